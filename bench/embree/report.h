// Writes the report of bench/embree: a table on stdout line by line, and JSON at the end.
#ifndef GLINT_BENCH_EMBREE_REPORT_H
#define GLINT_BENCH_EMBREE_REPORT_H

#include "embree/contest.h"

#include <jansson.h>

// Returns the report without its scenes: machine, versions, settings. The caller owns it.
json_t *embree_report_create(const bench_arena *arena);

// Adds an object for a scene to the report. Returns it, borrowed.
json_t *embree_report_add_scene(json_t *report, const bench_scene *scene);

// Adds results to a scene's object and prints a line.
void embree_report_contest(json_t *scene, const bench_contest *contest);
void embree_report_build(json_t *scene, const bench_build *build);

// Adds leaks to the report and prints a line.
void embree_report_leaks(json_t *report, const char *who, leak_count leaks);

#endif
