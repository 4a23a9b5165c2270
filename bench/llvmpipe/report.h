// Writes the report of bench/llvmpipe: a table on stdout line by line, and JSON at the end.
#ifndef GLINT_BENCH_LLVMPIPE_REPORT_H
#define GLINT_BENCH_LLVMPIPE_REPORT_H

#include "llvmpipe/contest.h"
#include "llvmpipe/context.h"

#include <jansson.h>

// Prints the driver's name and the head of the table. Returns the report without its scenes; the
// caller owns it.
json_t *llvmpipe_report_create(const bench_stage *stage, const llvmpipe_context *context);

// Adds a scene and prints its lines.
void llvmpipe_report_contest(json_t *report, const bench_scene *scene,
                             const llvmpipe_contest *contest);

#endif
