// Implements glint farm: renders a sequence in parts on a cluster, and reports the result.
#include "cli/commands.h"
#include "cli/common/options.h"
#include "cli/common/say.h"
#include "cli/common/signals.h"

#include "cli/cluster/farm_slurm.h"
#include "cli/common/json_output.h"
#include "cli/common/output_folder.h"
#include "cli/render/each_camera.h"
#include "cli/render/light.h"
#include "cli/render/request.h"
#include "image/output_file.h"
#include "report/farm_report.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// The options of glint farm.
typedef struct farm_request {
    int parts, at_once, cpus, retries;
    const char *folder, *name, *time, *partition, *further, *report_further, *program, *json, *job;
    bool dry_run, wait;
} farm_request;

static const glint_option slurm_options[] = {
    {GLINT_OPTION_HEADING, .help = "glint farm slurm"},
    {GLINT_OPTION_INT, .name = "parts", .argument = "N",
     .help = "Number of jobs. Each loads the scene, compiles its kernels once, and renders every "
             "N-th frame.",
     .fallback = "8, or as many as there are frames", .offset = offsetof(farm_request, parts),
     .minimum = 1, .maximum = GLINT_FARM_PARTS_MAX},
    {GLINT_OPTION_INT, .name = "at-once", .argument = "N",
     .help = "Number of parts that run at the same time.",
     .fallback = "as many as the cluster gives", .offset = offsetof(farm_request, at_once),
     .minimum = 1, .maximum = GLINT_FARM_PARTS_MAX},
    {GLINT_OPTION_INT, .name = "cpus", .argument = "N", .help = "Cores of each part.",
     .fallback = "the cluster's", .offset = offsetof(farm_request, cpus), .minimum = 1,
     .maximum = 4096},
    {GLINT_OPTION_TEXT, .name = "time", .argument = "TIME",
     .help = "The most that a part may take, as Slurm writes it: 90 (minutes), 2:00:00.",
     .fallback = "the partition's", .offset = offsetof(farm_request, time)},
    {GLINT_OPTION_TEXT, .name = "partition", .argument = "NAME", .help = "Where to run.",
     .fallback = "the cluster's", .offset = offsetof(farm_request, partition)},
    {GLINT_OPTION_TEXT, .name = "sbatch", .argument = "OPTIONS",
     .help = "Further options of sbatch: '--gres=gpu:1 --account=film'.",
     .offset = offsetof(farm_request, further)},
    {GLINT_OPTION_TEXT, .name = "report-sbatch", .argument = "OPTIONS",
     .help = "The same for the job that sums up at the end; it needs no more than a minute of one "
             "core.",
     .offset = offsetof(farm_request, report_further)},
    {GLINT_OPTION_INT, .name = "retries", .argument = "N",
     .help = "How often glint puts a part back into the queue after it was killed or its device "
             "failed. (Slurm itself puts back parts that lost their node.)",
     .fallback = "3", .offset = offsetof(farm_request, retries), .minimum = 0, .maximum = 1000},
    {GLINT_OPTION_TEXT, .name = "name", .argument = "NAME", .help = "Name of the job.",
     .fallback = "the frames'", .offset = offsetof(farm_request, name)},
    {GLINT_OPTION_TEXT, .name = "folder", .argument = "DIR",
     .help = "The job's folder, for scripts, logs and statistics; made where there is none.",
     .fallback = "beside the frames, jewel.farm for jewel.####.exr",
     .offset = offsetof(farm_request, folder)},
    {GLINT_OPTION_TEXT, .name = "program", .argument = "FILE", .help = "glint on the nodes.",
     .fallback = "this one", .offset = offsetof(farm_request, program)},
    {GLINT_OPTION_FLAG, .name = "dry-run",
     .help = "Print the parts' script to stdout; make and submit nothing.",
     .offset = offsetof(farm_request, dry_run)},
    {GLINT_OPTION_FLAG, .name = "wait",
     .help = "Wait until all parts have ended, then print the report. The exit status is 6 if "
             "frames are missing.",
     .offset = offsetof(farm_request, wait)},
    {GLINT_OPTION_HEADING, .help = "glint farm report"},
    {GLINT_OPTION_TEXT, .name = "json", .argument = "FILE",
     .help = "Write the report as JSON, with --wait too; - is stdout, in place of the table.",
     .offset = offsetof(farm_request, json)},
    {GLINT_OPTION_TEXT, .name = "job", .argument = "N", .help = "Which of the folder's jobs.",
     .fallback = "the last one", .offset = offsetof(farm_request, job)},
    GLINT_OPTION_END,
};

