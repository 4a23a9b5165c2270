// Tests captures, changing environments, and pictures behind frames.
#include "render/capture.h"

#include "scene/subset.h"
#include "support/bridge.h"
#include "support/render.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static glint_renderer *make(const glint_scene *scene, const glint_environment *environment,
                            const glint_settings *settings)
{
    const glint_renderer_inputs inputs = {
        .device = test_device(), .scene = scene, .environment = environment, .settings = settings};
    glint_renderer *renderer;
    glint_error error = {0};
    assert_int_equal(glint_renderer_create(&inputs, &renderer, &error), GLINT_OK);
    return renderer;
}

// The rays of a view's pixels go through the centres of texels. In an empty scene the capture
// equals each texel, except for rounding of the look-up's place. The rounding is a few times 2⁻²³
// of a face's edge, between texels that differ by at most 2.
static void an_empty_scene_is_its_environment(void **state)
{
    (void)state;
    glint_scene scene;
    glint_environment environment;
    glint_error error = {0};
    glint_cube cube;
    test_scene_load("mirror_sphere", &scene);
    assert_int_equal(glint_scene_remove_nodes(&scene, "1", &error), GLINT_OK);
    bridge_direction_environment(32, &environment);
    glint_settings settings = test_small_frame(1);
    settings.texels = GLINT_TEXELS_FLOAT;
    settings = glint_capture_settings(&settings, 32);
    glint_renderer *renderer = make(&scene, &environment, &settings);
    const glint_vec3 at = {3, -1, 2};
    assert_int_equal(
        glint_capture(&(glint_capture_request){renderer, at, NULL, NULL}, &cube, &error), GLINT_OK);
    assert_int_equal(cube.edge, 32);
    double worst = 0;
    for (size_t i = 0; i < glint_cube_size(&cube); i++) {
        if (i % 4 != 3) {
            worst =
                fmax(worst, fabs((double)cube.texels[i] - (double)environment.radiance.texels[i]));
        }
    }
    assert_true(worst <= 32 * 8 * 2 / 8388608.0);
    glint_cube_free(&cube);
    glint_renderer_free(renderer);
    glint_environment_free(&environment);
    glint_scene_free(&scene);
}

// The view of a face equals the frame of a camera at that place.
static void a_face_is_a_frame(void **state)
{
    (void)state;
    glint_scene scene;
    glint_environment environment;
    glint_error error = {0};
    glint_cube cube;
    glint_image image = {0};
    test_scene_load("lecture_example_2", &scene);
    bridge_direction_environment(16, &environment);
    glint_settings settings = test_small_frame(2);
    settings = glint_capture_settings(&settings, 24);
    glint_renderer *renderer = make(&scene, &environment, &settings);
    glint_frame_report report, of_frame;
    const glint_vec3 at = {0, 0, 2.5};
    assert_int_equal(
        glint_capture(&(glint_capture_request){renderer, at, NULL, &report}, &cube, &error),
        GLINT_OK);
    // Render each face through a camera with a field of view of 90 degrees.
    for (int face = 0; face < 6; face++) {
        const glint_vec3 ahead = glint_cube_direction(face, 0, 0);
        const glint_vec3 right = glint_vec3_subtract(glint_cube_direction(face, 1, 0), ahead);
        const glint_camera camera = {.yfov = 2 * atan(1),
                                     .eye = at,
                                     .right = right,
                                     .up = glint_vec3_cross(glint_vec3_scale(ahead, -1), right),
                                     .back = glint_vec3_scale(ahead, -1)};
        assert_int_equal(
            glint_renderer_frame(&(glint_frame_request){renderer, &camera, NULL, &image, &of_frame},
                                 &error),
            GLINT_OK);
        for (int k = 0; k < 24 * 24; k++) {
            assert_memory_equal(glint_image_pixel(&image, k % 24, k / 24),
                                glint_cube_texel(&cube, face, k % 24, k / 24), 3 * sizeof(float));
        }
        report.rays.primary -= of_frame.rays.primary;
        report.rays.reflected -= of_frame.rays.reflected;
    }
    assert_true(report.rays.primary == 0 && report.rays.reflected == 0);
    glint_image_free(&image);
    glint_cube_free(&cube);
    glint_renderer_free(renderer);
    glint_environment_free(&environment);
    glint_scene_free(&scene);
}

static bool stop_within_the_third_view(void *context, uint64_t done, uint64_t total)
{
    uint64_t *most = context;
    assert_true(done >= *most);
    *most = done;
    return done * 6 < 3 * total;
}

static void a_capture_can_be_stopped_and_is_square(void **state)
{
    (void)state;
    glint_scene scene;
    glint_environment environment;
    glint_error error = {0};
    glint_cube cube;
    uint64_t most = 0;
    test_scene_load("mirror_sphere", &scene);
    bridge_direction_environment(16, &environment);
    glint_settings settings = test_small_frame(1);
    const glint_vec3 at = {0, 0, 0};
    glint_renderer *renderer = make(&scene, &environment, &settings);
    assert_int_equal(
        glint_capture(&(glint_capture_request){renderer, at, NULL, NULL}, &cube, &error),
        GLINT_USAGE);
    assert_null(cube.texels);
    glint_renderer_free(renderer);
    settings.aovs = GLINT_AOV_ALL;
    settings.transparent = true;
    settings = glint_capture_settings(&settings, 64);
    assert_true(settings.aovs == 0 && !settings.transparent);
    renderer = make(&scene, &environment, &settings);
    const glint_progress progress = {stop_within_the_third_view, &most};
    assert_int_equal(
        glint_capture(&(glint_capture_request){renderer, at, &progress, NULL}, &cube, &error),
        GLINT_INTERRUPTED);
    assert_null(cube.texels);
    assert_int_equal(
        glint_capture(&(glint_capture_request){renderer, at, NULL, NULL}, &cube, &error), GLINT_OK);
    glint_cube_free(&cube);
    glint_renderer_free(renderer);
    glint_environment_free(&environment);
    glint_scene_free(&scene);
}

