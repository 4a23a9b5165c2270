// Builds scenes of several objects: interreflections, and the material model term by term.
#include "scenes.h"
#include "shapes.h"

// A mirror among four painted balls. The red ball has the lecture's blend of paint and mirror.
void build_lecture_example_2(model *scene)
{
    model_add_perspective(scene, "front", 34, (glint_vec3){0, 0.9, 7}, (glint_vec3){0, 0.1, 0});
    shape_sphere(model_add_geometry(scene, "mirror ball"), 1, 6);
    material mirror = material_metal("mirror", 0.95, 0.95, 0.95);
    model_add_object(scene, "mirror", model_add_material(scene, &mirror), (glint_vec3){0, 0, 0});

    static const struct {
        const char *name;
        double color[3];
        glint_vec3 position;
    } balls[4] = {
        {"red", {0.7, 0.06, 0.04}, {-1.7, 0, 0.6}},
        {"green", {0.08, 0.5, 0.1}, {1.7, 0, 0.6}},
        {"blue", {0.06, 0.12, 0.65}, {0, -1.05, 1.35}},
        {"yellow", {0.75, 0.55, 0.05}, {0, 1.55, 0.2}},
    };
    shape_sphere(model_add_geometry(scene, "small ball"), 0.45, 4);
    for (int i = 0; i < 4; i++) {
        const double *c = balls[i].color;
        material paint = material_paint(balls[i].name, c[0], c[1], c[2], 1);
        paint.blend = i == 0;
        paint.mirror = 0.5;
        model_add_object(scene, balls[i].name, model_add_material(scene, &paint),
                         balls[i].position);
    }
}

// Two mirrors of reflectance 0.9 that face each other at 2 m, with two balls between them.
void build_facing_mirrors(model *scene)
{
    model_add_perspective(scene, "between", 55, (glint_vec3){0.85, 0.3, 0.95},
                          (glint_vec3){-1, 0.05, 0.1});
    shape_box(model_add_geometry(scene, "mirror plate"), (glint_vec3){0, 0, 0},
              (glint_vec3){0.02, 1.4, 2.6});
    material tinted = material_metal("mirror 0.9", 0.9, 0.9, 0.9);
    int plate = model_add_material(scene, &tinted);
    model_add_object(scene, "left mirror", plate, (glint_vec3){-1.02, 0, 0});
    model_add_object(scene, "right mirror", plate, (glint_vec3){1.02, 0, 0});

    shape_sphere(model_add_geometry(scene, "ball"), 0.3, 6);
    material paint = material_paint("matte orange", 0.75, 0.28, 0.05, 1);
    model_add_object(scene, "matte ball", model_add_material(scene, &paint),
                     (glint_vec3){-0.4, -0.27, 0.15});
    material gold = material_metal("gold", 1, 0.71, 0.29);
    model_add_object(scene, "gold ball", model_add_material(scene, &gold),
                     (glint_vec3){-0.4, 0.36, -0.5});
}

// Render it with axes.hdr. The middle of the ball shows +Z, behind the camera, mirrored left to
// right. The background shows −Z as the camera sees it.
void build_axes(model *scene)
{
    model_add_perspective(scene, "ahead", 70, (glint_vec3){0, 0, 4}, (glint_vec3){0, 0, 0});
    shape_sphere(model_add_geometry(scene, "sphere"), 1, 10);
    material mirror = material_metal("mirror", 1, 1, 1);
    model_add_object(scene, "mirror sphere", model_add_material(scene, &mirror),
                     (glint_vec3){0, 0, 0});
}

// The bottom row of the materials: terms that are no mixtures.
static void add_special_materials(model *scene, glint_vec3 first, double pitch)
{
    material special[5] = {
        material_paint("lamp, strength 4", 0, 0, 0, 1),
        material_paint("unlit", 0.1, 0.55, 0.5, 1),
        material_paint("glossy paint", 0.05, 0.3, 0.08, 0),
        material_paint("lecture's blend", 0.7, 0.1, 0.4, 1),
        material_thin("tinted thin wall", 1.5),
    };
    special[0].emission[0] = 1;
    special[0].emission[1] = 0.6;
    special[0].emission[2] = 0.25;
    special[0].emissive_strength = 4;
    special[1].unlit = true;
    special[3].blend = true;
    special[3].mirror = 0.5;
    special[4].base_color[0] = 0.4;
    special[4].base_color[1] = 0.7;
    for (int i = 0; i < 5; i++) {
        model_add_object(scene, special[i].name, model_add_material(scene, &special[i]), first);
        first.x += pitch;
    }
}

