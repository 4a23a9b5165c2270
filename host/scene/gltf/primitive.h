// Primitives that are ready to be drawn: their arrays are open, and their indices are checked.
#ifndef GLINT_SCENE_GLTF_PRIMITIVE_H
#define GLINT_SCENE_GLTF_PRIMITIVE_H

#include "scene/gltf/joints.h"
#include "scene/gltf/morph.h"

#include <stdio.h>

// glTF's modes of primitives.
typedef enum glint_mode {
    GLINT_MODE_POINTS = 0, // 1 to 3 are lines
    GLINT_MODE_TRIANGLES = 4,
    GLINT_MODE_STRIP = 5,
    GLINT_MODE_FAN = 6,
} glint_mode;

// Arrays without elements: the file does not have the attribute.
typedef struct glint_primitive {
    size_t mesh, number; // meshes[mesh].primitives[number]
    int mode;            // a glint_mode
    ptrdiff_t material;  // index in the file; −1: glTF's default material
    size_t triangles;    // 0 for points and lines
    size_t left_over;    // last vertices that make no whole triangle
    glint_array positions, normals, indices, tangents, colors, texcoords[2];
    size_t color_components;           // 3 or 4; 0: no colours
    const glint_morph_target *targets; // borrowed
    size_t target_count;
    glint_influence_sets influences; // borrowed; none: no skin moves the primitive
} glint_primitive;

// Large enough for a place such as meshes[3].primitives[0].
#define GLINT_PRIMITIVE_PLACE 80

// Writes the primitive's place in the file to `text` and returns it.
static inline const char *glint_primitive_place(const glint_primitive *primitive,
                                                char text[GLINT_PRIMITIVE_PLACE])
{
    (void)snprintf(text, GLINT_PRIMITIVE_PLACE, "meshes[%zu].primitives[%zu]", primitive->mesh,
                   primitive->number);
    return text;
}

// Returns the vertex at corner c of triangle t, in the mode's winding order.
static inline size_t glint_primitive_vertex(const glint_primitive *primitive, size_t t, size_t c)
{
    size_t i = 3 * t + c;
    if (primitive->mode == GLINT_MODE_STRIP) {
        // Every second triangle of a strip swaps two corners, so that all have the same winding.
        i = t + (c == 0 ? 0 : (c == 1 ? 1 + t % 2 : 2 - t % 2));
    } else if (primitive->mode == GLINT_MODE_FAN) {
        i = c == 2 ? 0 : t + 1 + c;
    }
    return primitive->indices.count > 0 ? glint_array_index(&primitive->indices, i) : i;
}

#endif
