// Tests Radiance pictures: orders of pixels, run-length codes, and what headers say. The oracle is
// files built byte by byte after "Radiance File Formats" (Ward 1991).
#include "image/image_io.h"
#include "support/image_bytes.h"
#include "support/image_files.h"
#include "support/scratch.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#define FORMAT "FORMAT=32-bit_rle_rgbe\n"

static void put_text(image_bytes *file, const char *text)
{
    image_bytes_put(file, text, strlen(text));
}

static void write_and_free(image_bytes *file)
{
    scratch_write("a.hdr", file->bytes, (long)file->length);
    image_bytes_free(file);
}

static void expect_refusal(const char *said)
{
    glint_image image;
    glint_error error = {0};
    if (glint_image_read(scratch_path("a.hdr"), &image, NULL, &error) != GLINT_BAD_INPUT) {
        fail_msg("read, where '%s' is expected", said);
    }
    if (strstr(error.message, said) == NULL) {
        fail_msg("'%s' does not say '%s'", error.message, said);
    }
}

// ---- Orders -------------------------------------------------------------------------------------

// Writes a picture of 11 × 9 whose pixel (x, y) is (128 + x, 128 + y, 7) / 128, its origin at the
// top left, in an order of Radiance's: "-Y" runs down, "+X" to the right.
static void write_in_order(const char *order, bool is_packed)
{
    enum { WIDTH = 11, HEIGHT = 9 };
    const bool by_rows = order[1] == 'Y';
    const int lines = by_rows ? HEIGHT : WIDTH, length = by_rows ? WIDTH : HEIGHT;
    char size[64];
    image_bytes file = {0};
    snprintf(size, sizeof size, "%.2s %d %.2s %d\n", order, lines, order + 2, length);
    put_text(&file, "#?RADIANCE\n" FORMAT "\n");
    put_text(&file, size);
    for (int i = 0; i < lines; i++) {
        unsigned char line[4][WIDTH];
        for (int j = 0; j < length; j++) {
            const int across = by_rows ? j : i, down = by_rows ? i : j;
            const char x_sign = order[by_rows ? 2 : 0], y_sign = order[by_rows ? 0 : 2];
            line[0][j] = (unsigned char)(128 + (x_sign == '+' ? across : WIDTH - 1 - across));
            line[1][j] = (unsigned char)(128 + (y_sign == '-' ? down : HEIGHT - 1 - down));
            line[2][j] = 7;
            line[3][j] = 129;
        }
        if (is_packed) {
            image_bytes_put_big(&file, 0x02020000u | (unsigned)length, 4);
        }
        for (int k = 0; k < 4 * length; k++) {
            if (is_packed && k % length == 0) {
                image_bytes_put_number(&file, (unsigned)length, 1);
            }
            image_bytes_put_number(
                &file, is_packed ? line[k / length][k % length] : line[k % 4][k / 4], 1);
        }
    }
    write_and_free(&file);
}

static void all_eight_orders_are_upright(void **state)
{
    (void)state;
    static const char *const orders[] = {"-Y+X", "-Y-X", "+Y+X", "+Y-X",
                                         "+X-Y", "-X-Y", "+X+Y", "-X+Y"};
    for (int k = 0; k < 16; k++) {
        write_in_order(orders[k / 2], k % 2 == 1);
        glint_image image = image_file_read("a.hdr", NULL);
        assert_int_equal(image.width, 11);
        assert_int_equal(image.height, 9);
        assert_int_equal(image.channels, 3);
        for (int y = 0; y < 9; y++) {
            for (int x = 0; x < 11; x++) {
                const float *pixel = glint_image_pixel(&image, x, y);
                if (pixel[0] != (float)(128 + x) / 128 || pixel[1] != (float)(128 + y) / 128 ||
                    pixel[2] != 7.0f / 128) {
                    fail_msg("%s: pixel %d,%d", orders[k / 2], x, y);
                }
            }
        }
        glint_image_free(&image);
    }
}

