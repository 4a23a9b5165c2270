// Moves a camera so that a scene fills its frame.
#ifndef GLINT_SCENE_FIT_H
#define GLINT_SCENE_FIT_H

#include "scene/camera.h"
#include "scene/scene.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// The content of the frame.
typedef struct glint_fit {
    const glint_scene *scene; // its vertices must be in the frame
    bool as_box; // instead: the corners of the box from `low` to `high` must be in the frame
    glint_vec3 low, high; // metres, world space
    // The content turns about the vertical axis through the box's centre; all it sweeps must be in
    // the frame.
    bool turns;
    double aspect; // width of the frame over its height
    double margin; // part of half the frame to leave free at each edge, in [0, 1)
} glint_fit;

// Moves the camera without turning it, so that every point is in the frame. The outermost points
// lie on two opposite edges (or on the margin before them). The planes of the other two edges are
// equally far from the points. A perspective camera keeps its angle. It stays at least a hundredth
// of the box's radius away from every point, so a spike that points at it may not reach the edges.
// An orthographic camera gets another height and stands one radius before the points. Without
// points the camera stays.
void glint_camera_fit(const glint_fit *fit, glint_camera *camera);

#ifdef __cplusplus
}
#endif

#endif
