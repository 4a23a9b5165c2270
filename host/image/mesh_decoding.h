// Defines the request for a mesh that glint sends to its codec (codec_messages.h).
//
// glint knows from the scene's accessors what a mesh must hold. It lays out the memory file: this
// job, the packed bytes, then room for the results. The child fills the room and answers with
// value_bytes, the bytes of the indices that it wrote.
#ifndef GLINT_IMAGE_MESH_DECODING_H
#define GLINT_IMAGE_MESH_DECODING_H

#include <stdint.h>

#define GLINT_MESH_ATTRIBUTES_MAX 32

typedef struct glint_mesh_attribute {
    uint32_t id;            // Draco's unique id
    int32_t component_type; // glTF's: 5120 to 5126
    int32_t components;     // components of a vertex, 1 to 4
    uint64_t offset;        // place of [vertex_count][components], packed tightly
} glint_mesh_attribute;

typedef struct glint_mesh_job {
    uint64_t packed_offset, packed_bytes;
    uint64_t vertex_count;
    uint64_t index_offset; // place of [index_room] 32-bit indices
    uint64_t index_room;
    int32_t is_exact; // there must be exactly index_room indices, not fewer
    int32_t attribute_count;
    glint_mesh_attribute attributes[GLINT_MESH_ATTRIBUTES_MAX];
} glint_mesh_job;

#endif
