// Stores the environment as a tree of cells. See cells.h.
#include "environment/cells.h"

#include "base/parallel.h"
#include "kernels/layout.h"

#include <math.h>
#include <string.h>

// Cells along a face's edge from which the environment's brightness is computed.
#define BRIGHTNESS_EDGE 64

// The weight of a cell without light. It puts the cell's centroid in its middle.
#define DARK_WEIGHT 1e-20

typedef struct job {
    const glint_cube *cube;
    int edge;    // cells along a face's edge
    int level;   // number of the level of these cells
    int samples; // samples along the edge of a finest cell
    float *cells;
} job;

// Spreads the bits of x < 2¹⁶ to even places. In Morton order the even bits are the column's.
static size_t spread_bits(size_t x)
{
    x = (x | x << 8) & 0x00ff00ff;
    x = (x | x << 4) & 0x0f0f0f0f;
    x = (x | x << 2) & 0x33333333;
    return (x | x << 1) & 0x55555555;
}

static float *cell_at(const job *j, int face, int column, int row)
{
    const size_t edge = (size_t)j->edge;
    const size_t place = spread_bits((size_t)column) | spread_bits((size_t)row) << 1;
    const size_t number = GLINT_CELLS_FIRST(j->level) + (size_t)face * edge * edge + place;
    return j->cells + number * GLINT_CELL_VALUES;
}

// Sums over a cell.
typedef struct cell_sum {
    double toward[3]; // sum of directions, weighted by brightness
    double weight;    // sum of these weights
    double variance;  // weighted sum of the variances within the parts
    double light[3];
} cell_sum;

// Adds light to the sum and returns the weight of its direction.
static double add_light(const double light[3], double times, cell_sum *sum)
{
    const double bright = (light[0] + light[1] + light[2]) * times;
    const double weight = (bright > 0 ? bright : 0) + DARK_WEIGHT;
    sum->weight += weight;
    for (int k = 0; k < 3; k++) {
        sum->light[k] += light[k] * times;
    }
    return weight;
}

static void store_cell(const cell_sum *sum, double size, float *cell)
{
    const double *d = sum->toward;
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const double inverse = 1 / length, share = 1 / sum->weight;
    const double between = 0.5 * (1 - length * length * share * share);
    for (int k = 0; k < 3; k++) {
        cell[k] = (float)(d[k] * inverse);
        cell[4 + k] = (float)sum->light[k];
    }
    cell[3] = (float)size;
    cell[7] = (float)(sum->variance * share + (between > 0 ? between : 0));
}

// The inverse of the distance from the cube's middle to (s, t) on a face. The face's plane is at
// distance 1.
static double inverse_distance(double s, double t)
{
    return 1 / sqrt(1 + s * s + t * t);
}

// The inverse distance of the middle of a cell, at the level of the given edge.
static double middle_of(int edge, int column, int row)
{
    return inverse_distance((2 * column + 1.0) / edge - 1, (2 * row + 1.0) / edge - 1);
}

// Looks up the map at (x, y) of a face, in texels, bilinearly.
static void sample_face(const glint_cube *cube, int face, double x, double y, double rgb[3])
{
    const int i = (int)floor(x - 0.5), j = (int)floor(y - 0.5);
    const double right = x - 0.5 - i, down = y - 0.5 - j;
    const float *upper = glint_cube_texel(cube, face, i, j);
    const float *lower = glint_cube_texel(cube, face, i, j + 1);
    for (int k = 0; k < 3; k++) {
        const double above = upper[k] + right * (upper[4 + k] - upper[k]);
        const double below = lower[k] + right * (lower[4 + k] - lower[k]);
        rgb[k] = above + down * (below - above);
    }
}

// The solid angle of a square of edge h: its value in the middle and h²/24 of the Laplacian there.
static double solid_angle(double h, double u)
{
    const double squared = u * u;
    return h * h * squared * u * (1 + h * h / 24 * squared * (9 - 15 * squared));
}

// The direction through (s, t) of a face is middle + s to_s + t to_t.
typedef struct face_axes {
    glint_vec3 middle, to_s, to_t;
} face_axes;

