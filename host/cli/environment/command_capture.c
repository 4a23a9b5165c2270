// Implements glint capture: renders the environment at a place of a scene to a file.
#include "cli/commands.h"
#include "cli/common/options.h"
#include "cli/common/say.h"
#include "cli/common/signals.h"

#include "base/clock.h"
#include "cli/common/env_output.h"
#include "cli/common/file_names.h"
#include "cli/common/frame_list.h"
#include "cli/common/frame_name.h"
#include "cli/common/inputs.h"
#include "cli/common/progress.h"
#include "cli/common/proxy_option.h"
#include "device/device.h"
#include "render/capture.h"
#include "scene/subset.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define FACE_EDGE 256 // default edge of a face, pixels

// The options of glint capture.
typedef struct capture_request {
    glint_input_request inputs; // first: see inputs.h
    env_output_request output;
    place_request at;
    const char *around;
    const char *frames_text;
    double fps;
    int progress;
    bool is_sequence; // settle sets the members from here on
    glint_frame_list frames;
    glint_frame_name name;
} capture_request;

static const glint_option capture_options[] = {
    {GLINT_OPTION_HEADING, .help = "From where"},
    {GLINT_OPTION_CUSTOM, .name = "at", .argument = "X,Y,Z",
     .help = "The place, in metres of the scene's world.", .offset = offsetof(capture_request, at),
     .parse = place_option_parse},
    {GLINT_OPTION_TEXT, .name = "around", .argument = "NODE",
     .help = "The middle of the bounds of a node, by its name or index, or of several with commas "
             "between; they themselves are taken away.",
     .offset = offsetof(capture_request, around)},
    {GLINT_OPTION_HEADING, .help = "What is written"},
    ENV_OUTPUT_OPTIONS(offsetof(capture_request, output),
                       "latlong, or six files where OUT is for them", "256, of a lat-long map 512"),
    {GLINT_OPTION_CHOICE, .name = "progress", .argument = "KIND",
     .help = "What is shown of the work on stderr: bar, plain lines, json lines or none.",
     .fallback = "a bar on a terminal, else plain lines",
     .offset = offsetof(capture_request, progress), .choices = GLINT_PROGRESS_CHOICES},
    {GLINT_OPTION_HEADING, .help = "Sequences"},
    {GLINT_OPTION_TEXT, .name = "frames", .argument = "LIST",
     .help =
         "Capture at these frames of the scene's animation (1-24, 7, 1-48x2), into OUT with the "
         "frame's number in it: ball.####.exr.",
     .fallback = "the animation's beginning", .offset = offsetof(capture_request, frames_text)},
    {GLINT_OPTION_REAL, .name = "fps", .argument = "RATE",
     .help = "Frames a second of the animation; frame 1 is its beginning.", .fallback = "24",
     .offset = offsetof(capture_request, fps), .minimum = 1e-3, .maximum = 1e5},
    GLINT_OPTION_END,
};

static const glint_option *const groups[] = {
    capture_options, glint_input_options, glint_settings_options, glint_kernel_dir_options, NULL};

// The state of a capture. Zero is valid.
typedef struct capture {
    const capture_request *request;
    glint_progress_display display;
    // once `at` is found, the scene lacks the nodes of --around
    glint_inputs inputs;
    bool stands; // the scene is the one at `time`
    double time; // seconds
    glint_vec3 at;
    glint_device *device;
    glint_renderer *renderer;
} capture;

// ---- The scene ----------------------------------------------------------------------------------

static glint_status find_place(capture *work, glint_error *error)
{
    const capture_request *request = work->request;
    if (request->at.is_given) {
        work->at = (glint_vec3){request->at.at[0], request->at.at[1], request->at.at[2]};
        return GLINT_OK;
    }
    glint_scene *scene = &work->inputs.scene;
    TRY(glint_scene_middle_of_nodes(scene, request->around, &work->at, error));
    return glint_scene_remove_nodes(scene, request->around, error);
}

