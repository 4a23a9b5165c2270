// Computes the irradiance of an environment that is constant over each texel. See irradiance.h.
//
// Over a region of constant radiance L that lies wholly in front of n, ∫ L n·ω dω = n · (L m) with
// the first moment m = ∫ ω dω. Moments add up. The faces are cut into blocks of whole texels, or of
// parts of large texels. Each row and each column of blocks keeps running sums of L m. n·ω is
// linear over a face, so the horizon of n is a straight line there. In each row it separates the
// blocks in front from the blocks behind. (It does so in each column if it crosses columns more
// steeply.) So a row costs one running sum and the blocks that the horizon crosses.
//
// The line crosses one or two blocks of a row. With g = n·ω/ω_z, linear on the face, and the weight
// w = L ω_z, such a block adds ∫ w max(0, g) dω. Only two sums are known: W of w, and P = n · Σ L m
// of w g. g is assumed to be spread evenly over P/W ± a, where a gives the spread of g over an
// evenly weighted block: (P + aW)²/(4aW). This is exact for an even weight and a line along an
// axis, and at most 6% of aW/4 too much for a diagonal line. Half a block is a ≤ h/2, h the width
// of a block. So a great circle through 2π/h blocks of h² errs by less than 0.06 · h²/4 of the
// radiance near the horizon: 4e-6 with h = 2/GRID_MIN. However uneven the weight, the part of P
// within the block is right to aW/4: h/8 of the block's irradiance from straight above. This is the
// largest error of a single bright texel (the sun), when the horizon runs through its block.
//
// Half of the normals follow from the other half: max(0, x) − max(0, −x) = x, so E(n) − E(−n) is
// n · M. M is the first moment of the whole sphere. The opposite of a texel's normal is also a
// texel's normal.
#include "environment/irradiance.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "kernels/layout.h"

#include <stdint.h>
#include <stdlib.h>

enum {
    GRID_MIN = 128,  // least number of blocks along a face's edge
    CELLS_MAX = 128, // most cells along a block's edge; the largest cube has fewer
    // Rows of blocks that a thread sums at once. Neighbouring rows share cache lines.
    BAND = 4,
    // Normals along the edge of a square. Their horizons pass the same blocks.
    TILE = 8,
    AXES = 3, // axes of a face: s, t and its normal
    CHANNELS = 3,
    PAIRS = (AXES * CHANNELS + 1) / 2,
};

// Vectors that fit the registers of every x86-64. Each lane is computed as a scalar would be.
typedef double pair __attribute__((vector_size(2 * sizeof(double))));
typedef float quad __attribute__((vector_size(4 * sizeof(float))));
typedef int32_t quad_mask __attribute__((vector_size(4 * sizeof(int32_t))));

// Σ L m: [axis][channel], padded with a 0.
typedef struct moment_sum {
    pair of[PAIRS];
} moment_sum;

// A block, with a lane for each channel. Floats suffice: only horizons that cross it read it.
typedef struct block {
    quad s, t;   // P/W along s and t, 0 without light; along the normal it is 1
    quad weight; // W
} block;

// Blocks are the same along both axes of a face. A line is a row (ALONG_S) or a column (ALONG_T).
enum { ALONG_S, ALONG_T, DIRECTIONS };

typedef struct block_grid {
    int cells;    // cells along a face's edge; a cell has constant radiance
    int parts;    // cells along a texel's edge
    int whole;    // cells along a block's edge; the last block may have fewer
    int blocks;   // blocks along a face's edge
    double scale; // the same, counting only the part of the last block that exists
    // [face][line][-1 … blocks + 1]: the sum of the blocks of a line before block k. The ends
    // repeat the sums of no block and of all blocks.
    moment_sum *before[DIRECTIONS];
    block *lights[DIRECTIONS];     // [face][line][-1 … blocks + 1]; empty blocks at the ends
    moment_sum *above[DIRECTIONS]; // [face][blocks + 1]: the sum of the lines before line k
} block_grid;

// The data that all threads share.
typedef struct job {
    const glint_cube *radiance;
    glint_cube *irradiance;
    block_grid grid;
} job;

