// Tests hard cases of frames beyond the colours of independent pixels: layers, terms, lists of
// pixels, shading at vertices, and environments that are near or averaged.
#include "selftest/judged.h"
#include "selftest/shapes.h"

#include <math.h>
#include <string.h>

#define UNIT 2 // metres per stored unit; not 1, so that layers in metres differ from stored units

static const double eye[3] = {0.3 * UNIT, 0.25 * UNIT, 2.1 * UNIT}, target[3] = {0, 0, 0};

// Builds a ball of tinted metal and a ball of paint in front of glass.
static glint_status build_scene(trial *t, int level, glint_scene *scene)
{
    static const double metal[3] = {-0.45, 0, 0}, paint[3] = {0.45, 0, 0.1},
                        wall[4][3] = {{-0.9, -0.7, -0.6},
                                      {0.9, -0.7, -0.8},
                                      {0.9, 0.7, -0.8},
                                      {-0.9, 0.7, -0.6}};
    shape s = shape_begin();
    shape_add_ball(&s, &(shape_ball){metal, 0.4, level, MATERIAL_TINTED, true, NULL});
    shape_add_ball(&s, &(shape_ball){paint, 0.4, level, MATERIAL_PAINT, true, NULL});
    shape_add_quad(&s, wall, MATERIAL_GLASS);
    TRY(shape_end_with_unit(&s, UNIT, scene, t->error));
    scene->materials[MATERIAL_GLASS].thickness = 0;
    scene->materials[MATERIAL_PAINT].base_color[1] = 0.5F;
    return GLINT_OK;
}

static glint_settings small_frame(const trial *t, int depth)
{
    glint_settings settings = trial_settings(t);
    settings.width = 32;
    settings.height = 24;
    settings.depth = depth;
    return settings;
}

// Renders the scene beside the oracle, with balls of this subdivision level. The caller frees both,
// whatever the outcome.
static glint_status show(trial *t, int level, const glint_settings *settings, glint_scene *scene,
                         judged *frame)
{
    const glint_camera camera = shape_camera(eye, target, 0.8, 0);
    TRY(build_scene(t, level, scene));
    return judged_frame(t, scene, &camera, settings, frame);
}

// ---- Layers -------------------------------------------------------------------------------------

static const float *channel_of(const glint_layers *layers, const char *name)
{
    for (size_t i = 0; i < layers->count; i++) {
        if (strcmp(layers->channels[i].name, name) == 0) {
            return layers->channels[i].values;
        }
    }
    return NULL;
}

typedef struct layer_measures {
    glint_measure *triangles, *surfaces, *depths, *colors;
} layer_measures;

// Compares a pixel's layers with the first surface that the oracle sees.
static void measure_layers(const glint_scene *scene, const judged *frame, int p,
                           const layer_measures *of)
{
    static const char *const albedo[3] = {"albedo.R", "albedo.G", "albedo.B"};
    const glint_layers *layers = &frame->picture.layers;
    const int column = p % frame->picture.width, row = p / frame->picture.width;
    const double at[2] = {column + 0.5, row + 0.5};
    const oracle_ray ray = oracle_primary_ray(&frame->view, at);
    const oracle_hit hit = oracle_closest_hit(&frame->judge.scene, &ray, -1);
    double rgba[4], along = 0;
    oracle_report report;
    judged_pixel(frame, p, rgba, &report);
    for (int k = 0; k < 3; k++) {
        along -= ray.direction[k] * frame->view.back[k];
    }
    const double triangle = (double)channel_of(layers, "triangle.index")[p];
    measure_event(of->triangles, triangle != hit.triangle, "pixel (%d, %d): %g, not %d", column,
                  row, triangle, hit.triangle);
    measure_event(of->surfaces,
                  (double)channel_of(layers, "surfaces.count")[p] != (double)report.deepest,
                  "pixel (%d, %d): %g, not %d", column, row,
                  (double)channel_of(layers, "surfaces.count")[p], report.deepest);
    if (hit.triangle < 0) {
        return;
    }
    measure_value(of->depths, (double)channel_of(layers, "Z")[p], hit.distance * along, 1,
                  "pixel (%d, %d)", column, row);
    const glint_material *m = &scene->materials[scene->material_of[hit.triangle]];
    for (int k = 0; k < 3; k++) {
        measure_value(of->colors, (double)channel_of(layers, albedo[k])[p],
                      (double)m->base_color[k], 1, "pixel (%d, %d)", column, row);
    }
}

