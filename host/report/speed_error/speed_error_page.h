// Writes the results of speed against error as a page: one self-contained HTML file.
#ifndef GLINT_REPORT_SPEED_ERROR_SPEED_ERROR_PAGE_H
#define GLINT_REPORT_SPEED_ERROR_SPEED_ERROR_PAGE_H

#include "base/status.h"
#include "report/json.h"

// Writes the page of a document with pictures (speed_error_json.h), whole or not at all. Errors:
// GLINT_OUTPUT_FAILED, GLINT_OUT_OF_MEMORY.
glint_status glint_speed_error_page_write(const char *path, const json_t *document,
                                          glint_error *error);

#endif
