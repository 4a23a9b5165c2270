// Tests writing image files. Written files must read back within the rounding of the format, and
// must follow OpenEXR's file layout. Impossible requests must fail before any work. test_image.c
// tests the reader separately.
#include "image/image_io.h"
#include "support/image_files.h"
#include "support/scratch.h"
#include "support/srgb.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// ---- Writing and reading again ------------------------------------------------------------------

// A ramp of colours with alpha, premultiplied.
static glint_image make_ramp(int channels)
{
    glint_image image;
    assert_int_equal(glint_image_create(64, 16, channels, &image, NULL), GLINT_OK);
    for (int p = 0; p < 64 * 16; p++) {
        int row = p / 64;
        float alpha = channels % 2 == 0 ? (float)(row + 1) / 16.0f : 1.0f;
        for (int c = 0; c < channels; c++) {
            bool is_alpha = channels % 2 == 0 && c == channels - 1;
            float color = (float)((p * (c + 3)) % 64) / 63.0f;
            image.pixels[p * channels + c] = is_alpha ? alpha : color * alpha;
        }
    }
    return image;
}

// Allowed error of linear values in a format: relative to the largest value of a pixel, and in sRGB
// codes of the straight colour.
typedef struct tolerance {
    const char *name;
    int channels_back[5]; // by the number of channels written
    double relative, codes;
} tolerance;

static void compare_pixel(const float *wrote, const float *read, int channels,
                          const tolerance *allowed)
{
    bool has_alpha = channels % 2 == 0;
    int colors = has_alpha ? channels - 1 : channels;
    double alpha = has_alpha ? (double)wrote[colors] : 1.0;
    double most = 0.0;
    for (int c = 0; c < colors; c++) {
        most = fmax(most, (double)wrote[c]);
    }
    for (int c = 0; c < colors; c++) {
        double error = fabs((double)wrote[c] - (double)read[c]);
        if (allowed->codes > 0.0) {
            // Alpha has eight bits, too. The division must not use the rounded alpha.
            double before = srgb_from_linear((double)wrote[c] / alpha),
                   after = srgb_from_linear((double)read[c] / alpha);
            error = 255.0 * fabs(before - after) - (has_alpha ? 0.5 / alpha : 0.0);
            assert_true(error <= allowed->codes);
        } else {
            assert_true(error <= allowed->relative * most);
        }
    }
}

static void what_is_written_is_read_again(void **state)
{
    (void)state;
    // Half has 11 bits, rounded: 2⁻¹¹. RGBE has 8 bits, truncated or rounded, of a mantissa of at
    // least ½: 2⁻⁷. Eight bits give half a code, plus the rounding of float.
    static const tolerance formats[] = {
        {"a.exr", {0, 1, 2, 3, 4}, 1.0 / 2048, 0.0}, {"a.hdr", {0, 3, 3, 3, 3}, 1.0 / 128, 0.0},
        {"a.png", {0, 1, 2, 3, 4}, 0.0, 0.5001},     {"a.tif", {0, 1, 2, 3, 4}, 0.0, 0.5001},
        {"a.tiff", {0, 1, 2, 3, 4}, 0.0, 0.5001},
    };
    for (size_t k = 0; k < sizeof formats / sizeof formats[0]; k++) {
        for (int channels = 1; channels <= 4; channels++) {
            glint_error error = {0};
            glint_image wrote = make_ramp(channels);
            if (glint_image_write(scratch_path(formats[k].name), &wrote, NULL, &error) !=
                GLINT_OK) {
                fail_msg("%s", error.message);
            }
            glint_image read = image_file_read(formats[k].name, NULL);
            assert_int_equal(read.channels, formats[k].channels_back[channels]);
            for (int p = 0; p < 64 * 16 && read.channels == channels; p++) {
                compare_pixel(wrote.pixels + p * channels, read.pixels + p * channels, channels,
                              &formats[k]);
            }
            glint_image_free(&wrote);
            glint_image_free(&read);
        }
    }
    assert_int_equal(scratch_count(), 5);
}

