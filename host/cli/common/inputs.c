// The options that commands on a scene share, and loading what they name. See inputs.h.
#include "cli/common/inputs.h"

#include "base/clock.h"
#include "scene/built_in.h"
#include "scene/subset.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#define SAMPLES_MAX (GLINT_SAMPLES_PER_AXIS_MAX * GLINT_SAMPLES_PER_AXIS_MAX)
#define DEPTH_MAX 65535

// Writes "cube, faces or latlong" from the layouts there are.
static void list_layouts(char *text, size_t capacity)
{
    size_t length = 0;
    text[0] = '\0';
    for (int i = GLINT_LAYOUT_UNKNOWN + 1; i < GLINT_LAYOUT_STUDIO && length < capacity; i++) {
        int written = snprintf(text + length, capacity - length, "%s%s", length > 0 ? ", " : "",
                               glint_layout_name((glint_layout)i));
        length += written > 0 ? (size_t)written : 0;
    }
}

glint_status glint_parse_layout(const glint_option *option, const char *text, void *destination,
                                glint_error *error)
{
    glint_layout layout = glint_layout_from_name(text);
    if (layout == GLINT_LAYOUT_UNKNOWN || layout == GLINT_LAYOUT_STUDIO) {
        char names[256];
        list_layouts(names, sizeof names);
        return glint_fail(error, GLINT_USAGE, "--%s %s: one of %s is expected", option->name, text,
                          names);
    }
    *(glint_layout *)destination = layout;
    return GLINT_OK;
}

glint_status glint_parse_circle(const glint_option *option, const char *text, void *destination,
                                glint_error *error)
{
    double *circle = destination;
    if (glint_parse_reals(text, circle, 3) && circle[2] >= 1) {
        return GLINT_OK;
    }
    return glint_fail(error, GLINT_USAGE,
                      "--%s %s: x,y,r in pixels is expected, with a radius of 1 or more",
                      option->name, text);
}

glint_status glint_parse_distance(const glint_option *option, const char *text, void *destination,
                                  glint_error *error)
{
    double distance;
    if (glint_parse_real(text, &distance) && distance > 1 && distance <= 1e9) {
        *(double *)destination = distance;
        return GLINT_OK;
    }
    return glint_fail(error, GLINT_USAGE,
                      "--%s %s: radii from the ball's centre are expected, above 1 and to 1e9",
                      option->name, text);
}

glint_status glint_layout_request_check(const glint_layout_request *request, glint_error *error)
{
    const bool is_ball = request->layout == GLINT_LAYOUT_BALL;
    if (request->circle[2] > 0 && !is_ball && request->layout != GLINT_LAYOUT_ANGULAR) {
        return glint_fail(error, GLINT_USAGE,
                          "--ball-circle: it says where a disc lies (with --env-layout ball or "
                          "angular)");
    }
    if ((request->ball_distance > 0 || request->ball_fov > 0) && !is_ball) {
        return glint_fail(error, GLINT_USAGE,
                          "--ball-%s: it says how a ball was seen (with --env-layout ball)",
                          request->ball_fov > 0 ? "fov" : "distance");
    }
    if (request->ball_distance > 0 && request->ball_fov > 0) {
        return glint_fail(error, GLINT_USAGE,
                          "--ball-fov: the distance that follows from it is given by "
                          "--ball-distance (give one)");
    }
    return GLINT_OK;
}

static glint_status parse_depth(const glint_option *option, const char *text, void *destination,
                                glint_error *error)
{
    long long depth;
    if (strcmp(text, "auto") == 0) {
        *(int *)destination = 0;
        return GLINT_OK;
    }
    if (!glint_parse_int(text, &depth) || depth < 1 || depth > DEPTH_MAX) {
        return glint_fail(error, GLINT_USAGE,
                          "--%s %s: a number of surfaces from 1 to %d, or auto, is expected",
                          option->name, text, DEPTH_MAX);
    }
    *(int *)destination = (int)depth;
    return GLINT_OK;
}

static glint_status parse_samples(const glint_option *option, const char *text, void *destination,
                                  glint_error *error)
{
    long long samples;
    if (glint_parse_int(text, &samples) && samples >= 1 && samples <= SAMPLES_MAX) {
        int root = (int)lround(sqrt((double)samples));
        if ((long long)root * root == samples) {
            *(int *)destination = root;
            return GLINT_OK;
        }
    }
    return glint_fail(error, GLINT_USAGE,
                      "--%s %s: a square number of samples is expected (1, 4, 9, 16 … %d)",
                      option->name, text, SAMPLES_MAX);
}

