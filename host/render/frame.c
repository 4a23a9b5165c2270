// Rendering one frame. See frame.h.
#include "render/frame.h"

#include "base/clock.h"
#include "base/memory.h"
#include "device/program.h"
#include "environment/irradiance.h"
#include "kernels/layout.h"
#include "render/renderer.h"
#include "scene/topology.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Launches are made long enough to keep a device busy and short enough for progress and signals.
#define LAUNCH_MS 100.0
// The first frame's first one tells the speed.
#define FIRST_LAUNCH_SAMPLES 32768.0
// Rows of tiles that are rendered side by side: what neighbours have fetched from memory is then
// still in the caches. One where so many rows would be a long launch by themselves.
#define BAND_ROWS 4
#define BAND_SAMPLES 2e6

static size_t scalar_bytes(const glint_renderer *r)
{
    return r->plan.precision == GLINT_PRECISION_DOUBLE ? sizeof(double) : sizeof(float);
}

static size_t layers_bytes(const glint_renderer *r)
{
    return r->settings.aovs != 0 ? r->pixel_count * sizeof(glint_layers_record) : 0;
}

// ---- Creation ----------------------------------------------------------------------------------

static bool has_solids(const glint_scene *scene)
{
    for (size_t i = 0; i < scene->material_count; i++) {
        if (glint_material_is_solid(&scene->materials[i])) {
            return true;
        }
    }
    return false;
}

// The topology is found only where the plan asks for it: millions of triangles take seconds.
static glint_status analyse(const glint_renderer_inputs *in, glint_renderer *r,
                            const glint_plan *before, glint_error *error)
{
    glint_topology topology = {0};
    const bool wanted = has_solids(in->scene) && !in->scene->moves;
    glint_status status = wanted ? glint_topology_find(in->scene, &topology, error) : GLINT_OK;
    if (status == GLINT_OK) {
        const glint_plan_inputs inputs = {
            .scene = in->scene,
            .topology = &topology,
            .environment = &in->environment->radiance,
            .device = glint_device_capabilities(in->device),
            .settings = in->settings,
            .before = before,
        };
        status = glint_plan_make(&inputs, &r->plan, error);
    }
    glint_topology_free(&topology);
    return status;
}

static bool needs_irradiance(const glint_plan *plan)
{
    return plan->features[GLINT_FEATURE_PAINT].compiled ||
           plan->features[GLINT_FEATURE_BLEND].compiled;
}

static glint_status set_argument(const glint_renderer *r, cl_uint index, size_t size,
                                 const void *value, glint_error *error)
{
    cl_int code = clSetKernelArg(r->kernel, index, size, value);
    return code == CL_SUCCESS
               ? GLINT_OK
               : glint_fail_opencl(error, r->device, "setting a kernel's argument", code);
}

static glint_status set_buffers(const glint_renderer *r, glint_error *error)
{
    const cl_mem buffers[] = {r->geometry.nodes,
                              r->geometry.clusters,
                              r->geometry.normals,
                              r->geometry.numbers,
                              r->geometry.materials,
                              r->geometry.media,
                              r->light.environment,
                              r->light.irradiance,
                              r->pixels.own,
                              r->counters,
                              r->layers};
    glint_status status = GLINT_OK;
    for (cl_uint i = 0; status == GLINT_OK && i < sizeof buffers / sizeof *buffers; i++) {
        status = set_argument(r, i, sizeof buffers[i], &buffers[i], error);
    }
    return status;
}

#define PIXELS_ARGUMENT 8 // see set_buffers
#define FRAME_ARGUMENT 11

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

// Renders `bands` bands of tiles from `first` on, and waits for the end.
static glint_status launch(glint_renderer *r, glint_frame_record *record, size_t first,
                           size_t bands, glint_error *error)
{
    record->first_band = (int)first;
    glint_status status = set_argument(r, FRAME_ARGUMENT, sizeof *record, record, error);
    if (status != GLINT_OK) {
        return status;
    }
    int tile_width, tile_height;
    tile_size(&r->plan, &tile_width, &tile_height);
    size_t local[2];
    local_size(&r->plan, local);
    size_t columns = ((size_t)r->settings.width + (size_t)tile_width - 1) / (size_t)tile_width;
    const size_t across = columns * (size_t)record->band;
    const size_t global[2] = {round_up(across, local[0]), round_up(bands, local[1])};
    cl_int code =
        clEnqueueNDRangeKernel(r->device->queue, r->kernel, 2, NULL, global, local, 0, NULL, NULL);
    if (code == CL_SUCCESS) {
        code = clFinish(r->device->queue);
    }
    return code == CL_SUCCESS ? GLINT_OK
                              : glint_fail_opencl(error, r->device, "running the kernel", code);
}

