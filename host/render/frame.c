// Rendering one frame. See frame.h.
#include "render/frame.h"

#include "base/clock.h"
#include "base/memory.h"
#include "device/opencl_error.h"
#include "kernels/layout.h"
#include "render/mend.h"
#include "render/renderer.h"
#include "render/terms.h"
#include "render/vertices.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Launches are made long enough to keep a device busy and short enough for progress and signals.
#define LAUNCH_MS 100.0
#define LAUNCHES_AT_ONCE 2
// The first frame's first one tells the speed.
#define FIRST_LAUNCH_SAMPLES 32768.0
// Rows of tiles that are rendered side by side: what neighbours have fetched from memory is then
// still in the caches. One where so many rows would be a long launch by themselves.
#define BAND_ROWS 4
#define BAND_SAMPLES 2e6

// Where a packet is one ray, the rays of 8 × 8 pixels share a work-group; a wider packet is a
// work-group's worth by itself.
static void local_size(const glint_plan *plan, size_t local[2])
{
    local[0] = local[1] = plan->kernel_width == 1 ? 8 : 1;
}

// Pixels that a work-item renders.
static void tile_size(const glint_plan *plan, int *width, int *height)
{
    *width = GLINT_PACKET_COLUMNS(plan->kernel_width) * GLINT_TILE_SIDE(plan->tiles);
    *height = GLINT_PACKET_ROWS(plan->kernel_width) * GLINT_TILE_SIDE(plan->tiles);
}

static size_t round_up(size_t value, size_t multiple)
{
    return (value + multiple - 1) / multiple * multiple;
}

glint_status glint_renderer_launch(glint_renderer *r, glint_frame_record *record, size_t first,
                                   size_t bands, cl_event *done, glint_error *error)
{
    record->first_band = (int)first;
    glint_status status =
        glint_renderer_set_argument(r, GLINT_FRAME_ARGUMENT, sizeof *record, record, error);
    if (status != GLINT_OK) {
        return status;
    }
    int tile_width, tile_height;
    tile_size(&r->plan, &tile_width, &tile_height);
    size_t local[2];
    local_size(&r->plan, local);
    const size_t width = record->width > 0 ? (size_t)record->width : 1; // 0: see equipment.c
    size_t columns = (width + (size_t)tile_width - 1) / (size_t)tile_width;
    const size_t across = columns * (size_t)record->band;
    const size_t global[2] = {round_up(across, local[0]), round_up(bands, local[1])};
    cl_command_queue queue = r->device->launches;
    cl_int code = clEnqueueNDRangeKernel(queue, r->kernel, 2, NULL, global, local, 0, NULL, done);
    if (code == CL_SUCCESS) {
        code = clFlush(queue);
        if (code != CL_SUCCESS) {
            clReleaseEvent(*done);
        }
    }
    return code == CL_SUCCESS ? GLINT_OK
                              : glint_fail_opencl(error, r->device, "running the kernel", code);
}

glint_status glint_renderer_wait(const glint_renderer *r, cl_event done, glint_error *error)
{
    const cl_int code = clWaitForEvents(1, &done);
    clReleaseEvent(done);
    return code == CL_SUCCESS ? GLINT_OK
                              : glint_fail_opencl(error, r->device, "running the kernel", code);
}

static glint_status clear_counters(const glint_renderer *r, glint_error *error)
{
    static const cl_uint zeros[GLINT_COUNTER_SLOTS * GLINT_COUNTERS * 2] = {0};
    cl_int code = clEnqueueWriteBuffer(r->device->queue, r->counters, CL_TRUE, 0, sizeof zeros,
                                       zeros, 0, NULL, NULL);
    return code == CL_SUCCESS ? GLINT_OK
                              : glint_fail_opencl(error, r->device, "clearing the counters", code);
}

static uint64_t total_of(const cl_uint *counters, int counter)
{
    uint64_t total = 0;
    for (int slot = 0; slot < GLINT_COUNTER_SLOTS; slot++) {
        const cl_uint *words = counters + 2 * (slot * GLINT_COUNTERS + counter);
        uint64_t value = ((uint64_t)words[1] << 32) + words[0];
        total = counter == GLINT_COUNT_DEEPEST ? (value > total ? value : total) : total + value;
    }
    return total;
}

