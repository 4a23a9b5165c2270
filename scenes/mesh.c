// Builds triangle meshes for the scenes. See mesh.h.
#include "mesh.h"
#include "rotation.h"

#include <stdlib.h>
#include <string.h>

#define GRID 1073741824.0 // 2^30 steps a metre

void mesh_free(mesh *m)
{
    free(m->positions);
    free(m->normals);
    free(m->triangles);
    *m = (mesh){0};
}

double mesh_snap(double x)
{
    // volatile: at -O2 and above, GCC 12's vectoriser drops double → float → double when it handles
    // two values at a time. The bounds in the file would then differ from the bounds of its
    // vertices. The result is never −0: floor(x + ½) gives +0 near 0.
    volatile float rounded = (float)(floor(x * GRID + 0.5) / GRID);
    return (double)rounded;
}

static glint_vec3 snap(glint_vec3 v)
{
    return (glint_vec3){mesh_snap(v.x), mesh_snap(v.y), mesh_snap(v.z)};
}

// Returns the array with room for one more element. Without memory returns NULL and sets `failed`.
static void *grow(mesh *m, void *array, size_t count, size_t size)
{
    // The capacity is the smallest power of two ≥ 256 that holds `count`, so the array is full when
    // count reaches it.
    bool full = count == 0 || (count >= 256 && (count & (count - 1)) == 0);
    if (!full || m->failed) {
        return m->failed ? NULL : array;
    }
    void *larger = realloc(array, (count == 0 ? 256 : 2 * count) * size);
    m->failed = larger == NULL;
    return larger;
}

uint32_t mesh_add_vertex(mesh *m, glint_vec3 position, glint_vec3 normal)
{
    glint_vec3 *positions = grow(m, m->positions, m->vertex_count, sizeof *positions);
    if (positions == NULL) {
        return 0;
    }
    m->positions = positions;
    glint_vec3 *normals = grow(m, m->normals, m->vertex_count, sizeof *normals);
    if (normals == NULL) {
        return 0;
    }
    m->normals = normals;
    positions[m->vertex_count] = snap(position);
    normals[m->vertex_count] = m->flat ? (glint_vec3){0, 0, 0} : snap(normal);
    return (uint32_t)m->vertex_count++;
}

