// Computes poses. See pose.h.
#include "scene/gltf/pose.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

static bool is_hiding(const glint_mat4 *matrix)
{
    for (int row = 0; row < 3; row++) {
        const double *m = matrix->m[row];
        if (m[0] != 0 || m[1] != 0 || m[2] != 0) {
            return false;
        }
    }
    return true;
}

// ---- Sets ---------------------------------------------------------------------------------------

// What decides how a node deforms its mesh.
typedef struct key {
    int32_t mesh, weights_node, skin; // −1: the mesh's weights; no skin
    int32_t node;
} key;

static int compare_keys(const void *a, const void *b)
{
    return memcmp(a, b, offsetof(key, node)); // any order will do that depends on the file alone
}

static void number_sets(glint_poses *poses, key *keys, size_t count)
{
    qsort(keys, count, sizeof *keys, compare_keys);
    for (size_t i = 0; i < count; i++) {
        if (i == 0 || compare_keys(&keys[i - 1], &keys[i]) != 0) {
            poses->set_count++;
        }
        poses->set_of[keys[i].node] = (int32_t)poses->set_count - 1;
    }
}

glint_status glint_poses_init(glint_poses *poses, const glint_pose_source *source,
                              glint_error *error)
{
    const glint_document *document = source->visits->document;
    *poses = (glint_poses){.source = *source};
    key *keys = glint_allocate(document->nodes_count, sizeof *keys);
    poses->set_of = glint_allocate(document->nodes_count, sizeof *poses->set_of);
    poses->joints = glint_allocate(document->joints_count, sizeof *poses->joints);
    poses->skins = glint_allocate(document->skins_count, sizeof *poses->skins);
    if (keys == NULL || poses->set_of == NULL || poses->joints == NULL || poses->skins == NULL) {
        free(keys);
        return glint_fail_memory(error, "the scene");
    }
    size_t count = 0;
    for (size_t i = 0; i < document->nodes_count; i++) {
        const glint_document_node *node = &document->nodes[i];
        const bool has_weights =
            node->weights.count > 0 ||
            glint_clips_curve(source->visits->clips, (int)i, GLINT_PROPERTY_WEIGHTS) != NULL;
        if (node->mesh >= 0) {
            keys[count++] =
                (key){node->mesh, has_weights ? (int32_t)i : -1, node->skin, (int32_t)i};
        }
    }
    number_sets(poses, keys, count);
    free(keys);
    poses->sets = glint_allocate(poses->set_count, sizeof *poses->sets);
    return poses->sets != NULL ? GLINT_OK : glint_fail_memory(error, "the scene");
}

void glint_poses_clear(glint_poses *poses)
{
    for (size_t i = 0; i < poses->set_count; i++) {
        glint_shape_set *set = &poses->sets[i];
        for (size_t k = 0; k < set->count; k++) {
            glint_shape_free(&set->shapes[k]);
        }
        free(set->shapes);
        *set = (glint_shape_set){0};
    }
}

void glint_poses_free(glint_poses *poses)
{
    if (poses->sets != NULL) {
        glint_poses_clear(poses);
    }
    free(poses->joints);
    free(poses->skins);
    free(poses->set_of);
    free(poses->sets);
    *poses = (glint_poses){0};
}

// ---- A time -------------------------------------------------------------------------------------

// All joints of a skin in use are visited; joints of other skins may not be.
static glint_skin_pose place_skin(glint_poses *poses, size_t index, const glint_mat4 *placed)
{
    const glint_document *document = poses->source.visits->document;
    const glint_run joints = document->skins[index].joints;
    glint_mat4 *matrices = poses->joints + joints.first;
    bool are_hidden = true;
    for (uint32_t j = 0; j < joints.count; j++) {
        const ptrdiff_t visit = poses->source.visits->of[document->joints[joints.first + j]];
        if (visit < 0) {
            return (glint_skin_pose){0};
        }
        matrices[j] =
            glint_mat4_multiply(&placed[visit], &poses->source.inverse_bind[joints.first + j]);
        are_hidden = are_hidden && is_hiding(&placed[visit]);
    }
    return (glint_skin_pose){{matrices, joints.count}, are_hidden};
}

