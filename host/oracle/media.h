// Tracks the solids that a path is inside (rule 5). Internal to the oracle.
#ifndef GLINT_ORACLE_MEDIA_H
#define GLINT_ORACLE_MEDIA_H

#include "oracle/oracle.h"

#include <string.h>

// A stack of materials, innermost last. A path meets at most ORACLE_DEPTH_LIMIT surfaces and enters
// at most one solid at each. One more entry is for the solid in which it began.
typedef struct media {
    int solid[ORACLE_DEPTH_LIMIT + 1];
    int count;
} media;

// The material of the innermost solid. NULL: empty space.
static inline const oracle_material *top_material(const oracle_scene *scene, const media *inside)
{
    return inside->count > 0 ? &scene->materials[inside->solid[inside->count - 1]] : NULL;
}

static inline void media_enter(media *inside, int material)
{
    if (inside->count <= ORACLE_DEPTH_LIMIT)
        inside->solid[inside->count++] = material;
}

// The media of a path inside one solid; −1: inside none.
static inline media media_of(int material)
{
    media inside = {.count = 0};
    if (material >= 0)
        media_enter(&inside, material);
    return inside;
}

// Removes the topmost entry of the material if there is one.
static inline void media_leave(media *inside, int material)
{
    for (int i = inside->count - 1; i >= 0; i--) {
        if (inside->solid[i] != material)
            continue;
        size_t above = (size_t)(inside->count - 1 - i);
        memmove(&inside->solid[i], &inside->solid[i + 1], above * sizeof(int));
        inside->count--;
        return;
    }
}

#endif
