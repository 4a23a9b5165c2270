// Tests hard cases of hits: edges, vertices, slivers, degenerate and coincident triangles, places
// where naive slab tests give NaN, scenes far from the origin.
#include "base/memory.h"
#include "selftest/judge.h"
#include "selftest/shapes.h"
#include "selftest/trial.h"
#include "selftest/vectors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define BATCH 32768 // rays in a batch

// ---- Closed meshes -----------------------------------------------------------------------------

static double spiky(const double u[3])
{
    return 0.35 + 0.6 * fabs(sin(9 * u[0] + 1) * sin(8 * u[1] + 2) * sin(11 * u[2]));
}

static double bumpy(const double u[3])
{
    return 0.8 + 0.1 * sin(5 * u[0]) * sin(4 * u[1] + 1) * sin(6 * u[2] + 2);
}

// Makes a closed body, star-shaped about its middle: every ray from there must hit.
static glint_status closed_scene(trial *t, int which, glint_scene *scene)
{
    static const double origin[3] = {0, 0, 0}, aside[3] = {0.6, -0.7, 0.55},
                        low[3] = {-0.75, -0.5, -0.875}, high[3] = {0.625, 0.75, 0.5};
    shape s = shape_begin();
    switch (which) {
    case 0:
        shape_add_ball(&s, &(shape_ball){origin, 1, 5, MATERIAL_TINTED, true, spiky});
        break;
    case 1:
        shape_add_ball(&s, &(shape_ball){origin, 1, 6, MATERIAL_TINTED, true, bumpy});
        break;
    case 2:
        shape_add_box(&s, &(shape_box){low, high, 24, MATERIAL_TINTED, false});
        break;
    case 3:
        shape_add_ball(&s, &(shape_ball){origin, 0x1p-10, 4, MATERIAL_TINTED, true, NULL});
        break;
    case 4: // gets an origin of its own
        shape_add_ball(&s, &(shape_ball){aside, 0x1p-10, 4, MATERIAL_TINTED, true, bumpy});
        return shape_end_with_parts(&s, 1, scene, NULL, t->error);
    default:
        shape_add_ball(&s, &(shape_ball){aside, 0.15, 5, MATERIAL_TINTED, true, bumpy});
        break;
    }
    return shape_end(&s, scene, t->error);
}
#define CLOSED_SCENES 6

// Picks a point on an edge of a random triangle, or a vertex.
static void random_target(trial *t, const glint_scene *scene, bool at_vertex, double target[3])
{
    const size_t number = (size_t)(glint_random_number(&t->random) * (double)scene->triangle_count);
    const int edge = (int)(3 * glint_random_number(&t->random));
    const glint_vec3 a = glint_scene_corner(scene, number, (size_t)edge);
    const glint_vec3 b = glint_scene_corner(scene, number, (size_t)(edge + 1) % 3);
    const double share = at_vertex ? 0 : glint_random_number(&t->random);
    const glint_vec3 on_edge =
        glint_vec3_add(a, glint_vec3_scale(glint_vec3_subtract(b, a), share));
    const double exact[3] = {on_edge.x, on_edge.y, on_edge.z};
    for (int k = 0; k < 3; k++) {
        target[k] = scene->parts.count > 0 ? exact[k] : trial_rounded(t, exact[k]);
    }
}

// A ray that starts inside, near the middle.
static glint_probe_ray ray_from_inside(trial *t, const glint_scene *scene, const double target[3])
{
    const double size = 0.05 * (scene->high.x - scene->low.x);
    const double from[3] = {(scene->low.x + scene->high.x) / 2 + trial_random(t, -size, size),
                            (scene->low.y + scene->high.y) / 2 + trial_random(t, -size, size),
                            (scene->low.z + scene->high.z) / 2 + trial_random(t, -size, size)};
    return trial_aim(t, from, target);
}

// Traces a batch. `in` and `out` hold it.
static glint_status trace_batch(trial *t, glint_probe *probe, const glint_scene *scene,
                                bool at_vertex, glint_measure *leaks)
{
    static glint_probe_ray in[BATCH];
    static glint_probe_hit out[BATCH];
    for (size_t i = 0; i < BATCH; i++) {
        double target[3];
        random_target(t, scene, at_vertex, target);
        in[i] = ray_from_inside(t, scene, target);
    }
    TRY(trial_trace(t, probe, in, out, BATCH));
    for (size_t i = 0; i < BATCH; i++) {
        const double *o = in[i].origin, *d = in[i].direction;
        measure_event(leaks, !(out[i].triangle >= 0),
                      "the ray from (%.9g, %.9g, %.9g) along (%.9g, %.9g, %.9g) hits nothing", o[0],
                      o[1], o[2], d[0], d[1], d[2]);
    }
    return GLINT_OK;
}

