// Measures one scene on one device: the time of every phase, the rays per second, and whether the
// picture is right. Without a right picture the times mean nothing.
#ifndef GLINT_REPORT_BENCH_BENCH_H
#define GLINT_REPORT_BENCH_BENCH_H

#include "accel/bvh.h"
#include "base/statistics.h"
#include "base/status.h"
#include "device/capabilities.h"
#include "environment/environment.h"
#include "image/metrics.h"
#include "render/frame.h"
#include "render/plan.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stdint.h>

#define GLINT_BENCH_DEFAULT_SECONDS 5.0
#define GLINT_BENCH_LEAST_FRAMES 5 // minimum number of measured frames, however slow they are

// The subject of a measurement. All borrowed.
typedef struct glint_bench_inputs {
    const char *device; // a selector, see glint_device_open
    const glint_scene *scene;
    const glint_environment *environment;
    const glint_camera *camera;
    const glint_settings *settings;
    const char *kernel_dir; // NULL: the embedded kernels
} glint_bench_inputs;

// How long to measure.
typedef struct glint_bench_options {
    double seconds; // duration of the measured frames
    int rounds;     // number of frames; 0: `seconds` decides
    bool no_check;  // true: do not render the reference
} glint_bench_options;

// Receives short descriptions of the current step and decides whether to stop. The text is valid
// during the call only. Both functions may be NULL.
typedef struct glint_bench_watcher {
    void (*show)(void *context, const char *doing);
    void *context;
    bool (*stop_requested)(void);
} glint_bench_watcher;

// The progress callback of a frame: asks the watcher whether to stop. Borrows the watcher.
glint_progress glint_bench_progress(glint_bench_watcher *watcher);

typedef enum glint_check_outcome {
    GLINT_CHECK_PASSED,
    GLINT_CHECK_FAILED,    // the picture is wrong; nothing is measured
    GLINT_CHECK_LEFT_OUT,  // the caller asked for no check
    GLINT_CHECK_NO_DOUBLE, // the device has no double precision
} glint_check_outcome;

// The result of comparing the first frame with the reference.
typedef struct glint_bench_check {
    glint_check_outcome outcome;
    char reason[200];          // of a failure; else ""
    bool has_reference;        // false: the next four members are zero
    glint_metrics error;       // of the first frame
    glint_metrics judged;      // error of the well-conditioned pixels only; it decides the outcome
    double ill_conditioned;    // share of ill-conditioned pixels
    double most_differing;     // allowed share of visibly different pixels among the judged ones
    uint64_t nonfinite_pixels; // of the first frame
    uint64_t unsteady_frames;  // later frames that differ from the first in any bit
} glint_bench_check;

// Milliseconds to build the kernels, including the first launch, in a child process.
typedef struct glint_compile_time {
    double cold; // no driver's cache holds the kernels
    double warm; // the same build again, in another child
} glint_compile_time;

// The figures of a scene. Milliseconds are wall-clock. Plain data.
typedef struct glint_bench_result {
    glint_capabilities device;
    glint_plan plan;
    glint_bvh_report bvh;
    // of creating the renderer; the time to build the kernels depends on the driver's cache
    glint_phases phases;
    glint_compile_time compile;
    double first_frame_ms;        // launches and read-back
    glint_frame_report report;    // of the first frame; all frames have equal counts
    glint_device_bytes bytes;     // memory on the device
    uint64_t peak_resident_bytes; // of this process, after the first frame
    glint_bench_check check;
    // The following members are zero if the check failed.
    int warm_up_frames;
    glint_summary kernel, readback, frame; // frame: kernel and readback together
} glint_bench_result;

// Measures a scene. A wrong picture is an outcome of the check, not an error. The process must not
// have loaded an OpenCL driver yet, because children measure the compile times (base/child.h).
// Errors: as rendering; GLINT_INTERRUPTED; GLINT_OUTPUT_FAILED if no temporary folder can be made.
glint_status glint_bench_measure(const glint_bench_inputs *inputs,
                                 const glint_bench_options *options,
                                 const glint_bench_watcher *watcher, glint_bench_result *result,
                                 glint_error *error);

// The parts of the measurement, each in its own file.

// Compiles the kernels twice, each time in a child. The drivers' caches lie in a temporary folder,
// which is removed before the function returns.
glint_status glint_bench_compile_time(const glint_bench_inputs *inputs,
                                      bool (*stop_requested)(void), glint_compile_time *result,
                                      glint_error *error);

// The inputs of the check; all borrowed.
typedef struct glint_bench_judge {
    const glint_bench_inputs *inputs;
    glint_device *device;
    const glint_progress *progress;
} glint_bench_judge;

// Renders the reference in double precision with the embedded kernels and judges `image` against
// it. judge->progress may be NULL.
glint_status glint_bench_check_picture(const glint_bench_judge *judge, const glint_image *image,
                                       glint_bench_check *check, glint_error *error);

#endif
