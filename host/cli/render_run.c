// The frames of a run. See render_run.h.
#include "cli/render_run.h"

#include "cli/cli.h"
#include "image/output_file.h"
#include "render/sequence.h"
#include "report/frame_metadata.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

glint_subject render_run_subject(const render_run *run)
{
    return (glint_subject){
        .scene = &run->inputs.scene,
        .environment = &run->inputs.environment,
        .camera = &run->inputs.camera,
        .settings = &run->request->inputs.settings,
        .device = glint_device_capabilities(run->device),
        .plan = glint_renderer_plan(run->renderer),
        .bvh = glint_renderer_bvh(run->renderer),
        .warnings = &run->inputs.warnings,
    };
}

// ---- Which frames ------------------------------------------------------------------------------

static glint_camera camera_of(const render_run *run, int frame)
{
    const glint_scene *scene = &run->inputs.scene;
    const int turntable = run->request->turntable;
    if (turntable == 0) {
        return run->inputs.camera;
    }
    glint_vec3 centre = {0, 0, 0};
    if (scene->triangle_count > 0) {
        centre = glint_vec3_scale(glint_vec3_add(scene->low, scene->high), 0.5);
    }
    return glint_camera_orbit(&run->inputs.camera, centre, (int64_t)frame - 1, turntable);
}

// Whether the file of a frame is there, whole, and what would be rendered again. Says why not,
// where there is one.
static bool is_done(const render_run *run, int frame, const char *path)
{
    if (access(path, F_OK) != 0) {
        return false;
    }
    char wanted[GLINT_FINGERPRINT_TEXT], found[GLINT_FINGERPRINT_TEXT];
    const glint_camera camera = camera_of(run, frame);
    glint_fingerprint_frame(&run->fingerprint, &camera, wanted);
    glint_fingerprint_find(path, found);
    if (strcmp(wanted, found) != 0) {
        glint_say("%s: rendered again: %s", path,
                  found[0] == '\0' ? "it does not say how it was made"
                                   : "made from another scene, environment or settings, or by "
                                     "another version");
        return false;
    }
    glint_image image = {0};
    glint_error error = {0};
    const bool is_whole = glint_image_read(path, &image, NULL, &error) == GLINT_OK;
    if (!is_whole) {
        glint_say("%s: rendered again: it is damaged", path);
    }
    glint_image_free(&image);
    glint_error_free(&error);
    return is_whole;
}

static void log_frame(render_run *run, const glint_stats_frame *facts)
{
    if (run->stats == NULL || run->failure.code != GLINT_OK) {
        return;
    }
    glint_stats_log_frame(run->stats, facts, &run->failure);
}

static void skip(render_run *run, int frame, const char *path)
{
    run->totals.skipped++;
    glint_progress_past(&run->display, false);
    const glint_progress_frame shown = {
        .number = frame, .file = path, .outcome = GLINT_FRAME_SKIPPED};
    glint_progress_through(&run->display, &shown);
    const glint_stats_frame facts = {
        .number = frame, .file = path, .outcome = glint_frame_outcome_name(GLINT_FRAME_SKIPPED)};
    log_frame(run, &facts);
}

static bool next_frame(void *context, glint_sequence_frame *frame)
{
    render_run *run = context;
    while (run->failure.code == GLINT_OK && !glint_stop_requested() &&
           glint_frame_next(&run->cursor, &frame->number)) {
        char *path = glint_frame_name_make(&run->request->name, frame->number);
        const bool skipped =
            run->request->skip_existing && path != NULL && is_done(run, frame->number, path);
        if (skipped) {
            skip(run, frame->number, path);
        }
        free(path);
        if (!skipped) {
            frame->camera = camera_of(run, frame->number);
            return true;
        }
    }
    return false;
}

// ---- Writing -----------------------------------------------------------------------------------

