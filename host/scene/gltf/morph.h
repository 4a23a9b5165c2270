// Adds morph targets to a primitive's attributes.
#ifndef GLINT_SCENE_GLTF_MORPH_H
#define GLINT_SCENE_GLTF_MORPH_H

#include "scene/gltf/array.h"

// The attributes that targets move: vectors of three components.
typedef enum glint_morph_attribute {
    GLINT_MORPH_POSITION,
    GLINT_MORPH_NORMAL,
    GLINT_MORPH_ATTRIBUTES
} glint_morph_attribute;

// The deltas of a target for each attribute, at weight 1. An array without elements: no deltas.
typedef struct glint_morph_target {
    glint_array of[GLINT_MORPH_ATTRIBUTES];
} glint_morph_target;

// A target that counts, with its weight.
typedef struct glint_morph_part {
    double weight;
    const glint_array *deltas; // borrowed
} glint_morph_part;

// A sum of targets times their weights. Targets of weight 0 cost nothing. Zero is valid: nothing
// moves.
typedef struct glint_morph {
    glint_morph_part *parts[GLINT_MORPH_ATTRIBUTES]; // the first one is owned and holds them all
    size_t counts[GLINT_MORPH_ATTRIBUTES];
} glint_morph;

// Ignores weights past the last target; missing weights are 0. Borrows the targets. Returns false
// if memory is short.
bool glint_morph_init(glint_morph *morph, const glint_morph_target *targets, size_t target_count,
                      const double *weights, size_t weight_count);

// Adds the deltas to the three components of a vertex.
void glint_morph_add(const glint_morph *morph, glint_morph_attribute attribute, size_t vertex,
                     double *components);

void glint_morph_free(glint_morph *morph);

#endif
