// A scene that moves, in each way that glTF knows.
#include "scenes.h"
#include "shapes.h"

#define SECONDS 2.0

// A whole turn about an axis at a steady rate: quarter turns, as two keys half a turn apart would
// leave the direction open.
static void spin(model *scene, const node *object, glint_vec3 axis)
{
    motion *turns = model_add_motion(scene, object, "rotation", "LINEAR");
    for (int quarter = 0; quarter <= 4; quarter++) {
        double rotation[4];
        rotation_about(axis, 90 * quarter, rotation);
        motion_add_key(turns, SECONDS * quarter / 4, rotation);
    }
}

// Up and down twice, at rest where it turns.
static void lift(model *scene, const node *object, double height)
{
    const double seconds = SECONDS / 4; // from a key to the next: up, down, up, down
    motion *flight = model_add_motion(scene, object, "translation", "CUBICSPLINE");
    for (int key = 0; key <= 4; key++) {
        double place[3] = {object->translation[0], object->translation[1], object->translation[2]};
        place[1] += key % 2 == 1 ? height : 0;
        motion_add_key(flight, seconds * key, place);
    }
}

// Grows from nothing and shrinks again.
static void breathe(model *scene, const node *object)
{
    static const double sizes[] = {0, 1, 1, 0.4, 0};
    motion *growth = model_add_motion(scene, object, "scale", "LINEAR");
    for (int key = 0; key < 5; key++) {
        const double size[3] = {sizes[key], sizes[key], sizes[key]};
        motion_add_key(growth, SECONDS * key / 4, size);
    }
}

// From place to place without a way between.
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

// A glass block that turns on a mirror floor, a silver ball that goes up and down, a gold one that
// grows and shrinks, a dark one that ticks round like a second hand, and a camera that comes
// nearer.
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
