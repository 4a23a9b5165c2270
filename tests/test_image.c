// Image files: what is read is what the formats' specifications say is there, what is written can
// be read again to within the format's own rounding, and bad files get one clear answer. The oracle
// is files put together byte by byte (support/image_bytes.c) and the formulas of IEC 61966-2-1.
#include "image/color.h"
#include "image/image_io.h"
#include "support/image_bytes.h"
#include "support/scratch.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

static int make_folder(void **state)
{
    (void)state;
    scratch_make();
    return 0;
}

static int remove_folder(void **state)
{
    (void)state;
    scratch_remove();
    return 0;
}

// ---- Colour -------------------------------------------------------------------------------------

static double curve(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
}

static void srgb_codes_survive_decoding_and_encoding(void **state)
{
    (void)state;
    for (int code = 0; code < 256; code++) {
        float linear = glint_srgb_to_linear((float)code / 255.0f);
        assert_int_equal(glint_linear_to_srgb8(linear), code);
        // Decoding rounds to float, 2⁻²⁴ of the value; encoding has a slope of at most 12.92 and
        // rounds once more.
        assert_true(fabs((double)glint_linear_to_srgb(linear) - code / 255.0) < 2e-7);
    }
}

// Every float from 2⁻¹⁴ to 1 in steps of 37 units in the last place, against the formula in double;
// at a threshold itself the rounding of the formula decides, hence the 1e-9.
static void eight_bit_codes_are_the_rounded_curve(void **state)
{
    (void)state;
    for (uint32_t bits = 0x38800000u; bits <= 0x3f800000u; bits += 37) {
        float linear;
        memcpy(&linear, &bits, sizeof linear);
        double exact = 255.0 * curve((double)linear);
        if (fabs(glint_linear_to_srgb8(linear) - exact) > 0.5 + 1e-9) {
            fail_msg("%a becomes %d, exactly %f", (double)linear, glint_linear_to_srgb8(linear),
                     exact);
        }
    }
}

static void values_outside_the_range_are_clamped(void **state)
{
    (void)state;
    const float low[] = {NAN, -NAN, -1.0f, -INFINITY, 0.0f, -0.0f, 1e-40f};
    for (size_t i = 0; i < sizeof low / sizeof low[0]; i++) {
        assert_int_equal(glint_linear_to_srgb8(low[i]), 0);
        assert_true(glint_linear_to_srgb(low[i]) < 1e-30f);
    }
    assert_int_equal(glint_linear_to_srgb8(1.0f), 255);
    assert_int_equal(glint_linear_to_srgb8(1e30f), 255);
    assert_int_equal(glint_linear_to_srgb8(INFINITY), 255);
    assert_true(glint_linear_to_srgb(INFINITY) == 1.0f);
}

// ---- Reading what was put together by hand ------------------------------------------------------

static glint_image read_image(const char *name, glint_image_facts *facts)
{
    glint_image image;
    glint_error error = {0};
    if (glint_image_read(scratch_path(name), &image, facts, &error) != GLINT_OK) {
        fail_msg("%s", error.message);
    }
    return image;
}

static void refuse(const char *path, const char *said)
{
    glint_image image;
    glint_error error = {0};
    assert_int_equal(glint_image_read(path, &image, NULL, &error), GLINT_BAD_INPUT);
    assert_null(image.pixels);
    if (strncmp(error.message, path, strlen(path)) != 0 || strstr(error.message, said) == NULL) {
        fail_msg("'%s' does not say '%s'", error.message, said);
    }
}

static void radiance_pixels_are_mantissas_times_a_power(void **state)
{
    (void)state;
    const unsigned char rgbe[] = {128, 64,  32, 129, 255, 1, 0, 120, 0, 0, 0, 0,
                                  10,  200, 77, 140, 1,   2, 3, 100, 9, 8, 7, 128};
    image_bytes file = hdr_bytes(3, 2, rgbe);
    scratch_write("a.hdr", file.bytes, (long)file.length);
    image_bytes_free(&file);
    glint_image image = read_image("a.hdr", NULL);
    assert_int_equal(image.width, 3);
    assert_int_equal(image.height, 2);
    assert_int_equal(image.channels, 3);
    for (int p = 0; p < 6; p++) {
        for (int c = 0; c < 3; c++) {
            // Ward 1991: (m + ½)·2^(e − 136), or m·2^(e − 136) as most programs have it.
            double low = rgbe[4 * p + c] * ldexp(1.0, rgbe[4 * p + 3] - 136);
            double high = (rgbe[4 * p + c] + 0.5) * ldexp(1.0, rgbe[4 * p + 3] - 136);
            double value = (double)image.pixels[3 * p + c];
            assert_true(value == low || value == high || rgbe[4 * p + 3] == 0);
        }
    }
    assert_true(image.pixels[6] == 0.0f);
    glint_image_free(&image);
}

