// Welds corners by a hash table, and files half-edges by a counting sort. O(n log n) in time. See
// welding.h.
#include "scene/shape/welding.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static uint32_t part_at(const glint_welding *weld, uint32_t corner)
{
    const glint_parts *parts = &weld->scene->parts;
    return parts->count > 0 ? parts->part_of[glint_triangle_at(weld, corner)] : 0;
}

static uint32_t kind_at(const glint_welding *weld, uint32_t corner)
{
    const uint32_t *kind_of = weld->list.kind_of;
    return kind_of != NULL ? kind_of[weld->scene->material_of[glint_triangle_at(weld, corner)]] : 0;
}

// ---- Vertices -----------------------------------------------------------------------------------

// A corner to find the vertex of.
typedef struct sought_corner {
    const glint_welding *weld;
    uint32_t corner;
} sought_corner;

static uint64_t hash_corner(const glint_welding *weld, uint32_t corner)
{
    const uint32_t kind = weld->list.by_kind ? kind_at(weld, corner) : 0;
    const uint64_t hash = glint_hash_mix(kind, part_at(weld, corner));
    return glint_hash_floats(hash, glint_position_at(weld, corner), 3);
}

static bool is_vertex_of(const void *sought, uint32_t vertex)
{
    const sought_corner *s = sought;
    const glint_welding *weld = s->weld;
    const uint32_t a = s->corner, b = weld->corner_of[vertex];
    const float *p = glint_position_at(weld, a);
    const float *q = glint_position_at(weld, b);
    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2] && part_at(weld, a) == part_at(weld, b) &&
           (!weld->list.by_kind || kind_at(weld, a) == kind_at(weld, b));
}

// Returns the vertex at a corner's place; adds it if it is new.
static uint32_t weld_corner(glint_welding *weld, uint32_t corner)
{
    const sought_corner sought = {weld, corner};
    uint32_t *slot =
        glint_hash_table_slot(&weld->table, hash_corner(weld, corner), is_vertex_of, &sought);
    if (*slot == GLINT_NO_ITEM) {
        *slot = weld->vertex_count++;
        weld->corner_of[*slot] = corner;
    }
    return *slot;
}

// The most vertices that the triangles can have.
static uint32_t most_vertices(const glint_scene *scene, uint32_t triangles)
{
    const size_t all = glint_scene_vertex_count(scene), corners = 3 * (size_t)triangles;
    return (uint32_t)(all < corners ? all : corners);
}

static void weld_corners(glint_welding *weld)
{
    glint_hash_table_empty(&weld->table, most_vertices(weld->scene, weld->list.count));
    weld->vertex_count = 0;
    weld->call++;
    for (uint32_t corner = 0; corner < 3 * weld->list.count; corner++) {
        if (weld->known == NULL) {
            weld->vertex_of[corner] = weld_corner(weld, corner);
            continue;
        }
        const size_t triangle = glint_triangle_at(weld, corner);
        glint_known_weld *known =
            &weld->known[glint_scene_vertex(weld->scene, triangle, corner % 3)];
        if (known->call != weld->call) {
            *known = (glint_known_weld){weld->call, weld_corner(weld, corner)};
        }
        weld->vertex_of[corner] = known->vertex;
    }
}

// ---- Half-edges ---------------------------------------------------------------------------------

static int compare_edges(const void *left, const void *right)
{
    const glint_half_edge *a = left;
    const glint_half_edge *b = right;
    if (a->upper != b->upper) {
        return a->upper < b->upper ? -1 : 1;
    }
    return a->corner < b->corner ? -1 : a->corner > b->corner;
}

// Stores every half-edge under its lesser vertex, by a counting sort.
static void file_edges(glint_welding *weld)
{
    uint32_t *first = weld->first_edge;
    memset(first, 0, ((size_t)weld->vertex_count + 1) * sizeof *first);
    for (int pass = 0; pass < 2; pass++) {
        for (uint32_t corner = 0; corner < 3 * weld->list.count; corner++) {
            const uint32_t a = weld->vertex_of[corner];
            const uint32_t b = weld->vertex_of[glint_next_corner(corner)];
            const uint32_t lower = a < b ? a : b;
            if (pass == 0) {
                first[lower]++;
            } else {
                // Fill from the end, so that first[] holds the starts in the end.
                weld->edges[--first[lower]] = (glint_half_edge){a < b ? b : a, corner};
            }
        }
        for (uint32_t vertex = 0; pass == 0 && vertex < weld->vertex_count; vertex++) {
            first[vertex + 1] += first[vertex];
        }
    }
    for (uint32_t vertex = 0; vertex < weld->vertex_count; vertex++) {
        qsort(weld->edges + first[vertex], first[vertex + 1] - first[vertex], sizeof *weld->edges,
              compare_edges);
    }
}

