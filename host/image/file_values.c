// Converts pixels to the values of a file. See file_values.h.
#include "image/file_values.h"

#include "base/half.h"
#include "base/parallel.h"
#include "image/color.h"
#include "image/tone.h"

#include <math.h>
#include <string.h>

// DWA quantizes the cosine transform of w(v) = 1 + ln(v) / 2.2 (v > 1), in blocks of 8 × 8, and
// halfs hold all of it. A value becomes infinite from 65520 on. At 60000, w is 0.040 below that.
// All errors together reach 0.12: each coefficient's tolerance (Y 0.020, Cb and Cr 0.016 times 1.86
// and 1.57), and the rounding of halfs. But they add up like dice: 128 independent errors of the
// full tolerance have a standard deviation of 0.006. Noise, and a search for the worst of 1.3
// million blocks, raised values by up to 4.4%, which is 0.020.
#define DWA_MAX 60000.0f

// B44 keeps the largest value of 4 × 4 pixels and rounds the others to a step of up to a factor of
// two. So only values far below 0 can leave the range of halfs, next to large ones above 0.
#define B44_MAX 32752.0f

static size_t value_bytes(glint_value_type type)
{
    return type == GLINT_VALUE_CODE ? 1 : type == GLINT_VALUE_HALF ? 2 : sizeof(float);
}

// Sets the limits of an EXR's picture: those of halfs, or closer ones where a compression with loss
// would go beyond 65504 and make infinities.
static void set_limits(glint_file_values *values)
{
    const char *compression = values->options->compression;
    const bool is_half = values->type == GLINT_VALUE_HALF;
    values->highest = is_half ? GLINT_HALF_MAX : INFINITY;
    values->lowest = -values->highest;
    if (compression == NULL) {
        return;
    }
    if (strncmp(compression, "dwa", 3) == 0) {
        values->highest = DWA_MAX;
        values->lowest = -DWA_MAX;
    } else if (strncmp(compression, "b44", 3) == 0 && is_half) {
        values->lowest = -B44_MAX;
    }
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
        set_limits(&values);
    }
    return values;
}

// ---- EXR ----------------------------------------------------------------------------------------

// Leaves NaN: it fails both comparisons.
static float clamp(const glint_file_values *values, float value)
{
    return value > values->highest  ? values->highest
           : value < values->lowest ? values->lowest
                                    : value;
}

static void fill_linear(const glint_file_values *values, const float *from, unsigned char *to,
                        size_t pixels)
{
    enum { CHUNK = 256 };
    const size_t count = pixels * (size_t)values->channels;
    const size_t bytes = value_bytes(values->type);
    float clamped[CHUNK];
    uint16_t halfs[CHUNK];
    for (size_t done = 0; done < count; done += CHUNK) {
        const size_t now = count - done < CHUNK ? count - done : CHUNK;
        for (size_t i = 0; i < now; i++) {
            clamped[i] = clamp(values, from[done + i]);
        }
        if (values->type == GLINT_VALUE_HALF) {
            glint_floats_to_halfs(clamped, now, halfs);
        }
        memcpy(to + bytes * done, values->type == GLINT_VALUE_HALF ? (void *)halfs : clamped,
               bytes * now);
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