static void float_exr_is_exact_and_every_compression_reads_back(void **state)
{
    (void)state;
    static const char *const lossless[] = {"none", "rle", "zip", "zips", "piz"};
    static const char *const lossy[] = {"pxr24", "b44", "b44a", "dwaa", "dwab"};
    glint_image wrote = make_ramp(4);
    for (int k = 0; k < 10; k++) {
        glint_write_options options = {.exr_float = true,
                                       .compression = k < 5 ? lossless[k] : lossy[k - 5]};
        glint_error error = {0};
        if (glint_image_write(scratch_path("a.exr"), &wrote, &options, &error) != GLINT_OK) {
            fail_msg("%s", error.message);
        }
        glint_image read = image_file_read("a.exr", NULL);
        if (k < 5) {
            assert_memory_equal(wrote.pixels, read.pixels, 64 * 16 * 4 * sizeof(float));
        }
        glint_image_free(&read);
    }
    glint_image_free(&wrote);
}

// Makes two layers for a ramp: values that half cannot hold, and others.
static void make_layers(float values[2][64 * 16], glint_channel channels[2])
{
    static const char *const names[] = {"triangle.index", "depth.surfaces"};
    for (int c = 0; c < 2; c++) {
        channels[c] = (glint_channel){names[c], values[c]};
        for (int p = 0; p < 64 * 16; p++) {
            values[c][p] = c == 0 ? (float)((1 << 24) - p) : (float)(p % 7) - 1.0f;
        }
    }
}

// Finds a row of an EXR without compression. The file ends with its rows. Each row holds two
// integers, then its channels by their names' byte order.
static const unsigned char *find_exr_row(const unsigned char *bytes, size_t length, int row,
                                         size_t row_bytes)
{
    return bytes + length - (size_t)(16 - row) * (8 + row_bytes) + 8;
}

static void further_channels_are_floats_behind_a_picture_of_half(void **state)
{
    (void)state;
    static float values[2][64 * 16];
    glint_channel channels[2];
    make_layers(values, channels);
    glint_image wrote = make_ramp(4);
    const glint_write_options options = {
        .compression = "none", .channels = channels, .channel_count = 2};
    assert_int_equal(glint_image_write(scratch_path("a.exr"), &wrote, &options, NULL), GLINT_OK);
    size_t length;
    unsigned char *bytes = scratch_read("a.exr", &length);
    assert_non_null(bytes);
    for (int row = 0; row < 16; row++) {
        // A, B, G and R as half, then depth and triangle.
        const unsigned char *begin = find_exr_row(bytes, length, row, 64 * (4 * 2 + 2 * 4));
        assert_memory_equal(begin + 64 * 8, values[1] + 64 * row, 64 * 4);
        assert_memory_equal(begin + 64 * 12, values[0] + 64 * row, 64 * 4);
    }
    free(bytes);
    glint_image_free(&wrote);
}

static void a_reader_of_the_picture_does_not_see_further_channels(void **state)
{
    (void)state;
    // DWA is left out: its loss depends on the other channels.
    static const char *const compressions[] = {"rle", "zip", "piz", "pxr24", "b44"};
    static float values[2][64 * 16];
    glint_channel channels[2];
    make_layers(values, channels);
    for (int k = 0; k < 5; k++) {
        for (int in_image = 1; in_image <= 4; in_image++) {
            glint_image wrote = make_ramp(in_image);
            glint_write_options options = {.exr_float = k % 2 == 0, .compression = compressions[k]};
            assert_int_equal(glint_image_write(scratch_path("a.exr"), &wrote, &options, NULL),
                             GLINT_OK);
            options.channels = channels;
            options.channel_count = 2;
            assert_int_equal(glint_image_write(scratch_path("b.exr"), &wrote, &options, NULL),
                             GLINT_OK);
            glint_image plain = image_file_read("a.exr", NULL),
                        layered = image_file_read("b.exr", NULL);
            assert_int_equal(layered.channels, in_image);
            assert_memory_equal(plain.pixels, layered.pixels,
                                64 * 16 * (size_t)in_image * sizeof(float));
            glint_image_free(&wrote);
            glint_image_free(&plain);
            glint_image_free(&layered);
        }
    }
}

