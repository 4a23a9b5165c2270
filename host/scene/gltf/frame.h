// Chooses a scene's origin and unit by the drawn triangles.
#ifndef GLINT_SCENE_GLTF_FRAME_H
#define GLINT_SCENE_GLTF_FRAME_H

#include "scene/gltf/load.h"

// Sets the scene's origin and unit. Sets *smallest to the width of the smallest triangle, in stored
// units. Errors: GLINT_BAD_INPUT for positions that are not finite or too far away.
glint_status glint_frame_choose(const glint_load *load, glint_scene *scene, double *smallest,
                                glint_error *error);

#endif