static glint_image read_tiff(const tiff_recipe *recipe, glint_image_facts *facts)
{
    image_bytes file = tiff_bytes(recipe);
    scratch_write("a.tif", file.bytes, (long)file.length);
    image_bytes_free(&file);
    return read_image("a.tif", facts);
}

static double decode(double code)
{
    return code <= 0.04045 ? code / 12.92 : pow((code + 0.055) / 1.055, 2.4);
}

static void whole_numbers_are_linearised_and_floats_are_not(void **state)
{
    (void)state;
    uint16_t codes[256 * 3];
    for (int i = 0; i < 256 * 3; i++) {
        codes[i] = (uint16_t)(i / 3);
    }
    glint_image_facts facts = {0};
    glint_image image = read_tiff(&(tiff_recipe){256, 1, 3, 8, 0, 1, codes}, &facts);
    assert_true(facts.was_encoded);
    for (int i = 0; i < 256 * 3; i++) {
        assert_true(fabs((double)image.pixels[i] - decode(codes[i] / 255.0)) < 1e-7);
        codes[i] = (uint16_t)(i * 85);
    }
    glint_image_free(&image);
    image = read_tiff(&(tiff_recipe){256, 1, 3, 16, 0, 1, codes}, &facts);
    assert_true(facts.was_encoded);
    for (int i = 0; i < 256 * 3; i++) {
        assert_true(fabs((double)image.pixels[i] - decode(codes[i] / 65535.0)) < 1e-7);
    }
    glint_image_free(&image);
}

static void alpha_is_premultiplied_after_linearising(void **state)
{
    (void)state;
    // Beside: the colour is the code's. Premultiplied before the curve: the colour is code / alpha.
    const uint16_t codes[] = {200, 100, 50, 128, 60, 30, 20, 64, 9, 8, 7, 0, 255, 128, 0, 255};
    for (int extra = 1; extra <= 2; extra++) {
        glint_image image = read_tiff(&(tiff_recipe){4, 1, 4, 8, extra, 1, codes}, NULL);
        assert_int_equal(image.channels, 4);
        for (int p = 0; p < 4; p++) {
            double alpha = codes[4 * p + 3] / 255.0;
            assert_true(fabs((double)image.pixels[4 * p + 3] - alpha) < 1e-7);
            for (int c = 0; c < 3 && alpha > 0.0; c++) {
                double code = codes[4 * p + c] / 255.0;
                double wanted = alpha * decode(extra == 2 ? code : code / alpha);
                // The power multiplies relative roundings by 2.4.
                assert_true(fabs((double)image.pixels[4 * p + c] - wanted) <= 1e-6 * wanted);
            }
        }
        glint_image_free(&image);
    }
}

static void grey_and_grey_with_alpha_keep_their_channels(void **state)
{
    (void)state;
    const uint16_t codes[] = {0, 255, 128, 64, 255, 0};
    glint_image image = read_tiff(&(tiff_recipe){6, 1, 1, 8, 0, 1, codes}, NULL);
    assert_int_equal(image.channels, 1);
    assert_true(fabs((double)image.pixels[2] - decode(128 / 255.0)) < 1e-7);
    glint_image_free(&image);
    image = read_tiff(&(tiff_recipe){3, 1, 2, 8, 2, 1, codes}, NULL);
    assert_int_equal(image.channels, 2);
    assert_true(fabs((double)image.pixels[2] - decode(128 / 255.0) * 64 / 255.0) < 1e-7);
    glint_image_free(&image);
}

