// Where the driver takes the process down. See death.h.
//
// This is the one handler of signals in glint: the process is lost, and what it calls is
// async-signal-safe.
#include "cli/common/death.h"

#include "base/status.h"
#include "device/driver_cache.h"

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void end_if_driver_died(void)
{
    if (glint_driver_cache_is_used()) {
        const char *line = glint_driver_cache_epitaph();
        glint_driver_cache_mark();
        (void)!write(STDERR_FILENO, line, strlen(line));
        _exit(GLINT_DEVICE_FAILED);
    }
    const char *line = glint_driver_run_epitaph();
    if (line != NULL) {
        (void)!write(STDERR_FILENO, line, strlen(line));
        _exit(GLINT_DEVICE_FAILED);
    }
}

// Its action is the default again: what is no driver's death, as a signal that another process sent
// is not, dies of the signal.
static void on_fatal_signal(int number, siginfo_t *from, void *context)
{
    (void)context;
    const bool is_sent = from->si_code == SI_USER || from->si_code == SI_QUEUE;
    if (!is_sent || from->si_pid == getpid()) {
        end_if_driver_died();
    }
    raise(number);
}

// Not SIGFPE, which PoCL itself survives. AddressSanitizer has handlers of its own for the others.
static const int fatal[] = {
    SIGABRT,
#ifndef __SANITIZE_ADDRESS__
    SIGSEGV,
    SIGBUS,
    SIGILL,
#endif
};

// Anew for each build: LLVM puts handlers of its own before these, which let abort() pass.
static void install_handlers(void)
{
    struct sigaction action = {.sa_sigaction = on_fatal_signal,
                               .sa_flags = (int)(SA_RESETHAND | SA_SIGINFO)};
    sigemptyset(&action.sa_mask);
    for (size_t i = 0; i < sizeof fatal / sizeof fatal[0]; i++) {
        sigaction(fatal[i], &action, NULL);
    }
}

void glint_death_install(void)
{
    atexit(end_if_driver_died); // LLVM exits where it finds a disk full
    glint_driver_cache_watch(install_handlers);
}
