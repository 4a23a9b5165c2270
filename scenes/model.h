// Holds a scene before it is written: geometries, materials, nodes and cameras, in fixed arrays.
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
    bool sharp;   // magnified without interpolation
    // Draws a texel: the stored values in [0, 1] at its centre (u, v). u runs to the right and v
    // down, in [0, 1].
    void (*draw)(double u, double v, double *value);
} picture;

// A picture on a surface. Zero: no picture.
typedef struct texture {
    const picture *shown;
    double repeats[2]; // repeats along u and v; 0: as the texture coordinates say
} texture;

// A material with glTF 2.0's factors, linear Rec.709. Zero is valid: black matte paint, no metal,
// roughness 0.
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
    bool blend;    // use the lecture's blend: `mirror` is written
    double mirror; // share of reflection
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
    double scale; // 0: 1
    int parent;   // a node; −1: none
} node;

// Deforms the vertices of a geometry by one morph target and by joints. Zero: no deformation. The
// model frees it.
#define FLESH_JOINTS 4
typedef struct flesh {
    glint_vec3 *bulge, *normal_bulge; // [vertex_count]: offsets of the morph target
    double (*weights)[FLESH_JOINTS];  // [vertex_count], each with sum 1
    int joints[FLESH_JOINTS];         // nodes without rotation and scale at rest
    glint_vec3 rest[FLESH_JOINTS];    // places of the joints at rest, in the geometry's space
} flesh;

// Optional attributes of a geometry's vertices. Zero: none. The model frees it.
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

// A light of KHR_lights_punctual.
typedef struct light {
    const char *name, *type; // "point", "spot" or "directional"
    double color[3];
    double intensity;    // candela; lux for a directional light
    double range;        // metres; 0: none
    double inner, outer; // degrees, for a spot
} light;

#define MODEL_CAPACITY 64

// The motion of one property of a node: a glTF channel with its sampler.
#define MOTION_KEYS 16
typedef struct motion {
    int node;
    const char *path;          // "translation", "rotation", "scale" or "weights" (of one target)
    const char *interpolation; // "LINEAR", "STEP" or "CUBICSPLINE"
    int key_count;
    double times[MOTION_KEYS]; // seconds, ascending
    double values[MOTION_KEYS][4];
    double tangents[MOTION_KEYS][4]; // CUBICSPLINE: the tangent on both sides of a key, per second
} motion;

// A scene. Zero is valid: empty. Strings are borrowed. Adding past the capacity sets `overflow`,
// and model_check reports it.
typedef struct model {
    const char *name; // also the name of the files
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
    motion motions[MODEL_CAPACITY]; // all in one clip
    const char *clip;               // the clip's name
    bool overflow;
} model;

void model_free(model *scene);

// Adds an empty mesh; its index is geometry_count − 1. The pointer stays valid.
mesh *model_add_geometry(model *scene, const char *name);
int model_add_material(model *scene, const material *m);

// Adds a copy of a picture. The pointer stays valid.
const picture *model_add_picture(model *scene, const picture *p);

// Adds an empty node at (x, y, z) from its parent (−1: none).
node *model_add_joint(model *scene, const char *name, int parent, glint_vec3 position);

// Adds a node at (x, y, z) that shows the newest geometry in a material.
node *model_add_object(model *scene, const char *name, int material_index, glint_vec3 position);

// Moves the node vertically: its lowest vertex, after rotation and scale, comes to `height` metres.
void model_rest(model *scene, node *object, double height);

// Adds a camera at `eye` that looks at `target` with +Y up. `yfov` is in degrees.
void model_add_perspective(model *scene, const char *name, double yfov, glint_vec3 eye,
                           glint_vec3 target);
void model_add_orthographic(model *scene, const char *name, double ymag, glint_vec3 eye,
                            glint_vec3 target);

// Adds a light at `eye` that shines towards `target`.
node *model_add_light(model *scene, const light *l, glint_vec3 eye, glint_vec3 target);

// Adds a motion of a node, without keys.
motion *model_add_motion(model *scene, const node *moved, const char *path,
                         const char *interpolation);
// Number of components of a value: 4 for a rotation, 1 for weights, otherwise 3.
int motion_components(const motion *m);

// Adds a key with tangent 0.
void motion_add_key(motion *m, double seconds, const double *value);

material material_metal(const char *name, double r, double g, double b);
material material_paint(const char *name, double r, double g, double b, double roughness);
material material_glass(const char *name, double ior); // clear, solid
material material_thin(const char *name, double ior);  // clear, a thin wall

// Counts the scene's visible triangles: a geometry counts once for each node.
size_t model_count_triangles(const model *scene);

// Checks the geometries. Errors: GLINT_MISMATCH if memory ran out, the capacity was exceeded, or a
// geometry is not closed and counter-clockwise from outside (sheets may be open).
glint_status model_check(const model *scene, glint_error *error);

#endif
