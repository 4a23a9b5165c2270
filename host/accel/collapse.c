// Collapses a binary tree to the wide tree with the least surface area, and writes its arrays.
// Dynamic programming from the leaves up finds this tree (Ylitie, Karras, Laine, Efficient
// Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs, 2017). See collapse.h.
#include "accel/collapse.h"

#include "accel/cluster.h"
#include "accel/wide_box.h"
#include "base/memory.h"
#include "base/parallel.h"

#include <stdlib.h>
#include <string.h>

// ---- Costs -------------------------------------------------------------------------------------

glint_wide_costs glint_wide_costs_of_leaf(void)
{
    return (glint_wide_costs){.most = 1};
}

// The best way to make `trees` wide trees of two subtrees.
typedef struct sharing {
    double cost;
    uint32_t nodes;
    uint8_t left; // number of trees made of the left subtree
} sharing;

static inline bool is_better(double cost, uint32_t nodes, const sharing *than)
{
    return cost < than->cost || (cost == than->cost && nodes < than->nodes);
}

static sharing share(int trees, const glint_wide_costs *left, const glint_wide_costs *right)
{
    int least = trees > right->most ? trees - right->most : 1;
    int most = trees - 1 < left->most ? trees - 1 : left->most;
    sharing best = {INFINITY, UINT32_MAX, 0};
    for (int k = least; k <= most; k++) {
        double cost = left->cost[k] + right->cost[trees - k];
        uint32_t nodes = left->nodes[k] + right->nodes[trees - k];
        if (is_better(cost, nodes, &best)) {
            best = (sharing){cost, nodes, (uint8_t)k};
        }
    }
    return best;
}

glint_wide_costs glint_wide_costs_join(glint_binary_node *node, int width,
                                       const glint_wide_costs *left, const glint_wide_costs *right)
{
    const int leaves = left->most + right->most;
    glint_wide_costs costs = {.most = leaves < width ? leaves : width};
    sharing children = share(costs.most, left, right);
    node->leaf = NULL;
    node->shares[0] = children.left;
    costs.cost[1] = glint_wide_area(node->bounds) + children.cost;
    costs.nodes[1] = 1 + children.nodes;
    for (int trees = 2; trees <= costs.most; trees++) {
        sharing best = share(trees, left, right);
        sharing fewer = {costs.cost[trees - 1], costs.nodes[trees - 1], 0};
        best = is_better(best.cost, best.nodes, &fewer) ? best : fewer;
        node->shares[trees] = best.left;
        costs.cost[trees] = best.cost;
        costs.nodes[trees] = best.nodes;
    }
    node->cluster_count = node->children[0].cluster_count + node->children[1].cluster_count;
    return costs;
}

// ---- Arrays ------------------------------------------------------------------------------------

typedef struct family {
    int count;
    const glint_binary_node *children[GLINT_WIDTH_MAX];
} family;

// Adds the roots of the forest of up to `trees` wide trees that stands for a subtree.
static void add_trees(family *f, const glint_binary_node *node, int trees)
{
    if (trees > (int)node->cluster_count) {
        trees = (int)node->cluster_count;
    }
    if (trees == 1) {
        f->children[f->count++] = node;
        return;
    }
    const int left = node->shares[trees];
    if (left == 0) {
        add_trees(f, node, trees - 1);
        return;
    }
    add_trees(f, &node->children[0], left);
    add_trees(f, &node->children[1], trees - left);
}

static family family_of(const glint_binary_node *node, int width)
{
    family f = {.count = 0};
    if (node->children == NULL) {
        f.children[f.count++] = node; // the root is a leaf
        return f;
    }
    int trees = (int)node->cluster_count < width ? (int)node->cluster_count : width;
    add_trees(&f, &node->children[0], node->shares[0]);
    add_trees(&f, &node->children[1], trees - node->shares[0]);
    return f;
}

// A wide node to be written. Its index is its place in the list.
typedef struct wide_node {
    const glint_binary_node *root; // the binary node that becomes this wide node
    uint32_t first_inner;          // index of its first child that is a node; its others follow
    uint32_t first_cluster;        // index of the first cluster below it
    int depth;                     // number of nodes above it
    int waiting;                   // stack entries that a traversal may hold above it
} wide_node;

typedef struct collapse {
    const glint_bvh_inputs *in;
    const glint_bvh *bvh;
    wide_node *list; // [node_count], level by level
} collapse;