// TIFF 6.0, tag 274: what the 0th row and the 0th column of the stored picture show.
static void orientation_is_applied(void **state)
{
    (void)state;
    // The upright picture is 3 × 2, pixel (x, y) holding the code 40·(3 y + x) + 20.
    static const char rows[9] = "-ttbblrrl", columns[9] = "-lrrlttbb";
    for (int orientation = 1; orientation <= 8; orientation++) {
        bool turned = orientation >= 5;
        int width = turned ? 2 : 3, height = turned ? 3 : 2;
        uint16_t codes[6];
        for (int row = 0; row < height; row++) {
            for (int column = 0; column < width; column++) {
                char r = rows[orientation], c = columns[orientation];
                int x = turned ? (r == 'l' ? row : 2 - row) : (c == 'l' ? column : 2 - column);
                int y = turned ? (c == 't' ? column : 1 - column) : (r == 't' ? row : 1 - row);
                codes[row * width + column] = (uint16_t)(40 * (3 * y + x) + 20);
            }
        }
        glint_image image =
            read_tiff(&(tiff_recipe){width, height, 1, 8, 0, orientation, codes}, NULL);
        assert_int_equal(image.width, 3);
        assert_int_equal(image.height, 2);
        for (int i = 0; i < 6; i++) {
            assert_int_equal(glint_linear_to_srgb8(image.pixels[i]), 40 * i + 20);
        }
        glint_image_free(&image);
    }
}

static float coded_value(int channel, int x, int y, void *context)
{
    (void)context;
    return (float)(1000 * channel + 10 * x + y) / 7.0f;
}

static glint_image read_exr(const exr_recipe *recipe, glint_image_facts *facts)
{
    image_bytes file = exr_bytes(recipe);
    scratch_write("a.exr", file.bytes, (long)file.length);
    image_bytes_free(&file);
    return read_image("a.exr", facts);
}

static void exr_channels_are_found_by_name(void **state)
{
    (void)state;
    static const char *const shuffled[] = {"A", "B", "G", "R", "Z"};
    static const char *const layered[] = {"ViewLayer.Combined.A", "ViewLayer.Combined.B",
                                          "ViewLayer.Combined.G", "ViewLayer.Combined.R",
                                          "ViewLayer.Depth.Z"};
    for (int k = 0; k < 2; k++) {
        exr_recipe recipe = {
            k == 0 ? shuffled : layered, 5, {0, 0, 4, 2}, {0, 0, 4, 2}, -1, coded_value, NULL};
        glint_image image = read_exr(&recipe, NULL);
        assert_int_equal(image.channels, 4);
        static const int place[4] = {3, 2, 1, 0};
        for (int y = 0; y < 3; y++) {
            for (int x = 0; x < 5; x++) {
                for (int c = 0; c < 4; c++) {
                    assert_true(glint_image_pixel(&image, x, y)[c] ==
                                coded_value(place[c], x, y, NULL));
                }
            }
        }
        glint_image_free(&image);
    }
}

static void exr_with_two_colour_layers_is_refused(void **state)
{
    (void)state;
    static const char *const names[] = {"a.B", "a.G", "a.R", "b.B", "b.G", "b.R"};
    exr_recipe recipe = {names, 6, {0, 0, 1, 1}, {0, 0, 1, 1}, -1, coded_value, NULL};
    image_bytes file = exr_bytes(&recipe);
    scratch_write("a.exr", file.bytes, (long)file.length);
    image_bytes_free(&file);
    refuse(scratch_path("a.exr"), "several layers: a, b");
}

static void exr_without_colour_is_refused_with_its_channels_named(void **state)
{
    (void)state;
    static const char *const names[] = {"N.x", "N.y", "depth.Z"};
    exr_recipe recipe = {names, 3, {0, 0, 1, 1}, {0, 0, 1, 1}, -1, coded_value, NULL};
    image_bytes file = exr_bytes(&recipe);
    scratch_write("a.exr", file.bytes, (long)file.length);
    image_bytes_free(&file);
    refuse(scratch_path("a.exr"), "depth.Z");
}

// The display window is the picture: cropped pixels are framed with zero, those outside cut off.
static void exr_pixels_stand_in_the_display_window(void **state)
{
    (void)state;
    static const char *const names[] = {"B", "G", "R"};
    exr_recipe recipe = {names, 3, {2, -1, 9, 3}, {0, 0, 6, 4}, -1, coded_value, NULL};
    glint_image image = read_exr(&recipe, NULL);
    assert_int_equal(image.width, 7);
    assert_int_equal(image.height, 5);
    for (int y = 0; y < 5; y++) {
        for (int x = 0; x < 7; x++) {
            bool inside = x >= 2 && y <= 3;
            float wanted = inside ? coded_value(2, x, y, NULL) : 0.0f;
            assert_true(glint_image_pixel(&image, x, y)[0] == wanted);
        }
    }
    glint_image_free(&image);
}

