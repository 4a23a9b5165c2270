// The --stats file. See stats.h.
#include "report/stats.h"

#include "report/json.h"

#include <sys/resource.h>

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

static json_t *rays_object(const glint_ray_counts *rays)
{
    json_t *object = json_object();
    glint_json_put_count(object, "primary", rays->primary);
    glint_json_put_count(object, "reflected", rays->reflected);
    glint_json_put_count(object, "refracted_in", rays->refracted_in);
    glint_json_put_count(object, "refracted_out", rays->refracted_out);
    glint_json_put_count(object, "transmitted", rays->transmitted);
    glint_json_put_count(object, "all", glint_stats_rays(rays));
    glint_json_put_count(object, "total_reflections", rays->total_reflections);
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

static json_t *truncation_object(const glint_truncation *truncation)
{
    json_t *object = json_object();
    glint_json_put_real(object, "by_depth", truncation->by_depth);
    glint_json_put_real(object, "by_min_weight", truncation->by_min_weight);
    glint_json_put_real(object, "by_stack", truncation->by_stack);
    glint_json_put_real(object, "total", glint_stats_truncated(truncation));
    glint_json_put_count(object, "media_overflows", truncation->media_overflows);
    return object;
}

static json_t *memory_object(void)
{
    struct rusage usage = {0};
    json_t *object = json_object();
    if (getrusage(RUSAGE_SELF, &usage) == 0) {
        // Linux counts in KiB.
        glint_json_put_count(object, "peak_resident_bytes", (uint64_t)usage.ru_maxrss * 1024);
    }
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
    glint_json_put(root, "rays", rays_object(&stats->frame->rays));
    glint_json_put(root, "mrays_per_second", rates_object(stats->frame));
    glint_json_put(root, "truncated_weight", truncation_object(&stats->frame->truncation));
    glint_json_put_count(root, "deepest_path", stats->frame->deepest);
    glint_json_put_count(root, "nonfinite_pixels", stats->frame->nonfinite_pixels);
    glint_json_put(root, "plan", glint_json_plan(subject->plan));
    glint_json_put(root, "device", glint_json_device(subject->device));
    glint_json_put(root, "bvh", glint_json_bvh(subject->bvh));
    glint_json_put(root, "scene", glint_json_scene(subject->scene, NULL, false));
    glint_json_put(root, "environment", glint_json_environment(subject->environment));
    glint_json_put(root, "camera", glint_json_camera(subject->camera));
    glint_json_put(root, "memory", memory_object());
    glint_json_put(root, "warnings", glint_json_warnings(subject->warnings));
    return glint_json_write(path, root, error);
}
