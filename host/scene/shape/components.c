// Divides welded triangles into components. Paired half-edges join triangles. What is closed then
// is a component: so bodies that touch in an edge or a vertex are apart. Triangles that are open
// are also joined by common vertices, because rounding and T-junctions part edges more often than
// corners. Near-linear in time.
#include "scene/shape/components.h"

#include "base/memory.h"
#include "base/union_find.h"
#include "scene/shape/convexity.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define NONE 0xFFFFFFFFu

// Joins triangles by paired half-edges, and marks those of surfaces that are open.
static void join_by_edges(glint_components *all)
{
    const glint_welding *weld = all->weld;
    for (uint32_t t = 0; t < weld->list.count; t++) {
        all->parent[t] = t;
        all->is_open[t] = false;
    }
    for (uint32_t corner = 0; corner < 3 * weld->list.count; corner++) {
        if (weld->twin[corner] != GLINT_UNPAIRED && weld->twin[corner] > corner) {
            glint_union_join(all->parent, corner / 3, weld->twin[corner] / 3);
        }
    }
    for (uint32_t corner = 0; corner < 3 * weld->list.count; corner++) {
        if (weld->twin[corner] == GLINT_UNPAIRED) {
            all->is_open[glint_union_root(all->parent, corner / 3)] = true;
        }
    }
    for (uint32_t t = 0; t < weld->list.count; t++) {
        all->is_open[t] = all->is_open[glint_union_root(all->parent, t)];
    }
}

static void join_open_by_vertices(glint_components *all)
{
    const glint_welding *weld = all->weld;
    memset(all->stamp, 0xFF, (size_t)weld->vertex_count * sizeof *all->stamp);
    for (uint32_t corner = 0; corner < 3 * weld->list.count; corner++) {
        uint32_t *first = &all->stamp[weld->vertex_of[corner]];
        if (!all->is_open[corner / 3]) {
            continue;
        }
        if (*first == NONE) {
            *first = corner / 3;
        } else {
            glint_union_join(all->parent, *first, corner / 3);
        }
    }
}

// Numbers the components by their first triangle. The root is the first triangle.
static void number_components(glint_components *all, bool closed_alone)
{
    all->count = 0;
    for (uint32_t t = 0; t < all->weld->list.count; t++) {
        const uint32_t root = glint_union_root(all->parent, t);
        if (closed_alone && all->is_open[t]) {
            all->number_of[t] = NONE;
        } else {
            all->number_of[t] = root == t ? (uint32_t)all->count++ : all->number_of[root];
        }
    }
}

// Sorts the triangles by component, by a counting sort that keeps their order.
static void sort_triangles(glint_components *all)
{
    memset(all->first, 0, (all->count + 1) * sizeof *all->first);
    for (uint32_t t = 0; t < all->weld->list.count; t++) {
        if (all->number_of[t] != NONE) {
            all->first[all->number_of[t] + 1]++;
        }
    }
    for (size_t i = 0; i < all->count; i++) {
        all->first[i + 1] += all->first[i];
    }
    for (uint32_t t = 0; t < all->weld->list.count; t++) {
        if (all->number_of[t] != NONE) {
            all->triangles[all->first[all->number_of[t]]++] = t;
        }
    }
    memmove(all->first + 1, all->first, all->count * sizeof *all->first);
    all->first[0] = 0;
}

// ---- Measuring ----------------------------------------------------------------------------------

static const float *anchor_of(const glint_welding *weld, uint32_t corner)
{
    static const float origin[3] = {0, 0, 0};
    const glint_parts *parts = &weld->scene->parts;
    return parts->count > 0 ? parts->anchors[parts->part_of[glint_triangle_at(weld, corner)]]
                            : origin;
}

