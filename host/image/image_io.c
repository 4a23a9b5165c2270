// Reads and writes image files, which another process decodes and encodes. See image_io.h.
#include "image/image_io.h"

#include "base/memory.h"
#include "image/codec.h"
#include "image/decoder.h"
#include "image/encoder.h"
#include "image/formats.h"
#include "image/output_file.h"
#include "image/png.h"
#include "image/stored.h"

#include <stdlib.h>
#include <string.h>

// ---- Reading ------------------------------------------------------------------------------------

glint_status glint_image_read(const char *path, glint_image *image, glint_image_facts *facts,
                              glint_error *error)
{
    *image = (glint_image){0};
    glint_stored stored;
    TRY(glint_image_read_stored(path, &stored, error));
    if (facts != NULL) {
        *facts = glint_image_facts_of(&stored);
    }
    const glint_status status = glint_stored_develop(&stored, image, error);
    glint_stored_free(&stored);
    return status;
}

// Splits the channels' names. The texts end at `end`; each has its own final zero.
static glint_status split_names(const char *path, const char *texts, const char *end,
                                glint_channels *channels, glint_error *error)
{
    for (int i = 0; i < channels->count; i++) {
        if (memchr(texts, '\0', (size_t)(end - texts)) == NULL) {
            return glint_fail(error, GLINT_BAD_INPUT,
                              "%s: its channels came without names (try again)", path);
        }
        channels->names[i] = strdup(texts);
        if (channels->names[i] == NULL) {
            return glint_fail_memory(error, "a file's channels");
        }
        texts += strlen(texts) + 1;
    }
    return GLINT_OK;
}

static glint_status copy_channels(const glint_stored *stored, glint_channels *channels,
                                  glint_error *error)
{
    const size_t count = (size_t)stored->facts.channels;
    channels->width = stored->facts.width;
    channels->height = stored->facts.height;
    channels->values = glint_allocate_unset(stored->value_bytes, 1);
    channels->names = glint_allocate(count, sizeof *channels->names);
    char *texts = glint_allocate(stored->name_bytes + 1, 1);
    glint_status status = GLINT_OK;
    if (channels->values == NULL || channels->names == NULL || texts == NULL) {
        status = glint_fail_memory(error, "a file's channels");
        goto cleanup;
    }
    channels->count = (int)count;
    TRY_OR(cleanup, status,
           glint_stored_read(stored, 0, channels->values, stored->value_bytes, error));
    TRY_OR(cleanup, status,
           glint_stored_read(stored, stored->value_bytes, texts, stored->name_bytes, error));
    status = split_names(stored->path, texts, texts + stored->name_bytes, channels, error);
cleanup:
    free(texts);
    return status;
}

glint_status glint_image_read_channels(const char *path, glint_channels *channels,
                                       glint_error *error)
{
    *channels = (glint_channels){0};
    glint_image_source source;
    glint_stored stored;
    TRY(glint_image_find_source(path, &source, error));
    if (strcmp(source.plugin, "openexr") != 0) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: is no EXR (check the name, or render it anew)", path);
    }
    TRY(glint_decoder_run(&source, true, &stored, error));
    const glint_status status = copy_channels(&stored, channels, error);
    glint_stored_free(&stored);
    if (status != GLINT_OK) {
        glint_channels_free(channels);
    }
    return status;
}

void glint_channels_free(glint_channels *channels)
{
    for (int i = 0; i < channels->count; i++) {
        free(channels->names[i]);
    }
    free(channels->names);
    free(channels->values);
    *channels = (glint_channels){0};
}

// ---- Writing ------------------------------------------------------------------------------------

bool glint_image_can_write(const char *path)
{
    return glint_image_written_format(path) != NULL;
}

bool glint_image_stays_linear(const char *path)
{
    const glint_written_format *format = glint_image_written_format(path);
    return format != NULL &&
           (format->kind == GLINT_WRITTEN_EXR || format->kind == GLINT_WRITTEN_HDR);
}

glint_status glint_image_check_output(const char *path, const glint_write_options *options,
                                      glint_error *error)
{
    const glint_written_format *format = glint_image_written_format(path);
    if (format == NULL) {
        return glint_fail(error, GLINT_USAGE,
                          "%s: the extension names no format that can be written (use .exr, .hdr, "
                          ".png, .jpg, .jpeg, .tif or .tiff)",
                          path);
    }
    return glint_image_check_compression(path, format,
                                         options != NULL ? options->compression : NULL, error);
}

glint_status glint_image_encode(const char *path, const glint_image *image,
                                const glint_write_options *options, glint_encoded *encoded,
                                glint_error *error)
{
    *encoded = (glint_encoded){0};
    const glint_write_options defaults = {0};
    TRY(glint_image_check_output(path, options, error));
    if (image->pixels == NULL) {
        return glint_fail(error, GLINT_OUTPUT_FAILED, "%s: there are no pixels to write", path);
    }
    const glint_file_values values = glint_file_values_of(glint_image_written_format(path), image,
                                                          options != NULL ? options : &defaults);
    return values.format->kind == GLINT_WRITTEN_PNG
               ? glint_png_encode(path, &values, (size_t)glint_codec_threads(), encoded, error)
               : glint_encoder_run(path, &values, encoded, error);
}

glint_status glint_image_write(const char *path, const glint_image *image,
                               const glint_write_options *options, glint_error *error)
{
    glint_encoded encoded;
    TRY(glint_image_encode(path, image, options, &encoded, error));
    const glint_status status = glint_output_file_write(path, encoded.bytes, encoded.size, error);
    free(encoded.bytes);
    return status;
}

void glint_image_write_ahead(const char *path)
{
    const glint_written_format *format = glint_image_written_format(path);
    if (format != NULL && format->kind != GLINT_WRITTEN_PNG) {
        glint_codec_start();
    }
}

void glint_image_use_threads(int count)
{
    glint_codec_use_threads(count);
}
