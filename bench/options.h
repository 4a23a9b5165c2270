// Values of options that the contests share.
#ifndef GLINT_BENCH_OPTIONS_H
#define GLINT_BENCH_OPTIONS_H

#include "base/status.h"

// "1920x1088": each a multiple of 16 from 16 to 16384. Errors: GLINT_USAGE.
glint_status bench_parse_size(const char *text, int *width, int *height, glint_error *error);

// A number from 1 to `most`; `name` is the option's, without dashes. Errors: GLINT_USAGE.
glint_status bench_parse_count(const char *name, const char *text, double most, double *value,
                               glint_error *error);

// Puts a copy of `text` in place of *copy, which is owned. Errors: GLINT_DEVICE_FAILED.
glint_status bench_set_text(char **copy, const char *text, glint_error *error);

#endif