// Compiles, and launches once over an image without pixels: drivers put off a part of the
// compilation to the first launch.
static glint_status build_kernel(const glint_renderer_inputs *in, glint_renderer *r,
                                 glint_error *error)
{
    char options[4096];
    glint_plan_build_options(&r->plan, options, sizeof options);
    const glint_program_request request = {.kernel_dir = in->kernel_dir, .options = options};
    cl_program program;
    glint_status status = glint_program_build(r->device, &request, &program, error);
    if (status == GLINT_OK) {
        status = glint_program_kernel(r->device, program, "render_tiles", &r->kernel, error);
        clReleaseProgram(program);
    }
    if (status == GLINT_OK) {
        status = set_buffers(r, error);
    }
    if (status == GLINT_OK) {
        // No pixel is written, so that a device that writes into images needs none yet.
        glint_frame_record nothing = {.band = 1};
        status = launch(r, &nothing, 0, 1, error);
    }
    return status;
}

static glint_status create_outputs(glint_renderer *r, glint_error *error)
{
    glint_status status = glint_pixels_create(r->device, r->settings.width, r->settings.height,
                                              scalar_bytes(r), &r->pixels, error);
    if (status == GLINT_OK) {
        const size_t counters = GLINT_COUNTER_SLOTS * GLINT_COUNTERS * 2 * sizeof(cl_uint);
        status =
            glint_buffer_create(r->device, "the counters", counters, NULL, &r->counters, error);
    }
    if (status == GLINT_OK) {
        status =
            glint_buffer_create(r->device, "the layers", layers_bytes(r), NULL, &r->layers, error);
    }
    return status;
}

// The smallest power of two that is no smaller than the tree needs, so that few sizes are compiled.
static int traversal_stack(int need)
{
    int size = 64;
    while (size < need) {
        size *= 2;
    }
    return size;
}

// Plan and tree of the scene, and whether the device can hold them.
static glint_status prepare(const glint_renderer_inputs *in, glint_renderer *r,
                            const glint_plan *before, glint_bvh *bvh, glint_error *error)
{
    double clock = glint_now_ms();
    glint_upload_sizes sizes = {0};
    glint_status status = analyse(in, r, before, error);
    if (status == GLINT_OK) {
        status = glint_pixels_size(r->settings.width, r->settings.height, scalar_bytes(r),
                                   &sizes.frame, error);
        r->pixel_count = sizes.frame / (4 * scalar_bytes(r));
        sizes.layers = layers_bytes(r);
        sizes.environment = r->plan.environment_bytes;
    }
    if (status == GLINT_OK) {
        status = glint_upload_check(in->device, in->scene, &sizes, error);
    }
    r->phases.analysis = glint_lap_ms(&clock);
    if (status == GLINT_OK) {
        status = glint_plan_build_tree(&r->plan, in->scene, bvh, error);
        r->bvh = bvh->report;
        r->plan.traversal_stack = traversal_stack(bvh->report.stack_need);
        r->phases.bvh = glint_lap_ms(&clock);
    }
    return status;
}

static glint_status upload_geometry(const glint_renderer_inputs *in, glint_renderer *r,
                                    glint_bvh *bvh, glint_error *error)
{
    const glint_upload_inputs inputs = {
        .device = in->device, .scene = in->scene, .bvh = bvh, .plan = &r->plan};
    double clock = glint_now_ms();
    glint_geometry_memory fresh;
    glint_status status = glint_geometry_upload(&inputs, &fresh, error);
    if (status == GLINT_OK) {
        r->geometry = fresh;
        r->space = glint_stored_space_of(in->scene);
    }
    r->phases.upload = glint_lap_ms(&clock);
    return status;
}

static glint_status upload_light(const glint_renderer_inputs *in, glint_renderer *r,
                                 glint_error *error)
{
    double clock = glint_now_ms();
    glint_cube irradiance = {0};
    glint_status status = GLINT_OK;
    if (needs_irradiance(&r->plan) && !in->without_frames) {
        status = glint_irradiance_map(&in->environment->radiance, GLINT_IRRADIANCE_EDGE,
                                      &irradiance, error);
        r->phases.irradiance = glint_lap_ms(&clock);
    }
    if (status == GLINT_OK) {
        const glint_upload_inputs inputs = {
            .device = in->device,
            .plan = &r->plan,
            .environment = &in->environment->radiance,
            .irradiance = &irradiance,
        };
        status = glint_light_upload(&inputs, &r->light, error);
        r->environment_edge = in->environment->radiance.edge;
        r->irradiance_edge = irradiance.edge;
        r->phases.upload += glint_lap_ms(&clock);
    }
    glint_cube_free(&irradiance);
    return status;
}