// Rows of five: metallic from 0 to 1, transmission of a solid from 0 to 1, and the special
// materials.
void build_materials(model *scene)
{
    static const char *const metallic[5] = {"metallic 0", "metallic 0.25", "metallic 0.5",
                                            "metallic 0.75", "metallic 1"};
    static const char *const transmission[5] = {"transmission 0", "transmission 0.25",
                                                "transmission 0.5", "transmission 0.75",
                                                "transmission 1"};
    const double pitch = 1.1;
    model_add_perspective(scene, "front", 30, (glint_vec3){0, 0, 7}, (glint_vec3){0, 0, 0});
    shape_sphere(model_add_geometry(scene, "ball"), 0.5, 4);
    glint_vec3 place = {-2 * pitch, pitch, 0};
    for (int i = 0; i < 5; i++) {
        material m = material_paint(metallic[i], 0.95, 0.55, 0.3, 0);
        m.metallic = 0.25 * i;
        model_add_object(scene, m.name, model_add_material(scene, &m), place);
        place.y = 0;
        material g = material_paint(transmission[i], 0.55, 0.8, 0.95, 0);
        g.transmission = 0.25 * i;
        g.ior = 1.5;
        g.thickness = i > 0 ? 1 : 0;
        model_add_object(scene, g.name, model_add_material(scene, &g), place);
        place.x += pitch;
        place.y = pitch;
    }
    add_special_materials(scene, (glint_vec3){-2 * pitch, -pitch, 0}, pitch);
}

// The same three objects through a perspective and an orthographic camera, selected by name.
void build_orthographic(model *scene)
{
    glint_vec3 eye = {2.2, 1.8, 4};
    glint_vec3 target = {0.1, 0.1, 0};
    model_add_perspective(scene, "perspective", 32, eye, target);
    model_add_orthographic(scene, "orthographic", 1.35, eye, target);
    shape_sphere(model_add_geometry(scene, "sphere"), 0.6, 8);
    material silver = material_metal("silver", 0.972, 0.96, 0.915);
    model_add_object(scene, "mirror sphere", model_add_material(scene, &silver),
                     (glint_vec3){0, 0.1, 0});
    shape_chamfered_box(model_add_geometry(scene, "block"), (glint_vec3){0.4, 0.4, 0.4}, 0.05);
    material glass = material_glass("clear glass", 1.5);
    model_add_object(scene, "glass block", model_add_material(scene, &glass),
                     (glint_vec3){1.1, -0.1, 0.3});
    shape_box(model_add_geometry(scene, "column"), (glint_vec3){0, 0, 0},
              (glint_vec3){0.25, 0.7, 0.25});
    material paint = material_paint("matte red", 0.6, 0.08, 0.05, 1);
    model_add_object(scene, "matte column", model_add_material(scene, &paint),
                     (glint_vec3){-1.1, 0.2, -0.2});
}

// An open surface of water, seen from above and from below, so that light crosses one interface.
// From below, the whole world above lies within Snell's window; around it all light is reflected. A
// ball floats in the water, two lie in the depth.
void build_water(model *scene)
{
    model_add_perspective(scene, "above", 40, (glint_vec3){0, 2.2, 4.5}, (glint_vec3){0, -0.2, 0});
    model_add_perspective(scene, "below", 100, (glint_vec3){0.3, -1.6, 0.9},
                          (glint_vec3){0, 0.6, -0.6});
    shape_sheet(model_add_geometry(scene, "surface"), 40, 40);
    material water = material_glass("water", 1.333);
    water.attenuation_distance = 12;
    water.attenuation_color[0] = 0.55;
    water.attenuation_color[1] = 0.85;
    water.attenuation_color[2] = 0.9;
    model_add_object(scene, "water", model_add_material(scene, &water), (glint_vec3){0, 0, 0});

    shape_sphere(model_add_geometry(scene, "ball"), 0.4, 6);
    material orange = material_paint("orange", 0.85, 0.3, 0.04, 1);
    material white = material_paint("white", 0.8, 0.8, 0.78, 1);
    material silver = material_metal("silver", 0.972, 0.96, 0.915);
    model_add_object(scene, "floating ball", model_add_material(scene, &orange),
                     (glint_vec3){-0.5, 0.1, 0});
    model_add_object(scene, "white ball", model_add_material(scene, &white),
                     (glint_vec3){0.9, -1, -0.5});
    model_add_object(scene, "silver ball", model_add_material(scene, &silver),
                     (glint_vec3){-0.9, -0.9, -0.8});
}