static const glint_option *const groups[] = {slurm_options, NULL};

// ---- The report --------------------------------------------------------------------------------

static double mean(double sum, uint64_t count)
{
    return count > 0 ? sum / (double)count : 0;
}

static void print_part(const glint_farm_part *part)
{
    char status[16] = "-";
    if (part->status >= 0) {
        snprintf(status, sizeof status, "%d", part->status);
    }
    printf("%6d  %-20s %8d %6s %7llu %9llu %8llu %7llu %9.1f %9.1f\n", part->number,
           part->attempts > 0 ? part->node : "-", part->attempts, status,
           (unsigned long long)part->frames, (unsigned long long)part->rendered,
           (unsigned long long)part->skipped, (unsigned long long)part->failed,
           mean(part->trace_ms, part->traced), mean(part->write_ms, part->traced));
}

static void print_report(const glint_farm_report *report)
{
    const glint_farm_job *job = &report->job;
    printf("%s: job %s, %llu frames in %d parts\n\n", job->output, job->id,
           (unsigned long long)job->frames, job->parts);
    printf("%6s  %-20s %8s %6s %7s %9s %8s %7s %9s %9s\n", "part", "node", "attempts", "status",
           "frames", "rendered", "skipped", "failed", "trace ms", "write ms");
    for (int i = 0; i < job->parts; i++) {
        print_part(&report->parts[i]);
    }
    printf("%6s  %-20s %8s %6s %7llu %9llu %8llu %7llu %9.1f %9.1f\n\n", "all", "", "", "",
           (unsigned long long)job->frames, (unsigned long long)report->rendered,
           (unsigned long long)report->skipped, (unsigned long long)report->failed,
           mean(report->trace_ms, report->traced), mean(report->write_ms, report->traced));
    for (size_t i = 0; i < report->failures.count; i++) {
        printf("failed: %s\n", report->failures.texts[i]);
    }
    const uint64_t there = report->rendered + report->skipped;
    printf("%llu of %llu frames are there, %llu failed, %llu are missing, %llu were rendered "
           "again\n",
           (unsigned long long)there, (unsigned long long)job->frames,
           (unsigned long long)report->failed, (unsigned long long)report->missing,
           (unsigned long long)report->again);
}

static glint_status verdict(const glint_farm_report *report, glint_error *error)
{
    const uint64_t absent = report->failed + report->missing;
    return absent == 0 ? GLINT_OK
                       : glint_fail(error, GLINT_FRAMES_FAILED,
                                    "%s: %llu of %llu frames are not there (submit again for "
                                    "those, once the parts have ended)",
                                    report->job.output, (unsigned long long)absent,
                                    (unsigned long long)report->job.frames);
}

static glint_status give_report(const char *folder, const char *job, const char *json,
                                glint_error *error)
{
    glint_farm_report report;
    glint_status status = glint_farm_report_read(folder, job, &report, error);
    if (status == GLINT_OK && !glint_is_stdout(json)) {
        print_report(&report);
    }
    if (status == GLINT_OK && json != NULL) {
        status = glint_write_json(json, glint_farm_report_json(&report), error);
    }
    if (status == GLINT_OK) {
        status = verdict(&report, error);
    }
    glint_farm_report_free(&report);
    return status;
}

// ---- What is rendered --------------------------------------------------------------------------

// The arguments of glint render, parsed as the parts will parse them. So mistakes show here once,
// not in every part.
typedef struct farm_subject {
    render_request request;
    char **words; // "render --skip-existing …"; the further words are borrowed
    int count;
} farm_subject;

static void free_subject(farm_subject *subject)
{
    render_request_free(&subject->request);
    free(subject->words);
}

static glint_status check_subject(const render_request *request, glint_error *error)
{
    if (!request->is_sequence) {
        return glint_fail(error, GLINT_USAGE,
                          "%s: one frame alone (a sequence is named frame.####.exr)",
                          request->output);
    }
    if (render_each_camera_is_asked(request)) {
        return glint_fail(error, GLINT_USAGE,
                          "--camera all: a job has the frames of one camera (submit a job for each "
                          "camera)");
    }
    if (request->shard.count > 0 || request->stats != NULL) {
        return glint_fail(error, GLINT_USAGE,
                          "%s: each part gets its own from glint farm (leave it out)",
                          request->stats != NULL ? "--stats" : "--shard");
    }
    return GLINT_OK;
}

