// Tests hard cases of size and place: far from the origin, tiny beside huge, and everything scaled.
#include "selftest/judge.h"
#include "selftest/shapes.h"
#include "selftest/trial.h"

#include <math.h>
#include <string.h>

static const double middle[3] = {0, 0, 0};

typedef struct watched {
    const glint_camera *camera;
    int size[2];
    double last; // triangles from this number on count as one
} watched;

// Counts the pixels that show another triangle than the oracle's. Triangles from `last` on count as
// one.
static glint_status compare_hits(trial *t, const glint_scene *scene, const watched *view,
                                 glint_measure *others)
{
    const int *size = view->size;
    const double last = view->last;
    glint_environment environment;
    judge j = {0};
    trial_picture picture = {0};
    glint_settings settings = trial_settings(t);
    settings.width = size[0];
    settings.height = size[1];
    settings.output = GLINT_OUTPUT_HITS;
    glint_status status;
    TRY_OR(cleanup, status, trial_uniform_environment(1, &environment, t->error));
    TRY_OR(cleanup, status, judge_begin(scene, &j, t->error));
    const glint_renderer_inputs inputs = trial_inputs(t, scene, &environment, &settings);
    TRY_OR(cleanup, status, trial_frame(t, &inputs, view->camera, &picture));
    const oracle_view judged = judge_view(view->camera, &settings);
    for (int i = 0; i < size[0] * size[1]; i++) {
        const int column = i % size[0], row = i / size[0];
        const double wanted = fmin(judge_pixel(&j.scene, &judged, column, row), last);
        const double number = picture.values[4 * i + 3];
        const double found = number > last ? last : number; // NaN stays NaN
        measure_event(others, found != wanted, "pixel (%d, %d): triangle %g expected, %g found",
                      column, row, wanted, found);
    }
cleanup:
    trial_picture_free(&picture);
    judge_end(&j);
    glint_environment_free(&environment);
    return status;
}

// Moves a ball's scene to a place and judges the view of an eye near it, `size` × (10, 5, 14) away.
static glint_status watch_ball(trial *t, glint_scene *scene, const double place[3], double size,
                               glint_measure *others)
{
    const double eye[3] = {place[0] + 10 * size, place[1] + 5 * size, place[2] + 14 * size};
    const glint_camera camera = shape_camera(eye, place, 0.9, 0);
    scene->origin = (glint_vec3){place[0], place[1], place[2]};
    glint_scene_find_bounds(scene);
    const watched view = {&camera, {200, 150}, INFINITY};
    return compare_hits(t, scene, &view, others);
}

// A ball a million metres from the origin, where a float steps by 1/16 of a metre. Single precision
// leaves only its rounded vertices.
static glint_status rounded_ball(trial *t, glint_measure *others)
{
    enum { UNIT = 8 };
    static const double far[3] = {1e6, -1e6, 1e6};
    glint_scene scene;
    shape s = shape_begin();
    shape_add_ball(&s, &(shape_ball){middle, 1, 3, MATERIAL_MIRROR, true, NULL});
    glint_status status;
    TRY_OR(cleanup, status, shape_end_with_unit(&s, UNIT, &scene, t->error));
    for (size_t i = 0; i < 9 * scene.triangle_count; i++) {
        const float world = (float)(far[i % 3] + 7 * (double)scene.positions[i]);
        scene.positions[i] = (float)(((double)world - far[i % 3]) / UNIT);
    }
    TRY_OR(cleanup, status, watch_ball(t, &scene, far, 1, others));
cleanup:
    glint_scene_free(&scene);
    return status;
}

// A ball of 4 mm at ten million metres, as loaders place it with transforms in double. Its own
// coordinates are small. Its place and the eye's are double, exact to 2⁻³⁰ m there: 2·10⁻⁵ of a
// pixel.
static glint_status small_ball(trial *t, glint_measure *others)
{
    static const double unit = 0x1p-8, far[3] = {1e7, -1e7, 1e7};
    glint_scene scene;
    shape s = shape_begin();
    shape_add_ball(&s, &(shape_ball){middle, 0.002 / unit, 3, MATERIAL_MIRROR, true, NULL});
    glint_status status;
    TRY_OR(cleanup, status, shape_end_with_unit(&s, unit, &scene, t->error));
    TRY_OR(cleanup, status, watch_ball(t, &scene, far, 4e-4, others));
cleanup:
    glint_scene_free(&scene);
    return status;
}

static glint_status far_from_origin(trial *t)
{
    glint_measure *rounded = trial_share(t, "at 10⁶ m: pixels that show another triangle", 1e-4);
    glint_measure *small = trial_share(t, "at 10⁷ m, of a ball of 4 mm", 1e-4);
    TRY(rounded_ball(t, rounded));
    return small_ball(t, small);
}

