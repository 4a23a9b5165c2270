// bench/embree: times glint against Embree, in turns, on the same scenes. bench/README.md explains
// the measurements. Results go to stdout, progress to stderr.
#include "embree/contest.h"
#include "embree/report.h"
#include "options.h"
#include "results.h"

#include "report/json.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SCENES_MAX 64
#define BUILD_ROUNDS 5

typedef struct request {
    bench_request shared;
    unsigned jobs;
    int sweep_rounds;
    bool medium_only, robust, list;
    const char *device;
    uint64_t leaks;
} request;

static const char help[] =
    "Usage: bench/run embree [options]\n"
    "\n"
    "Renders the same frames with glint and with Embree in turns, checks that they agree and\n"
    "prints how many times faster glint is.\n"
    "\n"
    "  --scenes LIST    S0, S1, S2, needles, stadium, G0 or ico:N, with commas between\n"
    "                   (all but ico:N)\n"
    "  --jobs LIST      traverse, reflect, refract, glass, build (all)\n"
    "  --rounds N       rounds of each, 1 to 1000 (9)\n"
    "  --size WxH       pixels, multiples of 16 (1920x1088)\n"
    "  --robust         give Embree's scenes RTC_SCENE_FLAG_ROBUST\n"
    "  --medium         leave Embree's trees of quality HIGH out, which take long to build\n"
    "  --device NAME    glint's OpenCL device, as `glint render` takes it (cpu)\n"
    "  --leaks N        count the rays that pass between S0's triangles, of the same N\n"
    "                   in Embree and in glint\n"
    "  --json FILE      write everything as JSON\n"
    "  --quick          S0 alone, traverse and reflect, 3 rounds\n"
    "  --list           list the scenes, their sizes and their jobs\n"
    "  --help\n"
    "\n"
    "Exit status: 0 done, 2 usage, 4 no device or it failed, 5 the file could not be written,\n"
    "7 the frames differ.\n";

// ---- Options -----------------------------------------------------------------------------------

#define JOB_BUILD BENCH_JOBS // after the jobs of bench_job

static glint_status parse_jobs(const char *text, unsigned *jobs, glint_error *error)
{
    *jobs = 0;
    for (const char *at = text; *at != '\0';) {
        size_t length = strcspn(at, ",");
        unsigned found = 0;
        for (int job = 0; job <= JOB_BUILD; job++) {
            const char *name = job == JOB_BUILD ? "build" : bench_job_name((bench_job)job);
            if (strlen(name) == length && strncmp(name, at, length) == 0) {
                found = 1u << job;
            }
        }
        if (found == 0) {
            return glint_fail(error, GLINT_USAGE,
                              "--jobs: '%.*s' is none (traverse, reflect, refract, glass, build)",
                              (int)length, at);
        }
        *jobs |= found;
        at += length + (at[length] == ',' ? 1 : 0);
    }
    return GLINT_OK;
}

enum { JOBS = BENCH_OWN_OPTIONS, MEDIUM, ROBUST, DEVICE, LEAKS, QUICK, LIST };

static const struct option long_options[] = {
    BENCH_SHARED_OPTIONS,
    {"jobs", required_argument, NULL, JOBS},
    {"medium", no_argument, NULL, MEDIUM},
    {"device", required_argument, NULL, DEVICE},
    {"leaks", required_argument, NULL, LEAKS},
    {"quick", no_argument, NULL, QUICK},
    {"list", no_argument, NULL, LIST},
    {"robust", no_argument, NULL, ROBUST},
    {NULL, 0, NULL, 0},
};

