// Tests hard cases of whole paths: a hundred bounces, rooms without a way out, a furnace without
// loss, coincident surfaces, scenes of nothing and of one triangle.
#include "base/memory.h"
#include "selftest/judge.h"
#include "selftest/shapes.h"
#include "selftest/trial.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double middle[3] = {0, 0, 0};

// Renders under E = 1.
static glint_status render_in_white(trial *t, const glint_scene *scene, const glint_camera *camera,
                                    const glint_settings *settings, trial_picture *picture)
{
    glint_environment environment;
    *picture = (trial_picture){0};
    glint_status status;
    TRY_OR(cleanup, status, trial_uniform_environment(1, &environment, t->error));
    const glint_renderer_inputs inputs = trial_inputs(t, scene, &environment, settings);
    TRY_OR(cleanup, status, trial_frame(t, &inputs, camera, picture));
cleanup:
    glint_environment_free(&environment);
    return status;
}

// ---- Parallel mirrors --------------------------------------------------------------------------

// An eye between two tinted mirrors looks straight at one of them, along parallel rays.
static glint_status parallel_mirrors(trial *t)
{
    static const int depths[] = {1, 2, 3, 10, 100};
    static const double tint[3] = {0.5, 0.75, 1};
    static const double mirrors[2][4][3] = {
        {{-0.75, -0.75, -0.5}, {0.75, -0.75, -0.5}, {0.75, 0.75, -0.5}, {-0.75, 0.75, -0.5}},
        {{0.75, -0.75, 0.5}, {-0.75, -0.75, 0.5}, {-0.75, 0.75, 0.5}, {0.75, 0.75, 0.5}}};
    static const double ahead[3] = {0, 0, -1};
    glint_measure *errors = trial_error(t, "tint^N beside what is seen, N up to 100", "N·u", 2);
    glint_scene scene;
    // Place two mirrors face to face.
    shape s = shape_begin();
    shape_add_quad(&s, mirrors[0], MATERIAL_TINTED);
    shape_add_quad(&s, mirrors[1], MATERIAL_TINTED);
    trial_picture picture = {0};
    glint_status status;
    TRY_OR(cleanup, status, shape_end(&s, &scene, t->error));
    const glint_camera camera = shape_camera(middle, ahead, 0, 0.25);
    // After N reflections the colour is tint^N.
    for (size_t i = 0; i < sizeof depths / sizeof *depths; i++) {
        const int n = depths[i];
        glint_settings settings = trial_settings(t);
        settings.depth = n;
        TRY_OR(cleanup, status, render_in_white(t, &scene, &camera, &settings, &picture));
        for (int p = 0; p < picture.width * picture.height; p++) {
            for (int k = 0; k < 3; k++) {
                const double expected = pow(tint[k], n);
                measure_value(errors, picture.values[4 * p + k], expected, n * t->u * expected,
                              "%d mirrors of %g, pixel %d", n, tint[k], p);
            }
        }
        trial_picture_free(&picture);
    }
cleanup:
    glint_scene_free(&scene);
    return status;
}

// ---- Closed rooms ------------------------------------------------------------------------------

