// The frames of a run. See render_run.h.
#include "cli/render/run.h"

#include "base/clock.h"
#include "base/parallel.h"
#include "cli/common/say.h"
#include "cli/common/signals.h"
#include "cli/render/parcel.h"
#include "cli/render/stage.h"
#include "image/output_file.h"
#include "render/sequence.h"

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
        .camera = &run->inputs.viewpoint.camera,
        .settings = &run->request->inputs.settings,
        .max_error = run->request->max_error,
        .device = glint_device_capabilities(run->device),
        .plan = glint_renderer_plan(run->renderer),
        .bvh = glint_renderer_bvh(run->renderer),
        .warnings = &run->inputs.warnings,
    };
}

// ---- Which frames ------------------------------------------------------------------------------

// Why a file that is there is not the frame; NULL where it is.
static const char *why_again(const render_run *run, int frame, const char *path)
{
    char wanted[GLINT_FINGERPRINT_TEXT], found[GLINT_FINGERPRINT_TEXT];
    const glint_camera camera = render_stage_camera(run, frame);
    render_stage_fingerprint(run, &camera, wanted);
    glint_fingerprint_find(path, found);
    if (found[0] == '\0') {
        return "it does not say how it was made";
    }
    if (strcmp(wanted, found) != 0) {
        return "made from another scene, environment or settings, or by another version";
    }
    if (run->request->preview) {
        char *preview = glint_frame_name_make(&run->request->preview_name, frame);
        found[0] = '\0';
        if (preview != NULL) {
            glint_fingerprint_find(preview, found);
        }
        free(preview);
        if (strcmp(wanted, found) != 0) {
            return "its preview is missing, or another's";
        }
    }
    glint_image image = {0};
    glint_error error = {0};
    const bool is_whole = glint_image_read(path, &image, NULL, &error) == GLINT_OK;
    glint_image_free(&image);
    glint_error_free(&error);
    return is_whole ? NULL : "it is damaged";
}

// Whether the file of a frame is there, whole, and what would be rendered again.
static bool is_done(render_run *run, int frame, const char *path)
{
    if (access(path, F_OK) != 0) {
        return false;
    }
    const char *why = why_again(run, frame, path);
    if (why != NULL) {
        glint_progress_clear(&run->display);
        glint_say("%s: rendered again: %s", path, why);
    }
    return why == NULL;
}

// What ends the run, unless something has before. Takes the error.
static void end_by(render_run *run, glint_error *error)
{
    if (run->failure.code == GLINT_OK) {
        run->failure = *error;
        *error = (glint_error){0};
    }
}

static void log_frame(render_run *run, const glint_stats_frame *facts)
{
    glint_error error = {0};
    if (run->stats == NULL || run->stats_failed ||
        glint_stats_log_frame(run->stats, facts, &error) == GLINT_OK) {
        return;
    }
    run->stats_failed = true; // nothing comes behind a line that is not whole
    end_by(run, &error);
    glint_error_free(&error);
}

// Shows a frame of a sequence that is through.
static void show_frame(render_run *run, const glint_progress_frame *shown)
{
    if (run->request->is_sequence) {
        glint_progress_through(&run->display, shown);
    }
}

static void skip(render_run *run, int frame, const char *path, double ms)
{
    run->totals.skipped++;
    glint_progress_passed(&run->display, ms);
    const glint_progress_frame shown = {
        .number = frame, .file = path, .outcome = GLINT_FRAME_SKIPPED};
    show_frame(run, &shown);
    const glint_stats_frame facts = {
        .number = frame, .file = path, .outcome = glint_frame_outcome_name(GLINT_FRAME_SKIPPED)};
    log_frame(run, &facts);
}

static void count_failed(render_totals *totals, int frame)
{
    if (totals->failed_known == totals->failed_capacity) {
        const size_t capacity = 2 * totals->failed_capacity + 16;
        int *frames = realloc(totals->failed_frames, capacity * sizeof *frames);
        if (frames != NULL) {
            totals->failed_frames = frames;
            totals->failed_capacity = capacity;
        }
    }
    totals->failed++;
    if (totals->failed_known < totals->failed_capacity) {
        totals->failed_frames[totals->failed_known++] = frame;
    }
}

// A frame that cannot be rendered: as its scene at its time is bad, or the device failed, which is
// the end.
static void miss(render_run *run, int frame, const char *path, double ms, glint_error *error)
{
    count_failed(&run->totals, frame);
    glint_progress_passed(&run->display, ms);
    const glint_progress_frame shown = {
        .number = frame, .file = path != NULL ? path : "", .outcome = GLINT_FRAME_FAILED};
    const glint_stats_frame facts = {.number = frame,
                                     .file = path,
                                     .outcome = glint_frame_outcome_name(GLINT_FRAME_FAILED),
                                     .error = error->message};
    log_frame(run, &facts);
    if (!run->request->is_sequence || glint_status_is_of_machine(error->code)) {
        end_by(run, error);
        return;
    }
    glint_progress_clear(&run->display);
    glint_say("frame %d: %s", frame, error->message);
    show_frame(run, &shown);
}

