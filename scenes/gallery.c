// Builds the gallery: mirrors, glass and paint as a product photograph, on a disc of polished dark
// metal.
//
// Solid glass stands GAP metres above the floor, so that no two surfaces coincide. All other
// objects keep the same gap, so that float and double agree about the nearer surface.
#include "scenes.h"
#include "shapes.h"

#define GAP 1e-3

// The floor: a disc with a rounded rim, so that it ends in a highlight before the horizon.
static void add_floor(model *scene)
{
    const double radius = 3.4;
    const double rim = 0.06;
    profile p = {0};
    profile_line(&p, 0, -2 * rim, radius - rim, -2 * rim);
    profile_arc(&p, (const double[2]){radius - rim, -rim}, rim, (const double[2]){-90, 90}, 8);
    profile_line(&p, radius - rim, 0, 0, 0);
    shape_revolve(model_add_geometry(scene, "floor disc"), &p, 160);
    material steel = material_metal("polished dark steel", 0.25, 0.26, 0.29);
    model_add_object(scene, "floor", model_add_material(scene, &steel), (glint_vec3){0, 0, 0});
}

static void add_chrome_sphere(model *scene)
{
    shape_sphere(model_add_geometry(scene, "sphere"), 1, 18);
    material chrome = material_metal("chrome", 0.8, 0.81, 0.82);
    node *sphere = model_add_object(scene, "chrome sphere", model_add_material(scene, &chrome),
                                    (glint_vec3){-1.2, 0, -0.6});
    sphere->scale = 0.68;
    model_rest(scene, sphere, GAP);
}

// Shares the geometry of the sphere added before, so the order of calls in build_gallery matters.
static void add_balls(model *scene)
{
    material clear = material_glass("clear glass", 1.5);
    node *ball = model_add_object(scene, "glass ball", model_add_material(scene, &clear),
                                  (glint_vec3){-0.62, 0, 0.62});
    ball->scale = 0.36;
    model_rest(scene, ball, GAP);

    material soap = material_thin("soap film", 1.33);
    node *bubble = model_add_object(scene, "bubble", model_add_material(scene, &soap),
                                    (glint_vec3){1.24, 0, 0.9});
    bubble->scale = 0.26;
    model_rest(scene, bubble, GAP);

    material lacquer = material_paint("red lacquer", 0.33, 0.012, 0.01, 0);
    node *red = model_add_object(scene, "lacquered ball", model_add_material(scene, &lacquer),
                                 (glint_vec3){-1.72, 0, 0.5});
    red->scale = 0.27;
    model_rest(scene, red, GAP);
}

static void add_gold_knot(model *scene)
{
    shape_knot(
        model_add_geometry(scene, "trefoil knot"),
        &(knot_shape){.ring = 0.36, .inner = 0.165, .tube = 0.115, .along = 208, .around = 24});
    material gold = material_metal("gold", 1, 0.71, 0.29);
    node *knot = model_add_object(scene, "gold knot", model_add_material(scene, &gold),
                                  (glint_vec3){1.14, 0, -0.55});
    rotation_about((glint_vec3){0, 1, 0}, -24, knot->rotation);
    model_rest(scene, knot, GAP);
}

