// What the commands share: messages, which main.c alone prints, and signals.
#ifndef GLINT_CLI_CLI_H
#define GLINT_CLI_CLI_H

#include "base/status.h"
#include "cli/options.h"

#include <stdbool.h>

extern const glint_command glint_command_render;
extern const glint_command glint_command_info;
extern const glint_command glint_command_devices;
extern const glint_command glint_command_bench;
extern const glint_command glint_command_compare;
extern const glint_command glint_command_contact;
extern const glint_command glint_command_env;
extern const glint_command glint_command_capture;
extern const glint_command glint_command_relight;
extern const glint_command glint_command_farm;
extern const glint_command glint_command_selftest;

// One line on stderr, "glint: …".
void glint_say(const char *format, ...) __attribute__((format(printf, 1, 2)));

// The message, and below it the details in full, such as a kernel build log.
void glint_say_error(const glint_error *error);

// Each warning from the given one on as one line on stderr, "glint: warning: …".
void glint_say_warnings(const glint_warnings *warnings, size_t first);

// SIGINT and SIGTERM. Until work is cooperative a signal removes the temporaries of output files
// and ends the process at once, with 130 or 143. While it is, the first signal is remembered only:
// whoever works sees glint_stop_requested, cleans up and returns GLINT_INTERRUPTED; two seconds
// later, or on a second signal, the process ends all the same.
void glint_signals_install(void);
void glint_signals_cooperate(bool cooperative);
bool glint_stop_requested(void);

// 130 or 143 by the signal that came; 130 where none did.
int glint_stop_status(void);

#endif