void glint_poses_begin(glint_poses *poses, double time, const glint_mat4 *placed)
{
    glint_poses_clear(poses);
    poses->time = time;
    for (size_t i = 0; i < poses->source.visits->document->skins_count; i++) {
        poses->skins[i] = place_skin(poses, i, placed);
    }
}

glint_stand glint_poses_stand(const glint_poses *poses, const glint_shape *shape, int skin,
                              const glint_mat4 *node_to_world)
{
    if (shape != NULL && shape->bones != NULL) {
        return (glint_stand){glint_mat4_identity, poses->skins[skin].are_hidden};
    }
    return (glint_stand){*node_to_world, is_hiding(node_to_world)};
}

// The weights of a node's morph targets: from its curve, else the node, else its mesh. `values` has
// room for the curve's components.
static const double *weights_of(const glint_poses *poses, int node, double *values, size_t *count)
{
    const glint_document *document = poses->source.visits->document;
    const glint_curve *curve =
        glint_clips_curve(poses->source.visits->clips, node, GLINT_PROPERTY_WEIGHTS);
    if (curve != NULL) {
        glint_curve_sample(curve, poses->time, values);
        *count = curve->components;
        return values;
    }
    const glint_document_node *own = &document->nodes[node];
    const glint_run weights =
        own->weights.count > 0 ? own->weights : document->meshes[own->mesh].weights;
    *count = weights.count;
    return document->weights + weights.first;
}

static glint_status make_shapes(const glint_poses *poses, int node, glint_shape_set *set,
                                glint_error *error)
{
    const glint_document *document = poses->source.visits->document;
    const glint_document_node *own = &document->nodes[node];
    const glint_document_mesh *mesh = &document->meshes[own->mesh];
    const bool can_deform = own->skin >= 0 || mesh->target_count > 0;
    const size_t count = can_deform ? mesh->primitives.count : 0;
    double *values = glint_allocate(mesh->target_count, sizeof *values);
    set->shapes = glint_allocate(count, sizeof *set->shapes);
    bool is_whole = values != NULL && set->shapes != NULL;
    size_t weight_count = 0;
    const double *weights = is_whole ? weights_of(poses, node, values, &weight_count) : NULL;
    const glint_bones *bones = own->skin < 0 ? NULL : &poses->skins[own->skin].bones;
    for (size_t i = 0; is_whole && i < count; i++) {
        set->count++;
        is_whole = glint_shape_init(&set->shapes[i],
                                    &poses->source.primitives->all[mesh->primitives.first + i],
                                    weights, weight_count, bones);
    }
    free(values);
    return is_whole ? GLINT_OK : glint_fail_memory(error, "the scene");
}

glint_status glint_poses_shapes(glint_poses *poses, int node, glint_shape **shapes,
                                glint_error *error)
{
    glint_shape_set *set = &poses->sets[poses->set_of[node]];
    if (set->shapes == NULL) {
        TRY(make_shapes(poses, node, set, error));
    }
    *shapes = set->count == 0 ? NULL : set->shapes;
    return GLINT_OK;
}

glint_shape **glint_poses_deforming(const glint_poses *poses, size_t *count)
{
    size_t most = 0;
    for (size_t i = 0; i < poses->set_count; i++) {
        most += poses->sets[i].count;
    }
    glint_shape **found = glint_allocate(most, sizeof(glint_shape *));
    *count = 0;
    for (size_t i = 0; found != NULL && i < poses->set_count; i++) {
        for (size_t k = 0; k < poses->sets[i].count; k++) {
            glint_shape *shape = &poses->sets[i].shapes[k];
            if (glint_shape_deforms(shape) && shape->primitive->triangles > 0) {
                found[(*count)++] = shape;
            }
        }
    }
    return found;
}
