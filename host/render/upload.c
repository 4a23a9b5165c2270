// Uploads the scene and the environment. See upload.h.
#include "render/upload.h"

#include "base/memory.h"
#include "environment/half_texels.h"
#include "environment/mip_levels.h"
#include "kernels/layout.h"
#include "render/punctual.h"
#include "render/split.h"
#include "render/vertices.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Both compilers must give the shared structs the same layout: 32-bit scalars without gaps.
_Static_assert(sizeof(glint_material_record) == 232, "glint_material_record has gaps");
_Static_assert(sizeof(glint_texture_record) == 112, "glint_texture_record has gaps");
_Static_assert(sizeof(glint_medium_record) == 48, "glint_medium_record has gaps");
_Static_assert(sizeof(glint_split_vector) == 32, "glint_split_vector has gaps");
_Static_assert(sizeof(glint_light_record) == 112, "glint_light_record has gaps");
_Static_assert(sizeof(glint_layers_record) == 48, "glint_layers_record has gaps");
_Static_assert(sizeof(glint_frame_record) ==
                   12 * 32 + (36 + GLINT_FEATURE_WORDS) * 4 + GLINT_WAVELENGTHS_MAX * 16,
               "glint_frame_record has gaps");

static size_t attribute_bytes(const glint_scene *scene)
{
    return scene->triangle_count * 3 * glint_attributes_stride(&scene->attribute_set) *
           sizeof(float);
}

// Lists the attributes by corner, as kernels read them. Returns the scene's own array if it is such
// a list, else an array that the caller frees; NULL if memory is short.
static float *attributes_by_corner(const glint_scene *scene)
{
    if (scene->attributes == NULL || scene->indices == NULL) {
        return scene->attributes;
    }
    const size_t stride = glint_attributes_stride(&scene->attribute_set);
    float *listed = glint_allocate_unset(3 * scene->triangle_count, stride * sizeof *listed);
    for (size_t i = 0; listed != NULL && i < 3 * scene->triangle_count; i++) {
        memcpy(listed + stride * i, scene->attributes + stride * scene->indices[i],
               stride * sizeof *listed);
    }
    return listed;
}

static size_t solid_bytes(const glint_scene *scene, const glint_plan *plan)
{
    return plan->features[GLINT_FEATURE_OVERLAPS].compiled
               ? scene->triangle_count * sizeof(glint_solid_record)
               : 0;
}

void glint_geometry_measure(const glint_scene *scene, const glint_plan *plan,
                            glint_content contents[GLINT_GEOMETRY_CONTENTS])
{
    // The number of clusters if all clusters were full.
    const size_t clusters = (scene->triangle_count + GLINT_CLUSTER_LANES - 1) / GLINT_CLUSTER_LANES;
    const bool has_normals = scene->normals != NULL || glint_plan_shades_vertices(plan);
    const size_t normals = has_normals ? GLINT_CLUSTER_NORMALS * sizeof(float) : 0;
    const glint_content found[GLINT_GEOMETRY_CONTENTS] = {
        {"the triangles", clusters * sizeof(glint_cluster), NULL},
        {"the normals", clusters * normals, NULL},
        {"the triangles' numbers", clusters * GLINT_CLUSTER_LANES * sizeof(cl_int), NULL},
        {"the vertices", clusters * glint_vertices_bytes(plan), NULL},
        {"the vertices' attributes", attribute_bytes(scene), NULL},
        {"the solids' triangles", solid_bytes(scene, plan), NULL},
        {"the textures", glint_textures_bytes(scene->textures), NULL},
    };
    memcpy(contents, found, sizeof found);
}

