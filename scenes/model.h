// A scene before it is written: geometries, materials, nodes and cameras, in fixed rooms.
#ifndef GLINT_SCENES_MODEL_H
#define GLINT_SCENES_MODEL_H

#include "base/status.h"
#include "mesh.h"
#include "rotation.h"

#include <stdbool.h>

// A square picture of 8 bits a channel, drawn texel by texel. Its file is SCENE_NAME.png.
typedef struct picture {
    const char *name;
    int size;     // texels along a side
    int channels; // 3, or 4 with alpha
    bool sharp;   // texels keep their edges when they are magnified
    // The values at a texel's centre as they are stored, 0 to 1: u to the right and v down, 0 to 1.
    void (*draw)(double u, double v, double *value);
} picture;

// A picture on a surface. Zero is none.
typedef struct texture {
    const picture *shown;
    double repeats[2]; // along u and v; 0: as the texture coordinates say
} texture;

// glTF 2.0's factors, linear Rec.709. Zero is valid: black matte metal-free paint of roughness 0.
typedef struct material {
    const char *name;
    double base_color[3];
    double metallic, roughness;
    double emission[3];
    double emissive_strength;    // KHR_materials_emissive_strength; written above 0
    double transmission;         // KHR_materials_transmission; written above 0
    double ior;                  // KHR_materials_ior; written above 0
    double thickness;            // KHR_materials_volume, metres; written above 0
    double attenuation_distance; // metres; 0: none
    double attenuation_color[3];
    bool unlit;
    bool blend;    // the lecture's blend: `mirror` is written
    double mirror; // its share of reflection
    texture base_color_map, metallic_roughness_map, normal_map, emission_map;
    const char *alpha_mode; // "MASK" or "BLEND"; NULL: opaque
    bool double_sided;
} material;

typedef struct node {
    const char *name;
    int geometry; // −1: none
    int material;
    int camera; // −1: none
    int light;  // −1: none
    double translation[3];
    double rotation[4];
    double scale; // 0 means 1
    int parent;   // a node; −1: none
} node;

// What deforms a geometry's vertices: one morph target, and joints. Zero is none. Freed with the
// model.
#define FLESH_JOINTS 4
typedef struct flesh {
    glint_vec3 *bulge, *normal_bulge; // [vertex_count]: what the target adds
    double (*weights)[FLESH_JOINTS];  // [vertex_count], with a sum of 1
    int joints[FLESH_JOINTS];         // nodes that neither turn nor scale at rest
    glint_vec3 rest[FLESH_JOINTS];    // where the joints stand then, in the geometry's space
} flesh;

// What a geometry's vertices have beside position and normal. Zero is none. Freed with the model.
typedef struct coat {
    double (*texcoords)[2]; // [vertex_count]
    double (*colors)[3];    // [vertex_count], linear
} coat;

typedef struct camera {
    const char *name;
    bool orthographic;
    double yfov; // degrees, perspective
    double ymag; // metres, orthographic: half the height
} camera;

// KHR_lights_punctual.
typedef struct light {
    const char *name, *type; // "point", "spot" or "directional"
    double color[3];
    double intensity;    // candela, of a directional light lux
    double range;        // metres; 0: none
    double inner, outer; // degrees, of a spot
} light;

#define MODEL_CAPACITY 64

// How one property of a node moves: a glTF channel with its sampler.
#define MOTION_KEYS 16
typedef struct motion {
    int node;
    const char *path;          // "translation", "rotation", "scale" or "weights" (of one target)
    const char *interpolation; // "LINEAR", "STEP" or "CUBICSPLINE"
    int key_count;
    double times[MOTION_KEYS]; // seconds, ascending
    double values[MOTION_KEYS][4];
    double tangents[MOTION_KEYS][4]; // CUBICSPLINE: of both sides of a key, per second
} motion;

// Zero is valid: an empty scene. Strings are borrowed. Adding past the capacity sets `overflow`,
// which model_check reports.
typedef struct model {
    const char *name; // also the files' name
    int geometry_count, material_count, node_count, camera_count, motion_count, picture_count;
    int light_count;
    struct {
        const char *name;
        mesh mesh;
        flesh flesh;
        coat coat;
    } geometries[MODEL_CAPACITY];
    material materials[MODEL_CAPACITY];
    node nodes[MODEL_CAPACITY];
    camera cameras[MODEL_CAPACITY];
    light lights[MODEL_CAPACITY];
    picture pictures[MODEL_CAPACITY];
    motion motions[MODEL_CAPACITY]; // one clip
    const char *clip;               // its name
    bool overflow;
} model;

void model_free(model *scene);

// A new empty mesh; its index is geometry_count − 1. The pointer stays valid.
mesh *model_add_geometry(model *scene, const char *name);
int model_add_material(model *scene, const material *m);

// The pointer stays valid.
const picture *model_add_picture(model *scene, const picture *p);

// An empty node under a parent (−1: none), moved to (x, y, z) from there.
node *model_add_joint(model *scene, const char *name, int parent, glint_vec3 position);

// A node that shows the newest geometry in a material, moved to (x, y, z).
node *model_add_object(model *scene, const char *name, int material_index, glint_vec3 position);

// Sets the node down at its x and z: the lowest vertex, after its rotation and scale, comes to
// `height` metres.
void model_rest(model *scene, node *object, double height);

// `yfov` in degrees; looks from `eye` to `target` with +Y up.
void model_add_perspective(model *scene, const char *name, double yfov, glint_vec3 eye,
                           glint_vec3 target);
void model_add_orthographic(model *scene, const char *name, double ymag, glint_vec3 eye,
                            glint_vec3 target);

// A light at `eye` that shines towards `target`.
node *model_add_light(model *scene, const light *l, glint_vec3 eye, glint_vec3 target);

// A motion of a node, without keys.
motion *model_add_motion(model *scene, const node *moved, const char *path,
                         const char *interpolation);
// How many numbers a value has: 4 of a rotation, 1 of weights, else 3.
int motion_components(const motion *m);

// A key; the tangent is 0.
void motion_add_key(motion *m, double seconds, const double *value);

material material_metal(const char *name, double r, double g, double b);
material material_paint(const char *name, double r, double g, double b, double roughness);
material material_glass(const char *name, double ior); // clear, solid
material material_thin(const char *name, double ior);  // clear, a thin wall

// The triangles that the scene shows: a geometry counts once for each node.
size_t model_count_triangles(const model *scene);

// GLINT_MISMATCH when a geometry is not what its scene needs: out of memory, past the capacity, or
// not closed and counter-clockwise from outside (sheets are let through).
glint_status model_check(const model *scene, glint_error *error);

#endif
