// Declares the options of glint render. See request.h.
#include "cli/render/request.h"

#include "cli/common/progress.h"
#include "cli/common/tone_options.h"

#include <stdio.h>
#include <string.h>

#define EXR_TYPES GLINT_CHOICES("half", "float")

static glint_status parse_shard(const glint_option *option, const char *text, void *destination,
                                glint_error *error)
{
    (void)option;
    return glint_shard_parse(text, destination, error);
}

static const glint_option output_options[] = {
    {GLINT_OPTION_HEADING, .help = "Output"},
    {GLINT_OPTION_TEXT, .letter = 'o', .name = "output", .argument = "OUT",
     .help =
         "The image to write, by its extension: exr, hdr, png, jpg or tiff. It appears whole or "
         "not at all. Frames of a sequence take their number's place: frame.####.exr. \\# is the "
         "sign itself.",
     .offset = offsetof(render_request, output)},
    EXPOSURE_OPTION(offsetof(render_request, exposure)),
    TONE_OPTION(offsetof(render_request, tone)),
    {GLINT_OPTION_TEXT, .name = "compression", .argument = "NAME",
     .help = "EXR: none, rle, zip, zips, piz, pxr24, b44, b44a, dwaa, dwab. TIFF: none, lzw, zip, "
             "packbits. PNG: a level from 0 to 9. JPEG: a quality from 1 to 100.",
     .fallback = "the format's", .offset = offsetof(render_request, compression)},
    {GLINT_OPTION_CHOICE, .name = "exr-type", .argument = "TYPE",
     .help = "The picture's channels in an EXR: half or float.", .fallback = "half",
     .offset = offsetof(render_request, exr_type), .choices = EXR_TYPES},
    {GLINT_OPTION_FLAG, .name = "preview",
     .help = "Write a PNG beside each EXR, of the same name, with --exposure, --tone and the sRGB "
             "curve.",
     .offset = offsetof(render_request, preview)},
    GLINT_SETTINGS_ROW(GLINT_SETTINGS_OF_LAYERS, offsetof(render_request, inputs.settings)),
    {GLINT_OPTION_FLAG, .name = "strict",
     .help = "Treat warnings as errors. If there is a warning before the first frame (ignored or "
             "approximated features, solids that touch or overlap), render nothing and exit with "
             "status 3.",
     .offset = offsetof(render_request, strict)},
    {GLINT_OPTION_TEXT, .name = "stats", .argument = "FILE|-",
     .help = "Write measurements as JSON: phases in milliseconds, rays by kind, truncated light, "
             "plan and device. A sequence gets one object a line: the run, each frame when it is "
             "done, the total. - is stdout.",
     .offset = offsetof(render_request, stats)},
    {GLINT_OPTION_CHOICE, .name = "progress", .argument = "MODE",
     .help =
         "On stderr: bar (redrawn), plain (lines), json (an object a line) or none; auto is bar "
         "on a terminal and plain elsewhere. Warnings and errors stay text.",
     .fallback = "auto", .offset = offsetof(render_request, progress),
     .choices = GLINT_PROGRESS_CHOICES},
    {GLINT_OPTION_INT, .name = "progress-fd", .argument = "N",
     .help = "Write the objects of --progress json to the open file descriptor N instead of "
             "stderr: --progress json --progress-fd 3 3>events.",
     .fallback = "stderr", .offset = offsetof(render_request, progress_fd), .minimum = 1,
     .maximum = 1e6},
    GLINT_OPTION_END,
};

static const glint_option sequence_options[] = {
    {GLINT_OPTION_HEADING, .help = "Sequences"},
    {GLINT_OPTION_TEXT, .name = "frames", .argument = "LIST",
     .help = "Which frames: 7, 1-240, 1-10,20-40x2 (every second), 48-1x-1 (downwards); each once, "
             "in this order.",
     .fallback = "with --turntable N, 1-N; else the animation's",
     .offset = offsetof(render_request, frames_text)},
    {GLINT_OPTION_INT, .name = "turntable", .argument = "N",
     .help = "Turn the camera once around the middle of the scene in N frames, counter-clockwise "
             "seen from above. Frame 1 has the position of the camera itself.",
     .offset = offsetof(render_request, turntable), .minimum = 1, .maximum = GLINT_FRAME_MAX},
    {GLINT_OPTION_REAL, .name = "fps", .argument = "RATE",
     .help = "Frames a second of the animation; frame 1 is its beginning.", .fallback = "24",
     .offset = offsetof(render_request, fps), .minimum = 1e-3, .maximum = 1e5},
    {GLINT_OPTION_FLAG, .name = "skip-existing",
     .help = "Skip frames whose files are whole and come from the same scene, environment, "
             "settings and version. Render the others.",
     .offset = offsetof(render_request, skip_existing)},
    {GLINT_OPTION_CUSTOM, .name = "shard", .argument = "I/N",
     .help = "Render part I of N of the frames, from 1/N to N/N: every N-th, each in one part.",
     .fallback = "1/1", .offset = offsetof(render_request, shard), .parse = parse_shard},
    GLINT_OPTION_END,
};

static const glint_option error_options[] = {
    {GLINT_OPTION_REAL, .name = "max-error", .argument = "E",
     .help = "For each frame, choose the fastest precision, depth and least weight that keep the "
             "picture within a relative RMSE of E (0.01, for example) of a reference in double "
             "precision. The file names the choice and its error.",
     .instead_of = GLINT_SETTING_WEIGHS_ERRORS, .offset = offsetof(render_request, max_error),
     .minimum = 1e-9, .maximum = 10},
    GLINT_OPTION_END,
};

static const glint_option capture_options[] = {
    {GLINT_OPTION_TEXT, .name = "surroundings", .argument = "FILE",
     .help = "With --env capture:NODE, the environment behind the surroundings of the node. "
             "--env-layout and the other options of layouts then describe this file.",
     .fallback = "the built-in studio", .offset = offsetof(render_request, surroundings)},
    {GLINT_OPTION_INT, .name = "capture-size", .argument = "N",
     .help = "Edge of each of the six captured views, in pixels.", .fallback = "512",
     .offset = offsetof(render_request, capture_size), .minimum = 1, .maximum = 4096},
    {GLINT_OPTION_CUSTOM, .name = "proxy", .argument = "SHAPE",
     .help = "Put the environment at a finite distance, so that it shows parallax: sphere:RADIUS "
             "around the place where it was captured; a box in metres, x,y,z,x,y,z (two corners); "
             "or bounds, the box around the captured scene.",
     .fallback = "none: it is infinitely far away", .offset = offsetof(render_request, proxy),
     .parse = proxy_option_parse},
    {GLINT_OPTION_CUSTOM, .name = "env-at", .argument = "X,Y,Z",
     .help = "With --proxy, the place where the environment's file was captured.",
     .fallback = "0,0,0; of a capture its own place", .offset = offsetof(render_request, env_at),
     .parse = place_option_parse},
    GLINT_OPTION_END,
};

const glint_option *const render_option_groups[] = {output_options,           sequence_options,
                                                    glint_input_options,      capture_options,
                                                    glint_view_options,       glint_size_options,
                                                    glint_settings_options,   error_options,
                                                    glint_kernel_dir_options, NULL};
