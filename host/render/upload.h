// Uploads the scene and the environment to buffers on the device.
#ifndef GLINT_RENDER_UPLOAD_H
#define GLINT_RENDER_UPLOAD_H

#include "accel/bvh.h"
#include "base/status.h"
#include "device/buffer.h"
#include "environment/environment.h"
#include "render/plan.h"
#include "render/textures.h"
#include "scene/scene.h"

// The buffers of a scene's geometry; see kernels/layout.h. Buffers that the plan does not need are
// a few bytes long, because no argument of a kernel can be left out. Zero is valid: no buffers.
typedef struct glint_geometry_memory {
    glint_shared_buffer nodes, clusters, normals, numbers; // the tree's arrays
    cl_mem materials, media, solids, attributes, lights;
} glint_geometry_memory;

// The inputs of an upload. Pointers are borrowed. A device that shares the host's memory takes over
// the tree's arrays instead of copying them, and sets the pointers to NULL.
typedef struct glint_upload_inputs {
    const struct glint_device *device;
    const glint_scene *scene;
    const glint_solids *solids;
    glint_bvh *bvh;
    const glint_plan *plan;
    const glint_texture_table *textures;
} glint_upload_inputs;

// Measures the device memory that the scene takes, for glint_contents_check before the long work
// begins. The tree is not built yet, so this is the least memory that the triangles can take.
#define GLINT_GEOMETRY_CONTENTS 7
void glint_geometry_measure(const glint_scene *scene, const glint_plan *plan,
                            glint_content contents[GLINT_GEOMETRY_CONTENTS]);

// Uploads the tree, the materials and the lights. Errors: GLINT_DEVICE_FAILED; *memory is then
// empty.
glint_status glint_geometry_upload(const glint_upload_inputs *inputs, glint_geometry_memory *memory,
                                   glint_error *error);
void glint_geometry_memory_free(glint_geometry_memory *memory);

// Frees the buffers and gives the arrays that were taken over back to the tree.
void glint_geometry_take_back(glint_geometry_memory *memory, glint_bvh *bvh);

// Uploads the environment's texels in the form that the plan needs. Errors as above.
glint_status glint_environment_upload(const struct glint_device *device, const glint_plan *plan,
                                      const glint_cube *environment, glint_shared_buffer *texels,
                                      glint_error *error);

#endif
