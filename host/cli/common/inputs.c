// Declares the options of commands on a scene, and loads the inputs that they name. See inputs.h.
#include "cli/common/inputs.h"

#include "base/clock.h"
#include "base/memory.h"
#include "environment/cache.h"
#include "image/codec.h"
#include "image/decoder.h"
#include "scene/built_in.h"
#include "scene/shape/shares.h"
#include "scene/subset.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

// Writes a list of all layouts: "cube, faces, latlong".
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

glint_status glint_parse_allow_large(const glint_option *option, const char *text,
                                     void *destination, glint_error *error)
{
    (void)option, (void)text, (void)destination, (void)error;
    glint_decoder_allow_large();
    return GLINT_OK;
}

const glint_option glint_input_options[] = {
    {GLINT_OPTION_HEADING, .help = "Scene and environment"},
    {GLINT_OPTION_TEXT, .name = "env", .argument = "FILE",
     .help = "The environment: an image (exr, hdr, png, tiff, dds, jpeg, webp), a folder with six "
             "faces, or a pattern with %s for the face's name. render also takes one file for each "
             "frame, ball.####.exr, and capture:NODE, which renders the node alone, lit by its "
             "surroundings.",
     .fallback = "a built-in studio", .offset = OFFSET(env)},
    GLINT_ENV_AS_OPTIONS(OFFSET(env_as)),
    {GLINT_OPTION_CUSTOM, .name = "env-flip", .argument = "AXES",
     .help = "Mirror the environment: x exchanges left and right, y above and below, z front and "
             "back. This happens before --env-rotate.",
     .offset = OFFSET(env_flip), .parse = glint_parse_flip},
    GLINT_SETTINGS_ROW(GLINT_SETTINGS_OF_ENVIRONMENT, OFFSET(settings)),
    {GLINT_OPTION_TEXT, .name = "animation", .argument = "NAME|INDEX",
     .help = "The animation to play. all plays all animations at once, none plays none.",
     .fallback = "the first", .offset = OFFSET(animation)},
    {GLINT_OPTION_TEXT, .name = "scene", .argument = "NAME|INDEX",
     .help = "The glTF scene to render.", .fallback = "the file's default",
     .offset = OFFSET(scene_name)},
    {GLINT_OPTION_TEXT, .name = "variant", .argument = "NAME|INDEX",
     .help = "The variant of the file's materials (KHR_materials_variants). glint info lists the "
             "variants.",
     .fallback = "none: the plain materials", .offset = OFFSET(variant)},
    {GLINT_OPTION_CUSTOM, .name = "material", .argument = "NAME=WHAT",
     .help =
         "Replace a material of the file: Gem=glass,ior=2.42. NAME is its name or index, or * for "
         "all materials. WHAT is a preset, values, or a preset and values. "
         "Presets: " GLINT_MATERIAL_PRESETS ". Values: " GLINT_MATERIAL_VALUES ". Can be repeated.",
     .offset = OFFSET(overrides), .parse = glint_material_override_parse},
    {GLINT_OPTION_INT, .name = "texture-size", .argument = "N",
     .help =
         "Reduce textures to at most N texels across. They take less memory and show less detail.",
     .fallback = "as they are", .minimum = 1, .maximum = 32768, .offset = OFFSET(texture_size)},
    {GLINT_OPTION_TEXT, .name = "only", .argument = "NODE,…",
     .help = "Render only these nodes and the nodes below them: names or indices, separated by "
             "commas. Cameras and turntables stay those of the whole scene.",
     .offset = OFFSET(only)},
    {GLINT_OPTION_TEXT, .name = "without", .argument = "NODE,…",
     .help = "Leave out these nodes and the nodes below them.", .offset = OFFSET(without)},
    GLINT_LARGE_IMAGES_OPTION,
    GLINT_OPTION_END,
};

const glint_option glint_view_options[] = {GLINT_VIEW_OPTIONS(OFFSET(view)), GLINT_OPTION_END};

const glint_option glint_size_options[] = {GLINT_SIZE_OPTIONS(NULL), GLINT_OPTION_END};

