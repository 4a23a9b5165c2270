// Implements glint relight: lights a frame with another environment, from the directions that the
// frame kept.
#include "cli/commands.h"
#include "cli/common/options.h"
#include "cli/common/say.h"

#include "base/clock.h"
#include "cli/common/file_names.h"
#include "cli/common/inputs.h"
#include "cli/common/progress.h"
#include "cli/common/tone_options.h"
#include "image/image_io.h"
#include "image/output_file.h"
#include "render/terms.h"

#include <stdio.h>
#include <string.h>

#define DROPPED_WORTH_SAYING 1e-4 // share of the light's total weight

// The options of glint relight.
typedef struct relight_request {
    // first, for the offsets of shared rows; only the environment is used
    glint_input_request inputs;
    const char *output;
    const char *compression;
    int exr_type; // index into the choices: half, float
    double exposure;
    glint_tone tone;
    int progress;
} relight_request;

static const glint_option relight_options[] = {
    {GLINT_OPTION_HEADING, .help = "Environment"},
    {GLINT_OPTION_TEXT, .name = "env", .argument = "FILE",
     .help = "The environment, as for glint render.", .fallback = "a built-in studio",
     .offset = offsetof(relight_request, inputs.env)},
    GLINT_ENV_AS_OPTIONS(offsetof(relight_request, inputs.env_as)),
    {GLINT_OPTION_CUSTOM, .name = "env-flip", .argument = "AXES",
     .help = "Mirror the environment first, as glint render does.",
     .offset = offsetof(relight_request, inputs.env_flip), .parse = glint_parse_flip},
    GLINT_SETTINGS_ROW(GLINT_SETTINGS_OF_ENVIRONMENT, offsetof(relight_request, inputs.settings)),
    GLINT_LARGE_IMAGES_OPTION,
    {GLINT_OPTION_HEADING, .help = "Output"},
    {GLINT_OPTION_TEXT, .letter = 'o', .name = "output", .argument = "OUT",
     .help =
         "The image to write, by its extension: exr, hdr, png, jpg or tiff. It appears whole or "
         "not at all.",
     .offset = offsetof(relight_request, output)},
    EXPOSURE_OPTION(offsetof(relight_request, exposure)),
    TONE_OPTION(offsetof(relight_request, tone)),
    {GLINT_OPTION_TEXT, .name = "compression", .argument = "NAME", .help = "As for glint render.",
     .fallback = "the format's", .offset = offsetof(relight_request, compression)},
    {GLINT_OPTION_CHOICE, .name = "exr-type", .argument = "TYPE",
     .help = "The channels in an EXR: half or float.", .fallback = "half",
     .offset = offsetof(relight_request, exr_type), .choices = GLINT_CHOICES("half", "float")},
    {GLINT_OPTION_CHOICE, .name = "progress", .argument = "KIND",
     .help = "What is shown of the work on stderr: bar, plain lines, json lines or none.",
     .fallback = "a bar on a terminal, else plain lines",
     .offset = offsetof(relight_request, progress), .choices = GLINT_PROGRESS_CHOICES},
    GLINT_OPTION_END,
};

static const glint_option *const groups[] = {relight_options, NULL};

static glint_write_options write_options(const relight_request *request)
{
    return (glint_write_options){.exr_float = request->exr_type == 1,
                                 .compression = request->compression,
                                 .exposure = (float)request->exposure,
                                 .tone = request->tone};
}

static glint_status check_request(const relight_request *request, const char *path,
                                  glint_error *error)
{
    const glint_write_options options = write_options(request);
    if (request->output == NULL) {
        return glint_fail(error, GLINT_USAGE, "no output (name one: -o frame.exr)");
    }
    if (glint_same_file(request->output, path) ||
        glint_same_file(request->output, request->inputs.env)) {
        return glint_fail(error, GLINT_USAGE, "--output %s: this is an input (name another file)",
                          request->output);
    }
    if (request->exr_type != 0 && !glint_has_extension(request->output, ".exr")) {
        return glint_fail(error, GLINT_USAGE, "--exr-type: %s is no EXR", request->output);
    }
    if (request->inputs.env_as.layout != GLINT_LAYOUT_UNKNOWN && request->inputs.env == NULL) {
        return glint_fail(error, GLINT_USAGE,
                          "--env-layout: it says how a file is read, but no --env is given");
    }
    TRY(glint_layout_request_check(&request->inputs.env_as, error));
    TRY(glint_image_check_output(request->output, &options, error));
    return glint_output_file_check(request->output, error);
}

