// Implements the cube map: places, directions, border and look-up. See cube.h.
#include "environment/cube.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "kernels/layout.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

_Static_assert(GLINT_CUBE_EDGE_MAX >> GLINT_LEVELS_MAX == 0,
               "the largest cube has too many levels");

static const int s_axis[GLINT_CUBE_FACES] = GLINT_CUBE_S_AXIS;
static const int s_sign[GLINT_CUBE_FACES] = GLINT_CUBE_S_SIGN;
static const int t_axis[GLINT_CUBE_FACES] = GLINT_CUBE_T_AXIS;
static const int t_sign[GLINT_CUBE_FACES] = GLINT_CUBE_T_SIGN;

static glint_status create(int edge, void *(*allocate)(size_t, size_t), glint_cube *cube,
                           glint_error *error)
{
    *cube = (glint_cube){0};
    if (edge < 1 || edge > GLINT_CUBE_EDGE_MAX) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "environment: a cube of %d texels an edge (1 to %d can be held)", edge,
                          GLINT_CUBE_EDGE_MAX);
    }
    glint_cube sized = {.edge = edge};
    float *texels = allocate(glint_cube_size(&sized), sizeof(float));
    if (texels == NULL) {
        return glint_fail_memory(error, "an environment");
    }
    *cube = (glint_cube){.edge = edge, .texels = texels};
    return GLINT_OK;
}

glint_status glint_cube_create(int edge, glint_cube *cube, glint_error *error)
{
    return create(edge, glint_allocate, cube, error);
}

glint_status glint_cube_create_unset(int edge, glint_cube *cube, glint_error *error)
{
    return create(edge, glint_allocate_unset, cube, error);
}

void glint_cube_free(glint_cube *cube)
{
    if (cube->mapped_from > 0) {
        char *mapped = (char *)cube->texels - cube->mapped_from;
        munmap(mapped, cube->mapped_from + glint_cube_size(cube) * sizeof(float));
    } else {
        free(cube->texels);
    }
    *cube = (glint_cube){0};
}

size_t glint_cube_size(const glint_cube *cube)
{
    size_t pitch = (size_t)cube->edge + 2 * GLINT_CUBE_BORDER;
    return cube->edge < 1 ? 0 : GLINT_CUBE_FACES * pitch * pitch * 4;
}

float *glint_cube_texel(const glint_cube *cube, int face, int i, int j)
{
    ptrdiff_t pitch = cube->edge, row = j, column = i;
    pitch += 2 * GLINT_CUBE_BORDER;
    row += GLINT_CUBE_BORDER;
    column += GLINT_CUBE_BORDER;
    return cube->texels + ((face * pitch + row) * pitch + column) * 4;
}

void glint_cube_store(const glint_cube *cube, int face, int i, int j, const double rgb[3])
{
    float *texel = glint_cube_texel(cube, face, i, j);
    for (int c = 0; c < 3; c++) {
        texel[c] = (float)rgb[c];
    }
    texel[3] = 1.0f;
}

glint_vec3 glint_cube_direction(int face, double s, double t)
{
    double d[3] = {0.0, 0.0, 0.0};
    d[face / 2] = face % 2 == 0 ? 1.0 : -1.0;
    d[s_axis[face]] = s * s_sign[face];
    d[t_axis[face]] = t * t_sign[face];
    return (glint_vec3){d[0], d[1], d[2]};
}

int glint_cube_place(glint_vec3 direction, double *s, double *t)
{
    double d[3] = {direction.x, direction.y, direction.z};
    double x = fabs(d[0]), y = fabs(d[1]), z = fabs(d[2]);
    int axis = x >= y && x >= z ? 0 : (y >= z ? 1 : 2);
    int face = 2 * axis + (d[axis] < 0.0 ? 1 : 0);
    double major = fabs(d[axis]);
    *s = d[s_axis[face]] * s_sign[face] / major;
    *t = d[t_axis[face]] * t_sign[face] / major;
    return face;
}

static int clamp_index(double place, int last)
{
    // NaN, from a direction that is zero or not finite, becomes 0.
    return place > 0.0 ? (place < last ? (int)place : last) : 0;
}

// The neighbour's texel across the edge from border place (i, j): the texel that the border's
// centre looks at. This direction runs from s = 1 + 1/N on this plane to N/(N + 1) on the
// neighbour's plane, inside its outermost texels. Along the edge it shifts by at most
// (N − 1)/(N(N + 1)), less than the half texel of 1/N.
static const float *texel_across(const glint_cube *cube, int face, int i, int j)
{
    double n = cube->edge, s, t;
    glint_vec3 d = glint_cube_direction(face, (2.0 * i + 1.0) / n - 1.0, (2.0 * j + 1.0) / n - 1.0);
    int neighbour = glint_cube_place(d, &s, &t);
    int column = clamp_index((s + 1.0) * 0.5 * n, cube->edge - 1);
    int row = clamp_index((t + 1.0) * 0.5 * n, cube->edge - 1);
    return glint_cube_texel(cube, neighbour, column, row);
}

// One side of a face. Border place k is (i, j) + k (along_i, along_j). The face's own texel next to
// it is (into_i, into_j) further in.
typedef struct side {
    int i, j, along_i, along_j, into_i, into_j;
} side;

