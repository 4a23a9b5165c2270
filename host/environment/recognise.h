// Which layout an environment file has, and where its pixels look.
#ifndef GLINT_ENVIRONMENT_RECOGNISE_H
#define GLINT_ENVIRONMENT_RECOGNISE_H

#include "base/status.h"
#include "environment/chart.h"
#include "image/image.h"
#include "image/image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

// A single file as it was read.
typedef struct glint_image_file {
    const char *name; // for messages
    glint_image image;
    glint_image_facts facts;
} glint_image_file;

// What it is.
typedef struct glint_recognised {
    glint_chart chart;
    const char *reason; // static text
} glint_recognised;

// What a single file is: what the user named, else what the envmap attribute says, else its shape.
// GLINT_BAD_INPUT, naming the file and the choices, for a shape that does not suit or says too
// little, and for a disc that leaves the picture.
glint_status glint_layout_recognise(const glint_image_file *file,
                                    const glint_layout_request *request,
                                    glint_recognised *recognised, glint_error *error);

#ifdef __cplusplus
}
#endif

#endif
