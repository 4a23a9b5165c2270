// Places punctual lights. See lights.h.
#include "scene/gltf/lights.h"

#include "scene/gltf/notes.h"

#include <math.h>

glint_status glint_light_add(glint_load *load, size_t visit, glint_scene *scene, glint_error *error)
{
    const glint_document_node *node = glint_load_node(load, visit);
    const glint_document_light *source = &load->document.lights[node->light];
    glint_notes_tally(&load->document, source->notes, "", &load->tally);
    if (source->kind < 0) {
        return GLINT_OK;
    }
    const double(*m)[4] = load->placed[visit].m;
    const int index = load->visits.all[visit].node;
    glint_punctual_light *light = &scene->lights[scene->light_count];
    *light = (glint_punctual_light){
        .kind = (glint_punctual_kind)source->kind,
        .node_index = index,
        .position = {m[0][3], m[1][3], m[2][3]},
        .direction = glint_vec3_normalize((glint_vec3){-m[0][2], -m[1][2], -m[2][2]}),
        .color = {source->color[0], source->color[1], source->color[2]},
        .range = source->range > 0 ? source->range : INFINITY,
        .inner_angle = source->inner_angle,
        .outer_angle = source->outer_angle,
    };
    const bool has_place =
        isfinite(light->position.x) && isfinite(light->position.y) && isfinite(light->position.z);
    const bool has_direction = glint_vec3_length(light->direction) > 0;
    if (!has_place || (light->kind != GLINT_PUNCTUAL_POINT && !has_direction)) {
        char where[GLINT_WHERE];
        glint_tally_add(&load->tally,
                        "the light shines nowhere (the node's scale is 0, or its place not finite) "
                        "and is left out",
                        glint_name_place("nodes", (size_t)index, "", where));
        return GLINT_OK;
    }
    bool is_short = false;
    const glint_text name = node->name != 0 ? node->name : source->name;
    light->name = glint_name_copy(glint_load_text(load, name), &is_short);
    scene->light_count++;
    return is_short ? glint_fail_memory(error, "the scene") : GLINT_OK;
}
