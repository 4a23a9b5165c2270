// Pictures within a page: data URIs.
#ifndef GLINT_REPORT_SPEED_ERROR_DATA_URI_H
#define GLINT_REPORT_SPEED_ERROR_DATA_URI_H

#include "base/status.h"
#include "image/image.h"

typedef enum glint_data_format {
    GLINT_DATA_PNG,  // for few colours and sharp edges
    GLINT_DATA_JPEG, // for pictures
} glint_data_format;

// "data:image/png;base64,…" of a linear image, malloc'd. Errors: GLINT_OUTPUT_FAILED where it
// cannot be encoded, GLINT_OUT_OF_MEMORY.
glint_status glint_data_uri_make(const glint_image *image, glint_data_format format, char **uri,
                                 glint_error *error);

#endif
