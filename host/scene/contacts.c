// Finds where solids touch and overlap, and where other surfaces touch them. The triangles of
// solids, and triangles near them, are sorted so that neighbours in space stand together. A tree of
// boxes lies over them: boxes of eight triangles, of eight such boxes, and so on. The tree is
// joined with itself: triangles whose boxes meet are compared, O(n log n) pairs.
//
// Two surfaces coincide if their distance along the normal is less than GLINT_TOUCHING of their
// coordinates. The search here uses a few times the distance that the kernels use
// (kernels/overlaps.cl). The kernels judge ray by ray, so a mark too many costs time but changes no
// picture.
#include "scene/contacts.h"

#include "base/memory.h"
#include "base/vector.h"
#include "kernels/layout.h"

#include <meshoptimizer.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FAN 8       // children of a box; triangles of a lowest box
#define LEVELS 12   // enough for 8^12 triangles
#define FARTHER 4.0 // factor on the kernels' distance
// Rays are exact to a share of this many times the distance to a small part (LARGE_TRIANGLE).
#define NEIGHBOURHOOD 16
// The most pairs of triangles to compare, worth some seconds. A heap of triangles that all cross
// each other has more pairs, and more contacts than anyone reads. In this case all triangles may
// touch.
#define PAIRS_MAX ((size_t)16 * 1024 * 1024)
#define CONTACTS_MAX ((size_t)256 * 1024)
#define MIXED 0xFFFFFFFFu
#define NO_SOLID 0xFFFFFFFEu // a component number for triangles of no solid
// The least cosine between coinciding planes; the kernels use 0.99.
#define NEARLY_PARALLEL 0.9

typedef struct box {
    float low[3], high[3];
    uint32_t component; // component of all triangles inside, or MIXED
} box;

typedef struct search {
    const glint_scene *scene;
    const glint_topology *topology;
    glint_solids *solids;
    uint32_t *order; // [count] numbers of triangles, sorted
    size_t count;
    box *boxes[LEVELS]; // level 0: the triangles' boxes, in order
    size_t sizes[LEVELS];
    int levels;
    size_t capacity; // capacity of the list of contacts
    size_t pairs;    // pairs of triangles left to compare
    bool complete;
} search;

// ---- Two triangles ------------------------------------------------------------------------------

typedef struct face {
    glint_vec3 at[3], normal; // the normal is a unit vector
    double along_normal;      // the corners' coordinates along the normal
    double size;              // the largest coordinate
} face;

// Triangles within this distance of a face's plane coincide with it. The first term covers the
// rounding of its corners. The second covers the rounding of rays, for planes through the origin.
// Near a smaller part, rays are as exact as this part is.
static double reach_of(const face *f, const face *other)
{
    const double size = fmin(f->size, NEIGHBOURHOOD * other->size);
    return FARTHER * (double)GLINT_TOUCHING * (f->along_normal + 0.5 * size);
}

static face face_of(const glint_scene *scene, uint32_t triangle)
{
    const float *told = glint_scene_told(scene) + (size_t)triangle * 9;
    face f;
    double most[3] = {0, 0, 0};
    for (int i = 0; i < 3; i++) {
        f.at[i] = glint_scene_corner(scene, triangle, i);
        for (int k = 0; k < 3; k++) {
            most[k] = fmax(most[k], fabs((double)told[3 * i + k]));
        }
    }
    f.size = scene->parts.count > 0 ? fmax(most[0], fmax(most[1], most[2])) : 1;
    f.normal = glint_vec3_normalize(glint_vec3_cross(glint_vec3_subtract(f.at[1], f.at[0]),
                                                     glint_vec3_subtract(f.at[2], f.at[0])));
    f.along_normal =
        fabs(f.normal.x) * most[0] + fabs(f.normal.y) * most[1] + fabs(f.normal.z) * most[2];
    return f;
}

// Heights of the corners of `above` over the plane of `f`; 0 within its reach.
static void find_heights(const face *f, const face *above, double reach, double heights[3])
{
    for (int i = 0; i < 3; i++) {
        const double h = glint_vec3_dot(f->normal, glint_vec3_subtract(above->at[i], f->at[0]));
        heights[i] = fabs(h) <= reach ? 0 : h;
    }
}

static bool all_zero(const double heights[3])
{
    return heights[0] == 0 && heights[1] == 0 && heights[2] == 0;
}