static glint_status read_counters(const glint_renderer *r, glint_frame_report *report,
                                  glint_error *error)
{
    cl_uint counters[GLINT_COUNTER_SLOTS * GLINT_COUNTERS * 2];
    cl_int code = clEnqueueReadBuffer(r->device->queue, r->counters, CL_TRUE, 0, sizeof counters,
                                      counters, 0, NULL, NULL);
    if (code != CL_SUCCESS) {
        return glint_fail_opencl(error, r->device, "reading the counters", code);
    }
    const int k = r->settings.samples_per_axis;
    report->rays.primary = (uint64_t)glint_renderer_pixel_count(r) * (uint64_t)(k * k);
    report->rays.reflected = total_of(counters, GLINT_COUNT_REFLECTED);
    report->rays.refracted_in = total_of(counters, GLINT_COUNT_REFRACTED_IN);
    report->rays.refracted_out = total_of(counters, GLINT_COUNT_REFRACTED_OUT);
    report->rays.transmitted = total_of(counters, GLINT_COUNT_TRANSMITTED);
    report->rays.total_reflections = total_of(counters, GLINT_COUNT_TOTAL_REFLECTIONS);
    report->deepest = (uint32_t)total_of(counters, GLINT_COUNT_DEEPEST);
    double all = ldexp((double)report->rays.primary, GLINT_WEIGHT_BITS);
    glint_truncation *t = &report->truncation;
    // Where the depth is exact, what was not traced is known to see the environment.
    t->by_depth =
        r->plan.depth_is_exact ? 0 : (double)total_of(counters, GLINT_COUNT_WEIGHT_BY_DEPTH) / all;
    t->by_min_weight = (double)total_of(counters, GLINT_COUNT_WEIGHT_BY_MIN_WEIGHT) / all;
    t->by_stack = (double)total_of(counters, GLINT_COUNT_WEIGHT_BY_STACK) / all;
    t->rms =
        sqrt(ldexp((double)total_of(counters, GLINT_COUNT_TRUNCATION_SQUARES), -GLINT_SQUARE_BITS) /
             (double)glint_renderer_pixel_count(r));
    t->media_overflows = total_of(counters, GLINT_COUNT_MEDIA_OVERFLOWS);
    return GLINT_OK;
}

// The bands of tiles of the next launch: as many as would have taken LAUNCH_MS at the last one's
// speed, and at most four times as many, as the next part of the frame may be much slower.
static size_t next_step(size_t step, double elapsed_ms, size_t multiple)
{
    double factor = fmin(4, LAUNCH_MS / fmax(elapsed_ms, 1e-3));
    double wanted = fmax(1, (double)step * factor);
    return round_up((size_t)wanted, multiple);
}

// A frame's launches, of which a few are under way at once: what is left of one by the time that
// some of the device's cores find nothing more in it is rendered beside the next.
typedef struct launches {
    glint_renderer *renderer;
    glint_frame_record *record;
    size_t bands, begun, done; // of the frame; in launches that were begun, that have ended
    size_t step;               // bands of the next launch
    int under_way;
    struct {
        cl_event end;
        size_t bands;
    } queue[LAUNCHES_AT_ONCE]; // the oldest first
} launches;

static glint_status begin_launch(launches *l, glint_error *error)
{
    const size_t left = l->bands - l->begun, bands = l->step < left ? l->step : left;
    l->queue[l->under_way].bands = bands;
    glint_status status = glint_renderer_launch(l->renderer, l->record, l->begun, bands,
                                                &l->queue[l->under_way].end, error);
    l->begun += bands;
    l->under_way += status == GLINT_OK;
    return status;
}

static glint_status end_launch(launches *l, glint_error *error)
{
    cl_event end = l->queue[0].end;
    l->done += l->queue[0].bands;
    l->under_way--;
    memmove(l->queue, l->queue + 1, (size_t)l->under_way * sizeof *l->queue);
    return glint_renderer_wait(l->renderer, end, error);
}

