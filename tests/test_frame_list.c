// Tests lists of frames, their parts and their file names.
#include "base/random.h"
#include "cli/common/frame_list.h"
#include "cli/common/frame_name.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// Lists the frames of one part of a list, as text "1 2 3".
static void walk(const char *list_text, glint_shard shard, char *out, size_t capacity)
{
    glint_frame_list list;
    glint_error error = {0};
    assert_int_equal(glint_frame_list_parse(list_text, &list, &error), GLINT_OK);
    glint_frame_cursor cursor = {.list = &list, .shard = shard};
    int frame;
    uint64_t count = 0;
    size_t length = 0;
    out[0] = '\0';
    while (glint_frame_next(&cursor, &frame)) {
        length +=
            (size_t)snprintf(out + length, capacity - length, "%s%d", count > 0 ? " " : "", frame);
        count++;
    }
    assert_int_equal(count, glint_shard_size(shard, list.count));
    glint_frame_list_free(&list);
}

static void frames_in_the_order_they_are_asked_for(void **state)
{
    (void)state;
    static const char *const lists[][2] = {
        {"7", "7"},
        {"0", "0"},
        {"1-5", "1 2 3 4 5"},
        {"5-1", "5 4 3 2 1"},
        {"1-10x3", "1 4 7 10"},
        {"1-9x3", "1 4 7"},
        {"10-1x-4", "10 6 2"},
        {"-2-2", "-2 -1 0 1 2"},
        {"-1--3", "-1 -2 -3"},
        {"4-4x-7", "4"},
        {"1-3,2-5", "1 2 3 4 5"},
        {"1-10x3,1-10", "1 4 7 10 2 3 5 6 8 9"},
        {"9,8,9,8-9", "9 8"},
        {"1-3,20-30x5,2", "1 2 3 20 25 30"},
        {"999999999-999999999", "999999999"},
    };
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        char text[256];
        walk(lists[i][0], (glint_shard){1, 1}, text, sizeof text);
        assert_string_equal(text, lists[i][1]);
    }
}

static void mistakes_are_named(void **state)
{
    (void)state;
    static const char *const lists[][2] = {
        {"", "at ''"},
        {"1,", "at ''"},
        {",1", "at ',1'"},
        {"1-", "at ''"},
        {"1-x2", "at 'x2'"},
        {"1-5x", "at ''"},
        {"1-5x0", "leads nowhere"},
        {"1-5x-1", "never come to 5"},
        {"5-1x2", "never come to 1"},
        {"1x2", "'x2' makes no sense"},
        {"1-5 ", "' ' makes no sense"},
        {"1..5", "'..5' makes no sense"},
        {"one", "at 'one'"},
        {"1000000000", "at '"},
        {"99999999999999999999999", "at '9999"},
        {"+1", "at '+1'"},
        {" 1", "at ' 1'"},
    };
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        glint_frame_list list;
        glint_error error = {0};
        assert_int_equal(glint_frame_list_parse(lists[i][0], &list, &error), GLINT_USAGE);
        assert_non_null(strstr(error.message, lists[i][1]));
        assert_null(list.ranges);
    }
    static const char *const shards[] = {"",     "1",    "0/3", "4/3", "1/0", "-1/3",
                                         "1/-3", "1/3x", "/3",  "1/",  "1 /3"};
    for (size_t i = 0; i < sizeof shards / sizeof *shards; i++) {
        glint_shard shard;
        glint_error error = {0};
        assert_int_equal(glint_shard_parse(shards[i], &shard, &error), GLINT_USAGE);
    }
}

// Compares with a table marked frame by frame.
enum { LOW = -40, FRAMES = 120, RANGES = 6 };

typedef struct random_list {
    char text[256];
    int order[FRAMES]; // the frames as they come
    int count;
} random_list;

static int draw(glint_random *random, int below)
{
    return (int)(glint_random_number(random) * below);
}

static random_list draw_list(glint_random *random)
{
    random_list list = {0};
    bool marked[FRAMES] = {false};
    const int ranges = 1 + draw(random, RANGES);
    for (int i = 0; i < ranges; i++) {
        const int first = LOW + draw(random, FRAMES), last = LOW + draw(random, FRAMES);
        const int step = (last < first ? -1 : 1) * (1 + draw(random, 5));
        const size_t length = strlen(list.text);
        snprintf(list.text + length, sizeof list.text - length, "%s%d-%dx%d", i > 0 ? "," : "",
                 first, last, step);
        for (int frame = first; step > 0 ? frame <= last : frame >= last; frame += step) {
            if (!marked[frame - LOW]) {
                marked[frame - LOW] = true;
                list.order[list.count++] = frame;
            }
        }
    }
    return list;
}

