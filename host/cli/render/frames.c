// Chooses the next frame and records outcomes. See frames.h.
#include "cli/render/frames.h"

#include "cli/common/say.h"

#include <stdlib.h>
#include <unistd.h>

// ---- Which are next ----------------------------------------------------------------------------

void render_frames_begin(render_frames *frames, const render_request *request,
                         glint_progress_display *display)
{
    *frames = (render_frames){
        .request = request,
        .display = display,
        .cursor = {.list = &request->frames, .shard = request->shard},
        .count = glint_shard_size(request->shard, request->frames.count),
    };
}

uint64_t render_frames_standing(const render_frames *frames)
{
    glint_frame_cursor cursor = frames->cursor;
    uint64_t standing = 0;
    int frame;
    while (frames->request->skip_existing && glint_frame_next(&cursor, &frame)) {
        char *path = glint_frame_name_make(&frames->request->name, frame);
        standing += path != NULL && access(path, F_OK) == 0;
        free(path);
    }
    return standing;
}

glint_sequence_next render_frames_next(render_frames *frames, int *frame, bool *is_again)
{
    *is_again = false;
    if (frames->failure.code != GLINT_OK) {
        return GLINT_NEXT_NONE;
    }
    if (glint_frame_next(&frames->cursor, frame)) {
        return GLINT_NEXT_FRAME;
    }
    if (frames->damaged.count > 0) {
        *frame = frames->damaged.frames[--frames->damaged.count];
        *is_again = true;
        return GLINT_NEXT_FRAME;
    }
    return frames->looked_at > 0 ? GLINT_NEXT_WAIT : GLINT_NEXT_NONE;
}

// ---- What became of them -----------------------------------------------------------------------

// Ends the run with this error, unless an earlier error ended it. Takes over the error if it is
// used.
static void end_by(render_frames *frames, glint_error *error)
{
    if (frames->failure.code == GLINT_OK) {
        frames->failure = *error;
        *error = (glint_error){0};
    }
}

// Logs a finished frame; shows it if it is part of a sequence.
static void tell(render_frames *frames, const glint_stats_frame *facts, glint_frame_outcome outcome)
{
    glint_stats_frame named = *facts;
    named.outcome = glint_frame_outcome_name(outcome);
    glint_error error = {0};
    if (frames->log != NULL && glint_stats_log_frame(frames->log, &named, &error) != GLINT_OK) {
        end_by(frames, &error);
        glint_error_free(&error);
        glint_stats_log_close(frames->log); // a broken line must stay the last one
        frames->log = NULL;
    }
    const glint_progress_frame shown = {.number = facts->number,
                                        .file = facts->file != NULL ? facts->file : "",
                                        .outcome = outcome,
                                        .trace_ms = facts->trace_ms,
                                        .write_ms = facts->write_ms};
    if (frames->request->is_sequence) {
        glint_progress_through(frames->display, &shown);
    }
}

void render_frames_say_again(render_frames *frames, const char *path, const char *why)
{
    glint_progress_clear(frames->display);
    glint_say("%s: rendered again: %s", path, why);
    glint_progress_again(frames->display);
}

void render_frames_miss(render_frames *frames, int frame, const char *path, double ms,
                        glint_error *error)
{
    render_totals_add_failed(&frames->totals, frame);
    glint_progress_failed(frames->display, ms);
    const bool is_end = !frames->request->is_sequence || glint_status_is_of_machine(error->code);
    if (!is_end) {
        glint_progress_clear(frames->display);
        glint_say("frame %d: %s", frame, error->message);
    }
    const glint_stats_frame facts = {.number = frame, .file = path, .error = error->message};
    tell(frames, &facts, GLINT_FRAME_FAILED);
    if (is_end) {
        end_by(frames, error);
    }
}

static bool remember_damaged(render_damaged *damaged, int frame)
{
    if (damaged->count == damaged->capacity) {
        const size_t capacity = 2 * damaged->capacity + 16;
        int *grown = realloc(damaged->frames, capacity * sizeof *grown);
        if (grown == NULL) {
            return false;
        }
        damaged->frames = grown;
        damaged->capacity = capacity;
    }
    damaged->frames[damaged->count++] = frame;
    return true;
}

