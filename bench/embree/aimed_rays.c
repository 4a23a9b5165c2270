// Aims rays at the vertices and edges of triangles. See aimed_rays.h.
#include "embree/aimed_rays.h"

#include "render/probe.h"

#include <math.h>

// A ray comes from within 75° of the normals of the vertices that it is aimed at. The meshes are
// smooth, so all triangles around the target face the ray, and the next surface is far behind them.
#define LEAST_COSINE 0.26

// Returns x or one of the two floats next to x.
static float nudge(float x, glint_random *random)
{
    double which = glint_random_number(random);
    return which < 1.0 / 3   ? nextafterf(x, -INFINITY)
           : which < 2.0 / 3 ? nextafterf(x, INFINITY)
                             : x;
}

static double cosine_at(const float *normal, const float *direction)
{
    double along = 0;
    for (int k = 0; k < 3; k++) {
        along -= (double)normal[k] * (double)direction[k];
    }
    return along;
}

aimed_ray aim_ray(const bench_scene *scene, bool at_edge, glint_random *random)
{
    for (;;) {
        const uint32_t *triangle = scene->triangles + 3 * (size_t)(glint_random_number(random) *
                                                                   (double)scene->triangle_count);
        const float *a = scene->positions + 3 * (size_t)triangle[0];
        const float *b = scene->positions + 3 * (size_t)triangle[at_edge ? 1 : 0];
        const double share = glint_random_number(random);
        const double distance = 0.5 + 0.5 * glint_random_number(random);
        const glint_vec3 from = glint_vec3_scale(glint_random_direction(random), distance);
        const double away[3] = {from.x, from.y, from.z};
        aimed_ray ray;
        double to[3], squares = 0;
        for (int k = 0; k < 3; k++) {
            float target = (float)((double)a[k] + share * ((double)b[k] - (double)a[k]));
            ray.origin[k] = (float)((double)target + away[k]);
            to[k] = (double)target - (double)ray.origin[k];
            squares += to[k] * to[k];
        }
        ray.distance = (float)sqrt(squares);
        for (int k = 0; k < 3; k++) {
            ray.direction[k] = nudge((float)(to[k] / sqrt(squares)), random);
        }
        const float *normal_a = scene->normals + 3 * (size_t)triangle[0];
        const float *normal_b = scene->normals + 3 * (size_t)triangle[at_edge ? 1 : 0];
        if (cosine_at(normal_a, ray.direction) >= LEAST_COSINE &&
            cosine_at(normal_b, ray.direction) >= LEAST_COSINE) {
            return ray;
        }
    }
}

// Traces AIMED_RAYS_PER_ITEM rays from `first` on.
static glint_status trace_item(glint_probe *probe, const bench_scene *scene, uint64_t first,
                               leak_count *leaks, glint_error *error)
{
    const uint64_t left = leaks->rays - first;
    const uint64_t count = left < AIMED_RAYS_PER_ITEM ? left : AIMED_RAYS_PER_ITEM;
    static glint_probe_ray in[AIMED_RAYS_PER_ITEM];
    static glint_probe_hit out[AIMED_RAYS_PER_ITEM];
    static float distances[AIMED_RAYS_PER_ITEM];
    glint_random random = {first / AIMED_RAYS_PER_ITEM + 1};
    for (uint64_t i = 0; i < count; i++) {
        const aimed_ray aimed = aim_ray(scene, i % 2 == 1, &random);
        in[i] = (glint_probe_ray){.from = -1};
        for (int k = 0; k < 3; k++) {
            in[i].origin[k] = (double)aimed.origin[k];
            in[i].direction[k] = (double)aimed.direction[k];
        }
        distances[i] = aimed.distance;
    }
    TRY(glint_probe_call(
        probe, &(glint_probe_work){GLINT_PROBE_TRACE, NULL, in->origin, &out->distance, count},
        error));
    for (uint64_t i = 0; i < count; i++) {
        // NaN is a leak too.
        const bool leaks_here = !(out[i].distance <= AIMED_BEHIND * (double)distances[i]);
        *(i % 2 == 1 ? &leaks->at_edges : &leaks->at_vertices) += leaks_here;
    }
    return GLINT_OK;
}

glint_status count_leaks_of_glint(const bench_scene *scene, const glint_environment *environment,
                                  glint_device *device, leak_count *leaks, glint_error *error)
{
    leaks->at_vertices = leaks->at_edges = 0;
    const glint_renderer_inputs inputs = {.device = device,
                                          .scene = &scene->scene,
                                          .environment = environment,
                                          .settings = &glint_settings_default};
    glint_probe *probe;
    glint_status status;
    TRY_OR(cleanup, status, glint_probe_create(&inputs, &probe, error));
    for (uint64_t first = 0; first < leaks->rays; first += AIMED_RAYS_PER_ITEM) {
        TRY_OR(cleanup, status, trace_item(probe, scene, first, leaks, error));
    }
cleanup:
    glint_probe_free(probe);
    return status;
}
