// Tests hard cases of materials and of settings that change a frame. Each is a small scene that
// looks wrong if a rule of docs/light_transport.md is broken. The oracle gives the expected
// colours.
#include "selftest/judged.h"
#include "selftest/shapes.h"

#include <math.h>

typedef struct look {
    const char *what;
    void (*build)(shape *s);
    void (*dress)(glint_material *materials); // may be NULL
    void (*set)(glint_settings *settings);    // may be NULL
    double eye[3];
    int depth;
    bool is_lit; // a lamp lights it
} look;

// ---- Scenes -------------------------------------------------------------------------------------

static void add_ball(shape *s, double x, double z, double size, shape_material material)
{
    const double centre[3] = {x, 0, z};
    shape_add_ball(s, &(shape_ball){centre, size, 3, material, true, NULL});
}

// Adds an upright wall, from left to right. Its right end is `slant` farther away.
static void add_wall(shape *s, double half, double z, double slant, shape_material material)
{
    const double corners[4][3] = {
        {-half, -half, z}, {half, -half, z - slant}, {half, half, z - slant}, {-half, half, z}};
    shape_add_quad(s, corners, material);
}

static void build_pane(shape *s)
{
    add_wall(s, 0.7, 0.6, 0.6, MATERIAL_GLASS);
    add_ball(s, 0.3, -0.5, 0.4, MATERIAL_TINTED);
}

static void build_back(shape *s)
{
    const double corners[4][3] = {
        {0.6, -0.5, 0.2}, {-0.6, -0.5, 0}, {-0.6, 0.5, 0}, {0.6, 0.5, 0.2}};
    shape_add_quad(s, corners, MATERIAL_CORE); // counter-clockwise as seen from behind
    add_ball(s, -0.2, -0.7, 0.25, MATERIAL_TINTED);
}

static void build_ball_and_wall(shape *s)
{
    add_wall(s, 0.9, -0.6, -0.3, MATERIAL_TINTED);
    add_ball(s, 0.1, 0.2, 0.45, MATERIAL_GLASS);
}

static void build_lone_ball(shape *s)
{
    add_ball(s, 0, 0, 0.6, MATERIAL_GLASS);
}

static void build_two_balls(shape *s)
{
    add_ball(s, -0.45, 0, 0.4, MATERIAL_TINTED);
    add_ball(s, 0.45, 0.1, 0.4, MATERIAL_PAINT);
    add_wall(s, 0.9, -0.6, 0.2, MATERIAL_CORE);
}

static void build_in_glass(shape *s)
{
    const double low[3] = {-0.6, -0.5, -0.4}, high[3] = {0.5, 0.6, 0.4};
    shape_add_box(s, &(shape_box){low, high, 1, MATERIAL_GLASS, false});
    add_ball(s, 0.1, 0, 0.25, MATERIAL_CORE);
    add_wall(s, 0.9, -0.8, 0.2, MATERIAL_TINTED);
}

static void build_paint_in_glass(shape *s)
{
    const double low[3] = {-0.6, -0.5, -0.4}, high[3] = {0.5, 0.6, 0.4};
    shape_add_box(s, &(shape_box){low, high, 1, MATERIAL_CORE, false});
    add_ball(s, 0, 0, 0.3, MATERIAL_PAINT);
    add_wall(s, 0.9, -0.8, 0.2, MATERIAL_PAINT);
}

// ---- Materials ----------------------------------------------------------------------------------

static void set_color(float color[3], float r, float g, float b)
{
    color[0] = r;
    color[1] = g;
    color[2] = b;
}

static void make_thin(glint_material *m)
{
    m[MATERIAL_GLASS].thickness = 0;
    set_color(m[MATERIAL_GLASS].base_color, 0.9F, 0.6F, 0.3F);
}

static void make_absorbing(glint_material *m)
{
    m[MATERIAL_CORE].ior = 1.4F;
    m[MATERIAL_CORE].attenuation_distance = 1.5F;
    set_color(m[MATERIAL_CORE].attenuation_color, 0.9F, 0.5F, 0.2F);
}

static void make_mixed(glint_material *m)
{
    m[MATERIAL_GLASS].metallic = 0.4F;
    m[MATERIAL_GLASS].transmission = 0.7F;
    set_color(m[MATERIAL_GLASS].base_color, 0.9F, 0.6F, 0.3F);
    set_color(m[MATERIAL_GLASS].emission, 0.2F, 0.1F, 0.05F);
    set_color(m[MATERIAL_TINTED].emission, 0, 0.05F, 0.1F);
}

// The lecture's blend, an unlit colour, and glossy paint.
static void make_plain(glint_material *m)
{
    m[MATERIAL_TINTED].mirror = 0.35F;
    m[MATERIAL_CORE].unlit = true;
    m[MATERIAL_CORE].transmission = m[MATERIAL_CORE].thickness = 0;
    set_color(m[MATERIAL_CORE].base_color, 0.2F, 0.7F, 0.4F);
    m[MATERIAL_PAINT].roughness = 0;
    set_color(m[MATERIAL_PAINT].base_color, 0.8F, 0.5F, 0.2F);
}

// Everything that changes the reflection of surfaces.
static void make_coated(glint_material *m)
{
    glint_material *paint = &m[MATERIAL_PAINT], *metal = &m[MATERIAL_TINTED],
                   *glass = &m[MATERIAL_CORE];
    paint->roughness = 0;
    paint->specular = 0.6F;
    set_color(paint->specular_color, 0.9F, 0.7F, 0.5F);
    paint->diffuse_transmission = 0.4F;
    set_color(paint->diffuse_transmission_color, 0.3F, 0.9F, 0.6F);
    paint->clearcoat = 0.7F;
    metal->iridescence = 0.8F;
    metal->iridescence_ior = 1.4F;
    metal->iridescence_thickness[1] = 400;
    glass->thickness = 0;
    glass->specular = 0.5F;
    glass->clearcoat = 0.5F;
}

