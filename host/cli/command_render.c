// glint render: a scene and an environment become a frame.
#include "cli/cli.h"

#include "cli/file_names.h"
#include "cli/inputs.h"
#include "cli/progress.h"
#include "device/device.h"
#include "image/image_io.h"
#include "image/output_file.h"
#include "render/frame.h"
#include "report/frame_metadata.h"
#include "report/stats.h"

#include <stdio.h>
#include <string.h>

#define TRUNCATION_WORTH_SAYING 5e-3 // share of all weight

typedef struct render_request {
    glint_input_request inputs; // first: the shared tables' offsets count from here
    const char *output;
    const char *stats;
    const char *compression;
    int exr_type; // index into EXR_TYPES
    double exposure;
    int progress; // a glint_progress_mode
} render_request;

#define EXR_TYPES "half|float"

static uint32_t aov_by_name(const char *name)
{
    if (strcmp(name, "all") == 0) {
        return GLINT_AOV_ALL;
    }
    for (int i = 0; i < GLINT_AOV_COUNT; i++) {
        if (strcmp(name, glint_aov_name((glint_aov)i)) == 0) {
            return GLINT_AOV_BIT(i);
        }
    }
    return 0;
}

static glint_status fail_unknown_layer(const glint_option *option, const char *name,
                                       glint_error *error)
{
    const char *words[GLINT_AOV_COUNT + 2] = {"all"};
    char list[128] = "all";
    for (int i = 0; i < GLINT_AOV_COUNT; i++) {
        words[i + 1] = glint_aov_name((glint_aov)i);
        size_t length = strlen(list);
        snprintf(list + length, sizeof list - length, ", %s", words[i + 1]);
    }
    const char *nearest = glint_nearest_word(name, words);
    return nearest != NULL
               ? glint_fail(error, GLINT_USAGE, "--%s: there is no layer '%s' (did you mean %s?)",
                            option->name, name, nearest)
               : glint_fail(error, GLINT_USAGE, "--%s: there is no layer '%s' (there are %s)",
                            option->name, name, list);
}

// Names of layers between commas.
static glint_status parse_aovs(const glint_option *option, const char *text, void *destination,
                               glint_error *error)
{
    uint32_t aovs = 0;
    while (true) {
        const size_t length = strcspn(text, ",");
        char name[32];
        snprintf(name, sizeof name, "%.*s", (int)(length < sizeof name ? length : sizeof name),
                 text);
        const uint32_t found = aov_by_name(name);
        if (found == 0) {
            return fail_unknown_layer(option, name, error);
        }
        aovs |= found;
        if (text[length] == '\0') {
            break;
        }
        text += length + 1;
    }
    *(uint32_t *)destination = aovs;
    return GLINT_OK;
}

static const glint_option output_options[] = {
    {GLINT_OPTION_HEADING, .help = "Output"},
    {GLINT_OPTION_TEXT, .letter = 'o', .name = "output", .argument = "OUT",
     .help =
         "The image to write, by its extension: exr, hdr, png, jpg or tiff. It appears whole or "
         "not at all.",
     .offset = offsetof(render_request, output)},
    {GLINT_OPTION_REAL, .name = "exposure", .argument = "EV",
     .help = "Stops of exposure for PNG, JPEG and TIFF; EXR and HDR stay linear.", .fallback = "0",
     .offset = offsetof(render_request, exposure), .minimum = -100, .maximum = 100},
    {GLINT_OPTION_TEXT, .name = "compression", .argument = "NAME",
     .help = "EXR: none, rle, zip, zips, piz, pxr24, b44, b44a, dwaa, dwab. TIFF: none, lzw, zip, "
             "packbits. PNG: a level from 0 to 9. JPEG: a quality from 1 to 100.",
     .fallback = "the format's", .offset = offsetof(render_request, compression)},
    {GLINT_OPTION_CHOICE, .name = "exr-type", .argument = "TYPE",
     .help = "The picture's channels in an EXR: half or float.", .fallback = "half",
     .offset = offsetof(render_request, exr_type), .choices = EXR_TYPES},
    {GLINT_OPTION_CUSTOM, .name = "aov", .argument = "LIST",
     .help = "Layers that tell what became of each pixel's paths, as further channels of the EXR: "
             "depth (surfaces that the longest met), tir (total reflections), truncated (weight "
             "that was not traced to its end), triangle and material (what the primary ray met), "
             "face (of the environment, where the heaviest look-up fell); with commas between "
             "them, or all. With several samples depth is the maximum, tir and truncated are "
             "means, the others numbers from 0, −1 for none, of the sample in the middle.",
     .offset = offsetof(render_request, inputs.settings.aovs), .parse = parse_aovs},
    {GLINT_OPTION_TEXT, .name = "stats", .argument = "FILE.json",
     .help = "Write what the frame took and counted: phases in milliseconds, rays by kind, "
             "truncated light, the plan and the device.",
     .offset = offsetof(render_request, stats)},
    {GLINT_OPTION_CHOICE, .name = "progress", .argument = "MODE",
     .help = "On stderr: bar (redrawn), plain (lines), json (an object a line; warnings and errors "
             "stay text) or none; auto is bar "
             "on a terminal and plain elsewhere.",
     .fallback = "auto", .offset = offsetof(render_request, progress),
     .choices = GLINT_PROGRESS_CHOICES},
    GLINT_OPTION_END,
};

