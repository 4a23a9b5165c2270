// Adds morph targets to a primitive's attributes. See morph.h.
#include "scene/gltf/morph.h"

#include "base/memory.h"

#include <stdlib.h>

bool glint_morph_init(glint_morph *morph, const glint_morph_target *targets, size_t target_count,
                      const double *weights, size_t weight_count)
{
    *morph = (glint_morph){0};
    const size_t count = target_count < weight_count ? target_count : weight_count;
    if (count == 0) {
        return true;
    }
    glint_morph_part *part =
        glint_allocate(count, GLINT_MORPH_ATTRIBUTES * sizeof(glint_morph_part));
    if (part == NULL) {
        return false;
    }
    for (size_t k = 0; k < GLINT_MORPH_ATTRIBUTES; k++) {
        morph->parts[k] = part;
        for (size_t i = 0; i < count; i++) {
            if (weights[i] != 0 && targets[i].of[k].count > 0) {
                *part++ = (glint_morph_part){weights[i], &targets[i].of[k]};
            }
        }
        morph->counts[k] = (size_t)(part - morph->parts[k]);
    }
    return true;
}

void glint_morph_add(const glint_morph *morph, glint_morph_attribute attribute, size_t vertex,
                     double *components)
{
    for (size_t i = 0; i < morph->counts[attribute]; i++) {
        const glint_morph_part *part = &morph->parts[attribute][i];
        double delta[3];
        glint_array_numbers(part->deltas, vertex, 3, delta);
        for (size_t k = 0; k < 3; k++) {
            components[k] += part->weight * delta[k];
        }
    }
}

void glint_morph_free(glint_morph *morph)
{
    free(morph->parts[0]);
    *morph = (glint_morph){0};
}
