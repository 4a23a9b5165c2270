// Runs glint's side of a contest. See stage.h.
#include "stage.h"

glint_settings bench_stage_settings(const bench_stage *stage, bench_job job, int depth)
{
    glint_settings settings = glint_settings_default;
    settings.width = stage->width;
    settings.height = stage->height;
    settings.depth = 1;
    if (job == BENCH_TRAVERSE) {
        settings.output = GLINT_OUTPUT_HITS;
    } else if (job == BENCH_REFRACT) {
        settings.depth = 2;
        settings.fresnel = GLINT_FRESNEL_NONE;
    } else if (job == BENCH_GLASS) {
        settings.depth = depth;
        settings.min_weight = (double)BENCH_GLASS_MIN_WEIGHT;
    }
    return settings;
}

glint_status bench_stage_renderer(const bench_stage *stage, bench_job job,
                                  const glint_settings *settings, glint_renderer **renderer,
                                  glint_error *error)
{
    bench_scene_set_material(stage->scene, job);
    const glint_renderer_inputs inputs = {
        .device = stage->device,
        .scene = &stage->scene->scene,
        .environment = stage->environment,
        .settings = settings,
    };
    return glint_renderer_create(&inputs, renderer, error);
}

glint_status bench_stage_frame(const bench_stage *stage, glint_renderer *renderer, double *ms,
                               glint_image *image, glint_error *error)
{
    glint_frame_report report = {0};
    glint_status status = glint_renderer_frame(
        &(glint_frame_request){renderer, &stage->scene->camera, NULL, image, &report}, error);
    *ms = report.kernel_ms;
    return status;
}
