// Reads Radiance pictures (HDR, RGBE). See hdr.h.
//
// Written after "Radiance File Formats" (Ward 1991). OpenImageIO's reader is not used: it turns two
// of the eight orders of pixels by 180°, gives up after 100 lines of header, does not know the
// older run-length code, and ignores EXPOSURE.
#include "codec/hdr.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// ---- Lines --------------------------------------------------------------------------------------

#define LINE 256 // bytes of a line that are looked at: no variable needs more

// Copies the line at *at, and moves *at behind it. False at the end of the file.
static bool read_line(const glint_hdr_file *file, size_t *at, char line[LINE])
{
    const unsigned char *from = file->bytes + *at;
    const unsigned char *end = memchr(from, '\n', file->size - *at);
    if (end == NULL) {
        return false;
    }
    size_t length = (size_t)(end - from);
    *at += length + 1;
    length -= length > 0 && from[length - 1] == '\r';
    length = length < LINE - 1 ? length : LINE - 1;
    memcpy(line, from, length);
    line[length] = '\0';
    return true;
}

// The value of a variable that begins the line. NULL: the line has another one. Lines that begin
// with a tab are the history of the pictures that this one was made of.
static const char *value_of(const char *line, const char *name)
{
    const size_t length = strlen(name);
    if (strncmp(line, name, length) != 0 || line[length] != '=') {
        return NULL;
    }
    const char *value = line + length + 1;
    return value + strspn(value, " \t");
}

// Reads exactly `count` finite numbers.
static bool read_numbers(const char *text, int count, double *numbers)
{
    for (int i = 0; i < count; i++) {
        char *end;
        numbers[i] = strtod(text, &end);
        if (end == text || !isfinite(numbers[i])) {
            return false;
        }
        text = end;
    }
    return text[strspn(text, " \t")] == '\0';
}

// ---- The header ---------------------------------------------------------------------------------

// What the variables say.
typedef struct variables {
    double gain[3]; // EXPOSURE and COLORCORR: the values were multiplied by it
    bool has_primaries;
    glint_primaries primaries;
} variables;

static glint_status fail_of_line(const glint_hdr_file *file, const char *line, glint_error *error)
{
    return glint_fail(error, GLINT_BAD_INPUT,
                      "%s: its header has a value that cannot be used: %.80s (correct it, or make "
                      "the file anew)",
                      file->path, line);
}

static glint_status read_format(const glint_hdr_file *file, const char *format, glint_error *error)
{
    if (strncmp(format, "32-bit_rle_rgbe", 15) == 0) {
        return GLINT_OK;
    }
    if (strncmp(format, "32-bit_rle_xyze", 15) == 0) {
        // Their unit differs too, by a factor of 179 that not every writer applies.
        return glint_fail(
            error, GLINT_BAD_INPUT,
            "%s: holds CIE XYZ colours (32-bit_rle_xyze), which are not read (convert "
            "it with Radiance's ra_xyze -r)",
            file->path);
    }
    return glint_fail(error, GLINT_BAD_INPUT,
                      "%s: holds %.40s, which is not read (convert it to 32-bit_rle_rgbe)",
                      file->path, format);
}

// Multiplies a product by a line's factors. False if pixels would leave the range of floats.
static bool multiply(const char *value, int count, double product[3])
{
    double factors[3];
    if (!read_numbers(value, count, factors)) {
        return false;
    }
    bool is_good = true;
    for (int c = 0; c < 3; c++) {
        product[c] *= factors[count == 3 ? c : 0];
        is_good = is_good && product[c] >= (double)FLT_MIN && product[c] <= (double)FLT_MAX;
    }
    return is_good;
}

// Photoshop writes eight zeros.
static bool read_primaries(const char *value, variables *found)
{
    double numbers[8], sum = 0;
    if (!read_numbers(value, 8, numbers)) {
        return false;
    }
    for (int i = 0; i < 8; i++) {
        found->primaries.xy[i / 2][i % 2] = numbers[i];
        sum += fabs(numbers[i]);
    }
    found->has_primaries = sum > 0;
    return true;
}