static glint_status read_subject(char *const *arguments, int count, farm_subject *subject,
                                 glint_error *error)
{
    subject->words = calloc((size_t)count + 3, sizeof *subject->words);
    if (subject->words == NULL) {
        return glint_fail_memory(error, "the options");
    }
    subject->words[0] = "render";
    subject->words[1] = "--skip-existing";
    memcpy(subject->words + 2, arguments, (size_t)count * sizeof *arguments);
    subject->count = count + 2;
    render_request *request = &subject->request;
    glint_command_render.set_defaults(request);
    request->shard = (glint_shard){0}; // unset, so that check_subject sees a given --shard
    glint_arguments found = {.words = subject->words, .word_count = subject->count};
    glint_status status = glint_options_parse(&glint_command_render, request, &found, error);
    if (status == GLINT_OK && found.help) {
        return glint_fail(error, GLINT_USAGE, "--help is no sequence (glint help render)");
    }
    if (status == GLINT_OK) {
        request->inputs.scene = found.positionals[0];
        status = render_request_finish(request, error);
    }
    return status == GLINT_OK ? check_subject(request, error) : status;
}

// Loads the scene and the first light. This checks that they load and finds the frames of an
// animation.
static glint_status load_subject(farm_subject *subject, glint_error *error)
{
    glint_inputs inputs = {0};
    glint_progress_display display = {0};
    glint_progress_begin(&display, GLINT_PROGRESS_NONE);
    const render_request *request = &subject->request;
    glint_input_request of_scene = request->inputs;
    of_scene.camera_may_wait = true;
    glint_status status = glint_inputs_load_scene(&of_scene, &display, &inputs, error);
    glint_say_warnings(&inputs.warnings, 0);
    const size_t said = inputs.warnings.count;
    if (status == GLINT_OK) {
        status = render_request_settle(&subject->request, &inputs.motion, &inputs.warnings, error);
    }
    glint_frame_cursor cursor = {.list = &request->frames, .shard = {1, 1}};
    int first = 1;
    if (status == GLINT_OK && glint_frame_next(&cursor, &first)) {
        status = render_light_try(request, first, &display, &inputs, error);
    }
    if (status == GLINT_OK) {
        render_request_warn(&subject->request, &inputs.scene, &inputs.warnings);
        glint_say_warnings(&inputs.warnings, said);
    }
    glint_inputs_free(&inputs);
    return status;
}

// ---- The job -----------------------------------------------------------------------------------

// A job to submit. Owns its texts.
typedef struct farm_job {
    farm_slurm slurm;
    char *stem; // "out/jewel" for "out/jewel.####.exr"
    char *directory, *program, *folder, *name;
} farm_job;

static void free_job(farm_job *job)
{
    free(job->stem);
    free(job->directory);
    free(job->program);
    free(job->folder);
    free(job->name);
}

// The frames' path up to the number's place, without the separators before it.
static char *stem_of(const glint_frame_name *name)
{
    const char *slash = strrchr(name->path, '/');
    const size_t folder = slash != NULL ? (size_t)(slash + 1 - name->path) : 0;
    size_t length = name->length > 0 ? name->place : folder;
    while (length > folder && strchr("._-", name->path[length - 1]) != NULL) {
        length--;
    }
    char *stem = NULL;
    const char *rest = length > folder ? "" : "frames";
    return asprintf(&stem, "%.*s%s", (int)length, name->path, rest) < 0 ? NULL : stem;
}

static glint_status find_place(const farm_request *request, const render_request *render,
                               farm_job *job, glint_error *error)
{
    job->directory = getcwd(NULL, 0);
    if (job->directory == NULL) {
        return glint_fail(error, GLINT_OUTPUT_FAILED, "the working directory: %s (go elsewhere)",
                          strerror(errno));
    }
    job->program =
        request->program != NULL ? strdup(request->program) : realpath("/proc/self/exe", NULL);
    if (job->program == NULL) {
        return glint_fail(error, GLINT_OUTPUT_FAILED,
                          "where this program is: %s (say where it is on the nodes: --program)",
                          strerror(errno));
    }
    job->stem = stem_of(&render->name);
    if (job->stem == NULL) {
        return glint_fail_memory(error, "a file name");
    }
    const char *folder = request->folder != NULL ? request->folder : job->stem;
    const int made =
        asprintf(&job->folder, "%s%s%s%s", folder[0] == '/' ? "" : job->directory,
                 folder[0] == '/' ? "" : "/", folder, request->folder != NULL ? "" : ".farm");
    if (made < 0) {
        job->folder = NULL;
        return glint_fail_memory(error, "a file name");
    }
    return GLINT_OK;
}