// Bands of tiles, in launches of about LAUNCH_MS; asks `progress` between them.
static glint_status run_launches(launches *l, const glint_progress *progress, glint_error *error)
{
    size_t local[2];
    local_size(&l->renderer->plan, local);
    double clock = glint_now_ms();
    glint_status status = GLINT_OK;
    while (status == GLINT_OK && l->done < l->bands) {
        while (status == GLINT_OK && l->begun < l->bands && l->under_way < LAUNCHES_AT_ONCE) {
            status = begin_launch(l, error);
        }
        const size_t bands = l->queue[0].bands;
        if (status == GLINT_OK) {
            status = end_launch(l, error);
            l->step = next_step(bands, glint_lap_ms(&clock), local[1]);
        }
        if (status == GLINT_OK && progress != NULL &&
            !progress->step(progress->context, l->done, l->bands)) {
            status = glint_fail(error, GLINT_INTERRUPTED, "stopped");
        }
    }
    while (l->under_way > 0) {
        end_launch(l, NULL);
    }
    return status;
}

static glint_status run_frame(glint_renderer *r, glint_frame_record *record,
                              const glint_progress *progress, glint_error *error)
{
    int tile_width, tile_height;
    tile_size(&r->plan, &tile_width, &tile_height);
    size_t local[2];
    local_size(&r->plan, local);
    double row_samples =
        (double)record->width * tile_height * record->samples_per_axis * record->samples_per_axis;
    record->band = r->plan.tiles && BAND_ROWS * row_samples <= BAND_SAMPLES ? BAND_ROWS : 1;
    const int band_height = tile_height * record->band;
    double first_step = r->bands_per_ms > 0 ? r->bands_per_ms * LAUNCH_MS
                                            : FIRST_LAUNCH_SAMPLES / (row_samples * record->band);
    launches l = {
        .renderer = r,
        .record = record,
        .bands = ((size_t)record->height + (size_t)band_height - 1) / (size_t)band_height,
        .step = round_up((size_t)fmax(1, first_step), local[1]),
    };
    const double begun = glint_now_ms();
    glint_status status = run_launches(&l, progress, error);
    if (status == GLINT_OK) {
        r->bands_per_ms = (double)l.bands / fmax(glint_now_ms() - begun, 1e-3);
    }
    return status;
}

glint_status glint_renderer_frame(glint_renderer *renderer, const glint_camera *camera,
                                  const glint_progress *progress, glint_image *image,
                                  glint_frame_report *report, glint_error *error)
{
    glint_renderer *r = renderer;
    glint_frame_report own_report = {0};
    report = report != NULL ? report : &own_report;
    *report = (glint_frame_report){0};
    if (r->kernel == NULL || r->has_failed || r->is_dark) {
        glint_image_free(image);
        return glint_fail(error, GLINT_USAGE, "the renderer was made without frames, or failed");
    }
    glint_status status = glint_renderer_suit(r, camera, error);
    if (status != GLINT_OK) {
        glint_image_free(image);
        return status;
    }
    glint_frame_record record;
    glint_view_record(&r->space, camera, &r->settings, &r->plan, &record);
    record.environment_edge = r->environment_edge;
    record.irradiance_edge = r->irradiance_edge;
    record.terms = r->settings.terms;
    glint_view_set_proxy(&r->space, &r->proxy, &record);
    cl_mem target = NULL;
    status = glint_pixels_begin(&r->pixels, image, &target, error);
    if (status == GLINT_OK) {
        status =
            glint_renderer_set_argument(r, GLINT_PIXELS_ARGUMENT, sizeof target, &target, error);
    }
    double clock = glint_now_ms();
    if (status == GLINT_OK) {
        status = clear_counters(r, error);
    }
    if (status == GLINT_OK) {
        status = glint_vertices_shade(r, &record, error);
    }
    if (status == GLINT_OK) {
        status = run_frame(r, &record, progress, error);
        report->kernel_ms = glint_lap_ms(&clock);
    }
    glint_status ended =
        glint_pixels_end(&r->pixels, status == GLINT_OK, image, status == GLINT_OK ? error : NULL);
    status = status == GLINT_OK ? ended : status;
    if (status == GLINT_OK) {
        status = read_counters(r, report, error);
        report->readback_ms = glint_lap_ms(&clock);
    }
    if (status != GLINT_OK) {
        glint_image_free(image);
        return status;
    }
    const bool is_whole = r->settings.list == NULL && r->settings.grid_step == 0;
    if (r->settings.mend > 0 && is_whole) {
        status = glint_mend(r, camera, progress, image, report, error);
    }
    if (status != GLINT_OK) {
        glint_image_free(image);
        return status;
    }
    report->nonfinite_pixels = glint_image_count_nonfinite(image);
    r->phases.kernel = report->kernel_ms;
    r->phases.readback = report->readback_ms;
    return GLINT_OK;
}

