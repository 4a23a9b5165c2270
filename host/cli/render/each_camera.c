// Implements --camera all. See each_camera.h.
#include "cli/render/each_camera.h"

#include "base/memory.h"
#include "cli/common/json_output.h"
#include "cli/common/say.h"
#include "cli/render/camera_names.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ---- Cameras -----------------------------------------------------------------------------------

// The cameras of the file and the parts of file names for them. Zero is valid and empty.
typedef struct camera_list {
    glint_scene scene; // holds only the cameras
    char **names;
} camera_list;

static void free_list(camera_list *list)
{
    for (size_t i = 0; list->names != NULL && i < list->scene.camera_count; i++) {
        free(list->names[i]);
    }
    free(list->names);
    glint_scene_free(&list->scene);
}

static glint_status read_cameras(const glint_input_request *request, glint_scene *scene,
                                 glint_error *error)
{
    const glint_scene_options options = {.scene = request->scene_name,
                                         .animation = request->animation};
    glint_scene_source *source;
    TRY(glint_scene_open(request->scene, &options, &source, error));
    const glint_status status = glint_scene_cameras_at(source, 0, scene, error);
    glint_scene_close(source);
    return status;
}

static glint_status list_cameras(const glint_input_request *request, camera_list *list,
                                 glint_error *error)
{
    TRY(read_cameras(request, &list->scene, error));
    const size_t count = list->scene.camera_count;
    if (count == 0) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: --camera all: the scene has no camera (leave it out: one is made "
                          "that frames the scene)",
                          request->scene);
    }
    for (size_t i = 0; i < count && request->view.fov > 0; i++) {
        if (list->scene.cameras[i].orthographic) {
            return glint_fail(error, GLINT_USAGE,
                              "--fov: camera %zu is orthographic and has no angle of view (leave "
                              "it out)",
                              i);
        }
    }
    list->names = glint_allocate(count, sizeof *list->names);
    return list->names != NULL ? render_camera_names(list->scene.cameras, count, list->names, error)
                               : glint_fail_memory(error, "the cameras' names");
}

// ---- One of them -------------------------------------------------------------------------------

// A request with the file names for one camera. Zero is valid.
typedef struct camera_request {
    render_request one; // `render` frees it
    char *output, *stats;
    char index[24];
} camera_request;

static glint_status make_request(const render_request *request, const camera_list *list,
                                 size_t index, camera_request *made, glint_error *error)
{
    const bool has_stats = request->stats != NULL && !glint_is_stdout(request->stats);
    *made = (camera_request){.one = *request};
    made->output = render_camera_path(request->output, list->names[index]);
    made->stats = has_stats ? render_camera_path(request->stats, list->names[index]) : NULL;
    if (made->output == NULL || (has_stats && made->stats == NULL)) {
        return glint_fail_memory(error, "a file name");
    }
    snprintf(made->index, sizeof made->index, "%zu", index);
    made->one.output = made->output;
    made->one.stats = has_stats ? made->stats : request->stats;
    made->one.inputs.view.camera = made->index;
    return GLINT_OK;
}

static void free_request(camera_request *made)
{
    free(made->output);
    free(made->stats);
}

static glint_status check_only(render_request *one, glint_error *error)
{
    const glint_status status = render_request_finish(one, error);
    render_request_free(one);
    return status;
}

typedef glint_status render_function(render_request *one, glint_error *error);

static glint_status with_camera(const render_request *request, const camera_list *list,
                                size_t index, render_function *render, glint_error *error)
{
    camera_request made;
    glint_status status = make_request(request, list, index, &made, error);
    if (status == GLINT_OK) {
        status = render(&made.one, error);
    }
    free_request(&made);
    return status;
}

// ---- All of them -------------------------------------------------------------------------------

static glint_status render_all(const render_request *request, const camera_list *list,
                               render_function *render, glint_error *error)
{
    const size_t count = list->scene.camera_count;
    size_t failed = 0;
    for (size_t i = 0; i < count; i++) {
        TRY(with_camera(request, list, i, check_only, error));
    }
    for (size_t i = 0; i < count; i++) {
        const glint_status status = with_camera(request, list, i, render, error);
        const bool is_its_own = status == GLINT_FRAMES_FAILED ||
                                (status == GLINT_BAD_INPUT && list->scene.cameras[i].is_lost);
        if (status != GLINT_OK && !is_its_own) {
            return status;
        }
        if (status != GLINT_OK) {
            failed++;
            glint_say_error(error);
            glint_error_free(error);
            *error = (glint_error){0};
        }
    }
    return failed == 0 ? GLINT_OK
                       : glint_fail(error, GLINT_FRAMES_FAILED, "%s: %zu of %zu cameras failed",
                                    request->inputs.scene, failed, count);
}

bool render_each_camera_is_asked(const render_request *request)
{
    const char *camera = request->inputs.view.camera;
    return camera != NULL && strcmp(camera, "all") == 0;
}

glint_status render_each_camera(const render_request *request, render_function *render,
                                glint_error *error)
{
    render_request checked = *request;
    TRY(check_only(&checked, error)); // fail early, before any file is read
    camera_list list = {0};
    glint_status status = list_cameras(&request->inputs, &list, error);
    if (status == GLINT_OK) {
        status = render_all(request, &list, render, error);
    }
    free_list(&list);
    return status;
}