static void jpeg_is_close_and_over_black(void **state)
{
    (void)state;
    glint_image wrote, read;
    assert_int_equal(glint_image_create(64, 64, 4, &wrote, NULL), GLINT_OK);
    for (int p = 0; p < 64 * 64; p++) {
        for (int c = 0; c < 3; c++) {
            wrote.pixels[4 * p + c] = 0.25f * (float)(p % 64) / 64.0f * (float)(c + 1);
        }
        wrote.pixels[4 * p + 3] = 0.5f;
    }
    assert_int_equal(glint_image_write(scratch_path("a.jpg"), &wrote, NULL, NULL), GLINT_OK);
    read = image_file_read("a.jpg", NULL);
    assert_int_equal(read.channels, 3);
    double worst = 0.0;
    for (int p = 0; p < 64 * 64; p++) {
        for (int c = 0; c < 3; c++) {
            worst = fmax(worst, fabs(srgb_from_linear((double)wrote.pixels[4 * p + c]) -
                                     srgb_from_linear((double)read.pixels[3 * p + c])));
        }
    }
    // At quality 95 the largest quantisation step is 12 of 255, for the finest luma detail. A
    // smooth ramp has no such detail: a handful of codes.
    assert_true(worst * 255.0 < 6.0);
    glint_image_free(&wrote);
    glint_image_free(&read);
}

static void jpeg_orientation_is_applied(void **state)
{
    (void)state;
    // APP1 with one EXIF entry: orientation 6, the top row of the file is on the right.
    static const unsigned char exif[] = {0xff, 0xe1, 0, 34, 'E', 'x', 'i', 'f', 0, 0,  'M', 'M',
                                         0,    42,   0, 0,  0,   8,   0,   1,   1, 18, 0,   3,
                                         0,    0,    0, 1,  0,   6,   0,   0,   0, 0,  0,   0};
    image_file_write_noise("a.jpg", 3);
    glint_image plain = image_file_read("a.jpg", NULL);
    size_t length;
    unsigned char *bytes = scratch_read("a.jpg", &length);
    assert_non_null(bytes);
    // Insert it after the start of image; the file's own EXIF follows and comes too late.
    unsigned char *longer = malloc(length + sizeof exif);
    assert_non_null(longer);
    memcpy(longer, bytes, 2);
    memcpy(longer + 2, exif, sizeof exif);
    memcpy(longer + 2 + sizeof exif, bytes + 2, length - 2);
    scratch_write("b.jpg", longer, (long)(length + sizeof exif));
    free(bytes);
    free(longer);
    glint_image turned = image_file_read("b.jpg", NULL);
    assert_int_equal(turned.width, plain.height);
    assert_int_equal(turned.height, plain.width);
    for (int y = 0; y < turned.height; y++) {
        for (int x = 0; x < turned.width; x++) {
            const float *from = glint_image_pixel(&plain, y, turned.width - 1 - x);
            assert_memory_equal(glint_image_pixel(&turned, x, y), from, 3 * sizeof(float));
        }
    }
    glint_image_free(&plain);
    glint_image_free(&turned);
}

// The largest half is 65504. Larger values must not become infinite, and NaN must stay visible.
static void values_that_half_cannot_hold_are_clamped(void **state)
{
    (void)state;
    const float values[24] = {65504.0f, 65519.9f,  65520.0f,  1e6f,      3e38f, INFINITY,
                              -1e6f,    -INFINITY, NAN,       -65504.0f, 1e-9f, 0.5f,
                              65504.0f, 7e4f,      -7e4f,     INFINITY,  NAN,   NAN,
                              1.0f,     2.0f,      -INFINITY, 3.0f,      1e30f, 4.0f};
    glint_image image = {8, 1, 3, (float *)values};
    assert_int_equal(glint_image_write(scratch_path("a.exr"), &image, NULL, NULL), GLINT_OK);
    glint_image read = image_file_read("a.exr", NULL);
    for (int i = 0; i < 24; i++) {
        if (isnan(values[i])) {
            assert_true(isnan(read.pixels[i]));
            continue;
        }
        double wanted = fmax(-65504.0, fmin(65504.0, (double)values[i]));
        assert_true(fabs((double)read.pixels[i] - wanted) <= fabs(wanted) / 2048 + 6e-8);
    }
    glint_image_free(&read);
    // RGBE has one exponent for three values: a pixel with 1e30 has no room for small values.
    assert_int_equal(glint_image_write(scratch_path("a.hdr"), &image, NULL, NULL), GLINT_OK);
    read = image_file_read("a.hdr", NULL);
    for (int i = 0; i < 24; i++) {
        assert_true(isfinite(read.pixels[i]) && read.pixels[i] >= 0.0f);
    }
    glint_image_free(&read);
}