static glint_status count_leaks(trial *t, const glint_scene *scene, bool at_vertex, uint64_t rays,
                                glint_measure *leaks)
{
    glint_probe *probe;
    glint_status status;
    TRY_OR(cleanup, status, trial_probe(t, scene, &probe));
    for (uint64_t done = 0; done < rays; done += BATCH) {
        TRY_OR(cleanup, status, trace_batch(t, probe, scene, at_vertex, leaks));
    }
cleanup:
    glint_probe_free(probe);
    return status;
}

static glint_status leaks_of_closed_mesh(trial *t, int which, bool at_vertex, glint_measure *leaks)
{
    const uint64_t rays = 1 + (t->options->rays - 1) / CLOSED_SCENES;
    glint_scene scene;
    glint_status status;
    TRY_OR(cleanup, status, closed_scene(t, which, &scene));
    TRY_OR(cleanup, status, count_leaks(t, &scene, at_vertex, rays, leaks));
cleanup:
    glint_scene_free(&scene);
    return status;
}

static glint_status leaks_of_closed_meshes(trial *t, bool at_vertex)
{
    glint_measure *leaks = trial_events(t, "rays that pass between triangles", 0);
    for (int which = 0; which < CLOSED_SCENES; which++) {
        TRY(leaks_of_closed_mesh(t, which, at_vertex, leaks));
    }
    return GLINT_OK;
}

static glint_status rays_at_shared_edges(trial *t)
{
    return leaks_of_closed_meshes(t, false);
}

static glint_status rays_at_vertices(trial *t)
{
    return leaks_of_closed_meshes(t, true);
}

// ---- Against the oracle ------------------------------------------------------------------------

static glint_status trace_scene(trial *t, const glint_scene *scene, const glint_probe_ray *rays,
                                glint_probe_hit *hits, size_t count)
{
    glint_probe *probe;
    glint_status status;
    TRY_OR(cleanup, status, trial_probe(t, scene, &probe));
    TRY_OR(cleanup, status, trial_trace(t, probe, rays, hits, count));
cleanup:
    glint_probe_free(probe);
    return status;
}

// Gets the oracle's hits of the rays, an array of `count`.
static glint_status trace_by_oracle(trial *t, const glint_scene *scene, const glint_probe_ray *rays,
                                    oracle_hit *wanted, size_t count)
{
    judge j;
    TRY(judge_begin(scene, &j, t->error));
    for (size_t i = 0; i < count; i++) {
        wanted[i] = judge_ray(&j.scene, &rays[i]);
    }
    judge_end(&j);
    return GLINT_OK;
}

// ---- Primary rays ------------------------------------------------------------------------------

#define SHEET 128 // pixels across and down
#define SHEET_YFOV (0.5 * GLINT_PI)

// Makes a sheet whose vertices stand exactly on the rays through pixels' middles. With step 1 every
// such ray meets a vertex. With step 2 every other ray does, and the rest meet edges.
static glint_status sheet_scene(trial *t, int step, bool orthographic, glint_scene *scene)
{
    enum { COUNT = SHEET + 5 };
    static double at[COUNT][COUNT][3];
    const double pixel = 2.0 / SHEET; // 2 tan(45°); all products here are exact in float
    for (int j = 0; j < COUNT; j++) {
        for (int i = 0; i < COUNT; i++) {
            const double depth = orthographic ? 1 : floor(trial_random(t, 16, 32)) / 64;
            at[j][i][0] = (step * (i - 2) + 0.5 - SHEET / 2.0) * pixel * depth;
            at[j][i][1] = (SHEET / 2.0 - step * (j - 2) - 0.5) * pixel * depth;
            at[j][i][2] = orthographic ? -trial_random(t, 0.25, 0.5) : -depth;
        }
    }
    const int needed = SHEET / step + 4;
    shape s = shape_begin();
    for (int j = 0; j < needed; j++) {
        for (int i = 0; i < needed; i++) {
            double quad[4][3];
            memcpy(quad[0], at[j + 1][i], sizeof quad[0]);
            memcpy(quad[1], at[j + 1][i + 1], sizeof quad[1]);
            memcpy(quad[2], at[j][i + 1], sizeof quad[2]);
            memcpy(quad[3], at[j][i], sizeof quad[3]);
            shape_add_quad(&s, (const double(*)[3])quad, MATERIAL_TINTED);
        }
    }
    return shape_end_with_unit(&s, orthographic ? 2 : 1, scene, t->error);
}