static void warn_of_dropped(const char *path, const glint_terms *terms)
{
    if (terms->dropped > DROPPED_WORTH_SAYING) {
        glint_say(
            "warning: %s: %.3g%% of the weight found no room in %d directions a pixel, and is "
            "missing (render with more: --directions %d)",
            path, 100 * terms->dropped, terms->capacity,
            terms->capacity * 2 < GLINT_TERMS_MAX ? terms->capacity * 2 : GLINT_TERMS_MAX);
    }
}

static glint_status light(const relight_request *request, const char *path, glint_terms *terms,
                          glint_inputs *inputs, glint_error *error)
{
    glint_progress_display display;
    glint_image image = {0};
    glint_progress_begin(&display, (glint_progress_mode)request->progress);
    glint_progress_phase(&display, "read", "reading the directions");
    // Read the directions and the environment.
    const double begun = glint_now_ms();
    double clock = begun;
    glint_status status;
    status = glint_terms_read(path, terms, error);
    if (status != GLINT_OK) {
        glint_progress_clear(&display);
        goto cleanup;
    }
    const double read_ms = glint_lap_ms(&clock);
    status = glint_inputs_load_environment(&request->inputs, &display, inputs, error);
    const double environment_ms = glint_lap_ms(&clock);
    glint_progress_clear(&display);
    if (status != GLINT_OK) {
        goto cleanup;
    }
    tone_options_warn(request->output, request->exposure, request->tone, &inputs->warnings);
    glint_say_warnings(&inputs->warnings, 0);
    warn_of_dropped(path, terms);
    // Light the frame.
    TRY_OR(cleanup, status,
           glint_terms_relight(terms, &inputs->environment, request->inputs.settings.env_rotate,
                               &image, error));
    const double light_ms = glint_lap_ms(&clock);
    const size_t nonfinite = glint_image_count_nonfinite(&image);
    if (nonfinite > 0) {
        glint_say("warning: %zu pixels are not finite", nonfinite);
    }
    // Write the image.
    const glint_write_options options = write_options(request);
    TRY_OR(cleanup, status, glint_image_write(request->output, &image, &options, error));
    if (display.mode != GLINT_PROGRESS_NONE && display.mode != GLINT_PROGRESS_JSON) {
        glint_say("%s: %dx%d, %d directions a pixel, %.0f ms (read %.0f, environment %.0f, light "
                  "%.0f, encode %.0f)",
                  request->output, image.width, image.height, terms->capacity,
                  glint_now_ms() - begun, read_ms, environment_ms, light_ms, glint_lap_ms(&clock));
    }
cleanup:
    glint_image_free(&image);
    return status;
}

static glint_status run(void *context, const glint_arguments *arguments, glint_error *error)
{
    const relight_request *request = context;
    const char *path = arguments->positionals[0];
    glint_terms terms = {0};
    glint_inputs inputs = {0};
    glint_status status;
    TRY_OR(cleanup, status, check_request(request, path, error));
    TRY_OR(cleanup, status, light(request, path, &terms, &inputs, error));
cleanup:
    glint_terms_free(&terms);
    glint_inputs_free(&inputs);
    return status;
}

static void set_defaults(void *request)
{
    glint_input_request_default(&((relight_request *)request)->inputs);
}

const glint_command glint_command_relight = {
    .name = "relight",
    .summary = "a frame under another environment, without tracing",
    .synopsis = "DIRECTIONS.exr -o OUT [options]",
    .description =
        "Lights a frame anew from the directions that its paths left along, which glint render "
        "keeps with --directions K: the sum of what another environment sends along them, times "
        "their weights. Where no direction was left out the picture is that of a render.",
    .examples = "  glint render scenes/gallery.gltf -o kept.exr --directions 12\n"
                "  glint relight kept.exr --env sunset.hdr -o sunset.png\n",
    .groups = groups,
    .positional = "DIRECTIONS",
    .request_size = sizeof(relight_request),
    .set_defaults = set_defaults,
    .run = run,
};
