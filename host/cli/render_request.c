// The options of glint render and what is checked of them. See render_request.h.
#include "cli/render_request.h"

#include "cli/file_names.h"
#include "cli/progress.h"
#include "image/output_file.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define EXR_TYPES "half|float"
#define CAPTURE_SIZE 512 // of a view, where none is given

static uint32_t aov_by_name(const char *name)
{
    if (strcmp(name, "all") == 0) {
        return GLINT_AOV_ALL;
    }
    for (int i = 0; i < GLINT_AOV_COUNT; i++) {
        if (strcmp(name, glint_aov_name((glint_aov)i)) == 0) {
            return GLINT_AOV_BIT(i);
        }
    }
    return 0;
}

static glint_status fail_unknown_layer(const glint_option *option, const char *name,
                                       glint_error *error)
{
    const char *words[GLINT_AOV_COUNT + 2] = {"all"};
    char list[128] = "all";
    for (int i = 0; i < GLINT_AOV_COUNT; i++) {
        words[i + 1] = glint_aov_name((glint_aov)i);
        size_t length = strlen(list);
        snprintf(list + length, sizeof list - length, ", %s", words[i + 1]);
    }
    const char *nearest = glint_nearest_word(name, words);
    return nearest != NULL
               ? glint_fail(error, GLINT_USAGE, "--%s: there is no layer '%s' (did you mean %s?)",
                            option->name, name, nearest)
               : glint_fail(error, GLINT_USAGE, "--%s: there is no layer '%s' (there are %s)",
                            option->name, name, list);
}

// Names of layers between commas.
static glint_status parse_aovs(const glint_option *option, const char *text, void *destination,
                               glint_error *error)
{
    uint32_t aovs = 0;
    while (true) {
        const size_t length = strcspn(text, ",");
        char name[32];
        snprintf(name, sizeof name, "%.*s", (int)(length < sizeof name ? length : sizeof name),
                 text);
        const uint32_t found = aov_by_name(name);
        if (found == 0) {
            return fail_unknown_layer(option, name, error);
        }
        aovs |= found;
        if (text[length] == '\0') {
            break;
        }
        text += length + 1;
    }
    *(uint32_t *)destination = aovs;
    return GLINT_OK;
}

static glint_status parse_shard(const glint_option *option, const char *text, void *destination,
                                glint_error *error)
{
    (void)option;
    return glint_shard_parse(text, destination, error);
}

static const glint_option output_options[] = {
    {GLINT_OPTION_HEADING, .help = "Output"},
    {GLINT_OPTION_TEXT, .letter = 'o', .name = "output", .argument = "OUT",
     .help =
         "The image to write, by its extension: exr, hdr, png, jpg or tiff. It appears whole or "
         "not at all. Frames of a sequence take their number's place: frame.####.exr.",
     .offset = offsetof(render_request, output)},
    {GLINT_OPTION_REAL, .name = "exposure", .argument = "EV",
     .help = "Stops of exposure for PNG, JPEG and TIFF; EXR and HDR stay linear.", .fallback = "0",
     .offset = offsetof(render_request, exposure), .minimum = -100, .maximum = 100},
    {GLINT_OPTION_TEXT, .name = "compression", .argument = "NAME",
     .help = "EXR: none, rle, zip, zips, piz, pxr24, b44, b44a, dwaa, dwab. TIFF: none, lzw, zip, "
             "packbits. PNG: a level from 0 to 9. JPEG: a quality from 1 to 100.",
     .fallback = "the format's", .offset = offsetof(render_request, compression)},
    {GLINT_OPTION_CHOICE, .name = "exr-type", .argument = "TYPE",
     .help = "The picture's channels in an EXR: half or float.", .fallback = "half",
     .offset = offsetof(render_request, exr_type), .choices = EXR_TYPES},
    {GLINT_OPTION_FLAG, .name = "preview",
     .help = "Write a PNG beside each EXR, of the same name, with --exposure and the sRGB curve.",
     .offset = offsetof(render_request, preview)},
    {GLINT_OPTION_CUSTOM, .name = "aov", .argument = "LIST",
     .help = "Layers that tell what became of each pixel's paths, as further channels of the EXR: "
             "depth (surfaces that the longest met), tir (total reflections), truncated (weight "
             "that was not traced to its end), triangle and material (what the primary ray met), "
             "face (of the environment, where the heaviest look-up fell); with commas between "
             "them, or all. With several samples depth is the maximum, tir and truncated are "
             "means, the others numbers from 0, −1 for none, of the sample in the middle.",
     .offset = offsetof(render_request, inputs.settings.aovs), .parse = parse_aovs},
    {GLINT_OPTION_INT, .name = "directions", .argument = "K",
     .help = "Keep of each pixel the K heaviest directions that its paths leave along, with their "
             "weights, as further channels of the EXR: for glint relight.",
     .offset = offsetof(render_request, inputs.settings.terms), .minimum = 1,
     .maximum = GLINT_TERMS_MAX},
    {GLINT_OPTION_TEXT, .name = "stats", .argument = "FILE.json",
     .help = "Write what the frame took and counted: phases in milliseconds, rays by kind, "
             "truncated light, the plan and the device. Of a sequence, an object a line: the run, "
             "each frame as soon as it is through, the total.",
     .offset = offsetof(render_request, stats)},
    {GLINT_OPTION_CHOICE, .name = "progress", .argument = "MODE",
     .help = "On stderr: bar (redrawn), plain (lines), json (an object a line; warnings and errors "
             "stay text) or none; auto is bar "
             "on a terminal and plain elsewhere.",
     .fallback = "auto", .offset = offsetof(render_request, progress),
     .choices = GLINT_PROGRESS_CHOICES},
    GLINT_OPTION_END,
};