// Renders frames of the sheet. Each frame's angle of view differs by some ulp.
static glint_status watch_sheet(trial *t, const glint_scene *scene, bool orthographic,
                                uint64_t rays, glint_measure *leaks)
{
    static const double eye[3] = {0, 0, 0}, target[3] = {0, 0, -1};
    // Set up a renderer that shows hits.
    glint_environment environment;
    glint_settings settings = trial_settings(t);
    settings.width = settings.height = SHEET;
    settings.output = GLINT_OUTPUT_HITS;
    glint_renderer *renderer = NULL;
    glint_image image = {0};
    glint_status status;
    TRY_OR(cleanup, status, trial_uniform_environment(1, &environment, t->error));
    const glint_renderer_inputs inputs = trial_inputs(t, scene, &environment, &settings);
    TRY_OR(cleanup, status, glint_renderer_create(&inputs, &renderer, t->error));
    // Render with a nudged angle. Every pixel must hit the sheet.
    for (uint64_t done = 0; done < rays; done += SHEET * SHEET) {
        // The nudge is 0, 1, −1, 2, −2 and so on.
        const int frame = (int)(done / (SHEET * SHEET) % 17), off = (frame + 1) / 2;
        const double nudge = 1 + t->u * (frame % 2 == 1 ? off : -off);
        const glint_camera camera = shape_camera(eye, target, orthographic ? 0 : SHEET_YFOV * nudge,
                                                 2 * nudge * tan(SHEET_YFOV / 2));
        TRY_OR(cleanup, status,
               glint_renderer_frame(&(glint_frame_request){renderer, &camera, NULL, &image, NULL},
                                    t->error));
        for (int i = 0; i < SHEET * SHEET; i++) {
            measure_event(leaks, !(image.pixels[4 * i + 3] >= 0),
                          "pixel (%d, %d) looks through the sheet", i % SHEET, i / SHEET);
        }
    }
cleanup:
    glint_image_free(&image);
    glint_renderer_free(renderer);
    glint_environment_free(&environment);
    return status;
}

static glint_status leaks_of_sheet(trial *t, int kind, bool orthographic, glint_measure *leaks)
{
    glint_scene scene;
    glint_status status;
    TRY_OR(cleanup, status, sheet_scene(t, kind, orthographic, &scene));
    TRY_OR(cleanup, status,
           watch_sheet(t, &scene, orthographic, 1 + (t->options->rays - 1) / 4, leaks));
cleanup:
    glint_scene_free(&scene);
    return status;
}

static glint_status primary_rays_at_edges(trial *t)
{
    glint_measure *vertices = trial_events(t, "primary rays at vertices that pass", 0);
    glint_measure *edges = trial_events(t, "primary rays at edges that pass", 0);
    for (int kind = 0; kind < 4; kind++) {
        TRY(leaks_of_sheet(t, 1 + kind / 2, kind % 2 == 1, kind / 2 == 0 ? vertices : edges));
    }
    return GLINT_OK;
}

// ---- Zeros and NaN -----------------------------------------------------------------------------

#define GRID 16 // origins and the boxes' corners are multiples of 1/GRID

// A ray along an axis, from a point on the grid. The other components are 0 or −0, in all
// combinations.
static glint_probe_ray axis_ray(int number)
{
    const int axis = number % 3, sign = number / 3 % 2, zeros = number / 6 % 4;
    const int a = number / 24 % (GRID - 3), b = number / 24 / (GRID - 3) % (GRID - 3);
    glint_probe_ray ray = {.from = -1};
    ray.origin[axis] = 0;
    ray.origin[(axis + 1) % 3] = (double)(a + 2) / GRID - 0.5;
    ray.origin[(axis + 2) % 3] = (double)(b + 2) / GRID - 0.5;
    ray.direction[axis] = sign ? -1 : 1;
    ray.direction[(axis + 1) % 3] = zeros & 1 ? 0.0 : -0.0;
    ray.direction[(axis + 2) % 3] = zeros & 2 ? 0.0 : -0.0;
    return ray;
}