static glint_status read_variable(const glint_hdr_file *file, const char *line, variables *found,
                                  glint_error *error)
{
    const char *value;
    bool is_good = true;
    if ((value = value_of(line, "FORMAT")) != NULL) {
        return read_format(file, value, error);
    }
    if ((value = value_of(line, "EXPOSURE")) != NULL) {
        is_good = multiply(value, 1, found->gain);
    } else if ((value = value_of(line, "COLORCORR")) != NULL) {
        is_good = multiply(value, 3, found->gain);
    } else if ((value = value_of(line, "PRIMARIES")) != NULL) {
        is_good = read_primaries(value, found);
    }
    return is_good ? GLINT_OK : fail_of_line(file, line, error);
}

// The order of pixels. "-Y 2 +X 3": scanlines from the top down, each from the left to the right.
static bool read_resolution(const char *line, glint_hdr *header)
{
    // The orders by TIFF's numbers.
    static const char orders[][5] = {"-Y+X", "-Y-X", "+Y-X", "+Y+X",
                                     "+X-Y", "-X-Y", "-X+Y", "+X+Y"};
    char order[5] = "";
    int32_t sizes[2];
    for (int i = 0; i < 2; i++) {
        char *end;
        memcpy(order + 2 * i, line, strnlen(line, 2));
        line += strnlen(line, 2);
        const long size = strtol(line, &end, 10);
        if (end == line || size < 1 || size > INT32_MAX) {
            return false;
        }
        sizes[i] = (int32_t)size;
        line = end + strspn(end, " \t");
    }
    header->scanlines = sizes[0];
    header->length = sizes[1];
    for (int32_t i = 0; i < 8; i++) {
        if (strcmp(order, orders[i]) == 0) {
            header->orientation = i + 1;
            return *line == '\0';
        }
    }
    return false;
}

// Makes the matrix that undoes the gain and converts the primaries.
static bool make_matrix(const variables *found, glint_hdr *header)
{
    header->matrix = (glint_color_matrix){{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    if (found->has_primaries && !glint_primaries_are_rec709(&found->primaries)) {
        header->is_converted = true;
        if (!glint_primaries_to_rec709(&found->primaries, &header->matrix)) {
            return false;
        }
    }
    for (int i = 0; i < 9; i++) {
        header->matrix.rows[i / 3][i % 3] /= found->gain[i % 3];
        header->is_converted = header->is_converted || found->gain[i % 3] != 1;
    }
    return true;
}

glint_status glint_hdr_read_header(const glint_hdr_file *file, glint_hdr *header,
                                   glint_error *error)
{
    char line[LINE] = "";
    variables found = {.gain = {1, 1, 1}};
    *header = (glint_hdr){0};
    do {
        if (!read_line(file, &header->pixels_at, line)) {
            return glint_fail(error, GLINT_BAD_INPUT, "%s: its header has no end (make it anew)",
                              file->path);
        }
        TRY(read_variable(file, line, &found, error));
    } while (line[0] != '\0');
    if (!read_line(file, &header->pixels_at, line) || !read_resolution(line, header)) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: its header does not end in a size such as -Y 512 +X 1024 (make the "
                          "file anew)",
                          file->path);
    }
    if (!make_matrix(&found, header)) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: its PRIMARIES are no colours (correct them, or take the line out)",
                          file->path);
    }
    // A scanline has a pixel that is stored whole, at least.
    if ((uint64_t)header->scanlines * 4 > file->size - header->pixels_at) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: says %d × %d pixels, which its %zu bytes cannot hold (it is damaged "
                          "or cut short)",
                          file->path, header->length, header->scanlines, file->size);
    }
    return GLINT_OK;
}

// ---- Scanlines ----------------------------------------------------------------------------------

// The bytes that are not decoded yet.
typedef struct cursor {
    const unsigned char *at, *end;
} cursor;

static bool has(const cursor *from, size_t bytes)
{
    return (size_t)(from->end - from->at) >= bytes;
}

