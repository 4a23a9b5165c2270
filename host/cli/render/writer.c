// Writes frames to their files. See writer.h.
#include "cli/render/writer.h"

#include "cli/render/plate.h"
#include "image/output_file.h"
#include "report/frame/manifest.h"

#include <stdlib.h>
#include <string.h>

// ---- Packing -----------------------------------------------------------------------------------

// Lists the objects and materials for the layers that need them. False without memory.
static bool add_manifests(const render_shot *shot, render_parcel *made)
{
    const glint_scene *scene = &shot->stage.inputs.scene;
    const uint32_t aovs = shot->request->inputs.settings.aovs;
    if ((aovs & GLINT_AOV_BIT(GLINT_AOV_OBJECT)) != 0 &&
        glint_manifest_of_objects(scene, &made->objects, NULL) != GLINT_OK) {
        return false;
    }
    return (aovs & GLINT_AOV_BIT(GLINT_AOV_MATERIAL)) == 0 ||
           glint_manifest_of_materials(scene, &made->materials, NULL) == GLINT_OK;
}

static render_parcel *make_parcel(const render_shot *shot, int frame)
{
    const char *environment = shot->stage.inputs.environment.name;
    const bool has_plate = shot->request->plate != NULL;
    render_parcel *made = calloc(1, sizeof *made);
    if (made != NULL) {
        made->environment = strdup(environment != NULL ? environment : "");
        made->plate = has_plate ? glint_frame_name_make(&shot->request->plate_name, frame) : NULL;
        if (made->environment == NULL || (has_plate && made->plate == NULL) ||
            !add_manifests(shot, made)) {
            render_parcel_free(made);
            return NULL;
        }
    }
    return made;
}

static void fill_metadata(const render_shot *shot, const render_tracer *tracer,
                          const glint_sequence_frame *frame, render_parcel *made)
{
    const render_request *request = shot->request;
    glint_frame_metadata *metadata = &made->metadata;
    const glint_scene label = {.path = shot->stage.path};
    const glint_environment lit_by = {.name = made->environment,
                                      .proxy = shot->stage.inputs.environment.proxy};
    glint_subject subject = render_tracer_subject(tracer, shot);
    subject.scene = &label;
    subject.camera = &frame->camera;
    subject.environment = &lit_by;
    glint_frame_metadata_fill(&subject, frame->number, request->exposure,
                              frame->report.kernel_ms + frame->report.readback_ms, metadata);
    const glint_tone tone = render_write_options(request).tone;
    if (tone != GLINT_TONE_NONE) {
        glint_frame_metadata_add_text(metadata, "glint:tone", glint_tone_names[tone]);
    }
    if (made->plate != NULL) {
        glint_frame_metadata_add_text(metadata, "glint:plate", made->plate);
    }
    glint_frame_metadata_add_text(metadata, GLINT_MANIFEST_OBJECTS, made->objects);
    glint_frame_metadata_add_text(metadata, GLINT_MANIFEST_MATERIALS, made->materials);
    if (request->max_error > 0) {
        glint_frame_metadata_add_real(metadata, "glint:max_error", request->max_error);
        glint_frame_metadata_add_real(metadata, "glint:error", made->choice.error);
        glint_frame_metadata_add_text(metadata, "glint:options", made->choice.rung.options);
    }
    if (request->inputs.kernel_dir == NULL) {
        render_shot_fingerprint(shot, &frame->camera, made->fingerprint);
        glint_frame_metadata_add_text(metadata, GLINT_FINGERPRINT_NAME, made->fingerprint);
    }
}

void render_writer_pack(const render_shot *shot, const render_tracer *tracer, double build_ms,
                        const glint_error_choice *choice, glint_sequence_frame *frame)
{
    render_parcel *made = make_parcel(shot, frame->number);
    frame->own = made;
    if (made != NULL) {
        made->build_ms = build_ms;
        made->tree = tracer->tree;
        made->choice = choice != NULL ? *choice : (glint_error_choice){0};
        fill_metadata(shot, tracer, frame, made);
    }
}

