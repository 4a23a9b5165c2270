// Implements glint bench: measures how fast scenes render, phase by phase, and the picture's error.
//
// Each scene is measured in its own process, which returns its entry of the report. So the peak
// memory belongs to one scene, and the driver's state does not carry over to the next scene. Table
// and comparison are made from the report.
#include "cli/commands.h"
#include "cli/common/options.h"
#include "cli/common/say.h"
#include "cli/common/signals.h"

#include "base/child.h"
#include "cli/bench/bench_error.h"
#include "cli/bench/bench_report.h"
#include "cli/common/file_names.h"
#include "cli/common/inputs.h"
#include "cli/common/json_output.h"
#include "cli/common/shell_word.h"
#include "image/output_file.h"
#include "report/bench/bench_json.h"
#include "report/speed_error/speed_error_json.h"
#include "scene/built_in.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

// The options of glint bench.
typedef struct bench_request {
    glint_input_request inputs; // first: the offsets in the shared tables refer to it
    bool list;
    double seconds; // 0: not given
    int rounds;     // 0: not given
    bool no_check;
    bool error; // measure the speed and error of every rung
    bool no_sampling;
    const char *html;
    const char *json; // "-" is stdout
    const char *baseline;
    double margin; // percent; negative: not given
} bench_request;

static const glint_option bench_options[] = {
    {GLINT_OPTION_HEADING, .help = "Measurement"},
    {GLINT_OPTION_REAL, .name = "seconds", .argument = "S",
     .help =
         "Measure each scene's frames for so long, after the warm-up, with --error those of each "
         "way; five frames at least.",
     .fallback = "5", .offset = offsetof(bench_request, seconds), .minimum = 0.001,
     .maximum = 86400},
    {GLINT_OPTION_INT, .name = "rounds", .argument = "N",
     .help = "Measure N frames instead, however long they take.",
     .offset = offsetof(bench_request, rounds), .minimum = 1, .maximum = 1e6},
    {GLINT_OPTION_FLAG, .name = "no-check",
     .help = "Do not compare the picture with double precision first. For series in which an "
             "earlier run compared it.",
     .offset = offsetof(bench_request, no_check)},
    {GLINT_OPTION_FLAG, .name = "error",
     .help = "Render each scene in up to a dozen ways, from colours at vertices to double "
             "precision, and show the time of each way beside its error.",
     .offset = offsetof(bench_request, error)},
    {GLINT_OPTION_FLAG, .name = "no-sampling",
     .help = "With --error, leave out more samples a pixel. They take as long as some 150 frames.",
     .offset = offsetof(bench_request, no_sampling)},
    {GLINT_OPTION_FLAG, .name = "list", .help = "List the built-in scenes and do nothing else.",
     .offset = offsetof(bench_request, list)},
    {GLINT_OPTION_HEADING, .help = "Results"},
    {GLINT_OPTION_TEXT, .name = "json", .argument = "FILE|-",
     .help = "Write everything as JSON; - prints it instead of the table.",
     .offset = offsetof(bench_request, json)},
    {GLINT_OPTION_TEXT, .name = "html", .argument = "FILE",
     .help = "With --error, write a page with a plot, and the picture of each way beside the "
             "reference.",
     .offset = offsetof(bench_request, html)},
    {GLINT_OPTION_TEXT, .name = "baseline", .argument = "FILE",
     .help = "Compare with the JSON of an earlier run on the same device, with the same settings.",
     .offset = offsetof(bench_request, baseline)},
    {GLINT_OPTION_REAL, .name = "margin", .argument = "PERCENT",
     .help = "Per cent. A scene is slower if its median is more than the margin above the "
             "baseline, and the middle halves of both series do not overlap.",
     .fallback = "10", .offset = offsetof(bench_request, margin), .minimum = 0, .maximum = 1e6},
    GLINT_OPTION_END,
};

static const glint_option size_options[] = {GLINT_SIZE_OPTIONS("1920x1080; with --error 640x360"),
                                            GLINT_OPTION_END};

static const glint_option *const groups[] = {
    bench_options, glint_input_options,    glint_view_options,
    size_options,  glint_settings_options, glint_kernel_dir_options,
    NULL};

// The state of a run. Zero is valid.
typedef struct bench_work {
    const bench_request *request;
    glint_progress_display display;
    bench_report report;
    char *command; // the command line; NULL without memory
} bench_work;

