// Frames one after the other: while the device traces one, threads of their own write those before.
#ifndef GLINT_RENDER_SEQUENCE_H
#define GLINT_RENDER_SEQUENCE_H

#include "base/status.h"
#include "image/image.h"
#include "render/frame.h"
#include "render/layers.h"
#include "scene/camera.h"

#include <stdbool.h>
#include <stddef.h>

// A frame on its way from `next` by way of `write` to `done`.
typedef struct glint_sequence_frame {
    int number;
    glint_camera camera; // set by `next`
    glint_image image;
    glint_layers layers; // where they are asked for
    glint_frame_report report;
    double trace_ms; // from the first launch until the pixels were read back
    double write_ms;
    glint_status status; // of `write`
    glint_error error;   // where that is not GLINT_OK
    void *own;           // the caller's: set by `next` or `traced`, released by `done`
} glint_sequence_frame;

// What `next` has to say.
typedef enum glint_sequence_next {
    GLINT_NEXT_FRAME,
    GLINT_NEXT_TRACED, // this one needs no tracing, and goes to `write` at once
    GLINT_NEXT_AGAIN,  // this one needs nothing: ask once more, after a look at the others
    GLINT_NEXT_WAIT,   // a frame that is being written may bring another: ask again after that
    GLINT_NEXT_NONE,
} glint_sequence_next;

typedef struct glint_sequence {
    glint_renderer *renderer;
    bool with_layers; // the renderer's settings ask for some
    size_t writers;   // threads that write; at least 1
    // Renders frame->image, with its report; NULL: the renderer does.
    glint_status (*render)(void *context, glint_sequence_frame *frame,
                           const glint_progress *progress, glint_error *error);
    // Sets the next frame's number and camera, if there is one.
    glint_sequence_next (*next)(void *context, glint_sequence_frame *frame);
    // A frame has been traced, and is about to be queued.
    void (*traced)(void *context, glint_sequence_frame *frame);
    // Brings a frame to where it belongs. Called from the writing threads, for several frames at
    // once. An error of this one frame goes into frame->status and frame->error.
    void (*write)(void *context, glint_sequence_frame *frame);
    // A frame is through, well or not; frames may overtake each other. False: no further one.
    bool (*done)(void *context, glint_sequence_frame *frame);
    glint_progress
        progress;  // within a frame; see frame.h. Also called while writers are waited for
    void *context; // of all but progress
} glint_sequence;

// How many writers keep up with the device: one for each core, but no more than keep the frames in
// flight, of `frame_bytes` each, within a gigabyte, and one at least.
size_t glint_sequence_writers(double frame_bytes);

// Runs until `next` has no more, until `done` or `progress` asks for an end, or until the device
// fails; what has been traced by then is written all the same. All but `write` is called on the
// caller's thread. No more than writers + 2 frames are held at once. Errors: GLINT_INTERRUPTED
// where `progress` asked for the end, GLINT_DEVICE_FAILED. An end by `done` is GLINT_OK: the caller
// knows.
glint_status glint_sequence_run(const glint_sequence *sequence, glint_error *error);

#endif
