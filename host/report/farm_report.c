// Sums up the work of a farm's parts. See farm_report.h.
#include "report/farm_report.h"

#include "base/regular_file.h"
#include "report/json.h"

#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define FORMAT "glint farm"
#define FAILURES_MAX 40     // failures listed by name
#define ATTEMPTS_MAX 100000 // a larger attempt number does not come from a farm

// ---- The job -----------------------------------------------------------------------------------

void glint_farm_job_free(glint_farm_job *job)
{
    free(job->output);
    *job = (glint_farm_job){0};
}

static char *file_of(const char *folder, const char *job, const char *rest)
{
    char *path = NULL;
    return asprintf(&path, "%s/%s%s", folder, job, rest) < 0 ? NULL : path;
}

glint_status glint_farm_job_write(const char *folder, const glint_farm_job *job, glint_error *error)
{
    char *path = file_of(folder, job->id, ".json");
    if (path == NULL) {
        return glint_fail_memory(error, "a file name");
    }
    json_t *root = json_object();
    glint_json_put_text(root, "format", FORMAT);
    glint_json_put_text(root, "glint", GLINT_VERSION);
    glint_json_put_text(root, "job", job->id);
    glint_json_put_text(root, "output", job->output);
    glint_json_put_count(root, "frames", job->frames);
    glint_json_put_count(root, "parts", (uint64_t)job->parts);
    glint_status status = glint_json_write(path, root, error);
    free(path);
    return status;
}

// The number in the name of a job's file, "1234.json"; 0 for other names.
static unsigned long long job_in_name(const char *name)
{
    const size_t digits = strspn(name, "0123456789");
    return digits > 0 && digits < 19 && strcmp(name + digits, ".json") == 0
               ? strtoull(name, NULL, 10)
               : 0;
}

static glint_status find_latest(const char *folder, char id[64], glint_error *error)
{
    unsigned long long latest = 0;
    DIR *list = opendir(folder);
    if (list == NULL) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: could not be read: %s (name a folder that glint farm slurm made)",
                          folder, strerror(errno));
    }
    for (const struct dirent *entry; (entry = readdir(list)) != NULL;) {
        const unsigned long long found = job_in_name(entry->d_name);
        latest = found > latest ? found : latest;
    }
    closedir(list);
    if (latest == 0) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: no folder of a job (name the one that glint farm slurm made)",
                          folder);
    }
    snprintf(id, 64, "%llu", latest);
    return GLINT_OK;
}

static glint_status take_job(const json_t *root, const char *path, glint_farm_job *job,
                             glint_error *error)
{
    const char *format = glint_json_text_at(root, "format");
    const char *id = glint_json_text_at(root, "job");
    const char *output = glint_json_text_at(root, "output");
    const json_int_t frames = json_integer_value(json_object_get(root, "frames"));
    const json_int_t parts = json_integer_value(json_object_get(root, "parts"));
    if (format == NULL || strcmp(format, FORMAT) != 0 || id == NULL || strcmp(id, job->id) != 0 ||
        output == NULL || frames < 1 || parts < 1 || parts > GLINT_FARM_PARTS_MAX) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: not what glint farm writes (submit anew)",
                          path);
    }
    job->frames = (uint64_t)frames;
    job->parts = (int)parts;
    job->output = strdup(output);
    return job->output != NULL ? GLINT_OK : glint_fail_memory(error, "the report");
}

static glint_status read_job(const char *folder, glint_farm_job *job, glint_error *error)
{
    char *path = file_of(folder, job->id, ".json");
    if (path == NULL) {
        return glint_fail_memory(error, "a file name");
    }
    json_t *root = NULL;
    glint_status status;
    if (access(path, F_OK) != 0) {
        status = glint_fail(error, GLINT_BAD_INPUT, "%s: %s (it is no job of that folder)", path,
                            strerror(errno));
        goto cleanup;
    }
    TRY_OR(cleanup, status, glint_json_read(path, &root, error));
    status = take_job(root, path, job, error);
cleanup:
    json_decref(root);
    free(path);
    return status;
}

// ---- The lines ---------------------------------------------------------------------------------

typedef enum frame_state { FRAME_FAILED, FRAME_SKIPPED, FRAME_RENDERED } frame_state;

// A frame's line in the statistics of an attempt.
typedef struct frame_line {
    int64_t number;
    frame_state state;
    char *failure; // owned; NULL unless it failed
} frame_line;

// The lines of a part.
typedef struct part_lines {
    frame_line *lines;
    size_t count, capacity;
    int last_attempt; // −1: no attempt began
} part_lines;

static void free_lines(part_lines *lines)
{
    for (size_t i = 0; i < lines->count; i++) {
        free(lines->lines[i].failure);
    }
    free(lines->lines);
}

static frame_line *add_line(part_lines *lines)
{
    if (lines->count == lines->capacity) {
        const size_t capacity = 2 * lines->capacity + 64;
        frame_line *grown = realloc(lines->lines, capacity * sizeof *grown);
        if (grown == NULL) {
            return NULL;
        }
        lines->lines = grown;
        lines->capacity = capacity;
    }
    frame_line *line = &lines->lines[lines->count++];
    *line = (frame_line){0};
    return line;
}