glint_status glint_renderer_exact_pixels(glint_renderer *renderer, double **pixels,
                                         glint_error *error)
{
    *pixels = NULL;
    if (renderer->plan.precision != GLINT_PRECISION_DOUBLE) {
        return glint_fail(error, GLINT_USAGE, "only frames in double precision have exact pixels");
    }
    *pixels = glint_allocate_unset(glint_renderer_pixel_count(renderer) * 4, sizeof **pixels);
    if (*pixels == NULL) {
        return glint_fail_memory(error, "the frame");
    }
    glint_status status = glint_pixels_exact(&renderer->pixels, *pixels, error);
    if (status != GLINT_OK) {
        free(*pixels);
        *pixels = NULL;
    }
    return status;
}

glint_status glint_renderer_read(const glint_renderer *r, const char *what, cl_mem buffer,
                                 size_t bytes, void **copy, glint_error *error)
{
    *copy = malloc(bytes);
    if (*copy == NULL) {
        return glint_fail_memory(error, what);
    }
    cl_int code =
        clEnqueueReadBuffer(r->device->queue, buffer, CL_TRUE, 0, bytes, *copy, 0, NULL, NULL);
    return code == CL_SUCCESS ? GLINT_OK : glint_fail_opencl(error, r->device, what, code);
}

static glint_status read_layers(glint_renderer *r, glint_layers *layers, glint_error *error)
{
    const glint_settings *settings = &r->settings;
    void *records = NULL;
    glint_status status = glint_renderer_read(r, "reading the layers", r->layers,
                                              glint_layers_bytes(&r->settings), &records, error);
    if (status == GLINT_OK) {
        status = glint_layers_make(records, glint_renderer_pixel_count(r),
                                   settings->samples_per_axis * settings->samples_per_axis,
                                   settings->aovs, layers, error);
    }
    free(records);
    return status;
}

static glint_status read_terms(glint_renderer *r, glint_layers *layers, glint_error *error)
{
    void *stored = NULL;
    glint_status status = glint_renderer_read(r, "reading the directions", r->terms,
                                              glint_terms_bytes(&r->settings), &stored, error);
    if (status == GLINT_OK) {
        status = glint_terms_add_channels(stored, glint_renderer_pixel_count(r), r->settings.terms,
                                          layers, error);
    }
    free(stored);
    return status;
}

glint_status glint_renderer_layers(glint_renderer *renderer, glint_layers *layers,
                                   glint_error *error)
{
    *layers = (glint_layers){0};
    const glint_settings *settings = &renderer->settings;
    glint_status status = GLINT_OK;
    if (settings->aovs == 0 && settings->terms == 0) {
        return glint_fail(error, GLINT_USAGE, "no layers were asked for");
    }
    if (settings->aovs != 0) {
        status = read_layers(renderer, layers, error);
    }
    if (status == GLINT_OK && settings->terms > 0) {
        status = read_terms(renderer, layers, error);
    }
    if (status != GLINT_OK) {
        glint_layers_free(layers);
    }
    return status;
}
