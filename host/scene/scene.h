// The scene: triangles in world space, materials and cameras.
#ifndef GLINT_SCENE_SCENE_H
#define GLINT_SCENE_SCENE_H

#include "base/status.h"
#include "base/vector.h"
#include "scene/camera.h"
#include "scene/lights.h"
#include "scene/material.h"
#include "scene/parts.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// A node of the file, by its index.
typedef struct glint_node {
    char *name; // NULL where it has none; owned
    int parent; // its index; −1 of a root
} glint_node;

// Which attributes the vertices have beside position and normal. They stand in this order.
typedef struct glint_attributes {
    bool texcoords;        // 2 floats: u, v of set 0
    bool second_texcoords; // 2 floats: of set 1; only beside those of set 0
    bool colors;           // 4 floats: linear R, G, B, and A; 1 where a vertex has none
    bool tangents; // 4 floats: a unit vector in world space, and 1 or −1: the bitangent is
                   // that times normal × tangent; 0 where there is none
} glint_attributes;

static inline size_t glint_attributes_stride(const glint_attributes *set)
{
    const int floats = (set->texcoords ? 2 : 0) + (set->second_texcoords ? 2 : 0) +
                       (set->colors ? 4 : 0) + (set->tangents ? 4 : 0);
    return (size_t)floats;
}

// A primitive as it was instantiated by a node: a run of at least one triangle.
typedef struct glint_instance {
    const char *node; // the node's name, NULL where it has none; the scene's
    int node_index;
    size_t first_triangle, triangle_count;
    uint32_t material;
} glint_instance;

// What glint makes of something that a file uses.
typedef enum glint_treatment {
    GLINT_RENDERED,
    GLINT_APPROXIMATED,
    GLINT_IGNORED,
} glint_treatment;

const char *glint_treatment_name(glint_treatment treatment); // "rendered"

typedef struct glint_usage {
    char *name; // an extension, or a few words; owned
    glint_treatment treatment;
} glint_usage;

// Stored positions are relative: world = origin + unit × stored, with `origin` near the bounds'
// centre and `unit` a power of two such that stored coordinates lie within [−1, 1]; so neither a
// mesh at 1e6 nor one of 1e−6 metres loses anything, and a scene scaled by a power of two gives the
// same bits. Triangles keep the order of the file (scene, nodes depth first, primitives,
// triangles). Zero is valid: an empty scene with unit 0 is treated as unit 1.
typedef struct glint_scene {
    char *path;
    glint_vec3 origin;    // metres
    double unit;          // metres per stored unit, a power of two
    glint_vec3 low, high; // bounds, metres, world space; low > high when there is no triangle

    size_t triangle_count;
    float *positions; // [triangle_count][3 vertices][3], owned; counter-clockwise from outside,
                      // also where a node mirrors (the winding is swapped there, as glTF asks)
    float *normals;   // the same shape, unit, or NULL when no primitive has any; (0, 0, 0) where
                      // a vertex has none that is usable: the geometric normal serves there
    uint32_t *material_of; // [triangle_count], index into materials
    glint_parts parts;     // what positions leave out of small parts, see glint_scene_corner; owned

    // What vertices hold beside: per triangle three corners, each of glint_attributes_stride
    // floats. NULL where there is nothing.
    float *attributes; // owned
    glint_attributes attribute_set;
    glint_textures *textures; // that materials name; NULL: none. An owner of them

    size_t material_count;     // those that triangles use, in the order of the file; glTF's default
    glint_material *materials; // material stands last where a primitive names none

    size_t node_count;
    glint_node *nodes; // all of the file; NULL of a built-in scene, which has none

    size_t instance_count;
    glint_instance *instances; // in the order of their triangles

    size_t usage_count;
    glint_usage *usages; // what the file uses of glTF; owned; none of a built-in scene

    size_t variant_count;
    char **variants; // names of the file's variants of its materials, owned
    int variant;     // 1 + the chosen one's index; 0: none, which is the plain materials

    size_t camera_count;
    glint_camera *cameras; // in depth-first order of their nodes

    size_t light_count;
    glint_punctual_light *lights; // in depth-first order of their nodes; owned

    size_t skipped_points, skipped_lines; // primitives drawn by nodes that were left out, with a
                                          // warning
    size_t degenerate_triangles;          // zero area: kept out of `positions`

    bool moves; // the file's animation moves triangles: this is how they stand at one time
    glint_vec3 swept_low, swept_high; // bounds over the whole animation, where it does
} glint_scene;

