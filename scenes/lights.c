// Builds a scene of punctual lights: a point, a spot and a sun on paint, with their shadows, seen
// directly, in a mirror and through glass.
#include "scenes.h"
#include "shapes.h"

// Moves a lamp above the floor, to and fro.
static void swing(model *scene, const node *lamp)
{
    static const double places[3][3] = {{-1.1, 2.1, 0.9}, {1.3, 2.1, 0.9}, {-1.1, 2.1, 0.9}};
    motion *m = model_add_motion(scene, lamp, "translation", "LINEAR");
    for (int i = 0; i < 3; i++) {
        motion_add_key(m, i, places[i]);
    }
}

static void add_lights(model *scene)
{
    const light warm = {
        .name = "warm lamp", .type = "point", .color = {1, 0.62, 0.3}, .intensity = 26, .range = 6};
    const node *lamp =
        model_add_light(scene, &warm, (glint_vec3){-1.1, 2.1, 0.9}, (glint_vec3){-1.1, 0, 0.9});
    const light blue = {.name = "blue spot",
                        .type = "spot",
                        .color = {0.3, 0.5, 1},
                        .intensity = 90,
                        .inner = 9,
                        .outer = 14};
    model_add_light(scene, &blue, (glint_vec3){2.2, 2.6, 2.4}, (glint_vec3){1.5, 0, 0.1});
    const light sun = {
        .name = "sun", .type = "directional", .color = {1, 0.95, 0.85}, .intensity = 2};
    model_add_light(scene, &sun, (glint_vec3){-2, 4, 3}, (glint_vec3){0, 0, 0});
    scene->clip = "swing";
    swing(scene, lamp);
}

static void add_glass(model *scene)
{
    shape_box(model_add_geometry(scene, "block"), (glint_vec3){0, 0, 0},
              (glint_vec3){0.22, 0.3, 0.22});
    material amber = material_glass("amber", 1.5);
    amber.attenuation_distance = 0.4;
    amber.attenuation_color[0] = 0.9;
    amber.attenuation_color[1] = 0.55;
    amber.attenuation_color[2] = 0.12;
    model_add_object(scene, "amber block", model_add_material(scene, &amber),
                     (glint_vec3){-0.25, 0.301, 0.85});

    shape_sheet(model_add_geometry(scene, "pane"), 0.45, 0.4);
    material green = material_thin("green pane", 1.5);
    green.base_color[0] = 0.35;
    green.base_color[2] = 0.45;
    node *pane = model_add_object(scene, "green pane", model_add_material(scene, &green),
                                  (glint_vec3){1.05, 0.42, 0.75});
    rotation_about((glint_vec3){1, 0, 0}, 80, pane->rotation);
}

void build_lights(model *scene)
{
    model_add_perspective(scene, "main", 32, (glint_vec3){0.2, 2.1, 5.2},
                          (glint_vec3){0.05, 0.5, 0});
    shape_sheet(model_add_geometry(scene, "floor"), 2.6, 2.6);
    const material paint = material_paint("slate", 0.2, 0.21, 0.23, 1);
    const int slate = model_add_material(scene, &paint);
    model_add_object(scene, "floor", slate, (glint_vec3){0, 0, 0});
    shape_box(model_add_geometry(scene, "wall"), (glint_vec3){0, 0, 0},
              (glint_vec3){2.6, 0.8, 0.05});
    model_add_object(scene, "wall", slate, (glint_vec3){0, 0.801, -1.6});

    shape_sphere(model_add_geometry(scene, "ball"), 0.5, 4);
    const material chrome = material_metal("chrome", 0.9, 0.9, 0.92);
    model_add_object(scene, "mirror ball", model_add_material(scene, &chrome),
                     (glint_vec3){0.55, 0.501, -0.35});
    const material lacquer = material_paint("lacquer", 0.5, 0.06, 0.05, 0);
    model_add_object(scene, "lacquer ball", model_add_material(scene, &lacquer),
                     (glint_vec3){-0.85, 0.501, -0.4});
    add_glass(scene);
    add_lights(scene);
}
