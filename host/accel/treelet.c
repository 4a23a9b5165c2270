// Builds a treelet by exact sweeps over sorted triangles. The sweeps know which vertices are
// shared. See treelet.h.
#include "accel/treelet.h"

#include "accel/cluster.h"

#include <string.h>

#define CAPACITY GLINT_TREELET_MAX
#define BUCKETS 128  // for sorting triangles
#define TABLE_BITS 9 // of the vertex table: more than three slots per triangle

typedef struct treelet {
    const glint_bvh_inputs *in;
    glint_arena *arena;
    float scale; // scale of areas
    int count;
    glint_reference references[CAPACITY];
    uint32_t triangles[CAPACITY];
    uint64_t groups[CAPACITY];      // see glint_bvh_group
    uint16_t vertices[CAPACITY][4]; // numbers of each triangle's three vertices, from 0
    uint8_t order[3][CAPACITY];     // on each axis, the triangles sorted by their centres
    uint16_t stamps[3 * CAPACITY];  // by vertex: the last count that included it
    uint16_t stamp;
    uint8_t is_left[CAPACITY], right[CAPACITY]; // used while a cut is applied
    float clusters[CAPACITY + 1]; // by number of triangles: clusters that they are expected to make
} treelet;

// Some of the treelet's triangles: in each order, `count` triangles from `first` on.
typedef struct part {
    int first, count;
    bool fits; // the triangles make one cluster
} part;

typedef struct cut {
    float cost;
    int axis, left_count;
    bool left_fits, right_fits;
} cut;

// ---- Vertices ----------------------------------------------------------------------------------

// A vertex as integers: position, and normal or 0.
typedef struct vertex_bits {
    uint64_t words[3];
} vertex_bits;

static inline vertex_bits bits_of(const glint_bvh_inputs *in, size_t triangle, size_t corner)
{
    vertex_bits bits;
    uint32_t last[2] = {0, 0};
    const float *told = glint_bvh_told(in, triangle, corner);
    memcpy(&bits.words[0], told, sizeof bits.words[0]);
    memcpy(&last[0], told + 2, sizeof last[0]);
    bits.words[1] = 0;
    if (in->normals != NULL) {
        const float *normal = glint_bvh_normal(in, triangle, corner);
        memcpy(&bits.words[1], normal, sizeof bits.words[1]);
        memcpy(&last[1], normal + 2, sizeof last[1]);
    }
    bits.words[2] = (uint64_t)last[1] << 32 | last[0];
    return bits;
}

static inline bool same_bits(const vertex_bits *a, const vertex_bits *b)
{
    return ((a->words[0] ^ b->words[0]) | (a->words[1] ^ b->words[1]) |
            (a->words[2] ^ b->words[2])) == 0;
}

// Returns a place in the table.
static inline unsigned hash_of(const vertex_bits *bits)
{
    uint64_t mixed =
        bits->words[0] ^ bits->words[1] << 7 ^ (bits->words[2] << 29 | bits->words[2] >> 35);
    return (unsigned)((mixed * 0x9e3779b97f4a7c15u) >> (64 - TABLE_BITS));
}

// Numbers the vertices: corners whose position and normal have the same bits share a number.
// Returns the number of vertices.
static int number_vertices(treelet *t)
{
    uint16_t table[1 << TABLE_BITS] = {0}; // a vertex's number + 1
    vertex_bits vertices[3 * CAPACITY + 1];
    int count = 0;
    for (int i = 0; i < t->count; i++) {
        for (size_t corner = 0; corner < 3; corner++) {
            vertices[count] = bits_of(t->in, t->triangles[i], corner);
            unsigned slot = hash_of(&vertices[count]);
            while (table[slot] != 0 && !same_bits(&vertices[table[slot] - 1], &vertices[count])) {
                slot = (slot + 1) % (1 << TABLE_BITS);
            }
            if (table[slot] == 0) {
                table[slot] = (uint16_t)++count;
            }
            t->vertices[i][corner] = (uint16_t)(table[slot] - 1);
        }
    }
    return count;
}

// Counts the triangle's vertices that are new in this count, and stamps them.
static inline int new_vertices(treelet *t, int triangle)
{
    const uint16_t *vertices = t->vertices[triangle];
    const uint16_t now = t->stamp;
    // A triangle may have the same vertex twice, so stamp each vertex before testing the next.
    int count = t->stamps[vertices[0]] != now;
    t->stamps[vertices[0]] = now;
    count += t->stamps[vertices[1]] != now;
    t->stamps[vertices[1]] = now;
    count += t->stamps[vertices[2]] != now;
    t->stamps[vertices[2]] = now;
    return count;
}

