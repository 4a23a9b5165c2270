// Tests the pipeline of a sequence. Every frame must be written once with the pixels of a single
// frame. No more frames may be in flight than promised, and the pipeline must end on request.
#include "render/sequence.h"

#include "device/opencl.h"
#include "support/bridge.h"
#include "support/render.h"

#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { FRAMES = 12, WRITERS = 2 };

typedef struct shot {
    glint_scene scene;
    glint_environment environment;
    glint_settings settings;
    glint_renderer *renderer;
    glint_image alone[FRAMES]; // each frame rendered alone
    int asked;                 // number of frames from `next`
    int end;                   // number of frames in the sequence
    bool hesitates;            // every other time, `next` asks to be called again
    int refuse_after;          // number of frames that `done` takes before it ends the sequence
    int fail;                  // the frame with a write error; −1: none
    atomic_int writing, most_writing, written[FRAMES], different;
    int in_flight, most_in_flight, traced, done, failed;
    pthread_t caller;
    useconds_t delay; // time for writing
    int stop_at;      // `progress` ends the sequence within this frame; −1: never
} shot;

static glint_camera camera_of(const shot *s, int number)
{
    const glint_vec3 centre = {0, 0, 0};
    return glint_camera_orbit(&s->scene.cameras[0], centre, number, FRAMES);
}

static int open_shot(void **state)
{
    shot *s = calloc(1, sizeof *s);
    glint_error error = {0};
    test_scene_load("mirror_sphere", &s->scene);
    bridge_direction_environment(32, &s->environment);
    s->settings = test_small_frame(2);
    const glint_renderer_inputs inputs = {.device = test_device(),
                                          .scene = &s->scene,
                                          .environment = &s->environment,
                                          .settings = &s->settings};
    assert_int_equal(glint_renderer_create(&inputs, &s->renderer, &error), GLINT_OK);
    for (int i = 0; i < FRAMES; i++) {
        const glint_camera camera = camera_of(s, i);
        assert_int_equal(
            glint_renderer_frame(
                &(glint_frame_request){s->renderer, &camera, NULL, &s->alone[i], NULL}, &error),
            GLINT_OK);
    }
    assert_true(test_count_different(&s->alone[0], &s->alone[1]) > 0);
    *state = s;
    return 0;
}

static int close_shot(void **state)
{
    shot *s = *state;
    for (int i = 0; i < FRAMES; i++) {
        glint_image_free(&s->alone[i]);
    }
    glint_renderer_free(s->renderer);
    glint_environment_free(&s->environment);
    glint_scene_free(&s->scene);
    free(s);
    return test_close_device(state);
}

static glint_sequence_next next(void *context, glint_sequence_frame *frame)
{
    shot *s = context;
    if (s->asked == s->end) {
        return GLINT_NEXT_NONE;
    }
    s->hesitates = !s->hesitates;
    if (s->hesitates) {
        return GLINT_NEXT_AGAIN;
    }
    frame->number = s->asked++;
    frame->camera = camera_of(s, frame->number);
    return GLINT_NEXT_FRAME;
}

static void traced(void *context, glint_sequence_frame *frame)
{
    shot *s = context;
    frame->own = s;
    s->traced++;
    s->in_flight++;
    s->most_in_flight = s->in_flight > s->most_in_flight ? s->in_flight : s->most_in_flight;
}

static void write_frame(void *context, glint_sequence_frame *frame)
{
    shot *s = context;
    const int now = atomic_fetch_add(&s->writing, 1) + 1;
    int most = atomic_load(&s->most_writing);
    while (now > most && !atomic_compare_exchange_weak(&s->most_writing, &most, now)) {
    }
    usleep(s->delay);
    atomic_fetch_add(&s->written[frame->number], 1);
    if (test_count_different(&frame->image, &s->alone[frame->number]) > 0) {
        atomic_fetch_add(&s->different, 1);
    }
    if (frame->number == s->fail) {
        frame->status = glint_fail(&frame->error, GLINT_OUTPUT_FAILED, "no");
    }
    atomic_fetch_sub(&s->writing, 1);
}

