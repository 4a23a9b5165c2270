// Renders a sequence of frames: while the device traces a frame, other threads write earlier
// frames.
#ifndef GLINT_RENDER_SEQUENCE_H
#define GLINT_RENDER_SEQUENCE_H

#include "base/status.h"
#include "image/image.h"
#include "render/frame.h"
#include "render/layers.h"
#include "scene/camera.h"

#include <stdbool.h>
#include <stddef.h>

// A frame on its way from `next` through `write` to `done`.
typedef struct glint_sequence_frame {
    int number;
    glint_camera camera; // set by `next`
    glint_image image;
    glint_layers layers; // if the settings ask for layers
    glint_frame_report report;
    double trace_ms; // from the first launch to the end of the read-back
    double write_ms;
    glint_status status; // status of `write`
    glint_error error;   // set if `status` is not GLINT_OK
    void *own;           // data of the caller: set by `next` or `traced`, released by `done`
} glint_sequence_frame;

// The answers of `next`.
typedef enum glint_sequence_next {
    GLINT_NEXT_FRAME,
    GLINT_NEXT_TRACED, // this frame needs no tracing and goes to `write` at once
    GLINT_NEXT_AGAIN,  // this frame needs nothing: ask again after collecting finished frames
    GLINT_NEXT_WAIT,   // a frame that is being written may lead to another: ask again afterwards
    GLINT_NEXT_NONE,
} glint_sequence_next;

typedef struct glint_sequence {
    glint_renderer *renderer;
    bool with_layers; // the renderer's settings ask for layers
    size_t writers;   // number of writer threads; at least 1
    // Renders frame->image and its report; NULL: the renderer does it.
    glint_status (*render)(void *context, glint_sequence_frame *frame,
                           const glint_progress *progress, glint_error *error);
    // Sets number and camera of the next frame, if there is one.
    glint_sequence_next (*next)(void *context, glint_sequence_frame *frame);
    // Called when a frame has been traced, before it is queued.
    void (*traced)(void *context, glint_sequence_frame *frame);
    // Writes a frame. Called from the writer threads, for several frames at once. An error of this
    // frame goes into frame->status and frame->error.
    void (*write)(void *context, glint_sequence_frame *frame);
    // Called when a frame is finished, with or without an error; frames may overtake each other.
    // Returns false to stop the sequence.
    bool (*done)(void *context, glint_sequence_frame *frame);
    // Progress within a frame; see frame.h. Also called while waiting for writers.
    glint_progress progress;
    void *context; // context of all callbacks except progress
} glint_sequence;

// The number of writers that keep up with the device: one per core, at least one. The frames in
// flight, of `frame_bytes` each, stay within a gigabyte.
size_t glint_sequence_writers(double frame_bytes);

// Runs until `next` has no more frames, `done` or `progress` stops it, or the device fails. Frames
// traced by then are still written. All callbacks except `write` run on the caller's thread. At
// most writers + 2 frames are held at once. Errors: GLINT_INTERRUPTED if `progress` stopped it,
// GLINT_DEVICE_FAILED. A stop by `done` returns GLINT_OK, because the caller knows.
glint_status glint_sequence_run(const glint_sequence *sequence, glint_error *error);

#endif
