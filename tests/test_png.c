// Tests what glint asks of libpng. libpng's reader is the judge.
#include "image/png.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <png.h>

// Looks like noise, but has short repeats.
static glint_image make_image(int width, int height, int channels)
{
    glint_image image;
    assert_int_equal(glint_image_create(width, height, channels, &image, NULL), GLINT_OK);
    for (size_t i = 0; i < (size_t)width * (size_t)height * (size_t)channels; i++) {
        image.pixels[i] = (float)(i * i % 100003 % 61) / 60.0f;
    }
    return image;
}

static glint_file_values values_of(const glint_image *image, const glint_write_options *options)
{
    return glint_file_values_of(glint_image_written_format("a.png"), image, options);
}

static bool has(const glint_encoded *file, const void *bytes, size_t size)
{
    return memmem(file->bytes, file->size, bytes, size) != NULL;
}

// Encodes an image. libpng must read its codes again. Returns the file's size.
static size_t check(const glint_image *image, const glint_write_options *options)
{
    static const png_uint_32 formats[5] = {0, PNG_FORMAT_GRAY, PNG_FORMAT_GA, PNG_FORMAT_RGB,
                                           PNG_FORMAT_RGBA}; // of 8 bits
    const glint_file_values values = values_of(image, options);
    const size_t size = (size_t)image->width * (size_t)image->height * values.pixel_bytes;
    unsigned char *wanted = malloc(size), *read = malloc(size);
    glint_encoded file = {0};
    assert_true(wanted != NULL && read != NULL);
    glint_file_values_fill(&values, 1, wanted);
    assert_int_equal(glint_png_encode("a.png", &values, 3, &file, NULL), GLINT_OK);
    png_image png = {.version = PNG_IMAGE_VERSION};
    assert_true(png_image_begin_read_from_memory(&png, file.bytes, file.size));
    assert_int_equal(png.width, image->width);
    assert_int_equal(png.height, image->height);
    assert_int_equal(png.format, formats[image->channels]);
    assert_true(png_image_finish_read(&png, NULL, read, 0, NULL));
    assert_string_equal(png.message, ""); // no warning
    assert_memory_equal(read, wanted, size);
    assert_memory_equal(file.bytes + file.size - 8, "IEND\xae\x42\x60\x82", 8);
    assert_true(has(&file, "sRGB\x03", 5) && has(&file, "gAMA", 4) && has(&file, "cHRM", 4));
    assert_false(has(&file, "tEXt", 4)); // tests/test_image_write.c writes metadata
    free(read);
    free(wanted);
    free(file.bytes);
    return file.size;
}

static void files_hold_the_codes_of_all_sizes(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1, 1}, {1, 70}, {300, 1}, {63, 65}, {1030, 301}, {3, 40000}};
    const glint_write_options options = {0};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        for (int channels = 1; channels <= 4; channels++) {
            glint_image image = make_image(sizes[i][0], sizes[i][1], channels);
            check(&image, &options);
            glint_image_free(&image);
        }
    }
}

static void levels_make_files_smaller(void **state)
{
    (void)state;
    static const char *const levels[] = {"0", "1", "4", "9"};
    size_t before = SIZE_MAX;
    glint_image image = make_image(500, 400, 4);
    for (int i = 0; i < 4; i++) {
        const glint_write_options options = {.compression = levels[i]};
        const size_t size = check(&image, &options);
        assert_true(size < before);
        before = size;
    }
    glint_image_free(&image);
}

// The linker replaces png.c's realloc by this function, which fails when `reallocs_left` is 0.
static int reallocs_left = -1;
void *__real_realloc(void *old, size_t size);
void *__wrap_realloc(void *old, size_t size);
void *__wrap_realloc(void *old, size_t size)
{
    return reallocs_left == 0 ? NULL : (reallocs_left--, __real_realloc(old, size));
}

// libpng fails by a jump. The sanitizers find memory that is not released.
static void refuse(glint_image image, const char *cause)
{
    const glint_write_options options = {0};
    const glint_file_values values = values_of(&image, &options);
    glint_encoded file = {0};
    glint_error error = {0};
    assert_int_equal(glint_png_encode("a.png", &values, 0, &file, &error), GLINT_OUTPUT_FAILED);
    assert_memory_equal(error.message, "a.png: could not be encoded: ", 29);
    assert_non_null(strstr(error.message, cause));
    assert_null(file.bytes);
    glint_image_free(&image);
}

static void failures_leave_no_file(void **state)
{
    (void)state;
    refuse(make_image(1000001, 1, 1), "width");
    refuse(make_image(1, 1000001, 1), "height");
    for (int passing = 0; passing < 3; passing++) {
        reallocs_left = passing;
        refuse(make_image(300, 200, 4), "not enough memory");
    }
    reallocs_left = -1;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_hold_the_codes_of_all_sizes),
        cmocka_unit_test(levels_make_files_smaller),
        cmocka_unit_test(failures_leave_no_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