static const glint_option sequence_options[] = {
    {GLINT_OPTION_HEADING, .help = "Sequences"},
    {GLINT_OPTION_TEXT, .name = "frames", .argument = "LIST",
     .help = "Which frames: 7, 1-240, 1-10,20-40x2 (every second), 48-1x-1 (downwards); each once, "
             "in this order.",
     .fallback = "with --turntable N, 1-N; else the animation's",
     .offset = offsetof(render_request, frames_text)},
    {GLINT_OPTION_INT, .name = "turntable", .argument = "N",
     .help = "Turn the camera about the scene's middle, counter-clockwise seen from above, once in "
             "N frames; frame 1 is the camera as it stands.",
     .offset = offsetof(render_request, turntable), .minimum = 1, .maximum = GLINT_FRAME_MAX},
    {GLINT_OPTION_REAL, .name = "fps", .argument = "RATE",
     .help = "Frames a second of the animation; frame 1 is its beginning.", .fallback = "24",
     .offset = offsetof(render_request, fps), .minimum = 1e-3, .maximum = 1e5},
    {GLINT_OPTION_FLAG, .name = "skip-existing",
     .help = "Leave frames alone that are whole and were made from the same scene, environment and "
             "settings by the same version; render the others.",
     .offset = offsetof(render_request, skip_existing)},
    {GLINT_OPTION_CUSTOM, .name = "shard", .argument = "I/N",
     .help = "Render part I of N of the frames, from 1/N to N/N: every N-th, each in one part.",
     .fallback = "1/1", .offset = offsetof(render_request, shard), .parse = parse_shard},
    GLINT_OPTION_END,
};

static const glint_option capture_options[] = {
    {GLINT_OPTION_TEXT, .name = "surroundings", .argument = "FILE",
     .help = "With --env capture:NODE, which renders a node alone in what is around it: the "
             "environment behind all that, which --env-layout and its like then describe.",
     .fallback = "the built-in studio", .offset = offsetof(render_request, surroundings)},
    {GLINT_OPTION_INT, .name = "capture-size", .argument = "N",
     .help = "The edge of each of its six views, in pixels.", .fallback = "512",
     .offset = offsetof(render_request, capture_size), .minimum = 1, .maximum = 4096},
    {GLINT_OPTION_CUSTOM, .name = "proxy", .argument = "SHAPE",
     .help =
         "Take the environment to be no further away than a shape around the scene, so that it "
         "looks different from different places: sphere:RADIUS about where it was seen from, a "
         "box by two corners, x,y,z,x,y,z, in metres, or bounds, the box around what is captured.",
     .fallback = "none: it is infinitely far away", .offset = offsetof(render_request, proxy),
     .parse = proxy_option_parse},
    {GLINT_OPTION_CUSTOM, .name = "env-at", .argument = "X,Y,Z",
     .help = "With --proxy, where a file's environment was seen from.",
     .fallback = "0,0,0; of a capture its own place", .offset = offsetof(render_request, env_at),
     .parse = place_option_parse},
    GLINT_OPTION_END,
};

const glint_option *const render_option_groups[] = {
    output_options,     sequence_options,       glint_input_options,      capture_options,
    glint_size_options, glint_settings_options, glint_kernel_dir_options, NULL};

glint_write_options render_write_options(const render_request *request)
{
    return (glint_write_options){.exr_float = request->exr_type == 1,
                                 .compression = request->compression,
                                 .exposure = (float)request->exposure};
}

// ---- Checks ------------------------------------------------------------------------------------

