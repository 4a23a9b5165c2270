// What `glint selftest --json` writes; docs/selftest.md lists its members.
#ifndef GLINT_REPORT_SELFTEST_SELFTEST_JSON_H
#define GLINT_REPORT_SELFTEST_SELFTEST_JSON_H

#include "report/json.h"
#include "selftest/selftest.h"

// Changes whenever a reader of the last one would misread a file.
#define GLINT_SELFTEST_SCHEMA 1

// A run: its results in their order, all borrowed.
typedef struct glint_selftest_run_report {
    const glint_capabilities *device;
    const char *date;    // UTC, ISO 8601
    const char *machine; // "Linux 6.1.0 x86_64"
    uint64_t rays;       // of each case that counts leaks
    uint32_t seed;       // of the draws
    const glint_selftest_result *results;
    size_t count;
} glint_selftest_run_report;

// A new reference.
json_t *glint_selftest_json(const glint_selftest_run_report *run);

#endif
