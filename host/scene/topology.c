// Proves facts about the scene's surfaces, instance by instance. It welds corners by position,
// joins welded vertices to components, and pairs half-edges. Every pair tells whether the surface
// is open or bends inwards there. O(n log n) in time, about 60 bytes in memory per triangle of the
// largest instance.
//
// Why this proves convexity. Suppose that, from an inner point, every triangle is seen from inside,
// and the solid angles add up to 4π. Then the surface, projected onto a sphere around this point,
// covers the sphere once. So it is star-shaped and meets itself nowhere. (A pentagram's pyramid
// also bends outwards at every edge, but covers the sphere twice.) If such a surface bends outwards
// at every edge, it is convex in a neighbourhood of each of its points. A closed surface of this
// kind bounds a convex body (Tietze 1928, Nakajima 1928).
//
// Rounding. Flat faces are cut into triangles, and their corners rounded to floats: half of these
// edges bend inwards by less than the rounding. Each edge may bend so much. But in a very fine mesh
// a whole hollow can hide below this limit. So one of two conditions must hold. Either the sum of
// these bends is slight, or no vertex lies in a hollow, by a search over the whole body
// (convexity.h).
#include "scene/topology.h"

#include "base/memory.h"
#include "scene/convexity.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define NONE 0xFFFFFFFFu

// A half-edge, stored under the lesser of its two vertices.
typedef struct half_edge {
    uint32_t upper;  // the greater vertex
    uint32_t corner; // start of the half-edge: the triangle is corner / 3
} half_edge;

// Sums over a component, for internal use.
typedef struct component_sums {
    size_t vertices, edges;
    glint_vec3 sum;        // sum of the vertices
    bool bends_inwards;    // some edge bends inwards by more than rounding
    double rounding_bends; // radians: sum of the inward bends that rounding explains
    bool seen_from_inside; // every triangle is seen from inside, from the vertices' mean
    double solid_angle;    // sum over the triangles, seen from the vertices' mean
    bool look_for_hollows; // rounding could hide a hollow
    size_t end;            // end of the component's vertices in the gathered points
} component_sums;

// The work on one instance. Arrays are as large as the largest instance needs.
typedef struct welding {
    const float *positions;  // of the instance's triangles, relative to their parts' anchors
    const uint32_t *part_of; // part of each triangle; NULL: there are no parts
    const float (*anchors)[3];
    uint32_t *component_of; // [triangle of the instance]: component in the topology
    uint32_t corner_count;
    uint32_t vertex_count;
    uint32_t *vertex_of;      // [corner]
    uint32_t *corner_of;      // [vertex]: one of the vertex's corners
    uint32_t *parent;         // [vertex]: union-find
    uint32_t *component;      // [vertex]: component within the instance
    uint32_t *table;          // hash table of vertices, a power of two in size
    uint32_t *first_edge;     // [vertex + 1]: index into edges
    half_edge *edges;         // [corner]
    component_sums *gathered; // [component of this instance]
    size_t gathered_capacity;
} welding;

// The position relative to the anchor of the corner's part. A component lies in one part.
static glint_vec3 position_at(const welding *weld, uint32_t corner)
{
    const float *p = weld->positions + (size_t)corner * 3;
    return (glint_vec3){p[0], p[1], p[2]};
}

