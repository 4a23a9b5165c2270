// The command line: one parser and one help text, both made from a table that each command
// declares.
#ifndef GLINT_CLI_COMMON_OPTIONS_H
#define GLINT_CLI_COMMON_OPTIONS_H

#include "base/option.h"
#include "render/settings_table.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

// What the parser found besides the options.
typedef struct glint_arguments {
    bool help;                // --help was given: nothing else was looked at
    char *const *positionals; // borrowed from argv, in the order of the command line
    int positional_count;
    char **words;   // all of the command line, from the command's name on; borrowed. Options stand
    int word_count; // before the positional arguments
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

// A row that stands for a group of the table of settings, for a request with its glint_settings at
// `member`.
#define GLINT_SETTINGS_ROW(which, member)                                                          \
    {                                                                                              \
        GLINT_OPTION_SETTINGS, .group = (which), .offset = (member)                                \
    }

// Goes through a command's rows, those of settings in their places, and --help as the last one.
typedef struct glint_option_cursor {
    const glint_option *const *table;
    size_t row, setting;
    glint_option made; // the row that is returned, where it stands in no table of the command's
    char fallback[GLINT_SETTING_TEXT];
    bool is_at_end;
} glint_option_cursor;

// The next row, which is good until the next call; NULL at the end.
const glint_option *glint_option_next(glint_option_cursor *cursor);

// Parses arguments->words (word_count of them, the command's name first) into `request`, which
// holds the defaults already, and fills the rest of *arguments. Options may stand before and after
// the positional arguments; "--" ends them. The words are sorted: options first. Names are not
// abbreviated: what is short today is ambiguous with tomorrow's options. Errors: GLINT_USAGE.
glint_status glint_options_parse(const glint_command *command, void *request,
                                 glint_arguments *arguments, glint_error *error);

// Prints the command's help, at most `columns` wide.
void glint_options_help(const glint_command *command, int columns, FILE *out);

#endif
