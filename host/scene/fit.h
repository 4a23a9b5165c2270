// Moving a camera so that a scene fills its frame.
#ifndef GLINT_SCENE_FIT_H
#define GLINT_SCENE_FIT_H

#include "scene/camera.h"
#include "scene/scene.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// What is to be in the frame.
typedef struct glint_fit {
    const glint_scene *scene; // its vertices
    bool as_box;              // instead: the corners of the box from `low` to `high`
    glint_vec3 low, high;     // metres, world space
    bool turns;    // about the vertical axis through the box's centre: all that it sweeps
    double aspect; // the frame's width over its height
    double margin; // of half the frame, left free at each edge; 0 to less than 1
} glint_fit;

// Moves the camera without turning it: every point is in the frame, the outermost ones lie on two
// opposite edges (or the margin before them), and the planes of the other two edges are equally
// far. A perspective camera keeps its angle and is never nearer to a point than a hundredth of the
// box's radius, so a spike that points at it may not reach the edges. An orthographic one gets
// another height and stands one radius before the points. Without points the camera stays.
void glint_camera_fit(const glint_fit *fit, glint_camera *camera);

#ifdef __cplusplus
}
#endif

#endif
