// Irradiance of an environment, as its texels have it. See irradiance.h.
//
// Over a region of constant radiance L that lies wholly in front of n, ∫ L n·ω dω = n · (L m) with
// the first moment m = ∫ ω dω. On a cube's face a texel is a spherical quadrilateral whose sides
// are arcs of great circles, and m is Lambert's formula (Photometria, 1760; Arvo 1994): half the
// sum, over its sides, of the arc's angle times the unit normal of the arc's plane, pointing
// inwards. Moments add up. The faces are cut into blocks of whole texels (or of parts of texels,
// where these are large), and of each row and each column of blocks the running sums of L m are
// kept. n·ω is linear over a face, so the horizon of n is a straight line there, which in each row
// (or column, whichever it crosses more steeply) parts the blocks in front from those behind: a
// difference of two running sums is all that the ones in front bring.
//
// What is left are the blocks that the line runs through. With g = n·ω/ω_z, linear on the face, and
// the weight w = L ω_z, such a block brings ∫ w max(0, g) dω; of w only the sum W and of w g only
// the sum P = n · Σ L m are known. g is taken as spread evenly over P/W ± a, with a so that the
// spread is that of g over an evenly weighted block: (P + aW)²/(4aW). That is exact for an even
// weight and a line along an axis, and 6% of aW/4 too much at worst for one along a diagonal. Half
// a block is a ≤ h/2, h the width of a block, so a great circle through 2π/h blocks of h² errs by
// less than 0.06 · h²/4 of the radiance near the horizon: 4e-6 with h = 2/GRID_MIN. However uneven
// the weight, the part of P within the block is right to aW/4, h/8 of what it would bring from
// straight above: that is what a single bright texel (the sun) may err by, when the horizon runs
// through its block.
#include "environment/irradiance.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "kernels/layout.h"

#include <stdint.h>
#include <stdlib.h>

enum {
    GRID_MIN = 128, // blocks along a face's edge, at least
    BLOCKS_MAX = 2 * GRID_MIN - 1,
};

// R and G, or B and padding: what a vector register of every x86-64 holds. Each lane is computed as
// a scalar would be.
typedef double pair __attribute__((vector_size(2 * sizeof(double))));
typedef int64_t pair_mask __attribute__((vector_size(2 * sizeof(int64_t))));
enum { PAIRS = 2 };

// Σ L m in the face's axes: s, t and the face's own.
typedef struct moment_sum {
    pair along[3][PAIRS];
} moment_sum;

// Blocks are the same along both axes of a face. A line is a row (ALONG_S) or a column (ALONG_T).
enum { ALONG_S, ALONG_T, DIRECTIONS };

typedef struct block_grid {
    int texels;   // along an edge of the map
    int blocks;   // along an edge
    double scale; // blocks per unit of (s + 1)/2; all blocks but the last have this width
    // [face][line][blocks + 1]: the sums of the blocks of a line before the k-th.
    moment_sum *before[DIRECTIONS];
} block_grid;

// What the threads share.
typedef struct job {
    const glint_cube *radiance;
    glint_cube *irradiance;
    block_grid grid;
} job;

static moment_sum *line_of(const block_grid *grid, int direction, int face, int line)
{
    size_t blocks = (size_t)grid->blocks;
    return grid->before[direction] + ((size_t)face * blocks + (size_t)line) * (blocks + 1);
}

static void add_sum(const moment_sum *a, moment_sum *to)
{
    for (int axis = 0; axis < 3; axis++) {
        for (int p = 0; p < PAIRS; p++) {
            to->along[axis][p] += a->along[axis][p];
        }
    }
}

// ---- Moments ------------------------------------------------------------------------------------

