// Launches the kernels over the tiles of a frame. See launches.h.
#include "render/launches.h"

#include "base/clock.h"
#include "device/driver_cache.h"
#include "device/opencl_error.h"

#include <math.h>
#include <string.h>

// The length of a launch: long enough to keep a device busy, short enough for progress and signals.
#define LAUNCH_MS 100.0
#define LAUNCHES_AT_ONCE 2
// The first launch of the first frame measures the speed.
#define FIRST_LAUNCH_SAMPLES 32768.0
// A band: rows of tiles that are rendered side by side. Data that one tile fetched is then still in
// the caches for its neighbours. A band is one row if more rows would be a long launch by
// themselves.
#define BAND_ROWS 4
#define BAND_SAMPLES 2e6

// If a packet is one ray, the rays of 8 × 8 pixels share a work-group. A wider packet fills a
// work-group by itself.
static size_t local_side(const glint_plan *plan)
{
    return plan->kernel_width == 1 ? 8 : 1;
}

// Size in pixels of the tile that a work-item renders.
static int tile_width(const glint_plan *plan)
{
    return GLINT_PACKET_COLUMNS(plan->kernel_width) * GLINT_TILE_SIDE(plan->tiles);
}

static int tile_height(const glint_plan *plan)
{
    return GLINT_PACKET_ROWS(plan->kernel_width) * GLINT_TILE_SIDE(plan->tiles);
}

static size_t divide_up(size_t value, size_t by)
{
    return (value + by - 1) / by;
}

static size_t round_up(size_t value, size_t multiple)
{
    return divide_up(value, multiple) * multiple;
}

static glint_status set_arguments(const glint_launcher *l, const glint_frame_record *record,
                                  glint_error *error)
{
#define OF_SCENE(type, name) {sizeof(cl_mem), &l->scene.name},
#define OF_OUTPUTS(type, name) {sizeof(cl_mem), &l->outputs.name},
    const glint_argument arguments[] = {
        GLINT_SCENE_ARGUMENTS(OF_SCENE) GLINT_OUTPUT_ARGUMENTS(OF_OUTPUTS){sizeof *record, record}};
#undef OF_SCENE
#undef OF_OUTPUTS
    return glint_arguments_set(l->device, l->kernels->tiles, arguments,
                               sizeof arguments / sizeof *arguments, error);
}

// Starts to render `bands` bands of tiles from record->first_band on.
static glint_status launch(const glint_launcher *l, const glint_frame_record *record, size_t bands,
                           cl_event *done, glint_error *error)
{
    TRY(set_arguments(l, record, error));
    const size_t local[2] = {local_side(l->plan), local_side(l->plan)};
    const size_t width = record->width > 0 ? (size_t)record->width : 1; // width 0: warm-up
    const size_t across = divide_up(width, (size_t)tile_width(l->plan)) * (size_t)record->band;
    const size_t global[2] = {round_up(across, local[0]), round_up(bands, local[1])};
    cl_command_queue queue = l->device->launches;
    cl_int code =
        clEnqueueNDRangeKernel(queue, l->kernels->tiles, 2, NULL, global, local, 0, NULL, done);
    if (code == CL_SUCCESS) {
        code = clFlush(queue);
        if (code != CL_SUCCESS) {
            clReleaseEvent(*done);
        }
    }
    return glint_check_opencl(error, l->device, "running the kernel", code);
}

glint_status glint_launch_wait(const struct glint_device *device, cl_event done, glint_error *error)
{
    const cl_int code = clWaitForEvents(1, &done);
    clReleaseEvent(done);
    return glint_check_opencl(error, device, "running the kernel", code);
}

glint_status glint_launches_warm_up(const glint_launcher *l, glint_error *error)
{
    const glint_frame_record nothing = {.band = 1};
    cl_event done;
    TRY(launch(l, &nothing, 1, &done, error));
    return glint_launch_wait(l->device, done, error);
}

// The number of bands in the next launch: as many as fit into LAUNCH_MS at the speed of the last
// launch. At most four times as many as before, because the next part of the frame may be much
// slower.
static size_t next_step(size_t step, double elapsed_ms, size_t multiple)
{
    double factor = fmin(4, LAUNCH_MS / fmax(elapsed_ms, 1e-3));
    double wanted = fmax(1, (double)step * factor);
    return round_up((size_t)wanted, multiple);
}

// The launches of a frame. Several are queued at once: cores of the device that find no more work
// in one launch begin with the next.
typedef struct launches {
    const glint_launcher *launcher;
    glint_frame_record *record;
    size_t bands, begun, done; // bands of the frame, in launches that began, in launches that ended
    size_t step;               // bands of the next launch
    int under_way;
    struct {
        cl_event end;
        size_t bands;
    } queue[LAUNCHES_AT_ONCE]; // oldest first
} launches;

static glint_status begin_launch(launches *l, glint_error *error)
{
    const size_t left = l->bands - l->begun, bands = l->step < left ? l->step : left;
    l->queue[l->under_way].bands = bands;
    l->record->first_band = (int)l->begun;
    TRY(launch(l->launcher, l->record, bands, &l->queue[l->under_way].end, error));
    l->begun += bands;
    l->under_way++;
    return GLINT_OK;
}

static glint_status end_launch(launches *l, glint_error *error)
{
    cl_event end = l->queue[0].end;
    l->done += l->queue[0].bands;
    l->under_way--;
    memmove(l->queue, l->queue + 1, (size_t)l->under_way * sizeof *l->queue);
    return glint_launch_wait(l->launcher->device, end, error);
}

static glint_status run_all(launches *l, const glint_progress *progress, glint_error *error)
{
    const size_t multiple = local_side(l->launcher->plan);
    double clock = glint_now_ms();
    while (l->done < l->bands) {
        while (l->begun < l->bands && l->under_way < LAUNCHES_AT_ONCE) {
            TRY(begin_launch(l, error));
        }
        const size_t bands = l->queue[0].bands;
        TRY(end_launch(l, error));
        l->step = next_step(bands, glint_lap_ms(&clock), multiple);
        if (progress != NULL && !progress->step(progress->context, l->done, l->bands)) {
            return glint_fail(error, GLINT_INTERRUPTED, "stopped");
        }
    }
    return GLINT_OK;
}

glint_status glint_launches_run(const glint_launcher *launcher, glint_frame_record *record,
                                const glint_progress *progress, double *bands_per_ms,
                                glint_error *error)
{
    const glint_plan *plan = launcher->plan;
    const int height = tile_height(plan);
    const double row_samples =
        (double)record->width * height * record->samples_per_axis * record->samples_per_axis;
    record->band = plan->tiles && BAND_ROWS * row_samples <= BAND_SAMPLES ? BAND_ROWS : 1;
    const double first_step = *bands_per_ms > 0
                                  ? *bands_per_ms * LAUNCH_MS
                                  : FIRST_LAUNCH_SAMPLES / (row_samples * record->band);
    launches l = {
        .launcher = launcher,
        .record = record,
        .bands = divide_up((size_t)record->height, (size_t)height * (size_t)record->band),
        .step = round_up((size_t)fmax(1, first_step), local_side(plan)),
    };
    const double begun = glint_now_ms();
    glint_driver_run_begin();
    const glint_status status = run_all(&l, progress, error);
    while (l.under_way > 0) {
        end_launch(&l, NULL);
    }
    glint_driver_run_end();
    if (status == GLINT_OK) {
        *bands_per_ms = (double)l.bands / fmax(glint_now_ms() - begun, 1e-3);
    }
    return status;
}