// Counts the vertices of component i, and finds its bounds.
static void measure_vertices(glint_components *all, size_t i)
{
    const glint_welding *weld = all->weld;
    glint_component *c = &all->of[i];
    for (uint32_t k = 3 * all->first[i]; k < 3 * all->first[i + 1]; k++) {
        const uint32_t corner = 3 * all->triangles[k / 3] + k % 3;
        uint32_t *stamp = &all->stamp[weld->vertex_of[corner]];
        if (*stamp == (uint32_t)i) {
            continue;
        }
        *stamp = (uint32_t)i;
        all->vertices[i]++;
        const float *p = glint_position_at(weld, corner);
        const float *anchor = anchor_of(weld, corner);
        for (int axis = 0; axis < 3; axis++) {
            const float at = anchor[axis] + p[axis];
            c->low[axis] = fminf(c->low[axis], at);
            c->high[axis] = fmaxf(c->high[axis], at);
        }
    }
}

static glint_vec3 position_of(const glint_welding *weld, uint32_t corner)
{
    return glint_vec3_from_floats(glint_position_at(weld, corner));
}

// The common apex of the pyramids whose volumes are added. The volume of an open component depends
// on it: in the middle of the boundary, it is as if the opening were closed there. A component lies
// in one part.
static glint_vec3 apex_of(const glint_components *all, size_t i)
{
    const glint_welding *weld = all->weld;
    const glint_component *c = &all->of[i];
    const float *anchor = anchor_of(weld, 3 * all->triangles[all->first[i]]);
    const glint_vec3 low = {(double)c->low[0] - (double)anchor[0],
                            (double)c->low[1] - (double)anchor[1],
                            (double)c->low[2] - (double)anchor[2]};
    glint_vec3 sum = {0, 0, 0};
    double ends = 0;
    for (uint32_t k = 3 * all->first[i]; !c->closed && k < 3 * all->first[i + 1]; k++) {
        const uint32_t corner = 3 * all->triangles[k / 3] + k % 3;
        if (weld->twin[corner] == GLINT_UNPAIRED) {
            sum = glint_vec3_add(sum, position_of(weld, corner));
            sum = glint_vec3_add(sum, position_of(weld, glint_next_corner(corner)));
            ends += 2;
        }
    }
    return ends > 0 ? glint_vec3_scale(sum, 1 / ends) : low;
}

// Adds up the volume. Its error follows from the coordinates, which count from the part's anchor.
static void measure_volume(glint_components *all, size_t i)
{
    const glint_welding *weld = all->weld;
    const glint_vec3 apex = apex_of(all, i);
    double area = 0;
    double size = 0;
    for (uint32_t k = all->first[i]; k < all->first[i + 1]; k++) {
        const uint32_t corner = 3 * all->triangles[k];
        for (uint32_t n = 0; n < 9; n++) {
            size = fmax(size, fabs((double)glint_position_at(weld, corner + n / 3)[n % 3]));
        }
        const glint_vec3 p0 = glint_vec3_subtract(position_of(weld, corner), apex);
        const glint_vec3 p1 = glint_vec3_subtract(position_of(weld, corner + 1), apex);
        const glint_vec3 p2 = glint_vec3_subtract(position_of(weld, corner + 2), apex);
        all->of[i].volume += glint_vec3_dot(p0, glint_vec3_cross(p1, p2)) / 6;
        area += glint_vec3_length(
                    glint_vec3_cross(glint_vec3_subtract(p1, p0), glint_vec3_subtract(p2, p0))) /
                2;
    }
    all->of[i].volume_error = GLINT_POSITION_ROUNDINGS * 0x1p-24 * size * area;
}

// Counts the boundary edges of all components, and finds crowded ones. An edge counts once for each
// component.
static void measure_edges(glint_components *all)
{
    const glint_welding *weld = all->weld;
    uint32_t *boundary = all->place; // [component]: the last edge at its boundary
    uint32_t *inner = all->stamp;    // [component]: the last edge where a pair of it is
    memset(boundary, 0xFF, all->count * sizeof *boundary);
    memset(inner, 0xFF, all->count * sizeof *inner);
    for (uint32_t vertex = 0; vertex < weld->vertex_count; vertex++) {
        uint32_t edge = weld->first_edge[vertex];
        for (uint32_t i = edge; i < weld->first_edge[vertex + 1]; i++) {
            edge = weld->edges[i].upper == weld->edges[edge].upper ? edge : i;
            const uint32_t corner = weld->edges[i].corner;
            const uint32_t number = all->number_of[corner / 3];
            if (number == NONE) {
                continue;
            }
            if (weld->twin[corner] == GLINT_UNPAIRED) {
                all->of[number].boundary_edges += boundary[number] != edge;
                boundary[number] = edge;
            } else if (corner < weld->twin[corner]) {
                all->is_crowded[number] = all->is_crowded[number] || inner[number] == edge;
                inner[number] = edge;
            }
        }
    }
}

