// The scene's buffers on the device. See upload.h.
#include "render/upload.h"

#include "base/memory.h"
#include "device/opencl_error.h"
#include "environment/half_texels.h"
#include "environment/mip_levels.h"
#include "kernels/layout.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Both compilers must lay the shared structs out alike: 32-bit scalars without gaps.
_Static_assert(sizeof(glint_material_record) == 64, "glint_material_record has gaps");
_Static_assert(sizeof(glint_medium_record) == 48, "glint_medium_record has gaps");
_Static_assert(sizeof(glint_split_vector) == 32, "glint_split_vector has gaps");
_Static_assert(sizeof(glint_layers_record) == 24, "glint_layers_record has gaps");
_Static_assert(sizeof(glint_frame_record) == 12 * 32 + 27 * 4, "glint_frame_record has gaps");

#define MEBIBYTE 1048576.0
#define LEAST_BYTES ((size_t)16) // of a buffer

static glint_status check_size(const struct glint_device *device, const char *what, size_t bytes,
                               glint_error *error)
{
    const glint_capabilities *c = &device->capabilities;
    if (bytes <= c->largest_allocation_bytes) {
        return GLINT_OK;
    }
    return glint_fail(error, GLINT_DEVICE_FAILED,
                      "device '%s': %s needs %.0f MiB in one buffer and the device allows %.0f",
                      c->name, what, (double)bytes / MEBIBYTE,
                      (double)c->largest_allocation_bytes / MEBIBYTE);
}

glint_status glint_upload_check(const struct glint_device *device, const glint_scene *scene,
                                const glint_upload_sizes *sizes, glint_error *error)
{
    // As many as would do if all clusters could be full.
    const size_t clusters = (scene->triangle_count + GLINT_CLUSTER_LANES - 1) / GLINT_CLUSTER_LANES;
    const size_t normals =
        scene->normals != NULL || sizes->vertex > 0 ? clusters * GLINT_CLUSTER_NORMALS : 0;
    const struct {
        const char *what;
        size_t bytes;
    } buffers[] = {
        {"the triangles", clusters * sizeof(glint_cluster)},
        {"the normals", normals * sizeof(float)},
        {"the triangles' numbers", clusters * GLINT_CLUSTER_LANES * sizeof(cl_int)},
        {"the environment", sizes->environment},
        {"the frame", sizes->frame},
        {"the layers", sizes->layers},
        {"the directions", sizes->terms},
        {"the doubts", sizes->doubts},
        {"the vertices", clusters * sizes->vertex},
    };
    double total = 0;
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++) {
        glint_status status = check_size(device, buffers[i].what, buffers[i].bytes, error);
        if (status != GLINT_OK) {
            return status;
        }
        total += (double)buffers[i].bytes;
    }
    if (total > (double)device->capabilities.memory_bytes) {
        return glint_fail(error, GLINT_DEVICE_FAILED,
                          "device '%s': scene, environment and frame need %.0f MiB and it has %.0f",
                          device->capabilities.name, total / MEBIBYTE,
                          (double)device->capabilities.memory_bytes / MEBIBYTE);
    }
    return GLINT_OK;
}

glint_status glint_buffer_create(const struct glint_device *device, const char *what, size_t bytes,
                                 const void *data, cl_mem *buffer, glint_error *error)
{
    static const char nothing[LEAST_BYTES] = {0};
    glint_status status = check_size(device, what, bytes, error);
    if (status != GLINT_OK) {
        return status;
    }
    if (bytes < LEAST_BYTES) {
        data = bytes == 0 || data == NULL ? nothing : data;
    }
    size_t allocated = bytes < LEAST_BYTES ? LEAST_BYTES : bytes;
    cl_int code;
    *buffer = clCreateBuffer(device->context, CL_MEM_READ_WRITE, allocated, NULL, &code);
    if (code == CL_SUCCESS && data != NULL && bytes > 0) {
        code = clEnqueueWriteBuffer(device->queue, *buffer, CL_TRUE, 0, bytes, data, 0, NULL, NULL);
    }
    if (code == CL_SUCCESS) {
        return GLINT_OK;
    }
    glint_buffer_release(*buffer);
    *buffer = NULL;
    return glint_fail_opencl(error, device, what, code);
}

size_t glint_buffer_bytes(cl_mem buffer)
{
    size_t bytes = 0;
    if (buffer != NULL) {
        clGetMemObjectInfo(buffer, CL_MEM_SIZE, sizeof bytes, &bytes, NULL);
    }
    return bytes;
}

// A buffer that holds *data: a copy or, on a device that shares the host's memory, *data itself,
// which then is *kept, and *data NULL.
static glint_status hand_over(const struct glint_device *device, const char *what, size_t bytes,
                              void **data, void **kept, cl_mem *buffer, glint_error *error)
{
    if (!device->capabilities.shares_memory || bytes < LEAST_BYTES) {
        return glint_buffer_create(device, what, bytes, *data, buffer, error);
    }
    glint_status status = check_size(device, what, bytes, error);
    if (status != GLINT_OK) {
        return status;
    }
    cl_int code;
    *buffer = clCreateBuffer(device->context, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, bytes, *data,
                             &code);
    if (code != CL_SUCCESS) {
        return glint_fail_opencl(error, device, what, code);
    }
    *kept = *data;
    *data = NULL;
    return GLINT_OK;
}

