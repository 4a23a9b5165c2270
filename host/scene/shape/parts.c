// Finds small parts and their anchors. Triangles that share edges are joined to parts. Anchors
// stand on a grid a little coarser than the part is wide. So parts that are close to each other
// share an anchor, and their triangles may stand in one cluster of the tree.
#include "scene/shape/parts.h"

#include "base/memory.h"
#include "base/union_find.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define NONE 0xFFFFFFFFu

// A part is small if half of its extent is at most SMALL_PART, and the width of its smallest
// triangle at most SMALL_TRIANGLE, in stored units. Half of the scene's extent is about 1. Larger
// parts have enough digits.
#define SMALL_PART 0x1p-6
#define SMALL_TRIANGLE 0x1p-9
#define GRID_OF_PART 2.0 // factor on the power of two above half of the part's extent

// A hash table of numbers; its size is a power of two.
typedef struct table {
    uint32_t *slots;
    size_t mask;
} table;

// Joins triangles that share edges.
typedef struct joining {
    const glint_exact_triangles *exact;
    uint32_t *same;   // [vertex]: the first vertex at the same place
    uint32_t *parent; // [triangle]: union-find
    uint32_t *first;  // [vertex + 2]: where its edges begin
    uint32_t *edges;  // [corner], by the lesser end; the corners at which the edges begin
    table table;      // of vertices
} joining;

typedef struct extent {
    double low[3], high[3], smallest; // bounds of its triangles, and the width of the smallest
} extent;

bool glint_parts_may_be_there(double smallest_triangle)
{
    return smallest_triangle <= SMALL_TRIANGLE;
}

// ---- Joining ------------------------------------------------------------------------------------

static uint64_t mixed(uint64_t hash, uint64_t value)
{
    hash = (hash ^ value) * 0x9E3779B97F4A7C15u;
    return hash ^ hash >> 29;
}

static uint32_t vertex_of(const glint_exact_triangles *exact, uint32_t corner)
{
    return exact->corners != NULL ? exact->corners[corner] : corner;
}

// The bits of a vertex's place, either exact or rounded to floats; −0 becomes 0.
static void bits_of(const joining *j, uint32_t vertex, bool as_floats, uint64_t words[3])
{
    double place[3];
    for (int k = 0; k < 3; k++) {
        const double at = j->exact->places[3 * (size_t)vertex + (size_t)k];
        place[k] = (as_floats ? (double)(float)at : at) + 0.0;
    }
    memcpy(words, place, sizeof place);
}

// Sets `same`. Returns the number of different places.
static size_t weld(joining *j, bool as_floats)
{
    size_t places = 0;
    memset(j->table.slots, 0xFF, (j->table.mask + 1) * sizeof *j->table.slots);
    for (uint32_t vertex = 0; vertex < j->exact->vertex_count; vertex++) {
        uint64_t words[3], other[3];
        bits_of(j, vertex, as_floats, words);
        size_t slot = (size_t)mixed(mixed(mixed(0, words[0]), words[1]), words[2]) & j->table.mask;
        for (; j->table.slots[slot] != NONE; slot = (slot + 1) & j->table.mask) {
            bits_of(j, j->table.slots[slot], as_floats, other);
            if (words[0] == other[0] && words[1] == other[1] && words[2] == other[2]) {
                break;
            }
        }
        if (j->table.slots[slot] == NONE) {
            j->table.slots[slot] = vertex;
            places++;
        }
        j->same[vertex] = j->table.slots[slot];
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

// Does the same for many, with a table that is free.
static void join_many(joining *j, const uint32_t *edges, size_t count)
{
    size_t mask = 15;
    while (mask < 2 * count && mask < j->table.mask) {
        mask = 2 * mask + 1;
    }
    memset(j->table.slots, 0xFF, (mask + 1) * sizeof *j->table.slots);
    for (size_t i = 0; i < count; i++) {
        const uint32_t upper = upper_end(j, edges[i]);
        size_t slot = (size_t)mixed(0, upper) & mask;
        while (j->table.slots[slot] != NONE && upper_end(j, j->table.slots[slot]) != upper) {
            slot = (slot + 1) & mask;
        }
        if (j->table.slots[slot] == NONE) {
            j->table.slots[slot] = edges[i];
        } else {
            glint_union_join(j->parent, edges[i] / 3, j->table.slots[slot] / 3);
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

// Returns the number of an anchor; adds the anchor if it is new.
static uint32_t number_of(glint_parts *parts, const table *numbers, const float anchor[3])
{
    uint32_t words[3];
    memcpy(words, anchor, sizeof words);
    size_t slot = (size_t)mixed(mixed(mixed(0, words[0]), words[1]), words[2]) & numbers->mask;
    for (; numbers->slots[slot] != NONE; slot = (slot + 1) & numbers->mask) {
        const float *known = parts->anchors[numbers->slots[slot]];
        if (known[0] == anchor[0] && known[1] == anchor[1] && known[2] == anchor[2]) {
            return numbers->slots[slot];
        }
    }
    memcpy(parts->anchors[parts->count], anchor, sizeof words);
    numbers->slots[slot] = (uint32_t)parts->count;
    return (uint32_t)parts->count++;
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
    static const float origin[3] = {0, 0, 0};
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
    memset(j->table.slots, 0xFF, (j->table.mask + 1) * sizeof *j->table.slots);
    if (is_whole) {
        (void)number_of(parts, &j->table, origin); // the first one
    }
    for (size_t r = 0; is_whole && r < roots; r++) {
        float anchor[3];
        *any_small = choose_anchor(&extents[r], anchor) || *any_small;
        numbers[r] = number_of(parts, &j->table, anchor);
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
    // Vertices and anchors fill half of the table at most.
    while (j->table.mask < 2 * (vertices > count ? vertices : count + 1)) {
        j->table.mask = 2 * j->table.mask + 1;
    }
    j->same = glint_allocate_unset(vertices, sizeof *j->same);
    j->parent = glint_allocate_unset(count, sizeof *j->parent);
    j->first = glint_allocate_unset(vertices + 2, sizeof *j->first);
    j->edges = glint_allocate_unset(3 * count, sizeof *j->edges);
    j->table.slots = glint_allocate_unset(j->table.mask + 1, sizeof *j->table.slots);
    return j->same != NULL && j->parent != NULL && j->first != NULL && j->edges != NULL &&
           j->table.slots != NULL;
}

glint_status glint_parts_find(const glint_exact_triangles *exact, glint_parts *parts,
                              glint_error *error)
{
    *parts = (glint_parts){0};
    if (exact->count == 0 || exact->count > (NONE - 1) / 3 || exact->vertex_count > NONE - 2) {
        return GLINT_OK; // corner numbers have 32 bits
    }
    joining j = {.exact = exact, .table = {NULL, 15}};
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
    free(j.table.slots);
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
