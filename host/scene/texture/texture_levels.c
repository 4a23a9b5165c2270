// Makes mip levels from an image's rows. See texture_levels.h.
#include "scene/texture/texture_levels.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "image/color.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

// ---- Rows of the image --------------------------------------------------------------------------

// The values of codes, in 1/65535, not rounded.
typedef struct meanings {
    float *of_color, *of_alpha; // [code]
} meanings;

static glint_status make_meanings(int code_bits, bool is_color, meanings *of, glint_error *error)
{
    const size_t count = code_bits == 16 ? 65536 : 256;
    of->of_color = glint_allocate_unset(count, 2 * sizeof *of->of_color);
    if (of->of_color == NULL) {
        return glint_fail_memory(error, "a texture");
    }
    of->of_alpha = of->of_color + count;
    for (size_t code = 0; code < count; code++) {
        const float value = (float)((double)code / (double)(count - 1));
        of->of_color[code] = UINT16_MAX * (is_color ? glint_srgb_to_linear(value) : value);
        of->of_alpha[code] = UINT16_MAX * value;
    }
    return GLINT_OK;
}

// Converts a row of 1 to 4 channels; grey is repeated.
static void means_of_row(const meanings *of, const void *codes, const glint_stored_facts *facts,
                         float (*row)[4])
{
    const uint8_t *narrow = codes;
    const uint16_t *wide = codes;
    const size_t channels = (size_t)facts->channels, width = (size_t)facts->width;
    const size_t green = channels > 2 ? 1 : 0, blue = 2 * green;
    const bool is_wide = facts->code_bits == 16, has_alpha = channels % 2 == 0;
    for (size_t i = 0; i < width * channels; i += channels, row++) {
        (*row)[0] = of->of_color[is_wide ? wide[i] : narrow[i]];
        (*row)[1] = of->of_color[is_wide ? wide[i + green] : narrow[i + green]];
        (*row)[2] = of->of_color[is_wide ? wide[i + blue] : narrow[i + blue]];
        const size_t last = i + channels - 1;
        (*row)[3] = has_alpha ? of->of_alpha[is_wide ? wide[last] : narrow[last]] : UINT16_MAX;
    }
}

// ---- Levels -------------------------------------------------------------------------------------

// The texels of the finer level that a texel of the coarser level covers along one axis, and their
// shares. For an even size these are two texels. For an odd size there are up to three, because
// half of the size is rounded down.
typedef struct cover {
    int first, count;
    float share[3]; // sum 1
} cover;

static cover cover_of(int texel, int coarse, int fine)
{
    const double low = (double)texel * fine / coarse, high = (double)(texel + 1) * fine / coarse;
    cover c = {.first = (int)low};
    for (int i = 0; i < 3 && c.first + i < fine; i++) {
        const double from = fmax(low, c.first + i), to = fmin(high, c.first + i + 1);
        if (to > from) {
            c.share[i] = (float)((to - from) / (high - low));
            c.count = i + 1;
        }
    }
    return c;
}

static int half_of(int size)
{
    return size > 1 ? size / 2 : 1;
}

// The means or texels of a level, rows from the top.
typedef struct level_rows {
    int width, height;
    float (*means)[4]; // in 1/65535; NULL: level 0, whose rows are read from the image
    uint16_t (*texels)[4];
} level_rows;

// Rounds a row, whose values are in [0, 65535], to texels. Sets part of the border too.
static void round_row(const float (*row)[4], const level_rows *level, int y)
{
    const size_t width = (size_t)level->width, pitch = glint_texture_pitch(level->width);
    uint16_t(*texels)[4] = level->texels + (size_t)y * pitch;
    const float *from = &row[0][0];
    uint16_t *to = &texels[0][0];
    for (size_t i = 0; i < 4 * width; i++) {
        to[i] = (uint16_t)(int)(from[i] + 0.5f);
    }
    memcpy(texels[width], texels[0], sizeof *texels);
    if (y == 0) {
        memcpy(texels + (size_t)level->height * pitch, texels, pitch * sizeof *texels);
    }
}

