// Tests the parser of command lines, on tables made for the test.
#include "cli/common/options.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

typedef struct request {
    glint_settings settings;
    bool flag, other;
    int number;
    const char *output;
} request;

static const glint_option own_options[] = {
    {GLINT_OPTION_HEADING, .help = "Own"},
    {GLINT_OPTION_FLAG, .letter = 'f', .name = "flag", .help = "x",
     .offset = offsetof(request, flag)},
    {GLINT_OPTION_FLAG, .letter = 'g', .name = "flagon", .help = "x",
     .offset = offsetof(request, other)},
    {GLINT_OPTION_INT, .name = "number", .argument = "N", .help = "x",
     .offset = offsetof(request, number), .minimum = -5, .maximum = 5},
    {GLINT_OPTION_TEXT, .letter = 'o', .name = "output", .argument = "FILE", .help = "x",
     .offset = offsetof(request, output)},
    GLINT_SETTINGS_ROW(GLINT_SETTINGS_OF_FRAME, offsetof(request, settings)),
    GLINT_OPTION_END,
};
static const glint_option *const own_groups[] = {own_options, NULL};
static const glint_command own = {.name = "own",
                                  .synopsis = "[NAME…]",
                                  .groups = own_groups,
                                  .positional = "NAME",
                                  .takes_any_number = true,
                                  .request_size = sizeof(request)};

enum { WORDS = 12 };

// A command line, with '|' between its words, and its results.
typedef struct parsed {
    char line[200];
    char *words[WORDS];
    int count;
    request request;
    glint_arguments arguments;
    glint_error error;
} parsed;

static glint_status parse(const char *line, parsed *p)
{
    *p = (parsed){.words = {"own"}, .count = 1};
    snprintf(p->line, sizeof p->line, "%s", line);
    char *rest = p->line, *word;
    while ((word = strsep(&rest, "|")) != NULL) {
        p->words[p->count++] = word;
    }
    p->arguments = (glint_arguments){.words = p->words, .word_count = p->count};
    return glint_options_parse(&own, &p->request, &p->arguments, &p->error);
}

static void options_stand_anywhere_until_two_dashes(void **state)
{
    (void)state;
    static const struct {
        const char *line, *sorted;
        int positionals;
    } cases[] = {
        {"a|--number|3|b|--flag|c", "own --number 3 --flag a b c", 3},
        {"--number=3|-f|a|b|c", "own --number=3 -f a b c", 3},
        {"a|b|-f|--number|3|--|c", "own -f --number 3 -- a b c", 3},
        {"--number|3|-|-f|--|--flag", "own --number 3 -f -- - --flag", 2},
        {"--number|-4|--number|3|-f", "own --number -4 --number 3 -f", 0}, // the last one counts
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        parsed p;
        char sorted[200] = "own";
        assert_int_equal(parse(cases[i].line, &p), GLINT_OK);
        assert_true(p.request.flag && !p.request.other && p.request.number == 3);
        assert_int_equal(p.arguments.positional_count, cases[i].positionals);
        for (int k = 1; k < p.count; k++) {
            const size_t length = strlen(sorted);
            snprintf(sorted + length, sizeof sorted - length, " %s", p.words[k]);
        }
        assert_string_equal(sorted, cases[i].sorted);
        assert_ptr_equal(p.arguments.positionals + p.arguments.positional_count, p.words + p.count);
    }
}

static void letters_may_stand_together_and_before_a_value(void **state)
{
    (void)state;
    static const char *const lines[] = {"-fgofile", "-fg|-o|file", "-gf|-ofile", "-f|-g|-o|file"};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        parsed p;
        assert_int_equal(parse(lines[i], &p), GLINT_OK);
        assert_true(p.request.flag && p.request.other);
        assert_string_equal(p.request.output, "file");
    }
}

static void settings_are_options_in_their_places(void **state)
{
    (void)state;
    parsed p;
    assert_int_equal(parse("--depth|3|--shading=vertex-color|--samples|16|--mend|0.25", &p),
                     GLINT_OK);
    assert_int_equal(p.request.settings.depth, 3);
    assert_int_equal(p.request.settings.shading, GLINT_SHADING_VERTEX_COLOR);
    assert_int_equal(p.request.settings.samples_per_axis, 4);
    assert_true(p.request.settings.mend == 0.25);
    assert_int_equal(parse("--depth|auto", &p), GLINT_OK);
    assert_int_equal(p.request.settings.depth, 0);
    assert_int_equal(parse("--kernel-width|8", &p), GLINT_USAGE); // of another group
}

static void help_ends_the_reading(void **state)
{
    (void)state;
    static const char *const lines[] = {"--help", "-h", "-fh|--nonsense", "a|--help|-x", "-hx"};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        parsed p;
        assert_int_equal(parse(lines[i], &p), GLINT_OK);
        assert_true(p.arguments.help);
    }
}

static void mistakes_are_told_by_the_options_name(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        {"--help=x", "--help takes no value"},
        {"--flag=1", "--flag takes no value"},
        {"--fla", "unknown option --fla (did you mean --flag?)"},
        {"--hel", "unknown option --hel (did you mean --help?)"},
        {"--numbr=3", "unknown option --numbr (did you mean --number?)"},
        {"--shadin", "did you mean --shading?"},
        {"--frobnicate", "glint own --help lists them"},
        {"--=3", "unknown option --"},
        {"-x", "unknown option -x (glint own --help lists them)"},
        {"-fx", "unknown option -x"},
        {"--number", "--number: N is expected after it"},
        {"-o", "--output: FILE is expected after it"},
        {"-o|", "--output: an empty FILE"},
        {"--number|6", "--number 6: a whole number from -5 to 5"},
        {"--number| 1", "--number"},
        {"--number|0x1", "--number"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        parsed p;
        assert_int_equal(parse(cases[i][0], &p), GLINT_USAGE);
        if (strstr(p.error.message, cases[i][1]) == NULL) {
            print_error("%s: %s\n", cases[i][0], p.error.message);
            fail();
        }
    }
}

// Any number of options works: the last counts as well as the first.
static void no_option_is_one_too_many(void **state)
{
    (void)state;
    enum { MANY = 200 };
    static glint_option options[MANY + 1];
    static char names[MANY][16];
    static bool flags[MANY];
    const glint_option *const groups[] = {options, NULL};
    const glint_command command = {.name = "many", .groups = groups};
    for (size_t i = 0; i < MANY; i++) {
        snprintf(names[i], sizeof names[i], "option-%zu", i);
        options[i] = (glint_option){GLINT_OPTION_FLAG, .name = names[i], .help = "x",
                                    .offset = i * sizeof *flags};
    }
    for (size_t i = 0; i < MANY; i++) {
        char word[20];
        snprintf(word, sizeof word, "--option-%zu", i);
        char *words[] = {"many", word, NULL};
        glint_arguments arguments = {.words = words, .word_count = 2};
        assert_int_equal(glint_options_parse(&command, flags, &arguments, NULL), GLINT_OK);
        assert_true(flags[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(options_stand_anywhere_until_two_dashes),
        cmocka_unit_test(letters_may_stand_together_and_before_a_value),
        cmocka_unit_test(settings_are_options_in_their_places),
        cmocka_unit_test(help_ends_the_reading),
        cmocka_unit_test(mistakes_are_told_by_the_options_name),
        cmocka_unit_test(no_option_is_one_too_many),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