static void exr_envmap_attribute_is_told(void **state)
{
    (void)state;
    static const char *const names[] = {"B", "G", "R"};
    static const glint_envmap wanted[] = {GLINT_ENVMAP_NONE, GLINT_ENVMAP_LATLONG,
                                          GLINT_ENVMAP_CUBE};
    for (int envmap = -1; envmap <= 1; envmap++) {
        exr_recipe recipe = {names, 3, {0, 0, 3, 23}, {0, 0, 3, 23}, envmap, coded_value, NULL};
        glint_image_facts facts = {0};
        glint_image image = read_exr(&recipe, &facts);
        assert_int_equal(facts.envmap, wanted[envmap + 1]);
        assert_false(facts.was_encoded);
        assert_int_equal(image.width, 4);
        assert_int_equal(image.height, 24);
        glint_image_free(&image);
    }
}

static void content_decides_over_the_extension(void **state)
{
    (void)state;
    static const char *const names[] = {"B", "G", "R"};
    exr_recipe recipe = {names, 3, {0, 0, 3, 3}, {0, 0, 3, 3}, -1, coded_value, NULL};
    image_bytes file = exr_bytes(&recipe);
    scratch_write("really_an_exr.hdr", file.bytes, (long)file.length);
    image_bytes_free(&file);
    glint_image image = read_image("really_an_exr.hdr", NULL);
    assert_true(image.pixels[0] == coded_value(2, 0, 0, NULL));
    glint_image_free(&image);
}

// ---- Bad files ----------------------------------------------------------------------------------

static void what_is_no_picture_is_refused_by_name(void **state)
{
    (void)state;
    refuse(scratch_path("missing.hdr"), "No such file");
    refuse(scratch_path(""), "is a folder");
    refuse("/dev/zero", "no regular file");
    scratch_write("empty.exr", "", 0);
    refuse(scratch_path("empty.exr"), "is empty");
    scratch_write("text.png", "not a picture, but long enough to look at", -1);
    refuse(scratch_path("text.png"), "no image of a kind that is read");
    scratch_write("one.png", "\x89", 1);
    refuse(scratch_path("one.png"), "no image");
    scratch_write("a.gif", "GIF89a..............", -1);
    refuse(scratch_path("a.gif"), "GIF");
    scratch_write("a.jpg", "BM..................", -1);
    refuse(scratch_path("a.jpg"), "BMP");
    scratch_write("a.psd", "8BPS................", -1);
    refuse(scratch_path("a.psd"), "PSD");
}

static void a_small_file_that_claims_to_be_huge_is_refused(void **state)
{
    (void)state;
    scratch_write("huge.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 40000 +X 40000\n", 53);
    refuse(scratch_path("huge.hdr"), "40000 × 40000");
}

// Noise, so that no encoding makes it short, and every part of the file matters.
static void write_noise(const char *name, int channels)
{
    glint_image image;
    glint_error error = {0};
    assert_int_equal(glint_image_create(40, 30, channels, &image, &error), GLINT_OK);
    unsigned seed = 1;
    for (int i = 0; i < 40 * 30 * channels; i++) {
        seed = seed * 1664525u + 1013904223u;
        image.pixels[i] = (float)(seed >> 8) / 16777216.0f;
    }
    if (glint_image_write(scratch_path(name), &image, NULL, &error) != GLINT_OK) {
        fail_msg("%s", error.message);
    }
    glint_image_free(&image);
}

static const char *const noise_names[] = {"n.exr", "n.hdr", "n.png", "n.tif", "n.jpg"};

static void truncated_files_are_refused(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof noise_names / sizeof noise_names[0]; k++) {
        size_t length;
        write_noise(noise_names[k], 3);
        unsigned char *bytes = scratch_read(noise_names[k], &length);
        assert_non_null(bytes);
        for (size_t part = 1; part < 20; part++) {
            scratch_write("short", bytes, (long)(length * part / 20));
            refuse(scratch_path("short"), "(");
        }
        free(bytes);
    }
}

