// The scene's buffers on the device.
#ifndef GLINT_RENDER_UPLOAD_H
#define GLINT_RENDER_UPLOAD_H

#include "accel/bvh.h"
#include "base/status.h"
#include "device/opencl.h"
#include "environment/environment.h"
#include "render/plan.h"
#include "scene/scene.h"

#define GLINT_TREE_ARRAYS 4 // nodes, clusters, normals, numbers

// Zero is valid: no buffers. Each is described in kernels/layout.h; those that the plan does not
// need are a few bytes long, as a kernel's arguments cannot be left out. `kept` is the host's
// memory that buffers lie in, on devices that share it; owned.
typedef struct glint_geometry_memory {
    cl_mem nodes, clusters, normals, numbers, materials, media;
    void *kept[GLINT_TREE_ARRAYS]; // NULL where the tree's array was copied
} glint_geometry_memory;

typedef struct glint_environment_memory {
    cl_mem texels;
    void *kept; // what they lie in
} glint_environment_memory;

// What is uploaded of a scene. Pointers are borrowed. A device that shares the host's memory takes
// the tree's arrays over instead of copying them, and leaves NULL.
typedef struct glint_upload_inputs {
    const struct glint_device *device;
    const glint_scene *scene;
    glint_bvh *bvh;
    const glint_plan *plan;
} glint_upload_inputs;

// What takes memory beside the scene.
typedef struct glint_upload_sizes {
    size_t environment, frame, layers, terms, doubts; // bytes
    size_t vertex;                                    // what is found of a cluster's vertices
} glint_upload_sizes;

// Fails with GLINT_DEVICE_FAILED if one of the scene's buffers or of the others is larger than the
// device allows, or all of them together than its memory: asked before the long work begins. The
// tree is not built yet, so the least that its triangles can take is counted.
glint_status glint_upload_check(const struct glint_device *device, const glint_scene *scene,
                                const glint_upload_sizes *sizes, glint_error *error);

// The tree and the materials. Errors: GLINT_DEVICE_FAILED; *memory is then empty.
glint_status glint_geometry_upload(const glint_upload_inputs *inputs, glint_geometry_memory *memory,
                                   glint_error *error);
void glint_geometry_memory_free(glint_geometry_memory *memory);

// Frees the buffers and gives the tree the arrays back that were taken over.
void glint_geometry_take_back(glint_geometry_memory *memory, glint_bvh *bvh);

// The environment's texels as the plan wants them. Errors likewise.
glint_status glint_environment_upload(const struct glint_device *device, const glint_plan *plan,
                                      const glint_cube *environment,
                                      glint_environment_memory *memory, glint_error *error);
void glint_environment_memory_free(glint_environment_memory *memory);

// A buffer of `bytes` (at least 16 are made), filled from `data` unless that is NULL. `what` names
// it in messages.
glint_status glint_buffer_create(const struct glint_device *device, const char *what, size_t bytes,
                                 const void *data, cl_mem *buffer, glint_error *error);

// NULL is allowed.
void glint_buffer_release(cl_mem buffer);

// What the buffer takes, 0 for NULL.
size_t glint_buffer_bytes(cl_mem buffer);

#endif