bool render_writer_pack_standing(glint_sequence_frame *frame, double ms)
{
    render_parcel *made = calloc(1, sizeof *made);
    frame->own = made;
    if (made != NULL) {
        made->is_standing = true;
        made->build_ms = ms;
    }
    return made != NULL;
}

void render_parcel_free(render_parcel *parcel)
{
    if (parcel != NULL) {
        free(parcel->environment);
        free(parcel->plate);
        free(parcel->objects);
        free(parcel->materials);
        free(parcel);
    }
}

// ---- Writing -----------------------------------------------------------------------------------

static glint_status write_preview(const render_request *request, const glint_sequence_frame *frame,
                                  glint_error *error)
{
    const render_parcel *parcel = frame->own;
    char *path = glint_frame_name_make(&request->preview_name, frame->number);
    if (path == NULL) {
        return glint_fail_memory(error, "a file name");
    }
    const glint_write_options options = {.exposure = (float)request->exposure,
                                         .tone = request->tone,
                                         .metadata = parcel->metadata.entries,
                                         .metadata_count = parcel->metadata.count};
    glint_status status = glint_image_write(path, &frame->image, &options, error);
    free(path);
    return status;
}

static glint_status write_frame(const render_request *request, const char *path,
                                glint_sequence_frame *frame, glint_error *error)
{
    const render_parcel *parcel = frame->own;
    glint_write_options options = render_write_options(request);
    options.metadata = parcel->metadata.entries;
    options.metadata_count = parcel->metadata.count;
    options.channels = frame->layers.channels;
    options.channel_count = frame->layers.count;
    if (parcel->plate != NULL) {
        TRY(render_plate_put_behind(parcel->plate, &frame->image, error));
    }
    if (request->preview) {
        TRY(write_preview(request, frame, error));
    }
    return glint_image_write(path, &frame->image, &options, error);
}

static glint_status read_whole(const char *path, glint_error *error)
{
    glint_image image = {0};
    glint_status status = glint_image_read(path, &image, NULL, error);
    glint_image_free(&image);
    return status;
}

void render_writer_write(const render_request *request, glint_sequence_frame *frame)
{
    const render_parcel *parcel = frame->own;
    char *path = glint_frame_name_make(&request->name, frame->number);
    if (path == NULL || parcel == NULL) {
        frame->status = glint_fail_memory(&frame->error, "what a frame's file says of it");
    } else if (parcel->is_standing) {
        frame->status = read_whole(path, &frame->error);
    } else {
        frame->status = write_frame(request, path, frame, &frame->error);
    }
    free(path);
}

// ---- Files that are there ----------------------------------------------------------------------

const char *render_writer_why_again(const render_request *request, int frame, const char *path,
                                    const char *fingerprint)
{
    char found[GLINT_FINGERPRINT_TEXT];
    glint_fingerprint_find(path, found);
    if (found[0] == '\0') {
        return "it does not say how it was made";
    }
    if (strcmp(fingerprint, found) != 0) {
        return "made from another scene, environment or settings, or by another version";
    }
    if (request->preview) {
        char *preview = glint_frame_name_make(&request->preview_name, frame);
        found[0] = '\0';
        if (preview != NULL) {
            glint_fingerprint_find(preview, found);
        }
        free(preview);
        if (strcmp(fingerprint, found) != 0) {
            return "its preview is missing, or another's";
        }
    }
    return NULL;
}

bool render_writer_concerns_one_frame(const render_request *request,
                                      const glint_sequence_frame *frame, const char *path)
{
    if (!request->is_sequence || path == NULL ||
        glint_output_file_check_folder(path, NULL) != GLINT_OK) {
        return false;
    }
    if (frame->status == GLINT_BAD_INPUT) {
        return true;
    }
    char *preview =
        request->preview ? glint_frame_name_make(&request->preview_name, frame->number) : NULL;
    const bool is_taken = glint_output_file_check(path, NULL) != GLINT_OK ||
                          (preview != NULL && glint_output_file_check(preview, NULL) != GLINT_OK);
    free(preview);
    return is_taken;
}
