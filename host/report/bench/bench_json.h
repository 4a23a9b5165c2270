// What `glint bench --json` writes; docs/bench.md describes it.
#ifndef GLINT_REPORT_BENCH_BENCH_JSON_H
#define GLINT_REPORT_BENCH_BENCH_JSON_H

#include "report/bench/bench.h"
#include "report/frame/subject.h"
#include "report/json.h"
#include "report/machine.h"

#define GLINT_BENCH_FORMAT "glint bench"
#define GLINT_BENCH_SCHEMA 1 // changes whenever a reader of the last one would misread a file

// What is known of one measured scene besides the result. All borrowed.
typedef struct glint_bench_scene {
    const char *name;      // the file, or the built-in scene
    glint_subject subject; // scene, environment, camera, settings and warnings
    const char *kernel_dir;
    double load_scene_ms, load_environment_ms;
} glint_bench_scene;

// One entry of the list of scenes.
json_t *glint_bench_scene_json(const glint_bench_scene *scene, const glint_bench_result *result);

// The whole, with an empty list of scenes.
json_t *glint_bench_document(const glint_machine *machine, const glint_bench_options *options);

#endif