// Adds the moment of [s0, s1] × [t0, t1] in the plane at distance 1.
static void add_moment(const double s[2], const double t[2], double moment[3])
{
    for (int side = 0; side < 2; side++) {
        double sign = side == 0 ? 1.0 : -1.0; // inwards
        // The side at constant s: its plane's normal is (1, 0, −s), its arc runs over t.
        double far_s = sqrt(1.0 + s[side] * s[side]);
        double angle_t = atan(t[1] / far_s) - atan(t[0] / far_s);
        double far_t = sqrt(1.0 + t[side] * t[side]);
        double angle_s = atan(s[1] / far_t) - atan(s[0] / far_t);
        moment[0] += 0.5 * sign * angle_t / far_s;
        moment[1] += 0.5 * sign * angle_s / far_t;
        moment[2] -= 0.5 * sign * (angle_t * s[side] / far_s + angle_s * t[side] / far_t);
    }
}

// Whole texels a block; 0 where a block is a part of one.
static int texels_a_block(const block_grid *grid)
{
    return grid->texels / GRID_MIN;
}

// The first texel that block i covers, and in `line` where the block begins, in [−1, 1].
static int block_start(const block_grid *grid, int i, double *line)
{
    int whole = texels_a_block(grid);
    if (whole == 0) {
        *line = 2.0 * i / grid->blocks - 1.0;
        return i / (grid->blocks / grid->texels);
    }
    int first = i * whole < grid->texels ? i * whole : grid->texels;
    *line = 2.0 * first / grid->texels - 1.0;
    return first;
}

static void add_texel(const float *texel, const double s[2], const double t[2], moment_sum *sum)
{
    double moment[3] = {0.0, 0.0, 0.0};
    add_moment(s, t, moment);
    const pair radiance[PAIRS] = {{(double)texel[0], (double)texel[1]}, {(double)texel[2]}};
    for (int axis = 0; axis < 3; axis++) {
        for (int p = 0; p < PAIRS; p++) {
            sum->along[axis][p] += radiance[p] * moment[axis];
        }
    }
}

static double texel_line(const block_grid *grid, int i)
{
    return 2.0 * i / grid->texels - 1.0;
}

static void sum_block(const job *shared, int face, int row, int column, moment_sum *sum)
{
    const block_grid *grid = &shared->grid;
    double s[2], t[2];
    int first_i = block_start(grid, column, &s[0]), end_i = block_start(grid, column + 1, &s[1]);
    int first_j = block_start(grid, row, &t[0]), end_j = block_start(grid, row + 1, &t[1]);
    *sum = (moment_sum){0};
    if (texels_a_block(grid) == 0) {
        add_texel(glint_cube_texel(shared->radiance, face, first_i, first_j), s, t, sum);
        return;
    }
    for (int j = first_j; j < end_j; j++) {
        for (int i = first_i; i < end_i; i++) {
            double across[2] = {texel_line(grid, i), texel_line(grid, i + 1)};
            double down[2] = {texel_line(grid, j), texel_line(grid, j + 1)};
            add_texel(glint_cube_texel(shared->radiance, face, i, j), across, down, sum);
        }
    }
}

// One row of blocks: its running sums, and the blocks themselves to where the columns' sums will
// be.
static void sum_row(size_t index, void *context)
{
    const job *shared = context;
    const block_grid *grid = &shared->grid;
    int face = (int)index / grid->blocks, row = (int)index % grid->blocks;
    moment_sum *sums = line_of(grid, ALONG_S, face, row);
    for (int column = 0; column < grid->blocks; column++) {
        moment_sum *block = line_of(grid, ALONG_T, face, column) + row + 1;
        sum_block(shared, face, row, column, block);
        sums[column + 1] = sums[column];
        add_sum(block, &sums[column + 1]);
    }
}

static void sum_column(size_t index, void *context)
{
    const job *shared = context;
    const block_grid *grid = &shared->grid;
    int face = (int)index / grid->blocks, column = (int)index % grid->blocks;
    moment_sum *sums = line_of(grid, ALONG_T, face, column);
    for (int row = 0; row < grid->blocks; row++) {
        add_sum(&sums[row], &sums[row + 1]);
    }
}

static void grid_free(block_grid *grid)
{
    for (int direction = 0; direction < DIRECTIONS; direction++) {
        free(grid->before[direction]);
    }
    *grid = (block_grid){0};
}

