// Makes meshes for the measurements. See mesh.h.
#include "mesh.h"

#include "base/memory.h"
#include "base/random.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

void bench_mesh_free(bench_mesh *mesh)
{
    free(mesh->vertices);
    free(mesh->normals);
    free(mesh->triangles);
    *mesh = (bench_mesh){0};
}

// Replaces *array, of `used` elements, by an array with `count` more. On failure *array stays.
static bool extend(void **array, size_t used, size_t count, size_t size)
{
    void *larger = glint_allocate(used + count, size);
    if (larger == NULL) {
        return false;
    }
    if (used > 0) {
        memcpy(larger, *array, used * size);
    }
    free(*array);
    *array = larger;
    return true;
}

// Adds zeroed vertices and triangles to the mesh; *first is the first new vertex.
static glint_status grow(bench_mesh *mesh, size_t vertices, size_t triangles, uint32_t *first,
                         glint_error *error)
{
    void *places = mesh->vertices, *corners = mesh->triangles;
    bool grown = extend(&places, mesh->vertex_count, vertices, sizeof *mesh->vertices);
    mesh->vertices = places;
    grown = grown && extend(&corners, mesh->triangle_count, triangles, sizeof *mesh->triangles);
    mesh->triangles = corners;
    if (!grown) {
        return glint_fail_memory(error, "a mesh");
    }
    *first = (uint32_t)mesh->vertex_count;
    mesh->vertex_count += vertices;
    mesh->triangle_count += triangles;
    return GLINT_OK;
}

static void set_triangle(uint32_t *triangle, uint32_t a, uint32_t b, uint32_t c)
{
    triangle[0] = a;
    triangle[1] = b;
    triangle[2] = c;
}

double bench_bumps(glint_vec3 d, double phase)
{
    return 1 + 0.12 * sin(5 * d.x + phase) * sin(4 * d.y + 1 + phase) * sin(6 * d.z + 2) +
           0.03 * sin(17 * d.x) * sin(13 * d.y) * sin(15 * d.z + phase);
}

static glint_vec3 place_on_ball(const bench_ball *ball, glint_vec3 direction)
{
    double factor = ball->displacement != NULL ? ball->displacement(direction, ball->phase) : 1;
    return glint_vec3_add(ball->center, glint_vec3_scale(direction, ball->radius * factor));
}

// ---- Icosphere ---------------------------------------------------------------------------------

#define CORNERS 12
#define EDGES 30
#define FACES 20

// The icosahedron's corners: the poles, and two rings of five at latitude ±atan(½).
static glint_vec3 corner_direction(int corner)
{
    if (corner == 0 || corner == CORNERS - 1) {
        return (glint_vec3){0, corner == 0 ? 1 : -1, 0};
    }
    bool upper = corner <= 5;
    double azimuth = GLINT_PI / 5 * (2 * ((corner - 1) % 5) + (upper ? 0 : 1));
    double ring = 2 / sqrt(5.0);
    return (glint_vec3){ring * sin(azimuth), (upper ? 1 : -1) / sqrt(5.0), ring * cos(azimuth)};
}

static void face_corners(int face, int corners[3])
{
    int i = face % 5, next = (i + 1) % 5;
    const int table[4][3] = {
        {0, 1 + i, 1 + next},
        {1 + i, 6 + i, 1 + next},
        {6 + i, 6 + next, 1 + next},
        {11, 6 + next, 6 + i},
    };
    memcpy(corners, table[face / 5], sizeof table[0]);
}

// Points of a face, row by row from its first corner; row r has r + 1 points.
typedef struct face_grid {
    int frequency;
    glint_vec3 *directions;
} face_grid;

static size_t grid_index(int row, int i)
{
    return (size_t)row * ((size_t)row + 1) / 2 + (size_t)i;
}

static glint_vec3 middle(const face_grid *grid, int row, int i, int row_step, int i_step)
{
    glint_vec3 a = grid->directions[grid_index(row - row_step, i - i_step)];
    glint_vec3 b = grid->directions[grid_index(row + row_step, i + i_step)];
    return glint_vec3_normalize(glint_vec3_add(a, b));
}

