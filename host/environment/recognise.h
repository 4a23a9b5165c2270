// Recognises the layout of an environment file and makes its chart.
#ifndef GLINT_ENVIRONMENT_RECOGNISE_H
#define GLINT_ENVIRONMENT_RECOGNISE_H

#include "base/status.h"
#include "environment/chart.h"
#include "image/image.h"
#include "image/image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

// The content of a single file.
typedef struct glint_image_file {
    const char *name; // for messages
    glint_image image;
    glint_image_facts facts;
} glint_image_file;

// The result: the chart and how glint knows it.
typedef struct glint_recognised {
    glint_chart chart;
    const char *reason; // static text
} glint_recognised;

// Recognises a single file: the user's layout comes first, then the envmap attribute, then the
// shape. Fails with GLINT_BAD_INPUT if the shape does not suit the layout or is ambiguous, or if a
// disc leaves the picture. The message names the file and the choices.
glint_status glint_layout_recognise(const glint_image_file *file,
                                    const glint_layout_request *request,
                                    glint_recognised *recognised, glint_error *error);

#ifdef __cplusplus
}
#endif

#endif
