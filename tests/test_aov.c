// Tests layers against the oracle and against the frame's own counters. Layers must be the same at
// every width and size of tiles, and must not change the picture.
#include "support/bridge.h"
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

static glint_settings frame_of_layers(int depth)
{
    glint_settings settings = test_small_frame(depth);
    settings.aovs = GLINT_AOV_ALL;
    return settings;
}

static size_t pixel_count(const glint_settings *settings)
{
    return (size_t)settings->width * (size_t)settings->height;
}

// First channel of a layer, in a frame with all layers. The other channels follow it.
static const float *layer(const test_frame *frame, glint_aov aov)
{
    assert_int_equal(frame->layers.count, glint_layers_channels(GLINT_AOV_ALL));
    return frame->layers.channels[glint_layers_channels(GLINT_AOV_BIT(aov) - 1)].values;
}

static void assert_same_layers(const test_frame *a, const test_frame *b, size_t pixels)
{
    assert_int_equal(a->layers.count, b->layers.count);
    for (size_t i = 0; i < a->layers.count; i++) {
        assert_string_equal(a->layers.channels[i].name, b->layers.channels[i].name);
        assert_memory_equal(a->layers.channels[i].values, b->layers.channels[i].values,
                            pixels * sizeof(float));
    }
}

// ---- Against the oracle -------------------------------------------------------------------------

// As in test_agreement.c: within this margin single precision may decide otherwise.
#define FLOAT_MARGIN 1e-4

// Errors of the first surface's layers in single precision. The weights of a triangle are right to
// a few roundings of its extent in the picture. Normals inherit this error.
#define Z_ERROR 2e-6 // relative
#define NORMAL_ERROR 2e-5

typedef struct comparison {
    const glint_scene *scene;
    const bridge *bridge;
    const oracle_view *view;
    const test_frame *frame;
    size_t different, unexplained;
    double z_error, normal_error; // largest errors where the triangles agree
} comparison;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void turn_to(const double direction[3], double n[3])
{
    const double sign = dot(n, direction) < 0 ? -1 : 1;
    for (int k = 0; k < 3; k++) {
        n[k] *= sign;
    }
}

// Tests for a unit vector. False for a zero vector.
static bool unit(double n[3])
{
    const double length = sqrt(dot(n, n));
    for (int k = 0; k < 3 && length > 0; k++) {
        n[k] /= length;
    }
    return length > 0;
}