// The index of block 0 of a line, in `lights` and in `before`.
static size_t place_of(const block_grid *grid, int face, int line)
{
    const size_t blocks = (size_t)grid->blocks;
    return ((size_t)face * blocks + (size_t)line) * (blocks + 3) + 1;
}

static moment_sum *above_of(const block_grid *grid, int direction, int face)
{
    return grid->above[direction] + (size_t)face * ((size_t)grid->blocks + 1);
}

// Unrolled: a loop would keep the sum in memory.
static inline void add_sum(const moment_sum *a, moment_sum *to)
{
    to->of[0] += a->of[0];
    to->of[1] += a->of[1];
    to->of[2] += a->of[2];
    to->of[3] += a->of[3];
    to->of[4] += a->of[4];
}

static void subtract_sum(const moment_sum *a, moment_sum *from)
{
    for (int p = 0; p < PAIRS; p++) {
        from->of[p] -= a->of[p];
    }
}

// Adds n · Σ L m to the light.
static void add_light(const moment_sum *sum, const double n[AXES], double light[CHANNELS])
{
    for (int k = 0; k < AXES * CHANNELS; k++) {
        light[k % CHANNELS] += n[k / CHANNELS] * sum->of[k / 2][k % 2];
    }
}

// ---- Moments ------------------------------------------------------------------------------------

// Moments of a row of cells of a block. Along s and t, the moment is s or t times `aside`; along
// the face's normal it is `ahead`.
typedef struct cell_row {
    int first, count; // cells
    double t;
    double s[CELLS_MAX], aside[CELLS_MAX], ahead[CELLS_MAX];
} cell_row;

// ω dω is (s, t, 1) u² ds dt with u = 1/(1 + s² + t²). Over a square of edge h, a function's mean
// is its value in the middle plus h²/24 of its Laplacian there: 16u³ − 24u⁴ for u², and
// s (8u³ − 24u⁴) for s u². The remaining terms are less than 0.12 h⁴ of the whole: 7e-9 with
// h = 2/GRID_MIN.
static void weigh_cells(int cells, int row, cell_row *out)
{
    const double h = 2.0 / cells, area = h * h;
    out->t = (row + 0.5) * h - 1.0;
    for (int i = 0; i < out->count; i++) {
        const double s = (out->first + i + 0.5) * h - 1.0;
        const double u = 1.0 / (1.0 + s * s + out->t * out->t), weight = area * u * u;
        out->s[i] = s;
        out->aside[i] = weight * (1.0 + area * (u / 3.0 - u * u));
        out->ahead[i] = weight * (1.0 + area * (2.0 * u / 3.0 - u * u));
    }
}

// Sums of a block: a pair for R and G, a pair for B and the unused channel.
typedef struct block_sum {
    pair along[AXES][2];
} block_sum;

static void sum_cells(const float *texels, int parts, const cell_row *row, block_sum *sum)
{
    pair x[2] = {sum->along[0][0], sum->along[0][1]}, y[2] = {{0}, {0}};
    pair z[2] = {sum->along[2][0], sum->along[2][1]};
    for (int i = 0; i < row->count; i++) {
        const int cell = row->first + i;
        const float *texel = texels + 4 * (parts == 1 ? cell : cell / parts);
        const pair radiance[2] = {{(double)texel[0], (double)texel[1]},
                                  {(double)texel[2], (double)texel[3]}};
        for (int p = 0; p < 2; p++) {
            const pair aside = radiance[p] * row->aside[i];
            x[p] += aside * row->s[i];
            y[p] += aside;
            z[p] += radiance[p] * row->ahead[i];
        }
    }
    for (int p = 0; p < 2; p++) {
        sum->along[0][p] = x[p];
        sum->along[1][p] += y[p] * row->t;
        sum->along[2][p] = z[p];
    }
}

static int end_of_block(const block_grid *grid, int i)
{
    const int end = (i + 1) * grid->whole;
    return end < grid->cells ? end : grid->cells;
}

