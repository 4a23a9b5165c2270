// glint env: environments from one layout to another.
#include "cli/cli.h"

#include "base/clock.h"
#include "cli/file_names.h"
#include "cli/inputs.h"
#include "environment/axes.h"
#include "environment/sampler.h"
#include "environment/source.h"
#include "image/image_io.h"
#include "image/output_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define AXES_EDGE 512 // of --probe, where no size is given
#define HALF_MAX 65504.0f

typedef struct env_request {
    glint_layout_request env_as;
    glint_layout to; // UNKNOWN: as it is
    int size;        // 0: as fine as it is
    double rotate;   // degrees
    const char *flip;
    bool probe, studio;
    double exposure;
    const char *compression;
} env_request;

static glint_status parse_flip(const glint_option *option, const char *text, void *destination,
                               glint_error *error)
{
    if (text[strspn(text, "xyz")] != '\0') {
        return glint_fail(error, GLINT_USAGE, "--%s %s: axes are expected: x, y, z or several",
                          option->name, text);
    }
    *(const char **)destination = text;
    return GLINT_OK;
}

static const glint_option env_options[] = {
    {GLINT_OPTION_HEADING, .help = "What is read"},
    GLINT_ENV_AS_OPTIONS(offsetof(env_request, env_as)),
    {GLINT_OPTION_FLAG, .name = "probe",
     .help = "Instead of a file, the labelled axes: which way does a layout face?",
     .offset = offsetof(env_request, probe)},
    {GLINT_OPTION_FLAG, .name = "studio", .help = "Instead of a file, the built-in studio.",
     .offset = offsetof(env_request, studio)},
    {GLINT_OPTION_HEADING, .help = "What is written"},
    {GLINT_OPTION_CUSTOM, .name = "to", .argument = "LAYOUT",
     .help = "cube, faces (six files: OUT is a folder, or a pattern with %s), hcross, vcross, "
             "vstrip, hstrip, latlong, ball or angular.",
     .fallback = "the input's", .offset = offsetof(env_request, to), .parse = glint_parse_layout},
    {GLINT_OPTION_INT, .name = "size", .argument = "N",
     .help = "A face's edge, or the height of a lat-long map, a ball or an angular map, in pixels.",
     .fallback = "as fine as the input", .offset = offsetof(env_request, size), .minimum = 1,
     .maximum = GLINT_SIZE_MAX_PIXELS},
    {GLINT_OPTION_REAL, .name = "env-rotate", .argument = "DEG",
     .help = "Turn the environment about +Y by degrees, counter-clockwise seen from above.",
     .fallback = "0", .offset = offsetof(env_request, rotate), .minimum = -1e6, .maximum = 1e6},
    {GLINT_OPTION_CUSTOM, .name = "flip", .argument = "AXES",
     .help = "Mirror it first: x exchanges left and right, y above and below, z front and back; "
             "xz is half a turn.",
     .offset = offsetof(env_request, flip), .parse = parse_flip},
    {GLINT_OPTION_REAL, .name = "exposure", .argument = "EV",
     .help = "Stops of exposure for PNG, JPEG and TIFF; EXR and HDR stay linear.", .fallback = "0",
     .offset = offsetof(env_request, exposure), .minimum = -100, .maximum = 100},
    {GLINT_OPTION_TEXT, .name = "compression", .argument = "NAME",
     .help = "EXR: none, rle, zip, zips, piz, pxr24, b44, b44a, dwaa, dwab. TIFF: none, lzw, zip, "
             "packbits. PNG: a level 0 to 9. JPEG: a quality 1 to 100.",
     .fallback = "the format's", .offset = offsetof(env_request, compression)},
    GLINT_OPTION_END,
};

static const glint_option *const groups[] = {env_options, NULL};

// Everything between reading and writing. Zero is valid.
typedef struct conversion {
    const env_request *request;
    const char *input; // NULL: --probe or --studio
    const char *output;
    bool as_faces; // six files
    glint_source source;
    glint_cube axes;
    glint_environment studio;
    glint_sampler sampler;
    glint_chart chart; // of what is written
    glint_image image;
    glint_warnings warnings;
} conversion;

// ---- What is read -------------------------------------------------------------------------------

static glint_status load(conversion *work, glint_error *error)
{
    const env_request *request = work->request;
    glint_status status;
    if (request->probe) {
        const int edge = request->size > AXES_EDGE ? request->size : AXES_EDGE;
        status = glint_axes_cube(edge < 4096 ? edge : 4096, &work->axes, error);
        work->sampler = glint_sampler_of_cube(&work->axes);
    } else if (request->studio) {
        status = glint_environment_studio(&work->studio, error);
        work->sampler = glint_sampler_of_cube(&work->studio.radiance);
    } else {
        status =
            glint_source_load(work->input, &request->env_as, &work->source, &work->warnings, error);
        if (status == GLINT_OK) {
            status = glint_sampler_of_image(&work->source.image, &work->source.chart,
                                            &work->sampler, error);
        }
    }
    return status;
}

