// Writes the JSON of glint bench --error --json. See speed_error_json.h.
#include "report/speed_error/speed_error_json.h"

#include "report/frame/fingerprint.h"
#include "report/speed_error/data_uri.h"

#include <math.h>
#include <stdlib.h>

static glint_status put_picture(json_t *object, const char *key, const glint_image *image,
                                glint_data_format format, glint_error *error)
{
    if (image->pixels == NULL) {
        return GLINT_OK;
    }
    char *uri;
    glint_status status;
    TRY_OR(cleanup, status, glint_data_uri_make(image, format, &uri, error));
    glint_json_put_text(object, key, uri);
cleanup:
    free(uri);
    return status;
}

static json_t *directions_object(const glint_rung_result *rung)
{
    if (!rung->has_directions) {
        return json_null();
    }
    const glint_direction_error *directions = &rung->directions;
    const bool any = directions->compared > 0;
    json_t *object = json_object();
    glint_json_put_real(object, "mean_degrees", any ? directions->mean : NAN);
    glint_json_put_real(object, "p99_degrees", any ? directions->p99 : NAN);
    glint_json_put_real(object, "largest_degrees", any ? directions->largest : NAN);
    glint_json_put_count(object, "compared_pixels", directions->compared);
    glint_json_put_count(object, "pixels_with_one_alone", directions->lost);
    return object;
}

static json_t *phases_object(const glint_phases *phases)
{
    json_t *object = json_object();
    glint_json_put_real(object, "analysis", phases->analysis);
    glint_json_put_real(object, "bvh", phases->bvh);
    glint_json_put_real(object, "irradiance", phases->irradiance);
    glint_json_put_real(object, "cells", phases->cells);
    glint_json_put_real(object, "upload", phases->upload);
    glint_json_put_real(object, "kernel_build", phases->kernel_build);
    return object;
}

static void put_plan(json_t *object, const glint_plan *plan)
{
    char text[512];
    glint_plan_describe(plan, text, sizeof text);
    glint_json_put_text(object, "plan", text);
}

static glint_status put_rung(json_t *list, const glint_speed_error_result *result, size_t which,
                             glint_error *error)
{
    const glint_rung_result *rung = &result->rungs[which];
    const int by = rung->dominated_by;
    json_t *object = json_object();
    glint_json_put_text(object, "name", rung->rung.name);
    glint_json_put_text(object, "options", rung->rung.options);
    glint_json_put(object, "milliseconds", glint_json_summary(&rung->kernel));
    glint_json_put(object, "error", glint_json_metrics(&rung->error));
    glint_json_put(object, "directions", directions_object(rung));
    if (rung->has_directions) {
        glint_json_put_count(object, "wrong_hits", rung->wrong_hits);
    } else {
        glint_json_put(object, "wrong_hits", json_null());
    }
    glint_json_put_flag(object, "is_pareto_optimal",
                        by < 0 && rung->error.nonfinite == 0 && !isnan(rung->error.relative_rmse));
    glint_json_put_text(object, "dominated_by", by < 0 ? NULL : result->rungs[by].rung.name);
    glint_json_put(object, "dominated_by_number", by < 0 ? json_null() : json_integer(by + 1));
    glint_json_put(object, "rays", glint_json_rays(&rung->rays));
    glint_json_put(object, "truncated_weight", glint_json_truncation(&rung->truncation));
    glint_json_put(object, "phases", phases_object(&rung->phases));
    put_plan(object, &rung->plan);
    glint_status status;
    TRY_OR(cleanup, status, put_picture(object, "picture", &rung->picture, GLINT_DATA_JPEG, error));
    TRY_OR(cleanup, status, put_picture(object, "heat", &rung->heat, GLINT_DATA_PNG, error));
cleanup:
    (void)json_array_append_new(list, object);
    return status;
}

static glint_status put_reference(json_t *entry, const glint_speed_error_result *result,
                                  glint_error *error)
{
    json_t *object = json_object();
    glint_json_put_text(object, "options", result->reference.options);
    glint_json_put(object, "milliseconds", glint_json_summary(&result->reference_kernel));
    glint_json_put(object, "truncated_weight",
                   glint_json_truncation(&result->reference_truncation));
    glint_json_put(object, "change_by_four_times_the_weights",
                   glint_json_metrics(&result->change_by_weights));
    glint_json_put(object, "change_by_twice_the_depth",
                   glint_json_metrics(&result->change_by_depth));
    put_plan(object, &result->reference_plan);
    glint_status status =
        put_picture(object, "picture", &result->reference_picture, GLINT_DATA_JPEG, error);
    glint_json_put(entry, "reference", object);
    return status;
}

