// Tests features where they meet: rooms whose materials, lamps and settings are chosen by chance,
// the same in every run. The oracle gives the expected colours.
#include "selftest/judged.h"
#include "selftest/shapes.h"

#include <math.h>

// ---- Chance -------------------------------------------------------------------------------------

static bool one_in(trial *t, int n)
{
    return glint_random_number(&t->random) * n < 1;
}

static float between(trial *t, double low, double high)
{
    return (float)(low + (high - low) * glint_random_number(&t->random));
}

static void fill(trial *t, float color[3])
{
    for (int k = 0; k < 3; k++) {
        color[k] = between(t, 0.2, 1);
    }
}

// What lies above the base of any material, and how much of the surface is there.
static void add_layers(trial *t, bool rough, glint_material *m)
{
    if (one_in(t, 3)) {
        m->clearcoat = between(t, 0.3, 1);
        m->clearcoat_roughness = rough && one_in(t, 2) ? between(t, 0.2, 0.6) : 0;
    }
    if (one_in(t, 4)) {
        m->iridescence = between(t, 0.3, 1);
        m->iridescence_ior = 1.4F;
        m->iridescence_thickness[1] = between(t, 200, 500);
    }
    if (one_in(t, 3)) {
        m->specular = between(t, 0.3, 1);
        fill(t, m->specular_color);
    }
    if (one_in(t, 4)) {
        fill(t, m->emission);
    }
    if (one_in(t, 4)) {
        m->alpha_mode = one_in(t, 3) ? GLINT_ALPHA_MASK : GLINT_ALPHA_BLEND;
        m->alpha_cutoff = 0.5F;
        m->alpha = between(t, 0.2, 0.9);
    }
    if (one_in(t, 8)) {
        m->unlit = true;
    }
}

static void choose_metal(trial *t, bool rough, glint_material *m)
{
    m->metallic = one_in(t, 3) ? between(t, 0.3, 0.8) : 1;
    m->roughness = rough && one_in(t, 2) ? between(t, 0.2, 0.8) : 0;
    if (rough && one_in(t, 3)) {
        fill(t, m->sheen_color);
        m->sheen_roughness = between(t, 0.3, 0.9);
    }
    if (one_in(t, 5)) {
        m->mirror = between(t, 0.2, 0.8);
    }
    add_layers(t, rough, m);
}

static void choose_paint(trial *t, bool rough, glint_material *m)
{
    fill(t, m->base_color);
    m->roughness = one_in(t, 2) ? 0 : rough ? between(t, 0.2, 0.9) : 1;
    if (one_in(t, 3)) {
        m->diffuse_transmission = between(t, 0.3, 0.8);
        fill(t, m->diffuse_transmission_color);
    }
    if (rough && one_in(t, 3)) {
        fill(t, m->sheen_color);
        m->sheen_roughness = between(t, 0.3, 0.9);
    }
    add_layers(t, rough, m);
}

static void choose_glass(trial *t, glint_material *m)
{
    m->ior = between(t, 1.2, 1.8);
    if (one_in(t, 3)) {
        m->thickness = 0;
    }
    if (one_in(t, 2)) {
        m->attenuation_distance = between(t, 0.5, 2);
        fill(t, m->attenuation_color);
    }
    if (one_in(t, 3)) {
        m->dispersion = between(t, 0.5, 2);
    }
    if (one_in(t, 3)) {
        m->transmission = between(t, 0.4, 0.9);
        fill(t, m->base_color);
    }
    add_layers(t, false, m);
}

// ---- Rooms --------------------------------------------------------------------------------------

static void add_ball(shape *s, const double centre[3], double size, shape_material material)
{
    shape_add_ball(s, &(shape_ball){centre, size, 3, material, true, NULL});
}