// Whether an instance's material makes it a solid.
static inline bool glint_instance_is_solid(const glint_scene *scene, const glint_instance *instance)
{
    return glint_material_lobes(&scene->materials[instance->material]).solid;
}

// [triangle_count][3 vertices][3]: the corners from their parts' anchors, or, where there are no
// parts, as in `positions`.
static inline const float *glint_scene_told(const glint_scene *scene)
{
    return scene->parts.count > 0 ? scene->parts.positions : scene->positions;
}

// A corner's place in stored coordinates, to all digits that there are: those in `positions` are
// rounded to floats.
static inline glint_vec3 glint_scene_corner(const glint_scene *scene, size_t triangle, int corner)
{
    const glint_parts *parts = &scene->parts;
    const float *p = glint_scene_told(scene) + 9 * triangle + 3 * (size_t)corner;
    if (parts->count == 0) {
        return (glint_vec3){(double)p[0], (double)p[1], (double)p[2]};
    }
    const float *a = parts->anchors[parts->part_of[triangle]];
    return (glint_vec3){(double)a[0] + (double)p[0], (double)a[1] + (double)p[1],
                        (double)a[2] + (double)p[2]};
}

// Bytes of the arrays of so many triangles.
static inline size_t glint_scene_bytes(size_t triangles, bool with_normals,
                                       const glint_attributes *set)
{
    return triangles * (9 * sizeof(float) * (with_normals ? 2 : 1) +
                        3 * sizeof(float) * glint_attributes_stride(set) + sizeof(uint32_t));
}

typedef struct glint_scene_options {
    const char *scene;     // which glTF scene, by name or index; NULL: the file's default, else 0
    const char *animation; // which clip, by name or index; "all" at once, "none"; NULL: the first
    const char *variant;   // which variant of the materials, by name or index; NULL: none, which is
                           // the plain materials
    const struct glint_material_overrides *overrides; // of its materials, copied; NULL: none
    int texture_size; // textures are reduced to so many texels across at most; 0: they are not
} glint_scene_options;

// Loads .gltf or .glb as it is at the beginning of its animation. `options` and `warnings` may be
// NULL. Errors: GLINT_BAD_INPUT with "FILE: object[index]: cause (what to do)". On failure `scene`
// is left empty.
glint_status glint_scene_load(const char *path, const glint_scene_options *options,
                              glint_scene *scene, glint_warnings *warnings, glint_error *error);
void glint_scene_free(glint_scene *scene);

// ---- Over time ---------------------------------------------------------------------------------

// A file that stays open, to give its scene at any time of its animation. Opaque.
typedef struct glint_scene_source glint_scene_source;

// What the chosen clip does.
typedef struct glint_motion {
    bool moves_triangles, moves_cameras, moves_lights;
    double duration;  // seconds, to the last key; 0 without a clip
    const char *clip; // its name, the source's; NULL where it has none
} glint_motion;

// Whether the scene differs at other times by more than its cameras.
static inline bool glint_motion_moves_scene(const glint_motion *motion)
{
    return motion->moves_triangles || motion->moves_lights;
}

// `options` may be NULL. Errors: as glint_scene_load; *source is then NULL.
glint_status glint_scene_open(const char *path, const glint_scene_options *options,
                              glint_scene_source **source, glint_error *error);
const glint_motion *glint_scene_motion(const glint_scene_source *source);

// The scene at a time (seconds): what a file would hold whose nodes stood like this. Before the
// first key the first holds, after the last the last. On failure `scene` is left empty.
glint_status glint_scene_at(glint_scene_source *source, double time, glint_scene *scene,
                            glint_warnings *warnings, glint_error *error);

// Sets a scene's cameras alone to how they are at a time.
glint_status glint_scene_cameras_at(glint_scene_source *source, double time, glint_scene *scene,
                                    glint_error *error);

void glint_scene_close(glint_scene_source *source); // NULL is allowed

// ------------------------------------------------------------------------------------------------

// The bounds that cameras without a place of their own are put up for: of all that is there, over
// the whole animation.
void glint_scene_shown_bounds(const glint_scene *scene, glint_vec3 *low, glint_vec3 *high);

// Sets `positions` to what the parts say, rounded; where there are none nothing changes.
void glint_scene_round_positions(glint_scene *scene);

// Sets the bounds from the triangles.
void glint_scene_find_bounds(glint_scene *scene);

// The camera by name or by index ("0"); NULL: the first one, else one that frames the bounds. The
// names there are stand in the error. The camera's strings stay the scene's.
glint_status glint_scene_camera(const glint_scene *scene, const char *name, glint_camera *camera,
                                glint_error *error);

#ifdef __cplusplus
}
#endif

#endif
