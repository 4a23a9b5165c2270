// Finds where a scene's digits do not suffice: small parts beside surfaces whose place is known
// less exactly than the parts are large.
#ifndef GLINT_SCENE_SHAPE_DIGITS_H
#define GLINT_SCENE_SHAPE_DIGITS_H

#include "base/status.h"
#include "scene/scene.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// The places of a small part beside a surface.
typedef struct glint_coarse_places {
    size_t count;      // parts of this kind; 0: the rest is unset
    uint32_t instance; // of the first one
    double width;      // of the first one, metres
    double place; // its surfaces and those beside it are in one place if they are nearer, metres
} glint_coarse_places;

// A part is counted if its width is less than the depth of one place (GLINT_TOUCHING of the
// coordinates) on a larger surface beside it, and the camera sees it as wide as a pixel or wider.
// `camera` may be NULL: then all parts count. `height`: of the picture, in pixels. If memory is
// short, nothing is found.
glint_coarse_places glint_coarse_places_find(const glint_scene *scene, const glint_camera *camera,
                                             int height);

// Adds a warning if there are such places.
void glint_coarse_places_warn(const glint_scene *scene, const glint_camera *camera, int height,
                              glint_warnings *warnings);

#ifdef __cplusplus
}
#endif

#endif
