// What bench/embree says. See embree_report.h.
#include "embree_report.h"

#include "report/json.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>
#include <unistd.h>

// The first "model name" of /proc/cpuinfo; "unknown" where there is none.
static void read_cpu_name(char *name, size_t capacity)
{
    snprintf(name, capacity, "unknown");
    FILE *file = fopen("/proc/cpuinfo", "r");
    char line[512];
    while (file != NULL && fgets(line, sizeof line, file) != NULL) {
        const char *value = strchr(line, ':');
        if (strncmp(line, "model name", 10) == 0 && value != NULL) {
            line[strcspn(line, "\n")] = '\0';
            snprintf(name, capacity, "%s", value + 2);
            break;
        }
    }
    if (file != NULL) {
        fclose(file);
    }
}

static json_t *machine_object(void)
{
    char name[256];
    double load[3] = {NAN, NAN, NAN};
    (void)getloadavg(load, 3);
    read_cpu_name(name, sizeof name);
    json_t *object = json_object();
    glint_json_put_text(object, "cpu", name);
    glint_json_put_count(object, "cores", (uint64_t)sysconf(_SC_NPROCESSORS_ONLN));
    glint_json_put_real(object, "load_1_minute", load[0]); // at the start
    return object;
}

static json_t *versions_object(void)
{
    char embree[32];
    struct utsname system;
    embree_version(embree, sizeof embree);
    json_t *object = json_object();
    glint_json_put_text(object, "glint", GLINT_VERSION);
    glint_json_put_text(object, "embree", embree);
    glint_json_put_text(object, "compiler", __VERSION__);
    glint_json_put_text(object, "system", uname(&system) == 0 ? system.release : NULL);
    return object;
}

json_t *bench_report_create(const bench_arena *arena)
{
    json_t *report = json_object();
    glint_json_put(report, "machine", machine_object());
    glint_json_put(report, "versions", versions_object());
    glint_json_put(report, "device", glint_json_device(glint_device_capabilities(arena->device)));
    glint_json_put_count(report, "width", (uint64_t)arena->width);
    glint_json_put_count(report, "height", (uint64_t)arena->height);
    glint_json_put_count(report, "rounds", (uint64_t)arena->rounds);
    glint_json_put_flag(report, "high_quality_competes", arena->high);
    glint_json_put_flag(report, "robust", arena->robust);
    glint_json_put(report, "scenes", json_array());
    return report;
}

json_t *bench_report_add_scene(json_t *report, const bench_scene *scene)
{
    static const char *const parts[] = {
        "ratio", "ratio_staged", "glint_ms", "embree_ms", "embree_staged_ms", "agreement", "modes"};
    json_t *object = json_object();
    glint_json_put_text(object, "name", scene->name);
    glint_json_put_count(object, "triangles", scene->triangle_count);
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        glint_json_put(object, parts[i], json_object());
    }
    (void)json_array_append_new(json_object_get(report, "scenes"), object);
    return object;
}

static json_t *summary_object(bench_summary summary)
{
    json_t *object = json_object();
    glint_json_put_real(object, "median", summary.median);
    glint_json_put_real(object, "min", summary.min);
    glint_json_put_real(object, "max", summary.max);
    return object;
}

// A mode's name beside the summary of its times.
static json_t *entry_object(const bench_contest *contest, const bench_entry *entry)
{
    char name[128];
    embree_mode_describe(&entry->mode, contest->job, name, sizeof name);
    json_t *object = summary_object(bench_summarize(&entry->series));
    glint_json_put_text(object, "mode", name);
    return object;
}

// All modes that were tried: the fastest time of the sweep, and the rounds' median where listed.
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

static json_t *agreement_object(const bench_agreement *agreement)
{
    json_t *object = json_object();
    glint_json_put_real(object, "relative_rmse", agreement->relative_rmse);
    glint_json_put_count(object, "different_pixels", agreement->different_pixels);
    glint_json_put_count(object, "pixels", agreement->pixels);
    return object;
}

static void put_into(json_t *scene, const char *part, const char *job, json_t *value)
{
    glint_json_put(json_object_get(scene, part), job, value);
}