// ---- Run-length codes ---------------------------------------------------------------------------

// Writes one scanline of this length.
static void write_line(int length, const void *bytes, size_t size)
{
    char text[96];
    image_bytes file = {0};
    snprintf(text, sizeof text, "#?RADIANCE\n" FORMAT "\n-Y 1 +X %d\n", length);
    put_text(&file, text);
    image_bytes_put(&file, bytes, size);
    write_and_free(&file);
}

// Checks that the red of `count` pixels from `first` on is this number of 128ths.
static void expect_red(const glint_image *image, int first, int count, int red)
{
    for (int x = first; x < first + count; x++) {
        if (image->pixels[3 * x] != (float)red / 128) {
            fail_msg("pixel %d is %g, not %d / 128", x, (double)image->pixels[3 * x], red);
        }
    }
}

static void older_runs_repeat_a_pixel(void **state)
{
    (void)state;
    // 130, then 4 more. 140, then 2 + 256 · 1 more. 150 runs over the end.
    static const unsigned char line[] = {130, 0, 0, 129, 1, 1,   1, 4, 140, 0, 0, 129, 1, 1, 1,
                                         2,   1, 1, 1,   1, 150, 0, 0, 129, 1, 1, 1,   0, 1, 1,
                                         1,   0, 1, 1,   1, 0,   1, 1, 1,   0, 1, 1,   1, 1};
    write_line(300, line, sizeof line);
    glint_image image = image_file_read("a.hdr", NULL);
    expect_red(&image, 0, 5, 130);
    expect_red(&image, 5, 259, 140);
    expect_red(&image, 264, 36, 150);
    glint_image_free(&image);
    // The first pixel is never a count.
    write_line(2, (const unsigned char[]){1, 1, 1, 129, 200, 0, 0, 129}, 8);
    image = image_file_read("a.hdr", NULL);
    expect_red(&image, 0, 1, 1);
    expect_red(&image, 1, 1, 200);
    glint_image_free(&image);
}

static void newer_runs_repeat_a_component(void **state)
{
    (void)state;
    // Red: 127 times 130, 2 as they are, 128 + 3 times 9. Green, blue and exponent: runs.
    image_bytes line = {0};
    image_bytes_put_big(&line, 0x02020000u | 132, 4);
    static const unsigned char red[] = {128 + 127, 130, 2, 140, 150, 128 + 3, 9};
    image_bytes_put(&line, red, sizeof red);
    for (int c = 0; c < 3; c++) {
        const unsigned char value = c < 2 ? 77 : 129;
        const unsigned char runs[] = {128 + 127, value, 128 + 5, value};
        image_bytes_put(&line, runs, sizeof runs);
    }
    write_line(132, line.bytes, line.length);
    glint_image image = image_file_read("a.hdr", NULL);
    expect_red(&image, 0, 127, 130);
    expect_red(&image, 127, 1, 140);
    expect_red(&image, 128, 1, 150);
    expect_red(&image, 129, 3, 9);
    glint_image_free(&image);
    // One byte less, and a run that leaves the scanline.
    write_line(132, line.bytes, line.length - 1);
    expect_refusal("scanline 1 of 1 is damaged or cut short");
    line.bytes[4]--;
    line.bytes[9] += 2;
    write_line(132, line.bytes, line.length);
    expect_refusal("scanline 1 of 1 is damaged or cut short");
    image_bytes_free(&line);
}

// The largest and the smallest exponents, and 0 for black.
static void exponents_are_powers_of_two(void **state)
{
    (void)state;
    static const unsigned char line[] = {255, 1, 0, 255, 128, 1, 0, 1, 255, 255, 255, 0};
    write_line(3, line, sizeof line);
    glint_image image = image_file_read("a.hdr", NULL);
    assert_true(image.pixels[0] == ldexpf(255, 119) && image.pixels[1] == ldexpf(1, 119));
    assert_true(image.pixels[3] == ldexpf(128, -135) && image.pixels[4] == ldexpf(1, -135));
    assert_true(image.pixels[2] == 0 && image.pixels[6] == 0 && image.pixels[8] == 0);
    glint_image_free(&image);
}

