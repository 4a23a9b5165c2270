// Filters standard output, so that printed names cannot send control sequences to a terminal.
#ifndef GLINT_CLI_COMMON_PLAIN_STDOUT_H
#define GLINT_CLI_COMMON_PLAIN_STDOUT_H

#include "base/status.h"

// From now on `stdout` replaces everything that is not plain text (base/plain_text.h) by '?',
// except newlines. Without memory for the filter, stdout stays unfiltered.
void glint_plain_stdout_begin(void);

// Flushes stdout. Errors: GLINT_OUTPUT_FAILED if any printed text was not written. A reader that
// closed the pipe (EPIPE) is no error.
glint_status glint_plain_stdout_end(glint_error *error);

#endif
