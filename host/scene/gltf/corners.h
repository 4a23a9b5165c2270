// The corners of drawn triangles.
#ifndef GLINT_SCENE_GLTF_CORNERS_H
#define GLINT_SCENE_GLTF_CORNERS_H

#include "scene/gltf/load.h"

typedef struct glint_corner {
    size_t vertex;
    size_t element; // of the draw's shape, if there is one
    glint_vec3 local;
} glint_corner;

typedef struct glint_corners {
    glint_corner of[3]; // in stored order
    size_t triangle;    // of the draw
} glint_corners;

// True if the triangle is stored with the other winding: its node mirrors it, or its joints turn it
// inside out, but not both.
static inline bool glint_draw_winds_back(const glint_draw *draw, size_t t)
{
    const bool is_inside_out = draw->shape != NULL && glint_shape_is_mirrored(draw->shape, t);
    return (glint_mat4_determinant3(&draw->to_world) < 0) != is_inside_out;
}

// A vertex as the file has it.
static inline glint_corner glint_draw_vertex(const glint_draw *draw, size_t vertex)
{
    double p[3];
    glint_array_numbers(&draw->primitive->positions, vertex, 3, p);
    return (glint_corner){vertex, 0, {p[0], p[1], p[2]}};
}

static inline glint_corner glint_draw_corner(const glint_draw *draw, size_t t, size_t c)
{
    const size_t vertex = glint_primitive_vertex(draw->primitive, t, c);
    if (draw->shape != NULL) {
        const size_t element = glint_shape_element(draw->shape, t, c);
        return (glint_corner){vertex, element, draw->shape->positions[element]};
    }
    return glint_draw_vertex(draw, vertex);
}

static inline glint_corners glint_draw_corners(const glint_draw *draw, size_t t, bool winds_back)
{
    return (glint_corners){{glint_draw_corner(draw, t, 0),
                            glint_draw_corner(draw, t, winds_back ? 2 : 1),
                            glint_draw_corner(draw, t, winds_back ? 1 : 2)},
                           t};
}

static inline bool glint_corners_equal(glint_vec3 a, glint_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

// True if two corners are at one place. Such a triangle is degenerate under every transform and
// must not stretch the bounds.
static inline bool glint_corners_are_collapsed(const glint_corners *corners)
{
    const glint_corner *c = corners->of;
    return glint_corners_equal(c[0].local, c[1].local) ||
           glint_corners_equal(c[1].local, c[2].local) ||
           glint_corners_equal(c[2].local, c[0].local);
}

#endif
