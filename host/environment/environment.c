// Loading an environment. See environment.h.
//
// What is done with values that are no radiance, before anything filters them:
//   NaN and negative values, −∞ too, become 0;
//   +∞ becomes the largest finite value of the files (65504 where there is none above 0): it marks
//   what the format could not hold, the sun mostly, and is at least as bright as the brightest.
// Finite values stay, however large. Texels so mended are counted, and one warning says how many.
//
// An alpha channel is not used: the colour is taken as it was multiplied by alpha.
#include "environment/environment.h"

#include "environment/face_files.h"
#include "environment/layouts.h"
#include "image/image_io.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
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

// One policy over all the files of an environment: the same infinity is the same value on each
// face.
static size_t mend(const char *path, glint_image *images, int count, glint_warnings *warnings)
{
    mending found = {0};
    for (int i = 0; i < count; i++) {
        inspect(&images[i], &found);
    }
    if (found.count == 0) {
        return 0;
    }
    float infinity = found.largest > 0.0f ? found.largest : 65504.0f;
    for (int i = 0; i < count; i++) {
        replace(&images[i], infinity);
    }
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

// ---- One file -----------------------------------------------------------------------------------

static glint_status make_cube(const glint_image *image, const glint_recognised *what,
                              glint_cube *cube, glint_error *error)
{
    if (what->layout == GLINT_LAYOUT_LATLONG) {
        return glint_cube_from_latlong(image, what->on_edges, glint_latlong_edge(image->height),
                                       cube, error);
    }
    glint_face_view strip[6], views[6];
    for (int k = 0; k < 6; k++) {
        strip[k] = (glint_face_view){image, k * image->width};
        views[k] = strip[k];
    }
    if (what->layout == GLINT_LAYOUT_FACES) {
        glint_face_views_from_named(strip, views);
    }
    return glint_cube_from_faces(views, what->on_edges, cube, error);
}

static glint_status take_image(const char *name, glint_image *image, const glint_image_facts *facts,
                               glint_environment *environment, glint_warnings *warnings,
                               glint_error *error)
{
    glint_recognised what = {.layout = environment->layout};
    glint_status status = glint_layout_recognise(name, image, facts, &what, error);
    if (status != GLINT_OK) {
        return status;
    }
    if (what.layout == GLINT_LAYOUT_LATLONG && image->width != 2 * image->height &&
        facts->envmap != GLINT_ENVMAP_LATLONG) {
        glint_warn(warnings, "%s: %d × %d pixels are not 2:1: stretched over the whole sphere",
                   name, image->width, image->height);
    }
    environment->layout = what.layout;
    environment->reason = what.reason;
    environment->source_width = image->width;
    environment->source_height = image->height;
    environment->mended_texels = mend(name, image, 1, warnings);
    return make_cube(image, &what, &environment->radiance, error);
}

static glint_status load_file(const char *path, glint_environment *environment,
                              glint_warnings *warnings, glint_error *error)
{
    glint_image image = {0};
    glint_image_facts facts = {0};
    glint_status status = glint_image_read(path, &image, &facts, error);
    if (status == GLINT_OK) {
        status = take_image(path, &image, &facts, environment, warnings, error);
    }
    glint_image_free(&image);
    return status;
}

// ---- Six files ----------------------------------------------------------------------------------

static glint_status read_faces(const glint_face_files *files, glint_image images[6],
                               glint_error *error)
{
    for (int face = 0; face < 6; face++) {
        const char *path = files->paths[face];
        glint_status status = glint_image_read(path, &images[face], NULL, error);
        if (status != GLINT_OK) {
            return status;
        }
        if (images[face].width != images[face].height) {
            return glint_fail(error, GLINT_BAD_INPUT,
                              "%s: %d × %d pixels, where a face is square (crop it)", path,
                              images[face].width, images[face].height);
        }
        if (images[face].width != images[0].width) {
            return glint_fail(error, GLINT_BAD_INPUT,
                              "%s: %d pixels an edge, where %s has %d (make the six alike)", path,
                              images[face].width, files->paths[0], images[0].width);
        }
        if (images[face].width > GLINT_FACE_EDGE_MAX) {
            return glint_fail(error, GLINT_BAD_INPUT,
                              "%s: %d pixels an edge, where %d is the most (make the six smaller)",
                              path, images[face].width, GLINT_FACE_EDGE_MAX);
        }
    }
    return GLINT_OK;
}

static glint_status load_faces(const char *path, bool is_folder, glint_environment *environment,
                               glint_warnings *warnings, glint_error *error)
{
    glint_face_files files = {0};
    glint_image images[6] = {{0}};
    glint_status status = GLINT_OK;
    if (environment->layout != GLINT_LAYOUT_UNKNOWN && environment->layout != GLINT_LAYOUT_FACES) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: a %s holds six faces, not the layout %s (leave --env-layout out)",
                          path, is_folder ? "folder" : "pattern",
                          glint_layout_name(environment->layout));
    }
    status = is_folder ? glint_face_files_in_folder(path, &files, error)
                       : glint_face_files_by_pattern(path, &files, error);
    if (status == GLINT_OK) {
        status = read_faces(&files, images, error);
    }
    if (status != GLINT_OK) {
        goto cleanup;
    }
    environment->layout = GLINT_LAYOUT_FACES;
    environment->reason = is_folder ? "six faces in a folder" : "six faces by a pattern";
    environment->source_width = images[0].width;
    environment->source_height = images[0].height;
    environment->mended_texels = mend(path, images, 6, warnings);
    glint_face_view named[6], views[6];
    for (int face = 0; face < 6; face++) {
        named[face] = (glint_face_view){&images[face], 0};
    }
    glint_face_views_from_named(named, views);
    status = glint_cube_from_faces(views, false, &environment->radiance, error);

