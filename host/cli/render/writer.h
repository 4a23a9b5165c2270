// Writes a rendered frame to its file: name, encoding, metadata, plate and preview.
#ifndef GLINT_CLI_RENDER_WRITER_H
#define GLINT_CLI_RENDER_WRITER_H

#include "cli/render/shot.h"
#include "cli/render/tracer.h"
#include "render/sequence.h"
#include "report/frame/frame_metadata.h"

// The data that travel with a frame to its writer.
typedef struct render_parcel {
    glint_frame_metadata metadata;
    char fingerprint[GLINT_FINGERPRINT_TEXT];
    char *environment;         // name of the environment
    char *plate;               // file of the plate; NULL without a plate
    char *objects, *materials; // manifests; NULL without these layers
    double build_ms;           // milliseconds
    const char *tree;          // render_tracer.tree of this frame
    glint_error_choice choice; // only with --max-error
    // the frame's file exists and is only read; the members about the picture are not set
    bool is_standing;
} render_parcel;

// Packs the metadata of the file as frame->own. Copies everything that the next frame may change.
// frame->own is NULL without memory; the writer reports this. `choice` is NULL without --max-error.
void render_writer_pack(const render_shot *shot, const render_tracer *tracer, double build_ms,
                        const glint_error_choice *choice, glint_sequence_frame *frame);

// Packs a frame whose file exists, so that a writer only reads it to its end. `ms` is the time
// spent on the frame so far. False without memory.
bool render_writer_pack_standing(glint_sequence_frame *frame, double ms);

// Puts the plate behind the frame and writes the file; or reads an existing file and sets
// frame->status to GLINT_BAD_INPUT if it is damaged. Runs on a writer's thread and touches only the
// request and the frame. Writes the preview first, so that an existing frame always has its
// preview.
void render_writer_write(const render_request *request, glint_sequence_frame *frame);

// Compares the fingerprints in the headers of the file and of its preview with `fingerprint`.
// Returns why the frame must be rendered again; NULL if the file matches, provided that it is
// whole.
const char *render_writer_why_again(const render_request *request, int frame, const char *path,
                                    const char *fingerprint);

// True if a failed write says nothing about the next frame. Either the plate is bad, or something
// that cannot be replaced has the name of the file or of the preview. The folder itself must be
// fine.
bool render_writer_concerns_one_frame(const render_request *request,
                                      const glint_sequence_frame *frame, const char *path);

void render_parcel_free(render_parcel *parcel); // accepts NULL

#endif