static bool done(void *context, glint_sequence_frame *frame)
{
    shot *s = context;
    assert_true(pthread_equal(pthread_self(), s->caller));
    assert_true((frame->number == s->fail) == (frame->status != GLINT_OK));
    assert_ptr_equal(frame->own, s);
    s->failed += frame->status != GLINT_OK;
    s->in_flight--;
    s->done++;
    return s->done < s->refuse_after;
}

static bool step(void *context, uint64_t at, uint64_t total)
{
    const shot *s = context;
    return !(s->asked - 1 == s->stop_at && at > 0 && at <= total);
}

// Runs with the settings in *s and with new counts.
static glint_status run(shot *s, size_t writers, useconds_t delay)
{
    s->asked = s->in_flight = s->most_in_flight = s->traced = s->done = s->failed = 0;
    atomic_store(&s->most_writing, 0);
    atomic_store(&s->different, 0);
    memset(s->written, 0, sizeof s->written);
    s->caller = pthread_self();
    s->delay = delay;
    const glint_sequence sequence = {.renderer = s->renderer,
                                     .writers = writers,
                                     .next = next,
                                     .traced = traced,
                                     .write = write_frame,
                                     .done = done,
                                     .progress = {step, s},
                                     .context = s};
    glint_error error = {0};
    glint_status status = glint_sequence_run(&sequence, &error);
    glint_error_free(&error);
    assert_int_equal(atomic_load(&s->writing), 0);
    assert_int_equal(s->in_flight, 0);
    assert_int_equal(s->done, s->traced);
    return status;
}

static void settle(shot *s)
{
    s->end = FRAMES;
    s->refuse_after = FRAMES + 1;
    s->fail = -1;
    s->stop_at = -1;
}

static void assert_each_written_once(shot *s, int frames)
{
    for (int i = 0; i < FRAMES; i++) {
        assert_int_equal(atomic_load(&s->written[i]), i < frames ? 1 : 0);
    }
    assert_int_equal(atomic_load(&s->different), 0);
}

static void frames_have_the_pixels_that_they_have_by_themselves(void **state)
{
    shot *s = *state;
    settle(s);
    for (size_t writers = 1; writers <= 4; writers++) {
        assert_int_equal(run(s, writers, 0), GLINT_OK);
        assert_each_written_once(s, FRAMES);
    }
    s->end = 0;
    assert_int_equal(run(s, 1, 0), GLINT_OK);
    assert_each_written_once(s, 0);
}

static void no_more_frames_are_in_flight_than_was_promised(void **state)
{
    shot *s = *state;
    settle(s);
    assert_int_equal(run(s, WRITERS, 50000), GLINT_OK); // tracing takes far less
    assert_each_written_once(s, FRAMES);
    assert_true(atomic_load(&s->most_writing) <= WRITERS);
    assert_true(s->most_in_flight <= WRITERS + 2);
}

static void one_bad_frame_does_not_stop_the_others(void **state)
{
    shot *s = *state;
    settle(s);
    s->fail = 3;
    assert_int_equal(run(s, WRITERS, 0), GLINT_OK);
    assert_int_equal(s->failed, 1);
    assert_each_written_once(s, FRAMES);
}

static void it_ends_when_told_to(void **state)
{
    shot *s = *state;
    settle(s);
    s->refuse_after = 2;
    assert_int_equal(run(s, WRITERS, 20000), GLINT_OK);
    assert_true(s->traced < FRAMES);
    assert_each_written_once(s, s->traced);
    settle(s);
    s->stop_at = 4; // its pixels are discarded; frames traced before are written
    assert_int_equal(run(s, WRITERS, 0), GLINT_INTERRUPTED);
    assert_int_equal(s->traced, 4);
    assert_each_written_once(s, 4);
}

static void writers_are_bounded_by_memory(void **state)
{
    (void)state;
    assert_true(glint_sequence_writers(1) >= 1);
    assert_int_equal(glint_sequence_writers(68e9), 1);
    assert_true(glint_sequence_writers(256e6) <= 2);
}

