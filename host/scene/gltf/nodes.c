// Chooses and places nodes. It uses an explicit stack, because a chain of nodes may be as deep as
// the file is long. The document has neither loops nor second parents. See nodes.h.
#include "scene/gltf/nodes.h"

#include "base/memory.h"
#include "scene/gltf/roots.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// ---- Places -------------------------------------------------------------------------------------

glint_mat4 glint_matrix_of_parts(const double translation[3], const double rotation[4],
                                 const double scale[3])
{
    const double length = sqrt(rotation[0] * rotation[0] + rotation[1] * rotation[1] +
                               rotation[2] * rotation[2] + rotation[3] * rotation[3]);
    const double x = rotation[0] / length, y = rotation[1] / length, z = rotation[2] / length,
                 w = rotation[3] / length;
    const double turn[3][3] = {
        {1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
        {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
        {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)},
    };
    glint_mat4 result = glint_mat4_identity;
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++) {
            result.m[row][column] = turn[row][column] * scale[column];
        }
        result.m[row][3] = translation[row];
    }
    return result;
}

// Replaces a property by that of its curve, if it moves.
static void follow(const glint_clips *clips, int node, glint_property property, double time,
                   double *value)
{
    const glint_curve *curve = glint_clips_curve(clips, node, property);
    if (curve != NULL) {
        glint_curve_sample(curve, time, value);
    }
}

static glint_mat4 local_matrix(const glint_document *document, const glint_clips *clips, int index,
                               double time)
{
    const glint_document_node *node = &document->nodes[index];
    if (node->has_matrix != 0) {
        glint_mat4 result = glint_mat4_identity;
        for (int i = 0; i < 16; i++) {
            // The decoder allowed rounding in the last row; the exact row avoids any projection.
            result.m[i % 4][i / 4] = i % 4 < 3 ? node->matrix[i] : result.m[i % 4][i / 4];
        }
        return result;
    }
    double translation[3], rotation[4], scale[3];
    memcpy(translation, node->translation, sizeof translation);
    memcpy(rotation, node->rotation, sizeof rotation);
    memcpy(scale, node->scale, sizeof scale);
    follow(clips, index, GLINT_PROPERTY_TRANSLATION, time, translation);
    follow(clips, index, GLINT_PROPERTY_ROTATION, time, rotation);
    follow(clips, index, GLINT_PROPERTY_SCALE, time, scale);
    return glint_matrix_of_parts(translation, rotation, scale);
}

glint_mat4 glint_visit_place(const glint_visits *visits, size_t visit, double time,
                             const glint_mat4 *placed)
{
    const glint_visit *at = &visits->all[visit];
    const glint_mat4 local = local_matrix(visits->document, visits->clips, at->node, time);
    const glint_mat4 *parent = at->parent < 0 ? &glint_mat4_identity : &placed[at->parent];
    return glint_mat4_multiply(parent, &local);
}

// ---- Visits -------------------------------------------------------------------------------------

typedef struct node_step {
    int32_t node;
    ptrdiff_t parent;
} node_step;

typedef struct node_walk {
    glint_visits *visits;
    node_step *stack; // room for all nodes
    size_t depth;
} node_walk;

// True if the node's place ever changes.
static bool ever_moves(const glint_clips *clips, int node)
{
    for (int property = 0; property < GLINT_PROPERTY_WEIGHTS; property++) {
        const glint_curve *curve = glint_clips_curve(clips, node, (glint_property)property);
        if (curve != NULL && glint_curve_moves(curve)) {
            return true;
        }
    }
    return false;
}

static void visit(node_walk *walk, node_step step, bool is_root_shown)
{
    const glint_document_node *node = &walk->visits->document->nodes[step.node];
    glint_visits *visits = walk->visits;
    const glint_visit *parent = step.parent < 0 ? NULL : &visits->all[step.parent];
    const bool is_below_shown = parent == NULL ? is_root_shown : parent->is_shown;
    visits->of[step.node] = (ptrdiff_t)visits->count;
    visits->all[visits->count] = (glint_visit){
        .node = step.node,
        .parent = step.parent,
        .is_shown = is_below_shown && node->is_hidden == 0,
        .moves = ever_moves(walk->visits->clips, step.node) || (parent != NULL && parent->moves),
    };
    for (uint32_t c = node->children.count; c-- > 0;) {
        const int32_t child = walk->visits->document->node_lists[node->children.first + c];
        if (visits->of[child] < 0) {
            walk->stack[walk->depth++] = (struct node_step){child, (ptrdiff_t)visits->count};
        }
    }
    visits->count++;
}

// Adds a root and all nodes below it to the visits, except nodes that are visited already.
static void visit_tree(node_walk *walk, int32_t root, bool is_shown)
{
    walk->depth = 0;
    walk->stack[walk->depth++] = (node_step){root, -1};
    while (walk->depth > 0) {
        const node_step next = walk->stack[--walk->depth];
        if (walk->visits->of[next.node] < 0) {
            visit(walk, next, is_shown);
        }
    }
}

// Visits joints in trees that the scene does not show. Visits each tree once, in linear time.
static glint_status visit_joints(node_walk *walk, glint_error *error)
{
    const glint_document *document = walk->visits->document;
    char *is_known = glint_allocate(document->skins_count, 1);
    if (is_known == NULL) {
        return glint_fail_memory(error, "the scene");
    }
    const size_t shown = walk->visits->count;
    for (size_t i = 0; i < shown; i++) {
        const glint_document_node *node = &document->nodes[walk->visits->all[i].node];
        if (!walk->visits->all[i].is_shown || node->mesh < 0 || node->skin < 0 ||
            is_known[node->skin] != 0) {
            continue;
        }
        is_known[node->skin] = 1;
        const glint_run joints = document->skins[node->skin].joints;
        for (uint32_t j = 0; j < joints.count; j++) {
            int32_t root = document->joints[joints.first + j];
            if (walk->visits->of[root] >= 0) {
                continue;
            }
            while (document->nodes[root].parent >= 0) {
                root = document->nodes[root].parent;
            }
            visit_tree(walk, root, false);
        }
    }
    free(is_known);
    return GLINT_OK;
}

glint_status glint_visits_choose(glint_visits *visits, const char *name, glint_tally *tally,
                                 glint_error *error)
{
    const size_t nodes = visits->document->nodes_count;
    node_walk walk = {visits, glint_allocate(nodes + 1, sizeof(node_step)), 0};
    glint_roots roots = {0};
    visits->all = glint_allocate(nodes, sizeof *visits->all);
    visits->of = glint_allocate(nodes, sizeof *visits->of);
    glint_status status = walk.stack != NULL && visits->all != NULL && visits->of != NULL
                              ? glint_roots_find(visits->document, name, &roots, tally, error)
                              : glint_fail_memory(error, "the scene");
    if (status == GLINT_OK) {
        for (size_t i = 0; i < nodes; i++) {
            visits->of[i] = -1;
        }
        for (size_t i = 0; i < roots.count; i++) {
            visit_tree(&walk, roots.nodes[i], true);
        }
        status = visit_joints(&walk, error);
    }
    free(walk.stack);
    free(roots.nodes);
    return status;
}

void glint_visits_free(glint_visits *visits)
{
    free(visits->all);
    free(visits->of);
    *visits = (glint_visits){0};
}
