// Declares --exposure and --tone, the tone mapping of files with 8 bits per channel.
#ifndef GLINT_CLI_COMMON_TONE_OPTIONS_H
#define GLINT_CLI_COMMON_TONE_OPTIONS_H

#include "base/status.h"
#include "cli/common/options.h"
#include "image/tone.h"

// An option row for a request with a double at `member`.
#define EXPOSURE_OPTION(member)                                                                    \
    {                                                                                              \
        GLINT_OPTION_REAL, .name = "exposure", .argument = "EV",                                   \
                           .help = "Stops of exposure for PNG, JPEG and TIFF; EXR and HDR stay "   \
                                   "linear.",                                                      \
                           .fallback = "0", .offset = (member), .minimum = -100, .maximum = 100    \
    }

// An option row for a request with a glint_tone at `member`.
#define TONE_OPTION(member)                                                                        \
    {                                                                                              \
        GLINT_OPTION_CHOICE,                                                                       \
            .name = "tone", .argument = "CURVE",                                                   \
            .help = "The tone curve of PNG, JPEG and TIFF, after --exposure: none "                \
                    "(light above 1 is clipped), pbr-neutral (Khronos: keeps base "                \
                    "colours, rolls off highlights) or agx (as in Blender: softer, "               \
                    "bright colours turn white). EXR and HDR stay linear.",                        \
            .fallback = "none", .offset = (member), .choices = glint_tone_names                    \
    }

// Warns of options that have no effect because the file at `path` stays linear.
void tone_options_warn(const char *path, double exposure, glint_tone tone,
                       glint_warnings *warnings);

#endif
