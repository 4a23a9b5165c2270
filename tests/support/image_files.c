#include "support/image_files.h"

#include "support/scratch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

glint_image image_file_read(const char *name, glint_image_facts *facts)
{
    glint_image image;
    glint_error error = {0};
    if (glint_image_read(scratch_path(name), &image, facts, &error) != GLINT_OK) {
        fail_msg("%s", error.message);
    }
    return image;
}

void image_file_write_noise(const char *name, int channels)
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
