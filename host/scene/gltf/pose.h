// Poses: the shapes of nodes' meshes at one time, by morph weights and joints.
#ifndef GLINT_SCENE_GLTF_POSE_H
#define GLINT_SCENE_GLTF_POSE_H

#include "scene/gltf/nodes.h"
#include "scene/gltf/primitives.h"
#include "scene/gltf/shape.h"

// A skin's joints at one time.
typedef struct glint_skin_pose {
    glint_bones bones; // none if no visited node uses the skin
    bool are_hidden;   // all joints have a scale of 0
} glint_skin_pose;

// The shapes of a mesh that nodes deform alike.
typedef struct glint_shape_set {
    glint_shape *shapes; // of the mesh's primitives; owned; NULL: not made
    size_t count;        // 0: nothing can deform them
} glint_shape_set;

// The loader's data from which poses are made; borrowed.
typedef struct glint_pose_source {
    const glint_visits *visits; // of the document and its clips
    const glint_primitives *primitives;
    const glint_mat4 *inverse_bind; // [joint of any skin]
} glint_pose_source;

// The shapes of all nodes at one time. Nodes that deform a mesh alike share its shapes. Zero is
// valid and empty.
typedef struct glint_poses {
    glint_pose_source source;
    double time;
    glint_mat4 *joints;     // [joint of any skin], from the bound mesh to the world; owned
    glint_skin_pose *skins; // [skin]; owned
    int32_t *set_of;        // [node with a mesh]: its set; owned
    glint_shape_set *sets;  // [set_count], in an order that depends on the file alone; owned
    size_t set_count;
} glint_poses;

// The place of a drawn primitive. A scale of 0 hides it.
typedef struct glint_stand {
    glint_mat4 to_world;
    bool is_hidden;
} glint_stand;

// Fails with GLINT_OUT_OF_MEMORY.
glint_status glint_poses_init(glint_poses *poses, const glint_pose_source *source,
                              glint_error *error);

// Starts a new time; `placed` holds the matrices of the visits. Drops all shapes.
void glint_poses_begin(glint_poses *poses, double time, const glint_mat4 *placed);

// Drops all shapes.
void glint_poses_clear(glint_poses *poses);

// Sets the shapes of the primitives of a node's mesh, borrowed; NULL without targets and skin. They
// last until the time ends. Fails with GLINT_OUT_OF_MEMORY.
glint_status glint_poses_shapes(glint_poses *poses, int node, glint_shape **shapes,
                                glint_error *error);

// Returns all shapes that deform and have triangles, malloc'd; NULL if memory is short.
glint_shape **glint_poses_deforming(const glint_poses *poses, size_t *count);

// Returns the place of a primitive with this shape (NULL: the file's own) at a node with this skin.
// Only joints place a skinned primitive, and only all of them together can hide it.
glint_stand glint_poses_stand(const glint_poses *poses, const glint_shape *shape, int skin,
                              const glint_mat4 *node_to_world);

void glint_poses_free(glint_poses *poses);

// Reads the matrices of all skins' joints, [joints_count]. Errors:
// GLINT_BAD_INPUT for matrices that are not finite, or whose last row is not 0 0 0 1;
// GLINT_OUT_OF_MEMORY.
glint_status glint_skins_read(const glint_document *document, glint_mat4 **inverse_bind,
                              glint_error *error);

#endif
