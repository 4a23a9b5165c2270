// What is shown of the work while it goes on, on stderr.
#ifndef GLINT_CLI_PROGRESS_H
#define GLINT_CLI_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

typedef enum glint_progress_mode {
    GLINT_PROGRESS_AUTO,  // a bar when stderr is a terminal, plain lines otherwise
    GLINT_PROGRESS_BAR,   // one line that is redrawn, and erased at the end
    GLINT_PROGRESS_PLAIN, // a line when rendering begins, then one every few seconds
    GLINT_PROGRESS_JSON,  // one JSON object a line
    GLINT_PROGRESS_NONE,
} glint_progress_mode;

#define GLINT_PROGRESS_CHOICES "auto|bar|plain|json|none" // in the order of the modes

// Zero is valid: AUTO before glint_progress_begin.
typedef struct glint_progress_display {
    glint_progress_mode mode; // no longer AUTO once begun
    double begun;             // seconds on the monotonic clock
    double frame_begun;
    double last_shown;
    double total_rays; // primary rays of the frame, for the rate
    bool line_is_drawn;
} glint_progress_display;

void glint_progress_begin(glint_progress_display *display, glint_progress_mode mode);

// The next phase: a JSON name ("load_scene") and what a reader sees ("loading gallery.gltf").
void glint_progress_phase(glint_progress_display *display, const char *name, const char *text);

// The frame begins; `text` says what is rendered, on what.
void glint_progress_frame(glint_progress_display *display, double total_rays, const char *text);

// Share of the frame: done of total, in any unit.
void glint_progress_step(glint_progress_display *display, uint64_t done, uint64_t total);

// Erases the bar: before any other line on stderr, and at the end.
void glint_progress_clear(glint_progress_display *display);

// Milliseconds since the display began.
double glint_progress_elapsed(const glint_progress_display *display);

#endif
