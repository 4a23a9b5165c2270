// Writes the report of bench/llvmpipe. See report.h.
#include "llvmpipe/report.h"

#include "report/json.h"
#include "results.h"

#include <stdio.h>

json_t *llvmpipe_report_create(const bench_stage *stage, const llvmpipe_context *context)
{
    const char *renderer = llvmpipe_context_renderer(context);
    const char *version = llvmpipe_context_version(context);
    json_t *report = bench_report_start(stage, "opengl", version);
    glint_json_put_text(report, "renderer", renderer);
    printf("%s, OpenGL %s\n\n", renderer, version);
    bench_report_head("other");
    return report;
}

// A series with its times and their ratio to glint's.
static json_t *series_object(const llvmpipe_contest *contest, const bench_series *series)
{
    json_t *object = json_object();
    glint_json_put(object, "ms", bench_report_summary(bench_summarize(series)));
    glint_json_put(object, "ratio",
                   bench_report_summary(bench_summarize_ratio(series, &contest->glint)));
    return object;
}

static void print_line(const bench_scene *scene, const llvmpipe_contest *contest,
                       const bench_series *series, const bench_agreement *agreement,
                       const char *name)
{
    bench_report_line(&(bench_line){
        .scene = scene->name,
        .job = bench_job_name(BENCH_REFLECT),
        .glint_ms = bench_summarize(&contest->glint).median,
        .other_ms = bench_summarize(series).median,
        .ratio = bench_summarize_ratio(series, &contest->glint),
        .against = name,
        .agreement = agreement,
    });
}

void llvmpipe_report_contest(json_t *report, const bench_scene *scene,
                             const llvmpipe_contest *contest)
{
    json_t *object = bench_report_add_scene(report, scene);
    llvmpipe_texels best = llvmpipe_contest_best(contest);
    json_t *all = json_object();
    for (int i = 0; i < LLVMPIPE_TEXELS; i++) {
        glint_json_put(all, llvmpipe_texels_name((llvmpipe_texels)i),
                       series_object(contest, &contest->llvmpipe[i]));
    }
    json_t *one_ray = series_object(contest, &contest->one_ray);
    glint_json_put(one_ray, "agreement", bench_report_agreement(&contest->one_ray_agreement));
    glint_json_put(object, "glint_ms", bench_report_summary(bench_summarize(&contest->glint)));
    glint_json_put_text(object, "best", llvmpipe_texels_name(best));
    glint_json_put(object, "llvmpipe", all);
    glint_json_put(object, "agreement", bench_report_agreement(&contest->agreement));
    glint_json_put(object, "one_ray_a_work_item", one_ray);

    char name[64];
    snprintf(name, sizeof name, "llvmpipe, %s", llvmpipe_texels_name(best));
    print_line(scene, contest, &contest->llvmpipe[best], &contest->agreement, name);
    print_line(scene, contest, &contest->one_ray, &contest->one_ray_agreement,
               "glint, one ray a work-item");
}
