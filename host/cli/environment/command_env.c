// Implements glint env: converts environments from one layout to another.
#include "cli/commands.h"
#include "cli/common/options.h"
#include "cli/common/say.h"

#include "base/clock.h"
#include "cli/common/env_output.h"
#include "cli/common/file_names.h"
#include "cli/common/inputs.h"
#include "environment/axes.h"
#include "environment/face_files.h"
#include "environment/sampler.h"
#include "environment/source.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define AXES_EDGE 512 // smallest edge of the cube for --probe, pixels

// The options of glint env.
typedef struct env_request {
    glint_layout_request env_as;
    env_output_request output;
    double rotate; // degrees
    const char *flip;
    bool probe, studio;
} env_request;

static const glint_option env_options[] = {
    {GLINT_OPTION_HEADING, .help = "What is read"},
    GLINT_ENV_AS_OPTIONS(offsetof(env_request, env_as)),
    {GLINT_OPTION_FLAG, .name = "probe",
     .help = "Instead of a file, the labelled axes: which way does a layout face?",
     .offset = offsetof(env_request, probe)},
    {GLINT_OPTION_FLAG, .name = "studio", .help = "Instead of a file, the built-in studio.",
     .offset = offsetof(env_request, studio)},
    GLINT_LARGE_IMAGES_OPTION,
    {GLINT_OPTION_HEADING, .help = "What is written"},
    ENV_OUTPUT_OPTIONS(offsetof(env_request, output), "the input's", "as fine as the input"),
    {GLINT_OPTION_REAL, .name = "env-rotate", .argument = "DEG",
     .help = "Turn the environment about +Y by degrees, counter-clockwise seen from above.",
     .fallback = "0", .offset = offsetof(env_request, rotate), .minimum = -1e6, .maximum = 1e6},
    {GLINT_OPTION_CUSTOM, .name = "flip", .argument = "AXES",
     .help = "Mirror it first: x exchanges left and right, y above and below, z front and back; "
             "xz is half a turn.",
     .offset = offsetof(env_request, flip), .parse = glint_parse_flip},
    GLINT_OPTION_END,
};

static const glint_option *const groups[] = {env_options, NULL};

// The state of a conversion. Zero is valid.
typedef struct conversion {
    const env_request *request;
    const char *input; // NULL: --probe or --studio
    const char *path;  // output
    env_output output;
    glint_source source;
    glint_cube axes;
    glint_environment studio;
    glint_sampler sampler;
    glint_warnings warnings;
} conversion;

// ---- What is read -------------------------------------------------------------------------------

static glint_status load(conversion *work, glint_error *error)
{
    const env_request *request = work->request;
    if (request->probe) {
        const int size = request->output.size, edge = size > AXES_EDGE ? size : AXES_EDGE;
        TRY(glint_axes_cube(edge < 4096 ? edge : 4096, &work->axes, error));
        work->sampler = glint_sampler_of_cube(&work->axes);
    } else if (request->studio) {
        TRY(glint_environment_studio(&work->studio, error));
        work->sampler = glint_sampler_of_cube(&work->studio.radiance);
    } else {
        TRY(glint_source_load(work->input, &request->env_as, &work->source, &work->warnings,
                              error));
        TRY(glint_sampler_of_image(&work->source.image, &work->source.chart, &work->sampler,
                                   error));
    }
    return GLINT_OK;
}

// ---- The request --------------------------------------------------------------------------------

// True if one of the six output files is the input or one of the input's six files.
static bool is_read_too(const conversion *work)
{
    glint_face_files read = {0};
    struct stat facts;
    if (stat(work->input, &facts) == 0 && S_ISDIR(facts.st_mode)) {
        glint_face_files_in_folder(work->input, &read, NULL);
    } else if (env_output_is_set(work->input)) {
        glint_face_files_by_pattern(work->input, &read, NULL);
    }
    bool is_found = false;
    for (int k = 0; k < 6; k++) {
        char *path = env_output_face_path(work->path, k);
        is_found = is_found || glint_same_file(path, work->input);
        for (int face = 0; face < 6; face++) {
            is_found = is_found || glint_same_file(path, read.paths[face]);
        }
        free(path);
    }
    glint_face_files_free(&read);
    return is_found;
}

