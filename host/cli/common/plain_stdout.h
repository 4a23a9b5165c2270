// Standard output that cannot drive a terminal, whatever names are printed.
#ifndef GLINT_CLI_COMMON_PLAIN_STDOUT_H
#define GLINT_CLI_COMMON_PLAIN_STDOUT_H

#include "base/status.h"

// From here on `stdout` replaces by '?' all that is not plain (base/plain_text.h), but for
// newlines. Where there is no memory for that, it stays as it is.
void glint_plain_stdout_begin(void);

// Writes what is left. Errors: GLINT_OUTPUT_FAILED where something that was printed was not
// written; a reader that has seen enough (EPIPE) is none.
glint_status glint_plain_stdout_end(glint_error *error);

#endif
