// What is shown of the work while it goes on: on stderr, and to programs on a file descriptor.
#ifndef GLINT_CLI_COMMON_PROGRESS_H
#define GLINT_CLI_COMMON_PROGRESS_H

#include "base/status.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

typedef enum glint_progress_mode {
    GLINT_PROGRESS_AUTO,  // a bar when stderr is a terminal, plain lines otherwise
    GLINT_PROGRESS_BAR,   // one line that is redrawn, and erased at the end
    GLINT_PROGRESS_PLAIN, // a line when rendering begins, then one every few seconds
    GLINT_PROGRESS_JSON,  // one JSON object a line, on stderr or a file descriptor
    GLINT_PROGRESS_NONE,
} glint_progress_mode;

// The modes' words, for a GLINT_OPTION_CHOICE.
#define GLINT_PROGRESS_CHOICES                                                                     \
    GLINT_CHOICES([GLINT_PROGRESS_AUTO] = "auto", [GLINT_PROGRESS_BAR] = "bar",                    \
                  [GLINT_PROGRESS_PLAIN] = "plain", [GLINT_PROGRESS_JSON] = "json",                \
                  [GLINT_PROGRESS_NONE] = "none")

// Zero is valid: AUTO before glint_progress_begin.
typedef struct glint_progress_display {
    glint_progress_mode mode; // no longer AUTO once begun
    FILE *events;             // where JSON goes; NULL: stderr. Owned
    double begun;             // milliseconds on the monotonic clock
    double render_begun;      // of the frame, or of the sequence
    double last_shown;
    double rays;                    // primary rays of a frame, for the rate
    uint64_t frames, past, through; // of a sequence: all, those that need no more tracing, and
                                    // those that are on the disk or failed
    uint64_t traced;                // of `past`, those that were
    uint64_t standing;       // frames with a file at the beginning, which may only be skipped
    uint64_t skipped, again; // of `standing`: those that were, those that were not
    double passing_ms;       // what frames took that were not traced
    bool line_is_drawn;
} glint_progress_display;

void glint_progress_begin(glint_progress_display *display, glint_progress_mode mode);

// Sends the objects of GLINT_PROGRESS_JSON to an open file descriptor in the place of stderr.
// Errors: GLINT_USAGE where it is none, or the mode is another.
glint_status glint_progress_send_to(glint_progress_display *display, int descriptor,
                                    glint_error *error);

// Erases the bar, and closes what glint_progress_send_to opened.
void glint_progress_end(glint_progress_display *display);

// The next phase: a JSON name ("load_scene") and what a reader sees ("loading gallery.gltf").
void glint_progress_phase(glint_progress_display *display, const char *name, const char *text);

// Rendering begins: of one frame, or with `frames` > 0 of a sequence, of as many primary rays each.
// `text` says what is rendered, on what.
void glint_progress_render(glint_progress_display *display, uint64_t frames, double rays,
                           const char *text);

// Share of the frame: done of total, in any unit.
void glint_progress_step(glint_progress_display *display, uint64_t done, uint64_t total);

// Of a sequence, so many frames have a file already. The time left counts those as skipped, and
// once some have been looked at the same share of them.
void glint_progress_standing(glint_progress_display *display, uint64_t frames);

// A sequence's frame needs no more tracing: it has been traced; its file stays, or it failed, and
// so many milliseconds went by.
void glint_progress_traced(glint_progress_display *display);
void glint_progress_skipped(glint_progress_display *display, double ms);
void glint_progress_failed(glint_progress_display *display, double ms);

// A frame's file is not the frame: it will be traced.
void glint_progress_again(glint_progress_display *display);

typedef enum glint_frame_outcome {
    GLINT_FRAME_RENDERED,
    GLINT_FRAME_SKIPPED, // it was there already
    GLINT_FRAME_FAILED,
} glint_frame_outcome;

// "rendered", "skipped" or "failed".
const char *glint_frame_outcome_name(glint_frame_outcome outcome);

// What is shown of a frame that is through.
typedef struct glint_progress_frame {
    int number;
    const char *file;
    glint_frame_outcome outcome;
    double trace_ms, write_ms; // of a rendered one
} glint_progress_frame;

// A sequence's frame is on the disk, or has failed.
void glint_progress_through(glint_progress_display *display, const glint_progress_frame *frame);

// All is through: the last object of JSON. Frames of a sequence by their outcome.
void glint_progress_done(const glint_progress_display *display, uint64_t rendered, uint64_t skipped,
                         uint64_t failed);

// Erases the bar: before any other line on stderr, and at the end.
void glint_progress_clear(glint_progress_display *display);

// Milliseconds since the display began.
double glint_progress_elapsed(const glint_progress_display *display);

#endif
