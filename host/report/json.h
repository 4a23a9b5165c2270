// Makes, reads and writes JSON for all reports, with jansson. Functions that make values return new
// references. If memory runs short, an entry may be missing. Then the final text cannot be made
// either: glint_json_write and glint_json_print report this.
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

void glint_json_put(json_t *object, const char *key, json_t *value); // takes over the reference
void glint_json_put_flag(json_t *object, const char *key, bool value);
void glint_json_put_count(json_t *object, const char *key, uint64_t value);
// Puts a number; NaN and infinity become null, because JSON has neither.
void glint_json_put_real(json_t *object, const char *key, double value);
// Makes a string. If the text is not valid UTF-8 (file names may hold any bytes), all its bytes
// that are not ASCII become '?'. NULL becomes null.
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
// The figures are null if no pixel was compared.
json_t *glint_json_metrics(const glint_metrics *metrics);
// The scene's counts, bounds, variant and overrides. `everything` adds the features that the file
// uses, topology (if known), materials, variants, instances and cameras.
json_t *glint_json_scene(const glint_subject *subject, bool everything);

// The value at the end of a path such as "frames.kernel.median"; NULL if there is none. If the
// value is missing or has another type, the number is NaN and the text is NULL. All borrowed.
json_t *glint_json_at(const json_t *root, const char *path);
double glint_json_real_at(const json_t *root, const char *path);
const char *glint_json_text_at(const json_t *root, const char *path);

// Writes `root` indented into the file, whole or not at all (image/output_file.h). Takes over the
// reference. `root` may be NULL if memory ran short. Errors: GLINT_OUTPUT_FAILED.
glint_status glint_json_write(const char *path, json_t *root, glint_error *error);

// Reads a file with one value. Refuses objects with two members of the same name. The caller
// releases *root. Errors: GLINT_BAD_INPUT with the file's name, and the line if known.
glint_status glint_json_read(const char *path, json_t **root, glint_error *error);

// Like json_dumps, but escapes everything that a terminal should not receive.
char *glint_json_dump(const json_t *value, size_t flags);

// Makes an indented text that ends with a newline, malloc'd. Takes over the reference.
glint_status glint_json_print(json_t *root, char **text, glint_error *error);

#endif
