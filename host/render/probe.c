// Calls single parts of the renderer on arrays. See probe.h.
#include "render/probe.h"

#include "base/memory.h"
#include "device/opencl_error.h"
#include "device/program.h"
#include "render/renderer.h"

#include <stdlib.h>
#include <string.h>

_Static_assert(sizeof(glint_probe_ray) == GLINT_PROBE_RAY * sizeof(double), "a ray has gaps");
_Static_assert(sizeof(glint_probe_hit) == GLINT_PROBE_HIT * sizeof(double), "a hit has gaps");
_Static_assert(sizeof(glint_probe_bounce) == GLINT_PROBE_BOUNCE * sizeof(double),
               "a bounce has gaps");

// Elements of one launch: a whole number of work-items at any width.
#define CHUNK_ELEMENTS ((size_t)65536)

static const struct {
    const char *kernel;
    size_t in, out; // numbers per element
} parts[GLINT_PROBE_PARTS] = {
    [GLINT_PROBE_TRACE] = {"probe_trace", GLINT_PROBE_RAY, GLINT_PROBE_HIT},
    [GLINT_PROBE_BOUNCE_RAYS] = {"probe_bounce", GLINT_PROBE_RAY, GLINT_PROBE_BOUNCE},
    [GLINT_PROBE_FRESNEL] = {"probe_fresnel", GLINT_PROBE_VALUES, GLINT_PROBE_VALUES},
    [GLINT_PROBE_DIRECTIONS] = {"probe_directions", GLINT_PROBE_VALUES, GLINT_PROBE_VALUES},
    [GLINT_PROBE_METAL] = {"probe_metal", GLINT_PROBE_VALUES, GLINT_PROBE_VALUES},
    [GLINT_PROBE_NORMALIZED] = {"probe_normalized", GLINT_PROBE_VALUES, GLINT_PROBE_VALUES},
    [GLINT_PROBE_ENVIRONMENT] = {"probe_environment", GLINT_PROBE_VALUES, GLINT_PROBE_VALUES},
    [GLINT_PROBE_FACE] = {"probe_face", GLINT_PROBE_VALUES, GLINT_PROBE_VALUES},
    [GLINT_PROBE_PRIMARY] = {"probe_primary", GLINT_PROBE_VALUES, GLINT_PROBE_VALUES},
    [GLINT_PROBE_PRIMARY_ORIGIN] = {"probe_primary_origin", GLINT_PROBE_VALUES, GLINT_PROBE_VALUES},
    [GLINT_PROBE_TILE_PLACE] = {"probe_tile_place", GLINT_PROBE_VALUES, GLINT_PROBE_VALUES},
    [GLINT_PROBE_LOOP] = {"probe_loop", GLINT_PROBE_VALUES, GLINT_PROBE_VALUES},
};

_Static_assert(CHUNK_ELEMENTS % (16 * 16) == 0, "a chunk is no whole number of work-items");

struct glint_probe {
    glint_renderer *renderer; // the scene on the device
    cl_program program;
    glint_kernel_kind kind;
    cl_kernel kernels[GLINT_PROBE_PARTS]; // kernels called so far
    cl_mem in, out;                       // room for a chunk of the largest elements
    void *staging;                        // the same on the host
};

static bool is_double(const glint_probe *probe)
{
    return probe->renderer->plan.precision == GLINT_PRECISION_DOUBLE;
}

static size_t scalar_size(const glint_probe *probe)
{
    return is_double(probe) ? sizeof(double) : sizeof(float);
}

static glint_status create_buffers(glint_probe *probe, glint_error *error)
{
    const size_t bytes = CHUNK_ELEMENTS * GLINT_PROBE_BOUNCE * scalar_size(probe);
    const glint_content content = {"a self-test", bytes, NULL};
    probe->staging = malloc(bytes);
    if (probe->staging == NULL) {
        return glint_fail_memory(error, content.what);
    }
    const glint_device *device = probe->renderer->device;
    TRY(glint_buffer_create(device, &content, &probe->in, error));
    return glint_buffer_create(device, &content, &probe->out, error);
}

static glint_status fill(const glint_renderer_inputs *inputs, glint_probe *probe,
                         glint_error *error)
{
    glint_settings settings = *inputs->settings;
    // Test kernels for every depth, not those with a proved depth.
    if (settings.depth == 0) {
        settings.depth = GLINT_DEPTH_MAX;
    }
    glint_renderer_inputs without_frames = *inputs;
    without_frames.settings = &settings;
    without_frames.without_frames = true;
    TRY(glint_renderer_create(&without_frames, &probe->renderer, error));
    char options[GLINT_BUILD_OPTIONS_BYTES];
    const glint_plan *plan = &probe->renderer->plan;
    probe->kind = settings.kernels == GLINT_KERNELS_GENERAL ? glint_general_kernel_of(plan)
                                                            : GLINT_KERNEL_SPECIAL;
    glint_kernel_options(plan, probe->kind, options);
    const glint_program_request request = {inputs->kernel_dir, options, true};
    TRY(glint_program_build(probe->renderer->device, &request, &probe->program, error));
    return create_buffers(probe, error);
}

glint_status glint_probe_create(const glint_renderer_inputs *inputs, glint_probe **probe,
                                glint_error *error)
{
    *probe = NULL;
    glint_probe *made = calloc(1, sizeof *made);
    if (made == NULL) {
        return glint_fail_memory(error, "a self-test");
    }
    glint_status status = fill(inputs, made, error);
    if (status != GLINT_OK) {
        glint_probe_free(made);
        return status;
    }
    *probe = made;
    return GLINT_OK;
}