// Brings scene, camera and renderer to a frame; false where its file need not be rendered.
static bool wants(render_run *run, int frame, const char *path, glint_error *error)
{
    const double begun = glint_now_ms();
    run->build_ms = 0;
    glint_status status = render_stage_set(run, frame, error);
    double clock = glint_now_ms();
    if (status == GLINT_OK) {
        status = render_light_set(run, frame, error);
    }
    run->build_ms += glint_lap_ms(&clock);
    if (status == GLINT_OK) {
        status = render_parcel_find_plate(run, frame, error);
    }
    if (status == GLINT_OK && run->request->skip_existing && is_done(run, frame, path)) {
        skip(run, frame, path, glint_now_ms() - begun);
        return false;
    }
    clock = glint_now_ms();
    if (status == GLINT_OK) {
        status = render_stage_show(run, error);
    }
    if (status == GLINT_OK) {
        status = render_light_show(run, error);
    }
    run->build_ms += glint_lap_ms(&clock);
    return status == GLINT_OK;
}

static glint_sequence_next next_frame(void *context, glint_sequence_frame *frame)
{
    render_run *run = context;
    if (run->failure.code != GLINT_OK || glint_stop_requested() ||
        !glint_frame_next(&run->cursor, &frame->number)) {
        return GLINT_NEXT_NONE;
    }
    glint_error error = {0};
    char *path = glint_frame_name_make(&run->request->name, frame->number);
    const bool wanted = path != NULL ? wants(run, frame->number, path, &error)
                                     : (glint_fail_memory(&error, "a file name"), false);
    if (wanted) {
        frame->camera = render_stage_camera(run, frame->number);
        render_stage_look_ahead(run);
    } else if (error.code != GLINT_OK && error.code != GLINT_INTERRUPTED) {
        miss(run, frame->number, path, run->build_ms, &error);
    }
    const bool is_stopped = error.code == GLINT_INTERRUPTED; // while a capture was rendered
    glint_error_free(&error);
    free(path);
    return wanted ? GLINT_NEXT_FRAME : is_stopped ? GLINT_NEXT_NONE : GLINT_NEXT_AGAIN;
}

static glint_status render_within(void *context, glint_sequence_frame *frame,
                                  const glint_progress *progress, glint_error *error)
{
    render_run *run = context;
    const glint_frame_request request = {run->renderer, &frame->camera, progress, &frame->image,
                                         &frame->report};
    return glint_error_bound_frame(&run->bound, &request, &run->choice, error);
}

static void frame_is_traced(void *context, glint_sequence_frame *frame)
{
    render_run *run = context;
    glint_progress_traced(&run->display);
    render_parcel_make(run, frame);
}

// ---- What came of them -------------------------------------------------------------------------

static void add_to_spread(render_spread *spread, uint64_t before, double ms)
{
    spread->sum += ms;
    spread->least = before == 0 ? ms : fmin(spread->least, ms);
    spread->most = before == 0 ? ms : fmax(spread->most, ms);
}