static glint_status upload_tree(const glint_upload_inputs *in, glint_geometry_memory *memory,
                                glint_error *error)
{
    glint_bvh *bvh = in->bvh;
    const size_t node_bytes = GLINT_NODE_VALUES * (size_t)bvh->width * sizeof(float);
    const size_t normals = bvh->normals != NULL ? GLINT_CLUSTER_NORMALS * sizeof(float) : 0;
    void *data[] = {bvh->nodes, bvh->clusters, bvh->normals, bvh->numbers};
    const struct {
        glint_content content;
        glint_shared_buffer *buffer;
    } arrays[] = {
        {{"the tree", bvh->node_count * node_bytes, NULL}, &memory->nodes},
        {{"the triangles", bvh->cluster_count * sizeof(glint_cluster), NULL}, &memory->clusters},
        {{"the normals", bvh->cluster_count * normals, NULL}, &memory->normals},
        {{"the triangles' numbers", bvh->cluster_count * GLINT_CLUSTER_LANES * sizeof(int32_t),
          NULL},
         &memory->numbers},
    };
    glint_status status = GLINT_OK;
    for (size_t i = 0; status == GLINT_OK && i < sizeof arrays / sizeof *arrays; i++) {
        status = glint_buffer_hand_over(in->device, &arrays[i].content, &data[i], arrays[i].buffer,
                                        error);
    }
    bvh->nodes = data[0];
    bvh->clusters = data[1];
    bvh->normals = data[2];
    bvh->numbers = data[3];
    return status;
}

static glint_material_record
material_record(const glint_material *m, const int textures[GLINT_TEXTURE_SLOTS], uint32_t *media)
{
    const glint_lobes lobes = glint_material_lobes(m);
    glint_material_record record = {
        .metallic = lobes.unlit || lobes.blend ? 1 : m->metallic, // 1, so that nothing is
                                                                  // transmitted
        .transmission = m->transmission,
        .ior = m->ior,
        .blend = lobes.blend ? m->mirror : 0,
        .flags =
            (lobes.solid ? GLINT_MATERIAL_SOLID : 0) | (lobes.thin ? GLINT_MATERIAL_THIN : 0) |
            (lobes.unlit ? GLINT_MATERIAL_UNLIT : 0) | (lobes.blend ? GLINT_MATERIAL_BLEND : 0) |
            (lobes.gloss ? GLINT_MATERIAL_GLOSS : 0) | (lobes.masked ? GLINT_MATERIAL_MASK : 0) |
            (lobes.covers ? GLINT_MATERIAL_COVER : 0) |
            (lobes.dispersion ? GLINT_MATERIAL_DISPERSIVE : 0),
        .medium = lobes.solid ? ++*media : 0,
        .alpha_cutoff = m->alpha_cutoff,
        .normal_scale = m->normal_scale,
        .occlusion_strength = m->occlusion_strength,
        .specular = m->specular,
        .clearcoat = lobes.clearcoat ? m->clearcoat : 0,
        .clearcoat_roughness = m->clearcoat_roughness,
        .clearcoat_normal_scale = m->clearcoat_normal_scale,
        .anisotropy = lobes.brushed ? m->anisotropy : 0,
        .brush_direction = {cosf(m->anisotropy_rotation), sinf(m->anisotropy_rotation)},
        .iridescence = lobes.iridescent ? m->iridescence : 0,
        .iridescence_ior = m->iridescence_ior,
        .iridescence_thickness = {m->iridescence_thickness[0], m->iridescence_thickness[1]},
        .sheen_roughness = m->sheen_roughness,
        .diffuse_transmission = lobes.translucent ? m->diffuse_transmission : 0,
        .roughness = lobes.rough || lobes.facets ? m->roughness : 0,
    };
    // Copy colours and textures.
    memcpy(record.base_color, m->base_color, sizeof m->base_color);
    record.base_color[3] = m->alpha;
    memcpy(record.specular_color, m->specular_color, sizeof m->specular_color);
    memcpy(record.textures, textures, sizeof record.textures);
    memcpy(record.diffuse_transmission_color, m->diffuse_transmission_color,
           sizeof m->diffuse_transmission_color);
    if (lobes.sheen) {
        memcpy(record.sheen_color, m->sheen_color, sizeof m->sheen_color);
    }
    if (lobes.emission) {
        memcpy(record.emission, m->emission, sizeof m->emission);
    }
    return record;
}

