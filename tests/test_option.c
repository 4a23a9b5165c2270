// Tests the numbers and words of option values.
#include "base/option.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
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
    static const char *const words[] = {"transparent", "env", "depth", NULL};
    assert_string_equal(glint_nearest_word("transparant", words), "transparent");
    assert_string_equal(glint_nearest_word("tr", words), "transparent");
    assert_string_equal(glint_nearest_word("dept", words), "depth");
    assert_null(glint_nearest_word("frobnicate", words));
    assert_null(glint_nearest_word("", words));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_are_decimal_and_nothing_else),
        cmocka_unit_test(reals_have_points_and_exponents),
        cmocka_unit_test(whole_numbers_have_neither),
        cmocka_unit_test(lists_have_commas_alone_between),
        cmocka_unit_test(a_word_is_near_by_two_letters_or_as_a_beginning),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
