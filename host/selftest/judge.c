// The oracle as the self-test asks it. See judge.h.
#include "selftest/judge.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

glint_status judge_begin(const glint_scene *scene, oracle_scene *judge, glint_error *error)
{
    static const oracle_material plain = {.metallic = 1};
    const double origin[3] = {scene->origin.x, scene->origin.y, scene->origin.z};
    oracle_triangle *triangles = calloc(scene->triangle_count + 1, sizeof *triangles);
    *judge = (oracle_scene){
        .triangles = triangles, .triangle_count = (int)scene->triangle_count, .materials = &plain};
    for (size_t i = 0; triangles != NULL && i < 9 * scene->triangle_count; i++) {
        triangles[i / 9].position[i / 3 % 3][i % 3] =
            origin[i % 3] + scene->unit * (double)scene->positions[i];
    }
    if (triangles != NULL) {
        judge->tree = oracle_tree_create(triangles, judge->triangle_count);
    }
    return judge->tree != NULL ? GLINT_OK : glint_fail_memory(error, "a self-test");
}

void judge_end(oracle_scene *judge)
{
    oracle_tree_free((oracle_tree *)(uintptr_t)judge->tree);
    free((void *)(uintptr_t)judge->triangles);
    *judge = (oracle_scene){0};
}

oracle_hit judge_ray(const oracle_scene *judge, const glint_probe_ray *ray)
{
    oracle_ray r;
    memcpy(r.origin, ray->origin, sizeof r.origin);
    memcpy(r.direction, ray->direction, sizeof r.direction);
    return oracle_closest_hit(judge, &r, -1);
}

int judge_pixel(const oracle_scene *judge, const oracle_view *view, int column, int row)
{
    const double at[2] = {column + 0.5, row + 0.5};
    const oracle_ray ray = oracle_primary_ray(view, at);
    return oracle_closest_hit(judge, &ray, -1).triangle;
}

static void copy_vector(glint_vec3 from, double to[3])
{
    to[0] = from.x;
    to[1] = from.y;
    to[2] = from.z;
}

oracle_view judge_view(const glint_camera *camera, const glint_settings *settings)
{
    oracle_view view = {.yfov = camera->orthographic ? 0 : camera->yfov,
                        .ymag = camera->ymag,
                        .width = settings->width,
                        .height = settings->height,
                        .samples = settings->samples_per_axis,
                        .depth = 1};
    copy_vector(camera->eye, view.eye);
    copy_vector(camera->right, view.right);
    copy_vector(camera->up, view.up);
    copy_vector(camera->back, view.back);
    return view;
}