// The work on a level, made from the next finer level. Means are averaged before they are rounded.
typedef struct levels_work {
    const glint_stored *stored;
    meanings of;
    bool is_coverage; // weight R, G and B by A
    level_rows fine, coarse;
    cover *across; // [coarse.width]
    atomic_bool failed;
    glint_status status; // status of the first thread that failed
    glint_error *error;  // error of the same thread
} levels_work;

// The working memory of a thread: a row of the image, as codes and as means; and the mean of some
// rows, plain and with R, G and B times alpha. These are the rows that a row of the coarser level
// covers.
typedef struct strip {
    float (*row)[4], (*sum)[4], (*weighted)[4];
    uint8_t *codes;
} strip;

enum { STRIP_ROWS = 16 }; // rows of the coarser level that a thread makes at once

static glint_status make_strip(size_t width, strip *s, glint_error *error)
{
    s->row = glint_allocate_unset(width, 3 * sizeof *s->row + 4 * sizeof(uint16_t));
    if (s->row == NULL) {
        return glint_fail_memory(error, "a texture");
    }
    s->sum = s->row + width;
    s->weighted = s->sum + width;
    s->codes = (uint8_t *)(s->weighted + width);
    return GLINT_OK;
}

// Reads a row of the image. Writes it to the texels if `stays`.
static glint_status read_row(const levels_work *w, strip *s, int y, bool stays, glint_error *error)
{
    const glint_stored_facts *facts = &w->stored->facts;
    const size_t width = (size_t)facts->width;
    const size_t bytes = width * (size_t)facts->channels * (size_t)(facts->code_bits / 8);
    TRY(glint_stored_read(w->stored, (size_t)y * bytes, s->codes, bytes, error));
    means_of_row(&w->of, s->codes, facts, s->row);
    if (stays) {
        round_row((const float(*)[4])s->row, &w->fine, y);
    }
    return GLINT_OK;
}

static void add_row(const float (*row)[4], float share, bool is_coverage, size_t width, strip *s)
{
    for (size_t x = 0; x < width; x++) {
        for (int c = 0; c < 4; c++) {
            s->sum[x][c] += share * row[x][c];
        }
    }
    for (size_t x = 0; is_coverage && x < width; x++) {
        for (int c = 0; c < 3; c++) {
            s->weighted[x][c] += share * row[x][3] * row[x][c];
        }
    }
}

// Averages the texels that a coarser texel covers.
static void average(const strip *s, const cover *across, bool is_coverage, float mean[4])
{
    float sum[4] = {0}, weighted[3] = {0};
    for (int i = 0; i < across->count; i++) {
        const size_t x = (size_t)across->first + (size_t)i;
        for (int c = 0; c < 4; c++) {
            sum[c] += across->share[i] * s->sum[x][c];
        }
        for (int c = 0; is_coverage && c < 3; c++) {
            weighted[c] += across->share[i] * s->weighted[x][c];
        }
    }
    for (int c = 0; c < 4; c++) {
        const float value = is_coverage && c < 3 && sum[3] > 0 ? weighted[c] / sum[3] : sum[c];
        mean[c] = value < UINT16_MAX ? value : UINT16_MAX;
    }
}

// Makes a row of the coarser level. Rows of the image below it become texels here, except a last
// row that the next coarser row also covers.
static glint_status make_row(const levels_work *w, strip *s, int y, glint_error *error)
{
    const level_rows *fine = &w->fine, *coarse = &w->coarse;
    const cover down = cover_of(y, coarse->height, fine->height);
    const int next = cover_of(y + 1, coarse->height, fine->height).first;
    const size_t width = (size_t)coarse->width;
    memset(s->sum, 0, 2 * (size_t)fine->width * sizeof *s->sum);
    for (int j = 0; j < down.count; j++) {
        const int at = down.first + j;
        const float(*row)[4] = (const float(*)[4])s->row;
        if (fine->means != NULL) {
            row = (const float(*)[4])fine->means + (size_t)at * (size_t)fine->width;
        } else {
            TRY(read_row(w, s, at, at < next, error));
        }
        add_row(row, down.share[j], w->is_coverage, (size_t)fine->width, s);
    }
    float(*means)[4] = coarse->means + (size_t)y * width;
    for (size_t x = 0; x < width; x++) {
        average(s, &w->across[x], w->is_coverage, means[x]);
    }
    round_row((const float(*)[4])means, coarse, y);
    return GLINT_OK;
}