static json_t *sampling_object(const glint_speed_error_result *result)
{
    if (result->sampling_truth == 0) {
        return json_null();
    }
    json_t *rows = json_array();
    for (int i = 0; i < GLINT_SAMPLING_ROWS; i++) {
        const glint_sampling_result *of = &result->sampling[i];
        json_t *row = json_object();
        glint_json_put(row, "samples", json_integer(of->samples));
        glint_json_put_text(row, "filter", of->is_mip ? "mip" : "bilinear");
        glint_json_put(row, "milliseconds", glint_json_summary(&of->kernel));
        glint_json_put(row, "error", glint_json_metrics(&of->error));
        (void)json_array_append_new(rows, row);
    }
    json_t *object = json_object();
    glint_json_put(object, "reference_samples", json_integer(result->sampling_truth));
    glint_json_put(object, "rows", rows);
    return object;
}

static void put_fingerprint(json_t *object, const glint_fingerprint *fingerprint)
{
    char text[GLINT_FINGERPRINT_TEXT];
    snprintf(text, sizeof text, "%016llx%016llx", (unsigned long long)fingerprint->high,
             (unsigned long long)fingerprint->low);
    glint_json_put_text(object, "fingerprint", text);
}

// Puts scene, environment, camera and settings, with fingerprints that identify scene and
// environment.
static glint_status put_subject(json_t *entry, const glint_subject *subject, glint_error *error)
{
    glint_fingerprint scene_is = {0}, environment_is = {0};
    TRY(glint_fingerprint_scene(subject->scene, &scene_is, error));
    TRY(glint_fingerprint_environment(subject->environment, &environment_is, error));
    json_t *scene = glint_json_scene(subject, false);
    json_t *environment = glint_json_environment(subject->environment);
    put_fingerprint(scene, &scene_is);
    put_fingerprint(environment, &environment_is);
    glint_json_put(entry, "scene", scene);
    glint_json_put(entry, "environment", environment);
    glint_json_put(entry, "camera", glint_json_camera(subject->camera));
    glint_json_put(entry, "settings", glint_json_settings(subject->settings));
    glint_json_put(entry, "warnings", glint_json_warnings(subject->warnings));
    return GLINT_OK;
}

glint_status glint_speed_error_scene_json(const glint_bench_scene *scene,
                                          const glint_speed_error_result *result, json_t **entry,
                                          glint_error *error)
{
    *entry = json_object();
    glint_json_put_text(*entry, "name", scene->name);
    glint_json_put(*entry, "device", glint_json_device(&result->device));
    glint_json_put(*entry, "bvh", glint_json_bvh(&result->bvh));
    glint_status status;
    TRY_OR(cleanup, status, put_reference(*entry, result, error));
    json_t *rungs = json_array();
    glint_json_put(*entry, "rungs", rungs);
    for (size_t i = 0; i < result->count; i++) {
        TRY_OR(cleanup, status, put_rung(rungs, result, i, error));
    }
    glint_json_put(*entry, "sampling", sampling_object(result));
    TRY_OR(cleanup, status, put_subject(*entry, &scene->subject, error));
cleanup:
    if (status != GLINT_OK) {
        json_decref(*entry);
        *entry = NULL;
    }
    return status;
}

json_t *glint_speed_error_document(const glint_machine *machine,
                                   const glint_speed_error_options *options, const char *command)
{
    const glint_bench_options as_bench = {.seconds = options->seconds, .rounds = options->rounds};
    json_t *document = glint_bench_document(machine, &as_bench);
    glint_json_put_text(document, "format", GLINT_SPEED_ERROR_FORMAT);
    glint_json_put(document, "schema", json_integer(GLINT_SPEED_ERROR_SCHEMA));
    glint_json_put_text(document, "command", command);
    (void)json_object_del(glint_json_at(document, "options"), "check");
    return document;
}

void glint_speed_error_drop_pictures(json_t *document)
{
    size_t i, k;
    json_t *scene, *rung;
    json_array_foreach(glint_json_at(document, "scenes"), i, scene)
    {
        (void)json_object_del(glint_json_at(scene, "reference"), "picture");
        json_array_foreach(glint_json_at(scene, "rungs"), k, rung)
        {
            (void)json_object_del(rung, "picture");
            (void)json_object_del(rung, "heat");
        }
    }
}