// The tree's arrays are the device's already.
static glint_status upload_tree(const glint_upload_inputs *in, glint_geometry_memory *memory,
                                glint_error *error)
{
    glint_bvh *bvh = in->bvh;
    const size_t node_bytes = GLINT_NODE_VALUES * (size_t)bvh->width * sizeof(float);
    const size_t normals = bvh->normals != NULL ? GLINT_CLUSTER_NORMALS * sizeof(float) : 0;
    void *data[GLINT_TREE_ARRAYS] = {bvh->nodes, bvh->clusters, bvh->normals, bvh->numbers};
    const struct {
        const char *what;
        size_t bytes;
        cl_mem *buffer;
    } arrays[] = {
        {"the tree", bvh->node_count * node_bytes, &memory->nodes},
        {"the triangles", bvh->cluster_count * sizeof(glint_cluster), &memory->clusters},
        {"the normals", bvh->cluster_count * normals, &memory->normals},
        {"the triangles' numbers", bvh->cluster_count * GLINT_CLUSTER_LANES * sizeof(int32_t),
         &memory->numbers},
    };
    glint_status status = GLINT_OK;
    for (size_t i = 0; status == GLINT_OK && i < sizeof arrays / sizeof *arrays; i++) {
        status = hand_over(in->device, arrays[i].what, arrays[i].bytes, &data[i], &memory->kept[i],
                           arrays[i].buffer, error);
    }
    bvh->nodes = data[0];
    bvh->clusters = data[1];
    bvh->normals = data[2];
    bvh->numbers = data[3];
    return status;
}

static glint_material_record material_record(const glint_material *m, uint32_t *media)
{
    const glint_lobes lobes = glint_material_lobes(m);
    glint_material_record record = {
        .metallic = lobes.unlit || lobes.blend ? 1 : m->metallic, // nothing is transmitted
        .transmission = m->transmission,
        .ior = m->ior,
        .blend = lobes.blend ? m->mirror : 0,
        .flags = (lobes.solid ? GLINT_MATERIAL_SOLID : 0) | (lobes.thin ? GLINT_MATERIAL_THIN : 0) |
                 (lobes.unlit ? GLINT_MATERIAL_UNLIT : 0) |
                 (lobes.blend ? GLINT_MATERIAL_BLEND : 0) |
                 (lobes.gloss ? GLINT_MATERIAL_GLOSS : 0),
        .medium = lobes.solid ? ++*media : 0,
    };
    memcpy(record.base_color, m->base_color, sizeof m->base_color);
    if (lobes.emission) {
        memcpy(record.emission, m->emission, sizeof m->emission);
    }
    return record;
}

// σ = −ln(colour)/distance (KHR_materials_volume), per stored unit. A colour of 0 absorbs all: a
// finite σ large enough for any distance, as ∞ times a distance of 0 would give NaN.
static glint_medium_record medium_record(const glint_material *m, double unit)
{
    glint_medium_record record = {.ior = m->ior};
    for (int k = 0; k < 3; k++) {
        double sigma = 0;
        if (isfinite(m->attenuation_distance) && m->attenuation_color[k] < 1) {
            double color = fmax((double)m->attenuation_color[k], 1e-30);
            sigma = -log(color) / (double)m->attenuation_distance * unit;
            sigma = m->attenuation_color[k] > 0 ? fmin(sigma, 1e30) : 1e30;
        }
        record.absorption_high[k] = (float)sigma;
        record.absorption_low[k] = (float)(sigma - (double)record.absorption_high[k]);
    }
    return record;
}

static glint_status upload_materials(const glint_upload_inputs *in, glint_geometry_memory *memory,
                                     glint_error *error)
{
    const glint_scene *scene = in->scene;
    size_t count = scene->material_count;
    glint_status status = GLINT_OK;
    uint32_t media_count = 0;
    glint_material_record *materials = glint_allocate(count + 1, sizeof *materials);
    glint_medium_record *media = glint_allocate(count + 1, sizeof *media);
    if (materials == NULL || media == NULL) {
        status = glint_fail_memory(error, "the materials");
        goto cleanup;
    }
    media[0].ior = 1;
    size_t only = 0;
    for (size_t i = 0; i < count; i++) {
        uint32_t before = media_count;
        materials[i] = material_record(&scene->materials[i], &media_count);
        if (media_count > before) {
            media[media_count] = medium_record(&scene->materials[i], scene->unit);
        }
    }
    // A kernel without MANY_MATERIALS reads the first: the one that is in use.
    if (scene->triangle_count > 0) {
        only = scene->material_of[0];
    }
    if (!in->plan->features[GLINT_FEATURE_MANY_MATERIALS].compiled) {
        materials[0] = materials[only];
    }
    status = glint_buffer_create(in->device, "the materials", (count + 1) * sizeof *materials,
                                 materials, &memory->materials, error);
    if (status == GLINT_OK) {
        status = glint_buffer_create(in->device, "the media", (media_count + 1) * sizeof *media,
                                     media, &memory->media, error);
    }
cleanup:
    free(materials);
    free(media);
    return status;
}

