// Scenes by formula for the self-test. All have shading normals and the same list of materials, so
// that one set of compiled kernels serves them all.
#ifndef GLINT_SELFTEST_SHAPES_H
#define GLINT_SELFTEST_SHAPES_H

#include "base/random.h"
#include "base/status.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>

// What surfaces are made of. Two lossless solids, so that one can be inside the other.
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

// A scene on its way. Where memory ran out shape_end says so, and nobody else need.
typedef struct shape {
    glint_scene scene;
    double *exact; // the positions before they are rounded
    size_t capacity;
    bool failed;
} shape;

shape shape_begin(void);

// Adds a triangle, counter-clockwise seen from outside; positions round to float. `normals` NULL,
// or a vertex's (0, 0, 0): the geometric normal serves.
void shape_add(shape *s, const double corners[3][3], const double normals[3][3],
               shape_material material);

// Corners in their order around, counter-clockwise seen from outside.
void shape_add_quad(shape *s, const double corners[4][3], shape_material material);

// Each face is divided into `parts` × `parts` quads.
typedef struct shape_box {
    const double *low, *high; // [3]
    int parts;
    shape_material material;
    bool inward; // a room, whose walls face its inside
} shape_box;

void shape_add_box(shape *s, const shape_box *box);

typedef double shape_radius(const double direction[3]);

// An icosahedron whose triangles are quartered `level` times, its vertices at the radius that
// `radius` says for their direction, or NULL: 1; times `size`, about `centre`.
typedef struct shape_ball {
    const double *centre; // [3]
    double size;
    int level;
    shape_material material;
    bool smooth; // with the vertices' directions as normals
    shape_radius *radius;
} shape_ball;

void shape_add_ball(shape *s, const shape_ball *ball);

// Ends the scene: with unit 1, so that stored coordinates are those that were given (all within
// [−1, 1]); or with another power of two, by which stored ones are multiplied.
glint_status shape_end(shape *s, glint_scene *scene, glint_error *error);
glint_status shape_end_with_unit(shape *s, double unit, glint_scene *scene, glint_error *error);

// The same of a scene that may have small parts, as loaders find them (scene/parts.h). *exact is
// where its corners are, [triangle][3][3] in stored coordinates: for free(), whatever the outcome;
// `exact` may be NULL.
glint_status shape_end_with_parts(shape *s, double unit, glint_scene *scene, double **exact,
                                  glint_error *error);

// Gives a scene without lights these.
glint_status shape_set_lights(const glint_punctual_light *lights, size_t count, glint_scene *scene,
                              glint_error *error);

// A camera at `eye` that looks at `target`; yfov in radians, or 0: orthographic with `ymag`, half
// the height of what it sees, in metres.
glint_camera shape_camera(const double eye[3], const double target[3], double yfov, double ymag);

#endif