// Moves an animated scene to `time`, and gives it to the renderer if there is one.
static glint_status set_time(capture *work, double time, glint_error *error)
{
    glint_inputs *inputs = &work->inputs;
    if (work->stands && (!glint_motion_moves_scene(&inputs->motion) || time == work->time)) {
        return GLINT_OK;
    }
    work->stands = false;
    work->time = time;
    if (!glint_motion_moves_scene(&inputs->motion)) {
        work->stands = true;
        return find_place(work, error);
    }
    glint_scene_free(&inputs->scene);
    TRY(glint_scene_at(inputs->source, time, &inputs->scene, NULL, error));
    TRY(glint_inputs_stage(&work->request->inputs, inputs->source, &inputs->scene,
                           &inputs->viewpoint, error));
    TRY(find_place(work, error));
    if (work->renderer != NULL) {
        TRY(glint_renderer_set_scene(work->renderer, &inputs->scene, error));
    }
    work->stands = true;
    return GLINT_OK;
}

// ---- Rendering ----------------------------------------------------------------------------------

static bool step(void *context, uint64_t done, uint64_t total)
{
    glint_progress_step(context, done, total);
    return !glint_stop_requested();
}

static glint_status render(capture *work, const char *path, glint_cube *cube, glint_error *error)
{
    const glint_settings *settings = &work->request->inputs.settings;
    char text[GLINT_MESSAGE_CAPACITY];
    snprintf(text, sizeof text, "rendering six views of %dx%d from (%g, %g, %g) on %s",
             settings->width, settings->height, work->at.x, work->at.y, work->at.z,
             glint_device_capabilities(work->device)->name);
    const double samples = (double)settings->samples_per_axis * settings->samples_per_axis;
    glint_progress_render(&work->display, 0, 6 * samples * settings->width * settings->height,
                          text);
    const glint_progress progress = {step, &work->display};
    glint_frame_report report = {0};
    glint_signals_cooperate(true);
    glint_status status = glint_capture(
        &(glint_capture_request){work->renderer, work->at, &progress, &report}, cube, error);
    glint_signals_cooperate(false);
    glint_progress_clear(&work->display);
    if (report.nonfinite_pixels > 0) {
        glint_say("warning: %s: %llu pixels are not finite", path,
                  (unsigned long long)report.nonfinite_pixels);
    }
    return status;
}

// Finds the first frame whose scene and place are good. Later the bad frames fail alone; if all are
// bad, returns the last error.
static glint_status find_first(capture *work, glint_error *error)
{
    const capture_request *request = work->request;
    glint_frame_cursor cursor = {.list = &request->frames, .shard = {1, 1}};
    glint_status status = GLINT_OK;
    int frame = 1;
    bool is_left = !request->is_sequence || glint_frame_next(&cursor, &frame);
    while (is_left) {
        glint_error_free(error);
        *error = (glint_error){0};
        status = set_time(work, (frame - 1) / request->fps, error);
        is_left = status == GLINT_BAD_INPUT && glint_motion_moves_scene(&work->inputs.motion) &&
                  request->is_sequence && glint_frame_next(&cursor, &frame);
    }
    return status;
}

static glint_status prepare(capture *work, glint_error *error)
{
    const glint_input_request *request = &work->request->inputs;
    TRY(glint_inputs_load(request, &work->display, &work->inputs, error));
    TRY(find_first(work, error));
    TRY(glint_device_open(request->device, &work->device, error));
    glint_progress_phase(&work->display, "prepare", "building the tree and the kernels");
    const glint_renderer_inputs inputs = {.device = work->device,
                                          .scene = &work->inputs.scene,
                                          .environment = &work->inputs.environment,
                                          .settings = &request->settings,
                                          .kernel_dir = request->kernel_dir};
    return glint_renderer_create(&inputs, &work->renderer, error);
}

// ---- The request --------------------------------------------------------------------------------

static glint_status check_request(const capture_request *request, glint_error *error)
{
    if (request->at.is_given == (request->around != NULL)) {
        return glint_fail(error, GLINT_USAGE,
                          request->at.is_given ? "--around: the place is given by --at (give one)"
                                               : "from where? (give --at x,y,z or --around NODE)");
    }
    return GLINT_OK;
}

