// Prints the results of glint bench for people. Reads the same JSON as --json writes.
#ifndef GLINT_CLI_BENCH_BENCH_TABLE_H
#define GLINT_CLI_BENCH_BENCH_TABLE_H

#include "report/json.h"

#include <stdio.h>

// Prints version, date and machine of a document (report/bench/bench_json.h).
void glint_bench_print_head(const json_t *document, FILE *out);

// Prints the size, settings and device of one scene of the document.
void glint_bench_print_subject(const json_t *scene, FILE *out);

// Prints all results of one scene of the document.
void glint_bench_print_scene(const json_t *scene, FILE *out);

// Prints one line for a comparison (report/bench/baseline.h).
void glint_bench_print_comparison(const json_t *comparison, FILE *out);

#endif
