// bench_shading [WIDTHxHEIGHT [ROUNDS]]: what shading at vertices costs and is worth, as a mesh is
// refined. Frames of a mirror ball in the studio by each shading rate, with four
// samples a pixel, against one of 5.2 million triangles, shaded by pixel. One line of figures a
// mesh, with tabs between, for bench/shading_rates.
#include "options.h"
#include "stage.h"

#include "glint.h"
#include "report/metrics.h"
#include "report/statistics.h"

#include <stdio.h>
#include <stdlib.h>

enum {
    RATES = 3,
    MESHES = 7,
    FINEST = 5242880,
    COARSEST = 80,
    ROUNDS_MAX = 64,
    SAMPLES_PER_AXIS = 2
};

static const glint_shading rates[RATES] = {GLINT_SHADING_VERTEX_COLOR,
                                           GLINT_SHADING_VERTEX_DIRECTION, GLINT_SHADING_PIXEL};

// Frames of one mesh by each rate.
typedef struct contest {
    bench_scene scene;
    bench_stage stage;
    glint_renderer *renderers[RATES];
    glint_image images[RATES];
    double ms[RATES][ROUNDS_MAX];
} contest;

static void end_contest(contest *c)
{
    for (int i = 0; i < RATES; i++) {
        glint_renderer_free(c->renderers[i]);
        glint_image_free(&c->images[i]);
    }
    bench_scene_free(&c->scene);
}

// In turns, so that what else the machine does falls on all alike.
static glint_status run_contest(const bench_stage *stage, int triangles, int first_rate, contest *c,
                                glint_error *error)
{
    *c = (contest){.stage = *stage};
    char name[32];
    snprintf(name, sizeof name, "ball:%d", triangles);
    glint_status status = bench_scene_make(name, &c->scene, error);
    c->stage.scene = &c->scene;
    for (int i = first_rate; status == GLINT_OK && i < RATES; i++) {
        glint_settings settings = bench_stage_settings(&c->stage, BENCH_REFLECT, 1);
        settings.shading = rates[i];
        settings.samples_per_axis = SAMPLES_PER_AXIS;
        status = bench_stage_renderer(&c->stage, BENCH_REFLECT, &settings, &c->renderers[i], error);
    }
    for (int round = 0; round < stage->rounds; round++) {
        for (int i = first_rate; status == GLINT_OK && i < RATES; i++) {
            status = bench_stage_frame(&c->stage, c->renderers[i], &c->ms[i][round], &c->images[i],
                                       error);
        }
    }
    return status;
}

static glint_status print_figures(contest *c, const glint_image *truth, glint_error *error)
{
    printf("%zu", c->scene.triangle_count);
    for (int i = 0; i < RATES; i++) {
        glint_metrics metrics;
        glint_status status = glint_metrics_find(&c->images[i], truth, NULL, &metrics, error);
        if (status != GLINT_OK) {
            return status;
        }
        const glint_summary times = glint_summarize(c->ms[i], (size_t)c->stage.rounds);
        printf("\t%.6g\t%.6g\t%.6g", metrics.relative_rmse, metrics.mae / metrics.mean,
               times.median);
    }
    putchar('\n');
    fflush(stdout);
    return GLINT_OK;
}

static glint_status run(bench_stage *stage, glint_error *error)
{
    contest truth, meshes;
    const int rounds = stage->rounds;
    stage->rounds = 1;
    glint_status status = run_contest(stage, FINEST, RATES - 1, &truth, error);
    stage->rounds = rounds;
    for (int i = 0, triangles = COARSEST; status == GLINT_OK && i < MESHES; i++, triangles *= 4) {
        status = run_contest(stage, triangles, 0, &meshes, error);
        if (status == GLINT_OK) {
            status = print_figures(&meshes, &truth.images[RATES - 1], error);
        }
        end_contest(&meshes);
    }
    end_contest(&truth);
    return status;
}

int main(int argc, char **argv)
{
    glint_error error = {0};
    glint_environment studio = {0};
    bench_stage stage = {.environment = &studio, .width = 512, .height = 512, .rounds = 5};
    glint_status status =
        argc > 1 ? bench_parse_size(argv[1], &stage.width, &stage.height, &error) : GLINT_OK;
    double rounds = stage.rounds;
    if (status == GLINT_OK && argc > 2) {
        status = bench_parse_count("rounds", argv[2], ROUNDS_MAX, &rounds, &error);
    }
    stage.rounds = (int)rounds;
    if (status == GLINT_OK) {
        status = glint_device_open(NULL, &stage.device, &error);
    }
    if (status == GLINT_OK) {
        status = glint_environment_studio(&studio, &error);
    }
    if (status == GLINT_OK) {
        status = run(&stage, &error);
    }
    glint_environment_free(&studio);
    glint_device_close(stage.device);
    return bench_finish("bench_shading", status, &error);
}
