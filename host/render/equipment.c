// What a renderer's plan is put to work with. See equipment.h.
#include "render/equipment.h"

#include "base/clock.h"
#include "device/opencl_error.h"
#include "device/program.h"
#include "environment/harmonics.h"
#include "environment/irradiance.h"
#include "kernels/layout.h"
#include "render/renderer.h"
#include "render/terms.h"
#include "render/vertices.h"

#include <stdlib.h>
#include <string.h>

// ---- Light -------------------------------------------------------------------------------------

static glint_irradiance_kind irradiance_kind(const glint_renderer *r)
{
    const glint_feature_choice *features = r->plan.features;
    const bool needed =
        features[GLINT_FEATURE_PAINT].compiled || features[GLINT_FEATURE_BLEND].compiled;
    return features[GLINT_FEATURE_IRRADIANCE_HARMONICS].compiled ? GLINT_IRRADIANCE_BY_HARMONICS
           : needed && !r->inputs.without_frames                 ? GLINT_IRRADIANCE_BY_MAP
                                                                 : GLINT_IRRADIANCE_NOT_NEEDED;
}

static glint_status upload_irradiance(const glint_renderer *r, const float *values, size_t count,
                                      cl_mem *buffer, glint_error *error)
{
    return glint_buffer_create(r->device, "the irradiance", count * sizeof *values, values, buffer,
                               error);
}

static glint_status make_irradiance(glint_renderer *r, glint_irradiance_kind kind, cl_mem *buffer,
                                    glint_error *error)
{
    const glint_cube *radiance = &r->inputs.environment->radiance;
    double clock = glint_now_ms();
    glint_status status = GLINT_OK;
    if (kind == GLINT_IRRADIANCE_BY_HARMONICS) {
        float harmonics[GLINT_HARMONICS][4];
        status = glint_irradiance_harmonics(radiance, harmonics, error);
        r->phases.irradiance += glint_lap_ms(&clock);
        if (status == GLINT_OK) {
            status = upload_irradiance(r, &harmonics[0][0], sizeof harmonics / sizeof(float),
                                       buffer, error);
        }
    } else if (kind == GLINT_IRRADIANCE_BY_MAP) {
        glint_cube map = {0};
        status = glint_irradiance_map(radiance, GLINT_IRRADIANCE_EDGE, &map, error);
        r->phases.irradiance += glint_lap_ms(&clock);
        if (status == GLINT_OK) {
            status = upload_irradiance(r, map.texels, glint_cube_size(&map), buffer, error);
        }
        glint_cube_free(&map);
    } else {
        status = upload_irradiance(r, NULL, 0, buffer, error);
    }
    r->phases.upload += glint_lap_ms(&clock);
    return status;
}

static glint_status equip_light(glint_renderer *r, glint_error *error)
{
    glint_equipment *e = &r->equipment;
    const glint_irradiance_kind kind = irradiance_kind(r);
    glint_environment_memory *environment = &e->environments[r->plan.half_texels];
    cl_mem *irradiance = &e->irradiances[kind];
    glint_status status = GLINT_OK;
    if (environment->texels == NULL) {
        double clock = glint_now_ms();
        status = glint_environment_upload(r->device, &r->plan, &r->inputs.environment->radiance,
                                          environment, error);
        r->phases.upload += glint_lap_ms(&clock);
    }
    if (status == GLINT_OK && *irradiance == NULL) {
        status = make_irradiance(r, kind, irradiance, error);
    }
    r->light = (glint_light){environment->texels, *irradiance};
    r->environment_edge = r->inputs.environment->radiance.edge;
    r->irradiance_edge = kind == GLINT_IRRADIANCE_BY_MAP ? GLINT_IRRADIANCE_EDGE : 0;
    return status;
}

void glint_equipment_darken(glint_equipment *e)
{
    for (int i = 0; i < 2; i++) {
        glint_environment_memory_free(&e->environments[i]);
    }
    for (int i = 0; i < GLINT_IRRADIANCE_KINDS; i++) {
        glint_buffer_release(e->irradiances[i]);
        e->irradiances[i] = NULL;
    }
}

