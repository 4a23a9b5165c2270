// Runs the self-test: hard cases that go through the kernels on a device. Closed forms judge them,
// or the oracle, which shares no code with the kernels. No files are needed.
#ifndef GLINT_SELFTEST_SELFTEST_H
#define GLINT_SELFTEST_SELFTEST_H

#include "base/status.h"
#include "device/device.h"
#include "render/plan.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define GLINT_SELFTEST_MEASURES 16      // of a case, at most
#define GLINT_SELFTEST_FEATURE_SETS 128 // of a case that are kept, at most
#define GLINT_SELFTEST_RAYS 262144      // default of the cases that count leaks
#define GLINT_SELFTEST_QUICK_RAYS 16384 // the same in a quick run
#define GLINT_SELFTEST_RAYS_MAX 1000000000000.0

// A measure of a case. It holds if measured ≤ bound, so NaN fails.
typedef struct glint_measure {
    const char *what; // static text: "rays that pass between triangles"
    // Static text. "u" is the largest relative rounding error of the precision, 2⁻²⁴ or 2⁻⁵³. ""
    // for counts and shares.
    const char *unit;
    double measured, bound;
    uint64_t judged; // number of judged values, rays or pixels
    bool in_double;  // units in the last place are of double, not of float
    // `measured` is events over `judged`; else it is a count of events, or the largest error.
    bool is_share;
    // The worst one: its name, the expected and the measured value. "" if there was no error.
    char worst[320];
} glint_measure;

typedef enum glint_verdict {
    GLINT_PASSED,
    GLINT_FAILED,
    GLINT_SKIPPED, // the device lacks something that the case needs
    GLINT_BROKEN,  // the driver failed: a kernel did not compile or run
} glint_verdict;

typedef struct glint_selftest_result {
    const char *name; // of the case
    int width;        // lanes of a packet
    glint_precision precision;
    glint_measure measures[GLINT_SELFTEST_MEASURES];
    int measure_count;
    glint_verdict verdict;
    // The failure is known and does not count. The caller sets it.
    bool expected;
    char reason[GLINT_MESSAGE_CAPACITY]; // why it was skipped, or the driver's message
    double ms;                           // wall-clock time, with the compilation of kernels
    // The features of the judged frames' plans: bit 1 << glint_feature. Each set once.
    uint64_t feature_sets[GLINT_SELFTEST_FEATURE_SETS];
    int feature_set_count;
} glint_selftest_result;

// Zero, except for the device, means the defaults.
typedef struct glint_selftest_options {
    glint_device *device;   // borrowed
    const char *kernel_dir; // NULL: the embedded kernels
    int width;              // lanes: 1, 8 or 16; 0: the plan's choice for the device
    glint_precision precision;
    uint64_t rays; // for each case that counts leaks; 0: GLINT_SELFTEST_RAYS
    uint32_t seed; // each seed draws other numbers
    glint_kernel_choice kernels;
} glint_selftest_options;

// The name of a case ("rays_at_shared_edges") and a line on what it does and expects. Both are NULL
// past the last case. Static text.
const char *glint_selftest_name(size_t index);
const char *glint_selftest_summary(size_t index);

// True if a quick run includes the case; false past the last.
bool glint_selftest_is_quick(size_t index);

// Runs one case; `index` must have a name. If the driver fails, the verdict is GLINT_BROKEN, and
// error->details may hold a build log. Errors: GLINT_BAD_INPUT for kernel_dir.
glint_status glint_selftest_run(size_t index, const glint_selftest_options *options,
                                glint_selftest_result *result, glint_error *error);

// Whether the measure holds.
bool glint_measure_holds(const glint_measure *measure);

// The measure that fails by most; NULL if all hold.
const glint_measure *glint_selftest_worst(const glint_selftest_result *result);

// "passed", "failed", "skipped", "broken".
const char *glint_verdict_name(glint_verdict verdict);

#endif
