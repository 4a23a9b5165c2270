// JSON through jansson: what the reports of this floor share. Objects that are made here are new
// references. Where memory is short an entry is missing, and the text at the end cannot be made
// either: glint_json_write and glint_json_print report it.
#ifndef GLINT_REPORT_JSON_H
#define GLINT_REPORT_JSON_H

#include "base/statistics.h"
#include "base/status.h"
#include "image/metrics.h"
#include "render/frame.h"
#include "report/frame/subject.h"

#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>

void glint_json_put(json_t *object, const char *key, json_t *value); // takes the reference
void glint_json_put_flag(json_t *object, const char *key, bool value);
void glint_json_put_count(json_t *object, const char *key, uint64_t value);
// JSON has no NaN and no infinity: null stands for them.
void glint_json_put_real(json_t *object, const char *key, double value);
// Where a text is no UTF-8 (file names may hold any bytes), those that are no ASCII become '?';
// NULL becomes null.
json_t *glint_json_text(const char *text);
void glint_json_put_text(json_t *object, const char *key, const char *text);

json_t *glint_json_device(const glint_capabilities *device);
json_t *glint_json_bvh(const glint_bvh_report *bvh);
json_t *glint_json_plan(const glint_plan *plan);
json_t *glint_json_environment(const glint_environment *environment);
json_t *glint_json_camera(const glint_camera *camera);
json_t *glint_json_settings(const glint_settings *settings);
json_t *glint_json_warnings(const glint_warnings *warnings);
json_t *glint_json_rays(const glint_ray_counts *rays);
json_t *glint_json_truncation(const glint_truncation *truncation);
json_t *glint_json_summary(const glint_summary *summary);
// Where no pixel was compared, the figures are null.
json_t *glint_json_metrics(const glint_metrics *metrics);
// Counts, bounds, the variant and overrides; with `everything` also what the file uses, the
// topology, if the subject has one, the materials, their variants, the instances and the cameras.
json_t *glint_json_scene(const glint_subject *subject, bool everything);

// The value at the end of the names in `path`, "frames.kernel.median"; NULL where there is none. Of
// the wrong type or missing, a number is NaN and a text is NULL. All borrowed.
json_t *glint_json_at(const json_t *root, const char *path);
double glint_json_real_at(const json_t *root, const char *path);
const char *glint_json_text_at(const json_t *root, const char *path);

// Writes `root` indented into the file, whole or not at all (image/output_file.h). Takes the
// reference, also where it is NULL (memory was short when it was made). Errors:
// GLINT_OUTPUT_FAILED.
glint_status glint_json_write(const char *path, json_t *root, glint_error *error);

// Reads a file that holds one value, in which no object has two members of one name. The caller
// releases *root. Errors: GLINT_BAD_INPUT with the file's name, and the line where one is at fault.
glint_status glint_json_read(const char *path, json_t **root, glint_error *error);

// As json_dumps, with escapes for all that a terminal should not get.
char *glint_json_dump(const json_t *value, size_t flags);

// The same as a malloc'd text that ends with a newline.
glint_status glint_json_print(json_t *root, char **text, glint_error *error);

#endif
