// Makes spheres of triangles. See icosphere.h.
#include "scene/shape/icosphere.h"

typedef struct receiver {
    void (*triangle)(void *context, const glint_vec3 corners[3]);
    void *context;
} receiver;

// The middle of an edge is the same from both sides: a + b = b + a, bit for bit.
static glint_vec3 middle(glint_vec3 a, glint_vec3 b)
{
    return glint_vec3_normalize(glint_vec3_add(a, b));
}

static void quarter(const receiver *to, const glint_vec3 corners[3], int level)
{
    if (level == 0) {
        to->triangle(to->context, corners);
        return;
    }
    const glint_vec3 a = corners[0], b = corners[1], c = corners[2];
    const glint_vec3 ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    const glint_vec3 parts[4][3] = {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}};
    for (int i = 0; i < 4; i++) {
        quarter(to, parts[i], level - 1);
    }
}

void glint_icosphere(int level, void (*triangle)(void *context, const glint_vec3 corners[3]),
                     void *context)
{
    static const signed char faces[20][3] = {
        {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
        {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
        {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    // The corners of three golden rectangles in the planes of the axes.
    const double g = (1 + sqrt(5)) / 2;
    const glint_vec3 corners[12] = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                    {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                    {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
    const receiver to = {triangle, context};
    for (int face = 0; face < 20; face++) {
        glint_vec3 whole[3];
        for (int k = 0; k < 3; k++) {
            whole[k] = glint_vec3_normalize(corners[faces[face][k]]);
        }
        quarter(&to, whole, level);
    }
}
