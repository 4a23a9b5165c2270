// Computes coarser levels of a cube map. See mip_levels.h.
#include "environment/mip_levels.h"

#include "base/half.h"
#include "base/parallel.h"
#include "environment/half_texels.h"
#include "kernels/layout.h"

#include <math.h>

size_t glint_mip_levels_size(int edge)
{
    size_t size = 0;
    for (; edge > 0; edge /= 2) {
        size += glint_cube_size(&(glint_cube){.edge = edge});
    }
    return size;
}

// The texels of the finer level's row that a coarser texel covers, and how much of each. A texel
// covers two; if the edge shrinks from 2m + 1 to m, it covers three.
typedef struct span {
    int first, count;
    double shares[3];
} span;

static span find_span(int place, int finer, int coarser)
{
    if (finer == 2 * coarser) {
        return (span){2 * place, 2, {1, 1}};
    }
    return (span){2 * place, 3, {1 - (double)place / coarser, 1, (place + 1.0) / coarser}};
}

// The solid angle of the rectangle from the corner (0, 0) to (s, t) at the distance 1.
static double corner_angle(double s, double t)
{
    return atan2(s * t, sqrt(1 + s * s + t * t));
}

static double texel_angle(int edge, int i, int j)
{
    const double s0 = 2.0 * i / edge - 1, s1 = 2.0 * (i + 1) / edge - 1;
    const double t0 = 2.0 * j / edge - 1, t1 = 2.0 * (j + 1) / edge - 1;
    return corner_angle(s1, t1) - corner_angle(s0, t1) - corner_angle(s1, t0) +
           corner_angle(s0, t0);
}

typedef struct halving {
    const glint_cube *from;
    glint_cube *to;
} halving;

// Computes texel (i, j) of the coarser level for all faces.
static void halve_texel(const halving *h, int i, int j, const span *columns, const span *rows)
{
    double sums[GLINT_CUBE_FACES][4] = {{0}}, weights = 0;
    for (int k = 0; k < rows->count * columns->count; k++) {
        const int y = k / columns->count, x = k % columns->count;
        const int column = columns->first + x, row = rows->first + y;
        const double weight =
            rows->shares[y] * columns->shares[x] * texel_angle(h->from->edge, column, row);
        weights += weight;
        for (int n = 0; n < GLINT_CUBE_FACES * 4; n++) {
            sums[n / 4][n % 4] +=
                weight * (double)glint_cube_texel(h->from, n / 4, column, row)[n % 4];
        }
    }
    for (int n = 0; n < GLINT_CUBE_FACES * 4; n++) {
        glint_cube_texel(h->to, n / 4, i, j)[n % 4] = (float)(sums[n / 4][n % 4] / weights);
    }
}

static void halve_row(size_t index, void *context)
{
    const halving *h = context;
    const int finer = h->from->edge, coarser = h->to->edge, j = (int)index;
    const span rows = find_span(j, finer, coarser);
    for (int i = 0; i < coarser; i++) {
        const span columns = find_span(i, finer, coarser);
        halve_texel(h, i, j, &columns, &rows);
    }
}

void glint_mip_levels_fill(const glint_cube *cube, float *coarser)
{
    glint_cube finer = *cube;
    while (finer.edge > 1) {
        glint_cube level = {.edge = finer.edge / 2};
        level.texels = coarser;
        halving h = {&finer, &level};
        glint_parallel_for((size_t)level.edge, halve_row, &h);
        glint_cube_fill_border(&level);
        coarser += glint_cube_size(&level);
        finer = level;
    }
}

void glint_mip_levels_to_half(const glint_cube *cube, float *coarser, uint16_t *texels)
{
    glint_cube_to_half(cube, texels);
    texels += glint_cube_size(cube);
    for (int edge = cube->edge / 2; edge > 0; edge /= 2) {
        const glint_cube level = {.edge = edge, .texels = coarser};
        const size_t size = glint_cube_size(&level);
        for (size_t i = 0; i < size; i++) {
            coarser[i] = fmaxf(fminf(coarser[i], GLINT_HALF_MAX), -GLINT_HALF_MAX);
        }
        glint_cube_to_half(&level, texels);
        coarser += size;
        texels += size;
    }
}
