// An environment's picture as its files hold it, before it becomes a cube map.
#ifndef GLINT_ENVIRONMENT_SOURCE_H
#define GLINT_ENVIRONMENT_SOURCE_H

#include "base/status.h"
#include "environment/chart.h"
#include "environment/recognise.h"
#include "image/image.h"

#ifdef __cplusplus
extern "C" {
#endif

// Zero is valid: no picture.
typedef struct glint_source {
    glint_image image; // radiance; six files are one picture, of the layout FACES
    glint_chart chart;
    const char *reason;   // how the layout was known; static text
    size_t mended_texels; // NaN, infinite or negative ones, replaced (see radiance.h)
} glint_source;

// As glint_environment_load, which makes a cube map of it.
glint_status glint_source_load(const char *path, const glint_layout_request *request,
                               glint_source *source, glint_warnings *warnings, glint_error *error);

// The same from a single file's content, whose image is taken over (and freed on failure, too).
glint_status glint_source_take(const glint_image_file *file, const glint_layout_request *request,
                               glint_source *source, glint_warnings *warnings, glint_error *error);

void glint_source_free(glint_source *source);

#ifdef __cplusplus
}
#endif

#endif
