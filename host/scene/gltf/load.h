// The loader's data, from an open document to the scene at one time.
#ifndef GLINT_SCENE_GLTF_LOAD_H
#define GLINT_SCENE_GLTF_LOAD_H

#include "scene/gltf/clips.h"
#include "scene/gltf/images.h"
#include "scene/gltf/nodes.h"
#include "scene/gltf/pose.h"
#include "scene/gltf/primitives.h"
#include "scene/gltf/tally.h"
#include "scene/material/material_override.h"
#include "scene/scene.h"

// A material of the file, or glTF's default material.
typedef struct glint_used_material {
    glint_material material; // without a name
    bool is_used;            // by primitives of chosen nodes
    bool is_replaced;        // by an override: the file's other values no longer count
    uint32_t lost;           // slots whose images cannot be read, a bit each
} glint_used_material;

// A primitive drawn at a node or at one of the node's instances.
typedef struct glint_draw {
    const glint_primitive *primitive;
    int node;
    glint_mat4 to_world; // from the coordinates of `shape`, if there is one
    glint_shape *shape;  // borrowed; NULL: the primitive as the file has it
} glint_draw;

// Zero is valid and empty, but for the tally.
typedef struct glint_load {
    char *path;   // as the user gave it; owned
    char *folder; // resolved: images that the file refers to must lie under it; owned
    glint_document document;
    int variant; // index of the chosen variant; −1: none
    glint_primitives primitives;
    glint_clips clips;
    glint_images images;
    glint_used_material *materials;     // [document.materials_count + 1]; the last is the default
    glint_material_overrides overrides; // resolved
    glint_mat4 *inverse_bind;           // [joint of any skin]: from the bound mesh to the joint
    glint_visits visits;
    glint_mat4 *placed; // [visit], at the time of the last walk
    glint_poses poses;  // of the draws
    glint_draw *draws;
    size_t draw_count, draw_capacity;
    size_t skipped_points, skipped_lines; // primitives that the walk did not draw
    bool hides_any; // some mesh is hidden, or has a scale of 0 at the walk's time
    // True if some shown triangles, cameras or lights move over time.
    bool moves_triangles, moves_cameras, moves_lights;
    glint_tally tally;
} glint_load;

static inline const glint_document_node *glint_load_node(const glint_load *load, size_t visit)
{
    return &load->document.nodes[load->visits.all[visit].node];
}

// The primitives of a visited node's mesh; none if it has no mesh.
static inline glint_run glint_load_primitives(const glint_load *load, size_t visit)
{
    static const glint_run none;
    const int32_t mesh = glint_load_node(load, visit)->mesh;
    return mesh < 0 ? none : load->document.meshes[mesh].primitives;
}

static inline const char *glint_load_text(const glint_load *load, glint_text text)
{
    return glint_document_text(&load->document, text);
}

#endif
