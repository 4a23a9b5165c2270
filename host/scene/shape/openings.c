// Judges the openings of solids. See openings.h. Linear in time, up to a factor for the samples of
// level surfaces.
#include "scene/shape/openings.h"

#include "base/hash_table.h"
#include "base/memory.h"
#include "kernels/layout.h"
#include "scene/shape/faces.h"
#include "scene/shape/welding.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool is_opaque(const glint_material *m)
{
    const glint_lobes lobes = glint_material_lobes(m);
    return !lobes.glass && !lobes.masked && !lobes.covers;
}

static const float *told_corner(const glint_scene *scene, uint32_t corner)
{
    return glint_scene_told(scene, corner / 3, corner % 3);
}

// ---- Openings that opaque surfaces close --------------------------------------------------------

// An edge of a boundary: its ends in order, and how many more triangles run from the first to the
// second than back.
typedef struct border_edge {
    float ends[6];
    uint32_t part;
    int balance;
} border_edge;

typedef struct border_table {
    border_edge *edges; // [count], all different
    uint32_t count;
    glint_hash_table table;
} border_table;

typedef struct sought_edge {
    const border_edge *edges, *edge;
} sought_edge;

// Makes the edge that begins at a corner. Its balance is 1 or −1.
static border_edge edge_at(const glint_scene *scene, uint32_t corner)
{
    const float *a = told_corner(scene, corner);
    const float *b = told_corner(scene, glint_next_corner(corner));
    bool swaps = false;
    for (int k = 2; k >= 0; k--) {
        swaps = a[k] != b[k] ? a[k] > b[k] : swaps;
    }
    border_edge edge = {.part = scene->parts.count > 0 ? scene->parts.part_of[corner / 3] : 0,
                        .balance = swaps ? -1 : 1};
    for (int k = 0; k < 3; k++) {
        edge.ends[k] = (swaps ? b : a)[k] + 0.0f; // −0 becomes 0
        edge.ends[k + 3] = (swaps ? a : b)[k] + 0.0f;
    }
    return edge;
}

static bool is_edge(const void *sought, uint32_t number)
{
    const border_edge *edge = ((const sought_edge *)sought)->edge;
    const border_edge *known = &((const sought_edge *)sought)->edges[number];
    bool equal = known->part == edge->part;
    for (int k = 0; k < 6; k++) {
        equal = equal && known->ends[k] == edge->ends[k];
    }
    return equal;
}

// The slot of an edge; it is empty if the edge is new.
static uint32_t *slot_of(const border_table *border, const border_edge *edge)
{
    const sought_edge sought = {border->edges, edge};
    return glint_hash_table_slot(&border->table, glint_hash_floats(edge->part, edge->ends, 6),
                                 is_edge, &sought);
}

static bool make_table(const glint_scene *scene, const glint_topology *topology,
                       border_table *border)
{
    const size_t most = topology->open_corner_count;
    *border = (border_table){.edges = glint_allocate_unset(most, sizeof *border->edges)};
    if (!glint_hash_table_create(most, &border->table) || border->edges == NULL) {
        return false;
    }
    for (size_t i = 0; i < most; i++) {
        const border_edge edge = edge_at(scene, topology->open_corners[i]);
        uint32_t *slot = slot_of(border, &edge);
        if (*slot == GLINT_NO_ITEM) {
            *slot = border->count++;
            border->edges[*slot] = edge;
        } else {
            border->edges[*slot].balance += edge.balance;
        }
    }
    return true;
}

static void add_opaque(const glint_scene *scene, const border_table *border)
{
    for (size_t t = 0; t < scene->triangle_count; t++) {
        for (uint32_t k = 0; k < 3 && is_opaque(&scene->materials[scene->material_of[t]]); k++) {
            const border_edge edge = edge_at(scene, (uint32_t)(3 * t) + k);
            const uint32_t number = *slot_of(border, &edge);
            if (number != GLINT_NO_ITEM) {
                border->edges[number].balance += edge.balance;
            }
        }
    }
}

// Clears the marks of components all of whose boundary edges opaque triangles continue.
static bool clear_closed(const glint_scene *scene, const glint_topology *topology, bool *is_open)
{
    border_table border = {0};
    bool *has_hole = glint_allocate(topology->component_count, sizeof *has_hole);
    const bool done = has_hole != NULL && make_table(scene, topology, &border);
    if (done) {
        add_opaque(scene, &border);
        for (size_t i = 0; i < topology->open_corner_count; i++) {
            const uint32_t corner = topology->open_corners[i];
            const border_edge edge = edge_at(scene, corner);
            if (border.edges[*slot_of(&border, &edge)].balance != 0) {
                has_hole[topology->component_of[corner / 3]] = true;
            }
        }
        for (size_t i = 0; i < topology->component_count; i++) {
            is_open[i] = is_open[i] && has_hole[i];
        }
    }
    free(border.edges);
    glint_hash_table_free(&border.table);
    free(has_hole);
    return done;
}

// ---- Level surfaces -----------------------------------------------------------------------------

#define LEVELS_MAX 16  // more level surfaces are not looked at
#define SAMPLES_MAX 64 // points of a boundary
#define FLATNESS 0.125 // the greatest height of a level surface, as a share of its width
#define REACH (4 * (double)GLINT_TOUCHING) // places nearer than that touch; coordinates are ≤ 1

typedef struct level_surface {
    uint32_t component;
    bool rises;   // all its triangles face upwards
    bool is_met;  // something is lower than its boundary, and beside it
    double least; // height of the lowest point of its boundary
    size_t sample_count;
    glint_vec3 samples[SAMPLES_MAX]; // of its boundary
    bool is_held[SAMPLES_MAX];       // an opaque surface touches the sample
    double above[SAMPLES_MAX];       // distance to the nearest opaque surface above the sample
    bool is_buried[SAMPLES_MAX];     // which shows its back to the sample
} level_surface;

