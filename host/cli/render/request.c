// Checks and completes the options of glint render. See request.h.
#include "cli/render/request.h"

#include "cli/common/file_names.h"
#include "cli/common/json_output.h"
#include "cli/common/output_folder.h"
#include "cli/common/tone_options.h"
#include "image/output_file.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define CAPTURE_SIZE 512 // default edge of a captured view, pixels

glint_write_options render_write_options(const render_request *request)
{
    // Leave out a tone curve that no file uses, so that it does not change fingerprints.
    const bool is_mapped = request->preview || !glint_image_stays_linear(request->output);
    return (glint_write_options){.exr_float = request->exr_type == 1,
                                 .compression = request->compression,
                                 .exposure = (float)request->exposure,
                                 .tone = is_mapped ? request->tone : GLINT_TONE_NONE};
}

// ---- Checks ------------------------------------------------------------------------------------

// Makes the preview's name: the name of the image with the extension ".png".
static glint_status name_preview(render_request *request, glint_error *error)
{
    if (!request->preview) {
        return GLINT_OK;
    }
    char *path;
    const int stem = (int)strlen(request->output) - (int)strlen(".exr");
    if (asprintf(&path, "%.*s.png", stem, request->output) < 0) {
        return glint_fail_memory(error, "a file name");
    }
    const glint_status status = glint_frame_name_parse(path, &request->preview_name, error);
    free(path);
    return status;
}

// Finds the frame whose file would have the path's last part: reads the number between the parts of
// the name before and behind it. False if the path does not match.
static bool number_of(const glint_frame_name *name, const char *path, int *frame)
{
    const char *slash = strrchr(name->path, '/');
    const size_t folder = slash != NULL ? (size_t)(slash + 1 - name->path) : 0;
    const size_t before = name->place - folder;
    const char *behind = name->path + name->place + name->length;
    slash = strrchr(path, '/');
    const char *last = slash != NULL ? slash + 1 : path;
    const size_t length = strlen(last), behind_length = strlen(behind);
    char digits[32];
    long long number;
    if (length <= before + behind_length || length - before - behind_length >= sizeof digits ||
        strncmp(last, name->path + folder, before) != 0 ||
        strcmp(last + length - behind_length, behind) != 0) {
        return false;
    }
    snprintf(digits, sizeof digits, "%.*s", (int)(length - before - behind_length), last + before);
    if (!glint_parse_int(digits, &number) || llabs(number) > GLINT_FRAME_MAX) {
        return false;
    }
    *frame = (int)number;
    return true;
}

static bool is_frame(const render_request *request, const glint_frame_name *name, const char *path)
{
    int frame;
    if (path == NULL || !number_of(name, path, &frame) ||
        !glint_frame_list_holds(&request->frames, frame)) {
        return false;
    }
    char *output = glint_frame_name_make(name, frame);
    const bool same = glint_same_file(output, path);
    free(output);
    return same;
}

// True if a file of this name would replace `path` or the target of its link.
static bool is_named(const render_request *request, const glint_frame_name *name, const char *path)
{
    if (path == NULL || name->length == 0) {
        return glint_same_file(name->path, path);
    }
    char *target = realpath(path, NULL);
    const bool is = is_frame(request, name, path) || is_frame(request, name, target);
    free(target);
    return is;
}

static bool is_output(const render_request *request, const char *path)
{
    return is_named(request, &request->name, path) ||
           is_named(request, &request->preview_name, path);
}

// Fails if an output would replace this input.
static glint_status check_input(const render_request *request, const char *input,
                                glint_error *error)
{
    if (is_output(request, input)) {
        return glint_fail(error, GLINT_USAGE, "--output %s: this is an input (name another file)",
                          input);
    }
    if (glint_same_file(request->stats, input)) {
        return glint_fail(error, GLINT_USAGE, "--stats %s: this is an input (name another file)",
                          request->stats);
    }
    return GLINT_OK;
}

static glint_status check_input_of_frames(const render_request *request,
                                          const glint_frame_name *name, glint_error *error)
{
    glint_frame_cursor cursor = {.list = &request->frames, .shard = {1, 1}};
    glint_status status = GLINT_OK;
    int frame = 1;
    bool is_left = !request->is_sequence || glint_frame_next(&cursor, &frame);
    while (status == GLINT_OK && is_left) {
        char *path = glint_frame_name_make(name, frame);
        status = path != NULL ? check_input(request, path, error)
                              : glint_fail_memory(error, "a file name");
        free(path);
        is_left = request->is_sequence && glint_frame_next(&cursor, &frame);
    }
    return status;
}

