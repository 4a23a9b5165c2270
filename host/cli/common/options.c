// Parses a command line by a command's table, over getopt_long. The help is in options_help.c.
#include "cli/common/options.h"

#include <errno.h>
#include <getopt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define OPTIONS_MAX 64
#define FIRST_VALUE 1000 // getopt's value of the table's first row; clear of all letters

bool glint_parse_int(const char *text, long long *value)
{
    char *end = NULL;
    errno = 0;
    long long parsed = strtoll(text, &end, 10);
    if (end == text || *end != '\0' || errno != 0) {
        return false;
    }
    *value = parsed;
    return true;
}

bool glint_parse_real(const char *text, double *value)
{
    char *end = NULL;
    double parsed = strtod(text, &end);
    if (end == text || *end != '\0' || !isfinite(parsed)) {
        return false;
    }
    *value = parsed;
    return true;
}

bool glint_parse_reals(const char *text, double *values, int count)
{
    for (int i = 0; i < count; i++) {
        int length = 0;
        if (sscanf(text, "%lf%n", &values[i], &length) != 1 || !isfinite(values[i]) ||
            text[length] != (i + 1 < count ? ',' : '\0')) {
            return false;
        }
        text += length + 1;
    }
    return true;
}

static glint_status parse_int(const glint_option *option, const char *text, void *destination,
                              glint_error *error)
{
    long long value;
    if (!glint_parse_int(text, &value) || !((double)value >= option->minimum) ||
        !((double)value <= option->maximum)) {
        return glint_fail(error, GLINT_USAGE, "--%s %s: a whole number from %g to %g is expected",
                          option->name, text, option->minimum, option->maximum);
    }
    *(int *)destination = (int)value;
    return GLINT_OK;
}

static glint_status parse_real(const glint_option *option, const char *text, void *destination,
                               glint_error *error)
{
    double value;
    if (!glint_parse_real(text, &value) || !(value >= option->minimum) ||
        !(value <= option->maximum)) {
        return glint_fail(error, GLINT_USAGE, "--%s %s: a number from %g to %g is expected",
                          option->name, text, option->minimum, option->maximum);
    }
    *(double *)destination = value;
    return GLINT_OK;
}

static glint_status parse_size(const glint_option *option, const char *text, void *destination,
                               glint_error *error)
{
    int *size = destination;
    const char *cross = strchr(text, 'x');
    char first[16];
    size_t length = cross != NULL ? (size_t)(cross - text) : sizeof first;
    long long width = 0;
    long long height = 0;
    bool well_formed = length < sizeof first;
    if (well_formed) {
        memcpy(first, text, length);
        first[length] = '\0';
        well_formed = glint_parse_int(first, &width) && glint_parse_int(cross + 1, &height);
    }
    if (!well_formed) {
        return glint_fail(error, GLINT_USAGE,
                          "--%s %s: a width and a height are expected, as in 1920x1080",
                          option->name, text);
    }
    long long low = (long long)option->minimum;
    long long high = (long long)option->maximum;
    if (width < low || width > high || height < low || height > high) {
        return glint_fail(error, GLINT_USAGE,
                          "--%s %s: width and height must be from %lld to %lld pixels",
                          option->name, text, low, high);
    }
    size[0] = (int)width;
    size[1] = (int)height;
    return GLINT_OK;
}

static glint_status parse_choice(const glint_option *option, const char *text, void *destination,
                                 glint_error *error)
{
    int index = 0;
    size_t length = strlen(text);
    for (const char *word = option->choices; word != NULL; index++) {
        const char *end = strchr(word, '|');
        size_t word_length = end != NULL ? (size_t)(end - word) : strlen(word);
        if (word_length == length && memcmp(word, text, length) == 0) {
            *(int *)destination = index;
            return GLINT_OK;
        }
        word = end != NULL ? end + 1 : NULL;
    }
    return glint_fail(error, GLINT_USAGE, "--%s %s: one of %s is expected", option->name, text,
                      option->choices);
}

static glint_status parse_value(const glint_option *option, const char *text, void *request,
                                glint_error *error)
{
    void *destination = (char *)request + option->offset;
    switch (option->kind) {
    case GLINT_OPTION_FLAG:
        *(bool *)destination = true;
        return GLINT_OK;
    case GLINT_OPTION_TEXT:
        if (text[0] == '\0') {
            return glint_fail(error, GLINT_USAGE, "--%s: an empty %s makes no sense", option->name,
                              option->argument);
        }
        *(const char **)destination = text;
        return GLINT_OK;
    case GLINT_OPTION_INT:
        return parse_int(option, text, destination, error);
    case GLINT_OPTION_REAL:
        return parse_real(option, text, destination, error);
    case GLINT_OPTION_SIZE:
        return parse_size(option, text, destination, error);
    case GLINT_OPTION_CHOICE:
        return parse_choice(option, text, destination, error);
    case GLINT_OPTION_CUSTOM:
        return option->parse(option, text, destination, error);
    case GLINT_OPTION_HEADING:
        break;
    }
    return glint_fail(error, GLINT_USAGE, "--%s: not an option", option->name);
}

// The command's tables in getopt's terms.
typedef struct getopt_tables {
    const glint_option *rows[OPTIONS_MAX + 1]; // of getopt's value FIRST_VALUE + i
    struct option longs[OPTIONS_MAX + 2];
    const char *words[OPTIONS_MAX + 2]; // the long names, for suggestions
    char shorts[2 * OPTIONS_MAX + 4];
} getopt_tables;

