// The command line: one parser and one help text, both made from a table that each command
// declares.
#ifndef GLINT_CLI_COMMON_OPTIONS_H
#define GLINT_CLI_COMMON_OPTIONS_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef struct glint_option glint_option;

// Reads `text` into `destination`; on failure GLINT_USAGE with a message that begins with the
// option's name.
typedef glint_status glint_option_parser(const glint_option *option, const char *text,
                                         void *destination, glint_error *error);

typedef enum glint_option_kind {
    GLINT_OPTION_HEADING, // no option: the title of the group that follows
    GLINT_OPTION_FLAG,    // no argument; sets a bool
    GLINT_OPTION_TEXT,    // const char *, borrowed from argv; an empty text is refused
    GLINT_OPTION_INT,     // int within [minimum, maximum]
    GLINT_OPTION_REAL,    // double within [minimum, maximum], finite
    GLINT_OPTION_SIZE,    // int[2], "1920x1080", each within [minimum, maximum]
    GLINT_OPTION_CHOICE,  // int, the index of the word within `choices`
    GLINT_OPTION_CUSTOM,  // whatever `parse` makes of it
} glint_option_kind;

// One row of a command's table. An option that is given twice takes its last value, so that a
// script can append to a line of defaults. A table ends with a row whose `help` is NULL.
struct glint_option {
    glint_option_kind kind;
    char letter;          // the short form, 0: none
    const char *name;     // the long form without its dashes
    const char *argument; // what the help calls the value: "FILE"; NULL for flags
    const char *help;     // a sentence or two, any length: the help wraps it
    const char *fallback; // the default, for the help; NULL: none worth saying
    size_t offset;        // of the destination within the command's request
    double minimum, maximum;
    const char *choices; // "float|double"
    glint_option_parser *parse;
};

#define GLINT_OPTION_END                                                                           \
    {                                                                                              \
        .help = NULL                                                                               \
    }

// What the parser found besides the options.
typedef struct glint_arguments {
    bool help;                // --help was given: nothing else was looked at
    char *const *positionals; // borrowed from argv, in the order of the command line
    int positional_count;
    char *const *words; // all of the command line, from the command's name on; borrowed likewise.
    int word_count;     // Options stand before the positional arguments
} glint_arguments;

typedef struct glint_command {
    const char *name;                  // "render"
    const char *summary;               // for the list of commands, under 60 columns
    const char *synopsis;              // what follows the name: "SCENE -o OUT [options]"
    const char *description;           // paragraphs, wrapped by the help; '\n' separates them
    const char *examples;              // lines, printed as they are; NULL: none
    const glint_option *const *groups; // tables, NULL at the end
    const char *positional; // what a positional argument is called: "SCENE"; NULL: none is taken
    const char *second_positional; // what a second one is called, if two are taken; else NULL
    bool takes_any_number;         // of `positional`, none too; else exactly those that are named
    size_t request_size;           // of the struct that the tables' offsets count in
    void (*set_defaults)(void *request); // on a zeroed request; NULL: zero is the default
    glint_status (*run)(void *request, const glint_arguments *arguments, glint_error *error);
} glint_command;

// Parses argv[1 … argc − 1] (argv[0] is the command's name) into `request`, which holds the
// defaults already. Options may stand before and after the positional arguments; "--" ends them.
// Names are not abbreviated: what is short today is ambiguous with tomorrow's options. Errors:
// GLINT_USAGE.
glint_status glint_options_parse(const glint_command *command, int argc, char **argv, void *request,
                                 glint_arguments *arguments, glint_error *error);

// Prints the command's help, at most `columns` wide.
void glint_options_help(const glint_command *command, int columns, FILE *out);

// The word of `words` (NULL at the end) that `text` was probably meant to be, or NULL.
const char *glint_nearest_word(const char *text, const char *const *words);

// Whole text as a number; false when it is none, is not finite or something follows it.
bool glint_parse_int(const char *text, long long *value);
bool glint_parse_real(const char *text, double *value);

// Writes values[count] from as many numbers with commas between. False, and values are of no use,
// if the text is anything else or a number not finite.
bool glint_parse_reals(const char *text, double *values, int count);

#endif
