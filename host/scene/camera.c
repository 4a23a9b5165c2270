// Computes a camera's axes from a node's transform, and makes the default camera. See camera.h.
#include "scene/camera.h"

#include <stddef.h>

static glint_vec3 column3(const glint_mat4 *matrix, int column)
{
    return (glint_vec3){matrix->m[0][column], matrix->m[1][column], matrix->m[2][column]};
}

static bool is_zero(glint_vec3 v)
{
    return v.x == 0 && v.y == 0 && v.z == 0;
}

bool glint_camera_from_matrix(const glint_mat4 *to_world, glint_camera *camera)
{
    glint_vec3 back = glint_vec3_normalize(column3(to_world, 2));
    glint_vec3 up = glint_vec3_normalize(column3(to_world, 1));
    glint_vec3 eye = column3(to_world, 3);
    if (is_zero(back) || is_zero(up) || !isfinite(eye.x) || !isfinite(eye.y) || !isfinite(eye.z)) {
        return false;
    }
    // The part of up perpendicular to the forward axis. For two unit vectors, a shorter part is
    // only rounding.
    const double least = 1e-9;
    up = glint_vec3_subtract(up, glint_vec3_scale(back, glint_vec3_dot(up, back)));
    if (!(glint_vec3_length(up) > least)) {
        return false;
    }
    up = glint_vec3_normalize(up);
    // Repeat: if the perpendicular part was short, its rounding has grown.
    up = glint_vec3_subtract(up, glint_vec3_scale(back, glint_vec3_dot(up, back)));
    camera->up = glint_vec3_normalize(up);
    camera->back = back;
    // Do not use the matrix's right: a mirrored node would give a mirrored picture.
    camera->right = glint_vec3_normalize(glint_vec3_cross(camera->up, back));
    camera->eye = eye;
    return true;
}

void glint_camera_frame_bounds(glint_vec3 low, glint_vec3 high, glint_camera *camera)
{
    const double yfov = 40 * GLINT_PI / 180;
    *camera = (glint_camera){.yfov = yfov};
    // Written so that NaN counts as no box.
    bool has_box = low.x <= high.x && low.y <= high.y && low.z <= high.z;
    glint_vec3 center = {0, 0, 0};
    if (has_box) {
        center = glint_vec3_add(low, glint_vec3_scale(glint_vec3_subtract(high, low), 0.5));
    }
    double radius = has_box ? glint_vec3_length(glint_vec3_subtract(high, low)) / 2 : 0;
    // The direction from the centre to the eye, along the camera's +Z axis.
    glint_vec3 back = {0, 0, 1};
    // Far enough from the centre that rounding does not lose the step.
    double distance = fmax(1, 1e-3 * glint_vec3_length(center));
    if (radius > 0 && isfinite(radius)) {
        back = glint_vec3_normalize((glint_vec3){0.4, 0.3, 1});
        distance = radius / sin(yfov / 2);
    }
    camera->back = back;
    camera->right = glint_vec3_normalize(glint_vec3_cross((glint_vec3){0, 1, 0}, back));
    camera->up = glint_vec3_cross(back, camera->right);
    camera->eye = glint_vec3_add(center, glint_vec3_scale(back, distance));
}

bool glint_camera_look(glint_vec3 eye, glint_vec3 target, glint_vec3 up, glint_camera *camera)
{
    const glint_vec3 back = glint_vec3_normalize(glint_vec3_subtract(eye, target));
    const glint_mat4 to_world = {{{1, up.x, back.x, eye.x},
                                  {0, up.y, back.y, eye.y},
                                  {0, up.z, back.z, eye.z},
                                  {0, 0, 0, 1}}};
    return glint_camera_from_matrix(&to_world, camera);
}

// Returns the horizontal unit vector from `centre` towards the camera.
static glint_vec3 compass_direction(glint_vec3 centre, const glint_camera *camera)
{
    const double least = 1e-9; // below this is rounding: the camera stands straight above or below
    const glint_vec3 arm = glint_vec3_normalize(glint_vec3_subtract(camera->eye, centre));
    const glint_vec3 up = glint_vec3_scale(camera->up, camera->back.y > 0 ? -1 : 1);
    const glint_vec3 ways[] = {arm, camera->back, up};
    for (int i = 0; i < 3; i++) {
        if (hypot(ways[i].x, ways[i].z) > least) {
            return glint_vec3_normalize((glint_vec3){ways[i].x, 0, ways[i].z});
        }
    }
    return (glint_vec3){0, 0, 1};
}

void glint_camera_raise(glint_vec3 centre, double elevation, glint_camera *camera)
{
    const glint_vec3 towards = compass_direction(centre, camera);
    const double distance = glint_vec3_length(glint_vec3_subtract(camera->eye, centre));
    camera->back = glint_vec3_add(glint_vec3_scale(towards, cos(elevation)),
                                  (glint_vec3){0, sin(elevation), 0});
    camera->right = glint_vec3_cross((glint_vec3){0, 1, 0}, towards);
    camera->up = glint_vec3_cross(camera->back, camera->right);
    camera->eye = glint_vec3_add(centre, glint_vec3_scale(camera->back, distance));
}

// Turns v about +Y by `quarters` quarter turns and an angle with the given cosine and sine.
static glint_vec3 turn(glint_vec3 v, int quarters, double cosine, double sine)
{
    const glint_vec3 turned = {v.x * cosine + v.z * sine, v.y, v.z * cosine - v.x * sine};
    switch (quarters) {
    case 0:
        return turned;
    case 1:
        return (glint_vec3){turned.z, turned.y, -turned.x};
    case 2:
        return (glint_vec3){-turned.x, turned.y, -turned.z};
    default:
        return (glint_vec3){-turned.z, turned.y, turned.x};
    }
}

glint_camera glint_camera_orbit(const glint_camera *camera, glint_vec3 centre, int64_t step,
                                int64_t steps)
{
    const int64_t within = (step % steps + steps) % steps;
    if (within == 0) {
        return *camera;
    }
    const int quarters = (int)(4 * within / steps);
    const double angle = GLINT_PI / 2 * ((double)(4 * within % steps) / (double)steps);
    const double cosine = cos(angle), sine = sin(angle);
    const glint_vec3 arm = glint_vec3_subtract(camera->eye, centre);
    glint_camera turned = *camera;
    turned.eye = glint_vec3_add(centre, turn(arm, quarters, cosine, sine));
    turned.right = turn(camera->right, quarters, cosine, sine);
    turned.up = turn(camera->up, quarters, cosine, sine);
    turned.back = turn(camera->back, quarters, cosine, sine);
    return turned;
}