static void note_node(const wide_node *at, const family *f, double root_area,
                      glint_bvh_report *report)
{
    int need = at->waiting + f->count;
    report->depth = at->depth + 1;
    report->stack_need = need > report->stack_need ? need : report->stack_need;
    report->sah_cost += glint_wide_area(at->root->bounds) / root_area;
    for (int i = 0; i < f->count; i++) {
        if (f->children[i]->children == NULL) {
            report->sah_cost += glint_wide_area(f->children[i]->bounds) / root_area;
        }
    }
}

// Lists the wide nodes level by level. The children of a node stand side by side, behind it.
static void list_nodes(const glint_binary_node *root, int width, wide_node *list,
                       glint_bvh_report *report)
{
    const double root_area = fmax(glint_wide_area(root->bounds), 1e-300);
    report->root_area = glint_wide_area(root->bounds);
    uint32_t count = 1;
    list[0] = (wide_node){.root = root};
    for (uint32_t index = 0; index < count; index++) {
        wide_node *at = &list[index];
        family f = family_of(at->root, width);
        uint32_t cluster = at->first_cluster;
        at->first_inner = count;
        note_node(at, &f, root_area, report);
        for (int i = 0; i < f.count; i++) {
            const glint_binary_node *child = f.children[i];
            if (child->children != NULL) {
                list[count++] =
                    (wide_node){child, 0, cluster, at->depth + 1, at->waiting + f.count - 1};
            }
            cluster += child->cluster_count;
        }
    }
}

// Writes a node, and the clusters among its children.
static void write_node(const collapse *c, size_t index)
{
    const int width = c->bvh->width;
    const wide_node *at = &c->list[index];
    const family f = family_of(at->root, width);
    float *node = c->bvh->nodes + index * GLINT_NODE_VALUES * (size_t)width;
    uint32_t inner = at->first_inner, cluster = at->first_cluster;
    for (int i = 0; i < 6 * width; i++) {
        node[i] = GLINT_FAR;
    }
    for (int i = 0; i < width; i++) {
        int32_t value = 0;
        if (i < f.count) {
            const glint_binary_node *child = f.children[i];
            glint_wide_store_box(node, width, i, child->bounds);
            if (child->children == NULL) {
                glint_cluster_fill(c->in, child->leaf, c->bvh, cluster);
                value = ~(int32_t)cluster;
            } else {
                value = (int32_t)inner++;
            }
            cluster += child->cluster_count;
        }
        memcpy(node + 6 * width + i, &value, sizeof value);
    }
}

#define NODES_PER_TASK 64

static void write_some(size_t task, void *context)
{
    const collapse *c = context;
    size_t first = task * NODES_PER_TASK;
    for (size_t i = first; i < first + NODES_PER_TASK && i < c->bvh->node_count; i++) {
        write_node(c, i);
    }
}

static bool allocate_arrays(const glint_bvh_inputs *in, glint_bvh *bvh)
{
    const size_t values = GLINT_NODE_VALUES * (size_t)bvh->width;
    bvh->nodes = glint_allocate_unset(bvh->node_count, values * sizeof *bvh->nodes);
    bvh->clusters = glint_allocate_unset(bvh->cluster_count, sizeof *bvh->clusters);
    bvh->numbers =
        glint_allocate_unset(bvh->cluster_count, GLINT_CLUSTER_LANES * sizeof *bvh->numbers);
    if (in->normals != NULL) {
        bvh->normals =
            glint_allocate_unset(bvh->cluster_count, GLINT_CLUSTER_NORMALS * sizeof *bvh->normals);
    }
    return bvh->nodes != NULL && bvh->clusters != NULL && bvh->numbers != NULL &&
           (in->normals == NULL || bvh->normals != NULL);
}

bool glint_collapse(const glint_bvh_inputs *in, const glint_binary_node *root,
                    const glint_wide_costs *costs, glint_bvh *bvh)
{
    bvh->width = in->width;
    bvh->node_count = root->children == NULL ? 1 : costs->nodes[1];
    bvh->cluster_count = root->cluster_count;
    collapse c = {in, bvh, glint_allocate_unset(bvh->node_count, sizeof *c.list)};
    if (c.list == NULL || !allocate_arrays(in, bvh)) {
        free(c.list);
        return false;
    }
    list_nodes(root, in->width, c.list, &bvh->report);
    glint_parallel_for_on(in->threads, (bvh->node_count + NODES_PER_TASK - 1) / NODES_PER_TASK,
                          write_some, &c);
    free(c.list);
    return true;
}
