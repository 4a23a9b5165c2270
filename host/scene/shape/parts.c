// Finds small parts and their anchors. Triangles that share edges are joined to parts. Anchors
// stand on a grid a little coarser than the part is wide. So parts that are close to each other
// share an anchor, and their triangles may stand in one cluster of the tree.
#include "scene/shape/parts.h"

#include "base/hash_table.h"
#include "base/memory.h"
#include "base/union_find.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// A part is small if half of its extent is at most SMALL_PART, and the width of its smallest
// triangle at most SMALL_TRIANGLE, in stored units. Half of the scene's extent is about 1. Larger
// parts have enough digits.
#define SMALL_PART 0x1p-6
#define SMALL_TRIANGLE 0x1p-9
#define GRID_OF_PART 2.0 // factor on the power of two above half of the part's extent

// Joins triangles that share edges.
typedef struct joining {
    const glint_exact_triangles *exact;
    uint32_t *same;         // [vertex]: the first vertex at the same place
    uint32_t *parent;       // [triangle]: union-find
    uint32_t *first;        // [vertex + 2]: where its edges begin
    uint32_t *edges;        // [corner], by the lesser end; the corners at which the edges begin
    glint_hash_table table; // of vertices, edges, anchors
} joining;

typedef struct extent {
    double low[3], high[3], smallest; // bounds of its triangles, and the width of the smallest
} extent;

bool glint_parts_may_be_there(double smallest_triangle)
{
    return smallest_triangle <= SMALL_TRIANGLE;
}

// ---- Joining ------------------------------------------------------------------------------------

static uint32_t vertex_of(const glint_exact_triangles *exact, uint32_t corner)
{
    return (uint32_t)glint_triangle_vertex(exact->corners, 0, corner);
}

// A vertex's place, exact or rounded to floats.
typedef struct vertex_place {
    const double *places;
    bool as_floats;
    double at[3];
} vertex_place;

static double coordinate(const vertex_place *place, uint32_t vertex, size_t axis)
{
    const double at = place->places[3 * (size_t)vertex + axis];
    return (place->as_floats ? (double)(float)at : at) + 0.0; // −0 becomes 0
}

static bool is_place(const void *sought, uint32_t vertex)
{
    const vertex_place *place = sought;
    return coordinate(place, vertex, 0) == place->at[0] &&
           coordinate(place, vertex, 1) == place->at[1] &&
           coordinate(place, vertex, 2) == place->at[2];
}

// Sets `same`. Returns the number of different places.
static size_t weld(joining *j, bool as_floats)
{
    size_t places = 0;
    glint_hash_table_empty(&j->table, j->exact->vertex_count);
    for (uint32_t vertex = 0; vertex < j->exact->vertex_count; vertex++) {
        vertex_place place = {.places = j->exact->places, .as_floats = as_floats};
        uint64_t hash = 0, word;
        for (size_t k = 0; k < 3; k++) {
            place.at[k] = coordinate(&place, vertex, k);
            memcpy(&word, &place.at[k], sizeof word);
            hash = glint_hash_mix(hash, word);
        }
        uint32_t *slot = glint_hash_table_slot(&j->table, hash, is_place, &place);
        if (*slot == GLINT_NO_ITEM) {
            *slot = vertex;
            places++;
        }
        j->same[vertex] = *slot;
    }
    return places;
}

// The two ends of the edge that begins at a corner, the lesser first.
static void ends_of(const joining *j, uint32_t corner, uint32_t ends[2])
{
    const uint32_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
    const uint32_t a = j->same[vertex_of(j->exact, corner)];
    const uint32_t b = j->same[vertex_of(j->exact, next)];
    ends[0] = a < b ? a : b;
    ends[1] = a < b ? b : a;
}

// Lists the edges by their lesser end. An edge whose ends are at one place does not count.
static void list_edges(joining *j)
{
    const uint32_t corners = (uint32_t)(3 * j->exact->count);
    uint32_t ends[2];
    memset(j->first, 0, (j->exact->vertex_count + 2) * sizeof *j->first);
    for (uint32_t corner = 0; corner < corners; corner++) {
        ends_of(j, corner, ends);
        j->first[ends[0] + 2] += ends[0] != ends[1] ? 1 : 0;
    }
    for (size_t v = 2; v < j->exact->vertex_count + 2; v++) {
        j->first[v] += j->first[v - 1];
    }
    for (uint32_t corner = 0; corner < corners; corner++) {
        ends_of(j, corner, ends);
        if (ends[0] != ends[1]) {
            j->edges[j->first[ends[0] + 1]++] = corner;
        }
    }
}