// σ = −ln(colour)/distance (KHR_materials_volume), per stored unit. A colour of 0 absorbs all
// light. Its σ is large enough for any distance but finite, because ∞ times a distance of 0 is NaN.
static glint_medium_record medium_record(const glint_material *m, double unit)
{
    glint_medium_record record = {.ior = m->ior, .dispersion = (m->ior - 1) * m->dispersion};
    for (int k = 0; k < 3; k++) {
        double sigma = 0;
        if (isfinite(m->attenuation_distance) && m->attenuation_color[k] < 1) {
            double color = fmax((double)m->attenuation_color[k], 1e-30);
            sigma = -log(color) / (double)m->attenuation_distance * unit;
            sigma = m->attenuation_color[k] > 0 ? fmin(sigma, 1e30) : 1e30;
        }
        glint_split_number(sigma, &record.absorption_high[k], &record.absorption_low[k]);
    }
    return record;
}

// Makes the media that the plan counts: one per solid material or, if solids overlap, in order of
// priority. *count is their number without empty space.
static glint_medium_record *media_records(const glint_upload_inputs *in, size_t *count)
{
    const glint_scene *scene = in->scene;
    const bool ranked = in->plan->features[GLINT_FEATURE_OVERLAPS].compiled;
    const size_t most = ranked ? in->solids->medium_count : scene->material_count;
    glint_medium_record *media = glint_allocate(most + 1, sizeof *media);
    *count = 0;
    for (size_t i = 0; media != NULL && i < most; i++) {
        const size_t number = ranked ? in->solids->material_of[i] : i;
        const glint_material *m = &scene->materials[number];
        if (glint_material_lobes(m).solid) {
            media[++*count] = medium_record(m, scene->unit);
            media[*count].material = (int)number;
        }
    }
    if (media != NULL) {
        media[0] = (glint_medium_record){.ior = 1, .material = -1};
    }
    return media;
}

static glint_status upload_materials(const glint_upload_inputs *in, glint_geometry_memory *memory,
                                     glint_error *error)
{
    const glint_scene *scene = in->scene;
    const size_t count = scene->material_count;
    glint_status status;
    uint32_t media_of_materials = 0;
    size_t media_count;
    glint_material_record *materials = glint_allocate(count + 1, sizeof *materials);
    glint_medium_record *media = media_records(in, &media_count);
    float *attributes = attributes_by_corner(scene);
    if (materials == NULL || media == NULL || (attributes == NULL && scene->attributes != NULL)) {
        status = glint_fail_memory(error, "the materials and the vertices' attributes");
        goto cleanup;
    }
    // Fill the records.
    for (size_t i = 0; i < count; i++) {
        materials[i] = material_record(&scene->materials[i], in->textures->of_material[i],
                                       &media_of_materials);
    }
    // A kernel without MANY_MATERIALS reads the first material. Put the used material there.
    if (!in->plan->features[GLINT_FEATURE_MANY_MATERIALS].compiled && scene->triangle_count > 0) {
        materials[0] = materials[scene->material_of[0]];
    }
    // Upload the records, and the attributes of vertices and solids.
    const glint_content contents[] = {
        {"the materials", (count + 1) * sizeof *materials, materials},
        {"the media", (media_count + 1) * sizeof *media, media},
        {"the vertices' attributes", attribute_bytes(scene), attributes},
        {"the solids' triangles", solid_bytes(scene, in->plan), in->solids->of_triangle},
    };
    TRY_OR(cleanup, status,
           glint_buffer_create(in->device, &contents[0], &memory->materials, error));
    TRY_OR(cleanup, status, glint_buffer_create(in->device, &contents[1], &memory->media, error));
    TRY_OR(cleanup, status,
           glint_buffer_create(in->device, &contents[2], &memory->attributes, error));
    TRY_OR(cleanup, status, glint_buffer_create(in->device, &contents[3], &memory->solids, error));
cleanup:
    free(materials);
    free(media);
    if (attributes != scene->attributes) {
        free(attributes);
    }
    return status;
}

