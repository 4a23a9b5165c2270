// The result of glint compare for people.
#ifndef GLINT_CLI_COMPARE_COMPARE_TABLE_H
#define GLINT_CLI_COMPARE_COMPARE_TABLE_H

#include "report/compare/compare_json.h"

#include <stdio.h>

// A line for each figure: its name, its value, what it means.
void glint_compare_print(const glint_compare_result *result, FILE *out);

#endif
