// Blends the matrices of a skin's joints for a vertex. See joints.h.
#include "scene/gltf/joints.h"

#include <math.h>

// Sums differ from 1 at most so much by rounding: eight weights in bytes err by 1/510 each.
static const double sum_tolerance = 8.0 / 510;

enum { INFLUENCES = 4 }; // of a set

typedef struct influence {
    double weight, joint;
} influence;

static void read_set(const glint_influences *from, size_t vertex, influence set[INFLUENCES])
{
    double joints[INFLUENCES], weights[INFLUENCES];
    glint_array_numbers(&from->joints, vertex, INFLUENCES, joints);
    glint_array_numbers(&from->weights, vertex, INFLUENCES, weights);
    for (size_t k = 0; k < INFLUENCES; k++) {
        set[k] = (influence){weights[k], joints[k]};
    }
}

static glint_weighting judge(const influence *one, size_t joint_count)
{
    if (!(one->weight >= 0) || isinf(one->weight)) {
        return GLINT_WEIGHTS_FAULTY;
    }
    return one->weight > 0 && !(one->joint < (double)joint_count) ? GLINT_JOINT_FAULTY
                                                                  : GLINT_WEIGHTS_GOOD;
}

static void add_scaled(const glint_mat4 *matrix, double weight, glint_mat4 *sum)
{
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 4; column++) {
            sum->m[row][column] += weight * matrix->m[row][column];
        }
    }
}

glint_weighting glint_joints_blend(const glint_influence_sets *from, size_t vertex,
                                   const glint_bones *bones, glint_mat4 *blend)
{
    double total = 0;
    glint_mat4 sum = {{{0}}};
    influence set[INFLUENCES];
    for (size_t s = 0; s < from->count; s++) {
        read_set(&from->sets[s], vertex, set);
        for (int k = 0; k < INFLUENCES; k++) {
            const glint_weighting judged = judge(&set[k], bones->count);
            if (glint_weighting_is_fault(judged)) {
                return judged;
            }
            if (set[k].weight > 0) {
                total += set[k].weight;
                add_scaled(&bones->matrices[(size_t)set[k].joint], set[k].weight, &sum);
            }
        }
    }
    if (!(total > 0)) {
        read_set(&from->sets[0], vertex, set);
        if (!(set[0].joint < (double)bones->count)) {
            return GLINT_JOINT_FAULTY;
        }
        *blend = bones->matrices[(size_t)set[0].joint];
        return GLINT_WEIGHTS_NONE;
    }
    *blend = glint_mat4_identity;
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 4; column++) {
            blend->m[row][column] = sum.m[row][column] / total;
        }
    }
    return fabs(total - 1) > sum_tolerance ? GLINT_WEIGHTS_NOT_ONE : GLINT_WEIGHTS_GOOD;
}

glint_status glint_joints_refuse(const glint_influence_sets *from, size_t vertex,
                                 size_t joint_count, const char *primitive, glint_error *error)
{
    influence set[INFLUENCES];
    read_set(&from->sets[0], vertex, set);
    size_t faulty_set = 0;
    double joint = set[0].joint; // counts if all weights are 0
    for (size_t s = 0; s < from->count; s++) {
        read_set(&from->sets[s], vertex, set);
        for (int k = 0; k < INFLUENCES; k++) {
            const glint_weighting judged = judge(&set[k], joint_count);
            if (judged == GLINT_WEIGHTS_FAULTY) {
                return glint_fail(error, GLINT_BAD_INPUT,
                                  "%s.attributes.WEIGHTS_%zu: vertex %zu has a weight of %.9g "
                                  "(weights must be finite and not negative)",
                                  primitive, s, vertex, set[k].weight);
            }
            if (judged == GLINT_JOINT_FAULTY) {
                faulty_set = s;
                joint = set[k].joint;
            }
        }
    }
    return glint_fail(error, GLINT_BAD_INPUT,
                      "%s.attributes.JOINTS_%zu: vertex %zu follows joint %.9g (the skin has %zu "
                      "joint%s)",
                      primitive, faulty_set, vertex, joint, joint_count,
                      joint_count == 1 ? "" : "s");
}
