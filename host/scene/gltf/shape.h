// Shapes: primitives at one time, morphed by their targets and then skinned. Flattening asks here
// for positions and normals that are not the file's own.
#ifndef GLINT_SCENE_GLTF_SHAPE_H
#define GLINT_SCENE_GLTF_SHAPE_H

#include "scene/gltf/bounds.h"
#include "scene/gltf/primitive.h"
#include "scene/gltf/tally.h"

typedef struct glint_shape {
    const glint_primitive *primitive; // borrowed
    glint_morph morph;
    // The joints' matrices, borrowed; NULL: none. If there are some, positions are in world space,
    // so that the node's own place does not count.
    const glint_bones *bones;
    // If most vertices belong to no triangle, each corner has an element of its own. So the number
    // of triangles limits time and memory.
    bool is_per_corner;
    // [element], set by glint_shapes_deform; owned. Normals have any length. NULL: as in the file.
    glint_vec3 *positions, *normals;
    signed char *orientations; // −1: mirrored, 0: flattened, 1: neither; NULL: no joints
    // For those who ask: whether it is drawn, and its box, empty until it is known.
    bool is_drawn;
    glint_bounds box;
} glint_shape;

// `weights` are those of the primitive's targets. `bones` may be NULL, and serve only a primitive
// with influences. Returns false if memory is short.
bool glint_shape_init(glint_shape *shape, const glint_primitive *primitive, const double *weights,
                      size_t weight_count, const glint_bones *bones);

// False if positions and normals are the file's: then there is nothing to compute.
static inline bool glint_shape_deforms(const glint_shape *shape)
{
    return shape->bones != NULL || shape->morph.counts[GLINT_MORPH_POSITION] > 0 ||
           shape->morph.counts[GLINT_MORPH_NORMAL] > 0;
}

// Returns the element at corner c of triangle t.
static inline size_t glint_shape_element(const glint_shape *shape, size_t t, size_t c)
{
    return shape->is_per_corner ? 3 * t + c : glint_primitive_vertex(shape->primitive, t, c);
}

// True if the joints turn the triangle inside out, by the majority of its corners.
bool glint_shape_is_mirrored(const glint_shape *shape, size_t t);

// The approximate number of vectors that deforming reads and adds.
double glint_shape_cost(const glint_shape *shape);

// Computes the shapes on all cores. Each vertex is computed by itself in double precision, so the
// number of threads does not change the result. Repairs and tallies weights that do not sum to 1.
// Errors: GLINT_BAD_INPUT for faulty influences and for too much work, GLINT_OUT_OF_MEMORY.
glint_status glint_shapes_deform(glint_shape *const *shapes, size_t count, bool with_normals,
                                 glint_tally *tally, glint_error *error);

void glint_shape_free(glint_shape *shape);

#endif
