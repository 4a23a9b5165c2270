// Loading an environment's picture. See source.h.
//
// What is done with values that are no radiance, before anything filters them:
//   NaN and negative values, −∞ too, become 0;
//   +∞ becomes the largest finite value of the files (65504 where there is none above 0): it marks
//   what the format could not hold, the sun mostly, and is at least as bright as the brightest.
// Finite values stay, however large. Texels so mended are counted, and one warning says how many.
//
// An alpha channel is not used: the colour is taken as it was multiplied by alpha.
#include "environment/source.h"

#include "environment/face_files.h"
#include "environment/layouts.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>
#include <sys/stat.h>

// ---- Values that are no radiance ----------------------------------------------------------------

static int color_channels(const glint_image *image)
{
    return image->channels <= 2 ? 1 : 3;
}

// NaN fails the comparison.
static bool is_radiance(float value)
{
    return value >= 0.0f && isfinite(value);
}

typedef struct mending {
    size_t count; // texels
    bool has_infinity;
    float largest; // of the finite values
} mending;

static void inspect(const glint_image *image, mending *found)
{
    size_t pixels = (size_t)image->width * (size_t)image->height;
    int colors = color_channels(image);
    for (size_t p = 0; p < pixels; p++) {
        const float *pixel = image->pixels + p * (size_t)image->channels;
        bool good = true;
        for (int c = 0; c < colors; c++) {
            if (is_radiance(pixel[c])) {
                found->largest = fmaxf(found->largest, pixel[c]);
            } else {
                good = false;
                found->has_infinity = found->has_infinity || pixel[c] > 0.0f;
            }
        }
        found->count += !good;
    }
}

static void replace(glint_image *image, float infinity)
{
    size_t pixels = (size_t)image->width * (size_t)image->height;
    int colors = color_channels(image);
    for (size_t p = 0; p < pixels; p++) {
        float *pixel = image->pixels + p * (size_t)image->channels;
        for (int c = 0; c < colors; c++) {
            if (!is_radiance(pixel[c])) {
                pixel[c] = pixel[c] > 0.0f ? infinity : 0.0f;
            }
        }
    }
}

static size_t mend(const char *path, glint_image *image, glint_warnings *warnings)
{
    mending found = {0};
    inspect(image, &found);
    if (found.count == 0) {
        return 0;
    }
    float infinity = found.largest > 0.0f ? found.largest : 65504.0f;
    replace(image, infinity);
    if (found.has_infinity) {
        glint_warn(
            warnings,
            "%s: %zu texels are NaN, negative or infinite: NaN and negative values are taken "
            "as 0, infinity as %g",
            path, found.count, (double)infinity);
    } else {
        glint_warn(warnings, "%s: %zu texels are NaN or negative: these values are taken as 0",
                   path, found.count);
    }
    return found.count;
}

size_t glint_cube_mend(const char *name, glint_cube *cube, glint_warnings *warnings)
{
    // The faces above each other, with borders that hold nothing until they are filled anew.
    static const double nothing[3] = {0};
    const int edge = cube->edge, pitch = edge + 2;
    for (int k = 0; k < 6 * pitch; k++) {
        const int face = k / pitch, at = k % pitch - 1;
        glint_cube_store(cube, face, at, -1, nothing);
        glint_cube_store(cube, face, at, edge, nothing);
        glint_cube_store(cube, face, -1, at, nothing);
        glint_cube_store(cube, face, edge, at, nothing);
    }
    glint_image faces = {pitch, 6 * pitch, 4, cube->texels};
    const size_t mended = mend(name, &faces, warnings);
    glint_cube_fill_border(cube);
    return mended;
}

// ---- One file -----------------------------------------------------------------------------------

static const glint_layout_request nothing_known = {0};

glint_status glint_source_take(const char *name, glint_image *image, const glint_image_facts *facts,
                               const glint_layout_request *request, glint_source *source,
                               glint_warnings *warnings, glint_error *error)
{
    *source = (glint_source){.image = *image};
    *image = (glint_image){0};
    glint_recognised what;
    glint_status status = glint_layout_recognise(
        name, &source->image, facts, request != NULL ? request : &nothing_known, &what, error);
    if (status != GLINT_OK) {
        glint_source_free(source);
        return status;
    }
    const glint_image *taken = &source->image;
    if (what.chart.layout == GLINT_LAYOUT_LATLONG && taken->width != 2 * taken->height) {
        glint_warn(warnings, "%s: %d × %d pixels are not 2:1: stretched over the whole sphere",
                   name, taken->width, taken->height);
    }
    source->chart = what.chart;
    source->reason = what.reason;
    source->mended_texels = mend(name, &source->image, warnings);
    return GLINT_OK;
}

static glint_status load_file(const char *path, const glint_layout_request *request,
                              glint_source *source, glint_warnings *warnings, glint_error *error)
{
    glint_image image = {0};
    glint_image_facts facts = {0};
    glint_status status = glint_image_read(path, &image, &facts, error);
    return status == GLINT_OK
               ? glint_source_take(path, &image, &facts, request, source, warnings, error)
               : status;
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

// Reads a face and puts it at its place in the strip, which the first one makes.
static glint_status read_face(const glint_face_files *files, int face, glint_image *strip,
                              glint_error *error)
{
    glint_image image = {0};
    glint_status status = glint_image_read(files->paths[face], &image, NULL, error);
    const int edge = face == 0 ? image.width : strip->width;
    if (status == GLINT_OK) {
        status = check_face(files, face, &image, edge, error);
    }
    if (status == GLINT_OK && face == 0) {
        status = glint_image_create(edge, 6 * edge, 3, strip, error);
    }
    for (int k = 0; status == GLINT_OK && k < edge * edge; k++) {
        double rgb[3];
        glint_image_rgb(&image, k % edge, k / edge, rgb);
        float *pixel = glint_image_pixel(strip, k % edge, face * edge + k / edge);
        for (int c = 0; c < 3; c++) {
            pixel[c] = (float)rgb[c];
        }
    }
    glint_image_free(&image);
    return status;
}

static glint_status load_faces(const char *path, bool is_folder, glint_layout asked,
                               glint_source *source, glint_warnings *warnings, glint_error *error)
{
    if (asked != GLINT_LAYOUT_UNKNOWN && asked != GLINT_LAYOUT_FACES) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: a %s holds six faces, not the layout %s (leave --env-layout out)",
                          path, is_folder ? "folder" : "pattern", glint_layout_name(asked));
    }
    glint_face_files files = {0};
    glint_status status = is_folder ? glint_face_files_in_folder(path, &files, error)
                                    : glint_face_files_by_pattern(path, &files, error);
    for (int face = 0; status == GLINT_OK && face < 6; face++) {
        status = read_face(&files, face, &source->image, error);
    }
    glint_face_files_free(&files);
    if (status != GLINT_OK) {
        glint_source_free(source);
        return status;
    }
    source->chart = (glint_chart){.layout = GLINT_LAYOUT_FACES,
                                  .width = source->image.width,
                                  .height = source->image.height,
                                  .distance = INFINITY};
    source->reason = is_folder ? "six faces in a folder" : "six faces by a pattern";
    source->mended_texels = mend(path, &source->image, warnings);
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
        return load_faces(path, is_folder, request->layout, source, warnings, error);
    }
    return load_file(path, request, source, warnings, error);
}

void glint_source_free(glint_source *source)
{
    glint_image_free(&source->image);
    *source = (glint_source){0};
}
