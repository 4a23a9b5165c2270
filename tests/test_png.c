// Tests the PNG encoder against an independent decoder, written after the specification: zlib
// inflates, this file undoes the filters.
#include "image/png.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include <cmocka.h>

// ---- Decoding -----------------------------------------------------------------------------------

typedef struct decoded {
    unsigned width, height, channels;
    unsigned char *codes;    // [height][width][channels]
    size_t filter_counts[5]; // rows by filter
    size_t data_chunks;      // number of IDAT chunks
    char description[512];   // "": none
} decoded;

static uint32_t number_at(const unsigned char *bytes)
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

static void take_header(const unsigned char *data, decoded *to)
{
    static const unsigned channels_of[7] = {1, 0, 3, 0, 2, 0, 4};
    to->width = number_at(data);
    to->height = number_at(data + 4);
    assert_int_equal(data[8], 8);
    assert_true(data[9] <= 6);
    to->channels = channels_of[data[9]];
    assert_true(to->width > 0 && to->height > 0 && to->channels > 0);
    assert_true(data[10] == 0 && data[11] == 0 && data[12] == 0);
}

// Reads the chunks. Returns the compressed stream of `*size` bytes, which the caller frees.
static unsigned char *read_chunks(const glint_encoded *file, size_t *size, decoded *to)
{
    assert_true(file->size > 8);
    assert_memory_equal(file->bytes, "\x89PNG\r\n\x1a\n", 8);
    unsigned char *stream = malloc(file->size);
    assert_non_null(stream);
    *size = 0;
    bool is_ended = false;
    for (const unsigned char *at = file->bytes + 8; at < file->bytes + file->size;) {
        const size_t length = number_at(at);
        const unsigned char *data = at + 8;
        assert_false(is_ended);
        assert_true(length + 12 <= (size_t)(file->bytes + file->size - at));
        assert_int_equal(number_at(data + length), crc32(0, at + 4, (uInt)length + 4));
        if (memcmp(at + 4, "IHDR", 4) == 0) {
            take_header(data, to);
        } else if (memcmp(at + 4, "IDAT", 4) == 0) {
            memcpy(stream + *size, data, length);
            *size += length;
            to->data_chunks++;
        } else if (memcmp(at + 4, "tEXt", 4) == 0) {
            assert_string_equal((const char *)data, "Description");
            snprintf(to->description, sizeof to->description, "%.*s", (int)length - 12, data + 12);
        }
        is_ended = memcmp(at + 4, "IEND", 4) == 0;
        at = data + length + 4;
    }
    assert_true(is_ended);
    return stream;
}

// The prediction of filter type 4, as the specification writes it.
static int predict_paeth(int a, int b, int c)
{
    const int p = a + b - c;
    const int pa = abs(p - a), pb = abs(p - b), pc = abs(p - c);
    return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
}

static void undo_filters(const unsigned char *filtered, decoded *to)
{
    const size_t bytes = (size_t)to->width * to->channels;
    for (size_t y = 0; y < to->height; y++, filtered += 1 + bytes) {
        unsigned char *row = to->codes + y * bytes;
        assert_true(filtered[0] < 5);
        to->filter_counts[filtered[0]]++;
        for (size_t i = 0; i < bytes; i++) {
            const int a = i >= to->channels ? row[i - to->channels] : 0;
            const int b = y > 0 ? row[(ptrdiff_t)i - (ptrdiff_t)bytes] : 0;
            const int c = y > 0 && i >= to->channels ? (row - bytes)[i - to->channels] : 0;
            const int predictions[5] = {0, a, b, (a + b) / 2, predict_paeth(a, b, c)};
            row[i] = (unsigned char)(filtered[1 + i] + predictions[filtered[0]]);
        }
    }
}

static decoded decode(const glint_encoded *file)
{
    decoded result = {0};
    size_t size;
    unsigned char *stream = read_chunks(file, &size, &result);
    const size_t bytes = (size_t)result.width * result.channels;
    const size_t whole = (1 + bytes) * result.height;
    unsigned char *filtered = malloc(1 + whole);
    result.codes = malloc(1 + bytes * result.height);
    assert_non_null(filtered);
    assert_non_null(result.codes);
    uLongf inflated = whole;
    assert_int_equal(uncompress(filtered, &inflated, stream, size), Z_OK); // also its checksum
    assert_int_equal(inflated, whole);
    undo_filters(filtered, &result);
    free(filtered);
    free(stream);
    return result;
}