const glint_option glint_settings_options[] = {
    GLINT_SETTINGS_ROW(GLINT_SETTINGS_OF_FRAME, OFFSET(settings)),
    {GLINT_OPTION_TEXT, .name = "device", .argument = "SELECTOR",
     .help = "The OpenCL device: an index of `glint devices`, cpu, gpu, or a part of a name.",
     .fallback = "the first GPU, else the CPU", .offset = OFFSET(device)},
    GLINT_SETTINGS_ROW(GLINT_SETTINGS_OF_DEVICE, OFFSET(settings)),
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
}

glint_status glint_input_request_finish(glint_input_request *request, glint_error *error)
{
    const bool is_for_render = request->is_for_render;
    if (!is_for_render && request->env != NULL &&
        strncmp(request->env, "capture:", strlen("capture:")) == 0) {
        return glint_fail(error, GLINT_USAGE,
                          "--env %s: only render captures (glint capture writes what is around a "
                          "node into a file)",
                          request->env);
    }
    if (!is_for_render && request->settings.plate != NULL) {
        return glint_fail(error, GLINT_USAGE, "--background %s: pictures are for render alone",
                          request->settings.plate);
    }
    if (!is_for_render && request->env_as.layout != GLINT_LAYOUT_UNKNOWN && request->env == NULL) {
        return glint_fail(error, GLINT_USAGE,
                          "--env-layout: it says how a file is read, but no --env is given");
    }
    TRY(glint_layout_request_check(&request->env_as, error));
    TRY(glint_view_request_check(&request->view, error));
    struct stat facts;
    if (request->kernel_dir != NULL &&
        (stat(request->kernel_dir, &facts) != 0 || !S_ISDIR(facts.st_mode))) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: not a folder (--kernel-dir)",
                          request->kernel_dir);
    }
    return GLINT_OK;
}

// Loads a built-in scene and applies the overrides of its materials. Built-in scenes have no
// variants.
static glint_status load_built_in(const glint_input_request *request, glint_scene *scene,
                                  glint_error *error)
{
    if (request->variant != NULL) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: there is no material variant \"%.60s\" (the scene has none)",
                          request->scene, request->variant);
    }
    TRY(glint_built_in_scene(request->scene, scene, error));
    glint_material_overrides overrides = request->overrides;
    glint_error cause = {0};
    const glint_status status = glint_material_overrides_resolve(&overrides, scene->materials,
                                                                 scene->material_count, &cause);
    if (status != GLINT_OK) {
        return glint_fail(error, status, "%s: %s", request->scene, cause.message);
    }
    for (size_t i = 0; i < scene->material_count; i++) {
        glint_material_overrides_apply(&overrides, &scene->materials[i]);
    }
    return GLINT_OK;
}

static glint_status load_scene(const glint_input_request *request, glint_inputs *inputs,
                               glint_error *error)
{
    if (request->is_built_in) {
        return load_built_in(request, &inputs->scene, error);
    }
    const glint_scene_options options = {.scene = request->scene_name,
                                         .animation = request->animation,
                                         .variant = request->variant,
                                         .texture_size = request->texture_size,
                                         .overrides = &request->overrides};
    TRY(glint_scene_open(request->scene, &options, &inputs->source, error));
    inputs->motion = *glint_scene_motion(inputs->source);
    const glint_status status =
        glint_scene_at(inputs->source, 0, &inputs->scene, &inputs->warnings, error);
    if (!glint_motion_moves_scene(&inputs->motion) && !inputs->motion.moves_cameras) {
        glint_scene_close(inputs->source); // an open source holds the file
        inputs->source = NULL;
        inputs->motion = (glint_motion){0};
    }
    return status;
}

static void say_share(double share, glint_warnings *warnings, size_t number)
{
    char text[64] = " (less than 1% of the picture)";
    if (share >= 0.01) {
        snprintf(text, sizeof text, " (%.0f%% of the picture)", 100 * share);
    } else if (share <= 0) {
        snprintf(text, sizeof text, " (not in view)");
    }
    glint_warning_extend(warnings, number, text);
}

