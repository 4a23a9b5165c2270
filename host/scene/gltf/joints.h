// Blends the matrices of a skin's joints for a vertex.
#ifndef GLINT_SCENE_GLTF_JOINTS_H
#define GLINT_SCENE_GLTF_JOINTS_H

#include "base/status.h"
#include "base/vector.h"
#include "scene/gltf/array.h"

// A set of four joints and weights per vertex; a primitive may have several sets.
typedef struct glint_influences {
    glint_array joints, weights;
} glint_influences;

// The sets of a primitive; none: no skin moves it.
typedef struct glint_influence_sets {
    const glint_influences *sets;
    size_t count;
} glint_influence_sets;

// A skin's joints at one time.
typedef struct glint_bones {
    const glint_mat4 *matrices; // [count], from the bound mesh to the world
    size_t count;
} glint_bones;

// The verdict on a vertex's weights.
typedef enum glint_weighting {
    GLINT_WEIGHTS_GOOD,
    GLINT_WEIGHTS_NOT_ONE, // the sum is not 1, beyond rounding in files: normalise
    GLINT_WEIGHTS_NONE,    // all are 0: the vertex follows the first joint that it names
    GLINT_WEIGHTS_FAULTY,  // a weight is negative, infinite or NaN: refuse
    GLINT_JOINT_FAULTY,    // a weight above 0 is for a joint that the skin lacks: refuse
    GLINT_WEIGHTINGS
} glint_weighting;

static inline bool glint_weighting_is_fault(glint_weighting weighting)
{
    return weighting >= GLINT_WEIGHTS_FAULTY;
}

// Computes the mean of the joints' matrices at a vertex, weighted by weight over the sum of
// weights. If the verdict is a fault, `blend` is not set.
glint_weighting glint_joints_blend(const glint_influence_sets *from, size_t vertex,
                                   const glint_bones *bones, glint_mat4 *blend);

// Fails with GLINT_BAD_INPUT: names the vertex's first faulty influence. `primitive` is the
// primitive's place in the file.
glint_status glint_joints_refuse(const glint_influence_sets *from, size_t vertex,
                                 size_t joint_count, const char *primitive, glint_error *error);

#endif
