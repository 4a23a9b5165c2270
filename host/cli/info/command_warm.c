// Implements glint warm: compiles the general kernels, so that no frame waits for them.
#include "cli/commands.h"
#include "cli/common/options.h"

#include "base/child.h"
#include "base/parallel.h"
#include "device/device.h"
#include "device/driver_cache.h"
#include "render/general.h"

#include <stdio.h>
#include <stdlib.h>

enum { NOT_GIVEN = -1, FLOAT, DOUBLE, BOTH };

// The options of glint warm.
typedef struct warm_request {
    const char *device;
    int precision; // FLOAT (also if NOT_GIVEN), DOUBLE or BOTH
    bool lists;
    const char *build_options; // of special kernels; NULL: general kernels
} warm_request;

static const glint_option options[] = {
    {GLINT_OPTION_HEADING, .help = "Options"},
    {GLINT_OPTION_TEXT, .name = "device", .argument = "DEVICE",
     .help = "The device: an index or a part of its name, see glint devices.",
     .fallback = "the first GPU, else the first CPU", .offset = offsetof(warm_request, device)},
    {GLINT_OPTION_CHOICE, .name = "precision", .argument = "KIND",
     .help = "The kernels for float frames, for double frames, or both.", .fallback = "float",
     .offset = offsetof(warm_request, precision),
     .choices = GLINT_CHOICES("float", "double", "both")},
    {GLINT_OPTION_FLAG, .name = "lists",
     .help = "Also the kernels that render lists of pixels, which --max-error and --mend need.",
     .offset = offsetof(warm_request, lists)},
    {GLINT_OPTION_TEXT, .name = "build-options", .argument = "TEXT",
     .help =
         "Instead, the special kernels of a scene: plan.build_options of glint info SCENE --json.",
     .offset = offsetof(warm_request, build_options)},
    GLINT_OPTION_END,
};

static const glint_option *const groups[] = {options, NULL};

// A kernel to compile.
typedef struct job {
    const char *device; // as glint_device_open expects it
    glint_general_request kernel;
    const char *build_options; // of special kernels instead; NULL: none
} job;

#define MOST_JOBS (4 * (GLINT_KERNEL_KINDS - 1))

static glint_status compile(void *context, char **text, glint_error *error)
{
    const job *j = context;
    glint_device *device = NULL;
    glint_compile_report report;
    glint_status status;
    TRY(glint_device_open(j->device, &device, error));
    TRY_OR(cleanup, status,
           j->build_options != NULL
               ? glint_special_compile(device, j->build_options, &report, error)
               : glint_general_compile(device, &j->kernel, &report, error));
    if (report.is_needless) {
        goto cleanup;
    }
    if (asprintf(text, "%-22s %-6s %-5s  %-8s  %5.1f s\n", glint_kernel_kind_name(j->kernel.kind),
                 j->build_options != NULL                        ? ""
                 : j->kernel.precision == GLINT_PRECISION_DOUBLE ? "double"
                                                                 : "float",
                 j->build_options != NULL ? ""
                 : j->kernel.for_lists    ? "lists"
                                          : "tiles",
                 report.was_cached ? "cached" : "compiled", report.ms / 1000) < 0) {
        *text = NULL;
        status = glint_fail_memory(error, "a line");
    }
cleanup:
    glint_device_close(device);
    return status;
}

// Lists the kernels, the largest first: it takes longest.
static size_t list_jobs(const warm_request *request, job jobs[MOST_JOBS])
{
    const int wanted = request->precision == NOT_GIVEN ? FLOAT : request->precision;
    size_t count = 0;
    if (request->build_options != NULL) {
        jobs[0] = (job){.device = request->device, .build_options = request->build_options};
        return 1;
    }
    for (int kind = GLINT_KERNEL_KINDS - 1; kind > GLINT_KERNEL_SPECIAL; kind--) {
        for (int i = 0; i < 4; i++) {
            const int precision = i % 2, for_lists = i / 2;
            if ((wanted == precision || wanted == BOTH) && (!for_lists || request->lists)) {
                jobs[count++] = (job){
                    .device = request->device,
                    .kernel = {(glint_kernel_kind)kind, (glint_precision)precision, for_lists != 0},
                };
            }
        }
    }
    return count;
}

static void set_defaults(void *context)
{
    ((warm_request *)context)->precision = NOT_GIVEN;
}

static glint_status run(void *context, const glint_arguments *arguments, glint_error *error)
{
    (void)arguments;
    const warm_request *request = context;
    job jobs[MOST_JOBS];
    glint_status status = GLINT_OK;
    if (request->build_options != NULL && (request->precision != NOT_GIVEN || request->lists)) {
        return glint_fail(error, GLINT_USAGE,
                          "--build-options: they hold the precision and what is rendered already "
                          "(leave out --precision and --lists)");
    }
    glint_driver_cache_prepare(); // here, so that the children share a temporary cache
    const size_t count = list_jobs(request, jobs);
    // A driver may compile one program at a time: PoCL does. So each job has a process of its own.
    glint_child children[MOST_JOBS];
    glint_child_answer answers[MOST_JOBS];
    for (size_t i = 0; i < count; i++) {
        children[i] = (glint_child){.work = compile, .context = &jobs[i], .is_expendable = true};
    }
    glint_children_run(children, count, glint_usable_cores(), answers);
    for (size_t i = 0; i < count; i++) {
        if (answers[i].status == GLINT_OK) {
            printf("%s", answers[i].text);
        } else if (status == GLINT_OK) {
            status = answers[i].status; // of the first that failed
            *error = answers[i].error;
        } else {
            glint_error_free(&answers[i].error);
        }
        free(answers[i].text);
    }
    return status;
}

const glint_command glint_command_warm = {
    .name = "warm",
    .summary = "compile the general kernels ahead of time",
    .synopsis = "[options]",
    .description =
        "Compiles the general kernels, which serve most scenes, into the driver's cache. Frames of "
        "new scenes then begin at once. ./glint does it at the end of its build. PoCL's cache is "
        "the folder POCL_CACHE_DIR, or ~/.cache/pocl/kcache: machines of one kind may share it, "
        "and a container may ship it.",
    .examples = "  glint warm\n"
                "  POCL_CACHE_DIR=/shared/kernels glint warm --precision both\n",
    .groups = groups,
    .request_size = sizeof(warm_request),
    .set_defaults = set_defaults,
    .run = run,
};