static void make_rows(size_t index, void *context)
{
    levels_work *w = context;
    const int first = (int)index * STRIP_ROWS;
    glint_error error = {0};
    strip s = {0};
    glint_status status = make_strip((size_t)w->fine.width, &s, &error);
    for (int y = first; status == GLINT_OK && y < first + STRIP_ROWS && y < w->coarse.height; y++) {
        status = make_row(w, &s, y, &error);
    }
    free(s.row);
    if (status != GLINT_OK && !atomic_exchange(&w->failed, true)) {
        w->status = glint_fail(w->error, status, "%s", error.message);
    }
    glint_error_free(&error);
}

static glint_status make_level(levels_work *w, int threads)
{
    const int width = w->coarse.width;
    w->across = glint_allocate_unset((size_t)width, sizeof *w->across);
    if (w->across == NULL) {
        return glint_fail_memory(w->error, "a texture");
    }
    for (int x = 0; x < width; x++) {
        w->across[x] = cover_of(x, width, w->fine.width);
    }
    const int strips = (w->coarse.height + STRIP_ROWS - 1) / STRIP_ROWS;
    glint_parallel_for_on((size_t)threads, (size_t)strips, make_rows, w);
    free(w->across);
    return w->status;
}

// Sets the sizes and places of all levels. Returns the number of texels.
static size_t plan_levels(int width, int height, glint_texture *texture)
{
    *texture = (glint_texture){.width = width, .height = height};
    size_t count = 0;
    for (;;) {
        texture->first[texture->levels++] = count;
        count += glint_texture_area(width, height);
        if (width == 1 && height == 1) {
            return count;
        }
        width = half_of(width);
        height = half_of(height);
    }
}

// Makes level 1 from the image, which also sets level 0; then each level from the finer one.
static glint_status make_levels(levels_work *w, int threads, const glint_texture_levels *levels,
                                float (*means)[4])
{
    const glint_texture *t = &levels->texture;
    w->fine = (level_rows){t->width, t->height, NULL, levels->texels};
    for (int level = 1; level == 1 || level < t->levels; level++) {
        w->coarse =
            (level_rows){half_of(w->fine.width), half_of(w->fine.height), means,
                         w->fine.texels + glint_texture_area(w->fine.width, w->fine.height)};
        TRY(make_level(w, threads));
        means += (size_t)w->coarse.width * (size_t)w->coarse.height;
        w->fine = w->coarse;
    }
    return GLINT_OK;
}

glint_status glint_texture_levels_make(const glint_texture_request *request,
                                       const glint_stored *stored, glint_texture_levels *levels,
                                       glint_error *error)
{
    const glint_stored_facts *facts = &stored->facts;
    levels->texel_count = plan_levels(facts->width, facts->height, &levels->texture);
    // An image of one texel also gets a level 1, which stays unused.
    const size_t count = levels->texel_count + glint_texture_area(1, 1);
    const size_t coarser = count - glint_texture_area(facts->width, facts->height);
    float(*means)[4] = glint_allocate_unset(coarser, sizeof *means);
    levels->texels = glint_allocate_unset(count, sizeof *levels->texels);
    levels_work w = {.stored = stored, .is_coverage = request->is_coverage, .error = error};
    glint_status status = GLINT_OK;
    if (means == NULL || levels->texels == NULL) {
        status = glint_fail_memory(error, "a texture");
    } else {
        TRY_OR(cleanup, status, make_meanings(facts->code_bits, request->is_color, &w.of, error));
        status = make_levels(&w, request->threads, levels, means);
    }
cleanup:
    free(w.of.of_color);
    free(means);
    return status;
}