// A pattern of the largest and other values, different in each channel. B44's blocks are 4 × 4,
// those of DWA 8 × 8.
static glint_image make_extremes(int pattern)
{
    static const float others[] = {0, 1, 3e4f, -1e6f, -INFINITY, -65504};
    glint_image image;
    assert_int_equal(glint_image_create(256, 256, 4, &image, NULL), GLINT_OK);
    unsigned seed = 7;
    for (int i = 0; i < 256 * 256 * 4; i++) {
        const int x = i / 4 % 256, y = i / 1024;
        seed = seed * 1664525u + 1013904223u;
        bool is_high = seed >> 31 != 0;
        if (pattern == 1) {
            is_high = (x % 8 < 4) == (i % 4 == 1); // edges, opposite in green
        } else if (pattern == 2) {
            is_high = (x + y + i % 4) % 8 < 5;
        }
        const float other = others[(x / 8 + y / 8) % 6];
        image.pixels[i] = i % 4 == 3 ? 1 : is_high ? (seed >> 30 & 1 ? 65504 : INFINITY) : other;
    }
    return image;
}

// Losses once made infinities of 65504 (DWA) and of −65504 (B44). Values stay within DWA's own
// error of the largest value that a file keeps.
static void lossy_compressions_make_nothing_infinite(void **state)
{
    (void)state;
    static const char *const compressions[] = {"pxr24", "b44", "b44a", "dwaa", "dwab"};
    for (int k = 0; k < 30; k++) {
        const char *compression = compressions[k % 5];
        glint_image wrote = make_extremes(k / 10);
        // PXR24 and B44 keep floats, also infinite ones.
        const glint_write_options options = {.exr_float = k % 10 >= 8, .compression = compression};
        assert_int_equal(glint_image_write(scratch_path("a.exr"), &wrote, &options, NULL),
                         GLINT_OK);
        glint_image read = image_file_read("a.exr", NULL);
        for (int i = 0; i < 256 * 256 * 4; i++) {
            const double value = (double)read.pixels[i];
            const bool is_high = i % 4 < 3 && wrote.pixels[i] >= 65504;
            if (!isfinite(value) || (is_high && value < 57000)) {
                fail_msg("%s: %g becomes %g", compression, (double)wrote.pixels[i], value);
            }
        }
        glint_image_free(&wrote);
        glint_image_free(&read);
    }
}

static void exposure_is_stops_and_leaves_exr_alone(void **state)
{
    (void)state;
    float gray[3] = {0.05f, 0.1f, 0.2f};
    glint_image image = {1, 1, 3, gray};
    glint_write_options options = {.exposure = 2.0f};
    assert_int_equal(glint_image_write(scratch_path("a.png"), &image, &options, NULL), GLINT_OK);
    assert_int_equal(glint_image_write(scratch_path("a.exr"), &image, &options, NULL), GLINT_OK);
    glint_image png = image_file_read("a.png", NULL), exr = image_file_read("a.exr", NULL);
    for (int c = 0; c < 3; c++) {
        assert_true(fabs(255.0 * (srgb_from_linear((double)png.pixels[c]) -
                                  srgb_from_linear(4.0 * (double)gray[c]))) < 0.5001);
        assert_true(fabs((double)(exr.pixels[c] - gray[c])) <= (double)gray[c] / 2048);
    }
    glint_image_free(&png);
    glint_image_free(&exr);
}

// ---- Metadata, as OpenEXR's file layout has it --------------------------------------------------

