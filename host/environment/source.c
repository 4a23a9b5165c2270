// Loads an environment's picture. See source.h.
//
// The alpha channel is not used: colours stay multiplied by alpha.
#include "environment/source.h"

#include "environment/face_files.h"
#include "environment/radiance.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>
#include <sys/stat.h>

// ---- One file -----------------------------------------------------------------------------------

static const glint_layout_request nothing_known = {0};

static void mend(const char *name, glint_source *source, glint_warnings *warnings)
{
    source->mended_texels = glint_radiance_mend(name, &source->image, warnings);
    source->is_warned |= source->mended_texels > 0;
}

glint_status glint_source_take(const glint_image_file *file, const glint_layout_request *request,
                               glint_source *source, glint_warnings *warnings, glint_error *error)
{
    *source = (glint_source){.image = file->image, .facts = file->facts};
    glint_recognised what;
    const glint_status status =
        glint_layout_recognise(file, request != NULL ? request : &nothing_known, &what, error);
    if (status != GLINT_OK) {
        glint_source_free(source);
        return status;
    }
    const glint_image *taken = &source->image;
    if (what.chart.layout == GLINT_LAYOUT_LATLONG && taken->width != 2 * taken->height) {
        source->is_warned = true;
        glint_warn(warnings, "%s: %d × %d pixels are not 2:1: stretched over the whole sphere",
                   file->name, taken->width, taken->height);
    }
    source->chart = what.chart;
    source->reason = what.reason;
    mend(file->name, source, warnings);
    return GLINT_OK;
}

// Leaves a file of faces in `stored`. False if it is another file, or if it cannot be used.
static bool leave_stored(const char *path, const glint_layout_request *request,
                         const glint_stored *stored, glint_source *source)
{
    const glint_stored_facts *facts = &stored->facts;
    // Codes are always radiance, so nothing needs mending, except after an odd power.
    if (facts->code_bits == 0 || facts->transfer == GLINT_TRANSFER_POWER ||
        facts->orientation > 1) {
        return false;
    }
    const glint_image_file file = {
        path, {facts->width, facts->height, facts->channels, NULL}, glint_image_facts_of(stored)};
    glint_recognised what;
    if (glint_layout_recognise(&file, request, &what, NULL) != GLINT_OK || what.chart.on_edges ||
        glint_layout_cells(what.chart.layout, NULL, NULL) == NULL) {
        return false;
    }
    *source = (glint_source){.image = file.image,
                             .stored = *stored,
                             .facts = file.facts,
                             .chart = what.chart,
                             .reason = what.reason};
    return true;
}

static glint_status open_file(const char *path, const glint_layout_request *request,
                              glint_source *source, glint_warnings *warnings, glint_error *error)
{
    glint_image_file file = {.name = path};
    glint_stored stored;
    TRY(glint_image_read_stored(path, &stored, error));
    if (leave_stored(path, request, &stored, source)) {
        return GLINT_OK;
    }
    file.facts = glint_image_facts_of(&stored);
    const glint_status status = glint_stored_develop(&stored, &file.image, error);
    glint_stored_free(&stored);
    TRY(status);
    return glint_source_take(&file, request, source, warnings, error);
}

// ---- Six files ----------------------------------------------------------------------------------

static glint_status check_face(const glint_face_files *files, int face, const glint_image *image,
                               int edge, glint_error *error)
{
    const char *path = files->paths[face];
    if (image->width != image->height) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: %d × %d pixels, where a face is square (crop it)", path,
                          image->width, image->height);
    }
    if (image->width != edge) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: %d pixels an edge, where %s has %d (make the six alike)", path,
                          image->width, files->paths[0], edge);
    }
    if (edge > GLINT_FACE_EDGE_MAX) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: %d pixels an edge, where %d is the most (make the six smaller)",
                          path, edge, GLINT_FACE_EDGE_MAX);
    }
    return GLINT_OK;
}

// Reads a face and copies it to its place in the strip. The first face creates the strip.
static glint_status read_face(const glint_face_files *files, int face, glint_source *source,
                              glint_error *error)
{
    glint_image *strip = &source->image;
    glint_image image = {0};
    glint_image_facts facts;
    TRY(glint_image_read(files->paths[face], &image, &facts, error));
    source->facts.code_bits = facts.code_bits != 0 ? facts.code_bits : source->facts.code_bits;
    const int edge = face == 0 ? image.width : strip->width;
    glint_status status;
    TRY_OR(cleanup, status, check_face(files, face, &image, edge, error));
    if (face == 0) {
        TRY_OR(cleanup, status, glint_image_reuse(edge, 6 * edge, 3, strip, error));
    }
    const int step = image.channels >= 3;
    const size_t pixels = (size_t)edge * (size_t)edge;
    for (size_t k = 0; k < pixels; k++) {
        const float *from = image.pixels + k * (size_t)image.channels;
        float *to = strip->pixels + ((size_t)face * pixels + k) * 3;
        for (int c = 0; c < 3; c++) {
            to[c] = from[c * step];
        }
    }
cleanup:
    glint_image_free(&image);
    return status;
}