// The environments have other sizes and are too bright for half texels, so the kernels change. The
// frames must equal the frames of new renderers. The paint of the red sphere also needs the
// irradiance of each environment.
static void environments_take_each_others_place(void **state)
{
    (void)state;
    glint_scene scene;
    glint_environment environments[3];
    glint_error error = {0};
    test_scene_load("lecture_example_2", &scene);
    bridge_direction_environment(16, &environments[0]);
    bridge_direction_environment(24, &environments[1]);
    bridge_direction_environment(16, &environments[2]);
    const double bright[3] = {1e5, 2, 3};
    glint_cube_store(&environments[1].radiance, 4, 5, 6, bright);
    glint_cube_fill_border(&environments[1].radiance);
    const glint_settings settings = test_small_frame(3);
    glint_renderer *renderer = make(&scene, &environments[2], &settings);
    const glint_camera *camera = &scene.cameras[0];
    // Compare the shared renderer with a new renderer for each environment.
    for (int i = 0; i < 3; i++) {
        glint_renderer *own = make(&scene, &environments[i], &settings);
        glint_image wanted = {0}, found = {0};
        assert_int_equal(glint_renderer_plan(own)->half_texels, i != 1);
        assert_int_equal(
            glint_renderer_frame(&(glint_frame_request){own, camera, NULL, &wanted, NULL}, &error),
            GLINT_OK);
        assert_int_equal(glint_renderer_set_environment(renderer, &environments[i], &error),
                         GLINT_OK);
        assert_int_equal(glint_renderer_plan(renderer)->half_texels, i != 1);
        assert_int_equal(glint_renderer_frame(
                             &(glint_frame_request){renderer, camera, NULL, &found, NULL}, &error),
                         GLINT_OK);
        assert_int_equal(test_count_different(&wanted, &found), 0);
        glint_image_free(&wanted);
        glint_image_free(&found);
        glint_renderer_free(own);
    }
    glint_renderer_free(renderer);
    for (int i = 0; i < 3; i++) {
        glint_environment_free(&environments[i]);
    }
    glint_scene_free(&scene);
}

// The renderer refuses an environment that the device cannot hold, and still takes the next one.
static void a_refused_environment_is_followed_by_another(void **state)
{
    (void)state;
    glint_scene scene;
    glint_environment good, bad;
    glint_error error = {0};
    glint_image image = {0};
    test_scene_load("mirror_sphere", &scene);
    bridge_direction_environment(16, &good);
    bridge_direction_environment(16, &bad);
    const double bright[3] = {1e5, 2, 3};
    glint_cube_store(&bad.radiance, 4, 5, 6, bright);
    glint_settings settings = test_small_frame(1);
    settings.texels = GLINT_TEXELS_HALF;
    glint_renderer *renderer = make(&scene, &good, &settings);
    const glint_camera *camera = &scene.cameras[0];
    assert_int_equal(glint_renderer_set_environment(renderer, &bad, &error), GLINT_USAGE);
    assert_int_equal(
        glint_renderer_frame(&(glint_frame_request){renderer, camera, NULL, &image, NULL}, &error),
        GLINT_USAGE);
    assert_int_equal(glint_renderer_set_environment(renderer, &good, &error), GLINT_OK);
    assert_int_equal(
        glint_renderer_frame(&(glint_frame_request){renderer, camera, NULL, &image, NULL}, &error),
        GLINT_OK);
    glint_image_free(&image);
    glint_renderer_free(renderer);
    glint_environment_free(&good);
    glint_environment_free(&bad);
    glint_scene_free(&scene);
}

static void a_picture_is_put_behind_by_what_is_left_open(void **state)
{
    (void)state;
    float front[4][4] = {{1, 2, 3, 1}, {0, 0, 0, 0}, {0.25f, 0.5f, 0, 0.5f}, {-0.0f, 5, 0, 0}};
    float back[4][4] = {{NAN, INFINITY, 1, 1}, {7, 8, 9, 0.5f}, {2, 4, 6, 1}, {1, 0, NAN, 1}};
    const float wanted[4][4] = {{1, 2, 3, 1}, {7, 8, 9, 1}, {1.25f, 2.5f, 3, 1}, {1, 5, NAN, 1}};
    const glint_image over = {2, 2, 4, &front[0][0]}, under = {2, 2, 4, &back[0][0]};
    glint_image_put_behind(&over, &under);
    for (int k = 0; k < 16; k++) {
        const float a = front[k / 4][k % 4], b = wanted[k / 4][k % 4];
        assert_true(a == b || (isnan(a) && isnan(b)));
    }
    float open[2][4] = {{0, 0, 0, 0}, {0, 1, 0, 0.75f}};
    const glint_image single = {2, 1, 4, &open[0][0]};
    float few[2] = {3, 8};
    const glint_image one_channel = {2, 1, 1, few};
    glint_image_put_behind(&single, &one_channel);
    assert_true(open[0][0] == 3 && open[0][2] == 3 && open[0][3] == 1);
    assert_true(open[1][0] == 2 && open[1][1] == 3 && open[1][3] == 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_empty_scene_is_its_environment),
        cmocka_unit_test(a_face_is_a_frame),
        cmocka_unit_test(a_capture_can_be_stopped_and_is_square),
        cmocka_unit_test(environments_take_each_others_place),
        cmocka_unit_test(a_refused_environment_is_followed_by_another),
        cmocka_unit_test(a_picture_is_put_behind_by_what_is_left_open),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
