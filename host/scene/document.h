// The contents of a glTF file, as glint-decoder (host/decoder/) gives them to glint: one block of
// memory that holds tables of fixed rows. Rows refer to other rows by their index, and to bytes by
// their offset in the block, so that the block has no address of its own.
//
// Angles are radians, lengths metres, times seconds. An index of −1 refers to nothing. The decoder
// has checked what the file says, and worded what is left out. But it may misbehave in any way:
// glint_document_open checks every index and offset before anything reads them.
#ifndef GLINT_SCENE_DOCUMENT_H
#define GLINT_SCENE_DOCUMENT_H

#include "base/status.h"
#include "scene/material/material.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef uint32_t glint_text; // offset in the table of texts; 0: the empty text

// Some rows of a table, one after the other.
typedef struct glint_run {
    uint32_t first, count;
} glint_run;

// glTF's codes of component types.
typedef enum glint_component_type {
    GLINT_COMPONENT_INT8 = 5120,
    GLINT_COMPONENT_UINT8 = 5121,
    GLINT_COMPONENT_INT16 = 5122,
    GLINT_COMPONENT_UINT16 = 5123,
    GLINT_COMPONENT_UINT32 = 5125,
    GLINT_COMPONENT_FLOAT = 5126,
} glint_component_type;

// Returns the bytes of a component; 0 for what is no code.
static inline uint32_t glint_component_bytes(int32_t type)
{
    switch (type) {
    case GLINT_COMPONENT_INT8:
    case GLINT_COMPONENT_UINT8:
        return 1;
    case GLINT_COMPONENT_INT16:
    case GLINT_COMPONENT_UINT16:
        return 2;
    case GLINT_COMPONENT_UINT32:
    case GLINT_COMPONENT_FLOAT:
        return 4;
    default:
        return 0;
    }
}

// A warning, given if what holds it is shown. `where` is empty if that thing itself is meant.
typedef struct glint_document_note {
    glint_text where, text;
} glint_document_note;

// The most elements of an array that has no bytes of its own: it is all zeros, for any count.
#define GLINT_ZEROS_MAX (UINT64_C(1) << 24)

// An accessor. Its elements lie in the block, `stride` bytes apart. Sparse elements, packed
// tightly, stand in for some of them.
typedef struct glint_document_array {
    uint64_t offset;                          // 0: all elements are zeros
    uint64_t count;                           // elements
    uint64_t sparse_indices, sparse_elements; // offsets
    uint32_t sparse_count;
    int32_t sparse_type; // of the indices: unsigned integers that ascend, each below `count`
    uint32_t stride;
    int32_t type;       // a glint_component_type
    int32_t components; // of an element
    int32_t is_normalized;
    int32_t accessor; // its index in the file
} glint_document_array;

typedef struct glint_document_node {
    glint_text name;
    int32_t parent;
    glint_run children; // of node_lists
    int32_t mesh, camera, skin, light;
    int32_t has_matrix; // then it has no translation, rotation and scale
    int32_t is_hidden;  // with all below
    double matrix[16];  // columns
    double translation[3], rotation[4], scale[3];
    glint_run weights;    // none: its mesh's
    int32_t instances[3]; // arrays of translations, rotations, scales
    glint_run notes;
} glint_document_node;

typedef struct glint_document_mesh {
    glint_run primitives;
    glint_run weights;
    uint32_t target_count; // of the primitive with the most
} glint_document_mesh;

// Arrays of a value per vertex. A primitive of points or lines has none.
typedef struct glint_document_primitive {
    int32_t mode, material; // glTF's mode, from 0 (points) to 6 (a fan)
    int32_t positions, normals, indices, tangents, colors, texcoords[2];
    glint_run targets, influences;
    glint_run mappings;       // materials of variants
    glint_text mapping_fault; // why some of them could not be read
    glint_run notes;
} glint_document_primitive;

typedef struct glint_document_target {
    int32_t positions, normals; // deltas at weight 1
} glint_document_target;

// Four joints and weights per vertex.
typedef struct glint_document_influence {
    int32_t joints, weights;
} glint_document_influence;

typedef struct glint_document_mapping {
    int32_t variant, material;
} glint_document_mapping;

// `material` has no name, and `index` is not set. The image of a texture is 1 + its index.
typedef struct glint_document_material {
    glint_text name;
    int32_t has_thickness_texture;
    glint_text texture_keys[GLINT_TEXTURE_SLOTS]; // the textures' members in the file
    glint_run missing, notes;
    glint_material material;
} glint_document_material;

// A texture that cannot be shown.
typedef struct glint_document_missing {
    int32_t slot;   // a glint_texture_slot
    glint_text key; // its member in the file
    glint_text where, text;
} glint_document_missing;

// An image that materials name. It has a URI, or bytes in the block, or a fault.
typedef struct glint_document_image {
    glint_text shown; // its name in messages
    glint_text uri, fault;
    uint64_t offset, bytes;
} glint_document_image;

