// Writes the environments that commands make: one picture or six faces, in any layout.
#ifndef GLINT_CLI_COMMON_ENV_OUTPUT_H
#define GLINT_CLI_COMMON_ENV_OUTPUT_H

#include "base/status.h"
#include "cli/common/options.h"
#include "cli/common/tone_options.h"
#include "environment/sampler.h"
#include "render/settings.h"

// The options of the command line. Texts are borrowed from argv.
typedef struct env_output_request {
    glint_layout to; // UNKNOWN: the source's layout
    int size;        // pixels; 0: the source's resolution
    double exposure;
    const char *compression;
} env_output_request;

// Option rows for a request with an env_output_request at `member`. The help shows `default_layout`
// and `default_size` as the defaults.
#define ENV_OUTPUT_OPTIONS(member, default_layout, default_size)                                   \
    {GLINT_OPTION_CUSTOM,                                                                          \
     .name = "to",                                                                                 \
     .argument = "LAYOUT",                                                                         \
     .help = "cube, faces (six files: OUT is a folder, or a pattern with %s), hcross, vcross, "    \
             "vstrip, hstrip, latlong, ball or angular.",                                          \
     .fallback = (default_layout),                                                                 \
     .offset = (member) + offsetof(env_output_request, to),                                        \
     .parse = glint_parse_layout},                                                                 \
        {GLINT_OPTION_INT,                                                                         \
         .name = "size",                                                                           \
         .argument = "N",                                                                          \
         .help = "A face's edge, or the height of a lat-long map, a ball or an angular map, in "   \
                 "pixels.",                                                                        \
         .fallback = (default_size),                                                               \
         .offset = (member) + offsetof(env_output_request, size),                                  \
         .minimum = 1,                                                                             \
         .maximum = GLINT_SIDE_MAX},                                                               \
        EXPOSURE_OPTION((member) + offsetof(env_output_request, exposure)),                        \
    {                                                                                              \
        GLINT_OPTION_TEXT,                                                                         \
            .name = "compression", .argument = "NAME",                                             \
            .help =                                                                                \
                "EXR: none, rle, zip, zips, piz, pxr24, b44, b44a, dwaa, dwab. TIFF: none, lzw, "  \
                "zip, packbits. PNG: a level 0 to 9. JPEG: a quality 1 to 100.",                   \
            .fallback = "the format's",                                                            \
            .offset = (member) + offsetof(env_output_request, compression)                         \
    }

typedef struct env_output {
    const env_output_request *request; // borrowed
    const char *path;                  // borrowed
    bool as_faces;                     // six files
    glint_chart chart;                 // layout and size of the written picture
} env_output;

// True if `path` stands for six files: a folder that exists, or a pattern with "%s" that is not
// itself a file.
bool env_output_is_set(const char *path);

// The path of face k, 0 to 5, in the order +X −X +Y −Y +Z −Z: "posx.exr" in a folder, or the
// pattern with "posx" for "%s". malloc'd; NULL without memory.
char *env_output_face_path(const char *output, int k);

// Checks the destination before any work is done; creates nothing yet. `source` is the layout to
// write if the request names none: FACES for six files, UNKNOWN if it is not known yet. Errors:
// GLINT_USAGE, GLINT_OUTPUT_FAILED.
glint_status env_output_open(const env_output_request *request, const char *path,
                             glint_layout source, env_output *output, glint_error *error);

// Resamples the environment `from`, rotated or mirrored by `turn`, and writes it. Each file appears
// whole or not at all. Errors: GLINT_USAGE (the size), GLINT_OUT_OF_MEMORY, GLINT_OUTPUT_FAILED.
glint_status env_output_write(env_output *output, const glint_sampler *from, const glint_turn *turn,
                              glint_error *error);

#endif
