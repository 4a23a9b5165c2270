// Shows the progress of the work on stderr, or reports it to a program on a file descriptor.
#ifndef GLINT_CLI_COMMON_PROGRESS_H
#define GLINT_CLI_COMMON_PROGRESS_H

#include "base/status.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

typedef enum glint_progress_mode {
    GLINT_PROGRESS_AUTO,  // a bar when stderr is a terminal, plain lines otherwise
    GLINT_PROGRESS_BAR,   // one line that is redrawn, then erased at the end
    GLINT_PROGRESS_PLAIN, // a line when rendering begins, then a line every few seconds
    GLINT_PROGRESS_JSON,  // one JSON object per line, on stderr or a file descriptor
    GLINT_PROGRESS_NONE,
} glint_progress_mode;

// The names of the modes, for a GLINT_OPTION_CHOICE.
#define GLINT_PROGRESS_CHOICES                                                                     \
    GLINT_CHOICES([GLINT_PROGRESS_AUTO] = "auto", [GLINT_PROGRESS_BAR] = "bar",                    \
                  [GLINT_PROGRESS_PLAIN] = "plain", [GLINT_PROGRESS_JSON] = "json",                \
                  [GLINT_PROGRESS_NONE] = "none")

// Zero is valid: AUTO before glint_progress_begin.
typedef struct glint_progress_display {
    glint_progress_mode mode; // not AUTO any more after glint_progress_begin
    FILE *events;             // destination of JSON; NULL: stderr. Owned
    double begun;             // milliseconds on the monotonic clock
    double render_begun;      // start of the frame or sequence, on the same clock
    double last_shown;
    double rays; // primary rays per frame, for the ray rate
    // frames of a sequence: `frames` is their total; `past` need no more tracing; `through` are on
    // the disk or failed
    uint64_t frames, past, through;
    uint64_t traced; // the frames of `past` that were traced
    // frames that had a file at the start; --skip-existing may skip them
    uint64_t standing;
    // frames of `standing` that have been checked: skipped, or to be rendered again
    uint64_t skipped, again;
    double passing_ms; // milliseconds spent on skipped or failed frames
    bool line_is_drawn;
} glint_progress_display;

// Starts the clock, and replaces AUTO by the mode that fits stderr.
void glint_progress_begin(glint_progress_display *display, glint_progress_mode mode);

// Sends the objects of GLINT_PROGRESS_JSON to an open file descriptor instead of stderr. Errors:
// GLINT_USAGE if the descriptor is not open or the mode is not JSON.
glint_status glint_progress_send_to(glint_progress_display *display, int descriptor,
                                    glint_error *error);

// Erases the bar, and closes the stream of glint_progress_send_to.
void glint_progress_end(glint_progress_display *display);

// Begins a phase. `name` is for JSON ("load_scene"), `text` for readers ("loading gallery.gltf").
void glint_progress_phase(glint_progress_display *display, const char *name, const char *text);

// Begins rendering one frame (`frames` = 0) or a sequence of `frames` frames, with `rays` primary
// rays per frame. `text` names the scene and the device.
void glint_progress_render(glint_progress_display *display, uint64_t frames, double rays,
                           const char *text);

// Reports the progress of the current frame as `done` of `total`, in any unit.
void glint_progress_step(glint_progress_display *display, uint64_t done, uint64_t total);

// Reports how many frames of a sequence have a file already. At first the estimate of the time left
// counts them as skipped. Later it uses the share that was skipped so far.
void glint_progress_standing(glint_progress_display *display, uint64_t frames);

// Reports a frame of a sequence that needs no more tracing: it was traced, its file stays, or it
// failed. `ms` is the time spent on a frame that was not traced.
void glint_progress_traced(glint_progress_display *display);
void glint_progress_skipped(glint_progress_display *display, double ms);
void glint_progress_failed(glint_progress_display *display, double ms);

// Reports that a frame's existing file does not match: the frame will be traced.
void glint_progress_again(glint_progress_display *display);

typedef enum glint_frame_outcome {
    GLINT_FRAME_RENDERED,
    GLINT_FRAME_SKIPPED, // its file was there already
    GLINT_FRAME_FAILED,
} glint_frame_outcome;

// "rendered", "skipped" or "failed".
const char *glint_frame_outcome_name(glint_frame_outcome outcome);

// A finished frame, as the display shows it.
typedef struct glint_progress_frame {
    int number;
    const char *file;
    glint_frame_outcome outcome;
    double trace_ms, write_ms; // only of a rendered frame
} glint_progress_frame;

// Reports that a frame of a sequence is on the disk, or has failed.
void glint_progress_through(glint_progress_display *display, const glint_progress_frame *frame);

// Writes the last JSON object, with the numbers of frames by outcome.
void glint_progress_done(const glint_progress_display *display, uint64_t rendered, uint64_t skipped,
                         uint64_t failed);

// Erases the bar. Call it before any other line goes to stderr, and at the end.
void glint_progress_clear(glint_progress_display *display);

// Milliseconds since the display began.
double glint_progress_elapsed(const glint_progress_display *display);

#endif
