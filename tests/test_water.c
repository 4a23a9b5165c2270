// Tests the lecture's refraction through one interface: an open surface of water, from above and
// from below. The reference is a closed form in double precision that shares no code with the
// renderer.
#include "render/frame.h"

#include "scene/subset.h"
#include "support/bridge.h"
#include "support/render.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#define IOR 1.333
#define EDGE 512
#define PI 3.14159265358979323846

static const double attenuation[3] = {0.55, 0.85, 0.9}; // of white light over this distance:
static const double attenuation_distance = 12;

// Radiance of bridge_direction_environment. It is smooth: exact at the cube's texels. Between them
// interpolation errs by h²/8 of its second derivatives (under 1.5 in each of s and t), with h =
// 2/EDGE.
static double radiance(const double d[3], int channel)
{
    return 0.5 + 0.5 * d[channel] / sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}
static const double between_texels = 4.0 / EDGE / EDGE / 8 * 1.5 * 2;

// Unpolarised reflectance for light from the index `from` into the index `to`; 1 at total
// reflection. *cos_t belongs to the transmitted angle.
static double fresnel(double cos_i, double from, double to, double *cos_t)
{
    const double sin_t_squared = (from / to) * (from / to) * (1 - cos_i * cos_i);
    if (sin_t_squared >= 1) {
        *cos_t = 0;
        return 1;
    }
    *cos_t = sqrt(1 - sin_t_squared);
    const double s = (from * cos_i - to * *cos_t) / (from * cos_i + to * *cos_t);
    const double p = (to * cos_i - from * *cos_t) / (to * cos_i + from * *cos_t);
    return 0.5 * (s * s + p * p);
}

typedef struct seen {
    double rgb[3];
    double margin; // bound on the kernel's rounding error
    bool is_total; // total reflection
} seen;

// The colour along the unit vector d, from an eye `height` above the surface (negative: below).
static seen look(double height, const double d[3])
{
    seen s = {.margin = between_texels};
    const bool from_below = height < 0;
    if (d[1] * height >= 0) { // away from the surface
        for (int c = 0; c < 3; c++) {
            s.rgb[c] = radiance(d, c);
        }
        return s;
    }
    double cos_t;
    const double cos_i = fabs(d[1]);
    const double from = from_below ? IOR : 1, to = from_below ? 1 : IOR;
    const double f = fresnel(cos_i, from, to, &cos_t);
    const double mirrored[3] = {d[0], -d[1], d[2]};
    const double on[3] = {from / to * d[0], d[1] > 0 ? cos_t : -cos_t, from / to * d[2]};
    for (int c = 0; c < 3; c++) {
        const double way = from_below ? -height / cos_i : 0;
        const double left = pow(attenuation[c], way / attenuation_distance);
        s.rgb[c] = left * (f * radiance(mirrored, c) + (1 - f) * radiance(on, c));
    }
    s.is_total = f == 1;
    // A dozen roundings of numbers under 2. The square of cos_t has the same error, which affects
    // cos_t and f: df/dcos_t is under 4·from/to where light comes from the denser side.
    const double rounding = 12 * 1.2e-7;
    const double of_cos_t = fmin(sqrt(rounding), rounding / fmax(cos_t, 1e-9));
    s.margin += rounding + 6 * of_cos_t;
    return s;
}

// The unit direction of the middle of pixel (i, j).
static void direction_of(const glint_camera *camera, const glint_settings *settings, int i, int j,
                         double d[3])
{
    const double half = tan(camera->yfov / 2);
    const double axes[3][3] = {{camera->right.x, camera->right.y, camera->right.z},
                               {camera->up.x, camera->up.y, camera->up.z},
                               {-camera->back.x, -camera->back.y, -camera->back.z}};
    const double x = half * (2 * (i + 0.5) - settings->width) / settings->height;
    const double y = half * (settings->height - 2 * (j + 0.5)) / settings->height;
    for (int k = 0; k < 3; k++) {
        d[k] = x * axes[0][k] + y * axes[1][k] + axes[2][k];
    }
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int k = 0; k < 3; k++) {
        d[k] /= length;
    }
}

static void check_camera(const char *name, bool expect_total)
{
    glint_scene scene;
    glint_environment environment;
    glint_error error = {0};
    glint_camera camera;
    test_scene_load("water", &scene);
    assert_int_equal(glint_scene_keep_nodes(&scene, "water", &error), GLINT_OK);
    assert_int_equal(glint_scene_camera(&scene, name, &camera, &error), GLINT_OK);
    bridge_direction_environment(EDGE, &environment);
    glint_settings settings = test_small_frame(0);
    settings.width = 160;
    settings.height = 120;
    settings.texels = GLINT_TEXELS_FLOAT;
    test_frame frame;
    test_render(&scene, &environment, name, &settings, &frame);
    int total = 0, through = 0;
    double worst = 0;
    for (int j = 0; j < settings.height; j++) {
        for (int i = 0; i < settings.width; i++) {
            double d[3];
            direction_of(&camera, &settings, i, j, d);
            // Beyond the sheet's 40 m there is no surface. Near its end the pixel may show either.
            const double away = fabs(camera.eye.y / d[1]) * hypot(d[0], d[2]);
            if (d[1] * camera.eye.y < 0 && away > 35) {
                continue;
            }
            // Compare the pixel with the closed form.
            const seen wanted = look(camera.eye.y, d);
            total += wanted.is_total;
            through += !wanted.is_total && d[1] * camera.eye.y < 0;
            for (int c = 0; c < 3; c++) {
                const double off =
                    fabs((double)glint_image_pixel(&frame.image, i, j)[c] - wanted.rgb[c]);
                worst = fmax(worst, off / wanted.margin);
                if (!(off <= wanted.margin)) {
                    fail_msg("%s: pixel %d,%d channel %d: off by %g, %g is allowed", name, i, j, c,
                             off, wanted.margin);
                }
            }
        }
    }
    print_message("%s: %d pixels see through, %d total reflection; at worst %.2g of the bound\n",
                  name, through, total, worst);
    assert_true(through > 1000);
    assert_true(expect_total ? total > 1000 : total == 0);
    test_frame_free(&frame);
    glint_environment_free(&environment);
    glint_scene_free(&scene);
}

static void from_above_light_is_bent_down(void **state)
{
    (void)state;
    check_camera("above", false);
}

static void from_below_the_world_lies_in_snells_window(void **state)
{
    (void)state;
    check_camera("below", true);
}

// Straight up, at the critical angle and beyond: results that are known without a formula.
static void the_closed_form_knows_its_limits(void **state)
{
    (void)state;
    double cos_t;
    const double normal = (IOR - 1) / (IOR + 1);
    assert_true(fabs(fresnel(1, IOR, 1, &cos_t) - normal * normal) < 1e-15 && cos_t == 1);
    const double critical = asin(1 / IOR); // 48.6 degrees: Snell's window is 97.2 wide
    assert_true(fabs(critical * 180 / PI - 48.607) < 1e-3);
    assert_true(fresnel(cos(critical + 1e-9), IOR, 1, &cos_t) == 1);
    assert_true(fresnel(cos(critical - 1e-3), IOR, 1, &cos_t) < 0.8);
    assert_true(fabs(fresnel(1e-9, 1, IOR, &cos_t) - 1) < 1e-7);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_closed_form_knows_its_limits),
        cmocka_unit_test(from_above_light_is_bent_down),
        cmocka_unit_test(from_below_the_world_lies_in_snells_window),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