size_t glint_equipment_light_bytes(const glint_equipment *e)
{
    size_t bytes = 0;
    for (int i = 0; i < 2; i++) {
        bytes += glint_buffer_bytes(e->environments[i].texels);
    }
    for (int i = 0; i < GLINT_IRRADIANCE_KINDS; i++) {
        bytes += glint_buffer_bytes(e->irradiances[i]);
    }
    return bytes;
}

// ---- Outputs -----------------------------------------------------------------------------------

static size_t pixel_count(const glint_settings *settings)
{
    int size[2];
    glint_settings_pixels(settings, size);
    return (size_t)size[0] * (size_t)size[1];
}

size_t glint_layers_bytes(const glint_settings *settings)
{
    return settings->aovs != 0 ? pixel_count(settings) * sizeof(glint_layers_record) : 0;
}

size_t glint_terms_bytes(const glint_settings *settings)
{
    const size_t places = settings->terms > 0 ? (size_t)settings->terms + 1 : 0;
    return pixel_count(settings) * places * GLINT_TERM_VALUES * sizeof(float);
}

size_t glint_doubts_bytes(const glint_settings *settings)
{
    return settings->mend > 0 ? pixel_count(settings) * sizeof(float) : 0;
}

// Keeps a buffer that is large enough.
static glint_status resize(const glint_renderer *r, const char *what, size_t bytes, cl_mem *buffer,
                           glint_error *error)
{
    if (*buffer != NULL && glint_buffer_bytes(*buffer) >= bytes) {
        return GLINT_OK;
    }
    glint_buffer_release(*buffer);
    *buffer = NULL;
    return glint_buffer_create(r->device, what, bytes, NULL, buffer, error);
}

// Without a list it is a stand-in.
static glint_status upload_list(glint_renderer *r, glint_error *error)
{
    const size_t count = r->settings.list != NULL ? glint_renderer_pixel_count(r) : 1;
    const size_t bytes = count * sizeof *r->settings.list;
    glint_status status = resize(r, "the list of pixels", bytes, &r->list, error);
    if (status != GLINT_OK || r->settings.list == NULL) {
        return status;
    }
    const cl_int code = clEnqueueWriteBuffer(r->device->queue, r->list, CL_TRUE, 0, bytes,
                                             r->settings.list, 0, NULL, NULL);
    return code == CL_SUCCESS
               ? GLINT_OK
               : glint_fail_opencl(error, r->device, "writing the list of pixels", code);
}

static glint_status equip_outputs(glint_renderer *r, glint_error *error)
{
    const size_t counters = GLINT_COUNTER_SLOTS * GLINT_COUNTERS * 2 * sizeof(cl_uint);
    double clock = glint_now_ms();
    int size[2];
    glint_settings_pixels(&r->settings, size);
    glint_status status = glint_pixels_resize(r->device, size[0], size[1],
                                              glint_plan_scalar_bytes(&r->plan), &r->pixels, error);
    if (status == GLINT_OK) {
        status = resize(r, "the counters", counters, &r->counters, error);
    }
    if (status == GLINT_OK) {
        status = resize(r, "the layers", glint_layers_bytes(&r->settings), &r->layers, error);
    }
    if (status == GLINT_OK) {
        status = resize(r, "the directions", glint_terms_bytes(&r->settings), &r->terms, error);
    }
    if (status == GLINT_OK) {
        status = resize(r, "the doubts", glint_doubts_bytes(&r->settings), &r->doubts, error);
    }
    if (status == GLINT_OK) {
        status = upload_list(r, error);
    }
    r->phases.upload += glint_lap_ms(&clock);
    return status;
}

// ---- Kernels -----------------------------------------------------------------------------------

glint_status glint_renderer_set_argument(const glint_renderer *r, cl_uint index, size_t size,
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
                              r->layers,
                              r->terms,
                              r->doubts,
                              r->vertices,
                              r->list};
    glint_status status = GLINT_OK;
    for (cl_uint i = 0; status == GLINT_OK && i < sizeof buffers / sizeof *buffers; i++) {
        status = glint_renderer_set_argument(r, i, sizeof buffers[i], &buffers[i], error);
    }
    return status;
}