// All that a plan is put to work with.
static glint_status set_up(const glint_renderer_inputs *in, glint_renderer *r, glint_bvh *bvh,
                           glint_error *error)
{
    glint_status status = upload_geometry(in, r, bvh, error);
    if (status == GLINT_OK) {
        status = upload_light(in, r, error);
    }
    double clock = glint_now_ms();
    if (status == GLINT_OK) {
        status = create_outputs(r, error);
        r->phases.upload += glint_lap_ms(&clock);
    }
    if (status == GLINT_OK && !in->without_frames) {
        status = build_kernel(in, r, error);
        r->phases.kernel_build = glint_lap_ms(&clock);
    }
    return status;
}

static void tear_down(glint_renderer *r)
{
    glint_geometry_memory_free(&r->geometry);
    glint_light_memory_free(&r->light);
    glint_pixels_free(&r->pixels);
    glint_buffer_release(r->counters);
    glint_buffer_release(r->layers);
    r->counters = r->layers = NULL;
    if (r->kernel != NULL) {
        clReleaseKernel(r->kernel);
        r->kernel = NULL;
    }
}

glint_status glint_renderer_create(const glint_renderer_inputs *inputs, glint_renderer **renderer,
                                   glint_error *error)
{
    *renderer = NULL;
    glint_renderer *r = calloc(1, sizeof *r);
    if (r == NULL) {
        return glint_fail_memory(error, "the renderer");
    }
    r->device = inputs->device;
    r->settings = *inputs->settings;
    r->inputs = *inputs;
    r->inputs.settings = &r->settings;
    glint_bvh bvh = {0};
    glint_status status = prepare(inputs, r, NULL, &bvh, error);
    if (status == GLINT_OK) {
        status = set_up(inputs, r, &bvh, error);
    }
    glint_bvh_free(&bvh);
    if (status != GLINT_OK) {
        glint_renderer_free(r);
        return status;
    }
    *renderer = r;
    return GLINT_OK;
}

glint_status glint_renderer_set_scene(glint_renderer *r, const glint_scene *scene,
                                      glint_error *error)
{
    const glint_plan before = r->plan;
    char old_options[4096], options[4096];
    glint_plan_build_options(&before, old_options, sizeof old_options);
    glint_renderer_inputs in = r->inputs;
    in.scene = scene;
    glint_bvh bvh = {0};
    glint_geometry_memory_free(&r->geometry); // memory for one scene is enough
    r->has_failed = true;
    glint_status status = prepare(&in, r, &before, &bvh, error);
    if (status != GLINT_OK) {
        r->plan = before;
    } else {
        glint_plan_build_options(&r->plan, options, sizeof options);
        if (strcmp(options, old_options) == 0 && r->kernel != NULL) {
            status = upload_geometry(&in, r, &bvh, error);
            status = status == GLINT_OK ? set_buffers(r, error) : status;
        } else {
            // Other kernels, and what they read.
            tear_down(r);
            status = set_up(&in, r, &bvh, error);
        }
    }
    glint_bvh_free(&bvh);
    r->has_failed = status != GLINT_OK;
    return status;
}

const glint_plan *glint_renderer_plan(const glint_renderer *renderer)
{
    return &renderer->plan;
}

const glint_bvh_report *glint_renderer_bvh(const glint_renderer *renderer)
{
    return &renderer->bvh;
}

const glint_phases *glint_renderer_phases(const glint_renderer *renderer)
{
    return &renderer->phases;
}

glint_device_bytes glint_renderer_device_bytes(const glint_renderer *renderer)
{
    const glint_geometry_memory *geometry = &renderer->geometry;
    const glint_light_memory *light = &renderer->light;
    return (glint_device_bytes){
        .scene = glint_buffer_bytes(geometry->clusters) + glint_buffer_bytes(geometry->normals) +
                 glint_buffer_bytes(geometry->numbers) + glint_buffer_bytes(geometry->materials) +
                 glint_buffer_bytes(geometry->media),
        .tree = glint_buffer_bytes(geometry->nodes),
        .environment =
            glint_buffer_bytes(light->environment) + glint_buffer_bytes(light->irradiance),
        .frame = glint_pixels_bytes(&renderer->pixels) + layers_bytes(renderer),
    };
}

void glint_renderer_free(glint_renderer *renderer)
{
    if (renderer == NULL) {
        return;
    }
    tear_down(renderer);
    free(renderer);
}

