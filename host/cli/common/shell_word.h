// Words of a command line, as a shell reads them back.
#ifndef GLINT_CLI_COMMON_SHELL_WORD_H
#define GLINT_CLI_COMMON_SHELL_WORD_H

#include "cli/common/options.h"

#include <stdio.h>

// The word, in quotes where it needs them.
void glint_put_shell_word(const char *word, FILE *out);

// "glint NAME WORD …", of the command that was called with these arguments; malloc'd, NULL if
// memory ran out.
char *glint_command_line(const glint_arguments *arguments);

#endif
