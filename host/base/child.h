// Work in a process of its own: what it takes of memory, loads of drivers and leaves in them ends
// with it, and if it crashes the caller goes on.
#ifndef GLINT_BASE_CHILD_H
#define GLINT_BASE_CHILD_H

#include "base/status.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct glint_child {
    // Runs in the child, on a copy of the caller's memory, and gives a malloc'd text on GLINT_OK.
    // The child ends with it, without exit handlers and without flushing what stdio holds.
    glint_status (*work)(void *context, char **text, glint_error *error);
    void *context;
    // Asked in the caller ten times a second. Once true the child is abandoned, and gets SIGKILL if
    // that does not end it within a second. NULL: never.
    bool (*stop_requested)(void);
    bool is_expendable; // leaves nothing behind: a stop is SIGKILL at once
} glint_child;

// Forks, waits, and brings back the status, the error with its details, and the text. Threads do
// not survive a fork: the work must use nothing that has threads waiting in the caller, such as an
// OpenCL driver that was loaded before. Errors besides the work's own: GLINT_INTERRUPTED after a
// stop, GLINT_DEVICE_FAILED where there is no process to be had or the child ended without an
// answer.
glint_status glint_child_run(const glint_child *child, char **text, glint_error *error);

// In a child: whether nobody waits for its answer any more, as the caller stopped or died. Work
// that has something to clean up asks now and then. Not by a signal, as a terminal sends those to
// the child, too, and two are one too many to tell apart. False where this process is no child.
bool glint_child_is_abandoned(void);

#ifdef __cplusplus
}
#endif

#endif
