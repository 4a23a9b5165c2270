// Implements glint selftest: runs the hard cases on any device and judges them by closed forms and
// in double precision.
#include "cli/commands.h"
#include "cli/common/options.h"
#include "cli/common/say.h"

#include "base/parallel.h"
#include "cli/common/file_names.h"
#include "cli/common/json_output.h"
#include "cli/selftest/expectations.h"
#include "cli/selftest/pool.h"
#include "cli/selftest/selftest_table.h"
#include "image/output_file.h"
#include "report/machine.h"
#include "report/selftest/junit.h"
#include "report/selftest/selftest_json.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define CASES_MAX 128
#define DEFAULT_LIMIT (-1.0) // seconds per case; stands for an option that is not given

// The cases chosen with --case.
typedef struct case_selection {
    bool any;
    bool has[CASES_MAX];
} case_selection;

// The options of glint selftest.
typedef struct selftest_request {
    bool list, quick;
    case_selection cases;
    bool fail_fast;
    const char *device;
    const char *kernel_dir;
    int width;     // index into `widths`
    int precision; // index into the choices of --precision
    int kernels;   // index into the choices of --kernels
    double rays;
    int seed;
    int jobs;       // cases that run at the same time; 0: not given
    double limit_s; // seconds per case; 0: no limit
    const char *expect;
    const char *junit, *json;
} selftest_request;

// Both lists are in the order of the options' choices.
static const int widths[] = {0, 1, 8, 16};
enum { ALL_WIDTHS = 4 };
enum { NOT_GIVEN = -1 };
enum { FLOAT, DOUBLE, ALL_PRECISIONS };
enum { SPECIAL, GENERAL };

// ---- Options -----------------------------------------------------------------------------------

static size_t case_count(void)
{
    size_t count = 0;
    while (glint_selftest_name(count) != NULL) {
        count++;
    }
    return count;
}

static glint_status fail_unknown_case(const glint_option *option, const char *name,
                                      glint_error *error)
{
    const char *names[CASES_MAX + 1] = {NULL};
    for (size_t i = 0; i < case_count(); i++) {
        names[i] = glint_selftest_name(i);
    }
    const char *nearest = glint_nearest_word(name, names);
    if (nearest != NULL) {
        return glint_fail(error, GLINT_USAGE, "--%s: unknown case '%s' (did you mean %s?)",
                          option->name, name, nearest);
    }
    return glint_fail(error, GLINT_USAGE,
                      "--%s: unknown case '%s' (glint selftest --list has them)", option->name,
                      name);
}

// Adds the cases of one --case option: a name, or several names separated by commas.
static glint_status parse_cases(const glint_option *option, const char *text, void *destination,
                                glint_error *error)
{
    case_selection *cases = destination;
    cases->any = true;
    while (true) {
        char name[64];
        const size_t length = strcspn(text, ",");
        snprintf(name, sizeof name, "%.*s", (int)length, text);
        size_t i = 0;
        while (glint_selftest_name(i) != NULL && strcmp(glint_selftest_name(i), name) != 0) {
            i++;
        }
        if (glint_selftest_name(i) == NULL) {
            return fail_unknown_case(option, name, error);
        }
        cases->has[i] = true;
        if (text[length] == '\0') {
            return GLINT_OK;
        }
        text += length + 1;
    }
}

