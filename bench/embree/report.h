// What bench/embree says: a table on stdout as it goes along, and JSON at the end.
#ifndef GLINT_BENCH_EMBREE_REPORT_H
#define GLINT_BENCH_EMBREE_REPORT_H

#include "embree/contest.h"

#include <jansson.h>

// The whole report without its scenes: machine, versions, settings. A new reference.
json_t *embree_report_create(const bench_arena *arena);

// A scene's object, added to the report; borrowed.
json_t *embree_report_add_scene(json_t *report, const bench_scene *scene);

// Add to a scene's object and print a line.
void embree_report_contest(json_t *scene, const bench_contest *contest);
void embree_report_build(json_t *scene, const bench_build *build);

// Adds to the report and prints a line.
void embree_report_leaks(json_t *report, const char *who, leak_count leaks);

#endif
