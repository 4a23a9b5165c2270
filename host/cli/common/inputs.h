// Loads the scene, environment and camera for the commands that work on a scene; declares their
// common options.
#ifndef GLINT_CLI_COMMON_INPUTS_H
#define GLINT_CLI_COMMON_INPUTS_H

#include "base/status.h"
#include "cli/common/options.h"
#include "cli/common/progress.h"
#include "cli/common/viewpoint.h"
#include "environment/environment.h"
#include "render/plan.h"
#include "scene/material/material_override.h"
#include "scene/scene.h"

// The options that select the inputs and the computation. Texts are borrowed from argv.
typedef struct glint_input_request {
    const char *scene; // the file, or the name of a built-in scene
    bool is_built_in;
    const char *scene_name;
    glint_view_request view;
    const char *animation;
    const char *variant;
    glint_material_overrides overrides;
    int texture_size;           // largest width or height in texels; 0: no limit
    const char *only, *without; // lists of nodes, see scene/subset.h
    bool is_for_render;         // set by the command: true allows plates and captures
    // set by the command. True: a moving camera without a direction at time 0 is no error;
    // viewpoint.camera.is_lost is set instead
    bool camera_may_wait;
    const char *env;
    glint_layout_request env_as;
    const char *env_flip; // axes to mirror along; NULL: none
    const char *device;
    const char *kernel_dir; // NULL: the embedded kernels
    glint_settings settings;
} glint_input_request;

// Option tables for a request whose first member is a glint_input_request. The settings and the
// kernel folder appear under the same heading, after the size.
extern const glint_option glint_input_options[];
extern const glint_option glint_view_options[];
extern const glint_option glint_size_options[];
extern const glint_option glint_settings_options[];
extern const glint_option glint_kernel_dir_options[];

// Lifts the limits on memory and time for decoding image files, for the whole process.
glint_option_parser glint_parse_allow_large;
#define GLINT_LARGE_IMAGES_OPTION                                                                  \
    {                                                                                              \
        GLINT_OPTION_FLAG,                                                                         \
            .name = "allow-large-images",                                                          \
            .help =                                                                                \
                "Lift the limits on the memory and time that an image file may cost. For files "   \
                "that you trust.",                                                                 \
            .parse = glint_parse_allow_large                                                       \
    }

// Parsers for the options about the layout of an environment's file; their rows are
// GLINT_ENV_AS_OPTIONS. glint_layout_request_check checks that the options go together.
glint_option_parser glint_parse_layout, glint_parse_circle, glint_parse_distance;

// Parses axes to mirror along, such as "xz", into a const char *.
glint_option_parser glint_parse_flip;

// Option rows for a request with a glint_layout_request at `member`.
#define GLINT_ENV_AS_OPTIONS(member)                                                               \
    {GLINT_OPTION_CUSTOM,                                                                          \
     .name = "env-layout",                                                                         \
     .argument = "NAME",                                                                           \
     .help = "The layout of the environment's file, if glint cannot recognise it: cube "           \
             "(OpenEXR's strip), faces, hcross, vcross, vstrip, hstrip, latlong, ball (the "       \
             "picture of a mirror ball) or angular (a light probe).",                              \
     .fallback = "recognised",                                                                     \
     .offset = (member) + offsetof(glint_layout_request, layout),                                  \
     .parse = glint_parse_layout},                                                                 \
        {GLINT_OPTION_CUSTOM,                                                                      \
         .name = "ball-circle",                                                                    \
         .argument = "X,Y,R",                                                                      \
         .help = "The circle of the ball or angular map in its picture: centre from the top "      \
                 "left, and radius, in pixels.",                                                   \
         .fallback = "the circle that fills the picture's middle",                                 \
         .offset = (member) + offsetof(glint_layout_request, circle),                              \
         .parse = glint_parse_circle},                                                             \
        {GLINT_OPTION_CUSTOM,                                                                      \
         .name = "ball-distance",                                                                  \
         .argument = "RADII",                                                                      \
         .help = "Distance of the camera from the centre of the ball, in radii of the ball.",      \
         .fallback = "far away: all of its rays are parallel",                                     \
         .offset = (member) + offsetof(glint_layout_request, ball_distance),                       \
         .parse = glint_parse_distance},                                                           \
    {                                                                                              \
        GLINT_OPTION_REAL, .name = "ball-fov", .argument = "DEG",                                  \
                           .help = "Vertical angle of view of the camera that photographed the "   \
                                   "ball, for the whole picture. It replaces --ball-distance.",    \
                           .offset = (member) + offsetof(glint_layout_request, ball_fov),          \
                           .minimum = 0.01, .maximum = 179                                         \
    }

// Checks that options which describe a ball go with a fitting layout, and that its distance is
// given only once. Errors: GLINT_USAGE.
glint_status glint_layout_request_check(const glint_layout_request *request, glint_error *error);

// The heading and the row of glint_size_options, for a command with its own default size.
#define GLINT_SIZE_OPTIONS(default_size)                                                           \
    {GLINT_OPTION_HEADING, .help = "What is computed"},                                            \
    {                                                                                              \
        GLINT_OPTION_SETTINGS, .group = GLINT_SETTINGS_OF_SIZE, .fallback = (default_size),        \
                               .offset = offsetof(glint_input_request, settings)                   \
    }

// Fills the request with the defaults.
void glint_input_request_default(glint_input_request *request);

// Checks options that are only valid together, which the parser cannot do. Errors: GLINT_USAGE;
// GLINT_BAD_INPUT if --kernel-dir is no folder.
glint_status glint_input_request_finish(glint_input_request *request, glint_error *error);

// Finds the viewpoint, then removes the nodes that --only and --without exclude. `source` is NULL
// if nothing moves. Errors: as glint_viewpoint_find and glint_scene_remove_nodes.
glint_status glint_inputs_stage(const glint_input_request *request,
                                const glint_scene_source *source, glint_scene *scene,
                                glint_viewpoint *viewpoint, glint_error *error);

// The loaded inputs. Zero is valid and empty.
typedef struct glint_inputs {
    glint_scene scene;
    glint_environment environment;
    glint_viewpoint viewpoint;
    // NULL if nothing moves; `scene` is then the only pose, else the pose at time 0
    glint_scene_source *source;
    glint_motion motion; // the name of its clip belongs to `source`
    glint_warnings warnings;
    double scene_ms, environment_ms;
} glint_inputs;

// Loads the scene and the viewpoint, or the environment. glint_inputs_load_scene overwrites all of
// `inputs`; call it first. Free `inputs` with glint_inputs_free, also after an error. `display`
// shows the phase; it may be NULL for the environment.
glint_status glint_inputs_load_scene(const glint_input_request *request,
                                     glint_progress_display *display, glint_inputs *inputs,
                                     glint_error *error);
glint_status glint_inputs_load_environment(const glint_input_request *request,
                                           glint_progress_display *display, glint_inputs *inputs,
                                           glint_error *error);

// Loads the scene, then the environment.
glint_status glint_inputs_load(const glint_input_request *request, glint_progress_display *display,
                               glint_inputs *inputs, glint_error *error);
void glint_inputs_free(glint_inputs *inputs);

#endif