// Fails if an output would replace an input or another output.
static glint_status check_distinct(const render_request *request, glint_error *error)
{
    TRY(check_input(request, request->inputs.scene, error));
    TRY(check_input(request, request->inputs.env, error));
    if (request->env_name.length > 0) {
        TRY(check_input_of_frames(request, &request->env_name, error));
    }
    if (request->plate != NULL) {
        TRY(check_input_of_frames(request, &request->plate_name, error));
    }
    return !is_output(request, request->stats)
               ? GLINT_OK
               : glint_fail(error, GLINT_USAGE, "--stats %s: this is the image (name another file)",
                            request->stats);
}

static glint_status check_format(const render_request *request, glint_error *error)
{
    const char *output = request->output;
    const glint_write_options options = render_write_options(request);
    const bool is_exr = glint_has_extension(output, ".exr");
    TRY(glint_image_check_output(output, &options, error));
    if (request->exr_type != 0 && !is_exr) {
        return glint_fail(error, GLINT_USAGE, "--exr-type: %s is no EXR", output);
    }
    if (request->inputs.settings.aovs != 0 && !is_exr) {
        return glint_fail(error, GLINT_USAGE, "--aov: %s is no EXR, which alone holds layers",
                          output);
    }
    if (request->inputs.settings.terms > 0 && !is_exr) {
        return glint_fail(error, GLINT_USAGE, "--directions: %s is no EXR, which alone holds them",
                          output);
    }
    if (request->preview && !is_exr) {
        return glint_fail(error, GLINT_USAGE,
                          "--preview: %s is no EXR, beside which it would stand", output);
    }
    if (request->skip_existing && glint_has_extension(output, ".hdr")) {
        return glint_fail(error, GLINT_USAGE,
                          "--skip-existing: %s: an HDR does not say how it was made (write .exr)",
                          output);
    }
    if (request->skip_existing && request->inputs.kernel_dir != NULL) {
        return glint_fail(
            error, GLINT_USAGE,
            "--skip-existing: the kernels of --kernel-dir may have changed (leave out "
            "one of the two)");
    }
    return GLINT_OK;
}

// Finds the source of light: one file, one file per frame, or a capture around a node.
static glint_status find_light(render_request *request, glint_error *error)
{
    static const char capture[] = "capture:";
    glint_input_request *inputs = &request->inputs;
    const char *env = inputs->env;
    // A capture around a node.
    if (env != NULL && strncmp(env, capture, sizeof capture - 1) == 0) {
        request->capture = env + sizeof capture - 1;
        inputs->env = request->surroundings;
        inputs->only = inputs->only != NULL ? inputs->only : request->capture;
        request->capture_size = request->capture_size != 0 ? request->capture_size : CAPTURE_SIZE;
        request->capture_rotate = inputs->settings.env_rotate;
        inputs->settings.env_rotate = 0; // the capture contains the rotation already
        if (inputs->env_as.layout != GLINT_LAYOUT_UNKNOWN && inputs->env == NULL) {
            return glint_fail(error, GLINT_USAGE,
                              "--env-layout: it says how a file is read, but no --surroundings are "
                              "given");
        }
        return request->capture[0] != '\0' ? GLINT_OK
                                           : glint_fail(error, GLINT_USAGE,
                                                        "--env capture: around which node? "
                                                        "(--env capture:NODE)");
    }
    if (request->surroundings != NULL || request->capture_size != 0) {
        return glint_fail(error, GLINT_USAGE,
                          "--%s: it is about what is captured (with --env capture:NODE)",
                          request->surroundings != NULL ? "surroundings" : "capture-size");
    }
    if (env == NULL && inputs->env_as.layout != GLINT_LAYOUT_UNKNOWN) {
        return glint_fail(error, GLINT_USAGE,
                          "--env-layout: it says how a file is read, but no --env is given");
    }
    // One file, or a pattern with the frame's number.
    if (env != NULL) {
        TRY(glint_frame_name_parse_input(env, &request->env_name, error));
        inputs->env = request->env_name.path;
    }
    return GLINT_OK;
}

