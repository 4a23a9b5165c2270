// Computes the bounds of a moving scene over its whole clip.
#ifndef GLINT_SCENE_GLTF_SWEEP_H
#define GLINT_SCENE_GLTF_SWEEP_H

#include "scene/gltf/bounds.h"
#include "scene/gltf/load.h"

// Sets the bounds of everything drawn at any time, from the corners of the primitives' boxes. It
// evaluates nodes at rest once, and moving nodes at each key. Errors: GLINT_BAD_INPUT,
// GLINT_OUT_OF_MEMORY.
glint_status glint_sweep(const glint_load *load, glint_bounds *bounds, glint_error *error);

#endif