static uint32_t next_corner(uint32_t corner)
{
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

static uint32_t part_at(const welding *weld, uint32_t corner)
{
    return weld->part_of != NULL ? weld->part_of[corner / 3] : 0;
}

static const float *anchor_at(const welding *weld, uint32_t corner)
{
    static const float origin[3] = {0, 0, 0};
    return weld->part_of != NULL ? weld->anchors[part_at(weld, corner)] : origin;
}

static uint32_t hash_position(const float *p, uint32_t part)
{
    uint32_t hash = 2166136261u ^ part;
    for (int k = 0; k < 3; k++) {
        float value = p[k] + 0.0f; // −0 becomes 0
        uint32_t bits;
        memcpy(&bits, &value, sizeof bits);
        hash = (hash ^ bits) * 0x9E3779B1u;
        hash ^= hash >> 15;
    }
    return hash;
}

static uint32_t table_size(uint32_t corner_count)
{
    uint32_t size = 16;
    while (size < 0x80000000u && size / 2 < corner_count) {
        size *= 2;
    }
    return size;
}

static void weld_corners(welding *weld)
{
    uint32_t mask = table_size(weld->corner_count) - 1;
    memset(weld->table, 0xFF, ((size_t)mask + 1) * sizeof *weld->table);
    weld->vertex_count = 0;
    for (uint32_t corner = 0; corner < weld->corner_count; corner++) {
        const float *p = weld->positions + (size_t)corner * 3;
        const uint32_t part = part_at(weld, corner);
        uint32_t slot = hash_position(p, part) & mask;
        for (;; slot = (slot + 1) & mask) {
            uint32_t vertex = weld->table[slot];
            if (vertex == NONE) {
                vertex = weld->vertex_count++;
                weld->table[slot] = vertex;
                weld->corner_of[vertex] = corner;
                weld->parent[vertex] = vertex;
            }
            const float *q = weld->positions + (size_t)weld->corner_of[vertex] * 3;
            if (p[0] == q[0] && p[1] == q[1] && p[2] == q[2] &&
                part == part_at(weld, weld->corner_of[vertex])) {
                weld->vertex_of[corner] = vertex;
                break;
            }
        }
    }
}

// Path halving keeps the paths short without a stack.
static uint32_t find_root(welding *weld, uint32_t vertex)
{
    while (weld->parent[vertex] != vertex) {
        weld->parent[vertex] = weld->parent[weld->parent[vertex]];
        vertex = weld->parent[vertex];
    }
    return vertex;
}

// The lesser root becomes the root. With path halving, near-linear time needs no ranks.
static void join(welding *weld, uint32_t a, uint32_t b)
{
    a = find_root(weld, a);
    b = find_root(weld, b);
    if (a < b) {
        weld->parent[b] = a;
    } else {
        weld->parent[a] = b;
    }
}

static glint_component *append(glint_topology *topology, size_t *capacity)
{
    if (topology->component_count == *capacity) {
        size_t larger = *capacity ? 2 * *capacity : 16;
        size_t bytes;
        if (!glint_multiply(larger, sizeof *topology->components, &bytes)) {
            return NULL;
        }
        glint_component *components = realloc(topology->components, bytes);
        if (components == NULL) {
            return NULL;
        }
        topology->components = components;
        *capacity = larger;
    }
    glint_component *component = &topology->components[topology->component_count++];
    *component = (glint_component){.low = {INFINITY, INFINITY, INFINITY},
                                   .high = {-INFINITY, -INFINITY, -INFINITY}};
    return component;
}

static bool make_room(welding *weld, size_t count)
{
    if (count < weld->gathered_capacity) {
        return true;
    }
    size_t capacity = 2 * weld->gathered_capacity;
    component_sums *larger = realloc(weld->gathered, capacity * sizeof *larger);
    if (larger == NULL) {
        return false;
    }
    weld->gathered = larger;
    weld->gathered_capacity = capacity;
    return true;
}

// Numbers the components by their first triangle, and sums up over their vertices. Returns false if
// memory is short.
static bool number_components(welding *weld, uint32_t instance, glint_topology *topology,
                              size_t *capacity)
{
    for (uint32_t corner = 0; corner < weld->corner_count; corner++) {
        join(weld, weld->vertex_of[corner], weld->vertex_of[next_corner(corner)]);
    }
    size_t first = topology->component_count;
    memset(weld->component, 0xFF, (size_t)weld->vertex_count * sizeof *weld->component);
    for (uint32_t corner = 0; corner < weld->corner_count; corner += 3) {
        uint32_t root = find_root(weld, weld->vertex_of[corner]);
        if (weld->component[root] == NONE) {
            size_t number = topology->component_count - first;
            glint_component *component = append(topology, capacity);
            if (component == NULL || !make_room(weld, number)) {
                return false;
            }
            component->instance = instance;
            weld->gathered[number] = (component_sums){.seen_from_inside = true};
            weld->component[root] = (uint32_t)number;
        }
        topology->components[first + weld->component[root]].triangle_count++;
        weld->component_of[corner / 3] = (uint32_t)first + weld->component[root];
    }
    for (uint32_t vertex = 0; vertex < weld->vertex_count; vertex++) {
        uint32_t number = weld->component[find_root(weld, vertex)];
        weld->component[vertex] = number;
        component_sums *sums = &weld->gathered[number];
        glint_component *component = &topology->components[first + number];
        const float *p = weld->positions + (size_t)weld->corner_of[vertex] * 3;
        sums->vertices++;
        sums->sum = glint_vec3_add(sums->sum, (glint_vec3){p[0], p[1], p[2]});
        for (int k = 0; k < 3; k++) {
            const float at = anchor_at(weld, weld->corner_of[vertex])[k] + p[k];
            component->low[k] = fminf(component->low[k], at);
            component->high[k] = fmaxf(component->high[k], at);
        }
    }
    return true;
}

// Stores every half-edge under its lesser vertex, by a counting sort.
static void file_edges(welding *weld)
{
    uint32_t *first = weld->first_edge;
    memset(first, 0, ((size_t)weld->vertex_count + 1) * sizeof *first);
    for (int pass = 0; pass < 2; pass++) {
        for (uint32_t corner = 0; corner < weld->corner_count; corner++) {
            uint32_t a = weld->vertex_of[corner];
            uint32_t b = weld->vertex_of[next_corner(corner)];
            uint32_t lower = a < b ? a : b;
            if (pass == 0) {
                first[lower]++;
            } else {
                // Fill from the end, so that first[] holds the starts in the end.
                weld->edges[--first[lower]] = (half_edge){a < b ? b : a, corner};
            }
        }
        for (uint32_t vertex = 0; pass == 0 && vertex < weld->vertex_count; vertex++) {
            first[vertex + 1] += first[vertex];
        }
    }
}

static int compare_edges(const void *left, const void *right)
{
    const half_edge *a = left;
    const half_edge *b = right;
    if (a->upper != b->upper) {
        return a->upper < b->upper ? -1 : 1;
    }
    return a->corner < b->corner ? -1 : a->corner > b->corner;
}

// Bounds the error of judge_edge's determinant if its four points are off by some roundings. To
// first order it is the sum of |derivative| × |coordinate| × 2^-24.
static double rounding_of(const glint_vec3 *points, const glint_vec3 *derivatives)
{
    double sum = 0;
    for (int i = 0; i < 4; i++) {
        sum += fabs(points[i].x * derivatives[i].x) + fabs(points[i].y * derivatives[i].y) +
               fabs(points[i].z * derivatives[i].z);
    }
    return GLINT_POSITION_ROUNDINGS * ldexp(sum, -24);
}

// Judges the edge from corner `left` to the next corner; its twin begins at corner `right`. The
// triangles are (a, b, c) and (b, a, d). The surface bends inwards if d is above the first one's
// plane. Doubles hold the differences of floats exactly. The determinant's own rounding, about
// 2^-50, is far below the tolerance.
static void judge_edge(const welding *weld, uint32_t left, uint32_t right, component_sums *sums)
{
    glint_vec3 a = position_at(weld, left);
    glint_vec3 b = position_at(weld, right);
    glint_vec3 c = position_at(weld, next_corner(next_corner(left)));
    glint_vec3 d = position_at(weld, next_corner(next_corner(right)));
    glint_vec3 edge = glint_vec3_subtract(b, a);
    glint_vec3 to_c = glint_vec3_subtract(c, a);
    glint_vec3 to_d = glint_vec3_subtract(d, a);
    glint_vec3 normal = glint_vec3_cross(edge, to_c);
    glint_vec3 other = glint_vec3_cross(to_d, edge);
    double height = glint_vec3_dot(normal, to_d);
    if (height <= 0) {
        return;
    }
    glint_vec3 by_b = glint_vec3_cross(to_c, to_d);
    glint_vec3 by_a = glint_vec3_add(by_b, glint_vec3_add(other, normal)); // negated
    const glint_vec3 points[4] = {a, b, c, d};
    const glint_vec3 derivatives[4] = {by_a, by_b, other, normal};
    if (!(height <= rounding_of(points, derivatives)) || !(glint_vec3_dot(normal, other) > 0)) {
        sums->bends_inwards = true;
        return;
    }
    // The sine of the bend, which is small.
    sums->rounding_bends +=
        height * glint_vec3_length(edge) / (glint_vec3_length(normal) * glint_vec3_length(other));
}

static void pair_edges(welding *weld, glint_component *components)
{
    for (uint32_t vertex = 0; vertex < weld->vertex_count; vertex++) {
        half_edge *edges = weld->edges + weld->first_edge[vertex];
        uint32_t count = weld->first_edge[vertex + 1] - weld->first_edge[vertex];
        uint32_t number = weld->component[vertex];
        qsort(edges, count, sizeof *edges, compare_edges);
        for (uint32_t i = 0, end; i < count; i = end) {
            end = i + 1;
            while (end < count && edges[end].upper == edges[i].upper) {
                end++;
            }
            weld->gathered[number].edges++;
            bool opposite = end - i == 2 && weld->vertex_of[edges[i].corner] !=
                                                weld->vertex_of[edges[i + 1].corner];
            if (opposite) {
                judge_edge(weld, edges[i].corner, edges[i + 1].corner, &weld->gathered[number]);
            } else {
                components[number].boundary_edges++;
            }
        }
    }
}

static bool is_simple(const glint_component *component, const component_sums *sums)
{
    return component->boundary_edges == 0 &&
           sums->vertices + component->triangle_count == sums->edges + 2;
}

// True if the edges allow the component to be convex.
static bool may_be_convex(const glint_component *component, const component_sums *sums)
{
    return is_simple(component, sums) && !sums->bends_inwards;
}

// The solid angle of a triangle, seen from the origin, by Van Oosterom and Strackee (1983).
// Positive if seen from the inside.
static double solid_angle(glint_vec3 a, glint_vec3 b, glint_vec3 c)
{
    double la = glint_vec3_length(a);
    double lb = glint_vec3_length(b);
    double lc = glint_vec3_length(c);
    double numerator = glint_vec3_dot(a, glint_vec3_cross(b, c));
    double denominator = la * lb * lc + glint_vec3_dot(a, b) * lc + glint_vec3_dot(b, c) * la +
                         glint_vec3_dot(c, a) * lb;
    return 2 * atan2(numerator, denominator);
}

// Adds the volumes of the pyramids over the triangles. Their apex is a corner of the component's
// bounds.
static void add_volumes(const welding *weld, glint_topology *topology)
{
    for (uint32_t corner = 0; corner < weld->corner_count; corner += 3) {
        glint_component *c = &topology->components[weld->component_of[corner / 3]];
        const float *anchor = anchor_at(weld, corner);
        const glint_vec3 top = {(double)c->low[0] - (double)anchor[0],
                                (double)c->low[1] - (double)anchor[1],
                                (double)c->low[2] - (double)anchor[2]};
        const glint_vec3 p0 = glint_vec3_subtract(position_at(weld, corner), top);
        const glint_vec3 p1 = glint_vec3_subtract(position_at(weld, corner + 1), top);
        const glint_vec3 p2 = glint_vec3_subtract(position_at(weld, corner + 2), top);
        c->volume += glint_vec3_dot(p0, glint_vec3_cross(p1, p2)) / 6;
    }
}

static void look_from_inside(welding *weld, const glint_component *components)
{
    for (uint32_t corner = 0; corner < weld->corner_count; corner += 3) {
        uint32_t number = weld->component[weld->vertex_of[corner]];
        component_sums *sums = &weld->gathered[number];
        if (!sums->seen_from_inside || !may_be_convex(&components[number], sums)) {
            continue;
        }
        glint_vec3 mean = glint_vec3_scale(sums->sum, 1 / (double)sums->vertices);
        double angle = solid_angle(glint_vec3_subtract(position_at(weld, corner), mean),
                                   glint_vec3_subtract(position_at(weld, corner + 1), mean),
                                   glint_vec3_subtract(position_at(weld, corner + 2), mean));
        sums->seen_from_inside = angle > 0;
        sums->solid_angle += angle;
    }
}

// True if the component is convex, except for hollows that are shallower than rounding everywhere.
static bool is_nearly_convex(const glint_component *component, const component_sums *sums)
{
    // Multiples of 4π are far apart compared with the sum's rounding.
    return may_be_convex(component, sums) && sums->seen_from_inside &&
           fabs(sums->solid_angle - 4 * GLINT_PI) < 0.1;
}

// True if the bends that rounding explains may hide a hollow. If they add up to less than the
// limit, a line that leaves the surface more steeply than the limit does not meet it again. A
// hollow would have to bend more than the limit.
static bool bends_add_up(const component_sums *sums)
{
    return sums->rounding_bends > 1.0 / 1024;
}

// Gathers the vertices of the components to search, component by component. Each ends at
// component_sums.end.
static void gather_points(welding *weld, glint_surface_point *points)
{
    for (uint32_t vertex = 0; vertex < weld->vertex_count; vertex++) {
        component_sums *sums = &weld->gathered[weld->component[vertex]];
        if (sums->look_for_hollows) {
            // Union-find no longer needs `parent`: reuse it for the place of the vertex's point.
            glint_surface_point *point = &points[sums->end];
            const float *p = weld->positions + (size_t)weld->corner_of[vertex] * 3;
            memcpy(point->position, p, sizeof point->position);
            weld->parent[vertex] = (uint32_t)sums->end++;
        }
    }
    for (uint32_t corner = 0; corner < weld->corner_count; corner++) {
        uint32_t vertex = weld->vertex_of[corner];
        if (!weld->gathered[weld->component[vertex]].look_for_hollows) {
            continue;
        }
        uint32_t next = next_corner(corner);
        glint_vec3 here = position_at(weld, corner);
        glint_vec3 normal =
            glint_vec3_cross(glint_vec3_subtract(position_at(weld, next), here),
                             glint_vec3_subtract(position_at(weld, next_corner(next)), here));
        glint_vec3 *sum = &points[weld->parent[vertex]].normal;
        *sum = glint_vec3_add(*sum, normal);
    }
}

// Clears `convex` of components that may have a hollow. If memory is short, none of them is proved.
static void look_for_hollows(welding *weld, glint_component *components, size_t count)
{
    size_t point_count = 0;
    for (size_t i = 0; i < count; i++) {
        component_sums *sums = &weld->gathered[i];
        sums->look_for_hollows = components[i].convex && bends_add_up(sums);
        sums->end = point_count;
        point_count += sums->look_for_hollows ? sums->vertices : 0;
    }
    glint_surface_point *points =
        point_count > 0 ? glint_allocate(point_count, sizeof *points) : NULL;
    if (points != NULL) {
        gather_points(weld, points);
    }
    for (size_t i = 0; i < count; i++) {
        const component_sums *sums = &weld->gathered[i];
        if (sums->look_for_hollows) {
            components[i].convex =
                points != NULL &&
                glint_points_are_extreme(points + (sums->end - sums->vertices), sums->vertices);
        }
    }
    free(points);
}

static bool find_in_instance(welding *weld, uint32_t instance, glint_topology *topology,
                             size_t *capacity)
{
    size_t first = topology->component_count;
    weld_corners(weld);
    if (!number_components(weld, instance, topology, capacity)) {
        return false;
    }
    glint_component *components = topology->components + first;
    size_t count = topology->component_count - first;
    add_volumes(weld, topology);
    file_edges(weld);
    pair_edges(weld, components);
    look_from_inside(weld, components);
    for (size_t i = 0; i < count; i++) {
        components[i].closed = components[i].boundary_edges == 0;
        components[i].simple = is_simple(&components[i], &weld->gathered[i]);
        components[i].convex = is_nearly_convex(&components[i], &weld->gathered[i]);
        topology->boundary_edges += components[i].boundary_edges;
    }
    look_for_hollows(weld, components, count);
    return true;
}

static bool allocate_weld(welding *weld, size_t corners)
{
    weld->vertex_of = glint_allocate(corners, sizeof *weld->vertex_of);
    weld->corner_of = glint_allocate(corners, sizeof *weld->corner_of);
    weld->parent = glint_allocate(corners, sizeof *weld->parent);
    weld->component = glint_allocate(corners, sizeof *weld->component);
    weld->table = glint_allocate(table_size((uint32_t)corners), sizeof *weld->table);
    weld->first_edge = glint_allocate(corners + 1, sizeof *weld->first_edge);
    weld->edges = glint_allocate(corners, sizeof *weld->edges);
    weld->gathered_capacity = 16;
    weld->gathered = glint_allocate(weld->gathered_capacity, sizeof *weld->gathered);
    return weld->gathered && weld->vertex_of && weld->corner_of && weld->parent &&
           weld->component && weld->table && weld->first_edge && weld->edges;
}

static void free_weld(welding *weld)
{
    free(weld->vertex_of);
    free(weld->corner_of);
    free(weld->parent);
    free(weld->component);
    free(weld->table);
    free(weld->first_edge);
    free(weld->edges);
    free(weld->gathered);
}

static glint_status find(const glint_scene *scene, bool solids_alone, glint_topology *topology,
                         glint_error *error)
{
    *topology = (glint_topology){0};
    welding weld = {0};
    size_t capacity = 0;
    glint_status status = GLINT_OK;
    size_t largest = 0;
    // Allocate for the largest instance.
    for (size_t i = 0; i < scene->instance_count; i++) {
        size_t count = scene->instances[i].triangle_count;
        largest = count > largest ? count : largest;
    }
    topology->component_of = glint_allocate(scene->triangle_count, sizeof *topology->component_of);
    // Corner numbers have 32 bits.
    if (largest > (NONE - 1) / 3 || !allocate_weld(&weld, largest * 3) ||
        topology->component_of == NULL) {
        status = glint_fail_memory(error, "the topology of the scene");
        goto cleanup;
    }
    // Find the components of each instance.
    for (size_t i = 0; i < scene->instance_count; i++) {
        const glint_instance *instance = &scene->instances[i];
        if (solids_alone && !glint_instance_is_solid(scene, instance)) {
            memset(topology->component_of + instance->first_triangle, 0xFF,
                   instance->triangle_count * sizeof *topology->component_of);
            continue;
        }
        const glint_parts *parts = &scene->parts;
        weld.positions = glint_scene_told(scene) + instance->first_triangle * 9;
        weld.part_of = parts->count > 0 ? parts->part_of + instance->first_triangle : NULL;
        weld.anchors = (const float(*)[3])parts->anchors;
        weld.component_of = topology->component_of + instance->first_triangle;
        weld.corner_count = (uint32_t)(instance->triangle_count * 3);
        if (!find_in_instance(&weld, (uint32_t)i, topology, &capacity)) {
            status = glint_fail_memory(error, "the topology of the scene");
            goto cleanup;
        }
    }
cleanup:
    free_weld(&weld);
    if (status != GLINT_OK) {
        glint_topology_free(topology);
    }
    return status;
}

glint_status glint_topology_find(const glint_scene *scene, glint_topology *topology,
                                 glint_error *error)
{
    return find(scene, false, topology, error);
}

glint_status glint_topology_find_solids(const glint_scene *scene, glint_topology *topology,
                                        glint_error *error)
{
    return find(scene, true, topology, error);
}

void glint_topology_free(glint_topology *topology)
{
    free(topology->components);
    free(topology->component_of);
    *topology = (glint_topology){0};
}
