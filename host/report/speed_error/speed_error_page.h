// Speed against error as a page: one HTML file that needs nothing from elsewhere.
#ifndef GLINT_REPORT_SPEED_ERROR_SPEED_ERROR_PAGE_H
#define GLINT_REPORT_SPEED_ERROR_SPEED_ERROR_PAGE_H

#include "base/status.h"
#include "report/json.h"

// Writes the page of a document with its pictures (speed_error_json.h), whole or not at all.
// Errors: GLINT_OUTPUT_FAILED, GLINT_OUT_OF_MEMORY.
glint_status glint_speed_error_page_write(const char *path, const json_t *document,
                                          glint_error *error);

#endif