static bool on_one_side(const double heights[3])
{
    return (heights[0] >= 0 && heights[1] >= 0 && heights[2] >= 0) ||
           (heights[0] <= 0 && heights[1] <= 0 && heights[2] <= 0);
}

// True if some edge of `a` separates the two faces within the plane of `a`.
static bool edge_separates(const face *a, const face *b, double reach)
{
    for (int i = 0; i < 3; i++) {
        const glint_vec3 from = a->at[i];
        const glint_vec3 along = glint_vec3_subtract(a->at[(i + 1) % 3], from);
        const glint_vec3 out = glint_vec3_normalize(glint_vec3_cross(along, a->normal));
        double least = INFINITY;
        for (int k = 0; k < 3; k++) {
            least = fmin(least, glint_vec3_dot(out, glint_vec3_subtract(b->at[k], from)));
        }
        if (least >= -reach) {
            return true;
        }
    }
    return false;
}

// Finds the stretch of a line that lies on a face, in the direction `along`. The face crosses the
// line.
static void find_stretch(const face *f, const double heights[3], glint_vec3 along, double ends[2])
{
    ends[0] = INFINITY;
    ends[1] = -INFINITY;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        if (heights[i] * heights[j] > 0 || heights[i] == heights[j]) {
            continue;
        }
        const double share = heights[i] / (heights[i] - heights[j]);
        const glint_vec3 at = glint_vec3_add(
            f->at[i], glint_vec3_scale(glint_vec3_subtract(f->at[j], f->at[i]), share));
        const double where = glint_vec3_dot(along, at);
        ends[0] = fmin(ends[0], where);
        ends[1] = fmax(ends[1], where);
    }
}

typedef enum meeting { APART, TOUCHING, CROSSING } meeting;

// Tells how two faces meet. Möller, "A Fast Triangle-Triangle Intersection Test" (1997).
static meeting meet(const face *a, const face *b)
{
    double of_b[3];
    double of_a[3];
    const double reach_a = reach_of(a, b);
    const double reach_b = reach_of(b, a);
    find_heights(a, b, reach_a, of_b);
    find_heights(b, a, reach_b, of_a);
    if (all_zero(of_a) || all_zero(of_b)) {
        const bool alike = fabs(glint_vec3_dot(a->normal, b->normal)) > NEARLY_PARALLEL;
        return alike && !edge_separates(a, b, reach_a) && !edge_separates(b, a, reach_b) ? TOUCHING
                                                                                         : APART;
    }
    if (on_one_side(of_a) || on_one_side(of_b)) {
        return APART;
    }
    const glint_vec3 along = glint_vec3_normalize(glint_vec3_cross(a->normal, b->normal));
    double one[2];
    double other[2];
    find_stretch(a, of_a, along, one);
    find_stretch(b, of_b, along, other);
    const double common = fmin(one[1], other[1]) - fmax(one[0], other[0]);
    return common > fmax(reach_a, reach_b) ? CROSSING : APART;
}

// ---- All pairs ----------------------------------------------------------------------------------

static bool boxes_meet(const box *a, const box *b)
{
    for (int k = 0; k < 3; k++) {
        if (a->low[k] > b->high[k] || b->low[k] > a->high[k]) {
            return false;
        }
    }
    return true;
}

// True if a component may touch itself: bodies of one mesh that share corners are one component.
static bool may_touch_itself(const search *s, uint32_t component)
{
    return component != NO_SOLID && !s->topology->components[component].simple;
}

static int compare_contacts(const void *left, const void *right)
{
    const glint_contact *a = left;
    const glint_contact *b = right;
    for (int k = 0; k < 2; k++) {
        if (a->components[k] != b->components[k]) {
            return a->components[k] < b->components[k] ? -1 : 1;
        }
    }
    return (int)b->overlap - (int)a->overlap;
}

// Keeps one contact of each pair, an overlap if there is one.
static void sort_contacts(glint_solids *solids)
{
    if (solids->contact_count == 0) {
        return;
    }
    glint_contact *all = solids->contacts;
    qsort(all, solids->contact_count, sizeof *all, compare_contacts);
    size_t kept = 1;
    for (size_t i = 1; i < solids->contact_count; i++) {
        if (memcmp(all[i].components, all[kept - 1].components, sizeof all[i].components) != 0) {
            all[kept++] = all[i];
        }
    }
    solids->contact_count = kept;
}

