// Writes the --stats file. See stats.h.
#include "report/frame/stats.h"

#include "report/json.h"
#include "report/machine.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The times of the steps before the first frame.
static json_t *preparation_object(const glint_stats *stats)
{
    const glint_phases *phases = stats->phases;
    json_t *object = json_object();
    glint_json_put_real(object, "load_scene", stats->load_scene_ms);
    glint_json_put_real(object, "load_environment", stats->load_environment_ms);
    glint_json_put_real(object, "analysis", phases->analysis);
    glint_json_put_real(object, "bvh", phases->bvh);
    glint_json_put_real(object, "irradiance", phases->irradiance);
    glint_json_put_real(object, "cells", phases->cells);
    glint_json_put_real(object, "kernel_build", phases->kernel_build);
    glint_json_put_real(object, "upload", phases->upload);
    return object;
}

static json_t *rates_object(const glint_ray_counts *rays, double ms)
{
    // 1e6 rays per second = rays / (1e3 × milliseconds). A time of 0 gives null.
    const double scale = 1e-3 / ms;
    json_t *object = json_object();
    glint_json_put_real(object, "primary", (double)rays->primary * scale);
    glint_json_put_real(object, "all", (double)glint_ray_counts_all(rays) * scale);
    return object;
}

static void put_frame(json_t *root, const glint_frame_report *frame)
{
    glint_json_put(root, "rays", glint_json_rays(&frame->rays));
    glint_json_put(root, "mrays_per_second", rates_object(&frame->rays, frame->kernel_ms));
    glint_json_put(root, "truncated_weight", glint_json_truncation(&frame->truncation));
    glint_json_put_count(root, "deepest_path", frame->deepest);
    glint_json_put_count(root, "nonfinite_pixels", frame->nonfinite_pixels);
    glint_json_put_count(root, "mended_pixels", frame->mended_pixels);
}

static void put_choice(json_t *root, const glint_error_choice *choice)
{
    if (choice == NULL) {
        return;
    }
    json_t *object = json_object();
    glint_json_put_real(object, "bound", choice->bound);
    glint_json_put_real(object, "error", choice->error);
    glint_json_put_text(object, "options", choice->rung.options);
    glint_json_put_real(object, "grid_error", choice->grid_error);
    glint_json_put_real(object, "unseen_of_single_precision", choice->unseen_of_float);
    glint_json_put_count(object, "grid_pixels", (uint64_t)choice->grid_pixels);
    glint_json_put_flag(object, "grid_is_frame", choice->grid_is_frame);
    glint_json_put_count(object, "grids", (uint64_t)choice->grids);
    glint_json_put_count(object, "frames", (uint64_t)choice->frames);
    glint_json_put_real(object, "choosing_milliseconds", choice->choosing_ms);
    glint_json_put_count(object, "choosing_rays", choice->choosing_rays);
    glint_json_put(root, "max_error", object);
}

static void put_subject(json_t *root, const glint_subject *subject)
{
    glint_json_put_text(root, "kernels", subject->kernels);
    glint_json_put(root, "plan", glint_json_plan(subject->plan));
    glint_json_put(root, "device", glint_json_device(subject->device));
    glint_json_put(root, "bvh", glint_json_bvh(subject->bvh));
    glint_json_put(root, "scene", glint_json_scene(subject, false));
    glint_json_put(root, "environment", glint_json_environment(subject->environment));
    glint_json_put(root, "camera", glint_json_camera(subject->camera));
}

static void put_run(json_t *root, const glint_stats *stats)
{
    glint_json_put_text(root, "glint", GLINT_VERSION);
    glint_json_put_text(root, "output", stats->output);
    json_t *settings = glint_json_settings(stats->subject->settings);
    glint_json_put_real(settings, "exposure", stats->exposure);
    glint_json_put_text(settings, "tone", glint_tone_names[stats->tone]);
    if (stats->plate != NULL) {
        glint_json_put_text(settings, "background", stats->plate);
    }
    if (stats->subject->max_error > 0) {
        glint_json_put_real(settings, "max_error", stats->subject->max_error);
    }
    glint_json_put(root, "settings", settings);
}

static void put_memory(json_t *root)
{
    json_t *memory = json_object();
    glint_json_put_count(memory, "peak_resident_bytes", glint_peak_resident_bytes());
    glint_json_put(root, "memory", memory);
}

json_t *glint_stats_json(const glint_stats *stats)
{
    json_t *root = json_object();
    put_run(root, stats);
    json_t *milliseconds = preparation_object(stats);
    glint_json_put_real(milliseconds, "kernel", stats->frame->kernel_ms);
    glint_json_put_real(milliseconds, "readback", stats->frame->readback_ms);
    glint_json_put_real(milliseconds, "encode", stats->encode_ms);
    glint_json_put_real(milliseconds, "total", stats->total_ms);
    glint_json_put(root, "milliseconds", milliseconds);
    put_frame(root, stats->frame);
    put_choice(root, stats->choice);
    put_subject(root, stats->subject);
    put_memory(root);
    glint_json_put(root, "warnings", glint_json_warnings(stats->subject->warnings));
    return root;
}

