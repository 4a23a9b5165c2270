// Reads image files with the decoder (decoder.h) and writes them with the codec (codec.h). See
// image_io.h.
#include "image/image_io.h"

#include "base/memory.h"
#include "image/codec.h"
#include "image/decoder.h"
#include "image/formats.h"
#include "image/output_file.h"
#include "image/stored.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CODEC_FILE "libglint_codec.so"

// ---- The codec ----------------------------------------------------------------------------------

// `lock` guards the other members.
static struct {
    pthread_mutex_t lock;
    const glint_codec *codec; // NULL: not loaded yet, or not available
    bool is_tried;
    char fault[GLINT_MESSAGE_CAPACITY]; // why the codec is not available
    int threads;                        // requested number; 0: one for each core
} loaded = {.lock = PTHREAD_MUTEX_INITIALIZER};

// The program's run path says where the library is. RTLD_LOCAL hides the symbols of OpenImageIO's
// libraries from OpenCL drivers. The library stays until the process ends.
static const glint_codec *open_codec(char fault[static GLINT_MESSAGE_CAPACITY])
{
    void *library = dlopen(CODEC_FILE, RTLD_NOW | RTLD_LOCAL);
    const glint_codec *codec = library != NULL ? dlsym(library, "glint_codec_functions") : NULL;
    if (codec == NULL) {
        snprintf(fault, GLINT_MESSAGE_CAPACITY, "%s", dlerror());
    } else if (strcmp(codec->version, GLINT_VERSION) != 0) {
        snprintf(fault, GLINT_MESSAGE_CAPACITY, "it belongs to glint %s", codec->version);
        codec = NULL;
    }
    return codec;
}

// Loads the codec at the first call. NULL: it cannot be loaded.
static const glint_codec *get_codec(void)
{
    pthread_mutex_lock(&loaded.lock);
    if (!loaded.is_tried) {
        loaded.is_tried = true;
        loaded.codec = open_codec(loaded.fault);
        if (loaded.codec != NULL && loaded.threads != 0) {
            loaded.codec->use_threads(loaded.threads);
        }
    }
    const glint_codec *codec = loaded.codec;
    pthread_mutex_unlock(&loaded.lock);
    return codec;
}

static glint_status require_codec(const glint_codec **codec, glint_error *error)
{
    *codec = get_codec();
    if (*codec == NULL) {
        return glint_fail(error, GLINT_OUTPUT_FAILED,
                          CODEC_FILE ": the image library cannot be loaded: %s "
                                     "(install glint anew)",
                          loaded.fault);
    }
    return GLINT_OK;
}

static pthread_t loader;
static bool is_loading;

static void *load_beside(void *unused)
{
    (void)unused;
    (void)get_codec(); // writers report a failure
    return NULL;
}

void glint_image_load_ahead(void)
{
    is_loading = is_loading || pthread_create(&loader, NULL, load_beside, NULL) == 0;
}

void glint_image_end_loading(void)
{
    if (is_loading) {
        pthread_join(loader, NULL);
        is_loading = false;
    }
}

void glint_image_use_threads(int count)
{
    pthread_mutex_lock(&loaded.lock);
    loaded.threads = count;
    if (loaded.codec != NULL) {
        loaded.codec->use_threads(count);
    }
    pthread_mutex_unlock(&loaded.lock);
    glint_decoder_use_threads(count);
}

// ---- Reading ------------------------------------------------------------------------------------

glint_image_facts glint_image_facts_of(const glint_stored *stored)
{
    return (glint_image_facts){
        .envmap = (glint_envmap)stored->facts.envmap,
        .was_encoded = stored->facts.transfer != GLINT_TRANSFER_LINEAR,
        .is_direct3d_cube = stored->facts.is_direct3d_cube != 0,
    };
}

glint_status glint_image_read_stored(const char *path, glint_stored *stored, glint_error *error)
{
    *stored = (glint_stored){.file = -1};
    glint_image_source source;
    TRY(glint_image_find_source(path, &source, error));
    return glint_decoder_run(&source, false, stored, error);
}

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
    const glint_codec *codec;
    TRY(glint_image_check_output(path, options, error));
    if (image->pixels == NULL) {
        return glint_fail(error, GLINT_OUTPUT_FAILED, "%s: there are no pixels to write", path);
    }
    TRY(require_codec(&codec, error));
    return codec->encode(path, image, options != NULL ? options : &defaults, encoded, error);
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
