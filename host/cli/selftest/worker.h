// Runs self-test cases in a child process. If the driver aborts, crashes, exits or hangs, only the
// child ends, and the current case counts as broken.
#ifndef GLINT_CLI_SELFTEST_WORKER_H
#define GLINT_CLI_SELFTEST_WORKER_H

#include "base/status.h"
#include "device/capabilities.h"
#include "selftest/selftest.h"

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

#define SELFTEST_WORDS 400 // bytes kept of the driver's last output

// A child process that runs cases. Zero is no worker.
typedef struct selftest_worker {
    const char *device; // as glint_device_open expects it; borrowed
    double limit_s;     // seconds per case; 0: no limit
    pid_t process;      // 0: no process
    // Pipes: cases to the child, results from it, and its stderr.
    int requests, answers, words;
    char said[SELFTEST_WORDS]; // end of the child's stderr
    glint_capabilities capabilities;
} selftest_worker;

// Starts a child that opens the device, and reads its capabilities. The parent must not have loaded
// a driver before. Errors: as glint_device_open; GLINT_DEVICE_FAILED if the driver ended the child.
glint_status selftest_worker_start(selftest_worker *worker, glint_error *error);

// Runs a case like glint_selftest_run; ignores options->device. If the driver ends the child or
// exceeds the time limit, the verdict is GLINT_BROKEN with the driver's last words. The next case
// then starts a new child.
glint_status selftest_worker_run(selftest_worker *worker, size_t index,
                                 const glint_selftest_options *options,
                                 glint_selftest_result *result, glint_error *error);

void selftest_worker_stop(selftest_worker *worker);

#endif
