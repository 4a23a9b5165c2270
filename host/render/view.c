// Computes from a camera the values for the kernel's primary rays. See view.h and
// glint_frame_record.
#include "render/view.h"

#include "render/plan_device.h"
#include "render/plan_features.h"
#include "render/plan_make.h"
#include "render/split.h"
#include "render/wavelengths.h"

#include <math.h>
#include <string.h>

glint_stored_space glint_stored_space_of(const glint_scene *scene)
{
    double unit = scene->unit > 0 ? scene->unit : 1;
    return (glint_stored_space){scene->origin, unit, scene->low, scene->high};
}

static glint_split_vector split_vector(glint_vec3 v)
{
    glint_split_vector split = {{0}, {0}};
    glint_split_number(v.x, &split.high[0], &split.low[0]);
    glint_split_number(v.y, &split.high[1], &split.low[1]);
    glint_split_number(v.z, &split.high[2], &split.low[2]);
    return split;
}

// If the eye is farther away than this many scene extents, 1/depth is too flat to order surfaces in
// single precision.
#define FAR_EYE 4.0

// The interval of the scene along the view axis, in stored units.
typedef struct depth_range {
    // Distance from the eye to the scene; 0 if the eye is beside, behind or inside it. Slightly too
    // short, so that rounding hides nothing.
    double start;
    double extent; // length of the interval
} depth_range;

static depth_range depth_of(const glint_stored_space *space, const glint_camera *camera,
                            glint_vec3 eye)
{
    if (!(space->low.x <= space->high.x)) {
        return (depth_range){0, 0};
    }
    double nearest = INFINITY, farthest = -INFINITY;
    for (int corner = 0; corner < 8; corner++) {
        glint_vec3 p = {corner & 1 ? space->high.x : space->low.x,
                        corner & 2 ? space->high.y : space->low.y,
                        corner & 4 ? space->high.z : space->low.z};
        p = glint_vec3_scale(glint_vec3_subtract(p, space->origin), 1 / space->unit);
        double depth = -glint_vec3_dot(glint_vec3_subtract(p, eye), camera->back);
        nearest = fmin(nearest, depth);
        farthest = fmax(farthest, depth);
    }
    double depth = nearest - 0.01 * (farthest - nearest) - 1e-6 * fabs(nearest);
    depth = depth > 0 ? depth : 0;
    return (depth_range){depth, farthest - depth};
}

static void note_wavelengths(int count, glint_frame_record *record)
{
    glint_wavelength wavelengths[GLINT_WAVELENGTHS_MAX];
    glint_wavelengths_choose(count, wavelengths);
    record->wavelengths = count;
    for (int i = 0; i < count; i++) {
        record->wavelength[i].ior_step = (float)glint_wavelength_ior_step(wavelengths[i].nm);
        for (int c = 0; c < 3; c++) {
            record->wavelength[i].share[c] = (float)wavelengths[i].share[c];
        }
    }
}

static void note_settings(const glint_settings *settings, glint_frame_record *record)
{
    record->min_weight = (float)settings->min_weight;
    int pixels[2];
    glint_settings_pixels(settings, pixels);
    record->width = pixels[0];
    record->height = pixels[1];
    record->image_width = settings->width;
    record->image_height = settings->height;
    record->step = settings->grid_step > 0 ? settings->grid_step : 1;
    record->first_pixel = settings->grid_step / 2;
    record->facet_rounds = glint_settings_rounds(settings);
    record->samples_per_axis = settings->samples_per_axis;
    record->anisotropy = (float)settings->anisotropy;
    record->compensation = settings->scattering == GLINT_SCATTERING_MULTIPLE;
    record->cells_tolerance = (float)glint_lobe_tolerance(settings->roughness);
}

_Static_assert(GLINT_FEATURE_COUNT <= 32 * GLINT_FEATURE_WORDS, "each feature has a bit");

void glint_view_set_plan(const glint_plan *plan, glint_frame_record *record)
{
    for (int i = 0; i < GLINT_FEATURE_COUNT; i++) {
        record->features[i / 32] |= (uint32_t)plan->features[i].compiled << i % 32;
    }
    record->half_texels = plan->half_texels;
    record->media_bits = plan->media_bits;
    record->media_capacity = plan->media_capacity;
    record->cells_last = plan->cells_last;
    record->depth = plan->depth;
    record->depth_counts = !plan->depth_is_exact && plan->depth < GLINT_DEPTH_MAX;
}