void glint_probe_free(glint_probe *probe)
{
    if (probe == NULL) {
        return;
    }
    for (int i = 0; i < GLINT_PROBE_PARTS; i++) {
        if (probe->kernels[i] != NULL) {
            clReleaseKernel(probe->kernels[i]);
        }
    }
    if (probe->program != NULL) {
        clReleaseProgram(probe->program);
    }
    glint_buffer_release(&probe->in);
    glint_buffer_release(&probe->out);
    glint_renderer_free(probe->renderer);
    free(probe->staging);
    free(probe);
}

const glint_plan *glint_probe_plan(const glint_probe *probe)
{
    return &probe->renderer->plan;
}

void glint_probe_view(const glint_probe *probe, const glint_camera *camera,
                      const glint_settings *settings, glint_frame_record *frame)
{
    const glint_renderer *r = probe->renderer;
    *frame = (glint_frame_record){0};
    if (camera != NULL) {
        glint_view_record(&r->scene.space, camera, settings, &r->plan, frame);
    } else {
        glint_view_set_plan(&r->plan, frame);
    }
    frame->environment_edge = r->light.chosen.environment_edge;
    frame->irradiance_edge = r->light.chosen.irradiance_edge;
}

// Elements per work-item: PATH_GROUPS packets, see kernels/traverse_together.cl.
static size_t elements_per_item(const glint_probe *probe)
{
    const glint_plan *plan = &probe->renderer->plan;
    const bool follows = glint_kernel_has(plan, probe->kind, GLINT_FEATURE_INTERREFLECTION) ||
                         glint_kernel_has(plan, probe->kind, GLINT_FEATURE_SPLIT);
    const size_t side = follows ? GLINT_TILE_SIDE(plan->tiles) : 1;
    return side * side * (size_t)plan->kernel_width;
}

static glint_status set_arguments(const glint_probe *probe, cl_kernel kernel,
                                  const glint_frame_record *frame, glint_error *error)
{
    const glint_scene_arguments scene = glint_renderer_scene_arguments(probe->renderer);
#define OF_SCENE(type, name) {sizeof(cl_mem), &scene.name},
#define OF_PROBE(type, name) {sizeof(cl_mem), &probe->name},
    const glint_argument arguments[] = {GLINT_SCENE_ARGUMENTS(OF_SCENE)
                                            GLINT_PROBE_ARGUMENTS(OF_PROBE){sizeof *frame, frame}};
#undef OF_SCENE
#undef OF_PROBE
    return glint_arguments_set(probe->renderer->device, kernel, arguments,
                               sizeof arguments / sizeof *arguments, error);
}

static void narrow(const double *from, void *to, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        ((float *)to)[i] = (float)from[i];
    }
}

static void widen(const void *from, double *to, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        to[i] = (double)((const float *)from)[i];
    }
}

// Writes `count` elements, at most CHUNK_ELEMENTS, to the device. Fills with 0 up to a whole number
// of work-items.
static cl_int write_elements(const glint_probe *probe, glint_probe_part part, const double *in,
                             size_t count, size_t padded)
{
    const size_t scalar = scalar_size(probe), values = count * parts[part].in;
    const size_t bytes = padded * parts[part].in * scalar;
    memset(probe->staging, 0, bytes);
    if (is_double(probe)) {
        memcpy(probe->staging, in, values * scalar);
    } else {
        narrow(in, probe->staging, values);
    }
    return glint_buffer_write(probe->renderer->device, probe->in, bytes, probe->staging);
}

static cl_int read_elements(const glint_probe *probe, glint_probe_part part, double *out,
                            size_t count)
{
    const size_t values = count * parts[part].out;
    const cl_int code =
        glint_buffer_read(probe->renderer->device, probe->out, values * scalar_size(probe),
                          is_double(probe) ? (void *)out : probe->staging);
    if (code == CL_SUCCESS && !is_double(probe)) {
        widen(probe->staging, out, values);
    }
    return code;
}

// Calls the part for one chunk of the elements of `work`, from `first` on.
static cl_int call_chunk(const glint_probe *probe, const glint_probe_work *work, size_t first)
{
    const glint_renderer *r = probe->renderer;
    const glint_probe_part part = work->part;
    const size_t left = work->count - first, count = left < CHUNK_ELEMENTS ? left : CHUNK_ELEMENTS;
    const size_t per_item = elements_per_item(probe), local = 1;
    const size_t items = (count + per_item - 1) / per_item;
    const double *in = work->in + first * parts[part].in;
    cl_int code = write_elements(probe, part, in, count, items * per_item);
    if (code == CL_SUCCESS) {
        code = clEnqueueNDRangeKernel(r->device->queue, probe->kernels[part], 1, NULL, &items,
                                      &local, 0, NULL, NULL);
    }
    return code == CL_SUCCESS
               ? read_elements(probe, part, work->out + first * parts[part].out, count)
               : code;
}

glint_status glint_probe_call(glint_probe *probe, const glint_probe_work *work, glint_error *error)
{
    const glint_device *device = probe->renderer->device;
    glint_frame_record no_view;
    glint_probe_view(probe, NULL, NULL, &no_view);
    cl_kernel *kernel = &probe->kernels[work->part];
    if (*kernel == NULL) {
        TRY(glint_program_kernel(device, probe->program, parts[work->part].kernel, kernel, error));
    }
    TRY(set_arguments(probe, *kernel, work->frame != NULL ? work->frame : &no_view, error));
    for (size_t first = 0; first < work->count; first += CHUNK_ELEMENTS) {
        const cl_int code = call_chunk(probe, work, first);
        TRY(glint_check_opencl(error, device, "running a self-test's kernel", code));
    }
    return GLINT_OK;
}
