// Makes scenes by formula for the self-test. All have shading normals and the same list of
// materials, so one set of compiled kernels serves them all.
#ifndef GLINT_SELFTEST_SHAPES_H
#define GLINT_SELFTEST_SHAPES_H

#include "base/random.h"
#include "base/status.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>

// The materials of surfaces. There are two lossless solids, so that one can be inside the other.
typedef enum shape_material {
    MATERIAL_MIRROR, // white metal
    MATERIAL_GLASS,  // clear, of index 1.5
    MATERIAL_CORE,   // clear, of index 1.25
    MATERIAL_TINTED, // metal of base colour (½, ¾, 1)
    MATERIAL_PAINT,  // white and matte
    MATERIAL_COUNT,
} shape_material;

#define SHAPE_GLASS_IOR 1.5
#define SHAPE_CORE_IOR 1.25

// A scene under construction. If memory runs out, only shape_end reports it.
typedef struct shape {
    glint_scene scene;
    double *exact; // the positions before they are rounded
    size_t capacity;
    bool failed;
} shape;

shape shape_begin(void);

// Adds a triangle, counter-clockwise seen from outside; positions round to float. If `normals` is
// NULL, or a vertex's normal is (0, 0, 0), the geometric normal is used.
void shape_add(shape *s, const double corners[3][3], const double normals[3][3],
               shape_material material);

// Adds a quad. Its corners go around, counter-clockwise seen from outside.
void shape_add_quad(shape *s, const double corners[4][3], shape_material material);

// A box whose faces are divided into `parts` × `parts` quads each.
typedef struct shape_box {
    const double *low, *high; // [3]
    int parts;
    shape_material material;
    bool inward; // a room: its walls face inwards
} shape_box;

void shape_add_box(shape *s, const shape_box *box);

typedef double shape_radius(const double direction[3]);

// An icosahedron whose triangles are quartered `level` times. A vertex is at radius(direction) ×
// size from `centre`; `radius` NULL means 1.
typedef struct shape_ball {
    const double *centre; // [3]
    double size;
    int level;
    shape_material material;
    bool smooth; // normals are the directions of the vertices
    shape_radius *radius;
} shape_ball;

void shape_add_ball(shape *s, const shape_ball *ball);

// Ends the scene. Its unit is 1, so stored coordinates are the given ones (all within [−1, 1]). Or
// the unit is another power of two, which multiplies stored coordinates.
glint_status shape_end(shape *s, glint_scene *scene, glint_error *error);
glint_status shape_end_with_unit(shape *s, double unit, glint_scene *scene, glint_error *error);

// Ends a scene that may have small parts, as loaders find them (scene/shape/parts.h). *exact gets
// its corners, [triangle][3][3] in stored coordinates. The caller frees it with free(), whatever
// the outcome. `exact` may be NULL.
glint_status shape_end_with_parts(shape *s, double unit, glint_scene *scene, double **exact,
                                  glint_error *error);

// Gives lights to a scene without lights.
glint_status shape_set_lights(const glint_punctual_light *lights, size_t count, glint_scene *scene,
                              glint_error *error);

// A camera at `eye` that looks at `target`. yfov is in radians. With yfov 0 it is orthographic, and
// `ymag` is half the height of its view in metres.
glint_camera shape_camera(const double eye[3], const double target[3], double yfov, double ymag);

#endif
