// Writes glTF files for tests, in the test's own folder (scratch.h): a text with its data as a data
// URI. Most tests start from a small mesh declared here.
#ifndef GLINT_TESTS_SUPPORT_GLTF_TEXT_H
#define GLINT_TESTS_SUPPORT_GLTF_TEXT_H

#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Returns the path of a file in the folder. The text is valid until the next call.
const char *folder_path(const char *folder, const char *name);

// Writes folder/name and returns its path. Fails the test on error. If the environment has
// GLINT_TESTS_KEEP, a copy stays under a path that begins with its value.
const char *write_bytes(const char *folder, const char *name, const void *bytes, size_t size);

// Makes a glTF text: the bytes are buffers[0], `rest` holds members of the top level:
// "\"nodes\":[…],…". The caller frees it.
char *gltf_text(const void *bytes, size_t size, const char *rest);

// Makes the same file as a .glb, with the bytes in the BIN chunk.
unsigned char *glb_bytes(const void *bytes, size_t size, const char *rest, size_t *glb_size);

// Writes the text as folder/test.gltf and loads it. The caller frees the lists.
glint_status load_text(const char *folder, const char *text, glint_scene *scene,
                       glint_warnings *warnings, glint_error *error);

// gltf_text and load_text; asserts success.
glint_scene load_rest(const char *folder, const void *bytes, size_t size, const char *rest);

// Does the same, and gives each corner a vertex of its own (by_corner.h).
glint_scene load_by_corner(const char *folder, const void *bytes, size_t size, const char *rest);

bool any_warning_has(const glint_warnings *warnings, const char *part);

// A tetrahedron of unit legs at the origin, counter-clockwise from outside. Accessor 0: positions,
// 1: normals (vertex normals pointing away from the centre), 2: indices (unsigned short).
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

// Asserts that glint refuses the file, in one line that begins with the path and contains `said`.
void assert_refused(const char *path, const char *said);

// Asserts the same for the tetrahedron's data with `rest`.
void assert_rest_refused(const char *folder, const char *rest, const char *said);

// Loads the tetrahedron with the nodes, scenes and so on in `rest`.
glint_scene load_tetrahedron(const char *folder, const char *rest);

#endif