static const glint_option *const groups[] = {output_options,           glint_input_options,
                                             glint_size_options,       glint_settings_options,
                                             glint_kernel_dir_options, NULL};

// Everything a run holds. Zero is valid.
typedef struct render_work {
    glint_progress_display display;
    glint_inputs inputs;
    glint_device *device;
    glint_renderer *renderer;
    glint_image image;
    glint_layers layers;
    glint_frame_report report;
    double encode_ms;
} render_work;

static glint_write_options write_options(const render_request *request)
{
    return (glint_write_options){.exr_float = request->exr_type == 1,
                                 .compression = request->compression,
                                 .exposure = (float)request->exposure};
}

// An output that would replace an input, or another output.
static glint_status check_distinct(const render_request *request, glint_error *error)
{
    const char *const written[] = {request->output, request->stats};
    const char *const options[] = {"--output", "--stats"};
    for (int i = 0; i < 2; i++) {
        if (glint_same_file(written[i], request->inputs.scene) ||
            glint_same_file(written[i], request->inputs.env)) {
            return glint_fail(error, GLINT_USAGE, "%s %s: this is an input (name another file)",
                              options[i], written[i]);
        }
    }
    if (glint_same_file(request->output, request->stats)) {
        return glint_fail(error, GLINT_USAGE, "--stats %s: this is the image (name another file)",
                          request->stats);
    }
    return GLINT_OK;
}

// All that can be found wrong before anything is loaded.
static glint_status check_request(render_request *request, glint_error *error)
{
    if (request->output == NULL) {
        return glint_fail(error, GLINT_USAGE, "no output (name one: -o frame.exr)");
    }
    const glint_write_options options = write_options(request);
    bool is_exr = glint_has_extension(request->output, ".exr");
    glint_status status = glint_image_check_output(request->output, &options, error);
    if (status == GLINT_OK) {
        status = glint_input_request_finish(&request->inputs, error);
    }
    if (status == GLINT_OK && request->exr_type != 0 && !is_exr) {
        status = glint_fail(error, GLINT_USAGE, "--exr-type: %s is no EXR", request->output);
    }
    if (status == GLINT_OK && request->inputs.settings.aovs != 0 && !is_exr) {
        status = glint_fail(error, GLINT_USAGE, "--aov: %s is no EXR, which alone holds layers",
                            request->output);
    }
    if (status == GLINT_OK) {
        status = check_distinct(request, error);
    }
    if (status == GLINT_OK) {
        status = glint_output_file_check(request->output, error);
    }
    if (status == GLINT_OK && request->stats != NULL) {
        status = glint_output_file_check(request->stats, error);
    }
    return status;
}

// What the chosen format cannot keep.
static void warn_of_format(const render_request *request, glint_warnings *warnings)
{
    const char *output = request->output;
    bool is_hdr = glint_has_extension(output, ".hdr");
    bool is_jpeg = glint_has_extension(output, ".jpg") || glint_has_extension(output, ".jpeg");
    if (request->exposure != 0 && (is_hdr || glint_has_extension(output, ".exr"))) {
        glint_warn(warnings, "%s: --exposure is left out, this format stays linear", output);
    }
    if (request->inputs.settings.transparent && (is_hdr || is_jpeg)) {
        glint_warn(warnings, "%s: this format keeps no alpha, the background becomes black",
                   output);
    }
}

static void warn_of_layers(const render_request *request, const glint_scene *scene,
                           glint_warnings *warnings)
{
    if ((request->inputs.settings.aovs & GLINT_AOV_BIT(GLINT_AOV_TRIANGLE)) != 0 &&
        scene->triangle_count > GLINT_AOV_TRIANGLES_EXACT) {
        glint_warn(warnings, "%s: the layer 'triangle' rounds numbers above %u, by 4 at most",
                   request->output, GLINT_AOV_TRIANGLES_EXACT);
    }
}