// On the edge at height t the value is e = ½(a(t′) + b(t′)) with t′ = t(1 − 1/2N); a and b are the
// outermost texels of the two faces. Seen from the centre, the point half way between these two
// texels lies a little further out along the edge than the texels do on their planes. Both faces
// have the same e, so the look-up is continuous, and it is right to second order. The border 2e − a
// makes bilinear interpolation go through e. It may be negative beside a bright texel. A look-up is
// between a and e, so it is never negative.
static void fill_side(glint_cube *cube, int face, const side *at)
{
    int n = cube->edge;
    for (int k = 0; k < n; k++) {
        double t = (2.0 * k + 1.0) / n - 1.0;
        int inner = n == 1 ? 0 : (t < 0.0 ? k + 1 : k - 1); // towards the middle of the edge
        double share = fabs(t) / 4.0;                       // t − t′, in texels
        int i = at->i + k * at->along_i, j = at->j + k * at->along_j;
        int inner_i = at->i + inner * at->along_i, inner_j = at->j + inner * at->along_j;
        const float *own = glint_cube_texel(cube, face, i + at->into_i, j + at->into_j);
        const float *own_inner =
            glint_cube_texel(cube, face, inner_i + at->into_i, inner_j + at->into_j);
        const float *across = texel_across(cube, face, i, j);
        const float *across_inner = texel_across(cube, face, inner_i, inner_j);
        float *border = glint_cube_texel(cube, face, i, j);
        for (int c = 0; c < 4; c++) {
            double a = (double)own[c], b = (double)across[c];
            double twice_e =
                a + b + share * ((double)own_inner[c] - a + (double)across_inner[c] - b);
            border[c] = (float)(twice_e - a);
        }
    }
}

// Three faces meet in a corner. For all of them its value is the mean of their three texels.
static void fill_corner(glint_cube *cube, int face, int right, int down)
{
    int n = cube->edge;
    int border_i = right ? n : -1, border_j = down ? n : -1;
    int inside_i = right ? n - 1 : 0, inside_j = down ? n - 1 : 0;
    const float *own = glint_cube_texel(cube, face, inside_i, inside_j);
    const float *beside = glint_cube_texel(cube, face, border_i, inside_j);
    const float *below = glint_cube_texel(cube, face, inside_i, border_j);
    const float *across_beside = texel_across(cube, face, border_i, inside_j);
    const float *across_below = texel_across(cube, face, inside_i, border_j);
    float *corner = glint_cube_texel(cube, face, border_i, border_j);
    for (int c = 0; c < 4; c++) {
        double mean = ((double)own[c] + (double)across_beside[c] + (double)across_below[c]) / 3.0;
        corner[c] = (float)(4.0 * mean - (double)own[c] - (double)beside[c] - (double)below[c]);
    }
}

static void fill_face_border(size_t face, void *context)
{
    glint_cube *cube = context;
    const int n = cube->edge;
    const side sides[4] = {
        {-1, 0, 0, 1, 1, 0}, {n, 0, 0, 1, -1, 0}, {0, -1, 1, 0, 0, 1}, {0, n, 1, 0, 0, -1}};
    for (int k = 0; k < 4; k++) {
        fill_side(cube, (int)face, &sides[k]);
    }
    for (int corner = 0; corner < 4; corner++) {
        fill_corner(cube, (int)face, corner % 2, corner / 2);
    }
}

// A face reads its neighbours' insides and its own border only.
void glint_cube_fill_border(glint_cube *cube)
{
    glint_parallel_for(cube->edge > 0 ? GLINT_CUBE_FACES : 0, fill_face_border, cube);
}

// The texel of a cube of edge n whose centre has the coordinate s on a face.
static int texel_at(double s, int n)
{
    return (int)lround(((s + 1) * n - 1) / 2);
}

static void mirror_face(const glint_cube *from, glint_vec3 signs, int face, glint_cube *to)
{
    const int n = from->edge;
    for (int j = 0; j < n; j++) {
        for (int i = 0; i < n; i++) {
            const glint_vec3 d =
                glint_cube_direction(face, (2.0 * i + 1) / n - 1, (2.0 * j + 1) / n - 1);
            double s, t;
            const int source =
                glint_cube_place((glint_vec3){signs.x * d.x, signs.y * d.y, signs.z * d.z}, &s, &t);
            memcpy(glint_cube_texel(to, face, i, j),
                   glint_cube_texel(from, source, texel_at(s, n), texel_at(t, n)),
                   4 * sizeof(float));
        }
    }
}

glint_status glint_cube_mirror(glint_cube *cube, const char *flip, glint_error *error)
{
    const glint_vec3 signs = {strchr(flip, 'x') != NULL ? -1 : 1,
                              strchr(flip, 'y') != NULL ? -1 : 1,
                              strchr(flip, 'z') != NULL ? -1 : 1};
    glint_cube mirrored;
    TRY(glint_cube_create(cube->edge, &mirrored, error));
    for (int face = 0; face < GLINT_CUBE_FACES; face++) {
        mirror_face(cube, signs, face, &mirrored);
    }
    glint_cube_fill_border(&mirrored);
    glint_cube_free(cube);
    *cube = mirrored;
    return GLINT_OK;
}

void glint_cube_sample(const glint_cube *cube, glint_vec3 direction, double rgb[3])
{
    double s, t, n = cube->edge;
    int face = glint_cube_place(direction, &s, &t);
    // In texels from the centre of the first border texel; the last cell begins at column n.
    double column = (s + 1.0) * 0.5 * n + 0.5, row = (t + 1.0) * 0.5 * n + 0.5;
    int i = clamp_index(column, cube->edge), j = clamp_index(row, cube->edge);
    double right = column - i, down = row - j;
    const float *upper = glint_cube_texel(cube, face, i - 1, j - 1);
    const float *lower = glint_cube_texel(cube, face, i - 1, j);
    for (int c = 0; c < 3; c++) {
        double above = (double)upper[c] + right * ((double)upper[c + 4] - (double)upper[c]);
        double below = (double)lower[c] + right * ((double)lower[c + 4] - (double)lower[c]);
        rgb[c] = above + down * (below - above);
    }
}
