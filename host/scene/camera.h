// The camera: the origin and directions of primary rays.
#ifndef GLINT_SCENE_CAMERA_H
#define GLINT_SCENE_CAMERA_H

#include "base/vector.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// right, up and back are orthonormal and right-handed (right × up = back) in world space; the
// camera looks along −back. The node's scale is ignored. Near and far planes do not clip.
typedef struct glint_camera {
    char *name;        // the node's name, else the camera's, else NULL; owned
    bool is_lost;      // its node has no direction at this time of an animation: do not use it
    bool orthographic; // otherwise it is perspective
    double yfov;       // perspective: the full vertical angle, radians, in (0, π)
    double ymag;       // orthographic: half the vertical extent, metres, > 0
    glint_vec3 eye;    // metres, world space
    glint_vec3 right, up, back;
} glint_camera;

// Makes the camera at a node whose global transform is `to_world`, with orthonormal axes. The
// forward axis is kept, up is made perpendicular to it, and right follows. Returns false if the
// axes cannot be made orthonormal (singular or not finite).
bool glint_camera_from_matrix(const glint_mat4 *to_world, glint_camera *camera);

// Makes a camera that frames the box from `low` to `high` (metres, world space). The camera is
// perspective, 40°, and looks from the front, a little from the right and from above. Its distance
// makes the bounding sphere fit an aspect of 1:1. If the box has no extent or is empty (low >
// high), the camera stands at +Z and looks at its centre or the origin.
void glint_camera_frame_bounds(glint_vec3 low, glint_vec3 high, glint_camera *camera);

// Sets the camera's axes at `eye`, looking at `target`, with `up` in the upper half of the picture.
// Its kind and angle stay. Returns false and changes nothing if eye and target are the same place,
// or up is zero or along the view.
bool glint_camera_look(glint_vec3 eye, glint_vec3 target, glint_vec3 up, glint_camera *camera);

// Moves the camera to `elevation` radians (−π/2 to π/2) above the horizon of `centre` and turns it
// towards `centre`. The compass direction and the distance stay.
void glint_camera_raise(glint_vec3 centre, double elevation, glint_camera *camera);

// Returns the camera turned about the vertical axis through `centre` (metres) by step/steps of a
// full turn. The turn is counter-clockwise seen from above (from +Z towards +X); any step, steps >
// 0. Quarter turns are exact; full turns return the camera itself. The result borrows the camera's
// name.
glint_camera glint_camera_orbit(const glint_camera *camera, glint_vec3 centre, int64_t step,
                                int64_t steps);

#ifdef __cplusplus
}
#endif

#endif
