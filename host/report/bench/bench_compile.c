// Measures how long the kernels take to compile, cold and warm. See bench.h.
//
// A compile time is cold only if no driver's cache holds the kernels. Two measures ensure this:
//   - The build options contain a new random number, and every cache's key includes the build
//   options.
//   - In the compiling children, the environment variables of the drivers' caches name an empty
//   folder.
//     So these builds do not pile up in the user's caches.
// A second child repeats the build for the warm time, with the same number and the same folder,
// which is now filled. A driver that ignores all the variables is still measured correctly; its
// cache keeps one more build.
#include "report/bench/bench.h"

#include "base/child.h"

#include <errno.h>
#include <ftw.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>

// Cache variables of PoCL, NVIDIA, Intel, AMD and Mesa. The last one is for drivers that follow the
// XDG specification.
static const char *const cache_variables[] = {
    "POCL_CACHE_DIR",      "CUDA_CACHE_PATH",       "NEO_CACHE_DIR",
    "AMD_COMGR_CACHE_DIR", "MESA_SHADER_CACHE_DIR", "XDG_CACHE_HOME",
};

typedef struct timed_build {
    const glint_bench_inputs *inputs;
    glint_settings settings; // with a new build tag
    const char *folder;
} timed_build;

static glint_status build_once(const timed_build *build, double *milliseconds, glint_error *error)
{
    glint_device *device = NULL;
    glint_renderer *renderer = NULL;
    glint_status status;
    TRY_OR(cleanup, status, glint_device_open(build->inputs->device, &device, error));
    const glint_renderer_inputs inputs = {
        .device = device,
        .scene = build->inputs->scene,
        .environment = build->inputs->environment,
        .settings = &build->settings,
        .kernel_dir = build->inputs->kernel_dir,
    };
    TRY_OR(cleanup, status, glint_renderer_create(&inputs, &renderer, error));
    *milliseconds = glint_renderer_phases(renderer)->kernel_build;
cleanup:
    glint_renderer_free(renderer);
    glint_device_close(device);
    return status;
}

// Runs in the child: builds the kernels and reports the time.
static glint_status work(void *context, char **text, glint_error *error)
{
    const timed_build *build = context;
    for (size_t i = 0; i < sizeof cache_variables / sizeof *cache_variables; i++) {
        setenv(cache_variables[i], build->folder, 1);
    }
    double milliseconds = 0;
    TRY(build_once(build, &milliseconds, error));
    if (asprintf(text, "%.17g", milliseconds) < 0) {
        *text = NULL;
        return glint_fail_memory(error, "a compile time");
    }
    return GLINT_OK;
}

static glint_status time_build(const glint_child *child, double *milliseconds, glint_error *error)
{
    char *text;
    glint_status status;
    TRY_OR(cleanup, status, glint_child_run(child, &text, error));
    *milliseconds = strtod(text, NULL);
cleanup:
    free(text);
    return status;
}

static int remove_entry(const char *path, const struct stat *facts, int kind, struct FTW *where)
{
    (void)facts;
    (void)kind;
    (void)where;
    return remove(path);
}

static uint32_t new_tag(void)
{
    uint32_t tag = 0;
    while (tag == 0 && getrandom(&tag, sizeof tag, 0) < 0 && errno == EINTR) {
    }
    return tag;
}

glint_status glint_bench_compile_time(const glint_bench_inputs *inputs,
                                      bool (*stop_requested)(void), glint_compile_time *result,
                                      glint_error *error)
{
    *result = (glint_compile_time){0};
    const char *base = getenv("TMPDIR");
    char folder[4096];
    int length = snprintf(folder, sizeof folder, "%s/glint-bench-XXXXXX",
                          base != NULL && base[0] != '\0' ? base : "/tmp");
    if (length >= (int)sizeof folder || mkdtemp(folder) == NULL) {
        return glint_fail(error, GLINT_OUTPUT_FAILED, "%s: no temporary folder can be made: %s",
                          folder, strerror(errno));
    }
    timed_build build = {.inputs = inputs, .settings = *inputs->settings, .folder = folder};
    build.settings.build_tag = new_tag();
    const glint_child child = {
        .work = work, .context = &build, .stop_requested = stop_requested, .is_expendable = true};
    glint_status status;
    TRY_OR(cleanup, status, time_build(&child, &result->cold, error));
    TRY_OR(cleanup, status, time_build(&child, &result->warm, error));
cleanup:
    nftw(folder, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
    return status;
}
