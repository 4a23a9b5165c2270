// Finds the camera of a scene from the options about the view.
#ifndef GLINT_CLI_COMMON_VIEWPOINT_H
#define GLINT_CLI_COMMON_VIEWPOINT_H

#include "base/status.h"
#include "cli/common/options.h"
#include "cli/common/proxy_option.h"
#include "scene/scene.h"

#include <stdbool.h>

// An angle in degrees. Zero means not given.
typedef struct angle_request {
    double degrees;
    bool is_given;
} angle_request;

// The options about the view. Zero: the file's first camera, else the default camera. Texts are
// borrowed.
typedef struct glint_view_request {
    const char *camera; // name or index
    place_request eye, look_at, up;
    double fov; // degrees; 0: the camera's own angle
    angle_request elevation;
    bool fit;
    bool turns; // set by the command: the camera circles the scene, and every position must fit
} glint_view_request;

glint_option_parser glint_parse_direction, glint_parse_elevation;

// Option rows for a request with a glint_view_request at `member`.
#define GLINT_VIEW_OPTIONS(member)                                                                 \
    {GLINT_OPTION_HEADING, .help = "Camera"},                                                      \
        {GLINT_OPTION_TEXT,                                                                        \
         .name = "camera",                                                                         \
         .argument = "NAME|INDEX",                                                                 \
         .help = "The camera. render also takes all: one file for each camera, with the camera's " \
                 "name before the frame's number or the extension (car.front.png).",               \
         .fallback = "the first; without any, one that sees the scene as by --fit",                \
         .offset = (member) + offsetof(glint_view_request, camera)},                               \
        {GLINT_OPTION_CUSTOM,                                                                      \
         .name = "eye",                                                                            \
         .argument = "X,Y,Z",                                                                      \
         .help = "Position of a perspective camera of your own, in metres of the scene's world. "  \
                 "It replaces the file's cameras.",                                                \
         .offset = (member) + offsetof(glint_view_request, eye),                                   \
         .parse = place_option_parse},                                                             \
        {GLINT_OPTION_CUSTOM,                                                                      \
         .name = "look-at",                                                                        \
         .argument = "X,Y,Z",                                                                      \
         .help = "With --eye, the point in the middle of the picture.",                            \
         .fallback = "the middle of the scene's bounds",                                           \
         .offset = (member) + offsetof(glint_view_request, look_at),                               \
         .parse = place_option_parse},                                                             \
        {GLINT_OPTION_CUSTOM,                                                                      \
         .name = "up",                                                                             \
         .argument = "X,Y,Z",                                                                      \
         .help = "With --eye, the direction that points up in the picture.",                       \
         .fallback = "0,1,0; straight down 0,0,-1, straight up 0,0,1",                             \
         .offset = (member) + offsetof(glint_view_request, up),                                    \
         .parse = glint_parse_direction},                                                          \
        {GLINT_OPTION_REAL,                                                                        \
         .name = "fov",                                                                            \
         .argument = "DEG",                                                                        \
         .help = "The vertical angle of view of a perspective camera.",                            \
         .fallback = "the camera's; 40 with --eye",                                                \
         .offset = (member) + offsetof(glint_view_request, fov),                                   \
         .minimum = 0.001,                                                                         \
         .maximum = 179.9},                                                                        \
        {GLINT_OPTION_CUSTOM,                                                                      \
         .name = "elevation",                                                                      \
         .argument = "DEG",                                                                        \
         .help = "Place the camera DEG degrees above (negative: below) the middle of the scene's " \
                 "bounds, and look at the middle. Compass direction and distance stay. Works "     \
                 "with turntables, too.",                                                          \
         .offset = (member) + offsetof(glint_view_request, elevation),                             \
         .parse = glint_parse_elevation},                                                          \
    {                                                                                              \
        GLINT_OPTION_FLAG,                                                                         \
            .name = "fit",                                                                         \
            .help = "Move the camera, without turning it, until the scene fills the frame and is " \
                    "centred. Animated scenes fit at all times, turntables in all positions.",     \
            .offset = (member) + offsetof(glint_view_request, fit)                                 \
    }

// Checks that the options go together. Errors: GLINT_USAGE.
glint_status glint_view_request_check(const glint_view_request *request, glint_error *error);

// The camera and its framing. Both come from the whole scene, so that pictures of its parts fit
// together.
typedef struct glint_viewpoint {
    glint_camera camera; // the scene owns its strings
    // bounds of the visible scene (metres, world space); low > high if it is empty
    glint_vec3 low, high;
    glint_vec3 centre; // middle of the bounds; a turntable turns around it
    double aspect;     // width / height of the frame
    bool moves;        // triangles move over time
} glint_viewpoint;

// Sets the bounds and the centre. Call it before nodes are removed. aspect and moves must be set.
void glint_viewpoint_measure(const glint_scene *scene, glint_viewpoint *viewpoint);

// Finds the camera in a measured scene. Errors: as glint_scene_camera; GLINT_USAGE if the options
// do not suit the scene.
glint_status glint_viewpoint_find(const glint_view_request *request, const glint_scene *scene,
                                  glint_viewpoint *viewpoint, glint_error *error);

#endif
