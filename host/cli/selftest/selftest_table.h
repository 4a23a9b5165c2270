// The results of a self-test for people.
#ifndef GLINT_CLI_SELFTEST_SELFTEST_TABLE_H
#define GLINT_CLI_SELFTEST_SELFTEST_TABLE_H

#include "device/capabilities.h"
#include "selftest/selftest.h"

#include <stdio.h>

void glint_selftest_print_device(const glint_capabilities *device, FILE *out);

// The heading of the results at one width and precision.
void glint_selftest_print_head(const glint_selftest_result *result, FILE *out);

// A line for each measure; below one that fails, what the worst value is.
void glint_selftest_print(const glint_selftest_result *result, FILE *out);

#endif