// ---- Of a sequence -----------------------------------------------------------------------------

struct glint_stats_log {
    FILE *file;
    char *path;
};

// Writes the object as a line. Takes over the reference.
static glint_status add_line(glint_stats_log *log, json_t *object, glint_error *error)
{
    char *text = object != NULL ? glint_json_dump(object, JSON_REAL_PRECISION(9)) : NULL;
    json_decref(object);
    if (text == NULL) {
        return glint_fail_memory(error, "a line of statistics");
    }
    errno = 0;
    const bool written =
        fputs(text, log->file) >= 0 && fputc('\n', log->file) >= 0 && fflush(log->file) == 0;
    free(text);
    return written ? GLINT_OK
                   : glint_fail(error, GLINT_OUTPUT_FAILED,
                                "%s: could not be written: %s (write elsewhere)", log->path,
                                strerror(errno));
}

static json_t *event_object(const char *name)
{
    json_t *object = json_object();
    glint_json_put_text(object, "event", name);
    return object;
}

static glint_status add_run(glint_stats_log *log, const glint_stats *run, glint_error *error)
{
    json_t *root = event_object("run");
    put_run(root, run);
    glint_machine machine;
    glint_machine_describe(&machine);
    glint_json_put_text(root, "host", machine.host);
    glint_json_put_text(root, "date", machine.date);
    glint_json_put_count(root, "frames", run->frames);
    glint_json_put(root, "milliseconds", preparation_object(run));
    put_subject(root, run->subject);
    glint_json_put(root, "warnings", glint_json_warnings(run->subject->warnings));
    return add_line(log, root, error);
}

glint_status glint_stats_log_open(FILE *file, const char *path, const glint_stats *run,
                                  glint_stats_log **log, glint_error *error)
{
    *log = calloc(1, sizeof **log);
    char *copy = strdup(path);
    if (*log == NULL || copy == NULL) {
        free(*log);
        *log = NULL;
        free(copy);
        fclose(file);
        return glint_fail_memory(error, "the statistics");
    }
    **log = (glint_stats_log){.file = file, .path = copy};
    glint_status status = add_run(*log, run, error);
    if (status != GLINT_OK) {
        glint_stats_log_close(*log);
        *log = NULL;
    }
    return status;
}

glint_status glint_stats_log_frame(glint_stats_log *log, const glint_stats_frame *frame,
                                   glint_error *error)
{
    json_t *root = event_object("frame");
    glint_json_put(root, "frame", json_integer(frame->number));
    glint_json_put_text(root, "file", frame->file);
    glint_json_put_text(root, "outcome", frame->outcome);
    if (frame->error != NULL) {
        glint_json_put_text(root, "error", frame->error);
    }
    if (frame->report != NULL) {
        json_t *milliseconds = json_object();
        glint_json_put_real(milliseconds, "kernel", frame->report->kernel_ms);
        glint_json_put_real(milliseconds, "readback", frame->report->readback_ms);
        glint_json_put_real(milliseconds, "build", frame->build_ms);
        glint_json_put_real(milliseconds, "trace", frame->trace_ms);
        glint_json_put_real(milliseconds, "write", frame->write_ms);
        glint_json_put(root, "milliseconds", milliseconds);
        if (frame->tree != NULL) {
            glint_json_put_text(root, "tree", frame->tree);
        }
        put_frame(root, frame->report);
        put_choice(root, frame->choice);
    }
    return add_line(log, root, error);
}

glint_status glint_stats_log_total(glint_stats_log *log, const glint_stats_total *total,
                                   glint_error *error)
{
    json_t *root = event_object("total");
    glint_json_put_count(root, "frames", total->frames);
    glint_json_put_count(root, "rendered", total->rendered);
    glint_json_put_count(root, "skipped", total->skipped);
    glint_json_put_count(root, "failed", total->failed);
    glint_json_put_flag(root, "stopped", total->stopped);
    json_t *milliseconds = json_object();
    glint_json_put_real(milliseconds, "build", total->build_ms);
    glint_json_put_real(milliseconds, "trace", total->trace_ms);
    glint_json_put_real(milliseconds, "write", total->write_ms);
    glint_json_put_real(milliseconds, "total", total->total_ms);
    glint_json_put(root, "milliseconds", milliseconds);
    glint_json_put_real(root, "frames_per_second", 1e3 * (double)total->rendered / total->total_ms);
    glint_json_put(root, "rays", glint_json_rays(&total->rays));
    put_memory(root);
    return add_line(log, root, error);
}

void glint_stats_log_close(glint_stats_log *log)
{
    if (log == NULL) {
        return;
    }
    fclose(log->file);
    free(log->path);
    free(log);
}