static glint_status take_option(int option, void *context, glint_error *error)
{
    request *r = context;
    glint_status status = GLINT_OK;
    double count = 0;
    switch (option) {
    case JOBS:
        return parse_jobs(optarg, &r->jobs, error);
    case MEDIUM:
        r->medium_only = true;
        return GLINT_OK;
    case ROBUST:
        r->robust = true;
        return GLINT_OK;
    case DEVICE:
        r->device = optarg;
        return GLINT_OK;
    case LEAKS:
        status = bench_parse_count("leaks", optarg, 1e12, &count, error);
        r->leaks = (uint64_t)count;
        return status;
    case QUICK:
        r->shared.rounds = 3;
        r->sweep_rounds = 2;
        r->jobs = 1u << BENCH_TRAVERSE | 1u << BENCH_REFLECT;
        return bench_set_text(&r->shared.scenes, "S0", error);
    case LIST:
        r->list = true;
        return GLINT_OK;
    default:
        return bench_take_option(option, &r->shared, error);
    }
}

static glint_status parse(int argc, char **argv, request *r, glint_error *error)
{
    *r = (request){.shared = {.width = 1920, .height = 1088, .rounds = 9},
                   .jobs = (1u << (JOB_BUILD + 1)) - 1,
                   .sweep_rounds = 3,
                   .device = "cpu"};
    TRY(bench_set_text(&r->shared.scenes, "S0,S1,S2,needles,stadium,G0", error));
    const bench_parser parser = {long_options, take_option, r};
    return bench_parse_options(argc, argv, &parser, error);
}

// ---- Work --------------------------------------------------------------------------------------

static glint_status list_scenes(glint_error *error)
{
    for (size_t i = 0; bench_scene_names[i] != NULL; i++) {
        bench_scene scene;
        glint_status status = bench_scene_make(bench_scene_names[i], &scene, error);
        if (status != GLINT_OK) {
            return status;
        }
        printf("%-8s %8zu triangles:", scene.name, scene.triangle_count);
        for (int job = 0; job < BENCH_JOBS; job++) {
            if (scene.jobs & 1u << job) {
                printf(" %s", bench_job_name((bench_job)job));
            }
        }
        printf("\n");
        bench_scene_free(&scene);
    }
    return GLINT_OK;
}

static glint_status run_build(const request *r, const bench_arena *arena, json_t *object,
                              glint_error *error)
{
    const int rounds = r->shared.rounds > BUILD_ROUNDS ? r->shared.rounds : BUILD_ROUNDS;
    bench_build build;
    fprintf(stderr, "%s: build\n", arena->stage.scene->name);
    TRY(bench_build_run(arena, rounds, &build, error));
    embree_report_build(object, &build);
    return GLINT_OK;
}

static glint_status run_jobs(const request *r, const bench_arena *arena, json_t *object,
                             glint_error *error)
{
    bench_contest *contest = malloc(sizeof *contest);
    if (contest == NULL) {
        return glint_fail_memory(error, "a contest");
    }
    glint_status status = GLINT_OK;
    for (int job = 0; job < BENCH_JOBS; job++) {
        if (arena->stage.scene->jobs & r->jobs & 1u << job) {
            fprintf(stderr, "%s: %s\n", arena->stage.scene->name, bench_job_name((bench_job)job));
            TRY_OR(cleanup, status, bench_contest_run(arena, (bench_job)job, contest, error));
            embree_report_contest(object, contest);
        }
    }
    if (r->jobs & 1u << JOB_BUILD) {
        status = run_build(r, arena, object, error);
    }
cleanup:
    free(contest);
    return status;
}

// Sets up Embree's side and runs the jobs. Fills in the scene and program of `arena`.
static glint_status run_scene(const request *r, bench_arena arena, const char *name, json_t *report,
                              glint_error *error)
{
    bench_scene scene;
    fprintf(stderr, "%s: making the scene and Embree's trees\n", name);
    glint_status status;
    TRY_OR(cleanup, status, bench_scene_make(name, &scene, error));
    const embree_inputs inputs = {
        .scene = &scene,
        .environment = &arena.stage.environment->radiance,
        .pool = arena.pool,
        .width = arena.stage.width,
        .height = arena.stage.height,
        .robust = arena.robust,
        .high = arena.high,
    };
    arena.stage.scene = &scene;
    TRY_OR(cleanup, status, embree_program_create(&inputs, &arena.program, error));
    TRY_OR(cleanup, status, run_jobs(r, &arena, embree_report_add_scene(report, &scene), error));
cleanup:
    embree_program_free(arena.program);
    bench_scene_free(&scene);
    return status;
}

