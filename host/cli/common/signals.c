// SIGINT and SIGTERM: stop promptly, leave nothing half-written. See signals.h.
#include "cli/common/signals.h"

#include "base/status.h"
#include "image/output_file.h"

#include <signal.h>
#include <unistd.h>

static volatile sig_atomic_t received_signal;
static volatile sig_atomic_t work_is_cooperative;

#define PATIENCE 2 // seconds that cooperative work has to heed a signal

static void stop(int signal_number)
{
    // A second signal, or the alarm, ends what does not heed the first.
    if (work_is_cooperative && received_signal == 0) {
        received_signal = signal_number;
        alarm(PATIENCE);
        return;
    }
    glint_output_file_discard_all();
    _exit(128 + (received_signal != 0 ? received_signal : signal_number));
}

void glint_signals_install(void)
{
    struct sigaction action = {.sa_handler = stop, .sa_flags = SA_RESTART};
    sigemptyset(&action.sa_mask);
    // One at a time: the handler is not interrupted by another of the signals.
    sigaddset(&action.sa_mask, SIGINT);
    sigaddset(&action.sa_mask, SIGTERM);
    sigaddset(&action.sa_mask, SIGALRM);
    // Also where the parent had them ignored: a shell does that to the background jobs of a script,
    // and a stop that is asked for by name is meant.
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    sigaction(SIGALRM, &action, NULL);
    // A reader that leaves and a file that grows past the limit are seen in the result of writing.
    struct sigaction ignore = {.sa_handler = SIG_IGN};
    sigemptyset(&ignore.sa_mask);
    sigaction(SIGPIPE, &ignore, NULL);
    sigaction(SIGXFSZ, &ignore, NULL);
}

void glint_signals_cooperate(bool cooperative)
{
    work_is_cooperative = cooperative;
}

bool glint_stop_requested(void)
{
    return received_signal != 0;
}

int glint_stop_status(void)
{
    return received_signal != 0 ? 128 + received_signal : GLINT_INTERRUPTED;
}
