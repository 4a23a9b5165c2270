// Holds and checks the options of glint render, before anything is loaded.
#ifndef GLINT_CLI_RENDER_REQUEST_H
#define GLINT_CLI_RENDER_REQUEST_H

#include "cli/common/frame_list.h"
#include "cli/common/frame_name.h"
#include "cli/common/inputs.h"
#include "cli/common/proxy_option.h"
#include "image/image_io.h"

#include <stdbool.h>

// The options of glint render, and what follows from them.
typedef struct render_request {
    glint_input_request inputs; // first: the shared tables' offsets count from here
    const char *output;         // render_request_finish removes the backslashes that escape
    const char *stats;
    const char *compression;
    double max_error; // relative RMSE; 0: the settings decide
    int exr_type;     // index into the choices: half, float
    double exposure;
    glint_tone tone;
    bool preview;             // write a PNG beside the EXR
    const char *surroundings; // environment behind a capture; NULL: the studio
    int capture_size;         // pixels along the edge of a captured view
    proxy_request proxy;      // distance of the environment
    place_request env_at;     // where the environment of a file was seen from
    int progress;             // a glint_progress_mode
    int progress_fd;          // destination of JSON progress; 0: stderr
    const char *frames_text;
    int turntable; // frames per full turn; 0: no turntable
    double fps;
    bool strict; // warnings are errors
    bool skip_existing;
    bool is_sequence; // render_request_finish sets the members from here on
    // nodes that a capture of their surroundings lights; inputs.env is then the file of the
    // surroundings. NULL: no capture
    const char *capture;
    double capture_rotate;     // rotation of the surroundings, degrees
    glint_frame_name env_name; // one environment file per frame; length 0: one for all
    const char *plate;         // path or pattern; NULL: none
    glint_frame_name plate_name;
    glint_frame_list frames;
    glint_shard shard;
    glint_frame_name name;
    char *folder;                  // folder of the output; owned
    glint_frame_name preview_name; // empty without previews
} render_request;

extern const glint_option *const render_option_groups[];

// Checks what the parser cannot check, and completes the request. If the scene's animation sets the
// number of frames, render_request_settle does this later. Free the request with
// render_request_free, also after an error. Errors: GLINT_USAGE, GLINT_OUTPUT_FAILED,
// GLINT_BAD_INPUT.
glint_status render_request_finish(render_request *request, glint_error *error);
void render_request_free(render_request *request);

// Completes the request with the loaded scene: takes the frames of the animation if none were
// named, and warns of frames beyond its end. Errors: GLINT_USAGE if nothing says which frames to
// render.
glint_status render_request_settle(render_request *request, const glint_motion *motion,
                                   glint_warnings *warnings, glint_error *error);

// The animation time of a frame in seconds; frame 1 is at 0.
double render_request_time(const render_request *request, int frame);

// The encoding of the image, without metadata and layers.
glint_write_options render_write_options(const render_request *request);

// Warns of information in this scene that the chosen format cannot keep.
void render_request_warn(const render_request *request, const glint_scene *scene,
                         glint_warnings *warnings);

#endif