// Spaces points a step apart evenly on the face's plane, then projects them to the sphere.
static void fill_coarse(face_grid *grid, const glint_vec3 corners[3], int step)
{
    for (int row = 0; row <= grid->frequency; row += step) {
        for (int i = 0; i <= row; i += step) {
            glint_vec3 sum = glint_vec3_scale(corners[0], grid->frequency - row);
            sum = glint_vec3_add(sum, glint_vec3_scale(corners[1], row - i));
            sum = glint_vec3_add(sum, glint_vec3_scale(corners[2], i));
            grid->directions[grid_index(row, i)] = glint_vec3_normalize(sum);
        }
    }
}

static void fill_grid(face_grid *grid, const glint_vec3 corners[3])
{
    int step = grid->frequency & -grid->frequency;
    fill_coarse(grid, corners, step);
    for (step /= 2; step > 0; step /= 2) {
        for (int row = 0; row <= grid->frequency; row += step) {
            for (int i = 0; i <= row; i += step) {
                // An edge runs along the row, along the column or along both.
                int row_step = row / step % 2 * step, i_step = i / step % 2 * step;
                if (row_step != 0 || i_step != 0) {
                    grid->directions[grid_index(row, i)] = middle(grid, row, i, row_step, i_step);
                }
            }
        }
    }
}

// An icosphere's vertices in order: the corners, the points inside each edge, the points inside
// each face.
typedef struct icosphere {
    const bench_ball *ball;
    int frequency;
    uint32_t first;
    int edges[CORNERS][CORNERS]; // from the lower to the higher corner; −1: no edge
} icosphere;

static void number_edges(icosphere *sphere)
{
    memset(sphere->edges, -1, sizeof sphere->edges);
    int count = 0;
    for (int face = 0; face < FACES; face++) {
        int c[3];
        face_corners(face, c);
        for (int k = 0; k < 3; k++) {
            int a = c[k], b = c[(k + 1) % 3];
            if (a < b && sphere->edges[a][b] < 0) {
                sphere->edges[a][b] = count++;
            }
        }
    }
}

// The vertex at s[k] steps from the sides opposite the corners c[k]. The steps add up to the
// frequency.
static uint32_t vertex_at(const icosphere *sphere, int face, const int c[3], const int s[3])
{
    const uint32_t inside_edge = (uint32_t)sphere->frequency - 1;
    for (int k = 0; k < 3; k++) {
        if (s[k] == sphere->frequency) {
            return sphere->first + (uint32_t)c[k];
        }
    }
    for (int k = 0; k < 3; k++) {
        if (s[k] == 0) {
            int p = (k + 1) % 3, q = (k + 2) % 3;
            int low = c[p] < c[q] ? p : q, high = low == p ? q : p;
            uint32_t edge = (uint32_t)sphere->edges[c[low]][c[high]];
            return sphere->first + CORNERS + edge * inside_edge + (uint32_t)s[high] - 1;
        }
    }
    uint32_t row = (uint32_t)(s[1] + s[2]);
    uint32_t inside_face = inside_edge * (inside_edge - 1) / 2;
    uint32_t within = (row - 1) * (row - 2) / 2 + (uint32_t)s[2] - 1;
    return sphere->first + CORNERS + EDGES * inside_edge + (uint32_t)face * inside_face + within;
}

