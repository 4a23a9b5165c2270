// Measuring one scene on one device: how long everything takes, how many rays that is a second, and
// whether the picture is right, without which the rest is worth nothing.
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
#define GLINT_BENCH_LEAST_FRAMES 5 // that are measured, however long they take

// What is measured. All borrowed.
typedef struct glint_bench_inputs {
    const char *device; // a selector, see glint_device_open
    const glint_scene *scene;
    const glint_environment *environment;
    const glint_camera *camera;
    const glint_settings *settings;
    const char *kernel_dir; // NULL: the embedded kernels
} glint_bench_inputs;

typedef struct glint_bench_options {
    double seconds; // that frames are measured for
    int rounds;     // 0: by the time; else so many frames
    bool no_check;  // do not render the reference
} glint_bench_options;

// Whom the measuring tells what it does, in a few words that are valid during the call, and whom it
// asks whether to stop. Both may be NULL.
typedef struct glint_bench_watcher {
    void (*show)(void *context, const char *doing);
    void *context;
    bool (*stop_requested)(void);
} glint_bench_watcher;

// What a frame asks whether to stop; borrows the watcher.
glint_progress glint_bench_progress(glint_bench_watcher *watcher);

typedef enum glint_check_outcome {
    GLINT_CHECK_PASSED,
    GLINT_CHECK_FAILED,    // the picture is wrong; nothing is measured
    GLINT_CHECK_LEFT_OUT,  // on request
    GLINT_CHECK_NO_DOUBLE, // the device has no double precision
} glint_check_outcome;

typedef struct glint_bench_check {
    glint_check_outcome outcome;
    char reason[200];          // of a failure
    bool has_reference;        // else the next four are zero
    glint_metrics error;       // of the first frame
    glint_metrics judged;      // over its well-conditioned pixels alone: what the verdict rests on
    double ill_conditioned;    // share of the other pixels
    double most_differing;     // share of the judged pixels that may differ visibly
    uint64_t nonfinite_pixels; // of the first frame
    uint64_t unsteady_frames;  // frames after it that are not the same bit by bit
} glint_bench_check;

// Milliseconds of building the kernels, with the first launch, in a process of their own.
typedef struct glint_compile_time {
    double cold; // no driver has them in its cache
    double warm; // the same once more, in another process
} glint_compile_time;

// Milliseconds are wall-clock. Plain data.
typedef struct glint_bench_result {
    glint_capabilities device;
    glint_plan plan;
    glint_bvh_report bvh;
    glint_phases phases; // of creation; the kernel build there is as warm as the driver's cache was
    glint_compile_time compile;
    double first_frame_ms;        // launches and read-back
    glint_frame_report report;    // of the first frame; every other one has the same counts
    glint_device_bytes bytes;     // on the device
    uint64_t peak_resident_bytes; // of the process, once the first frame was there
    glint_bench_check check;
    // What follows is zero where the check failed.
    int warm_up_frames;
    glint_summary kernel, readback, frame; // a frame is both
} glint_bench_result;

// Measures. A picture that is wrong is no error here but an outcome of the check. The process must
// not have loaded an OpenCL driver yet: compile times are taken in children (base/child.h). Errors:
// what rendering gives; GLINT_INTERRUPTED; GLINT_OUTPUT_FAILED where there is no folder for
// temporary files.
glint_status glint_bench_measure(const glint_bench_inputs *inputs,
                                 const glint_bench_options *options,
                                 const glint_bench_watcher *watcher, glint_bench_result *result,
                                 glint_error *error);

// The parts of it, each in a file of its own.

// Compiles twice, each time in a child, with the drivers' caches in a temporary folder that is
// removed before it returns.
glint_status glint_bench_compile_time(const glint_bench_inputs *inputs,
                                      bool (*stop_requested)(void), glint_compile_time *result,
                                      glint_error *error);

// What the picture is judged with; all borrowed.
typedef struct glint_bench_judge {
    const glint_bench_inputs *inputs;
    glint_device *device;
    const glint_progress *progress;
} glint_bench_judge;

// Renders the reference on `device`, the same in double precision by the embedded kernels, and
// judges `image`. `progress` may be NULL.
glint_status glint_bench_check_picture(const glint_bench_judge *judge, const glint_image *image,
                                       glint_bench_check *check, glint_error *error);

#endif
