// Describes an option, and reads its value from a text. The command line (cli/common/options.h) and
// the table of settings (render/settings_table.h) consist of options.
#ifndef GLINT_BASE_OPTION_H
#define GLINT_BASE_OPTION_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct glint_option glint_option;

// Reads `text` into `destination`. On failure returns GLINT_USAGE, with a message that begins with
// the option's name.
typedef glint_status glint_option_parser(const glint_option *option, const char *text,
                                         void *destination, glint_error *error);

typedef enum glint_option_kind {
    GLINT_OPTION_LAST,     // no option: end of a table
    GLINT_OPTION_HEADING,  // no option: title of the rows that follow
    GLINT_OPTION_SETTINGS, // no option: stands for a group of the table of settings
    GLINT_OPTION_FLAG,     // no argument; sets a bool. If `parse` is not NULL, calls it with NULL
                           // instead
    GLINT_OPTION_TEXT,     // const char *, borrowed from argv; an empty text is refused
    GLINT_OPTION_INT,      // int within [minimum, maximum]
    GLINT_OPTION_REAL,     // double within [minimum, maximum], finite
    GLINT_OPTION_SIZE,     // int[2], "1920x1080", each within [minimum, maximum]
    GLINT_OPTION_CHOICE,   // int or an enum, the index of the word within `choices`
    GLINT_OPTION_ONE_OF,   // int, one of the numbers in `choices`
    GLINT_OPTION_CUSTOM,   // `parse` decides
} glint_option_kind;

// One row of a command's table. If an option is given twice, the last value counts, so that a
// script can append to a line of defaults.
struct glint_option {
    glint_option_kind kind;
    char letter;          // short form; 0: none
    const char *name;     // long form without its dashes
    const char *argument; // the value's name in the help: "FILE"; NULL for flags
    const char *help;     // one or two sentences of any length: the help wraps them
    const char *fallback; // default, as the help shows it; NULL: not shown
    size_t offset;        // offset of the destination in the command's request
    double minimum, maximum;
    const char *zero;           // INT, ONE_OF: word that stands for 0; NULL: none
    const char *const *choices; // words, NULL at the end: GLINT_CHOICES("float", "double")
    glint_option_parser *parse;
    int group; // SETTINGS: a glint_settings_group
    // Roles of settings (settings_table.h) that this option decides about. The help names these
    // settings.
    unsigned instead_of;
};

#define GLINT_CHOICES(...) ((const char *const[]){__VA_ARGS__, NULL})
#define GLINT_OPTION_END                                                                           \
    {                                                                                              \
        GLINT_OPTION_LAST                                                                          \
    }

// Reads the value of an option that has one. Errors: GLINT_USAGE.
glint_status glint_option_parse(const glint_option *option, const char *text, void *destination,
                                glint_error *error);

// Read the whole text as a number: decimal digits, with an optional sign, point and exponent (an
// integer has only the sign). False for any other text, such as spaces or "0x10", and for numbers
// that are not finite.
bool glint_parse_int(const char *text, long long *value);
bool glint_parse_real(const char *text, double *value);

// Reads `count` numbers with commas between them into `values`. Returns false for any other text;
// `values` are then undefined.
bool glint_parse_reals(const char *text, double *values, int count);

// The edit distance from `text` to `word`, in letters; GLINT_WORD_IS_FAR if `word` was hardly
// meant: if more than two letters, or more than a third of `text`, are others. The beginning of a
// word counts as near, because most wrong names are abbreviations.
#define GLINT_WORD_IS_FAR 3
size_t glint_word_distance(const char *text, const char *word);

// Returns the word of `words` (NULL at the end) that `text` probably meant, or NULL.
const char *glint_nearest_word(const char *text, const char *const *words);

#endif
