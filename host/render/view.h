// From a camera to the values that the kernel makes primary rays of.
#ifndef GLINT_RENDER_VIEW_H
#define GLINT_RENDER_VIEW_H

#include "kernels/layout.h"
#include "render/plan.h"
#include "scene/scene.h"

// What placing rays in stored coordinates needs of a scene.
typedef struct glint_stored_space {
    glint_vec3 origin;    // metres
    double unit;          // metres per stored unit
    glint_vec3 low, high; // bounds, metres; low > high: no triangles
} glint_stored_space;

glint_stored_space glint_stored_space_of(const glint_scene *scene);

// Fills the camera's and the settings' part of the record; the edges of the maps are the caller's.
void glint_view_record(const glint_stored_space *space, const glint_camera *camera,
                       const glint_settings *settings, const glint_plan *plan,
                       glint_frame_record *record);

// Whether all rays begin outside of the scene's bounds.
bool glint_view_is_outside(const glint_stored_space *space, const glint_camera *camera);

// Makes the plan heed its sight if that holds for the camera.
void glint_plan_suit(glint_plan *plan, const glint_stored_space *space, const glint_camera *camera);

// Fills the proxy's part; one of kind NONE is never read.
void glint_view_set_proxy(const glint_stored_space *space, const glint_proxy *proxy,
                          glint_frame_record *record);

#endif
