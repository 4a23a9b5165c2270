// Compares the device's frames with the oracle's. See judged.h.
#include "support/judged.h"

#include "environment/irradiance.h"
#include "support/bridge.h"
#include "support/render.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

glint_settings judged_frame(int width, int height, int depth)
{
    glint_settings settings = glint_settings_default;
    settings.width = width;
    settings.height = height;
    settings.depth = depth;
    settings.texels = GLINT_TEXELS_FLOAT;
    settings.roughness = GLINT_ROUGHNESS_EXACT;
    settings.facets = 1024;
    return settings;
}

// Relative RMSE. Skips pixels nearer than `edge` to the edge of a triangle. At least `fewest`
// values must be left.
static double error_of(const oracle_scene *scene, const oracle_view *view, double edge,
                       const test_frame *frame, size_t fewest)
{
    double squares = 0, light = 0;
    size_t count = 0;
    for (int i = 0; i < view->width * view->height; i++) {
        double rgba[4];
        oracle_report report;
        oracle_pixel(scene, view, (const int[]){i % view->width, i / view->width}, rgba, &report);
        if (report.surfaces == 0 || report.edge < edge) {
            continue;
        }
        for (int k = 0; k < 3; k++) {
            const double off = frame->exact[4 * i + k] - rgba[k];
            assert_true(isfinite(frame->exact[4 * i + k]));
            squares += off * off;
            light += rgba[k];
            count++;
        }
    }
    assert_true(count > fewest);
    return sqrt(squares * (double)count) / light;
}

static void set_materials(const judged *j, glint_scene *scene)
{
    for (size_t i = 0; i < scene->material_count; i++) {
        glint_material *m = &scene->materials[i];
        if (j->roughness >= 0 && glint_material_lobes(m).glass == (j->strata > 0)) {
            m->roughness = j->roughness;
        } else if (j->strata > 0) {
            m->roughness = 0;
        }
        if (j->alpha < 1 && glint_material_lobes(m).thin) {
            m->alpha_mode = GLINT_ALPHA_BLEND;
            m->alpha = j->alpha;
        }
        m->metallic = j->metallic < 0 ? m->metallic : j->metallic;
        if (j->change != NULL) {
            j->change(j->kind, m);
        }
    }
}

// Gives the oracle the renderer's map of irradiance.
static void use_irradiance(bridge *b, const glint_environment *environment, glint_cube *irradiance)
{
    assert_int_equal(
        glint_irradiance_map(&environment->radiance, GLINT_IRRADIANCE_EDGE, irradiance, NULL),
        GLINT_OK);
    bridge_use_irradiance_map(b, irradiance);
}

double judge(const judged *j)
{
    glint_scene scene = {0};
    test_scene_load(j->scene, &scene);
    set_materials(j, &scene);
    test_frame frame;
    test_render(&scene, j->environment, NULL, &j->settings, &frame);
    assert_true(frame.plan.features[j->feature].compiled);
    bridge *b = bridge_create(&scene, j->environment);
    glint_cube irradiance = {0};
    use_irradiance(b, j->environment, &irradiance);
    glint_camera camera;
    assert_int_equal(glint_scene_camera(&scene, NULL, &camera, NULL), GLINT_OK);
    oracle_view view = bridge_view(&camera, &j->settings);
    if (j->strata > 0) {
        view.roughness = j->strata;
        view.edges = false; // in every pixel the path of some facet passes near an edge
    }
    oracle_scene turned = *bridge_scene(b);
    turned.environment_rotation = j->settings.env_rotate;
    const double edge = j->settings.precision == GLINT_PRECISION_DOUBLE ? 1e-9 : 1e-4;
    const double error =
        error_of(&turned, &view, edge, &frame, (size_t)(view.width * view.height * 3 / 8));
    bridge_free(b);
    glint_cube_free(&irradiance);
    test_frame_free(&frame);
    glint_scene_free(&scene);
    return error;
}

double judged_overlaps(const glint_scene *scene, const glint_environment *environment,
                       const glint_settings *settings, const test_frame *frame)
{
    bridge *b = bridge_create(scene, environment);
    glint_cube irradiance = {0};
    use_irradiance(b, environment, &irradiance);
    glint_camera camera;
    assert_int_equal(glint_scene_camera(scene, NULL, &camera, NULL), GLINT_OK);
    const oracle_view view = bridge_view(&camera, settings);
    oracle_scene overlapping = *bridge_scene(b);
    overlapping.overlaps = true;
    const double error = error_of(&overlapping, &view, 1e-4, frame, 100);
    bridge_free(b);
    glint_cube_free(&irradiance);
    return error;
}