// Makes boxes inside each other. Rays run and start on their walls, which lie in the grid's planes.
static glint_status nested_boxes(trial *t, glint_scene *scene)
{
    shape s = shape_begin();
    for (int i = 1; i <= GRID / 2; i++) {
        const double h = (double)i / GRID;
        const double low[3] = {-h, -h, -h}, high[3] = {h, h, h};
        shape_add_box(&s, &(shape_box){low, high, 2 * i, MATERIAL_TINTED, i % 2 == 0});
    }
    return shape_end(&s, scene, t->error);
}

static glint_status directions_with_zeros(trial *t)
{
    enum { COUNT = 24 * (GRID - 3) * (GRID - 3) };
    static glint_probe_ray rays[COUNT];
    static glint_probe_hit found[COUNT];
    static oracle_hit wanted[COUNT];
    glint_measure *others = trial_events(t, "rays that meet another triangle", 0);
    // A division errs by this much.
    glint_measure *distances = trial_error(t, "error of the distance", "u", 4);
    for (int i = 0; i < COUNT; i++) {
        rays[i] = axis_ray(i);
    }
    glint_scene scene;
    glint_status status;
    TRY_OR(cleanup, status, nested_boxes(t, &scene));
    TRY_OR(cleanup, status, trace_scene(t, &scene, rays, found, COUNT));
    TRY_OR(cleanup, status, trace_by_oracle(t, &scene, rays, wanted, COUNT));
    for (int i = 0; i < COUNT; i++) {
        const double *o = rays[i].origin;
        measure_event(others, found[i].triangle != (double)wanted[i].triangle,
                      "from (%g, %g, %g) along axis %d: triangle %d expected, %g found", o[0], o[1],
                      o[2], i % 3, wanted[i].triangle, found[i].triangle);
        if (wanted[i].triangle >= 0) {
            measure_value(distances, found[i].distance, wanted[i].distance, t->u,
                          "from (%g, %g, %g) along axis %d", o[0], o[1], o[2], i % 3);
        }
    }
cleanup:
    glint_scene_free(&scene);
    return status;
}

// Makes a bumpy ball. With `spoilt`, a triangle without area follows each of its triangles.
static glint_status ball_scene(trial *t, bool spoilt, glint_scene *scene)
{
    static const double centre[3] = {0, 0, 0};
    glint_scene clean;
    // Make the plain ball.
    shape plain = shape_begin();
    shape_add_ball(&plain, &(shape_ball){centre, 1, 3, MATERIAL_TINTED, false, bumpy});
    glint_status status = shape_end(&plain, &clean, t->error);
    if (status != GLINT_OK || !spoilt) {
        *scene = clean;
        return status;
    }
    // Copy it, with empty triangles between.
    shape s = shape_begin();
    for (size_t i = 0; i < clean.triangle_count; i++) {
        double own[3][3], empty[3][3];
        for (size_t k = 0; k < 9; k++) {
            own[k / 3][k % 3] = (double)clean.positions[9 * i + k];
        }
        // The empty triangle is a point, an edge there and back, or three points of an edge along
        // an axis.
        for (size_t k = 0; k < 9; k++) {
            const size_t corner = i % 3 == 0 ? 0 : k / 3 == 2 ? 0 : k / 3;
            empty[k / 3][k % 3] = own[corner][k % 3];
        }
        if (i % 3 == 2) {
            memcpy(empty[1], empty[0], sizeof empty[1]);
            empty[1][0] += 0.0625;
            empty[2][0] += 0.03125;
        }
        shape_add(&s, (const double(*)[3])own, NULL, MATERIAL_TINTED);
        shape_add(&s, (const double(*)[3])empty, NULL, MATERIAL_TINTED);
    }
    glint_scene_free(&clean);
    return shape_end(&s, scene, t->error);
}

static void aim_at_mesh(trial *t, const glint_scene *scene, glint_probe_ray *rays, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        double target[3];
        random_target(t, scene, i % 2 == 0, target);
        rays[i] = ray_from_inside(t, scene, target);
    }
}

