// The frames of `glint render`, one or many: which are next, where they go, what came of them.
#ifndef GLINT_CLI_RENDER_RUN_H
#define GLINT_CLI_RENDER_RUN_H

#include "bound/error_bound.h"
#include "cli/common/progress.h"
#include "cli/render/ahead.h"
#include "cli/render/light.h"
#include "cli/render/request.h"
#include "device/device.h"
#include "render/frame.h"
#include "report/frame/fingerprint.h"
#include "report/frame/stats.h"
#include "report/frame/subject.h"

// Milliseconds of several frames.
typedef struct render_spread {
    double sum, least, most;
} render_spread;

// What came of the frames that are through.
typedef struct render_totals {
    uint64_t rendered, skipped;
    size_t failed;
    size_t failed_known, failed_capacity;
    int *failed_frames; // owned; in the order in which they failed, as many as found memory
    glint_ray_counts rays;
    render_spread error;               // relative RMSE, where --max-error asks for it
    render_spread choosing;            // milliseconds, likewise
    render_spread build, trace, write; // build: the scene at its time, its tree;
                                       // beside the frame before
    glint_frame_report worst; // the one with the most truncated weight, with the largest of the
                              // other figures that warnings are about
} render_totals;

// Everything a run holds. Zero is valid.
typedef struct render_run {
    const render_request *request;
    glint_progress_display display;
    glint_inputs inputs;
    glint_device *device;
    glint_renderer *renderer;
    glint_fingerprint fingerprint;    // of what all frames share
    glint_fingerprint scene_is;       // of inputs.scene
    glint_fingerprint renderer_shows; // of the renderer's
    glint_fingerprint plate_is;       // of the frame's plate; zero without
    render_light light;
    glint_scene label;         // the scene's path, which outlives scenes of other times
    char *camera_name;         // likewise; owned
    bool stands;               // inputs.scene and inputs.viewpoint are those of `time`
    double time;               // seconds of the animation
    bool is_prepared;          // the renderer, for inputs.scene
    render_ahead ahead;        // the next frame's scene
    glint_error_bound bound;   // --max-error
    glint_error_choice choice; // its last
    double build_ms;           // of the frame that is traced
    const char *tree;          // what came of its tree: "kept", "fitted" or "built"
    glint_frame_cursor cursor;
    uint64_t frames; // of this run's shard
    glint_stats_log *stats;
    bool stats_failed;
    render_totals totals;
    glint_frame_report last;   // of the last frame that was rendered
    double rendering_begun_ms; // since the display began
    size_t warnings_said;
    glint_error failure; // what ended the run before its time; its code is 0 where nothing did
} render_run;

// Loads what the request names. Errors: as loading.
glint_status render_run_load(render_run *run, glint_error *error);

// Opens the device and makes the renderer of the scene as the run's first frame shows it.
glint_status render_run_prepare(render_run *run, glint_error *error);

// Renders the frames, each to its file, and says what is to be said of each. What fails of one
// frame alone does not stop the others of a sequence. Errors: what ended the run.
glint_status render_run_frames(render_run *run, glint_error *error);

// As GLINT_FRAMES_FAILED, with their names, if any frame failed.
glint_status render_run_verdict(const render_run *run, glint_error *error);

glint_subject render_run_subject(const render_run *run);

void render_run_free(render_run *run);

#endif