// On a writer's thread: nothing of the run changes here.
static void write_frame(void *context, glint_sequence_frame *frame)
{
    const render_run *run = context;
    const render_request *request = run->request;
    char *path = glint_frame_name_make(&request->name, frame->number);
    if (path == NULL) {
        frame->status = glint_fail_memory(&frame->error, "a file name");
        return;
    }
    glint_subject subject = render_run_subject(run);
    subject.camera = &frame->camera;
    glint_frame_metadata metadata;
    glint_frame_metadata_fill(&subject, frame->number, request->exposure,
                              frame->report.kernel_ms + frame->report.readback_ms, &metadata);
    char fingerprint[GLINT_FINGERPRINT_TEXT];
    if (request->inputs.kernel_dir == NULL) {
        glint_fingerprint_frame(&run->fingerprint, &frame->camera, fingerprint);
        glint_frame_metadata_add_text(&metadata, GLINT_FINGERPRINT_NAME, fingerprint);
    }
    glint_write_options options = render_write_options(request);
    options.metadata = metadata.entries;
    options.metadata_count = metadata.count;
    options.channels = frame->layers.channels;
    options.channel_count = frame->layers.count;
    frame->status = glint_image_write(path, &frame->image, &options, &frame->error);
    free(path);
}

// ---- What came of them -------------------------------------------------------------------------

static void add_to_spread(render_spread *spread, uint64_t before, double ms)
{
    spread->sum += ms;
    spread->least = before == 0 ? ms : fmin(spread->least, ms);
    spread->most = before == 0 ? ms : fmax(spread->most, ms);
}

static void count_rendered(render_totals *totals, const glint_sequence_frame *frame)
{
    const glint_frame_report *report = &frame->report;
    add_to_spread(&totals->trace, totals->rendered, frame->trace_ms);
    add_to_spread(&totals->write, totals->rendered, frame->write_ms);
    totals->rays.primary += report->rays.primary;
    totals->rays.reflected += report->rays.reflected;
    totals->rays.refracted_in += report->rays.refracted_in;
    totals->rays.refracted_out += report->rays.refracted_out;
    totals->rays.transmitted += report->rays.transmitted;
    totals->rays.total_reflections += report->rays.total_reflections;
    glint_frame_report *worst = &totals->worst;
    if (glint_stats_truncated(&report->truncation) > glint_stats_truncated(&worst->truncation)) {
        const uint64_t overflows = worst->truncation.media_overflows;
        worst->truncation = report->truncation;
        worst->truncation.media_overflows = overflows;
    }
    if (report->truncation.media_overflows > worst->truncation.media_overflows) {
        worst->truncation.media_overflows = report->truncation.media_overflows;
    }
    if (report->nonfinite_pixels > worst->nonfinite_pixels) {
        worst->nonfinite_pixels = report->nonfinite_pixels;
    }
    totals->rendered++;
}

static void count_failed(render_totals *totals, int frame)
{
    if (totals->failed == totals->failed_capacity) {
        const size_t capacity = 2 * totals->failed_capacity + 16;
        int *frames = realloc(totals->failed_frames, capacity * sizeof *frames);
        if (frames != NULL) {
            totals->failed_frames = frames;
            totals->failed_capacity = capacity;
        }
    }
    if (totals->failed < totals->failed_capacity) {
        totals->failed_frames[totals->failed++] = frame;
    }
}

// Whether a frame that could not be written tells nothing of the next one: its own name is taken by
// something that cannot be replaced, while the folder is as it should be.
static bool concerns_one_frame(const render_run *run, const char *path)
{
    return run->request->is_sequence && path != NULL &&
           glint_output_file_check(path, NULL) != GLINT_OK &&
           glint_output_file_check_folder(path, NULL) == GLINT_OK;
}

static void fail_frame(render_run *run, glint_sequence_frame *frame, const char *path)
{
    count_failed(&run->totals, frame->number);
    if (concerns_one_frame(run, path)) {
        glint_progress_clear(&run->display);
        glint_say_error(&frame->error);
    } else if (run->failure.code == GLINT_OK) {
        run->failure = frame->error;
        frame->error = (glint_error){0};
    }
}

static bool frame_is_through(void *context, glint_sequence_frame *frame)
{
    render_run *run = context;
    const bool is_written = frame->status == GLINT_OK;
    char *path = glint_frame_name_make(&run->request->name, frame->number);
    const glint_frame_outcome outcome = is_written ? GLINT_FRAME_RENDERED : GLINT_FRAME_FAILED;
    const glint_stats_frame facts = {.number = frame->number,
                                     .file = path,
                                     .outcome = glint_frame_outcome_name(outcome),
                                     .error = is_written ? NULL : frame->error.message,
                                     .report = &frame->report,
                                     .trace_ms = frame->trace_ms,
                                     .write_ms = frame->write_ms};
    log_frame(run, &facts);
    if (is_written) {
        count_rendered(&run->totals, frame);
        run->last = frame->report;
    } else {
        fail_frame(run, frame, path);
    }
    if (run->request->is_sequence) {
        const glint_progress_frame shown = {.number = frame->number,
                                            .file = path != NULL ? path : "",
                                            .outcome = outcome,
                                            .trace_ms = frame->trace_ms,
                                            .write_ms = frame->write_ms};
        glint_progress_through(&run->display, &shown);
    }
    free(path);
    return run->failure.code == GLINT_OK;
}

