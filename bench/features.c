// bench_features WIDTHxHEIGHT ROUNDS SCENE…: kernels that hold what a scene needs against kernels
// that hold everything. For each scene (a file or a built-in one) in the studio: pixels that
// differ, times of frames in turns, compile times, sizes of what the compiler made. One line of
// figures a scene, with tabs between: features compiled in, milliseconds a frame, cold compile,
// KiB, each of both; their ratio's quartiles; pixels that differ, and by how much at most.
#include "options.h"

#include "glint.h"
#include "report/bench.h"
#include "report/metrics.h"
#include "report/statistics.h"
#include "scene/built_in.h"

#include <math.h>
#include <stdio.h>
#include <sys/stat.h>

enum { KINDS = 2, ROUNDS_MAX = 64, SCENES_MAX = 16 }; // what is needed; everything

typedef struct subject {
    const char *name;
    glint_scene scene;
    glint_camera camera;
    glint_settings settings[KINDS];
    glint_compile_time compile[KINDS];
} subject;

typedef struct contest {
    glint_device *device;
    const glint_environment *studio;
    int rounds;
    glint_renderer *renderers[KINDS];
    glint_image images[KINDS];
    double ms[KINDS][ROUNDS_MAX], ratios[ROUNDS_MAX];
} contest;

static glint_status load(const char *name, int width, int height, subject *s, glint_error *error)
{
    struct stat facts;
    *s = (subject){.name = name};
    glint_status status = stat(name, &facts) == 0
                              ? glint_scene_load(name, NULL, &s->scene, NULL, error)
                              : glint_built_in_scene(name, &s->scene, error);
    if (status == GLINT_OK) {
        status = glint_scene_camera(&s->scene, NULL, &s->camera, error);
    }
    for (int i = 0; i < KINDS; i++) {
        s->settings[i] = glint_settings_default;
        s->settings[i].width = width;
        s->settings[i].height = height;
        s->settings[i].all_features = i == 1;
    }
    return status;
}

// In children: this process must not have loaded a driver yet.
static glint_status time_compiling(subject *s, const glint_environment *studio, glint_error *error)
{
    glint_status status = GLINT_OK;
    for (int i = 0; status == GLINT_OK && i < KINDS; i++) {
        const glint_bench_inputs inputs = {.scene = &s->scene,
                                           .environment = studio,
                                           .camera = &s->camera,
                                           .settings = &s->settings[i]};
        status = glint_bench_compile_time(&inputs, NULL, &s->compile[i], error);
    }
    return status;
}

static glint_status render(const subject *s, contest *c, glint_error *error)
{
    glint_status status = GLINT_OK;
    for (int i = 0; status == GLINT_OK && i < KINDS; i++) {
        const glint_renderer_inputs inputs = {.device = c->device,
                                              .scene = &s->scene,
                                              .environment = c->studio,
                                              .settings = &s->settings[i]};
        status = glint_renderer_create(&inputs, &c->renderers[i], error);
    }
    for (int round = -1; round < c->rounds; round++) { // the first is not counted
        for (int i = 0; status == GLINT_OK && i < KINDS; i++) {
            glint_frame_report report;
            status = glint_renderer_frame(c->renderers[i], &s->camera, NULL, &c->images[i], &report,
                                          error);
            c->ms[i][round < 0 ? 0 : round] = report.kernel_ms;
        }
    }
    for (int round = 0; round < c->rounds; round++) {
        c->ratios[round] = c->ms[1][round] / c->ms[0][round];
    }
    return status;
}

static void print_figures(const subject *s, contest *c)
{
    const glint_image *a = &c->images[0], *b = &c->images[1];
    const size_t values = 4 * (size_t)a->width * (size_t)a->height;
    size_t differing = 0;
    double largest = 0;
    for (size_t i = 0; i < values; i += 4) {
        double off = 0;
        for (size_t k = i; k < i + 4; k++) {
            const double difference = fabs((double)a->pixels[k] - (double)b->pixels[k]);
            off = isnan(difference) ? INFINITY : fmax(off, difference);
        }
        differing += off > 0;
        largest = fmax(largest, off);
    }
    const glint_summary ratio = glint_summarize(c->ratios, (size_t)c->rounds);
    printf("%s", s->name);
    for (int i = 0; i < KINDS; i++) {
        const glint_summary times = glint_summarize(c->ms[i], (size_t)c->rounds);
        printf("\t%d\t%.2f\t%.2f\t%.0f",
               glint_plan_feature_count(glint_renderer_plan(c->renderers[i])), times.median,
               s->compile[i].cold / 1e3,
               (double)glint_renderer_program_bytes(c->renderers[i]) / 1024);
    }
    printf("\t%.2f\t%.2f\t%.2f\t%zu\t%.2g\n", ratio.lower_quartile, ratio.median,
           ratio.upper_quartile, differing, largest);
    fflush(stdout);
}

static glint_status run_all(subject *subjects, int count, contest *c, glint_error *error)
{
    glint_status status = GLINT_OK;
    for (int i = 0; status == GLINT_OK && i < count; i++) {
        status = time_compiling(&subjects[i], c->studio, error);
    }
    if (status == GLINT_OK) {
        status = glint_device_open(NULL, &c->device, error);
    }
    for (int i = 0; status == GLINT_OK && i < count; i++) {
        status = render(&subjects[i], c, error);
        if (status == GLINT_OK) {
            print_figures(&subjects[i], c);
        }
        for (int k = 0; k < KINDS; k++) {
            glint_renderer_free(c->renderers[k]);
            c->renderers[k] = NULL;
            glint_image_free(&c->images[k]);
        }
    }
    glint_device_close(c->device);
    return status;
}

int main(int argc, char **argv)
{
    glint_error error = {0};
    glint_environment studio = {0};
    int width = 1280, height = 720;
    double rounds = 9;
    glint_status status =
        argc > 3 ? bench_parse_size(argv[1], &width, &height, &error)
                 : glint_fail(&error, GLINT_USAGE, "WIDTHxHEIGHT ROUNDS SCENE… are expected");
    if (status == GLINT_OK) {
        status = bench_parse_count("rounds", argv[2], ROUNDS_MAX, &rounds, &error);
    }
    static subject subjects[SCENES_MAX];
    const int count = argc > 3 ? argc - 3 : 0;
    if (status == GLINT_OK && count > SCENES_MAX) {
        status = glint_fail(&error, GLINT_USAGE, "%d scenes at most", SCENES_MAX);
    }
    if (status == GLINT_OK) {
        status = glint_environment_studio(&studio, &error);
    }
    for (int i = 0; status == GLINT_OK && i < count; i++) {
        status = load(argv[i + 3], width, height, &subjects[i], &error);
    }
    if (status == GLINT_OK) {
        contest c = {.studio = &studio, .rounds = (int)rounds};
        status = run_all(subjects, count, &c, &error);
    }
    for (int i = 0; i < count && i < SCENES_MAX; i++) {
        glint_scene_free(&subjects[i].scene);
    }
    glint_environment_free(&studio);
    return bench_finish("bench_features", status, &error);
}
