// Computes bounds over time. See sweep.h.
#include "scene/gltf/sweep.h"

#include "base/memory.h"
#include "scene/gltf/flatten.h"
#include "scene/gltf/walk.h"

#include <stdlib.h>

// A clip is evaluated at this many evenly spaced times, and at its keys, where motion may reverse.
// Between two times, moving things are assumed to stay near their positions at both.
enum { SWEEP_STEPS = 64, SWEEP_KEYS_MAX = 4096 };

// The most cost of deforming over all times, two seconds of one core. A vertex of four joints costs
// 5, about 120 ns. Scenes of higher cost are evaluated at fewer times.
static const double most_deforming = 5 * 0x1p24;
// The most boxes of moving instances over all times, some seconds.
static const double most_moving = 0x1p26;
static const double fewest_times = 17;

// ---- Times --------------------------------------------------------------------------------------

typedef struct time_list {
    double *all; // [count], ascending; owned
    size_t count;
} time_list;

static int compare_times(const void *a, const void *b)
{
    const double one = *(const double *)a, other = *(const double *)b;
    return (one > other) - (one < other);
}

static glint_status find_times(const glint_clips *clips, time_list *times, glint_error *error)
{
    size_t keys = 0, count = 0;
    for (size_t i = 0; i < clips->count; i++) {
        for (int property = 0; property < GLINT_PROPERTIES; property++) {
            keys += clips->moves[i].of[property].key_count;
        }
    }
    times->all = glint_allocate(keys + SWEEP_STEPS + 1, sizeof *times->all);
    if (times->all == NULL) {
        return glint_fail_memory(error, "the scene");
    }
    for (size_t i = 0; i < clips->count; i++) {
        for (int property = 0; property < GLINT_PROPERTIES; property++) {
            const glint_curve *curve = &clips->moves[i].of[property];
            for (size_t k = 0; k < curve->key_count; k++) {
                times->all[count++] = curve->times[k];
            }
        }
    }
    qsort(times->all, count, sizeof *times->all, compare_times);
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) {
        if (kept == 0 || times->all[i] != times->all[kept - 1]) {
            times->all[kept++] = times->all[i];
        }
    }
    // Of more keys, which lie close together, keep every stride-th.
    const size_t stride = kept / SWEEP_KEYS_MAX + 1;
    for (size_t i = 0; i * stride < kept; i++) {
        times->all[i] = times->all[i * stride];
    }
    times->count = (kept + stride - 1) / stride;
    for (int step = 0; step <= SWEEP_STEPS; step++) {
        times->all[times->count++] = clips->duration * step / SWEEP_STEPS;
    }
    qsort(times->all, times->count, sizeof *times->all, compare_times);
    return GLINT_OK;
}

// Returns how many times are evaluated, evenly and with both ends, if each costs `each` and `all`
// may be spent.
static size_t affordable(const time_list *times, double each, double all)
{
    const double count = fmax(fewest_times, all / fmax(each, 1.0));
    return count < (double)times->count ? (size_t)count : times->count;
}

static double chosen_time(const time_list *times, size_t i, size_t chosen)
{
    return times->all[chosen == times->count ? i : i * (times->count - 1) / (chosen - 1)];
}

// ---- Drawings -----------------------------------------------------------------------------------

typedef enum motion_kind { STILL, MOVING, DEFORMING } motion_kind;

// A visited node with a mesh.
typedef struct mesh_drawing {
    size_t visit;
    motion_kind motion;
    glint_instances instances; // owned
} mesh_drawing;

typedef struct sweep_state {
    const glint_load *load;
    glint_poses poses;
    glint_tally said_elsewhere; // dropped: loading a frame gives the same warnings
    glint_mat4 *placed;         // [visit]
    glint_bounds *boxes;        // [primitive], as in the file
    mesh_drawing *drawings;     // [drawing_count]
    size_t drawing_count;
    glint_bounds bounds;
} sweep_state;

// Lists what is drawn; refuses too much before anything takes time.
static glint_status list_drawings(sweep_state *sweeper, glint_error *error)
{
    const glint_load *load = sweeper->load;
    size_t drawn = 0, triangles = 0;
    for (size_t i = 0; i < load->visits.count; i++) {
        const glint_document_node *node = glint_load_node(load, i);
        const glint_visit *visit = &load->visits.all[i];
        if (!visit->is_shown || node->mesh < 0) {
            continue;
        }
        const glint_run primitives = glint_load_primitives(load, i);
        size_t drawable = 0, each = 0;
        for (uint32_t p = 0; p < primitives.count; p++) {
            const size_t own = load->primitives.all[primitives.first + p].triangles;
            each += own;
            drawable += own > 0 ? 1 : 0;
        }
        if (drawable == 0) {
            continue;
        }
        mesh_drawing *added = &sweeper->drawings[sweeper->drawing_count++];
        added->visit = i;
        added->motion = visit->deforms ? DEFORMING : visit->moves ? MOVING : STILL;
        TRY(glint_instances_find(load, visit->node, drawn, &added->instances, error));
        const size_t copies = added->instances.count > 0 ? added->instances.count : 1;
        drawn += drawable * copies;
        triangles += each * copies;
    }
    return glint_flatten_check_count(triangles, error);
}

