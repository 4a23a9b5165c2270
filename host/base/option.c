// Reads the values of options. See option.h.
#include "base/option.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ---- Numbers -----------------------------------------------------------------------------------

#define DIGITS "0123456789"

// The length in bytes of the decimal number at the beginning of `text`; 0: none. strtod would also
// accept spaces, hexadecimal digits and "inf".
static size_t number_length(const char *text, bool is_whole)
{
    const char *at = text + (*text == '+' || *text == '-');
    size_t digits = strspn(at, DIGITS);
    at += digits;
    if (!is_whole && *at == '.') {
        const size_t behind = strspn(at + 1, DIGITS);
        digits += behind;
        at += 1 + behind;
    }
    if (digits == 0) {
        return 0;
    }
    if (!is_whole && (*at == 'e' || *at == 'E')) {
        const char *exponent = at + 1 + (at[1] == '+' || at[1] == '-');
        const size_t behind = strspn(exponent, DIGITS);
        at = behind > 0 ? exponent + behind : at;
    }
    return (size_t)(at - text);
}

bool glint_parse_int(const char *text, long long *value)
{
    const size_t length = number_length(text, true);
    if (length == 0 || text[length] != '\0') {
        return false;
    }
    errno = 0;
    const long long parsed = strtoll(text, NULL, 10);
    if (errno != 0) {
        return false;
    }
    *value = parsed;
    return true;
}

// Reads the number in the first `length` bytes. If the locale has another decimal point, strtod
// ends too early, and the number is refused, not misread.
static bool read_real(const char *text, size_t length, double *value)
{
    char *end;
    const double parsed = strtod(text, &end);
    if (length == 0 || end != text + length || !isfinite(parsed)) {
        return false;
    }
    *value = parsed;
    return true;
}

bool glint_parse_real(const char *text, double *value)
{
    const size_t length = number_length(text, false);
    return text[length] == '\0' && read_real(text, length, value);
}

bool glint_parse_reals(const char *text, double *values, int count)
{
    for (int i = 0; i < count; i++) {
        const size_t length = number_length(text, false);
        if (text[length] != (i + 1 < count ? ',' : '\0') || !read_real(text, length, &values[i])) {
            return false;
        }
        text += length + 1;
    }
    return true;
}

// ---- Words -------------------------------------------------------------------------------------

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

// The number of letters to insert, delete or replace, and of neighbours to exchange, to get from
// `a` to `b` (Damerau 1964, without edits of exchanged letters).
static size_t edit_distance(const char *a, const char *b)
{
    enum { LONGEST = 63 };
    // Three rows of the table: for the last letter of `a`, the one before, and the one before that.
    size_t rows[3][LONGEST + 1];
    const size_t a_length = strlen(a), b_length = strlen(b);
    if (a_length > LONGEST || b_length > LONGEST) {
        return LONGEST;
    }
    for (size_t i = 0; i <= a_length; i++) {
        size_t *row = rows[i % 3];
        row[0] = i;
        for (size_t j = 1; j <= b_length; j++) {
            if (i == 0) {
                row[j] = j;
                continue;
            }
            const size_t *above = rows[(i - 1) % 3], *above_that = rows[(i + 1) % 3];
            row[j] = least(above[j - 1] + (a[i - 1] != b[j - 1]), least(above[j], row[j - 1]) + 1);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                row[j] = least(row[j], above_that[j - 2] + 1);
            }
        }
    }
    return rows[a_length % 3][b_length];
}

size_t glint_word_distance(const char *text, const char *word)
{
    const size_t length = strlen(text);
    const bool is_beginning = length >= 2 && strncmp(word, text, length) == 0;
    const size_t distance = is_beginning ? 1 : edit_distance(text, word);
    // Two edits make another word of three letters.
    const bool is_near = is_beginning || distance <= length / 3;
    return is_near && distance < GLINT_WORD_IS_FAR ? distance : GLINT_WORD_IS_FAR;
}

const char *glint_nearest_word(const char *text, const char *const *words)
{
    const char *nearest = NULL;
    size_t best = GLINT_WORD_IS_FAR;
    for (; *words != NULL; words++) {
        const size_t distance = glint_word_distance(text, *words);
        if (distance < best) {
            best = distance;
            nearest = *words;
        }
    }
    return nearest;
}

// ---- Options -----------------------------------------------------------------------------------

static bool is_in_range(const glint_option *option, double value)
{
    return value >= option->minimum && value <= option->maximum;
}

