// Writes the JSON of glint bench --json. See bench_json.h.
#include "report/bench/bench_json.h"

#include "report/frame/stats.h"

#include <math.h>

static json_t *milliseconds_object(const glint_bench_scene *scene, const glint_bench_result *result)
{
    const glint_phases *phases = &result->phases;
    json_t *object = json_object();
    glint_json_put_real(object, "load_scene", scene->load_scene_ms);
    glint_json_put_real(object, "load_environment", scene->load_environment_ms);
    glint_json_put_real(object, "analysis", phases->analysis);
    glint_json_put_real(object, "bvh", phases->bvh);
    glint_json_put_real(object, "irradiance", phases->irradiance);
    glint_json_put_real(object, "cells", phases->cells);
    glint_json_put_real(object, "upload", phases->upload);
    glint_json_put_real(object, "kernel_build_cold", result->compile.cold);
    glint_json_put_real(object, "kernel_build_warm", result->compile.warm);
    // Do not report the speed of a wrong picture.
    bool is_wrong = result->check.outcome == GLINT_CHECK_FAILED;
    glint_json_put_real(object, "first_frame", is_wrong ? NAN : result->first_frame_ms);
    return object;
}

static json_t *frames_object(const glint_bench_result *result)
{
    json_t *object = json_object();
    glint_json_put(object, "warm_up_frames", json_integer(result->warm_up_frames));
    glint_json_put(object, "kernel", glint_json_summary(&result->kernel));
    glint_json_put(object, "readback", glint_json_summary(&result->readback));
    glint_json_put(object, "kernel_and_readback", glint_json_summary(&result->frame));
    // A time of 0 gives null.
    glint_json_put_real(object, "frames_per_second", 1e3 / result->kernel.median);
    glint_json_put_real(object, "frames_per_second_with_readback", 1e3 / result->frame.median);
    return object;
}

static json_t *rates_object(const glint_bench_result *result)
{
    const glint_ray_counts *rays = &result->report.rays;
    const struct {
        const char *name;
        uint64_t count;
    } classes[] = {
        {"primary", rays->primary},           {"reflected", rays->reflected},
        {"refracted_in", rays->refracted_in}, {"refracted_out", rays->refracted_out},
        {"transmitted", rays->transmitted},   {"shadow", rays->shadow},
        {"all", glint_ray_counts_all(rays)},
    };
    // 1e6 rays per second = rays / (1e3 × milliseconds).
    double scale = 1e-3 / result->kernel.median;
    json_t *object = json_object();
    for (size_t i = 0; i < sizeof classes / sizeof *classes; i++) {
        glint_json_put_real(object, classes[i].name, (double)classes[i].count * scale);
    }
    return object;
}

static json_t *memory_object(const glint_bench_result *result)
{
    const glint_device_bytes *bytes = &result->bytes;
    json_t *object = json_object();
    glint_json_put_count(object, "device_scene_bytes", bytes->scene);
    glint_json_put_count(object, "device_tree_bytes", bytes->tree);
    glint_json_put_count(object, "device_environment_bytes", bytes->environment);
    glint_json_put_count(object, "device_frame_bytes", bytes->frame);
    glint_json_put_count(object, "device_bytes",
                         bytes->scene + bytes->tree + bytes->environment + bytes->frame);
    glint_json_put_count(object, "peak_resident_bytes", result->peak_resident_bytes);
    return object;
}

static json_t *check_object(const glint_bench_check *check)
{
    static const char *const outcomes[] = {
        [GLINT_CHECK_PASSED] = "passed",
        [GLINT_CHECK_FAILED] = "failed",
        [GLINT_CHECK_LEFT_OUT] = "left out",
        [GLINT_CHECK_NO_DOUBLE] = "no double precision",
    };
    json_t *object = json_object();
    glint_json_put_text(object, "outcome", outcomes[check->outcome]);
    glint_json_put_text(object, "reason", check->reason[0] != '\0' ? check->reason : NULL);
    glint_json_put_count(object, "nonfinite_pixels", check->nonfinite_pixels);
    glint_json_put_count(object, "unsteady_frames", check->unsteady_frames);
    if (check->has_reference) {
        glint_json_put(object, "error", glint_json_metrics(&check->error));
        glint_json_put_real(object, "ill_conditioned", check->ill_conditioned);
        glint_json_put(object, "well_conditioned_error", glint_json_metrics(&check->judged));
        glint_json_put_real(object, "differing_allowed", check->most_differing);
    }
    return object;
}

json_t *glint_bench_scene_json(const glint_bench_scene *scene, const glint_bench_result *result)
{
    const glint_subject *subject = &scene->subject;
    json_t *object = json_object();
    glint_json_put_text(object, "name", scene->name);
    glint_json_put(object, "check", check_object(&result->check));
    if (result->check.outcome != GLINT_CHECK_FAILED) {
        glint_json_put(object, "frames", frames_object(result));
        glint_json_put(object, "mrays_per_second", rates_object(result));
    }
    glint_json_put(object, "milliseconds", milliseconds_object(scene, result));
    glint_json_put(object, "rays", glint_json_rays(&result->report.rays));
    glint_json_put(object, "truncated_weight", glint_json_truncation(&result->report.truncation));
    glint_json_put_count(object, "deepest_path", result->report.deepest);
    glint_json_put(object, "memory", memory_object(result));
    glint_json_put(object, "settings", glint_json_settings(subject->settings));
    glint_json_put_text(object, "kernel_dir", scene->kernel_dir);
    glint_json_put(object, "device", glint_json_device(&result->device));
    glint_json_put(object, "plan", glint_json_plan(&result->plan));
    glint_json_put(object, "bvh", glint_json_bvh(&result->bvh));
    glint_json_put(object, "scene", glint_json_scene(subject, false));
    glint_json_put(object, "environment", glint_json_environment(subject->environment));
    glint_json_put(object, "camera", glint_json_camera(subject->camera));
    glint_json_put(object, "warnings", glint_json_warnings(subject->warnings));
    return object;
}

json_t *glint_bench_document(const glint_machine *machine, const glint_bench_options *options)
{
    json_t *host = json_object();
    glint_json_put_text(host, "cpu", machine->cpu[0] != '\0' ? machine->cpu : NULL);
    glint_json_put(host, "cores", json_integer(machine->cores));
    glint_json_put_real(host, "load_average", machine->load);
    glint_json_put_text(host, "system", machine->system);
    json_t *asked = json_object();
    glint_json_put(asked, "seconds",
                   options->rounds > 0 ? json_null() : json_real(options->seconds));
    glint_json_put(asked, "rounds",
                   options->rounds > 0 ? json_integer(options->rounds) : json_null());
    glint_json_put_flag(asked, "check", !options->no_check);
    json_t *document = json_object();
    glint_json_put_text(document, "format", GLINT_BENCH_FORMAT);
    glint_json_put(document, "schema", json_integer(GLINT_BENCH_SCHEMA));
    glint_json_put_text(document, "glint", GLINT_VERSION);
    glint_json_put_text(document, "date", machine->date);
    glint_json_put(document, "host", host);
    glint_json_put(document, "options", asked);
    glint_json_put_flag(document, "complete", false);
    glint_json_put(document, "scenes", json_array());
    return document;
}