static glint_status grid_create(int texels, block_grid *grid, glint_error *error)
{
    *grid = (block_grid){.texels = texels};
    int whole = texels_a_block(grid);
    if (whole == 0) {
        grid->blocks = texels * ((GRID_MIN + texels - 1) / texels);
        grid->scale = grid->blocks;
    } else {
        grid->blocks = (texels + whole - 1) / whole;
        grid->scale = (double)texels / whole;
    }
    size_t blocks = (size_t)grid->blocks;
    for (int direction = 0; direction < DIRECTIONS; direction++) {
        grid->before[direction] =
            glint_allocate(GLINT_CUBE_FACES * blocks * (blocks + 1), sizeof(moment_sum));
        if (grid->before[direction] == NULL) {
            return glint_fail_memory(error, "an irradiance map");
        }
    }
    return GLINT_OK;
}

// ---- Gathering ----------------------------------------------------------------------------------

// The whole number at or below, and the one at or above, in 0 … most; NaN: 0.
static int whole_below(double value, int most)
{
    return value > 0.0 ? (value < most ? (int)value : most) : 0;
}

static int whole_above(double value, int most)
{
    const int below = whole_below(value, most);
    return below < most && below < value ? below + 1 : below;
}

// What the block between two running sums brings, of reach a. Taking a block for crossed that is
// not does no harm: P is then outside ±aW.
static pair light_of_crossed(const moment_sum sums[2], const double n[3], double a, int p)
{
    const pair weight = sums[1].along[2][p] - sums[0].along[2][p];
    const pair part = n[0] * (sums[1].along[0][p] - sums[0].along[0][p]) +
                      n[1] * (sums[1].along[1][p] - sums[0].along[1][p]) + n[2] * weight;
    const pair reach = a * weight;
    const pair_mask in_front = part >= reach;
    const pair risen = (pair)((part > -reach) & (pair_mask)(part + reach)); // 0 behind
    const pair crossed = risen * risen / (4.0 * reach); // NaN where there is no light
    return (pair)((in_front & (pair_mask)part) | (~in_front & (pair_mask)crossed));
}

// What a normal's horizon, in a face's axes, cuts of a line of blocks.
typedef struct horizon {
    const double *n;
    double fast, slow, height; // of n: along the line, along the next line, along the face's axis
    double scale, step;        // blocks per half unit, and the width of a line
    double reach;              // a, see above
    int blocks;
} horizon;

// Where n·ω is 0 at one side of a line, in blocks; a face that n looks straight at, or away from,
// has it at ±∞.
static double crossing(const horizon *h, double side)
{
    return (1.0 - (h->height + h->slow * side) / h->fast) * 0.5 * h->scale;
}

// The blocks of a line that lie wholly in front end or begin with those that are crossed.
typedef struct cut {
    const moment_sum *crossed, *crossed_end, *front, *front_end;
} cut;

static cut cut_line(const moment_sum *sums, const horizon *h, int line)
{
    const double side = 2.0 * line / h->scale - 1.0;
    const double start = crossing(h, side), stop = crossing(h, side + h->step);
    const moment_sum *first = &sums[whole_below(start < stop ? start : stop, h->blocks)];
    const moment_sum *end = &sums[whole_above(start < stop ? stop : start, h->blocks)];
    return h->fast > 0.0 ? (cut){first, end, end, &sums[h->blocks]}
                         : (cut){first, end, sums, first};
}

// Two channels of what the lines of a face bring.
static pair gather_pair(const cut *cuts, const horizon *h, int p, pair light)
{
    const double *n = h->n;
    pair x = {0}, y = {0}, z = {0}; // of what lies wholly in front
    for (int line = 0; line < h->blocks; line++) {
        const cut *c = &cuts[line];
        x = x + c->front_end->along[0][p] - c->front->along[0][p];
        y = y + c->front_end->along[1][p] - c->front->along[1][p];
        z = z + c->front_end->along[2][p] - c->front->along[2][p];
        for (const moment_sum *k = c->crossed; k < c->crossed_end; k++) {
            light += light_of_crossed(k, n, h->reach, p);
        }
    }
    return light + (n[0] * x + n[1] * y + n[2] * z);
}