// Sums the block at a row and a column, for all faces.
static void sum_block(const job *shared, int row, int column, block_sum sums[GLINT_CUBE_FACES])
{
    const block_grid *grid = &shared->grid;
    cell_row cells;
    cells.first = column * grid->whole;
    cells.count = end_of_block(grid, column) - cells.first;
    for (int j = row * grid->whole; j < end_of_block(grid, row); j++) {
        weigh_cells(grid->cells, j, &cells);
        for (int face = 0; face < GLINT_CUBE_FACES; face++) {
            const float *texels = glint_cube_texel(shared->radiance, face, 0, j / grid->parts);
            sum_cells(texels, grid->parts, &cells, &sums[face]);
        }
    }
}

static moment_sum pack_sum(const block_sum *sum)
{
    moment_sum packed = {0};
    for (int k = 0; k < AXES * CHANNELS; k++) {
        const int channel = k % CHANNELS;
        packed.of[k / 2][k % 2] = sum->along[k / CHANNELS][channel / 2][channel % 2];
    }
    return packed;
}

static block light_of(const block_sum *sum)
{
    block light = {0};
    for (int c = 0; c < CHANNELS; c++) {
        const double weight = sum->along[2][c / 2][c % 2];
        const double share = weight > 0.0 ? 1.0 / weight : 0.0;
        light.s[c] = (float)(sum->along[0][c / 2][c % 2] * share);
        light.t[c] = (float)(sum->along[1][c / 2][c % 2] * share);
        light.weight[c] = (float)weight;
    }
    return light;
}

// Fills the ends of a line of blocks whose sums are complete.
static void close_line(const block_grid *grid, int direction, size_t place)
{
    moment_sum *before = grid->before[direction] + place;
    block *lights = grid->lights[direction] + place;
    before[-1] = before[0] = (moment_sum){0};
    before[grid->blocks + 1] = before[grid->blocks];
    lights[-1] = lights[grid->blocks] = (block){0};
}

// Sums a row of blocks. Stores its running sums, and the blocks themselves in the place of the
// columns' sums.
static void sum_row(const job *shared, int row)
{
    const block_grid *grid = &shared->grid;
    moment_sum running[GLINT_CUBE_FACES] = {0};
    for (int column = 0; column < grid->blocks; column++) {
        block_sum sums[GLINT_CUBE_FACES] = {0};
        sum_block(shared, row, column, sums);
        for (int face = 0; face < GLINT_CUBE_FACES; face++) {
            const size_t s = place_of(grid, face, row) + (size_t)column;
            const size_t t = place_of(grid, face, column) + (size_t)row;
            const moment_sum sum = pack_sum(&sums[face]);
            add_sum(&sum, &running[face]);
            grid->before[ALONG_S][s + 1] = running[face];
            grid->before[ALONG_T][t + 1] = sum;
            grid->lights[ALONG_S][s] = grid->lights[ALONG_T][t] = light_of(&sums[face]);
        }
    }
    for (int face = 0; face < GLINT_CUBE_FACES; face++) {
        close_line(grid, ALONG_S, place_of(grid, face, row));
    }
}

static void sum_band(size_t index, void *context)
{
    const job *shared = context;
    const int first = (int)index * BAND;
    for (int row = first; row < first + BAND && row < shared->grid.blocks; row++) {
        sum_row(shared, row);
    }
}

static void sum_column(size_t index, void *context)
{
    const job *shared = context;
    const block_grid *grid = &shared->grid;
    const size_t place = place_of(grid, (int)index / grid->blocks, (int)index % grid->blocks);
    moment_sum *before = grid->before[ALONG_T] + place;
    for (int row = 1; row < grid->blocks; row++) {
        add_sum(&before[row], &before[row + 1]);
    }
    close_line(grid, ALONG_T, place);
}

// Sums the lines of a face, in one direction.
static void sum_lines(size_t index, void *context)
{
    const job *shared = context;
    const block_grid *grid = &shared->grid;
    const int direction = (int)index / GLINT_CUBE_FACES, face = (int)index % GLINT_CUBE_FACES;
    moment_sum *above = above_of(grid, direction, face);
    above[0] = (moment_sum){0};
    for (int line = 0; line < grid->blocks; line++) {
        const size_t end = place_of(grid, face, line) + (size_t)grid->blocks;
        above[line + 1] = above[line];
        add_sum(&grid->before[direction][end], &above[line + 1]);
    }
}