static void count_rendered(render_totals *totals, const glint_sequence_frame *frame,
                           const render_parcel *along)
{
    const glint_frame_report *report = &frame->report;
    const double build_ms = along != NULL ? along->build_ms : 0;
    if (along != NULL) {
        add_to_spread(&totals->error, totals->rendered, along->choice.error);
        add_to_spread(&totals->choosing, totals->rendered, along->choice.choosing_ms);
    }
    add_to_spread(&totals->build, totals->rendered, build_ms);
    add_to_spread(&totals->trace, totals->rendered, frame->trace_ms);
    add_to_spread(&totals->write, totals->rendered, frame->write_ms);
    glint_ray_counts_add(&totals->rays, &report->rays);
    glint_frame_report *worst = &totals->worst;
    if (glint_truncation_total(&report->truncation) > glint_truncation_total(&worst->truncation)) {
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

// Whether a frame that could not be written tells nothing of the next one: its plate is bad; or its
// own name, or its preview's, is taken by something that cannot be replaced, while the folder is as
// it should be.
static bool concerns_one_frame(const render_run *run, const glint_sequence_frame *traced,
                               const char *path)
{
    const int frame = traced->number;
    if (!run->request->is_sequence || path == NULL ||
        glint_output_file_check_folder(path, NULL) != GLINT_OK) {
        return false;
    }
    if (traced->status == GLINT_BAD_INPUT) {
        return true;
    }
    char *preview =
        run->request->preview ? glint_frame_name_make(&run->request->preview_name, frame) : NULL;
    const bool is_taken = glint_output_file_check(path, NULL) != GLINT_OK ||
                          (preview != NULL && glint_output_file_check(preview, NULL) != GLINT_OK);
    free(preview);
    return is_taken;
}

static void fail_frame(render_run *run, glint_sequence_frame *frame, const char *path)
{
    count_failed(&run->totals, frame->number);
    if (concerns_one_frame(run, frame, path)) {
        glint_progress_clear(&run->display);
        glint_say_error(&frame->error);
    } else {
        end_by(run, &frame->error);
    }
}

static const glint_error_choice *choice_of(const render_run *run, const render_parcel *along)
{
    return run->request->max_error > 0 && along != NULL ? &along->choice : NULL;
}

static bool frame_is_through(void *context, glint_sequence_frame *frame)
{
    render_run *run = context;
    const bool is_written = frame->status == GLINT_OK;
    const render_parcel *along = frame->own;
    const double build_ms = along != NULL ? along->build_ms : 0;
    char *path = glint_frame_name_make(&run->request->name, frame->number);
    const glint_frame_outcome outcome = is_written ? GLINT_FRAME_RENDERED : GLINT_FRAME_FAILED;
    const glint_stats_frame facts = {.number = frame->number,
                                     .file = path,
                                     .outcome = glint_frame_outcome_name(outcome),
                                     .error = is_written ? NULL : frame->error.message,
                                     .report = &frame->report,
                                     .build_ms = build_ms,
                                     .tree = along != NULL ? along->tree : NULL,
                                     .choice = choice_of(run, along),
                                     .trace_ms = frame->trace_ms,
                                     .write_ms = frame->write_ms};
    log_frame(run, &facts);
    if (is_written) {
        count_rendered(&run->totals, frame, along);
        run->last = frame->report;
    } else {
        fail_frame(run, frame, path);
    }
    const glint_progress_frame shown = {.number = frame->number,
                                        .file = path != NULL ? path : "",
                                        .outcome = outcome,
                                        .trace_ms = frame->trace_ms,
                                        .write_ms = frame->write_ms};
    show_frame(run, &shown);
    free(path);
    render_parcel_free(frame->own);
    return run->failure.code == GLINT_OK;
}

// ---- The run -----------------------------------------------------------------------------------

static bool step(void *context, uint64_t done, uint64_t total)
{
    glint_progress_step(context, done, total);
    return !glint_stop_requested();
}

static void begin_display(render_run *run)
{
    const render_request *request = run->request;
    const glint_settings *settings = &request->inputs.settings;
    char plan[256], count[48] = "", text[GLINT_MESSAGE_CAPACITY];
    glint_plan_describe(glint_renderer_plan(run->renderer), plan, sizeof plan);
    if (request->max_error > 0) {
        snprintf(plan, sizeof plan, "an error of %g at most, by what that takes",
                 request->max_error);
    }
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
    glint_subject subject = render_run_subject(run);
    if (request->env_name.length > 0 || request->capture != NULL || request->max_error > 0) {
        subject.plan = NULL; // it is one frame's
    }
    const glint_write_options options = render_write_options(request);
    glint_status status =
        glint_fingerprint_run(&subject, request->output, &options, &run->fingerprint, error);
    if (status != GLINT_OK) {
        return status;
    }
    begin_display(run);
    const double values = 4 + (request->plate != NULL ? 4 : 0) + (settings->aovs != 0 ? 6 : 0) +
                          7.0 * settings->terms; // of a pixel
    const size_t room =
        glint_sequence_writers(values * sizeof(float) * settings->width * settings->height);
    const size_t writers = run->frames < room ? (size_t)run->frames : room;
    const glint_sequence sequence = {
        .renderer = run->renderer,
        .with_layers = settings->aovs != 0 || settings->terms > 0,
        .writers = writers,
        .render = request->max_error > 0 ? render_within : NULL,
        .next = next_frame,
        .traced = frame_is_traced,
        .write = render_parcel_write,
        .done = frame_is_through,
        .progress = {step, &run->display},
        .context = run,
    };
    // Frames that are written side by side share the cores.
    const int threads = glint_usable_cores() / (int)writers;
    glint_image_use_threads(threads > 1 ? threads : 1);
    glint_signals_cooperate(true);
    status = glint_sequence_run(&sequence, error);
    glint_signals_cooperate(false);
    glint_progress_clear(&run->display);
    if (run->failure.code != GLINT_OK) {
        if (status != GLINT_OK) {
            glint_say_error(error); // what came first decides
            glint_error_free(error);
        }
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
    glint_frame_list_print(totals->failed_frames, totals->failed_known, list, sizeof list);
    return glint_fail(error, GLINT_FRAMES_FAILED,
                      "%s: %zu of %llu frames failed: %s (mend the cause, then run this again with "
                      "--skip-existing)",
                      run->request->output, totals->failed, (unsigned long long)run->frames, list);
}

void render_run_free(render_run *run)
{
    render_pose unused = {0};
    if (render_ahead_take(&run->ahead, run->ahead.pose.time, &unused)) {
        glint_scene_free(&unused.scene);
    }
    render_light_free(&run->light);
    glint_stats_log_close(run->stats);
    glint_renderer_free(run->renderer);
    glint_device_close(run->device);
    glint_inputs_free(&run->inputs);
    glint_error_free(&run->failure);
    free(run->totals.failed_frames);
    free(run->label.path);
    free(run->camera_name);
    *run = (render_run){0};
}