static glint_status closed_room(trial *t)
{
    static const int depths[] = {1, 2, 7, 64, 1000};
    static const double low[3] = {-0.75, -0.5, -0.625}, high[3] = {0.625, 0.75, 0.5};
    static const double ahead[3] = {0.3, 0.2, -1};
    glint_measure *wrong = trial_events(t, "frames whose paths do not meet just N mirrors", 0);
    glint_measure *shares =
        trial_error(t, "share of light said to be cut off, beside 1", "2⁻³²", 1);
    glint_measure *colors = trial_events(t, "pixels that are not 1", 0);
    // Make a closed room of mirrors.
    glint_scene scene;
    shape s = shape_begin();
    shape_add_box(&s, &(shape_box){low, high, 3, MATERIAL_MIRROR, true});
    glint_status status;
    TRY_OR(cleanup, status, shape_end(&s, &scene, t->error));
    const glint_camera camera = shape_camera(middle, ahead, 1.5, 0);
    // Every path meets just N mirrors and is then cut off.
    for (size_t i = 0; i < sizeof depths / sizeof *depths; i++) {
        glint_settings settings = trial_settings(t);
        settings.depth = depths[i];
        trial_picture picture;
        TRY_OR(cleanup, status, render_in_white(t, &scene, &camera, &settings, &picture));
        const glint_frame_report *r = &picture.report;
        const uint64_t rays = r->rays.primary * (uint64_t)depths[i];
        measure_event(wrong, r->deepest != (uint32_t)depths[i] || r->rays.reflected != rays,
                      "depth %d: %u deep, %llu reflections instead of %llu", depths[i], r->deepest,
                      (unsigned long long)r->rays.reflected, (unsigned long long)rays);
        measure_value(shares, r->truncation.by_depth, 1, 0x1p-32, "depth %d", depths[i]);
        for (int p = 0; p < picture.width * picture.height; p++) {
            const double *rgb = picture.values + 4 * p;
            measure_event(colors, rgb[0] != 1 || rgb[1] != 1 || rgb[2] != 1,
                          "depth %d, pixel %d: (%.9g, %.9g, %.9g)", depths[i], p, rgb[0], rgb[1],
                          rgb[2]);
        }
        trial_picture_free(&picture);
    }
cleanup:
    glint_scene_free(&scene);
    return status;
}

// ---- The white furnace -------------------------------------------------------------------------

// Makes glass, glass in glass and mirrors, all without loss, in a mirrored room or in the open.
static glint_status furnace_scene(trial *t, bool closed, glint_scene *scene)
{
    static const double left[3] = {-0.3, 0, 0}, right[3] = {0.3, 0, 0.1};
    static const double low[3] = {-0.15, -0.4, -0.3}, high[3] = {0.2, -0.28, 0.3};
    static const double wall_low[3] = {-0.9, -0.9, -0.9}, wall_high[3] = {0.9, 0.9, 0.9};
    shape s = shape_begin();
    shape_add_ball(&s, &(shape_ball){left, 0.25, 3, MATERIAL_GLASS, true, NULL});
    shape_add_ball(&s, &(shape_ball){left, 0.125, 3, MATERIAL_CORE, false, NULL});
    shape_add_ball(&s, &(shape_ball){right, 0.25, 2, MATERIAL_MIRROR, true, NULL});
    shape_add_box(&s, &(shape_box){low, high, 1, MATERIAL_GLASS, false});
    if (closed) {
        shape_add_box(&s, &(shape_box){wall_low, wall_high, 1, MATERIAL_MIRROR, true});
    }
    return shape_end(&s, scene, t->error);
}

// At each surface the light is split into F and 1 − F. Rounding makes their sum 1 within u. The
// product with the weight adds another u. Adding up the ends errs by less than u for each surface
// on the way of the largest.
static glint_status measure_furnace(trial *t, bool closed, bool deep, glint_measure *errors,
                                    glint_measure *lost)
{
    static const double eye[3] = {0.1, 0.25, 0.8};
    glint_scene scene;
    trial_picture picture = {0};
    const glint_camera camera = shape_camera(eye, middle, 1, 0);
    glint_settings settings = trial_settings(t);
    settings.depth = deep ? 12 : 0;
    settings.min_weight = deep ? 1.0 / 64 : 1.0 / 1024;
    glint_status status;
    TRY_OR(cleanup, status, furnace_scene(t, closed, &scene));
    TRY_OR(cleanup, status, render_in_white(t, &scene, &camera, &settings, &picture));
    for (int p = 0; p < 3 * picture.width * picture.height; p++) {
        const double value = picture.values[p / 3 * 4 + p % 3];
        measure_event(lost, !isfinite(value), "pixel %d", p / 3);
        measure_value(errors, value, 1, t->u * fmax(1, picture.report.deepest),
                      "%s, depth %s, pixel (%d, %d)", closed ? "in a room" : "in the open",
                      deep ? "12" : "auto", p / 3 % picture.width, p / 3 / picture.width);
    }
cleanup:
    trial_picture_free(&picture);
    glint_scene_free(&scene);
    return status;
}

static glint_status white_furnace(trial *t)
{
    glint_measure *errors = trial_error(t, "pixels beside 1", "u × surfaces", 4);
    glint_measure *lost = trial_events(t, "pixels that are not finite", 0);
    for (int i = 0; i < 4; i++) {
        TRY(measure_furnace(t, i % 2 == 1, i / 2 == 1, errors, lost));
    }
    return GLINT_OK;
}