static void every_frame_is_in_exactly_one_part(void **state)
{
    (void)state;
    glint_random random = {42};
    for (int round = 0; round < 2000; round++) {
        const random_list expected = draw_list(&random);
        const uint32_t parts = 1 + (uint32_t)draw(&random, 9);
        glint_frame_list list;
        glint_error error = {0};
        assert_int_equal(glint_frame_list_parse(expected.text, &list, &error), GLINT_OK);
        assert_int_equal(list.count, expected.count);
        for (uint32_t part = 1; part <= parts; part++) {
            glint_frame_cursor cursor = {.list = &list, .shard = {part, parts}};
            int frame;
            int at = (int)part - 1;
            uint64_t seen = 0;
            for (; glint_frame_next(&cursor, &frame); at += (int)parts) {
                assert_true(at < expected.count);
                assert_int_equal(frame, expected.order[at]);
                seen++;
            }
            assert_true(at >= expected.count);
            assert_int_equal(seen, glint_shard_size(cursor.shard, list.count));
        }
        glint_frame_list_free(&list);
    }
}

static void millions_of_frames_take_no_memory(void **state)
{
    (void)state;
    glint_frame_list list;
    glint_error error = {0};
    assert_int_equal(glint_frame_list_parse("-999999999-999999999", &list, &error), GLINT_OK);
    assert_int_equal(list.range_count, 1);
    assert_int_equal(list.count, 1999999999);
    assert_int_equal(glint_frame_list_highest(&list), 999999999);
    glint_frame_list_free(&list);
    assert_int_equal(glint_frame_list_parse("1-1000000,500000-1500000", &list, &error), GLINT_OK);
    assert_int_equal(list.count, 1500000);
    glint_frame_list_free(&list);
    assert_int_equal(glint_frame_list_span(1, 240, &list, &error), GLINT_OK);
    assert_int_equal(list.count, 240);
    glint_frame_list_free(&list);
}

static void frames_are_printed_as_ranges(void **state)
{
    (void)state;
    char text[96];
    int frames[] = {20, 9, 3, 8, 7, -1};
    glint_frame_list_print(frames, 6, text, sizeof text);
    assert_string_equal(text, "-1,3,7-9,20");
    int many[100];
    for (int i = 0; i < 100; i++) {
        many[i] = 2 * i;
    }
    glint_frame_list_print(many, 100, text, sizeof text);
    assert_non_null(strstr(text, " and "));
    assert_true(strlen(text) < sizeof text - 1);
    glint_frame_list_print(many, 0, text, sizeof text);
    assert_string_equal(text, "");
}

static void names_hold_the_number(void **state)
{
    (void)state;
    static const struct {
        const char *path;
        int frame;
        const char *name;
    } cases[] = {
        {"a.####.exr", 7, "a.0007.exr"},
        {"a.####.exr", 12345, "a.12345.exr"},
        {"a.####.exr", -7, "a.-0007.exr"},
        {"a#.png", 7, "a7.png"},
        {"f#/a.%04d.exr", 7, "f#/a.0007.exr"},
        {"%d", 7, "7"},
        {"f/%3d.exr", 7, "f/007.exr"},
        {"plain.exr", 7, "plain.exr"},
        {"100%.exr", 7, "100%.exr"},
        {"%123d.exr", 7, "%123d.exr"},
        {"####", 0, "0000"},
        // Escapes, and backslashes that escape nothing.
        {"ring \\#1.png", 7, "ring #1.png"},
        {"ring \\#1.####.png", 7, "ring #1.0007.png"},
        {"take \\#####.exr", 7, "take #0007.exr"},
        {"\\#\\#.exr", 7, "##.exr"},
        {"a\\%d.%d", 7, "a%d.7"},
        {"a\\%04d.##", 7, "a%04d.07"},
        {"a\\\\##.exr", 7, "a\\07.exr"},
        {"a\\\\\\##.exr", 7, "a\\#7.exr"},
        {"a\\b\\\\c.#\\", 7, "a\\b\\\\c.7\\"},
        {"f\\#/100\\%.#.exr", 7, "f\\#/100\\%.7.exr"},
        {"", 7, ""},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        glint_frame_name name;
        glint_error error = {0};
        assert_int_equal(glint_frame_name_parse(cases[i].path, &name, &error), GLINT_OK);
        char *path = glint_frame_name_make(&name, cases[i].frame);
        assert_string_equal(path, cases[i].name);
        free(path);
        glint_frame_name_free(&name);
    }
    static const char *const refused[] = {"a.##.##.exr", "a.%d.####.exr", "#.%4d", "\\#.#.#"};
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        glint_frame_name name;
        glint_error error = {0};
        assert_int_equal(glint_frame_name_parse(refused[i], &name, &error), GLINT_USAGE);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_in_the_order_they_are_asked_for),
        cmocka_unit_test(mistakes_are_named),
        cmocka_unit_test(every_frame_is_in_exactly_one_part),
        cmocka_unit_test(millions_of_frames_take_no_memory),
        cmocka_unit_test(frames_are_printed_as_ranges),
        cmocka_unit_test(names_hold_the_number),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
