// Tests the shadows of punctual lights: transmission through glass, alpha and solids, in closed
// form, and cases where rounding matters.
#include "support/lit_floor.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

// ---- Obstacles ----------------------------------------------------------------------------------

typedef struct curtain {
    glint_material material;
    double thickness; // 0: a thin sheet
    double left[3];   // transmission without reflection and absorption
    bool reflects;    // with Fresnel's term at each interface
    double beside;    // transmission of the transparent part
} curtain;

// Transmittance 1 − F, for light from empty space onto n = 1.5.
static double passing(double cosine)
{
    const double t = sqrt(1 - (1 - cosine * cosine) / 2.25);
    const double s = (cosine - 1.5 * t) / (cosine + 1.5 * t);
    const double p = (1.5 * cosine - t) / (1.5 * cosine + t);
    return 1 - (s * s + p * p) / 2;
}

#define CURTAIN_HALF 0.15625
#define CURTAIN_Y 0.1875

static void hang(lit_floor *s, const curtain *c)
{
    s->materials[1] = c->material;
    lit_floor_add_sheet(s, &(sheet){CURTAIN_HALF, CURTAIN_Y + c->thickness, 0, 1, false}, 1);
    if (c->thickness == 0) {
        return;
    }
    lit_floor_add_sheet(s, &(sheet){CURTAIN_HALF, CURTAIN_Y, 0, 1, true}, 1);
    const double h = CURTAIN_HALF, low = CURTAIN_Y, high = CURTAIN_Y + c->thickness;
    const double sides[4][2][2] = {
        {{-h, h}, {h, h}}, {{h, h}, {h, -h}}, {{h, -h}, {-h, -h}}, {{-h, -h}, {-h, h}}};
    for (int i = 0; i < 4; i++) {
        const double(*e)[2] = sides[i];
        const double corners[4][3] = {{e[0][0], low, e[0][1]},
                                      {e[1][0], low, e[1][1]},
                                      {e[1][0], high, e[1][1]},
                                      {e[0][0], high, e[0][1]}};
        lit_floor_add_quad(s, corners, 1);
    }
}

// Distance inside a square at height y where the ray from p to the light passes; below 0: outside.
static double inside_at(const glint_punctual_light *light, const double p[3], double y)
{
    const double share = (y - p[1]) / (light->position.y - p[1]);
    const double x = p[0] + share * (light->position.x - p[0]);
    const double z = p[2] + share * (light->position.z - p[2]);
    return CURTAIN_HALF - fmax(fabs(x), fabs(z));
}

// Checks pixels whose ray meets both top and bottom, or neither of them and no side. Counts the
// former.
static int expect_shadows(const lit_floor *s, const glint_settings *settings,
                          const test_frame *frame, const curtain *c)
{
    int met = 0;
    for (int i = 0; i < settings->width * settings->height; i++) {
        double p[3];
        lit_floor_point(s, settings, i, &flat_floor, p);
        if (fmax(fabs(p[0]), fabs(p[2])) < CURTAIN_HALF + 0.01) {
            continue; // the pixel shows the curtain
        }
        const glint_punctual_light *light = &s->lights[0];
        double least = INFINITY, most = -INFINITY;
        for (int k = 0; k <= 8; k++) {
            const double inside = inside_at(light, p, CURTAIN_Y + c->thickness * k / 8);
            least = fmin(least, inside);
            most = fmax(most, inside);
        }
        if (most < -0.01) {
            lit_floor_expect(&(lit_frame){s, settings, frame, &flat_floor}, i, lit_fully,
                             LIT_FLOOR_SLACK);
        } else if (least > 1e-5) {
            const double to[3] = {light->position.x - p[0], light->position.y - p[1],
                                  light->position.z - p[2]};
            const double cosine = to[1] / sqrt(to[0] * to[0] + to[1] * to[1] + to[2] * to[2]);
            double left[3];
            for (int k = 0; k < 3; k++) {
                const int interfaces = c->thickness > 0 ? 2 : 1;
                const double open = c->reflects ? pow(passing(cosine), interfaces) : 1;
                const double absorbed =
                    pow((double)c->material.attenuation_color[k], c->thickness / cosine);
                left[k] = c->beside + c->left[k] * open * absorbed;
            }
            lit_floor_expect(&(lit_frame){s, settings, frame, &flat_floor}, i, left,
                             LIT_FLOOR_SLACK);
            met++;
        }
    }
    return met;
}

#define CURTAIN(...)                                                                               \
    {                                                                                              \
        GLINT_MATERIAL_CLEAR, .mirror = -1, .alpha_cutoff = 0.5f, __VA_ARGS__                      \
    }
#define BLACK .base_color = {0, 0, 0}, .roughness = 1, .alpha = 1
#define TINT .base_color = {0.5f, 0.75f, 1}