static glint_status find_frames(capture_request *request, glint_error *error)
{
    request->is_sequence = request->frames_text != NULL;
    if (request->is_sequence) {
        TRY(glint_frame_list_parse(request->frames_text, &request->frames, error));
    }
    if (request->frames.count > 1 && request->name.length == 0) {
        return glint_fail(error, GLINT_USAGE,
                          "%s: %llu frames need a place for their number (as in ball.####.exr)",
                          request->name.path, (unsigned long long)request->frames.count);
    }
    if (request->name.length > 0 && !request->is_sequence) {
        return glint_frame_name_refuse(&request->name, "name frames with --frames 1-24", error);
    }
    return GLINT_OK;
}

static glint_status check_settings(const glint_settings *settings, glint_error *error)
{
    for (size_t i = 0; i < glint_setting_count; i++) {
        const glint_setting *setting = &glint_setting_table[i];
        if (setting->no_capture != NULL &&
            glint_setting_differs(setting, settings, &glint_settings_default)) {
            char name[GLINT_SETTING_TEXT];
            glint_setting_print_name(setting, settings, name);
            return glint_fail(error, GLINT_USAGE, "%s: %s (leave it out)", name,
                              setting->no_capture);
        }
    }
    return GLINT_OK;
}

// Completes the request. The rendered views get the resolution of the output.
static glint_status settle(capture_request *request, const char *path, glint_error *error)
{
    env_output_request *output = &request->output;
    TRY(glint_frame_name_parse(path, &request->name, error));
    if (output->to == GLINT_LAYOUT_UNKNOWN) {
        output->to =
            env_output_is_set(request->name.path) ? GLINT_LAYOUT_FACES : GLINT_LAYOUT_LATLONG;
    }
    if (output->size == 0) {
        output->size = glint_chart_size_for(output->to, FACE_EDGE);
    }
    glint_chart chart;
    TRY(glint_chart_make(output->to, output->size, false, &chart, error));
    const int edge = (int)fmax(1, round(glint_chart_quarter_turn(&chart)));
    request->inputs.settings.width = request->inputs.settings.height = edge;
    TRY(glint_input_request_finish(&request->inputs, error));
    TRY(check_settings(&request->inputs.settings, error));
    return find_frames(request, error);
}

static void say_done(const capture *work, const env_output *output, double ms)
{
    const glint_chart *to = &output->chart;
    if (work->display.mode != GLINT_PROGRESS_NONE && work->display.mode != GLINT_PROGRESS_JSON) {
        glint_say("%s: %s %dx%d, six views from (%g, %g, %g), %.0f ms", output->path,
                  glint_layout_name(to->layout), to->width,
                  output->as_faces ? to->width : to->height, work->at.x, work->at.y, work->at.z,
                  ms);
    }
}

// ---- The run ------------------------------------------------------------------------------------

static glint_status capture_to(capture *work, const char *path, glint_error *error)
{
    const env_output_request *request = &work->request->output;
    const double begun = glint_now_ms();
    env_output output;
    glint_cube cube = {0};
    glint_status status;
    TRY_OR(cleanup, status, env_output_open(request, path, request->to, &output, error));
    TRY_OR(cleanup, status, render(work, path, &cube, error));
    const glint_sampler sampler = glint_sampler_of_cube(&cube);
    TRY_OR(cleanup, status, env_output_write(&output, &sampler, &glint_turn_none, error));
    say_done(work, &output, glint_now_ms() - begun);
cleanup:
    glint_cube_free(&cube);
    return status;
}

// Captures a frame of a sequence.
static glint_status capture_frame(capture *work, int frame, glint_error *error)
{
    char *path = glint_frame_name_make(&work->request->name, frame);
    if (path == NULL) {
        return glint_fail_memory(error, "a file name");
    }
    glint_status status;
    TRY_OR(cleanup, status, set_time(work, (frame - 1) / work->request->fps, error));
    status = capture_to(work, path, error);
cleanup:
    free(path);
    return status;
}