// The preview's path is the image's with another extension.
static glint_status name_preview(render_request *request, glint_error *error)
{
    if (!request->preview) {
        return GLINT_OK;
    }
    const int stem = (int)strlen(request->output) - (int)strlen(".exr");
    if (asprintf(&request->preview_path, "%.*s.png", stem, request->output) < 0) {
        request->preview_path = NULL;
        return glint_fail_memory(error, "a file name");
    }
    return glint_frame_name_parse(request->preview_path, &request->preview_name, error);
}

// The frame whose file would have that path, if there is one: the path's last part without what
// stands before and behind the number's place.
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

// Whether `path`, or the file that it leads to, is one that files of that name replace.
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

// An output that would replace an input.
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

// An output that would replace an input, or another output.
static glint_status check_distinct(const render_request *request, glint_error *error)
{
    glint_status status = check_input(request, request->inputs.scene, error);
    if (status == GLINT_OK) {
        status = check_input(request, request->inputs.env, error);
    }
    if (status == GLINT_OK && request->env_name.length > 0) {
        status = check_input_of_frames(request, &request->env_name, error);
    }
    if (status == GLINT_OK && request->plate != NULL) {
        status = check_input_of_frames(request, &request->plate_name, error);
    }
    if (status == GLINT_OK && is_output(request, request->stats)) {
        return glint_fail(error, GLINT_USAGE, "--stats %s: this is the image (name another file)",
                          request->stats);
    }
    return status;
}

static glint_status check_format(const render_request *request, glint_error *error)
{
    const char *output = request->output;
    const glint_write_options options = render_write_options(request);
    const bool is_exr = glint_has_extension(output, ".exr");
    glint_status status = glint_image_check_output(output, &options, error);
    if (status == GLINT_OK && request->exr_type != 0 && !is_exr) {
        return glint_fail(error, GLINT_USAGE, "--exr-type: %s is no EXR", output);
    }
    if (status == GLINT_OK && request->inputs.settings.aovs != 0 && !is_exr) {
        return glint_fail(error, GLINT_USAGE, "--aov: %s is no EXR, which alone holds layers",
                          output);
    }
    if (status == GLINT_OK && request->inputs.settings.terms > 0 && !is_exr) {
        return glint_fail(error, GLINT_USAGE, "--directions: %s is no EXR, which alone holds them",
                          output);
    }
    if (status == GLINT_OK && request->preview && !is_exr) {
        return glint_fail(error, GLINT_USAGE,
                          "--preview: %s is no EXR, beside which it would stand", output);
    }
    if (status == GLINT_OK && request->skip_existing && glint_has_extension(output, ".hdr")) {
        return glint_fail(error, GLINT_USAGE,
                          "--skip-existing: %s: an HDR does not say how it was made (write .exr)",
                          output);
    }
    if (status == GLINT_OK && request->skip_existing && request->inputs.kernel_dir != NULL) {
        return glint_fail(
            error, GLINT_USAGE,
            "--skip-existing: the kernels of --kernel-dir may have changed (leave out "
            "one of the two)");
    }
    return status;
}

