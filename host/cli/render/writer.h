// From a rendered frame to its file: names, encoding, metadata, plate and preview.
#ifndef GLINT_CLI_RENDER_WRITER_H
#define GLINT_CLI_RENDER_WRITER_H

#include "cli/render/shot.h"
#include "cli/render/tracer.h"
#include "render/sequence.h"
#include "report/frame/frame_metadata.h"

// What goes with a frame to its writer.
typedef struct render_parcel {
    glint_frame_metadata metadata;
    char fingerprint[GLINT_FINGERPRINT_TEXT];
    char *environment;         // its name
    char *plate;               // the file; NULL without one
    char *objects, *materials; // manifests; NULL without these layers
    double build_ms;
    const char *tree;
    glint_error_choice choice; // where --max-error asks for one
    bool is_standing; // the frame's file is there: it is only looked at, and the rest is not set
} render_parcel;

// Packs what the file says of the frame, as frame->own: all that may be others with the next frame
// is copied. NULL where memory is short, which the writer says. `choice`: NULL without --max-error.
void render_writer_pack(const render_shot *shot, const render_tracer *tracer, double build_ms,
                        const glint_error_choice *choice, glint_sequence_frame *frame);

// Packs a frame whose file is there already, as was found in so many milliseconds, and need only be
// read to its end. False without memory.
bool render_writer_pack_standing(glint_sequence_frame *frame, double ms);

// Puts the plate behind and writes the file; or reads the file that is there: then frame->status is
// GLINT_BAD_INPUT where that is damaged. Called on a writer's thread, where only the request and
// the frame are read. The preview comes first, so that a frame that is there has one.
void render_writer_write(const render_request *request, glint_sequence_frame *frame);

// Why the file at `path` is not the frame of that fingerprint, by its header and its preview's;
// NULL where it is, if it is whole.
const char *render_writer_why_again(const render_request *request, int frame, const char *path,
                                    const char *fingerprint);

// Whether a frame that could not be written tells nothing of the next one: its plate is bad; or its
// own name, or its preview's, is taken by something that cannot be replaced, while the folder is as
// it should be.
bool render_writer_concerns_one_frame(const render_request *request,
                                      const glint_sequence_frame *frame, const char *path);

void render_parcel_free(render_parcel *parcel); // NULL is allowed

#endif
