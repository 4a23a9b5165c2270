// glint capture: the environment at a place of a scene.
#include "cli/cli.h"

#include "base/clock.h"
#include "cli/env_output.h"
#include "cli/inputs.h"
#include "cli/progress.h"
#include "device/device.h"
#include "render/frame.h"
#include "scene/subset.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define FACE_EDGE 256 // where no size is given

typedef struct capture_request {
    glint_input_request inputs; // first: see inputs.h
    env_output_request output;
    double at[3];
    bool has_at;
    const char *around, *without;
    int progress;
} capture_request;

static glint_status parse_at(const glint_option *option, const char *text, void *destination,
                             glint_error *error)
{
    capture_request *request = destination;
    char rest;
    double *at = request->at;
    request->has_at = sscanf(text, "%lf,%lf,%lf%c", &at[0], &at[1], &at[2], &rest) == 3 &&
                      isfinite(at[0]) && isfinite(at[1]) && isfinite(at[2]);
    return request->has_at ? GLINT_OK
                           : glint_fail(error, GLINT_USAGE, "--%s %s: x,y,z in metres is expected",
                                        option->name, text);
}

static const glint_option capture_options[] = {
    {GLINT_OPTION_HEADING, .help = "From where"},
    {GLINT_OPTION_CUSTOM, .name = "at", .argument = "X,Y,Z",
     .help = "The place, in metres of the scene's world.", .parse = parse_at},
    {GLINT_OPTION_TEXT, .name = "around", .argument = "NODE",
     .help = "The middle of a node's bounds, by its name or index; the node itself is taken away.",
     .offset = offsetof(capture_request, around)},
    {GLINT_OPTION_TEXT, .name = "without", .argument = "NODE,…",
     .help = "Further nodes to take away, their names or indices with commas between.",
     .offset = offsetof(capture_request, without)},
    {GLINT_OPTION_HEADING, .help = "What is written"},
    ENV_OUTPUT_OPTIONS(offsetof(capture_request, output),
                       "latlong, or six files where OUT is for them", "256, of a lat-long map 512"),
    {GLINT_OPTION_CHOICE, .name = "progress", .argument = "KIND",
     .help = "What is shown of the work on stderr: bar, plain lines, json lines or none.",
     .fallback = "a bar on a terminal, else plain lines",
     .offset = offsetof(capture_request, progress), .choices = GLINT_PROGRESS_CHOICES},
    GLINT_OPTION_END,
};

static const glint_option *const groups[] = {
    capture_options, glint_input_options, glint_settings_options, glint_kernel_dir_options, NULL};

// Everything between reading and writing. Zero is valid.
typedef struct capture {
    const capture_request *request;
    glint_progress_display display;
    env_output output;
    glint_inputs inputs;
    glint_vec3 at;
    glint_device *device;
    glint_renderer *renderer;
    glint_cube cube;
    int face;                  // that is rendered
    uint64_t nonfinite_pixels; // of all
} capture;

// ---- The scene ----------------------------------------------------------------------------------

static glint_status remove_listed(capture *work, glint_error *error)
{
    const char *rest = work->request->without;
    glint_status status = GLINT_OK;
    while (status == GLINT_OK && rest != NULL) {
        const char *comma = strchr(rest, ',');
        const size_t length = comma != NULL ? (size_t)(comma - rest) : strlen(rest);
        char name[256];
        snprintf(name, sizeof name, "%.*s", (int)(length < 255 ? length : 255), rest);
        status = glint_scene_remove_node(&work->inputs.scene, name, NULL, NULL, error);
        rest = comma != NULL ? comma + 1 : NULL;
    }
    return status;
}

static glint_status find_place(capture *work, glint_error *error)
{
    const capture_request *request = work->request;
    if (request->has_at) {
        work->at = (glint_vec3){request->at[0], request->at[1], request->at[2]};
        return GLINT_OK;
    }
    glint_vec3 low, high;
    glint_status status =
        glint_scene_remove_node(&work->inputs.scene, request->around, &low, &high, error);
    if (status == GLINT_OK) {
        work->at = glint_vec3_scale(glint_vec3_add(low, high), 0.5);
    }
    return status;
}