// Adds a face. `triangles` has room for this face's triangles.
static void add_face(bench_mesh *mesh, const icosphere *sphere, const face_grid *grid, int face,
                     uint32_t (*triangles)[3])
{
    const int f = sphere->frequency;
    int c[3];
    face_corners(face, c);
    size_t count = 0;
    for (int row = 0; row <= f; row++) {
        for (int i = 0; i <= row; i++) {
            uint32_t here = vertex_at(sphere, face, c, (int[3]){f - row, row - i, i});
            mesh->vertices[here] =
                place_on_ball(sphere->ball, grid->directions[grid_index(row, i)]);
            if (row == f) {
                continue;
            }
            uint32_t left = vertex_at(sphere, face, c, (int[3]){f - row - 1, row + 1 - i, i});
            uint32_t right = vertex_at(sphere, face, c, (int[3]){f - row - 1, row - i, i + 1});
            set_triangle(triangles[count++], here, left, right);
            if (i < row) {
                uint32_t next = vertex_at(sphere, face, c, (int[3]){f - row, row - i - 1, i + 1});
                set_triangle(triangles[count++], here, right, next);
            }
        }
    }
}

glint_status bench_mesh_add_icosphere(bench_mesh *mesh, const bench_ball *ball, int frequency,
                                      glint_error *error)
{
    icosphere sphere = {.ball = ball, .frequency = frequency};
    size_t per_face = (size_t)frequency * (size_t)frequency;
    size_t first_triangle = mesh->triangle_count;
    face_grid grid = {frequency, glint_allocate(grid_index(frequency + 1, 0), sizeof(glint_vec3))};
    if (grid.directions == NULL) {
        return glint_fail_memory(error, "a mesh");
    }
    glint_status status;
    TRY_OR(cleanup, status,
           grow(mesh, FACES / 2 * per_face + 2, FACES * per_face, &sphere.first, error));
    number_edges(&sphere);
    for (int face = 0; face < FACES; face++) {
        int c[3];
        face_corners(face, c);
        const glint_vec3 corners[3] = {corner_direction(c[0]), corner_direction(c[1]),
                                       corner_direction(c[2])};
        fill_grid(&grid, corners);
        add_face(mesh, &sphere, &grid, face,
                 mesh->triangles + first_triangle + (size_t)face * per_face);
    }
cleanup:
    free(grid.directions);
    return status;
}

// ---- Other shapes ------------------------------------------------------------------------------

glint_status bench_mesh_add_latlong(bench_mesh *mesh, const bench_ball *ball, int around, int bands,
                                    glint_error *error)
{
    uint32_t first = 0, columns = (uint32_t)around, rings = (uint32_t)bands - 1;
    size_t next = mesh->triangle_count;
    glint_status status =
        grow(mesh, 2 + (size_t)columns * rings, 2 * (size_t)columns * rings, &first, error);
    if (status != GLINT_OK) {
        return status;
    }
    // Add the poles, then the rings from the top.
    mesh->vertices[first] = place_on_ball(ball, (glint_vec3){0, 1, 0});
    mesh->vertices[first + 1] = place_on_ball(ball, (glint_vec3){0, -1, 0});
    for (uint32_t ring = 0; ring < rings; ring++) {
        double polar = GLINT_PI * (ring + 1) / bands;
        for (uint32_t i = 0; i < columns; i++) {
            double azimuth = 2 * GLINT_PI * i / around;
            glint_vec3 d = {sin(polar) * sin(azimuth), cos(polar), sin(polar) * cos(azimuth)};
            mesh->vertices[first + 2 + ring * columns + i] = place_on_ball(ball, d);
        }
    }
    for (uint32_t i = 0; i < columns; i++) {
        uint32_t j = (i + 1) % columns, above = first + 2;
        set_triangle(mesh->triangles[next++], first, above + i, above + j);
        for (uint32_t ring = 1; ring < rings; ring++, above += columns) {
            uint32_t below = above + columns;
            set_triangle(mesh->triangles[next++], above + i, below + i, below + j);
            set_triangle(mesh->triangles[next++], above + i, below + j, above + j);
        }
        set_triangle(mesh->triangles[next++], first + 1, above + j, above + i);
    }
    return GLINT_OK;
}