static glint_status open_output(conversion *work, glint_error *error)
{
    const bool is_set = work->input != NULL && env_output_is_set(work->input);
    TRY(env_output_open(&work->request->output, work->path,
                        is_set ? GLINT_LAYOUT_FACES : GLINT_LAYOUT_UNKNOWN, &work->output, error));
    if (work->input != NULL && (glint_same_file(work->input, work->path) ||
                                (work->output.as_faces && is_read_too(work)))) {
        return glint_fail(error, GLINT_USAGE, "%s: this is the input (name another file)",
                          work->path);
    }
    return GLINT_OK;
}

static glint_status take_names(const glint_arguments *arguments, conversion *work,
                               glint_error *error)
{
    const env_request *request = work->request;
    const bool has_input = !request->probe && !request->studio;
    if (request->probe && request->studio) {
        return glint_fail(error, GLINT_USAGE, "--studio: --probe is given too (give one)");
    }
    if (arguments->positional_count != 1 + has_input) {
        return glint_fail(error, GLINT_USAGE, "%d files, where %s expected (see glint env --help)",
                          arguments->positional_count,
                          has_input ? "the input's and the output's names are"
                                    : "the output's name alone is");
    }
    if (!has_input && (request->env_as.layout != GLINT_LAYOUT_UNKNOWN)) {
        return glint_fail(error, GLINT_USAGE,
                          "--env-layout: it says how a file is read, but none is (use --to)");
    }
    work->input = has_input ? arguments->positionals[0] : NULL;
    work->path = arguments->positionals[has_input];
    return GLINT_OK;
}

static void say_done(const conversion *work, double ms)
{
    const glint_chart *from = &work->sampler.chart, *to = &work->output.chart;
    char source[128];
    if (work->input == NULL) {
        snprintf(source, sizeof source, "%s", work->request->probe ? "the axes" : "the studio");
    } else {
        snprintf(source, sizeof source, "%s %dx%d (%s)", glint_layout_name(from->layout),
                 from->width, from->height, work->source.reason);
    }
    glint_say("%s: %s %dx%d from %s, %.0f ms", work->path, glint_layout_name(to->layout), to->width,
              to->layout == GLINT_LAYOUT_FACES ? to->width : to->height, source, ms);
}

static glint_status convert(conversion *work, glint_error *error)
{
    const double begun = glint_now_ms();
    TRY(load(work, error));
    const glint_turn turn = glint_turn_of(work->request->rotate, work->request->flip);
    TRY(env_output_write(&work->output, &work->sampler, &turn, error));
    glint_say_warnings(&work->warnings, 0);
    say_done(work, glint_now_ms() - begun);
    return GLINT_OK;
}

static glint_status run(void *context, const glint_arguments *arguments, glint_error *error)
{
    conversion work = {.request = context, .path = ""};
    glint_status status;
    TRY_OR(cleanup, status, glint_layout_request_check(&work.request->env_as, error));
    TRY_OR(cleanup, status, take_names(arguments, &work, error));
    TRY_OR(cleanup, status, open_output(&work, error));
    TRY_OR(cleanup, status, convert(&work, error));
cleanup:
    glint_sampler_free(&work.sampler);
    glint_source_free(&work.source);
    glint_cube_free(&work.axes);
    glint_environment_free(&work.studio);
    glint_warnings_free(&work.warnings);
    return status;
}

const glint_command glint_command_env = {
    .name = "env",
    .summary = "convert an environment from one layout to another",
    .synopsis = "IN OUT [options]",
    .description =
        "Reads an environment in any layout (a file, a folder with six faces, or a pattern with %s "
        "for the face's name) and writes it in another layout. A pixel that covers several pixels "
        "of the input is their mean. Interpolation continues across the edges of faces, the poles "
        "and ±180 degrees. Directions that a layout does not hold are black.\nLat-long maps and "
        "cubes in EXR get OpenEXR's envmap attribute; their outermost pixels lie on the edges and "
        "poles. In all other files they lie half a pixel inside. EXR holds half floats, or floats "
        "if a value is above 65504.",
    .examples = "  glint env sky.hdr faces/ --to faces --size 512\n"
                "  glint env ball.jpg sky.exr --env-layout ball --ball-fov 12 --to latlong\n"
                "  glint env sky.exr sky_turned.exr --env-rotate 90\n"
                "  glint env --probe axes.png --to hcross\n",
    .groups = groups,
    .positional = "IN OUT",
    .takes_any_number = true,
    .request_size = sizeof(env_request),
    .run = run,
};