static const curtain curtains[] = {
    {.material = CURTAIN(BLACK)},
    {.material = CURTAIN(BLACK, .metallic = 1)},
    {.material = CURTAIN(TINT, .transmission = 1, .alpha = 1),
     .left = {0.5, 0.75, 1},
     .reflects = true},
    // Glass has the share that metal leaves.
    {.material = CURTAIN(TINT, .transmission = 0.5f, .metallic = 0.5f, .alpha = 1),
     .left = {0.125, 0.1875, 0.25},
     .reflects = true},
    {.material = CURTAIN(TINT, .roughness = 1, .alpha = 0.25f, .alpha_mode = GLINT_ALPHA_BLEND),
     .beside = 0.75},
    {.material = CURTAIN(TINT, .roughness = 1, .alpha = 0.25f, .alpha_mode = GLINT_ALPHA_MASK),
     .beside = 1},
    {.material = CURTAIN(TINT, .roughness = 1, .alpha = 0.75f, .alpha_mode = GLINT_ALPHA_MASK)},
    {.material = CURTAIN(TINT, .transmission = 1, .alpha = 0.5f, .alpha_mode = GLINT_ALPHA_BLEND),
     .left = {0.25, 0.375, 0.5},
     .reflects = true,
     .beside = 0.5},
    {.material = {TINT, .ior = 1.5f, .mirror = -1, .transmission = 1, .alpha = 1, .thickness = 1,
                  .attenuation_distance = 1, .attenuation_color = {0.01f, 0.1f, 1},
                  GLINT_MATERIAL_SPECULAR},
     .thickness = 0.125,
     .left = {0.25, 0.5625, 1},
     .reflects = true},
};

static void check_curtains(const glint_settings *settings)
{
    for (size_t i = 0; i < sizeof curtains / sizeof *curtains; i++) {
        lit_floor s;
        test_frame frame;
        lit_floor_begin(&s, &flat_floor);
        lit_floor_add_light(&s, &floor_lamp);
        s.lights[0].position = (glint_vec3){0.4375, 0.59375, 0.015625};
        hang(&s, &curtains[i]);
        lit_floor_render(&s, settings, &frame);
        if (expect_shadows(&s, settings, &frame, &curtains[i]) < 40) {
            fail_msg("curtain %zu casts no shadow", i);
        }
        test_frame_free(&frame);
    }
}

static void what_is_on_the_way_takes_its_share(void **state)
{
    (void)state;
    lit_floor_in_both(check_curtains);
}

// ---- Where rounding would tell ------------------------------------------------------------------

// A lamp on a ceiling lights the floor, but not the ceiling.
static void check_lamp_on_a_ceiling(const glint_settings *settings)
{
    const sheet ceiling = {.half = 0.8, .y = 0.7, .parts = 5, .faces_down = true};
    for (int up = 0; up < 2; up++) {
        lit_floor s;
        test_frame frame;
        lit_floor_begin(&s, &flat_floor);
        lit_floor_add_sheet(&s, &ceiling, 1);
        lit_floor_look(&s, 0.5, up);
        lit_floor_add_light(&s, &floor_lamp);
        s.lights[0].position = (glint_vec3){0.125, (double)0.7f, 0.0625};
        lit_floor_render(&s, settings, &frame);
        lit_floor_expect_everywhere(&(lit_frame){&s, settings, &frame, up ? &ceiling : &flat_floor},
                                    up ? lit_not : lit_fully, LIT_FLOOR_SLACK);
        test_frame_free(&frame);
    }
}

static void a_lamp_on_a_ceiling_lights_the_floor_alone(void **state)
{
    (void)state;
    lit_floor_in_both(check_lamp_on_a_ceiling);
}

// Close above a slanted plane of many triangles, rays to a lamp graze all triangles.
static void check_grazing(const glint_settings *settings)
{
    const sheet slanted = {.half = 0.9, .y = LIT_FLOOR_Y, .slope = 0.1, .parts = 16};
    static const double heights[] = {0.125, 0x1p-7, 0x1p-10};
    for (size_t i = 0; i < sizeof heights / sizeof *heights; i++) {
        lit_floor s;
        test_frame frame;
        lit_floor_begin(&s, &slanted);
        lit_floor_add_light(&s, &floor_lamp);
        s.lights[0].position = (glint_vec3){0, LIT_FLOOR_Y + heights[i], 0.03125};
        lit_floor_render(&s, settings, &frame);
        // Vertices are rounded to floats, so the plane deviates from flat_floor.
        const double bumps = 0x1p-22 / lit_floor_rounding(settings);
        lit_floor_expect_everywhere(&(lit_frame){&s, settings, &frame, &slanted}, lit_fully,
                                    LIT_FLOOR_SLACK + 64 * bumps / heights[i]);
        test_frame_free(&frame);
    }
}

static void grazing_light_meets_no_shadow_of_its_own_plane(void **state)
{
    (void)state;
    lit_floor_in_both(check_grazing);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_on_the_way_takes_its_share),
        cmocka_unit_test(a_lamp_on_a_ceiling_lights_the_floor_alone),
        cmocka_unit_test(grazing_light_meets_no_shadow_of_its_own_plane),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