// ---- Headers ------------------------------------------------------------------------------------

// Writes one pixel (1, 0.5, 0.25) below these lines.
static void write_header(const char *lines)
{
    static const unsigned char pixel[] = {128, 64, 32, 129};
    image_bytes file = {0};
    put_text(&file, "#?RADIANCE\n");
    put_text(&file, lines);
    put_text(&file, "\n-Y 1 +X 1\n");
    image_bytes_put(&file, pixel, sizeof pixel);
    write_and_free(&file);
}

static void expect_pixel(double red, double green, double blue, double relative)
{
    glint_image image = image_file_read("a.hdr", NULL);
    const double wanted[3] = {red, green, blue};
    for (int c = 0; c < 3; c++) {
        if (fabs((double)image.pixels[c] - wanted[c]) > relative * wanted[c]) {
            fail_msg("component %d is %.7g, not %.7g", c, (double)image.pixels[c], wanted[c]);
        }
    }
    glint_image_free(&image);
}

static void long_headers_are_read(void **state)
{
    (void)state;
    image_bytes lines = {0};
    for (int i = 0; i < 2000; i++) {
        char line[400];
        snprintf(line, sizeof line, "\tpcomb -s %d %*s\n", i, i % 300, "x");
        put_text(&lines, line);
    }
    put_text(&lines, FORMAT);
    image_bytes_put(&lines, "", 1);
    write_header((const char *)lines.bytes);
    image_bytes_free(&lines);
    expect_pixel(1, 0.5, 0.25, 0);
    // Without a format, with lines of other systems, and with the other first line.
    write_header("");
    expect_pixel(1, 0.5, 0.25, 0);
    static const char other[] = "#?RGBE\r\n" FORMAT "\r\n-Y 1 +X 1\r\n\x80\x40\x20\x81";
    scratch_write("a.hdr", other, (long)sizeof other - 1);
    expect_pixel(1, 0.5, 0.25, 0);
}

// Ward: the original values are the values in the file, divided by all EXPOSUREs and COLORCORRs.
static void exposure_and_correction_are_undone(void **state)
{
    (void)state;
    write_header(FORMAT "EXPOSURE=4\n");
    expect_pixel(0.25, 0.125, 0.0625, 0);
    write_header("EXPOSURE= 2.5e-1\nEXPOSURE=8\n" FORMAT);
    expect_pixel(0.5, 0.25, 0.125, 0);
    write_header(FORMAT "COLORCORR=0.5 1 2\nEXPOSURE=2\nCOLORCORR= 1 2 1\n");
    expect_pixel(1, 0.125, 0.0625, 0);
    // The history is not the picture's own.
    write_header(FORMAT "\tEXPOSURE=7\nVIEW= -vtv EXPOSURE=3\nEXPOSURES=3\n");
    expect_pixel(1, 0.5, 0.25, 0);
    static const char *const wrong[] = {"EXPOSURE=0",
                                        "EXPOSURE=-1",
                                        "EXPOSURE=nan",
                                        "EXPOSURE=inf",
                                        "EXPOSURE=",
                                        "EXPOSURE=2 3",
                                        "EXPOSURE=1e-999",
                                        "COLORCORR=1 2",
                                        "COLORCORR=1 0 1",
                                        "PRIMARIES=1 2",
                                        "EXPOSURE=1e-60",
                                        "EXPOSURE=1e60",
                                        "EXPOSURE=1e300\nEXPOSURE=1e300",
                                        "EXPOSURE=1e-200\nEXPOSURE=1e-200"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char lines[96];
        snprintf(lines, sizeof lines, FORMAT "%s\n", wrong[i]);
        write_header(lines);
        expect_refusal("cannot be used");
    }
}

