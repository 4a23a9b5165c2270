// Estimates how much of a picture each material fills.
#ifndef GLINT_SCENE_SHAPE_SHARES_H
#define GLINT_SCENE_SHAPE_SHARES_H

#include "scene/scene.h"

#include <stdbool.h>

// Sets shares[scene->material_count] to the share of the picture, in [0, 1], where a material is
// the first surface that a ray meets. Surfaces seen in mirrors or through glass do not count; the
// mirror or the glass counts. Traces a few thousand rays. `aspect`: the picture's width over its
// height. Returns false if this would take seconds, or if memory is short: do not use the shares
// then.
bool glint_material_shares(const glint_scene *scene, const glint_camera *camera, double aspect,
                           double *shares);

#endif
