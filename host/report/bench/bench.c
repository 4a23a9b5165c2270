// Measures one scene on one device. See bench.h.
//
// The steps, in this order:
//   1. compile times, in children, before this process loads a driver
//   2. the renderer and the first frame
//   3. the check of the first frame's picture
//   4. warm-up, until three frames in a row agree or one second is over
//   5. the measured frames
// Every later frame is compared with the first, bit by bit; the comparison is not timed.
#include "report/bench/bench.h"

#include "base/clock.h"
#include "report/machine.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SHOW_MS 100.0 // least time between two progress messages
#define WARM_UP_MS 1000.0
#define WARM_UP_AGREEMENT 1.05 // allowed ratio of the longest to the shortest of three frames

typedef struct frame_time {
    double kernel, readback; // milliseconds
} frame_time;

// The state of a measurement. Zero is valid.
typedef struct bench_run {
    const glint_bench_inputs *inputs;
    const glint_bench_options *options;
    glint_bench_watcher watcher;
    glint_device *device;
    glint_renderer *renderer;
    glint_image first, again;
    frame_time *times; // of the measured frames
    size_t count, capacity;
    glint_bench_result *result;
} bench_run;

static void show(const bench_run *run, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static void show(const bench_run *run, const char *format, ...)
{
    char text[128];
    if (run->watcher.show == NULL) {
        return;
    }
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    run->watcher.show(run->watcher.context, text);
}

// Callback for glint_progress: shows nothing, but lets the user stop a frame.
static bool step(void *context, uint64_t done, uint64_t total)
{
    (void)done;
    (void)total;
    const glint_bench_watcher *watcher = context;
    return watcher->stop_requested == NULL || !watcher->stop_requested();
}

glint_progress glint_bench_progress(glint_bench_watcher *watcher)
{
    return (glint_progress){step, watcher};
}

static glint_status create_renderer(bench_run *run, glint_error *error)
{
    const glint_bench_inputs *in = run->inputs;
    glint_bench_result *result = run->result;
    TRY(glint_device_open(in->device, &run->device, error));
    const glint_renderer_inputs inputs = {
        .device = run->device,
        .scene = in->scene,
        .environment = in->environment,
        .settings = in->settings,
        .kernel_dir = in->kernel_dir,
    };
    TRY(glint_renderer_create(&inputs, &run->renderer, error));
    result->device = *glint_device_capabilities(run->device);
    result->bvh = *glint_renderer_bvh(run->renderer);
    result->bytes = glint_renderer_device_bytes(run->renderer);
    return GLINT_OK;
}

static glint_status render_first(bench_run *run, glint_error *error)
{
    glint_bench_result *result = run->result;
    const glint_progress progress = glint_bench_progress(&run->watcher);
    glint_status status =
        glint_renderer_frame(&(glint_frame_request){run->renderer, run->inputs->camera, &progress,
                                                    &run->first, &result->report},
                             error);
    result->plan = *glint_renderer_plan(run->renderer); // after it has been adapted to the camera
    result->phases = *glint_renderer_phases(run->renderer);
    result->first_frame_ms = result->report.kernel_ms + result->report.readback_ms;
    result->peak_resident_bytes = glint_peak_resident_bytes();
    return status;
}

static glint_status check(bench_run *run, glint_error *error)
{
    glint_bench_check *check = &run->result->check;
    check->nonfinite_pixels = run->result->report.nonfinite_pixels;
    if (check->nonfinite_pixels > 0) {
        check->outcome = GLINT_CHECK_FAILED;
        snprintf(check->reason, sizeof check->reason, "%llu pixels are not finite",
                 (unsigned long long)check->nonfinite_pixels);
        return GLINT_OK;
    }
    if (run->options->no_check) {
        check->outcome = GLINT_CHECK_LEFT_OUT;
        return GLINT_OK;
    }
    if (!run->result->device.has_double) {
        check->outcome = GLINT_CHECK_NO_DOUBLE;
        return GLINT_OK;
    }
    const glint_progress progress = glint_bench_progress(&run->watcher);
    const glint_bench_judge judge = {run->inputs, run->device, &progress};
    return glint_bench_check_picture(&judge, &run->first, check, error);
}

// Renders one more frame and compares it with the first.
static glint_status repeat(bench_run *run, glint_frame_report *report, glint_error *error)
{
    glint_image *image = &run->again;
    const glint_progress progress = glint_bench_progress(&run->watcher);
    TRY(glint_renderer_frame(
        &(glint_frame_request){run->renderer, run->inputs->camera, &progress, image, report},
        error));
    size_t bytes = (size_t)image->width * (size_t)image->height * (size_t)image->channels *
                   sizeof *image->pixels;
    run->result->check.unsteady_frames +=
        memcmp(image->pixels, run->first.pixels, bytes) != 0 ? 1 : 0;
    return GLINT_OK;
}

static glint_status warm_up(bench_run *run, glint_error *error)
{
    double times[3] = {INFINITY, INFINITY, run->result->report.kernel_ms};
    double spent = run->result->first_frame_ms;
    bool agree = false;
    while (!agree && spent < WARM_UP_MS) {
        glint_frame_report report;
        glint_status status = repeat(run, &report, error);
        if (status != GLINT_OK) {
            return status;
        }
        run->result->warm_up_frames++;
        spent += report.kernel_ms + report.readback_ms;
        times[0] = times[1];
        times[1] = times[2];
        times[2] = report.kernel_ms;
        double longest = fmax(times[0], fmax(times[1], times[2]));
        double shortest = fmin(times[0], fmin(times[1], times[2]));
        agree = longest <= WARM_UP_AGREEMENT * shortest;
    }
    return GLINT_OK;
}

static glint_status keep_time(bench_run *run, const glint_frame_report *report, glint_error *error)
{
    if (run->count == run->capacity) {
        size_t capacity = run->capacity > 0 ? 2 * run->capacity : 64;
        frame_time *grown = realloc(run->times, capacity * sizeof *grown);
        if (grown == NULL) {
            return glint_fail_memory(error, "measured times");
        }
        run->times = grown;
        run->capacity = capacity;
    }
    run->times[run->count++] = (frame_time){report->kernel_ms, report->readback_ms};
    return GLINT_OK;
}

static bool wants_more(const bench_run *run, double elapsed_ms)
{
    if (run->options->rounds > 0) {
        return run->count < (size_t)run->options->rounds;
    }
    return run->count < GLINT_BENCH_LEAST_FRAMES || elapsed_ms < 1e3 * run->options->seconds;
}

static glint_status measure_frames(bench_run *run, glint_error *error)
{
    double begun = glint_now_ms(), shown = -INFINITY;
    while (wants_more(run, glint_now_ms() - begun)) {
        if (glint_now_ms() - shown > SHOW_MS) {
            shown = glint_now_ms();
            show(run, "measuring, frame %zu, %.1f s", run->count + 1, shown - begun);
        }
        glint_frame_report report;
        TRY(repeat(run, &report, error));
        TRY(keep_time(run, &report, error));
    }
    return GLINT_OK;
}

static glint_status summarize(bench_run *run, glint_error *error)
{
    glint_bench_result *result = run->result;
    double *values = malloc((run->count + 1) * sizeof *values);
    if (values == NULL) {
        return glint_fail_memory(error, "measured times");
    }
    for (size_t i = 0; i < run->count; i++) {
        values[i] = run->times[i].kernel;
    }
    result->kernel = glint_summarize(values, run->count);
    for (size_t i = 0; i < run->count; i++) {
        values[i] = run->times[i].readback;
    }
    result->readback = glint_summarize(values, run->count);
    for (size_t i = 0; i < run->count; i++) {
        values[i] = run->times[i].kernel + run->times[i].readback;
    }
    result->frame = glint_summarize(values, run->count);
    free(values);
    return GLINT_OK;
}

// Fails the check if any frame differs from the first. Equal inputs must give equal bits, so a
// difference means that the device made a mistake.
static void judge_steadiness(bench_run *run)
{
    glint_bench_result *result = run->result;
    glint_bench_check *check = &result->check;
    if (check->unsteady_frames > 0) {
        check->outcome = GLINT_CHECK_FAILED;
        snprintf(check->reason, sizeof check->reason,
                 "%llu of %zu frames are not the same as the first, bit by bit",
                 (unsigned long long)check->unsteady_frames,
                 (size_t)result->warm_up_frames + run->count);
        result->warm_up_frames = 0;
        result->kernel = result->readback = result->frame = (glint_summary){0};
    }
}

static glint_status measure(bench_run *run, glint_error *error)
{
    show(run, "compiling the kernels, cold and warm");
    TRY(glint_bench_compile_time(run->inputs, run->watcher.stop_requested, &run->result->compile,
                                 error));
    show(run, "building the tree and the kernels");
    TRY(create_renderer(run, error));
    show(run, "rendering the first frame");
    TRY(render_first(run, error));
    show(run, "checking the picture");
    TRY(check(run, error));
    if (run->result->check.outcome == GLINT_CHECK_FAILED) {
        return GLINT_OK;
    }
    show(run, "warming up");
    TRY(warm_up(run, error));
    TRY(measure_frames(run, error));
    TRY(summarize(run, error));
    judge_steadiness(run);
    return GLINT_OK;
}

glint_status glint_bench_measure(const glint_bench_inputs *inputs,
                                 const glint_bench_options *options,
                                 const glint_bench_watcher *watcher, glint_bench_result *result,
                                 glint_error *error)
{
    *result = (glint_bench_result){0};
    bench_run run = {.inputs = inputs, .options = options, .watcher = *watcher, .result = result};
    glint_status status = measure(&run, error);
    free(run.times);
    glint_image_free(&run.first);
    glint_image_free(&run.again);
    glint_renderer_free(run.renderer);
    glint_device_close(run.device);
    return status;
}
