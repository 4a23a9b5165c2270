// The scene and the environment in buffers on the device.
#ifndef GLINT_RENDER_UPLOAD_H
#define GLINT_RENDER_UPLOAD_H

#include "accel/bvh.h"
#include "base/status.h"
#include "device/buffer.h"
#include "environment/environment.h"
#include "render/plan.h"
#include "render/textures.h"
#include "scene/scene.h"

// Zero is valid: no buffers. Each is described in kernels/layout.h; those that the plan does not
// need are a few bytes long, as a kernel's arguments cannot be left out.
typedef struct glint_geometry_memory {
    glint_shared_buffer nodes, clusters, normals, numbers; // the tree's arrays
    cl_mem materials, media, solids, attributes, lights;
} glint_geometry_memory;

// What is uploaded of a scene. Pointers are borrowed. A device that shares the host's memory takes
// the tree's arrays over instead of copying them, and leaves NULL.
typedef struct glint_upload_inputs {
    const struct glint_device *device;
    const glint_scene *scene;
    const glint_solids *solids;
    glint_bvh *bvh;
    const glint_plan *plan;
    const glint_texture_table *textures;
} glint_upload_inputs;

// What the scene takes on the device, for glint_contents_check: asked before the long work begins.
// The tree is not built yet, so the least that its triangles can take is counted.
#define GLINT_GEOMETRY_CONTENTS 7
void glint_geometry_measure(const glint_scene *scene, const glint_plan *plan,
                            glint_content contents[GLINT_GEOMETRY_CONTENTS]);

// The tree and the materials. Errors: GLINT_DEVICE_FAILED; *memory is then empty.
glint_status glint_geometry_upload(const glint_upload_inputs *inputs, glint_geometry_memory *memory,
                                   glint_error *error);
void glint_geometry_memory_free(glint_geometry_memory *memory);

// Frees the buffers and gives the tree the arrays back that were taken over.
void glint_geometry_take_back(glint_geometry_memory *memory, glint_bvh *bvh);

// The environment's texels as the plan wants them. Errors likewise.
glint_status glint_environment_upload(const struct glint_device *device, const glint_plan *plan,
                                      const glint_cube *environment, glint_shared_buffer *texels,
                                      glint_error *error);

#endif