static void make_tables(const glint_command *command, getopt_tables *tables)
{
    int count = 0;
    size_t letters = 0;
    // The leading ':' makes getopt tell a missing value from an unknown option.
    tables->shorts[letters++] = ':';
    tables->shorts[letters++] = 'h';
    for (const glint_option *const *group = command->groups; *group != NULL; group++) {
        for (const glint_option *option = *group; option->help != NULL; option++) {
            if (option->kind == GLINT_OPTION_HEADING || count == OPTIONS_MAX) {
                continue;
            }
            bool has_value = option->kind != GLINT_OPTION_FLAG;
            tables->longs[count] =
                (struct option){option->name, has_value ? required_argument : no_argument, NULL,
                                FIRST_VALUE + count};
            tables->words[count] = option->name;
            tables->rows[count++] = option;
            if (option->letter != 0) {
                tables->shorts[letters++] = option->letter;
                if (has_value) {
                    tables->shorts[letters++] = ':';
                }
            }
        }
    }
    tables->longs[count] = (struct option){"help", no_argument, NULL, 'h'};
    tables->words[count] = "help";
}

static const glint_option *find_row(const getopt_tables *tables, int value)
{
    if (value >= FIRST_VALUE) {
        return tables->rows[value - FIRST_VALUE];
    }
    for (int i = 0; tables->rows[i] != NULL; i++) {
        if (tables->rows[i]->letter == value) {
            return tables->rows[i];
        }
    }
    return NULL;
}

static size_t name_length(const char *word)
{
    return strcspn(word, "=");
}

// What getopt refused: a letter, or (letter 0) `word`, the argument as it was written.
static glint_status fail_unknown(const glint_command *command, const getopt_tables *tables,
                                 const char *word, int letter, glint_error *error)
{
    if (letter != 0) {
        return glint_fail(error, GLINT_USAGE, "unknown option -%c (glint %s --help lists them)",
                          letter, command->name);
    }
    char name[64];
    size_t length = name_length(word + 2);
    if (length >= sizeof name) {
        length = sizeof name - 1;
    }
    memcpy(name, word + 2, length);
    name[length] = '\0';
    const char *nearest = glint_nearest_word(name, tables->words);
    if (nearest != NULL) {
        return glint_fail(error, GLINT_USAGE, "unknown option --%s (did you mean --%s?)", name,
                          nearest);
    }
    return glint_fail(error, GLINT_USAGE, "unknown option --%s (glint %s --help lists them)", name,
                      command->name);
}

// getopt also takes the beginning of a name for the name.
static bool is_abbreviated(const glint_option *option, char *const *argv, int next)
{
    // A value of its own argument stands between the name and argv[next].
    bool own_value = optarg != NULL && optarg == argv[next - 1];
    const char *word = argv[next - (own_value ? 2 : 1)];
    return strncmp(word, "--", 2) == 0 && (strlen(option->name) != name_length(word + 2));
}

static glint_status parse_one(const glint_command *command, const getopt_tables *tables, int value,
                              char *const *argv, void *request, glint_error *error)
{
    const char *word = argv[optind - 1];
    if (value == ':') {
        const glint_option *option = find_row(tables, optopt);
        return glint_fail(error, GLINT_USAGE, "--%s: %s is expected after it", option->name,
                          option->argument);
    }
    if (value == '?') {
        const glint_option *option = optopt >= FIRST_VALUE ? find_row(tables, optopt) : NULL;
        if (option != NULL) {
            return glint_fail(error, GLINT_USAGE, "--%s takes no value", option->name);
        }
        return fail_unknown(command, tables, word, optopt, error);
    }
    const glint_option *option = find_row(tables, value);
    if (value >= FIRST_VALUE && is_abbreviated(option, argv, optind)) {
        bool own_value = optarg != NULL && optarg == word;
        return fail_unknown(command, tables, argv[optind - (own_value ? 2 : 1)], 0, error);
    }
    return parse_value(option, optarg, request, error);
}

static glint_status check_positionals(const glint_command *command,
                                      const glint_arguments *arguments, glint_error *error)
{
    const char *second = command->second_positional;
    int count = arguments->positional_count;
    int named = (command->positional != NULL) + (second != NULL);
    int most = command->takes_any_number ? count : named;
    if (count > most) {
        return glint_fail(error, GLINT_USAGE, "unexpected argument '%s' (usage: glint %s %s)",
                          arguments->positionals[most], command->name, command->synopsis);
    }
    // The first that is not there, or is empty.
    int at = 0;
    while (at < count && arguments->positionals[at][0] != '\0') {
        at++;
    }
    if (at < most) {
        const char *missing = at > 0 && second != NULL ? second : command->positional;
        return glint_fail(error, GLINT_USAGE, "%s is missing (usage: glint %s %s)", missing,
                          command->name, command->synopsis);
    }
    return GLINT_OK;
}

glint_status glint_options_parse(const glint_command *command, int argc, char **argv, void *request,
                                 glint_arguments *arguments, glint_error *error)
{
    *arguments = (glint_arguments){.words = argv, .word_count = argc};
    getopt_tables tables = {0};
    make_tables(command, &tables);
    opterr = 0;
    optind = 0; // begins anew, whatever was parsed before
    int value;
    while ((value = getopt_long(argc, argv, tables.shorts, tables.longs, NULL)) != -1) {
        if (value == 'h') {
            arguments->help = true;
            return GLINT_OK;
        }
        glint_status status = parse_one(command, &tables, value, argv, request, error);
        if (status != GLINT_OK) {
            return status;
        }
    }
    arguments->positionals = argv + optind;
    arguments->positional_count = argc - optind;
    return check_positionals(command, arguments, error);
}
