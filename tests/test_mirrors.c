// Tests the short way of mirrors (mirrors.cl), for mirrors that see only the environment: against
// the oracle, against the kernel with all features, and at every width and size of tiles.
#include "base/random.h"
#include "support/bridge.h"
#include "support/by_corner.h"
#include "support/render.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define EDGE 256 // edge of the environment's cube

static void keep(glint_scene *scene)
{
    (void)scene;
}

static void drop_normals(glint_scene *scene)
{
    free(scene->normals);
    scene->normals = NULL;
}

// Removes the normal of every seventh corner, and all normals of some triangles.
static void drop_some_normals(glint_scene *scene)
{
    for (size_t i = 0; i < 3 * scene->triangle_count; i++) {
        if (i % 7 == 0 || i / 3 % 5 == 0) {
            memset(scene->normals + 3 * i, 0, 3 * sizeof *scene->normals);
        }
    }
}

static void turn_some_normals(glint_scene *scene)
{
    for (size_t i = 0; i < 9 * scene->triangle_count; i++) {
        scene->normals[i] = i / 9 % 2 == 0 ? scene->normals[i] : -scene->normals[i];
    }
}

// Bends normals by at most 53 degrees, so that many rays would go behind the surface. No
// interpolated normal is shorter than 0.6.
static void roughen(glint_scene *scene)
{
    glint_random random = {1};
    for (size_t i = 0; i < 3 * scene->triangle_count; i++) {
        float *n = scene->normals + 3 * i;
        const glint_vec3 a = glint_random_direction(&random);
        const double x = n[0] + 0.8 * a.x, y = n[1] + 0.8 * a.y, z = n[2] + 0.8 * a.z;
        const double length = sqrt(x * x + y * y + z * z);
        n[0] = (float)(x / length);
        n[1] = (float)(y / length);
        n[2] = (float)(z / length);
    }
}

static void set_color(glint_scene *scene, size_t material, float r, float g, float b)
{
    const float color[3] = {r, g, b};
    memcpy(scene->materials[material].base_color, color, sizeof color);
}

static void whiten(glint_scene *scene)
{
    set_color(scene, 0, 1, 1, 1);
}

static void whiten_and_roughen(glint_scene *scene)
{
    whiten(scene);
    roughen(scene);
}

// Makes half of the triangles white, as a separate instance.
static void divide(glint_scene *scene)
{
    assert_int_equal(scene->material_count, 1);
    assert_int_equal(scene->instance_count, 1);
    scene->materials = realloc(scene->materials, 2 * sizeof *scene->materials);
    scene->instances = realloc(scene->instances, 2 * sizeof *scene->instances);
    assert_non_null(scene->materials);
    assert_non_null(scene->instances);
    scene->material_count = scene->instance_count = 2;
    scene->materials[1] = scene->materials[0];
    scene->materials[1].name = NULL;
    set_color(scene, 1, 1, 1, 1);
    const size_t first = scene->triangle_count / 2;
    scene->instances[0].triangle_count = first;
    scene->instances[1] = (glint_instance){
        .first_triangle = first, .triangle_count = scene->triangle_count - first, .material = 1};
    for (size_t i = first; i < scene->triangle_count; i++) {
        scene->material_of[i] = 1;
    }
}

static void see_in_parallel(glint_scene *scene)
{
    scene->cameras[0].orthographic = true;
    scene->cameras[0].ymag = 1.2;
}

#define FAR 100.0
static void see_from_afar(glint_scene *scene)
{
    scene->cameras[0].eye.z *= FAR;
    scene->cameras[0].yfov /= FAR;
}

// Error of a direction in single precision. It is a few dozen roundings, plus the error of a
// triangle's weights times the angle between its normals. The weights err by the pixel's distance
// to the middle of the image (45 pixels and four roundings) over the visible thickness of the
// triangle. At the rim of the sphere this thickness is a tenth of a pixel: 1800 roundings. The
// angle between the sphere's own normals is less than 0.1.
#define ROUNDING 0x1p-24
#define SMOOTH_ERROR (200 * ROUNDING)
#define ROUGH_ERROR (2000 * ROUNDING)
// In double precision the host passes sums of two floats, which are right to 2⁻⁴⁸.
#define DOUBLE_ERROR (300 * 0x1p-48)

typedef struct mirror_case {
    const char *name;
    void (*change)(glint_scene *scene);
    double error;
} mirror_case;

enum {
    SILVER,
    WHITE,
    FACETS,
    SOME_NORMALS,
    TURNED_NORMALS,
    TWO_METALS,
    PARALLEL,
    AFAR,
    ROUGH_WHITE,
    ROUGH_SILVER,
    CASES
};

