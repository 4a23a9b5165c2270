// What goes with a frame to its writer, and the writing. For render_run alone.
#ifndef GLINT_CLI_RENDER_PARCEL_H
#define GLINT_CLI_RENDER_PARCEL_H

#include "cli/render/run.h"
#include "render/sequence.h"
#include "report/frame/frame_metadata.h"

typedef struct render_parcel {
    glint_frame_metadata metadata;
    char fingerprint[GLINT_FINGERPRINT_TEXT];
    char *environment; // its name
    char *plate;       // the file; NULL without one
    double build_ms;
    const char *tree;
    glint_error_choice choice; // where --max-error asks for one
} render_parcel;

// Finds the plate of a frame and what it holds (run->plate_is). Errors: GLINT_BAD_INPUT.
glint_status render_parcel_find_plate(render_run *run, int frame, glint_error *error);

// Reads a frame's plate to see whether it serves. Errors: GLINT_BAD_INPUT.
glint_status render_parcel_check_plate(const render_run *run, int frame, glint_error *error);

// As frame->own: all that may be others with the next frame is taken along. NULL where memory is
// short, which the writer says.
void render_parcel_make(render_run *run, glint_sequence_frame *frame);

// Puts the plate behind and writes the file, as `write` of a glint_sequence whose context is a
// render_run: on a writer's thread, where nothing of the run changes and nothing is read that does
// elsewhere. The preview comes first, so that a frame that is there has one.
void render_parcel_write(void *context, glint_sequence_frame *frame);

void render_parcel_free(render_parcel *parcel); // NULL is allowed

#endif
