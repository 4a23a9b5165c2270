// Prints the result of glint compare as a table for people.
#ifndef GLINT_CLI_COMPARE_COMPARE_TABLE_H
#define GLINT_CLI_COMPARE_COMPARE_TABLE_H

#include "report/compare/compare_json.h"

#include <stdio.h>

// Prints a line for each figure: name, value and meaning.
void glint_compare_print(const glint_compare_result *result, FILE *out);

#endif