// ---- The run -----------------------------------------------------------------------------------

static bool step(void *context, uint64_t done, uint64_t total)
{
    glint_progress_step(context, done, total);
    return !glint_stop_requested();
}

static void frame_is_traced(void *context)
{
    render_run *run = context;
    glint_progress_past(&run->display, true);
}

static void begin_display(render_run *run)
{
    const render_request *request = run->request;
    const glint_settings *settings = &request->inputs.settings;
    char plan[256], count[48] = "", text[GLINT_MESSAGE_CAPACITY];
    glint_plan_describe(glint_renderer_plan(run->renderer), plan, sizeof plan);
    if (request->is_sequence) {
        snprintf(count, sizeof count, "%llu frames of ", (unsigned long long)run->frames);
    }
    snprintf(text, sizeof text, "rendering %s%dx%d on %s (%s)", count, settings->width,
             settings->height, glint_device_capabilities(run->device)->name, plan);
    const double samples = (double)settings->samples_per_axis * settings->samples_per_axis;
    glint_progress_render(&run->display, request->is_sequence ? run->frames : 0,
                          samples * settings->width * settings->height, text);
}

glint_status render_run_frames(render_run *run, glint_error *error)
{
    const render_request *request = run->request;
    const glint_settings *settings = &request->inputs.settings;
    const glint_subject subject = render_run_subject(run);
    const glint_write_options options = render_write_options(request);
    glint_status status =
        glint_fingerprint_make(&subject, request->output, &options, &run->fingerprint, error);
    if (status != GLINT_OK) {
        return status;
    }
    begin_display(run);
    run->cursor = (glint_frame_cursor){.list = &request->frames, .shard = request->shard};
    const size_t writers = glint_sequence_writers(settings->width, settings->height);
    const glint_sequence sequence = {
        .renderer = run->renderer,
        .with_layers = settings->aovs != 0,
        .writers = run->frames < writers ? (size_t)run->frames : writers,
        .next = next_frame,
        .traced = frame_is_traced,
        .write = write_frame,
        .done = frame_is_through,
        .progress = {step, &run->display},
        .context = run,
    };
    // Frames that are written side by side keep the cores busy; a single one takes all of them.
    glint_image_use_threads(run->frames > 1 ? 1 : 0);
    glint_signals_cooperate(true);
    status = glint_sequence_run(&sequence, error);
    glint_signals_cooperate(false);
    glint_progress_clear(&run->display);
    if (status == GLINT_OK && run->failure.code != GLINT_OK) {
        *error = run->failure;
        run->failure = (glint_error){.code = error->code};
        return error->code;
    }
    if (status == GLINT_OK && glint_stop_requested()) {
        return glint_fail(error, GLINT_INTERRUPTED, "stopped");
    }
    return status;
}

glint_status render_run_verdict(const render_run *run, glint_error *error)
{
    const render_totals *totals = &run->totals;
    if (totals->failed == 0) {
        return GLINT_OK;
    }
    char list[GLINT_MESSAGE_CAPACITY / 2];
    glint_frame_list_print(totals->failed_frames, totals->failed, list, sizeof list);
    return glint_fail(error, GLINT_FRAMES_FAILED,
                      "%s: %zu of %llu frames failed: %s (mend the cause, then run this again with "
                      "--skip-existing)",
                      run->request->output, totals->failed, (unsigned long long)run->frames, list);
}

void render_run_free(render_run *run)
{
    glint_stats_log_close(run->stats);
    glint_renderer_free(run->renderer);
    glint_device_close(run->device);
    glint_inputs_free(&run->inputs);
    glint_error_free(&run->failure);
    free(run->totals.failed_frames);
    *run = (render_run){0};
}