// A renderer that gets several scenes must give the frames of separate renderers, also if a scene
// needs other kernels, such as a scene without glass.
static void a_renderer_given_a_scene_is_one_made_of_it(void **state)
{
    shot *s = *state;
    static const double times[] = {0, 0.01, 0.3, 1.1, 2, 0.3};
    glint_error error = {0};
    int refitted = 0;
    glint_scene_source *source;
    const char *path = GLINT_SOURCE_DIR "/scenes/clockwork.gltf";
    assert_int_equal(glint_scene_open(path, NULL, &source, &error), GLINT_OK);
    glint_settings settings = test_small_frame(0);
    glint_renderer_inputs inputs = {.device = test_device(),
                                    .scene = &s->scene,
                                    .environment = &s->environment,
                                    .settings = &settings};
    glint_renderer *moved;
    assert_int_equal(glint_renderer_create(&inputs, &moved, &error), GLINT_OK);
    for (size_t i = 0; i < sizeof times / sizeof *times; i++) {
        glint_scene scene;
        glint_image here = {0}, there = {0};
        glint_renderer *fresh;
        assert_int_equal(glint_scene_at(source, times[i], &scene, NULL, &error), GLINT_OK);
        inputs.scene = &scene;
        assert_int_equal(glint_renderer_create(&inputs, &fresh, &error), GLINT_OK);
        assert_int_equal(glint_renderer_set_scene(moved, &scene, &error), GLINT_OK);
        refitted += glint_renderer_bvh(moved)->is_refitted;
        const glint_camera *camera = &scene.cameras[0];
        assert_int_equal(
            glint_renderer_frame(&(glint_frame_request){moved, camera, NULL, &here, NULL}, &error),
            GLINT_OK);
        assert_int_equal(
            glint_renderer_frame(&(glint_frame_request){fresh, camera, NULL, &there, NULL}, &error),
            GLINT_OK);
        assert_int_equal(test_count_different(&here, &there), 0);
        glint_renderer_free(fresh);
        glint_image_free(&here);
        glint_image_free(&there);
        glint_scene_free(&scene);
    }
    assert_in_range(refitted, 1, sizeof times / sizeof *times - 1); // both refitted and new trees
    glint_renderer_free(moved);
    glint_scene_close(source);
}

// A scene may be prepared on another thread while a frame of the scene before renders. Both frames
// must have the same pixels as without preparation. Tests devices that share the host's memory and
// devices with copies.
typedef struct preparation {
    glint_renderer *renderer;
    const glint_scene *scene;
    glint_status status;
} preparation;

static void *prepare(void *context)
{
    preparation *p = context;
    glint_error error = {0};
    p->status = glint_renderer_prepare(p->renderer, p->scene, &error);
    glint_error_free(&error);
    return NULL;
}

static void render_into(glint_renderer *renderer, const glint_scene *scene, glint_image *image)
{
    glint_error error = {0};
    const glint_camera *camera = &scene->cameras[0];
    assert_int_equal(
        glint_renderer_frame(&(glint_frame_request){renderer, camera, NULL, image, NULL}, &error),
        GLINT_OK);
}

enum { TIMES = 6 };

// Renders a moving scene at some times, each with a new renderer.
static void render_alone(const glint_renderer_inputs *inputs, glint_scene *scenes,
                         glint_image *images)
{
    static const double times[TIMES] = {0, 0.01, 0.02, 0.03, 2, 0.3};
    const char *path = GLINT_SOURCE_DIR "/scenes/clockwork.gltf";
    glint_scene_source *source;
    glint_error error = {0};
    assert_int_equal(glint_scene_open(path, NULL, &source, &error), GLINT_OK);
    for (int i = 0; i < TIMES; i++) {
        assert_int_equal(glint_scene_at(source, times[i], &scenes[i], NULL, &error), GLINT_OK);
        glint_renderer_inputs its = *inputs;
        its.scene = &scenes[i];
        glint_renderer *fresh;
        assert_int_equal(glint_renderer_create(&its, &fresh, &error), GLINT_OK);
        render_into(fresh, &scenes[i], &images[i]);
        glint_renderer_free(fresh);
    }
    glint_scene_close(source);
}

