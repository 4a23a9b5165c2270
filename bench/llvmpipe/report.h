// What bench/llvmpipe says: a table on stdout as it goes along, and JSON at the end.
#ifndef GLINT_BENCH_LLVMPIPE_REPORT_H
#define GLINT_BENCH_LLVMPIPE_REPORT_H

#include "llvmpipe/contest.h"
#include "llvmpipe/context.h"

#include <jansson.h>

// The whole report without its scenes. Prints the driver's name and the table's head. A new
// reference.
json_t *llvmpipe_report_create(const bench_stage *stage, const llvmpipe_context *context);

// Adds a scene and prints its lines.
void llvmpipe_report_contest(json_t *report, const bench_scene *scene,
                             const llvmpipe_contest *contest);

#endif
