// Renders the frames of a run. See run.h.
#include "cli/render/run.h"

#include "base/clock.h"
#include "base/parallel.h"
#include "cli/common/say.h"
#include "cli/common/signals.h"
#include "cli/render/plate.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

// ---- The first frame ---------------------------------------------------------------------------

static glint_status begin_with(render_run *run, int frame, glint_error *error)
{
    render_shot *shot = &run->shot;
    TRY(render_stage_set(&shot->stage, frame, error));
    TRY(render_light_set(&shot->light, &shot->stage, frame, shot->display, error));
    TRY(render_plate_check(run->request, frame, error));
    return render_tracer_begin(&run->tracer, shot, error);
}

// True if the next frame may still succeed: the error may come from this frame's own scene, plate
// or environment.
static bool is_one_frames(const render_run *run, glint_status status)
{
    const bool has_own_light = run->request->env_name.length > 0 || run->request->capture != NULL;
    return status == GLINT_BAD_INPUT || (status == GLINT_USAGE && has_own_light);
}

glint_status render_run_prepare(render_run *run, glint_error *error)
{
    glint_frame_cursor first = run->frames.cursor;
    glint_error first_error = {0};
    glint_status status = GLINT_OK;
    int frame;
    // Start the renderer with the first good frame. next_frame reports the bad frames before it. If
    // no frame is good, return the error of the first one.
    while (glint_frame_next(&first, &frame)) {
        status = begin_with(run, frame, error);
        if (!is_one_frames(run, status)) {
            break;
        }
        if (first_error.code == GLINT_OK) {
            first_error = *error;
        } else {
            glint_error_free(error);
        }
        *error = (glint_error){0};
    }
    if (is_one_frames(run, status)) {
        *error = first_error;
        return first_error.code;
    }
    glint_error_free(&first_error);
    return status;
}

// ---- The next frame ----------------------------------------------------------------------------

// True if the frame's file exists and its fingerprint matches. A writer still checks that it is
// whole.
static bool stands(render_run *run, int frame, const char *path)
{
    if (!run->request->skip_existing || access(path, F_OK) != 0) {
        return false;
    }
    char fingerprint[GLINT_FINGERPRINT_TEXT];
    const glint_camera camera = render_stage_camera(&run->shot.stage, frame);
    render_shot_fingerprint(&run->shot, &camera, fingerprint);
    const char *why = render_writer_why_again(run->request, frame, path, fingerprint);
    if (why != NULL) {
        render_frames_say_again(&run->frames, path, why);
    }
    return why == NULL;
}

// Starts loading the next frame's scene, if there is a next frame.
static void look_ahead(render_run *run)
{
    glint_frame_cursor after = run->frames.cursor;
    int next;
    if (!glint_frame_next(&after, &next)) {
        return;
    }
    char *path = glint_frame_name_make(&run->request->name, next);
    const bool may_skip = run->request->skip_existing && (path == NULL || access(path, F_OK) == 0);
    render_tracer_look_ahead(&run->tracer, &run->shot, next, may_skip);
    free(path);
}

// Moves the shot and the renderer to a frame. If the frame's file is there, a writer only reads it.
static glint_status reach(render_run *run, glint_sequence_frame *frame, const char *path,
                          bool is_again, glint_error *error)
{
    const double begun = glint_now_ms();
    TRY(render_shot_set(&run->shot, frame->number, &run->build_ms, error));
    if (!is_again && stands(run, frame->number, path)) {
        if (!render_writer_pack_standing(frame, glint_now_ms() - begun)) {
            return glint_fail_memory(error, "a frame");
        }
        run->frames.looked_at++;
        return GLINT_OK;
    }
    double clock = glint_now_ms();
    TRY(render_tracer_show(&run->tracer, &run->shot, error));
    run->build_ms += glint_lap_ms(&clock);
    frame->camera = render_stage_camera(&run->shot.stage, frame->number);
    look_ahead(run);
    glint_renderer_take_special(run->tracer.renderer);
    return GLINT_OK;
}

static glint_sequence_next next_frame(void *context, glint_sequence_frame *frame)
{
    render_run *run = context;
    bool is_again;
    const glint_sequence_next next = render_frames_next(&run->frames, &frame->number, &is_again);
    if (glint_stop_requested() || next != GLINT_NEXT_FRAME) {
        return glint_stop_requested() ? GLINT_NEXT_NONE : next;
    }
    glint_error error = {0};
    char *path = glint_frame_name_make(&run->request->name, frame->number);
    const glint_status status = path != NULL ? reach(run, frame, path, is_again, &error)
                                             : glint_fail_memory(&error, "a file name");
    // An interrupted capture is no failed frame
    if (status != GLINT_OK && status != GLINT_INTERRUPTED) {
        render_frames_miss(&run->frames, frame->number, path, run->build_ms, &error);
    }
    glint_error_free(&error);
    free(path);
    return status == GLINT_INTERRUPTED ? GLINT_NEXT_NONE
           : status != GLINT_OK        ? GLINT_NEXT_AGAIN
           : frame->own != NULL        ? GLINT_NEXT_TRACED
                                       : GLINT_NEXT_FRAME;
}

// ---- The sequence ------------------------------------------------------------------------------

static glint_status render_within(void *context, glint_sequence_frame *frame,
                                  const glint_progress *progress, glint_error *error)
{
    render_run *run = context;
    const glint_frame_request request = {run->tracer.renderer, &frame->camera, progress,
                                         &frame->image, &frame->report};
    return glint_error_bound_frame(&run->tracer.bound, &request, &run->choice, error);
}