static const glint_option selftest_options[] = {
    {GLINT_OPTION_HEADING, .help = "What is run"},
    {GLINT_OPTION_FLAG, .name = "list",
     .help = "Print the cases, a line each, and run none; with --quick or --case, those chosen.",
     .offset = offsetof(selftest_request, list)},
    {GLINT_OPTION_FLAG, .name = "quick",
     .help = "Run the cases that cover most kernels, in float and with few rays. They take about a "
             "minute. --case, --precision and --rays override this choice.",
     .offset = offsetof(selftest_request, quick)},
    {GLINT_OPTION_CUSTOM, .name = "case", .argument = "NAME[,NAME…]",
     .help = "Run only these cases. Can be repeated.", .fallback = "all",
     .offset = offsetof(selftest_request, cases), .parse = parse_cases},
    {GLINT_OPTION_CHOICE, .name = "precision", .argument = "P",
     .help = "float, double, or all: both, double where the device has it.",
     .fallback = "all; with --quick float", .offset = offsetof(selftest_request, precision),
     .choices = GLINT_CHOICES("float", "double", "all")},
    {GLINT_OPTION_CHOICE, .name = "kernel-width", .argument = "N",
     .help = "Rays of a packet: 1, 8 or 16; auto: what the device renders with; all: the three, "
             "one after the other.",
     .fallback = "auto", .offset = offsetof(selftest_request, width),
     .choices = GLINT_CHOICES("auto", "1", "8", "16", "all")},
    {GLINT_OPTION_CHOICE, .name = "kernels", .argument = "KIND",
     .help = "special: the kernels that frames of such scenes have, compiled for each case. "
             "general: those of glint warm, where they serve; a tenth of the time.",
     .fallback = "special; with --quick general", .offset = offsetof(selftest_request, kernels),
     .choices = GLINT_CHOICES("special", "general")},
    {GLINT_OPTION_REAL, .name = "rays", .argument = "N",
     .help = "Rays for each case that counts leaks.", .fallback = "262144; with --quick 16384",
     .offset = offsetof(selftest_request, rays), .minimum = 1, .maximum = GLINT_SELFTEST_RAYS_MAX},
    {GLINT_OPTION_INT, .name = "seed", .argument = "N",
     .help = "Draw other rays, angles and places. The bounds stay the same.", .fallback = "0",
     .offset = offsetof(selftest_request, seed), .minimum = 0, .maximum = 2147483647},
    {GLINT_OPTION_REAL, .name = "case-timeout", .argument = "SECONDS",
     .help = "Time limit of a case. A slower case is broken: the driver hangs. 0: no limit.",
     .fallback = "900, and none with more rays", .offset = offsetof(selftest_request, limit_s),
     .minimum = 0, .maximum = 1e6},
    {GLINT_OPTION_INT, .name = "jobs", .argument = "N",
     .help = "Number of cases that run at the same time, each in its own process.",
     .fallback = "1; with --quick as many as there are processors, up to 4",
     .offset = offsetof(selftest_request, jobs), .minimum = 1, .maximum = SELFTEST_WORKERS_MAX},
    {GLINT_OPTION_FLAG, .name = "fail-fast", .help = "Stop after the first case that fails.",
     .offset = offsetof(selftest_request, fail_fast)},
    {GLINT_OPTION_HEADING, .help = "Device"},
    {GLINT_OPTION_TEXT, .name = "device", .argument = "DEVICE",
     .help = "Its number or a part of its name (glint devices), cpu or gpu.",
     .fallback = "the first GPU, else the CPU", .offset = offsetof(selftest_request, device)},
    {GLINT_OPTION_TEXT, .name = "kernel-dir", .argument = "DIR",
     .help = "Compile the kernels in this folder instead of those in the program.",
     .offset = offsetof(selftest_request, kernel_dir)},
    {GLINT_OPTION_HEADING, .help = "Results"},
    {GLINT_OPTION_TEXT, .name = "expect", .argument = "FILE",
     .help = "Known failures, which do not count. Each line names a case. float, double, 1, 8 or "
             "16 behind the name limit the line to this precision or packet width. glint names "
             "listed cases that pass.",
     .offset = offsetof(selftest_request, expect)},
    {GLINT_OPTION_TEXT, .name = "junit", .argument = "FILE",
     .help = "Write the results as JUnit's XML.", .offset = offsetof(selftest_request, junit)},
    {GLINT_OPTION_TEXT, .name = "json", .argument = "FILE|-",
     .help = "Write the results as JSON; - prints it instead of the table.",
     .offset = offsetof(selftest_request, json)},
    GLINT_OPTION_END,
};

static const glint_option *const groups[] = {selftest_options, NULL};

static void set_defaults(void *context)
{
    selftest_request *request = context;
    request->precision = NOT_GIVEN;
    request->kernels = NOT_GIVEN;
    request->limit_s = DEFAULT_LIMIT;
    request->rays = 0;
}