// Any answer will do, as long as there is one: no crash, no hang, nothing outside the picture.
static void damaged_files_are_survived(void **state)
{
    (void)state;
    unsigned seed = 2;
    for (size_t k = 0; k < sizeof noise_names / sizeof noise_names[0]; k++) {
        size_t length;
        write_noise(noise_names[k], 3);
        unsigned char *bytes = scratch_read(noise_names[k], &length);
        assert_non_null(bytes);
        for (int round = 0; round < 40; round++) {
            unsigned char kept[4];
            size_t places[4];
            for (int i = 0; i < 4; i++) {
                seed = seed * 1664525u + 1013904223u;
                // Headers matter most.
                places[i] = (seed >> 8) % (i < 3 && length > 400 ? 400 : length);
                kept[i] = bytes[places[i]];
                bytes[places[i]] = (unsigned char)(seed >> 24);
            }
            scratch_write("damaged", bytes, (long)length);
            glint_image image;
            glint_status status = glint_image_read(scratch_path("damaged"), &image, NULL, NULL);
            assert_true(status == GLINT_OK ? image.pixels != NULL : image.pixels == NULL);
            glint_image_free(&image);
            for (int i = 3; i >= 0; i--) {
                bytes[places[i]] = kept[i];
            }
        }
        free(bytes);
    }
}

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

// How far apart linear values may be that a format holds: relative to the largest of a pixel, and
// in sRGB codes of the colour beside alpha.
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
            // Eight bits of alpha too: dividing by what was rounded is not what is asked here.
            double before = curve((double)wrote[c] / alpha), after = curve((double)read[c] / alpha);
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
    // Half: 11 bits, rounded: 2⁻¹¹. RGBE: 8 bits, cut off or rounded, of a mantissa of at least ½:
    // 2⁻⁷. Eight bits: half a code, and what float makes of it.
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
            glint_image read = read_image(formats[k].name, NULL);
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
        glint_image read = read_image("a.exr", NULL);
        if (k < 5) {
            assert_memory_equal(wrote.pixels, read.pixels, 64 * 16 * 4 * sizeof(float));
        }
        glint_image_free(&read);
    }
    glint_image_free(&wrote);
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
    read = read_image("a.jpg", NULL);
    assert_int_equal(read.channels, 3);
    double worst = 0.0;
    for (int p = 0; p < 64 * 64; p++) {
        for (int c = 0; c < 3; c++) {
            worst = fmax(worst, fabs(curve((double)wrote.pixels[4 * p + c]) -
                                     curve((double)read.pixels[3 * p + c])));
        }
    }
    // At quality 95 the largest quantisation step is 12 of 255 for the finest luma detail, and a
    // smooth ramp has none: a handful of codes.
    assert_true(worst * 255.0 < 6.0);
    glint_image_free(&wrote);
    glint_image_free(&read);
}