// Estimates the clusters of i triangles. If few vertices are shared, the vertices fill the clusters
// before the triangles do. Up to 16 triangles that do not make one cluster make two.
static void expect_clusters(treelet *t, int vertices)
{
    const float load = fmaxf(1, (float)vertices / (float)t->count) / GLINT_CLUSTER_LANES;
    for (int i = 0; i <= t->count; i++) {
        t->clusters[i] = fmaxf(2, (float)(int)((float)i * load + 0.999f));
    }
}

// ---- Order -------------------------------------------------------------------------------------

// Sorts into buckets, then by insertion, which has little left to do. The sort is stable.
static void sort_axis(treelet *t, glint_box middles, int axis)
{
    float keys[CAPACITY];
    uint8_t bucket_of[CAPACITY], starts[BUCKETS + 1] = {0};
    uint8_t *order = t->order[axis];
    const float low = -middles.low_negated[axis];
    const float scale = glint_bin_scale(middles.high[axis] - low, BUCKETS);
    for (int i = 0; i < t->count; i++) {
        keys[i] = glint_box_middle(t->references[i])[axis];
        bucket_of[i] = (uint8_t)((keys[i] - low) * scale);
        starts[bucket_of[i] + 1]++;
    }
    for (int i = 1; i < BUCKETS; i++) {
        starts[i] = (uint8_t)(starts[i] + starts[i - 1]);
    }
    for (int i = 0; i < t->count; i++) {
        order[starts[bucket_of[i]]++] = (uint8_t)i;
    }
    for (int i = 1; i < t->count; i++) {
        const uint8_t triangle = order[i];
        int k = i;
        for (; k > 0 && keys[order[k - 1]] > keys[triangle]; k--) {
            order[k] = order[k - 1];
        }
        order[k] = triangle;
    }
}

// ---- Splits ------------------------------------------------------------------------------------

// Returns how many of a part's triangles make one cluster: the most, from one end of an order on.
// `step` is 1 or −1.
static int fitting_count(treelet *t, const uint8_t *order, int step, int count)
{
    const uint64_t group = t->groups[*order];
    int vertices = 0;
    int most = count < GLINT_CLUSTER_LANES ? count : GLINT_CLUSTER_LANES;
    t->stamp++;
    for (int i = 0; i < most; i++, order += step) {
        vertices += new_vertices(t, *order);
        if (vertices > GLINT_CLUSTER_LANES || t->groups[*order] != group) {
            return i;
        }
    }
    return most;
}

static inline float cost_of(const treelet *t, glint_box box, int triangles, int fitting)
{
    float clusters = triangles <= fitting ? 1 : t->clusters[triangles];
    return glint_cluster_cost(box, t->scale, clusters);
}

// Looks for a better place to cut the part along one axis.
static void sweep_axis(treelet *t, const part *p, int axis, cut *best)
{
    const uint8_t *order = t->order[axis] + p->first;
    const int last = p->count - 1;
    const int left_fitting = fitting_count(t, order, 1, p->count);
    const int right_fitting = fitting_count(t, order + last, -1, p->count);
    float left_cost[CAPACITY];
    glint_box box = glint_box_empty();
    for (int i = 0; i < last; i++) {
        box = glint_box_union(box, t->references[order[i]]);
        left_cost[i] = cost_of(t, box, i + 1, left_fitting);
    }
    box = glint_box_empty();
    for (int i = last; i > 0; i--) {
        box = glint_box_union(box, t->references[order[i]]);
        float cost = left_cost[i - 1] + cost_of(t, box, p->count - i, right_fitting);
        if (cost < best->cost) {
            *best = (cut){cost, axis, i, i <= left_fitting, p->count - i <= right_fitting};
        }
    }
}

static inline float extent_of(const treelet *t, const part *p, int axis)
{
    const uint8_t *order = t->order[axis] + p->first;
    return glint_box_middle(t->references[order[p->count - 1]])[axis] -
           glint_box_middle(t->references[order[0]])[axis];
}

// True for an axis that is not short: a part is hardly ever cut along its short axes.
static bool is_worth_cutting(const treelet *t, const part *p, int axis)
{
    float longest = fmaxf(extent_of(t, p, (axis + 1) % 3), extent_of(t, p, (axis + 2) % 3));
    return extent_of(t, p, axis) >= 0.5f * longest;
}

