// Tests that what glint says to other renderers' options is true of every command.
#include "cli/commands.h"
#include "cli/common/foreign_options.h"

#include <ctype.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const glint_command *const commands[] = {
    &glint_command_render,   &glint_command_farm,    &glint_command_contact, &glint_command_env,
    &glint_command_capture,  &glint_command_relight, &glint_command_compare, &glint_command_bench,
    &glint_command_selftest, &glint_command_info,    &glint_command_devices, &glint_command_warm};
enum { COMMAND_COUNT = sizeof commands / sizeof commands[0] };

static bool has_option(const glint_command *command, const char *name)
{
    glint_option unused;
    return glint_options_find(command, name, &unused);
}

// Parses "glint COMMAND --NAME" and returns the message. It must be a mistake.
static const char *said_to(const glint_command *command, const char *dashes, const char *name)
{
    static glint_error error;
    char command_name[32], word[80];
    snprintf(command_name, sizeof command_name, "%s", command->name);
    snprintf(word, sizeof word, "%s%s", dashes, name);
    char *words[] = {command_name, word, NULL};
    glint_arguments arguments = {.words = words, .word_count = 2};
    void *request = calloc(1, command->request_size);
    assert_non_null(request);
    error = (glint_error){0};
    assert_int_equal(glint_options_parse(command, request, &arguments, &error), GLINT_USAGE);
    free(request);
    return error.message;
}

// Every option that a text names must be an option of the command.
static void assert_options_exist(const glint_command *command, const char *text)
{
    const char *at = text;
    while ((at = strstr(at, "--")) != NULL) {
        char name[64];
        at += 2;
        snprintf(name, sizeof name, "%.*s",
                 (int)strspn(at, "abcdefghijklmnopqrstuvwxyz-0123456789"), at);
        if (strcmp(name, "version") != 0 && !has_option(command, name)) {
            fail_msg("glint %s has no --%s: \"%s\"", command->name, name, text);
        }
    }
}

// A suggested value must be one that the option takes.
static void assert_value_is_taken(const glint_command *command, const glint_foreign_option *row)
{
    static union {
        max_align_t alignment;
        char bytes[65536];
    } request;
    glint_option option;
    if (row->ours == NULL || row->text == NULL ||
        !glint_options_find(command, row->ours, &option)) {
        return;
    }
    assert_true(option.offset < sizeof request.bytes / 2);
    glint_error error = {0};
    if (glint_option_parse(&option, row->text, request.bytes + option.offset, &error) != GLINT_OK) {
        fail_msg("glint %s: %s", command->name, error.message);
    }
}

typedef void name_check(const glint_command *command, const glint_foreign_option *row,
                        const char *name);

// Calls `check` with each name of each row and each command.
static void for_each_name(name_check *check)
{
    for (const glint_foreign_option *row = glint_foreign_options; row->names != NULL; row++) {
        char *names = strdup(row->names), *rest = names;
        for (char *name; (name = strsep(&rest, " ")) != NULL;) {
            for (int i = 0; i < COMMAND_COUNT; i++) {
                check(commands[i], row, name);
            }
        }
        free(names);
    }
}

static void check_truth(const glint_command *command, const glint_foreign_option *row,
                        const char *name)
{
    char text[256] = "";
    assert_value_is_taken(command, row);
    if (!has_option(command, name) &&
        glint_foreign_option_explain(command, name, text, sizeof text)) {
        assert_options_exist(command, text);
        assert_true(strlen(text) + 1 < sizeof text || strchr(command->synopsis, '\n') != NULL);
    }
}

static void suggestions_exist(void **state)
{
    (void)state;
    for_each_name(check_truth);
}

// What a command has, it takes: no row stands in its way.
static void check_own(const glint_command *command, const glint_foreign_option *row,
                      const char *name)
{
    (void)row;
    if (has_option(command, name)) {
        assert_null(strstr(said_to(command, "--", name), "unknown option"));
    }
}

static void options_that_exist_are_never_explained_away(void **state)
{
    (void)state;
    for_each_name(check_own);
}