static glint_status parse_int(const glint_option *option, const char *text, int *destination,
                              glint_error *error)
{
    long long value;
    if (option->zero != NULL && strcmp(text, option->zero) == 0) {
        *destination = 0;
        return GLINT_OK;
    }
    if (glint_parse_int(text, &value) && is_in_range(option, (double)value)) {
        *destination = (int)value;
        return GLINT_OK;
    }
    char or_zero[32] = "";
    if (option->zero != NULL) {
        snprintf(or_zero, sizeof or_zero, ", or %s,", option->zero);
    }
    return glint_fail(error, GLINT_USAGE, "--%s %s: a whole number from %g to %g%s is expected",
                      option->name, text, option->minimum, option->maximum, or_zero);
}

static glint_status parse_real(const glint_option *option, const char *text, double *destination,
                               glint_error *error)
{
    double value;
    if (glint_parse_real(text, &value) && is_in_range(option, value)) {
        *destination = value;
        return GLINT_OK;
    }
    return glint_fail(error, GLINT_USAGE, "--%s %s: a number from %g to %g is expected",
                      option->name, text, option->minimum, option->maximum);
}

static glint_status parse_size(const glint_option *option, const char *text, int size[2],
                               glint_error *error)
{
    long long sides[2];
    char first[16];
    const size_t length = strcspn(text, "x");
    snprintf(first, sizeof first, "%.*s", (int)length, text);
    if (length >= sizeof first || text[length] != 'x' || !glint_parse_int(first, &sides[0]) ||
        !glint_parse_int(text + length + 1, &sides[1])) {
        return glint_fail(error, GLINT_USAGE,
                          "--%s %s: a width and a height are expected, as in 1920x1080",
                          option->name, text);
    }
    if (!is_in_range(option, (double)sides[0]) || !is_in_range(option, (double)sides[1])) {
        return glint_fail(error, GLINT_USAGE,
                          "--%s %s: width and height must be from %.0f to %.0f pixels",
                          option->name, text, option->minimum, option->maximum);
    }
    size[0] = (int)sides[0];
    size[1] = (int)sides[1];
    return GLINT_OK;
}

// Lists the choices as "auto|1|8|16", in at most `capacity` bytes.
static void list_choices(const glint_option *option, char *list, size_t capacity)
{
    const char *zero = option->zero != NULL ? option->zero : "";
    size_t length = (size_t)snprintf(list, capacity, "%s", zero);
    for (const char *const *word = option->choices; *word != NULL && length < capacity; word++) {
        length += (size_t)snprintf(list + length, capacity - length, "%s%s", length > 0 ? "|" : "",
                                   *word);
    }
}

static glint_status parse_choice(const glint_option *option, const char *text, int *destination,
                                 glint_error *error)
{
    if (option->zero != NULL && strcmp(text, option->zero) == 0) {
        *destination = 0;
        return GLINT_OK;
    }
    for (int i = 0; option->choices[i] != NULL; i++) {
        if (strcmp(text, option->choices[i]) == 0) {
            *destination = option->kind == GLINT_OPTION_ONE_OF ? atoi(text) : i;
            return GLINT_OK;
        }
    }
    char list[256];
    list_choices(option, list, sizeof list);
    return glint_fail(error, GLINT_USAGE, "--%s %s: one of %s is expected", option->name, text,
                      list);
}

static glint_status parse_text(const glint_option *option, const char *text,
                               const char **destination, glint_error *error)
{
    if (text[0] == '\0') {
        return glint_fail(error, GLINT_USAGE, "--%s: an empty %s makes no sense", option->name,
                          option->argument);
    }
    *destination = text;
    return GLINT_OK;
}

glint_status glint_option_parse(const glint_option *option, const char *text, void *destination,
                                glint_error *error)
{
    switch (option->kind) {
    case GLINT_OPTION_TEXT:
        return parse_text(option, text, destination, error);
    case GLINT_OPTION_INT:
        return parse_int(option, text, destination, error);
    case GLINT_OPTION_REAL:
        return parse_real(option, text, destination, error);
    case GLINT_OPTION_SIZE:
        return parse_size(option, text, destination, error);
    case GLINT_OPTION_CHOICE:
    case GLINT_OPTION_ONE_OF:
        return parse_choice(option, text, destination, error);
    case GLINT_OPTION_CUSTOM:
        return option->parse(option, text, destination, error);
    case GLINT_OPTION_LAST:
    case GLINT_OPTION_HEADING:
    case GLINT_OPTION_SETTINGS:
    case GLINT_OPTION_FLAG:
        break;
    }
    return glint_fail(error, GLINT_USAGE, "--%s takes no value", option->name);
}
