// Tests --texture-size, which drops texture levels, and joined images.
#include "scene/texture/texture.h"
#include "scene/texture/texture_read.h"
#include "support/scratch.h"
#include "support/textured_plane.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static glint_texture_levels read_levels(const char *name, int largest)
{
    glint_texture_request request = {.is_color = true};
    glint_texture_levels levels;
    glint_error error = {0};
    glint_status status = glint_image_find_source(scratch_path(name), &request.source, &error);
    if (status == GLINT_OK) {
        status = glint_texture_read(&request, largest, &levels, &error);
    }
    if (status != GLINT_OK) {
        fail_msg("%s", error.message);
    }
    return levels;
}

static void write_pictures(void)
{
    unsigned char codes[31 * 17][4];
    for (int i = 0; i < 31 * 17; i++) {
        memcpy(codes[i], (unsigned char[]){(unsigned char)(7 * i), (unsigned char)i, 9, 255}, 4);
    }
    write_codes("a.png", (int[]){31, 17}, (const unsigned char(*)[4])codes);
    write_codes("b.png", (int[]){4, 2}, (const unsigned char(*)[4])codes);
}

static void what_is_left_are_the_smaller_levels(void **state)
{
    (void)state;
    write_pictures();
    // 31 × 17, 15 × 8, 7 × 4, 3 × 2, 1 × 1
    static const struct {
        int largest, width, height, levels;
    } cases[] = {{31, 31, 17, 5}, {30, 15, 8, 4}, {8, 7, 4, 3}, {3, 3, 2, 2}, {1, 1, 1, 1}};
    glint_texture_levels all = read_levels("a.png", 0);
    assert_int_equal(all.texture.levels, 5);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        glint_texture_levels some = read_levels("a.png", cases[i].largest);
        assert_int_equal(some.texture.width, cases[i].width);
        assert_int_equal(some.texture.height, cases[i].height);
        assert_int_equal(some.texture.levels, cases[i].levels);
        const size_t gone = all.texture.first[5 - cases[i].levels];
        assert_int_equal(some.texel_count, all.texel_count - gone);
        for (int k = 0; k < cases[i].levels; k++) {
            assert_int_equal(some.texture.first[k],
                             all.texture.first[5 - cases[i].levels + k] - gone);
        }
        assert_memory_equal(some.texels, all.texels + gone, some.texel_count * sizeof *some.texels);
        free(some.texels);
    }
    free(all.texels);
}

static void joined_images_keep_their_texels(void **state)
{
    (void)state;
    write_pictures();
    static const char *const names[] = {"a.png", "b.png"};
    for (size_t count = 1; count <= 2; count++) {
        glint_texture_levels images[2] = {0}, again[2] = {0};
        for (size_t i = 0; i < count; i++) {
            images[i] = read_levels(names[i], 0);
            again[i] = read_levels(names[i], 0);
        }
        glint_textures *all = NULL;
        assert_int_equal(glint_textures_join(images, count, &all, NULL), GLINT_OK);
        assert_int_equal(all->count, count);
        size_t before = 0;
        for (size_t i = 0; i < count; i++) {
            assert_null(images[i].texels);
            assert_int_equal(all->textures[i].first[0], before);
            assert_memory_equal(all->texels + before, again[i].texels,
                                again[i].texel_count * sizeof *again[i].texels);
            before += again[i].texel_count;
            free(again[i].texels);
        }
        assert_int_equal(all->texel_count, before);
        glint_textures_release(all);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(what_is_left_are_the_smaller_levels, scratch_setup,
                                        scratch_teardown),
        cmocka_unit_test_setup_teardown(joined_images_keep_their_texels, scratch_setup,
                                        scratch_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