static double count_boxes(const sweep_state *sweeper)
{
    double boxes = 0;
    for (size_t i = 0; i < sweeper->drawing_count; i++) {
        const mesh_drawing *drawing = &sweeper->drawings[i];
        if (drawing->motion == MOVING) {
            boxes += drawing->instances.count > 0 ? (double)drawing->instances.count : 1;
        }
    }
    return boxes;
}

static bool any_is(const sweep_state *sweeper, motion_kind motion)
{
    for (size_t i = 0; i < sweeper->drawing_count; i++) {
        if (sweeper->drawings[i].motion == motion) {
            return true;
        }
    }
    return false;
}

// ---- Boxes --------------------------------------------------------------------------------------

// The bounds of the triangles' corners, deformed by the shape; NULL: as in the file.
static glint_bounds box_of(const glint_primitive *primitive, const glint_shape *shape)
{
    glint_bounds box = GLINT_BOUNDS_EMPTY;
    for (size_t t = 0; t < primitive->triangles; t++) {
        for (size_t c = 0; c < 3; c++) {
            if (shape != NULL) {
                glint_bounds_grow(&box, shape->positions[glint_shape_element(shape, t, c)]);
                continue;
            }
            double p[3];
            glint_array_numbers(&primitive->positions, glint_primitive_vertex(primitive, t, c), 3,
                                p);
            glint_bounds_grow(&box, (glint_vec3){p[0], p[1], p[2]});
        }
    }
    return box;
}

static void grow_by_box(const glint_mat4 *to_world, const glint_bounds *box, glint_bounds *all)
{
    for (int corner = 0; corner < 8; corner++) {
        const glint_vec3 p = {(corner & 1) != 0 ? box->high.x : box->low.x,
                              (corner & 2) != 0 ? box->high.y : box->low.y,
                              (corner & 4) != 0 ? box->high.z : box->low.z};
        glint_bounds_grow(all, glint_mat4_point(to_world, p));
    }
}

static void grow_by_primitive(sweep_state *sweeper, const mesh_drawing *drawing, size_t index,
                              glint_shape *shape)
{
    const glint_primitive *primitive = &sweeper->load->primitives.all[index];
    const int skin = glint_load_node(sweeper->load, drawing->visit)->skin;
    const glint_stand stand =
        glint_poses_stand(&sweeper->poses, shape, skin, &sweeper->placed[drawing->visit]);
    if (stand.is_hidden || primitive->triangles == 0) {
        return;
    }
    glint_shape *deformed = shape != NULL && glint_shape_deforms(shape) ? shape : NULL;
    glint_bounds *box = deformed != NULL ? &deformed->box : &sweeper->boxes[index];
    if (glint_bounds_are_empty(box)) {
        *box = box_of(primitive, deformed);
    }
    for (size_t i = 0; i < drawing->instances.count; i++) {
        const glint_mat4 to_world =
            glint_mat4_multiply(&stand.to_world, &drawing->instances.places[i]);
        grow_by_box(&to_world, box, &sweeper->bounds);
    }
    if (drawing->instances.count == 0) {
        grow_by_box(&stand.to_world, box, &sweeper->bounds);
    }
}

// Grows the bounds by the posed drawings of a kind.
static glint_status grow(sweep_state *sweeper, motion_kind motion, glint_error *error)
{
    for (size_t i = 0; i < sweeper->drawing_count; i++) {
        const mesh_drawing *drawing = &sweeper->drawings[i];
        if (drawing->motion != motion) {
            continue;
        }
        glint_shape *shapes;
        TRY(glint_poses_shapes(&sweeper->poses, sweeper->load->visits.all[drawing->visit].node,
                               &shapes, error));
        const glint_run primitives = glint_load_primitives(sweeper->load, drawing->visit);
        for (uint32_t p = 0; p < primitives.count; p++) {
            grow_by_primitive(sweeper, drawing, primitives.first + p,
                              shapes == NULL ? NULL : &shapes[p]);
        }
    }
    return GLINT_OK;
}

// ---- Times and drawings -------------------------------------------------------------------------

