// Tests mended frames: beside jumps pixels must equal double precision, elsewhere single precision,
// bit for bit.
#include "render/layers.h"
#include "support/render.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static double mean_of(const glint_image *image)
{
    double sum = 0;
    const size_t count = 4 * (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < count; i++) {
        sum += i % 4 < 3 ? (double)image->pixels[i] : 0;
    }
    return sum * 4 / 3 / (double)count;
}

// The difference of two pixels, root mean square over R, G and B; 0 for a pixel outside the image.
static double jump(const glint_image *image, int x, int y, int to_x, int to_y)
{
    if (to_x < 0 || to_y < 0 || to_x >= image->width || to_y >= image->height) {
        return 0;
    }
    const float *a = image->pixels + 4 * ((ptrdiff_t)y * image->width + x);
    const float *b = image->pixels + 4 * ((ptrdiff_t)to_y * image->width + to_x);
    double square = 0;
    for (int c = 0; c < 3; c++) {
        square += pow((double)a[c] - (double)b[c], 2) / 3;
    }
    return sqrt(square);
}

static double largest_jump(const glint_image *image, int x, int y)
{
    return fmax(fmax(jump(image, x, y, x + 1, y), jump(image, x, y, x - 1, y)),
                fmax(jump(image, x, y, x, y + 1), jump(image, x, y, x, y - 1)));
}

static bool is_same(const glint_image *a, const glint_image *b, size_t pixel)
{
    const void *of_a = a->pixels + 4 * pixel, *of_b = b->pixels + 4 * pixel; // as bits
    return memcmp(of_a, of_b, 4 * sizeof *a->pixels) == 0;
}

static void check_mended(const glint_image *mended, const glint_image *in_float,
                         const glint_image *in_double, double mend, uint64_t count)
{
    const double limit = mend * mean_of(in_float), rounding = 1e-5 * limit;
    uint64_t least = 0, most = 0;
    for (int y = 0; y < mended->height; y++) {
        for (int x = 0; x < mended->width; x++) {
            const size_t pixel = (size_t)y * (size_t)mended->width + (size_t)x;
            const double largest = largest_jump(in_float, x, y);
            const bool is_float = is_same(mended, in_float, pixel);
            const bool is_double = is_same(mended, in_double, pixel);
            assert_true(largest < limit - rounding   ? is_float
                        : largest > limit + rounding ? is_double
                                                     : is_float || is_double);
            least += largest > limit + rounding;
            most += largest >= limit - rounding;
        }
    }
    assert_in_range(count, least, most);
    assert_true(count > 0 && count < (uint64_t)mended->width * (uint64_t)mended->height / 2);
}

static void check_scene(const char *name, int width, int height, int samples_per_axis, double mend)
{
    glint_settings settings = glint_settings_default;
    settings.width = width;
    settings.height = height;
    settings.samples_per_axis = samples_per_axis;
    test_stage s;
    test_stage_open(name, &settings, &s);
    glint_settings mending = settings, doubles = settings;
    mending.mend = mend;
    doubles.precision = GLINT_PRECISION_DOUBLE;
    const glint_settings *all[] = {&settings, &mending, &doubles, &mending, &settings};
    glint_image images[5] = {{0}};
    glint_frame_report reports[5];
    for (int i = 0; i < 5; i++) {
        assert_int_equal(glint_renderer_set_settings(s.renderer, all[i], NULL), GLINT_OK);
        assert_int_equal(
            glint_renderer_frame(
                &(glint_frame_request){s.renderer, &s.camera, NULL, &images[i], &reports[i]}, NULL),
            GLINT_OK);
        assert_int_equal(reports[i].mended_pixels > 0, all[i]->mend > 0);
    }
    check_mended(&images[1], &images[0], &images[2], mend, reports[1].mended_pixels);
    assert_int_equal(test_count_different(&images[1], &images[3]), 0);
    assert_int_equal(test_count_different(&images[0], &images[4]), 0);
    // The report counts the rays of mended pixels, rounded up to full rows of the list.
    const uint64_t k = (uint64_t)samples_per_axis * (uint64_t)samples_per_axis;
    const uint64_t again = (reports[1].rays.primary - reports[0].rays.primary) / k;
    assert_in_range(again, reports[1].mended_pixels, reports[1].mended_pixels + 63);
    assert_true(reports[1].rays.reflected > reports[0].rays.reflected);
    for (int i = 0; i < 5; i++) {
        glint_image_free(&images[i]);
    }
    test_stage_close(&s);
}

static void pixels_beside_jumps_are_those_of_double_precision(void **state)
{
    (void)state;
    check_scene("prism", 203, 117, 1, 0.3);
    check_scene("glass_sphere", 160, 90, 2, 0.2);
    check_scene("gallery", 96, 54, 1, 3);
    check_scene("mirror_sphere", 320, 181, 1, 0.5);
    check_scene("orthographic", 131, 97, 1, 1);
}

