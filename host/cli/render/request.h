// What `glint render` was asked for: its options, and what can be found wrong with them before
// anything is loaded.
#ifndef GLINT_CLI_RENDER_REQUEST_H
#define GLINT_CLI_RENDER_REQUEST_H

#include "cli/common/inputs.h"
#include "cli/common/proxy_option.h"
#include "image/image_io.h"
#include "render/frame_list.h"
#include "render/frame_name.h"

#include <stdbool.h>

typedef struct render_request {
    glint_input_request inputs; // first: the shared tables' offsets count from here
    const char *output;
    const char *stats;
    const char *compression;
    double max_error; // of the picture; 0: as the settings say
    int exr_type;     // index of the choices
    double exposure;
    glint_tone tone;
    bool preview;             // a PNG beside the EXR
    const char *surroundings; // behind what is captured; NULL: the studio
    int capture_size;         // of a view
    proxy_request proxy;      // of the environment
    place_request env_at;     // where a file's was seen from
    int progress;             // a glint_progress_mode
    int progress_fd;          // where its JSON goes; 0: stderr
    const char *frames_text;
    int turntable; // frames of a whole turn; 0: the camera stays
    double fps;
    bool strict; // warnings are errors
    bool skip_existing;
    bool is_sequence;          // from here on set by render_request_finish
    const char *capture;       // the nodes that are lit by what is around them; NULL: a file is
                               // taken, and inputs.env is it; else inputs.env is the surroundings'
    double capture_rotate;     // degrees, of the surroundings
    glint_frame_name env_name; // of files for each frame; length 0: one for all
    const char *plate;         // NULL without one
    glint_frame_name plate_name;
    glint_frame_list frames;
    glint_shard shard;
    glint_frame_name name;
    char *folder;                  // of the output; owned
    char *preview_path;            // NULL without previews; owned
    glint_frame_name preview_name; // of preview_path
} render_request;

extern const glint_option *const render_option_groups[];

// Checks what the parser cannot see and completes the request, but for a sequence that is as long
// as the scene's animation. Errors: GLINT_USAGE, GLINT_OUTPUT_FAILED, GLINT_BAD_INPUT. Whatever the
// outcome, it is for render_request_free.
glint_status render_request_finish(render_request *request, glint_error *error);
void render_request_free(render_request *request);

// Once the scene is known: the frames, where they are those of its animation, and a warning where
// frames go beyond it. Errors: GLINT_USAGE where nothing says which frames there are.
glint_status render_request_settle(render_request *request, const glint_motion *motion,
                                   glint_warnings *warnings, glint_error *error);

// Seconds of the animation at a frame: frame 1 is its beginning.
double render_request_time(const render_request *request, int frame);

// How the image is encoded, without metadata and layers.
glint_write_options render_write_options(const render_request *request);

// Warns of what the chosen format cannot keep of this scene.
void render_request_warn(const render_request *request, const glint_scene *scene,
                         glint_warnings *warnings);

#endif
