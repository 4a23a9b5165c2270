// Reads the list of known self-test failures, such as those of a driver that waits for a fix.
#ifndef GLINT_CLI_SELFTEST_EXPECTATIONS_H
#define GLINT_CLI_SELFTEST_EXPECTATIONS_H

#include "selftest/selftest.h"

// A list of known failures. Zero is valid: none are known.
typedef struct selftest_expectations {
    const char *path; // path of the file, borrowed
    struct selftest_expectation *list;
    size_t count;
} selftest_expectations;

// Reads a file of lines. A line names a case, then optionally the precision, the width or both at
// which it fails ("slivers float 16"). '#' begins a comment. Errors: GLINT_BAD_INPUT, with the line
// number.
glint_status selftest_expectations_read(const char *path, selftest_expectations *expectations,
                                        glint_error *error);
void selftest_expectations_free(selftest_expectations *expectations);

// The number of the line that expects this case to fail; 0 if there is none.
int selftest_expectation_of(const selftest_expectations *expectations,
                            const glint_selftest_result *result);

#endif