static void grid_free(block_grid *grid)
{
    for (int direction = 0; direction < DIRECTIONS; direction++) {
        free(grid->before[direction]);
        free(grid->lights[direction]);
        free(grid->above[direction]);
    }
    *grid = (block_grid){0};
}

static glint_status grid_create(int texels, block_grid *grid, glint_error *error)
{
    *grid = (block_grid){.parts = texels < GRID_MIN ? (GRID_MIN + texels - 1) / texels : 1,
                         .whole = texels < GRID_MIN ? 1 : texels / GRID_MIN};
    grid->cells = texels * grid->parts;
    grid->blocks = (grid->cells + grid->whole - 1) / grid->whole;
    grid->scale = (double)grid->cells / grid->whole;
    const size_t end = place_of(grid, GLINT_CUBE_FACES, 0);
    const size_t lines = GLINT_CUBE_FACES * ((size_t)grid->blocks + 1);
    for (int direction = 0; direction < DIRECTIONS; direction++) {
        grid->before[direction] = glint_allocate_unset(end, sizeof(moment_sum));
        grid->lights[direction] = glint_allocate_unset(end, sizeof(block));
        grid->above[direction] = glint_allocate_unset(lines, sizeof(moment_sum));
        if (grid->before[direction] == NULL || grid->lights[direction] == NULL ||
            grid->above[direction] == NULL) {
            return glint_fail_memory(error, "an irradiance map");
        }
    }
    return GLINT_OK;
}

// ---- Gathering ----------------------------------------------------------------------------------

// How a normal's horizon runs over a face, in the direction that it crosses more steeply. Places on
// a line are in blocks · 2³².
typedef struct horizon {
    // The least place on line 0; its change per line; |step|.
    int64_t low, step, span;
    int first, end;   // the range of lines that the horizon crosses
    bool rises;       // on a line, the front is beyond the horizon, not before it
    double reach;     // a
    quad s, t, ahead; // n/2a, with ½ added to `ahead`
} horizon;

#define ONE_BLOCK ((int64_t)1 << 32)

static quad four(double value)
{
    const float f = (float)value;
    return (quad){f, f, f, f};
}

static horizon find_horizon(const block_grid *grid, int direction, const double n[AXES])
{
    // The line at `side` is crossed at s (or t) = −(ahead + slow · side)/fast.
    const double fast = n[direction == ALONG_S ? 0 : 1], slow = n[direction == ALONG_S ? 1 : 0];
    const double start = (1.0 - (n[2] - slow) / fast) * 0.5 * grid->scale;
    const double reach = sqrt(fast * fast + slow * slow) / grid->scale, share = 0.5 / reach;
    horizon h = {.step = (int64_t)(-slow / fast * (double)ONE_BLOCK),
                 .rises = fast > 0.0,
                 .reach = reach,
                 .s = four(n[0] * share),
                 .t = four(n[1] * share),
                 .ahead = four(n[2] * share + 0.5)};
    h.span = h.step < 0 ? -h.step : h.step;
    h.low = (int64_t)floor(start * (double)ONE_BLOCK) + (h.step < 0 ? h.step : 0);
    return h;
}

static bool crosses(const horizon *h, int line, int blocks)
{
    const int64_t low = h->low + h->step * line;
    return low + h->span > 0 && low < blocks * ONE_BLOCK;
}

static void find_lines(horizon *h, int blocks)
{
    h->end = blocks;
    while (h->first < h->end && !crosses(h, h->first, blocks)) {
        h->first++;
    }
    while (h->first < h->end && !crosses(h, h->end - 1, blocks)) {
        h->end--;
    }
}

static quad above_zero(quad value)
{
    return (quad)((value > 0.0f) & (quad_mask)value);
}