// Checks the options for the distance of the environment and the place where it was seen from.
static glint_status find_proxy(render_request *request, glint_error *error)
{
    const bool has_proxy = request->proxy.kind != PROXY_NONE;
    if (request->env_at.is_given && (!has_proxy || request->capture != NULL)) {
        return glint_fail(error, GLINT_USAGE, "--env-at: %s",
                          has_proxy ? "a capture has a place of its own (leave one of the two out)"
                                    : "it is where a proxy is seen from (with --proxy)");
    }
    if (request->proxy.kind == PROXY_BOUNDS && request->capture == NULL) {
        return glint_fail(error, GLINT_USAGE,
                          "--proxy bounds: they are those of what is captured (with --env "
                          "capture:NODE, or name a box or a sphere)");
    }
    request->inputs.settings.proxy = has_proxy;
    return GLINT_OK;
}

// --max-error chooses precision, depth and weight itself: it excludes the options for them.
static glint_status check_max_error(render_request *request, glint_error *error)
{
    const glint_setting *own =
        glint_settings_find_changed(&request->inputs.settings, GLINT_SETTING_WEIGHS_ERRORS);
    if (request->max_error > 0 && own != NULL) {
        return glint_fail(error, GLINT_USAGE,
                          "--max-error: it chooses what --%s says (leave one of the two out)",
                          own->option.name);
    }
    request->inputs.settings.truncation_squares = request->max_error > 0;
    return GLINT_OK;
}

static glint_status find_plate(render_request *request, glint_error *error)
{
    const char *plate = request->inputs.settings.plate;
    if (plate != NULL) {
        TRY(glint_frame_name_parse_input(plate, &request->plate_name, error));
        request->plate = request->plate_name.path;
    }
    return GLINT_OK;
}

// Finds which frames to render and how their files are named. From here on `output` is a path
// without escapes.
static glint_status find_frames(render_request *request, glint_error *error)
{
    TRY(glint_frame_name_parse(request->output, &request->name, error));
    request->output = request->name.path;
    request->is_sequence =
        request->frames_text != NULL || request->turntable > 0 || request->name.length > 0;
    if (!request->is_sequence && request->shard.count > 1) {
        return glint_fail(error, GLINT_USAGE,
                          "--shard: there is one frame alone (name several with --frames)");
    }
    if (request->frames_text != NULL) {
        TRY(glint_frame_list_parse(request->frames_text, &request->frames, error));
    } else if (!request->is_sequence || request->turntable > 0) {
        const int last = request->turntable > 0 ? request->turntable : 1;
        TRY(glint_frame_list_span(1, last, &request->frames, error));
    }
    if (request->frames.count > 1 && request->name.length == 0) {
        return glint_fail(error, GLINT_USAGE,
                          "%s: %llu frames need a place for their number (as in frame.####.exr)",
                          request->output, (unsigned long long)request->frames.count);
    }
    return GLINT_OK;
}

// Checks where the output goes. A sequence may need a new folder. One file that cannot be replaced
// fails only its own frame.
static glint_status check_place(render_request *request, glint_error *error)
{
    request->folder = glint_folder_of(request->output);
    if (request->folder == NULL) {
        return glint_fail_memory(error, "a file name");
    }
    const bool has_stats = request->stats != NULL && !glint_is_stdout(request->stats);
    if (!request->is_sequence) {
        TRY(glint_output_file_check(request->output, error));
        if (request->preview) {
            TRY(glint_output_file_check(request->preview_name.path, error));
        }
    } else if (!glint_is_folder(request->folder)) {
        TRY(glint_folder_check(request->folder, error));
        char *folder = has_stats ? glint_folder_of(request->stats) : NULL;
        const bool is_beside = folder != NULL && strcmp(folder, request->folder) == 0;
        free(folder);
        if (is_beside) {
            return GLINT_OK;
        }
    } else {
        TRY(glint_output_file_check_folder(request->output, error));
    }
    return has_stats ? glint_output_file_check(request->stats, error) : GLINT_OK;
}

glint_status render_request_finish(render_request *request, glint_error *error)
{
    if (request->output == NULL) {
        return glint_fail(error, GLINT_USAGE, "no output (name one: -o frame.exr)");
    }
    TRY(check_format(request, error));
    TRY(find_light(request, error));
    TRY(find_proxy(request, error));
    request->inputs.is_for_render = true;
    request->inputs.view.turns = request->turntable > 0;
    TRY(glint_input_request_finish(&request->inputs, error));
    TRY(check_max_error(request, error));
    TRY(find_plate(request, error));
    TRY(name_preview(request, error));
    TRY(find_frames(request, error));
    TRY(check_distinct(request, error));
    return check_place(request, error);
}

