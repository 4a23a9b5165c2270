// Reading images and computing their levels. See texture.h.
#include "scene/texture.h"

#include "base/memory.h"
#include "image/color.h"
#include "image/decoder.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *glint_texture_slot_name(glint_texture_slot slot)
{
    static const char *const names[] = {
        [GLINT_TEXTURE_BASE_COLOR] = "base colour",
        [GLINT_TEXTURE_METALLIC_ROUGHNESS] = "metallic and roughness",
        [GLINT_TEXTURE_OCCLUSION] = "occlusion",
        [GLINT_TEXTURE_NORMAL] = "normal",
        [GLINT_TEXTURE_EMISSION] = "emission",
        [GLINT_TEXTURE_TRANSMISSION] = "transmission",
    };
    return names[slot];
}

// ---- The image ----------------------------------------------------------------------------------

// What codes mean, as 1/65535.
typedef struct meanings {
    uint16_t *of_color, *of_alpha; // [code]
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
        const double value = (double)code / (double)(count - 1);
        const double linear = is_color ? (double)glint_srgb_to_linear((float)value) : value;
        of->of_color[code] = (uint16_t)lround(linear * 65535);
        of->of_alpha[code] = (uint16_t)lround(value * 65535);
    }
    return GLINT_OK;
}

// One pixel of 1 to 4 channels; grey is repeated.
static void spread(const meanings *of, const unsigned *codes, int channels, uint16_t texel[4])
{
    const bool is_grey = channels <= 2, has_alpha = channels == 2 || channels == 4;
    for (int c = 0; c < 3; c++) {
        texel[c] = of->of_color[codes[is_grey ? 0 : c]];
    }
    texel[3] = has_alpha ? of->of_alpha[codes[channels - 1]] : UINT16_MAX;
}

// Sets level 0 row by row.
static glint_status spread_rows(const glint_stored *stored, const meanings *of,
                                uint16_t (*texels)[4], glint_error *error)
{
    const glint_stored_facts *facts = &stored->facts;
    const size_t channels = (size_t)facts->channels, width = (size_t)facts->width;
    const size_t bytes = width * channels * (size_t)(facts->code_bits / 8);
    uint8_t *row = glint_allocate_unset(bytes, 1);
    if (row == NULL) {
        return glint_fail_memory(error, "a texture");
    }
    const uint16_t *wide = (const uint16_t *)(const void *)row;
    glint_status status = GLINT_OK;
    for (size_t y = 0; y < (size_t)facts->height; y++) {
        TRY_OR(cleanup, status, glint_stored_read(stored, y * bytes, row, bytes, error));
        for (size_t x = 0; x < width; x++) {
            unsigned codes[4] = {0};
            for (size_t c = 0; c < channels; c++) {
                codes[c] = facts->code_bits == 16 ? wide[x * channels + c] : row[x * channels + c];
            }
            spread(of, codes, facts->channels, texels[y * width + x]);
        }
    }
cleanup:
    free(row);
    return status;
}

// ---- Levels -------------------------------------------------------------------------------------

// Which texels of the finer level a texel of the coarser one covers along one axis, and how much of
// each: of an even number two, of an odd one up to three, as half of it is rounded down.
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

// What a texel covers of the finer level, whose rows are `width` long.
typedef struct window {
    const uint16_t (*fine)[4];
    int width;
    cover across, down;
} window;

// The mean of what a texel covers. With `is_coverage` R, G and B are weighted by A.
static void average(const window *w, bool is_coverage, uint16_t texel[4])
{
    float sum[4] = {0}, weighted[3] = {0};
    for (int j = 0; j < w->down.count; j++) {
        for (int i = 0; i < w->across.count; i++) {
            const size_t row = (size_t)(w->down.first + j) * (size_t)w->width;
            const uint16_t *from = w->fine[row + (size_t)(w->across.first + i)];
            const float share = w->across.share[i] * w->down.share[j];
            for (int c = 0; c < 4; c++) {
                sum[c] += share * (float)from[c];
            }
            for (int c = 0; is_coverage && c < 3; c++) {
                weighted[c] += share * (float)from[3] * (float)from[c];
            }
        }
    }
    for (int c = 0; c < 3; c++) {
        const float value = is_coverage && sum[3] > 0 ? weighted[c] / sum[3] : sum[c];
        texel[c] = (uint16_t)lrintf(fminf(value, UINT16_MAX));
    }
    texel[3] = (uint16_t)lrintf(fminf(sum[3], UINT16_MAX));
}

static int half_of(int size)
{
    return size > 1 ? size / 2 : 1;
}

static void fill_level(const uint16_t (*fine)[4], const int size[2], bool is_coverage,
                       uint16_t (*coarse)[4])
{
    const int width = half_of(size[0]), height = half_of(size[1]);
    window w = {.fine = fine, .width = size[0]};
    for (int y = 0; y < height; y++) {
        w.down = cover_of(y, height, size[1]);
        for (int x = 0; x < width; x++) {
            w.across = cover_of(x, width, size[0]);
            average(&w, is_coverage, coarse[(size_t)y * (size_t)width + (size_t)x]);
        }
    }
}

