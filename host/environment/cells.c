// The environment as a tree of cells. See cells.h.
#include "environment/cells.h"

#include "base/parallel.h"
#include "kernels/layout.h"

#include <math.h>
#include <string.h>

// What a cell of no light weighs, by which its centroid is its middle.
#define DARK_WEIGHT 1e-20

typedef struct job {
    const glint_cube *cube;
    int edge;    // cells along a face's edge
    int level;   // of them
    int samples; // along a finest cell's edge
    float *cells;
    double *roots; // for each row of finest cells, ∫ √(R + G + B) dω
} job;

// The even bits of a place in Morton order are the column's.
static size_t spread_bits(size_t x)
{
    size_t spread = 0;
    for (int bit = 0; x >> bit != 0; bit++) {
        spread |= (x >> bit & 1) << (2 * bit);
    }
    return spread;
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
    double toward[3]; // directions, by how bright they are
    double weight;    // of them
    double variance;  // of the parts' own, weighted
    double light[3];
} cell_sum;

static void add_part(const double direction[3], const double light[3], double variance,
                     cell_sum *sum)
{
    const double bright = light[0] + light[1] + light[2];
    const double weight = (bright > 0 ? bright : 0) + DARK_WEIGHT;
    sum->weight += weight;
    sum->variance += weight * variance;
    for (int k = 0; k < 3; k++) {
        sum->toward[k] += weight * direction[k];
        sum->light[k] += light[k];
    }
}

static void store_cell(const cell_sum *sum, double size, float *cell)
{
    const double *d = sum->toward;
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), inverse = 1 / length;
    const double between = 0.5 * (1 - length * length / (sum->weight * sum->weight));
    for (int k = 0; k < 3; k++) {
        cell[k] = (float)(d[k] * inverse);
        cell[4 + k] = (float)sum->light[k];
    }
    cell[3] = (float)size;
    cell[7] = (float)(sum->variance / sum->weight + (between > 0 ? between : 0));
}

static double size_of(int edge, int column, int row)
{
    const double s = (2 * column + 1.0) / edge - 1, t = (2 * row + 1.0) / edge - 1;
    return 2.0 / edge / sqrt(1 + s * s + t * t);
}

// The map at (x, y) of a face, in texels.
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

// The solid angle about (s, t) of a square of edge h: its middle's, and h²/24 of the Laplacian
// there.
static double solid_angle(double h, double u)
{
    const double cube = u * u * u, fifth = cube * u * u;
    return h * h * (cube + h * h / 24 * (9 * fifth - 15 * fifth * u * u));
}

// The result is ∫ √(R + G + B) dω over the cell.
static double fill_finest(const job *j, int face, int column, int row)
{
    const int parts = j->edge * j->samples;
    const double h = 2.0 / parts, scale = (double)j->cube->edge / parts;
    cell_sum sum = {0};
    double root = 0;
    for (int k = 0; k < j->samples * j->samples; k++) {
        const int down = k / j->samples;
        const double x = column * j->samples + k % j->samples + 0.5;
        const double y = row * j->samples + down + 0.5;
        const double s = x * h - 1, t = y * h - 1, u = 1 / sqrt(1 + s * s + t * t);
        const glint_vec3 d = glint_cube_direction(face, s, t);
        const double direction[3] = {d.x * u, d.y * u, d.z * u}, angle = solid_angle(h, u);
        double light[3];
        sample_face(j->cube, face, x * scale, y * scale, light);
        root += sqrt(fmax(0, light[0] + light[1] + light[2])) * angle;
        for (int c = 0; c < 3; c++) {
            light[c] *= angle;
        }
        add_part(direction, light, 0, &sum);
    }
    store_cell(&sum, size_of(j->edge, column, row), cell_at(j, face, column, row));
    return root;
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
        add_part(direction, light, (double)child[7], &sum);
    }
    store_cell(&sum, size_of(j->edge, column, row), cell);
}

static void fill_row(size_t index, void *context)
{
    const job *j = context;
    const int face = (int)index / j->edge, row = (int)index % j->edge;
    for (int column = 0; column < j->edge; column++) {
        if (j->samples > 0) {
            j->roots[index] += fill_finest(j, face, column, row);
        } else {
            fill_coarser(j, face, column, row);
        }
    }
}

// One sample a texel where these fill the cells; else twice as many, so that none is left out.
static int samples_along(int texels, int cells)
{
    return texels % cells == 0 ? texels / cells : 2 * (texels / cells + 1);
}

float glint_cells_fill(const glint_cube *cube, int edge, float *cells)
{
    double roots[GLINT_CUBE_FACES * (GLINT_CELLS_ROOT << (GLINT_CELLS_LEVELS - 1))] = {0};
    job j = {.cube = cube, .edge = edge, .roots = roots};
    j.cells = cells;
    while (GLINT_CELLS_ROOT << j.level < edge) {
        j.level++;
    }
    j.samples = samples_along(cube->edge, edge);
    for (; j.level >= 0; j.level--, j.edge /= 2, j.samples = 0) {
        glint_parallel_for((size_t)(GLINT_CUBE_FACES * j.edge), fill_row, &j);
    }
    double root = 0;
    for (int row = 0; row < GLINT_CUBE_FACES * edge; row++) {
        root += roots[row] / (4 * GLINT_PI);
    }
    return (float)(root * root);
}
