// Stores texels as halfs and measures the error. See half_texels.h.
#include "environment/half_texels.h"

#include "base/half.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "kernels/layout.h"

#include <math.h>
#include <stdlib.h>

// Sums over row j of all six faces, weighted by solid angle.
typedef struct row_sums {
    double weight;    // sum of the weights, counted for R, G and B
    double value;     // sum of magnitudes
    double squared;   // sum of squared errors
    double visible;   // sum of squared errors over the larger of value and mean
    uint32_t largest; // bits of the largest magnitude; in this order NaN is above ∞
} row_sums;

// The data that all threads share.
typedef struct job {
    const glint_cube *cube;
    row_sums *rows; // [edge + 2]; a border row sets only `largest`
    float mean;     // 0 in the first pass, which computes it
    uint16_t *texels;
} job;

// The number of columns weighed at once. The weights are the same on all six faces.
#define CHUNK 64

static size_t pitch_of(const glint_cube *cube)
{
    return (size_t)cube->edge + 2 * GLINT_CUBE_BORDER;
}

// The solid angles of the texels (first …, j), except for a constant factor: (1 + s² + t²)^(−3/2).
static void weigh_texels(int edge, int j, int first, int count, double weights[CHUNK])
{
    for (int k = 0; k < count; k++) {
        double s = (2.0 * (first + k) + 1.0) / edge - 1.0, t = (2.0 * j + 1.0) / edge - 1.0;
        double squared = 1.0 + s * s + t * t;
        weights[k] = 1.0 / (squared * sqrt(squared));
    }
}

static void sum_values(const float *texels, const double *weights, int count, row_sums *sums)
{
    double weight = 0.0, value = 0.0;
    for (int k = 0; k < count; k++) {
        const float *texel = texels + 4 * k;
        double r = (double)fabsf(texel[0]), g = (double)fabsf(texel[1]);
        value += weights[k] * (r + g + (double)fabsf(texel[2]));
        weight += 3.0 * weights[k];
    }
    sums->value += value;
    sums->weight += weight;
}

static void sum_errors(const float *texels, const double *weights, int count, float mean,
                       row_sums *sums)
{
    uint16_t halfs[4 * CHUNK];
    float errors[4 * CHUNK] = {0}, seen[4 * CHUNK] = {0};
    glint_floats_to_halfs(texels, 4 * (size_t)count, halfs);
    glint_halfs_to_floats(halfs, 4 * (size_t)count, errors);
    for (int k = 0; k < 4 * count; k++) {
        const float magnitude = fabsf(texels[k]);
        errors[k] -= texels[k];
        seen[k] = errors[k] / (magnitude > mean ? magnitude : mean);
    }
    double squared = 0.0, visible = 0.0;
    for (int k = 0; k < count; k++) {
        double texel_squared = 0.0, texel_visible = 0.0;
        for (int c = 0; c < 3; c++) {
            const double error = (double)errors[4 * k + c], relative = (double)seen[4 * k + c];
            texel_squared += error * error;
            texel_visible += relative * relative;
        }
        squared += weights[k] * texel_squared;
        visible += weights[k] * texel_visible;
    }
    sums->squared += squared;
    sums->visible += visible;
}

static uint32_t find_largest(const float *texels, size_t count)
{
    uint32_t largest = 0;
    for (size_t k = 0; k < count; k++) {
        for (int c = 0; c < 3; c++) {
            uint32_t magnitude = glint_float_bits(fabsf(texels[4 * k + (size_t)c]));
            largest = magnitude > largest ? magnitude : largest;
        }
    }
    return largest;
}

static void sum_row(size_t index, void *context)
{
    const job *shared = context;
    const glint_cube *cube = shared->cube;
    int edge = cube->edge, j = (int)index - GLINT_CUBE_BORDER;
    row_sums *sums = &shared->rows[index];
    for (int face = 0; face < GLINT_CUBE_FACES && shared->mean == 0.0f; face++) {
        const float *row = glint_cube_texel(cube, face, -GLINT_CUBE_BORDER, j);
        uint32_t largest = find_largest(row, pitch_of(cube));
        sums->largest = largest > sums->largest ? largest : sums->largest;
    }
    for (int first = 0; first < edge && j >= 0 && j < edge; first += CHUNK) {
        double weights[CHUNK];
        int count = edge - first < CHUNK ? edge - first : CHUNK;
        weigh_texels(edge, j, first, count, weights);
        for (int face = 0; face < GLINT_CUBE_FACES; face++) {
            const float *texels = glint_cube_texel(cube, face, first, j);
            if (shared->mean == 0.0f) {
                sum_values(texels, weights, count, sums);
            } else {
                sum_errors(texels, weights, count, shared->mean, sums);
            }
        }
    }
}

// Sums in the rows' order, so that the result does not depend on the threads.
static row_sums sum_rows(const job *shared)
{
    row_sums all = {0};
    size_t count = pitch_of(shared->cube);
    glint_parallel_for(count, sum_row, (void *)shared);
    for (size_t i = 0; i < count; i++) {
        const row_sums *row = &shared->rows[i];
        all.weight += row->weight;
        all.value += row->value;
        all.squared += row->squared;
        all.visible += row->visible;
        all.largest = row->largest > all.largest ? row->largest : all.largest;
    }
    return all;
}

glint_status glint_half_rounding_measure(const glint_cube *cube, glint_half_rounding *rounding,
                                         glint_error *error)
{
    *rounding = (glint_half_rounding){0};
    if (cube->texels == NULL) {
        return GLINT_OK;
    }
    job shared = {.cube = cube, .rows = glint_allocate(pitch_of(cube), sizeof(row_sums))};
    if (shared.rows == NULL) {
        return glint_fail_memory(error, "the environment's texels");
    }
    row_sums all = sum_rows(&shared);
    rounding->largest = glint_float_from_bits(all.largest);
    shared.mean = (float)(all.value / all.weight);
    // Skip a mean of 0 or NaN.
    if (shared.mean > 0.0f) {
        all = sum_rows(&shared);
        rounding->relative_rmse = sqrt(all.squared / all.weight) / (double)shared.mean;
        rounding->visible_rmse = sqrt(all.visible / all.weight);
    }
    free(shared.rows);
    return GLINT_OK;
}

static void convert_row(size_t index, void *context)
{
    const job *shared = context;
    size_t values = 4 * pitch_of(shared->cube);
    const float *from = shared->cube->texels + index * values;
    uint16_t *to = shared->texels + index * values;
    glint_floats_to_halfs(from, values, to);
}

void glint_cube_to_half(const glint_cube *cube, uint16_t *texels)
{
    job shared = {.cube = cube};
    shared.texels = texels;
    glint_parallel_for(GLINT_CUBE_FACES * pitch_of(cube), convert_row, &shared);
}
