// Uploads punctual lights to the device. See punctual.h.
#include "render/punctual.h"

#include "base/memory.h"
#include "kernels/layout.h"
#include "render/split.h"

#include <math.h>
#include <stdlib.h>

// The largest value: far beyond the range of a frame, and far below the largest float.
#define MOST 1e30

// The narrowest cone with a soft edge, as in KHR_lights_punctual.
#define LEAST_CONE 1e-3

static void set_cone(const glint_punctual_light *light, glint_light_record *record)
{
    const double inner = cos(light->inner_angle), outer = cos(light->outer_angle);
    glint_split_number(outer, &record->outer_cosine[0], &record->outer_cosine[1]);
    glint_split_number(1 / fmax(LEAST_CONE, inner - outer), &record->cone_scale[0],
                       &record->cone_scale[1]);
}

// Positions are rounded like vertices: a light in a plane along the axes stays in it.
static glint_light_record record_of(const glint_scene *scene, const glint_punctual_light *light)
{
    static const unsigned kinds[] = {
        [GLINT_PUNCTUAL_POINT] = GLINT_LIGHT_POINT,
        [GLINT_PUNCTUAL_SPOT] = GLINT_LIGHT_SPOT,
        [GLINT_PUNCTUAL_DIRECTIONAL] = GLINT_LIGHT_DIRECTIONAL,
    };
    glint_light_record record = {.kind = kinds[light->kind]};
    const double unit = scene->unit > 0 ? scene->unit : 1;
    const bool has_place = light->kind != GLINT_PUNCTUAL_DIRECTIONAL;
    const glint_vec3 place =
        glint_vec3_scale(glint_vec3_subtract(light->position, scene->origin), 1 / unit);
    const double places[3] = {place.x, place.y, place.z};
    const double axis[3] = {light->direction.x, light->direction.y, light->direction.z};
    for (int k = 0; k < 3; k++) {
        record.position[k] = has_place ? (float)places[k] : 0;
        glint_split_number(axis[k], &record.axis.high[k], &record.axis.low[k]);
        const double color = light->color[k] / GLINT_PI / (has_place ? unit * unit : 1);
        glint_split_number(fmin(color, MOST), &record.color.high[k], &record.color.low[k]);
    }
    const double reach = light->range / unit;
    glint_split_number(has_place ? fmin(1 / (reach * reach), MOST) : 0, &record.inverse_range[0],
                       &record.inverse_range[1]);
    if (light->kind == GLINT_PUNCTUAL_SPOT) {
        set_cone(light, &record);
    }
    return record;
}

glint_status glint_lights_upload(const struct glint_device *device, const glint_scene *scene,
                                 cl_mem *lights, glint_error *error)
{
    const size_t count = scene->light_count;
    glint_light_record *records = glint_allocate(count + 1, sizeof *records);
    if (records == NULL) {
        return glint_fail_memory(error, "the lights");
    }
    for (size_t i = 0; i < count; i++) {
        records[i] = record_of(scene, &scene->lights[i]);
    }
    const glint_content content = {"the lights", (count + 1) * sizeof *records, records};
    const glint_status status = glint_buffer_create(device, &content, lights, error);
    free(records);
    return status;
}