// ---- What is written ----------------------------------------------------------------------------

static bool is_exr(const char *path)
{
    return glint_has_extension(path, ".exr");
}

// OpenEXR's attribute, which says that the outermost centres lie on the edges, is written where
// there is one.
static glint_envmap envmap_of(const char *path, glint_layout layout)
{
    return !is_exr(path)                    ? GLINT_ENVMAP_NONE
           : layout == GLINT_LAYOUT_CUBE    ? GLINT_ENVMAP_CUBE
           : layout == GLINT_LAYOUT_LATLONG ? GLINT_ENVMAP_LATLONG
                                            : GLINT_ENVMAP_NONE;
}

// Six files where the output is a folder or a pattern, or the input was and nothing is asked for; a
// DDS, whose six faces are one file, is a strip.
static glint_layout layout_to_write(const conversion *work)
{
    const glint_layout asked = work->request->to, from = work->sampler.chart.layout;
    return work->as_faces                  ? GLINT_LAYOUT_FACES
           : asked != GLINT_LAYOUT_UNKNOWN ? asked
           : from == GLINT_LAYOUT_FACES    ? GLINT_LAYOUT_VSTRIP
                                           : from;
}

static glint_status plan_output(conversion *work, glint_error *error)
{
    const env_request *request = work->request;
    const glint_chart *from = &work->sampler.chart;
    const glint_layout to = layout_to_write(work);
    const bool on_edges = envmap_of(work->output, to) != GLINT_ENVMAP_NONE;
    int size = request->size;
    if (size == 0) {
        size = glint_chart_size_for(to, glint_chart_quarter_turn(from));
        size = on_edges && size < 2 ? 2 : size;
    }
    return glint_chart_make(to, size, on_edges, &work->chart, error);
}

// The strip's k-th face, in the order of the six names.
static glint_status cut_face(const glint_image *strip, int k, glint_image *face, glint_error *error)
{
    const int edge = strip->width;
    glint_status status = glint_image_create(edge, edge, strip->channels, face, error);
    if (status == GLINT_OK) {
        const size_t values = (size_t)edge * (size_t)edge * (size_t)strip->channels;
        memcpy(face->pixels, strip->pixels + (size_t)k * values, values * sizeof *face->pixels);
    }
    return status;
}

// posx.exr in a folder, or by a pattern.
static char *face_path(const char *output, int k)
{
    static const char *const names[6] = {"posx", "negx", "posy", "negy", "posz", "negz"};
    const char *gap = strstr(output, "%s");
    const size_t capacity = strlen(output) + 16;
    char *path = malloc(capacity);
    if (path != NULL && gap != NULL) {
        snprintf(path, capacity, "%.*s%s%s", (int)(gap - output), output, names[k], gap + 2);
    } else if (path != NULL) {
        snprintf(path, capacity, "%s/%s.exr", output, names[k]);
    }
    return path;
}

static glint_write_options write_options(const conversion *work, const char *path)
{
    const glint_image *image = &work->image;
    const size_t values = (size_t)image->width * (size_t)image->height * (size_t)image->channels;
    bool fits = true; // in half floats
    for (size_t i = 0; i < values && fits; i++) {
        fits = image->pixels[i] <= HALF_MAX;
    }
    return (glint_write_options){.exr_float = !fits,
                                 .compression = work->request->compression,
                                 .exposure = (float)work->request->exposure,
                                 .envmap = envmap_of(path, work->chart.layout)};
}

static glint_status write_faces(const conversion *work, glint_error *error)
{
    glint_status status = GLINT_OK;
    for (int k = 0; status == GLINT_OK && k < 6; k++) {
        glint_image face = {0};
        char *path = face_path(work->output, k);
        status = path != NULL ? cut_face(&work->image, k, &face, error)
                              : glint_fail_memory(error, "a file name");
        if (status == GLINT_OK) {
            const glint_write_options options = write_options(work, path);
            status = glint_image_write(path, &face, &options, error);
        }
        glint_image_free(&face);
        free(path);
    }
    return status;
}

static glint_status write_picture(const conversion *work, glint_error *error)
{
    if (work->chart.layout == GLINT_LAYOUT_FACES) {
        return write_faces(work, error);
    }
    const glint_write_options options = write_options(work, work->output);
    return glint_image_write(work->output, &work->image, &options, error);
}

// ---- The request --------------------------------------------------------------------------------

static glint_status make_folder(const char *folder, glint_error *error)
{
    struct stat facts;
    if (mkdir(folder, 0777) == 0 || (stat(folder, &facts) == 0 && S_ISDIR(facts.st_mode))) {
        return GLINT_OK;
    }
    return glint_fail(error, GLINT_OUTPUT_FAILED,
                      "%s: no folder could be made there: %s (name another)", folder,
                      strerror(errno));
}

