// Frames on their way to their files. See render_parcel.h.
#include "cli/render/parcel.h"

#include "cli/render/stage.h"

#include <stdlib.h>
#include <string.h>

// ---- Plates ------------------------------------------------------------------------------------

glint_status render_parcel_find_plate(render_run *run, int frame, glint_error *error)
{
    if (run->request->plate == NULL) {
        return GLINT_OK;
    }
    char *path = glint_frame_name_make(&run->request->plate_name, frame);
    glint_status status = path != NULL ? glint_fingerprint_file(path, &run->plate_is, error)
                                       : glint_fail_memory(error, "a file name");
    free(path);
    return status;
}

static glint_status read_plate(const char *path, int width, int height, glint_image *plate,
                               glint_error *error)
{
    glint_status status = glint_image_read(path, plate, NULL, error);
    if (status == GLINT_OK && (plate->width != width || plate->height != height)) {
        status = glint_fail(
            error, GLINT_BAD_INPUT,
            "%s: the plate has %dx%d pixels, the frame %dx%d (give --size %dx%d, or "
            "another plate)",
            path, plate->width, plate->height, width, height, plate->width, plate->height);
        glint_image_free(plate);
    }
    return status;
}

glint_status render_parcel_check_plate(const render_run *run, int frame, glint_error *error)
{
    const glint_settings *settings = &run->request->inputs.settings;
    glint_image plate = {0};
    if (run->request->plate == NULL) {
        return GLINT_OK;
    }
    char *path = glint_frame_name_make(&run->request->plate_name, frame);
    glint_status status = path != NULL
                              ? read_plate(path, settings->width, settings->height, &plate, error)
                              : glint_fail_memory(error, "a file name");
    glint_image_free(&plate);
    free(path);
    return status;
}

static glint_status put_plate_behind(const render_parcel *parcel, glint_sequence_frame *frame)
{
    glint_image plate = {0};
    glint_status status =
        read_plate(parcel->plate, frame->image.width, frame->image.height, &plate, &frame->error);
    if (status == GLINT_OK) {
        glint_image_put_behind(&frame->image, &plate);
    }
    glint_image_free(&plate);
    return status;
}

// ---- Parcels -----------------------------------------------------------------------------------

void render_parcel_make(render_run *run, glint_sequence_frame *frame)
{
    const render_request *request = run->request;
    const char *environment = run->inputs.environment.name;
    render_parcel *made = calloc(1, sizeof *made);
    frame->own = made;
    if (made != NULL) {
        made->environment = strdup(environment != NULL ? environment : "");
        made->plate = request->plate != NULL
                          ? glint_frame_name_make(&request->plate_name, frame->number)
                          : NULL;
    }
    if (made == NULL || made->environment == NULL ||
        (request->plate != NULL && made->plate == NULL)) {
        render_parcel_free(made);
        frame->own = NULL;
        return;
    }
    const glint_environment lit_by = {.name = made->environment,
                                      .proxy = run->inputs.environment.proxy};
    glint_subject subject = render_run_subject(run);
    subject.scene = &run->label;
    subject.camera = &frame->camera;
    subject.environment = &lit_by;
    made->build_ms = run->build_ms;
    made->tree = run->tree;
    run->tree = "kept";
    glint_frame_metadata_fill(&subject, frame->number, request->exposure,
                              frame->report.kernel_ms + frame->report.readback_ms, &made->metadata);
    if (made->plate != NULL) {
        glint_frame_metadata_add_text(&made->metadata, "glint:plate", made->plate);
    }
    if (request->max_error > 0) {
        made->choice = run->choice;
        glint_frame_metadata_add_real(&made->metadata, "glint:max_error", request->max_error);
        glint_frame_metadata_add_real(&made->metadata, "glint:error", made->choice.error);
        glint_frame_metadata_add_text(&made->metadata, "glint:options", made->choice.rung.options);
    }
    if (request->inputs.kernel_dir == NULL) {
        render_stage_fingerprint(run, &frame->camera, made->fingerprint);
        glint_frame_metadata_add_text(&made->metadata, GLINT_FINGERPRINT_NAME, made->fingerprint);
    }
}

static glint_status write_preview(const render_request *request, const glint_sequence_frame *frame,
                                  glint_error *error)
{
    const render_parcel *parcel = frame->own;
    char *path = glint_frame_name_make(&request->preview_name, frame->number);
    if (path == NULL) {
        return glint_fail_memory(error, "a file name");
    }
    const glint_write_options options = {.exposure = (float)request->exposure,
                                         .metadata = parcel->metadata.entries,
                                         .metadata_count = parcel->metadata.count};
    glint_status status = glint_image_write(path, &frame->image, &options, error);
    free(path);
    return status;
}

void render_parcel_write(void *context, glint_sequence_frame *frame)
{
    const render_run *run = context;
    const render_request *request = run->request;
    const render_parcel *parcel = frame->own;
    char *path = glint_frame_name_make(&request->name, frame->number);
    if (path == NULL || parcel == NULL) {
        frame->status = glint_fail_memory(&frame->error, "what a frame's file says of it");
        free(path);
        return;
    }
    glint_write_options options = render_write_options(request);
    options.metadata = parcel->metadata.entries;
    options.metadata_count = parcel->metadata.count;
    options.channels = frame->layers.channels;
    options.channel_count = frame->layers.count;
    if (parcel->plate != NULL) {
        frame->status = put_plate_behind(parcel, frame);
    }
    if (frame->status == GLINT_OK && request->preview) {
        frame->status = write_preview(request, frame, &frame->error);
    }
    if (frame->status == GLINT_OK) {
        frame->status = glint_image_write(path, &frame->image, &options, &frame->error);
    }
    free(path);
}

void render_parcel_free(render_parcel *parcel)
{
    if (parcel != NULL) {
        free(parcel->environment);
        free(parcel->plate);
        free(parcel);
    }
}