static face_axes axes_of(int face)
{
    const glint_vec3 middle = glint_cube_direction(face, 0, 0);
    return (face_axes){middle, glint_vec3_subtract(glint_cube_direction(face, 1, 0), middle),
                       glint_vec3_subtract(glint_cube_direction(face, 0, 1), middle)};
}

// Adds u (1, s, t). u holds the brightness as a weight.
static void add_direction(const face_axes *a, double u, double us, double ut, cell_sum *sum)
{
    sum->toward[0] += a->middle.x * u + a->to_s.x * us + a->to_t.x * ut;
    sum->toward[1] += a->middle.y * u + a->to_s.y * us + a->to_t.y * ut;
    sum->toward[2] += a->middle.z * u + a->to_s.z * us + a->to_t.z * ut;
}

// Fills a cell that is one texel. Its light lies in its middle.
static void fill_texel(const job *j, const face_axes *axes, int face, int column, int row)
{
    const double h = 2.0 / j->edge, s = (column + 0.5) * h - 1, t = (row + 0.5) * h - 1;
    const double u = inverse_distance(s, t), angle = solid_angle(h, u);
    const float *texel = glint_cube_texel(j->cube, face, column, row);
    float *cell = cell_at(j, face, column, row);
    cell[0] = (float)((axes->middle.x + axes->to_s.x * s + axes->to_t.x * t) * u);
    cell[1] = (float)((axes->middle.y + axes->to_s.y * s + axes->to_t.y * t) * u);
    cell[2] = (float)((axes->middle.z + axes->to_s.z * s + axes->to_t.z * t) * u);
    cell[3] = (float)(h * u);
    for (int k = 0; k < 3; k++) {
        cell[4 + k] = (float)((double)texel[k] * angle);
    }
    cell[7] = 0;
}

// Samples along s that are weighed at once. The weights are the same on all six faces.
#define CHUNK 32

typedef struct sample_row {
    int first, count; // samples from the face's left edge on
    double t;
    double s[CHUNK], u[CHUNK], angle[CHUNK];
} sample_row;

static void weigh_samples(int parts, int row, sample_row *out)
{
    const double h = 2.0 / parts;
    out->t = (row + 0.5) * h - 1;
    for (int k = 0; k < out->count; k++) {
        out->s[k] = (out->first + k + 0.5) * h - 1;
        out->u[k] = inverse_distance(out->s[k], out->t);
        out->angle[k] = solid_angle(h, out->u[k]);
    }
}

// Sums over a cell, with its directions in the face's axes.
typedef struct face_sum {
    cell_sum sum;
    double u, us, ut;
} face_sum;

static void add_samples(const job *j, int face, int row, const sample_row *samples, face_sum *to)
{
    const int parts = j->edge * j->samples;
    const double scale = (double)j->cube->edge / parts;
    for (int k = 0; k < samples->count; k++) {
        const int x = samples->first + k;
        double light[3];
        if (j->cube->edge == parts) {
            const float *texel = glint_cube_texel(j->cube, face, x, row);
            light[0] = (double)texel[0], light[1] = (double)texel[1], light[2] = (double)texel[2];
        } else {
            sample_face(j->cube, face, (x + 0.5) * scale, (row + 0.5) * scale, light);
        }
        const double weight = add_light(light, samples->angle[k], &to->sum) * samples->u[k];
        to->u += weight;
        to->us += weight * samples->s[k];
        to->ut += weight * samples->t;
    }
}