static void primaries_are_converted(void **state)
{
    (void)state;
    // Photoshop's zeros, and Rec. 709's own.
    write_header(FORMAT "PRIMARIES=0 0 0 0 0 0 0 0\n");
    expect_pixel(1, 0.5, 0.25, 0);
    write_header(FORMAT "PRIMARIES=0.640 0.330 0.300 0.600 0.150 0.060 0.3127 0.3290\n");
    expect_pixel(1, 0.5, 0.25, 0);
    // ITU-R BT.2087 (2015), of four digits: row sums of (1, 0.5, 0.25).
    write_header(FORMAT
                 "EXPOSURE=2\nPRIMARIES=0.708 0.292 0.170 0.797 0.131 0.046 0.3127 0.3290\n");
    expect_pixel((1.6605 - 0.5876 * 0.5 - 0.0728 * 0.25) / 2,
                 (-0.1246 + 1.1329 * 0.5 - 0.0083 * 0.25) / 2,
                 (-0.0182 - 0.1006 * 0.5 + 1.1187 * 0.25) / 2, 1e-3);
    write_header(FORMAT "PRIMARIES=0.3 0.3 0.3 0.3 0.3 0.3 0.3 0.3\n");
    expect_refusal("its PRIMARIES are no colours");
}

static void other_headers_are_refused_with_the_true_reason(void **state)
{
    (void)state;
    write_header("FORMAT=32-bit_rle_xyze\n");
    expect_refusal("holds CIE XYZ colours (32-bit_rle_xyze)");
    write_header("FORMAT=Radiance_spectra\n");
    expect_refusal("holds Radiance_spectra, which is not read");
    static const struct {
        const char *bytes, *said;
    } files[] = {
        {"#?RADIANCE\n" FORMAT, "its header has no end"},
        {"#?RADIANCE\n" FORMAT "\n", "does not end in a size"},
        {"#?RADIANCE\n" FORMAT "\n-Y 1\n", "does not end in a size"},
        {"#?RADIANCE\n" FORMAT "\n-Y 1 +Y 1\nxxxx", "does not end in a size"},
        {"#?RADIANCE\n" FORMAT "\n-Z 1 +X 1\nxxxx", "does not end in a size"},
        {"#?RADIANCE\n" FORMAT "\n-Y 0 +X 1\nxxxx", "does not end in a size"},
        {"#?RADIANCE\n" FORMAT "\n-Y 1 +X -1\nxxxx", "does not end in a size"},
        {"#?RADIANCE\n" FORMAT "\n-Y 1 +X 99999999999\nxxxx", "does not end in a size"},
        {"#?RADIANCE\n" FORMAT "\n-Y 1 +X 1 1\nxxxx", "does not end in a size"},
        {"#?RADIANCE\n" FORMAT "\n-Y 1 +X 2147483647\nxxxx", "than can be read"},
        {"#?RADIANCE\n" FORMAT "\n-Y 2 +X 1\nxxxx", "cannot hold"},
        {"#?RADIANCE\n" FORMAT "\n-Y 1 +X 2\nxxxx", "scanline 1 of 1"},
    };
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        scratch_write("a.hdr", files[i].bytes, -1);
        expect_refusal(files[i].said);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, scratch_setup, scratch_teardown)
        IN_FOLDER(all_eight_orders_are_upright),
        IN_FOLDER(older_runs_repeat_a_pixel),
        IN_FOLDER(newer_runs_repeat_a_component),
        IN_FOLDER(exponents_are_powers_of_two),
        IN_FOLDER(long_headers_are_read),
        IN_FOLDER(exposure_and_correction_are_undone),
        IN_FOLDER(primaries_are_converted),
        IN_FOLDER(other_headers_are_refused_with_the_true_reason),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