static glint_status layers(trial *t)
{
    const layer_measures of = {trial_share(t, "triangles", 0.005),
                               trial_share(t, "numbers of surfaces", 0.005),
                               trial_error(t, "depths", "metres", 1e-5),
                               trial_error(t, "colours of surfaces", "of white", 1e-6)};
    glint_scene scene = {0};
    judged frame = {0};
    glint_settings settings = small_frame(t, 3);
    settings.aovs = GLINT_AOV_ALL;
    glint_status status;
    TRY_OR(cleanup, status, show(t, 2, &settings, &scene, &frame));
    for (int p = 0; p < settings.width * settings.height; p++) {
        measure_layers(&scene, &frame, p, &of);
    }
cleanup:
    judged_end(&frame);
    glint_scene_free(&scene);
    return status;
}

// ---- Terms --------------------------------------------------------------------------------------

static glint_status terms(trial *t)
{
    glint_measure *m = trial_error(t, "sums beside the picture", "of white", 4e-4);
    glint_scene scene = {0};
    judged frame = {0};
    glint_settings settings = small_frame(t, 3);
    settings.terms = 8;
    glint_status status;
    TRY_OR(cleanup, status, show(t, 2, &settings, &scene, &frame));
    judged_compare_terms(&frame, m);
cleanup:
    judged_end(&frame);
    glint_scene_free(&scene);
    return status;
}

// ---- Truncation ---------------------------------------------------------------------------------

// Light cut off by depth and by weight is counted as the oracle counts it.
static glint_status counted_light(trial *t)
{
    glint_measure *m = trial_error(t, "light that is cut off", "of all", 2e-5);
    glint_scene scene = {0};
    judged frame = {0};
    glint_settings settings = small_frame(t, 2);
    settings.min_weight = 0.1;
    settings.truncation_squares = true;
    glint_status status;
    TRY_OR(cleanup, status, show(t, 2, &settings, &scene, &frame));
    double by_depth = 0, by_weight = 0, squares = 0;
    const int pixels = settings.width * settings.height;
    for (int p = 0; p < pixels; p++) {
        double rgba[4];
        oracle_report report;
        judged_pixel(&frame, p, rgba, &report);
        const double cut = report.truncated_by_depth + report.truncated_by_weight;
        by_depth += report.truncated_by_depth / pixels;
        by_weight += report.truncated_by_weight / pixels;
        squares += cut * cut / pixels;
    }
    const glint_truncation *counted = &frame.picture.report.truncation;
    measure_value(m, counted->by_depth, by_depth, 1, "by depth");
    measure_value(m, counted->by_min_weight, by_weight, 1, "by weight");
    measure_value(m, counted->rms, sqrt(squares), 1, "their root mean square");
cleanup:
    judged_end(&frame);
    glint_scene_free(&scene);
    return status;
}

// ---- Lists of pixels ----------------------------------------------------------------------------

// Every third pixel, listed backwards, equals the whole frame's pixel to the last bit.
static glint_status listed_pixels(trial *t)
{
    enum { ROWS = 16, COUNT = ROWS * GLINT_LIST_COLUMNS };
    glint_measure *m = trial_error(t, "beside the whole frame", "ulp", 0);
    uint32_t list[COUNT];
    glint_scene scene = {0};
    judged whole = {0}, some = {0};
    glint_settings settings = small_frame(t, 3);
    const uint32_t pixels = (uint32_t)(settings.width * settings.height);
    for (uint32_t i = 0; i < COUNT; i++) {
        list[i] = (pixels - 1 - 3 * i % pixels + pixels) % pixels;
    }
    const glint_camera camera = shape_camera(eye, target, 0.8, 0);
    glint_status status;
    TRY_OR(cleanup, status, build_scene(t, 2, &scene));
    TRY_OR(cleanup, status, judged_frame(t, &scene, &camera, &settings, &whole));
    settings.list = list;
    settings.list_rows = ROWS;
    TRY_OR(cleanup, status, judged_frame(t, &scene, &camera, &settings, &some));
    for (int i = 0; i < 4 * COUNT; i++) {
        const double wanted = whole.picture.values[4 * list[i / 4] + (uint32_t)(i % 4)];
        measure_error(m, fabs(trial_ulps(t, some.picture.values[i], wanted)), "place %d", i / 4);
    }
cleanup:
    judged_end(&whole);
    judged_end(&some);
    glint_scene_free(&scene);
    return status;
}

// ---- Shading at vertices ------------------------------------------------------------------------

