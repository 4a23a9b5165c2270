// Parses the command line and prints help texts. Both work from a table that each command declares.
#ifndef GLINT_CLI_COMMON_OPTIONS_H
#define GLINT_CLI_COMMON_OPTIONS_H

#include "base/option.h"
#include "render/settings_table.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

// The words of the command line, and the parser's findings besides the options.
typedef struct glint_arguments {
    bool help;                // --help was given; the parser stopped there
    char *const *positionals; // borrowed from argv, in the order of the command line
    int positional_count;
    // all words from the command's name on, options first; borrowed
    char **words;
    int word_count; // number of `words`
} glint_arguments;

// Declares a command to main.c, the parser and the help.
typedef struct glint_command {
    const char *name;     // "render"
    const char *summary;  // for the list of commands, less than 60 columns
    const char *synopsis; // follows the command's name in the usage line: "SCENE -o OUT [options]"
    const char *description;           // the help wraps it; '\n' separates paragraphs
    const char *examples;              // complete lines; NULL: none
    const glint_option *const *groups; // option tables; NULL ends the list
    // the name of the positional argument in messages: "SCENE"; NULL: the command takes none
    const char *positional;
    const char *second_positional; // the name of the second one; NULL: the command takes only one
    bool takes_any_number;         // true: zero or more `positional`; false: exactly the named ones
    size_t request_size;           // size of the struct that the offsets in the tables refer to
    void (*set_defaults)(void *request); // gets a zeroed request; NULL: zero is the default
    glint_status (*run)(void *request, const glint_arguments *arguments, glint_error *error);
} glint_command;

// A row that stands for a whole group of settings; the request has its glint_settings at `member`.
#define GLINT_SETTINGS_ROW(which, member)                                                          \
    {                                                                                              \
        GLINT_OPTION_SETTINGS, .group = (which), .offset = (member)                                \
    }

#define GLINT_HELP_LETTER 'h' // of --help, which every command has

// An iterator over a command's option rows: settings in their places, --help as the last row.
typedef struct glint_option_cursor {
    const glint_option *const *table;
    size_t row, setting;
    glint_option made; // storage for a returned row that is in no table of the command
    char fallback[GLINT_SETTING_TEXT];
    bool is_at_end;
} glint_option_cursor;

// The next row, valid until the next call; NULL at the end.
const glint_option *glint_option_next(glint_option_cursor *cursor);

// Find an option of the command by its name without dashes, or by its letter, which must not be 0.
// *found has no fallback text. False if there is none.
bool glint_options_find(const glint_command *command, const char *name, glint_option *found);
bool glint_options_find_letter(const glint_command *command, char letter, glint_option *found);

// Parses arguments->words (word_count words, the command's name first). Fills `request`, which must
// already hold the defaults, and the rest of *arguments. Options may stand before and after the
// positional arguments; "--" ends them. Reorders the words: options first. Options cannot be
// abbreviated: a short form that is unique today may be ambiguous after the next new option.
// Errors: GLINT_USAGE.
glint_status glint_options_parse(const glint_command *command, void *request,
                                 glint_arguments *arguments, glint_error *error);

// Prints the command's help, at most `columns` wide.
void glint_options_help(const glint_command *command, int columns, FILE *out);

#endif
