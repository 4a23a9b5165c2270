// glTF files for tests, made in the test itself in a folder of its own (scratch.h): a text with its
// data as a data URI, and a small mesh that most tests start from.
#ifndef GLINT_TESTS_SUPPORT_GLTF_TEXT_H
#define GLINT_TESTS_SUPPORT_GLTF_TEXT_H

#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// The path of a file in the folder; the text lasts until the next call.
const char *folder_path(const char *folder, const char *name);

// Writes folder/name and returns its path. A failure fails the test. The environment's
// GLINT_TESTS_KEEP is a path that begins the names of copies, which stay.
const char *write_bytes(const char *folder, const char *name, const void *bytes, size_t size);

// A glTF text with the bytes as buffers[0] and `rest`, members of the top level: "\"nodes\":[…],…".
// The caller frees it.
char *gltf_text(const void *bytes, size_t size, const char *rest);

// The same as a .glb with the bytes in its BIN chunk.
unsigned char *glb_bytes(const void *bytes, size_t size, const char *rest, size_t *glb_size);

// Loads folder/test.gltf made of the text. The lists are the caller's to free.
glint_status load_text(const char *folder, const char *text, glint_scene *scene,
                       glint_warnings *warnings, glint_error *error);

// gltf_text and load_text, with success asserted.
glint_scene load_rest(const char *folder, const void *bytes, size_t size, const char *rest);

bool any_warning_has(const glint_warnings *warnings, const char *part);

// A tetrahedron of unit legs at the origin, wound counter-clockwise from outside: accessors 0
// positions, 1 normals (vertex normals pointing away from its centre), 2 indices (unsigned short).
typedef struct tetrahedron {
    float positions[4][3];
    float normals[4][3];
    uint16_t indices[12];
} tetrahedron;

extern const tetrahedron the_tetrahedron;

#define TETRAHEDRON_STORAGE                                                                        \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},"                                           \
    "{\"buffer\":0,\"byteOffset\":48,\"byteLength\":48},"                                          \
    "{\"buffer\":0,\"byteOffset\":96,\"byteLength\":24}],"                                         \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"      \
    "{\"bufferView\":1,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"                     \
    "{\"bufferView\":2,\"componentType\":5123,\"count\":12,\"type\":\"SCALAR\"}]"
#define TETRAHEDRON_PRIMITIVE "\"attributes\":{\"POSITION\":0,\"NORMAL\":1},\"indices\":2"
#define TETRAHEDRON                                                                                \
    TETRAHEDRON_STORAGE ",\"meshes\":[{\"primitives\":[{" TETRAHEDRON_PRIMITIVE "}]}]"
#define ONE_SCENE "\"scenes\":[{\"nodes\":[0]}]"

// The file must be refused, with a line that begins with its path and has `said` in it.
void assert_refused(const char *path, const char *said);

// The same of the tetrahedron's data with `rest`.
void assert_rest_refused(const char *folder, const char *rest, const char *said);

// The tetrahedron with the node, scenes and so on that `rest` gives.
glint_scene load_tetrahedron(const char *folder, const char *rest);

#endif
