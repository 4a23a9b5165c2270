// Reads stored pictures, and converts them to images. See stored.h.
#include "image/stored.h"

#include "base/half.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "image/color.h"

#include <math.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

glint_image_facts glint_image_facts_of(const glint_stored *stored)
{
    return (glint_image_facts){
        .envmap = (glint_envmap)stored->facts.envmap,
        .was_encoded = stored->facts.transfer != GLINT_TRANSFER_LINEAR,
        .code_bits = stored->facts.code_bits,
        .is_direct3d_cube = stored->facts.is_direct3d_cube != 0,
    };
}

glint_status glint_image_read_stored(const char *path, glint_stored *stored, glint_error *error)
{
    *stored = (glint_stored){0};
    glint_image_source source;
    TRY(glint_image_find_source(path, &source, error));
    return glint_decoder_run(&source, false, stored, error);
}

// ---- Converting ---------------------------------------------------------------------------------

static float linear_of(const glint_stored_facts *facts, float code)
{
    return facts->transfer == GLINT_TRANSFER_SRGB    ? glint_srgb_to_linear(code)
           : facts->transfer == GLINT_TRANSFER_POWER ? powf(code, facts->gamma)
                                                     : code;
}

// Converts one pixel. Alpha never has a curve. If a colour was multiplied by alpha before the
// curve, it is divided first, because the curve belongs to the colour.
static void develop_pixel(const glint_stored_facts *facts, const float *linear, const float *codes,
                          float *pixel)
{
    const int colors = facts->channels <= 2 ? 1 : 3;
    const bool has_alpha = colors < facts->channels;
    const float alpha = has_alpha ? codes[colors] : 1.0f;
    const bool was_multiplied = has_alpha && facts->is_unassociated == 0;
    for (int c = 0; c < colors; c++) {
        if (was_multiplied && facts->transfer != GLINT_TRANSFER_LINEAR) {
            pixel[c] = alpha > 0.0f ? alpha * linear_of(facts, codes[c] / alpha) : linear[c];
        } else {
            pixel[c] = was_multiplied ? linear[c] : linear[c] * alpha;
        }
    }
    if (has_alpha) {
        pixel[colors] = alpha;
    }
}

static size_t count_pixels(const glint_stored_facts *facts)
{
    return (size_t)facts->width * (size_t)facts->height;
}

#define CHUNK 4096       // number of pixels read at a time
#define BAND (8 * CHUNK) // number of pixels that a thread develops at a time

// Pixels as read, with 8 or 16 bits a value.
typedef struct chunk {
    uint16_t values[CHUNK * 4];
    size_t pixels;
} chunk;

// Is compiled once for each width of codes.
static inline void develop_each(const glint_stored_facts *facts, const glint_development *of,
                                const chunk *from, bool is_wide, float *pixels)
{
    const uint8_t *narrow = (const uint8_t *)from->values;
    const size_t channels = (size_t)facts->channels;
    for (size_t p = 0; p < from->pixels; p++) {
        float curved[4] = {0}, straight[4] = {0};
        for (size_t c = 0; c < channels; c++) {
            const size_t place = p * channels + c;
            const unsigned code = is_wide ? from->values[place] : narrow[place];
            curved[c] = of->linear[code];
            straight[c] = of->plain[code];
        }
        develop_pixel(facts, curved, straight, pixels + p * channels);
    }
}

static void multiply_alpha(const glint_stored_facts *facts, float *pixels, size_t count)
{
    const size_t channels = (size_t)facts->channels;
    for (size_t p = 0; facts->is_unassociated != 0 && p < count; p++) {
        float value[4] = {0};
        memcpy(value, pixels + p * channels, channels * sizeof *value);
        develop_pixel(facts, value, value, pixels + p * channels);
    }
}

static void develop_chunk(const glint_development *d, const chunk *from, float *pixels)
{
    const glint_stored_facts *facts = &d->stored->facts;
    if (facts->code_bits == 16) {
        develop_each(facts, d, from, true, pixels);
    } else if (facts->code_bits == 8) {
        develop_each(facts, d, from, false, pixels);
    } else {
        glint_halfs_to_floats(from->values, from->pixels * (size_t)facts->channels, pixels);
        multiply_alpha(facts, pixels, from->pixels);
    }
}