static const unsigned char *find_attribute(const unsigned char *bytes, size_t length,
                                           const char *name, const char *type)
{
    char wanted[256];
    size_t size = strlen(name) + strlen(type) + 2;
    snprintf(wanted, sizeof wanted, "%s%c%s", name, 0, type);
    for (size_t i = 0; i + size + 4 < length; i++) {
        if (memcmp(bytes + i, wanted, size - 1) == 0 && bytes[i + size - 1] == 0) {
            return bytes + i + size + 4; // after the size
        }
    }
    return NULL;
}

// A regression test: numbers once had empty values.
static void png_metadata_is_text_with_its_values(void **state)
{
    (void)state;
    const glint_metadata metadata[] = {
        {.name = "glint:frame", .type = GLINT_METADATA_INT, .integer = 42},
        {.name = "matrix", .type = GLINT_METADATA_MATRIX}, // left out
        {.name = "glint:exposure", .type = GLINT_METADATA_FLOAT, .real = 1.5f},
        {.name = "scene", .type = GLINT_METADATA_STRING, .string = "a b"},
        {.name = "nothing", .type = GLINT_METADATA_STRING}};
    static const char text[] = "tEXtDescription\0glint:frame: 42\nglint:exposure: 1.5\nscene: a b\n"
                               "nothing: \n";
    glint_image image = make_ramp(3);
    const glint_write_options options = {.metadata = metadata, .metadata_count = 5};
    assert_int_equal(glint_image_write(scratch_path("m.png"), &image, &options, NULL), GLINT_OK);
    size_t length;
    unsigned char *bytes = scratch_read("m.png", &length);
    assert_non_null(bytes);
    assert_non_null(memmem(bytes, length, text, sizeof text - 1));
    free(bytes);
    glint_image_free(&image);
}

static void exr_metadata_has_openexrs_types(void **state)
{
    (void)state;
    glint_metadata metadata[] = {
        {.name = "worldToCamera", .type = GLINT_METADATA_MATRIX},
        {.name = "worldToNDC", .type = GLINT_METADATA_MATRIX},
        {.name = "glint:frame", .type = GLINT_METADATA_INT, .integer = 42},
        {.name = "glint:seconds", .type = GLINT_METADATA_FLOAT, .real = 1.5f},
        {.name = "glint:scene", .type = GLINT_METADATA_STRING, .string = "gallery.gltf"},
    };
    for (int i = 0; i < 16; i++) {
        metadata[0].matrix[i] = (float)i + 0.25f;
        metadata[1].matrix[i] = (float)i + 100.25f;
    }
    glint_image image = make_ramp(3);
    glint_write_options options = {
        .metadata = metadata, .metadata_count = 5, .envmap = GLINT_ENVMAP_LATLONG};
    assert_int_equal(glint_image_write(scratch_path("a.exr"), &image, &options, NULL), GLINT_OK);
    size_t length;
    unsigned char *bytes = scratch_read("a.exr", &length);
    assert_non_null(bytes);
    // Check the attributes in the file.
    for (int k = 0; k < 2; k++) {
        const unsigned char *matrix = find_attribute(bytes, length, metadata[k].name, "m44f");
        assert_non_null(matrix);
        assert_memory_equal(matrix, metadata[k].matrix, sizeof metadata[k].matrix);
    }
    const unsigned char *number = find_attribute(bytes, length, "glint:frame", "int");
    assert_non_null(number);
    assert_int_equal(number[0], 42);
    const unsigned char *real = find_attribute(bytes, length, "glint:seconds", "float");
    assert_non_null(real);
    assert_memory_equal(real, &metadata[3].real, sizeof(float));
    const unsigned char *text = find_attribute(bytes, length, "glint:scene", "string");
    assert_non_null(text);
    assert_memory_equal(text, "gallery.gltf", 12);
    const unsigned char *envmap = find_attribute(bytes, length, "envmap", "envmap");
    assert_non_null(envmap);
    assert_int_equal(envmap[0], 0);
    free(bytes);
    // The other formats write the values that they support.
    assert_int_equal(glint_image_write(scratch_path("a.png"), &image, &options, NULL), GLINT_OK);
    assert_int_equal(glint_image_write(scratch_path("a.tif"), &image, &options, NULL), GLINT_OK);
    assert_int_equal(glint_image_write(scratch_path("a.jpg"), &image, &options, NULL), GLINT_OK);
    assert_int_equal(glint_image_write(scratch_path("a.hdr"), &image, &options, NULL), GLINT_OK);
    for (int k = 0; k < 4; k++) {
        static const char *const names[] = {"a.png", "a.tif", "a.jpg", "a.hdr"};
        glint_image read = image_file_read(names[k], NULL);
        glint_image_free(&read);
    }
    glint_image_free(&image);
}