// Counts in an opaque face that may hold a sample of the boundary, or lie above it.
static void hold_sample(level_surface *level, size_t i, const glint_face *f)
{
    const glint_vec3 p = level->samples[i];
    const double height = glint_vec3_dot(f->normal, glint_vec3_subtract(p, f->at[0]));
    if (fabs(height) <= REACH) {
        level->is_held[i] = level->is_held[i] || glint_face_faces(f, p, REACH);
        return;
    }
    const double up = -height / f->normal.y; // infinite for upright faces
    const glint_vec3 over = {p.x, p.y + up, p.z};
    if (up > 0 && up < level->above[i] && glint_face_faces(f, over, REACH)) {
        level->above[i] = up;
        level->is_buried[i] = f->normal.y > 0;
    }
}

static bool may_be_level(const glint_component *c)
{
    const double width =
        fmin((double)c->high[0] - (double)c->low[0], (double)c->high[2] - (double)c->low[2]);
    return (double)c->high[1] - (double)c->low[1] <= FLATNESS * width;
}

static size_t list_levels(const glint_topology *topology, const bool *is_open,
                          level_surface *levels)
{
    size_t count = 0;
    for (size_t i = 0; i < topology->component_count && count < LEVELS_MAX; i++) {
        if (is_open[i] && may_be_level(&topology->components[i])) {
            levels[count++] =
                (level_surface){.component = (uint32_t)i, .rises = true, .least = INFINITY};
        }
    }
    return count;
}

// Takes samples of a level surface's boundary: the middles of its edges, or of some of them.
static void take_samples(const glint_scene *scene, const glint_topology *topology,
                         level_surface *level)
{
    const size_t edges = topology->components[level->component].boundary_edges;
    const size_t every = edges / SAMPLES_MAX + 1;
    size_t seen = 0;
    for (size_t i = 0; i < topology->open_corner_count; i++) {
        const uint32_t corner = topology->open_corners[i];
        if (topology->component_of[corner / 3] != level->component) {
            continue;
        }
        const uint32_t next = glint_next_corner(corner);
        const glint_vec3 a = glint_scene_corner(scene, corner / 3, corner % 3);
        const glint_vec3 b = glint_scene_corner(scene, next / 3, next % 3);
        level->least = fmin(level->least, fmin(a.y, b.y));
        if (seen++ % every == 0 && level->sample_count < SAMPLES_MAX) {
            level->above[level->sample_count] = INFINITY;
            level->samples[level->sample_count++] = glint_vec3_scale(glint_vec3_add(a, b), 0.5);
        }
    }
}

// Counts in a triangle of another component, or of no solid.
static void meet_triangle(const glint_component *own, const glint_face *f, bool opaque,
                          level_surface *level)
{
    const glint_vec3 *at = f->at;
    const double low[2] = {fmin(at[0].x, fmin(at[1].x, at[2].x)),
                           fmin(at[0].z, fmin(at[1].z, at[2].z))};
    const double high[2] = {fmax(at[0].x, fmax(at[1].x, at[2].x)),
                            fmax(at[0].z, fmax(at[1].z, at[2].z))};
    bool is_beside = false;
    bool is_apart = false;
    for (int k = 0; k < 2; k++) {
        const double own_low = (double)own->low[2 * k], own_high = (double)own->high[2 * k];
        is_beside = is_beside || low[k] < own_low || high[k] > own_high;
        is_apart = is_apart || high[k] < own_low - REACH || low[k] > own_high + REACH;
    }
    const double lowest = fmin(at[0].y, fmin(at[1].y, at[2].y));
    level->is_met = level->is_met || (is_beside && lowest < level->least - REACH);
    for (size_t i = 0; opaque && !is_apart && i < level->sample_count; i++) {
        hold_sample(level, i, f);
    }
}

static bool is_water(const level_surface *level)
{
    bool is_enclosed = true;
    for (size_t i = 0; i < level->sample_count; i++) {
        is_enclosed = is_enclosed && (level->is_held[i] || level->is_buried[i]);
    }
    return level->rises && (is_enclosed || !level->is_met);
}

// Clears the marks of the level surfaces of liquids.
static bool clear_levels(const glint_scene *scene, const glint_topology *topology, bool *is_open)
{
    level_surface *levels = glint_allocate(LEVELS_MAX, sizeof *levels);
    const size_t count = levels != NULL ? list_levels(topology, is_open, levels) : 0;
    for (size_t i = 0; i < count; i++) {
        take_samples(scene, topology, &levels[i]);
    }
    for (size_t t = 0; count > 0 && t < scene->triangle_count; t++) {
        const glint_face f = glint_face_of(scene, t);
        const bool opaque = is_opaque(&scene->materials[scene->material_of[t]]);
        for (size_t i = 0; i < count; i++) {
            if (topology->component_of[t] == levels[i].component) {
                levels[i].rises = levels[i].rises && f.normal.y > 0;
            } else {
                meet_triangle(&topology->components[levels[i].component], &f, opaque, &levels[i]);
            }
        }
    }
    for (size_t i = 0; i < count; i++) {
        is_open[levels[i].component] = !is_water(&levels[i]);
    }
    free(levels);
    return levels != NULL;
}

bool glint_openings_judge(const glint_scene *scene, const glint_topology *topology, bool *is_open)
{
    return clear_closed(scene, topology, is_open) && clear_levels(scene, topology, is_open);
}
