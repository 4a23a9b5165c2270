// Makes quads, boxes, prisms and tessellated balls. See meshes.h.
#include "meshes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

void mesh_free(mesh *m)
{
    free(m->triangles);
    *m = (mesh){0};
}

void mesh_add(mesh *m, const oracle_triangle *triangle)
{
    if (m->count == m->capacity) {
        m->capacity = m->capacity > 0 ? 2 * m->capacity : 64;
        m->triangles = realloc(m->triangles, (size_t)m->capacity * sizeof *triangle);
        if (!m->triangles)
            abort();
    }
    m->triangles[m->count++] = *triangle;
}

void mesh_add_triangle(mesh *m, const double corners[3][3], int material)
{
    oracle_triangle triangle = {.material = material};
    memcpy(triangle.position, corners, sizeof triangle.position);
    mesh_add(m, &triangle);
}

void mesh_add_quad(mesh *m, const double corners[4][3], int material)
{
    double halves[2][3][3];
    memcpy(halves[0], corners, sizeof halves[0]);
    memcpy(halves[1][0], corners[0], sizeof halves[1][0]);
    memcpy(halves[1][1], corners[2], 2 * sizeof halves[1][1]);
    mesh_add_triangle(m, (const double(*)[3])halves[0], material);
    mesh_add_triangle(m, (const double(*)[3])halves[1], material);
}

void mesh_add_box(mesh *m, const double low[3], const double high[3], int material)
{
    for (int axis = 0; axis < 3; axis++) {
        int next = (axis + 1) % 3, last = (axis + 2) % 3;
        for (int side = 0; side < 2; side++) {
            double corners[4][3];
            for (int i = 0; i < 4; i++) {
                // The corners around the face are (0,0) (1,0) (1,1) (0,1); in reverse order on the
                // low side.
                int step = side ? i : 3 - i;
                corners[i][axis] = side ? high[axis] : low[axis];
                corners[i][next] = step == 1 || step == 2 ? high[next] : low[next];
                corners[i][last] = step >= 2 ? high[last] : low[last];
            }
            mesh_add_quad(m, (const double(*)[3])corners, material);
        }
    }
}

void mesh_add_prism(mesh *m, const double corners[3][2], double depth, int material)
{
    double front[3][3], back[3][3];
    for (int i = 0; i < 3; i++) {
        for (int axis = 0; axis < 2; axis++) {
            front[i][axis] = corners[i][axis];
            back[2 - i][axis] = corners[i][axis];
        }
        front[i][2] = depth;
        back[i][2] = -depth;
    }
    mesh_add_triangle(m, (const double(*)[3])front, material);
    mesh_add_triangle(m, (const double(*)[3])back, material);
    for (int i = 0; i < 3; i++) {
        const double *from = corners[i], *to = corners[(i + 1) % 3];
        double side[4][3] = {{from[0], from[1], -depth},
                             {to[0], to[1], -depth},
                             {to[0], to[1], depth},
                             {from[0], from[1], depth}};
        mesh_add_quad(m, (const double(*)[3])side, material);
    }
}

static void ball_vertex(const mesh_ball *ball, const int at[2], double position[3],
                        double normal[3])
{
    int row = at[0], column = at[1] % (2 * ball->rows); // so that the seam closes exactly
    double polar = PI * row / ball->rows, around = PI * column / ball->rows;
    bool pole = row == 0 || row == ball->rows;
    double ring = pole ? 0.0 : sin(polar);
    normal[0] = ring * cos(around);
    normal[1] = row == 0 ? 1.0 : (pole ? -1.0 : cos(polar));
    normal[2] = ring * sin(around);
    for (int axis = 0; axis < 3; axis++)
        position[axis] = ball->centre[axis] + ball->radius * normal[axis];
}

void mesh_add_ball(mesh *m, const mesh_ball *ball)
{
    for (int row = 0; row < ball->rows; row++) {
        for (int column = 0; column < 2 * ball->rows; column++) {
            // The two triangles of a cell. At the poles one of them has no area and is left out.
            const int cell[2][3][2] = {
                {{row, column}, {row, column + 1}, {row + 1, column + 1}},
                {{row, column}, {row + 1, column + 1}, {row + 1, column}},
            };
            for (int half = row == 0; half < (row == ball->rows - 1 ? 1 : 2); half++) {
                oracle_triangle triangle = {.material = ball->material};
                for (int i = 0; i < 3; i++)
                    ball_vertex(ball, cell[half][i], triangle.position[i], triangle.normal[i]);
                if (!ball->smooth)
                    memset(triangle.normal, 0, sizeof triangle.normal);
                mesh_add(m, &triangle);
            }
        }
    }
}

void mesh_turn_inside_out(mesh *m)
{
    for (int k = 0; k < m->count; k++) {
        oracle_triangle *t = &m->triangles[k], old = *t;
        for (int i = 0; i < 3; i++) {
            for (int axis = 0; axis < 3; axis++) {
                t->position[i][axis] = old.position[2 - i][axis];
                t->normal[i][axis] = -old.normal[2 - i][axis];
            }
        }
    }
}