// The light of a crossed block, over a: W ((P/aW + 1)/2)², and the straight line where P > aW.
static quad light_of_crossed(const block *b, const horizon *h, quad weight)
{
    const quad risen = above_zero(h->s * b->s + h->t * b->t + h->ahead);
    const quad beyond = above_zero(risen - 1.0f);
    return weight * (risen * risen - beyond * beyond);
}

// Adds the light of the crossed blocks, over a. Returns the sum of the blocks before the horizon,
// over all crossed lines. It includes the crossed blocks if `rises`.
static moment_sum walk_lines(const block_grid *grid, int direction, size_t place, const horizon *h,
                             quad *crossed)
{
    static const quad_mask taken[2] = {{0, 0, 0, 0}, {-1, -1, -1, -1}};
    const ptrdiff_t pitch = grid->blocks + 3;
    const moment_sum *before = grid->before[direction] + place + h->first * pitch;
    const block *lights = grid->lights[direction] + place + h->first * pitch;
    int64_t low = h->low + h->step * h->first;
    moment_sum sum = {0};
    quad light = {0};
    for (int line = h->first; line < h->end; line++) {
        const ptrdiff_t first = (ptrdiff_t)(low >> 32);
        const int second = (low & (ONE_BLOCK - 1)) + h->span > ONE_BLOCK;
        add_sum(&before[h->rises ? first + 1 + second : first], &sum);
        const block *b = &lights[first];
        light += light_of_crossed(&b[0], h, b[0].weight);
        light += light_of_crossed(&b[1], h, (quad)((quad_mask)b[1].weight & taken[second]));
        before += pitch;
        lights += pitch;
        low += h->step;
    }
    *crossed = light;
    return sum;
}

// Adds the light of one face; n is in the face's axes.
static void gather_face(const block_grid *grid, int face, const double n[AXES],
                        double light[CHANNELS])
{
    const double across = fabs(n[0]) + fabs(n[1]);
    const int direction = fabs(n[0]) >= fabs(n[1]) ? ALONG_S : ALONG_T, blocks = grid->blocks;
    const moment_sum *above = above_of(grid, direction, face);
    if (!(across > fabs(n[2]))) { // wholly in front or behind
        if (n[2] > 0.0) {
            add_light(&above[blocks], n, light);
        }
        return;
    }
    horizon h = find_horizon(grid, direction, n);
    find_lines(&h, blocks);
    quad crossed;
    moment_sum sum = walk_lines(grid, direction, place_of(grid, face, 0), &h, &crossed);
    // In a line that is not crossed, either all blocks lie before the horizon or none.
    if (h.low >= blocks * ONE_BLOCK) {
        add_sum(&above[h.first], &sum);
    }
    if (h.low + h.step * (blocks - 1) >= blocks * ONE_BLOCK) {
        add_sum(&above[blocks], &sum);
        subtract_sum(&above[h.end], &sum);
    }
    moment_sum front = above[blocks];
    subtract_sum(&sum, &front);
    add_light(h.rises ? &front : &sum, n, light);
    for (int c = 0; c < CHANNELS; c++) {
        light[c] += h.reach * (double)crossed[c];
    }
}

typedef struct face_axes {
    glint_vec3 s, t, ahead;
} face_axes;

static face_axes axes_of(int face)
{
    const glint_vec3 ahead = glint_cube_direction(face, 0.0, 0.0);
    return (face_axes){glint_vec3_subtract(glint_cube_direction(face, 1.0, 0.0), ahead),
                       glint_vec3_subtract(glint_cube_direction(face, 0.0, 1.0), ahead), ahead};
}

static void turn_to_face(const face_axes *axes, glint_vec3 n, double out[AXES])
{
    out[0] = glint_vec3_dot(n, axes->s);
    out[1] = glint_vec3_dot(n, axes->t);
    out[2] = glint_vec3_dot(n, axes->ahead);
}

// A normal of the map, the light that it receives, and the light that its opposite receives.
typedef struct receiver {
    int i, j;
    glint_vec3 n;
    double light[2][CHANNELS];
} receiver;

