// Where the commands write environments that they made: one picture or six, in any layout.
#ifndef GLINT_CLI_COMMON_ENV_OUTPUT_H
#define GLINT_CLI_COMMON_ENV_OUTPUT_H

#include "base/status.h"
#include "cli/common/options.h"
#include "cli/common/tone_options.h"
#include "environment/sampler.h"
#include "render/settings.h"

// What the command line says. Texts are borrowed from argv.
typedef struct env_output_request {
    glint_layout to; // UNKNOWN: as it is
    int size;        // 0: as fine as it is
    double exposure;
    const char *compression;
} env_output_request;

// Rows for a request with an env_output_request at `member`; `default_layout` and `default_size`
// are what the help calls them.
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
    glint_chart chart;                 // of what was written
} env_output;

// True for a folder, or a pattern of files that are there or are to be.
bool env_output_is_set(const char *path);

// The path of the k-th of six faces, in the order of their names: posx.exr in a folder, or by a
// pattern. malloc'd; NULL without memory.
char *env_output_face_path(const char *output, int k);

// Looks at where it goes, before any work is done; nothing is made yet. `source` is
// the layout that is written where none is asked for; FACES of six files, UNKNOWN where it is not
// known yet. Errors: GLINT_USAGE, GLINT_OUTPUT_FAILED.
glint_status env_output_open(const env_output_request *request, const char *path,
                             glint_layout source, env_output *output, glint_error *error);

// Draws what `from` shows, turned, and writes it. Of six files each appears whole or not at all.
// Errors: GLINT_USAGE (the size), GLINT_OUT_OF_MEMORY, GLINT_OUTPUT_FAILED.
glint_status env_output_write(env_output *output, const glint_sampler *from, const glint_turn *turn,
                              glint_error *error);

#endif
