// Tests shading at vertices in hard places: at the rim of solids, where corners are just out of
// sight, and without vertices.
#include "support/bridge.h"
#include "support/render.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static double largest_difference(const glint_image *a, const glint_image *b)
{
    double largest = 0;
    for (size_t i = 0; i < 4 * (size_t)a->width * (size_t)a->height; i++) {
        const double difference = fabs((double)a->pixels[i] - (double)b->pixels[i]);
        largest = fmax(largest, isnan(difference) ? INFINITY : difference);
    }
    return largest;
}

// From outside, depth 1 does not show the absorption inside a ball. Paint interpolates the
// irradiance, 1/2 + n/3 here, with an error of h² for triangles of size h = 0.1.
static void corners_out_of_sight_show_the_outside(void **state)
{
    (void)state;
    glint_environment environment;
    bridge_direction_environment(64, &environment);
    for (int by_color = 0; by_color < 2; by_color++) {
        glint_scene scene = {0};
        test_scene_load("glass_sphere", &scene);
        glint_settings settings = test_small_frame(1);
        settings.shading = by_color ? GLINT_SHADING_VERTEX_COLOR : GLINT_SHADING_VERTEX_DIRECTION;
        test_frame clear, other, pixel;
        test_render(&scene, &environment, NULL, &settings, &clear);
        glint_material *material = &scene.materials[0];
        material->attenuation_distance = 0.1F;
        material->attenuation_color[0] = material->attenuation_color[1] = 0.1F;
        test_render(&scene, &environment, NULL, &settings, &other);
        assert_true(other.plan.features[GLINT_FEATURE_ABSORPTION].compiled);
        assert_int_equal(test_count_different(&clear.image, &other.image), 0);
        test_frame_free(&other);
        material->transmission = 0;
        material->roughness = 1;
        test_render(&scene, &environment, NULL, &settings, &other);
        settings.shading = GLINT_SHADING_PIXEL;
        test_render(&scene, &environment, NULL, &settings, &pixel);
        const double off = largest_difference(&other.image, &pixel.image);
        print_message("matte, %s: off by %.2g\n", by_color ? "colours" : "directions", off);
        assert_true(off < 0.01);
        test_frame_free(&clear);
        test_frame_free(&other);
        test_frame_free(&pixel);
        glint_scene_free(&scene);
    }
    glint_environment_free(&environment);
}

// Without triangles there are no vertices, so glint shades pixels.
static void where_there_are_no_vertices_pixels_are_shaded(void **state)
{
    (void)state;
    glint_scene empty = {0}, scene = {0};
    glint_environment environment;
    test_scene_load("mirror_sphere", &scene);
    bridge_direction_environment(16, &environment);
    glint_settings settings = test_small_frame(0);
    settings.shading = GLINT_SHADING_VERTEX_COLOR;
    test_frame frame, pixel;
    test_render(&empty, &environment, NULL, &settings, &frame);
    assert_int_equal(frame.plan.shading, GLINT_SHADING_PIXEL);
    test_frame_free(&frame);
    settings.output = GLINT_OUTPUT_HITS;
    test_render(&scene, &environment, NULL, &settings, &frame);
    settings.shading = GLINT_SHADING_PIXEL;
    test_render(&scene, &environment, NULL, &settings, &pixel);
    assert_int_equal(test_count_different(&frame.image, &pixel.image), 0);
    test_frame_free(&frame);
    test_frame_free(&pixel);
    glint_environment_free(&environment);
    glint_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(corners_out_of_sight_show_the_outside),
        cmocka_unit_test(where_there_are_no_vertices_pixels_are_shaded),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