void glint_view_record(const glint_stored_space *space, const glint_camera *camera,
                       const glint_settings *settings, const glint_plan *plan,
                       glint_frame_record *record)
{
    memset(record, 0, sizeof *record);
    const glint_vec3 none = {0, 0, 0};
    glint_vec3 eye =
        glint_vec3_scale(glint_vec3_subtract(camera->eye, space->origin), 1 / space->unit);
    glint_vec3 forward = glint_vec3_scale(camera->back, -1);
    depth_range range = depth_of(space, camera, eye);
    double start = range.start;

    // The step of one pixel in the image plane: at unit distance, or for parallel rays in stored
    // units.
    double half_height = camera->orthographic ? camera->ymag / space->unit : tan(camera->yfov / 2);
    double step = 2 * half_height / settings->height;
    glint_vec3 step_x = glint_vec3_scale(camera->right, step);
    glint_vec3 step_y = glint_vec3_scale(camera->up, step);
    double spread = camera->orthographic ? 1 : start; // distance of the origins, as a factor of the
                                                      // step

    // Origin and direction of primary rays, and their change per pixel.
    record->origin = split_vector(glint_vec3_add(eye, glint_vec3_scale(forward, start)));
    record->origin_x = split_vector(glint_vec3_scale(step_x, spread));
    record->origin_y = split_vector(glint_vec3_scale(step_y, spread));
    record->direction = split_vector(forward);
    record->direction_x = split_vector(camera->orthographic ? none : step_x);
    record->direction_y = split_vector(camera->orthographic ? none : step_y);
    glint_split_number(start, &record->start[0], &record->start[1]);

    // The projection of a point onto the image, and the key that orders surfaces by depth.
    record->image_x = split_vector(glint_vec3_scale(camera->right, 1 / step));
    record->image_y = split_vector(glint_vec3_scale(camera->up, 1 / step));
    record->image_z = split_vector(forward);
    glint_split_number(camera->orthographic ? 1 : start, &record->image_offset[0],
                       &record->image_offset[1]);
    record->image_slope = camera->orthographic ? 0 : 1;
    record->key_is_inverse = !camera->orthographic && start <= FAR_EYE * range.extent;

    // The rotation of the environment, and the settings.
    double angle = fmod(settings->env_rotate, 360) * GLINT_PI / 180;
    glint_split_number(cos(angle), &record->env_rotation[0], &record->env_rotation[1]);
    glint_split_number(sin(angle), &record->env_rotation[2], &record->env_rotation[3]);
    note_settings(settings, record);
    if (plan->features[GLINT_FEATURE_DISPERSION].compiled) {
        note_wavelengths(settings->wavelengths, record);
    }
    glint_view_set_plan(plan, record);
    record->unit = (float)space->unit;
}

bool glint_view_is_outside(const glint_stored_space *space, const glint_camera *camera)
{
    const glint_vec3 e = camera->eye, low = space->low, high = space->high;
    if (camera->orthographic) { // parallel rays begin in the plane of the eye
        const glint_vec3 eye =
            glint_vec3_scale(glint_vec3_subtract(e, space->origin), 1 / space->unit);
        return depth_of(space, camera, eye).start > 0;
    }
    return e.x < low.x || e.x > high.x || e.y < low.y || e.y > high.y || e.z < low.z ||
           e.z > high.z;
}

// Tolerance around the bounds, because eyes may lie on a solid's surface.
#define BESIDE_BOX 1e-6

// True if rays may begin in or on a box in stored coordinates.
static bool begins_in(const float box[2][3], glint_vec3 eye, const glint_camera *camera)
{
    const double at[3] = {eye.x, eye.y, eye.z};
    const double back[3] = {camera->back.x, camera->back.y, camera->back.z};
    bool inside = true;
    double least = 0;
    double most = 0; // heights of the box's corners above the eye's plane
    for (int k = 0; k < 3; k++) {
        const double low = (double)box[0][k] - at[k] - BESIDE_BOX;
        const double high = (double)box[1][k] - at[k] + BESIDE_BOX;
        inside = inside && low <= 0 && high >= 0;
        least += fmin(back[k] * low, back[k] * high);
        most += fmax(back[k] * low, back[k] * high);
    }
    return camera->orthographic ? least <= 0 && most >= 0 : inside;
}

void glint_plan_suit(glint_plan *plan, const glint_stored_space *space, const glint_camera *camera)
{
    const glint_vec3 eye =
        glint_vec3_scale(glint_vec3_subtract(camera->eye, space->origin), 1 / space->unit);
    bool inside = false;
    for (int i = 0; i < plan->box_count; i++) {
        inside = inside || begins_in((const float(*)[3])plan->boxes[i], eye, camera);
    }
    if (inside != plan->features[GLINT_FEATURE_INSIDE].compiled) {
        glint_plan_decide_inside(inside, plan);
        glint_plan_decide_paths(plan);
        glint_plan_describe_secondary_rays(plan);
    }
    glint_plan_heed_sight(plan, !plan->sight.from_outside || glint_view_is_outside(space, camera));
}

void glint_view_set_proxy(const glint_stored_space *space, const glint_proxy *proxy,
                          glint_frame_record *record)
{
    const double scale = 1 / space->unit;
    const glint_vec3 center = glint_vec3_subtract(proxy->center, space->origin);
    const glint_vec3 middle = glint_vec3_subtract(proxy->middle, space->origin);
    record->proxy_center = split_vector(glint_vec3_scale(center, scale));
    record->proxy_middle = split_vector(glint_vec3_scale(middle, scale));
    record->proxy_half = split_vector(glint_vec3_scale(proxy->half_extent, scale));
    record->proxy_is_sphere = proxy->kind == GLINT_PROXY_SPHERE;
}
