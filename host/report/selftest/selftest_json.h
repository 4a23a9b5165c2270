// Writes the JSON of glint selftest --json; docs/selftest.md lists its members.
#ifndef GLINT_REPORT_SELFTEST_SELFTEST_JSON_H
#define GLINT_REPORT_SELFTEST_SELFTEST_JSON_H

#include "report/json.h"
#include "selftest/selftest.h"

// Changes when a reader of the previous schema would misread a file.
#define GLINT_SELFTEST_SCHEMA 1

// A run with its results in order, all borrowed.
typedef struct glint_selftest_run_report {
    const glint_capabilities *device;
    const char *date;    // UTC, ISO 8601
    const char *machine; // "Linux 6.1.0 x86_64"
    uint64_t rays;       // rays per case that counts leaks
    uint32_t seed;       // seed of the random numbers
    const glint_selftest_result *results;
    size_t count;
} glint_selftest_run_report;

// The run as JSON, a new reference.
json_t *glint_selftest_json(const glint_selftest_run_report *run);

#endif