glint_status bench_mesh_add_sheet(bench_mesh *mesh, const bench_sheet *sheet, glint_error *error)
{
    uint32_t first = 0, cells = (uint32_t)sheet->cells, pitch = cells + 1;
    size_t next = mesh->triangle_count;
    glint_status status =
        grow(mesh, (size_t)pitch * pitch, 2 * (size_t)cells * cells, &first, error);
    if (status != GLINT_OK) {
        return status;
    }
    for (uint32_t j = 0; j <= cells; j++) {
        for (uint32_t i = 0; i <= cells; i++) {
            uint32_t here = first + j * pitch + i;
            glint_vec3 along_u = glint_vec3_scale(sheet->u, (double)i / cells);
            glint_vec3 along_v = glint_vec3_scale(sheet->v, (double)j / cells);
            mesh->vertices[here] = glint_vec3_add(sheet->corner, glint_vec3_add(along_u, along_v));
            if (i < cells && j < cells) {
                set_triangle(mesh->triangles[next++], here, here + 1, here + pitch + 1);
                set_triangle(mesh->triangles[next++], here, here + pitch + 1, here + pitch);
            }
        }
    }
    return GLINT_OK;
}

static void add_needle(bench_mesh *mesh, const bench_needles *shape, glint_random *random,
                       uint32_t at, uint32_t *triangle)
{
    glint_vec3 root = glint_random_direction(random);
    glint_vec3 lean = glint_vec3_scale(glint_random_direction(random), 0.8);
    glint_vec3 along = glint_vec3_normalize(glint_vec3_add(root, lean));
    glint_vec3 side = glint_vec3_normalize(glint_vec3_cross(along, glint_random_direction(random)));
    glint_vec3 normal = glint_vec3_cross(side, along);
    glint_vec3 base = glint_vec3_scale(root, shape->radius);
    glint_vec3 half = glint_vec3_scale(side, shape->width / 2);
    mesh->vertices[at] = glint_vec3_subtract(base, half);
    mesh->vertices[at + 1] = glint_vec3_add(base, half);
    mesh->vertices[at + 2] = glint_vec3_add(base, glint_vec3_scale(along, shape->length));
    glint_vec3 turn = glint_vec3_scale(side, 0.7);
    mesh->normals[at] = glint_vec3_normalize(glint_vec3_subtract(normal, turn));
    mesh->normals[at + 1] = glint_vec3_normalize(glint_vec3_add(normal, turn));
    mesh->normals[at + 2] = normal;
    set_triangle(triangle, at, at + 1, at + 2);
}

glint_status bench_mesh_add_needles(bench_mesh *mesh, const bench_needles *needles,
                                    glint_error *error)
{
    uint32_t first = 0;
    size_t old_vertices = mesh->vertex_count, next = mesh->triangle_count;
    TRY(grow(mesh, 3 * needles->count, needles->count, &first, error));
    void *normals = mesh->normals;
    if (!extend(&normals, old_vertices, 3 * needles->count, sizeof *mesh->normals)) {
        return glint_fail_memory(error, "a mesh");
    }
    mesh->normals = normals;
    glint_random random = {1};
    for (uint32_t i = 0; i < needles->count; i++) {
        add_needle(mesh, needles, &random, first + 3 * i, mesh->triangles[next + i]);
    }
    return GLINT_OK;
}

glint_status bench_mesh_smooth(bench_mesh *mesh, glint_error *error)
{
    free(mesh->normals);
    mesh->normals = glint_allocate(mesh->vertex_count, sizeof *mesh->normals);
    if (mesh->normals == NULL) {
        return glint_fail_memory(error, "a mesh's normals");
    }
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t *t = mesh->triangles[i];
        glint_vec3 a = mesh->vertices[t[0]];
        glint_vec3 normal = glint_vec3_cross(glint_vec3_subtract(mesh->vertices[t[1]], a),
                                             glint_vec3_subtract(mesh->vertices[t[2]], a));
        for (int k = 0; k < 3; k++) {
            mesh->normals[t[k]] = glint_vec3_add(mesh->normals[t[k]], normal);
        }
    }
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        mesh->normals[i] = glint_vec3_normalize(mesh->normals[i]);
    }
    return GLINT_OK;
}
