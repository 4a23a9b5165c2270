// Tests contact sheets: the places of pictures, and the mean in each pixel of the sheet.
#include "report/compare/bitmap_font.h"
#include "report/compare/contact_labels.h"
#include "report/compare/contact_sheet.h"

#include <ctype.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { GAP = 8, LABEL = 20 }; // constants of contact_sheet.c

static glint_contact_sheet make_sheet(int count, int columns, int width, int height)
{
    glint_contact_sheet sheet = {
        .count = count, .columns = columns, .width = width, .height = height};
    assert_int_equal(glint_contact_sheet_begin(&sheet, NULL), GLINT_OK);
    return sheet;
}

static const float *at(const glint_contact_sheet *sheet, int index, int x, int y)
{
    const int column = index % sheet->columns, row = index / sheet->columns;
    return glint_image_pixel(&sheet->image, GAP + column * (sheet->width + GAP) + x,
                             GAP + row * (sheet->height + LABEL + GAP) + y);
}

static glint_image picture(int width, int height, int channels)
{
    glint_image image = {0};
    assert_int_equal(glint_image_create(width, height, channels, &image, NULL), GLINT_OK);
    return image;
}

static void pixels_are_means_of_what_they_cover(void **state)
{
    (void)state;
    glint_contact_sheet sheet = make_sheet(1, 0, 3, 2);
    // 7 × 5 to 3 × 2: borders fall within pixels. The mean of a linear ramp is its value in the
    // middle.
    glint_image image = picture(7, 5, 3);
    for (int y = 0; y < 5; y++) {
        for (int x = 0; x < 7; x++) {
            float *p = glint_image_pixel(&image, x, y);
            p[0] = 0.1F * ((float)x + 0.5F);
            p[1] = 0.2F * ((float)y + 0.5F);
            p[2] = 1;
        }
    }
    glint_contact_sheet_put(&sheet, 0, &image, "");
    for (int y = 0; y < 2; y++) {
        for (int x = 0; x < 3; x++) {
            const float *p = at(&sheet, 0, x, y);
            // The picture is constant within a pixel, so means over parts of a pixel err by up to a
            // quarter of a step on each side.
            assert_true(fabsf(p[0] - 0.1F * ((float)x + 0.5F) * 7 / 3) < 0.1F / 8);
            assert_true(fabsf(p[1] - 0.2F * ((float)y + 0.5F) * 5 / 2) < 0.2F / 8);
            assert_true(fabsf(p[2] - 1) < 1e-6F);
        }
    }
    // If pixels divide evenly, the mean is exact.
    glint_image fine = picture(6, 4, 3);
    for (int y = 0; y < 4; y++) {
        for (int x = 0; x < 6; x++) {
            glint_image_pixel(&fine, x, y)[0] = (float)(x % 2 + 2 * (y % 2));
        }
    }
    glint_contact_sheet_put(&sheet, 0, &fine, "");
    for (int i = 0; i < 6; i++) {
        assert_true(at(&sheet, 0, i % 3, i / 3)[0] == 1.5F);
    }
    glint_image_free(&fine);
    glint_image_free(&image);
    glint_contact_sheet_free(&sheet);
}

static void pictures_lie_in_rows_and_fit(void **state)
{
    (void)state;
    glint_contact_sheet sheet = make_sheet(5, 2, 16, 8);
    assert_int_equal(sheet.columns, 2);
    assert_int_equal(sheet.image.width, 2 * (16 + GAP) + GAP);
    assert_int_equal(sheet.image.height, 3 * (8 + LABEL + GAP) + GAP);
    glint_image square = picture(32, 32, 1);
    for (int i = 0; i < 32 * 32; i++) {
        square.pixels[i] = 5;
    }
    glint_contact_sheet_put(&sheet, 3, &square, "");
    // 8 × 8 in the middle of 16 × 8.
    assert_true(at(&sheet, 3, 4, 0)[0] == 5 && at(&sheet, 3, 11, 7)[2] == 5);
    assert_true(at(&sheet, 3, 3, 0)[0] < 1 && at(&sheet, 3, 12, 7)[0] < 1);
    for (int other = 0; other < 5; other++) {
        assert_true(other == 3 || at(&sheet, other, 8, 4)[0] < 1);
    }
    glint_image_free(&square);
    glint_contact_sheet_free(&sheet);
}

static void alpha_nan_and_missing_pictures_are_seen(void **state)
{
    (void)state;
    glint_contact_sheet sheet = make_sheet(3, 3, 16, 16);
    glint_image clear = picture(16, 16, 4);
    float *half = glint_image_pixel(&clear, 3, 3);
    half[0] = 0.5F;
    half[3] = 0.5F;
    glint_image_pixel(&clear, 5, 5)[1] = NAN;
    glint_image_pixel(&clear, 6, 5)[1] = INFINITY;
    glint_contact_sheet_put(&sheet, 0, &clear, "0001");
    const float grey = at(&sheet, 0, 0, 0)[0];
    assert_true(grey > 0.05F && at(&sheet, 0, 0, 0)[1] == grey);
    assert_true(fabsf(at(&sheet, 0, 3, 3)[0] - (0.5F + grey / 2)) < 1e-6F);
    for (int x = 5; x <= 6; x++) {
        const float *magenta = at(&sheet, 0, x, 5);
        assert_true(magenta[0] == 1 && magenta[1] == 0 && magenta[2] == 1);
    }
    glint_contact_sheet_put(&sheet, 1, NULL, "a label that is far too long for its room");
    assert_true(at(&sheet, 1, 0, 0)[0] > 0.5F && at(&sheet, 1, 0, 15)[0] > 0.5F);
    assert_true(at(&sheet, 1, 8, 0)[0] < 0.5F);
    glint_image_free(&clear);
    glint_contact_sheet_free(&sheet);
}

