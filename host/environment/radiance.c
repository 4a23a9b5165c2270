// Replaces values that are no radiance. See radiance.h.
#include "environment/radiance.h"

#include "base/half.h"
#include "base/parallel.h"

#include <math.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

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
    float largest; // largest finite value
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

#define BAND ((size_t)1 << 16) // values that a thread checks at once

typedef struct check {
    const float *values;
    size_t count;
    atomic_bool is_doubtful;
} check;

// Finds values, alpha included, that may be no radiance. Adding 2²³ to the bits of a float sets the
// sign from ∞ on. This loop fits vectors, and almost all pictures pass it.
static void check_band(size_t index, void *context)
{
    check *shared = context;
    const float *values = shared->values + index * BAND;
    const size_t left = shared->count - index * BAND, count = left < BAND ? left : BAND;
    uint32_t signs = 0;
    for (size_t i = 0; i < count; i++) {
        const uint32_t bits = glint_float_bits(values[i]);
        signs |= bits | (bits + 0x800000u);
    }
    if (signs >> 31 != 0) {
        atomic_store(&shared->is_doubtful, true);
    }
}

// True if all values are radiance. May be false although they are: −0 is doubtful.
static bool is_all_radiance(const glint_image *image)
{
    check shared = {.values = image->pixels,
                    .count =
                        (size_t)image->width * (size_t)image->height * (size_t)image->channels};
    glint_parallel_for((shared.count + BAND - 1) / BAND, check_band, &shared);
    return !atomic_load(&shared.is_doubtful);
}

size_t glint_radiance_mend(const char *path, glint_image *image, glint_warnings *warnings)
{
    mending found = {0};
    if (!is_all_radiance(image)) {
        inspect(image, &found);
    }
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
    // Treat the faces as one picture, stacked vertically. Borders are zero until they are filled
    // again.
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
    const size_t mended = glint_radiance_mend(name, &faces, warnings);
    glint_cube_fill_border(cube);
    return mended;
}
