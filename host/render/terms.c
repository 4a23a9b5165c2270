// Writes, reads and lights the terms of pixels. See terms.h.
#include "render/terms.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "environment/cached_irradiance.h"
#include "environment/irradiance.h"
#include "kernels/layout.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The names of the channels of the header and of a term, in the stored order.
enum { HEADER = 4, TERM = 7 };
static const char *const header_names[HEADER] = {"constant_r", "constant_g", "constant_b",
                                                 "dropped"};
static const char *const term_names[TERM] = {"x", "y", "z", "kind", "wr", "wg", "wb"};

_Static_assert(GLINT_LAYER_CHANNELS >= GLINT_AOV_CHANNELS + HEADER + TERM * GLINT_TERMS_MAX,
               "all channels have room");

static void name_channel(int which, char name[GLINT_LAYER_NAME])
{
    if (which < HEADER) {
        snprintf(name, GLINT_LAYER_NAME, "terms.%s", header_names[which]);
    } else {
        const int of_term = which - HEADER;
        snprintf(name, GLINT_LAYER_NAME, "terms.%02d.%s", of_term / TERM,
                 term_names[of_term % TERM]);
    }
}

// The index of a channel among a pixel's stored values.
static size_t place_of(int which)
{
    return which < HEADER ? (size_t)which
                          : (size_t)(GLINT_TERM_VALUES * (1 + (which - HEADER) / TERM) +
                                     (which - HEADER) % TERM);
}

glint_status glint_terms_add_channels(const float *stored, size_t pixel_count, int capacity,
                                      glint_layers *layers, glint_error *error)
{
    const int channels = HEADER + TERM * capacity;
    const size_t of_pixel = (size_t)(GLINT_TERM_VALUES * (capacity + 1));
    float *values = glint_allocate_unset(pixel_count, (size_t)channels * sizeof *values);
    layers->term_values = values;
    layers->names = glint_allocate((size_t)channels, sizeof *layers->names);
    if (values == NULL || layers->names == NULL) {
        return glint_fail_memory(error, "the directions");
    }
    for (int which = 0; which < channels; which++) {
        const size_t place = place_of(which);
        for (size_t p = 0; p < pixel_count; p++) {
            values[p] = stored[p * of_pixel + place];
        }
        char *name = layers->names[which];
        name_channel(which, name);
        layers->channels[layers->count++] = (glint_channel){name, values};
        values += pixel_count;
    }
    return GLINT_OK;
}

// ---- Reading -----------------------------------------------------------------------------------

static int find_channel(const glint_channels *channels, const char *name)
{
    for (int i = 0; i < channels->count; i++) {
        if (strcmp(channels->names[i], name) == 0) {
            return i;
        }
    }
    return -1;
}

// Finds the channels. Returns false if one of the terms is incomplete or if there are none.
static bool find_channels(glint_terms *terms)
{
    char name[GLINT_LAYER_NAME];
    while (terms->capacity < GLINT_TERMS_MAX) {
        name_channel(HEADER + TERM * terms->capacity, name);
        if (find_channel(&terms->channels, name) < 0) {
            break;
        }
        terms->capacity++;
    }
    for (int which = 0; which < HEADER + TERM * terms->capacity; which++) {
        name_channel(which, name);
        terms->places[which] = find_channel(&terms->channels, name);
        if (terms->places[which] < 0) {
            return false;
        }
    }
    terms->alpha = find_channel(&terms->channels, "A");
    return terms->capacity > 0;
}

static double heaviest(const float *pixel, const int *places)
{
    return fmax(fmax((double)pixel[places[4]], (double)pixel[places[5]]), (double)pixel[places[6]]);
}

static void survey(glint_terms *terms)
{
    const glint_channels *c = &terms->channels;
    const size_t pixels = (size_t)c->width * (size_t)c->height;
    double kept = 0, dropped = 0;
    for (size_t p = 0; p < pixels; p++) {
        const float *pixel = c->values + p * (size_t)c->count;
        dropped += fmax(0, (double)pixel[terms->places[3]]); // 0 for NaN
        for (int k = 0; k < terms->capacity; k++) {
            const int *places = terms->places + HEADER + TERM * k;
            kept += fmax(0, heaviest(pixel, places));
            terms->has_irradiance = terms->has_irradiance || pixel[places[3]] != 0;
        }
    }
    terms->dropped = dropped > 0 ? dropped / (kept + dropped) : 0;
}

