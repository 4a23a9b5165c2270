// Tests a measurement. It is a single test, because it must begin before a driver is loaded.
#include "report/bench/bench.h"
#include "scene/built_in.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static int shown;

static void show(void *context, const char *doing)
{
    (void)context;
    assert_non_null(doing);
    shown++;
}

static bool never(void)
{
    return false;
}

static void a_measurement_is_consistent(void **state)
{
    (void)state;
    glint_scene scene;
    glint_environment environment;
    glint_camera camera;
    glint_error error = {0};
    assert_int_equal(glint_built_in_scene("mirror", &scene, &error), GLINT_OK);
    assert_int_equal(glint_environment_studio(&environment, &error), GLINT_OK);
    assert_int_equal(glint_scene_camera(&scene, NULL, &camera, &error), GLINT_OK);
    glint_settings settings = glint_settings_default;
    settings.width = 61;
    settings.height = 43;
    const glint_bench_inputs inputs = {
        .scene = &scene, .environment = &environment, .camera = &camera, .settings = &settings};
    const glint_bench_options options = {.rounds = 4};
    const glint_bench_watcher watcher = {show, NULL, never};
    glint_bench_result result;
    assert_int_equal(glint_bench_measure(&inputs, &options, &watcher, &result, &error), GLINT_OK);

    assert_true(shown >= 5);
    assert_true(result.compile.cold > 0 && result.compile.warm > 0);
    assert_int_equal(result.plan.build_tag, 0); // measures the program as it is
    assert_int_equal(result.report.rays.primary, 61 * 43);
    assert_true(result.report.rays.reflected > 0);
    assert_int_equal(result.bytes.frame, 61 * 43 * 4 * sizeof(float));
    assert_true(result.bytes.scene > scene.triangle_count * 16);
    assert_true(result.bytes.tree > 0 && result.bytes.environment > 0);
    assert_true(result.peak_resident_bytes > result.bytes.scene);
    assert_int_equal(result.kernel.count, 4);
    assert_true(result.frame.median >= result.kernel.minimum + result.readback.minimum);

    const glint_bench_check *check = &result.check;
    assert_true(check->nonfinite_pixels == 0 && check->unsteady_frames == 0);
    if (result.device.has_double) {
        assert_int_equal(check->outcome, GLINT_CHECK_PASSED);
        assert_int_equal(check->error.compared, 61 * 43);
        // Float differs from double, but a mirror multiplies the error only a little.
        assert_true(check->error.relative_rmse > 0 && check->judged.relative_rmse < 1e-3);
        assert_true(check->ill_conditioned < 0.05);
    }
    glint_environment_free(&environment);
    glint_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_measurement_is_consistent)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