// ---- Coincident surfaces -----------------------------------------------------------------------

#define COPIES 3

// Makes a ball COPIES times in the same place, with its triangles in different orders. The first
// copy's triangles have the lowest numbers.
static glint_status coincident_balls(trial *t, glint_scene *scene)
{
    glint_scene one;
    shape plain = shape_begin();
    shape_add_ball(&plain, &(shape_ball){middle, 0.75, 3, MATERIAL_TINTED, true, NULL});
    glint_status status = shape_end(&plain, &one, t->error);
    if (status != GLINT_OK) {
        return status;
    }
    const size_t count = one.triangle_count;
    shape s = shape_begin();
    // Strides without a common divisor with 20 × 4³ visit all triangles.
    static const size_t strides[COPIES] = {7, 1, 321};
    for (size_t i = 0; i < COPIES * count; i++) {
        const size_t copy = i / count, which = i * strides[copy] % count;
        double corners[3][3], normals[3][3];
        for (size_t k = 0; k < 9; k++) {
            corners[k / 3][k % 3] = (double)one.positions[9 * which + k];
            normals[k / 3][k % 3] = (double)one.normals[9 * which + k];
        }
        shape_add(&s, (const double(*)[3])corners, (const double(*)[3])normals, MATERIAL_TINTED);
    }
    glint_scene_free(&one);
    return shape_end(&s, scene, t->error);
}

static glint_status coincident_faces(trial *t)
{
    static const double eye[3] = {0.3, 0.5, 2};
    glint_measure *higher = trial_events(t, "pixels that show a triangle of a higher number", 0);
    glint_measure *secondary = trial_events(t, "rays that hit a triangle of a higher number", 0);
    enum { COUNT = 8192 };
    static glint_probe_ray rays[COUNT];
    static glint_probe_hit hits[COUNT];
    glint_scene scene = {0};
    glint_probe *probe = NULL;
    trial_picture picture = {0};
    glint_status status;
    // A frame shows the lowest numbers.
    TRY_OR(cleanup, status, coincident_balls(t, &scene));
    const size_t lowest = scene.triangle_count / COPIES;
    const glint_camera camera = shape_camera(eye, middle, 0.8, 0);
    glint_settings settings = trial_settings(t);
    settings.output = GLINT_OUTPUT_HITS;
    TRY_OR(cleanup, status, render_in_white(t, &scene, &camera, &settings, &picture));
    for (int p = 0; p < picture.width * picture.height; p++) {
        measure_event(higher, !(picture.values[4 * p + 3] < (double)lowest),
                      "pixel %d shows triangle %g", p, picture.values[4 * p + 3]);
    }
    // Rays that start inside hit the lowest numbers too.
    for (int i = 0; i < COUNT; i++) {
        rays[i] = trial_random_ray(t, middle);
    }
    TRY_OR(cleanup, status, trial_probe(t, &scene, &probe));
    TRY_OR(cleanup, status, trial_trace(t, probe, rays, hits, COUNT));
    for (int i = 0; i < COUNT; i++) {
        measure_event(secondary, !(hits[i].triangle >= 0 && hits[i].triangle < (double)lowest),
                      "ray %d hits triangle %g", i, hits[i].triangle);
    }
cleanup:
    trial_picture_free(&picture);
    glint_probe_free(probe);
    glint_scene_free(&scene);
    return status;
}

// ---- Next to nothing ---------------------------------------------------------------------------

// The position of the triangles: before the eye, behind it, or before it without area.
typedef enum small_kind { BEFORE, BEHIND, FLAT } small_kind;

static glint_status small_scene(trial *t, int triangles, small_kind kind, glint_scene *scene)
{
    shape s = shape_begin();
    for (int i = 0; i < triangles; i++) {
        const double x = -0.7 + 0.09 * i, z = kind == BEHIND ? 0.9 : -0.25;
        const double right = kind == FLAT ? x : x + 0.08;
        const double corners[3][3] = {{x, -0.3, z}, {right, -0.3, z}, {x, 0.4, z}};
        shape_add(&s, corners, NULL, MATERIAL_MIRROR);
    }
    return shape_end(&s, scene, t->error);
}