// One of a few numbers, which end with a 0; `wanted` names them.
static glint_status parse_one_of(const glint_option *option, const char *text, const int *numbers,
                                 const char *wanted, int *destination, glint_error *error)
{
    long long value;
    if (glint_parse_int(text, &value)) {
        for (const int *number = numbers; *number != 0; number++) {
            if (value == *number) {
                *destination = *number;
                return GLINT_OK;
            }
        }
    }
    return glint_fail(error, GLINT_USAGE, "--%s %s: one of %s is expected", option->name, text,
                      wanted);
}

static glint_status parse_kernel_width(const glint_option *option, const char *text,
                                       void *destination, glint_error *error)
{
    static const int widths[] = {1, 8, 16, 0};
    return parse_one_of(option, text, widths, "1, 8, 16", destination, error);
}

static glint_status parse_kernel_tile(const glint_option *option, const char *text,
                                      void *destination, glint_error *error)
{
    static const int sizes[] = {1, 16, 0};
    return parse_one_of(option, text, sizes, "1, 16", destination, error);
}

#define OFFSET(member) offsetof(glint_input_request, member)

glint_status glint_parse_flip(const glint_option *option, const char *text, void *destination,
                              glint_error *error)
{
    if (text[strspn(text, "xyz")] != '\0') {
        return glint_fail(error, GLINT_USAGE, "--%s %s: axes are expected: x, y, z or several",
                          option->name, text);
    }
    *(const char **)destination = text;
    return GLINT_OK;
}

const glint_option glint_input_options[] = {
    {GLINT_OPTION_HEADING, .help = "Scene and environment"},
    {GLINT_OPTION_TEXT, .name = "env", .argument = "FILE",
     .help =
         "The environment: an image (exr, hdr, png, tiff, dds, jpeg), a folder that holds six "
         "faces, or a pattern with %s in the place of the face's name. For render also one for "
         "each frame, ball.####.exr, or capture:NODE: the node alone, lit by what is around it.",
     .fallback = "a built-in studio", .offset = OFFSET(env)},
    GLINT_ENV_AS_OPTIONS(OFFSET(env_as)),
    {GLINT_OPTION_CUSTOM, .name = "env-flip", .argument = "AXES",
     .help = "Mirror the environment first: x exchanges left and right, y above and below, z front "
             "and back.",
     .offset = OFFSET(env_flip), .parse = glint_parse_flip},
    {GLINT_OPTION_REAL, .name = "env-rotate", .argument = "DEG",
     .help = "Turn the environment about +Y by degrees, counter-clockwise seen from above.",
     .fallback = "0", .offset = OFFSET(settings.env_rotate), .minimum = -1e6, .maximum = 1e6},
    {GLINT_OPTION_TEXT, .name = "camera", .argument = "NAME|INDEX",
     .help = "The camera to see through.",
     .fallback = "the first; without any, one that frames the scene", .offset = OFFSET(camera)},
    {GLINT_OPTION_TEXT, .name = "animation", .argument = "NAME|INDEX",
     .help = "Which of the file's animations; all at once, or none: everything as its nodes say.",
     .fallback = "the first", .offset = OFFSET(animation)},
    {GLINT_OPTION_TEXT, .name = "scene", .argument = "NAME|INDEX",
     .help = "Which of the file's glTF scenes.", .fallback = "the file's default",
     .offset = OFFSET(scene_name)},
    {GLINT_OPTION_TEXT, .name = "only", .argument = "NODE,…",
     .help = "Leave all nodes out but these, with what hangs under them: names or indices, with "
             "commas between. Cameras and turntables stay those of the whole scene.",
     .offset = OFFSET(only)},
    {GLINT_OPTION_TEXT, .name = "without", .argument = "NODE,…",
     .help = "Leave these nodes out, likewise.", .offset = OFFSET(without)},
    GLINT_OPTION_END,
};