double render_request_time(const render_request *request, int frame)
{
    return (frame - 1) / request->fps;
}

// The number of the first frame at or after the end of a clip. Key times are floats: a time of
// exactly n frames may come out slightly larger or smaller than n.
static double last_frame(const render_request *request, double duration)
{
    const double frames = duration * request->fps;
    return ceil(frames - fmax(1e-6, 4 * FLT_EPSILON * frames)) + 1;
}

static glint_status take_clip(render_request *request, double duration, glint_error *error)
{
    const double frames = last_frame(request, duration);
    if (frames > GLINT_FRAME_MAX) {
        return glint_fail(error, GLINT_USAGE,
                          "%s: the animation has %.3g frames at %g a second (name some with "
                          "--frames)",
                          request->inputs.scene, frames, request->fps);
    }
    TRY(glint_frame_list_span(1, (int)frames, &request->frames, error));
    return check_distinct(request, error);
}

glint_status render_request_settle(render_request *request, const glint_motion *motion,
                                   glint_warnings *warnings, glint_error *error)
{
    const bool moves = glint_motion_moves_scene(motion) || motion->moves_cameras;
    if (request->frames.count == 0) {
        return moves ? take_clip(request, motion->duration, error)
                     : glint_frame_name_refuse(&request->name,
                                               "nothing moves in the scene, so name frames with "
                                               "--frames 1-240 or --turntable 240",
                                               error);
    }
    const int highest = glint_frame_list_highest(&request->frames);
    const double last = last_frame(request, motion->duration);
    if (moves && highest > last) {
        glint_warn(warnings,
                   "%s: the animation ends at frame %.0f (%g s); the frames after it, up to %d, "
                   "show its end",
                   request->inputs.scene, last, motion->duration, highest);
    }
    return GLINT_OK;
}

void render_request_free(render_request *request)
{
    glint_frame_list_free(&request->frames);
    glint_frame_name_free(&request->env_name);
    glint_frame_name_free(&request->plate_name);
    glint_frame_name_free(&request->name);
    glint_frame_name_free(&request->preview_name);
    free(request->folder);
}

// Warns of what the chosen format cannot keep.
static void warn_of_format(const render_request *request, glint_warnings *warnings)
{
    const char *output = request->output;
    bool is_hdr = glint_has_extension(output, ".hdr");
    bool is_jpeg = glint_has_extension(output, ".jpg") || glint_has_extension(output, ".jpeg");
    if (!request->preview) {
        tone_options_warn(output, request->exposure, request->tone, warnings);
    }
    if (request->inputs.settings.transparent && request->plate == NULL && (is_hdr || is_jpeg)) {
        glint_warn(warnings, "%s: this format keeps no alpha, the background becomes black",
                   output);
    }
}

static bool has_layer(const render_request *request, uint32_t layers)
{
    return (request->inputs.settings.aovs & layers) != 0;
}

static void warn_of_layers(const render_request *request, const glint_scene *scene,
                           glint_warnings *warnings)
{
    const char *output = request->output, *compression = request->compression;
    if (has_layer(request, GLINT_AOV_BIT(GLINT_AOV_TRIANGLE)) &&
        scene->triangle_count > GLINT_AOV_TRIANGLES_EXACT) {
        glint_warn(warnings, "%s: the layer 'triangle' rounds numbers above %u, by 4 at most",
                   output, GLINT_AOV_TRIANGLES_EXACT);
    }
    if (has_layer(request, GLINT_AOV_BIT(GLINT_AOV_DEPTH))) {
        glint_warn(warnings,
                   "%s: the layer 'depth' counts surfaces, and is called 'surfaces' now (the "
                   "distance is 'Z')",
                   output);
    }
    if (has_layer(request, GLINT_AOV_LOSSY) && compression != NULL &&
        strncmp(compression, "dwa", 3) == 0) {
        glint_warn(warnings,
                   "%s: --compression %s loses digits of the layers 'normal' and 'albedo', as of "
                   "the picture (zip and piz keep them)",
                   output, compression);
    }
}

void render_request_warn(const render_request *request, const glint_scene *scene,
                         glint_warnings *warnings)
{
    warn_of_format(request, warnings);
    warn_of_layers(request, scene, warnings);
}
