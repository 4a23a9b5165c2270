// Prints, compares and writes the report of glint bench. See bench_report.h.
#include "cli/bench/bench_report.h"

#include "cli/bench/bench_table.h"
#include "cli/bench/error_table.h"
#include "cli/common/json_output.h"
#include "cli/common/say.h"
#include "report/bench/baseline.h"
#include "report/speed_error/speed_error_json.h"
#include "report/speed_error/speed_error_page.h"

#include <stdio.h>

static bool prints_table(const bench_report *report)
{
    return !glint_is_stdout(report->json);
}

static size_t count_scenes(const bench_report *report)
{
    return json_array_size(json_object_get(report->document, "scenes"));
}

// ---- The baseline ------------------------------------------------------------------------------

static glint_status load_baseline(bench_report *report, glint_error *error)
{
    TRY(glint_baseline_load(report->baseline_path, &report->baseline, error));
    if (json_is_false(json_object_get(report->baseline, "complete"))) {
        glint_say("warning: %s: its run ended early: it holds %zu of %zu scenes",
                  report->baseline_path,
                  json_array_size(json_object_get(report->baseline, "scenes")),
                  json_array_size(json_object_get(report->baseline, "asked")));
    }
    return GLINT_OK;
}

static glint_status compare_scene(bench_report *report, const json_t *entry, glint_error *error)
{
    const char *name = glint_json_text_at(entry, "name"), *path = report->baseline_path;
    const glint_baseline baseline = {report->baseline, path, report->margin / 100};
    glint_comparison comparison;
    TRY(glint_baseline_compare(&baseline, entry, &comparison, error));
    report->compared += comparison.verdict != GLINT_VERDICT_MISSING;
    report->slower += comparison.verdict == GLINT_VERDICT_SLOWER;
    (void)json_array_append_new(report->comparisons, glint_comparison_json(name, &comparison));
    if (comparison.verdict == GLINT_VERDICT_MISSING) {
        glint_say("warning: %s: there is no scene %s to compare with", path, name);
    } else if (comparison.verdict == GLINT_VERDICT_SLOWER) {
        glint_say("%s: slower: %.3f ms a frame, was %.3f (%+.1f%%)", name, comparison.now,
                  comparison.before, 100 * (comparison.now / comparison.before - 1));
    }
    return GLINT_OK;
}

static void print_comparisons(const bench_report *report)
{
    printf("\nagainst %s\n", report->baseline_path);
    for (size_t i = 0; i < json_array_size(report->comparisons); i++) {
        glint_bench_print_comparison(json_array_get(report->comparisons, i), stdout);
    }
}

// ---- Writing -----------------------------------------------------------------------------------

// Adds the comparisons so far to the report.
static void put_comparisons(bench_report *report)
{
    json_t *object = json_object();
    glint_json_put_text(object, "file", report->baseline_path);
    glint_json_put_text(object, "glint", glint_json_text_at(report->baseline, "glint"));
    glint_json_put_text(object, "date", glint_json_text_at(report->baseline, "date"));
    glint_json_put_real(object, "margin_percent", report->margin);
    glint_json_put(object, "scenes", json_incref(report->comparisons));
    glint_json_put(report->document, "baseline", object);
}

// Writes the JSON. The pictures of --error stay in `document`, for the page.
static glint_status write_json(bench_report *report, glint_error *error)
{
    if (report->json == NULL) {
        return GLINT_OK;
    }
    glint_json_put_flag(report->document, "complete", count_scenes(report) == report->count);
    if (report->baseline != NULL) {
        put_comparisons(report);
    }
    json_t *written = json_deep_copy(report->document);
    if (written != NULL) {
        glint_speed_error_drop_pictures(written);
    }
    TRY(glint_write_json(report->json, written, error));
    report->written = count_scenes(report);
    return GLINT_OK;
}

// ---- The report --------------------------------------------------------------------------------

glint_status bench_report_begin(bench_report *report, json_t *document, glint_error *error)
{
    report->document = document;
    report->comparisons = json_array();
    json_t *asked = json_array();
    for (size_t i = 0; i < report->count; i++) {
        (void)json_array_append_new(asked, glint_json_text(report->names[i]));
    }
    glint_json_put(document, "asked", asked);
    return report->baseline_path != NULL ? load_baseline(report, error) : GLINT_OK;
}

static void print_entry(const bench_report *report, const json_t *entry)
{
    if (count_scenes(report) == 0) {
        glint_bench_print_head(report->document, stdout);
    }
    if (report->error) {
        glint_error_print_scene(entry, stdout);
    } else {
        glint_bench_print_scene(entry, stdout);
    }
    fflush(stdout);
}

// Judges an entry: is the picture right, and how does its time compare?
static glint_status judge_entry(bench_report *report, const json_t *entry, glint_error *error)
{
    if (report->error) {
        return GLINT_OK;
    }
    if (glint_json_at(entry, "frames") == NULL) {
        report->wrong++;
        glint_say("%s: the picture is wrong: %s (its speed is not reported)",
                  glint_json_text_at(entry, "name"), glint_json_text_at(entry, "check.reason"));
        return GLINT_OK;
    }
    return report->baseline != NULL ? compare_scene(report, entry, error) : GLINT_OK;
}

glint_status bench_report_add(bench_report *report, json_t *entry, glint_error *error)
{
    if (prints_table(report)) {
        print_entry(report, entry);
    }
    const glint_status status = judge_entry(report, entry, error);
    if (status != GLINT_OK) {
        json_decref(entry);
        return status;
    }
    (void)json_array_append_new(json_object_get(report->document, "scenes"), entry);
    return glint_is_stdout(report->json) ? GLINT_OK : write_json(report, error);
}

static glint_status give_verdict(const bench_report *report, glint_error *error)
{
    if (report->wrong > 0) {
        return glint_fail(error, GLINT_MISMATCH, "%zu of %zu pictures %s wrong", report->wrong,
                          report->count, report->wrong == 1 ? "is" : "are");
    }
    if (report->baseline != NULL && report->compared == 0) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: it holds none of the scenes measured",
                          report->baseline_path);
    }
    if (report->slower > 0) {
        return glint_fail(error, GLINT_MISMATCH, "%zu of %zu scenes %s slower than in %s",
                          report->slower, report->count, report->slower == 1 ? "is" : "are",
                          report->baseline_path);
    }
    return GLINT_OK;
}

glint_status bench_report_finish(bench_report *report, glint_error *error)
{
    if (report->baseline != NULL && prints_table(report)) {
        print_comparisons(report);
    }
    if (report->html != NULL) {
        TRY(glint_speed_error_page_write(report->html, report->document, error));
    }
    if (glint_is_stdout(report->json)) {
        TRY(write_json(report, error));
    }
    return give_verdict(report, error);
}

void bench_report_leave(bench_report *report)
{
    glint_error unused = {0};
    if (glint_is_stdout(report->json) && count_scenes(report) > 0) {
        (void)write_json(report, &unused);
        glint_error_free(&unused);
    }
    if (report->written > 0 && report->written < report->count) {
        glint_say("%s: it holds %zu of %zu scenes, and is marked as incomplete",
                  prints_table(report) ? report->json : "the report", report->written,
                  report->count);
    }
}

void bench_report_free(bench_report *report)
{
    json_decref(report->comparisons);
    json_decref(report->baseline);
    json_decref(report->document);
    *report = (bench_report){0};
}
