// Quotes the words of a command line, so that a shell reads them back unchanged.
#ifndef GLINT_CLI_COMMON_SHELL_WORD_H
#define GLINT_CLI_COMMON_SHELL_WORD_H

#include "cli/common/options.h"

#include <stdio.h>

// Writes the word, quoted if necessary.
void glint_put_shell_word(const char *word, FILE *out);

// The command line "glint NAME WORD …" that has these arguments. malloc'd; NULL without memory.
char *glint_command_line(const glint_arguments *arguments);

#endif
