// Holds the scene on the device, and the next scene, which is prepared at the same time. Used in
// this folder only.
#ifndef GLINT_RENDER_DEVICE_SCENE_H
#define GLINT_RENDER_DEVICE_SCENE_H

#include "base/status.h"
#include "device/buffer.h"
#include "render/owners.h"
#include "render/prepared_scene.h"
#include "render/upload.h"
#include "render/view.h"

#include <stdbool.h>
#include <stddef.h>

// Zero is valid: no scene.
typedef struct glint_device_scene {
    const struct glint_device *device; // borrowed
    glint_prepared_scene shown;        // the scene that frames show
    glint_prepared_scene next;         // the next scene; its tree is refitted from the tree of the
                                       // scene before `shown`
    bool next_is_ready;                // set and read by the caller that prepares it
    glint_stored_space space;
    glint_owners owners;
    glint_geometry_memory geometry;
    glint_texture_memory textures;
    cl_mem vertices; // the results of shading at vertices
    double upload_ms;
} glint_device_scene;

// Takes the tree of the shown scene back from the device, so that it can be refitted.
void glint_device_scene_take_back(glint_device_scene *s);

// Makes the prepared scene the shown scene. The tree of the old scene is refitted next.
void glint_device_scene_swap(glint_device_scene *s);

// Uploads `shown`, which was prepared from `scene`. Errors: GLINT_DEVICE_FAILED,
// GLINT_OUT_OF_MEMORY.
glint_status glint_device_scene_upload(glint_device_scene *s, const glint_scene *scene,
                                       glint_error *error);

size_t glint_device_scene_bytes(const glint_device_scene *s); // without tree and vertices
size_t glint_device_scene_tree_bytes(const glint_device_scene *s);

void glint_device_scene_free(glint_device_scene *s);

#endif