// True if the name is a built-in scene. A file of the same name takes precedence.
static bool is_built_in(const char *name)
{
    struct stat facts;
    bool is_name = false;
    for (size_t i = 0; glint_built_in_name(i) != NULL; i++) {
        is_name = is_name || strcmp(glint_built_in_name(i), name) == 0;
    }
    return is_name && !(stat(name, &facts) == 0 && S_ISREG(facts.st_mode));
}

// ---- One scene, in its own process -------------------------------------------------------------

// The measurement of one scene.
typedef struct scene_task {
    glint_input_request inputs;
    glint_bench_options options;
    bool error; // true: measure by error_options
    glint_speed_error_options error_options;
    glint_progress_display *display;
} scene_task;

// In the child: true if the child got a signal, or a signal ended its parent.
static bool stop_requested(void)
{
    return glint_stop_requested() || glint_child_is_abandoned();
}

static void show(void *context, const char *doing)
{
    const scene_task *task = context;
    char text[GLINT_MESSAGE_CAPACITY];
    snprintf(text, sizeof text, "%s: %s", task->inputs.scene, doing);
    glint_progress_phase(task->display, "bench", text);
}

static glint_status measure(scene_task *task, glint_inputs *loaded, char **text, glint_error *error)
{
    const glint_input_request *request = &task->inputs;
    const glint_bench_inputs inputs = {
        .device = request->device,
        .scene = &loaded->scene,
        .environment = &loaded->environment,
        .camera = &loaded->viewpoint.camera,
        .settings = &request->settings,
        .kernel_dir = request->kernel_dir,
    };
    const glint_bench_watcher watcher = {show, task, stop_requested};
    glint_bench_result result;
    glint_status status = glint_bench_measure(&inputs, &task->options, &watcher, &result, error);
    if (status != GLINT_OK) {
        return status;
    }
    if (result.check.outcome == GLINT_CHECK_NO_DOUBLE) {
        glint_warn(&loaded->warnings,
                   "device '%s' has no double precision: the picture is not checked",
                   result.device.name);
    }
    const glint_bench_scene scene = {
        .name = request->scene,
        .subject = {.scene = &loaded->scene,
                    .overrides = &request->overrides,
                    .environment = &loaded->environment,
                    .camera = &loaded->viewpoint.camera,
                    .settings = &request->settings,
                    .warnings = &loaded->warnings},
        .kernel_dir = request->kernel_dir,
        .load_scene_ms = loaded->scene_ms,
        .load_environment_ms = loaded->environment_ms,
    };
    return glint_json_print(glint_bench_scene_json(&scene, &result), text, error);
}

static glint_status measure_task(scene_task *task, glint_inputs *loaded, char **text,
                                 glint_error *error)
{
    if (!task->error) {
        return measure(task, loaded, text, error);
    }
    const glint_bench_watcher watcher = {show, task, stop_requested};
    const bench_error_task errors = {&task->inputs, loaded, &task->error_options, &watcher};
    return bench_error_measure(&errors, text, error);
}

static glint_status run_task(void *context, char **text, glint_error *error)
{
    scene_task *task = context;
    glint_inputs loaded;
    glint_status status;
    TRY_OR(cleanup, status, glint_inputs_load(&task->inputs, task->display, &loaded, error));
    status = measure_task(task, &loaded, text, error);
cleanup:
    glint_progress_clear(task->display);
    if (status == GLINT_OK) {
        glint_say_warnings(&loaded.warnings, 0);
    }
    glint_inputs_free(&loaded);
    return status;
}

// ---- All scenes --------------------------------------------------------------------------------

static glint_bench_options options_of(const bench_request *request)
{
    return (glint_bench_options){
        .seconds = request->seconds > 0 ? request->seconds : GLINT_BENCH_DEFAULT_SECONDS,
        .rounds = request->rounds,
        .no_check = request->no_check,
    };
}

static glint_speed_error_options error_options_of(const bench_request *request)
{
    return (glint_speed_error_options){
        .seconds = options_of(request).seconds,
        .rounds = request->rounds,
        .pictures = request->html != NULL,
        .no_sampling = request->no_sampling,
    };
}

