// Builds moving scenes, with every kind of animation in glTF.
#include "scenes.h"
#include "shapes.h"

#define SECONDS 2.0

// Turns a node once about an axis at a steady rate. The keys are quarter turns: between keys half a
// turn apart the direction would be undefined.
static void spin(model *scene, const node *object, glint_vec3 axis)
{
    motion *turns = model_add_motion(scene, object, "rotation", "LINEAR");
    for (int quarter = 0; quarter <= 4; quarter++) {
        double rotation[4];
        rotation_about(axis, 90 * quarter, rotation);
        motion_add_key(turns, SECONDS * quarter / 4, rotation);
    }
}

// Moves a node up and down twice, at rest at each end.
static void lift(model *scene, const node *object, double height)
{
    const double seconds = SECONDS / 4; // from key to key: up, down, up, down
    motion *flight = model_add_motion(scene, object, "translation", "CUBICSPLINE");
    for (int key = 0; key <= 4; key++) {
        double place[3] = {object->translation[0], object->translation[1], object->translation[2]};
        place[1] += key % 2 == 1 ? height : 0;
        motion_add_key(flight, seconds * key, place);
    }
}

// Scales a node from nothing and back.
static void breathe(model *scene, const node *object)
{
    static const double sizes[] = {0, 1, 1, 0.4, 0};
    motion *growth = model_add_motion(scene, object, "scale", "LINEAR");
    for (int key = 0; key < 5; key++) {
        const double size[3] = {sizes[key], sizes[key], sizes[key]};
        motion_add_key(growth, SECONDS * key / 4, size);
    }
}

// Jumps from place to place, without motion between.
static void tick(model *scene, const node *object)
{
    motion *steps = model_add_motion(scene, object, "translation", "STEP");
    for (int key = 0; key < 8; key++) {
        const double angle = GLINT_PI / 4 * key;
        const double place[3] = {1.5 * sin(angle), object->translation[1], 1.5 * cos(angle)};
        motion_add_key(steps, SECONDS * key / 8, place);
    }
}

static void dolly(model *scene, const node *eye, double nearer)
{
    motion *way = model_add_motion(scene, eye, "translation", "LINEAR");
    motion_add_key(way, 0, eye->translation);
    const double place[3] = {eye->translation[0] * nearer, eye->translation[1] * nearer,
                             eye->translation[2] * nearer};
    motion_add_key(way, SECONDS, place);
}

// A clockwork on a mirror floor. A glass block turns, a silver ball goes up and down, a gold ball
// grows and shrinks, a dark ball ticks round like a second hand, and a camera comes nearer.
void build_clockwork(model *scene)
{
    scene->clip = "clockwork";
    model_add_perspective(scene, "dolly", 34, (glint_vec3){2.4, 2.2, 5}, (glint_vec3){0, 0.5, 0});
    dolly(scene, &scene->nodes[0], 0.8);
    model_add_perspective(scene, "still", 34, (glint_vec3){0, 1.4, 6}, (glint_vec3){0, 0.6, 0});
    shape_box(model_add_geometry(scene, "floor"), (glint_vec3){0, 0, 0},
              (glint_vec3){2.2, 0.05, 2.2});
    material steel = material_metal("dark steel", 0.32, 0.33, 0.35);
    model_add_object(scene, "floor", model_add_material(scene, &steel), (glint_vec3){0, -0.05, 0});

    shape_chamfered_box(model_add_geometry(scene, "block"), (glint_vec3){0.4, 0.4, 0.4}, 0.06);
    material glass = material_glass("clear glass", 1.5);
    spin(scene,
         model_add_object(scene, "glass block", model_add_material(scene, &glass),
                          (glint_vec3){0, 0.7, 0}),
         (glint_vec3){0, 1, 0});

    shape_sphere(model_add_geometry(scene, "ball"), 0.3, 6);
    material silver = material_metal("silver", 0.972, 0.96, 0.915);
    material gold = material_metal("gold", 1, 0.71, 0.29);
    material dark = material_paint("dark lacquer", 0.03, 0.03, 0.04, 0);
    lift(scene,
         model_add_object(scene, "lifted ball", model_add_material(scene, &silver),
                          (glint_vec3){-1.2, 0.3, 0.2}),
         0.9);
    breathe(scene, model_add_object(scene, "growing ball", model_add_material(scene, &gold),
                                    (glint_vec3){1.2, 0.35, -0.4}));
    node *hand = model_add_object(scene, "second hand", model_add_material(scene, &dark),
                                  (glint_vec3){0, 0.15, 1.5});
    hand->scale = 0.5;
    tick(scene, hand);
}

