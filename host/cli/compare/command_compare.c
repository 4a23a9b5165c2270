// Implements glint compare: measures how far a picture is from its reference.
#include "cli/commands.h"
#include "cli/common/options.h"

#include "cli/common/file_names.h"
#include "cli/common/inputs.h"
#include "cli/common/json_output.h"
#include "cli/compare/compare_table.h"
#include "image/image_io.h"
#include "image/metrics.h"
#include "image/output_file.h"
#include "report/compare/compare_json.h"
#include "report/compare/figures.h"
#include "report/compare/heat_map.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// The options of glint compare.
typedef struct compare_request {
    const char *image, *reference; // paths
    const char *output;            // path of the heat map; NULL: none
    int heat;                      // a glint_heat; −1: not given
    const char *json;              // "-" is stdout; NULL: none
    glint_bounds bounds;
} compare_request;

// ---- Options ------------------------------------------------------------------------------------

// Finds the figure called `name`; GLINT_FIGURE_COUNT if there is none.
static glint_figure find_figure(const char *name, size_t length)
{
    int i = 0;
    while (i < GLINT_FIGURE_COUNT && (strlen(glint_figure_names[i]) != length ||
                                      memcmp(glint_figure_names[i], name, length) != 0)) {
        i++;
    }
    return (glint_figure)i;
}

static glint_status fail_unknown_figure(const glint_option *option, const char *name,
                                        glint_error *error)
{
    const char *nearest = glint_nearest_word(name, glint_figure_names);
    if (nearest != NULL) {
        return glint_fail(error, GLINT_USAGE, "--%s: unknown metric %s (did you mean %s?)",
                          option->name, name, nearest);
    }
    return glint_fail(error, GLINT_USAGE,
                      "--%s: unknown metric %s (glint compare --help lists them)", option->name,
                      name);
}

// Parses METRIC=VALUE into glint_bounds.
static glint_status parse_bound(const glint_option *option, bool from_below, const char *text,
                                glint_bounds *bounds, glint_error *error)
{
    char name[64];
    const size_t length = strcspn(text, "=");
    if (length == 0 || text[length] == '\0') {
        return glint_fail(error, GLINT_USAGE, "--%s %s: %s is expected, as in %s=0.01",
                          option->name, text, option->argument, from_below ? "psnr" : "rmse");
    }
    snprintf(name, sizeof name, "%.*s", (int)length, text);
    const glint_figure figure = find_figure(text, length);
    if (figure == GLINT_FIGURE_COUNT) {
        return fail_unknown_figure(option, name, error);
    }
    const char *value = text + length + 1;
    double limit;
    if (!glint_parse_real(value, &limit) || !(limit >= 0)) {
        return glint_fail(error, GLINT_USAGE,
                          "--%s %s: a number from 0 is expected after %s=", option->name, text,
                          name);
    }
    if (glint_figure_is_better_high(figure) != from_below) {
        return glint_fail(error, GLINT_USAGE, "--%s %s: %s is better the %s it is (give --%s %s)",
                          option->name, text, name, from_below ? "lower" : "higher",
                          from_below ? "fail-above" : "fail-below", text);
    }
    bounds->is_set[figure] = true;
    bounds->limit[figure] = fabs(limit); // turns -0 into 0
    return GLINT_OK;
}

static glint_status parse_above(const glint_option *option, const char *text, void *destination,
                                glint_error *error)
{
    return parse_bound(option, false, text, destination, error);
}

static glint_status parse_below(const glint_option *option, const char *text, void *destination,
                                glint_error *error)
{
    return parse_bound(option, true, text, destination, error);
}

static const glint_option compare_options[] = {
    {GLINT_OPTION_HEADING, .help = "Verdict"},
    {GLINT_OPTION_CUSTOM, .name = "fail-above", .argument = "METRIC=VALUE",
     .help = "Exit with status 7 if the metric is above the value or not a number. Metrics: rmse, "
             "relative-rmse, mae, p99, max, differing, nan, infinite, alpha. Can be given once for "
             "each metric. Any bound also sets nan and infinite to 0, if they have no bound of "
             "their own.",
     .offset = offsetof(compare_request, bounds), .parse = parse_above},
    {GLINT_OPTION_CUSTOM, .name = "fail-below", .argument = "psnr=VALUE",
     .help = "Exit with status 7 if psnr, in dB, is below the value.",
     .offset = offsetof(compare_request, bounds), .parse = parse_below},
    {GLINT_OPTION_HEADING, .help = "Results"},
    {GLINT_OPTION_TEXT, .letter = 'o', .name = "output", .argument = "FILE",
     .help = "The heat map: each pixel's largest difference in colour, with a scale below. png, "
             "jpg, tiff or hdr; an exr gets the signed differences themselves, as float.",
     .offset = offsetof(compare_request, output)},
    {GLINT_OPTION_CHOICE, .name = "heat", .argument = "MEASURE",
     .help = "relative divides differences by the component of the reference, or by its mean if "
             "that is larger. absolute shows the differences themselves.",
     .fallback = "relative", .offset = offsetof(compare_request, heat),
     .choices = GLINT_CHOICES("relative", "absolute")},
    {GLINT_OPTION_TEXT, .name = "json", .argument = "FILE|-",
     .help = "Write the figures as JSON; - prints it instead of the table.",
     .offset = offsetof(compare_request, json)},
    {GLINT_OPTION_HEADING, .help = "Input"},
    GLINT_LARGE_IMAGES_OPTION,
    GLINT_OPTION_END,
};