static void sheets_have_a_largest_size(void **state)
{
    (void)state;
    glint_contact_sheet large = {.count = 1000000, .width = 240, .height = 135};
    glint_error error = {0};
    assert_int_equal(glint_contact_sheet_begin(&large, &error), GLINT_USAGE);
    assert_non_null(strstr(error.message, "--width"));
    glint_contact_sheet sheet = make_sheet(1, 7, 16, 16);
    assert_int_equal(sheet.columns, 1);
    glint_contact_sheet_free(&sheet);
}

// A sheet's files and their labels, NULL at the end.
typedef const char *labelled_files[9][2];

static void frames_have_their_numbers_and_others_their_names(void **state)
{
    (void)state;
    static const labelled_files sheets[] = {
        {{"turn/f.0012.exr", "0012"}},
        {{"0012.exr", "0012"}},
        {{"2/glass.exr", "glass"}},
        {{"mirror.png", "mirror"}},
        {{"a.b.hdr", "a.b"}},
        {{"plain", "plain"}},
        {{".hidden", ".hidden"}},
        {{"", ""}},
        // Numbers that are no frame's.
        {{"ball_8k.exr", "ball_8k"}, {"2CylinderEngine.png", "2CylinderEngine"}},
        {{"turn/f.0012b.exr", "f.0012b"}, {"v2/ring2.exr", "ring2"}},
        {{"cam2_left.exr", "cam2_left"}, {"cam2_right.exr", "cam2_right"}},
        // A sequence may have its numbers anywhere.
        {{"a_0001.png", "0001"}, {"a_0002.png", "0002"}, {"a_10000.png", "10000"}},
        {{"f7.png", "7"}, {"f12.png", "12"}, {"g12.png", "g12"}},
        {{"f.1.v2.png", "1"}, {"f.2.v2.png", "2"}},
        {{"turn-01.exr", "01"}, {"turn-02.exr", "02"}},
        {{"f.-07.exr", "-07"}, {"f.08.exr", "08"}, {"f.00.exr", "00"}},
        {{"-7.exr", "-7"}, {"8.exr", "8"}},
        // Two numbers differ, so neither is the frame's.
        {{"c1_f1.png", "c1_f1"}, {"c1_f2.png", "c1_f2"}, {"c2_f1.png", "c2_f1"}},
        // The same numbers in different sequences; and the same name in different folders.
        {{"front.0001.exr", "front.0001"}, {"side.0001.exr", "side.0001"}},
        {{"a/f.0001.exr", "0001"}, {"b/f.0001.exr", "0001"}, {"b/f.0002.exr", "0002"}},
    };
    for (size_t i = 0; i < sizeof sheets / sizeof *sheets; i++) {
        const char *paths[9];
        char labels[9][GLINT_CONTACT_LABEL];
        size_t count = 0;
        for (; sheets[i][count][0] != NULL; count++) {
            paths[count] = sheets[i][count][0];
        }
        assert_int_equal(glint_contact_labels(paths, count, labels, NULL), GLINT_OK);
        for (size_t k = 0; k < count; k++) {
            assert_string_equal(labels[k], sheets[i][k][1]);
        }
    }
}

static void long_names_are_cut(void **state)
{
    (void)state;
    char name[300];
    memset(name, '7', sizeof name);
    name[sizeof name - 1] = '\0';
    const char *paths[] = {name};
    char labels[1][GLINT_CONTACT_LABEL];
    assert_int_equal(glint_contact_labels(paths, 1, labels, NULL), GLINT_OK);
    assert_int_equal(strlen(labels[0]), GLINT_CONTACT_LABEL - 1);
}

static void every_letter_of_a_name_is_visible(void **state)
{
    (void)state;
    for (int letter = 'A'; letter <= 'z'; letter++) {
        bool is_drawn = isalpha(letter) == 0;
        for (int i = 0; i < GLINT_FONT_WIDTH * GLINT_FONT_HEIGHT; i++) {
            is_drawn = is_drawn ||
                       glint_font_dot((char)letter, i % GLINT_FONT_WIDTH, i / GLINT_FONT_WIDTH);
        }
        assert_true(is_drawn);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pixels_are_means_of_what_they_cover),
        cmocka_unit_test(pictures_lie_in_rows_and_fit),
        cmocka_unit_test(alpha_nan_and_missing_pictures_are_seen),
        cmocka_unit_test(sheets_have_a_largest_size),
        cmocka_unit_test(frames_have_their_numbers_and_others_their_names),
        cmocka_unit_test(long_names_are_cut),
        cmocka_unit_test(every_letter_of_a_name_is_visible),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