// Makes room for a contact. If the list is full, keeps one contact of each pair. If it is then
// still more than half full, enlarges it.
static bool make_room(search *s)
{
    glint_solids *solids = s->solids;
    if (solids->contact_count < s->capacity) {
        return true;
    }
    sort_contacts(solids);
    if (solids->contact_count < s->capacity / 2) {
        return true;
    }
    const size_t larger = s->capacity > 0 ? 2 * s->capacity : 16;
    glint_contact *contacts = realloc(solids->contacts, larger * sizeof *contacts);
    if (contacts == NULL) {
        return false;
    }
    solids->contacts = contacts;
    s->capacity = larger;
    s->pairs = larger > CONTACTS_MAX ? 0 : s->pairs;
    return true;
}

static void note_contact(search *s, uint32_t a, uint32_t b, bool overlap)
{
    glint_solids *solids = s->solids;
    const glint_contact contact = {.components = {a < b ? a : b, a < b ? b : a},
                                   .overlap = overlap};
    if (solids->contact_count > 0 &&
        compare_contacts(&solids->contacts[solids->contact_count - 1], &contact) == 0) {
        return;
    }
    if (!make_room(s)) {
        s->complete = false;
        return;
    }
    solids->contacts[solids->contact_count++] = contact;
}

static void meet_triangles(search *s, size_t i, size_t j)
{
    const box *left = &s->boxes[0][i];
    const box *right = &s->boxes[0][j];
    if (i == j || !boxes_meet(left, right)) {
        return;
    }
    const bool same = left->component == right->component;
    if (s->pairs == 0 || (same && !may_touch_itself(s, left->component))) {
        return;
    }
    s->pairs--;
    const uint32_t a = s->order[i];
    const uint32_t b = s->order[j];
    const face one = face_of(s->scene, a);
    const face other = face_of(s->scene, b);
    const meeting how = meet(&one, &other);
    if (how == APART || (same && !(how == TOUCHING && // neighbours in a plane have equal winding
                                   glint_vec3_dot(one.normal, other.normal) < 0))) {
        return;
    }
    const bool solids = left->component != NO_SOLID && right->component != NO_SOLID;
    if (solids) {
        note_contact(s, left->component, right->component, how == CROSSING);
    }
    if (how == TOUCHING) {
        s->solids->touch_others |= !solids;
        s->solids->of_triangle[a].medium |= GLINT_SOLID_TOUCHES;
        s->solids->of_triangle[b].medium |= GLINT_SOLID_TOUCHES;
    }
}

static void join(search *s, int level, size_t i, size_t j)
{
    const box *a = &s->boxes[level][i];
    const box *b = &s->boxes[level][j];
    if (level == 0) {
        meet_triangles(s, i, j);
        return;
    }
    if (s->pairs == 0 || !boxes_meet(a, b) ||
        (a->component == b->component && a->component != MIXED &&
         !may_touch_itself(s, a->component))) {
        return;
    }
    const size_t count = s->sizes[level - 1];
    for (size_t left = i * FAN; left < (i + 1) * FAN && left < count; left++) {
        for (size_t right = i == j ? left : j * FAN; right < (j + 1) * FAN && right < count;
             right++) {
            join(s, level - 1, left, right);
        }
    }
}

// ---- The tree -----------------------------------------------------------------------------------

static box empty_box(void)
{
    return (box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, MIXED};
}

static void grow_box(box *b, const float *low, const float *high)
{
    for (int k = 0; k < 3; k++) {
        b->low[k] = fminf(b->low[k], low[k]);
        b->high[k] = fmaxf(b->high[k], high[k]);
    }
}

// The triangle's box, widened so that coinciding triangles' boxes meet.
static box box_of(const search *s, uint32_t triangle)
{
    const float *p = s->scene->positions + (size_t)triangle * 9;
    box b = empty_box();
    for (int i = 0; i < 3; i++) {
        grow_box(&b, p + (size_t)i * 3, p + (size_t)i * 3);
    }
    const face f = face_of(s->scene, triangle);
    const float margin = (float)reach_of(&f, &f);
    for (int k = 0; k < 3; k++) {
        b.low[k] -= margin;
        b.high[k] += margin;
    }
    b.component = s->solids->of_triangle[triangle].medium != 0 ? s->topology->component_of[triangle]
                                                               : NO_SOLID;
    return b;
}

