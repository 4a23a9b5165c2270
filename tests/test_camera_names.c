// Tests the file names of --camera all.
#include "cli/render/camera_names.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define MOST 8

// `own` and `wanted` end with NULL. NONE is a camera without a name.
#define NONE ""

static void assert_names(const char *const own[], const char *const wanted[])
{
    glint_camera cameras[MOST] = {{0}};
    char *names[MOST] = {NULL};
    size_t count = 0;
    for (; own[count] != NULL; count++) {
        cameras[count].name = own[count][0] != '\0' ? strdup(own[count]) : NULL;
    }
    assert_int_equal(render_camera_names(cameras, count, names, NULL), GLINT_OK);
    for (size_t i = 0; i < count; i++) {
        assert_string_equal(names[i], wanted[i]);
        free(cameras[i].name);
        free(names[i]);
    }
}

#define LIST(...)                                                                                  \
    (const char *const[])                                                                          \
    {                                                                                              \
        __VA_ARGS__, NULL                                                                          \
    }

static void cameras_keep_their_names_where_files_can(void **state)
{
    (void)state;
    assert_names(LIST("front", "Top_2.b-c", "Vordere Kamera", "Küche"),
                 LIST("front", "Top_2.b-c", "Vordere_Kamera", "Küche"));
    assert_names(LIST("../../etc/x", "a\\b:c*?\"<>|", "f####", "%04d"),
                 LIST(".._.._etc_x", "a_b_c______", "f____", "_04d"));
    // U+202E reverses the direction of text; the last name is invalid UTF-8.
    const char turned[] = {'a', (char)0xe2, (char)0x80, (char)0xae, 'b', '\0'};
    assert_names(LIST("a\nb\x1b[31m", "\xc2\x9b_m", turned, "\xff\xfe"),
                 LIST("a_b__31m", "__m", "a_b", "__"));
}

static void cameras_without_a_name_are_called_by_their_index(void **state)
{
    (void)state;
    assert_names(LIST(NONE, "side", NONE), LIST("0", "side", "2"));
}

static void names_are_never_the_same(void **state)
{
    (void)state;
    assert_names(LIST("a", "b", "a"), LIST("0", "b", "2"));
    assert_names(LIST("Top", "top", "tops"), LIST("0", "1", "tops"));
    assert_names(LIST("a/b", "a_b"), LIST("0", "1"));
    // Each index is the name of another camera.
    assert_names(LIST("2", "x", "x", "0"), LIST("0", "1", "2", "3"));
}

static void long_names_are_cut_between_characters(void **state)
{
    (void)state;
    enum { BYTES = sizeof "€" - 1 };
    char name[40 * BYTES + 1] = "", wanted[21 * BYTES + 1] = "";
    for (int i = 0; i < 40; i++) {
        memcpy(name + i * BYTES, "€", BYTES);
        memcpy(wanted + (i < 21 ? i : 0) * BYTES, "€", BYTES);
    }
    assert_names(LIST(name), LIST(wanted));
}

static void the_name_stands_before_the_extension_or_the_number(void **state)
{
    (void)state;
    static const char *const paths[][2] = {
        {"car.png", "car.front.png"},
        {"out.d/car.v2.exr", "out.d/car.v2.front.exr"},
        {"turn/car.####.exr", "turn/car.front.####.exr"},
        {"turn/####.exr", "turn/front.####.exr"},
        {"turn/f%04d.exr", "turn/f.front.%04d.exr"},
        {"turn/f_#.exr", "turn/f_front.#.exr"},
        {"a.b/stats", "a.b/stats.front"},
        {"ring \\#1.png", "ring \\#1.front.png"},
        {"ring \\#1.##.png", "ring \\#1.front.##.png"},
        {"a\\\\##.png", "a.front.\\\\##.png"},
        {".png", "front.png"},
    };
    for (size_t i = 0; i < sizeof paths / sizeof paths[0]; i++) {
        char *made = render_camera_path(paths[i][0], "front");
        assert_string_equal(made, paths[i][1]);
        free(made);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cameras_keep_their_names_where_files_can),
        cmocka_unit_test(cameras_without_a_name_are_called_by_their_index),
        cmocka_unit_test(names_are_never_the_same),
        cmocka_unit_test(long_names_are_cut_between_characters),
        cmocka_unit_test(the_name_stands_before_the_extension_or_the_number),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
