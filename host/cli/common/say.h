// Prints the messages of commands on stderr. Only the progress display and the end by a signal also
// write there.
#ifndef GLINT_CLI_COMMON_SAY_H
#define GLINT_CLI_COMMON_SAY_H

#include "base/status.h"

// Prints one line on stderr, "glint: …".
void glint_say(const char *format, ...) __attribute__((format(printf, 1, 2)));

// Prints the message, then the details in full, such as a kernel build log.
void glint_say_error(const glint_error *error);

// Prints the warnings from index `first` on, one line each: "glint: warning: …".
void glint_say_warnings(const glint_warnings *warnings, size_t first);

#endif
