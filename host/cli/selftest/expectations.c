// Reads the list of known self-test failures. See expectations.h.
#include "cli/selftest/expectations.h"

#include "base/regular_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BLANKS " \t\r\n"

typedef struct selftest_expectation {
    const char *name; // static
    int line;
    int width;     // 0: any
    int precision; // a glint_precision, -1: any
} selftest_expectation;

static glint_status fail_at(const selftest_expectations *e, int line, const char *word,
                            const char *what, glint_error *error)
{
    return glint_fail(error, GLINT_BAD_INPUT, "%s: line %d: '%s' %s", e->path, line, word, what);
}

static glint_status find_name(const selftest_expectations *e, const char *word,
                              selftest_expectation *found, glint_error *error)
{
    for (size_t i = 0; glint_selftest_name(i) != NULL; i++) {
        if (strcmp(glint_selftest_name(i), word) == 0) {
            found->name = glint_selftest_name(i);
            return GLINT_OK;
        }
    }
    return fail_at(e, found->line, word, "is no case (glint selftest --list has them)", error);
}

// Parses a word after a case's name: a precision or a width.
static glint_status take_word(const selftest_expectations *e, const char *word,
                              selftest_expectation *found, glint_error *error)
{
    const bool is_double = strcmp(word, "double") == 0;
    if ((is_double || strcmp(word, "float") == 0) && found->precision < 0) {
        found->precision = is_double ? GLINT_PRECISION_DOUBLE : GLINT_PRECISION_FLOAT;
        return GLINT_OK;
    }
    static const int widths[] = {1, 8, 16};
    for (size_t i = 0; i < sizeof widths / sizeof *widths && found->width == 0; i++) {
        char text[8];
        snprintf(text, sizeof text, "%d", widths[i]);
        if (strcmp(word, text) == 0) {
            found->width = widths[i];
            return GLINT_OK;
        }
    }
    return fail_at(e, found->line, word,
                   "does not belong there (after the case: float or double, and 1, 8 or 16)",
                   error);
}

static glint_status read_line(char *text, int line, selftest_expectations *e, glint_error *error)
{
    text[strcspn(text, "#")] = '\0';
    char *rest = NULL;
    const char *word = strtok_r(text, BLANKS, &rest);
    if (word == NULL) {
        return GLINT_OK;
    }
    selftest_expectation found = {.line = line, .precision = -1};
    TRY(find_name(e, word, &found, error));
    while ((word = strtok_r(NULL, BLANKS, &rest)) != NULL) {
        TRY(take_word(e, word, &found, error));
    }
    selftest_expectation *list = realloc(e->list, (e->count + 1) * sizeof *list);
    if (list == NULL) {
        return glint_fail_memory(error, "the expected failures");
    }
    list[e->count++] = found;
    e->list = list;
    return GLINT_OK;
}

glint_status selftest_expectations_read(const char *path, selftest_expectations *expectations,
                                        glint_error *error)
{
    FILE *file;
    *expectations = (selftest_expectations){.path = path};
    TRY(glint_regular_file_open(path, &file, NULL, error));
    char *text = NULL;
    size_t capacity = 0;
    glint_status status = GLINT_OK;
    for (int line = 1; getline(&text, &capacity, file) >= 0; line++) {
        TRY_OR(cleanup, status, read_line(text, line, expectations, error));
    }
cleanup:
    free(text);
    fclose(file);
    return status;
}

void selftest_expectations_free(selftest_expectations *expectations)
{
    free(expectations->list);
    *expectations = (selftest_expectations){0};
}

int selftest_expectation_of(const selftest_expectations *expectations,
                            const glint_selftest_result *result)
{
    for (size_t i = 0; i < expectations->count; i++) {
        const selftest_expectation *e = &expectations->list[i];
        if (strcmp(e->name, result->name) == 0 && (e->width == 0 || e->width == result->width) &&
            (e->precision < 0 || e->precision == (int)result->precision)) {
            return e->line;
        }
    }
    return 0;
}