static bool step(void *context, uint64_t done, uint64_t total)
{
    glint_progress_step(context, done, total);
    return !glint_stop_requested();
}

static glint_status create_renderer(const render_request *request, render_work *work,
                                    glint_error *error)
{
    glint_status status = glint_device_open(request->inputs.device, &work->device, error);
    if (status != GLINT_OK) {
        return status;
    }
    glint_progress_phase(&work->display, "prepare", "building the tree and the kernels");
    const glint_renderer_inputs inputs = {
        .device = work->device,
        .scene = &work->inputs.scene,
        .environment = &work->inputs.environment,
        .settings = &request->inputs.settings,
        .kernel_dir = request->inputs.kernel_dir,
    };
    return glint_renderer_create(&inputs, &work->renderer, error);
}

static glint_status render_frame(const render_request *request, render_work *work,
                                 glint_error *error)
{
    const glint_settings *settings = &request->inputs.settings;
    char plan[256];
    char text[GLINT_MESSAGE_CAPACITY];
    glint_plan_describe(glint_renderer_plan(work->renderer), plan, sizeof plan);
    snprintf(text, sizeof text, "rendering %dx%d on %s (%s)", settings->width, settings->height,
             glint_device_capabilities(work->device)->name, plan);
    double samples = (double)settings->samples_per_axis * settings->samples_per_axis;
    glint_progress_frame(&work->display, samples * settings->width * settings->height, text);

    const glint_progress progress = {step, &work->display};
    glint_signals_cooperate(true);
    glint_status status = glint_renderer_frame(work->renderer, &work->inputs.camera, &progress,
                                               &work->image, &work->report, error);
    glint_signals_cooperate(false);
    if (status == GLINT_OK && glint_stop_requested()) {
        status = glint_fail(error, GLINT_INTERRUPTED, "stopped");
    }
    if (status == GLINT_OK && settings->aovs != 0) {
        status = glint_renderer_layers(work->renderer, &work->layers, error);
    }
    glint_progress_clear(&work->display);
    return status;
}

static glint_subject subject_of(const render_request *request, const render_work *work)
{
    return (glint_subject){
        .scene = &work->inputs.scene,
        .environment = &work->inputs.environment,
        .camera = &work->inputs.camera,
        .settings = &request->inputs.settings,
        .device = glint_device_capabilities(work->device),
        .plan = glint_renderer_plan(work->renderer),
        .bvh = glint_renderer_bvh(work->renderer),
        .warnings = &work->inputs.warnings,
    };
}

static glint_status write_image(const render_request *request, render_work *work,
                                glint_error *error)
{
    double begun = glint_progress_elapsed(&work->display);
    glint_progress_phase(&work->display, "encode", "writing the image");
    const glint_subject subject = subject_of(request, work);
    glint_frame_metadata metadata;
    glint_frame_metadata_fill(&subject, 1, request->exposure,
                              work->report.kernel_ms + work->report.readback_ms, &metadata);
    glint_write_options options = write_options(request);
    options.metadata = metadata.entries;
    options.metadata_count = metadata.count;
    options.channels = work->layers.channels;
    options.channel_count = work->layers.count;
    glint_status status = glint_image_write(request->output, &work->image, &options, error);
    work->encode_ms = glint_progress_elapsed(&work->display) - begun;
    return status;
}

static glint_status write_stats(const render_request *request, const render_work *work,
                                glint_error *error)
{
    const glint_subject subject = subject_of(request, work);
    const glint_stats stats = {
        .subject = &subject,
        .output = request->output,
        .phases = glint_renderer_phases(work->renderer),
        .frame = &work->report,
        .load_scene_ms = work->inputs.scene_ms,
        .load_environment_ms = work->inputs.environment_ms,
        .encode_ms = work->encode_ms,
        .total_ms = glint_progress_elapsed(&work->display),
        .exposure = request->exposure,
    };
    return glint_stats_write(request->stats, &stats, error);
}

static const char *truncation_advice(const glint_truncation *truncation)
{
    if (truncation->by_stack > truncation->by_depth + truncation->by_min_weight) {
        return "a larger --min-weight leaves fewer branches waiting";
    }
    return truncation->by_depth >= truncation->by_min_weight
               ? "a greater --depth follows it further"
               : "a smaller --min-weight, say 1e-5, follows it further";
}

