// The --stats file. See stats.h.
#include "report/stats.h"

#include "report/json.h"
#include "report/machine.h"

uint64_t glint_stats_rays(const glint_ray_counts *rays)
{
    // Total reflections are among the reflected.
    return rays->primary + rays->reflected + rays->refracted_in + rays->refracted_out +
           rays->transmitted;
}

double glint_stats_truncated(const glint_truncation *truncation)
{
    return truncation->by_depth + truncation->by_min_weight + truncation->by_stack;
}

static json_t *milliseconds_object(const glint_stats *stats)
{
    const glint_phases *phases = stats->phases;
    json_t *object = json_object();
    glint_json_put_real(object, "load_scene", stats->load_scene_ms);
    glint_json_put_real(object, "load_environment", stats->load_environment_ms);
    glint_json_put_real(object, "analysis", phases->analysis);
    glint_json_put_real(object, "bvh", phases->bvh);
    glint_json_put_real(object, "irradiance", phases->irradiance);
    glint_json_put_real(object, "kernel_build", phases->kernel_build);
    glint_json_put_real(object, "upload", phases->upload);
    glint_json_put_real(object, "kernel", stats->frame->kernel_ms);
    glint_json_put_real(object, "readback", stats->frame->readback_ms);
    glint_json_put_real(object, "encode", stats->encode_ms);
    glint_json_put_real(object, "total", stats->total_ms);
    return object;
}

static json_t *rates_object(const glint_frame_report *frame)
{
    // Rays in 1e6 over milliseconds in 1e-3: a kernel time of 0 gives null.
    double scale = 1e-3 / frame->kernel_ms;
    json_t *object = json_object();
    glint_json_put_real(object, "primary", (double)frame->rays.primary * scale);
    glint_json_put_real(object, "all", (double)glint_stats_rays(&frame->rays) * scale);
    return object;
}

glint_status glint_stats_write(const char *path, const glint_stats *stats, glint_error *error)
{
    const glint_subject *subject = stats->subject;
    json_t *root = json_object();
    glint_json_put_text(root, "glint", GLINT_VERSION);
    glint_json_put_text(root, "output", stats->output);
    json_t *settings = glint_json_settings(subject->settings);
    glint_json_put_real(settings, "exposure", stats->exposure);
    glint_json_put(root, "settings", settings);
    glint_json_put(root, "milliseconds", milliseconds_object(stats));
    glint_json_put(root, "rays", glint_json_rays(&stats->frame->rays));
    glint_json_put(root, "mrays_per_second", rates_object(stats->frame));
    glint_json_put(root, "truncated_weight", glint_json_truncation(&stats->frame->truncation));
    glint_json_put_count(root, "deepest_path", stats->frame->deepest);
    glint_json_put_count(root, "nonfinite_pixels", stats->frame->nonfinite_pixels);
    glint_json_put(root, "plan", glint_json_plan(subject->plan));
    glint_json_put(root, "device", glint_json_device(subject->device));
    glint_json_put(root, "bvh", glint_json_bvh(subject->bvh));
    glint_json_put(root, "scene", glint_json_scene(subject->scene, NULL, false));
    glint_json_put(root, "environment", glint_json_environment(subject->environment));
    glint_json_put(root, "camera", glint_json_camera(subject->camera));
    json_t *memory = json_object();
    glint_json_put_count(memory, "peak_resident_bytes", glint_peak_resident_bytes());
    glint_json_put(root, "memory", memory);
    glint_json_put(root, "warnings", glint_json_warnings(subject->warnings));
    return glint_json_write(path, root, error);
}
