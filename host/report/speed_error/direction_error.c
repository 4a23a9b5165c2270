// Measures the error of directions. See speed_error.h.
#include "report/speed_error/speed_error.h"

#include "base/memory.h"
#include "base/statistics.h"
#include "environment/environment.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float *channel(const glint_layers *layers, const char *name)
{
    for (size_t i = 0; i < layers->count; i++) {
        if (strcmp(layers->channels[i].name, name) == 0) {
            return layers->channels[i].values;
        }
    }
    return NULL;
}

// The channels of each pixel's heaviest term.
typedef struct heaviest {
    const float *vector[3], *weight[3], *kind;
} heaviest;

static bool find(const glint_layers *layers, heaviest *found)
{
    static const char *const vectors[3] = {"terms.00.x", "terms.00.y", "terms.00.z"};
    static const char *const weights[3] = {"terms.00.wr", "terms.00.wg", "terms.00.wb"};
    found->kind = channel(layers, "terms.00.kind");
    bool all = found->kind != NULL;
    for (int k = 0; k < 3; k++) {
        found->vector[k] = channel(layers, vectors[k]);
        found->weight[k] = channel(layers, weights[k]);
        all = all && found->vector[k] != NULL && found->weight[k] != NULL;
    }
    return all;
}

// True if the pixel's heaviest term looks up radiance with a positive weight.
static bool sees_environment(const heaviest *h, size_t pixel)
{
    return h->kind[pixel] == 0 &&
           (h->weight[0][pixel] > 0 || h->weight[1][pixel] > 0 || h->weight[2][pixel] > 0);
}

// The angle in degrees. The arc tangent keeps its digits for small angles.
static double angle_between(const heaviest *a, const heaviest *b, size_t pixel)
{
    glint_vec3 v[2];
    const heaviest *const both[2] = {a, b};
    for (int i = 0; i < 2; i++) {
        const float *const *vector = both[i]->vector;
        v[i] = (glint_vec3){(double)vector[0][pixel], (double)vector[1][pixel],
                            (double)vector[2][pixel]};
    }
    return atan2(glint_vec3_length(glint_vec3_cross(v[0], v[1])), glint_vec3_dot(v[0], v[1])) *
           180 / GLINT_PI;
}

glint_status glint_direction_error_find(const glint_layers *layers, const glint_layers *reference,
                                        size_t pixel_count, glint_direction_error *result,
                                        glint_error *error)
{
    *result = (glint_direction_error){0};
    heaviest a, b;
    if (!find(layers, &a) || !find(reference, &b)) {
        return glint_fail(error, GLINT_USAGE, "the frames hold no directions");
    }
    double *angles = glint_allocate_unset(pixel_count, sizeof *angles);
    if (angles == NULL) {
        return glint_fail_memory(error, "the directions");
    }
    size_t count = 0;
    for (size_t i = 0; i < pixel_count; i++) {
        const bool one = sees_environment(&a, i), other = sees_environment(&b, i);
        if (one && other) {
            const double angle = angle_between(&a, &b, i);
            result->mean += angle;
            angles[count++] = angle;
        }
        result->lost += one != other;
    }
    result->compared = count;
    if (count > 0) {
        glint_sort(angles, count);
        result->mean /= (double)count;
        result->p99 = glint_quantile(angles, count, 0.99);
        result->largest = angles[count - 1];
    }
    free(angles);
    return GLINT_OK;
}