static bool build_level(search *s)
{
    const int level = s->levels;
    const size_t below = s->sizes[level - 1];
    const size_t count = (below + FAN - 1) / FAN;
    box *boxes = glint_allocate(count, sizeof *boxes);
    s->boxes[level] = boxes;
    s->sizes[level] = count;
    s->levels++;
    for (size_t i = 0; boxes != NULL && i < count; i++) {
        boxes[i] = empty_box();
        boxes[i].component = s->boxes[level - 1][i * FAN].component;
        for (size_t j = i * FAN; j < (i + 1) * FAN && j < below; j++) {
            const box *child = &s->boxes[level - 1][j];
            grow_box(&boxes[i], child->low, child->high);
            boxes[i].component = boxes[i].component == child->component ? child->component : MIXED;
        }
    }
    return boxes != NULL;
}

// The bounds of all solids, and of all triangles that may touch them.
static box bounds_of_solids(const glint_scene *scene, const glint_topology *topology)
{
    box all = empty_box();
    for (size_t i = 0; i < topology->component_count; i++) {
        const glint_component *c = &topology->components[i];
        if (glint_instance_is_solid(scene, &scene->instances[c->instance])) {
            grow_box(&all, c->low, c->high);
        }
    }
    for (int k = 0; k < 3; k++) {
        const float margin = (float)(4 * FARTHER * (double)GLINT_TOUCHING); // coordinates are ≤ 1
        all.low[k] -= margin;
        all.high[k] += margin;
    }
    return all;
}

// Lists the corners of triangles that may be near solids; `corners` may be NULL. Returns the number
// of triangles.
static size_t list_corners(const search *s, unsigned int *corners)
{
    const glint_scene *scene = s->scene;
    const box near = bounds_of_solids(scene, s->topology);
    size_t count = 0;
    for (size_t i = 0; i < scene->triangle_count; i++) {
        box own = empty_box();
        for (size_t k = 0; k < 3; k++) {
            const float *p = scene->positions + 9 * i + 3 * k;
            grow_box(&own, p, p);
        }
        if (boxes_meet(&own, &near)) {
            for (size_t k = 0; corners != NULL && k < 3; k++) {
                corners[3 * count + k] = (unsigned int)(3 * i + k);
            }
            count++;
        }
    }
    return count;
}

// Sorts the triangles so that neighbours in space stand together.
static bool sort_triangles(search *s)
{
    const glint_scene *scene = s->scene;
    s->count = list_corners(s, NULL);
    unsigned int *corners = glint_allocate(3 * s->count, sizeof *corners);
    unsigned int *sorted = glint_allocate(3 * s->count, sizeof *sorted);
    s->order = glint_allocate(s->count, sizeof *s->order);
    const bool done = corners != NULL && sorted != NULL && s->order != NULL;
    if (done) {
        list_corners(s, corners);
        meshopt_spatialSortTriangles(sorted, corners, 3 * s->count, scene->positions,
                                     3 * scene->triangle_count, 3 * sizeof(float));
        for (size_t i = 0; i < s->count; i++) {
            s->order[i] = sorted[3 * i] / 3;
        }
    }
    free(corners);
    free(sorted);
    return done;
}

static bool build(search *s)
{
    if (!sort_triangles(s)) {
        return false;
    }
    s->boxes[0] = glint_allocate(s->count, sizeof *s->boxes[0]);
    if (s->boxes[0] == NULL) {
        return false;
    }
    for (size_t i = 0; i < s->count; i++) {
        s->boxes[0][i] = box_of(s, s->order[i]);
    }
    s->sizes[0] = s->count;
    s->levels = 1;
    while (s->sizes[s->levels - 1] > 1) {
        if (!build_level(s)) {
            return false;
        }
    }
    return true;
}

// Marks all triangles as touching if some pairs were not compared.
static void mark_rest(search *s)
{
    for (size_t i = 0; s->pairs == 0 && i < s->count; i++) {
        s->solids->of_triangle[s->order[i]].medium |= GLINT_SOLID_TOUCHES;
        s->solids->touch_others = true;
    }
}

bool glint_contacts_find(const glint_scene *scene, const glint_topology *topology,
                         glint_solids *solids)
{
    search s = {.scene = scene,
                .topology = topology,
                .solids = solids,
                .pairs = PAIRS_MAX,
                .complete = true};
    s.complete = solids->component_count == 0 || build(&s);
    if (s.complete && s.count > 0) {
        join(&s, s.levels - 1, 0, 0);
        mark_rest(&s);
    }
    free(s.order);
    for (int i = 0; i < LEVELS; i++) {
        free(s.boxes[i]);
    }
    sort_contacts(solids);
    return s.complete;
}
