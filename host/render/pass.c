// Runs one pass over a frame's pixels. See pass.h.
#include "render/pass.h"

#include "base/clock.h"
#include "kernels/layout.h"
#include "render/vertices.h"

#include <math.h>

static uint64_t total_of(const uint32_t *counters, int counter)
{
    uint64_t total = 0;
    for (int slot = 0; slot < GLINT_COUNTER_SLOTS; slot++) {
        const uint32_t *words = counters + 2 * (slot * GLINT_COUNTERS + counter);
        const uint64_t value = ((uint64_t)words[1] << 32) + words[0];
        total = counter == GLINT_COUNT_DEEPEST ? (value > total ? value : total) : total + value;
    }
    return total;
}

static void count_rays(const uint32_t *counters, glint_ray_counts *rays)
{
    rays->reflected = total_of(counters, GLINT_COUNT_REFLECTED);
    rays->refracted_in = total_of(counters, GLINT_COUNT_REFRACTED_IN);
    rays->refracted_out = total_of(counters, GLINT_COUNT_REFRACTED_OUT);
    rays->transmitted = total_of(counters, GLINT_COUNT_TRANSMITTED);
    rays->shadow = total_of(counters, GLINT_COUNT_SHADOW_RAYS);
    rays->total_reflections = total_of(counters, GLINT_COUNT_TOTAL_REFLECTIONS);
}

// The share of a weight counter in the weight of all samples.
static double share_of(const uint32_t *counters, int counter, uint64_t samples)
{
    return (double)total_of(counters, counter) / ldexp((double)samples, GLINT_WEIGHT_BITS);
}

static glint_status read_counters(const glint_renderer *r, glint_frame_report *report,
                                  glint_error *error)
{
    uint32_t counters[GLINT_COUNTER_WORDS];
    TRY(glint_target_read_counters(&r->target, counters, error));
    int size[2];
    glint_settings_pixels(&r->settings, size);
    const int k = r->settings.samples_per_axis;
    const uint64_t pixels = (uint64_t)size[0] * (uint64_t)size[1];
    const uint64_t samples = pixels * (uint64_t)(k * k);
    count_rays(counters, &report->rays);
    report->rays.primary = samples;
    report->deepest = (uint32_t)total_of(counters, GLINT_COUNT_DEEPEST);
    const double squares =
        ldexp((double)total_of(counters, GLINT_COUNT_TRUNCATION_SQUARES), -GLINT_SQUARE_BITS);
    report->truncation = (glint_truncation){
        // If the depth is exact, untraced light is known to see the environment.
        .by_depth =
            r->plan.depth_is_exact ? 0 : share_of(counters, GLINT_COUNT_WEIGHT_BY_DEPTH, samples),
        .by_min_weight = share_of(counters, GLINT_COUNT_WEIGHT_BY_MIN_WEIGHT, samples),
        .by_stack = share_of(counters, GLINT_COUNT_WEIGHT_BY_STACK, samples),
        .rms = r->settings.truncation_squares ? sqrt(squares / (double)pixels) : 0,
        .media_overflows = total_of(counters, GLINT_COUNT_MEDIA_OVERFLOWS),
    };
    return GLINT_OK;
}

static void make_record(const glint_renderer *r, const glint_camera *camera,
                        glint_frame_record *record)
{
    glint_view_record(&r->scene.space, camera, &r->settings, &r->plan, record);
    glint_view_set_proxy(&r->scene.space, &r->light.proxy, record);
    record->environment_edge = r->light.chosen.environment_edge;
    record->irradiance_edge = r->light.chosen.irradiance_edge;
    record->terms = r->settings.terms;
}

// Shades the vertices and renders the tiles into `pixels`.
static glint_status launch(const glint_frame_request *request, cl_mem pixels, glint_error *error)
{
    glint_renderer *r = request->renderer;
    glint_frame_record record;
    make_record(r, request->camera, &record);
    glint_launcher launcher = glint_renderer_launcher(r);
    launcher.outputs.pixels = pixels;
    TRY(glint_target_clear_counters(&r->target, error));
    TRY(glint_vertices_shade(&launcher, &record, r->scene.shown.bvh.cluster_count, error));
    return glint_launches_run(&launcher, &record, request->progress, &r->bands_per_ms, error);
}

static glint_status render(const glint_frame_request *request, glint_error *error)
{
    glint_renderer *r = request->renderer;
    cl_mem pixels;
    TRY(glint_renderer_suit(r, request->camera, error));
    TRY(glint_pixels_begin(&r->target.pixels, request->image, &pixels, error));
    double clock = glint_now_ms();
    const glint_status status = launch(request, pixels, error);
    request->report->kernel_ms = glint_lap_ms(&clock);
    const bool is_rendered = status == GLINT_OK;
    const glint_status ended = glint_pixels_end(&r->target.pixels, is_rendered, request->image,
                                                is_rendered ? error : NULL);
    TRY(status);
    TRY(ended);
    TRY(read_counters(r, request->report, error));
    request->report->readback_ms = glint_lap_ms(&clock);
    return GLINT_OK;
}

glint_status glint_pass_run(const glint_frame_request *request, glint_error *error)
{
    *request->report = (glint_frame_report){0};
    const glint_status status = render(request, error);
    if (status != GLINT_OK) {
        glint_image_free(request->image);
    }
    return status;
}