// The number of parts: as many as requested, but at most one per frame.
static int count_parts(const farm_request *request, uint64_t frames)
{
    const int parts = request->parts > 0 ? request->parts : 8;
    if (frames >= (uint64_t)parts) {
        return parts;
    }
    if (request->parts > 0) {
        glint_say("--parts %d: there are %llu frames, which make as many parts", request->parts,
                  (unsigned long long)frames);
    }
    return (int)frames;
}

// The requested name, or the frames' name without characters that Slurm cannot write.
static char *name_of(const farm_request *request, const char *stem)
{
    const char *slash = strrchr(stem, '/');
    char *name = strdup(request->name != NULL ? request->name : slash != NULL ? slash + 1 : stem);
    for (char *c = name; c != NULL && request->name == NULL && *c != '\0'; c++) {
        if (*c == '"' || *c == '\\') {
            *c = '_';
        }
    }
    return name;
}

static glint_status describe_job(const farm_request *request, const farm_subject *subject,
                                 farm_job *job, glint_error *error)
{
    glint_status status = find_place(request, &subject->request, job, error);
    if (status != GLINT_OK || job->stem == NULL || job->folder == NULL) {
        return status;
    }
    job->name = name_of(request, job->stem);
    if (job->name == NULL) {
        return glint_fail_memory(error, "a job's name");
    }
    job->slurm = (farm_slurm){
        .folder = job->folder,
        .directory = job->directory,
        .program = job->program,
        .name = job->name,
        .arguments = subject->words + 2,
        .argument_count = subject->count - 2,
        .parts = count_parts(request, subject->request.frames.count),
        .at_once = request->at_once,
        .cpus = request->cpus,
        .retries = request->retries,
        .time = request->time,
        .partition = request->partition,
        .further = request->further,
        .report_further = request->report_further,
    };
    return GLINT_OK;
}

// Writes a script into the job's folder.
static glint_status put_script(const farm_job *job, const char *name, const char *script,
                               char **path, glint_error *error)
{
    if (asprintf(path, "%s/%s", job->folder, name) < 0) {
        *path = NULL;
        return glint_fail_memory(error, "a file name");
    }
    return glint_output_file_write(*path, script, strlen(script), error);
}

// Submits the array job of the parts. Makes the frames' folder first: the job's folder may lie in
// it.
static glint_status submit_parts(const farm_job *job, const char *frames_folder, const char *script,
                                 char id[FARM_ID_CAPACITY], glint_error *error)
{
    char *path = NULL;
    glint_status status;
    TRY(glint_folder_make(frames_folder, NULL, error));
    TRY(glint_folder_make(job->folder, NULL, error));
    TRY_OR(cleanup, status, put_script(job, "job.sh", script, &path, error));
    status = farm_slurm_submit(&job->slurm, &(farm_submission){.path = path}, id, error);

cleanup:
    free(path);
    return status;
}

static glint_status submit_report(const farm_job *job, const char *after, bool wait,
                                  glint_error *error)
{
    char *script = NULL, *path = NULL, id[FARM_ID_CAPACITY];
    glint_status status;
    TRY_OR(cleanup, status, farm_slurm_report_script(&job->slurm, after, &script, error));
    TRY_OR(cleanup, status, put_script(job, "report.sh", script, &path, error));
    status = farm_slurm_submit(&job->slurm, &(farm_submission){path, after, wait}, id, error);

cleanup:
    free(script);
    free(path);
    return status;
}

// Submits the parts and then the report. Once the parts are in the queue, a failure of the report
// is only a warning, except with --wait.
static glint_status submit(const farm_request *request, const farm_subject *subject,
                           const farm_job *job, const char *script, glint_error *error)
{
    glint_farm_job facts = {.output = (char *)subject->request.output,
                            .frames = subject->request.frames.count,
                            .parts = job->slurm.parts};
    glint_status status = submit_parts(job, subject->request.folder, script, facts.id, error);
    if (status != GLINT_OK) {
        return status;
    }
    glint_say("job %s: %llu frames in %d parts; logs, statistics and, at the end, the report in %s",
              facts.id, (unsigned long long)facts.frames, facts.parts, job->folder);
    if (!request->wait) {
        printf("%s\n", facts.id);
    }
    // Submit the report; with --wait, wait for it.
    status = glint_farm_job_write(job->folder, &facts, error);
    if (status == GLINT_OK) {
        glint_signals_cooperate(request->wait); // Ctrl-C also ends sbatch
        status = submit_report(job, facts.id, request->wait, error);
    }
    if (glint_stop_requested() || status == GLINT_INTERRUPTED) {
        glint_say("nobody waits any more: job %s goes on (scancel %s ends it)", facts.id, facts.id);
        glint_error_free(error);
        return glint_fail(error, GLINT_INTERRUPTED, "stopped");
    }
    glint_signals_cooperate(false);
    if (request->wait && (status == GLINT_OK || status == GLINT_FRAMES_FAILED)) {
        // Read the parts' results even if the report's own job failed.
        glint_error_free(error);
        *error = (glint_error){0};
        return give_report(job->folder, facts.id, request->json, error);
    }
    if (status != GLINT_OK && !request->wait) {
        glint_say("warning: %s", error->message);
        glint_say("warning: job %s goes on; there will be no report of it", facts.id);
        glint_error_free(error);
        *error = (glint_error){0};
        return GLINT_OK;
    }
    return status;
}