// ---- A frame -----------------------------------------------------------------------------------

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
    report->rays.primary = (uint64_t)r->pixel_count * (uint64_t)(k * k);
    report->rays.reflected = total_of(counters, GLINT_COUNT_REFLECTED);
    report->rays.refracted_in = total_of(counters, GLINT_COUNT_REFRACTED_IN);
    report->rays.refracted_out = total_of(counters, GLINT_COUNT_REFRACTED_OUT);
    report->rays.transmitted = total_of(counters, GLINT_COUNT_TRANSMITTED);
    report->rays.total_reflections = total_of(counters, GLINT_COUNT_TOTAL_REFLECTIONS);
    report->deepest = (uint32_t)total_of(counters, GLINT_COUNT_DEEPEST);
    double all = ldexp((double)report->rays.primary, GLINT_WEIGHT_BITS);
    glint_truncation *t = &report->truncation;
    t->by_depth = (double)total_of(counters, GLINT_COUNT_WEIGHT_BY_DEPTH) / all;
    t->by_min_weight = (double)total_of(counters, GLINT_COUNT_WEIGHT_BY_MIN_WEIGHT) / all;
    t->by_stack = (double)total_of(counters, GLINT_COUNT_WEIGHT_BY_STACK) / all;
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

// Bands of tiles, in launches of about LAUNCH_MS; asks `progress` between them.
static glint_status run_launches(glint_renderer *r, glint_frame_record *record,
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
    size_t bands = ((size_t)record->height + (size_t)band_height - 1) / (size_t)band_height;
    double first_step = r->bands_per_ms > 0 ? r->bands_per_ms * LAUNCH_MS
                                            : FIRST_LAUNCH_SAMPLES / (row_samples * record->band);
    size_t step = round_up((size_t)fmax(1, first_step), local[1]);
    double begin = glint_now_ms();
    for (size_t first = 0; first < bands;) {
        size_t count = first + step < bands ? step : bands - first;
        double clock = glint_now_ms();
        glint_status status = launch(r, record, first, count, error);
        if (status != GLINT_OK) {
            return status;
        }
        first += count;
        step = next_step(step, glint_lap_ms(&clock), local[1]);
        if (progress != NULL && !progress->step(progress->context, first, bands)) {
            return glint_fail(error, GLINT_INTERRUPTED, "stopped");
        }
    }
    r->bands_per_ms = (double)bands / fmax(glint_now_ms() - begin, 1e-3);
    return GLINT_OK;
}

static uint64_t count_nonfinite(const glint_image *image)
{
    uint64_t count = 0;
    size_t pixels = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < pixels; i++) {
        const float *p = image->pixels + 4 * i;
        // The sum is not finite if any of the four is not (or if it overflows, which is as wrong).
        count += isfinite(p[0] + p[1] + p[2] + p[3]) ? 0 : 1;
    }
    return count;
}

glint_status glint_renderer_frame(glint_renderer *renderer, const glint_camera *camera,
                                  const glint_progress *progress, glint_image *image,
                                  glint_frame_report *report, glint_error *error)
{
    glint_renderer *r = renderer;
    glint_frame_report own_report = {0};
    report = report != NULL ? report : &own_report;
    *report = (glint_frame_report){0};
    if (r->kernel == NULL || r->has_failed) {
        glint_image_free(image);
        return glint_fail(error, GLINT_USAGE, "the renderer was made without frames, or failed");
    }
    glint_frame_record record;
    glint_view_record(&r->space, camera, &r->settings, &r->plan, &record);
    record.environment_edge = r->environment_edge;
    record.irradiance_edge = r->irradiance_edge;
    cl_mem target = NULL;
    glint_status status = glint_pixels_begin(&r->pixels, image, &target, error);
    if (status == GLINT_OK) {
        status = set_argument(r, PIXELS_ARGUMENT, sizeof target, &target, error);
    }
    double clock = glint_now_ms();
    if (status == GLINT_OK) {
        status = clear_counters(r, error);
    }
    if (status == GLINT_OK) {
        status = run_launches(r, &record, progress, error);
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
    report->nonfinite_pixels = count_nonfinite(image);
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
    *pixels = glint_allocate_unset(renderer->pixel_count * 4, sizeof **pixels);
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

glint_status glint_renderer_layers(glint_renderer *renderer, glint_layers *layers,
                                   glint_error *error)
{
    *layers = (glint_layers){0};
    const glint_settings *settings = &renderer->settings;
    if (settings->aovs == 0) {
        return glint_fail(error, GLINT_USAGE, "no layers were asked for");
    }
    glint_layers_record *records = malloc(layers_bytes(renderer));
    if (records == NULL) {
        return glint_fail_memory(error, "the layers");
    }
    cl_int code = clEnqueueReadBuffer(renderer->device->queue, renderer->layers, CL_TRUE, 0,
                                      layers_bytes(renderer), records, 0, NULL, NULL);
    glint_status status =
        code == CL_SUCCESS
            ? glint_layers_make(records, renderer->pixel_count,
                                settings->samples_per_axis * settings->samples_per_axis,
                                settings->aovs, layers, error)
            : glint_fail_opencl(error, renderer->device, "reading the layers", code);
    free(records);
    return status;
}