// Fills in the options that were not given; some defaults depend on other options.
static void complete(selftest_request *request)
{
    if (request->precision == NOT_GIVEN) {
        request->precision = request->quick ? FLOAT : ALL_PRECISIONS;
    }
    if (request->kernels == NOT_GIVEN) {
        request->kernels = request->quick ? GENERAL : SPECIAL;
    }
    if (request->jobs == 0) {
        const int processors = glint_usable_cores();
        request->jobs = !request->quick ? 1 : processors < 4 ? processors : 4;
    }
    if (request->rays == 0) {
        request->rays = request->quick ? GLINT_SELFTEST_QUICK_RAYS : GLINT_SELFTEST_RAYS;
    }
    for (size_t i = 0; request->quick && !request->cases.any && i < case_count(); i++) {
        request->cases.has[i] = glint_selftest_is_quick(i);
    }
    request->cases.any = request->cases.any || request->quick;
}

static bool is_chosen(const selftest_request *request, size_t index)
{
    return !request->cases.any || request->cases.has[index];
}

static glint_status check_request(const selftest_request *request, glint_error *error)
{
    const bool writes_json = request->json != NULL && !glint_is_stdout(request->json);
    struct stat facts;
    if (request->kernel_dir != NULL &&
        (stat(request->kernel_dir, &facts) != 0 || !S_ISDIR(facts.st_mode))) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: no such folder (--kernel-dir)",
                          request->kernel_dir);
    }
    if (writes_json && glint_same_file(request->json, request->junit)) {
        return glint_fail(error, GLINT_USAGE, "--json %s: --junit writes there (name another file)",
                          request->json);
    }
    if (request->junit != NULL) {
        TRY(glint_output_file_check(request->junit, error));
    }
    if (writes_json) {
        TRY(glint_output_file_check(request->json, error));
    }
    return GLINT_OK;
}

// ---- Running -----------------------------------------------------------------------------------

// The state of a self-test: its cases and their results.
typedef struct selftest_work {
    const selftest_request *request;
    selftest_pool pool;
    selftest_job *jobs;             // owned
    glint_selftest_result *results; // owned, in the order of `jobs`
    size_t count;                   // results taken so far
    size_t troubled;                // failed or broken, unexpectedly
    size_t expected;                // failed or broken, as --expect says
    selftest_expectations expectations;
    bool log_printed;
} selftest_work;

static const glint_capabilities *capabilities_of(const selftest_work *work)
{
    return &work->pool.workers[0].capabilities;
}

static bool prints_table(const selftest_work *work)
{
    return !glint_is_stdout(work->request->json);
}

// With --fail-fast, stops the run after the first failure.
static bool has_enough(const void *context)
{
    const selftest_work *work = context;
    return work->request->fail_fast && work->troubled > 0;
}

static bool has_trouble(const glint_selftest_result *result)
{
    return result->verdict == GLINT_FAILED || result->verdict == GLINT_BROKEN;
}

static bool is_troubled(const glint_selftest_result *result)
{
    return has_trouble(result) && !result->expected;
}

// Marks a failure that the --expect file lists. Warns if a listed case passes.
static void compare_to_expectations(const selftest_work *work, glint_selftest_result *result)
{
    const int line = selftest_expectation_of(&work->expectations, result);
    result->expected = line > 0 && has_trouble(result);
    if (line > 0 && result->verdict == GLINT_PASSED) {
        glint_say("warning: %s: line %d: %s passes, %s, packets of %d (take the line out)",
                  work->expectations.path, line, result->name,
                  result->precision == GLINT_PRECISION_DOUBLE ? "double" : "float", result->width);
    }
}

