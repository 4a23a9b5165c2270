// Single parts of the renderer on arrays. See probe.h.
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

#define CHUNK_ELEMENTS ((size_t)65536) // of one launch; a whole number of work-items at any width

static const struct {
    const char *kernel;
    size_t in, out; // numbers of an element
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
};

_Static_assert(CHUNK_ELEMENTS % (16 * 16) == 0, "a chunk is no whole number of work-items");

struct glint_probe {
    glint_renderer *renderer; // the scene on the device
    cl_program program;
    cl_kernel kernels[GLINT_PROBE_PARTS]; // those called so far
    cl_mem in, out;                       // of a chunk of the largest elements
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

static glint_status fill(const glint_renderer_inputs *inputs, glint_probe *probe,
                         glint_error *error)
{
    glint_settings settings = *inputs->settings;
    if (settings.depth == 0) { // the parts are those of the general kernels, whatever is proved
        settings.depth = GLINT_DEPTH_MAX;
    }
    glint_renderer_inputs without_frames = *inputs;
    without_frames.settings = &settings;
    without_frames.without_frames = true;
    glint_status status = glint_renderer_create(&without_frames, &probe->renderer, error);
    if (status != GLINT_OK) {
        return status;
    }
    const glint_renderer *r = probe->renderer;
    char options[4096];
    glint_plan_build_options(&r->plan, options, sizeof options);
    const glint_program_request request = {inputs->kernel_dir, options, true};
    const size_t bytes = CHUNK_ELEMENTS * GLINT_PROBE_BOUNCE * scalar_size(probe);
    probe->staging = malloc(bytes);
    status = probe->staging != NULL ? GLINT_OK : glint_fail_memory(error, "a self-test");
    if (status == GLINT_OK) {
        status = glint_program_build(r->device, &request, &probe->program, error);
    }
    if (status == GLINT_OK) {
        status = glint_buffer_create(r->device, "a self-test", bytes, NULL, &probe->in, error);
    }
    if (status == GLINT_OK) {
        status = glint_buffer_create(r->device, "a self-test", bytes, NULL, &probe->out, error);
    }
    return status;
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
    glint_buffer_release(probe->in);
    glint_buffer_release(probe->out);
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
        glint_view_record(&r->space, camera, settings, &r->plan, frame);
    }
    frame->environment_edge = r->environment_edge;
    frame->irradiance_edge = r->irradiance_edge;
}

// Elements that one work-item takes: PATH_GROUPS packets, see kernels/traverse_together.cl.
static size_t elements_per_item(const glint_plan *plan)
{
    const bool follows = plan->features[GLINT_FEATURE_INTERREFLECTION].compiled ||
                         plan->features[GLINT_FEATURE_SPLIT].compiled;
    const size_t side = follows ? GLINT_TILE_SIDE(plan->tiles) : 1;
    return side * side * (size_t)plan->kernel_width;
}

static glint_status set_arguments(const glint_probe *probe, cl_kernel kernel,
                                  const glint_frame_record *frame, glint_error *error)
{
    const glint_renderer *r = probe->renderer;
    const glint_geometry_memory *g = &r->geometry;
    const cl_mem buffers[] = {g->nodes,     g->clusters, g->normals,           g->numbers,
                              g->materials, g->media,    r->light.environment, r->light.irradiance,
                              probe->in,    probe->out};
    const cl_uint count = sizeof buffers / sizeof *buffers;
    cl_int code = CL_SUCCESS;
    for (cl_uint i = 0; code == CL_SUCCESS && i < count; i++) {
        code = clSetKernelArg(kernel, i, sizeof buffers[i], &buffers[i]);
    }
    if (code == CL_SUCCESS) {
        code = clSetKernelArg(kernel, count, sizeof *frame, frame);
    }
    return code == CL_SUCCESS
               ? GLINT_OK
               : glint_fail_opencl(error, r->device, "setting a kernel's argument", code);
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

// At most CHUNK_ELEMENTS; elements after the last, up to a whole number of work-items, are 0.
static glint_status call_chunk(glint_probe *probe, glint_probe_part part, const double *in,
                               double *out, size_t count, glint_error *error)
{
    const glint_renderer *r = probe->renderer;
    const size_t scalar = scalar_size(probe), per_item = elements_per_item(&r->plan);
    const size_t items = (count + per_item - 1) / per_item, global = items, local = 1;
    const size_t values_in = count * parts[part].in, values_out = count * parts[part].out;
    memset(probe->staging, 0, items * per_item * parts[part].in * scalar);
    if (is_double(probe)) {
        memcpy(probe->staging, in, values_in * scalar);
    } else {
        narrow(in, probe->staging, values_in);
    }
    cl_command_queue queue = r->device->queue;
    cl_int code = clEnqueueWriteBuffer(queue, probe->in, CL_TRUE, 0,
                                       items * per_item * parts[part].in * scalar, probe->staging,
                                       0, NULL, NULL);
    if (code == CL_SUCCESS) {
        code = clEnqueueNDRangeKernel(queue, probe->kernels[part], 1, NULL, &global, &local, 0,
                                      NULL, NULL);
    }
    void *found = is_double(probe) ? out : probe->staging;
    if (code == CL_SUCCESS) {
        code = clEnqueueReadBuffer(queue, probe->out, CL_TRUE, 0, values_out * scalar, found, 0,
                                   NULL, NULL);
    }
    if (code != CL_SUCCESS) {
        return glint_fail_opencl(error, r->device, "running a self-test's kernel", code);
    }
    if (!is_double(probe)) {
        widen(probe->staging, out, values_out);
    }
    return GLINT_OK;
}

glint_status glint_probe_call(glint_probe *probe, glint_probe_part part,
                              const glint_frame_record *frame, const double *in, double *out,
                              size_t count, glint_error *error)
{
    glint_frame_record no_view;
    glint_probe_view(probe, NULL, NULL, &no_view);
    glint_status status = GLINT_OK;
    if (probe->kernels[part] == NULL) {
        status = glint_program_kernel(probe->renderer->device, probe->program, parts[part].kernel,
                                      &probe->kernels[part], error);
    }
    if (status == GLINT_OK) {
        status =
            set_arguments(probe, probe->kernels[part], frame != NULL ? frame : &no_view, error);
    }
    for (size_t first = 0; status == GLINT_OK && first < count; first += CHUNK_ELEMENTS) {
        const size_t left = count - first;
        status = call_chunk(probe, part, in + first * parts[part].in, out + first * parts[part].out,
                            left < CHUNK_ELEMENTS ? left : CHUNK_ELEMENTS, error);
    }
    return status;
}
