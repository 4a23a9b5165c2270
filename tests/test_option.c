// Tests the numbers and words of option values.
#include "base/option.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static const char *const no_numbers[] = {
    "",     " ",        "x",   "-",   "+",      ".",     "e5",    "0x10", "0X1p3", " 1",    "1 ",
    "\t1",  "1\n",      "1,5", "1x",  "--1",    "+-1",   "1e",    "1e+",  "1.5e",  "inf",   "INF",
    "-inf", "infinity", "nan", "NaN", "nan(1)", "1_000", "1'000", "1f",   "1..2",  "1e5.5",
};

static void numbers_are_decimal_and_nothing_else(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof no_numbers / sizeof *no_numbers; i++) {
        double real = 7;
        double reals[1];
        long long whole = 7;
        assert_false(glint_parse_real(no_numbers[i], &real));
        assert_false(glint_parse_int(no_numbers[i], &whole));
        assert_false(glint_parse_reals(no_numbers[i], reals, 1));
        assert_true(real == 7 && whole == 7);
    }
}

static void reals_have_points_and_exponents(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double value;
    } cases[] = {{"0", 0},      {"-1.5", -1.5}, {"+2", 2},        {".5", 0.5},  {"3.", 3},
                 {"1e3", 1000}, {"1E-2", 0.01}, {"2.5e+1", 25.0}, {"0010", 10}, {"1e-999", 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double value;
        assert_true(glint_parse_real(cases[i].text, &value));
        assert_true(value == cases[i].value);
    }
    double value;
    assert_false(glint_parse_real("1e999", &value)); // not finite
    assert_false(glint_parse_real("-1e999", &value));
}

static void whole_numbers_have_neither(void **state)
{
    (void)state;
    long long value;
    assert_true(glint_parse_int("-9223372036854775808", &value) && value == INT64_MIN);
    assert_true(glint_parse_int("+010", &value) && value == 10);
    assert_false(glint_parse_int("9223372036854775808", &value));
    assert_false(glint_parse_int("1.0", &value));
    assert_false(glint_parse_int("1e3", &value));
}

static void lists_have_commas_alone_between(void **state)
{
    (void)state;
    double v[3];
    assert_true(glint_parse_reals("1,-2.5,1e2", v, 3));
    assert_true(v[0] == 1 && v[1] == -2.5 && v[2] == 100);
    static const char *const wrong[] = {"1,2",   "1,2,3,4", "1, 2,3",  "1,2,3 ", "1,,3",
                                        "1;2;3", "1,2,nan", "1,2,0x3", ",1,2",   "1,2,1e999"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_false(glint_parse_reals(wrong[i], v, 3));
    }
}

static void a_word_is_near_by_two_letters_or_as_a_beginning(void **state)
{
    (void)state;
    static const char *const words[] = {"transparent", "env", "depth", "aov", "render", NULL};
    assert_string_equal(glint_nearest_word("transparant", words), "transparent");
    assert_string_equal(glint_nearest_word("tr", words), "transparent");
    assert_string_equal(glint_nearest_word("dept", words), "depth");
    assert_string_equal(glint_nearest_word("rednre", words), "render"); // two exchanges
    assert_string_equal(glint_nearest_word("edpth", words), "depth");
    assert_string_equal(glint_nearest_word("evn", words), "env");
    assert_null(glint_nearest_word("frobnicate", words));
    assert_null(glint_nearest_word("dof", words)); // two letters of three are others
    assert_null(glint_nearest_word("ev", words));
    assert_null(glint_nearest_word("width", words));
    assert_null(glint_nearest_word("", words));
}

// The distance by its definition: the cheaper of all edits at the first letters.
static size_t distance_by_definition(const char *a, const char *b)
{
    if (a[0] == '\0' || b[0] == '\0') {
        return strlen(a) + strlen(b);
    }
    const size_t by_replacing = distance_by_definition(a + 1, b + 1) + (a[0] != b[0]);
    const size_t by_deleting = distance_by_definition(a + 1, b) + 1;
    const size_t by_inserting = distance_by_definition(a, b + 1) + 1;
    size_t least = by_replacing < by_deleting ? by_replacing : by_deleting;
    least = by_inserting < least ? by_inserting : least;
    if (a[0] == b[1] && a[1] == b[0]) {
        const size_t by_exchanging = distance_by_definition(a + 2, b + 2) + 1;
        least = by_exchanging < least ? by_exchanging : least;
    }
    return least;
}

// All words of six letters from "abc".
static void distances_are_those_of_the_definition(void **state)
{
    (void)state;
    static const char *const words[] = {"abcabcab", "bcacba", "cabcab", "ababab"};
    for (int number = 0; number < 729; number++) {
        char text[7] = "";
        for (int i = 0, rest = number; i < 6; i++, rest /= 3) {
            text[i] = (char)('a' + rest % 3);
        }
        for (size_t k = 0; k < sizeof words / sizeof *words; k++) {
            const bool is_beginning = strncmp(words[k], text, 6) == 0;
            const size_t distance = is_beginning ? 1 : distance_by_definition(text, words[k]);
            assert_int_equal(glint_word_distance(text, words[k]),
                             distance <= 2 ? distance : GLINT_WORD_IS_FAR);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_are_decimal_and_nothing_else),
        cmocka_unit_test(reals_have_points_and_exponents),
        cmocka_unit_test(whole_numbers_have_neither),
        cmocka_unit_test(lists_have_commas_alone_between),
        cmocka_unit_test(a_word_is_near_by_two_letters_or_as_a_beginning),
        cmocka_unit_test(distances_are_those_of_the_definition),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
