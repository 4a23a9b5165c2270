// Shows a textured plane at a slant: a file that tests fill in, its images, and the closed-form
// points where the rays of pixels meet the plane.
#ifndef GLINT_TESTS_SUPPORT_TEXTURED_PLANE_H
#define GLINT_TESTS_SUPPORT_TEXTURED_PLANE_H

#include "render/settings.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stdint.h>

// Two triangles in the plane y = 0 from (−4, 0, 2) to (4, 0, −14). u runs along +x, v along +z.
// Texture coordinates are 0 to 2 in set 0; set 1 is half as large and reversed.
typedef struct textured_plane {
    float positions[4][3], normals[4][3], first[4][2], second[4][2], tangents[4][4], colors[4][4];
    uint16_t indices[6];
} textured_plane;

extern const textured_plane the_plane;

// Accessors: 0 positions, 1 normals, 2 and 3 texture coordinates, 4 tangents, 5 colours, 6 indices.
// Node 0 has mesh 0, node 1 the camera.
#define PLANE_YFOV 0.8
#define PLANE                                                                                      \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},"                                           \
    "{\"buffer\":0,\"byteOffset\":48,\"byteLength\":48},"                                          \
    "{\"buffer\":0,\"byteOffset\":96,\"byteLength\":32},"                                          \
    "{\"buffer\":0,\"byteOffset\":128,\"byteLength\":32},"                                         \
    "{\"buffer\":0,\"byteOffset\":160,\"byteLength\":64},"                                         \
    "{\"buffer\":0,\"byteOffset\":224,\"byteLength\":64},"                                         \
    "{\"buffer\":0,\"byteOffset\":288,\"byteLength\":12}],"                                        \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"      \
    "{\"bufferView\":1,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"                     \
    "{\"bufferView\":2,\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"},"                     \
    "{\"bufferView\":3,\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"},"                     \
    "{\"bufferView\":4,\"componentType\":5126,\"count\":4,\"type\":\"VEC4\"},"                     \
    "{\"bufferView\":5,\"componentType\":5126,\"count\":4,\"type\":\"VEC4\"},"                     \
    "{\"bufferView\":6,\"componentType\":5123,\"count\":6,\"type\":\"SCALAR\"}],"                  \
    "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.8,\"znear\":1}}],"         \
    "\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{\"mesh\":0},"                                      \
    "{\"camera\":0,\"translation\":[0,1.5,3],\"rotation\":[-0.19866933,0,0,0.98006658]}],"
// The mesh, with `more` attributes.
#define MESH(more)                                                                                 \
    "\"meshes\":[{\"primitives\":[{\"indices\":6,\"material\":0,\"attributes\":{\"POSITION\":0,"   \
    "\"NORMAL\":1,\"TEXCOORD_0\":2,\"TEXCOORD_1\":3" more "}}]}],"
#define UNLIT "\"extensions\":{\"KHR_materials_unlit\":{}}"
#define ONE_TEXTURE(file)                                                                          \
    "\"images\":[{\"uri\":\"" file "\"}],\"textures\":[{\"source\":0,\"sampler\":0}],"

// Loads the plane with the mesh, materials and other members in `format`.
glint_scene textured_plane_load(const char *folder, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

// The point where the primary ray through a pixel's centre meets the plane.
typedef struct meeting {
    double at[2];          // x and z
    double length, cosine; // length of the ray; cosine to the plane's normal
    double slant;          // length of the ray over its depth
} meeting;

// Returns false if the ray misses the plane.
bool textured_plane_meet(const glint_settings *settings, int pixel, meeting *m);

// Writes width × height texels of R, G, B, A to the PNG NAME in the scratch folder.
void write_codes(const char *name, const int size[2], const unsigned char (*codes)[4]);

#endif