static const glint_option *const groups[] = {compare_options, NULL};

// ---- The request --------------------------------------------------------------------------------

// Checks that an output can be written and replaces neither input.
static glint_status check_output(const compare_request *request, const char *option,
                                 const char *path, glint_error *error)
{
    if (glint_same_file(path, request->image) || glint_same_file(path, request->reference)) {
        return glint_fail(error, GLINT_USAGE, "--%s %s: this is an input (name another file)",
                          option, path);
    }
    return glint_output_file_check(path, error);
}

// Checks everything that can be checked before the pictures are read.
static glint_status check_request(const compare_request *request, glint_error *error)
{
    const bool writes_json = request->json != NULL && !glint_is_stdout(request->json);
    if (request->heat >= 0 && request->output == NULL) {
        return glint_fail(error, GLINT_USAGE,
                          "--heat: there is no heat map (name one: -o "
                          "heat.png)");
    }
    if (request->output != NULL) {
        TRY(glint_image_check_output(request->output, NULL, error));
    }
    if (writes_json && glint_same_file(request->json, request->output)) {
        return glint_fail(error, GLINT_USAGE, "--json %s: this is the heat map (name another file)",
                          request->json);
    }
    if (request->output != NULL) {
        TRY(check_output(request, "output", request->output, error));
    }
    if (writes_json) {
        TRY(check_output(request, "json", request->json, error));
    }
    return GLINT_OK;
}

// ---- The comparison -----------------------------------------------------------------------------

// The data of a comparison. Zero is valid.
typedef struct compare_work {
    glint_image image, reference;
    glint_metrics metrics;
} compare_work;

static glint_status load(const compare_request *request, compare_work *work, glint_error *error)
{
    const glint_image *image = &work->image, *reference = &work->reference;
    TRY(glint_image_read(request->image, &work->image, NULL, error));
    TRY(glint_image_read(request->reference, &work->reference, NULL, error));
    if (image->width != reference->width || image->height != reference->height) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: it is %dx%d pixels and %s %dx%d (give pictures of one size)",
                          request->image, image->width, image->height, request->reference,
                          reference->width, reference->height);
    }
    return GLINT_OK;
}

static glint_status write_heat_map(const compare_request *request, const compare_work *work,
                                   glint_error *error)
{
    const bool is_exr = glint_has_extension(request->output, ".exr");
    const glint_heat heat = request->heat > 0 ? (glint_heat)request->heat : GLINT_HEAT_RELATIVE;
    const glint_write_options options = {.exr_float = true};
    glint_image map = {0};
    glint_status status;
    TRY_OR(cleanup, status,
           is_exr ? glint_heat_map_differences(&work->image, &work->reference, heat, &map, error)
                  : glint_heat_map_paint(&work->image, &work->reference, heat, &map, error));
    TRY_OR(cleanup, status, glint_image_write(request->output, &map, &options, error));
cleanup:
    glint_image_free(&map);
    return status;
}

static glint_status compare(const compare_request *request, compare_work *work, glint_error *error)
{
    TRY(load(request, work, error));
    TRY(glint_metrics_find(&work->image, &work->reference, NULL, &work->metrics, error));
    if (request->output != NULL) {
        TRY(write_heat_map(request, work, error));
    }
    const glint_compare_result result = {.image = {request->image, &work->image},
                                         .reference = {request->reference, &work->reference},
                                         .metrics = &work->metrics,
                                         .bounds = &request->bounds};
    if (request->json != NULL) {
        TRY(glint_write_json(request->json, glint_compare_json(&result), error));
    }
    if (!glint_is_stdout(request->json)) {
        glint_compare_print(&result, stdout);
    }
    return glint_bounds_check(&request->bounds, &work->metrics, request->image, request->reference,
                              error);
}

static void set_defaults(void *request)
{
    ((compare_request *)request)->heat = -1;
}

static glint_status run(void *context, const glint_arguments *arguments, glint_error *error)
{
    compare_request *request = context;
    request->image = arguments->positionals[0];
    request->reference = arguments->positionals[1];
    glint_bounds_complete(&request->bounds);
    TRY(check_request(request, error));
    compare_work work = {0};
    const glint_status status = compare(request, &work, error);
    glint_image_free(&work.reference);
    glint_image_free(&work.image);
    return status;
}

const glint_command glint_command_compare = {
    .name = "compare",
    .summary = "measure how far a picture is from its reference",
    .synopsis = "IMAGE REFERENCE [options]",
    .description =
        "Compares two pictures of the same size in linear light, over R, G and B of the pixels "
        "that are finite in both. Grey counts as R = G = B. A picture without alpha has alpha 1. "
        "Pixels outside an EXR's data window are 0. 8-bit files are rounded, by at most half a "
        "step, 0.0045 of white. The exit status is 0 for any difference, unless a bound is given.",
    .examples = "  glint compare frame.exr reference.exr\n"
                "  glint compare frame.exr reference.exr -o heat.png\n"
                "  glint compare new.png old.png --fail-above relative-rmse=0.01 "
                "--fail-above max=0.2\n"
                "  glint compare new.png old.png --fail-below psnr=40 --json -\n",
    .groups = groups,
    .positional = "IMAGE",
    .second_positional = "REFERENCE",
    .request_size = sizeof(compare_request),
    .set_defaults = set_defaults,
    .run = run,
};
