// Converts pixels to the values of a file. See file_values.h.
#include "image/file_values.h"

#include "base/half.h"
#include "base/parallel.h"
#include "image/color.h"
#include "image/tone.h"

#include <math.h>
#include <string.h>

static size_t value_bytes(glint_value_type type)
{
    return type == GLINT_VALUE_CODE ? 1 : type == GLINT_VALUE_HALF ? 2 : sizeof(float);
}

glint_file_values glint_file_values_of(const glint_written_format *format, const glint_image *image,
                                       const glint_write_options *options)
{
    const glint_written_kind kind = format->kind;
    const bool has_alpha = image->channels == 2 || image->channels == 4;
    const bool keeps_alpha = has_alpha && kind != GLINT_WRITTEN_JPEG && kind != GLINT_WRITTEN_HDR;
    glint_file_values values = {.format = format, .image = image, .options = options};
    values.color = kind == GLINT_WRITTEN_HDR || image->channels > 2 ? 3 : 1;
    values.channels = values.color + keeps_alpha;
    values.type = kind == GLINT_WRITTEN_HDR   ? GLINT_VALUE_FLOAT
                  : kind != GLINT_WRITTEN_EXR ? GLINT_VALUE_CODE
                  : options->exr_float        ? GLINT_VALUE_FLOAT
                                              : GLINT_VALUE_HALF;
    values.picture_bytes = (size_t)values.channels * value_bytes(values.type);
    values.pixel_bytes = values.picture_bytes;
    if (kind == GLINT_WRITTEN_EXR) {
        values.pixel_bytes += options->channel_count * sizeof(float);
    }
    return values;
}

// ---- EXR ----------------------------------------------------------------------------------------

// Leaves NaN: it fails both comparisons.
static float clamp_to_half(float value)
{
    return value > GLINT_HALF_MAX    ? GLINT_HALF_MAX
           : value < -GLINT_HALF_MAX ? -GLINT_HALF_MAX
                                     : value;
}

static void fill_halfs(const float *from, unsigned char *to, size_t count)
{
    enum { CHUNK = 256 };
    float clamped[CHUNK];
    uint16_t halfs[CHUNK];
    for (size_t done = 0; done < count; done += CHUNK) {
        const size_t now = count - done < CHUNK ? count - done : CHUNK;
        for (size_t i = 0; i < now; i++) {
            clamped[i] = clamp_to_half(from[done + i]);
        }
        glint_floats_to_halfs(clamped, now, halfs);
        memcpy(to + 2 * done, halfs, now * sizeof *halfs);
    }
}

static void fill_linear(const glint_file_values *values, const float *from, unsigned char *to,
                        size_t pixels)
{
    const size_t count = pixels * (size_t)values->channels;
    if (values->type == GLINT_VALUE_FLOAT) {
        memcpy(to, from, count * sizeof(float));
    } else {
        fill_halfs(from, to, count);
    }
}

// Interleaves the picture with the further channels.
static void fill_layered(const glint_file_values *values, size_t first, unsigned char *to,
                         size_t pixels)
{
    const glint_write_options *options = values->options;
    const float *from = values->image->pixels + first * (size_t)values->channels;
    for (size_t p = 0; p < pixels; p++, from += values->channels) {
        fill_linear(values, from, to, 1);
        to += values->picture_bytes;
        for (size_t i = 0; i < options->channel_count; i++) {
            memcpy(to, options->channels[i].values + first + p, sizeof(float));
            to += sizeof(float);
        }
    }
}

// ---- Other formats ------------------------------------------------------------------------------

static float clamp_to_rgbe(float value)
{
    return value > 0.0f ? fminf(value, 1.6e38f) : 0.0f;
}

static void fill_rgbe(const glint_image *image, const float *from, unsigned char *to, size_t pixels)
{
    for (size_t p = 0; p < pixels; p++, from += image->channels, to += 3 * sizeof(float)) {
        float color[3];
        for (int c = 0; c < 3; c++) {
            color[c] = clamp_to_rgbe(from[image->channels >= 3 ? c : 0]);
        }
        memcpy(to, color, sizeof color);
    }
}

// Applies exposure, unpremultiplies if alpha is kept, then applies the tone curve and sRGB. Tone
// curves are not linear: they must see the colour without its alpha.
static void fill_codes(const glint_file_values *values, const float *from, unsigned char *to,
                       size_t pixels)
{
    const bool keeps_alpha = values->channels > values->color;
    const int channels = values->image->channels;
    const float gain = exp2f(values->options->exposure);
    for (size_t p = 0; p < pixels; p++, from += channels) {
        const float alpha = keeps_alpha ? from[channels - 1] : 1.0f;
        // An emitting pixel with alpha 0 keeps its colour.
        const float scale = keeps_alpha && alpha > 0.0f ? gain / alpha : gain;
        float color[3];
        for (int c = 0; c < 3; c++) {
            color[c] = from[values->color == 3 ? c : 0] * scale;
        }
        glint_tone_map(values->options->tone, color);
        for (int c = 0; c < values->color; c++) {
            *to++ = glint_linear_to_srgb8(color[c]);
        }
        if (keeps_alpha) {
            const float clamped = alpha > 0.0f ? fminf(alpha, 1.0f) : 0.0f;
            *to++ = (unsigned char)lroundf(clamped * 255.0f);
        }
    }
}

// Writes `rows` rows from `first_row` on to `to`.
static void fill_rows(const glint_file_values *values, int first_row, int rows, unsigned char *to)
{
    const glint_image *image = values->image;
    const size_t first = (size_t)first_row * (size_t)image->width;
    const size_t pixels = (size_t)rows * (size_t)image->width;
    const float *from = image->pixels + first * (size_t)image->channels;
    if (values->type == GLINT_VALUE_CODE) {
        fill_codes(values, from, to, pixels);
    } else if (values->format->kind == GLINT_WRITTEN_HDR) {
        fill_rgbe(image, from, to, pixels);
    } else if (values->pixel_bytes > values->picture_bytes) {
        fill_layered(values, first, to, pixels);
    } else {
        fill_linear(values, from, to, pixels);
    }
}

// ---- Threads ------------------------------------------------------------------------------------

#define BAND 16 // rows that a thread converts at once

typedef struct bands {
    const glint_file_values *values;
    unsigned char *to;
} bands;

static void fill_band(size_t index, void *context)
{
    const bands *shared = context;
    const glint_image *image = shared->values->image;
    const int first = (int)index * BAND;
    const int rows = image->height - first < BAND ? image->height - first : BAND;
    const size_t row_bytes = (size_t)image->width * shared->values->pixel_bytes;
    fill_rows(shared->values, first, rows, shared->to + (size_t)first * row_bytes);
}

void glint_file_values_fill(const glint_file_values *values, size_t threads, unsigned char *to)
{
    bands shared = {.values = values};
    shared.to = to;
    glint_parallel_for_on(threads, ((size_t)values->image->height + BAND - 1) / BAND, fill_band,
                          &shared);
}