void bench_report_head(void)
{
    printf("| scene | job | glint, ms | Embree, ms | ratio | against | pixels that differ |\n");
    printf("|---|---|---|---|---|---|---|\n");
}

static void print_line(json_t *scene, const bench_contest *contest, const bench_entry *entry)
{
    char mode[128];
    embree_mode_describe(&entry->mode, contest->job, mode, sizeof mode);
    bench_summary ratio = bench_contest_ratio(contest, entry);
    printf("| %s | %s | %.2f | %.2f | %.2f (%.2f–%.2f) | %s | %llu |\n",
           json_string_value(json_object_get(scene, "name")), bench_job_name(contest->job),
           bench_summarize(&contest->glint).median, bench_summarize(&entry->series).median,
           ratio.median, ratio.min, ratio.max, mode,
           (unsigned long long)contest->agreement.different_pixels);
    fflush(stdout);
}

void bench_report_contest(json_t *scene, const bench_contest *contest)
{
    const char *job = bench_job_name(contest->job);
    const bench_entry *plain = bench_contest_best(contest, EMBREE_PLAIN);
    const bench_entry *staged = bench_contest_best(contest, EMBREE_STAGED);
    put_into(scene, "ratio", job, summary_object(bench_contest_ratio(contest, plain)));
    put_into(scene, "ratio_staged", job, summary_object(bench_contest_ratio(contest, staged)));
    put_into(scene, "glint_ms", job, json_real(bench_summarize(&contest->glint).median));
    put_into(scene, "embree_ms", job, entry_object(contest, plain));
    put_into(scene, "embree_staged_ms", job, entry_object(contest, staged));
    json_t *agreement = agreement_object(&contest->agreement);
    if (contest->job == BENCH_GLASS) {
        glint_json_put(agreement, "judged", agreement_object(&contest->judged));
    }
    put_into(scene, "agreement", job, agreement);
    put_into(scene, "modes", job, modes_array(contest));
    print_line(scene, contest, plain);
    if (staged != plain) {
        print_line(scene, contest, staged);
    }
}

void bench_report_build(json_t *scene, const bench_build *build)
{
    bench_summary ratio = bench_build_ratio(build);
    json_t *object = json_object();
    glint_json_put(object, "ratio", summary_object(ratio));
    glint_json_put(object, "glint_ms", summary_object(bench_summarize(&build->glint)));
    glint_json_put(object, "embree_ms", summary_object(bench_summarize(&build->embree)));
    glint_json_put_count(object, "glint_bytes", build->glint_bytes);
    glint_json_put_count(object, "embree_bytes",
                         build->embree_tree_bytes + build->embree_shading_bytes);
    glint_json_put_count(object, "embree_tree_bytes", build->embree_tree_bytes);
    glint_json_put(scene, "build", object);
    printf("| %s | build | %.2f | %.2f | %.2f (%.2f–%.2f) | MEDIUM | – |\n",
           json_string_value(json_object_get(scene, "name")), bench_summarize(&build->glint).median,
           bench_summarize(&build->embree).median, ratio.median, ratio.min, ratio.max);
    fflush(stdout);
}

void bench_report_leaks(json_t *report, const char *flags, embree_leaks leaks)
{
    json_t *object = json_object();
    glint_json_put_text(object, "flags", flags);
    glint_json_put_count(object, "rays", leaks.rays);
    glint_json_put_count(object, "at_vertices", leaks.at_vertices);
    glint_json_put_count(object, "at_edges", leaks.at_edges);
    if (json_object_get(report, "leaks") == NULL) {
        glint_json_put(report, "leaks", json_array());
    }
    (void)json_array_append_new(json_object_get(report, "leaks"), object);
    printf("leaks of Embree, %s: %llu of %llu rays at vertices, %llu of %llu at edges\n", flags,
           (unsigned long long)leaks.at_vertices, (unsigned long long)leaks.rays / 2,
           (unsigned long long)leaks.at_edges, (unsigned long long)leaks.rays / 2);
}