// The environment and its coarser levels. Of halfs the map's own texels need no copy in between.
static glint_status upload_levels(const struct glint_device *device, bool half,
                                  const glint_cube *cube, glint_environment_memory *memory,
                                  glint_error *error)
{
    const char *what = "the environment";
    const size_t own = glint_cube_size(cube), count = glint_mip_levels_size(cube->edge);
    void *floats = glint_allocate_unset(half ? count - own : count, sizeof(float));
    void *halfs = half ? glint_allocate_unset(count, sizeof(uint16_t)) : NULL;
    glint_status status;
    if (floats == NULL || (half && halfs == NULL)) {
        status = glint_fail_memory(error, what);
    } else if (half) {
        glint_mip_levels_fill(cube, floats);
        glint_mip_levels_to_half(cube, floats, halfs);
        status = hand_over(device, what, count * sizeof(uint16_t), &halfs, &memory->kept,
                           &memory->texels, error);
    } else {
        memcpy(floats, cube->texels, own * sizeof(float));
        glint_mip_levels_fill(cube, (float *)floats + own);
        status = hand_over(device, what, count * sizeof(float), &floats, &memory->kept,
                           &memory->texels, error);
    }
    free(floats);
    free(halfs);
    return status;
}

static glint_status upload_halfs(const struct glint_device *device, const glint_cube *cube,
                                 glint_environment_memory *memory, glint_error *error)
{
    const char *what = "the environment";
    const size_t count = glint_cube_size(cube);
    void *texels = glint_allocate_unset(count, sizeof(uint16_t));
    if (texels == NULL) {
        return glint_fail_memory(error, what);
    }
    glint_cube_to_half(cube, texels);
    glint_status status = hand_over(device, what, count * sizeof(uint16_t), &texels, &memory->kept,
                                    &memory->texels, error);
    free(texels);
    return status;
}

glint_status glint_environment_upload(const struct glint_device *device, const glint_plan *plan,
                                      const glint_cube *environment,
                                      glint_environment_memory *memory, glint_error *error)
{
    *memory = (glint_environment_memory){0};
    if (plan->features[GLINT_FEATURE_MIP_LEVELS].compiled) {
        return upload_levels(device, plan->half_texels, environment, memory, error);
    }
    if (plan->half_texels) {
        return upload_halfs(device, environment, memory, error);
    }
    const size_t floats = environment->texels != NULL ? glint_cube_size(environment) : 0;
    return glint_buffer_create(device, "the environment", floats * sizeof(float),
                               environment->texels, &memory->texels, error);
}

glint_status glint_geometry_upload(const glint_upload_inputs *in, glint_geometry_memory *memory,
                                   glint_error *error)
{
    *memory = (glint_geometry_memory){0};
    glint_status status = upload_tree(in, memory, error);
    if (status == GLINT_OK) {
        status = upload_materials(in, memory, error);
    }
    if (status != GLINT_OK) {
        glint_geometry_memory_free(memory);
    }
    return status;
}

void glint_buffer_release(cl_mem buffer)
{
    if (buffer != NULL) {
        clReleaseMemObject(buffer);
    }
}

static void release_buffers(glint_geometry_memory *memory)
{
    glint_buffer_release(memory->nodes);
    glint_buffer_release(memory->clusters);
    glint_buffer_release(memory->normals);
    glint_buffer_release(memory->numbers);
    glint_buffer_release(memory->materials);
    glint_buffer_release(memory->media);
}

void glint_geometry_memory_free(glint_geometry_memory *memory)
{
    release_buffers(memory);
    for (int i = 0; i < GLINT_TREE_ARRAYS; i++) {
        free(memory->kept[i]);
    }
    *memory = (glint_geometry_memory){0};
}

void glint_geometry_take_back(glint_geometry_memory *memory, glint_bvh *bvh)
{
    release_buffers(memory);
    void *const *kept = memory->kept;
    bvh->nodes = kept[0] != NULL ? kept[0] : bvh->nodes;
    bvh->clusters = kept[1] != NULL ? kept[1] : bvh->clusters;
    bvh->normals = kept[2] != NULL ? kept[2] : bvh->normals;
    bvh->numbers = kept[3] != NULL ? kept[3] : bvh->numbers;
    *memory = (glint_geometry_memory){0};
}

void glint_environment_memory_free(glint_environment_memory *memory)
{
    glint_buffer_release(memory->texels);
    free(memory->kept);
    *memory = (glint_environment_memory){0};
}
