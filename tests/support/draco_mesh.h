// Packs meshes by Draco's own encoder, for tests.
#ifndef GLINT_TESTS_SUPPORT_DRACO_MESH_H
#define GLINT_TESTS_SUPPORT_DRACO_MESH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct draco_mesh {
    size_t vertices, triangles;
    const float *positions;  // [vertices][3], Draco's attribute 0
    const float *normals;    // [vertices][3], attribute 1
    const uint8_t *colors;   // [vertices][4], normalised, attribute 2
    const uint32_t *indices; // [triangles][3]
    bool edgebreaker;        // vertices and triangles may change their order
    int bits;                // bits of positions and normals; 0: lossless
} draco_mesh;

// Returns the packed bytes. The caller frees them.
unsigned char *draco_pack(const draco_mesh *mesh, size_t *size);

#ifdef __cplusplus
}
#endif

#endif