// Measures a scene in a child. *entry becomes its entry of the report, a new reference.
static glint_status measure_scene(bench_work *work, const char *name, json_t **entry,
                                  glint_error *error)
{
    const bench_request *request = work->request;
    scene_task task = {
        .inputs = request->inputs,
        .options = options_of(request),
        .error = request->error,
        .error_options = error_options_of(request),
        .display = &work->display,
    };
    task.inputs.scene = name;
    task.inputs.is_built_in = is_built_in(name);
    const glint_child child = {
        .work = run_task, .context = &task, .stop_requested = glint_stop_requested};
    char *text = NULL;
    glint_status status;
    TRY_OR(cleanup, status, glint_child_run(&child, &text, error));
    *entry = json_loads(text, 0, NULL);
    status = *entry != NULL ? GLINT_OK : glint_fail_memory(error, "a report");
cleanup:
    free(text);
    return status;
}

static glint_status measure_scenes(bench_work *work, glint_error *error)
{
    for (size_t i = 0; i < work->report.count; i++) {
        json_t *entry = NULL;
        glint_signals_cooperate(true);
        const glint_status status = measure_scene(work, work->report.names[i], &entry, error);
        glint_signals_cooperate(false);
        TRY(status);
        if (glint_stop_requested()) {
            json_decref(entry);
            return glint_fail(error, GLINT_INTERRUPTED, "stopped");
        }
        TRY(bench_report_add(&work->report, entry, error));
    }
    return GLINT_OK;
}

static glint_status bench(bench_work *work, const char *const *names, size_t count,
                          glint_error *error)
{
    const bench_request *request = work->request;
    const glint_bench_options options = options_of(request);
    const glint_speed_error_options error_options = error_options_of(request);
    glint_machine machine;
    glint_machine_describe(&machine);
    work->report = (bench_report){
        .json = request->json,
        .html = request->html,
        .baseline_path = request->baseline,
        .margin = request->margin >= 0 ? request->margin : BENCH_DEFAULT_MARGIN,
        .error = request->error,
        .names = names,
        .count = count,
    };
    TRY(bench_report_begin(&work->report,
                           request->error
                               ? glint_speed_error_document(&machine, &error_options, work->command)
                               : glint_bench_document(&machine, &options),
                           error));
    const glint_status status = measure_scenes(work, error);
    if (status != GLINT_OK) {
        bench_report_leave(&work->report);
        return status;
    }
    return bench_report_finish(&work->report, error);
}

// ---- The request -------------------------------------------------------------------------------

static glint_status check_scene(const bench_request *request, const char *name, glint_error *error)
{
    struct stat facts;
    if (is_built_in(name) && request->inputs.scene_name != NULL) {
        return glint_fail(error, GLINT_USAGE, "--scene: %s is built in, not a file with scenes",
                          name);
    }
    if (!is_built_in(name) && stat(name, &facts) != 0) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: no such file, and no built-in scene (glint bench --list)", name);
    }
    return GLINT_OK;
}

// True if writing a report to `path` would replace an input.
static bool is_input(const bench_request *request, const char *path, const char *const *names,
                     size_t count)
{
    if (glint_same_file(path, request->baseline) || glint_same_file(path, request->inputs.env)) {
        return true;
    }
    for (size_t i = 0; i < count; i++) {
        if (!is_built_in(names[i]) && glint_same_file(path, names[i])) {
            return true;
        }
    }
    return false;
}

static glint_status check_report(const char *option, const char *path, bool is_read,
                                 glint_error *error)
{
    if (is_read) {
        return glint_fail(error, GLINT_USAGE, "--%s %s: this is an input (name another file)",
                          option, path);
    }
    return glint_output_file_check(path, error);
}

static glint_status check_reports(const bench_request *request, const char *const *names,
                                  size_t count, glint_error *error)
{
    if (request->json != NULL && !glint_is_stdout(request->json)) {
        TRY(check_report("json", request->json, is_input(request, request->json, names, count),
                         error));
    }
    if (request->html != NULL) {
        if (glint_same_file(request->html, request->json)) {
            return glint_fail(error, GLINT_USAGE,
                              "--html %s: --json goes there, too (name another "
                              "file)",
                              request->html);
        }
        TRY(check_report("html", request->html, is_input(request, request->html, names, count),
                         error));
    }
    return GLINT_OK;
}