// ---- Many triangles at one edge -----------------------------------------------------------------

// A triangle at an edge that more than two triangles share.
typedef struct blade {
    double angle; // around the edge, counter-clockwise seen from its greater vertex
    uint32_t corner, kind;
    bool opens; // at greater angles is the inside, else at lesser angles
} blade;

// At equal angles, a blade that ends an inside comes before one that begins an inside.
static int compare_angles(const void *left, const void *right)
{
    const blade *a = left;
    const blade *b = right;
    if (a->angle != b->angle) {
        return a->angle < b->angle ? -1 : 1;
    }
    if (a->opens != b->opens) {
        return a->opens ? 1 : -1;
    }
    return a->corner < b->corner ? -1 : a->corner > b->corner;
}

static int compare_kinds(const void *left, const void *right)
{
    const blade *a = left;
    const blade *b = right;
    if (a->kind != b->kind) {
        return a->kind < b->kind ? -1 : 1;
    }
    return compare_angles(left, right);
}

static glint_vec3 vector_between(const float *from, const float *to)
{
    return (glint_vec3){(double)to[0] - (double)from[0], (double)to[1] - (double)from[1],
                        (double)to[2] - (double)from[2]};
}

// Faces that lie on each other are at nearly one angle: where their corners differ, rounding moves
// them by 2^-24 of the coordinates. Triangles are seldom narrower than 2^-14.
#define NEARLY_ONE_ANGLE 0x1p-10

// Gives blades at nearly one angle the same angle, so that what ends comes before what begins.
static void even_angles(blade *blades, uint32_t count)
{
    qsort(blades, count, sizeof *blades, compare_angles);
    for (uint32_t i = 1; i < count; i++) {
        const double before = blades[i - 1].angle;
        blades[i].angle = blades[i].angle - before < NEARLY_ONE_ANGLE ? before : blades[i].angle;
    }
}

// Measures the angles from the first blade on.
static void measure_blades(const glint_welding *weld, const glint_half_edge *edges, uint32_t count,
                           blade *blades)
{
    const uint32_t upper = edges[0].upper;
    const uint32_t start = edges[0].corner;
    const uint32_t lower = weld->vertex_of[start] == upper
                               ? weld->vertex_of[glint_next_corner(start)]
                               : weld->vertex_of[start];
    const float *a = glint_position_at(weld, weld->corner_of[lower]);
    const float *b = glint_position_at(weld, weld->corner_of[upper]);
    const glint_vec3 axis = glint_vec3_normalize(vector_between(a, b));
    glint_vec3 zero = {0, 0, 0}; // direction of the angle 0
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t corner = edges[i].corner;
        const uint32_t third = glint_next_corner(glint_next_corner(corner));
        const glint_vec3 to = vector_between(a, glint_position_at(weld, third));
        if (i == 0) {
            zero = glint_vec3_subtract(to, glint_vec3_scale(axis, glint_vec3_dot(axis, to)));
        }
        const double angle =
            atan2(glint_vec3_dot(axis, glint_vec3_cross(zero, to)), glint_vec3_dot(zero, to));
        blades[i] =
            (blade){.angle = angle < NEARLY_ONE_ANGLE - GLINT_PI ? angle + 2 * GLINT_PI : angle,
                    .corner = corner,
                    .kind = kind_at(weld, corner),
                    .opens = weld->vertex_of[corner] == upper};
    }
    even_angles(blades, count);
}

// Pairs each blade that ends an inside with the earliest blade that began one. So it does not
// matter in which order rounding puts faces of two bodies that lie on each other.
static void pair_blades(const blade *blades, uint32_t count, uint32_t *twin)
{
    // Start where the fewest insides are open.
    uint32_t start = 0;
    int64_t depth = 0;
    int64_t least = 0;
    for (uint32_t i = 0; i < count; i++) {
        depth += blades[i].opens ? 1 : -1;
        if (depth < least) {
            least = depth;
            start = i + 1;
        }
    }
    uint32_t front = 0; // blades before it are no waiting beginnings
    uint32_t waiting = 0;
    for (uint32_t i = 0; i < count; i++) {
        const blade *here = &blades[(start + i) % count];
        waiting += here->opens;
        if (here->opens || waiting == 0) {
            continue;
        }
        while (!blades[(start + front) % count].opens) {
            front++;
        }
        const uint32_t other = blades[(start + front++) % count].corner;
        twin[here->corner] = other;
        twin[other] = here->corner;
        waiting--;
    }
}