// A ball of metal, a box of glass with a ball of another solid in it, and a wall of paint.
static glint_status build(trial *t, bool rough, glint_scene *scene)
{
    static const double left[3] = {-0.5, 0, 0.1}, right[3] = {0.4, 0.05, 0};
    static const double low[3] = {0, -0.4, -0.4}, high[3] = {0.8, 0.45, 0.4};
    static const double wall[4][3] = {
        {-0.95, -0.9, -0.6}, {0.95, -0.9, -0.8}, {0.95, 0.9, -0.8}, {-0.95, 0.9, -0.6}};
    static const glint_punctual_light lamp = {.kind = GLINT_PUNCTUAL_POINT,
                                              .position = {0.2, 1.3, 1.5},
                                              .direction = {0, -1, 0},
                                              .color = {3, 2, 1},
                                              .range = INFINITY};
    shape s = shape_begin();
    add_ball(&s, left, 0.35, MATERIAL_TINTED);
    shape_add_box(&s, &(shape_box){low, high, 1, MATERIAL_GLASS, false});
    if (one_in(t, 2)) {
        add_ball(&s, right, 0.25, MATERIAL_CORE);
    }
    shape_add_quad(&s, wall, MATERIAL_PAINT);
    TRY(shape_end(&s, scene, t->error));
    choose_metal(t, rough, &scene->materials[MATERIAL_TINTED]);
    choose_paint(t, rough, &scene->materials[MATERIAL_PAINT]);
    choose_glass(t, &scene->materials[MATERIAL_GLASS]);
    choose_glass(t, &scene->materials[MATERIAL_CORE]);
    return one_in(t, 2) ? shape_set_lights(&lamp, 1, scene, t->error) : GLINT_OK;
}

static glint_settings choose_settings(trial *t, bool rough)
{
    glint_settings settings = rough ? trial_lobe_settings(t, 3) : trial_settings(t);
    settings.width = 24;
    settings.height = 18;
    settings.depth = 3;
    settings.wavelengths = 3;
    settings.samples_per_axis = one_in(t, 3) ? 2 : 1;
    settings.env_rotate = one_in(t, 3) ? (double)between(t, -180, 180) : 0;
    settings.transparent = one_in(t, 3);
    settings.irradiance = one_in(t, 3) ? GLINT_IRRADIANCE_SH : GLINT_IRRADIANCE_EXACT;
    settings.fresnel = one_in(t, 6) ? GLINT_FRESNEL_NONE : GLINT_FRESNEL_EXACT;
    return settings;
}

static glint_status judge_room(trial *t, bool rough, glint_measure *errors)
{
    // The second eye is in the box of glass.
    static const double eyes[2][3] = {{0.3, 0.2, 2.2}, {0.45, 0.1, 0.35}}, target[3] = {0, 0, 0};
    glint_scene scene = {0};
    judged frame = {0};
    glint_status status;
    TRY_OR(cleanup, status, build(t, rough, &scene));
    const glint_settings settings = choose_settings(t, rough);
    const bool inside = one_in(t, 4);
    const glint_camera camera = shape_camera(eyes[inside], target, 0.8, 0);
    TRY_OR(cleanup, status, judged_frame(t, &scene, &camera, &settings, &frame));
    frame.judge.scene.overlaps = inside; // finds the media where the path begins
    frame.view.no_fresnel = settings.fresnel == GLINT_FRESNEL_NONE;
    if (rough) {
        frame.view.roughness = 32;
        measure_error(errors, judged_rmse(&frame), "relative RMSE");
    } else {
        frame.view.edges = true;
        judged_compare(&frame, errors);
    }
cleanup:
    judged_end(&frame);
    glint_scene_free(&scene);
    return status;
}

enum { SMOOTH_ROOMS = 48, ROUGH_ROOMS = 12 };

// The look-up in the environment errs as in cases_materials.c, the lobes as in cases_rough.c.
static glint_status smooth_rooms(trial *t)
{
    glint_measure *errors = trial_error(t, "smooth rooms", "of white", 4e-4);
    for (int i = 0; i < SMOOTH_ROOMS; i++) {
        TRY(judge_room(t, false, errors));
    }
    return GLINT_OK;
}

static glint_status rough_rooms(trial *t)
{
    glint_measure *errors = trial_error(t, "rough rooms", "of the mean", 0.003);
    for (int i = 0; i < ROUGH_ROOMS; i++) {
        TRY(judge_room(t, true, errors));
    }
    return GLINT_OK;
}

const trial_case chance_cases[] = {
    {"smooth_rooms", "smooth materials, lamps and settings by chance: where features meet",
     smooth_rooms},
    {"rough_rooms", "the same with rough surfaces and sheen", rough_rooms},
    {0},
};
