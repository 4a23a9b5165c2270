// Finds where solids touch and overlap, and where other surfaces touch them. The triangles of
// solids, and triangles near them, are sorted so that neighbours in space stand together. A tree of
// boxes lies over them: boxes of eight triangles, of eight such boxes, and so on. The tree is
// joined with itself: triangles whose boxes meet are compared, O(n log n) pairs.
//
// The kernels judge ray by ray, so a mark too many costs time but changes no picture.
#include "scene/shape/contacts.h"

#include "base/memory.h"
#include "base/vector.h"
#include "kernels/layout.h"
#include "scene/shape/faces.h"

#include <meshoptimizer.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FAN 8     // children of a box; triangles of a lowest box
#define LEVELS 12 // enough for 8^12 triangles
// The most pairs of triangles to compare, worth some seconds. A heap of triangles that all cross
// each other has more pairs, and more contacts than anyone reads. In this case all triangles may
// touch.
#define PAIRS_MAX ((size_t)16 * 1024 * 1024)
#define CONTACTS_MAX ((size_t)256 * 1024)
#define SIDES_MAX ((size_t)1024 * 1024) // of edges on triangles; more are not looked at
#define MIXED 0xFFFFFFFFu
#define NO_SOLID 0xFFFFFFFEu // a component number for triangles of no solid

typedef struct box {
    float low[3], high[3];
    uint32_t component; // component of all triangles inside, or MIXED
} box;

// A triangle of one solid with an edge on a triangle of another one.
typedef struct side_of_edge {
    uint32_t plane, body; // components: of the triangle that the edge lies on, and of the edge
    glint_face_edge edge;
} side_of_edge;

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
    side_of_edge *sides;
    size_t side_count, side_capacity;
    bool complete;
} search;

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

// Notes on which side of `f` is a triangle that has an edge on it. If two triangles at the edge are
// on both sides, the surfaces cross there.
static void note_edge(search *s, uint32_t plane, uint32_t body, const glint_face *f,
                      const glint_face *other)
{
    side_of_edge side = {.plane = plane, .body = body};
    if (!glint_edge_on_face(f, other, &side.edge)) {
        return;
    }
    if (s->side_count == SIDES_MAX) {
        s->pairs = 0;
        return;
    }
    if (s->side_count == s->side_capacity) {
        const size_t larger = s->side_capacity > 0 ? 2 * s->side_capacity : 64;
        side_of_edge *sides = realloc(s->sides, larger * sizeof *sides);
        if (sides == NULL) {
            s->complete = false;
            return;
        }
        s->sides = sides;
        s->side_capacity = larger;
    }
    s->sides[s->side_count++] = side;
}

// Sorts the sides of an edge together.
static int compare_edges(const void *left, const void *right)
{
    const side_of_edge *a = left;
    const side_of_edge *b = right;
    if (a->plane != b->plane) {
        return a->plane < b->plane ? -1 : 1;
    }
    if (a->body != b->body) {
        return a->body < b->body ? -1 : 1;
    }
    const double one[6] = {a->edge.ends[0].x, a->edge.ends[0].y, a->edge.ends[0].z,
                           a->edge.ends[1].x, a->edge.ends[1].y, a->edge.ends[1].z};
    const double other[6] = {b->edge.ends[0].x, b->edge.ends[0].y, b->edge.ends[0].z,
                             b->edge.ends[1].x, b->edge.ends[1].y, b->edge.ends[1].z};
    for (int k = 0; k < 6; k++) {
        if (one[k] != other[k]) {
            return one[k] < other[k] ? -1 : 1;
        }
    }
    return 0;
}