// Moves the left triangles of a cut to the front of each order. The sort order is kept on both
// sides.
static void apply_cut(treelet *t, const part *p, const cut *c)
{
    for (int i = 0; i < p->count; i++) {
        t->is_left[t->order[c->axis][p->first + i]] = i < c->left_count;
    }
    for (int axis = 0; axis < 3; axis++) {
        uint8_t *order = t->order[axis] + p->first;
        int lefts = 0, rights = 0;
        for (int i = 0; i < p->count; i++) {
            uint8_t triangle = order[i];
            int is_left = t->is_left[triangle];
            order[lefts] = triangle;
            t->right[rights] = triangle;
            lefts += is_left;
            rights += 1 - is_left;
        }
        memcpy(order + lefts, t->right, (size_t)rights);
    }
}

static glint_box bounds_of(const treelet *t, const part *p)
{
    glint_box box = glint_box_empty();
    for (int i = p->first; i < p->first + p->count; i++) {
        box = glint_box_union(box, t->references[t->order[0][i]]);
    }
    return box;
}

// ---- The tree ----------------------------------------------------------------------------------

static bool make_leaf(treelet *t, const part *p, glint_binary_node *node, glint_wide_costs *costs)
{
    glint_leaf *leaf = glint_arena_take(t->arena, sizeof *leaf);
    if (leaf == NULL) {
        return false;
    }
    *leaf = (glint_leaf){.count = p->count};
    uint8_t lane_of[3 * CAPACITY];
    int lanes = 0;
    t->stamp++;
    for (int i = 0; i < p->count; i++) {
        int triangle = t->order[0][p->first + i];
        leaf->triangles[i] = t->triangles[triangle];
        for (int corner = 0; corner < 3; corner++) {
            uint16_t vertex = t->vertices[triangle][corner];
            if (t->stamps[vertex] != t->stamp) {
                t->stamps[vertex] = t->stamp;
                leaf->sources[lanes] = (uint8_t)(4 * i + corner);
                lane_of[vertex] = (uint8_t)lanes++;
            }
            leaf->corners[corner][i] = lane_of[vertex];
        }
    }
    node->children = NULL;
    node->leaf = leaf;
    node->cluster_count = 1;
    *costs = glint_wide_costs_of_leaf();
    return true;
}

static bool build(treelet *t, const part *p, glint_binary_node *node, glint_wide_costs *costs)
{
    if (p->fits) {
        return make_leaf(t, p, node, costs);
    }
    // There is always a cut: the longest axis is worth cutting, and no cost is NaN or infinite.
    cut best = {.cost = INFINITY};
    for (int axis = 0; axis < 3; axis++) {
        if (is_worth_cutting(t, p, axis)) {
            sweep_axis(t, p, axis, &best);
        }
    }
    glint_binary_node *children = glint_arena_take(t->arena, 2 * sizeof *children);
    if (children == NULL) {
        return false;
    }
    apply_cut(t, p, &best);
    const part left = {p->first, best.left_count, best.left_fits};
    const part right = {p->first + best.left_count, p->count - best.left_count, best.right_fits};
    children[0].bounds = bounds_of(t, &left);
    children[1].bounds = bounds_of(t, &right);
    node->children = children;
    glint_wide_costs left_costs, right_costs;
    if (!build(t, &left, &children[0], &left_costs) ||
        !build(t, &right, &children[1], &right_costs)) {
        return false;
    }
    *costs = glint_wide_costs_join(node, t->in->width, &left_costs, &right_costs);
    return true;
}

bool glint_treelet_build(const glint_bvh_inputs *in, const glint_treelet_range *range,
                         glint_arena *arena, glint_wide_costs *costs)
{
    treelet t;
    t.in = in;
    t.arena = arena;
    t.scale = glint_box_scale(range->root->bounds);
    t.count = (int)range->count;
    t.stamp = 0;
    memset(t.stamps, 0, sizeof t.stamps);
    glint_box middles = glint_box_empty();
    for (int i = 0; i < t.count; i++) {
        t.references[i] = range->references[i];
        middles = glint_box_union(middles, glint_box_of(glint_box_middle(t.references[i])));
        t.triangles[i] = glint_reference_first(t.references[i]);
        t.groups[i] = glint_bvh_group(in, t.triangles[i]);
    }
    for (int axis = 0; axis < 3; axis++) {
        sort_axis(&t, middles, axis);
    }
    expect_clusters(&t, number_vertices(&t));
    const part all = {0, t.count, fitting_count(&t, t.order[0], 1, t.count) == t.count};
    return build(&t, &all, range->root, costs);
}