static void make_dispersive(glint_material *m)
{
    m[MATERIAL_GLASS].dispersion = 4;
    m[MATERIAL_CORE].attenuation_distance = 0.5F;
    set_color(m[MATERIAL_CORE].attenuation_color, 0.3F, 0.6F, 0.9F);
}

// ---- Settings -----------------------------------------------------------------------------------

static void cut_by_weight(glint_settings *settings)
{
    settings->min_weight = 0.1;
}

// Leaves the depth to glint, which proves it, and compiles only the needed features.
static void leave_to_plan(glint_settings *settings)
{
    settings->depth = 0;
    settings->min_weight = 1e-3;
    settings->all_features = false;
}

static void turn(glint_settings *settings)
{
    settings->env_rotate = 37;
}

static void sample_twice(glint_settings *settings)
{
    settings->env_rotate = -100;
    settings->samples_per_axis = 2;
    settings->transparent = true;
    settings->irradiance = GLINT_IRRADIANCE_SH;
}

static void divide_light(glint_settings *settings)
{
    settings->wavelengths = 3;
}

static const look looks[] = {
    {"a thin pane, at a slant", build_pane, make_thin, NULL, {0.2, 0.1, 2.2}, 3, false},
    {"absorbing glass, from behind", build_back, make_absorbing, NULL, {0.2, 0.1, 2.2}, 3, false},
    {"metal, glass and paint in one, emitting",
     build_ball_and_wall,
     make_mixed,
     NULL,
     {0.3, 0.2, 2},
     5,
     false},
    {"paths that end by their weight",
     build_ball_and_wall,
     make_mixed,
     cut_by_weight,
     {0.3, 0.2, 2},
     12,
     false},
    {"an environment turned by 37°", build_two_balls, make_plain, turn, {0.2, 0.3, 2}, 3, false},
};

// These looks need kernels of their own.
static const look more_looks[] = {
    {"paint in absorbing glass, under a lamp",
     build_paint_in_glass,
     make_absorbing,
     NULL,
     {0.3, 0.2, 2.2},
     3,
     true},
    {"one convex solid", build_lone_ball, NULL, leave_to_plan, {0.2, 0.3, 2}, 0, false},
    {"four samples, no background, irradiance as a polynomial",
     build_two_balls,
     make_plain,
     sample_twice,
     {0.2, 0.3, 2},
     3,
     false},
    {"coats, films and paint lit from behind",
     build_two_balls,
     make_coated,
     NULL,
     {0.2, 0.3, 2},
     3,
     false},
    {"light divided by glass",
     build_in_glass,
     make_dispersive,
     divide_light,
     {0.3, 0.2, 2.2},
     5,
     false},
};

// The lamp is above, to the right and in front. It shines through the glass onto things in it and
// behind it.
static const glint_punctual_light lamp = {.kind = GLINT_PUNCTUAL_POINT,
                                          .position = {0.8, 1.3, 1.5},
                                          .direction = {0, -1, 0},
                                          .color = {3, 2, 1},
                                          .range = INFINITY};

// ---- Judging ------------------------------------------------------------------------------------

// A look-up in the environment errs by at most 2/edge². Dividing by half a wavelength's weight
// doubles this. The irradiance map errs by as much. Curved surfaces multiply the rounding error.
#define LOOK_BOUND 4e-4

static glint_status judge_look(trial *t, const look *of)
{
    static const double target[3] = {0, 0, 0};
    glint_measure *m = trial_error(t, of->what, "of white", LOOK_BOUND);
    glint_scene scene = {0};
    judged frame = {0};
    // Set up the frame.
    glint_settings settings = trial_settings(t);
    settings.width = 32;
    settings.height = 24;
    settings.depth = of->depth;
    settings.all_features = true;
    if (of->set != NULL) {
        of->set(&settings);
    }
    const glint_camera camera = shape_camera(of->eye, target, 0.8, 0);
    // Build the scene.
    glint_status status;
    shape s = shape_begin();
    of->build(&s);
    TRY_OR(cleanup, status, shape_end(&s, &scene, t->error));
    if (of->dress != NULL) {
        of->dress(scene.materials);
    }
    if (of->is_lit) {
        TRY_OR(cleanup, status, shape_set_lights(&lamp, 1, &scene, t->error));
    }
    // Render it and compare it with the oracle.
    TRY_OR(cleanup, status, judged_frame(t, &scene, &camera, &settings, &frame));
    frame.view.edges = true;
    judged_compare(&frame, m);
cleanup:
    judged_end(&frame);
    glint_scene_free(&scene);
    return status;
}

static glint_status plain_materials(trial *t)
{
    for (size_t i = 0; i < sizeof looks / sizeof *looks; i++) {
        TRY(judge_look(t, &looks[i]));
    }
    return GLINT_OK;
}

static glint_status coats_and_settings(trial *t)
{
    for (size_t i = 0; i < sizeof more_looks / sizeof *more_looks; i++) {
        TRY(judge_look(t, &more_looks[i]));
    }
    return GLINT_OK;
}

const trial_case material_cases[] = {
    {"plain_materials", "what one surface does to light, each by itself: the oracle's colours",
     plain_materials},
    {"coats_and_settings", "the same of coats, films and dispersion, and of what settings do",
     coats_and_settings},
    {0},
};
