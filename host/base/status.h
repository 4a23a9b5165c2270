// The error idiom: a function that can fail returns a glint_status and fills the caller's
// glint_error. The library never prints and never exits; main.c turns the status into the exit
// status of the process.
#ifndef GLINT_BASE_STATUS_H
#define GLINT_BASE_STATUS_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// The values are the exit statuses of the program.
typedef enum glint_status {
    GLINT_OK = 0,
    GLINT_USAGE = 2,         // the command line makes no sense
    GLINT_BAD_INPUT = 3,     // a scene, environment or image that cannot be used
    GLINT_DEVICE_FAILED = 4, // no device, or the driver reported an error; no cluster, or it
                             // refused a job
    GLINT_OUTPUT_FAILED = 5, // an output file could not be written
    GLINT_FRAMES_FAILED = 6, // some frames of a sequence failed
    GLINT_MISMATCH = 7,      // a comparison or a self-test found an error
    GLINT_OUT_OF_MEMORY = 8, // the host has too little memory
    GLINT_DEVICE_LACKS = 9,  // the device has too little memory in all, or no double precision:
                             // trying again never helps
    GLINT_INTERRUPTED = 130, // stopped on request (signal), nothing half-written
} glint_status;

// True if the machine failed, not the input: the next piece of work would fail too.
static inline bool glint_status_is_of_machine(glint_status status)
{
    return status == GLINT_DEVICE_FAILED || status == GLINT_OUT_OF_MEMORY ||
           status == GLINT_DEVICE_LACKS;
}

#define GLINT_MESSAGE_CAPACITY 1024

// The caller owns it. Zero is valid ("no error"). `message` is one line without a trailing newline,
// of the form "FILE: what is wrong (what to do)". `details` is NULL or a malloc'd text of several
// lines, such as a kernel build log; glint_error_free frees it.
typedef struct glint_error {
    glint_status code;
    char message[GLINT_MESSAGE_CAPACITY];
    char *details;
} glint_error;

// Records the failure and returns `code`, so that a caller can write `return glint_fail(…)`.
// `error` may be NULL. Characters that are not plain (plain_text.h) become '?'. So the message
// stays one line, even if a file or its name holds line breaks.
glint_status glint_fail(glint_error *error, glint_status code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// Returns from the calling function with the status of `call` if that status is not GLINT_OK.
#define TRY(call)                                                                                  \
    do {                                                                                           \
        const glint_status status_of_call = (call);                                                \
        if (status_of_call != GLINT_OK) {                                                          \
            return status_of_call;                                                                 \
        }                                                                                          \
    } while (0)

// Sets the variable `status` to the status of `call`; goes to `label` if that status is not
// GLINT_OK. For functions that must release something.
#define TRY_OR(label, status, call)                                                                \
    do {                                                                                           \
        (status) = (call);                                                                         \
        if ((status) != GLINT_OK) {                                                                \
            goto label;                                                                            \
        }                                                                                          \
    } while (0)

// Returns GLINT_OUT_OF_MEMORY: an allocation for `what` failed.
static inline glint_status glint_fail_memory(glint_error *error, const char *what)
{
    (void)glint_fail(error, GLINT_OUT_OF_MEMORY, "not enough memory for %s", what);
    return GLINT_OUT_OF_MEMORY; // a constant, so that static analysis sees a failure
}

void glint_error_free(glint_error *error);

// Appends an entry to a list for a message: 0 "main", 1, 2 "top" and so on. Appends "..." for
// entries that do not fit. `name` may be NULL. A list starts as an empty text.
void glint_list_add(char *list, size_t capacity, long long index, const char *name);

// Warnings, which do not stop the work. Zero is valid and empty. The list owns the texts. Adding a
// text twice has no effect, so that each warning appears once. `lost` counts the texts that found
// no memory.
typedef struct glint_warnings {
    char **texts;
    size_t count;
    size_t capacity;
    size_t lost;
} glint_warnings;

// `warnings` may be NULL. The text has the form "FILE: what was found, what is done about it".
void glint_warn(glint_warnings *warnings, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

// Appends `more` to warning `number` if there is memory.
void glint_warning_extend(glint_warnings *warnings, size_t number, const char *more);

void glint_warnings_free(glint_warnings *warnings);

#ifdef __cplusplus
}
#endif

#endif
