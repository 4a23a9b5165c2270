// The self-test: hard cases that run through the kernels on a device and are judged by closed forms
// or by the oracle, which shares no code with them. No files are needed.
#ifndef GLINT_SELFTEST_SELFTEST_H
#define GLINT_SELFTEST_SELFTEST_H

#include "base/status.h"
#include "device/device.h"
#include "render/plan.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define GLINT_SELFTEST_MEASURES 16      // of a case, at most
#define GLINT_SELFTEST_RAYS 262144      // of the cases that count leaks, if nobody says otherwise
#define GLINT_SELFTEST_QUICK_RAYS 16384 // of a quick run
#define GLINT_SELFTEST_RAYS_MAX 1000000000000.0

// One thing that a case measures. It holds where measured ≤ bound, which NaN is not.
typedef struct glint_measure {
    const char *what; // static text: "rays that pass between triangles"
    const char *unit; // static text; "u" is the largest relative rounding error of the precision,
                      // 2⁻²⁴ or 2⁻⁵³; "" for counts and shares
    double measured, bound;
    uint64_t judged; // values, rays or pixels
    bool in_double;  // units in the last place are those of double, else of float
    bool is_share;   // events over `judged`; else a count of events, or the largest error
    char worst[320]; // the worst one: which, what was expected, what was got; "" where none erred
} glint_measure;

typedef enum glint_verdict {
    GLINT_PASSED,
    GLINT_FAILED,
    GLINT_SKIPPED, // the device cannot do what the case needs
    GLINT_BROKEN,  // the driver gave up: a kernel did not compile or run
} glint_verdict;

typedef struct glint_selftest_result {
    const char *name; // of the case
    int width;        // lanes of a packet
    glint_precision precision;
    glint_measure measures[GLINT_SELFTEST_MEASURES];
    int measure_count;
    glint_verdict verdict;
    bool expected; // that it failed or broke is known, and counts as none; set by who runs it
    char reason[GLINT_MESSAGE_CAPACITY]; // why it was skipped, or what the driver said
    double ms;                           // wall-clock time, kernels' compilation included
} glint_selftest_result;

// All-zero but the device means the defaults.
typedef struct glint_selftest_options {
    glint_device *device;   // borrowed
    const char *kernel_dir; // NULL: the embedded kernels
    int width;              // lanes: 1, 8 or 16; 0: the plan's choice for the device
    glint_precision precision;
    uint64_t rays; // of each case that counts leaks; 0: GLINT_SELFTEST_RAYS
    uint32_t seed; // other draws for each seed; 0 is as good as any
} glint_selftest_options;

// The cases in their order: name ("rays_at_shared_edges") and in a line what is done and what must
// come out; both NULL past the last. Static text.
const char *glint_selftest_name(size_t index);
const char *glint_selftest_summary(size_t index);

// Whether the case is one of the few that a quick run has; false past the last.
bool glint_selftest_is_quick(size_t index);

// Runs one case; `index` is one of those that have a name. What the driver fails at is the case's
// verdict (GLINT_BROKEN), and error->details may then hold a build log. Errors: GLINT_BAD_INPUT for
// kernel_dir.
glint_status glint_selftest_run(size_t index, const glint_selftest_options *options,
                                glint_selftest_result *result, glint_error *error);

// Whether the measure holds.
bool glint_measure_holds(const glint_measure *measure);

// The measure that fails by most; NULL where all hold.
const glint_measure *glint_selftest_worst(const glint_selftest_result *result);

// "passed", "failed", "skipped", "broken".
const char *glint_verdict_name(glint_verdict verdict);

#endif
