// Describes a scene: triangles in world space, materials and cameras.
#ifndef GLINT_SCENE_SCENE_H
#define GLINT_SCENE_SCENE_H

#include "base/status.h"
#include "base/vector.h"
#include "scene/camera.h"
#include "scene/lights.h"
#include "scene/material/material.h"
#include "scene/shape/parts.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// A node of the file; its place in the array is its index.
typedef struct glint_node {
    char *name; // NULL: none; owned
    int parent; // index of the parent; −1 for a root
} glint_node;

// The vertices' attributes besides position and normal, stored in this order.
typedef struct glint_attributes {
    bool texcoords;        // 2 floats: u, v of set 0
    bool second_texcoords; // 2 floats: u, v of set 1; only together with set 0
    bool colors;           // 4 floats: linear R, G, B, and A; 1 for a vertex without colour
    // 4 floats: a unit vector in world space, and a sign, 1 or −1. The bitangent is the sign times
    // normal × tangent. The sign is 0 for a vertex without a tangent.
    bool tangents;
} glint_attributes;

static inline size_t glint_attributes_stride(const glint_attributes *set)
{
    const int floats = (set->texcoords ? 2 : 0) + (set->second_texcoords ? 2 : 0) +
                       (set->colors ? 4 : 0) + (set->tangents ? 4 : 0);
    return (size_t)floats;
}

// A primitive that a node instantiates: a run of at least one triangle.
typedef struct glint_instance {
    const char *node; // the node's name, owned by the scene; NULL: none
    int node_index;
    size_t first_triangle, triangle_count;
    uint32_t material;
} glint_instance;

// How glint treats a glTF feature that a file uses.
typedef enum glint_treatment {
    GLINT_RENDERED,
    GLINT_APPROXIMATED,
    GLINT_IGNORED,
} glint_treatment;

const char *glint_treatment_name(glint_treatment treatment); // such as "rendered"

typedef struct glint_usage {
    char *name; // an extension, or a description of a few words; owned
    glint_treatment treatment;
} glint_usage;

// A scene. Stored positions are relative: world = origin + unit × stored. `origin` is near the
// bounds' centre. `unit` is a power of two such that stored coordinates lie within [−1, 1]. So
// neither a mesh at 1e6 metres nor a mesh of 1e−6 metres loses precision. A scene scaled by a power
// of two gives the same bits. Triangles keep the order of the file (scene, nodes depth first,
// primitives, triangles). Zero is valid: an empty scene, whose unit 0 counts as 1.
typedef struct glint_scene {
    char *path;
    glint_vec3 origin;    // metres
    double unit;          // metres per stored unit, a power of two
    glint_vec3 low, high; // bounds, metres, world space; low > high if there is no triangle

    size_t triangle_count;
    // [triangle_count][3], the triangles' vertices; owned. They wind counter-clockwise seen from
    // outside. If a node mirrors, the winding is swapped, as glTF requires. A vertex belongs to
    // triangles of one instance, one part and one material, and to at least one. NULL: corner c of
    // triangle t is vertex 3 t + c.
    uint32_t *indices;
    size_t vertex_count; // with indices; see glint_scene_vertex_count
    float *positions;    // [vertex][3], owned
    // [vertex][3], unit, owned; NULL if no primitive has normals. (0, 0, 0) for a vertex without a
    // usable normal: the geometric normal serves there.
    float *normals;
    uint32_t *material_of; // [triangle_count], index into materials
    // The digits of small parts that `positions` cannot hold, see glint_scene_corner; owned.
    glint_parts parts;

    // The vertices' other attributes: [vertex][glint_attributes_stride]. NULL: none.
    float *attributes; // owned
    glint_attributes attribute_set;
    // Textures that the materials name; NULL: none. The scene is one of their owners.
    glint_textures *textures;

    // The materials that triangles use, in the order of the file. glTF's default material stands
    // last if a primitive names none.
    size_t material_count;
    glint_material *materials;

    size_t node_count;
    glint_node *nodes; // all nodes of the file; NULL for a built-in scene

    size_t instance_count;
    glint_instance *instances; // in the order of their triangles

    size_t usage_count;
    glint_usage *usages; // glTF features that the file uses; owned; none for a built-in scene

    size_t variant_count;
    char **variants; // names of the file's material variants, owned
    int variant;     // 1 + index of the chosen variant; 0: none, the plain materials

    size_t camera_count;
    glint_camera *cameras; // in depth-first order of their nodes

    size_t light_count;
    glint_punctual_light *lights; // in depth-first order of their nodes; owned

    // Primitives of points and of lines that nodes draw. glint leaves them out, with a warning.
    size_t skipped_points, skipped_lines;
    size_t degenerate_triangles; // triangles without area, not in `positions`

    bool moves; // the file's animation moves triangles: this scene is one moment of it
    glint_vec3 swept_low, swept_high; // if it moves: bounds over the whole animation
} glint_scene;

// True if the instance's material makes it a solid.
static inline bool glint_instance_is_solid(const glint_scene *scene, const glint_instance *instance)
{
    return glint_material_lobes(&scene->materials[instance->material]).solid;
}

