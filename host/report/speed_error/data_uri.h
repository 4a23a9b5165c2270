// Encodes pictures as data URIs, which a page can contain.
#ifndef GLINT_REPORT_SPEED_ERROR_DATA_URI_H
#define GLINT_REPORT_SPEED_ERROR_DATA_URI_H

#include "base/status.h"
#include "image/image.h"

typedef enum glint_data_format {
    GLINT_DATA_PNG,  // lossless, for few colours and sharp edges
    GLINT_DATA_JPEG, // lossy, for pictures
} glint_data_format;

// Makes "data:image/png;base64,…" (or jpeg) from a linear image, malloc'd. Errors:
// GLINT_OUTPUT_FAILED if it cannot be encoded, GLINT_OUT_OF_MEMORY.
glint_status glint_data_uri_make(const glint_image *image, glint_data_format format, char **uri,
                                 glint_error *error);

#endif