// Fills in the components' measures.
static void measure(glint_components *all)
{
    memset(all->vertices, 0, all->count * sizeof *all->vertices);
    memset(all->is_crowded, 0, all->count * sizeof *all->is_crowded);
    measure_edges(all);
    memset(all->stamp, 0xFF, (size_t)all->weld->vertex_count * sizeof *all->stamp);
    for (size_t i = 0; i < all->count; i++) {
        all->of[i].triangle_count = all->first[i + 1] - all->first[i];
        all->of[i].closed = all->of[i].boundary_edges == 0;
        measure_vertices(all, i);
        measure_volume(all, i);
    }
}

// ------------------------------------------------------------------------------------------------

static bool make_room(glint_components *all, uint32_t triangles)
{
    if (triangles <= all->capacity) {
        return true;
    }
    const size_t count = triangles;
    glint_components_free(all);
    all->parent = glint_allocate(count, sizeof *all->parent);
    all->number_of = glint_allocate(count, sizeof *all->number_of);
    all->triangles = glint_allocate(count, sizeof *all->triangles);
    all->first = glint_allocate(count + 1, sizeof *all->first);
    all->vertices = glint_allocate(count, sizeof *all->vertices);
    all->stamp = glint_allocate(3 * count, sizeof *all->stamp);
    all->place = glint_allocate(3 * count, sizeof *all->place);
    all->is_open = glint_allocate(count, sizeof *all->is_open);
    all->is_crowded = glint_allocate(count, sizeof *all->is_crowded);
    all->capacity = triangles;
    return all->parent && all->number_of && all->triangles && all->first && all->vertices &&
           all->stamp && all->place && all->is_open && all->is_crowded;
}

// Appends `all->count` components to the topology. Returns false if memory is short.
static bool append(glint_components *all, glint_topology *topology)
{
    const size_t before = topology->component_count;
    const size_t needed = before + all->count;
    if (needed > topology->capacity) {
        const size_t larger = needed > 2 * topology->capacity ? needed : 2 * topology->capacity;
        glint_component *components =
            realloc(topology->components, larger * sizeof *topology->components);
        if (components == NULL) {
            return false;
        }
        topology->components = components;
        topology->capacity = larger;
    }
    topology->component_count = needed;
    all->of = topology->components + before;
    for (size_t i = 0; i < all->count; i++) {
        all->of[i] = (glint_component){.low = {INFINITY, INFINITY, INFINITY},
                                       .high = {-INFINITY, -INFINITY, -INFINITY}};
    }
    for (uint32_t t = 0; t < all->weld->list.count; t++) {
        if (all->number_of[t] != NONE) {
            topology->component_of[all->weld->list.triangles[t]] =
                (uint32_t)(before + all->number_of[t]);
        }
    }
    return true;
}

bool glint_components_find(glint_components *all, const glint_welding *weld, bool closed_alone,
                           glint_topology *topology)
{
    if (!make_room(all, weld->list.count)) {
        return false;
    }
    all->weld = weld;
    join_by_edges(all);
    if (!closed_alone) {
        join_open_by_vertices(all);
    }
    number_components(all, closed_alone);
    if (!append(all, topology)) {
        return false;
    }
    sort_triangles(all);
    measure(all);
    glint_components_judge(all);
    return true;
}

void glint_components_free(glint_components *all)
{
    free(all->parent);
    free(all->number_of);
    free(all->triangles);
    free(all->first);
    free(all->vertices);
    free(all->stamp);
    free(all->place);
    free(all->is_open);
    free(all->is_crowded);
    *all = (glint_components){0};
}