static inline size_t glint_scene_vertex_count(const glint_scene *scene)
{
    return scene->indices != NULL ? scene->vertex_count : 3 * scene->triangle_count;
}

// Returns the vertex at corner 0, 1 or 2 of a triangle.
static inline size_t glint_scene_vertex(const glint_scene *scene, size_t triangle, size_t corner)
{
    return glint_triangle_vertex(scene->indices, triangle, corner);
}

// Returns a corner's position, 3 floats in stored coordinates.
static inline const float *glint_scene_position(const glint_scene *scene, size_t triangle,
                                                size_t corner)
{
    return scene->positions + 3 * glint_scene_vertex(scene, triangle, corner);
}

// Returns a corner's normal, 3 floats. Only for scenes with normals.
static inline const float *glint_scene_normal(const glint_scene *scene, size_t triangle,
                                              size_t corner)
{
    return scene->normals + 3 * glint_scene_vertex(scene, triangle, corner);
}

// Returns a corner's position relative to its part's anchor if there are parts, else its position.
static inline const float *glint_scene_told(const glint_scene *scene, size_t triangle,
                                            size_t corner)
{
    const float *told = scene->parts.count > 0 ? scene->parts.positions : scene->positions;
    return told + 3 * glint_scene_vertex(scene, triangle, corner);
}

// Returns a corner in stored coordinates, with all digits; `positions` are rounded to floats.
static inline glint_vec3 glint_scene_corner(const glint_scene *scene, size_t triangle,
                                            size_t corner)
{
    const glint_parts *parts = &scene->parts;
    const float *p = glint_scene_told(scene, triangle, corner);
    if (parts->count == 0) {
        return glint_vec3_from_floats(p);
    }
    return glint_vec3_add(glint_vec3_from_floats(parts->anchors[parts->part_of[triangle]]),
                          glint_vec3_from_floats(p));
}

// Returns the bytes of the arrays of triangles and vertices.
size_t glint_scene_bytes(const glint_scene *scene);

typedef struct glint_scene_options {
    const char *scene;     // the glTF scene, by name or index; NULL: the file's default, else 0
    const char *animation; // the clip, by name or index; "all" at once, "none"; NULL: the first
    const char *variant;   // the variant of the materials, by name or index; NULL: none
    const struct glint_material_overrides *overrides; // overrides of materials, copied; NULL: none
    int texture_size; // most texels across a texture, larger ones are reduced; 0: no limit
} glint_scene_options;

// Loads a .gltf or .glb file at the beginning of its animation. `options` and `warnings` may be
// NULL. Errors: GLINT_BAD_INPUT with "FILE: object[index]: cause (what to do)". On failure `scene`
// is empty.
glint_status glint_scene_load(const char *path, const glint_scene_options *options,
                              glint_scene *scene, glint_warnings *warnings, glint_error *error);
void glint_scene_free(glint_scene *scene);

// ---- Over time ---------------------------------------------------------------------------------

// An open file that gives its scene at any time of its animation. Opaque.
typedef struct glint_scene_source glint_scene_source;

// The motion of the chosen clip.
typedef struct glint_motion {
    bool moves_triangles, moves_cameras, moves_lights;
    double duration;  // seconds to the last key; 0 without a clip
    const char *clip; // the clip's name, owned by the source; NULL: none
} glint_motion;

// True if more than the cameras differ at other times.
static inline bool glint_motion_moves_scene(const glint_motion *motion)
{
    return motion->moves_triangles || motion->moves_lights;
}

// `options` may be NULL. Errors: as glint_scene_load; *source is then NULL.
glint_status glint_scene_open(const char *path, const glint_scene_options *options,
                              glint_scene_source **source, glint_error *error);
const glint_motion *glint_scene_motion(const glint_scene_source *source);

// Makes the scene at a time (seconds), as if the file's nodes stood as they do then. Before the
// first key the first key counts, after the last key the last. On failure `scene` is empty.
glint_status glint_scene_at(glint_scene_source *source, double time, glint_scene *scene,
                            glint_warnings *warnings, glint_error *error);

// Sets only the scene's cameras, for a time.
glint_status glint_scene_cameras_at(glint_scene_source *source, double time, glint_scene *scene,
                                    glint_error *error);

void glint_scene_close(glint_scene_source *source); // NULL is allowed

// ------------------------------------------------------------------------------------------------

// Sets the bounds for cameras without a position of their own: all that is visible over the whole
// animation.
void glint_scene_shown_bounds(const glint_scene *scene, glint_vec3 *low, glint_vec3 *high);

// Gives the vertices' arrays room for `vertices` vertices, or takes room away. The arrays need not
// stay aligned. Returns false if memory is short; the arrays are then valid, some with the old
// room.
bool glint_scene_resize_vertices(glint_scene *scene, size_t vertices);

// Sets the bounds from the triangles.
void glint_scene_find_bounds(glint_scene *scene);

// Finds the camera by name or by index ("0"). NULL: the first camera, or else one that frames the
// bounds. An error lists the names of the cameras. The scene owns the camera's strings.
glint_status glint_scene_camera(const glint_scene *scene, const char *name, glint_camera *camera,
                                glint_error *error);

#ifdef __cplusplus
}
#endif

#endif
