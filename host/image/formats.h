// Image formats: which file is of which, and what may be written.
#ifndef GLINT_IMAGE_FORMATS_H
#define GLINT_IMAGE_FORMATS_H

#include "base/status.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// A file to be read, of one of the formats that are, or its bytes in memory.
typedef struct glint_image_source {
    const char *path;   // borrowed; of an image in memory: its name for messages
    const char *plugin; // OpenImageIO's name of the format
    uint64_t size;      // of the file, bytes
    const void *bytes;  // [size], borrowed; NULL: the path is read
} glint_image_source;

// Finds out what the file at `path` is, by its content. Errors: GLINT_BAD_INPUT with the file's
// name where it is no regular file, empty, or of no format that is read.
glint_status glint_image_find_source(const char *path, glint_image_source *source,
                                     glint_error *error);

// The same of a file's bytes. `name` stands for it in messages. Both must outlive the source.
glint_status glint_image_find_source_in_memory(const char *name, const void *bytes, uint64_t size,
                                               glint_image_source *source, glint_error *error);

typedef enum glint_written_kind {
    GLINT_WRITTEN_EXR,
    GLINT_WRITTEN_HDR,
    GLINT_WRITTEN_PNG,
    GLINT_WRITTEN_JPEG,
    GLINT_WRITTEN_TIFF,
} glint_written_kind;

typedef struct glint_written_format {
    const char *extension; // without the dot
    glint_written_kind kind;
    const char *plugin; // OpenImageIO's name of the format
} glint_written_format;

// By the extension of `path`, whatever its case; NULL where that names none.
const glint_written_format *glint_image_written_format(const char *path);

// GLINT_USAGE (naming what may be given) unless `compression` suits the format. NULL does.
glint_status glint_image_check_compression(const char *path, const glint_written_format *format,
                                           const char *compression, glint_error *error);

#ifdef __cplusplus
}
#endif

#endif