// A renderer may be created with mending, and again change its settings. A threshold beyond all
// jumps mends nothing.
static void renderers_may_be_made_with_it(void **state)
{
    (void)state;
    glint_settings settings = glint_settings_default;
    settings.width = 203;
    settings.height = 117;
    settings.mend = 0.3;
    test_stage s;
    glint_image first = {0}, none = {0}, in_float = {0};
    glint_frame_report report;
    test_stage_open("prism", &settings, &s);
    assert_int_equal(
        glint_renderer_frame(&(glint_frame_request){s.renderer, &s.camera, NULL, &first, &report},
                             NULL),
        GLINT_OK);
    assert_true(report.mended_pixels > 0);
    settings.mend = 1e6;
    assert_int_equal(glint_renderer_set_settings(s.renderer, &settings, NULL), GLINT_OK);
    assert_int_equal(glint_renderer_frame(
                         &(glint_frame_request){s.renderer, &s.camera, NULL, &none, &report}, NULL),
                     GLINT_OK);
    assert_int_equal(report.mended_pixels, 0);
    settings.mend = 0;
    assert_int_equal(glint_renderer_set_settings(s.renderer, &settings, NULL), GLINT_OK);
    assert_int_equal(
        glint_renderer_frame(&(glint_frame_request){s.renderer, &s.camera, NULL, &in_float, NULL},
                             NULL),
        GLINT_OK);
    assert_int_equal(test_count_different(&none, &in_float), 0);
    glint_image_free(&first);
    glint_image_free(&none);
    glint_image_free(&in_float);
    test_stage_close(&s);
}

// Layers are those of single precision, whatever was rendered since.
static void layers_stay(void **state)
{
    (void)state;
    test_frame frames[2];
    glint_settings settings = glint_settings_default;
    settings.width = 131;
    settings.height = 97;
    settings.aovs = GLINT_AOV_ALL;
    for (int i = 0; i < 2; i++) {
        settings.mend = i == 0 ? 0 : 0.3;
        test_render_named("prism", &settings, &frames[i]);
    }
    assert_int_equal(frames[0].layers.count, frames[1].layers.count);
    assert_true(frames[0].layers.count > 0 && frames[1].report.mended_pixels > 0);
    assert_memory_equal(frames[0].layers.values, frames[1].layers.values,
                        frames[0].layers.count * 131 * 97 * sizeof(float));
    test_frame_free(&frames[0]);
    test_frame_free(&frames[1]);
}

static bool stop_in_the_end(void *context, uint64_t done, uint64_t total)
{
    int *after = context;
    *after += done == total;
    return *after < 2;
}

static void it_can_be_stopped(void **state)
{
    (void)state;
    glint_settings settings = glint_settings_default;
    settings.width = 203;
    settings.height = 117;
    settings.mend = 0.3;
    test_stage s;
    glint_image image = {0};
    test_stage_open("prism", &settings, &s);
    int ends = 0;
    const glint_progress progress = {stop_in_the_end, &ends};
    assert_int_equal(
        glint_renderer_frame(&(glint_frame_request){s.renderer, &s.camera, &progress, &image, NULL},
                             NULL),
        GLINT_INTERRUPTED);
    assert_int_equal(ends, 2);
    assert_null(image.pixels);
    // The renderer continues as if nothing had happened.
    assert_int_equal(glint_renderer_frame(
                         &(glint_frame_request){s.renderer, &s.camera, NULL, &image, NULL}, NULL),
                     GLINT_OK);
    glint_image_free(&image);
    test_stage_close(&s);
}

static void what_cannot_be_mended_is_refused(void **state)
{
    (void)state;
    const glint_scene nothing = {0};
    glint_capabilities device = *glint_device_capabilities(test_device());
    glint_settings settings = glint_settings_default;
    const glint_plan_inputs inputs = {.scene = &nothing, .device = &device, .settings = &settings};
    const double odd[] = {-1, (double)NAN, (double)INFINITY};
    for (int i = 0; i < 3; i++) {
        settings.mend = odd[i];
        assert_int_equal(glint_settings_check(inputs.settings, inputs.device, inputs.scene, NULL),
                         GLINT_USAGE);
    }
    settings.mend = 0.3;
    assert_int_equal(glint_settings_check(inputs.settings, inputs.device, inputs.scene, NULL),
                     GLINT_OK);
    settings.precision = GLINT_PRECISION_DOUBLE;
    assert_int_equal(glint_settings_check(inputs.settings, inputs.device, inputs.scene, NULL),
                     GLINT_USAGE);
    settings.precision = GLINT_PRECISION_FLOAT;
    settings.output = GLINT_OUTPUT_HITS;
    assert_int_equal(glint_settings_check(inputs.settings, inputs.device, inputs.scene, NULL),
                     GLINT_USAGE);
    settings.output = GLINT_OUTPUT_COLOR;
    settings.shading = GLINT_SHADING_VERTEX_COLOR;
    assert_int_equal(glint_settings_check(inputs.settings, inputs.device, inputs.scene, NULL),
                     GLINT_USAGE);
    settings.shading = GLINT_SHADING_PIXEL;
    device.has_double = false;
    assert_int_equal(glint_settings_check(inputs.settings, inputs.device, inputs.scene, NULL),
                     GLINT_DEVICE_LACKS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pixels_beside_jumps_are_those_of_double_precision),
        cmocka_unit_test(renderers_may_be_made_with_it),
        cmocka_unit_test(layers_stay),
        cmocka_unit_test(it_can_be_stopped),
        cmocka_unit_test(what_cannot_be_mended_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