// ---- Encoding -----------------------------------------------------------------------------------

static glint_encoded encode(const glint_image *image, const glint_write_options *options,
                            size_t threads)
{
    const glint_file_values values =
        glint_file_values_of(glint_image_written_format("a.png"), image, options);
    glint_encoded encoded = {0};
    glint_error error = {0};
    if (glint_png_encode("a.png", &values, threads, &encoded, &error) != GLINT_OK) {
        fail_msg("%s", error.message);
    }
    return encoded;
}

// The file must hold the codes of the pixels, which glint_file_values_fill gives. Returns its facts
// without the codes.
static decoded check(const glint_image *image, const glint_write_options *options)
{
    const glint_file_values values =
        glint_file_values_of(glint_image_written_format("a.png"), image, options);
    glint_encoded file = encode(image, options, 0);
    decoded read = decode(&file);
    assert_int_equal(read.width, image->width);
    assert_int_equal(read.height, image->height);
    assert_int_equal(read.channels, values.channels);
    const size_t size = (size_t)read.width * read.height * read.channels;
    unsigned char *wanted = malloc(1 + size);
    assert_non_null(wanted);
    glint_file_values_fill(&values, 0, image->height, wanted);
    assert_memory_equal(read.codes, wanted, size);
    free(wanted);
    free(read.codes);
    free(file.bytes);
    read.codes = NULL;
    return read;
}

static float noise_of(unsigned *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (float)(*seed >> 8) / 16777216.0f;
}

// Bands of eight rows by turns: constant, a ramp along the row, one row again and again, noise at
// every other pixel, the average of left and above, a smooth slope with small noise. Each filter is
// the best one somewhere.
static float value_at(const glint_image *image, int x, int y, int c, unsigned *seed)
{
    const float noise = noise_of(seed);
    const float left = x > 0 ? glint_image_pixel(image, x - 1, y)[c] : 0.5f;
    const float above = y > 0 ? glint_image_pixel(image, x, y - 1)[c] : 0.5f;
    switch (y / 8 % 6) {
    case 0:
        return 0.25f;
    case 1:
        return (float)((x * 3 + c + y * 40) % 200) / 200.0f;
    case 2:
        return (float)((x * 7919 + c) % 101) / 101.0f;
    case 3:
        return noise * (float)(x % 2);
    case 4:
        return (left + above) / 2;
    default:
        return (float)(x + y % 8 * 30 + c) / 2000.0f + 0.02f * noise;
    }
}

static glint_image make_image(int width, int height, int channels)
{
    glint_image image;
    unsigned seed = 7;
    assert_int_equal(glint_image_create(width, height, channels, &image, NULL), GLINT_OK);
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            for (int c = 0; c < channels; c++) {
                glint_image_pixel(&image, x, y)[c] = value_at(&image, x, y, c, &seed);
            }
        }
    }
    return image;
}

static void files_hold_the_pixels_of_all_sizes(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1, 1}, {1, 70}, {300, 1}, {63, 65}, {1030, 301}, {3, 40000}};
    const glint_write_options options = {0};
    size_t most_chunks = 0;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        for (int channels = 1; channels <= 4; channels++) {
            glint_image image = make_image(sizes[i][0], sizes[i][1], channels);
            const decoded read = check(&image, &options);
            most_chunks = read.data_chunks > most_chunks ? read.data_chunks : most_chunks;
            glint_image_free(&image);
        }
    }
    assert_true(most_chunks >= 4); // some files have several blocks
}

static void files_hold_the_pixels_at_all_levels(void **state)
{
    (void)state;
    static const char *const levels[] = {"0", "1", "2", "3", "4", "5", "6", "7", "8", "9"};
    glint_image image = make_image(500, 400, 4);
    for (int level = 0; level < 10; level++) {
        const glint_write_options options = {.compression = levels[level]};
        const decoded read = check(&image, &options);
        assert_true(read.data_chunks > 1);
    }
    glint_image_free(&image);
}

