// SIGINT and SIGTERM: stop promptly, leave nothing half-written. See signals.h.
//
// One thread waits for the two signals. All others block them, those of libraries and of child
// processes too: a thread inherits what its creator blocks, and main installs this first. So
// nothing here runs in a signal handler.
#include "cli/common/signals.h"

#include "base/status.h"
#include "image/output_file.h"

#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stddef.h>
#include <time.h>
#include <unistd.h>

#define PATIENCE 2 // seconds that cooperative work has to heed a signal

static atomic_int received_signal;
static atomic_bool work_is_cooperative;

static sigset_t stopping_signals(void)
{
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    sigaddset(&set, SIGTERM);
    return set;
}

static void *wait_for_signal(void *unused)
{
    (void)unused;
    const sigset_t stopping = stopping_signals();
    const struct timespec patience = {.tv_sec = PATIENCE};
    int first = SIGINT;
    sigwait(&stopping, &first);
    if (atomic_load(&work_is_cooperative)) {
        atomic_store(&received_signal, first);
        // A second signal, or the end of patience, ends what does not heed the first.
        while (sigtimedwait(&stopping, NULL, &patience) < 0 && errno == EINTR) {
        }
    }
    glint_output_file_discard_all();
    _exit(128 + first);
}

void glint_signals_install(void)
{
    const sigset_t stopping = stopping_signals();
    struct sigaction action = {.sa_handler = SIG_DFL};
    sigemptyset(&action.sa_mask);
    // Also where the parent had them ignored: a shell does that to the background jobs of a script,
    // and a stop that is asked for by name is meant.
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    pthread_sigmask(SIG_BLOCK, &stopping, NULL);
    pthread_t waiting;
    if (pthread_create(&waiting, NULL, wait_for_signal, NULL) == 0) {
        pthread_detach(waiting);
    } else { // a signal then ends the process; the next run removes its temporaries
        pthread_sigmask(SIG_UNBLOCK, &stopping, NULL);
    }
    // A reader that leaves and a file that grows past the limit are seen in the result of writing.
    action.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &action, NULL);
    sigaction(SIGXFSZ, &action, NULL);
}

void glint_signals_cooperate(bool cooperative)
{
    atomic_store(&work_is_cooperative, cooperative);
}

bool glint_stop_requested(void)
{
    return atomic_load(&received_signal) != 0;
}

int glint_stop_status(void)
{
    const int received = atomic_load(&received_signal);
    return received != 0 ? 128 + received : GLINT_INTERRUPTED;
}
