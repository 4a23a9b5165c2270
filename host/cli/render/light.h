// What lights a run's frames: one environment for all, a file for each, or one that is captured
// from the scene. For render_run alone.
#ifndef GLINT_CLI_RENDER_LIGHT_H
#define GLINT_CLI_RENDER_LIGHT_H

#include "cli/common/inputs.h"
#include "cli/render/request.h"
#include "render/frame.h"
#include "report/frame/fingerprint.h"

#include <stdbool.h>

typedef struct render_run render_run;

// Zero is valid. The environment itself is the run's (inputs.environment).
typedef struct render_light {
    glint_fingerprint is;      // of what the frame that stands is to have
    glint_fingerprint loaded;  // of what there is
    glint_fingerprint shown;   // of what the renderer has
    glint_fingerprint weighed; // of what --max-error has been told of
    bool has_file;             // of frame `frame`: what there is is its file's
    int frame;
    // Of captures:
    glint_environment surroundings; // behind all that is captured
    glint_fingerprint surroundings_are;
    bool stands; // the scene below is that of the run's time
    double time;
    glint_scene scene; // without what is lit
    glint_fingerprint scene_is;
    glint_vec3 at; // where it is captured from (metres, world space)
    glint_proxy proxy;
    glint_renderer *capturer; // of that scene; NULL before the first capture
    glint_fingerprint capturer_shows;
} render_light;

// Loads what all frames share. Errors: as glint_inputs_load_environment.
glint_status render_light_load(render_run *run, glint_error *error);

// Loads what a run would begin with, its environment or that of the frame `first`, for whoever
// wants to know whether it can. Errors likewise.
glint_status render_light_try(const render_request *request, int first,
                              glint_progress_display *display, glint_inputs *inputs,
                              glint_error *error);

// Finds what is to light a frame, at which the run's scene stands; its file is loaded, a capture is
// only prepared. Errors: as loading.
glint_status render_light_set(render_run *run, int frame, glint_error *error);

// Makes that the run's environment, and the renderer's, if there is one. Errors: as rendering.
glint_status render_light_show(render_run *run, glint_error *error);

void render_light_free(render_light *light);

#endif