glint_status glint_geometry_upload(const glint_upload_inputs *in, glint_geometry_memory *memory,
                                   glint_error *error)
{
    *memory = (glint_geometry_memory){0};
    glint_status status = upload_tree(in, memory, error);
    if (status == GLINT_OK) {
        status = upload_materials(in, memory, error);
    }
    if (status == GLINT_OK) {
        status = glint_lights_upload(in->device, in->scene, &memory->lights, error);
    }
    if (status != GLINT_OK) {
        glint_geometry_memory_free(memory);
    }
    return status;
}

static void *take_back(glint_shared_buffer *shared, void *own)
{
    void *array = shared->kept != NULL ? shared->kept : own;
    shared->kept = NULL;
    return array;
}

void glint_geometry_take_back(glint_geometry_memory *memory, glint_bvh *bvh)
{
    bvh->nodes = take_back(&memory->nodes, bvh->nodes);
    bvh->clusters = take_back(&memory->clusters, bvh->clusters);
    bvh->normals = take_back(&memory->normals, bvh->normals);
    bvh->numbers = take_back(&memory->numbers, bvh->numbers);
    glint_geometry_memory_free(memory);
}

void glint_geometry_memory_free(glint_geometry_memory *memory)
{
    glint_shared_buffer_free(&memory->nodes);
    glint_shared_buffer_free(&memory->clusters);
    glint_shared_buffer_free(&memory->normals);
    glint_shared_buffer_free(&memory->numbers);
    glint_buffer_release(&memory->materials);
    glint_buffer_release(&memory->media);
    glint_buffer_release(&memory->solids);
    glint_buffer_release(&memory->attributes);
    glint_buffer_release(&memory->lights);
}

// Uploads the environment and its coarser levels. For halfs, the map's own texels need no
// intermediate copy.
static glint_status upload_levels(const struct glint_device *device, bool half,
                                  const glint_cube *cube, glint_shared_buffer *texels,
                                  glint_error *error)
{
    const size_t own = glint_cube_size(cube), count = glint_mip_levels_size(cube->edge);
    const glint_content content = {"the environment",
                                   count * (half ? sizeof(uint16_t) : sizeof(float)), NULL};
    void *floats = glint_allocate_unset(half ? count - own : count, sizeof(float));
    void *halfs = half ? glint_allocate_unset(count, sizeof(uint16_t)) : NULL;
    glint_status status;
    if (floats == NULL || (half && halfs == NULL)) {
        status = glint_fail_memory(error, content.what);
    } else if (half) {
        glint_mip_levels_fill(cube, floats);
        glint_mip_levels_to_half(cube, floats, halfs);
        status = glint_buffer_hand_over(device, &content, &halfs, texels, error);
    } else {
        memcpy(floats, cube->texels, own * sizeof(float));
        glint_mip_levels_fill(cube, (float *)floats + own);
        status = glint_buffer_hand_over(device, &content, &floats, texels, error);
    }
    free(floats);
    free(halfs);
    return status;
}

static glint_status upload_halfs(const struct glint_device *device, const glint_cube *cube,
                                 glint_shared_buffer *texels, glint_error *error)
{
    const size_t count = glint_cube_size(cube);
    const glint_content content = {"the environment", count * sizeof(uint16_t), NULL};
    void *halfs = glint_allocate_unset(count, sizeof(uint16_t));
    if (halfs == NULL) {
        return glint_fail_memory(error, content.what);
    }
    glint_cube_to_half(cube, halfs);
    const glint_status status = glint_buffer_hand_over(device, &content, &halfs, texels, error);
    free(halfs);
    return status;
}

glint_status glint_environment_upload(const struct glint_device *device, const glint_plan *plan,
                                      const glint_cube *environment, glint_shared_buffer *texels,
                                      glint_error *error)
{
    *texels = (glint_shared_buffer){0};
    if (glint_plan_reads_levels(plan)) {
        return upload_levels(device, plan->half_texels, environment, texels, error);
    }
    if (plan->half_texels) {
        return upload_halfs(device, environment, texels, error);
    }
    const size_t floats = environment->texels != NULL ? glint_cube_size(environment) : 0;
    const glint_content content = {"the environment", floats * sizeof(float), environment->texels};
    return glint_buffer_create(device, &content, &texels->buffer, error);
}
