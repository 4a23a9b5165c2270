// Implements glint bench --error. See bench_error.h.
#include "cli/bench/bench_error.h"

#include "report/speed_error/speed_error_json.h"

#include <stdlib.h>

glint_status bench_error_check(const glint_settings *settings, glint_error *error)
{
    const glint_setting *own = glint_settings_find_changed(settings, GLINT_SETTING_WEIGHS_ERRORS |
                                                                         GLINT_SETTING_IS_COMPARED);
    return own == NULL ? GLINT_OK
                       : glint_fail(error, GLINT_USAGE,
                                    "--%s: --error tries them one after the other (leave it out)",
                                    own->option.name);
}

glint_status bench_error_measure(const bench_error_task *task, char **text, glint_error *error)
{
    const glint_input_request *request = task->request;
    const glint_inputs *loaded = task->loaded;
    const glint_bench_inputs inputs = {
        .device = request->device,
        .scene = &loaded->scene,
        .environment = &loaded->environment,
        .camera = &loaded->viewpoint.camera,
        .settings = &request->settings,
        .kernel_dir = request->kernel_dir,
    };
    glint_speed_error_result *result = malloc(sizeof *result);
    if (result == NULL) {
        return glint_fail_memory(error, "the errors");
    }
    glint_status status;
    TRY_OR(cleanup, status,
           glint_speed_error_measure(&inputs, task->options, task->watcher, result, error));
    json_t *entry = NULL;
    const glint_bench_scene scene = {
        .name = request->scene,
        .subject = {.scene = &loaded->scene,
                    .overrides = &request->overrides,
                    .environment = &loaded->environment,
                    .camera = &loaded->viewpoint.camera,
                    .settings = &request->settings,
                    .warnings = &loaded->warnings},
    };
    TRY_OR(cleanup, status, glint_speed_error_scene_json(&scene, result, &entry, error));
    status = glint_json_print(entry, text, error);
cleanup:
    glint_speed_error_free(result);
    free(result);
    return status;
}