// The goblet is one closed surface: underneath the foot, up the stem and the outside of the bowl,
// over the rim and down the inside. Every crossing of a path is a front or back face of the same
// solid.
static void add_goblet(model *scene)
{
    static const struct {
        double control[3][2];
        int steps;
    } curves[] = {
        {{{0.316, 0}, {0.316, 0.0201}, {0.303, 0.0236}}, 6},      // the foot's edge
        {{{0.17, 0.06}, {0.035, 0.05}, {0.033, 0.2}}, 14},        // the foot and the stem
        {{{0.031, 0.35}, {0.03, 0.42}, {0.034, 0.5}}, 6},         // the stem
        {{{0.042, 0.6}, {0.37, 0.62}, {0.375, 0.9}}, 20},         // the bowl's outside
        {{{0.3786, 1.06}, {0.345, 1.2}, {0.318, 1.32}}, 14},      //
        {{{0.3153, 1.332}, {0.2964, 1.3276}, {0.299, 1.316}}, 8}, // the rim
        {{{0.325, 1.2}, {0.355, 1.06}, {0.352, 0.9}}, 14},        // the bowl's inside
        {{{0.3475, 0.66}, {0.16, 0.6}, {0, 0.6}}, 20},            //
    };
    profile p = {0};
    profile_line(&p, 0, 0.012, 0.3, 0);
    for (size_t i = 0; i < sizeof curves / sizeof curves[0]; i++) {
        profile_curve(&p, curves[i].control, curves[i].steps);
    }
    shape_revolve(model_add_geometry(scene, "goblet"), &p, 72);
    material crystal = material_glass("crystal", 1.54);
    node *goblet = model_add_object(scene, "goblet", model_add_material(scene, &crystal),
                                    (glint_vec3){0.02, 0, -0.6});
    model_rest(scene, goblet, GAP);
}

// The gem leans on a main facet of its pavilion, the table towards the camera.
static void add_diamond(model *scene)
{
    shape_brilliant(model_add_geometry(scene, "round brilliant"),
                    &(brilliant_shape){.girdle_radius = 0.3,
                                       .girdle_height = 0.06,
                                       .table = 0.56,
                                       .crown = 34.5,
                                       .pavilion = 40.75,
                                       .star = 0.5,
                                       .lower_half = 0.77});
    material diamond = material_glass("diamond", 2.42);
    node *gem = model_add_object(scene, "diamond", model_add_material(scene, &diamond),
                                 (glint_vec3){0.17, 0, 1.0});
    double lean[4];
    double turn[4];
    rotation_about((glint_vec3){1, 0, 0}, 40.75, lean);
    rotation_about((glint_vec3){0, 1, 0}, -12, turn);
    rotation_compose(turn, lean, gem->rotation);
    model_rest(scene, gem, GAP);
}

static void add_glass_block(model *scene)
{
    shape_chamfered_box(model_add_geometry(scene, "chamfered block"),
                        (glint_vec3){0.24, 0.24, 0.24}, 0.035);
    material teal = material_glass("teal glass", 1.52);
    teal.attenuation_distance = 0.5;
    const double color[3] = {0.04, 0.5, 0.55};
    for (int i = 0; i < 3; i++) {
        teal.attenuation_color[i] = color[i];
    }
    node *block = model_add_object(scene, "glass block", model_add_material(scene, &teal),
                                   (glint_vec3){1.78, 0, 0.2});
    rotation_about((glint_vec3){0, 1, 0}, 28, block->rotation);
    model_rest(scene, block, GAP);
}

static void add_matte_cone(model *scene)
{
    profile p = {0};
    const double tip = 0.03; // the apex is a ball cap, smooth with the flank
    const double flank = 70; // degrees from the floor
    double cap[2] = {0, 0.6};
    double c = cos(flank * GLINT_PI / 180);
    double s = sin(flank * GLINT_PI / 180);
    double base = tip * s + (cap[1] + tip * c) * c / s;
    profile_line(&p, 0, 0, base, 0);
    profile_line(&p, base, 0, tip * s, cap[1] + tip * c);
    profile_arc(&p, cap, tip, (const double[2]){90 - flank, 90}, 8);
    shape_revolve(model_add_geometry(scene, "cone"), &p, 80);
    material blue = material_paint("matte ultramarine", 0.015, 0.045, 0.3, 1);
    node *cone = model_add_object(scene, "matte cone", model_add_material(scene, &blue),
                                  (glint_vec3){0.58, 0, 0.02});
    model_rest(scene, cone, GAP);
}

void build_gallery(model *scene)
{
    model_add_perspective(scene, "photographer", 25, (glint_vec3){0.05, 1.5, 6.2},
                          (glint_vec3){0.02, 0.42, 0});
    add_floor(scene);
    add_chrome_sphere(scene);
    add_balls(scene);
    add_gold_knot(scene);
    add_goblet(scene);
    add_diamond(scene);
    add_glass_block(scene);
    add_matte_cone(scene);
}
