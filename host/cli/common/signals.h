// Stops the program on SIGINT and SIGTERM: promptly, and without half-written files.
#ifndef GLINT_CLI_COMMON_SIGNALS_H
#define GLINT_CLI_COMMON_SIGNALS_H

#include <stdbool.h>

// Starts the thread that handles SIGINT and SIGTERM. Call it first, while there is no other thread:
// it blocks both signals in every other thread.
//
// By default, a signal removes the temporary output files and ends the process at once, with status
// 130 or 143. Cooperative work gets a chance to clean up: the first signal only sets
// glint_stop_requested. The work then cleans up and returns GLINT_INTERRUPTED. Two seconds later,
// or on a second signal, the process ends anyway.
void glint_signals_install(void);
void glint_signals_cooperate(bool cooperative);
bool glint_stop_requested(void);

// 130 (SIGINT) or 143 (SIGTERM), by the received signal; 130 without a signal.
int glint_stop_status(void);

#endif