// Places the moving nodes at a time.
static void place(sweep_state *sweeper, double time)
{
    const glint_load *load = sweeper->load;
    for (size_t i = 0; i < load->visits.count; i++) {
        if (load->visits.all[i].moves) {
            sweeper->placed[i] = glint_visit_place(&load->visits, i, time, sweeper->placed);
        }
    }
}

// Deforms the meshes of drawings that deform, or of all others, for the time of place().
static glint_status pose(sweep_state *sweeper, bool deforming, double time, double *cost,
                         glint_error *error)
{
    glint_shape *shapes;
    glint_poses_begin(&sweeper->poses, time, sweeper->placed);
    for (size_t i = 0; i < sweeper->drawing_count; i++) {
        if ((sweeper->drawings[i].motion == DEFORMING) == deforming) {
            const size_t visit = sweeper->drawings[i].visit;
            TRY(glint_poses_shapes(&sweeper->poses, sweeper->load->visits.all[visit].node, &shapes,
                                   error));
        }
    }
    size_t count;
    glint_shape **all = glint_poses_deforming(&sweeper->poses, &count);
    if (all == NULL) {
        return glint_fail_memory(error, "the scene");
    }
    const glint_status status =
        glint_shapes_deform(all, count, false, &sweeper->said_elsewhere, error);
    *cost = 0;
    for (size_t i = 0; i < count; i++) {
        *cost += glint_shape_cost(all[i]);
    }
    free(all);
    return status;
}

static glint_status sweep(sweep_state *sweeper, const time_list *times, glint_error *error)
{
    double cost;
    // Evaluate drawings at rest once.
    TRY(pose(sweeper, false, 0, &cost, error));
    TRY(grow(sweeper, STILL, error));
    // Evaluate rigid motion, as often as its cost allows.
    size_t count = affordable(times, count_boxes(sweeper), most_moving);
    for (size_t i = 0; i < count; i++) {
        place(sweeper, chosen_time(times, i, count));
        TRY(grow(sweeper, MOVING, error));
    }
    if (!any_is(sweeper, DEFORMING)) {
        return GLINT_OK;
    }
    // Evaluate deforming meshes, as often as their cost allows.
    place(sweeper, 0);
    TRY(pose(sweeper, true, 0, &cost, error));
    count = affordable(times, cost, most_deforming);
    for (size_t i = 0; i < count; i++) {
        const double time = chosen_time(times, i, count);
        place(sweeper, time);
        TRY(pose(sweeper, true, time, &cost, error));
        TRY(grow(sweeper, DEFORMING, error));
    }
    return GLINT_OK;
}

static glint_status prepare(sweep_state *sweeper, glint_error *error)
{
    const glint_load *load = sweeper->load;
    TRY(glint_poses_init(&sweeper->poses, &load->poses.source, error));
    const size_t primitives = load->document.primitives_count;
    sweeper->placed = glint_allocate(load->visits.count, sizeof *sweeper->placed);
    sweeper->boxes = glint_allocate(primitives, sizeof *sweeper->boxes);
    sweeper->drawings = glint_allocate(load->visits.count, sizeof *sweeper->drawings);
    if (sweeper->placed == NULL || sweeper->boxes == NULL || sweeper->drawings == NULL) {
        return glint_fail_memory(error, "the scene");
    }
    for (size_t i = 0; i < load->visits.count; i++) {
        sweeper->placed[i] = glint_visit_place(&load->visits, i, 0, sweeper->placed);
    }
    for (size_t i = 0; i < primitives; i++) {
        sweeper->boxes[i] = GLINT_BOUNDS_EMPTY;
    }
    return list_drawings(sweeper, error);
}

glint_status glint_sweep(const glint_load *load, glint_bounds *bounds, glint_error *error)
{
    sweep_state sweeper = {
        .load = load, .said_elsewhere = GLINT_TALLY_EMPTY, .bounds = GLINT_BOUNDS_EMPTY};
    time_list times = {NULL, 0};
    glint_status status = prepare(&sweeper, error);
    if (status == GLINT_OK) {
        status = find_times(&load->clips, &times, error);
    }
    if (status == GLINT_OK) {
        status = sweep(&sweeper, &times, error);
    }
    *bounds = sweeper.bounds;
    for (size_t i = 0; i < sweeper.drawing_count; i++) {
        free(sweeper.drawings[i].instances.places);
    }
    free(times.all);
    free(sweeper.placed);
    free(sweeper.boxes);
    free(sweeper.drawings);
    glint_poses_free(&sweeper.poses);
    glint_tally_free(&sweeper.said_elsewhere);
    return status;
}