// The normal of rule 1 of "Light transport".
static void shading_normal(const oracle_triangle *t, const oracle_hit *hit, const oracle_ray *ray,
                           double n[3])
{
    double geometric[3], a[3], b[3];
    const double viewer[3] = {-ray->direction[0], -ray->direction[1], -ray->direction[2]};
    bool is_smooth = true;
    for (int k = 0; k < 3; k++) {
        a[k] = t->position[1][k] - t->position[0][k];
        b[k] = t->position[2][k] - t->position[0][k];
        n[k] = 0;
        for (int v = 0; v < 3; v++) {
            n[k] += hit->barycentric[v] * t->normal[v][k];
        }
        is_smooth = is_smooth && dot(t->normal[k], t->normal[k]) > 0;
    }
    for (int k = 0; k < 3; k++) {
        geometric[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
    assert_true(unit(geometric));
    turn_to(viewer, geometric);
    if (!is_smooth || !unit(n)) {
        memcpy(n, geometric, sizeof geometric);
    }
    turn_to(geometric, n);
    turn_to(viewer, n);
}

// Compares the oracle's first surface with the layers of pixel `at`.
static bool surfaces_agree(comparison *c, size_t at, const oracle_ray *ray, const oracle_hit *hit)
{
    const oracle_scene *scene = bridge_scene(c->bridge);
    const size_t pixels = (size_t)c->view->width * (size_t)c->view->height;
    const float *normals = layer(c->frame, GLINT_AOV_NORMAL) + at;
    const float *albedo = layer(c->frame, GLINT_AOV_ALBEDO) + at;
    const double z = (double)layer(c->frame, GLINT_AOV_Z)[at];
    double n[3] = {0}, along = INFINITY;
    const double none[3] = {0}, *base = none;
    if (hit->triangle >= 0) {
        const oracle_triangle *t = &scene->triangles[hit->triangle];
        shading_normal(t, hit, ray, n);
        base = scene->materials[t->material].base;
        along = 0;
        for (int k = 0; k < 3; k++) {
            const double place = ray->origin[k] + hit->distance * ray->direction[k];
            along -= (place - c->view->eye[k]) * c->view->back[k];
        }
    }
    bool agree = isinf(along) ? z == along : fabs(z - along) <= Z_ERROR * along;
    c->z_error = isinf(along) || isinf(z) ? c->z_error : fmax(c->z_error, fabs(z - along) / along);
    for (size_t k = 0; k < 3; k++) {
        const double error = fabs((double)normals[k * pixels] - n[k]);
        agree = agree && error <= NORMAL_ERROR && albedo[k * pixels] == (float)base[k];
        c->normal_error = agree ? fmax(c->normal_error, error) : c->normal_error;
    }
    return agree;
}

// Compares the names of the triangle's node and material with the file.
static bool names_agree(const comparison *c, size_t at, int triangle)
{
    int object = -1, material = -1;
    for (size_t i = 0; i < c->scene->instance_count; i++) {
        const glint_instance *instance = &c->scene->instances[i];
        if (triangle >= 0 && (size_t)triangle >= instance->first_triangle &&
            (size_t)triangle < instance->first_triangle + instance->triangle_count) {
            object = instance->node_index;
            material = c->scene->materials[instance->material].index;
        }
    }
    return layer(c->frame, GLINT_AOV_TRIANGLE)[at] == (float)triangle &&
           layer(c->frame, GLINT_AOV_OBJECT)[at] == (float)object &&
           layer(c->frame, GLINT_AOV_MATERIAL)[at] == (float)material;
}

// Compares a pixel's layers with the oracle. Weights err like the paths, by some hundreds of
// roundings.
static bool layers_agree(comparison *c, const int pixel[2], const oracle_report *report)
{
    const size_t at = (size_t)pixel[1] * (size_t)c->view->width + (size_t)pixel[0];
    const int k = c->view->samples, middle = k / 2;
    const double position[2] = {pixel[0] + (middle + 0.5) / k, pixel[1] + (middle + 0.5) / k};
    const oracle_ray ray = oracle_primary_ray(c->view, position);
    const oracle_hit hit = oracle_closest_hit(bridge_scene(c->bridge), &ray, -1);
    const double truncated = report->truncated_by_depth + report->truncated_by_weight;
    const test_frame *f = c->frame;
    return layer(f, GLINT_AOV_SURFACES)[at] == (float)report->deepest &&
           layer(f, GLINT_AOV_TIR)[at] == (float)((double)report->total_reflections / (k * k)) &&
           fabs((double)layer(f, GLINT_AOV_TRUNCATED)[at] - truncated) <= 1e-4 &&
           names_agree(c, at, hit.triangle) && surfaces_agree(c, at, &ray, &hit);
}

static void compare_pixel(comparison *c, const int pixel[2])
{
    double rgba[4];
    oracle_report report;
    oracle_pixel(bridge_scene(c->bridge), c->view, pixel, rgba, &report);
    if (!layers_agree(c, pixel, &report)) {
        c->different++;
        c->unexplained += report.edge >= FLOAT_MARGIN && report.critical >= FLOAT_MARGIN &&
                          report.threshold >= FLOAT_MARGIN;
    }
}

static void compare_scene(const char *name, const glint_settings *settings)
{
    glint_scene scene = {0};
    test_scene_load(name, &scene);
    glint_environment environment;
    bridge_direction_environment(16, &environment);
    test_frame frame;
    test_render(&scene, &environment, NULL, settings, &frame);
    bridge *b = bridge_create(&scene, &environment);
    glint_camera camera;
    assert_int_equal(glint_scene_camera(&scene, NULL, &camera, NULL), GLINT_OK);
    const oracle_view view = bridge_view(&camera, settings);
    comparison c = {.scene = &scene, .bridge = b, .view = &view, .frame = &frame};
    for (int i = 0; i < settings->width * settings->height; i++) {
        compare_pixel(&c, (const int[]){i % settings->width, i / settings->width});
    }
    print_message("%-20s %zu of %zu pixels have other layers than the oracle's; Z errs by %.2g, "
                  "normals by %.2g\n",
                  name, c.different, pixel_count(settings), c.z_error, c.normal_error);
    assert_int_equal(c.unexplained, 0);
    assert_true(c.different <= pixel_count(settings) / 50);
    bridge_free(b);
    test_frame_free(&frame);
    glint_environment_free(&environment);
    glint_scene_free(&scene);
}

static void layers_agree_with_the_oracle(void **state)
{
    (void)state;
    static const char *const names[] = {"nested_glass", "gallery", "facing_mirrors",
                                        "glass_sphere", "prism",   "orthographic"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        glint_settings settings = frame_of_layers(8);
        settings.samples_per_axis = i == 4 ? 2 : 1;
        settings.roughness = i % 2 == 0 ? GLINT_ROUGHNESS_SMOOTH : GLINT_ROUGHNESS_FAST;
        compare_scene(names[i], &settings);
    }
}

// ---- Faces --------------------------------------------------------------------------------------

// Makes an environment with faces first, first + 1 and first + 2 in red, green and blue. The other
// faces are black.
static void face_environment(int first, glint_environment *environment)
{
    const int edge = 64;
    *environment = (glint_environment){0};
    assert_int_equal(glint_cube_create(edge, &environment->radiance, NULL), GLINT_OK);
    for (int i = 0; i < 3 * edge * edge; i++) {
        const int channel = i / edge / edge;
        float *texel =
            glint_cube_texel(&environment->radiance, first + channel, i % edge, i / edge % edge);
        texel[channel] = 1;
    }
    glint_cube_fill_border(&environment->radiance);
}

// Finds the face that sends the most light to a pixel, and its lead over the second face.
static int brightest_face(const double first[4], const double last[4], double *lead)
{
    const double shares[] = {first[0], first[1], first[2], last[0], last[1], last[2]};
    int best = 0;
    double second = 0;
    for (int face = 1; face < 6; face++) {
        second = fmax(second, fmin(shares[face], shares[best]));
        best = shares[face] > shares[best] ? face : best;
    }
    *lead = shares[best] - second;
    return best;
}

// Checks the face layer. The weights of two look-ups add up to at most 1. Where the face of the
// heavier look-up leads, it must be the layer's face. At a seam another face has as large a part in
// the look-up. The lighter look-up, of at most ½, may add to that part.
static void check_faces(const char *name, const glint_settings *settings, bool seen[6])
{
    glint_scene scene = {0};
    test_scene_load(name, &scene);
    test_frame frames[2];
    for (int i = 0; i < 2; i++) {
        glint_environment environment;
        face_environment(3 * i, &environment);
        test_render(&scene, &environment, NULL, settings, &frames[i]);
        glint_environment_free(&environment);
    }
    size_t judged = 0;
    for (size_t p = 0; p < pixel_count(settings); p++) {
        const int face = (int)layer(&frames[0], GLINT_AOV_FACE)[p];
        assert_true(layer(&frames[1], GLINT_AOV_FACE)[p] == (float)face);
        if (settings->transparent && layer(&frames[0], GLINT_AOV_TRIANGLE)[p] < 0) {
            assert_int_equal(face, -1);
            continue;
        }
        assert_in_range(face, 0, 5);
        seen[face] = true;
        double lead;
        const int wanted = brightest_face(frames[0].exact + 4 * p, frames[1].exact + 4 * p, &lead);
        if (lead > 0.5) {
            judged++;
            assert_int_equal(face, wanted);
        }
    }
    assert_true(judged > pixel_count(settings) / 4);
    test_frame_free(&frames[0]);
    test_frame_free(&frames[1]);
    glint_scene_free(&scene);
}

static void the_face_is_that_of_the_heaviest_look_up(void **state)
{
    (void)state;
    glint_settings settings = frame_of_layers(1);
    bool seen[6] = {false};
    check_faces("mirror_sphere", &settings, seen);
    for (int face = 0; face < 6; face++) {
        assert_true(seen[face]);
    }
    check_faces("glass_sphere", &settings, seen);
    settings.env_rotate = 30;
    settings.transparent = true;
    check_faces("glass_sphere", &settings, seen);
}

// ---- Against the frame itself -------------------------------------------------------------------

// Sums of up to a few hundred rounded weights for each pixel.
static void layers_add_up_to_what_the_frame_reports(void **state)
{
    (void)state;
    static const char *const names[] = {"nested_glass", "facing_mirrors", "prism"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        glint_settings settings = frame_of_layers(i == 1 ? 2 : 0);
        settings.samples_per_axis = i == 2 ? 1 : 3;
        settings.min_weight = 0.01;
        settings.precision = i == 2 ? GLINT_PRECISION_DOUBLE : GLINT_PRECISION_FLOAT;
        test_frame frame;
        test_render_named(names[i], &settings, &frame);
        double truncated = 0, total_reflections = 0, deepest = 0;
        const int samples = settings.samples_per_axis * settings.samples_per_axis;
        for (size_t p = 0; p < pixel_count(&settings); p++) {
            truncated += (double)layer(&frame, GLINT_AOV_TRUNCATED)[p];
            total_reflections += round((double)layer(&frame, GLINT_AOV_TIR)[p] * (double)samples);
            deepest = fmax(deepest, (double)layer(&frame, GLINT_AOV_SURFACES)[p]);
        }
        const glint_truncation *t = &frame.report.truncation;
        const double reported = t->by_depth + t->by_min_weight + t->by_stack;
        assert_true(reported > 0);
        assert_true(fabs(truncated / (double)pixel_count(&settings) - reported) <= 1e-5 * reported);
        assert_true((uint64_t)total_reflections == frame.report.rays.total_reflections);
        assert_true((uint32_t)deepest == frame.report.deepest);
        test_frame_free(&frame);
    }
}

// Covers paths that split, paths that gather, and the short way of mirrors.
static void every_width_and_tile_write_the_same_layers_and_leave_the_picture_alone(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        int depth;
    } frames[] = {{"nested_glass", 0}, {"lecture_example_2", 3}, {"mirror_sphere", 1}};
    static const int forms[][2] = {{8, 16}, {16, 16}, {16, 1}, {1, 16}};
    for (size_t i = 0; i < sizeof frames / sizeof *frames; i++) {
        glint_settings settings = frame_of_layers(frames[i].depth);
        settings.samples_per_axis = 2;
        settings.kernel_width = settings.tile_packets = 1;
        settings.aovs = 0;
        test_frame plain, one, more;
        test_render_named(frames[i].name, &settings, &plain);
        assert_int_equal(plain.layers.count, 0);
        settings.aovs = GLINT_AOV_ALL;
        test_render_named(frames[i].name, &settings, &one);
        assert_int_equal(test_count_different(&plain.image, &one.image), 0);
        assert_memory_equal(&plain.report.rays, &one.report.rays, sizeof one.report.rays);
        for (size_t w = 0; w < (i == 0 ? 4 : 2); w++) {
            settings.kernel_width = forms[w][0];
            settings.tile_packets = forms[w][1];
            test_render_named(frames[i].name, &settings, &more);
            assert_int_equal(test_count_different(&plain.image, &more.image), 0);
            assert_same_layers(&one, &more, pixel_count(&settings));
            test_frame_free(&more);
        }
        test_frame_free(&plain);
        test_frame_free(&one);
    }
}

// With everything compiled, mirrors at depth 1 take the general way. Weights are rounded
// differently there, and look-ups within rounding of a seam may fall on another face.
static void the_short_way_of_mirrors_writes_the_same_layers(void **state)
{
    (void)state;
    glint_settings settings = frame_of_layers(1);
    settings.env_rotate = 30; // otherwise the sphere's diagonals are seams, where rounding decides
    test_frame mirrors, paths;
    test_render_named("mirror_sphere", &settings, &mirrors);
    settings.all_features = true;
    test_render_named("mirror_sphere", &settings, &paths);
    size_t other_faces = 0;
    for (size_t i = 0; i < mirrors.layers.count; i++) {
        const glint_channel *a = &mirrors.layers.channels[i], *b = &paths.layers.channels[i];
        const bool is_face = strcmp(a->name, "face.index") == 0;
        for (size_t p = 0; p < pixel_count(&settings); p++) {
            const bool differ = a->values[p] != b->values[p]; // skip two infinite values
            other_faces += is_face && differ;
            assert_true(is_face || !differ || fabs((double)(a->values[p] - b->values[p])) <= 1e-6);
        }
    }
    assert_true(other_faces <= 2);
    test_frame_free(&mirrors);
    test_frame_free(&paths);
}

// The middle one of 3 × 3 samples goes through the pixel's centre, like a single sample.
static void what_a_pixel_shows_is_its_middle_samples(void **state)
{
    (void)state;
    glint_settings settings = frame_of_layers(4);
    test_frame one, nine;
    test_render_named("nested_glass", &settings, &one);
    settings.samples_per_axis = 3;
    test_render_named("nested_glass", &settings, &nine);
    for (size_t i = glint_layers_channels(GLINT_AOV_BIT(GLINT_AOV_TRIANGLE) - 1);
         i < one.layers.count; i++) {
        assert_memory_equal(one.layers.channels[i].values, nine.layers.channels[i].values,
                            pixel_count(&settings) * sizeof(float));
    }
    for (size_t p = 0; p < pixel_count(&settings); p++) {
        assert_true(layer(&nine, GLINT_AOV_SURFACES)[p] >= layer(&one, GLINT_AOV_SURFACES)[p]);
    }
    test_frame_free(&one);
    test_frame_free(&nine);
}

// Cones blur the look-ups over seams. They change neither the paths nor the places of the look-ups.
static void layers_do_not_depend_on_the_filter(void **state)
{
    (void)state;
    glint_settings settings = frame_of_layers(4);
    test_frame bilinear, cones;
    test_render_named("glass_sphere", &settings, &bilinear);
    settings.filter = GLINT_FILTER_MIP;
    test_render_named("glass_sphere", &settings, &cones);
    assert_true(test_count_different(&bilinear.image, &cones.image) > 0);
    assert_same_layers(&bilinear, &cones, pixel_count(&settings));
    test_frame_free(&bilinear);
    test_frame_free(&cones);
}

// A frame without geometry shows only the background.
static void an_empty_scene_has_faces_and_nothing_else(void **state)
{
    (void)state;
    glint_scene scene = {0};
    glint_environment environment;
    bridge_direction_environment(16, &environment);
    const glint_settings settings = frame_of_layers(0);
    test_frame frame;
    test_render(&scene, &environment, NULL, &settings, &frame);
    for (size_t p = 0; p < pixel_count(&settings); p++) {
        assert_true(layer(&frame, GLINT_AOV_SURFACES)[p] == 0);
        assert_true(layer(&frame, GLINT_AOV_TIR)[p] == 0);
        assert_true(layer(&frame, GLINT_AOV_TRUNCATED)[p] == 0);
        assert_true(layer(&frame, GLINT_AOV_TRIANGLE)[p] == -1);
        assert_true(layer(&frame, GLINT_AOV_MATERIAL)[p] == -1);
        assert_true(layer(&frame, GLINT_AOV_OBJECT)[p] == -1);
        assert_true(layer(&frame, GLINT_AOV_Z)[p] == INFINITY);
        for (size_t k = 0; k < 3; k++) {
            assert_true(layer(&frame, GLINT_AOV_NORMAL)[k * pixel_count(&settings) + p] == 0);
            assert_true(layer(&frame, GLINT_AOV_ALBEDO)[k * pixel_count(&settings) + p] == 0);
        }
        assert_true(layer(&frame, GLINT_AOV_FACE)[p] == 5); // the default camera looks along −Z
    }
    test_frame_free(&frame);
    glint_environment_free(&environment);
}

// ---- Scales -------------------------------------------------------------------------------------

static void scale(glint_vec3 *v, double by)
{
    *v = glint_vec3_scale(*v, by);
}

// Z is in metres, whatever the scene's unit. If the scale is a power of two, all other layers keep
// their bits.
static void distances_grow_with_the_scene_and_nothing_else_does(void **state)
{
    (void)state;
    static const double scales[] = {0x1p-40, 0x1p40};
    const glint_settings settings = frame_of_layers(2);
    glint_environment environment;
    bridge_direction_environment(16, &environment);
    test_frame plain;
    test_render_named("mirror_sphere", &settings, &plain);
    for (size_t i = 0; i < 2; i++) {
        glint_scene scene = {0};
        test_frame scaled;
        test_scene_load("mirror_sphere", &scene);
        scene.unit *= scales[i];
        scale(&scene.origin, scales[i]);
        scale(&scene.low, scales[i]);
        scale(&scene.high, scales[i]);
        scale(&scene.cameras[0].eye, scales[i]);
        test_render(&scene, &environment, NULL, &settings, &scaled);
        for (size_t p = 0; p < pixel_count(&settings); p++) {
            assert_true(layer(&scaled, GLINT_AOV_Z)[p] ==
                        (float)scales[i] * layer(&plain, GLINT_AOV_Z)[p]);
        }
        memcpy((float *)layer(&scaled, GLINT_AOV_Z), layer(&plain, GLINT_AOV_Z),
               pixel_count(&settings) * sizeof(float));
        assert_same_layers(&plain, &scaled, pixel_count(&settings));
        test_frame_free(&scaled);
        glint_scene_free(&scene);
    }
    test_frame_free(&plain);
    glint_environment_free(&environment);
}

// ---- Requests -----------------------------------------------------------------------------------

static void only_layers_that_are_asked_for_are_made(void **state)
{
    (void)state;
    glint_settings settings = frame_of_layers(1);
    settings.aovs = GLINT_AOV_BIT(GLINT_AOV_FACE) | GLINT_AOV_BIT(GLINT_AOV_TIR);
    test_frame some, all;
    test_render_named("glass_slab", &settings, &some);
    assert_int_equal(some.layers.count, 2);
    assert_string_equal(some.layers.channels[0].name, "tir.count");
    assert_string_equal(some.layers.channels[1].name, "face.index");
    settings.aovs = GLINT_AOV_ALL;
    test_render_named("glass_slab", &settings, &all);
    const size_t bytes = pixel_count(&settings) * sizeof(float);
    assert_memory_equal(some.layers.channels[0].values, layer(&all, GLINT_AOV_TIR), bytes);
    assert_memory_equal(some.layers.channels[1].values, layer(&all, GLINT_AOV_FACE), bytes);
    test_frame_free(&some);
    test_frame_free(&all);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(layers_agree_with_the_oracle),
        cmocka_unit_test(the_face_is_that_of_the_heaviest_look_up),
        cmocka_unit_test(layers_add_up_to_what_the_frame_reports),
        cmocka_unit_test(every_width_and_tile_write_the_same_layers_and_leave_the_picture_alone),
        cmocka_unit_test(the_short_way_of_mirrors_writes_the_same_layers),
        cmocka_unit_test(what_a_pixel_shows_is_its_middle_samples),
        cmocka_unit_test(layers_do_not_depend_on_the_filter),
        cmocka_unit_test(an_empty_scene_has_faces_and_nothing_else),
        cmocka_unit_test(distances_grow_with_the_scene_and_nothing_else_does),
        cmocka_unit_test(only_layers_that_are_asked_for_are_made),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
