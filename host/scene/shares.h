// How much of a picture shows which material.
#ifndef GLINT_SCENE_SHARES_H
#define GLINT_SCENE_SHARES_H

#include "scene/scene.h"

#include <stdbool.h>

// Sets shares[scene->material_count] to the parts of the picture, each in [0, 1], in which a
// material is the first that is met: what is seen in mirrors or through glass counts for these. A
// few thousand rays are looked at. `aspect`: the picture's width over its height. False where that
// would take seconds, or memory is short: the shares are then not to be used.
bool glint_material_shares(const glint_scene *scene, const glint_camera *camera, double aspect,
                           double *shares);

#endif