const char *glint_error_option(const glint_settings *settings)
{
    const glint_settings *usual = &glint_settings_default;
    return settings->depth != usual->depth             ? "--depth"
           : settings->min_weight != usual->min_weight ? "--min-weight"
           : settings->precision != usual->precision   ? "--precision"
           : settings->mend != usual->mend             ? "--mend"
           : settings->fresnel != usual->fresnel       ? "--fresnel"
           : settings->texels != usual->texels         ? "--texels"
           : settings->irradiance != usual->irradiance ? "--irradiance"
           : settings->shading != usual->shading       ? "--shading"
                                                       : NULL;
}

const glint_option glint_size_options[] = {GLINT_SIZE_OPTIONS("1280x720"), GLINT_OPTION_END};

const glint_option glint_settings_options[] = {
    {GLINT_OPTION_CUSTOM, .name = "samples", .argument = "K2",
     .help = "Samples a pixel, a square number: a regular grid.", .fallback = "1",
     .offset = OFFSET(settings.samples_per_axis), .parse = parse_samples},
    {GLINT_OPTION_CUSTOM, .name = "depth", .argument = "N|auto",
     .help =
         "How many surfaces a light path meets before it takes the environment along its "
         "direction: 1 is environment mapping, 2 is in and out of glass. auto goes on until "
         "--min-weight ends every path, 64 at most, and no further than it is proved that anything "
         "is met.",
     .fallback = "auto", .offset = OFFSET(settings.depth), .parse = parse_depth},
    {GLINT_OPTION_REAL, .name = "min-weight", .argument = "W",
     .help = "A branch whose weight falls under this takes the environment at once; 0 follows "
             "every branch to --depth.",
     .fallback = "1/1024", .offset = OFFSET(settings.min_weight), .minimum = 0, .maximum = 1},
    {GLINT_OPTION_TEXT, .name = "background", .argument = "KIND|PLATE",
     .help = "What is behind the scene: env, the environment; transparent, nothing, and alpha says "
             "so; for render also a picture of the frame's size, plate.exr, or one for each frame, "
             "plate.####.exr.",
     .fallback = "env", .offset = OFFSET(background)},
    {GLINT_OPTION_CHOICE, .name = "precision", .argument = "KIND",
     .help = "float or double arithmetic on the device.", .fallback = "float",
     .offset = OFFSET(precision), .choices = "float|double"},
    {GLINT_OPTION_REAL, .name = "mend", .argument = "JUMP",
     .help =
         "With --precision float, render pixels again in double that differ from a neighbour "
         "by more than this, in parts of the frame's mean, 0.3 say: at edges and folds of glass "
         "float shows the other side in a pixel here and there. 0 mends nothing.",
     .fallback = "0", .offset = OFFSET(settings.mend), .minimum = 0, .maximum = 1e6},
    {GLINT_OPTION_CHOICE, .name = "fresnel", .argument = "KIND",
     .help = "exact: reflectance depends on the angle. none: metal reflects its base colour, glass "
             "only where it reflects all, paint nothing.",
     .fallback = "exact", .offset = OFFSET(fresnel), .choices = "exact|none"},
    {GLINT_OPTION_CHOICE, .name = "texels", .argument = "KIND",
     .help = "The environment's texels on the device: half is faster and holds values up to 65504; "
             "auto takes it where rounding to it does no harm, and float for precision double.",
     .fallback = "auto", .offset = OFFSET(texels), .choices = "auto|half|float"},
    {GLINT_OPTION_CHOICE, .name = "filter", .argument = "KIND",
     .help = "How the environment is taken along a direction: bilinear, between the four nearest "
             "texels; mip, averaged over what a pixel sees of it, so that fine or bright detail "
             "does not sparkle in curved mirrors and glass.",
     .fallback = "bilinear", .offset = OFFSET(filter), .choices = "bilinear|mip"},
    {GLINT_OPTION_CHOICE, .name = "irradiance", .argument = "KIND",
     .help =
         "What lights matte paint: exact, a map that is computed of the whole environment; sh, its "
         "nine spherical harmonics, which take less time and are off where a light is small.",
     .fallback = "exact", .offset = OFFSET(irradiance), .choices = "exact|sh"},
    {GLINT_OPTION_CHOICE, .name = "shading", .argument = "RATE",
     .help = "Where the environment is looked up: pixel, at what each pixel's rays meet; "
             "vertex-direction, along directions that are found at the triangles' vertices and "
             "interpolated; vertex-color, at the vertices, whose colours are interpolated. At "
             "vertices surfaces see nothing but the environment.",
     .fallback = "pixel", .offset = OFFSET(shading),
     .choices = "pixel|vertex-direction|vertex-color"},
    {GLINT_OPTION_TEXT, .name = "device", .argument = "SELECTOR",
     .help = "The OpenCL device: an index of `glint devices`, cpu, gpu, or a part of a name.",
     .fallback = "the first GPU, else the CPU", .offset = OFFSET(device)},
    {GLINT_OPTION_CUSTOM, .name = "kernel-width", .argument = "LANES",
     .help = "Rays that the kernel works on at once, for measurements: 1, 8 or 16.",
     .fallback = "chosen for the device", .offset = OFFSET(settings.kernel_width),
     .parse = parse_kernel_width},
    {GLINT_OPTION_CUSTOM, .name = "kernel-tile", .argument = "PACKETS",
     .help = "Packets whose primary rays the kernel traces together, for measurements: 1 or 16.",
     .fallback = "chosen for the device", .offset = OFFSET(settings.tile_packets),
     .parse = parse_kernel_tile},
    GLINT_OPTION_END,
};

