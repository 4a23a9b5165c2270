// Loads and prepares the next frame of a moving scene on its own thread, while the device traces
// the current frame.
#ifndef GLINT_CLI_RENDER_AHEAD_H
#define GLINT_CLI_RENDER_AHEAD_H

#include "cli/common/inputs.h"
#include "render/frame.h"
#include "report/frame/fingerprint.h"
#include "scene/scene.h"

#include <pthread.h>
#include <stdbool.h>

// A scene at one time, and how far its preparation is.
typedef struct render_pose {
    double time;       // seconds of the animation
    glint_scene scene; // owned
    glint_viewpoint viewpoint;
    glint_fingerprint is; // of the scene
    bool is_loaded;       // `scene`, `viewpoint` and `is` are set
    bool is_prepared;     // glint_renderer_prepare has succeeded
    double ms;            // time that all of this took
} render_pose;

// Loads the requested part of the scene at pose->time, and its fingerprint. Errors: as
// glint_scene_at and glint_inputs_stage; pose->scene is then empty.
glint_status render_pose_load(const glint_input_request *request, glint_scene_source *source,
                              render_pose *pose, glint_error *error);

// State of loading ahead. Zero is valid: the thread is not running. While it runs, it owns all
// members except `source`, `renderer` and `shown`.
typedef struct render_ahead {
    const glint_input_request *request; // borrowed
    glint_scene_source *source;         // borrowed
    glint_renderer *renderer;           // borrowed
    glint_fingerprint shown;            // of the scene that the renderer shows
    bool with_tree;                     // true: also prepare the renderer
    render_pose pose;
    pthread_t thread;
    bool is_under_way;
} render_ahead;

// Starts the thread for the scene at `time`. It loads the scene. With ahead->with_tree it also
// prepares the renderer, unless the renderer shows the same scene already. Does nothing if the
// thread is running. Request, source and renderer must be set and stay borrowed until
// render_ahead_take. Until then, the caller gives the renderer no other scene.
void render_ahead_begin(render_ahead *ahead, double time);

// Waits for the thread and hands over its scene. The thread is never running afterwards. False,
// with *pose unchanged, if there was no thread, or it failed or loaded another time. After a
// failure the caller loads the scene again to get the error message.
bool render_ahead_take(render_ahead *ahead, double time, render_pose *pose);

#endif