bool glint_development_read(const glint_development *d, size_t first, size_t count, float *pixels)
{
    const glint_stored_facts *facts = &d->stored->facts;
    const size_t channels = (size_t)facts->channels,
                 bytes = channels * glint_stored_value_bytes(facts);
    if (facts->code_bits == 0 && facts->is_half == 0) {
        if (glint_stored_read(d->stored, first * bytes, pixels, count * bytes, NULL) != GLINT_OK) {
            return false;
        }
        multiply_alpha(facts, pixels, count);
        return true;
    }
    chunk from;
    for (size_t done = 0; done < count; done += from.pixels) {
        from.pixels = count - done < CHUNK ? count - done : CHUNK;
        if (glint_stored_read(d->stored, (first + done) * bytes, from.values, from.pixels * bytes,
                              NULL) != GLINT_OK) {
            return false;
        }
        develop_chunk(d, &from, pixels + done * channels);
    }
    return true;
}

glint_status glint_development_begin(const glint_stored *stored, glint_development *development,
                                     glint_error *error)
{
    const glint_stored_facts *facts = &stored->facts;
    const unsigned most = facts->code_bits == 16 ? UINT16_MAX : UINT8_MAX;
    *development = (glint_development){.stored = stored};
    if (facts->code_bits == 0) {
        return GLINT_OK;
    }
    float *values = glint_allocate_unset(most + 1, 2 * sizeof *values);
    if (values == NULL) {
        return glint_fail_memory(error, "an image");
    }
    development->plain = values;
    development->linear = values + most + 1;
    for (unsigned code = 0; code <= most; code++) {
        development->plain[code] = (float)((double)code / most);
        development->linear[code] = linear_of(facts, development->plain[code]);
    }
    return GLINT_OK;
}

void glint_development_end(glint_development *development)
{
    free(development->plain);
    *development = (glint_development){0};
}

// The data that all threads share.
typedef struct job {
    glint_development development;
    float *pixels;
    atomic_bool is_cut; // values are missing
} job;

static void develop_band(size_t index, void *context)
{
    job *shared = context;
    const glint_stored_facts *facts = &shared->development.stored->facts;
    const size_t first = index * BAND, left = count_pixels(facts) - first;
    if (!glint_development_read(&shared->development, first, left < BAND ? left : BAND,
                                shared->pixels + first * (size_t)facts->channels)) {
        atomic_store(&shared->is_cut, true);
    }
}

static glint_status develop_values(const glint_stored *stored, glint_image *image,
                                   glint_error *error)
{
    job shared = {.pixels = image->pixels};
    TRY(glint_development_begin(stored, &shared.development, error));
    glint_parallel_for((count_pixels(&stored->facts) + BAND - 1) / BAND, develop_band, &shared);
    glint_development_end(&shared.development);
    return atomic_load(&shared.is_cut) ? glint_stored_fail_of_cut(stored, error) : GLINT_OK;
}

// The stored place of pixel (x, y) of an upright image of `width` × `height`. EXIF's numbers: 2
// mirrored, 3 half a turn, 4 upside down, 5 to 8 with rows and columns exchanged.
static void stored_place(int orientation, int width, int height, int place[2])
{
    const int x = place[0], y = place[1];
    const bool flips_x =
        orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
    const bool flips_y =
        orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
    if (orientation >= 5) {
        // Upright (x, y) comes from stored (y, x). 6 and 8 are quarter turns.
        place[0] = flips_y ? height - 1 - y : y;
        place[1] = flips_x ? width - 1 - x : x;
    } else {
        place[0] = flips_x ? width - 1 - x : x;
        place[1] = flips_y ? height - 1 - y : y;
    }
}

static glint_status set_upright(int orientation, glint_image *image, glint_error *error)
{
    if (orientation < 2 || orientation > 8) {
        return GLINT_OK;
    }
    const bool exchanges = orientation >= 5;
    glint_image upright;
    TRY(glint_image_create(exchanges ? image->height : image->width,
                           exchanges ? image->width : image->height, image->channels, &upright,
                           error));
    for (int y = 0; y < upright.height; y++) {
        for (int x = 0; x < upright.width; x++) {
            int place[2] = {x, y};
            stored_place(orientation, upright.width, upright.height, place);
            memcpy(glint_image_pixel(&upright, x, y), glint_image_pixel(image, place[0], place[1]),
                   (size_t)image->channels * sizeof(float));
        }
    }
    glint_image_free(image);
    *image = upright;
    return GLINT_OK;
}

static glint_status develop(const glint_stored *stored, glint_image *image, glint_error *error)
{
    TRY(develop_values(stored, image, error));
    return set_upright(stored->facts.orientation, image, error);
}

glint_status glint_stored_develop(const glint_stored *stored, glint_image *image,
                                  glint_error *error)
{
    const glint_stored_facts *facts = &stored->facts;
    *image = (glint_image){0};
    TRY(glint_image_reuse(facts->width, facts->height, facts->channels, image, error));
    const glint_status status = develop(stored, image, error);
    if (status != GLINT_OK) {
        glint_image_free(image);
    }
    return status;
}