static uint32_t upper_end(const joining *j, uint32_t corner)
{
    uint32_t ends[2];
    ends_of(j, corner, ends);
    return ends[1];
}

// Joins the triangles of equal edges among those of one vertex.
static void join_few(joining *j, const uint32_t *edges, size_t count)
{
    for (size_t i = 1; i < count; i++) {
        const uint32_t upper = upper_end(j, edges[i]);
        for (size_t k = 0; k < i; k++) {
            if (upper_end(j, edges[k]) == upper) {
                glint_union_join(j->parent, edges[i] / 3, edges[k] / 3);
                break;
            }
        }
    }
}

typedef struct upper_vertex {
    const joining *j;
    uint32_t vertex;
} upper_vertex;

static bool ends_at(const void *sought, uint32_t edge)
{
    const upper_vertex *upper = sought;
    return upper_end(upper->j, edge) == upper->vertex;
}

// Does the same for many, with a table that is free.
static void join_many(joining *j, const uint32_t *edges, size_t count)
{
    glint_hash_table_empty(&j->table, count);
    for (size_t i = 0; i < count; i++) {
        const upper_vertex upper = {j, upper_end(j, edges[i])};
        uint32_t *slot =
            glint_hash_table_slot(&j->table, glint_hash_mix(0, upper.vertex), ends_at, &upper);
        if (*slot == GLINT_NO_ITEM) {
            *slot = edges[i];
        } else {
            glint_union_join(j->parent, edges[i] / 3, *slot / 3);
        }
    }
}

static void join_by_edges(joining *j)
{
    enum { FEW = 24 }; // usual vertices have three
    list_edges(j);
    for (size_t v = 0; v < j->exact->vertex_count; v++) {
        const uint32_t *edges = j->edges + j->first[v];
        const size_t count = j->first[v + 1] - j->first[v];
        if (count <= FEW) {
            join_few(j, edges, count);
        } else {
            join_many(j, edges, count);
        }
    }
}

// Joins triangles by equal edges: first of exact places, then of rounded ones.
static void join(joining *j)
{
    for (uint32_t t = 0; t < j->exact->count; t++) {
        j->parent[t] = t;
    }
    const size_t places = weld(j, false);
    join_by_edges(j);
    if (weld(j, true) < places) {
        join_by_edges(j);
    }
}

// ---- Anchors ------------------------------------------------------------------------------------

static const double *place_of(const glint_exact_triangles *exact, size_t corner)
{
    return exact->places + 3 * (size_t)vertex_of(exact, (uint32_t)corner);
}

static double lesser(double a, double b)
{
    return a < b ? a : b;
}

static double greater(double a, double b)
{
    return a > b ? a : b;
}

static void grow(extent *e, const glint_exact_triangles *exact, size_t triangle)
{
    const double *a = place_of(exact, 3 * triangle), *b = place_of(exact, 3 * triangle + 1);
    const double *c = place_of(exact, 3 * triangle + 2);
    double widest = 0;
    for (int k = 0; k < 3; k++) {
        const double low = lesser(a[k], lesser(b[k], c[k]));
        const double high = greater(a[k], greater(b[k], c[k]));
        e->low[k] = lesser(e->low[k], low);
        e->high[k] = greater(e->high[k], high);
        widest = greater(widest, high - low);
    }
    e->smallest = lesser(e->smallest, widest);
}

// Returns false if the part is not small; its anchor is then the scene's origin.
static bool choose_anchor(const extent *e, float anchor[3])
{
    double half = 0;
    for (int k = 0; k < 3; k++) {
        half = fmax(half, (e->high[k] - e->low[k]) / 2);
        anchor[k] = 0;
    }
    if (!(half > 0 && half <= SMALL_PART && e->smallest <= SMALL_TRIANGLE)) {
        return false;
    }
    int exponent;
    (void)frexp(half, &exponent);
    const double grid = ldexp(GRID_OF_PART, exponent);
    for (int k = 0; k < 3; k++) {
        anchor[k] = (float)(nearbyint((e->low[k] + e->high[k]) / 2 / grid) * grid) + 0.0f;
    }
    return true;
}

typedef struct anchor {
    const glint_parts *parts;
    float at[3];
} anchor;

static bool is_anchor(const void *sought, uint32_t number)
{
    const anchor *a = sought;
    const float *known = a->parts->anchors[number];
    return known[0] == a->at[0] && known[1] == a->at[1] && known[2] == a->at[2];
}

