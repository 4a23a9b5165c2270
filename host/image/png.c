// Encodes PNG files with libpng. See png.h.
#include "image/png.h"

#include "base/memory.h"
#include "image/description.h"

#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LEVEL 4 // the fastest level that looks for a better match before it takes one

// What libpng has written and said.
typedef struct output {
    glint_encoded file;
    size_t room;     // allocated bytes of the file
    char fault[128]; // the first warning or error; "": none
} output;

// ---- What libpng calls --------------------------------------------------------------------------

// libpng warns of the cause before it fails.
static void keep_fault(png_structp png, png_const_charp text)
{
    output *to = png_get_error_ptr(png);
    if (to->fault[0] == '\0') {
        snprintf(to->fault, sizeof to->fault, "%s", text);
    }
}

// Continues in `write_file`: libpng cannot go on if this function returns.
static void give_up(png_structp png, png_const_charp text)
{
    keep_fault(png, text);
    png_longjmp(png, 1);
}

static void append(png_structp png, png_bytep bytes, size_t count)
{
    output *to = png_get_io_ptr(png);
    if (count > to->room - to->file.size) {
        const size_t room = 2 * (to->room + count);
        unsigned char *grown = realloc(to->file.bytes, room);
        if (grown == NULL) {
            png_error(png, "not enough memory");
        }
        to->file.bytes = grown;
        to->room = room;
    }
    memcpy(to->file.bytes + to->file.size, bytes, count);
    to->file.size += count;
}

// Without it libpng would flush a FILE.
static void flush(png_structp png)
{
    (void)png;
}

// ---- The file -----------------------------------------------------------------------------------

static void describe(png_structp png, png_infop info, const glint_file_values *values,
                     char *description)
{
    static const int color_types[5] = {0, PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA,
                                       PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA};
    static char title[] = "Description";
    const glint_image *image = values->image;
    const char *level = values->options->compression;
    png_set_IHDR(png, info, (png_uint_32)image->width, (png_uint_32)image->height, 8,
                 color_types[values->channels], PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_BASE,
                 PNG_FILTER_TYPE_BASE);
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_ABSOLUTE);
    if (description[0] != '\0') {
        png_text text = {.compression = PNG_TEXT_COMPRESSION_NONE, .key = title};
        text.text = description;
        png_set_text(png, info, &text, 1);
    }
    // One filter. Trying all of them for each row takes longer, and makes files hardly smaller
    // (docs/measurements.md).
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_compression_level(png, level != NULL ? atoi(level) : LEVEL);
}

// Writes the codes: [height][width][channels]. False if libpng gave up. Nothing that this function
// changes is read after libpng has jumped back here.
static bool write_file(png_structp png, png_infop info, const glint_file_values *values,
                       char *description, const unsigned char *codes)
{
    if (setjmp(png_jmpbuf(png)) != 0) {
        return false;
    }
    describe(png, info, values, description);
    png_write_info(png, info);
    const size_t row_bytes = (size_t)values->image->width * values->pixel_bytes;
    for (size_t y = 0; y < (size_t)values->image->height; y++) {
        png_write_row(png, codes + y * row_bytes);
    }
    png_write_end(png, info);
    return true;
}

glint_status glint_png_encode(const char *path, const glint_file_values *values, size_t threads,
                              glint_encoded *encoded, glint_error *error)
{
    output to = {0};
    char *description = glint_description_make(values->options);
    unsigned char *codes = glint_allocate_unset((size_t)values->image->height,
                                                (size_t)values->image->width * values->pixel_bytes);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &to, give_up, keep_fault);
    png_infop info = png != NULL ? png_create_info_struct(png) : NULL;
    glint_status status = GLINT_OK;
    if (description == NULL || codes == NULL || info == NULL) {
        status = glint_fail_memory(error, "an encoded image");
        goto cleanup;
    }
    glint_file_values_fill(values, threads, codes);
    png_set_write_fn(png, &to, append, flush);
    if (!write_file(png, info, values, description, codes)) {
        status = glint_fail(error, GLINT_OUTPUT_FAILED, "%s: could not be encoded: %s (try .exr)",
                            path, to.fault);
        goto cleanup;
    }
    *encoded = to.file;
    to.file.bytes = NULL;
cleanup:
    free(to.file.bytes);
    png_destroy_write_struct(&png, &info);
    free(codes);
    free(description);
    return status;
}
