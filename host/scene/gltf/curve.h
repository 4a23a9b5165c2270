// Samples the animation of a node's property: glTF's keyframes and the values between them.
#ifndef GLINT_SCENE_GLTF_CURVE_H
#define GLINT_SCENE_GLTF_CURVE_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum glint_interpolation {
    GLINT_INTERPOLATION_LINEAR, // rotations along the shorter arc, at a steady rate
    GLINT_INTERPOLATION_STEP,   // each key's value holds until the next key
    GLINT_INTERPOLATION_CUBIC,  // Hermite's spline through the keys with their tangents
} glint_interpolation;

// Borrows its arrays.
typedef struct glint_curve {
    glint_interpolation interpolation;
    bool is_rotation;     // values are quaternions (x, y, z, w) of any length but 0
    size_t components;    // numbers per value: 4 for a rotation, 3 for other vectors, one per morph
                          // target
    size_t key_count;     // at least 1
    const double *times;  // [key_count], seconds, ascending
    const double *values; // [key_count][components]; CUBIC: [key_count][in-tangent, value,
                          // out-tangent][components], tangents per second
} glint_curve;

// Computes the value at a time: `components` numbers; for a rotation, a unit quaternion. Before the
// first key the first value holds, after the last key the last value. Times in files are floats. A
// time that is earlier than a key by at most a float's rounding counts as the key's time. Otherwise
// a STEP meant for frame n would come at frame n + 1 if its time is rounded up.
void glint_curve_sample(const glint_curve *curve, double time, double *value);

// True if the value ever changes.
bool glint_curve_moves(const glint_curve *curve);

#ifdef __cplusplus
}
#endif

#endif