// Compiles special kernels if the rest of the sequence takes long, by the time of this frame.
static void consider_kernels(render_run *run, double frame_ms)
{
    const render_totals *totals = &run->frames.totals;
    const double done = (double)(totals->rendered + totals->skipped + totals->failed) + 1;
    const double left = (double)run->frames.count - done;
    render_kernels_ahead_consider(&run->kernels, run->tracer.renderer,
                                  glint_device_capabilities(run->tracer.device), left * frame_ms);
}

static void frame_is_traced(void *context, glint_sequence_frame *frame)
{
    render_run *run = context;
    glint_progress_traced(&run->display);
    consider_kernels(run, frame->report.kernel_ms);
    render_writer_pack(&run->shot, &run->tracer, run->build_ms,
                       run->request->max_error > 0 ? &run->choice : NULL, frame);
    run->tracer.tree = "kept";
}

static void write_frame(void *context, glint_sequence_frame *frame)
{
    const render_run *run = context;
    render_writer_write(run->request, frame);
}

static bool frame_is_through(void *context, glint_sequence_frame *frame)
{
    render_run *run = context;
    return render_frames_through(&run->frames, frame);
}

static bool step(void *context, uint64_t done, uint64_t total)
{
    glint_progress_step(context, done, total);
    return !glint_stop_requested();
}

static void begin_display(render_run *run)
{
    const render_request *request = run->request;
    const glint_settings *settings = &request->inputs.settings;
    const glint_subject subject = render_tracer_subject(&run->tracer, &run->shot);
    char plan[256], count[48] = "", text[GLINT_MESSAGE_CAPACITY];
    glint_plan_describe(subject.plan, plan, sizeof plan);
    if (request->max_error > 0) {
        snprintf(plan, sizeof plan, "an error of %g at most, by what that takes",
                 request->max_error);
    }
    if (request->is_sequence) {
        snprintf(count, sizeof count, "%llu frames of ", (unsigned long long)run->frames.count);
    }
    snprintf(text, sizeof text, "rendering %s%dx%d on %s (%s, kernels %s)", count, settings->width,
             settings->height, subject.device->name, plan, subject.kernels);
    const double samples = (double)settings->samples_per_axis * settings->samples_per_axis;
    run->shot.display = NULL; // from now on the display shows only frames
    glint_progress_render(&run->display, request->is_sequence ? run->frames.count : 0,
                          samples * settings->width * settings->height, text);
    glint_progress_standing(&run->display, render_frames_standing(&run->frames));
}

// Computes the fingerprint of the settings that all frames share.
static glint_status find_fingerprint(render_run *run, glint_error *error)
{
    const render_request *request = run->request;
    glint_subject subject = render_tracer_subject(&run->tracer, &run->shot);
    if (request->env_name.length > 0 || request->capture != NULL || request->max_error > 0) {
        subject.plan = NULL; // the plan may differ between frames
    }
    const glint_write_options options = render_write_options(request);
    return glint_fingerprint_run(&subject, request->output, &options, &run->shot.shared, error);
}

static size_t count_writers(const render_run *run)
{
    const render_request *request = run->request;
    const glint_settings *settings = &request->inputs.settings;
    const double values = 4 + (request->plate != NULL ? 4 : 0) +
                          (double)glint_layers_channels(settings->aovs) +
                          7.0 * settings->terms; // floats per pixel
    const size_t room =
        glint_sequence_writers(values * sizeof(float) * settings->width * settings->height);
    return run->frames.count < room ? (size_t)run->frames.count : room;
}

glint_status render_run_frames(render_run *run, glint_error *error)
{
    const glint_settings *settings = &run->request->inputs.settings;
    TRY(find_fingerprint(run, error));
    begin_display(run);
    const glint_sequence sequence = {
        .renderer = run->tracer.renderer,
        .with_layers = settings->aovs != 0 || settings->terms > 0,
        .writers = count_writers(run),
        .render = run->request->max_error > 0 ? render_within : NULL,
        .next = next_frame,
        .traced = frame_is_traced,
        .write = write_frame,
        .done = frame_is_through,
        .progress = {step, &run->display},
        .context = run,
    };
    // Share the cores among the writers that run at the same time.
    const int threads = glint_usable_cores() / (int)sequence.writers;
    glint_image_use_threads(threads > 1 ? threads : 1);
    // Render all frames.
    glint_signals_cooperate(true);
    glint_status status = glint_sequence_run(&sequence, error);
    glint_signals_cooperate(false);
    glint_progress_clear(&run->display);
    // Decide which error to return.
    if (run->frames.failure.code != GLINT_OK && status != GLINT_OK) {
        glint_say_error(error); // the earlier error decides the exit status
    }
    if (render_frames_take_failure(&run->frames, error)) {
        return error->code;
    }
    if (status == GLINT_OK && glint_stop_requested()) {
        return glint_fail(error, GLINT_INTERRUPTED, "stopped");
    }
    return status;
}

void render_run_free(render_run *run)
{
    render_kernels_ahead_end(&run->kernels);
    render_shot_free(&run->shot); // first: the thread that loads ahead uses the renderer
    render_frames_free(&run->frames);
    render_tracer_free(&run->tracer);
    *run = (render_run){0};
}