// Takes the result of a job: counts it, prints it, and shows the driver's log.
static glint_status take_result(void *context, selftest_job *job, glint_error *error)
{
    selftest_work *work = context;
    glint_selftest_result *result = job->result;
    glint_error trouble = job->error;
    job->error = (glint_error){0};
    work->count++;
    if (job->status != GLINT_OK) {
        glint_error_free(error);
        *error = trouble;
        return job->status;
    }
    compare_to_expectations(work, result);
    work->troubled += is_troubled(result);
    work->expected += result->expected;
    if (prints_table(work)) {
        if (work->count == 1) {
            glint_selftest_print_device(capabilities_of(work), stdout);
        }
        if (job->is_first) {
            glint_selftest_print_head(result, stdout);
        }
        glint_selftest_print(result, stdout);
        fflush(stdout);
    }
    // Print the log of a driver only once: a driver that fails at one kernel usually fails at all
    // of them.
    if (trouble.details != NULL && !work->log_printed) {
        glint_say_error(&trouble);
        work->log_printed = true;
    }
    glint_error_free(&trouble);
    return GLINT_OK;
}

static void add_jobs(selftest_work *work, int width, glint_precision precision)
{
    const selftest_request *request = work->request;
    const glint_selftest_options options = {
        .kernel_dir = request->kernel_dir,
        .width = width,
        .precision = precision,
        .kernels = request->kernels == GENERAL ? GLINT_KERNELS_GENERAL : GLINT_KERNELS_SPECIAL,
        .rays = (uint64_t)request->rays,
        .seed = (uint32_t)request->seed};
    bool is_first = true;
    for (size_t i = 0; glint_selftest_name(i) != NULL; i++) {
        if (is_chosen(request, i)) {
            const size_t number = work->pool.job_count++;
            work->jobs[number] = (selftest_job){.index = i,
                                                .is_first = is_first,
                                                .options = options,
                                                .result = &work->results[number]};
            is_first = false;
        }
    }
}

static glint_status run_all(selftest_work *work, glint_error *error)
{
    const selftest_request *request = work->request;
    const bool has_double = capabilities_of(work)->has_double;
    for (int w = 0; w < ALL_WIDTHS; w++) {
        const bool all = request->width == ALL_WIDTHS;
        if (all ? w == 0 : w != request->width) {
            continue;
        }
        for (int p = FLOAT; p <= DOUBLE; p++) {
            // Without double precision on the device, "all" leaves it out. An explicit "double"
            // makes every case skipped.
            const bool wanted = request->precision == ALL_PRECISIONS ? p == FLOAT || has_double
                                                                     : p == request->precision;
            if (wanted) {
                add_jobs(work, widths[w],
                         p == DOUBLE ? GLINT_PRECISION_DOUBLE : GLINT_PRECISION_FLOAT);
            }
        }
    }
    work->pool.jobs = work->jobs;
    return selftest_pool_run(&work->pool, &(selftest_taker){take_result, has_enough, work}, error);
}

static glint_status write_reports(const selftest_work *work, glint_error *error)
{
    glint_machine machine;
    glint_machine_describe(&machine);
    const selftest_request *request = work->request;
    const glint_selftest_run_report run = {
        .device = capabilities_of(work),
        .date = machine.date,
        .machine = machine.system,
        .rays = (uint64_t)request->rays,
        .seed = (uint32_t)request->seed,
        .results = work->results,
        .count = work->count,
    };
    if (request->junit != NULL) {
        TRY(glint_junit_write(request->junit, &run, error));
    }
    if (request->json != NULL) {
        TRY(glint_write_json(request->json, glint_selftest_json(&run), error));
    }
    return GLINT_OK;
}

// True if the same case failed before, at another width or precision.
static bool is_named_before(const selftest_work *work, size_t index)
{
    const char *name = work->results[index].name;
    bool named = false;
    for (size_t i = 0; i < index; i++) {
        named =
            named || (is_troubled(&work->results[i]) && strcmp(work->results[i].name, name) == 0);
    }
    return named;
}