// Keeps only the blades without a twin. Returns their number.
static uint32_t keep_unpaired(blade *blades, uint32_t count, const uint32_t *twin)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (twin[blades[i].corner] == GLINT_UNPAIRED) {
            blades[kept++] = blades[i];
        }
    }
    return kept;
}

// Pairs triangles of one kind at an edge, then the rest. Returns false if memory is short.
static bool pair_fan(glint_welding *weld, const glint_half_edge *edges, uint32_t count)
{
    blade few[16];
    blade *blades = count <= 16 ? few : glint_allocate(count, sizeof *blades);
    if (blades == NULL) {
        return false;
    }
    measure_blades(weld, edges, count, blades);
    qsort(blades, count, sizeof *blades, compare_kinds);
    for (uint32_t i = 0, end; i < count; i = end) {
        end = i + 1;
        while (end < count && blades[end].kind == blades[i].kind) {
            end++;
        }
        pair_blades(blades + i, end - i, weld->twin);
    }
    const uint32_t left = keep_unpaired(blades, count, weld->twin);
    qsort(blades, left, sizeof *blades, compare_angles);
    pair_blades(blades, left, weld->twin);
    if (blades != few) {
        free(blades);
    }
    return true;
}

// ------------------------------------------------------------------------------------------------

static bool pair_edges(glint_welding *weld)
{
    memset(weld->twin, 0xFF, 3 * (size_t)weld->list.count * sizeof *weld->twin);
    for (uint32_t vertex = 0; vertex < weld->vertex_count; vertex++) {
        const uint32_t last = weld->first_edge[vertex + 1];
        for (uint32_t i = weld->first_edge[vertex], end; i < last; i = end) {
            const glint_half_edge *edges = weld->edges + i;
            for (end = i + 1; end < last && weld->edges[end].upper == edges->upper;) {
                end++;
            }
            if (end - i > 2) {
                if (!pair_fan(weld, edges, end - i)) {
                    return false;
                }
            } else if (end - i == 2 &&
                       weld->vertex_of[edges[0].corner] != weld->vertex_of[edges[1].corner]) {
                weld->twin[edges[0].corner] = edges[1].corner;
                weld->twin[edges[1].corner] = edges[0].corner;
            }
        }
    }
    return true;
}

// Frees all that belongs to a list.
static void free_list(glint_welding *weld)
{
    free(weld->vertex_of);
    free(weld->corner_of);
    free(weld->twin);
    free(weld->first_edge);
    free(weld->edges);
    glint_hash_table_free(&weld->table);
    *weld = (glint_welding){.scene = weld->scene, .call = weld->call, .known = weld->known};
}

static bool make_room(glint_welding *weld, uint32_t triangles)
{
    const glint_scene *scene = weld->scene;
    const size_t corners = 3 * (size_t)triangles, vertices = most_vertices(scene, triangles);
    if (scene->indices != NULL && weld->known == NULL) {
        weld->known = glint_allocate(scene->vertex_count, sizeof *weld->known);
    }
    if (triangles > weld->capacity) {
        free_list(weld);
        weld->vertex_of = glint_allocate_unset(corners, sizeof *weld->vertex_of);
        weld->corner_of = glint_allocate_unset(vertices, sizeof *weld->corner_of);
        weld->twin = glint_allocate_unset(corners, sizeof *weld->twin);
        weld->first_edge = glint_allocate_unset(vertices + 1, sizeof *weld->first_edge);
        weld->edges = glint_allocate_unset(corners, sizeof *weld->edges);
        weld->capacity = glint_hash_table_create(vertices, &weld->table) ? triangles : 0;
    }
    return (weld->known || scene->indices == NULL) && weld->vertex_of && weld->corner_of &&
           weld->twin && weld->first_edge && weld->edges && weld->table.slots;
}

bool glint_weld(glint_welding *weld, const glint_weld_list *list)
{
    // Corner numbers have 32 bits.
    if (list->count > (GLINT_NO_ITEM - 1) / 3 || !make_room(weld, list->count)) {
        return false;
    }
    weld->list = *list;
    weld_corners(weld);
    file_edges(weld);
    return pair_edges(weld);
}

void glint_welding_free(glint_welding *weld)
{
    free_list(weld);
    free(weld->known);
    *weld = (glint_welding){0};
}
