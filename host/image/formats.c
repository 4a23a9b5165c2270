// Recognises image formats. See formats.h.
#include "image/formats.h"

#include "base/regular_file.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

// ---- What is read -------------------------------------------------------------------------------

// The first bytes of a format's files.
typedef struct magic {
    const char *bytes;
    size_t offset, length;
    const char *name;
    const char *plugin; // NULL: known, but glint does not read it
} magic;

static const magic magics[] = {
    {"\x76\x2f\x31\x01", 0, 4, "OpenEXR", "openexr"},
    {"#?", 0, 2, "Radiance HDR", "hdr"},
    {"\x89PNG\r\n\x1a\n", 0, 8, "PNG", "png"},
    {"II\x2a\x00", 0, 4, "TIFF", "tiff"},
    {"MM\x00\x2a", 0, 4, "TIFF", "tiff"},
    {"II\x2b\x00", 0, 4, "BigTIFF", "tiff"},
    {"MM\x00\x2b", 0, 4, "BigTIFF", "tiff"},
    {"DDS ", 0, 4, "DDS", "dds"},
    {"\xff\xd8\xff", 0, 3, "JPEG", "jpeg"},
    {"GIF8", 0, 4, "GIF", NULL},
    {"8BPS", 0, 4, "PSD", NULL},
    {"BM", 0, 2, "BMP", NULL},
    {"SDPX", 0, 4, "DPX", NULL},
    {"XPDS", 0, 4, "DPX", NULL},
    {"SIMPLE", 0, 6, "FITS", NULL},
    {"WEBP", 8, 4, "WebP", "webp"},
    {"\xabKTX ", 0, 5, "KTX", NULL},
    {"ftypavif", 4, 8, "AVIF", NULL},
    {"ftypheic", 4, 8, "HEIC", NULL},
    {"\x00\x00\x00\x0cjP  ", 0, 8, "JPEG 2000", NULL},
    {"PF\n", 0, 3, "PFM", NULL},
    {"Pf\n", 0, 3, "PFM", NULL},
};

#define FORMATS_READ "exr, hdr, png, tiff, dds, jpeg or webp"

static const magic *magic_of(const char *start, size_t length)
{
    for (size_t i = 0; i < COUNT(magics); i++) {
        const magic *known = &magics[i];
        if (length >= known->offset + known->length &&
            memcmp(start + known->offset, known->bytes, known->length) == 0) {
            return known;
        }
    }
    return NULL;
}

const char *glint_image_format_name(const void *start, size_t length)
{
    const magic *known = magic_of(start, length);
    return known != NULL ? known->name : NULL;
}

// Sets the plugin by the file's first bytes.
static glint_status recognise(const char *start, size_t length, glint_image_source *source,
                              glint_error *error)
{
    const char *path = source->path;
    const magic *known = magic_of(start, length);
    if (source->size == 0) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: is empty (make the file anew)", path);
    }
    if (known == NULL) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: is no image of a kind that is read (give " FORMATS_READ ")", path);
    }
    if (known->plugin == NULL) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: is %s, which is not read (convert it to " FORMATS_READ ")", path,
                          known->name);
    }
    source->plugin = known->plugin;
    return GLINT_OK;
}

#define START 16 // bytes that tell formats apart

glint_status glint_image_find_source(const char *path, glint_image_source *source,
                                     glint_error *error)
{
    *source = (glint_image_source){.path = path};
    FILE *file;
    TRY(glint_regular_file_open(path, &file, &source->size, error));
    char start[START] = {0};
    const size_t length = fread(start, 1, sizeof start, file);
    fclose(file);
    return recognise(start, length, source, error);
}

glint_status glint_image_find_source_in_memory(const char *name, const void *bytes, uint64_t size,
                                               glint_image_source *source, glint_error *error)
{
    *source = (glint_image_source){.path = name, .size = size, .bytes = bytes};
    return recognise(bytes, size < START ? (size_t)size : START, source, error);
}

// ---- What is written ----------------------------------------------------------------------------

static const glint_written_format formats[] = {
    {"exr", GLINT_WRITTEN_EXR, "openexr"}, {"hdr", GLINT_WRITTEN_HDR, "hdr"},
    {"png", GLINT_WRITTEN_PNG, "png"},     {"jpg", GLINT_WRITTEN_JPEG, "jpeg"},
    {"jpeg", GLINT_WRITTEN_JPEG, "jpeg"},  {"tif", GLINT_WRITTEN_TIFF, "tiff"},
    {"tiff", GLINT_WRITTEN_TIFF, "tiff"},
};

const glint_written_format *glint_image_written_format(const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *name = slash != NULL ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    // ".exr" alone is a hidden file's name without an extension.
    if (dot != NULL && dot != name) {
        for (size_t i = 0; i < COUNT(formats); i++) {
            if (strcasecmp(dot + 1, formats[i].extension) == 0) {
                return &formats[i];
            }
        }
    }
    return NULL;
}

// The choices for compression: words, or an integer in [low, high].
typedef struct compressions {
    const char *words[11]; // NULL at the end
    int low, high;
    const char *said; // for messages; NULL: no compression may be given
} compressions;

static const compressions compressions_of[] = {
    [GLINT_WRITTEN_EXR] = {{"none", "rle", "zip", "zips", "piz", "pxr24", "b44", "b44a", "dwaa",
                            "dwab"},
                           0,
                           -1,
                           "none, rle, zip, zips, piz, pxr24, b44, b44a, dwaa or dwab"},
    [GLINT_WRITTEN_HDR] = {{NULL}, 0, -1, NULL},
    [GLINT_WRITTEN_PNG] = {{NULL}, 0, 9, "a level from 0 to 9"},
    [GLINT_WRITTEN_JPEG] = {{NULL}, 1, 100, "a quality from 1 to 100"},
    [GLINT_WRITTEN_TIFF] = {{"none", "lzw", "zip", "packbits"},
                            0,
                            -1,
                            "none, lzw, zip or packbits"},
};

static bool compression_fits(const compressions *allowed, const char *given)
{
    for (const char *const *word = allowed->words; *word != NULL; word++) {
        if (strcmp(*word, given) == 0) {
            return true;
        }
    }
    char *end;
    const long number = strtol(given, &end, 10);
    return given[0] >= '0' && given[0] <= '9' && *end == '\0' && number >= allowed->low &&
           number <= allowed->high;
}

glint_status glint_image_check_compression(const char *path, const glint_written_format *format,
                                           const char *compression, glint_error *error)
{
    const compressions *allowed = &compressions_of[format->kind];
    if (compression == NULL || compression_fits(allowed, compression)) {
        return GLINT_OK;
    }
    if (allowed->said == NULL) {
        return glint_fail(error, GLINT_USAGE,
                          "%s: this format has one compression only (leave '%s' out)", path,
                          compression);
    }
    return glint_fail(error, GLINT_USAGE, "%s: '%s' is no compression of this format (give %s)",
                      path, compression, allowed->said);
}
