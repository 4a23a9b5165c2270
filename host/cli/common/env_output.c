// Writes environments as one picture or as six faces. See env_output.h.
#include "cli/common/env_output.h"

#include "cli/common/file_names.h"
#include "cli/common/output_folder.h"
#include "image/image_io.h"
#include "image/output_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define HALF_MAX 65504.0f

// ---- Names --------------------------------------------------------------------------------------

bool env_output_is_set(const char *path)
{
    struct stat facts;
    return stat(path, &facts) == 0 ? S_ISDIR(facts.st_mode) : strstr(path, "%s") != NULL;
}

char *env_output_face_path(const char *output, int k)
{
    static const char *const names[6] = {"posx", "negx", "posy", "negy", "posz", "negz"};
    const char *gap = strstr(output, "%s");
    const size_t capacity = strlen(output) + 16;
    char *path = malloc(capacity);
    if (path != NULL && gap != NULL) {
        snprintf(path, capacity, "%.*s%s%s", (int)(gap - output), output, names[k], gap + 2);
    } else if (path != NULL) {
        snprintf(path, capacity, "%s/%s.exr", output, names[k]);
    }
    return path;
}

static glint_status check_face(const char *output, int k, bool is_there,
                               const glint_write_options *options, glint_error *error)
{
    char *path = env_output_face_path(output, k);
    if (path == NULL) {
        return glint_fail_memory(error, "a file name");
    }
    glint_status status;
    TRY_OR(cleanup, status, glint_image_check_output(path, options, error));
    if (is_there) {
        status = glint_output_file_check(path, error);
    }
cleanup:
    free(path);
    return status;
}

static glint_status check_faces(const char *output, const glint_write_options *options,
                                glint_error *error)
{
    const bool is_there = env_output_is_set(output);
    const char *gap = strstr(output, "%s");
    if (gap != NULL && strstr(gap + 2, "%s") != NULL) {
        return glint_fail(error, GLINT_USAGE, "%s: a pattern holds %%s once, for the face's name",
                          output);
    }
    if (!is_there && glint_image_can_write(output)) {
        return glint_fail(error, GLINT_USAGE,
                          "%s: one file's name, where six are written (name a folder or a pattern "
                          "with %%s, or another layout: --to)",
                          output);
    }
    if (!is_there) {
        TRY(glint_folder_check(output, error));
    }
    for (int k = 0; k < 6; k++) {
        TRY(check_face(output, k, is_there, options, error));
    }
    return GLINT_OK;
}

// ---- Pictures -----------------------------------------------------------------------------------

// OpenEXR's envmap attribute means that the outermost texel centres lie on the edges. glint writes
// the attribute if OpenEXR has one for the layout.
static glint_envmap envmap_of(const char *path, glint_layout layout)
{
    return !glint_has_extension(path, ".exr") ? GLINT_ENVMAP_NONE
           : layout == GLINT_LAYOUT_CUBE      ? GLINT_ENVMAP_CUBE
           : layout == GLINT_LAYOUT_LATLONG   ? GLINT_ENVMAP_LATLONG
                                              : GLINT_ENVMAP_NONE;
}

// Without --to, the layout of the source. The six faces of a DDS are one file: they become a strip.
static glint_layout layout_to_write(const env_output *output, glint_layout from)
{
    const glint_layout asked = output->request->to;
    return output->as_faces                ? GLINT_LAYOUT_FACES
           : asked != GLINT_LAYOUT_UNKNOWN ? asked
           : from == GLINT_LAYOUT_FACES    ? GLINT_LAYOUT_VSTRIP
                                           : from;
}

static glint_status choose_chart(env_output *output, const glint_chart *from, glint_error *error)
{
    const glint_layout to = layout_to_write(output, from->layout);
    const bool on_edges = envmap_of(output->path, to) != GLINT_ENVMAP_NONE;
    int size = output->request->size;
    if (size == 0) {
        size = glint_chart_size_for(to, glint_chart_quarter_turn(from));
        size = on_edges && size < 2 ? 2 : size;
    }
    return glint_chart_make(to, size, on_edges, &output->chart, error);
}

