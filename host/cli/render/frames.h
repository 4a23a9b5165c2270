// Chooses the next frame of a run and records the outcome of each frame.
#ifndef GLINT_CLI_RENDER_FRAMES_H
#define GLINT_CLI_RENDER_FRAMES_H

#include "cli/common/progress.h"
#include "cli/render/request.h"
#include "cli/render/totals.h"
#include "cli/render/writer.h"
#include "render/sequence.h"
#include "report/frame/stats.h"

// Frames with damaged files; they are rendered at the end. Zero is valid and empty.
typedef struct render_damaged {
    int *frames; // owned
    size_t count, capacity;
} render_damaged;

// The state of the frames. Zero is valid: no frames.
typedef struct render_frames {
    const render_request *request;   // borrowed
    glint_progress_display *display; // borrowed
    glint_frame_cursor cursor;
    uint64_t count;   // number of frames in this run's shard
    size_t looked_at; // frames whose existing files the writers are reading
    render_damaged damaged;
    render_totals totals;
    glint_stats_log *log;    // of --stats for a sequence. Owned; closed after a failed write
    glint_frame_report last; // the last rendered frame
    glint_error failure;     // the error that ended the run early; code 0 if there is none
} render_frames;

// Starts with the frames of the request's shard. The request must be settled
// (render_request_settle).
void render_frames_begin(render_frames *frames, const render_request *request,
                         glint_progress_display *display);

// The number of frames that have a file, which --skip-existing may keep; 0 without --skip-existing.
uint64_t render_frames_standing(const render_frames *frames);

// Sets the next frame. *is_again means that its file was found damaged. Returns GLINT_NEXT_WAIT
// while writers still read existing files.
glint_sequence_next render_frames_next(render_frames *frames, int *frame, bool *is_again);

// Reports that an existing file will be rendered again, and the reason.
void render_frames_say_again(render_frames *frames, const char *path, const char *why);

// Records a frame that could not be rendered: its scene is bad, or the device failed, which ends
// the run. `ms` is the time spent on the frame. Takes over the error.
void render_frames_miss(render_frames *frames, int frame, const char *path, double ms,
                        glint_error *error);

// Records a frame that returns from its writer: written, failed, or an existing file that was read.
// Returns false if the run must end.
bool render_frames_through(render_frames *frames, glint_sequence_frame *frame);

// Moves the error that ended the run to `error`. Returns false if there is none.
bool render_frames_take_failure(render_frames *frames, glint_error *error);

// GLINT_FRAMES_FAILED with the list of failed frames, if any frame failed.
glint_status render_frames_verdict(const render_frames *frames, glint_error *error);

void render_frames_free(render_frames *frames);

#endif