// Checks which options go with --error and which without; sets the default size.
static glint_status check_kind(bench_request *request, glint_error *error)
{
    const char *lone = request->html != NULL ? "--html" : "--no-sampling";
    if (!request->error && (request->html != NULL || request->no_sampling)) {
        return glint_fail(error, GLINT_USAGE, "%s: it belongs to --error (add that)", lone);
    }
    const char *other = request->baseline != NULL ? "--baseline" : "--no-check";
    if (request->error && (request->baseline != NULL || request->no_check)) {
        return glint_fail(error, GLINT_USAGE, "%s: it does not go with --error (leave one out)",
                          other);
    }
    glint_settings *settings = &request->inputs.settings;
    if (settings->width == 0) {
        settings->width = request->error ? 640 : 1920;
        settings->height = request->error ? 360 : 1080;
    }
    return GLINT_OK;
}

// Checks everything that can be checked before measuring.
static glint_status check_request(bench_request *request, const char *const *names, size_t count,
                                  glint_error *error)
{
    if (request->rounds > 0 && request->seconds > 0) {
        return glint_fail(error, GLINT_USAGE, "--rounds and --seconds exclude each other");
    }
    if (request->margin >= 0 && request->baseline == NULL) {
        return glint_fail(error, GLINT_USAGE, "--margin: there is no --baseline");
    }
    TRY(check_kind(request, error));
    TRY(glint_input_request_finish(&request->inputs, error));
    if (request->error) {
        TRY(bench_error_check(&request->inputs.settings, error));
    }
    for (size_t i = 0; i < count; i++) {
        TRY(check_scene(request, names[i], error));
        for (size_t k = 0; k < i; k++) {
            if (strcmp(names[i], names[k]) == 0) {
                return glint_fail(error, GLINT_USAGE, "%s: named twice", names[i]);
            }
        }
    }
    return check_reports(request, names, count, error);
}

static void print_list(void)
{
    for (size_t i = 0; glint_built_in_name(i) != NULL; i++) {
        printf("%-10s %s\n", glint_built_in_name(i), glint_built_in_summary(i));
    }
}

static void set_defaults(void *context)
{
    bench_request *request = context;
    glint_input_request_default(&request->inputs);
    request->inputs.settings.width = 0; // not given
    request->inputs.settings.kernels = GLINT_KERNELS_SPECIAL;
    request->margin = -1;
}

// The scene names on the command line; without any, the names of all built-in scenes. malloc'd;
// NULL without memory.
static const char **scene_names(const glint_arguments *arguments, size_t *count)
{
    *count = (size_t)arguments->positional_count;
    bool all = *count == 0;
    while (all && glint_built_in_name(*count) != NULL) {
        (*count)++;
    }
    const char **names = calloc(*count + 1, sizeof *names);
    for (size_t i = 0; names != NULL && i < *count; i++) {
        names[i] = all ? glint_built_in_name(i) : arguments->positionals[i];
    }
    return names;
}

static glint_status run(void *context, const glint_arguments *arguments, glint_error *error)
{
    bench_request *request = context;
    if (request->list) {
        print_list();
        return GLINT_OK;
    }
    size_t count;
    const char **names = scene_names(arguments, &count);
    if (names == NULL) {
        return glint_fail_memory(error, "the scenes' names");
    }
    glint_status status;
    TRY_OR(cleanup, status, check_request(request, names, count, error));
    bench_work work = {.request = request, .command = glint_command_line(arguments)};
    glint_progress_begin(&work.display, GLINT_PROGRESS_AUTO);
    if (work.display.mode != GLINT_PROGRESS_BAR) {
        work.display.mode = GLINT_PROGRESS_NONE;
    }
    status = bench(&work, names, count, error);
    bench_report_free(&work.report);
    free(work.command);
cleanup:
    free(names);
    return status;
}

const glint_command glint_command_bench = {
    .name = "bench",
    .summary = "measure how fast scenes are rendered, and how right",
    .synopsis = "[SCENE…] [options]",
    .description = "Measures phases, frames and rays a second of each scene: glTF files, or "
                   "built-in scenes (--list; the default is all of them). It first compares the "
                   "picture with double precision. A wrong picture gets no figures, and the exit "
                   "status is 7. The time of a frame is a median, with quartiles and range. "
                   "--error renders each scene in many ways and shows time beside error.",
    .examples = "  glint bench\n"
                "  glint bench mirror --json before.json\n"
                "  glint bench mirror --baseline before.json --margin 5\n"
                "  glint bench car.glb --device gpu --size 3840x2160 --seconds 20\n"
                "  glint bench car.glb --error --html car.html\n",
    .groups = groups,
    .positional = "SCENE",
    .takes_any_number = true,
    .request_size = sizeof(bench_request),
    .set_defaults = set_defaults,
    .run = run,
};