const glint_option glint_kernel_dir_options[] = {
    {GLINT_OPTION_TEXT, .name = "kernel-dir", .argument = "DIR",
     .help = "Read the kernels from this folder instead of those built in, to edit them.",
     .offset = OFFSET(kernel_dir)},
    GLINT_OPTION_END,
};

void glint_input_request_default(glint_input_request *request)
{
    *request = (glint_input_request){.settings = glint_settings_default};
    request->size[0] = glint_settings_default.width;
    request->size[1] = glint_settings_default.height;
}

static glint_status check_background(glint_input_request *request, glint_error *error)
{
    static const char *const words[] = {"env", "transparent", NULL};
    const char *background = request->background;
    const bool is_env = background == NULL || strcmp(background, "env") == 0;
    const bool is_plate = !is_env && strcmp(background, "transparent") != 0;
    request->settings.transparent = !is_env;
    if (!is_plate || (request->is_for_render && strpbrk(background, "./") != NULL)) {
        request->plate = is_plate ? background : NULL;
        return GLINT_OK;
    }
    const char *nearest = glint_nearest_word(background, words);
    return nearest != NULL
               ? glint_fail(error, GLINT_USAGE,
                            "--background %s: neither env nor transparent%s (did you "
                            "mean %s?)",
                            background, request->is_for_render ? " nor a file" : "", nearest)
               : glint_fail(error, GLINT_USAGE, "--background %s: env or transparent%s is expected",
                            background,
                            request->is_for_render ? ", or an image's file,"
                                                   : " (pictures are for render alone)");
}

glint_status glint_input_request_finish(glint_input_request *request, glint_error *error)
{
    if (!request->is_for_render && request->env != NULL &&
        strncmp(request->env, "capture:", strlen("capture:")) == 0) {
        return glint_fail(error, GLINT_USAGE,
                          "--env %s: only render captures (glint capture writes what is around a "
                          "node into a file)",
                          request->env);
    }
    if (!request->is_for_render && request->env_as.layout != GLINT_LAYOUT_UNKNOWN &&
        request->env == NULL) {
        return glint_fail(error, GLINT_USAGE,
                          "--env-layout: it says how a file is read, but no --env is given");
    }
    glint_status status = glint_layout_request_check(&request->env_as, error);
    if (status == GLINT_OK) {
        status = check_background(request, error);
    }
    if (status != GLINT_OK) {
        return status;
    }
    struct stat facts;
    if (request->kernel_dir != NULL &&
        (stat(request->kernel_dir, &facts) != 0 || !S_ISDIR(facts.st_mode))) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: not a folder (--kernel-dir)",
                          request->kernel_dir);
    }
    request->settings.width = request->size[0];
    request->settings.height = request->size[1];
    request->settings.precision =
        request->precision == 0 ? GLINT_PRECISION_FLOAT : GLINT_PRECISION_DOUBLE;
    request->settings.fresnel = request->fresnel == 0 ? GLINT_FRESNEL_EXACT : GLINT_FRESNEL_NONE;
    request->settings.texels = (glint_texels)request->texels;
    request->settings.filter = (glint_filter)request->filter;
    request->settings.irradiance = (glint_irradiance)request->irradiance;
    request->settings.shading = (glint_shading)request->shading;
    return GLINT_OK;
}