// What lights the frames: a file, one for each, or what is around a node.
static glint_status find_light(render_request *request, glint_error *error)
{
    static const char capture[] = "capture:";
    glint_input_request *inputs = &request->inputs;
    const char *env = inputs->env;
    if (env != NULL && strncmp(env, capture, sizeof capture - 1) == 0) {
        request->capture = env + sizeof capture - 1;
        inputs->env = request->surroundings;
        inputs->only = inputs->only != NULL ? inputs->only : request->capture;
        request->capture_size = request->capture_size != 0 ? request->capture_size : CAPTURE_SIZE;
        request->capture_rotate = inputs->settings.env_rotate;
        inputs->settings.env_rotate = 0; // the capture is turned already
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
    if (env == NULL || access(env, F_OK) == 0) {
        return GLINT_OK; // a name may hold anything
    }
    return glint_frame_name_parse(env, &request->env_name, error);
}

// How far away the environment is, and where it was seen from.
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

static glint_status find_plate(render_request *request, glint_error *error)
{
    const char *plate = request->inputs.plate;
    request->plate = request->plate_name.path = plate;
    return plate == NULL || access(plate, F_OK) == 0
               ? GLINT_OK
               : glint_frame_name_parse(plate, &request->plate_name, error);
}

// Which frames there are, and what their files are called.
static glint_status find_frames(render_request *request, glint_error *error)
{
    glint_status status = glint_frame_name_parse(request->output, &request->name, error);
    request->is_sequence =
        request->frames_text != NULL || request->turntable > 0 || request->name.length > 0;
    if (status == GLINT_OK && !request->is_sequence && request->shard.count > 1) {
        return glint_fail(error, GLINT_USAGE,
                          "--shard: there is one frame alone (name several with --frames)");
    }
    const bool is_known =
        !request->is_sequence || request->frames_text != NULL || request->turntable > 0;
    if (status == GLINT_OK && is_known) {
        status = request->frames_text != NULL
                     ? glint_frame_list_parse(request->frames_text, &request->frames, error)
                     : glint_frame_list_span(1, request->turntable > 0 ? request->turntable : 1,
                                             &request->frames, error);
    }
    if (status == GLINT_OK && request->frames.count > 1 && request->name.length == 0) {
        return glint_fail(error, GLINT_USAGE,
                          "%s: %llu frames need a place for their number (as in frame.####.exr)",
                          request->output, (unsigned long long)request->frames.count);
    }
    return status;
}

// A sequence's file that cannot be replaced is one bad frame; its folder is everybody's.
static glint_status check_place(const render_request *request, glint_error *error)
{
    glint_status status = request->is_sequence
                              ? glint_output_file_check_folder(request->output, error)
                              : glint_output_file_check(request->output, error);
    if (status == GLINT_OK && request->preview && !request->is_sequence) {
        status = glint_output_file_check(request->preview_path, error);
    }
    if (status == GLINT_OK && request->stats != NULL) {
        status = glint_output_file_check(request->stats, error);
    }
    return status;
}

glint_status render_request_finish(render_request *request, glint_error *error)
{
    if (request->output == NULL) {
        return glint_fail(error, GLINT_USAGE, "no output (name one: -o frame.exr)");
    }
    glint_status status = check_format(request, error);
    if (status == GLINT_OK) {
        status = find_light(request, error);
    }
    if (status == GLINT_OK) {
        status = find_proxy(request, error);
    }
    if (status == GLINT_OK) {
        request->inputs.is_for_render = true;
        status = glint_input_request_finish(&request->inputs, error);
    }
    if (status == GLINT_OK) {
        status = find_plate(request, error);
    }
    if (status == GLINT_OK) {
        status = name_preview(request, error);
    }
    if (status == GLINT_OK) {
        status = find_frames(request, error);
    }
    if (status == GLINT_OK) {
        status = check_distinct(request, error);
    }
    if (status == GLINT_OK) {
        status = check_place(request, error);
    }
    return status;
}

double render_request_time(const render_request *request, int frame)
{
    return (frame - 1) / request->fps;
}

// The first frame at or beyond the end of a clip, as a whole number. Keys are floats: a time that
// is n frames is a little more or less than that.
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
    glint_status status = glint_frame_list_span(1, (int)frames, &request->frames, error);
    return status == GLINT_OK ? check_distinct(request, error) : status;
}

glint_status render_request_settle(render_request *request, const glint_motion *motion,
                                   glint_warnings *warnings, glint_error *error)
{
    const bool moves = motion->moves_triangles || motion->moves_cameras;
    if (request->frames.count == 0) {
        return moves ? take_clip(request, motion->duration, error)
                     : glint_fail(error, GLINT_USAGE,
                                  "%s: which frames? (nothing moves in the scene: name them with "
                                  "--frames 1-240, or --turntable 240)",
                                  request->output);
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
    free(request->preview_path);
}

// What the chosen format cannot keep.
static void warn_of_format(const render_request *request, glint_warnings *warnings)
{
    const char *output = request->output;
    bool is_hdr = glint_has_extension(output, ".hdr");
    bool is_jpeg = glint_has_extension(output, ".jpg") || glint_has_extension(output, ".jpeg");
    if (request->exposure != 0 && !request->preview &&
        (is_hdr || glint_has_extension(output, ".exr"))) {
        glint_warn(warnings, "%s: --exposure is left out, this format stays linear", output);
    }
    if (request->inputs.settings.transparent && request->plate == NULL && (is_hdr || is_jpeg)) {
        glint_warn(warnings, "%s: this format keeps no alpha, the background becomes black",
                   output);
    }
}

static void warn_of_layers(const render_request *request, const glint_scene *scene,
                           glint_warnings *warnings)
{
    if ((request->inputs.settings.aovs & GLINT_AOV_BIT(GLINT_AOV_TRIANGLE)) != 0 &&
        scene->triangle_count > GLINT_AOV_TRIANGLES_EXACT) {
        glint_warn(warnings, "%s: the layer 'triangle' rounds numbers above %u, by 4 at most",
                   request->output, GLINT_AOV_TRIANGLES_EXACT);
    }
}

void render_request_warn(const render_request *request, const glint_scene *scene,
                         glint_warnings *warnings)
{
    warn_of_format(request, warnings);
    warn_of_layers(request, scene, warnings);
}
