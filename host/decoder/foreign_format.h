// Recognises files that people give as a scene and that are not glTF, to say how to get glTF.
#ifndef GLINT_DECODER_FOREIGN_FORMAT_H
#define GLINT_DECODER_FOREIGN_FORMAT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// As many first bytes as a format needs at most.
#define GLINT_FOREIGN_HEAD 1024

// The beginning of a file.
typedef struct glint_foreign_file {
    const char *path;
    const unsigned char *head; // the first bytes
    size_t length;             // of `head`: GLINT_FOREIGN_HEAD, or the whole file
    uint64_t size;             // of the file, in bytes
} glint_foreign_file;

// Writes what the file is and the way to glTF: "it is a Blender file, not glTF (in Blender: …)".
// Judges by the content and, if the content tells nothing and is no JSON, by the extension. Returns
// false if the file may be glTF.
bool glint_foreign_describe(const glint_foreign_file *file, char *text, size_t capacity);

#ifdef __cplusplus
}
#endif

#endif