// Where six files go, each of them is looked at before any work is done.
static glint_status check_faces(const char *output, const glint_write_options *options,
                                glint_error *error)
{
    glint_status status = strstr(output, "%s") == NULL ? make_folder(output, error) : GLINT_OK;
    for (int k = 0; status == GLINT_OK && k < 6; k++) {
        char *path = face_path(output, k);
        status = path == NULL ? glint_fail_memory(error, "a file name")
                              : glint_image_check_output(path, options, error);
        if (status == GLINT_OK) {
            status = glint_output_file_check(path, error);
        }
        free(path);
    }
    return status;
}

// A folder, or a pattern of files that are there or are to be.
static bool is_set_of_files(const char *path)
{
    struct stat facts;
    return stat(path, &facts) == 0 ? S_ISDIR(facts.st_mode) : strstr(path, "%s") != NULL;
}

static glint_status check_output(conversion *work, glint_error *error)
{
    const env_request *request = work->request;
    const glint_write_options options = {.compression = request->compression};
    if (work->input != NULL && glint_same_file(work->input, work->output)) {
        return glint_fail(error, GLINT_USAGE, "%s: this is the input (name another file)",
                          work->output);
    }
    const bool is_set = is_set_of_files(work->output);
    work->as_faces = request->to == GLINT_LAYOUT_FACES;
    if (request->to == GLINT_LAYOUT_UNKNOWN) {
        work->as_faces = is_set || (work->input != NULL && is_set_of_files(work->input));
    }
    if (work->as_faces) {
        return check_faces(work->output, &options, error);
    }
    if (is_set) {
        return glint_fail(error, GLINT_USAGE,
                          "%s: a %s is for six faces (with --to faces; the layout %s is one file)",
                          work->output, strstr(work->output, "%s") != NULL ? "pattern" : "folder",
                          glint_layout_name(request->to));
    }
    glint_status status = glint_image_check_output(work->output, &options, error);
    return status == GLINT_OK ? glint_output_file_check(work->output, error) : status;
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
    work->output = arguments->positionals[has_input];
    return GLINT_OK;
}

static void say_done(const conversion *work, double ms)
{
    const glint_chart *from = &work->sampler.chart, *to = &work->chart;
    char source[128];
    if (work->input == NULL) {
        snprintf(source, sizeof source, "%s", work->request->probe ? "the axes" : "the studio");
    } else {
        snprintf(source, sizeof source, "%s %dx%d (%s)", glint_layout_name(from->layout),
                 from->width, from->height, work->source.reason);
    }
    glint_say("%s: %s %dx%d from %s, %.0f ms", work->output, glint_layout_name(to->layout),
              to->width, to->layout == GLINT_LAYOUT_FACES ? to->width : to->height, source, ms);
}

static glint_status convert(conversion *work, glint_error *error)
{
    const double begun = glint_now_ms();
    glint_status status = load(work, error);
    if (status == GLINT_OK) {
        status = plan_output(work, error);
    }
    if (status == GLINT_OK) {
        const glint_turn turn = glint_turn_of(work->request->rotate, work->request->flip);
        status = glint_resample(&work->sampler, &turn, &work->chart, &work->image, error);
    }
    if (status == GLINT_OK) {
        status = write_picture(work, error);
    }
    glint_say_warnings(&work->warnings, 0);
    if (status == GLINT_OK) {
        say_done(work, glint_now_ms() - begun);
    }
    return status;
}

static glint_status run(void *context, const glint_arguments *arguments, glint_error *error)
{
    conversion work = {.request = context, .output = ""};
    glint_status status = glint_layout_request_check(&work.request->env_as, error);
    if (status == GLINT_OK) {
        status = take_names(arguments, &work, error);
    }
    if (status == GLINT_OK) {
        status = check_output(&work, error);
    }
    if (status == GLINT_OK) {
        status = convert(&work, error);
    }
    glint_sampler_free(&work.sampler);
    glint_source_free(&work.source);
    glint_cube_free(&work.axes);
    glint_environment_free(&work.studio);
    glint_image_free(&work.image);
    glint_warnings_free(&work.warnings);
    return status;
}

const glint_command glint_command_env = {
    .name = "env",
    .summary = "convert an environment from one layout to another",
    .synopsis = "IN OUT [options]",
    .description =
        "Reads an environment in any layout (a file, a folder that holds six faces, or a pattern "
        "with %s in the place of the face's name) and writes it in another. Where a pixel covers "
        "several of the input's it is their mean; across the edges of faces, the poles and the "
        "half turn it is interpolated. What a layout leaves open is black.\n"
        "Lat-long maps and cubes are written to EXR with OpenEXR's envmap attribute, whose pixels "
        "lie on the edges and poles; everywhere else they lie half a pixel within. EXR holds half "
        "floats, or floats where a value is above 65504.",
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