typedef struct glint_document_camera {
    glint_text name;
    int32_t is_orthographic;
    double size; // yfov, or ymag
    glint_run notes;
} glint_document_camera;

typedef struct glint_document_light {
    glint_text name;
    int32_t kind;    // a glint_punctual_kind; −1: it cannot be shown
    double color[3]; // times its intensity
    double range;    // 0: unlimited
    double inner_angle, outer_angle;
    glint_run notes;
} glint_document_light;

typedef struct glint_document_skin {
    glint_run joints;     // nodes; at least one
    int32_t inverse_bind; // an array of at least as many matrices
} glint_document_skin;

typedef struct glint_document_animation {
    glint_text name;
    glint_run channels, notes;
} glint_document_animation;

typedef enum glint_property {
    GLINT_PROPERTY_TRANSLATION,
    GLINT_PROPERTY_ROTATION,
    GLINT_PROPERTY_SCALE,
    GLINT_PROPERTY_WEIGHTS,
    GLINT_PROPERTIES
} glint_property;

// `output` has a value per key of `input`, or three (in-tangent, value, out-tangent) if cubic. For
// weights, a value is a number per morph target of the node's mesh, one element each.
typedef struct glint_document_channel {
    int32_t node, property, interpolation; // a glint_property, a glint_interpolation
    int32_t input, output;                 // arrays
    int32_t sampler;                       // its index in the file
} glint_document_channel;

typedef struct glint_document_variant {
    glint_text name;
} glint_document_variant;

typedef struct glint_document_scene {
    glint_text name;
    glint_run roots; // of node_lists, as listed
    glint_run notes;
} glint_document_scene;

// An extension that the file uses.
typedef struct glint_document_usage {
    glint_text name;
    int32_t treatment; // a glint_treatment
} glint_document_usage;

// The tables: TABLE(name, type of a row).
#define GLINT_DOCUMENT_TABLES(TABLE)                                                               \
    TABLE(texts, char)                                                                             \
    TABLE(node_lists, int32_t)                                                                     \
    TABLE(joints, int32_t)                                                                         \
    TABLE(weights, double)                                                                         \
    TABLE(notes, glint_document_note)                                                              \
    TABLE(arrays, glint_document_array)                                                            \
    TABLE(nodes, glint_document_node)                                                              \
    TABLE(meshes, glint_document_mesh)                                                             \
    TABLE(primitives, glint_document_primitive)                                                    \
    TABLE(targets, glint_document_target)                                                          \
    TABLE(influences, glint_document_influence)                                                    \
    TABLE(mappings, glint_document_mapping)                                                        \
    TABLE(materials, glint_document_material)                                                      \
    TABLE(missing, glint_document_missing)                                                         \
    TABLE(images, glint_document_image)                                                            \
    TABLE(cameras, glint_document_camera)                                                          \
    TABLE(lights, glint_document_light)                                                            \
    TABLE(skins, glint_document_skin)                                                              \
    TABLE(animations, glint_document_animation)                                                    \
    TABLE(channels, glint_document_channel)                                                        \
    TABLE(variants, glint_document_variant)                                                        \
    TABLE(scenes, glint_document_scene)                                                            \
    TABLE(usages, glint_document_usage)

typedef enum glint_document_table {
#define TABLE(name, type) GLINT_TABLE_##name,
    GLINT_DOCUMENT_TABLES(TABLE)
#undef TABLE
        GLINT_TABLES
} glint_document_table;

// The header is at the beginning of the block.
#define GLINT_DOCUMENT_MAGIC UINT64_C(0x31636f64746e6c67)

typedef struct glint_document_place {
    uint64_t offset, count; // of a table: bytes from the block's beginning, and rows
} glint_document_place;

// What the decoder works on, for a message if it dies.
typedef struct glint_document_doing {
    char name[128];   // of a part, such as bufferViews[3]; empty: the whole file
    uint32_t seconds; // of CPU time that it may take
} glint_document_doing;

typedef struct glint_document_header {
    uint64_t magic;
    glint_document_doing doing;
    int32_t default_scene; // −1: the file names none
    int32_t unused;
    glint_document_place tables[GLINT_TABLES];
} glint_document_header;

// An open document. Zero is valid: nothing is open.
typedef struct glint_document {
    const unsigned char *block; // mapped; owned
    size_t bytes;
    int default_scene; // −1: the file names none
#define TABLE(name, type)                                                                          \
    const type *name;                                                                              \
    size_t name##_count;
    GLINT_DOCUMENT_TABLES(TABLE)
#undef TABLE
} glint_document;

// Maps the block in the file, which the caller keeps, and checks it. Nobody else may still be able
// to change the file. Errors: GLINT_BAD_INPUT, GLINT_OUT_OF_MEMORY; the document is then empty.
glint_status glint_document_open(int file, glint_document *document, glint_error *error);

void glint_document_close(glint_document *document);

static inline const char *glint_document_text(const glint_document *document, glint_text text)
{
    return document->texts + text;
}

#ifdef __cplusplus
}
#endif

#endif
