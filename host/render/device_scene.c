// Uploads the scene and swaps it with the next scene. See device_scene.h.
#include "render/device_scene.h"

#include "accel/bvh_build.h"
#include "base/clock.h"
#include "render/vertices.h"

void glint_device_scene_take_back(glint_device_scene *s)
{
    glint_geometry_take_back(&s->geometry, &s->shown.tree);
}

void glint_device_scene_swap(glint_device_scene *s)
{
    glint_device_scene_take_back(s);
    const glint_prepared_scene before = s->shown;
    s->shown = s->next;
    s->next = before;
    s->next_is_ready = false;
}

static glint_status upload(glint_device_scene *s, const glint_scene *scene, glint_error *error)
{
    const glint_prepared_scene *shown = &s->shown;
    glint_texture_table table;
    TRY(glint_texture_table_make(scene, &table, error));
    const glint_upload_inputs inputs = {.device = s->device,
                                        .scene = scene,
                                        .solids = &shown->solids,
                                        .bvh = &s->shown.tree,
                                        .plan = &shown->plan,
                                        .textures = &table};
    glint_status status = glint_geometry_upload(&inputs, &s->geometry, error);
    if (status == GLINT_OK) {
        status = glint_texture_memory_fill(s->device, scene, &table, &s->textures, error);
    }
    glint_texture_table_free(&table);
    TRY(status);
    TRY(glint_owners_set(&s->owners, scene, error));
    s->space = glint_stored_space_of(scene);
    const size_t bytes = shown->bvh.cluster_count * glint_vertices_bytes(&shown->plan);
    glint_buffer_release(&s->vertices);
    return glint_buffer_create(s->device, &(glint_content){"the vertices", bytes, NULL},
                               &s->vertices, error);
}

glint_status glint_device_scene_upload(glint_device_scene *s, const glint_scene *scene,
                                       glint_error *error)
{
    double clock = glint_now_ms();
    const glint_status status = upload(s, scene, error);
    glint_solids_free(&s->shown.solids);
    if (status != GLINT_OK || !scene->moves) {
        glint_bvh_free(&s->shown.tree); // only the tree of a scene that moves is needed again
    }
    s->upload_ms = glint_lap_ms(&clock);
    return status;
}

size_t glint_device_scene_bytes(const glint_device_scene *s)
{
    const glint_geometry_memory *g = &s->geometry;
    return glint_buffer_bytes(g->clusters.buffer) + glint_buffer_bytes(g->normals.buffer) +
           glint_buffer_bytes(g->numbers.buffer) + glint_buffer_bytes(g->materials) +
           glint_buffer_bytes(g->media) + glint_buffer_bytes(g->solids) +
           glint_buffer_bytes(g->attributes) + glint_buffer_bytes(g->lights) +
           glint_buffer_bytes(s->textures.texels);
}

size_t glint_device_scene_tree_bytes(const glint_device_scene *s)
{
    return glint_buffer_bytes(s->geometry.nodes.buffer);
}

void glint_device_scene_free(glint_device_scene *s)
{
    glint_geometry_memory_free(&s->geometry);
    glint_texture_memory_free(&s->textures);
    glint_buffer_release(&s->vertices);
    glint_owners_free(&s->owners);
    glint_bvh_free(&s->shown.tree);
    glint_bvh_free(&s->next.tree);
    glint_solids_free(&s->shown.solids);
    glint_solids_free(&s->next.solids);
    *s = (glint_device_scene){0};
}