// Decodes a component of a scanline: runs of one byte (128 and their length before it), and bytes
// as they are (their number before them).
static bool read_component(cursor *from, size_t length, unsigned char *to)
{
    while (length > 0) {
        if (!has(from, 2)) {
            return false;
        }
        const unsigned code = *from->at++;
        const size_t count = code > 128 ? code - 128 : code;
        if (count > length || count == 0) {
            return false;
        }
        if (code > 128) {
            memset(to, *from->at++, count);
        } else {
            if (!has(from, count)) {
                return false;
            }
            memcpy(to, from->at, count);
            from->at += count;
        }
        to += count;
        length -= count;
    }
    return true;
}

// Takes pixels as they are, four bytes each. After the first one, (1, 1, 1, n) repeats the last
// pixel n times, and directly after another one 256 · n times, and so on.
static bool read_pixels(cursor *from, size_t length, unsigned char *to)
{
    unsigned shift = 0;
    for (size_t done = 0; done < length; from->at += 4) {
        if (!has(from, 4)) {
            return false;
        }
        const unsigned char *pixel = from->at;
        if (done == 0 || pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
            for (size_t c = 0; c < 4; c++) {
                to[c * length + done] = pixel[c];
            }
            done++;
            shift = 0;
            continue;
        }
        // What is beyond the scanline's end is ignored.
        const uint64_t wanted = shift < 32 ? (uint64_t)pixel[3] << shift : length;
        const size_t count = wanted < length - done ? (size_t)wanted : length - done;
        for (size_t c = 0; c < 4; c++) {
            memset(to + c * length + done, to[c * length + done - 1], count);
        }
        done += count;
        shift += 8;
    }
    return true;
}

// Decodes a scanline to four components, one after the other.
static bool read_scanline(cursor *from, size_t length, unsigned char *to)
{
    // The two leading bytes are no pixel's: one byte of a pixel is at least 128.
    if (length < 8 || length > 0x7fff || !has(from, 4) || from->at[0] != 2 || from->at[1] != 2 ||
        from->at[2] > 127) {
        return read_pixels(from, length, to);
    }
    if ((size_t)from->at[2] * 256 + from->at[3] != length) {
        return false;
    }
    from->at += 4;
    for (size_t c = 0; c < 4; c++) {
        if (!read_component(from, length, to + c * length)) {
            return false;
        }
    }
    return true;
}

// A component c with exponent e is c · 2^(e − 136); all is 0 if e is.
static void convert_scanline(const glint_hdr *header, const float powers[256],
                             const unsigned char *rgbe, float *pixels)
{
    const size_t length = (size_t)header->length;
    for (size_t x = 0; x < length; x++) {
        const float power = powers[rgbe[3 * length + x]];
        for (size_t c = 0; c < 3; c++) {
            pixels[3 * x + c] = (float)rgbe[c * length + x] * power;
        }
    }
    if (header->is_converted) {
        glint_color_matrix_apply(&header->matrix, pixels, length, 3);
    }
}

glint_status glint_hdr_read_pixels(const glint_hdr_file *file, const glint_hdr *header,
                                   float *pixels, glint_error *error)
{
    float powers[256] = {0};
    for (int exponent = 1; exponent < 256; exponent++) {
        powers[exponent] = ldexpf(1, exponent - 136);
    }
    const size_t length = (size_t)header->length;
    unsigned char *rgbe = malloc(4 * length);
    if (rgbe == NULL) {
        return glint_fail_memory(error, "an image");
    }
    cursor from = {file->bytes + header->pixels_at, file->bytes + file->size};
    glint_status status = GLINT_OK;
    for (int32_t y = 0; y < header->scanlines && status == GLINT_OK; y++) {
        if (read_scanline(&from, length, rgbe)) {
            convert_scanline(header, powers, rgbe, pixels + (size_t)y * length * 3);
        } else {
            status = glint_fail(error, GLINT_BAD_INPUT,
                                "%s: scanline %d of %d is damaged or cut short (make the file "
                                "anew)",
                                file->path, y + 1, header->scanlines);
        }
    }
    free(rgbe);
    return status;
}