static glint_status run_leaks(const request *r, const bench_arena *arena, json_t *report,
                              glint_error *error)
{
    bench_scene scene;
    glint_status status;
    TRY_OR(cleanup, status, bench_scene_make("S0", &scene, error));
    for (int robust = 0; robust < 2; robust++) {
        const embree_inputs inputs = {
            .scene = &scene,
            .environment = &arena->stage.environment->radiance,
            .pool = arena->pool,
            .width = arena->stage.width,
            .height = arena->stage.height,
            .robust = robust == 1,
        };
        embree_program *program;
        TRY_OR(cleanup, status, embree_program_create(&inputs, &program, error));
        embree_report_leaks(report, robust ? "Embree, ROBUST" : "Embree, default",
                            embree_program_leaks(program, r->leaks));
        embree_program_free(program);
    }
    leak_count leaks = {.rays = r->leaks / AIMED_RAYS_PER_ITEM * AIMED_RAYS_PER_ITEM};
    TRY_OR(
        cleanup, status,
        count_leaks_of_glint(&scene, arena->stage.environment, arena->stage.device, &leaks, error));
    embree_report_leaks(report, "glint", leaks);
cleanup:
    bench_scene_free(&scene);
    return status;
}

static glint_status run_scenes(const request *r, const bench_arena *arena, json_t *report,
                               glint_error *error)
{
    char *rest = NULL;
    bench_report_head("Embree");
    for (char *name = strtok_r(r->shared.scenes, ",", &rest); name != NULL;
         name = strtok_r(NULL, ",", &rest)) {
        TRY(run_scene(r, *arena, name, report, error));
    }
    return GLINT_OK;
}

static glint_status run_all(const request *r, const bench_arena *arena, json_t *report,
                            glint_error *error)
{
    const glint_status status =
        r->leaks > 0 ? run_leaks(r, arena, report, error) : run_scenes(r, arena, report, error);
    if (status == GLINT_OK && r->shared.json != NULL) {
        return glint_json_write(r->shared.json, report, error);
    }
    json_decref(report);
    return status;
}

static glint_status run(const request *r, glint_error *error)
{
    glint_environment environment = {0};
    bench_arena arena = {
        .stage = {.environment = &environment,
                  .width = r->shared.width,
                  .height = r->shared.height,
                  .rounds = r->shared.rounds},
        .sweep_rounds = r->sweep_rounds,
        .high = !r->medium_only,
        .robust = r->robust,
    };
    glint_status status;
    TRY_OR(cleanup, status, bench_environment_make(&environment, error));
    TRY_OR(cleanup, status, bench_pool_create(&arena.pool, error));
    TRY_OR(cleanup, status, glint_device_open(r->device, &arena.stage.device, error));
    TRY_OR(cleanup, status, run_all(r, &arena, embree_report_create(&arena), error));
cleanup:
    glint_device_close(arena.stage.device);
    bench_pool_free(arena.pool);
    glint_environment_free(&environment);
    return status;
}

int main(int argc, char **argv)
{
    request r;
    glint_error error = {0};
    glint_status status = parse(argc, argv, &r, &error);
    if (status == GLINT_OK && r.shared.help) {
        fputs(help, stdout);
    } else if (status == GLINT_OK && r.list) {
        status = list_scenes(&error);
    } else if (status == GLINT_OK) {
        status = run(&r, &error);
    }
    free(r.shared.scenes);
    return bench_finish("bench/embree", status, &error);
}
