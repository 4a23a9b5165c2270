// Writes the results of a self-test as JUnit XML for continuous integration: a suite for each
// precision and width, a test case for each case.
#ifndef GLINT_REPORT_SELFTEST_JUNIT_H
#define GLINT_REPORT_SELFTEST_JUNIT_H

#include "base/status.h"
#include "report/selftest/selftest_json.h"

// Writes the file, whole or not at all. Errors: GLINT_OUTPUT_FAILED, GLINT_OUT_OF_MEMORY.
glint_status glint_junit_write(const char *path, const glint_selftest_run_report *run,
                               glint_error *error);

#endif