static bool same(glint_vec3 a, glint_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

void mesh_add_triangle(mesh *m, uint32_t a, uint32_t b, uint32_t c)
{
    if (m->failed || same(m->positions[a], m->positions[b]) ||
        same(m->positions[b], m->positions[c]) || same(m->positions[c], m->positions[a])) {
        return;
    }
    uint32_t(*triangles)[3] = grow(m, m->triangles, m->triangle_count, sizeof *triangles);
    if (triangles == NULL) {
        return;
    }
    m->triangles = triangles;
    uint32_t *corners = triangles[m->triangle_count++];
    corners[0] = a;
    corners[1] = b;
    corners[2] = c;
}

void mesh_add_quad(mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    mesh_add_triangle(m, a, b, c);
    mesh_add_triangle(m, a, c, d);
}

// ---- Welding -----------------------------------------------------------------------------------

typedef struct vertex_key {
    double values[6]; // position, normal
    uint32_t index;
} vertex_key;

static int compare_values(const vertex_key *a, const vertex_key *b)
{
    for (int i = 0; i < 6; i++) {
        if (a->values[i] != b->values[i]) {
            return a->values[i] < b->values[i] ? -1 : 1;
        }
    }
    return 0;
}

// Equal vertices keep the order of their indices: qsort is not stable.
static int compare_keys(const void *a, const void *b)
{
    const vertex_key *p = a;
    const vertex_key *q = b;
    int order = compare_values(p, q);
    return order != 0 ? order : (p->index > q->index) - (p->index < q->index);
}

// Finds for each vertex the first equal vertex, by position or by position and normal. The caller
// frees the result. NULL when memory is short.
static uint32_t *find_first_equals(const mesh *m, bool with_normals)
{
    vertex_key *keys = calloc(m->vertex_count + 1, sizeof *keys);
    uint32_t *first = calloc(m->vertex_count + 1, sizeof *first);
    if (keys == NULL || first == NULL) {
        free(keys);
        free(first);
        return NULL;
    }
    for (size_t i = 0; i < m->vertex_count; i++) {
        glint_vec3 p = m->positions[i];
        glint_vec3 n = with_normals ? m->normals[i] : (glint_vec3){0, 0, 0};
        keys[i] = (vertex_key){{p.x, p.y, p.z, n.x, n.y, n.z}, (uint32_t)i};
    }
    qsort(keys, m->vertex_count, sizeof *keys, compare_keys);
    for (size_t i = 0; i < m->vertex_count; i++) {
        bool equal = i > 0 && compare_values(&keys[i - 1], &keys[i]) == 0;
        first[keys[i].index] = equal ? first[keys[i - 1].index] : keys[i].index;
    }
    free(keys);
    return first;
}

void mesh_weld(mesh *m)
{
    uint32_t *place = m->failed ? NULL : find_first_equals(m, true);
    if (place == NULL) {
        m->failed = true;
        return;
    }
    size_t kept = 0;
    for (size_t i = 0; i < m->vertex_count; i++) {
        if (place[i] == i) {
            m->positions[kept] = m->positions[i];
            m->normals[kept] = m->normals[i];
            place[i] = (uint32_t)kept++;
        } else {
            place[i] = place[place[i]]; // an earlier vertex, so its place is known
        }
    }
    m->vertex_count = kept;
    for (size_t i = 0; i < m->triangle_count; i++) {
        for (int k = 0; k < 3; k++) {
            m->triangles[i][k] = place[m->triangles[i][k]];
        }
    }
    free(place);
}

// ---- Checks ------------------------------------------------------------------------------------

typedef struct edge {
    uint32_t low, high;
    int direction; // +1 from low to high, −1 back
} edge;

static int compare_edges(const void *a, const void *b)
{
    const edge *p = a;
    const edge *q = b;
    if (p->low != q->low) {
        return p->low < q->low ? -1 : 1;
    }
    return (p->high > q->high) - (p->high < q->high);
}

static size_t count_unpaired(const edge *edges, size_t count)
{
    size_t unpaired = 0;
    for (size_t i = 0; i < count;) {
        size_t end = i;
        int sum = 0;
        for (; end < count && compare_edges(&edges[i], &edges[end]) == 0; end++) {
            sum += edges[end].direction;
        }
        unpaired += end - i != 2 || sum != 0;
        i = end;
    }
    return unpaired;
}

size_t mesh_count_boundary_edges(const mesh *m)
{
    size_t count = 3 * m->triangle_count;
    uint32_t *first = find_first_equals(m, false);
    edge *edges = calloc(count + 1, sizeof *edges);
    size_t unpaired = SIZE_MAX;
    if (first != NULL && edges != NULL) {
        for (size_t i = 0; i < count; i++) {
            const uint32_t *corners = m->triangles[i / 3];
            uint32_t from = first[corners[i % 3]];
            uint32_t to = first[corners[(i + 1) % 3]];
            edges[i] = from < to ? (edge){from, to, 1} : (edge){to, from, -1};
        }
        qsort(edges, count, sizeof *edges, compare_edges);
        unpaired = count_unpaired(edges, count);
    }
    free(first);
    free(edges);
    return unpaired;
}

double mesh_signed_volume(const mesh *m)
{
    double sum = 0;
    for (size_t i = 0; i < m->triangle_count; i++) {
        const uint32_t *corners = m->triangles[i];
        sum += glint_vec3_dot(m->positions[corners[0]],
                              glint_vec3_cross(m->positions[corners[1]], m->positions[corners[2]]));
    }
    return sum;
}

double mesh_lowest(const mesh *m, const double rotation[4])
{
    double lowest = INFINITY;
    for (size_t i = 0; i < m->vertex_count; i++) {
        lowest = fmin(lowest, rotation_apply(rotation, m->positions[i]).y);
    }
    return lowest;
}
