// Renders a floor under punctual lights. See lit_floor.h.
#include "support/lit_floor.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

// ---- Scenes -------------------------------------------------------------------------------------

static const float albedo[3] = {0.8f, 0.5f, 0.25f};

const glint_material floor_paint = {GLINT_MATERIAL_CLEAR, .base_color = {0.8f, 0.5f, 0.25f},
                                    .roughness = 1,       .mirror = -1,
                                    .alpha = 1,           .occlusion_strength = 1};

void lit_floor_add_quad(lit_floor *s, const double corners[4][3], uint32_t material)
{
    static const int order[6] = {0, 1, 2, 0, 2, 3};
    for (int i = 0; i < 6; i++) {
        for (int k = 0; k < 3; k++) {
            s->positions[s->scene.triangle_count + (size_t)(i / 3)][3 * (i % 3) + k] =
                (float)corners[order[i]][k];
        }
    }
    for (int i = 0; i < 2; i++) {
        s->material_of[s->scene.triangle_count++] = material;
    }
    s->instances[material].triangle_count += 2;
    s->instances[material].material = material;
    if (material + 1 > s->scene.instance_count) {
        s->instances[material].first_triangle = s->scene.triangle_count - 2;
        s->scene.instance_count = s->scene.material_count = material + 1;
    }
}

void lit_floor_add_sheet(lit_floor *s, const sheet *f, uint32_t material)
{
    const double step = 2 * f->half / f->parts;
    for (int i = 0; i < f->parts * f->parts; i++) {
        const int column = i % f->parts, row = i / f->parts;
        const double x0 = -f->half + step * column, x1 = x0 + step;
        const double z0 = -f->half + step * row, z1 = z0 + step;
        const double y0 = f->y + f->slope * x0, y1 = f->y + f->slope * x1;
        const double up[4][3] = {{x0, y0, z1}, {x1, y1, z1}, {x1, y1, z0}, {x0, y0, z0}};
        const double down[4][3] = {{x0, y0, z0}, {x1, y1, z0}, {x1, y1, z1}, {x0, y0, z1}};
        lit_floor_add_quad(s, f->faces_down ? down : up, material);
    }
}

void lit_floor_look(lit_floor *s, double y, bool up)
{
    s->camera = (glint_camera){.orthographic = true,
                               .ymag = 0.55,
                               .eye = {0, y, 0},
                               .right = {1, 0, 0},
                               .up = {0, 0, up ? 1 : -1},
                               .back = {0, up ? -1 : 1, 0}};
}

void lit_floor_begin(lit_floor *s, const sheet *floor)
{
    *s = (lit_floor){.materials = {floor_paint, floor_paint}};
    s->scene = (glint_scene){.unit = 1,
                             .positions = s->positions[0],
                             .material_of = s->material_of,
                             .materials = s->materials,
                             .instances = s->instances,
                             .camera_count = 1,
                             .cameras = &s->camera,
                             .lights = s->lights};
    lit_floor_add_sheet(s, floor, 0);
    lit_floor_look(s, 2, false);
}

const sheet flat_floor = {.half = 0.875, .y = LIT_FLOOR_Y, .parts = 4};

void lit_floor_add_light(lit_floor *s, const glint_punctual_light *light)
{
    s->lights[s->scene.light_count++] = *light;
}

const glint_punctual_light floor_lamp = {.kind = GLINT_PUNCTUAL_POINT,
                                         .position = {0.1875, 0.4375, -0.125},
                                         .direction = {0, 0, -1},
                                         .color = {3, 2, 1},
                                         .range = INFINITY};

// ---- Frames -------------------------------------------------------------------------------------

double lit_floor_rounding(const glint_settings *settings)
{
    return settings->precision == GLINT_PRECISION_DOUBLE ? 0x1p-53 : 0x1p-24;
}

static void dark_environment(glint_environment *environment)
{
    *environment = (glint_environment){0};
    assert_int_equal(glint_cube_create(4, &environment->radiance, NULL), GLINT_OK);
}

