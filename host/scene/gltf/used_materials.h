// The materials of drawn primitives.
#ifndef GLINT_SCENE_GLTF_USED_MATERIALS_H
#define GLINT_SCENE_GLTF_USED_MATERIALS_H

#include "scene/gltf/load.h"

// Takes the materials of the chosen nodes' primitives, applies the overrides of `options`, and
// reads the images that the materials then need. Leaves out textures that cannot be shown, and
// tallies them. Errors: GLINT_BAD_INPUT, GLINT_OUT_OF_MEMORY.
glint_status glint_materials_take(glint_load *load, const glint_scene_options *options,
                                  glint_error *error);

// Gives a flattened scene the materials that its triangles use, in the order of the file, the
// default one last. So glint compiles nothing for other materials and does not warn of them.
// Tallies features of the used materials that glint does not model. Fails with GLINT_OUT_OF_MEMORY.
glint_status glint_materials_give(glint_load *load, glint_scene *scene, glint_error *error);

#endif