static const mirror_case cases[CASES] = {
    [SILVER] = {"silver", keep, SMOOTH_ERROR},
    [WHITE] = {"white", whiten, SMOOTH_ERROR},
    [FACETS] = {"facets", drop_normals, SMOOTH_ERROR},
    [SOME_NORMALS] = {"some corners without normals", drop_some_normals, SMOOTH_ERROR},
    [TURNED_NORMALS] = {"normals turned inwards", turn_some_normals, SMOOTH_ERROR},
    [TWO_METALS] = {"two metals", divide, SMOOTH_ERROR},
    [PARALLEL] = {"seen in parallel", see_in_parallel, SMOOTH_ERROR},
    [AFAR] = {"seen from afar", see_from_afar, SMOOTH_ERROR},
    [ROUGH_WHITE] = {"rough white", whiten_and_roughen, ROUGH_ERROR},
    [ROUGH_SILVER] = {"rough silver", roughen, ROUGH_ERROR},
};

static glint_settings small_frame(void)
{
    glint_settings settings = glint_settings_default;
    // Not multiples of the packet, so that packets hang over both edges.
    settings.width = 91;
    settings.height = 70;
    settings.depth = 1;
    settings.texels = GLINT_TEXELS_FLOAT; // the oracle's texels
    return settings;
}

static void load_case(const mirror_case *c, glint_scene *scene, glint_environment *environment)
{
    *scene = (glint_scene){0};
    test_scene_load("mirror_sphere", scene);
    scene_by_corner(scene);
    assert_non_null(scene->normals);
    c->change(scene);
    bridge_direction_environment(EDGE, environment);
}

static void free_case(glint_scene *scene, glint_environment *environment)
{
    glint_environment_free(environment);
    glint_scene_free(scene);
}

// The environment is 0.5 + 0.5 d, so a radiance errs by half as much as the direction. No direction
// ties between two faces of the cube, where interpolations differ.
static void compare_with_oracle(const mirror_case *c, const glint_settings *settings,
                                double tolerance)
{
    glint_scene scene;
    glint_environment environment;
    load_case(c, &scene, &environment);
    test_frame frame;
    test_render(&scene, &environment, NULL, settings, &frame);
    bridge *b = bridge_create(&scene, &environment);
    glint_camera camera;
    assert_int_equal(glint_scene_camera(&scene, NULL, &camera, NULL), GLINT_OK);
    const oracle_view view = bridge_view(&camera, settings);
    const int pixels = settings->width * settings->height;
    double largest = 0;
    int near_edges = 0;
    const bool is_far = c == &cases[AFAR];
    const double margin = is_far ? 1e-6 / FAR : 1e-6; // as an angle
    for (int i = 0; i < pixels; i++) {
        const int pixel[2] = {i % settings->width, i / settings->width};
        double rgba[4];
        oracle_report report;
        oracle_pixel(bridge_scene(b), &view, pixel, rgba, &report);
        if (report.edge < margin) {
            near_edges++;
            continue;
        }
        for (int k = 0; k < 4; k++) {
            const double difference = fabs(frame.exact[4 * i + k] - rgba[k]);
            assert_true(difference <= tolerance); // NaN is not
            largest = fmax(largest, difference);
        }
    }
    print_message("%-30s %s: off by %.2g at most, %d pixels at edges\n", c->name,
                  settings->precision == GLINT_PRECISION_DOUBLE ? "double" : "float", largest,
                  near_edges);
    assert_true(near_edges < pixels / (is_far ? 20 : 200));
    assert_true(frame.report.rays.reflected > (uint64_t)pixels / 10);
    bridge_free(b);
    test_frame_free(&frame);
    free_case(&scene, &environment);
}

static void mirrors_agree_with_the_oracle(void **state)
{
    (void)state;
    for (size_t i = 0; i < CASES; i++) {
        glint_settings settings = small_frame();
        compare_with_oracle(&cases[i], &settings, cases[i].error);
        settings.precision = GLINT_PRECISION_DOUBLE;
        compare_with_oracle(&cases[i], &settings, DOUBLE_ERROR);
    }
    // Coloured metal without Fresnel's equations has the same weight at every angle.
    glint_settings settings = small_frame();
    settings.fresnel = GLINT_FRESNEL_NONE;
    compare_with_oracle(&cases[ROUGH_SILVER], &settings, ROUGH_ERROR);
}

