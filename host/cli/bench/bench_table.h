// What `glint bench` prints for people: the same figures that --json holds, read from there.
#ifndef GLINT_CLI_BENCH_BENCH_TABLE_H
#define GLINT_CLI_BENCH_BENCH_TABLE_H

#include "report/json.h"

#include <stdio.h>

// The program, the date and the machine, of a document (report/bench/bench_json.h).
void glint_bench_print_head(const json_t *document, FILE *out);

// What one of its scenes is, and the device.
void glint_bench_print_subject(const json_t *scene, FILE *out);

// One of its scenes.
void glint_bench_print_scene(const json_t *scene, FILE *out);

// A line for a comparison (report/bench/baseline.h).
void glint_bench_print_comparison(const json_t *comparison, FILE *out);

#endif