static void gather(const block_grid *grid, receiver *receivers, int count)
{
    for (int face = 0; face < GLINT_CUBE_FACES; face++) {
        const face_axes axes = axes_of(face);
        const moment_sum *all = above_of(grid, ALONG_S, face) + grid->blocks;
        for (int k = 0; k < count; k++) {
            double n[AXES];
            turn_to_face(&axes, receivers[k].n, n);
            gather_face(grid, face, n, receivers[k].light[0]);
            const double opposite[AXES] = {-n[0], -n[1], -n[2]};
            add_light(all, opposite, receivers[k].light[1]);
        }
    }
}

static void store(float *texel, const double light[CHANNELS])
{
    for (int c = 0; c < CHANNELS; c++) {
        texel[c] = light[c] > 0.0 ? (float)(light[c] / GLINT_PI) : 0.0f;
    }
    texel[3] = 1.0f;
}

// Stores the texel of a face and the opposite texel, seen from the cube's middle, on the opposite
// face.
static void store_receiver(const glint_cube *map, int face, const receiver *r)
{
    const face_axes here = axes_of(face), there = axes_of(face + 1);
    const int last = map->edge - 1;
    const int i = glint_vec3_dot(here.s, there.s) < 0.0 ? r->i : last - r->i;
    const int j = glint_vec3_dot(here.t, there.t) < 0.0 ? r->j : last - r->j;
    const double opposite[CHANNELS] = {r->light[0][0] + r->light[1][0],
                                       r->light[0][1] + r->light[1][1],
                                       r->light[0][2] + r->light[1][2]};
    store(glint_cube_texel(map, face, r->i, r->j), r->light[0]);
    store(glint_cube_texel(map, face + 1, i, j), opposite);
}

static int tiles_of(int edge)
{
    return (edge + 2 * GLINT_CUBE_BORDER + TILE - 1) / TILE;
}

// Fills the border too. Irradiance is smooth, so its own value in the plane of the face serves
// better than a neighbour's texel, which is up to half a texel aside. Both faces then agree on
// their common edge up to the error of interpolation.
static void gather_tile(size_t index, void *context)
{
    const job *shared = context;
    const int edge = shared->irradiance->edge, tiles = tiles_of(edge);
    const int face = 2 * ((int)index / tiles / tiles); // and the opposite face, face + 1
    const int first_i = (int)index % tiles * TILE - GLINT_CUBE_BORDER;
    const int first_j = (int)index / tiles % tiles * TILE - GLINT_CUBE_BORDER;
    receiver receivers[TILE * TILE];
    int count = 0;
    for (int j = first_j; j < first_j + TILE && j < edge + GLINT_CUBE_BORDER; j++) {
        for (int i = first_i; i < first_i + TILE && i < edge + GLINT_CUBE_BORDER; i++) {
            const double s = (2.0 * i + 1.0) / edge - 1.0, t = (2.0 * j + 1.0) / edge - 1.0;
            const glint_vec3 n = glint_vec3_normalize(glint_cube_direction(face, s, t));
            receivers[count++] = (receiver){i, j, n, {{0}}};
        }
    }
    gather(&shared->grid, receivers, count);
    for (int k = 0; k < count; k++) {
        store_receiver(shared->irradiance, face, &receivers[k]);
    }
}

glint_status glint_irradiance_map(const glint_cube *radiance, int edge, glint_cube *irradiance,
                                  glint_error *error)
{
    job shared = {.radiance = radiance, .irradiance = irradiance};
    TRY(glint_cube_create(edge, irradiance, error));
    const glint_status status = grid_create(radiance->edge, &shared.grid, error);
    if (status == GLINT_OK) {
        const size_t blocks = (size_t)shared.grid.blocks, tiles = (size_t)tiles_of(edge);
        glint_parallel_for((blocks + BAND - 1) / BAND, sum_band, &shared);
        glint_parallel_for(GLINT_CUBE_FACES * blocks, sum_column, &shared);
        glint_parallel_for(DIRECTIONS * GLINT_CUBE_FACES, sum_lines, &shared);
        glint_parallel_for(GLINT_CUBE_FACES / 2 * tiles * tiles, gather_tile, &shared);
    } else {
        glint_cube_free(irradiance);
    }
    grid_free(&shared.grid);
    return status;
}