glint_status glint_terms_read(const char *path, glint_terms *terms, glint_error *error)
{
    *terms = (glint_terms){0};
    glint_status status = glint_image_read_channels(path, &terms->channels, error);
    if (status == GLINT_OK && !find_channels(terms)) {
        status = glint_fail(error, GLINT_BAD_INPUT,
                            "%s: it holds no directions (render it with --directions 8)", path);
    }
    if (status == GLINT_OK) {
        survey(terms);
    } else {
        glint_terms_free(terms);
    }
    return status;
}

void glint_terms_free(glint_terms *terms)
{
    glint_channels_free(&terms->channels);
    *terms = (glint_terms){0};
}

// ---- Lighting ----------------------------------------------------------------------------------

// The data that the threads share.
typedef struct job {
    const glint_terms *terms;
    const glint_cube *radiance, *irradiance;
    double cosine, sine; // of the environment's rotation
    glint_image *image;
} job;

// To look up an environment that is rotated by the angle a about +Y, rotates the vector by −a.
static glint_vec3 turn_back(const job *work, const float *pixel, const int *places)
{
    const double x = (double)pixel[places[0]], z = (double)pixel[places[2]];
    return (glint_vec3){work->cosine * x - work->sine * z, (double)pixel[places[1]],
                        work->sine * x + work->cosine * z};
}

static void light_pixel(const job *work, const float *pixel, double rgb[3])
{
    const glint_terms *terms = work->terms;
    for (int c = 0; c < 3; c++) {
        rgb[c] = (double)pixel[terms->places[c]];
    }
    for (int k = 0; k < terms->capacity; k++) {
        const int *places = terms->places + HEADER + TERM * k;
        if (pixel[places[0]] == 0 && pixel[places[1]] == 0 && pixel[places[2]] == 0) {
            break; // this place and all following are unused
        }
        const glint_vec3 along = turn_back(work, pixel, places);
        double light[3];
        glint_cube_sample(pixel[places[3]] != 0 ? work->irradiance : work->radiance, along, light);
        for (int c = 0; c < 3; c++) {
            rgb[c] += (double)pixel[places[4 + c]] * light[c];
        }
    }
}

static void light_row(size_t row, void *context)
{
    const job *work = context;
    const glint_channels *c = &work->terms->channels;
    for (int x = 0; x < c->width; x++) {
        const float *pixel = c->values + (row * (size_t)c->width + (size_t)x) * (size_t)c->count;
        float *out = glint_image_pixel(work->image, x, (int)row);
        double rgb[3];
        light_pixel(work, pixel, rgb);
        for (int k = 0; k < 3; k++) {
            out[k] = (float)rgb[k];
        }
        out[3] = work->terms->alpha >= 0 ? pixel[work->terms->alpha] : 1;
    }
}

glint_status glint_terms_relight(const glint_terms *terms, const glint_environment *environment,
                                 double degrees, glint_image *image, glint_error *error)
{
    const double turn = fmod(degrees, 360) * GLINT_PI / 180;
    glint_cube irradiance = {0};
    job work = {.terms = terms,
                .radiance = &environment->radiance,
                .irradiance = &irradiance,
                .cosine = cos(turn),
                .sine = sin(turn),
                .image = image};
    glint_status status =
        glint_image_create(terms->channels.width, terms->channels.height, 4, image, error);
    if (status == GLINT_OK && terms->has_irradiance) {
        status = glint_irradiance_map_cached(&environment->radiance, GLINT_IRRADIANCE_EDGE,
                                             &irradiance, error);
    }
    if (status == GLINT_OK) {
        glint_parallel_for((size_t)terms->channels.height, light_row, &work);
    } else {
        glint_image_free(image);
    }
    glint_cube_free(&irradiance);
    return status;
}
