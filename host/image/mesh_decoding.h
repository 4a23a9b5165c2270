// Defines the request for a mesh that glint sends to its codec (codec_messages.h).
//
// The packed data alone knows how many vertices and corners a mesh has; the scene's accessors may
// say otherwise. So glint gives room in the memory file, behind this job and the packed bytes, and
// says which attributes it wants. The child writes the counts into the job. If the results fit into
// the room, it lays them out as glint_mesh_layout says; else it writes none. glint reads the counts
// and checks them in the same way: no count makes the file larger than glint made it.
#ifndef GLINT_IMAGE_MESH_DECODING_H
#define GLINT_IMAGE_MESH_DECODING_H

#include <stdint.h>

#define GLINT_MESH_ATTRIBUTES_MAX 32
// The most vertices and corners, so that the sizes of the results do not overflow. Draco counts
// points and faces in 32 bits.
#define GLINT_MESH_COUNT_MAX (UINT64_C(3) << 32)

typedef struct glint_mesh_attribute {
    uint32_t id;            // Draco's unique id
    int32_t component_type; // glTF's: 5120 to 5126
    int32_t components;     // components of a vertex, 1 to 4
} glint_mesh_attribute;

typedef struct glint_mesh_job {
    uint64_t packed_offset, packed_bytes;
    uint64_t result_offset, result_room; // the room for the results
    uint64_t vertex_count, index_count;  // the child sets them
    int32_t attribute_count;
    glint_mesh_attribute attributes[GLINT_MESH_ATTRIBUTES_MAX];
} glint_mesh_job;

// The places of the results, from result_offset on: 32-bit indices; then each attribute,
// [vertex_count][components], packed tightly. Each part begins at a multiple of 8 bytes.
typedef struct glint_mesh_places {
    uint64_t indices;
    uint64_t attributes[GLINT_MESH_ATTRIBUTES_MAX];
    uint64_t bytes; // of all results
} glint_mesh_places;

// Returns the bytes of a vertex in an attribute.
static inline uint64_t glint_mesh_vertex_bytes(const glint_mesh_attribute *attribute)
{
    const int32_t type = attribute->component_type;
    const uint64_t component = type == 5120 || type == 5121   ? 1
                               : type == 5122 || type == 5123 ? 2
                                                              : 4;
    return component * (uint64_t)attribute->components;
}

// Lays out the results. If a count exceeds GLINT_MESH_COUNT_MAX, `bytes` is UINT64_MAX.
static inline glint_mesh_places glint_mesh_layout(const glint_mesh_job *job)
{
    glint_mesh_places places = {0, {0}, UINT64_MAX};
    if (job->vertex_count > GLINT_MESH_COUNT_MAX || job->index_count > GLINT_MESH_COUNT_MAX) {
        return places;
    }
    places.bytes = (4 * job->index_count + 7) / 8 * 8;
    for (int32_t i = 0; i < job->attribute_count; i++) {
        places.attributes[i] = places.bytes;
        const uint64_t bytes = job->vertex_count * glint_mesh_vertex_bytes(&job->attributes[i]);
        places.bytes += (bytes + 7) / 8 * 8;
    }
    return places;
}

#endif