static void envmap_cube_is_written_as_the_attribute(void **state)
{
    (void)state;
    glint_image image;
    assert_int_equal(glint_image_create(4, 24, 3, &image, NULL), GLINT_OK);
    glint_write_options options = {.envmap = GLINT_ENVMAP_CUBE};
    assert_int_equal(glint_image_write(scratch_path("a.exr"), &image, &options, NULL), GLINT_OK);
    glint_image_free(&image);
    size_t length;
    unsigned char *bytes = scratch_read("a.exr", &length);
    assert_non_null(bytes);
    const unsigned char *envmap = find_attribute(bytes, length, "envmap", "envmap");
    assert_non_null(envmap);
    assert_int_equal(envmap[0], 1);
    free(bytes);
    glint_image_facts facts = {0};
    image = image_file_read("a.exr", &facts);
    assert_int_equal(facts.envmap, GLINT_ENVMAP_CUBE);
    assert_int_equal(image.height, 24);
    glint_image_free(&image);
}

static void output_is_checked_before_work_is_done(void **state)
{
    (void)state;
    static const char *const good[] = {"a.exr",  "b/c.HDR", "a.b.png", "x.jpg",
                                       "x.jpeg", "x.tif",   "x.tiff"};
    static const char *const bad[] = {"a", "a.bmp", "exr", ".exr", "a.exr/b", "a.png~", ""};
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        assert_true(glint_image_can_write(good[i]));
        assert_int_equal(glint_image_check_output(good[i], NULL, NULL), GLINT_OK);
    }
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_false(glint_image_can_write(bad[i]));
        assert_int_equal(glint_image_check_output(bad[i], NULL, NULL), GLINT_USAGE);
    }
    static const struct {
        const char *path, *compression;
        glint_status status;
    } given[] = {
        {"a.exr", "piz", GLINT_OK},    {"a.exr", "lzw", GLINT_USAGE}, {"a.exr", "0", GLINT_USAGE},
        {"a.tif", "lzw", GLINT_OK},    {"a.tif", "piz", GLINT_USAGE}, {"a.png", "9", GLINT_OK},
        {"a.png", "10", GLINT_USAGE},  {"a.png", "zip", GLINT_USAGE}, {"a.jpg", "100", GLINT_OK},
        {"a.jpg", "0", GLINT_USAGE},   {"a.jpg", "9x", GLINT_USAGE},  {"a.hdr", "rle", GLINT_USAGE},
        {"a.jpg", " 90", GLINT_USAGE}, {"a.exr", "", GLINT_USAGE},
    };
    for (size_t i = 0; i < sizeof given / sizeof given[0]; i++) {
        glint_write_options options = {.compression = given[i].compression};
        assert_int_equal(glint_image_check_output(given[i].path, &options, NULL), given[i].status);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, scratch_setup, scratch_teardown)
        IN_FOLDER(what_is_written_is_read_again),
        IN_FOLDER(float_exr_is_exact_and_every_compression_reads_back),
        IN_FOLDER(further_channels_are_floats_behind_a_picture_of_half),
        IN_FOLDER(a_reader_of_the_picture_does_not_see_further_channels),
        IN_FOLDER(jpeg_is_close_and_over_black),
        IN_FOLDER(jpeg_orientation_is_applied),
        IN_FOLDER(values_that_half_cannot_hold_are_clamped),
        IN_FOLDER(lossy_compressions_make_nothing_infinite),
        IN_FOLDER(exposure_is_stops_and_leaves_exr_alone),
        IN_FOLDER(png_metadata_is_text_with_its_values),
        IN_FOLDER(exr_metadata_has_openexrs_types),
        IN_FOLDER(envmap_cube_is_written_as_the_attribute),
        IN_FOLDER(output_is_checked_before_work_is_done),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