// One face, n in its axes.
static void gather_face(const block_grid *grid, int face, const double n[3], pair light[PAIRS])
{
    // Along the axis that n·ω changes faster with, the horizon crosses two blocks a line at most.
    const int direction = fabs(n[0]) >= fabs(n[1]) ? ALONG_S : ALONG_T;
    const double fast = n[direction == ALONG_S ? 0 : 1], slow = n[direction == ALONG_S ? 1 : 0];
    if (fabs(fast) + fabs(slow) + n[2] <= 0.0) {
        return; // wholly behind
    }
    const double reach = sqrt(fast * fast + slow * slow) / grid->scale;
    const horizon h = {n, fast, slow, n[2], grid->scale, 2.0 / grid->scale, reach, grid->blocks};
    cut cuts[BLOCKS_MAX];
    for (int line = 0; line < h.blocks; line++) {
        cuts[line] = cut_line(line_of(grid, direction, face, line), &h, line);
    }
    for (int p = 0; p < PAIRS; p++) {
        light[p] = gather_pair(cuts, &h, p, light[p]);
    }
}

static void irradiance_along(const block_grid *grid, glint_vec3 n, pair light[PAIRS])
{
    for (int face = 0; face < GLINT_CUBE_FACES; face++) {
        glint_vec3 axis = glint_cube_direction(face, 0.0, 0.0);
        glint_vec3 along_s = glint_vec3_subtract(glint_cube_direction(face, 1.0, 0.0), axis);
        glint_vec3 along_t = glint_vec3_subtract(glint_cube_direction(face, 0.0, 1.0), axis);
        // A component of 0 has no sign to divide by; so small a one turns n by nothing.
        const double least = 1e-30;
        double in_face[3] = {glint_vec3_dot(n, along_s), glint_vec3_dot(n, along_t),
                             glint_vec3_dot(n, axis)};
        if (fabs(in_face[0]) < least && fabs(in_face[1]) < least) {
            in_face[0] = least;
        }
        gather_face(grid, face, in_face, light);
    }
    for (int p = 0; p < PAIRS; p++) {
        light[p] /= GLINT_PI;
    }
}

// The border too: irradiance is smooth, and its own value in the plane of the face serves better
// than a neighbour's texel, which stands up to half a texel aside. Both faces then agree on their
// common edge up to the error of interpolation.
static void gather_row(size_t index, void *context)
{
    const job *shared = context;
    int edge = shared->irradiance->edge, pitch = edge + 2 * GLINT_CUBE_BORDER;
    int face = (int)index / pitch, j = (int)index % pitch - GLINT_CUBE_BORDER;
    for (int i = -GLINT_CUBE_BORDER; i < edge + GLINT_CUBE_BORDER; i++) {
        double s = (2.0 * i + 1.0) / edge - 1.0, t = (2.0 * j + 1.0) / edge - 1.0;
        const glint_vec3 normal = glint_vec3_normalize(glint_cube_direction(face, s, t));
        pair light[PAIRS] = {0};
        irradiance_along(&shared->grid, normal, light);
        float *texel = glint_cube_texel(shared->irradiance, face, i, j);
        for (int c = 0; c < 3; c++) {
            texel[c] = (float)light[c / 2][c % 2];
        }
        texel[3] = 1.0f;
    }
}

glint_status glint_irradiance_map(const glint_cube *radiance, int edge, glint_cube *irradiance,
                                  glint_error *error)
{
    job shared = {.radiance = radiance, .irradiance = irradiance};
    TRY(glint_cube_create(edge, irradiance, error));
    const glint_status status = grid_create(radiance->edge, &shared.grid, error);
    if (status != GLINT_OK) {
        glint_cube_free(irradiance);
        return status;
    }
    const size_t lines = GLINT_CUBE_FACES * (size_t)shared.grid.blocks;
    glint_parallel_for(lines, sum_row, &shared);
    glint_parallel_for(lines, sum_column, &shared);
    const size_t pitch = (size_t)edge + 2 * GLINT_CUBE_BORDER;
    glint_parallel_for(GLINT_CUBE_FACES * pitch, gather_row, &shared);
    grid_free(&shared.grid);
    return GLINT_OK;
}
