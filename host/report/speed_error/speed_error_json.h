// Writes the JSON of glint bench --error --json; docs/speed_error.md describes it.
#ifndef GLINT_REPORT_SPEED_ERROR_SPEED_ERROR_JSON_H
#define GLINT_REPORT_SPEED_ERROR_SPEED_ERROR_JSON_H

#include "report/bench/bench_json.h"
#include "report/json.h"
#include "report/speed_error/speed_error.h"

#define GLINT_SPEED_ERROR_FORMAT "glint bench --error"
// changes when a reader of the previous schema would misread a file
#define GLINT_SPEED_ERROR_SCHEMA 1

// The entry of one scene in the list of scenes. If the result has pictures, the entry holds them as
// data URIs: "picture" of the reference and of each rung, and "heat" of each rung. Errors: as
// glint_data_uri_make and glint_fingerprint_scene.
glint_status glint_speed_error_scene_json(const glint_bench_scene *scene,
                                          const glint_speed_error_result *result, json_t **entry,
                                          glint_error *error);

// The whole document, with an empty list of scenes. `command` is the command line.
json_t *glint_speed_error_document(const glint_machine *machine,
                                   const glint_speed_error_options *options, const char *command);

// Removes all pictures from the document.
void glint_speed_error_drop_pictures(json_t *document);

#endif
