// Runs work in a child process. The end of the process frees its memory and unloads the drivers
// that it loaded. If the child crashes, the caller goes on.
#ifndef GLINT_BASE_CHILD_H
#define GLINT_BASE_CHILD_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct glint_child {
    // Runs in the child, on a copy of the caller's memory. On GLINT_OK, *text is a malloc'd text.
    // Then the child ends without exit handlers and without flushing stdio.
    glint_status (*work)(void *context, char **text, glint_error *error);
    void *context;
    // The caller asks this ten times a second. Once it is true, the caller abandons the child. A
    // child that is still running a second later gets SIGKILL. NULL: never stops.
    bool (*stop_requested)(void);
    bool is_expendable; // the child leaves nothing behind: a stop sends SIGKILL at once
} glint_child;

// Forks, waits, and returns the status, the error with its details, and the text. Threads do not
// survive a fork. So the work must not use a library whose threads run in the caller. An example is
// an OpenCL driver that the caller has loaded. Errors besides the work's own: GLINT_INTERRUPTED
// after a stop; GLINT_DEVICE_FAILED if the fork fails or the child ends without an answer.
glint_status glint_child_run(const glint_child *child, char **text, glint_error *error);

// What a child said.
typedef struct glint_child_answer {
    glint_status status;
    char *text; // malloc'd; the caller frees it. NULL on failure
    glint_error error;
} glint_child_answer;

// Runs `count` children, at most `at_once` together, and fills answers[count]. One thread forks
// them all: another one that allocated at that moment might leave a lock that nobody opens in the
// child. `stop_requested` must be NULL, and children must not ask whether they are abandoned.
void glint_children_run(const glint_child *children, size_t count, int at_once,
                        glint_child_answer *answers);

// In a child: true if the caller has stopped or died, so that nobody waits for the answer. Work
// that must clean up asks now and then. A signal would not do: a terminal sends signals to the
// child too, and the child could not tell two signals apart. False if this process is not a child.
bool glint_child_is_abandoned(void);

#ifdef __cplusplus
}
#endif

#endif