// Each row serves some command, and names are as users type them, in small letters.
static void rows_are_reachable(void **state)
{
    (void)state;
    for (const glint_foreign_option *row = glint_foreign_options; row->names != NULL; row++) {
        bool is_used = row->ours == NULL || row->ours[0] == '<';
        for (int i = 0; i < COMMAND_COUNT; i++) {
            is_used = is_used || has_option(commands[i], row->ours);
        }
        assert_true(is_used);
        assert_true(row->ours != NULL || row->text != NULL);
        for (const char *c = row->names; *c != '\0'; c++) {
            assert_true(islower((unsigned char)*c) || *c == '-' || *c == ' ' ||
                        isdigit((unsigned char)*c));
        }
        assert_null(strstr(row->names, "  "));
        assert_true(row->names[strlen(row->names) - 1] != ' ');
    }
}

static void users_of_other_renderers_find_their_way(void **state)
{
    (void)state;
    static const struct {
        const glint_command *command;
        const char *dashes, *typed, *said;
    } cases[] = {
        {&glint_command_render, "--", "dof", "unknown option --dof (glint has no depth of field)"},
        {&glint_command_render, "--", "threads", "(glint takes the cores that it may use: taskset"},
        {&glint_command_render, "--", "resolution", "(did you mean --size WxH?)"},
        {&glint_command_render, "--", "resolution=64x64", "(did you mean --size WxH?)"},
        {&glint_command_render, "--", "Spp", "(did you mean --samples 16?)"},
        {&glint_command_render, "--", "max_depth", "(did you mean --depth N|auto?)"},
        {&glint_command_render, "--", "width", "(did you mean --size WxH?)"},
        {&glint_command_render, "--", "gpu", "(did you mean --device gpu?)"},
        {&glint_command_render, "--", "motion-blur", "(glint has no motion blur)"},
        {&glint_command_render, "--", "skip", "(did you mean --skip-existing?)"},
        {&glint_command_render, "--", "input", "(SCENE stands without an option: glint render SC"},
        {&glint_command_render, "-", "spp", "unknown option -spp (did you mean --samples 16?)"},
        {&glint_command_render, "-", "size", "unknown option -size (did you mean --size?)"},
        {&glint_command_render, "-", "output", "unknown option -output (did you mean --output?)"},
        {&glint_command_render, "-", "height", "(did you mean --size WxH?)"},
        {&glint_command_render, "-", "t", "unknown option -t (glint takes the cores"},
        {&glint_command_render, "-", "x", "unknown option -x (glint render --help lists them)"},
        {&glint_command_render, "--", "dopth", "(did you mean --depth?)"},
        {&glint_command_render, "--", "of", "(glint render --help lists them)"},
        {&glint_command_capture, "--", "resolution", "(did you mean --size N?)"},
        {&glint_command_capture, "--", "output", "(OUT stands without an option: glint capture SC"},
        {&glint_command_env, "-", "o", "(OUT stands without an option: glint env IN OUT"},
        {&glint_command_contact, "--", "size", "(did you mean --width PIXELS?)"},
        {&glint_command_contact, "--", "spp", "(glint contact --help lists them)"},
        {&glint_command_compare, "--", "resolution", "(glint compare --help lists them)"},
        {&glint_command_env, "--", "input", "stands without an option: glint env IN OUT"},
        {&glint_command_farm, "--", "output", "(glint farm --help lists them)"},
        {&glint_command_farm, "--", "input", "(glint farm --help lists them)"},
        {&glint_command_bench, "--", "scene-file", "(SCENE stands without an option: glint bench"},
        {&glint_command_info, "--", "output", "(did you mean --json?)"},
        {&glint_command_bench, "--", "iterations", "(did you mean --rounds N?)"},
        {&glint_command_selftest, "--", "threads", "(did you mean --jobs N?)"},
        {&glint_command_farm, "--", "threads", "(did you mean --cpus N?)"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *said = said_to(cases[i].command, cases[i].dashes, cases[i].typed);
        if (strstr(said, cases[i].said) == NULL) {
            fail_msg("%s%s: \"%s\" where \"%s\" is right", cases[i].dashes, cases[i].typed, said,
                     cases[i].said);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(suggestions_exist),
        cmocka_unit_test(options_that_exist_are_never_explained_away),
        cmocka_unit_test(rows_are_reachable),
        cmocka_unit_test(users_of_other_renderers_find_their_way),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
