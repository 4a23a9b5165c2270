// Writes the report of bench/embree. See report.h.
#include "embree/report.h"

#include "report/json.h"
#include "results.h"

#include <math.h>
#include <stdio.h>

json_t *embree_report_create(const bench_arena *arena)
{
    char version[32];
    embree_version(version, sizeof version);
    json_t *report = bench_report_start(&arena->stage, "embree", version);
    glint_json_put_flag(report, "high_quality_competes", arena->high);
    glint_json_put_flag(report, "robust", arena->robust);
    return report;
}

json_t *embree_report_add_scene(json_t *report, const bench_scene *scene)
{
    static const char *const parts[] = {
        "ratio", "ratio_staged", "glint_ms", "embree_ms", "embree_staged_ms", "agreement", "modes"};
    json_t *object = bench_report_add_scene(report, scene);
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        glint_json_put(object, parts[i], json_object());
    }
    return object;
}

// A mode's name and the summary of its times.
static json_t *entry_object(const bench_contest *contest, const bench_entry *entry)
{
    char name[128];
    embree_mode_describe(&entry->mode, contest->job, name, sizeof name);
    json_t *object = bench_report_summary(bench_summarize(&entry->series));
    glint_json_put_text(object, "mode", name);
    return object;
}

// All modes with the fastest time of the sweep, and the rounds' median of listed modes.
static json_t *modes_array(const bench_contest *contest)
{
    json_t *list = json_array();
    for (int i = 0; i < contest->entry_count; i++) {
        const bench_entry *entry = &contest->entries[i];
        if (isfinite(entry->sweep_ms)) {
            json_t *object = entry_object(contest, entry);
            glint_json_put_real(object, "sweep", entry->sweep_ms);
            (void)json_array_append_new(list, object);
        }
    }
    return list;
}

static void put_into(json_t *scene, const char *part, const char *job, json_t *value)
{
    glint_json_put(json_object_get(scene, part), job, value);
}

static void print_line(json_t *scene, const bench_contest *contest, const bench_entry *entry)
{
    char mode[128];
    embree_mode_describe(&entry->mode, contest->job, mode, sizeof mode);
    bench_report_line(&(bench_line){
        .scene = json_string_value(json_object_get(scene, "name")),
        .job = bench_job_name(contest->job),
        .glint_ms = bench_summarize(&contest->glint).median,
        .other_ms = bench_summarize(&entry->series).median,
        .ratio = bench_contest_ratio(contest, entry),
        .against = mode,
        .agreement = &contest->agreement,
    });
}

void embree_report_contest(json_t *scene, const bench_contest *contest)
{
    const char *job = bench_job_name(contest->job);
    const bench_entry *plain = bench_contest_best(contest, EMBREE_PLAIN);
    const bench_entry *staged = bench_contest_best(contest, EMBREE_STAGED);
    put_into(scene, "ratio", job, bench_report_summary(bench_contest_ratio(contest, plain)));
    put_into(scene, "ratio_staged", job,
             bench_report_summary(bench_contest_ratio(contest, staged)));
    put_into(scene, "glint_ms", job, json_real(bench_summarize(&contest->glint).median));
    put_into(scene, "embree_ms", job, entry_object(contest, plain));
    put_into(scene, "embree_staged_ms", job, entry_object(contest, staged));
    json_t *agreement = bench_report_agreement(&contest->agreement);
    if (contest->job == BENCH_GLASS) {
        glint_json_put(agreement, "judged", bench_report_agreement(&contest->judged));
    }
    put_into(scene, "agreement", job, agreement);
    put_into(scene, "modes", job, modes_array(contest));
    print_line(scene, contest, plain);
    if (staged != plain) {
        print_line(scene, contest, staged);
    }
}

void embree_report_build(json_t *scene, const bench_build *build)
{
    bench_summary ratio = bench_build_ratio(build);
    json_t *object = json_object();
    glint_json_put(object, "ratio", bench_report_summary(ratio));
    glint_json_put(object, "glint_ms", bench_report_summary(bench_summarize(&build->glint)));
    glint_json_put(object, "embree_ms", bench_report_summary(bench_summarize(&build->embree)));
    glint_json_put_count(object, "glint_bytes", build->glint_bytes);
    glint_json_put_count(object, "embree_bytes",
                         build->embree_tree_bytes + build->embree_shading_bytes);
    glint_json_put_count(object, "embree_tree_bytes", build->embree_tree_bytes);
    glint_json_put(scene, "build", object);
    bench_report_line(&(bench_line){
        .scene = json_string_value(json_object_get(scene, "name")),
        .job = "build",
        .glint_ms = bench_summarize(&build->glint).median,
        .other_ms = bench_summarize(&build->embree).median,
        .ratio = ratio,
        .against = "MEDIUM",
    });
}

void embree_report_leaks(json_t *report, const char *who, leak_count leaks)
{
    json_t *object = json_object();
    glint_json_put_text(object, "of", who);
    glint_json_put_count(object, "rays", leaks.rays);
    glint_json_put_count(object, "at_vertices", leaks.at_vertices);
    glint_json_put_count(object, "at_edges", leaks.at_edges);
    if (json_object_get(report, "leaks") == NULL) {
        glint_json_put(report, "leaks", json_array());
    }
    (void)json_array_append_new(json_object_get(report, "leaks"), object);
    printf("leaks of %s: %llu of %llu rays at vertices, %llu of %llu at edges\n", who,
           (unsigned long long)leaks.at_vertices, (unsigned long long)leaks.rays / 2,
           (unsigned long long)leaks.at_edges, (unsigned long long)leaks.rays / 2);
}