// Fills a cell that is several samples, on all faces.
static void fill_finest(const job *j, int column, int row)
{
    const int parts = j->edge * j->samples;
    face_sum sums[GLINT_CUBE_FACES] = {0};
    for (int y = row * j->samples; y < (row + 1) * j->samples; y++) {
        for (int done = 0; done < j->samples; done += CHUNK) {
            const int left = j->samples - done;
            sample_row samples = {.first = column * j->samples + done,
                                  .count = left < CHUNK ? left : CHUNK};
            weigh_samples(parts, y, &samples);
            for (int face = 0; face < GLINT_CUBE_FACES; face++) {
                add_samples(j, face, y, &samples, &sums[face]);
            }
        }
    }
    const double size = 2.0 / j->edge * middle_of(j->edge, column, row);
    for (int face = 0; face < GLINT_CUBE_FACES; face++) {
        const face_axes axes = axes_of(face);
        face_sum *of = &sums[face];
        add_direction(&axes, of->u, of->us, of->ut, &of->sum);
        store_cell(&of->sum, size, cell_at(j, face, column, row));
    }
}

static void fill_coarser(const job *j, int face, int column, int row)
{
    float *cell = cell_at(j, face, column, row);
    const size_t number = (size_t)(cell - j->cells) / GLINT_CELL_VALUES;
    const size_t first =
        GLINT_CELLS_FIRST(j->level + 1) + 4 * (number - GLINT_CELLS_FIRST(j->level));
    cell_sum sum = {0};
    for (size_t k = 0; k < 4; k++) {
        const float *child = j->cells + (first + k) * GLINT_CELL_VALUES;
        const double direction[3] = {(double)child[0], (double)child[1], (double)child[2]};
        const double light[3] = {(double)child[4], (double)child[5], (double)child[6]};
        const double weight = add_light(light, 1, &sum);
        sum.variance += weight * (double)child[7];
        for (int c = 0; c < 3; c++) {
            sum.toward[c] += weight * direction[c];
        }
    }
    store_cell(&sum, 2.0 / j->edge * middle_of(j->edge, column, row), cell);
}

static void fill_row(size_t index, void *context)
{
    const job *j = context;
    const int face = (int)index / j->edge, row = (int)index % j->edge;
    const face_axes axes = axes_of(face);
    for (int column = 0; column < j->edge; column++) {
        if (j->samples > 0) {
            fill_texel(j, &axes, face, column, row);
        } else {
            fill_coarser(j, face, column, row);
        }
    }
}

// Fills a row of cells that are several samples, on all faces.
static void fill_finest_row(size_t row, void *context)
{
    const job *j = context;
    for (int column = 0; column < j->edge; column++) {
        fill_finest(j, column, (int)row);
    }
}

static void fill_level(job *j)
{
    if (j->samples > 1 || (j->samples == 1 && j->edge != j->cube->edge)) {
        glint_parallel_for((size_t)j->edge, fill_finest_row, j);
    } else {
        glint_parallel_for((size_t)(GLINT_CUBE_FACES * j->edge), fill_row, j);
    }
}

// One sample a texel if the texels fill the cells; else twice as many, so that every texel counts.
static int samples_along(int texels, int cells)
{
    return texels % cells == 0 ? texels / cells : 2 * (texels / cells + 1);
}

// The environment's brightness, from the level of edge j->edge.
static float brightness_of(const job *j)
{
    double root = 0;
    for (int i = 0; i < GLINT_CUBE_FACES * j->edge * j->edge; i++) {
        const int face = i / (j->edge * j->edge), row = i / j->edge % j->edge;
        const float *cell = cell_at(j, face, i % j->edge, row);
        const double angle = solid_angle(2.0 / j->edge, middle_of(j->edge, i % j->edge, row));
        const double bright = (double)cell[4] + (double)cell[5] + (double)cell[6];
        root += sqrt(fmax(0, bright) * angle) / (4 * GLINT_PI);
    }
    return (float)(root * root);
}

float glint_cells_fill(const glint_cube *cube, int edge, float *cells)
{
    job j = {.cube = cube, .edge = edge};
    j.cells = cells;
    while (GLINT_CELLS_ROOT << j.level < edge) {
        j.level++;
    }
    j.samples = samples_along(cube->edge, edge);
    float brightness = 0;
    for (; j.level >= 0; j.level--, j.edge /= 2, j.samples = 0) {
        fill_level(&j);
        if (j.edge <= BRIGHTNESS_EDGE && brightness == 0) {
            brightness = brightness_of(&j);
        }
    }
    return brightness;
}
