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

typedef struct joining {
    const double *exact;
    size_t count;        // number of triangles
    uint32_t *vertex_of; // [corner]: the first corner at the same place
    uint32_t *parent;    // [triangle]: union-find
    table table;
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

// The bits of a corner's position, either exact or rounded to floats; −0 becomes 0.
static void place_of(const joining *j, uint32_t corner, bool as_floats, uint64_t words[3])
{
    double place[3];
    for (int k = 0; k < 3; k++) {
        const double at = j->exact[3 * (size_t)corner + (size_t)k];
        place[k] = (as_floats ? (double)(float)at : at) + 0.0;
    }
    memcpy(words, place, sizeof place);
}

static void weld(joining *j, bool as_floats)
{
    memset(j->table.slots, 0xFF, (j->table.mask + 1) * sizeof *j->table.slots);
    for (uint32_t corner = 0; corner < 3 * j->count; corner++) {
        uint64_t words[3], other[3];
        place_of(j, corner, as_floats, words);
        size_t slot = (size_t)mixed(mixed(mixed(0, words[0]), words[1]), words[2]) & j->table.mask;
        for (; j->table.slots[slot] != NONE; slot = (slot + 1) & j->table.mask) {
            place_of(j, j->table.slots[slot], as_floats, other);
            if (words[0] == other[0] && words[1] == other[1] && words[2] == other[2]) {
                break;
            }
        }
        if (j->table.slots[slot] == NONE) {
            j->table.slots[slot] = corner;
        }
        j->vertex_of[corner] = j->table.slots[slot];
    }
}

// The two ends of the edge that begins at a corner, the lesser first.
static void ends_of(const joining *j, uint32_t corner, uint32_t ends[2])
{
    const uint32_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
    const uint32_t a = j->vertex_of[corner], b = j->vertex_of[next];
    ends[0] = a < b ? a : b;
    ends[1] = a < b ? b : a;
}

// Joins triangles that share an edge. An edge whose ends are at one place does not count.
static void join_by_edges(joining *j)
{
    memset(j->table.slots, 0xFF, (j->table.mask + 1) * sizeof *j->table.slots);
    for (uint32_t corner = 0; corner < 3 * j->count; corner++) {
        uint32_t ends[2], other[2];
        ends_of(j, corner, ends);
        if (ends[0] == ends[1]) {
            continue;
        }
        size_t slot = (size_t)mixed(mixed(0, ends[0]), ends[1]) & j->table.mask;
        for (; j->table.slots[slot] != NONE; slot = (slot + 1) & j->table.mask) {
            ends_of(j, j->table.slots[slot], other);
            if (ends[0] == other[0] && ends[1] == other[1]) {
                glint_union_join(j->parent, corner / 3, j->table.slots[slot] / 3);
                break;
            }
        }
        if (j->table.slots[slot] == NONE) {
            j->table.slots[slot] = corner;
        }
    }
}

// ---- Anchors ------------------------------------------------------------------------------------

static void grow(extent *e, const double *corners)
{
    double widest = 0;
    for (int k = 0; k < 3; k++) {
        const double low = fmin(corners[k], fmin(corners[3 + k], corners[6 + k]));
        const double high = fmax(corners[k], fmax(corners[3 + k], corners[6 + k]));
        e->low[k] = fmin(e->low[k], low);
        e->high[k] = fmax(e->high[k], high);
        widest = fmax(widest, high - low);
    }
    e->smallest = fmin(e->smallest, widest);
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

// Measures the part of every root, and gives all triangles the number of its anchor. Returns false
// if no part is small.
static bool number_parts(joining *j, extent *extents, glint_parts *parts)
{
    static const float origin[3] = {0, 0, 0};
    bool any_small = false;
    for (uint32_t t = 0; t < j->count; t++) {
        extents[t] =
            (extent){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, INFINITY};
    }
    for (uint32_t t = 0; t < j->count; t++) {
        grow(&extents[glint_union_root(j->parent, t)], j->exact + 9 * (size_t)t);
    }
    memset(j->table.slots, 0xFF, (j->table.mask + 1) * sizeof *j->table.slots);
    number_of(parts, &j->table, origin);
    for (uint32_t t = 0; t < j->count; t++) {
        const uint32_t root =
            glint_union_root(j->parent, t); // the root is the first of its triangles
        if (root == t) {
            float anchor[3];
            any_small = choose_anchor(&extents[t], anchor) || any_small;
            parts->part_of[t] = number_of(parts, &j->table, anchor);
        }
        parts->part_of[t] = parts->part_of[root];
    }
    return any_small;
}

static void tell_positions(const joining *j, glint_parts *parts)
{
    for (size_t i = 0; i < 9 * j->count; i++) {
        const float *anchor = parts->anchors[parts->part_of[i / 9]];
        parts->positions[i] = (float)(j->exact[i] - (double)anchor[i % 3]);
    }
}

glint_status glint_parts_find(const double *exact, size_t count, glint_parts *parts,
                              glint_error *error)
{
    *parts = (glint_parts){0};
    if (count == 0 || count > (NONE - 1) / 3) {
        return GLINT_OK; // corner numbers have 32 bits
    }
    joining j = {exact, count, NULL, NULL, {NULL, 15}};
    while (j.table.mask < 6 * count) {
        j.table.mask = 2 * j.table.mask + 1;
    }
    j.vertex_of = glint_allocate(3 * count, sizeof *j.vertex_of);
    j.parent = glint_allocate(count, sizeof *j.parent);
    j.table.slots = glint_allocate(j.table.mask + 1, sizeof *j.table.slots);
    extent *extents = glint_allocate(count, sizeof *extents);
    parts->anchors = glint_allocate(count + 1, sizeof *parts->anchors);
    parts->part_of = glint_allocate(count, sizeof *parts->part_of);
    parts->positions = glint_allocate(9 * count, sizeof *parts->positions);
    glint_status status = GLINT_OK;
    bool any_small = false;
    if (!j.vertex_of || !j.parent || !j.table.slots || !extents || !parts->anchors ||
        !parts->part_of || !parts->positions) {
        status = glint_fail_memory(error, "the scene's small parts");
    } else {
        // Join triangles by equal edges: first of exact positions, then of rounded positions.
        for (uint32_t t = 0; t < count; t++) {
            j.parent[t] = t;
        }
        for (int as_floats = 0; as_floats < 2; as_floats++) {
            weld(&j, as_floats);
            join_by_edges(&j);
        }
        any_small = number_parts(&j, extents, parts);
        tell_positions(&j, parts);
    }
    if (!any_small) {
        glint_parts_free(parts);
    }
    free(j.vertex_of);
    free(j.parent);
    free(j.table.slots);
    free(extents);
    return status;
}

void glint_parts_free(glint_parts *parts)
{
    free(parts->anchors);
    free(parts->part_of);
    free(parts->positions);
    *parts = (glint_parts){0};
}