static glint_status load_scene(const glint_input_request *request, glint_inputs *inputs,
                               glint_error *error)
{
    if (request->is_built_in) {
        return glint_built_in_scene(request->scene, &inputs->scene, error);
    }
    const glint_scene_options options = {.scene = request->scene_name,
                                         .animation = request->animation};
    glint_status status = glint_scene_open(request->scene, &options, &inputs->source, error);
    if (status != GLINT_OK) {
        return status;
    }
    inputs->motion = *glint_scene_motion(inputs->source);
    status = glint_scene_at(inputs->source, 0, &inputs->scene, &inputs->warnings, error);
    if (!inputs->motion.moves_triangles && !inputs->motion.moves_cameras) {
        glint_scene_close(inputs->source); // it holds the file
        inputs->source = NULL;
        inputs->motion = (glint_motion){0};
    }
    return status;
}

static bool has_lost_camera(const glint_scene *scene)
{
    bool is_lost = false;
    for (size_t i = 0; i < scene->camera_count; i++) {
        is_lost = is_lost || scene->cameras[i].is_lost;
    }
    return is_lost;
}

glint_status glint_inputs_stage(const glint_input_request *request, glint_scene *scene,
                                glint_viewpoint *viewpoint, glint_error *error)
{
    glint_vec3 low, high;
    glint_scene_shown_bounds(scene, &low, &high);
    viewpoint->centre =
        low.x <= high.x ? glint_vec3_scale(glint_vec3_add(low, high), 0.5) : (glint_vec3){0, 0, 0};
    glint_status status = glint_scene_camera(scene, request->camera, &viewpoint->camera, error);
    if (status == GLINT_BAD_INPUT && request->camera_may_wait && has_lost_camera(scene)) {
        viewpoint->camera = (glint_camera){.is_lost = true};
        glint_error_free(error);
        status = GLINT_OK;
    }
    if (status == GLINT_OK && request->without != NULL) {
        status = glint_scene_remove_nodes(scene, request->without, error);
    }
    if (status == GLINT_OK && request->only != NULL) {
        status = glint_scene_keep_nodes(scene, request->only, error);
    }
    return status;
}

glint_status glint_inputs_load_scene(const glint_input_request *request,
                                     glint_progress_display *display, glint_inputs *inputs,
                                     glint_error *error)
{
    *inputs = (glint_inputs){0};
    const double begun = glint_progress_elapsed(display);
    glint_progress_phase(display, "load_scene", "loading the scene");
    glint_status status = load_scene(request, inputs, error);
    inputs->scene_ms = glint_progress_elapsed(display) - begun;
    return status == GLINT_OK
               ? glint_inputs_stage(request, &inputs->scene, &inputs->viewpoint, error)
               : status;
}

glint_status glint_inputs_load_environment(const glint_input_request *request,
                                           glint_progress_display *display, glint_inputs *inputs,
                                           glint_error *error)
{
    const double begun = glint_now_ms();
    if (display != NULL) {
        glint_progress_phase(display, "load_environment", "loading the environment");
    }
    glint_status status =
        request->env == NULL
            ? glint_environment_studio(&inputs->environment, error)
            : glint_environment_load(request->env, &request->env_as, &inputs->environment,
                                     &inputs->warnings, error);
    if (status == GLINT_OK && request->env_flip != NULL) {
        status = glint_cube_mirror(&inputs->environment.radiance, request->env_flip, error);
    }
    inputs->environment_ms = glint_now_ms() - begun;
    return status;
}

glint_status glint_inputs_load(const glint_input_request *request, glint_progress_display *display,
                               glint_inputs *inputs, glint_error *error)
{
    glint_status status = glint_inputs_load_scene(request, display, inputs, error);
    return status == GLINT_OK ? glint_inputs_load_environment(request, display, inputs, error)
                              : status;
}

void glint_inputs_free(glint_inputs *inputs)
{
    glint_environment_free(&inputs->environment);
    glint_scene_close(inputs->source);
    glint_scene_free(&inputs->scene);
    glint_warnings_free(&inputs->warnings);
    *inputs = (glint_inputs){0};
}
