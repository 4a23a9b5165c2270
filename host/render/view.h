// Computes from a camera the values for the kernel's primary rays.
#ifndef GLINT_RENDER_VIEW_H
#define GLINT_RENDER_VIEW_H

#include "kernels/layout.h"
#include "render/plan.h"
#include "scene/scene.h"

// The data of a scene that convert positions to stored coordinates.
typedef struct glint_stored_space {
    glint_vec3 origin;    // metres
    double unit;          // metres per stored unit
    glint_vec3 low, high; // bounds, metres; low > high: no triangles
} glint_stored_space;

glint_stored_space glint_stored_space_of(const glint_scene *scene);

// Fills the part of the record that the plan decides: the features that a general kernel uses, the
// stack of media, depth and cells.
void glint_view_set_plan(const glint_plan *plan, glint_frame_record *record);

// Fills the part of the record for camera, settings and plan. The caller sets the edges of the
// maps.
void glint_view_record(const glint_stored_space *space, const glint_camera *camera,
                       const glint_settings *settings, const glint_plan *plan,
                       glint_frame_record *record);

// True if all rays begin outside the scene's bounds.
bool glint_view_is_outside(const glint_stored_space *space, const glint_camera *camera);

// Adapts the plan to the camera: decides INSIDE, and uses the proof about the scene if it holds for
// the camera.
void glint_plan_suit(glint_plan *plan, const glint_stored_space *space, const glint_camera *camera);

// Fills the proxy's part. Kernels never read a proxy of kind NONE.
void glint_view_set_proxy(const glint_stored_space *space, const glint_proxy *proxy,
                          glint_frame_record *record);

#endif
