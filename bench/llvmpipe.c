// bench/llvmpipe: glint against Mesa's llvmpipe, in turns, on the same mirrors. bench/README.md
// says what is measured and what it means. Results go to stdout, chatter to stderr.
#include "llvmpipe_contest.h"
#include "llvmpipe_context.h"
#include "llvmpipe_report.h"
#include "options.h"

#include "report/json.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct request {
    char *scenes; // names with commas between, owned
    int width, height, rounds;
    const char *json;
    bool help;
} request;

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

enum { SCENES = 1, ROUNDS, SIZE, JSON, HELP };

static const struct option long_options[] = {
    {"scenes", required_argument, NULL, SCENES}, {"rounds", required_argument, NULL, ROUNDS},
    {"size", required_argument, NULL, SIZE},     {"json", required_argument, NULL, JSON},
    {"help", no_argument, NULL, HELP},           {NULL, 0, NULL, 0},
};

static glint_status take_option(int option, request *r, glint_error *error)
{
    glint_status status;
    double count = 0;
    switch (option) {
    case SCENES:
        return bench_set_text(&r->scenes, optarg, error);
    case ROUNDS:
        status = bench_parse_count("rounds", optarg, BENCH_ROUNDS_MAX, &count, error);
        r->rounds = (int)count;
        return status;
    case SIZE:
        return bench_parse_size(optarg, &r->width, &r->height, error);
    case JSON:
        r->json = optarg;
        return GLINT_OK;
    case HELP:
        r->help = true;
        return GLINT_OK;
    default:
        return glint_fail(error, GLINT_USAGE, "an option is unknown or lacks its value (--help)");
    }
}

static glint_status parse(int argc, char **argv, request *r, glint_error *error)
{
    *r = (request){.width = 1920, .height = 1088, .rounds = 9};
    glint_status status = bench_set_text(&r->scenes, "S0,S1", error);
    int option;
    opterr = 0;
    while (status == GLINT_OK && (option = getopt_long(argc, argv, "", long_options, NULL)) != -1) {
        status = take_option(option, r, error);
    }
    if (status == GLINT_OK && optind < argc) {
        status = glint_fail(error, GLINT_USAGE, "unexpected argument '%s'", argv[optind]);
    }
    return status;
}

// ---- Work --------------------------------------------------------------------------------------

// `stage` lacks its scene.
static glint_status run_scene(bench_stage stage, const char *name, json_t *report,
                              glint_error *error)
{
    fprintf(stderr, "%s\n", name);
    bench_scene scene = {0};
    llvmpipe_contest *contest = malloc(sizeof *contest);
    glint_status status = contest != NULL ? bench_scene_make(name, &scene, error)
                                          : glint_fail_memory(error, "a contest");
    if (status == GLINT_OK && !(scene.jobs & 1u << BENCH_REFLECT)) {
        status = glint_fail(error, GLINT_USAGE, "--scenes: '%s' is no mirror", name);
    }
    if (status == GLINT_OK) {
        stage.scene = &scene;
        status = llvmpipe_contest_run(&stage, contest, error);
    }
    if (status == GLINT_OK) {
        llvmpipe_report_contest(report, &scene, contest);
    }
    free(contest);
    bench_scene_free(&scene);
    return status;
}

static glint_status run_scenes(const request *r, const bench_stage *stage, json_t *report,
                               glint_error *error)
{
    glint_status status = GLINT_OK;
    char *rest = NULL;
    for (char *name = strtok_r(r->scenes, ",", &rest); status == GLINT_OK && name != NULL;
         name = strtok_r(NULL, ",", &rest)) {
        status = run_scene(*stage, name, report, error);
    }
    if (status == GLINT_OK && r->json != NULL) {
        return glint_json_write(r->json, report, error);
    }
    json_decref(report);
    return status;
}

static glint_status run(const request *r, glint_error *error)
{
    glint_environment environment = {0};
    llvmpipe_context *context = NULL;
    bench_stage stage = {
        .environment = &environment, .width = r->width, .height = r->height, .rounds = r->rounds};
    glint_status status = bench_environment_make(&environment, error);
    if (status == GLINT_OK) {
        status = glint_device_open("cpu", &stage.device, error);
    }
    if (status == GLINT_OK) {
        status = llvmpipe_context_create(&context, error);
    }
    if (status == GLINT_OK) {
        status = run_scenes(r, &stage, llvmpipe_report_create(&stage, context), error);
    }
    llvmpipe_context_free(context);
    glint_device_close(stage.device);
    glint_environment_free(&environment);
    return status;
}

int main(int argc, char **argv)
{
    request r;
    glint_error error = {0};
    glint_status status = parse(argc, argv, &r, &error);
    if (status == GLINT_OK && r.help) {
        fputs(help, stdout);
    } else if (status == GLINT_OK) {
        status = run(&r, &error);
    }
    if (status != GLINT_OK) {
        fprintf(stderr, "bench/llvmpipe: %s\n%s", error.message,
                error.details != NULL ? error.details : "");
    }
    glint_error_free(&error);
    free(r.scenes);
    return (int)status;
}