// A ball of a millimetre on a plane of twenty kilometres. The plane's two triangles count as one.
// Seen from so near, the line between them is only known to a rounding error of its far ends.
static glint_status tiny_on_huge(trial *t)
{
    static const double unit = 0x1p14, radius = 5e-4, half = 1e4;
    glint_measure *others = trial_share(t, "pixels that show another triangle", 1e-5);
    glint_scene scene;
    shape s = shape_begin();
    const double h = half / unit, centre[3] = {0, radius / unit, 0};
    const double plane[4][3] = {{-h, 0, h}, {h, 0, h}, {h, 0, -h}, {-h, 0, -h}};
    shape_add_ball(&s, &(shape_ball){centre, radius / unit, 4, MATERIAL_MIRROR, true, NULL});
    shape_add_quad(&s, plane, MATERIAL_MIRROR);
    glint_status status;
    TRY_OR(cleanup, status, shape_end_with_unit(&s, unit, &scene, t->error));
    const double halves = (double)scene.triangle_count - 2;
    const double eye[3] = {6e-4, 1.2e-3, 2e-3}, target[3] = {0, radius, 0};
    const glint_camera camera = shape_camera(eye, target, 0.9, 0);
    const watched view = {&camera, {400, 300}, halves};
    TRY_OR(cleanup, status, compare_hits(t, &scene, &view, others));
cleanup:
    glint_scene_free(&scene);
    return status;
}

// Renders a glass ball before a mirror, in a world 2^k times as large, with a unit 2^unit times as
// large.
static glint_status scaled_picture(trial *t, const glint_environment *environment, int k, int unit,
                                   trial_picture *picture)
{
    static const double ball[3] = {0.1, 0, 0.2};
    static const double wall[4][3] = {
        {-0.9, -0.8, -0.5}, {0.9, -0.8, -0.5}, {0.9, 0.8, -0.5}, {-0.9, 0.8, -0.5}};
    const double scale = ldexp(1, k), eye[3] = {0.3 * scale, 0.4 * scale, 2 * scale};
    glint_scene scene;
    shape s = shape_begin();
    shape_add_ball(&s, &(shape_ball){ball, 0.4, 3, MATERIAL_GLASS, true, NULL});
    shape_add_quad(&s, wall, MATERIAL_MIRROR);
    glint_status status;
    TRY_OR(cleanup, status, shape_end_with_unit(&s, ldexp(1, unit), &scene, t->error));
    for (size_t i = 0; i < 9 * scene.triangle_count; i++) {
        scene.positions[i] *= (float)ldexp(1, k - unit);
    }
    glint_scene_find_bounds(&scene);
    const glint_camera camera = shape_camera(eye, middle, 0.8, 0);
    glint_settings settings = trial_settings(t);
    settings.depth = 8;
    settings.min_weight = 1.0 / 256;
    const glint_renderer_inputs inputs = trial_inputs(t, &scene, environment, &settings);
    TRY_OR(cleanup, status, trial_frame(t, &inputs, &camera, picture));
cleanup:
    glint_scene_free(&scene);
    return status;
}

static glint_status powers_of_two(trial *t)
{
    // The last two keep the unit, so the kernels get small coordinates.
    static const struct {
        int scale, unit;
    } scales[] = {{-20, -20}, {20, 20}, {-60, -60}, {60, 60}, {-10, 0}, {-20, 0}};
    glint_measure *errors = trial_error(t, "colours of the scaled scene", "ulp", 4);
    glint_environment environment;
    trial_picture plain = {0};
    glint_status status;
    TRY_OR(cleanup, status, trial_linear_environment(16, &environment, t->error));
    TRY_OR(cleanup, status, scaled_picture(t, &environment, 0, 0, &plain));
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
        trial_picture scaled;
        TRY_OR(cleanup, status,
               scaled_picture(t, &environment, scales[i].scale, scales[i].unit, &scaled));
        for (int p = 0; p < 4 * plain.width * plain.height; p++) {
            measure_error(errors, fabs(trial_ulps(t, scaled.values[p], plain.values[p])),
                          "2^%d, value %d: %.9g unscaled, %.9g scaled", scales[i].scale, p,
                          plain.values[p], scaled.values[p]);
        }
        trial_picture_free(&scaled);
    }
cleanup:
    trial_picture_free(&plain);
    glint_environment_free(&environment);
    return status;
}

const trial_case scale_cases[] = {
    {"far_from_origin",
     "meshes at 10⁶ m, where floats step by 1/16, and of millimetres at 10⁷ m: the oracle's view",
     far_from_origin},
    {"powers_of_two", "a scene of glass and mirrors, times 2^±20 and 2^±60: the same picture",
     powers_of_two},
    {"tiny_on_huge", "a ball of 1 mm on a plane of 20 km: what the oracle sees", tiny_on_huge},
    {0},
};