static glint_status capture_frames(capture *work, glint_error *error)
{
    const capture_request *request = work->request;
    glint_frame_cursor cursor = {.list = &request->frames, .shard = {1, 1}};
    unsigned long long failed = 0;
    int frame, first_failed = 0;
    while (glint_frame_next(&cursor, &frame)) {
        const glint_status status = capture_frame(work, frame, error);
        if (glint_status_is_of_machine(status) || status == GLINT_INTERRUPTED) {
            return status;
        }
        if (status != GLINT_OK) { // continue with the next frame
            glint_say("frame %d: %s", frame, error->message);
            glint_error_free(error);
            *error = (glint_error){0};
            first_failed = failed++ == 0 ? frame : first_failed;
        }
    }
    return failed == 0 ? GLINT_OK
                       : glint_fail(error, GLINT_FRAMES_FAILED,
                                    "%s: %llu of %llu frames failed, the first of them %d",
                                    request->name.path, failed,
                                    (unsigned long long)request->frames.count, first_failed);
}

// Checks an output before any work is done. The first output gets a full check. The others are only
// compared with the inputs, which they must not replace.
static glint_status check_output(const capture_request *request, int frame, bool is_first,
                                 glint_error *error)
{
    env_output output;
    char *path = glint_frame_name_make(&request->name, frame);
    if (path == NULL) {
        return glint_fail_memory(error, "a file name");
    }
    glint_status status = GLINT_OK;
    if (glint_same_file(path, request->inputs.scene) ||
        glint_same_file(path, request->inputs.env)) {
        status = glint_fail(error, GLINT_USAGE, "%s: this is an input (name another file)", path);
    } else if (is_first) {
        status = env_output_open(&request->output, path, request->output.to, &output, error);
    }
    free(path);
    return status;
}

static glint_status check_outputs(const capture_request *request, glint_error *error)
{
    glint_frame_cursor cursor = {.list = &request->frames, .shard = {1, 1}};
    if (!request->is_sequence) {
        return check_output(request, 1, true, error);
    }
    int frame;
    for (bool is_first = true; glint_frame_next(&cursor, &frame); is_first = false) {
        TRY(check_output(request, frame, is_first, error));
    }
    return GLINT_OK;
}

static glint_status run(void *context, const glint_arguments *arguments, glint_error *error)
{
    capture_request *request = context;
    const char *path = arguments->positionals[1];
    capture work = {.request = request};
    request->inputs.scene = arguments->positionals[0];
    glint_progress_begin(&work.display, (glint_progress_mode)request->progress);
    glint_status status;
    TRY_OR(cleanup, status, check_request(request, error));
    TRY_OR(cleanup, status, settle(request, path, error));
    TRY_OR(cleanup, status, check_outputs(request, error));
    status = prepare(&work, error);
    glint_progress_clear(&work.display);
    if (status != GLINT_OK) {
        goto cleanup;
    }
    if (request->frames.count > 1 && !glint_motion_moves_scene(&work.inputs.motion)) {
        glint_warn(&work.inputs.warnings, "%s: nothing moves: all %llu frames are the same",
                   request->inputs.scene, (unsigned long long)request->frames.count);
    }
    glint_say_warnings(&work.inputs.warnings, 0);
    status = request->is_sequence ? capture_frames(&work, error)
                                  : capture_to(&work, request->name.path, error);
cleanup:
    glint_renderer_free(work.renderer);
    glint_device_close(work.device);
    glint_inputs_free(&work.inputs);
    glint_frame_list_free(&request->frames);
    glint_frame_name_free(&request->name);
    return status;
}

static void set_defaults(void *request)
{
    glint_input_request_default(&((capture_request *)request)->inputs);
    ((capture_request *)request)->fps = 24;
    // A capture does not look through the camera
    ((capture_request *)request)->inputs.camera_may_wait = true;
}

const glint_command glint_command_capture = {
    .name = "capture",
    .summary = "the environment at a place of a scene",
    .synopsis = "SCENE OUT --at X,Y,Z|--around NODE [options]",
    .description = "Renders six square views of 90 degrees from a place of a scene, and writes "
                   "them as an environment for render --env, in any layout. --around NODE leaves "
                   "the node itself out, so that its surroundings can light it.",
    .examples = "  glint capture room.glb room.exr --at 0,1.6,0 --size 1024 --samples 16\n"
                "  glint capture scenes/gallery.gltf faces/ --around diamond --to faces\n"
                "  glint capture shot.gltf ball.####.exr --around robot --to ball --frames 1-24\n",
    .groups = groups,
    .positional = "SCENE",
    .second_positional = "OUT",
    .request_size = sizeof(capture_request),
    .set_defaults = set_defaults,
    .run = run,
};