static glint_status triangles_without_area(trial *t)
{
    enum { COUNT = 8192 };
    static glint_probe_ray rays[COUNT];
    static glint_probe_hit clean[COUNT], found[COUNT];
    glint_measure *empty = trial_events(t, "rays that hit a triangle without area", 0);
    glint_measure *changed = trial_events(t, "hits of its neighbours that changed", 0);
    glint_scene scene = {0}, spoilt = {0};
    glint_status status;
    TRY_OR(cleanup, status, ball_scene(t, false, &scene));
    TRY_OR(cleanup, status, ball_scene(t, true, &spoilt));
    aim_at_mesh(t, &scene, rays, COUNT);
    TRY_OR(cleanup, status, trace_scene(t, &scene, rays, clean, COUNT));
    TRY_OR(cleanup, status, trace_scene(t, &spoilt, rays, found, COUNT));
    for (int i = 0; i < COUNT; i++) {
        const double number = found[i].triangle;
        measure_event(empty, fmod(number, 2) != 0, "ray %d hits triangle %g", i, number);
        measure_event(changed,
                      number != 2 * clean[i].triangle || found[i].distance != clean[i].distance,
                      "ray %d: triangle %g at %.9g expected, %g at %.9g found", i,
                      2 * clean[i].triangle, clean[i].distance, number, found[i].distance);
    }
cleanup:
    glint_scene_free(&scene);
    glint_scene_free(&spoilt);
    return status;
}

// ---- Slivers -----------------------------------------------------------------------------------

#define STRIPS 256
#define STRIP_WIDTH 1e-6

// Makes a closed column along y. One side consists of strips, a million times as long as wide. The
// caps are fans.
static glint_status sliver_scene(trial *t, glint_scene *scene)
{
    static double profile[STRIPS + 4][2]; // x, z, counter-clockwise from above
    const double square[3][2] = {{0.5, -0.5}, {-0.5, -0.5}, {-0.5, 0.5}};
    memcpy(profile, square, sizeof square);
    for (int i = 0; i <= STRIPS; i++) {
        profile[3 + i][0] = (double)(float)(0.1 + STRIP_WIDTH * i);
        profile[3 + i][1] = 0.5;
    }
    shape s = shape_begin();
    for (int i = 0; i < STRIPS + 4; i++) {
        const double *a = profile[i], *b = profile[(i + 1) % (STRIPS + 4)];
        const double side[4][3] = {
            {a[0], -0.5, a[1]}, {b[0], -0.5, b[1]}, {b[0], 0.5, b[1]}, {a[0], 0.5, a[1]}};
        shape_add_quad(&s, side, MATERIAL_TINTED);
        const double top[3][3] = {{a[0], 0.5, a[1]}, {b[0], 0.5, b[1]}, {0, 0.5, 0}};
        const double bottom[3][3] = {{b[0], -0.5, b[1]}, {a[0], -0.5, a[1]}, {0, -0.5, 0}};
        shape_add(&s, top, NULL, MATERIAL_TINTED);
        shape_add(&s, bottom, NULL, MATERIAL_TINTED);
    }
    return shape_end(&s, scene, t->error);
}

// The distance from the ray to the point of the triangle that the weights describe.
static double distance_to_point(const glint_scene *scene, const glint_probe_ray *ray,
                                const glint_probe_hit *hit)
{
    const float *p = scene->positions + 9 * (size_t)hit->triangle;
    const double b1 = hit->barycentric[0], b2 = hit->barycentric[1], b0 = 1 - b1 - b2;
    double away[3], along = 0, squares = 0;
    for (int k = 0; k < 3; k++) {
        away[k] =
            b0 * (double)p[k] + b1 * (double)p[3 + k] + b2 * (double)p[6 + k] - ray->origin[k];
        along += away[k] * ray->direction[k];
    }
    for (int k = 0; k < 3; k++) {
        const double across = away[k] - along * ray->direction[k];
        squares += across * across;
    }
    return sqrt(squares);
}

// Measures how far a hit's weights lie outside of the triangle, in u.
static void judge_weights(glint_measure *weights, const trial *t, const glint_probe_hit *hit,
                          int ray)
{
    const double b1 = hit->barycentric[0], b2 = hit->barycentric[1];
    // Add all up, so that NaN stays. Each weight is a quotient, good to 2u; the third is the rest
    // to 1.
    const double outside = above_zero(-b1) + above_zero(-b2) + above_zero(b1 + b2 - 1);
    measure_error(weights, outside / t->u, "ray %d, triangle %g: %.9g, %.9g", ray, hit->triangle,
                  b1, b2);
}

