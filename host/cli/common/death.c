// Ends the process with a message when the OpenCL driver crashes it. See death.h.
//
// This is the only signal handler in glint. The process is lost anyway, and the handler calls only
// async-signal-safe functions.
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

// SA_RESETHAND has restored the default action. So a signal that the driver did not cause kills the
// process as usual, for example a signal from another process.
static void on_fatal_signal(int number, siginfo_t *from, void *context)
{
    (void)context;
    const bool is_sent = from->si_code == SI_USER || from->si_code == SI_QUEUE;
    if (!is_sent || from->si_pid == getpid()) {
        end_if_driver_died();
    }
    raise(number);
}

// SIGFPE is missing because PoCL survives it. AddressSanitizer handles the other three itself.
static const int fatal[] = {
    SIGABRT,
#ifndef __SANITIZE_ADDRESS__
    SIGSEGV,
    SIGBUS,
    SIGILL,
#endif
};

// Installs the handlers again before each build: LLVM installs its own handlers on top, and these
// let abort() pass.
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
    atexit(end_if_driver_died); // LLVM calls exit() when the disk is full
    glint_driver_cache_watch(install_handlers);
}