static const double tiny_eye[3] = {0, 0, 0.6};

static glint_status tiny_picture(trial *t, int triangles, small_kind kind,
                                 const glint_settings *settings, trial_picture *picture)
{
    glint_scene scene;
    glint_environment environment = {0};
    *picture = (trial_picture){0};
    glint_status status;
    TRY_OR(cleanup, status, small_scene(t, triangles, kind, &scene));
    TRY_OR(cleanup, status, trial_linear_environment(16, &environment, t->error));
    const glint_camera camera = shape_camera(tiny_eye, middle, 1.2, 0);
    const glint_renderer_inputs inputs = trial_inputs(t, &scene, &environment, settings);
    TRY_OR(cleanup, status, trial_frame(t, &inputs, &camera, picture));
cleanup:
    glint_environment_free(&environment);
    glint_scene_free(&scene);
    return status;
}

// Compares a hidden triangle with no triangle at all. No triangle, one behind the eye, and one
// without area give the same bits. (With one triangle, and with a full leaf, the hits are the
// oracle's: compare_with_oracle.)
static glint_status compare_with_nothing(trial *t, const glint_settings *settings,
                                         glint_measure *different)
{
    trial_picture none = {0}, hidden = {0};
    glint_status status;
    TRY_OR(cleanup, status, tiny_picture(t, 0, BEFORE, settings, &none));
    for (int kind = BEHIND; kind <= FLAT; kind++) {
        TRY_OR(cleanup, status, tiny_picture(t, 1, (small_kind)kind, settings, &hidden));
        for (int p = 0; p < 4 * none.width * none.height; p++) {
            measure_event(different, none.values[p] != hidden.values[p], "value %d: %.9g and %.9g",
                          p, none.values[p], hidden.values[p]);
        }
        trial_picture_free(&hidden);
    }
cleanup:
    trial_picture_free(&none);
    return status;
}

static glint_status compare_with_oracle(trial *t, int triangles, const glint_settings *settings,
                                        glint_measure *others)
{
    const glint_camera camera = shape_camera(tiny_eye, middle, 1.2, 0);
    const oracle_view view = judge_view(&camera, settings);
    trial_picture picture;
    glint_scene scene = {0};
    judge j = {0};
    glint_status status;
    TRY_OR(cleanup, status, tiny_picture(t, triangles, BEFORE, settings, &picture));
    TRY_OR(cleanup, status, small_scene(t, triangles, BEFORE, &scene));
    TRY_OR(cleanup, status, judge_begin(&scene, &j, t->error));
    for (int p = 0; p < picture.width * picture.height; p++) {
        const int wanted = judge_pixel(&j.scene, &view, p % picture.width, p / picture.width);
        measure_event(others, picture.values[4 * p + 3] != wanted,
                      "%d triangles, pixel %d: %d expected, %g seen", triangles, p, wanted,
                      picture.values[4 * p + 3]);
    }
cleanup:
    judge_end(&j);
    glint_scene_free(&scene);
    trial_picture_free(&picture);
    return status;
}

static glint_status next_to_nothing(trial *t)
{
    static const int counts[] = {1, 16, 17};
    glint_measure *empty = trial_events(t, "pixels of the empty scene that are not the sky's", 0);
    glint_measure *others = trial_events(t, "pixels that show another triangle", 0);
    glint_settings settings = trial_settings(t);
    settings.depth = 1;
    TRY(compare_with_nothing(t, &settings, empty));
    settings.output = GLINT_OUTPUT_HITS;
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        TRY(compare_with_oracle(t, counts[i], &settings, others));
    }
    return GLINT_OK;
}

const trial_case path_cases[] = {
    {"parallel_mirrors", "between two mirrors, N bounces: tint^N", parallel_mirrors},
    {"closed_room", "a mirrored room without a way out: exactly the depth asked, and said so",
     closed_room},
    {"white_furnace", "mirrors and glass without loss under E = 1: 1 everywhere", white_furnace},
    {"coincident_faces", "a ball three times in one place: the lowest number wins",
     coincident_faces},
    {"next_to_nothing",
     "no triangle, one without area, one, a leaf full and one more: what is there",
     next_to_nothing},
    {0},
};