static void each_filter_is_used_and_undone(void **state)
{
    (void)state;
    const glint_write_options options = {0};
    glint_image image = make_image(200, 200, 3);
    const decoded read = check(&image, &options);
    for (int filter = 0; filter < 5; filter++) {
        assert_true(read.filter_counts[filter] > 0);
    }
    glint_image_free(&image);
}

static void the_number_of_threads_does_not_change_the_bytes(void **state)
{
    (void)state;
    const glint_write_options options = {0};
    glint_image image = make_image(700, 600, 4);
    glint_encoded by_one = encode(&image, &options, 1);
    for (size_t threads = 2; threads <= 7; threads += 5) {
        glint_encoded by_more = encode(&image, &options, threads);
        assert_int_equal(by_one.size, by_more.size);
        assert_memory_equal(by_one.bytes, by_more.bytes, by_one.size);
        free(by_more.bytes);
    }
    free(by_one.bytes);
    glint_image_free(&image);
}

// Blocks continue each other. Two rows of noise take turns. So a row is known from the row but one
// before it, 18 KiB back. A block that began anew would hold both rows once more.
static void a_block_knows_the_one_before(void **state)
{
    (void)state;
    enum { WIDTH = 3000, ROW = 3 * WIDTH };
    const glint_write_options options = {0};
    glint_image image;
    unsigned seed = 3;
    assert_int_equal(glint_image_create(WIDTH, 700, 3, &image, NULL), GLINT_OK);
    for (size_t i = 0; i < (size_t)700 * ROW; i++) {
        image.pixels[i] = i < 2 * ROW ? noise_of(&seed) : image.pixels[i - 2 * ROW];
    }
    glint_encoded file = encode(&image, &options, 0);
    const decoded read = decode(&file);
    assert_true(read.data_chunks > 10);
    assert_true(file.size < read.data_chunks * 2 * ROW / 2);
    free(read.codes);
    free(file.bytes);
    glint_image_free(&image);
}

static void metadata_is_its_description(void **state)
{
    (void)state;
    const glint_metadata metadata[] = {
        {.name = "frame", .type = GLINT_METADATA_INT, .integer = -3},
        {.name = "matrix", .type = GLINT_METADATA_MATRIX},
        {.name = "seconds", .type = GLINT_METADATA_FLOAT, .real = 0.25f},
        {.name = "scene", .type = GLINT_METADATA_STRING, .string = "a b"},
        {.name = "nothing", .type = GLINT_METADATA_STRING}};
    const glint_write_options options = {.metadata = metadata, .metadata_count = 5};
    glint_image image = make_image(9, 9, 1);
    const decoded read = check(&image, &options);
    assert_string_equal(read.description, "frame: -3\nseconds: 0.25\nscene: a b\nnothing: \n");
    glint_image_free(&image);
}

static void a_row_that_is_too_long_is_refused(void **state)
{
    (void)state;
    float pixel = 0;
    glint_image image = {INT32_MAX, 1, 4, &pixel}; // refused before any pixel is read
    const glint_write_options options = {0};
    const glint_file_values values =
        glint_file_values_of(glint_image_written_format("a.png"), &image, &options);
    glint_encoded encoded = {0};
    glint_error error = {0};
    assert_int_equal(glint_png_encode("a.png", &values, 0, &encoded, &error), GLINT_OUTPUT_FAILED);
    assert_non_null(strstr(error.message, "a.png: is too wide"));
    assert_null(encoded.bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_hold_the_pixels_of_all_sizes),
        cmocka_unit_test(files_hold_the_pixels_at_all_levels),
        cmocka_unit_test(each_filter_is_used_and_undone),
        cmocka_unit_test(the_number_of_threads_does_not_change_the_bytes),
        cmocka_unit_test(a_block_knows_the_one_before),
        cmocka_unit_test(metadata_is_its_description),
        cmocka_unit_test(a_row_that_is_too_long_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
