// Failures of the self-test that are known: a driver's, say, until it is mended.
#ifndef GLINT_CLI_SELFTEST_EXPECTATIONS_H
#define GLINT_CLI_SELFTEST_EXPECTATIONS_H

#include "selftest/selftest.h"

// Zero is valid: none are known.
typedef struct selftest_expectations {
    const char *path; // of the file, borrowed
    struct selftest_expectation *list;
    size_t count;
} selftest_expectations;

// Reads a file of lines: a case and, where it fails there alone, a precision, a width or both
// ("slivers float 16"). What follows a # is a comment. Errors: GLINT_BAD_INPUT, with the line.
glint_status selftest_expectations_read(const char *path, selftest_expectations *expectations,
                                        glint_error *error);
void selftest_expectations_free(selftest_expectations *expectations);

// The number of the line that expects this case to fail, 0: none does.
int selftest_expectation_of(const selftest_expectations *expectations,
                            const glint_selftest_result *result);

#endif