static glint_status shade_at_vertices(trial *t, const glint_scene *scene, glint_shading shading,
                                      glint_measure *m)
{
    const glint_camera camera = shape_camera(eye, target, 0.8, 0);
    judged frame = {0};
    glint_settings settings = small_frame(t, 1);
    settings.shading = shading;
    const glint_status status = judged_frame(t, scene, &camera, &settings, &frame);
    if (status == GLINT_OK) {
        measure_error(m, judged_rmse(&frame), "over the picture");
    }
    judged_end(&frame);
    return status;
}

// Triangles are an eightieth across. Interpolation between their corners errs by its square. The
// pane has colours only at its four corners.
static glint_status shaded_vertices(trial *t)
{
    glint_measure *directions = trial_error(t, "directions at vertices", "relative RMSE", 0.002);
    glint_measure *colors = trial_error(t, "colours at vertices", "relative RMSE", 0.02);
    glint_scene scene = {0};
    glint_status status;
    TRY_OR(cleanup, status, build_scene(t, 5, &scene));
    TRY_OR(cleanup, status,
           shade_at_vertices(t, &scene, GLINT_SHADING_VERTEX_DIRECTION, directions));
    TRY_OR(cleanup, status, shade_at_vertices(t, &scene, GLINT_SHADING_VERTEX_COLOR, colors));
cleanup:
    glint_scene_free(&scene);
    return status;
}

// ---- Environments -------------------------------------------------------------------------------

// Coarser levels of E(d) = ½ + ½d are the same, except for an error of a texel's width.
static glint_status averaged_environment(trial *t)
{
    glint_measure *m = trial_error(t, "beside the oracle", "relative RMSE", 0.008);
    glint_scene scene = {0};
    judged frame = {0};
    glint_settings settings = small_frame(t, 3);
    settings.filter = GLINT_FILTER_MIP;
    glint_status status;
    TRY_OR(cleanup, status, show(t, 3, &settings, &scene, &frame));
    measure_error(m, judged_rmse(&frame), "over the picture");
cleanup:
    judged_end(&frame);
    glint_scene_free(&scene);
    return status;
}

// Compares the view from inside a proxy, directly and in a mirror. The mirror image of the eye is
// outside.
static glint_status see_proxy(trial *t, const glint_proxy *proxy, glint_measure *m)
{
    static const double within[3] = {0.3, 0.25, 2.1};
    static const double corners[4][3] = {
        {-0.5, -0.6, -0.3}, {0.4, -0.6, -0.3}, {0.4, 0.5, -0.3}, {-0.5, 0.5, -0.3}};
    glint_scene scene = {0};
    judged frame = {.proxy = proxy};
    glint_settings settings = small_frame(t, 2);
    settings.proxy = true;
    // Render a mirror inside the proxy.
    const glint_camera camera = shape_camera(within, target, 0.8, 0);
    glint_status status;
    shape s = shape_begin();
    shape_add_quad(&s, corners, MATERIAL_MIRROR);
    TRY_OR(cleanup, status, shape_end(&s, &scene, t->error));
    TRY_OR(cleanup, status, judged_frame(t, &scene, &camera, &settings, &frame));
    judged_compare(&frame, m);
cleanup:
    judged_end(&frame);
    glint_scene_free(&scene);
    return status;
}

static glint_status near_environment(trial *t)
{
    static const glint_proxy sphere = {GLINT_PROXY_SPHERE,
                                       {0.2, -0.4, 0.3},
                                       {0.1, 0.2, 0},
                                       {4, 4, 4}},
                             box = {GLINT_PROXY_BOX, {-0.3, 0.5, 1}, {0.2, 0, 0.1}, {3, 2, 4}};
    TRY(see_proxy(t, &sphere, trial_error(t, "on a sphere", "of white", 4e-4)));
    return see_proxy(t, &box, trial_error(t, "on a box", "of white", 4e-4));
}

const trial_case output_cases[] = {
    {"layers", "layers tell of each pixel's first surface what the oracle finds", layers},
    {"terms", "what pixels are the sum of adds up to the picture", terms},
    {"counted_light", "light that depth and least weight cut off, as the oracle counts it",
     counted_light},
    {"listed_pixels", "a list of pixels has the whole frame's bits", listed_pixels},
    {"shaded_vertices", "finely divided balls that are shaded at their vertices: the oracle's view",
     shaded_vertices},
    {"averaged_environment", "coarser levels of a smooth environment: the oracle's view",
     averaged_environment},
    {"near_environment", "an environment on a sphere and in a box: where rays leave them",
     near_environment},
    {0},
};