static glint_status check_asked(const char *path, bool is_folder, glint_layout asked,
                                glint_error *error)
{
    if (asked == GLINT_LAYOUT_UNKNOWN || asked == GLINT_LAYOUT_FACES) {
        return GLINT_OK;
    }
    return glint_fail(error, GLINT_BAD_INPUT,
                      "%s: a %s holds six faces, not the layout %s (leave --env-layout out)", path,
                      is_folder ? "folder" : "pattern", glint_layout_name(asked));
}

// Reads the six faces into one picture.
static glint_status read_faces(const char *path, bool is_folder, glint_source *source,
                               glint_error *error)
{
    glint_face_files files = {0};
    glint_status status;
    TRY_OR(cleanup, status,
           is_folder ? glint_face_files_in_folder(path, &files, error)
                     : glint_face_files_by_pattern(path, &files, error));
    for (int face = 0; face < 6; face++) {
        TRY_OR(cleanup, status, read_face(&files, face, source, error));
    }
cleanup:
    glint_face_files_free(&files);
    if (status != GLINT_OK) {
        glint_image_free(&source->image);
    }
    return status;
}

static void recognise_faces(bool is_folder, glint_source *source)
{
    source->chart = (glint_chart){.layout = GLINT_LAYOUT_FACES,
                                  .width = source->image.width,
                                  .height = source->image.height,
                                  .distance = INFINITY};
    source->reason = is_folder ? "six faces in a folder" : "six faces by a pattern";
}

static glint_status load_faces(const char *path, bool is_folder, glint_source *source,
                               glint_warnings *warnings, glint_error *error)
{
    TRY(read_faces(path, is_folder, source, error));
    recognise_faces(is_folder, source);
    mend(path, source, warnings);
    return GLINT_OK;
}

// ---- Either -------------------------------------------------------------------------------------

glint_source_kind glint_source_kind_of(const char *path)
{
    struct stat facts;
    if (stat(path, &facts) != 0) {
        return strstr(path, "%s") != NULL ? GLINT_SOURCE_PATTERN : GLINT_SOURCE_FILE;
    }
    return S_ISDIR(facts.st_mode) ? GLINT_SOURCE_FOLDER : GLINT_SOURCE_FILE;
}

glint_status glint_source_open(const char *path, const glint_layout_request *request,
                               glint_source *source, glint_warnings *warnings, glint_error *error)
{
    *source = (glint_source){0};
    request = request != NULL ? request : &nothing_known;
    const glint_source_kind kind = glint_source_kind_of(path);
    if (kind == GLINT_SOURCE_FILE) {
        return open_file(path, request, source, warnings, error);
    }
    TRY(check_asked(path, kind == GLINT_SOURCE_FOLDER, request->layout, error));
    return load_faces(path, kind == GLINT_SOURCE_FOLDER, source, warnings, error);
}

glint_status glint_source_load(const char *path, const glint_layout_request *request,
                               glint_source *source, glint_warnings *warnings, glint_error *error)
{
    TRY(glint_source_open(path, request, source, warnings, error));
    if (source->image.pixels != NULL) {
        return GLINT_OK;
    }
    const glint_status status = glint_stored_develop(&source->stored, &source->image, error);
    glint_stored_free(&source->stored);
    return status;
}

glint_status glint_source_recall(const char *path, const glint_layout_request *request,
                                 glint_source_kind kind, glint_source *source, glint_error *error)
{
    if (kind != GLINT_SOURCE_FILE) {
        recognise_faces(kind == GLINT_SOURCE_FOLDER, source);
        return GLINT_OK;
    }
    const glint_image_file file = {path, source->image, source->facts};
    glint_recognised what;
    TRY(glint_layout_recognise(&file, request != NULL ? request : &nothing_known, &what, error));
    source->chart = what.chart;
    source->reason = what.reason;
    return GLINT_OK;
}

void glint_source_free(glint_source *source)
{
    glint_image_free(&source->image);
    glint_stored_free(&source->stored);
    *source = (glint_source){0};
}
