// Says what glint has in place of the options that users of other renderers type.
#ifndef GLINT_CLI_COMMON_FOREIGN_OPTIONS_H
#define GLINT_CLI_COMMON_FOREIGN_OPTIONS_H

#include "cli/common/options.h"

#include <stdbool.h>
#include <stddef.h>

// A row of the table.
typedef struct glint_foreign_option {
    const char *names; // without dashes, one space between: "spp sample-count"
    // the name of glint's option. NULL: glint has none
    const char *ours;
    // the value to suggest; NULL: the option's argument. Without `ours`, the whole text
    const char *text;
} glint_foreign_option;

// The table; a row with NULL for `names` ends it. Several rows may have the same name: the first
// one counts whose option the command has.
extern const glint_foreign_option glint_foreign_options[];

// Writes what glint has in place of the option `name`, which the command lacks: "did you mean
// --samples N?" or "glint has no depth of field". Returns false if the table has no such name.
bool glint_foreign_option_explain(const glint_command *command, const char *name, char *text,
                                  size_t capacity);

#endif