// Prints the result, or fails with a message such as "3 of 84 cases failed: slivers, drift, prism".
static glint_status give_verdict(const selftest_work *work, glint_error *error)
{
    if (work->troubled == 0) {
        if (prints_table(work) && work->expected > 0) {
            printf("\n%zu cases: %zu failed as expected, the others are within their bounds\n",
                   work->count, work->expected);
        } else if (prints_table(work)) {
            printf("\n%zu cases, all of them within their bounds\n", work->count);
        }
        return GLINT_OK;
    }
    char names[512] = "";
    for (size_t i = 0; i < work->count; i++) {
        const size_t used = strlen(names), room = sizeof names - used;
        if (!is_troubled(&work->results[i]) || is_named_before(work, i)) {
            continue;
        }
        const char *comma = used > 0 ? ", " : "";
        if ((size_t)snprintf(NULL, 0, "%s%s, …", comma, work->results[i].name) >= room) {
            snprintf(names + used, room, "%s…", comma);
            break;
        }
        snprintf(names + used, room, "%s%s", comma, work->results[i].name);
    }
    return glint_fail(error, GLINT_MISMATCH, "%zu of %zu cases failed on '%s': %s", work->troubled,
                      work->count, capabilities_of(work)->name, names);
}

static void print_list(const selftest_request *request)
{
    for (size_t i = 0; glint_selftest_name(i) != NULL; i++) {
        if (is_chosen(request, i)) {
            printf("%-23s %s\n", glint_selftest_name(i), glint_selftest_summary(i));
        }
    }
}

static glint_status selftest(const selftest_request *request, glint_error *error)
{
    selftest_work work = {.request = request};
    const size_t most = (case_count() + 1) * ALL_WIDTHS * ALL_PRECISIONS;
    work.results = calloc(most, sizeof *work.results);
    work.jobs = calloc(most, sizeof *work.jobs);
    glint_status status = GLINT_OK;
    if (work.results == NULL || work.jobs == NULL) {
        status = glint_fail_memory(error, "the results");
        goto cleanup;
    }
    if (request->expect != NULL) {
        TRY_OR(cleanup, status,
               selftest_expectations_read(request->expect, &work.expectations, error));
    }
    const bool many_rays = request->rays > (double)GLINT_SELFTEST_RAYS;
    work.pool.workers[0].device = request->device;
    work.pool.workers[0].limit_s = request->limit_s >= 0 ? request->limit_s : many_rays ? 0 : 900;
    TRY_OR(cleanup, status, selftest_pool_start(&work.pool, request->jobs, error));
    TRY_OR(cleanup, status, run_all(&work, error));
    TRY_OR(cleanup, status, write_reports(&work, error));
    TRY_OR(cleanup, status, give_verdict(&work, error));
cleanup:
    selftest_pool_stop(&work.pool);
    selftest_expectations_free(&work.expectations);
    for (size_t i = 0; work.jobs != NULL && i < work.pool.job_count; i++) {
        // Only jobs whose results were not taken still have an error.
        glint_error_free(&work.jobs[i].error);
    }
    free(work.jobs);
    free(work.results);
    return status;
}

static glint_status run(void *context, const glint_arguments *arguments, glint_error *error)
{
    (void)arguments;
    selftest_request *request = context;
    complete(request);
    if (request->list) {
        print_list(request);
        return GLINT_OK;
    }
    TRY(check_request(request, error));
    return selftest(request, error);
}

const glint_command glint_command_selftest = {
    .name = "selftest",
    .summary = "the numerical hard cases, on any device",
    .synopsis = "[options]",
    .description =
        "Runs hard cases of ray tracing through the kernels on the device: edges and vertices, "
        "slivers, self-hits, the critical angle, missing normals, seams of the environment, and "
        "more. Closed forms and double precision judge the results. Every measure has a bound, "
        "derived from the rounding error u. glint explains each measure that exceeds its bound, "
        "and exits with status 7. The self-test needs no files.",
    .examples = "  glint selftest\n"
                "  glint selftest --quick\n"
                "  glint selftest --device gpu --junit selftest.xml\n"
                "  glint selftest --case slivers,prism --kernel-width all\n"
                "  glint selftest --expect known.txt --junit selftest.xml\n"
                "  glint selftest --case rays_at_vertices --rays 1e8\n",
    .groups = groups,
    .request_size = sizeof(selftest_request),
    .set_defaults = set_defaults,
    .run = run,
};