// Returns the number of an anchor; adds the anchor if it is new.
static uint32_t number_of(glint_parts *parts, const glint_hash_table *numbers, const anchor *a)
{
    uint32_t *slot = glint_hash_table_slot(numbers, glint_hash_floats(0, a->at, 3), is_anchor, a);
    if (*slot == GLINT_NO_ITEM) {
        *slot = (uint32_t)parts->count++;
        memcpy(parts->anchors[*slot], a->at, sizeof a->at);
    }
    return *slot;
}

// Numbers the parts in part_of, in the order of their first triangles. Returns their number.
static size_t number_roots(joining *j, uint32_t *part_of)
{
    size_t roots = 0;
    for (uint32_t t = 0; t < j->exact->count; t++) {
        const uint32_t root = glint_union_root(j->parent, t); // the first of its triangles
        part_of[t] = root == t ? (uint32_t)roots++ : part_of[root];
    }
    return roots;
}

// Gives all triangles the number of their part's anchor. Returns false if memory is short.
// *any_small: some part is small.
static bool number_parts(joining *j, glint_parts *parts, bool *any_small)
{
    const anchor origin = {parts, {0, 0, 0}};
    const size_t count = j->exact->count, roots = number_roots(j, parts->part_of);
    extent *extents = glint_allocate_unset(roots, sizeof *extents);
    uint32_t *numbers = glint_allocate(roots, sizeof *numbers); // [part]: of its anchor
    parts->anchors = glint_allocate(roots + 1, sizeof *parts->anchors);
    const bool is_whole = extents != NULL && numbers != NULL && parts->anchors != NULL;
    for (size_t r = 0; is_whole && r < roots; r++) {
        extents[r] =
            (extent){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, INFINITY};
    }
    for (size_t t = 0; is_whole && t < count; t++) {
        grow(&extents[parts->part_of[t]], j->exact, t);
    }
    glint_hash_table_empty(&j->table, roots + 1);
    if (is_whole) {
        (void)number_of(parts, &j->table, &origin); // the first one
    }
    for (size_t r = 0; is_whole && r < roots; r++) {
        anchor own = {parts, {0, 0, 0}};
        *any_small = choose_anchor(&extents[r], own.at) || *any_small;
        numbers[r] = number_of(parts, &j->table, &own);
    }
    for (size_t t = 0; is_whole && t < count; t++) {
        parts->part_of[t] = numbers[parts->part_of[t]];
    }
    free(extents);
    free(numbers);
    return is_whole;
}

static bool allocate(joining *j)
{
    const size_t vertices = j->exact->vertex_count, count = j->exact->count;
    j->same = glint_allocate_unset(vertices, sizeof *j->same);
    j->parent = glint_allocate_unset(count, sizeof *j->parent);
    j->first = glint_allocate_unset(vertices + 2, sizeof *j->first);
    j->edges = glint_allocate_unset(3 * count, sizeof *j->edges);
    const size_t items = vertices > count ? vertices : count + 1; // count + 1: of anchors
    return glint_hash_table_create(items, &j->table) && j->same != NULL && j->parent != NULL &&
           j->first != NULL && j->edges != NULL;
}

glint_status glint_parts_find(const glint_exact_triangles *exact, glint_parts *parts,
                              glint_error *error)
{
    *parts = (glint_parts){0};
    if (exact->count == 0 || exact->count > (GLINT_NO_ITEM - 1) / 3 ||
        exact->vertex_count > GLINT_NO_ITEM - 2) {
        return GLINT_OK; // corner numbers have 32 bits
    }
    joining j = {.exact = exact};
    parts->part_of = glint_allocate_unset(exact->count, sizeof *parts->part_of);
    bool is_whole = allocate(&j) && parts->part_of != NULL;
    bool any_small = false;
    if (is_whole) {
        join(&j);
        is_whole = number_parts(&j, parts, &any_small);
    }
    free(j.same);
    free(j.parent);
    free(j.first);
    free(j.edges);
    glint_hash_table_free(&j.table);
    if (!is_whole || !any_small) {
        glint_parts_free(parts);
    }
    return is_whole ? GLINT_OK : glint_fail_memory(error, "the scene's small parts");
}

void glint_parts_free(glint_parts *parts)
{
    free(parts->anchors);
    free(parts->part_of);
    free(parts->positions);
    *parts = (glint_parts){0};
}
