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

glint_status glint_source_take(const glint_image_file *file, const glint_layout_request *request,
                               glint_source *source, glint_warnings *warnings, glint_error *error)
{
    *source = (glint_source){.image = file->image};
    glint_recognised what;
    const glint_status status =
        glint_layout_recognise(file, request != NULL ? request : &nothing_known, &what, error);
    if (status != GLINT_OK) {
        glint_source_free(source);
        return status;
    }
    const glint_image *taken = &source->image;
    if (what.chart.layout == GLINT_LAYOUT_LATLONG && taken->width != 2 * taken->height) {
        glint_warn(warnings, "%s: %d × %d pixels are not 2:1: stretched over the whole sphere",
                   file->name, taken->width, taken->height);
    }
    source->chart = what.chart;
    source->reason = what.reason;
    source->mended_texels = glint_radiance_mend(file->name, &source->image, warnings);
    return GLINT_OK;
}

static glint_status load_file(const char *path, const glint_layout_request *request,
                              glint_source *source, glint_warnings *warnings, glint_error *error)
{
    glint_image_file file = {.name = path};
    TRY(glint_image_read(path, &file.image, &file.facts, error));
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
static glint_status read_face(const glint_face_files *files, int face, glint_image *strip,
                              glint_error *error)
{
    glint_image image = {0};
    TRY(glint_image_read(files->paths[face], &image, NULL, error));
    const int edge = face == 0 ? image.width : strip->width;
    glint_status status;
    TRY_OR(cleanup, status, check_face(files, face, &image, edge, error));
    if (face == 0) {
        TRY_OR(cleanup, status, glint_image_create(edge, 6 * edge, 3, strip, error));
    }
    for (int k = 0; k < edge * edge; k++) {
        double rgb[3];
        glint_image_rgb(&image, k % edge, k / edge, rgb);
        float *pixel = glint_image_pixel(strip, k % edge, face * edge + k / edge);
        for (int c = 0; c < 3; c++) {
            pixel[c] = (float)rgb[c];
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
static glint_status read_faces(const char *path, bool is_folder, glint_image *strip,
                               glint_error *error)
{
    glint_face_files files = {0};
    glint_status status;
    TRY_OR(cleanup, status,
           is_folder ? glint_face_files_in_folder(path, &files, error)
                     : glint_face_files_by_pattern(path, &files, error));
    for (int face = 0; face < 6; face++) {
        TRY_OR(cleanup, status, read_face(&files, face, strip, error));
    }
cleanup:
    glint_face_files_free(&files);
    if (status != GLINT_OK) {
        glint_image_free(strip);
    }
    return status;
}

static glint_status load_faces(const char *path, bool is_folder, glint_source *source,
                               glint_warnings *warnings, glint_error *error)
{
    TRY(read_faces(path, is_folder, &source->image, error));
    source->chart = (glint_chart){.layout = GLINT_LAYOUT_FACES,
                                  .width = source->image.width,
                                  .height = source->image.height,
                                  .distance = INFINITY};
    source->reason = is_folder ? "six faces in a folder" : "six faces by a pattern";
    source->mended_texels = glint_radiance_mend(path, &source->image, warnings);
    return GLINT_OK;
}

// ---- Either -------------------------------------------------------------------------------------

glint_status glint_source_load(const char *path, const glint_layout_request *request,
                               glint_source *source, glint_warnings *warnings, glint_error *error)
{
    *source = (glint_source){0};
    request = request != NULL ? request : &nothing_known;
    struct stat facts;
    const bool exists = stat(path, &facts) == 0;
    const bool is_folder = exists && S_ISDIR(facts.st_mode);
    if (is_folder || (!exists && strstr(path, "%s") != NULL)) {
        TRY(check_asked(path, is_folder, request->layout, error));
        return load_faces(path, is_folder, source, warnings, error);
    }
    return load_file(path, request, source, warnings, error);
}

void glint_source_free(glint_source *source)
{
    glint_image_free(&source->image);
    *source = (glint_source){0};
}
