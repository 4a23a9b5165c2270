// Which node and which material of the file the triangles of a scene belong to: layers name them by
// their indices in the file, which stay the same over an animation.
#ifndef GLINT_RENDER_OWNERS_H
#define GLINT_RENDER_OWNERS_H

#include "base/status.h"
#include "scene/scene.h"

#include <stddef.h>

// From `first_triangle` on, to the next owner's.
typedef struct glint_owner {
    size_t first_triangle;
    int node, material; // −1: none
} glint_owner;

// Zero is valid: no triangle has an owner.
typedef struct glint_owners {
    glint_owner *list; // ordered by their triangles
    size_t count;
} glint_owners;

// Copies what the layers need of a scene, into *owners, which may hold another's. Errors:
// GLINT_OUT_OF_MEMORY.
glint_status glint_owners_set(glint_owners *owners, const glint_scene *scene, glint_error *error);

// The owner of the triangle of that number in the scene; of −1, and of one without, {0, −1, −1}.
glint_owner glint_owner_of(const glint_owners *owners, int triangle);

void glint_owners_free(glint_owners *owners);

#endif
