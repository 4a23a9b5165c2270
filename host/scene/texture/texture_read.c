// Reads images and makes their mip levels. See texture_read.h.
#include "scene/texture/texture_read.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

// Removes levels that are too large, so that their memory is free before the next image is read.
static glint_status drop_large_levels(int largest, glint_texture_levels *levels, glint_error *error)
{
    glint_texture *t = &levels->texture;
    int dropped = 0;
    while (largest > 0 && (t->width > largest || t->height > largest)) {
        t->width = t->width > 1 ? t->width / 2 : 1;
        t->height = t->height > 1 ? t->height / 2 : 1;
        dropped++;
    }
    if (dropped == 0) {
        return GLINT_OK;
    }
    const size_t gone = t->first[dropped];
    levels->texel_count -= gone;
    t->levels -= dropped;
    for (int i = 0; i < t->levels; i++) {
        t->first[i] = t->first[i + dropped] - gone;
    }
    uint16_t(*all)[4] = levels->texels;
    levels->texels = glint_allocate_unset(levels->texel_count, sizeof *levels->texels);
    if (levels->texels != NULL) {
        memcpy(levels->texels, all + gone, levels->texel_count * sizeof *levels->texels);
    }
    free(all);
    return levels->texels != NULL ? GLINT_OK : glint_fail_memory(error, "a texture");
}

static glint_status make(const glint_texture_request *request, const glint_stored *stored,
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
    return glint_texture_levels_make(request, stored, levels, error);
}

glint_status glint_texture_read(const glint_texture_request *request, int largest,
                                glint_texture_levels *levels, glint_error *error)
{
    *levels = (glint_texture_levels){0};
    glint_stored stored;
    TRY(glint_decoder_run(&request->source, false, &stored, error));
    glint_status status = make(request, &stored, levels, error);
    glint_stored_free(&stored);
    if (status == GLINT_OK) {
        status = drop_large_levels(largest, levels, error);
    }
    if (status != GLINT_OK) {
        free(levels->texels);
        *levels = (glint_texture_levels){0};
    }
    return status;
}