static frame_state state_of(const char *outcome)
{
    if (outcome != NULL && strcmp(outcome, "rendered") == 0) {
        return FRAME_RENDERED;
    }
    return outcome != NULL && strcmp(outcome, "skipped") == 0 ? FRAME_SKIPPED : FRAME_FAILED;
}

static glint_status take_frame(const json_t *root, glint_farm_part *part, part_lines *lines,
                               glint_error *error)
{
    const json_t *number = json_object_get(root, "frame");
    if (!json_is_integer(number)) {
        return GLINT_OK;
    }
    frame_line *line = add_line(lines);
    if (line == NULL) {
        return glint_fail_memory(error, "the report");
    }
    line->number = json_integer_value(number);
    line->state = state_of(glint_json_text_at(root, "outcome"));
    if (line->state == FRAME_RENDERED) {
        const double trace_ms = glint_json_real_at(root, "milliseconds.trace");
        const double write_ms = glint_json_real_at(root, "milliseconds.write");
        if (isfinite(trace_ms) && isfinite(write_ms)) {
            part->trace_ms += trace_ms;
            part->write_ms += write_ms;
            part->traced++;
        }
    }
    const char *failure = glint_json_text_at(root, "error");
    if (line->state == FRAME_FAILED && failure != NULL) {
        line->failure = strdup(failure);
    }
    return GLINT_OK;
}

// Takes a line of statistics. Ignores an incomplete line: a killed attempt may cut its last line.
static glint_status take_line(const char *text, glint_farm_part *part, part_lines *lines,
                              glint_error *error)
{
    json_t *root = json_loads(text, 0, NULL);
    const char *event = glint_json_text_at(root, "event");
    glint_status status = GLINT_OK;
    if (event != NULL && strcmp(event, "frame") == 0) {
        status = take_frame(root, part, lines, error);
    }
    json_decref(root);
    return status;
}

// Hands each line of a file to `take`. A missing file counts as empty.
static glint_status read_lines(const char *path, glint_farm_part *part, part_lines *lines,
                               glint_status (*take)(const char *text, glint_farm_part *part,
                                                    part_lines *lines, glint_error *error),
                               glint_error *error)
{
    if (access(path, F_OK) != 0 && errno == ENOENT) {
        return GLINT_OK;
    }
    FILE *file;
    TRY(glint_regular_file_open(path, &file, NULL, error));
    char *text = NULL;
    size_t capacity = 0;
    glint_status status = GLINT_OK;
    while (getline(&text, &capacity, file) >= 0) {
        TRY_OR(cleanup, status, take(text, part, lines, error));
    }
cleanup:
    free(text);
    fclose(file);
    return status;
}

// Takes a line of the part's list of attempts.
static glint_status take_account(const char *text, glint_farm_part *part, part_lines *lines,
                                 glint_error *error)
{
    (void)error;
    int attempt, status;
    char node[sizeof part->node];
    if (sscanf(text, "begin %d %64s", &attempt, node) == 2 && attempt >= 0 &&
        attempt < ATTEMPTS_MAX) {
        memcpy(part->node, node, sizeof node);
        part->attempts++;
        part->status = -1;
        lines->last_attempt = attempt > lines->last_attempt ? attempt : lines->last_attempt;
    } else if (sscanf(text, "end %d %d", &attempt, &status) == 2) {
        part->status = status;
    }
    return GLINT_OK;
}

// ---- The sums ----------------------------------------------------------------------------------

// Sorts by frame number; within a frame, rendered before skipped before failed.
static int by_number_best_first(const void *a, const void *b)
{
    const frame_line *first = a, *second = b;
    if (first->number != second->number) {
        return first->number < second->number ? -1 : 1;
    }
    return (first->state < second->state) - (first->state > second->state);
}

static void count_frames(part_lines *lines, glint_farm_part *part, glint_farm_report *report)
{
    if (lines->count > 0) {
        qsort(lines->lines, lines->count, sizeof *lines->lines, by_number_best_first);
    }
    for (size_t i = 0; i < lines->count; i++) {
        const frame_line *line = &lines->lines[i];
        if (i > 0 && line->number == lines->lines[i - 1].number) {
            report->again += line->state == FRAME_RENDERED;
            continue;
        }
        part->rendered += line->state == FRAME_RENDERED;
        part->skipped += line->state == FRAME_SKIPPED;
        part->failed += line->state == FRAME_FAILED;
        if (line->state == FRAME_FAILED && report->failures.count < FAILURES_MAX) {
            glint_warn(&report->failures, "frame %lld: %s", (long long)line->number,
                       line->failure != NULL ? line->failure : "it failed");
        }
    }
}

// The number of frames of part `index` (from 0): part I of N has every N-th frame.
static uint64_t frames_of(const glint_farm_job *job, int index)
{
    const uint64_t parts = (uint64_t)job->parts;
    return (job->frames + parts - 1 - (uint64_t)index) / parts;
}

