// Recognises the formats of image files, and lists the formats to write.
#ifndef GLINT_IMAGE_FORMATS_H
#define GLINT_IMAGE_FORMATS_H

#include "base/status.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// A file of a known format to read, or its bytes in memory.
typedef struct glint_image_source {
    const char *path;   // borrowed; for an image in memory: its name in messages
    const char *plugin; // OpenImageIO's name of the format
    uint64_t size;      // of the file, in bytes
    const void *bytes;  // [size], borrowed; NULL: read the path
} glint_image_source;

// Recognises the file at `path` by its content. Errors: GLINT_BAD_INPUT with the file's name, if it
// is no regular file, is empty, or has no format that glint reads.
glint_status glint_image_find_source(const char *path, glint_image_source *source,
                                     glint_error *error);

// Recognises a file's bytes. `name` is its name in messages. Both must outlive the source.
glint_status glint_image_find_source_in_memory(const char *name, const void *bytes, uint64_t size,
                                               glint_image_source *source, glint_error *error);

// The name of the image format that begins with these bytes ("PNG"), read by glint or not; NULL if
// they are no image's.
const char *glint_image_format_name(const void *start, size_t length);

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

// The format for the extension of `path`, in any case; NULL if there is none.
const glint_written_format *glint_image_written_format(const char *path);

// Fails with GLINT_USAGE, naming the choices, if `compression` does not suit the format. NULL suits
// all.
glint_status glint_image_check_compression(const char *path, const glint_written_format *format,
                                           const char *compression, glint_error *error);

#ifdef __cplusplus
}
#endif

#endif
