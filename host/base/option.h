// What an option is, and how its value is read from a text. The command line (cli/common/options.h)
// and the table of settings (render/settings_table.h) are made of options.
#ifndef GLINT_BASE_OPTION_H
#define GLINT_BASE_OPTION_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct glint_option glint_option;

// Reads `text` into `destination`; on failure GLINT_USAGE with a message that begins with the
// option's name.
typedef glint_status glint_option_parser(const glint_option *option, const char *text,
                                         void *destination, glint_error *error);

typedef enum glint_option_kind {
    GLINT_OPTION_LAST,     // no option: the end of a table
    GLINT_OPTION_HEADING,  // no option: the title of the rows that follow
    GLINT_OPTION_SETTINGS, // no option: stands for a group of the table of settings
    GLINT_OPTION_FLAG,   // no argument; sets a bool, or calls `parse` with NULL where there is one
    GLINT_OPTION_TEXT,   // const char *, borrowed from argv; an empty text is refused
    GLINT_OPTION_INT,    // int within [minimum, maximum]
    GLINT_OPTION_REAL,   // double within [minimum, maximum], finite
    GLINT_OPTION_SIZE,   // int[2], "1920x1080", each within [minimum, maximum]
    GLINT_OPTION_CHOICE, // int or an enum, the index of the word within `choices`
    GLINT_OPTION_ONE_OF, // int, one of the numbers in `choices`
    GLINT_OPTION_CUSTOM, // whatever `parse` makes of it
} glint_option_kind;

// One row of a command's table. An option that is given twice takes its last value, so that a
// script can append to a line of defaults.
struct glint_option {
    glint_option_kind kind;
    char letter;          // the short form, 0: none
    const char *name;     // the long form without its dashes
    const char *argument; // what the help calls the value: "FILE"; NULL for flags
    const char *help;     // a sentence or two, any length: the help wraps it
    const char *fallback; // the default, for the help; NULL: none worth saying
    size_t offset;        // of the destination within the command's request
    double minimum, maximum;
    const char *zero;           // INT, ONE_OF: the word that stands for 0; NULL: none does
    const char *const *choices; // words, NULL at the end: GLINT_CHOICES("float", "double")
    glint_option_parser *parse;
    int group;           // SETTINGS: a glint_settings_group
    unsigned instead_of; // roles of settings (settings_table.h) that the option decides about: the
                         // help names these
};

#define GLINT_CHOICES(...) ((const char *const[]){__VA_ARGS__, NULL})
#define GLINT_OPTION_END                                                                           \
    {                                                                                              \
        GLINT_OPTION_LAST                                                                          \
    }

// Reads the value of an option that has one. Errors: GLINT_USAGE.
glint_status glint_option_parse(const glint_option *option, const char *text, void *destination,
                                glint_error *error);

// Whole text as a number: decimal digits with a sign, a point and an exponent, which are optional.
// False for anything else, spaces and "0x10" among it, and for what is not finite.
bool glint_parse_int(const char *text, long long *value);
bool glint_parse_real(const char *text, double *value);

// Writes values[count] from as many numbers with commas between. False, and values are of no use,
// if the text is anything else.
bool glint_parse_reals(const char *text, double *values, int count);

// How many letters `text` is off from `word`; GLINT_WORD_IS_FAR where it was hardly meant. The
// beginning of a word is near, as most wrong names are abbreviations.
#define GLINT_WORD_IS_FAR 3
size_t glint_word_distance(const char *text, const char *word);

// The word of `words` (NULL at the end) that `text` was probably meant to be, or NULL.
const char *glint_nearest_word(const char *text, const char *const *words);

#endif
