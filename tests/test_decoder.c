// Tests the image decoder: hostile files harm the decoder process but not glint. The decoder keeps
// to its limits, and is ready for the next file.
#include "image/decoder.h"

#include "image/image_io.h"
#include "support/hostile_images.h"
#include "support/scratch.h"

#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include <cmocka.h>

#define MIB (UINT64_C(1) << 20)

static glint_image_source source_of(const char *path)
{
    glint_image_source source;
    glint_error error = {0};
    if (glint_image_find_source(path, &source, &error) != GLINT_OK) {
        fail_msg("%s", error.message);
    }
    return source;
}

static void write_good(const char *name)
{
    glint_image image;
    assert_int_equal(glint_image_create(5, 4, 3, &image, NULL), GLINT_OK);
    for (int i = 0; i < 60; i++) {
        image.pixels[i] = (float)i / 64.0f;
    }
    assert_int_equal(glint_image_write(scratch_path(name), &image, NULL, NULL), GLINT_OK);
    glint_image_free(&image);
}

static void a_good_file_is_read(const char *name)
{
    glint_image image;
    glint_error error = {0};
    if (glint_image_read(scratch_path(name), &image, NULL, &error) != GLINT_OK) {
        fail_msg("%s", error.message);
    }
    assert_int_equal(image.width, 5);
    assert_int_equal(image.height, 4);
    assert_true(image.pixels[59] == 59.0f / 64.0f);
    glint_image_free(&image);
}

static void hostile_files_are_refused_in_one_line(void **state)
{
    (void)state;
    write_good("good.exr");
    for (size_t i = 0; i < hostile_image_count; i++) {
        const hostile_image *hostile = &hostile_images[i];
        image_bytes file = hostile->make();
        scratch_write(hostile->name, file.bytes, (long)file.length);
        const char *path = scratch_path(hostile->name);
        const glint_image_source source = source_of(path);
        glint_decode_limits limits = glint_decoder_limits(source.size);
        if (strcmp(hostile->said, "to decode") == 0) {
            limits.cpu_seconds = 1; // these files never end; one second is enough
        }
        glint_stored stored;
        glint_error error = {0};
        assert_int_equal(glint_decoder_run_within(&source, false, &limits, &stored, &error),
                         GLINT_BAD_INPUT);
        if (strncmp(error.message, path, strlen(path)) != 0 ||
            strstr(error.message, hostile->said) == NULL) {
            fail_msg("'%s' does not say '%s'", error.message, hostile->said);
        }
        assert_null(strchr(error.message, '\n'));
        a_good_file_is_read("good.exr");
        image_bytes_free(&file);
    }
}

static float one(int channel, int x, int y, void *context)
{
    (void)channel, (void)x, (void)y, (void)context;
    return 1;
}

static void pictures_of_the_allowed_size_are_read_and_larger_ones_not(void **state)
{
    (void)state;
    static const char *const names[] = {"B", "G", "R"};
    exr_recipe recipe = {.names = names,
                         .channels = 3,
                         .data = {0, 0, 63, 63},
                         .display = {0, 0, 63, 63},
                         .envmap = -1,
                         .value = one};
    image_bytes file = exr_bytes(&recipe);
    scratch_write("a.exr", file.bytes, (long)file.length);
    image_bytes_free(&file);
    const glint_image_source source = source_of(scratch_path("a.exr"));
    glint_decode_limits limits = glint_decoder_limits(source.size);
    glint_stored stored;
    glint_error error = {0};
    limits.picture_bytes = 64 * 64 * 3 * sizeof(float);
    assert_int_equal(glint_decoder_run_within(&source, false, &limits, &stored, &error), GLINT_OK);
    assert_int_equal(stored.value_bytes, limits.picture_bytes);
    glint_stored_free(&stored);
    limits.picture_bytes--;
    assert_int_equal(glint_decoder_run_within(&source, false, &limits, &stored, &error),
                     GLINT_BAD_INPUT);
    assert_non_null(strstr(error.message, "--allow-large-images"));
    const glint_decode_limits none = {0};
    assert_int_equal(glint_decoder_run_within(&source, true, &none, &stored, &error), GLINT_OK);
    glint_stored_free(&stored);
}

static void limits_grow_with_the_file(void **state)
{
    (void)state;
    const glint_decode_limits small = glint_decoder_limits(1),
                              huge = glint_decoder_limits(UINT64_MAX);
    const glint_decode_limits large = glint_decoder_limits(1024 * MIB);
    // For small files, the decoder and glint's picture together must stay under two gibibytes.
    assert_true(small.memory_bytes + small.picture_bytes <= 2048 * MIB);
    assert_true(small.picture_bytes >= UINT64_C(8192) * 4096 * 4 * sizeof(float));
    assert_in_range(small.cpu_seconds, 5, 15);
    assert_int_equal(large.picture_bytes, 64 * 1024 * MIB);
    assert_true(large.cpu_seconds > small.cpu_seconds);
    assert_true(huge.picture_bytes > large.picture_bytes && huge.seconds > huge.cpu_seconds);
}

// The decoder has its own memory: this process stays small, whatever the file does to the decoder.
static void the_caller_stays_small(void **state)
{
    (void)state;
    struct rusage before, after;
    getrusage(RUSAGE_SELF, &before);
    for (size_t i = 0; i < hostile_image_count; i++) {
        if (strcmp(hostile_images[i].said, "to decode") == 0) {
            continue; // skip slow files
        }
        image_bytes file = hostile_images[i].make();
        scratch_write(hostile_images[i].name, file.bytes, (long)file.length);
        image_bytes_free(&file);
        glint_image image;
        assert_int_equal(glint_image_read(scratch_path(hostile_images[i].name), &image, NULL, NULL),
                         GLINT_BAD_INPUT);
    }
    getrusage(RUSAGE_SELF, &after);
    assert_true(after.ru_maxrss - before.ru_maxrss < 64 * 1024); // kilobytes
}

int main(void)
{
    const struct CMUnitTest tests[] = {
#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, scratch_setup, scratch_teardown)
        IN_FOLDER(hostile_files_are_refused_in_one_line),
        IN_FOLDER(pictures_of_the_allowed_size_are_read_and_larger_ones_not),
        cmocka_unit_test(limits_grow_with_the_file),
        IN_FOLDER(the_caller_stays_small),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