// Adds to each warning about a material the share of the picture that the material covers.
static void say_shares(const glint_scene *scene, const glint_viewpoint *viewpoint,
                       glint_warnings *warnings)
{
    uint64_t about = 0;
    for (size_t m = 0; m < scene->material_count; m++) {
        about |= scene->materials[m].warnings;
    }
    if (about == 0 || viewpoint->camera.is_lost || warnings->lost > 0) {
        return;
    }
    double *shares = glint_allocate(scene->material_count, sizeof *shares);
    if (shares != NULL &&
        glint_material_shares(scene, &viewpoint->camera, viewpoint->aspect, shares)) {
        for (size_t i = 0; i < warnings->count && i < 64; i++) {
            double share = 0;
            for (size_t m = 0; m < scene->material_count; m++) {
                share += (scene->materials[m].warnings >> i & 1) != 0 ? shares[m] : 0;
            }
            if ((about >> i & 1) != 0) {
                say_share(share, warnings, i);
            }
        }
    }
    free(shares);
}

static bool has_lost_camera(const glint_scene *scene)
{
    bool is_lost = false;
    for (size_t i = 0; i < scene->camera_count; i++) {
        is_lost = is_lost || scene->cameras[i].is_lost;
    }
    return is_lost;
}

glint_status glint_inputs_stage(const glint_input_request *request,
                                const glint_scene_source *source, glint_scene *scene,
                                glint_viewpoint *viewpoint, glint_error *error)
{
    const glint_settings *settings = &request->settings;
    *viewpoint =
        (glint_viewpoint){.aspect = (double)settings->width / (double)settings->height,
                          .moves = source != NULL && glint_scene_motion(source)->moves_triangles};
    glint_viewpoint_measure(scene, viewpoint);
    glint_status status = glint_viewpoint_find(&request->view, scene, viewpoint, error);
    if (status == GLINT_BAD_INPUT && request->camera_may_wait && has_lost_camera(scene)) {
        viewpoint->camera = (glint_camera){.is_lost = true};
        glint_error_free(error);
        status = GLINT_OK;
    }
    TRY(status);
    if (request->without != NULL) {
        TRY(glint_scene_remove_nodes(scene, request->without, error));
    }
    return request->only != NULL ? glint_scene_keep_nodes(scene, request->only, error) : GLINT_OK;
}

glint_status glint_inputs_load_scene(const glint_input_request *request,
                                     glint_progress_display *display, glint_inputs *inputs,
                                     glint_error *error)
{
    *inputs = (glint_inputs){0};
    const double begun = glint_progress_elapsed(display);
    if (request->env != NULL && !glint_env_cache_may_have(request->env)) {
        glint_codec_start(); // the codec's process starts while the scene loads
    }
    glint_progress_phase(display, "load_scene", "loading the scene");
    TRY(load_scene(request, inputs, error));
    inputs->scene_ms = glint_progress_elapsed(display) - begun;
    TRY(glint_inputs_stage(request, inputs->source, &inputs->scene, &inputs->viewpoint, error));
    say_shares(&inputs->scene, &inputs->viewpoint, &inputs->warnings);
    return GLINT_OK;
}

glint_status glint_inputs_load_environment(const glint_input_request *request,
                                           glint_progress_display *display, glint_inputs *inputs,
                                           glint_error *error)
{
    const double begun = glint_now_ms();
    if (display != NULL) {
        glint_progress_phase(display, "load_environment", "loading the environment");
    }
    if (request->env == NULL) {
        TRY(glint_environment_studio(&inputs->environment, error));
    } else {
        TRY(glint_environment_load(request->env, &request->env_as, &inputs->environment,
                                   &inputs->warnings, error));
    }
    if (request->env_flip != NULL) {
        glint_environment_end_write(&inputs->environment);
        TRY(glint_cube_mirror(&inputs->environment.radiance, request->env_flip, error));
    }
    inputs->environment_ms = glint_now_ms() - begun;
    return GLINT_OK;
}

glint_status glint_inputs_load(const glint_input_request *request, glint_progress_display *display,
                               glint_inputs *inputs, glint_error *error)
{
    TRY(glint_inputs_load_scene(request, display, inputs, error));
    return glint_inputs_load_environment(request, display, inputs, error);
}

void glint_inputs_free(glint_inputs *inputs)
{
    glint_environment_free(&inputs->environment);
    glint_scene_close(inputs->source);
    glint_scene_free(&inputs->scene);
    glint_warnings_free(&inputs->warnings);
    *inputs = (glint_inputs){0};
}