// What the frame's figures give cause to say.
static void warn_of_report(const glint_frame_report *report, glint_warnings *warnings)
{
    const glint_truncation *truncation = &report->truncation;
    if (report->nonfinite_pixels > 0) {
        glint_warn(warnings, "%llu pixels are not finite",
                   (unsigned long long)report->nonfinite_pixels);
    }
    if (truncation->media_overflows > 0) {
        glint_warn(warnings, "solids nest too deep: %llu paths forgot one that they were in",
                   (unsigned long long)truncation->media_overflows);
    }
    if (glint_stats_truncated(truncation) > TRUNCATION_WORTH_SAYING) {
        glint_warn(warnings,
                   "%.2g%% of the light took the environment before its path had ended (%s)",
                   100 * glint_stats_truncated(truncation), truncation_advice(truncation));
    }
}

static void say_summary(const render_request *request, const render_work *work)
{
    const glint_progress_display *display = &work->display;
    const glint_phases *phases = glint_renderer_phases(work->renderer);
    double total = glint_progress_elapsed(display);
    double rate = (double)glint_stats_rays(&work->report.rays) / work->report.kernel_ms * 1e-3;
    if (display->mode == GLINT_PROGRESS_JSON) {
        fprintf(stderr, "{\"event\": \"done\", \"ms\": %.1f}\n", total);
    } else if (display->mode != GLINT_PROGRESS_NONE) {
        glint_say("%s: %dx%d, %.0f ms (load %.0f, tree %.0f, kernels %.0f, trace %.0f, encode "
                  "%.0f), %.3g Mrays/s",
                  request->output, work->image.width, work->image.height, total,
                  work->inputs.scene_ms + work->inputs.environment_ms, phases->bvh,
                  phases->kernel_build, work->report.kernel_ms, work->encode_ms, rate);
    }
}

static glint_status render(const render_request *request, render_work *work, glint_error *error)
{
    glint_status status = glint_inputs_load(&request->inputs, &work->display, &work->inputs, error);
    glint_progress_clear(&work->display);
    if (status != GLINT_OK) {
        return status;
    }
    warn_of_format(request, &work->inputs.warnings);
    warn_of_layers(request, &work->inputs.scene, &work->inputs.warnings);
    glint_say_warnings(&work->inputs.warnings, 0);
    size_t said = work->inputs.warnings.count;

    status = create_renderer(request, work, error);
    if (status == GLINT_OK) {
        status = render_frame(request, work, error);
    }
    if (status == GLINT_OK) {
        status = write_image(request, work, error);
    }
    glint_progress_clear(&work->display);
    if (status != GLINT_OK) {
        return status;
    }
    warn_of_report(&work->report, &work->inputs.warnings);
    glint_say_warnings(&work->inputs.warnings, said);
    if (request->stats != NULL) {
        status = write_stats(request, work, error);
    }
    if (status == GLINT_OK) {
        say_summary(request, work);
    }
    return status;
}

static void set_defaults(void *request)
{
    glint_input_request_default(&((render_request *)request)->inputs);
}

static glint_status run(void *context, const glint_arguments *arguments, glint_error *error)
{
    render_request *request = context;
    request->inputs.scene = arguments->positionals[0];
    glint_status status = check_request(request, error);
    if (status != GLINT_OK) {
        return status;
    }
    render_work work = {0};
    glint_progress_begin(&work.display, (glint_progress_mode)request->progress);
    status = render(request, &work, error);
    glint_progress_clear(&work.display);
    glint_image_free(&work.image);
    glint_layers_free(&work.layers);
    glint_renderer_free(work.renderer);
    glint_device_close(work.device);
    glint_inputs_free(&work.inputs);
    return status;
}

const glint_command glint_command_render = {
    .name = "render",
    .summary = "render a frame of a glTF scene",
    .synopsis = "SCENE -o OUT [options]",
    .description = "Renders the glTF scene (.gltf or .glb) as one frame. Metal reflects, glass "
                   "reflects and refracts, paint is lit by the environment; what the scene does "
                   "not need is not compiled. stdout stays empty.",
    .examples = "  glint render scenes/gallery.gltf -o gallery.png\n"
                "  glint render car.glb --env studio.hdr --env-rotate 90 --samples 16 -o car.exr\n"
                "  glint render jewel.glb --depth 8 --background transparent -o jewel.exr\n",
    .groups = groups,
    .positional = "SCENE",
    .request_size = sizeof(render_request),
    .set_defaults = set_defaults,
    .run = run,
};
