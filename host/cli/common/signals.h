// Signals that stop the program: promptly, and with nothing half-written.
#ifndef GLINT_CLI_COMMON_SIGNALS_H
#define GLINT_CLI_COMMON_SIGNALS_H

#include <stdbool.h>

// SIGINT and SIGTERM. To be called first, while there is no other thread: it blocks both signals in
// all threads but one of its own. Until work is cooperative a signal removes the temporaries of
// output files and ends the process at once, with 130 or 143. While it is, the first signal is
// remembered only: whoever works sees glint_stop_requested, cleans up and returns
// GLINT_INTERRUPTED; two seconds later, or on a second signal, the process ends all the same.
void glint_signals_install(void);
void glint_signals_cooperate(bool cooperative);
bool glint_stop_requested(void);

// 130 or 143 by the signal that came; 130 where none did.
int glint_stop_status(void);

#endif
