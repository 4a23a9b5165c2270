// Stops the program on SIGINT and SIGTERM without half-written files. See signals.h.
//
// One thread waits for the two signals, so no code runs in a signal handler. All other threads
// block them, even in libraries and child processes: a thread inherits the mask of its creator, and
// main installs this first.
#include "cli/common/signals.h"

#include "base/status.h"
#include "image/output_file.h"

#include <errno.h>
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <stdatomic.h>
#include <stddef.h>
#include <time.h>
#include <unistd.h>

#define PATIENCE 2 // seconds that cooperative work has to react to a signal

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

static void *wait_for_signal(void *started)
{
    sem_post(started);
    const sigset_t stopping = stopping_signals();
    const struct timespec patience = {.tv_sec = PATIENCE};
    int first = SIGINT;
    sigwait(&stopping, &first);
    if (atomic_load(&work_is_cooperative)) {
        atomic_store(&received_signal, first);
        // End the process on a second signal or after the time limit, if the work does not react.
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
    // Reset the handlers even if the parent ignores the signals. Shells do so for background jobs
    // of a script, but a signal sent to glint by name is meant.
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    pthread_sigmask(SIG_BLOCK, &stopping, NULL);
    // Wait for its start: what it allocates then would stay locked in a child that is forked
    // meanwhile. glibc unlocks it, AddressSanitizer does not.
    pthread_t waiting;
    static sem_t started;
    sem_init(&started, 0, 0);
    if (pthread_create(&waiting, NULL, wait_for_signal, &started) == 0) {
        pthread_detach(waiting);
        while (sem_wait(&started) != 0 && errno == EINTR) {
        }
    } else { // fallback: a signal ends the process, and the next run removes its temporaries
        pthread_sigmask(SIG_UNBLOCK, &stopping, NULL);
    }
    // Ignore signals about a closed pipe or a full file: the result of write() reports these.
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
