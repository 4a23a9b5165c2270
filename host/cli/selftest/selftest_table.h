// Prints the results of a self-test as a table for people.
#ifndef GLINT_CLI_SELFTEST_SELFTEST_TABLE_H
#define GLINT_CLI_SELFTEST_SELFTEST_TABLE_H

#include "device/capabilities.h"
#include "selftest/selftest.h"

#include <stdio.h>

void glint_selftest_print_device(const glint_capabilities *device, FILE *out);

// Prints the heading for one width and precision.
void glint_selftest_print_head(const glint_selftest_result *result, FILE *out);

// Prints a line per measure. Below a failed measure, describes its worst value.
void glint_selftest_print(const glint_selftest_result *result, FILE *out);

#endif