// Judges an existing file after a writer has read it to its end, or failed to.
static void judge_standing(render_frames *frames, glint_sequence_frame *frame, const char *path)
{
    const render_parcel *parcel = frame->own;
    frames->looked_at--;
    if (frame->status == GLINT_OK) {
        frames->totals.skipped++;
        glint_progress_skipped(frames->display, parcel->build_ms);
        const glint_stats_frame facts = {.number = frame->number, .file = path};
        tell(frames, &facts, GLINT_FRAME_SKIPPED);
    } else if (path != NULL && remember_damaged(&frames->damaged, frame->number)) {
        render_frames_say_again(frames, path, "it is damaged");
    } else {
        render_frames_miss(frames, frame->number, path, parcel->build_ms, &frame->error);
    }
}

// Records a frame that a writer has written or failed to write.
static void judge_written(render_frames *frames, glint_sequence_frame *frame, const char *path)
{
    const render_request *request = frames->request;
    const render_parcel *parcel = frame->own;
    const bool is_written = frame->status == GLINT_OK;
    const render_rendered rendered = {
        .report = &frame->report,
        .choice = request->max_error > 0 && parcel != NULL ? &parcel->choice : NULL,
        .build_ms = parcel != NULL ? parcel->build_ms : 0,
        .trace_ms = frame->trace_ms,
        .write_ms = frame->write_ms};
    // Add it to the totals.
    if (is_written) {
        render_totals_add(&frames->totals, &rendered);
        frames->last = frame->report;
    } else {
        render_totals_add_failed(&frames->totals, frame->number);
    }
    // Decide whether the error ends the run. If not, report it now.
    const bool is_end = !is_written && !render_writer_concerns_one_frame(request, frame, path);
    if (!is_written && !is_end) {
        glint_progress_clear(frames->display);
        glint_say_error(&frame->error);
    }
    // Log the frame.
    const glint_stats_frame facts = {.number = frame->number,
                                     .file = path,
                                     .error = is_written ? NULL : frame->error.message,
                                     .report = rendered.report,
                                     .tree = parcel != NULL ? parcel->tree : NULL,
                                     .choice = rendered.choice,
                                     .build_ms = rendered.build_ms,
                                     .trace_ms = rendered.trace_ms,
                                     .write_ms = rendered.write_ms};
    tell(frames, &facts, is_written ? GLINT_FRAME_RENDERED : GLINT_FRAME_FAILED);
    if (is_end) {
        end_by(frames, &frame->error);
    }
}

bool render_frames_through(render_frames *frames, glint_sequence_frame *frame)
{
    render_parcel *parcel = frame->own;
    char *path = glint_frame_name_make(&frames->request->name, frame->number);
    if (parcel != NULL && parcel->is_standing) {
        judge_standing(frames, frame, path);
    } else {
        judge_written(frames, frame, path);
    }
    free(path);
    render_parcel_free(parcel);
    return frames->failure.code == GLINT_OK;
}

bool render_frames_take_failure(render_frames *frames, glint_error *error)
{
    if (frames->failure.code == GLINT_OK) {
        return false;
    }
    glint_error_free(error);
    *error = frames->failure;
    frames->failure = (glint_error){.code = error->code};
    return true;
}

glint_status render_frames_verdict(const render_frames *frames, glint_error *error)
{
    const render_totals *totals = &frames->totals;
    if (totals->failed == 0) {
        return GLINT_OK;
    }
    char list[GLINT_MESSAGE_CAPACITY / 2];
    glint_frame_list_print(totals->failed_frames, totals->failed_known, list, sizeof list);
    return glint_fail(error, GLINT_FRAMES_FAILED,
                      "%s: %zu of %llu frames failed: %s (mend the cause, then run this again with "
                      "--skip-existing)",
                      frames->request->output, totals->failed, (unsigned long long)frames->count,
                      list);
}

void render_frames_free(render_frames *frames)
{
    glint_stats_log_close(frames->log);
    render_totals_free(&frames->totals);
    glint_error_free(&frames->failure);
    free(frames->damaged.frames);
    *frames = (render_frames){0};
}