static glint_status read_part(const char *folder, glint_farm_report *report, int index,
                              glint_error *error)
{
    glint_farm_part *part = &report->parts[index];
    part_lines lines = {.last_attempt = -1};
    part->number = index + 1;
    part->status = -1;
    part->frames = frames_of(&report->job, index);
    char rest[64];
    snprintf(rest, sizeof rest, "_%d.attempts", part->number);
    char *path = file_of(folder, report->job.id, rest);
    glint_status status = path != NULL ? read_lines(path, part, &lines, take_account, error)
                                       : glint_fail_memory(error, "a file name");
    free(path);
    for (int attempt = 0; status == GLINT_OK && attempt <= lines.last_attempt; attempt++) {
        snprintf(rest, sizeof rest, "_%d.%d.jsonl", part->number, attempt);
        path = file_of(folder, report->job.id, rest);
        status = path != NULL ? read_lines(path, part, &lines, take_line, error)
                              : glint_fail_memory(error, "a file name");
        free(path);
    }
    count_frames(&lines, part, report);
    free_lines(&lines);
    return status;
}

static glint_status find_job(const char *folder, const char *job, glint_farm_job *found,
                             glint_error *error)
{
    if (job == NULL) {
        TRY(find_latest(folder, found->id, error));
    } else if (strlen(job) < sizeof found->id && strspn(job, "0123456789") == strlen(job)) {
        memcpy(found->id, job, strlen(job) + 1);
    } else {
        return glint_fail(error, GLINT_USAGE, "--job %s: a number is expected", job);
    }
    return read_job(folder, found, error);
}

glint_status glint_farm_report_read(const char *folder, const char *job, glint_farm_report *report,
                                    glint_error *error)
{
    *report = (glint_farm_report){0};
    TRY(find_job(folder, job, &report->job, error));
    report->parts = calloc((size_t)report->job.parts, sizeof *report->parts);
    if (report->parts == NULL) {
        return glint_fail_memory(error, "the report");
    }
    for (int i = 0; i < report->job.parts; i++) {
        TRY(read_part(folder, report, i, error));
        const glint_farm_part *part = &report->parts[i];
        report->rendered += part->rendered;
        report->skipped += part->skipped;
        report->failed += part->failed;
        report->trace_ms += part->trace_ms;
        report->write_ms += part->write_ms;
        report->traced += part->traced;
    }
    const uint64_t known = report->rendered + report->skipped + report->failed;
    report->missing = known < report->job.frames ? report->job.frames - known : 0;
    return GLINT_OK;
}

void glint_farm_report_free(glint_farm_report *report)
{
    glint_farm_job_free(&report->job);
    glint_warnings_free(&report->failures);
    free(report->parts);
    *report = (glint_farm_report){0};
}

// ---- For programs ------------------------------------------------------------------------------

static void put_work(json_t *object, double trace_ms, double write_ms, uint64_t traced)
{
    json_t *milliseconds = json_object();
    glint_json_put_real(milliseconds, "trace", trace_ms);
    glint_json_put_real(milliseconds, "write", write_ms);
    glint_json_put(object, "milliseconds", milliseconds);
    glint_json_put_count(object, "renderings", traced);
}

static json_t *part_object(const glint_farm_part *part)
{
    json_t *object = json_object();
    glint_json_put_count(object, "part", (uint64_t)part->number);
    glint_json_put_text(object, "node", part->attempts > 0 ? part->node : NULL);
    glint_json_put_count(object, "attempts", (uint64_t)part->attempts);
    glint_json_put(object, "status", part->status >= 0 ? json_integer(part->status) : json_null());
    glint_json_put_count(object, "frames", part->frames);
    glint_json_put_count(object, "rendered", part->rendered);
    glint_json_put_count(object, "skipped", part->skipped);
    glint_json_put_count(object, "failed", part->failed);
    put_work(object, part->trace_ms, part->write_ms, part->traced);
    return object;
}

json_t *glint_farm_report_json(const glint_farm_report *report)
{
    json_t *root = json_object();
    glint_json_put_text(root, "format", "glint farm report");
    glint_json_put_text(root, "job", report->job.id);
    glint_json_put_text(root, "output", report->job.output);
    glint_json_put_count(root, "frames", report->job.frames);
    glint_json_put_count(root, "rendered", report->rendered);
    glint_json_put_count(root, "skipped", report->skipped);
    glint_json_put_count(root, "failed", report->failed);
    glint_json_put_count(root, "missing", report->missing);
    glint_json_put_count(root, "rendered_again", report->again);
    put_work(root, report->trace_ms, report->write_ms, report->traced);
    json_t *parts = json_array();
    for (int i = 0; i < report->job.parts; i++) {
        (void)json_array_append_new(parts, part_object(&report->parts[i]));
    }
    glint_json_put(root, "parts", parts);
    glint_json_put(root, "failures", glint_json_warnings(&report->failures));
    return root;
}
