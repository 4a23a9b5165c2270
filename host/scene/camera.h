// The camera: where primary rays come from.
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
    bool is_lost;      // its node has no direction at this time of an animation: not to be used
    bool orthographic; // else perspective
    double yfov;       // perspective: the whole vertical angle, radians, in (0, π)
    double ymag;       // orthographic: half the vertical extent, metres, > 0
    glint_vec3 eye;    // metres, world space
    glint_vec3 right, up, back;
} glint_camera;

// The camera at a node whose global transform is `to_world`, with its axes made orthonormal: the
// forward axis is kept, up is made perpendicular to it, right follows. False if they cannot be
// (singular or not finite).
bool glint_camera_from_matrix(const glint_mat4 *to_world, glint_camera *camera);

// A camera that frames the box from `low` to `high` (metres, world space): perspective, 40°, seen
// from in front, a little from the right and from above, so that the bounding sphere fits an aspect
// of 1:1. A box without extent, or none (low > high), gives a camera at +Z that looks at its centre
// or the origin.
void glint_camera_frame_bounds(glint_vec3 low, glint_vec3 high, glint_camera *camera);

// The camera's axes at `eye`, looking at `target`, with `up` in the picture's upper half; its kind
// and angle stay. False, and nothing is changed, if eye and target are the same place, or up is
// zero or along the view.
bool glint_camera_look(glint_vec3 eye, glint_vec3 target, glint_vec3 up, glint_camera *camera);

// The camera put `elevation` radians (−π/2 to π/2) above the horizon of `centre`, which it then
// looks at. The compass direction and the distance stay.
void glint_camera_raise(glint_vec3 centre, double elevation, glint_camera *camera);

// The camera turned about the vertical axis through `centre` (metres) by step/steps of a whole
// turn, counter-clockwise seen from above (from +Z towards +X); any step, steps > 0. Quarter turns
// are exact, whole ones the camera itself. The name stays the camera's.
glint_camera glint_camera_orbit(const glint_camera *camera, glint_vec3 centre, int64_t step,
                                int64_t steps);

#ifdef __cplusplus
}
#endif

#endif
