// Finds the camera of a scene from the options. See viewpoint.h.
#include "cli/common/viewpoint.h"

#include "scene/fit.h"

#include <math.h>
#include <string.h>

#define RADIANS (GLINT_PI / 180)
#define DEFAULT_MARGIN 0.05 // for the default camera, when the file has none

// ---- The options -------------------------------------------------------------------------------

static glint_vec3 vector(const place_request *place)
{
    return (glint_vec3){place->at[0], place->at[1], place->at[2]};
}

glint_status glint_parse_direction(const glint_option *option, const char *text, void *destination,
                                   glint_error *error)
{
    place_request direction = {.is_given = true};
    if (!glint_parse_reals(text, direction.at, 3) ||
        !(glint_vec3_length(glint_vec3_normalize(vector(&direction))) > 0)) {
        return glint_fail(error, GLINT_USAGE,
                          "--%s %s: a direction is expected: x,y,z, not all of them 0",
                          option->name, text);
    }
    memcpy(destination, &direction, sizeof direction);
    return GLINT_OK;
}

glint_status glint_parse_elevation(const glint_option *option, const char *text, void *destination,
                                   glint_error *error)
{
    angle_request angle = {.is_given = true};
    if (!glint_parse_real(text, &angle.degrees) || fabs(angle.degrees) > 90) {
        return glint_fail(error, GLINT_USAGE, "--%s %s: degrees from -90 to 90 are expected",
                          option->name, text);
    }
    memcpy(destination, &angle, sizeof angle);
    return GLINT_OK;
}

glint_status glint_view_request_check(const glint_view_request *request, glint_error *error)
{
    const bool has_eye = request->eye.is_given;
    if (has_eye && (request->camera != NULL || request->elevation.is_given)) {
        return glint_fail(error, GLINT_USAGE,
                          "--eye: it says where the camera is, and so does --%s (leave one out)",
                          request->camera != NULL ? "camera" : "elevation");
    }
    if (!has_eye && (request->look_at.is_given || request->up.is_given)) {
        return glint_fail(error, GLINT_USAGE,
                          "--%s: it says how a camera of your own looks (with --eye X,Y,Z)",
                          request->look_at.is_given ? "look-at" : "up");
    }
    return GLINT_OK;
}

// ---- The camera --------------------------------------------------------------------------------

void glint_viewpoint_measure(const glint_scene *scene, glint_viewpoint *viewpoint)
{
    glint_scene_shown_bounds(scene, &viewpoint->low, &viewpoint->high);
    const glint_vec3 sum = glint_vec3_add(viewpoint->low, viewpoint->high);
    const bool has_bounds = viewpoint->low.x <= viewpoint->high.x;
    viewpoint->centre = has_bounds ? glint_vec3_scale(sum, 0.5) : (glint_vec3){0, 0, 0};
}

// Looks upright at the target. Looking straight down, the far side of the scene (−z) is up in the
// picture, as on a map; looking straight up, the near side (+z) is up.
static bool look_upright(glint_vec3 eye, glint_vec3 target, glint_camera *camera)
{
    const glint_vec3 beyond = {0, 0, eye.y > target.y ? -1 : 1};
    return glint_camera_look(eye, target, (glint_vec3){0, 1, 0}, camera) ||
           glint_camera_look(eye, target, beyond, camera);
}

static glint_status make_camera(const glint_view_request *request, glint_viewpoint *viewpoint,
                                glint_error *error)
{
    const glint_vec3 eye = vector(&request->eye);
    const glint_vec3 target =
        request->look_at.is_given ? vector(&request->look_at) : viewpoint->centre;
    const glint_vec3 up = vector(&request->up);
    glint_camera_frame_bounds(viewpoint->low, viewpoint->high, &viewpoint->camera);
    if (request->up.is_given ? glint_camera_look(eye, target, up, &viewpoint->camera)
                             : look_upright(eye, target, &viewpoint->camera)) {
        return GLINT_OK;
    }
    if (request->up.is_given && glint_vec3_length(glint_vec3_subtract(eye, target)) > 0) {
        return glint_fail(error, GLINT_USAGE,
                          "--up %g,%g,%g: the camera looks along it (name another direction, or "
                          "leave it out)",
                          up.x, up.y, up.z);
    }
    return glint_fail(error, GLINT_USAGE, "--eye %g,%g,%g: this is the place that it looks at (%s)",
                      eye.x, eye.y, eye.z,
                      request->look_at.is_given ? "name two places"
                                                : "the middle of the scene; name another with "
                                                  "--look-at");
}

static void fit(const glint_view_request *request, const glint_scene *scene,
                glint_viewpoint *viewpoint)
{
    const glint_fit fit = {.scene = scene,
                           .as_box = viewpoint->moves,
                           .low = viewpoint->low,
                           .high = viewpoint->high,
                           .turns = request->turns,
                           .margin = request->fit ? 0 : DEFAULT_MARGIN,
                           .aspect = viewpoint->aspect};
    glint_camera_fit(&fit, &viewpoint->camera);
}

glint_status glint_viewpoint_find(const glint_view_request *request, const glint_scene *scene,
                                  glint_viewpoint *viewpoint, glint_error *error)
{
    glint_camera *camera = &viewpoint->camera;
    TRY(request->eye.is_given ? make_camera(request, viewpoint, error)
                              : glint_scene_camera(scene, request->camera, camera, error));
    if (request->fov > 0 && camera->orthographic) {
        return glint_fail(error, GLINT_USAGE,
                          "--fov: the camera is orthographic and has no angle of view (leave it "
                          "out, or name another --camera)");
    }
    if (request->fov > 0) {
        camera->yfov = request->fov * RADIANS;
    }
    if (request->elevation.is_given) {
        glint_camera_raise(viewpoint->centre, request->elevation.degrees * RADIANS, camera);
    }
    const bool is_default = scene->camera_count == 0 && !request->eye.is_given;
    if (request->fit || is_default) {
        fit(request, scene, viewpoint);
    }
    return GLINT_OK;
}
