// Cuts the meshes of a scene into more instances, as files store one body in several primitives.
#ifndef GLINT_TESTS_SUPPORT_CUT_H
#define GLINT_TESTS_SUPPORT_CUT_H

#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct cut {
    int pieces;     // of each instance, at most
    bool scattered; // triangles fall into pieces at random, in any order; else in runs
    bool recolored; // each piece has a material of its own, a copy
} cut;

// Makes a scene of the same triangles, without names and textures, and with the first camera alone.
// Sets *origin to the scene's number of each triangle; NULL is allowed. The caller frees both.
glint_scene cut_scene(const glint_scene *scene, const cut *how, uint64_t seed, size_t **origin);

#endif