static void release(glint_kernels *k)
{
    cl_kernel *const kernels[] = {&k->render, &k->vertices};
    for (int i = 0; i < 2; i++) {
        if (*kernels[i] != NULL) {
            clReleaseKernel(*kernels[i]);
        }
    }
    free(k->options);
    *k = (glint_kernels){0};
}

static void use(glint_renderer *r, const glint_kernels *k)
{
    r->kernel = k->render;
    r->vertex_kernel = k->vertices;
}

// Compiles, and launches once over an image without pixels: drivers put off a part of the
// compilation to the first launch.
static glint_status build(glint_renderer *r, const char *options, glint_kernels *k,
                          glint_error *error)
{
    const glint_program_request request = {.kernel_dir = r->inputs.kernel_dir, .options = options};
    cl_program program;
    glint_status status = glint_program_build(r->device, &request, &program, error);
    if (status == GLINT_OK) {
        status = glint_program_kernel(r->device, program, "render_tiles", &k->render, error);
        if (status == GLINT_OK && glint_plan_shades_vertices(&r->plan)) {
            status =
                glint_program_kernel(r->device, program, "shade_vertices", &k->vertices, error);
        }
        clReleaseProgram(program);
    }
    use(r, k);
    if (status == GLINT_OK) {
        status = glint_vertices_warm_up(r, error);
    }
    if (status == GLINT_OK) {
        status = set_buffers(r, error);
    }
    if (status == GLINT_OK) {
        // No pixel is written, so that a device that writes into images needs none yet.
        glint_frame_record nothing = {.band = 1};
        cl_event done;
        status = glint_renderer_launch(r, &nothing, 0, 1, &done, error);
        status = status == GLINT_OK ? glint_renderer_wait(r, done, error) : status;
    }
    return status;
}

// Of these options; NULL: none.
static glint_kernels *find(glint_equipment *e, const char *options)
{
    for (size_t i = 0; i < GLINT_KERNELS_KEPT; i++) {
        glint_kernels *k = &e->kernels[i];
        if (k->options != NULL && strcmp(k->options, options) == 0) {
            return k;
        }
    }
    return NULL;
}

// Those that have not been used for the longest time.
static glint_kernels *find_oldest(glint_equipment *e)
{
    glint_kernels *oldest = &e->kernels[0];
    for (size_t i = 1; i < GLINT_KERNELS_KEPT; i++) {
        oldest = e->kernels[i].last_use < oldest->last_use ? &e->kernels[i] : oldest;
    }
    return oldest;
}

static glint_status equip_kernels(glint_renderer *r, glint_error *error)
{
    glint_equipment *e = &r->equipment;
    char options[4096];
    glint_plan_build_options(&r->plan, options, sizeof options);
    glint_kernels *k = find(e, options);
    if (k != NULL) {
        k->last_use = ++e->uses;
        use(r, k);
        return set_buffers(r, error);
    }
    double clock = glint_now_ms();
    k = find_oldest(e);
    release(k);
    k->options = strdup(options);
    k->last_use = ++e->uses;
    glint_status status = k->options != NULL ? build(r, options, k, error)
                                             : glint_fail_memory(error, "a kernel's options");
    if (status != GLINT_OK) {
        release(k);
    }
    r->phases.kernel_build += glint_lap_ms(&clock);
    return status;
}

glint_status glint_equip(glint_renderer *r, glint_error *error)
{
    r->kernel = r->vertex_kernel = NULL;
    glint_status status = equip_light(r, error);
    if (status == GLINT_OK) {
        status = equip_outputs(r, error);
    }
    if (status == GLINT_OK && !r->inputs.without_frames) {
        status = equip_kernels(r, error);
    }
    if (status != GLINT_OK) {
        r->kernel = r->vertex_kernel = NULL;
    }
    return status;
}

void glint_equipment_free(glint_equipment *e)
{
    for (size_t i = 0; i < GLINT_KERNELS_KEPT; i++) {
        release(&e->kernels[i]);
    }
    glint_equipment_darken(e);
}