static void jpeg_orientation_is_applied(void **state)
{
    (void)state;
    // APP1 with one EXIF entry: orientation 6, the stored top row is on the right.
    static const unsigned char exif[] = {0xff, 0xe1, 0, 34, 'E', 'x', 'i', 'f', 0, 0,  'M', 'M',
                                         0,    42,   0, 0,  0,   8,   0,   1,   1, 18, 0,   3,
                                         0,    0,    0, 1,  0,   6,   0,   0,   0, 0,  0,   0};
    write_noise("a.jpg", 3);
    glint_image plain = read_image("a.jpg", NULL);
    size_t length;
    unsigned char *bytes = scratch_read("a.jpg", &length);
    assert_non_null(bytes);
    // After the start of image; the file's own EXIF, which follows, comes too late.
    unsigned char *longer = malloc(length + sizeof exif);
    assert_non_null(longer);
    memcpy(longer, bytes, 2);
    memcpy(longer + 2, exif, sizeof exif);
    memcpy(longer + 2 + sizeof exif, bytes + 2, length - 2);
    scratch_write("b.jpg", longer, (long)(length + sizeof exif));
    free(bytes);
    free(longer);
    glint_image turned = read_image("b.jpg", NULL);
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

// Half has 65504 as its largest: larger values must not become infinite, and NaN must stay visible.
static void values_that_half_cannot_hold_are_clamped(void **state)
{
    (void)state;
    const float values[24] = {65504.0f, 65519.9f,  65520.0f,  1e6f,      3e38f, INFINITY,
                              -1e6f,    -INFINITY, NAN,       -65504.0f, 1e-9f, 0.5f,
                              65504.0f, 7e4f,      -7e4f,     INFINITY,  NAN,   NAN,
                              1.0f,     2.0f,      -INFINITY, 3.0f,      1e30f, 4.0f};
    glint_image image = {8, 1, 3, (float *)values};
    assert_int_equal(glint_image_write(scratch_path("a.exr"), &image, NULL, NULL), GLINT_OK);
    glint_image read = read_image("a.exr", NULL);
    for (int i = 0; i < 24; i++) {
        if (isnan(values[i])) {
            assert_true(isnan(read.pixels[i]));
            continue;
        }
        double wanted = fmax(-65504.0, fmin(65504.0, (double)values[i]));
        assert_true(fabs((double)read.pixels[i] - wanted) <= fabs(wanted) / 2048 + 6e-8);
    }
    glint_image_free(&read);
    // RGBE keeps one exponent for three: a pixel with 1e30 has no room for small ones.
    assert_int_equal(glint_image_write(scratch_path("a.hdr"), &image, NULL, NULL), GLINT_OK);
    read = read_image("a.hdr", NULL);
    for (int i = 0; i < 24; i++) {
        assert_true(isfinite(read.pixels[i]) && read.pixels[i] >= 0.0f);
    }
    glint_image_free(&read);
}

static void exposure_is_stops_and_leaves_exr_alone(void **state)
{
    (void)state;
    float gray[3] = {0.05f, 0.1f, 0.2f};
    glint_image image = {1, 1, 3, gray};
    glint_write_options options = {.exposure = 2.0f};
    assert_int_equal(glint_image_write(scratch_path("a.png"), &image, &options, NULL), GLINT_OK);
    assert_int_equal(glint_image_write(scratch_path("a.exr"), &image, &options, NULL), GLINT_OK);
    glint_image png = read_image("a.png", NULL), exr = read_image("a.exr", NULL);
    for (int c = 0; c < 3; c++) {
        assert_true(fabs(255.0 * (curve((double)png.pixels[c]) - curve(4.0 * (double)gray[c]))) <
                    0.5001);
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
    // The others take what they can.
    assert_int_equal(glint_image_write(scratch_path("a.png"), &image, &options, NULL), GLINT_OK);
    assert_int_equal(glint_image_write(scratch_path("a.tif"), &image, &options, NULL), GLINT_OK);
    assert_int_equal(glint_image_write(scratch_path("a.jpg"), &image, &options, NULL), GLINT_OK);
    assert_int_equal(glint_image_write(scratch_path("a.hdr"), &image, &options, NULL), GLINT_OK);
    for (int k = 0; k < 4; k++) {
        static const char *const names[] = {"a.png", "a.tif", "a.jpg", "a.hdr"};
        glint_image read = read_image(names[k], NULL);
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
    image = read_image("a.exr", &facts);
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
        cmocka_unit_test(srgb_codes_survive_decoding_and_encoding),
        cmocka_unit_test(eight_bit_codes_are_the_rounded_curve),
        cmocka_unit_test(values_outside_the_range_are_clamped),
#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, make_folder, remove_folder)
        IN_FOLDER(radiance_pixels_are_mantissas_times_a_power),
        IN_FOLDER(whole_numbers_are_linearised_and_floats_are_not),
        IN_FOLDER(alpha_is_premultiplied_after_linearising),
        IN_FOLDER(grey_and_grey_with_alpha_keep_their_channels),
        IN_FOLDER(orientation_is_applied),
        IN_FOLDER(exr_channels_are_found_by_name),
        IN_FOLDER(exr_with_two_colour_layers_is_refused),
        IN_FOLDER(exr_without_colour_is_refused_with_its_channels_named),
        IN_FOLDER(exr_pixels_stand_in_the_display_window),
        IN_FOLDER(exr_envmap_attribute_is_told),
        IN_FOLDER(content_decides_over_the_extension),
        IN_FOLDER(what_is_no_picture_is_refused_by_name),
        IN_FOLDER(a_small_file_that_claims_to_be_huge_is_refused),
        IN_FOLDER(truncated_files_are_refused),
        IN_FOLDER(damaged_files_are_survived),
        IN_FOLDER(what_is_written_is_read_again),
        IN_FOLDER(float_exr_is_exact_and_every_compression_reads_back),
        IN_FOLDER(jpeg_is_close_and_over_black),
        IN_FOLDER(jpeg_orientation_is_applied),
        IN_FOLDER(values_that_half_cannot_hold_are_clamped),
        IN_FOLDER(exposure_is_stops_and_leaves_exr_alone),
        IN_FOLDER(exr_metadata_has_openexrs_types),
        IN_FOLDER(envmap_cube_is_written_as_the_attribute),
        IN_FOLDER(output_is_checked_before_work_is_done),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
