// Loads an environment's picture from its files, before it becomes a cube map.
#ifndef GLINT_ENVIRONMENT_SOURCE_H
#define GLINT_ENVIRONMENT_SOURCE_H

#include "base/status.h"
#include "environment/chart.h"
#include "environment/recognise.h"
#include "image/image.h"
#include "image/stored.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Zero is valid: no picture.
typedef struct glint_source {
    glint_image image;       // radiance; six files become one picture of layout FACES
    glint_stored stored;     // the file's values, if `image` has no pixels (glint_source_open)
    glint_image_facts facts; // of a single file; of six: code_bits of one that has any
    glint_chart chart;
    const char *reason;   // how glint knows the layout; static text
    size_t mended_texels; // NaN, infinite or negative texels, replaced (see radiance.h)
    bool is_warned;       // a warning was given, if anybody wanted warnings
} glint_source;

// What `path` names: a file, or six of them.
typedef enum glint_source_kind {
    GLINT_SOURCE_FILE,
    GLINT_SOURCE_FOLDER,
    GLINT_SOURCE_PATTERN, // with %s for the face's name
} glint_source_kind;
glint_source_kind glint_source_kind_of(const char *path);

// Loads the picture of `path`. Arguments and errors: as glint_environment_load.
glint_status glint_source_load(const char *path, const glint_layout_request *request,
                               glint_source *source, glint_warnings *warnings, glint_error *error);

// Does the same, but leaves faces of 8- or 16-bit codes in `stored`: they are needed once, texel by
// texel, and take a quarter or half of the memory there.
glint_status glint_source_open(const char *path, const glint_layout_request *request,
                               glint_source *source, glint_warnings *warnings, glint_error *error);

// Does what glint_source_load does with a single file's content. Takes the image over, and frees it
// on failure.
glint_status glint_source_take(const glint_image_file *file, const glint_layout_request *request,
                               glint_source *source, glint_warnings *warnings, glint_error *error);

// Recognises a picture again, of which `source` has only the size and the facts. Errors:
// GLINT_BAD_INPUT.
glint_status glint_source_recall(const char *path, const glint_layout_request *request,
                                 glint_source_kind kind, glint_source *source, glint_error *error);

void glint_source_free(glint_source *source);

#ifdef __cplusplus
}
#endif

#endif