// Finds the edges where surfaces cross.
static void cross_in_edges(search *s)
{
    if (s->side_count > 0) {
        qsort(s->sides, s->side_count, sizeof *s->sides, compare_edges);
    }
    size_t first = 0;
    for (size_t i = 1; i < s->side_count; i++) {
        first = compare_edges(&s->sides[i], &s->sides[first]) == 0 ? first : i;
        if (s->sides[i].edge.is_above != s->sides[first].edge.is_above) {
            note_contact(s, s->sides[i].plane, s->sides[i].body, true);
        }
    }
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
    const glint_face one = glint_face_of(s->scene, a);
    const glint_face other = glint_face_of(s->scene, b);
    const glint_meeting how = glint_faces_meet(&one, &other);
    // Neighbours in a plane have equal winding.
    if (same && !(how == GLINT_FACES_TOUCH && glint_vec3_dot(one.normal, other.normal) < 0)) {
        return;
    }
    const bool solids = left->component != NO_SOLID && right->component != NO_SOLID;
    if (solids && how == GLINT_FACES_MEET_IN_EDGE) {
        note_edge(s, left->component, right->component, &one, &other);
        note_edge(s, right->component, left->component, &other, &one);
    } else if (solids && how != GLINT_FACES_APART) {
        note_contact(s, left->component, right->component, how == GLINT_FACES_CROSS);
    }
    if (how == GLINT_FACES_TOUCH) {
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

static box box_of_triangle(const glint_scene *scene, size_t triangle)
{
    box b = empty_box();
    for (size_t i = 0; i < 3; i++) {
        const float *p = glint_scene_position(scene, triangle, i);
        grow_box(&b, p, p);
    }
    return b;
}

// The triangle's box, widened so that coinciding triangles' boxes meet.
static box box_of(const search *s, uint32_t triangle)
{
    box b = box_of_triangle(s->scene, triangle);
    const glint_face f = glint_face_of(s->scene, triangle);
    const float margin = (float)glint_face_reach(&f, &f);
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
        const float margin = (float)(16 * (double)GLINT_TOUCHING); // coordinates are ≤ 1
        all.low[k] -= margin;
        all.high[k] += margin;
    }
    return all;
}

// Lists the triangles that may be near solids; `triangles` may be NULL. Returns their number.
static size_t list_triangles(const search *s, uint32_t *triangles)
{
    const glint_scene *scene = s->scene;
    const box near = bounds_of_solids(scene, s->topology);
    size_t count = 0;
    for (size_t i = 0; i < scene->triangle_count; i++) {
        const box own = box_of_triangle(scene, i);
        if (boxes_meet(&own, &near)) {
            if (triangles != NULL) {
                triangles[count] = (uint32_t)i;
            }
            count++;
        }
    }
    return count;
}

// Sorts the triangles so that neighbours in space stand together.
static bool sort_triangles(search *s)
{
    s->count = list_triangles(s, NULL);
    uint32_t *near = glint_allocate_unset(s->count, sizeof *near);
    unsigned int *place = glint_allocate_unset(s->count, sizeof *place);
    float(*middles)[3] = glint_allocate_unset(s->count, sizeof *middles);
    s->order = glint_allocate_unset(s->count, sizeof *s->order);
    const bool done = near != NULL && place != NULL && middles != NULL && s->order != NULL;
    if (done) {
        list_triangles(s, near);
        for (size_t i = 0; i < s->count; i++) {
            const float *a = glint_scene_position(s->scene, near[i], 0);
            const float *b = glint_scene_position(s->scene, near[i], 1);
            const float *c = glint_scene_position(s->scene, near[i], 2);
            for (int k = 0; k < 3; k++) {
                middles[i][k] = (a[k] + b[k] + c[k]) / 3;
            }
        }
        meshopt_spatialSortRemap(place, middles[0], s->count, sizeof *middles);
        for (size_t i = 0; i < s->count; i++) {
            s->order[place[i]] = near[i];
        }
    }
    free(near);
    free(place);
    free(middles);
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
        cross_in_edges(&s);
        mark_rest(&s);
    }
    free(s.sides);
    free(s.order);
    for (int i = 0; i < LEVELS; i++) {
        free(s.boxes[i]);
    }
    sort_contacts(solids);
    return s.complete;
}
