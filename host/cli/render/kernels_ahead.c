// Compiles special kernels in another process. See kernels_ahead.h.
#include "cli/render/kernels_ahead.h"

#include "base/spawn.h"

#include <stdio.h>
#include <sys/wait.h>

// Special kernels save up to a third of the time. Compiling them takes a core for 2 to 5 s.
#define WORTH_MS 60000

// PoCL compiles one program at a time in a process, and its cache serves all. So a process of its
// own compiles; it prints nothing.
static bool start(const glint_plan *plan, const glint_capabilities *device, pid_t *process)
{
    char program[] = "glint", command[] = "warm", option[] = "--build-options";
    char by[] = "--device", number[16], options[GLINT_BUILD_OPTIONS_BYTES];
    char *const arguments[] = {program, command, by, number, option, options, NULL};
    snprintf(number, sizeof number, "%d", device->index);
    glint_plan_build_options(plan, options);
    return glint_spawn("/proc/self/exe", arguments, -1, process) == 0;
}

void render_kernels_ahead_consider(render_kernels_ahead *ahead, const glint_renderer *renderer,
                                   const glint_capabilities *device, double left_ms)
{
    if (ahead->process > 0 && waitpid(ahead->process, NULL, WNOHANG) == ahead->process) {
        ahead->process = 0;
    }
    if (!ahead->was_started && left_ms > WORTH_MS && glint_renderer_wants_special(renderer)) {
        ahead->was_started = true;
        if (!start(glint_renderer_plan(renderer), device, &ahead->process)) {
            ahead->process = 0;
        }
    }
}

void render_kernels_ahead_end(render_kernels_ahead *ahead)
{
    if (ahead->process > 0) {
        (void)glint_spawn_stop(ahead->process);
    }
    *ahead = (render_kernels_ahead){0};
}
