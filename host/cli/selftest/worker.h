// The self-test's work on a device, in a process of its own: a driver that aborts, crashes, exits
// or hangs takes that process down alone, and the case that met it is broken.
#ifndef GLINT_CLI_SELFTEST_WORKER_H
#define GLINT_CLI_SELFTEST_WORKER_H

#include "base/status.h"
#include "device/capabilities.h"
#include "selftest/selftest.h"

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

#define SELFTEST_WORDS 400 // of what a driver said last

// Zero is no worker.
typedef struct selftest_worker {
    const char *device; // as glint_device_open takes it; borrowed
    double limit_s;     // of a case; 0: none
    pid_t process;      // 0: none runs
    int requests, answers, words;
    char said[SELFTEST_WORDS]; // on stderr, the end of it
    glint_capabilities capabilities;
} selftest_worker;

// Starts a process that opens the device, and reads its capabilities. No driver may have been
// loaded by this process before. Errors: as glint_device_open, and GLINT_DEVICE_FAILED where the
// driver ended the process.
glint_status selftest_worker_start(selftest_worker *worker, glint_error *error);

// As glint_selftest_run; options->device is not read. Where the driver ends the process or is over
// its time, the verdict is GLINT_BROKEN, with its words, and the next case gets a new process.
glint_status selftest_worker_run(selftest_worker *worker, size_t index,
                                 const glint_selftest_options *options,
                                 glint_selftest_result *result, glint_error *error);

void selftest_worker_stop(selftest_worker *worker);

#endif