// With everything compiled, mirrors take the general way. (Each combination of features compiles a
// kernel, so the test has few cases.)
static void mirrors_agree_with_paths(void **state)
{
    (void)state;
    static const size_t few[] = {SILVER, FACETS, SOME_NORMALS, TWO_METALS, ROUGH_SILVER};
    for (size_t n = 0; n < sizeof few / sizeof *few; n++) {
        const size_t i = few[n];
        glint_scene scene;
        glint_environment environment;
        load_case(&cases[i], &scene, &environment);
        glint_settings settings = small_frame();
        settings.samples_per_axis = 2;
        settings.env_rotate = 30;
        test_frame mirrors, paths;
        test_render(&scene, &environment, NULL, &settings, &mirrors);
        settings.all_features = true;
        test_render(&scene, &environment, NULL, &settings, &paths);
        assert_true(paths.plan.features[GLINT_FEATURE_GLASS].compiled);
        assert_false(mirrors.plan.features[GLINT_FEATURE_GLASS].compiled);
        for (size_t p = 0; p < 4 * (size_t)(settings.width * settings.height); p++) {
            assert_true(fabs(mirrors.exact[p] - paths.exact[p]) <= cases[i].error);
        }
        // The two ways round differently, so some pixels must differ.
        assert_true(test_count_different(&mirrors.image, &paths.image) > 0);
        assert_memory_equal(&mirrors.report.rays, &paths.report.rays, sizeof paths.report.rays);
        assert_int_equal(mirrors.report.deepest, paths.report.deepest);
        // Sums of rounded weights: 4 samples of each pixel.
        const double weight = paths.report.truncation.by_depth;
        assert_true(fabs(mirrors.report.truncation.by_depth - weight) <= 1e-6 * weight);
        assert_true(weight > 0);
        test_frame_free(&mirrors);
        test_frame_free(&paths);
        free_case(&scene, &environment);
    }
}

// Two metals with all features of the short way, and facets in double precision.
static void mirrors_are_the_same_at_every_width_and_size_of_tiles(void **state)
{
    (void)state;
    static const int forms[][2] = {{8, 16}, {16, 16}, {16, 1}, {1, 16}};
    for (int precise = 0; precise < 2; precise++) {
        glint_scene scene;
        glint_environment environment;
        load_case(&cases[precise ? FACETS : TWO_METALS], &scene, &environment);
        glint_settings settings = small_frame();
        settings.samples_per_axis = precise ? 1 : 2;
        settings.env_rotate = precise ? 0 : 30;
        settings.texels = precise ? GLINT_TEXELS_FLOAT : GLINT_TEXELS_HALF;
        settings.precision = precise ? GLINT_PRECISION_DOUBLE : GLINT_PRECISION_FLOAT;
        settings.kernel_width = 1;
        settings.tile_packets = 1;
        test_frame one, more;
        test_render(&scene, &environment, NULL, &settings, &one);
        for (size_t w = 0; w < (precise ? 2 : 4); w++) {
            settings.kernel_width = forms[w][0];
            settings.tile_packets = forms[w][1];
            test_render(&scene, &environment, NULL, &settings, &more);
            assert_int_equal(test_count_different(&one.image, &more.image), 0);
            assert_memory_equal(&one.report.rays, &more.report.rays, sizeof one.report.rays);
            test_frame_free(&more);
        }
        test_frame_free(&one);
        free_case(&scene, &environment);
    }
}

// Black metal sends no ray on, and is black in front of any background.
static void black_metal_reflects_nothing(void **state)
{
    (void)state;
    glint_scene scene;
    glint_environment environment;
    load_case(&cases[SILVER], &scene, &environment);
    set_color(&scene, 0, 0, 0, 0);
    glint_settings settings = small_frame();
    settings.fresnel = GLINT_FRESNEL_NONE;
    test_frame frame;
    test_render(&scene, &environment, NULL, &settings, &frame);
    assert_int_equal(frame.report.rays.reflected, 0);
    assert_int_equal(frame.report.deepest, 1);
    assert_true(frame.report.truncation.by_depth == 0);
    const int middle = settings.height / 2 * settings.width + settings.width / 2;
    const double black[4] = {0, 0, 0, 1};
    assert_memory_equal(frame.exact + 4 * (size_t)middle, black, sizeof black);
    test_frame_free(&frame);
    free_case(&scene, &environment);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mirrors_agree_with_the_oracle),
        cmocka_unit_test(mirrors_agree_with_paths),
        cmocka_unit_test(black_metal_reflects_nothing),
        cmocka_unit_test(mirrors_are_the_same_at_every_width_and_size_of_tiles),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
