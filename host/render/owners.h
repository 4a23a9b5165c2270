// Finds the node and the material in the file that a triangle belongs to. Layers name them by their
// indices in the file, which stay the same during an animation.
#ifndef GLINT_RENDER_OWNERS_H
#define GLINT_RENDER_OWNERS_H

#include "base/status.h"
#include "scene/scene.h"

#include <stddef.h>

// The owner of the triangles from `first_triangle` up to the next owner's first triangle.
typedef struct glint_owner {
    size_t first_triangle;
    int node, material; // −1: none
} glint_owner;

// Zero is valid: no triangle has an owner.
typedef struct glint_owners {
    glint_owner *list; // ordered by their triangles
    size_t count;
} glint_owners;

// Copies the owners of a scene to *owners, and replaces earlier ones. Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_owners_set(glint_owners *owners, const glint_scene *scene, glint_error *error);

// The owner of triangle number `triangle` in the scene. For −1 and for a triangle without an owner:
// {0, −1, −1}.
glint_owner glint_owner_of(const glint_owners *owners, int triangle);

void glint_owners_free(glint_owners *owners);

#endif