// Checks the size as far as possible before the input has been read.
static glint_status check_size(const env_output *output, glint_error *error)
{
    glint_chart chart;
    const glint_layout to = layout_to_write(output, GLINT_LAYOUT_UNKNOWN);
    const bool on_edges = envmap_of(output->path, to) != GLINT_ENVMAP_NONE;
    return to == GLINT_LAYOUT_UNKNOWN || output->request->size == 0
               ? GLINT_OK
               : glint_chart_make(to, output->request->size, on_edges, &chart, error);
}

glint_status env_output_open(const env_output_request *request, const char *path,
                             glint_layout source, env_output *output, glint_error *error)
{
    const glint_write_options options = {.compression = request->compression};
    const bool is_set = env_output_is_set(path);
    *output = (env_output){.request = request, .path = path};
    output->as_faces =
        request->to == GLINT_LAYOUT_FACES ||
        (request->to == GLINT_LAYOUT_UNKNOWN && (is_set || source == GLINT_LAYOUT_FACES));
    if (output->as_faces) {
        TRY(check_faces(path, &options, error));
        return check_size(output, error);
    }
    if (is_set) {
        return glint_fail(error, GLINT_USAGE,
                          "%s: a %s is for six faces (with --to faces; the layout %s is one file)",
                          path, strstr(path, "%s") != NULL ? "pattern" : "folder",
                          glint_layout_name(request->to));
    }
    TRY(glint_image_check_output(path, &options, error));
    TRY(glint_output_file_check(path, error));
    return check_size(output, error);
}

static glint_write_options write_options(const env_output *output, const glint_image *image)
{
    const size_t values = (size_t)image->width * (size_t)image->height * (size_t)image->channels;
    bool fits = true; // half floats can hold all values
    for (size_t i = 0; i < values && fits; i++) {
        fits = image->pixels[i] <= HALF_MAX;
    }
    return (glint_write_options){.exr_float = !fits,
                                 .compression = output->request->compression,
                                 .exposure = (float)output->request->exposure,
                                 .envmap = envmap_of(output->path, output->chart.layout)};
}

// Copies face k out of the strip; k counts as in env_output_face_path.
static glint_status cut_face(const glint_image *strip, int k, glint_image *face, glint_error *error)
{
    const int edge = strip->width;
    const size_t values = (size_t)edge * (size_t)edge * (size_t)strip->channels;
    TRY(glint_image_create(edge, edge, strip->channels, face, error));
    memcpy(face->pixels, strip->pixels + (size_t)k * values, values * sizeof *face->pixels);
    return GLINT_OK;
}

static glint_status write_face(const env_output *output, const glint_image *strip, int k,
                               const glint_write_options *options, glint_error *error)
{
    glint_image face = {0};
    char *path = env_output_face_path(output->path, k);
    if (path == NULL) {
        return glint_fail_memory(error, "a file name");
    }
    glint_status status;
    TRY_OR(cleanup, status, cut_face(strip, k, &face, error));
    status = glint_image_write(path, &face, options, error);
cleanup:
    glint_image_free(&face);
    free(path);
    return status;
}

static glint_status write_faces(const env_output *output, const glint_image *strip,
                                const glint_write_options *options, glint_error *error)
{
    if (strstr(output->path, "%s") == NULL) {
        TRY(glint_folder_make(output->path, NULL, error));
    }
    for (int k = 0; k < 6; k++) {
        TRY(write_face(output, strip, k, options, error));
    }
    return GLINT_OK;
}

glint_status env_output_write(env_output *output, const glint_sampler *from, const glint_turn *turn,
                              glint_error *error)
{
    glint_image image = {0};
    TRY(choose_chart(output, &from->chart, error));
    TRY(glint_resample(from, turn, &output->chart, &image, error));
    const glint_write_options options = write_options(output, &image);
    const glint_status status = output->as_faces
                                    ? write_faces(output, &image, &options, error)
                                    : glint_image_write(output->path, &image, &options, error);
    glint_image_free(&image);
    return status;
}
