// Computes nine coefficients of an environment's irradiance. See harmonics.h.
#include "environment/harmonics.h"

#include "base/memory.h"
#include "base/parallel.h"

#include <math.h>
#include <stdlib.h>

// The polynomials of kernels/layout.h are spherical harmonics except for a factor. The projection
// of the radiance on f is f · ∫ f L / ∫ f². `squares` is ∫f² over the sphere. `kept` is the
// cosine's factor for the band, over π.
static const double squares[GLINT_HARMONICS] = {
    4 * GLINT_PI,      4 * GLINT_PI / 3,  4 * GLINT_PI / 3,   4 * GLINT_PI / 3, 4 * GLINT_PI / 15,
    4 * GLINT_PI / 15, 4 * GLINT_PI / 15, 16 * GLINT_PI / 15, 16 * GLINT_PI / 5};
static const double kept[GLINT_HARMONICS] = {1,       2.0 / 3, 2.0 / 3, 2.0 / 3, 1.0 / 4,
                                             1.0 / 4, 1.0 / 4, 1.0 / 4, 1.0 / 4};

// Sums over a row of texels: ∫ f L for each polynomial and channel, and the solid angle.
typedef struct row_sum {
    double value[GLINT_HARMONICS][3];
    double solid_angle;
} row_sum;

typedef struct job {
    const glint_cube *radiance;
    row_sum *rows; // [6][edge]
} job;

// From this edge on, a texel is sampled at one point. The error is h²/24 of the second derivatives,
// which are under 8: 2e-5 with h = 2/edge. Larger texels take four points of Gauss's rule.
#define POINT_EDGE 256

// Adds a texel: its points, each weighed by the solid angle of its part of the face.
static void add_texel(const glint_cube *cube, int face, int i, int j, row_sum *row)
{
    const float *texel = glint_cube_texel(cube, face, i, j);
    const int edge = cube->edge;
    const double s = (2.0 * i + 1) / edge - 1, t = (2.0 * j + 1) / edge - 1, half = 1.0 / edge;
    const int points = half <= 1.0 / POINT_EDGE ? 1 : 4;
    const double aside = points == 1 ? 0 : half / sqrt(3.0), area = 4 * half * half / points;
    double sum[GLINT_HARMONICS] = {0};
    for (int point = 0; point < points; point++) {
        const glint_vec3 at = glint_cube_direction(face, s + (point & 1 ? aside : -aside),
                                                   t + (point & 2 ? aside : -aside));
        const double length = glint_vec3_length(at);
        const double weight = area / (length * length * length);
        const glint_vec3 d = glint_vec3_scale(at, 1 / length);
        const double f[GLINT_HARMONICS] = GLINT_HARMONIC_TERMS(d.x, d.y, d.z);
        for (int k = 0; k < GLINT_HARMONICS; k++) {
            sum[k] += weight * f[k];
        }
    }
    for (int k = 0; k < GLINT_HARMONICS; k++) {
        for (int c = 0; c < 3; c++) {
            row->value[k][c] += sum[k] * (double)texel[c];
        }
    }
    row->solid_angle += sum[0];
}

static void sum_row(size_t index, void *context)
{
    const job *work = context;
    const int edge = work->radiance->edge;
    const int face = (int)index / edge, j = (int)index % edge;
    row_sum row = {0};
    for (int i = 0; i < edge; i++) {
        add_texel(work->radiance, face, i, j, &row);
    }
    work->rows[index] = row;
}

glint_status glint_irradiance_harmonics(const glint_cube *radiance,
                                        float coefficients[GLINT_HARMONICS][4], glint_error *error)
{
    const size_t rows = 6 * (size_t)radiance->edge;
    job work = {.radiance = radiance, .rows = glint_allocate(rows, sizeof *work.rows)};
    if (work.rows == NULL) {
        return glint_fail_memory(error, "the environment's harmonics");
    }
    glint_parallel_for(rows, sum_row, &work);
    row_sum all = {0};
    for (size_t i = 0; i < rows; i++) { // in a fixed order, so that threads do not matter
        all.solid_angle += work.rows[i].solid_angle;
        for (int k = 0; k < 3 * GLINT_HARMONICS; k++) {
            all.value[k / 3][k % 3] += work.rows[i].value[k / 3][k % 3];
        }
    }
    free(work.rows);
    for (int k = 0; k < GLINT_HARMONICS; k++) {
        const double factor = kept[k] / squares[k] * 4 * GLINT_PI / all.solid_angle;
        for (int c = 0; c < 3; c++) {
            coefficients[k][c] = (float)(factor * all.value[k][c]);
        }
        coefficients[k][3] = 0;
    }
    return GLINT_OK;
}