// Adds the surroundings of the drop: columns of paint, one of them glossy, and two balls.
static void add_surroundings(model *scene)
{
    static const struct {
        const char *name;
        double color[3], roughness;
        glint_vec3 place;
    } columns[] = {
        {"red column", {0.65, 0.06, 0.04}, 1, {-1.9, 0.8, -1.4}},
        {"white column", {0.75, 0.74, 0.7}, 1, {-0.6, 0.8, -2}},
        {"green column", {0.06, 0.35, 0.1}, 0, {0.8, 0.8, -1.8}},
        {"blue column", {0.05, 0.1, 0.55}, 1, {2.1, 0.8, -1.2}},
        {"orange column", {0.8, 0.3, 0.03}, 1, {-2.2, 0.8, 1.6}},
        {"violet column", {0.3, 0.08, 0.45}, 1, {2.3, 0.8, 1.8}},
    };
    shape_chamfered_box(model_add_geometry(scene, "column"), (glint_vec3){0.25, 0.8, 0.25}, 0.04);
    for (size_t i = 0; i < sizeof columns / sizeof *columns; i++) {
        const double *c = columns[i].color;
        material paint = material_paint(columns[i].name, c[0], c[1], c[2], columns[i].roughness);
        model_add_object(scene, columns[i].name, model_add_material(scene, &paint),
                         columns[i].place);
    }
}

// A chrome drop that hovers past columns, turning and tilting. It reflects its surroundings, which
// change with each of the 24 frames. bench/shot compares it under an environment map with the true
// reflections.
void build_shot(model *scene)
{
    const double seconds = 1;
    scene->clip = "flight";
    model_add_perspective(scene, "main", 38, (glint_vec3){0, 1.5, 5.2}, (glint_vec3){0, 0.75, 0});
    shape_box(model_add_geometry(scene, "floor"), (glint_vec3){0, -0.05, 0},
              (glint_vec3){3.2, 0.05, 3});
    material ground = material_paint("ground", 0.42, 0.4, 0.37, 1);
    model_add_object(scene, "floor", model_add_material(scene, &ground), (glint_vec3){0, 0, 0});
    add_surroundings(scene);

    static const double belly[3][2] = {{0.42, -0.42}, {0.42, 0.1}, {0.2, 0.35}};
    static const double tip[3][2] = {{0.1, 0.475}, {0.06, 0.6}, {0, 0.6}};
    profile drop = {0};
    profile_line(&drop, 0, -0.42, 0.01, -0.42);
    profile_curve(&drop, belly, 24);
    profile_curve(&drop, tip, 16);
    shape_revolve(model_add_geometry(scene, "drop"), &drop, 64);
    material chrome = material_metal("chrome", 0.92, 0.92, 0.93);
    node *body = model_add_object(scene, "drop", model_add_material(scene, &chrome),
                                  (glint_vec3){-1.3, 0.85, 0.5});
    motion *way = model_add_motion(scene, body, "translation", "LINEAR");
    motion *tilt = model_add_motion(scene, body, "rotation", "LINEAR");
    for (int key = 0; key <= 12; key++) {
        const double share = key / 12.0;
        const double place[3] = {-1.3 + 2.6 * share, 0.85 + 0.25 * sin(GLINT_PI * share),
                                 0.5 - 0.9 * sin(GLINT_PI * share)};
        double rotation[4];
        rotation_about((glint_vec3){0, 0, 1}, 50 - 100 * share, rotation);
        motion_add_key(way, seconds * share, place);
        motion_add_key(tilt, seconds * share, rotation);
    }
}
