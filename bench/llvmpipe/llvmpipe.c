// bench/llvmpipe: times glint against Mesa's llvmpipe, in turns, on the same mirrors.
// bench/README.md explains the measurements. Results go to stdout, progress to stderr.
#include "llvmpipe/contest.h"
#include "llvmpipe/context.h"
#include "llvmpipe/report.h"
#include "options.h"

#include "report/json.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "Usage: bench/run llvmpipe [options]\n"
    "\n"
    "Draws the same mirrors with glint and with Mesa's llvmpipe (OpenGL on the processor) in\n"
    "turns, checks that the frames agree and prints how many times faster glint is.\n"
    "\n"
    "  --scenes LIST    S0, S1, S2, stadium or ico:N, with commas between (S0,S1)\n"
    "  --rounds N       rounds of each, 1 to 1000 (9)\n"
    "  --size WxH       pixels, multiples of 16 (1920x1088)\n"
    "  --json FILE      write everything as JSON\n"
    "  --help\n"
    "\n"
    "Exit status: 0 done, 2 usage, 4 no device or it failed, 5 the file could not be written,\n"
    "7 the frames differ.\n";

// ---- Options -----------------------------------------------------------------------------------

static const struct option long_options[] = {BENCH_SHARED_OPTIONS, {NULL, 0, NULL, 0}};

static glint_status take_option(int option, void *request, glint_error *error)
{
    return bench_take_option(option, request, error);
}

static glint_status parse(int argc, char **argv, bench_request *r, glint_error *error)
{
    *r = (bench_request){.width = 1920, .height = 1088, .rounds = 9};
    TRY(bench_set_text(&r->scenes, "S0,S1", error));
    const bench_parser parser = {long_options, take_option, r};
    return bench_parse_options(argc, argv, &parser, error);
}

// ---- Work --------------------------------------------------------------------------------------

// Runs one scene. `stage` comes without its scene.
static glint_status run_scene(bench_stage stage, const char *name, json_t *report,
                              glint_error *error)
{
    fprintf(stderr, "%s\n", name);
    bench_scene scene = {0};
    llvmpipe_contest *contest = malloc(sizeof *contest);
    glint_status status;
    TRY_OR(cleanup, status,
           contest != NULL ? bench_scene_make(name, &scene, error)
                           : glint_fail_memory(error, "a contest"));
    if (!(scene.jobs & 1u << BENCH_REFLECT)) {
        status = glint_fail(error, GLINT_USAGE, "--scenes: '%s' is no mirror", name);
        goto cleanup;
    }
    stage.scene = &scene;
    TRY_OR(cleanup, status, llvmpipe_contest_run(&stage, contest, error));
    llvmpipe_report_contest(report, &scene, contest);
cleanup:
    free(contest);
    bench_scene_free(&scene);
    return status;
}

static glint_status run_scenes(const bench_request *r, const bench_stage *stage, json_t *report,
                               glint_error *error)
{
    char *rest = NULL;
    for (char *name = strtok_r(r->scenes, ",", &rest); name != NULL;
         name = strtok_r(NULL, ",", &rest)) {
        TRY(run_scene(*stage, name, report, error));
    }
    return GLINT_OK;
}

static glint_status run_all(const bench_request *r, const bench_stage *stage, json_t *report,
                            glint_error *error)
{
    const glint_status status = run_scenes(r, stage, report, error);
    if (status == GLINT_OK && r->json != NULL) {
        return glint_json_write(r->json, report, error);
    }
    json_decref(report);
    return status;
}

static glint_status run(const bench_request *r, glint_error *error)
{
    glint_environment environment = {0};
    llvmpipe_context *context = NULL;
    bench_stage stage = {
        .environment = &environment, .width = r->width, .height = r->height, .rounds = r->rounds};
    glint_status status;
    TRY_OR(cleanup, status, bench_environment_make(&environment, error));
    TRY_OR(cleanup, status, glint_device_open("cpu", &stage.device, error));
    TRY_OR(cleanup, status, llvmpipe_context_create(&context, error));
    TRY_OR(cleanup, status, run_all(r, &stage, llvmpipe_report_create(&stage, context), error));
cleanup:
    llvmpipe_context_free(context);
    glint_device_close(stage.device);
    glint_environment_free(&environment);
    return status;
}

int main(int argc, char **argv)
{
    bench_request r;
    glint_error error = {0};
    glint_status status = parse(argc, argv, &r, &error);
    if (status == GLINT_OK && r.help) {
        fputs(help, stdout);
    } else if (status == GLINT_OK) {
        status = run(&r, &error);
    }
    free(r.scenes);
    return bench_finish("bench/llvmpipe", status, &error);
}
