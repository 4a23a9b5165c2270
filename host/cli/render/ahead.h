// A moving scene's next frame, loaded and made ready on a thread of its own while the device traces
// the one before.
#ifndef GLINT_CLI_RENDER_AHEAD_H
#define GLINT_CLI_RENDER_AHEAD_H

#include "cli/common/inputs.h"
#include "render/frame.h"
#include "report/frame/fingerprint.h"
#include "scene/scene.h"

#include <pthread.h>
#include <stdbool.h>

// A scene at a time, and what has been done for it.
typedef struct render_pose {
    double time;       // seconds of the animation
    glint_scene scene; // owned
    glint_viewpoint viewpoint;
    glint_fingerprint is; // of the scene
    bool is_loaded;       // the three are there
    bool is_prepared;     // glint_renderer_prepare was through with it
    double ms;            // that all this took
} render_pose;

// Loads what of the scene is asked for as it is at pose->time, with its fingerprint. Errors: as
// glint_scene_at and glint_inputs_stage; pose->scene is then empty.
glint_status render_pose_load(const glint_input_request *request, glint_scene_source *source,
                              render_pose *pose, glint_error *error);

// Zero is valid: nothing is under way. All but the source, the renderer and what it shows is the
// thread's while it is.
typedef struct render_ahead {
    const glint_input_request *request; // borrowed
    glint_scene_source *source;         // borrowed
    glint_renderer *renderer;           // borrowed
    glint_fingerprint shown;            // of the scene that the renderer shows
    bool with_tree;                     // not only the scene
    render_pose pose;
    pthread_t thread;
    bool is_under_way;
} render_ahead;

// Begins on the scene at a time: loads it and, with ahead->with_tree, prepares the renderer for it,
// unless that shows the same; does nothing while another is under way. Request, source and renderer
// must be set; they stay borrowed until render_ahead_take, and until then the renderer is given no
// other scene.
void render_ahead_begin(render_ahead *ahead, double time);

// Waits, and hands over what was loaded; whatever the outcome nothing is under way any more. False,
// with *pose unchanged, where nothing was or it did not come about: what fails ahead is to be tried
// again in its turn, for what it has to say.
bool render_ahead_take(render_ahead *ahead, double time, render_pose *pose);

#endif
