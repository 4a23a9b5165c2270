// Samples keyframes. See curve.h.
#include "scene/gltf/curve.h"

#include <float.h>
#include <math.h>
#include <string.h>

// Returns a key's value; `part` −1 and 1 give its in-tangent and out-tangent.
static const double *key_value(const glint_curve *curve, size_t key, int part)
{
    const size_t components = curve->components;
    return curve->interpolation == GLINT_INTERPOLATION_CUBIC
               ? curve->values + (3 * key + (size_t)(1 + part)) * components
               : curve->values + key * components;
}

static double length4(const double q[4])
{
    return sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
}

// Scales to unit length. Returns false if that is impossible.
static bool normalize4(double q[4])
{
    const double length = length4(q);
    if (!(length > 0) || !isfinite(length)) {
        return false;
    }
    for (int k = 0; k < 4; k++) {
        q[k] /= length;
    }
    return true;
}

// Interpolates between two unit quaternions. q and −q are the same rotation; takes the nearer of
// the two. The angle comes from the sum and the difference, because the cosine alone is inexact for
// small angles.
static void slerp(const double *from, const double *to, double share, double *result)
{
    double a[4], b[4], sum[4], difference[4], dot = 0;
    memcpy(a, from, sizeof a);
    memcpy(b, to, sizeof b);
    normalize4(a);
    normalize4(b);
    for (int k = 0; k < 4; k++) {
        dot += a[k] * b[k];
    }
    for (int k = 0; k < 4; k++) {
        b[k] = dot < 0 ? -b[k] : b[k];
        sum[k] = a[k] + b[k];
        difference[k] = b[k] - a[k];
    }
    const double angle = 2 * atan2(length4(difference), length4(sum)); // at most a right angle
    const double sine = sin(angle);
    const double of_a = sine > 0 ? sin((1 - share) * angle) / sine : 1 - share;
    const double of_b = sine > 0 ? sin(share * angle) / sine : share;
    for (int k = 0; k < 4; k++) {
        result[k] = of_a * a[k] + of_b * b[k];
    }
    normalize4(result);
}

static void spline(const glint_curve *curve, size_t key, double share, double seconds,
                   double *result)
{
    const double *from = key_value(curve, key, 0), *leaving = key_value(curve, key, 1);
    const double *to = key_value(curve, key + 1, 0), *arriving = key_value(curve, key + 1, -1);
    const double s2 = share * share, s3 = s2 * share;
    const double of_from = 2 * s3 - 3 * s2 + 1, of_leaving = (s3 - 2 * s2 + share) * seconds;
    const double of_to = 3 * s2 - 2 * s3, of_arriving = (s3 - s2) * seconds;
    for (size_t k = 0; k < curve->components; k++) {
        result[k] =
            of_from * from[k] + of_leaving * leaving[k] + of_to * to[k] + of_arriving * arriving[k];
    }
    if (curve->is_rotation && !normalize4(result)) {
        memcpy(result, from, 4 * sizeof *result); // a spline that passes through 0 is no rotation
        normalize4(result);
    }
}

static void take_key(const glint_curve *curve, size_t key, double *value)
{
    memcpy(value, key_value(curve, key, 0), curve->components * sizeof *value);
    if (curve->is_rotation) {
        normalize4(value);
    }
}

// Returns the last key at or before `time`, which lies between the first and the last key.
static size_t find_key(const glint_curve *curve, double time)
{
    size_t low = 0, high = curve->key_count - 1;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        *(curve->times[middle] <= time ? &low : &high) = middle;
    }
    return low;
}

void glint_curve_sample(const glint_curve *curve, double exact_time, double *value)
{
    const double *times = curve->times;
    const double time = exact_time * (1 + 2 * (double)FLT_EPSILON);
    const size_t last = curve->key_count - 1;
    if (time >= times[last]) {
        take_key(curve, last, value);
        return;
    }
    if (!(time > times[0])) {
        // Several keys may have the first time.
        take_key(curve, time == times[0] ? find_key(curve, time) : 0, value);
        return;
    }
    const size_t key = find_key(curve, time);
    const double seconds = times[key + 1] - times[key];
    const double share = fmax(0, (exact_time - times[key]) / seconds);
    if (curve->interpolation == GLINT_INTERPOLATION_STEP) {
        take_key(curve, key, value);
    } else if (curve->interpolation == GLINT_INTERPOLATION_CUBIC) {
        spline(curve, key, share, seconds, value);
    } else if (curve->is_rotation) {
        slerp(key_value(curve, key, 0), key_value(curve, key + 1, 0), share, value);
    } else {
        const double *from = key_value(curve, key, 0), *to = key_value(curve, key + 1, 0);
        for (size_t k = 0; k < curve->components; k++) {
            value[k] = from[k] + share * (to[k] - from[k]);
        }
    }
}

bool glint_curve_moves(const glint_curve *curve)
{
    const size_t components = curve->components;
    for (size_t key = 1; key < curve->key_count; key++) {
        if (memcmp(key_value(curve, key, 0), key_value(curve, 0, 0), components * sizeof(double)) !=
            0) {
            return true;
        }
    }
    if (curve->interpolation != GLINT_INTERPOLATION_CUBIC) {
        return false;
    }
    for (size_t key = 0; curve->key_count > 1 && key < curve->key_count; key++) {
        for (size_t k = 0; k < components; k++) {
            if (key_value(curve, key, -1)[k] != 0 || key_value(curve, key, 1)[k] != 0) {
                return true;
            }
        }
    }
    return false;
}
