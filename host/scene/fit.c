// Moves a camera so that a scene fills its frame. See fit.h.
//
// A point p is left of the frame's right edge if (right + t·back)·p ≤ right·eye + t·back·eye, where
// t is the tangent of the half angle. So each edge needs only the greatest product of its plane's
// normal with a point. The eye follows in closed form.
#include "scene/fit.h"

#include <math.h>

enum { RIGHT_EDGE, LEFT_EDGE, UPPER_EDGE, LOWER_EDGE, NEAREST, EXTREMES };

#define LEAST_DISTANCE 0.01 // of the bounds' radius: a nearer point would hide all others

typedef struct fit_extremes {
    const glint_fit *fit;
    glint_vec3 centre;
    glint_vec3 normals[EXTREMES];
    double across[EXTREMES]; // horizontal lengths of the normals
    double most[EXTREMES];   // greatest normal·(point − centre)
} fit_extremes;

static void begin(const glint_fit *fit, const glint_camera *camera, fit_extremes *extremes)
{
    const double height = camera->orthographic ? 0 : tan(camera->yfov / 2) * (1 - fit->margin);
    const glint_vec3 sideways = glint_vec3_scale(camera->back, height * fit->aspect);
    const glint_vec3 upright = glint_vec3_scale(camera->back, height);
    const glint_vec3 centre = glint_vec3_scale(glint_vec3_add(fit->low, fit->high), 0.5);
    *extremes = (fit_extremes){.fit = fit, .centre = centre};
    extremes->normals[RIGHT_EDGE] = glint_vec3_add(sideways, camera->right);
    extremes->normals[LEFT_EDGE] = glint_vec3_subtract(sideways, camera->right);
    extremes->normals[UPPER_EDGE] = glint_vec3_add(upright, camera->up);
    extremes->normals[LOWER_EDGE] = glint_vec3_subtract(upright, camera->up);
    extremes->normals[NEAREST] = camera->back;
    for (int i = 0; i < EXTREMES; i++) {
        extremes->across[i] = hypot(extremes->normals[i].x, extremes->normals[i].z);
        extremes->most[i] = -INFINITY;
    }
}

static void add_point(fit_extremes *extremes, glint_vec3 point)
{
    const glint_vec3 p = glint_vec3_subtract(point, extremes->centre);
    const double radius = extremes->fit->turns ? sqrt(p.x * p.x + p.z * p.z) : 0;
    for (int i = 0; i < EXTREMES; i++) {
        const glint_vec3 n = extremes->normals[i];
        // On its circle about the axis, a point passes the direction of the normal.
        const double product =
            extremes->fit->turns ? n.y * p.y + extremes->across[i] * radius : glint_vec3_dot(n, p);
        extremes->most[i] = product > extremes->most[i] ? product : extremes->most[i];
    }
}

static void add_corners(fit_extremes *extremes, glint_vec3 low, glint_vec3 high)
{
    for (int corner = 0; corner < 8; corner++) {
        add_point(extremes, (glint_vec3){(corner & 1) != 0 ? high.x : low.x,
                                         (corner & 2) != 0 ? high.y : low.y,
                                         (corner & 4) != 0 ? high.z : low.z});
    }
}

static void add_vertices(fit_extremes *extremes, const glint_scene *scene)
{
    for (size_t i = 0; i < glint_scene_vertex_count(scene); i++) {
        const glint_vec3 relative = glint_vec3_from_floats(scene->positions + 3 * i);
        add_point(extremes, glint_vec3_add(scene->origin, glint_vec3_scale(relative, scene->unit)));
    }
}

void glint_camera_fit(const glint_fit *fit, glint_camera *camera)
{
    fit_extremes extremes;
    begin(fit, camera, &extremes);
    if (fit->as_box) {
        add_corners(&extremes, fit->low, fit->high);
    } else {
        add_vertices(&extremes, fit->scene);
    }
    const double *most = extremes.most;
    const double radius = glint_vec3_length(glint_vec3_subtract(fit->high, fit->low)) / 2;
    const double width = (most[RIGHT_EDGE] + most[LEFT_EDGE]) / 2 / fit->aspect;
    const double height = (most[UPPER_EDGE] + most[LOWER_EDGE]) / 2;
    const double larger = fmax(width, height);
    // There are no points; or, in an orthographic view, all lie behind each other. (In perspective,
    // `larger` is below 0 if the nearest point alone limits the distance.)
    if (!isfinite(larger) || !isfinite(radius) || !isfinite(most[NEAREST]) ||
        (camera->orthographic && !(larger > 0))) {
        return;
    }
    double distance = most[NEAREST] + radius; // from the centre
    if (camera->orthographic) {
        camera->ymag = larger / (1 - fit->margin);
    } else {
        distance = fmax(larger / (tan(camera->yfov / 2) * (1 - fit->margin)),
                        most[NEAREST] + LEAST_DISTANCE * radius);
    }
    const glint_vec3 aside =
        glint_vec3_add(glint_vec3_scale(camera->right, (most[RIGHT_EDGE] - most[LEFT_EDGE]) / 2),
                       glint_vec3_scale(camera->up, (most[UPPER_EDGE] - most[LOWER_EDGE]) / 2));
    const glint_vec3 eye = glint_vec3_add(aside, glint_vec3_scale(camera->back, distance));
    camera->eye = glint_vec3_add(extremes.centre, eye);
}
