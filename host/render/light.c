// Uploads the environment and its irradiance. See light.h.
#include "render/light.h"

#include "base/clock.h"
#include "base/memory.h"
#include "environment/cached_irradiance.h"
#include "environment/cells.h"
#include "environment/harmonics.h"
#include "environment/irradiance.h"
#include "environment/lobe_albedo.h"
#include "kernels/layout.h"
#include "render/upload.h"

#include <stdlib.h>

void glint_light_set_environment(glint_light *light, const glint_environment *environment)
{
    const glint_light before = *light;
    glint_light_free(light);
    light->device = before.device;
    light->environment = environment;
    light->proxy = environment->proxy;
    light->irradiance_ms = before.irradiance_ms;
    light->cells_ms = before.cells_ms;
}

bool glint_light_may_be_half(const glint_settings *settings)
{
    return settings->texels == GLINT_TEXELS_HALF ||
           (settings->texels == GLINT_TEXELS_AUTO && settings->precision != GLINT_PRECISION_DOUBLE);
}

glint_status glint_light_measure_half(glint_light *light, const glint_settings *settings,
                                      glint_error *error)
{
    if (light->half_is_known || !glint_light_may_be_half(settings)) {
        return GLINT_OK;
    }
    TRY(glint_half_rounding_measure(&light->environment->radiance, &light->half, error));
    light->half_is_known = true;
    return GLINT_OK;
}

static glint_irradiance_kind kind_of(const glint_plan *plan, bool without_frames)
{
    const glint_feature_choice *features = plan->features;
    if (features[GLINT_FEATURE_IRRADIANCE_HARMONICS].compiled) {
        return GLINT_IRRADIANCE_BY_HARMONICS;
    }
    const bool lights =
        features[GLINT_FEATURE_PAINT].compiled || features[GLINT_FEATURE_BLEND].compiled;
    return lights && !without_frames ? GLINT_IRRADIANCE_BY_MAP : GLINT_IRRADIANCE_NOT_NEEDED;
}

static glint_status upload_irradiance(glint_light *light, const float *values, size_t count,
                                      cl_mem *buffer, glint_error *error)
{
    double clock = glint_now_ms();
    const glint_content content = {"the irradiance", count * sizeof *values, values};
    TRY(glint_buffer_create(light->device, &content, buffer, error));
    light->upload_ms += glint_lap_ms(&clock);
    return GLINT_OK;
}

static glint_status make_harmonics(glint_light *light, cl_mem *buffer, glint_error *error)
{
    float harmonics[GLINT_HARMONICS][4];
    double clock = glint_now_ms();
    TRY(glint_irradiance_harmonics(&light->environment->radiance, harmonics, error));
    light->irradiance_ms += glint_lap_ms(&clock);
    return upload_irradiance(light, &harmonics[0][0], sizeof harmonics / sizeof(float), buffer,
                             error);
}

static glint_status make_map(glint_light *light, cl_mem *buffer, glint_error *error)
{
    glint_cube map = {0};
    double clock = glint_now_ms();
    TRY(glint_irradiance_map_cached(&light->environment->radiance, GLINT_IRRADIANCE_EDGE, &map,
                                    error));
    light->irradiance_ms += glint_lap_ms(&clock);
    const glint_status status =
        upload_irradiance(light, map.texels, glint_cube_size(&map), buffer, error);
    glint_cube_free(&map);
    return status;
}

// Makes albedos (also of sheen if `sheen`), followed by cells down to level `last`; −1: an empty
// buffer.
static glint_status make_lobes(glint_light *light, int last, bool sheen, glint_error *error)
{
    const size_t cells = last >= 0 ? GLINT_CELLS_FIRST(last + 1) : 0;
    const glint_content content = {
        "the cells of the environment",
        last >= 0 ? (GLINT_LOBES_CELLS + cells * GLINT_CELL_VALUES) * sizeof(float) : 0, NULL};
    // A device that shares the host's memory reads the values in place.
    float *values = glint_allocate_unset(content.bytes + 1, 1);
    if (values == NULL) {
        return glint_fail_memory(error, content.what);
    }
    double clock = glint_now_ms();
    if (last >= 0) {
        glint_lobe_albedo_fill(values);
        glint_sheen_albedo_fill(sheen, values + GLINT_ALBEDO_VALUES);
        values[GLINT_LOBES_BRIGHTNESS] = glint_cells_fill(
            &light->environment->radiance, GLINT_CELLS_ROOT << last, values + GLINT_LOBES_CELLS);
    }
    light->cells_ms += glint_lap_ms(&clock);
    glint_shared_buffer_free(&light->lobes);
    light->cells_last = last;
    light->knows_sheen = sheen;
    void *data = values;
    const glint_status status =
        glint_buffer_hand_over(light->device, &content, &data, &light->lobes, error);
    light->upload_ms += glint_lap_ms(&clock);
    free(data);
    return status;
}

static glint_status make_irradiance(glint_light *light, glint_irradiance_kind kind, cl_mem *buffer,
                                    glint_error *error)
{
    switch (kind) {
    case GLINT_IRRADIANCE_BY_HARMONICS:
        return make_harmonics(light, buffer, error);
    case GLINT_IRRADIANCE_BY_MAP:
        return make_map(light, buffer, error);
    default:
        return upload_irradiance(light, NULL, 0, buffer, error);
    }
}

glint_status glint_light_choose(glint_light *light, const glint_plan *plan, bool without_frames,
                                glint_error *error)
{
    const glint_irradiance_kind kind = kind_of(plan, without_frames);
    const glint_cube *radiance = &light->environment->radiance;
    glint_shared_buffer *texels = &light->texels[plan->half_texels];
    cl_mem *irradiance = &light->irradiances[kind];
    if (texels->buffer == NULL) {
        double clock = glint_now_ms();
        TRY(glint_environment_upload(light->device, plan, radiance, texels, error));
        light->upload_ms += glint_lap_ms(&clock);
    }
    if (*irradiance == NULL) {
        TRY(make_irradiance(light, kind, irradiance, error));
    }
    const int last = plan->features[GLINT_FEATURE_ROUGH].compiled ? plan->cells_last : -1;
    const bool sheen = plan->features[GLINT_FEATURE_SHEEN].compiled;
    if (light->lobes.buffer == NULL || light->cells_last < last || (sheen && !light->knows_sheen)) {
        TRY(make_lobes(light, last, sheen, error));
    }
    light->chosen = (glint_chosen_light){
        .lobes = light->lobes.buffer,
        .environment = texels->buffer,
        .irradiance = *irradiance,
        .environment_edge = radiance->edge,
        .irradiance_edge = kind == GLINT_IRRADIANCE_BY_MAP ? GLINT_IRRADIANCE_EDGE : 0,
    };
    return GLINT_OK;
}

size_t glint_light_bytes(const glint_light *light)
{
    size_t bytes = 0;
    for (int i = 0; i < 2; i++) {
        bytes += glint_buffer_bytes(light->texels[i].buffer);
    }
    for (int i = 0; i < GLINT_IRRADIANCE_KINDS; i++) {
        bytes += glint_buffer_bytes(light->irradiances[i]);
    }
    return bytes + glint_buffer_bytes(light->lobes.buffer);
}

void glint_light_free(glint_light *light)
{
    for (int i = 0; i < 2; i++) {
        glint_shared_buffer_free(&light->texels[i]);
    }
    for (int i = 0; i < GLINT_IRRADIANCE_KINDS; i++) {
        glint_buffer_release(&light->irradiances[i]);
    }
    glint_shared_buffer_free(&light->lobes);
    *light = (glint_light){0};
}
