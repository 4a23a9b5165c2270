// Writes the JSON of glint compare --json; docs/compare.md lists its members.
#ifndef GLINT_REPORT_COMPARE_COMPARE_JSON_H
#define GLINT_REPORT_COMPARE_COMPARE_JSON_H

#include "image/image.h"
#include "report/compare/figures.h"
#include "report/json.h"

// Changes when a reader of the previous schema would misread a file.
#define GLINT_COMPARE_SCHEMA 1

typedef struct glint_compared_file {
    const char *name;
    const glint_image *image;
} glint_compared_file;

// The result of a comparison. All borrowed.
typedef struct glint_compare_result {
    glint_compared_file image, reference;
    const glint_metrics *metrics;
    const glint_bounds *bounds;
} glint_compare_result;

// The result as JSON, a new reference.
json_t *glint_compare_json(const glint_compare_result *result);

#endif
