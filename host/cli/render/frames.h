// The frames of a run: which are next, and what became of each.
#ifndef GLINT_CLI_RENDER_FRAMES_H
#define GLINT_CLI_RENDER_FRAMES_H

#include "cli/common/progress.h"
#include "cli/render/request.h"
#include "cli/render/totals.h"
#include "cli/render/writer.h"
#include "render/sequence.h"
#include "report/frame/stats.h"

// Frames whose files were found to be damaged, to be rendered at the end. Zero is valid and empty.
typedef struct render_damaged {
    int *frames; // owned
    size_t count, capacity;
} render_damaged;

// Zero is valid: no frames.
typedef struct render_frames {
    const render_request *request;   // borrowed
    glint_progress_display *display; // borrowed
    glint_frame_cursor cursor;
    uint64_t count;   // of this run's shard
    size_t looked_at; // frames whose files are being read
    render_damaged damaged;
    render_totals totals;
    glint_stats_log *log;    // of a sequence, with --stats. Owned; closed when it cannot be written
    glint_frame_report last; // of the last frame that was rendered
    glint_error failure;     // what ended the run before its time; its code is 0 where nothing did
} render_frames;

// Once the request is settled: the frames of its shard.
void render_frames_begin(render_frames *frames, const render_request *request,
                         glint_progress_display *display);

// How many frames have a file, which --skip-existing may leave as it is; 0 without.
uint64_t render_frames_standing(const render_frames *frames);

// The next frame. *is_again: its file was found to be damaged. GLINT_NEXT_WAIT while files are
// read.
glint_sequence_next render_frames_next(render_frames *frames, int *frame, bool *is_again);

// A frame whose file will be rendered again, for a reason.
void render_frames_say_again(render_frames *frames, const char *path, const char *why);

// A frame that cannot be rendered, as its scene at its time is bad, or as the device failed, which
// is the end. `ms`: what it took to find out. Takes the error.
void render_frames_miss(render_frames *frames, int frame, const char *path, double ms,
                        glint_error *error);

// A frame has come from its writer: it was written or not, or its file was read. False: no further
// one.
bool render_frames_through(render_frames *frames, glint_sequence_frame *frame);

// Takes what ended the run, if anything did. False: nothing.
bool render_frames_take_failure(render_frames *frames, glint_error *error);

// As GLINT_FRAMES_FAILED, with their names, if any frame failed.
glint_status render_frames_verdict(const render_frames *frames, glint_error *error);

void render_frames_free(render_frames *frames);

#endif
