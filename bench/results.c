// Writes the shared parts of the contests' reports. See results.h.
#include "results.h"

#include "report/json.h"
#include "report/machine.h"

#include <stdio.h>

json_t *bench_report_start(const bench_stage *stage, const char *other, const char *version)
{
    glint_machine machine;
    glint_machine_describe(&machine);
    json_t *about = json_object();
    glint_json_put_text(about, "cpu", machine.cpu);
    glint_json_put_count(about, "cores", (uint64_t)machine.cores);
    glint_json_put_real(about, "load_1_minute", machine.load); // at the start
    json_t *versions = json_object();
    glint_json_put_text(versions, "glint", GLINT_VERSION);
    glint_json_put_text(versions, other, version);
    glint_json_put_text(versions, "compiler", __VERSION__);
    glint_json_put_text(versions, "system", machine.system);

    json_t *report = json_object();
    glint_json_put(report, "machine", about);
    glint_json_put(report, "versions", versions);
    glint_json_put(report, "device", glint_json_device(glint_device_capabilities(stage->device)));
    glint_json_put_count(report, "width", (uint64_t)stage->width);
    glint_json_put_count(report, "height", (uint64_t)stage->height);
    glint_json_put_count(report, "rounds", (uint64_t)stage->rounds);
    glint_json_put(report, "scenes", json_array());
    return report;
}

void bench_report_head(const char *other)
{
    printf("| scene | job | glint, ms | %s, ms | ratio | against | pixels that differ |\n", other);
    printf("|---|---|---|---|---|---|---|\n");
}

void bench_report_line(const bench_line *line)
{
    char different[32] = "–";
    if (line->agreement != NULL) {
        snprintf(different, sizeof different, "%llu",
                 (unsigned long long)line->agreement->different_pixels);
    }
    printf("| %s | %s | %.2f | %.2f | %.2f (%.2f–%.2f) | %s | %s |\n", line->scene, line->job,
           line->glint_ms, line->other_ms, line->ratio.median, line->ratio.min, line->ratio.max,
           line->against, different);
    fflush(stdout);
}

json_t *bench_report_add_scene(json_t *report, const bench_scene *scene)
{
    json_t *object = json_object();
    glint_json_put_text(object, "name", scene->name);
    glint_json_put_count(object, "triangles", scene->triangle_count);
    (void)json_array_append_new(json_object_get(report, "scenes"), object);
    return object;
}

json_t *bench_report_summary(bench_summary summary)
{
    json_t *object = json_object();
    glint_json_put_real(object, "median", summary.median);
    glint_json_put_real(object, "min", summary.min);
    glint_json_put_real(object, "max", summary.max);
    return object;
}

json_t *bench_report_agreement(const bench_agreement *agreement)
{
    json_t *object = json_object();
    glint_json_put_real(object, "relative_rmse", agreement->relative_rmse);
    glint_json_put_count(object, "different_pixels", agreement->different_pixels);
    glint_json_put_count(object, "pixels", agreement->pixels);
    return object;
}