cleanup:
    for (int face = 0; face < 6; face++) {
        glint_image_free(&images[face]);
    }
    glint_face_files_free(&files);
    return status;
}

// ---- Either -------------------------------------------------------------------------------------

// Gives what was loaded its name, or frees it where that failed.
static glint_status finish(const char *name, glint_status status, glint_environment *environment,
                           glint_error *error)
{
    if (status == GLINT_OK) {
        environment->name = strdup(name);
        status = environment->name != NULL ? GLINT_OK
                                           : glint_fail_memory(error, "an environment's name");
    }
    if (status != GLINT_OK) {
        glint_environment_free(environment);
    }
    return status;
}

glint_status glint_environment_load(const char *path, glint_layout layout,
                                    glint_environment *environment, glint_warnings *warnings,
                                    glint_error *error)
{
    *environment = (glint_environment){.layout = layout};
    if (layout == GLINT_LAYOUT_STUDIO) {
        return glint_environment_studio(environment, error);
    }
    struct stat facts;
    bool exists = stat(path, &facts) == 0;
    glint_status status;
    if (exists && S_ISDIR(facts.st_mode)) {
        status = load_faces(path, true, environment, warnings, error);
    } else if (!exists && strstr(path, "%s") != NULL) {
        status = load_faces(path, false, environment, warnings, error);
    } else {
        status = load_file(path, environment, warnings, error);
    }
    return finish(path, status, environment, error);
}

glint_status glint_environment_from_image(const char *name, glint_image *image, glint_layout layout,
                                          glint_environment *environment, glint_warnings *warnings,
                                          glint_error *error)
{
    static const glint_image_facts nothing_more = {0};
    *environment = (glint_environment){.layout = layout};
    glint_status status = take_image(name, image, &nothing_more, environment, warnings, error);
    return finish(name, status, environment, error);
}

void glint_environment_free(glint_environment *environment)
{
    free(environment->name);
    glint_cube_free(&environment->radiance);
    *environment = (glint_environment){0};
}