// ---- Rendering ----------------------------------------------------------------------------------

// The camera whose pixel (i, j) looks along texel (i, j) of a face: s to the right, t downwards.
static glint_camera face_camera(int face, glint_vec3 eye)
{
    const glint_vec3 middle = glint_cube_direction(face, 0, 0);
    const glint_vec3 right = glint_vec3_subtract(glint_cube_direction(face, 1, 0), middle);
    const glint_vec3 down = glint_vec3_subtract(glint_cube_direction(face, 0, 1), middle);
    return (glint_camera){.yfov = GLINT_PI / 2,
                          .eye = eye,
                          .right = right,
                          .up = glint_vec3_scale(down, -1),
                          .back = glint_vec3_scale(middle, -1)};
}

static bool step(void *context, uint64_t done, uint64_t total)
{
    capture *work = context;
    glint_progress_step(&work->display, (uint64_t)work->face * total + done, 6 * total);
    return !glint_stop_requested();
}

static glint_status render_face(capture *work, int face, glint_error *error)
{
    const glint_camera camera = face_camera(face, work->at);
    const glint_progress progress = {step, work};
    glint_image image = {0};
    glint_frame_report report;
    work->face = face;
    glint_status status =
        glint_renderer_frame(work->renderer, &camera, &progress, &image, &report, error);
    work->nonfinite_pixels += report.nonfinite_pixels;
    for (int k = 0; status == GLINT_OK && k < image.width * image.height; k++) {
        double rgb[3];
        glint_image_rgb(&image, k % image.width, k / image.width, rgb);
        glint_cube_store(&work->cube, face, k % image.width, k / image.width, rgb);
    }
    glint_image_free(&image);
    return status;
}

static glint_status render_faces(capture *work, glint_error *error)
{
    const glint_settings *settings = &work->request->inputs.settings;
    glint_status status = glint_cube_create(settings->width, &work->cube, error);
    char text[GLINT_MESSAGE_CAPACITY];
    snprintf(text, sizeof text, "rendering six views of %dx%d from (%g, %g, %g) on %s",
             settings->width, settings->height, work->at.x, work->at.y, work->at.z,
             glint_device_capabilities(work->device)->name);
    const double samples = (double)settings->samples_per_axis * settings->samples_per_axis;
    glint_progress_render(&work->display, 0, 6 * samples * settings->width * settings->height,
                          text);
    glint_signals_cooperate(true);
    for (int face = 0; status == GLINT_OK && face < 6; face++) {
        status = render_face(work, face, error);
    }
    glint_signals_cooperate(false);
    glint_progress_clear(&work->display);
    if (status == GLINT_OK) {
        glint_cube_fill_border(&work->cube);
    }
    return status;
}

static glint_status prepare(capture *work, glint_error *error)
{
    const glint_input_request *request = &work->request->inputs;
    glint_status status = glint_inputs_load(request, &work->display, &work->inputs, error);
    if (status == GLINT_OK) {
        status = find_place(work, error);
    }
    if (status == GLINT_OK) {
        status = remove_listed(work, error);
    }
    if (status == GLINT_OK) {
        status = glint_device_open(request->device, &work->device, error);
    }
    if (status == GLINT_OK) {
        glint_progress_phase(&work->display, "prepare", "building the tree and the kernels");
        const glint_renderer_inputs inputs = {.device = work->device,
                                              .scene = &work->inputs.scene,
                                              .environment = &work->inputs.environment,
                                              .settings = &request->settings,
                                              .kernel_dir = request->kernel_dir};
        status = glint_renderer_create(&inputs, &work->renderer, error);
    }
    return status;
}

// ---- The request --------------------------------------------------------------------------------

static glint_status check_request(const capture_request *request, glint_error *error)
{
    if (request->has_at == (request->around != NULL)) {
        return glint_fail(error, GLINT_USAGE,
                          request->has_at ? "--around: the place is given by --at (give one)"
                                          : "from where? (give --at x,y,z or --around NODE)");
    }
    if (request->inputs.settings.transparent) {
        return glint_fail(error, GLINT_USAGE,
                          "--background transparent: an environment has no holes");
    }
    return GLINT_OK;
}

