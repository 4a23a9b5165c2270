// Makes a figure of random triangles with morph targets and a skin, as a glTF text and as a model.
// The model follows the formulas of the glTF 2.0 specification (3.7.2.2, 3.7.3.3, appendix C) in
// double precision, without glint's code.
#ifndef GLINT_TESTS_SUPPORT_FIGURE_H
#define GLINT_TESTS_SUPPORT_FIGURE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    FIGURE_VERTICES = 14,
    FIGURE_TRIANGLES = 16,
    FIGURE_TARGETS = 3,
    FIGURE_JOINTS = 4,
    FIGURE_INFLUENCES = 8,
    FIGURE_KEYS = 3,
};

// Hierarchy of joints: 0 and 3 are children of a rig that is no joint, 1 of joint 0, 2 of joint 1.
// Two joints turn.
extern const int figure_parents[FIGURE_JOINTS], figure_turning[2];

// Place of the second copy of an instanced figure, from its node; with a skin, from the origin.
extern const float figure_instance[3];

// Storage of morph target deltas.
typedef enum figure_deltas {
    FIGURE_FLOATS,
    FIGURE_BYTES,  // normalised (KHR_mesh_quantization)
    FIGURE_SHORTS, // positions as whole numbers (KHR_mesh_quantization), normals normalised
    FIGURE_SPARSE, // every third vertex moves; the others have no data
} figure_deltas;

// Kind of a figure. Zero: a mesh without skin and targets, placed by its node.
typedef struct figure_kind {
    int influences;  // influences of each vertex: 0 (no skin), 4 or 8
    int weight_type; // component type in glTF; 0: floats
    bool short_joints, no_inverse_bind;
    int targets; // 0 to FIGURE_TARGETS
    figure_deltas deltas;
    const char *weights_of;    // owner of the weights: "mesh", "node"; NULL: none
    const char *interpolation; // interpolation of animated weights; NULL: not animated
    bool turns;                // two joints turn over time
    bool mirrors;              // a joint mirrors
    bool flattens;             // all joints stand under a scale of (1, 1, 0)
    bool hides_mesh_node;      // the mesh's node has scale 0, which skins ignore
    bool joints_outside;       // the scene shows only the node of the mesh
    bool instanced;            // a second copy stands at figure_instance
    uint64_t seed;
} figure_kind;

typedef struct figure_node {
    double translation[3], rotation[4], scale[3];
} figure_node;

// A figure: the data of the file in its intended meaning.
typedef struct figure {
    figure_kind kind;
    float positions[FIGURE_VERTICES][3], normals[FIGURE_VERTICES][3];
    uint16_t indices[FIGURE_TRIANGLES][3];
    double deltas[FIGURE_TARGETS][2][FIGURE_VERTICES][3]; // deltas of position and normal
    int joints[FIGURE_VERTICES][FIGURE_INFLUENCES];
    double weights[FIGURE_VERTICES][FIGURE_INFLUENCES];
    float inverse_bind[FIGURE_JOINTS][16]; // column by column
    figure_node mesh_node, rig, bones[FIGURE_JOINTS];
    double mesh_weights[FIGURE_TARGETS], node_weights[FIGURE_TARGETS];
    float times[FIGURE_KEYS];
    float morph_keys[FIGURE_KEYS][3][FIGURE_TARGETS]; // in-tangents, values, out-tangents
    float turn_keys[2][FIGURE_KEYS][4];
} figure;

// Makes a random figure from the kind's seed.
figure figure_make(const figure_kind *kind);

// Returns the glTF text of the figure; the caller frees it.
char *figure_text(const figure *f);

// The corners of a triangle at a time: positions and unit normals, counter-clockwise from outside.
// If most corners have a mirroring matrix, the winding is reversed.
typedef struct figure_triangle {
    double positions[3][3], normals[3][3];
} figure_triangle;
figure_triangle figure_triangle_at(const figure *f, double time, int triangle);

#endif
