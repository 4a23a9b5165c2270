// Writes the JSON of glint bench --json; docs/bench.md describes it.
#ifndef GLINT_REPORT_BENCH_BENCH_JSON_H
#define GLINT_REPORT_BENCH_BENCH_JSON_H

#include "report/bench/bench.h"
#include "report/frame/subject.h"
#include "report/json.h"
#include "report/machine.h"

#define GLINT_BENCH_FORMAT "glint bench"
#define GLINT_BENCH_SCHEMA 1 // changes when a reader of the previous schema would misread a file

// A measured scene, without its results. All borrowed.
typedef struct glint_bench_scene {
    const char *name;      // path, or name of the built-in scene
    glint_subject subject; // scene, environment, camera, settings and warnings
    const char *kernel_dir;
    double load_scene_ms, load_environment_ms;
} glint_bench_scene;

// The entry of one scene in the list of scenes.
json_t *glint_bench_scene_json(const glint_bench_scene *scene, const glint_bench_result *result);

// The whole document, with an empty list of scenes: it is not complete yet.
json_t *glint_bench_document(const glint_machine *machine, const glint_bench_options *options);

#endif