// What is rendered is as fine as what is written.
static glint_status settle(capture_request *request, const char *path, glint_error *error)
{
    env_output_request *output = &request->output;
    if (output->to == GLINT_LAYOUT_UNKNOWN) {
        output->to = env_output_is_set(path) ? GLINT_LAYOUT_FACES : GLINT_LAYOUT_LATLONG;
    }
    if (output->size == 0) {
        output->size = glint_chart_size_for(output->to, FACE_EDGE);
    }
    glint_chart chart;
    glint_status status = glint_chart_make(output->to, output->size, false, &chart, error);
    if (status == GLINT_OK) {
        const int edge = (int)fmax(1, round(glint_chart_quarter_turn(&chart)));
        request->inputs.size[0] = request->inputs.size[1] = edge;
        status = glint_input_request_finish(&request->inputs, error);
    }
    return status;
}

static void say_done(const capture *work, const char *path, double ms)
{
    const glint_chart *to = &work->output.chart;
    if (work->nonfinite_pixels > 0) {
        glint_say("warning: %llu pixels are not finite",
                  (unsigned long long)work->nonfinite_pixels);
    }
    if (work->display.mode != GLINT_PROGRESS_NONE && work->display.mode != GLINT_PROGRESS_JSON) {
        glint_say("%s: %s %dx%d, six views from (%g, %g, %g), %.0f ms", path,
                  glint_layout_name(to->layout), to->width,
                  work->output.as_faces ? to->width : to->height, work->at.x, work->at.y,
                  work->at.z, ms);
    }
}

static glint_status run(void *context, const glint_arguments *arguments, glint_error *error)
{
    capture_request *request = context;
    const char *path = arguments->positionals[1];
    capture work = {.request = request};
    const double begun = glint_now_ms();
    request->inputs.scene = arguments->positionals[0];
    glint_progress_begin(&work.display, (glint_progress_mode)request->progress);
    glint_status status = check_request(request, error);
    if (status == GLINT_OK) {
        status = settle(request, path, error);
    }
    if (status == GLINT_OK) {
        status = env_output_open(&request->output, path, request->output.to, &work.output, error);
    }
    if (status == GLINT_OK) {
        status = prepare(&work, error);
    }
    glint_progress_clear(&work.display);
    if (status == GLINT_OK) {
        glint_say_warnings(&work.inputs.warnings, 0);
        status = render_faces(&work, error);
    }
    if (status == GLINT_OK) {
        const glint_sampler sampler = glint_sampler_of_cube(&work.cube);
        status = env_output_write(&work.output, &sampler, &glint_turn_none, error);
    }
    if (status == GLINT_OK) {
        say_done(&work, path, glint_now_ms() - begun);
    }
    glint_cube_free(&work.cube);
    glint_renderer_free(work.renderer);
    glint_device_close(work.device);
    glint_inputs_free(&work.inputs);
    return status;
}

static void set_defaults(void *request)
{
    glint_input_request_default(&((capture_request *)request)->inputs);
}

const glint_command glint_command_capture = {
    .name = "capture",
    .summary = "the environment at a place of a scene",
    .synopsis = "SCENE OUT --at X,Y,Z|--around NODE [options]",
    .description =
        "Renders six square views of 90 degrees from a place, which are a cube map of what is seen "
        "from there, and writes it in any layout: an environment for render --env. Around a node "
        "the node itself is taken away, so that an object can be lit by its surroundings.",
    .examples = "  glint capture room.glb room.exr --at 0,1.6,0 --size 1024 --samples 16\n"
                "  glint capture scenes/gallery.gltf faces/ --around diamond --to faces\n",
    .groups = groups,
    .positional = "SCENE",
    .second_positional = "OUT",
    .request_size = sizeof(capture_request),
    .set_defaults = set_defaults,
    .run = run,
};