static glint_status slivers(trial *t)
{
    enum { COUNT = 65536 };
    static glint_probe_ray rays[COUNT];
    static glint_probe_hit found[COUNT];
    glint_measure *leaks = trial_events(t, "rays that pass between slivers", 0);
    // After the shear, the hit's corners are known to about 4u. The ray's direction is a unit
    // vector to 2u.
    glint_measure *distances = trial_error(t, "from the ray to the point that was hit", "u", 16);
    // Then the point lies in the triangle that is reported as hit.
    glint_measure *weights = trial_error(t, "barycentric weights outside of [0, 1]", "u", 4);
    glint_scene scene;
    glint_status status;
    TRY_OR(cleanup, status, sliver_scene(t, &scene));
    aim_at_mesh(t, &scene, rays, COUNT);
    TRY_OR(cleanup, status, trace_scene(t, &scene, rays, found, COUNT));
    for (int i = 0; i < COUNT; i++) {
        const bool missed = !(found[i].triangle >= 0);
        measure_event(leaks, missed, "ray %d from (%.9g, %.9g, %.9g)", i, rays[i].origin[0],
                      rays[i].origin[1], rays[i].origin[2]);
        if (!missed) {
            judge_weights(weights, t, &found[i], i);
            measure_error(distances, distance_to_point(&scene, &rays[i], &found[i]) / t->u,
                          "ray %d, triangle %g", i, found[i].triangle);
        }
    }
cleanup:
    glint_scene_free(&scene);
    return status;
}

// ---- Triangles seen edge-on --------------------------------------------------------------------

// Aims rays from places very near the planes of a box's walls to other such places. They meet walls
// edge-on, where rounding decides about the hit.
static void aim_along_walls(trial *t, glint_probe_ray *rays, int count)
{
    for (int i = 0; i < count; i++) {
        double ends[2][3];
        for (int e = 0; e < 2; e++) {
            for (int k = 0; k < 3; k++) {
                ends[e][k] = trial_random(t, -0.7, 0.7);
            }
            ends[e][i % 3] = (i % 2 ? -0.5 : 0.5) + pow(10, trial_random(t, -8, -4)) * (e ? 1 : -1);
        }
        rays[i] = trial_aim(t, ends[0], ends[1]);
    }
}

static glint_status edge_on_triangles(trial *t)
{
    enum { COUNT = 32768 };
    static const double low[3] = {-0.5, -0.5, -0.5}, high[3] = {0.5, 0.5, 0.5};
    static glint_probe_ray rays[COUNT], reversed[COUNT];
    static glint_probe_hit found[COUNT], again[COUNT];
    glint_measure *company = trial_events(t, "hits that depend on the rays beside", 0);
    glint_measure *weights = trial_error(t, "barycentric weights outside of [0, 1]", "u", 4);
    glint_scene scene;
    // Trace the rays in two orders.
    glint_probe *probe;
    shape s = shape_begin();
    shape_add_box(&s, &(shape_box){low, high, 2, MATERIAL_TINTED, false});
    glint_status status;
    TRY_OR(cleanup, status, trial_build(t, &s, &scene, &probe));
    aim_along_walls(t, rays, COUNT);
    for (int i = 0; i < COUNT; i++) {
        reversed[i] = rays[COUNT - 1 - i];
    }
    TRY_OR(cleanup, status, trial_trace(t, probe, rays, found, COUNT));
    TRY_OR(cleanup, status, trial_trace(t, probe, reversed, again, COUNT));
    // A hit must not depend on the order.
    for (int i = 0; i < COUNT; i++) {
        const glint_probe_hit *a = &found[i], *b = &again[COUNT - 1 - i];
        measure_event(company, a->triangle != b->triangle || a->distance != b->distance,
                      "ray %d: triangle %g at %.9g, in another order %g at %.9g", i, a->triangle,
                      a->distance, b->triangle, b->distance);
        if (a->triangle >= 0) {
            judge_weights(weights, t, a, i);
        }
    }
cleanup:
    glint_probe_free(probe);
    glint_scene_free(&scene);
    return status;
}

const trial_case hit_cases[] = {
    {"rays_at_shared_edges", "rays aimed at edges of closed meshes: none passes",
     rays_at_shared_edges},
    {"primary_rays_at_edges", "pixels whose middles lie on edges and vertices: none sees through",
     primary_rays_at_edges},
    {"rays_at_vertices", "rays aimed at vertices of closed meshes: none passes", rays_at_vertices},
    {"directions_with_zeros", "rays along axes, from planes of boxes: what the oracle hits",
     directions_with_zeros},
    {"triangles_without_area", "points and lines among triangles: not hit, neighbours unaffected",
     triangles_without_area},
    {"slivers", "triangles a million times as long as wide: watertight, hit where the ray is",
     slivers},
    {"edge_on_triangles", "rays along walls: hits in the triangles, whatever rays are beside",
     edge_on_triangles},
    {0},
};