static glint_status run_job(const farm_request *request, const farm_subject *subject,
                            glint_error *error)
{
    farm_job job = {0};
    char *script = NULL;
    glint_status status = describe_job(request, subject, &job, error);
    if (status == GLINT_OK) {
        status = farm_slurm_script(&job.slurm, &script, error);
    }
    if (status == GLINT_OK && request->dry_run) {
        fputs(script, stdout);
    } else if (status == GLINT_OK) {
        status = submit(request, subject, &job, script, error);
    }
    free(script);
    free_job(&job);
    return status;
}

// ---- The command -------------------------------------------------------------------------------

static glint_status run_slurm(const farm_request *request, char *const *arguments, int count,
                              glint_error *error)
{
    if (count == 0) {
        return glint_fail(error, GLINT_USAGE,
                          "no sequence (name it as glint render takes it, after --: glint farm "
                          "slurm -- SCENE --turntable 240 -o out/frame.####.exr)");
    }
    if (request->dry_run && request->wait) {
        return glint_fail(error, GLINT_USAGE,
                          "--wait: with --dry-run there is nothing to wait for");
    }
    if ((request->json != NULL && !request->wait) || request->job != NULL) {
        return glint_fail(error, GLINT_USAGE, "--%s: this is for the report (leave it out)",
                          request->job != NULL ? "job" : "json");
    }
    farm_subject subject = {0};
    glint_status status = read_subject(arguments, count, &subject, error);
    if (status == GLINT_OK) {
        status = load_subject(&subject, error);
    }
    if (status == GLINT_OK) {
        status = run_job(request, &subject, error);
    }
    free_subject(&subject);
    return status;
}

static glint_status run(void *context, const glint_arguments *arguments, glint_error *error)
{
    const farm_request *request = context;
    char *const *words = arguments->positionals;
    const int count = arguments->positional_count;
    if (count > 0 && strcmp(words[0], "slurm") == 0) {
        return run_slurm(request, words + 1, count - 1, error);
    }
    if (count > 0 && strcmp(words[0], "report") == 0) {
        return count == 2 ? give_report(words[1], request->job, request->json, error)
                          : glint_fail(error, GLINT_USAGE,
                                       "report: the folder of one job is expected (glint farm "
                                       "report out/jewel.farm)");
    }
    return count > 0
               ? glint_fail(error, GLINT_USAGE,
                            "farm %s: slurm or report is expected (glint farm --help)", words[0])
               : glint_fail(error, GLINT_USAGE,
                            "farm: what? (glint farm slurm … or glint farm report DIR)");
}

static void set_defaults(void *request)
{
    ((farm_request *)request)->retries = 3;
}

const glint_command glint_command_farm = {
    .name = "farm",
    .summary = "render a sequence on the machines of a cluster",
    .synopsis = "slurm [options] -- SCENE -o OUT [options of glint render]\n"
                "       glint farm report DIR [--job N] [--json FILE]",
    .description =
        "slurm submits a sequence to Slurm as an array job. Each part renders its frames with "
        "--skip-existing, so a part continues where it stopped. A last job writes the report. "
        "stdout gets the job's number. glint loads the scene before it submits, to find mistakes "
        "early.\nreport sums up a job's folder, at any time.",
    .examples = "  glint farm slurm --parts 16 --cpus 8 --time 1:00:00 -- \\\n"
                "      jewel.glb --turntable 240 --size 1920x1080 -o out/jewel.####.exr\n"
                "  glint farm slurm --sbatch '--gres=gpu:1' --wait -- walk.glb -o walk.####.exr\n"
                "  glint farm report out/jewel.farm\n",
    .groups = groups,
    .positional = "WORD",
    .takes_any_number = true,
    .request_size = sizeof(farm_request),
    .set_defaults = set_defaults,
    .run = run,
};
