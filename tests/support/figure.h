// A figure of random triangles with morph targets and a skin: as a glTF text, and as a model that
// computes by the formulas of the glTF 2.0 specification (3.7.2.2, 3.7.3.3, appendix C), in double
// precision and without glint's code.
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

// Joints 0 and 3 stand under a rig that is no joint, 1 under 0, 2 under 1. Two of them turn.
extern const int figure_parents[FIGURE_JOINTS], figure_turning[2];

// Where the second copy of an instanced figure stands, from its node; from the origin with a skin.
extern const float figure_instance[3];

// How deltas of targets are stored.
typedef enum figure_deltas {
    FIGURE_FLOATS,
    FIGURE_BYTES,  // normalised (KHR_mesh_quantization)
    FIGURE_SHORTS, // positions as whole numbers (KHR_mesh_quantization), normals normalised
    FIGURE_SPARSE, // every third vertex moves; the others have no data
} figure_deltas;

// What a file is made of. Zero is a mesh that only its node places.
typedef struct figure_kind {
    int influences;  // of each vertex: 0 (no skin), 4 or 8
    int weight_type; // glTF's component type; 0: floats
    bool short_joints, no_inverse_bind;
    int targets; // 0 to FIGURE_TARGETS
    figure_deltas deltas;
    const char *weights_of;    // "mesh", "node"; NULL: neither
    const char *interpolation; // of animated weights; NULL: they are not animated
    bool turns;                // two joints turn over time
    bool mirrors;              // a joint mirrors
    bool flattens;             // all joints stand under a scale of (1, 1, 0)
    bool hides_mesh_node;      // by a scale of 0, which skins do not heed
    bool joints_outside;       // the scene shows the mesh's node alone
    bool instanced;            // a second copy stands at figure_instance
    uint64_t seed;
} figure_kind;

typedef struct figure_node {
    double translation[3], rotation[4], scale[3];
} figure_node;

// What the file holds, as its reader is to understand it.
typedef struct figure {
    figure_kind kind;
    float positions[FIGURE_VERTICES][3], normals[FIGURE_VERTICES][3];
    uint16_t indices[FIGURE_TRIANGLES][3];
    double deltas[FIGURE_TARGETS][2][FIGURE_VERTICES][3]; // of position and normal
    int joints[FIGURE_VERTICES][FIGURE_INFLUENCES];
    double weights[FIGURE_VERTICES][FIGURE_INFLUENCES];
    float inverse_bind[FIGURE_JOINTS][16]; // column by column
    figure_node mesh_node, rig, bones[FIGURE_JOINTS];
    double mesh_weights[FIGURE_TARGETS], node_weights[FIGURE_TARGETS];
    float times[FIGURE_KEYS];
    float morph_keys[FIGURE_KEYS][3][FIGURE_TARGETS]; // in-tangents, values, out-tangents
    float turn_keys[2][FIGURE_KEYS][4];
} figure;

// Random, by the kind's seed.
figure figure_make(const figure_kind *kind);

// Its glTF text; the caller frees it.
char *figure_text(const figure *f);

// A triangle's corners at a time, counter-clockwise from outside: positions and unit normals. Where
// most corners' matrices mirror, the winding is turned round.
typedef struct figure_triangle {
    double positions[3][3], normals[3][3];
} figure_triangle;
figure_triangle figure_triangle_at(const figure *f, double time, int triangle);

#endif
