// What the commands say on stderr. Nothing else in the program prints there, but for the progress
// display and a signal's end.
#ifndef GLINT_CLI_COMMON_SAY_H
#define GLINT_CLI_COMMON_SAY_H

#include "base/status.h"

// One line on stderr, "glint: …".
void glint_say(const char *format, ...) __attribute__((format(printf, 1, 2)));

// The message, and below it the details in full, such as a kernel build log.
void glint_say_error(const glint_error *error);

// Each warning from the given one on as one line on stderr, "glint: warning: …".
void glint_say_warnings(const glint_warnings *warnings, size_t first);

#endif