// Sets sizes and places of all levels; returns the number of texels.
static size_t plan_levels(int width, int height, glint_texture *texture)
{
    *texture = (glint_texture){.width = width, .height = height};
    size_t count = 0;
    for (;;) {
        texture->first[texture->levels++] = count;
        count += (size_t)width * (size_t)height;
        if (width == 1 && height == 1) {
            return count;
        }
        width = half_of(width);
        height = half_of(height);
    }
}

static void fill_levels(bool is_coverage, glint_texture_levels *levels)
{
    const glint_texture *t = &levels->texture;
    int size[2] = {t->width, t->height};
    for (int level = 1; level < t->levels; level++) {
        fill_level((const uint16_t(*)[4])levels->texels + t->first[level - 1], size, is_coverage,
                   levels->texels + t->first[level]);
        size[0] = half_of(size[0]);
        size[1] = half_of(size[1]);
    }
}

// Leaves out the levels that are too large.
static void drop_large_levels(int largest, glint_texture_levels *levels)
{
    glint_texture *t = &levels->texture;
    int dropped = 0;
    while (largest > 0 && (t->width > largest || t->height > largest)) {
        t->width = half_of(t->width);
        t->height = half_of(t->height);
        dropped++;
    }
    if (dropped == 0) {
        return;
    }
    const size_t gone = t->first[dropped];
    levels->texel_count -= gone;
    t->levels -= dropped;
    memmove(levels->texels, levels->texels + gone, levels->texel_count * sizeof *levels->texels);
    for (int i = 0; i < t->levels; i++) {
        t->first[i] = t->first[i + dropped] - gone;
    }
}

static glint_status fill(const glint_texture_request *request, const glint_stored *stored,
                         glint_texture_levels *levels, glint_error *error)
{
    const glint_stored_facts *facts = &stored->facts;
    if (facts->code_bits == 0) {
        return glint_fail(
            error, GLINT_BAD_INPUT,
            "%s: holds floating-point numbers, which textures do not (save it as PNG)",
            request->source.path);
    }
    const int most = 1 << (GLINT_TEXTURE_LEVELS - 1);
    if (facts->width > most || facts->height > most) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: %d × %d pixels are more than the %d × %d of a texture (make it "
                          "smaller)",
                          request->source.path, facts->width, facts->height, most, most);
    }
    levels->texel_count = plan_levels(facts->width, facts->height, &levels->texture);
    levels->texels = glint_allocate_unset(levels->texel_count, sizeof *levels->texels);
    if (levels->texels == NULL) {
        return glint_fail_memory(error, "a texture");
    }
    meanings of;
    TRY(make_meanings(facts->code_bits, request->is_color, &of, error));
    const glint_status status = spread_rows(stored, &of, levels->texels, error);
    free(of.of_color);
    return status;
}

glint_status glint_texture_read(const glint_texture_request *request, int largest,
                                glint_texture_levels *levels, glint_error *error)
{
    *levels = (glint_texture_levels){0};
    glint_stored stored;
    TRY(glint_decoder_run(&request->source, false, &stored, error));
    const glint_status status = fill(request, &stored, levels, error);
    glint_stored_free(&stored);
    if (status != GLINT_OK) {
        free(levels->texels);
        *levels = (glint_texture_levels){0};
        return status;
    }
    fill_levels(request->is_coverage, levels);
    drop_large_levels(largest, levels);
    return GLINT_OK;
}

// ---- All images ---------------------------------------------------------------------------------

glint_status glint_textures_join(glint_texture_levels *images, size_t count,
                                 glint_textures **textures, glint_error *error)
{
    glint_textures *all = glint_allocate(1, sizeof *all);
    size_t texels = 0;
    for (size_t i = 0; i < count; i++) {
        texels += images[i].texel_count;
    }
    if (all != NULL) {
        all->owners = 1;
        all->textures = glint_allocate(count, sizeof *all->textures);
        all->texels = glint_allocate_unset(texels, sizeof *all->texels);
    }
    if (all == NULL || all->textures == NULL || all->texels == NULL) {
        glint_textures_release(all);
        return glint_fail_memory(error, "the textures");
    }
    for (size_t i = 0; i < count; i++) {
        glint_texture *texture = &all->textures[all->count++];
        *texture = images[i].texture;
        for (int k = 0; k < texture->levels; k++) {
            texture->first[k] += all->texel_count;
        }
        if (images[i].texels != NULL) { // else it could not be read
            memcpy(all->texels + all->texel_count, images[i].texels,
                   images[i].texel_count * sizeof *all->texels);
        }
        all->texel_count += images[i].texel_count;
        free(images[i].texels);
        images[i] = (glint_texture_levels){0};
    }
    *textures = all;
    return GLINT_OK;
}

size_t glint_textures_bytes(const glint_textures *textures)
{
    return textures != NULL ? textures->texel_count * sizeof *textures->texels : 0;
}

glint_textures *glint_textures_share(glint_textures *textures)
{
    if (textures != NULL) {
        __atomic_add_fetch(&textures->owners, 1, __ATOMIC_RELAXED);
    }
    return textures;
}

void glint_textures_release(glint_textures *textures)
{
    if (textures != NULL && __atomic_sub_fetch(&textures->owners, 1, __ATOMIC_ACQ_REL) == 0) {
        free(textures->textures);
        free(textures->texels);
        free(textures);
    }
}