static void follow_ahead(const glint_environment *environment)
{
    glint_error error = {0};
    glint_scene scenes[TIMES];
    glint_image alone[TIMES] = {0}, image = {0};
    glint_settings settings = test_small_frame(0);
    glint_renderer_inputs inputs = {.device = test_device(),
                                    .scene = &scenes[0],
                                    .environment = environment,
                                    .settings = &settings};
    render_alone(&inputs, scenes, alone);
    glint_renderer *renderer;
    int refitted = 0;
    assert_int_equal(glint_renderer_create(&inputs, &renderer, &error), GLINT_OK);
    for (int i = 0; i + 1 < TIMES; i++) {
        preparation ahead = {.renderer = renderer, .scene = &scenes[i + 1]};
        pthread_t thread;
        assert_int_equal(pthread_create(&thread, NULL, prepare, &ahead), 0);
        render_into(renderer, &scenes[i], &image);
        assert_int_equal(pthread_join(thread, NULL), 0);
        assert_int_equal(test_count_different(&image, &alone[i]), 0);
        assert_int_equal(ahead.status, GLINT_OK);
        assert_int_equal(glint_renderer_set_prepared(renderer, &scenes[i + 1], &error), GLINT_OK);
        refitted += glint_renderer_bvh(renderer)->is_refitted;
    }
    render_into(renderer, &scenes[TIMES - 1], &image);
    assert_int_equal(test_count_different(&image, &alone[TIMES - 1]), 0);
    assert_in_range(refitted, 1, TIMES - 2); // both refitted and new trees
    for (int i = 0; i < TIMES; i++) {
        glint_image_free(&alone[i]);
        glint_scene_free(&scenes[i]);
    }
    glint_image_free(&image);
    glint_renderer_free(renderer);
}

static void a_scene_made_ready_meanwhile_is_the_same(void **state)
{
    const shot *s = *state;
    glint_capabilities *capabilities = &test_device()->capabilities;
    const bool shares = capabilities->shares_memory;
    follow_ahead(&s->environment);
    capabilities->shares_memory = false;
    follow_ahead(&s->environment);
    capabilities->shares_memory = shares;
}

// An impossible scene. After a failed preparation the renderer keeps the scene before. After a
// failed set it renders no frame until it gets another scene.
static void a_renderer_outlives_a_scene_that_it_cannot_show(void **state)
{
    shot *s = *state;
    glint_error error = {0};
    glint_image image = {0};
    const glint_camera camera = camera_of(s, 0);
    const glint_scene bad = {.triangle_count = (size_t)1 << 40, .moves = true};
    assert_int_equal(glint_renderer_prepare(s->renderer, &bad, &error), GLINT_DEVICE_LACKS);
    glint_error_free(&error);
    assert_int_equal(glint_renderer_set_prepared(s->renderer, &bad, &error), GLINT_USAGE);
    glint_error_free(&error);
    assert_int_equal(glint_renderer_frame(
                         &(glint_frame_request){s->renderer, &camera, NULL, &image, NULL}, &error),
                     GLINT_OK);
    assert_int_equal(test_count_different(&image, &s->alone[0]), 0);
    assert_int_equal(glint_renderer_set_scene(s->renderer, &bad, &error), GLINT_DEVICE_LACKS);
    glint_error_free(&error);
    assert_int_equal(glint_renderer_frame(
                         &(glint_frame_request){s->renderer, &camera, NULL, &image, NULL}, &error),
                     GLINT_USAGE);
    glint_error_free(&error);
    assert_int_equal(glint_renderer_set_scene(s->renderer, &s->scene, &error), GLINT_OK);
    assert_int_equal(glint_renderer_frame(
                         &(glint_frame_request){s->renderer, &camera, NULL, &image, NULL}, &error),
                     GLINT_OK);
    assert_int_equal(test_count_different(&image, &s->alone[0]), 0);
    glint_image_free(&image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_have_the_pixels_that_they_have_by_themselves),
        cmocka_unit_test(no_more_frames_are_in_flight_than_was_promised),
        cmocka_unit_test(one_bad_frame_does_not_stop_the_others),
        cmocka_unit_test(it_ends_when_told_to),
        cmocka_unit_test(writers_are_bounded_by_memory),
        cmocka_unit_test(a_renderer_given_a_scene_is_one_made_of_it),
        cmocka_unit_test(a_scene_made_ready_meanwhile_is_the_same),
        cmocka_unit_test(a_renderer_outlives_a_scene_that_it_cannot_show),
    };
    return cmocka_run_group_tests(tests, open_shot, close_shot);
}
