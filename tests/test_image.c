// Tests image files. Reading must follow the formats' specifications, written files must read back
// within the rounding of the format, and bad files must get one clear answer. The oracle is files
// built byte by byte (support/image_bytes.c) and the formulas of IEC 61966-2-1.
#include "image/color.h"
#include "image/image_io.h"
#include "support/image_bytes.h"
#include "support/image_files.h"
#include "support/scratch.h"
#include "support/srgb.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// ---- Colour -------------------------------------------------------------------------------------

static void srgb_codes_survive_decoding_and_encoding(void **state)
{
    (void)state;
    for (int code = 0; code < 256; code++) {
        float linear = glint_srgb_to_linear((float)code / 255.0f);
        assert_int_equal(glint_linear_to_srgb8(linear), code);
        // Decoding rounds to float, 2⁻²⁴ of the value. Encoding has a slope of at most 12.92 and
        // rounds once more.
        assert_true(fabs((double)glint_linear_to_srgb(linear) - code / 255.0) < 2e-7);
    }
}

// Floats from 2⁻¹⁴ to 1 in steps of 37 units in the last place, against the formula in double. At a
// threshold the rounding of the formula decides, hence the 1e-9.
static void eight_bit_codes_are_the_rounded_curve(void **state)
{
    (void)state;
    for (uint32_t bits = 0x38800000u; bits <= 0x3f800000u; bits += 37) {
        float linear;
        memcpy(&linear, &bits, sizeof linear);
        double exact = 255.0 * srgb_from_linear((double)linear);
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

// ---- Reading handmade files ---------------------------------------------------------------------

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

static glint_image read_tiff(const tiff_recipe *recipe, glint_image_facts *facts)
{
    image_bytes file = tiff_bytes(recipe);
    scratch_write("a.tif", file.bytes, (long)file.length);
    image_bytes_free(&file);
    return image_file_read("a.tif", facts);
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
        assert_true(fabs((double)image.pixels[i] - linear_from_srgb(codes[i] / 255.0)) < 1e-7);
        codes[i] = (uint16_t)(i * 85);
    }
    glint_image_free(&image);
    image = read_tiff(&(tiff_recipe){256, 1, 3, 16, 0, 1, codes}, &facts);
    assert_true(facts.was_encoded);
    for (int i = 0; i < 256 * 3; i++) {
        assert_true(fabs((double)image.pixels[i] - linear_from_srgb(codes[i] / 65535.0)) < 1e-7);
    }
    glint_image_free(&image);
}

static void alpha_is_premultiplied_after_linearising(void **state)
{
    (void)state;
    // Straight alpha: the colour is the code. Premultiplied before the curve: the colour is code /
    // alpha.
    const uint16_t codes[] = {200, 100, 50, 128, 60, 30, 20, 64, 9, 8, 7, 0, 255, 128, 0, 255};
    for (int extra = 1; extra <= 2; extra++) {
        glint_image image = read_tiff(&(tiff_recipe){4, 1, 4, 8, extra, 1, codes}, NULL);
        assert_int_equal(image.channels, 4);
        for (int p = 0; p < 4; p++) {
            double alpha = codes[4 * p + 3] / 255.0;
            assert_true(fabs((double)image.pixels[4 * p + 3] - alpha) < 1e-7);
            for (int c = 0; c < 3 && alpha > 0.0; c++) {
                double code = codes[4 * p + c] / 255.0;
                double wanted = alpha * linear_from_srgb(extra == 2 ? code : code / alpha);
                // The power multiplies relative rounding errors by 2.4.
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
    assert_true(fabs((double)image.pixels[2] - linear_from_srgb(128 / 255.0)) < 1e-7);
    glint_image_free(&image);
    image = read_tiff(&(tiff_recipe){3, 1, 2, 8, 2, 1, codes}, NULL);
    assert_int_equal(image.channels, 2);
    assert_true(fabs((double)image.pixels[2] - linear_from_srgb(128 / 255.0) * 64 / 255.0) < 1e-7);
    glint_image_free(&image);
}

// TIFF 6.0, tag 274: the sides that the 0th row and the 0th column of the file show.
static void orientation_is_applied(void **state)
{
    (void)state;
    // The upright picture is 3 × 2. Pixel (x, y) has the code 40·(3 y + x) + 20.
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
    return image_file_read("a.exr", facts);
}

static void exr_channels_are_found_by_name(void **state)
{
    (void)state;
    static const char *const shuffled[] = {"A", "B", "G", "R", "Z"};
    static const char *const layered[] = {"ViewLayer.Combined.A", "ViewLayer.Combined.B",
                                          "ViewLayer.Combined.G", "ViewLayer.Combined.R",
                                          "ViewLayer.Depth.Z"};
    for (int k = 0; k < 2; k++) {
        exr_recipe recipe = {.names = k == 0 ? shuffled : layered,
                             .channels = 5,
                             .data = {0, 0, 4, 2},
                             .display = {0, 0, 4, 2},
                             .envmap = -1,
                             .value = coded_value};
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

// The display window is the picture. Pixels outside it are cut off; missing pixels are zero.
static void exr_pixels_stand_in_the_display_window(void **state)
{
    (void)state;
    static const char *const names[] = {"B", "G", "R"};
    exr_recipe recipe = {.names = names,
                         .channels = 3,
                         .data = {2, -1, 9, 3},
                         .display = {0, 0, 6, 4},
                         .envmap = -1,
                         .value = coded_value};
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
        exr_recipe recipe = {.names = names,
                             .channels = 3,
                             .data = {0, 0, 3, 23},
                             .display = {0, 0, 3, 23},
                             .envmap = envmap,
                             .value = coded_value};
        glint_image_facts facts = {0};
        glint_image image = read_exr(&recipe, &facts);
        assert_int_equal(facts.envmap, wanted[envmap + 1]);
        assert_false(facts.was_encoded);
        assert_int_equal(image.width, 4);
        assert_int_equal(image.height, 24);
        glint_image_free(&image);
    }
}

// A lossless WebP of one transparent pixel.
static void webp_is_read(void **state)
{
    (void)state;
    static const char file[] =
        "RIFF\x1a\0\0\0WEBPVP8L\x0d\0\0\0\x2f\0\0\0\x10\x07\x10\x11\x11\x88\x88\xfe\x07";
    scratch_write("a.webp", file, sizeof file);
    glint_image image = image_file_read("a.webp", NULL);
    assert_int_equal(image.width, 1);
    assert_int_equal(image.height, 1);
    assert_int_equal(image.channels, 4);
    assert_true(image.pixels[3] == 0.0f);
    glint_image_free(&image);
}

static glint_image read_jpeg(const unsigned char *components, int count, int adobe)
{
    image_bytes file = jpeg_bytes(components, count, adobe);
    scratch_write("a.jpg", file.bytes, (long)file.length);
    image_bytes_free(&file);
    return image_file_read("a.jpg", NULL);
}

// Checks the codes of all pixels. Rounding moves a code by one.
static void expect_codes(glint_image *image, int red, int green, int blue)
{
    const int codes[3] = {red, green, blue};
    assert_int_equal(image->width, 8);
    assert_int_equal(image->channels, 3);
    for (int i = 0; i < 8 * 8 * 3; i++) {
        const int code = glint_linear_to_srgb8(image->pixels[i]);
        if (abs(code - codes[i % 3]) > 1) {
            fail_msg("component %d is %d, not %d", i % 3, code, codes[i % 3]);
        }
    }
    glint_image_free(image);
}

// Programs of Adobe store inks inverted: red is cyan × black. Without Adobe's marker nobody knows.
static void jpegs_of_inks_are_read_where_their_marker_says_how(void **state)
{
    (void)state;
    // JFIF's YCbCr of (200, 100, 50), as a check of the files.
    glint_image image = read_jpeg((const unsigned char[]){124, 86, 182}, 3, -1);
    expect_codes(&image, 200, 100, 50);
    image = read_jpeg((const unsigned char[]){200, 100, 50}, 3, 0);
    expect_codes(&image, 200, 100, 50);
    image = read_jpeg((const unsigned char[]){200, 100, 50, 255}, 4, 0);
    expect_codes(&image, 200, 100, 50);
    image = read_jpeg((const unsigned char[]){200, 100, 50, 128}, 4, 0);
    expect_codes(&image, 100, 50, 25);
    // YCCK: the YCbCr of the inverted inks.
    image = read_jpeg((const unsigned char[]){131, 170, 73, 255}, 4, 2);
    expect_codes(&image, 200, 100, 50);
    const unsigned char inks[4] = {200, 100, 50, 128};
    image_bytes file = jpeg_bytes(inks, 4, -1);
    // Fill bytes may stand before a marker.
    for (int fill = 0; fill < 2; fill++) {
        scratch_write("a.jpg", file.bytes, (long)file.length);
        refuse(scratch_path("a.jpg"), "CMYK without Adobe's marker");
        image_bytes_put(&file, "\xff", 1);
        memmove(file.bytes + 3, file.bytes + 2, file.length - 3);
    }
    image_bytes_free(&file);
}

static void content_decides_over_the_extension(void **state)
{
    (void)state;
    static const char *const names[] = {"B", "G", "R"};
    exr_recipe recipe = {.names = names,
                         .channels = 3,
                         .data = {0, 0, 3, 3},
                         .display = {0, 0, 3, 3},
                         .envmap = -1,
                         .value = coded_value};
    image_bytes file = exr_bytes(&recipe);
    scratch_write("really_an_exr.hdr", file.bytes, (long)file.length);
    image_bytes_free(&file);
    glint_image image = image_file_read("really_an_exr.hdr", NULL);
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

static const char *const noise_names[] = {"n.exr", "n.hdr", "n.png", "n.tif", "n.jpg"};

static void truncated_files_are_refused(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof noise_names / sizeof noise_names[0]; k++) {
        size_t length;
        image_file_write_noise(noise_names[k], 3);
        unsigned char *bytes = scratch_read(noise_names[k], &length);
        assert_non_null(bytes);
        for (size_t part = 1; part < 20; part += 3) {
            scratch_write("short", bytes, (long)(length * part / 20));
            refuse(scratch_path("short"), "(");
        }
        free(bytes);
    }
}

// Any answer is right, if there is one: no crash, no hang, no access outside the picture.
static void damaged_files_are_survived(void **state)
{
    (void)state;
    unsigned seed = 2;
    for (size_t k = 0; k < sizeof noise_names / sizeof noise_names[0]; k++) {
        size_t length;
        image_file_write_noise(noise_names[k], 3);
        unsigned char *bytes = scratch_read(noise_names[k], &length);
        assert_non_null(bytes);
        for (int round = 0; round < 15; round++) {
            unsigned char kept[4];
            size_t places[4];
            for (int i = 0; i < 4; i++) {
                seed = seed * 1664525u + 1013904223u;
                // Damage the header most often.
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

static void memory_is_used_again_where_it_fits(void **state)
{
    (void)state;
    glint_image image = {0};
    assert_int_equal(glint_image_reuse(6, 4, 4, &image, NULL), GLINT_OK);
    float *first = image.pixels;
    assert_int_equal((uintptr_t)first % 64, 0);
    first[95] = 7;
    assert_int_equal(glint_image_reuse(6, 4, 4, &image, NULL), GLINT_OK);
    assert_ptr_equal(image.pixels, first);
    assert_true(image.pixels[95] == 7);
    assert_int_equal(glint_image_reuse(4, 6, 4, &image, NULL), GLINT_OK);
    assert_int_equal(image.width, 4);
    assert_int_equal(image.height, 6);
    assert_int_equal(glint_image_reuse(0, 6, 4, &image, NULL), GLINT_BAD_INPUT);
    assert_null(image.pixels);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_is_used_again_where_it_fits),
        cmocka_unit_test(srgb_codes_survive_decoding_and_encoding),
        cmocka_unit_test(eight_bit_codes_are_the_rounded_curve),
        cmocka_unit_test(values_outside_the_range_are_clamped),
#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, scratch_setup, scratch_teardown)
        IN_FOLDER(whole_numbers_are_linearised_and_floats_are_not),
        IN_FOLDER(alpha_is_premultiplied_after_linearising),
        IN_FOLDER(grey_and_grey_with_alpha_keep_their_channels),
        IN_FOLDER(orientation_is_applied),
        IN_FOLDER(exr_channels_are_found_by_name),
        IN_FOLDER(exr_pixels_stand_in_the_display_window),
        IN_FOLDER(exr_envmap_attribute_is_told),
        IN_FOLDER(webp_is_read),
        IN_FOLDER(jpegs_of_inks_are_read_where_their_marker_says_how),
        IN_FOLDER(content_decides_over_the_extension),
        IN_FOLDER(what_is_no_picture_is_refused_by_name),
        IN_FOLDER(a_small_file_that_claims_to_be_huge_is_refused),
        IN_FOLDER(truncated_files_are_refused),
        IN_FOLDER(damaged_files_are_survived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