void lit_floor_render(lit_floor *s, const glint_settings *settings, test_frame *frame)
{
    glint_environment environment;
    dark_environment(&environment);
    glint_scene_find_bounds(&s->scene);
    test_render(&s->scene, &environment, NULL, settings, frame);
    glint_environment_free(&environment);
}

void lit_floor_point(const lit_floor *s, const glint_settings *settings, int pixel, const sheet *on,
                     double p[3])
{
    const double w = settings->width, h = settings->height, half = s->camera.ymag;
    const int column = pixel % settings->width, row = pixel / settings->width;
    const double right = (2 * (column + 0.5) / w - 1) * half * w / h;
    const double up = (1 - 2 * (row + 0.5) / h) * half;
    p[0] = right;
    p[2] = s->camera.up.z * up;
    p[1] = (double)(float)on->y + on->slope * p[0];
}

// Irradiance over π from a light at a point with a unit normal, as KHR_lights_punctual defines it.
static double irradiance(const glint_punctual_light *light, const double p[3], const double n[3])
{
    const double place[3] = {light->position.x, light->position.y, light->position.z};
    const double axis[3] = {light->direction.x, light->direction.y, light->direction.z};
    double l[3], distance = 0, cosine = 0, along = 0, strength = 1;
    for (int k = 0; k < 3; k++) {
        l[k] = light->kind == GLINT_PUNCTUAL_DIRECTIONAL ? -axis[k] : place[k] - p[k];
        distance += l[k] * l[k];
    }
    distance = sqrt(distance);
    for (int k = 0; k < 3; k++) {
        cosine += l[k] / distance * n[k];
        along -= l[k] / distance * axis[k];
    }
    if (light->kind != GLINT_PUNCTUAL_DIRECTIONAL) {
        strength = fmax(fmin(1 - pow(distance / light->range, 4), 1), 0) / (distance * distance);
    }
    if (light->kind == GLINT_PUNCTUAL_SPOT) {
        const double inner = cos(light->inner_angle), outer = cos(light->outer_angle);
        const double scale = 1 / fmax(0.001, inner - outer);
        const double cone = fmin(fmax(along * scale - outer * scale, 0), 1);
        strength *= cone * cone;
    }
    return fmax(cosine, 0) * strength / GLINT_PI;
}

void lit_floor_in_both(void (*check)(const glint_settings *settings))
{
    for (int precision = 0; precision < 2; precision++) {
        glint_settings settings = test_small_frame(0);
        settings.precision = precision ? GLINT_PRECISION_DOUBLE : GLINT_PRECISION_FLOAT;
        check(&settings);
    }
}

void lit_floor_expect(const lit_frame *f, int pixel, const double left[3], double slack)
{
    const lit_floor *s = f->floor;
    const sheet *on = f->on;
    const double slant = hypot(1, on->slope), side = on->faces_down ? -1 : 1;
    const double n[3] = {-side * on->slope / slant, side / slant, 0};
    double p[3];
    lit_floor_point(s, f->settings, pixel, on, p);
    for (int k = 0; k < 3; k++) {
        double wanted = 0, most = 0;
        for (size_t i = 0; i < s->scene.light_count; i++) {
            glint_punctual_light open = s->lights[i];
            const double sent = irradiance(&s->lights[i], p, n) * open.color[k];
            open.range = INFINITY;
            open.kind = open.kind == GLINT_PUNCTUAL_SPOT ? GLINT_PUNCTUAL_POINT : open.kind;
            wanted += left[k] * sent;
            most += irradiance(&open, p, n) * open.color[k];
        }
        const double got = f->frame->exact[4 * pixel + k], base = (double)albedo[k];
        if (!(fabs(got - base * wanted) <= slack * lit_floor_rounding(f->settings) * base * most)) {
            fail_msg("precision %d, pixel %d at (%g, %g, %g): %.9g instead of %.9g",
                     f->settings->precision, pixel, p[0], p[1], p[2], got, base * wanted);
        }
    }
}

const double lit_fully[3] = {1, 1, 1}, lit_not[3] = {0, 0, 0};

void lit_floor_expect_everywhere(const lit_frame *f, const double left[3], double slack)
{
    for (int i = 0; i < f->settings->width * f->settings->height; i++) {
        lit_floor_expect(f, i, left, slack);
    }
}
