// Builds scenes of one solid, or of nested solids, which show refraction and absorption alone.
#include "scenes.h"
#include "shapes.h"

static void set_attenuation(material *m, double distance, double r, double g, double b)
{
    m->attenuation_distance = distance;
    m->attenuation_color[0] = r;
    m->attenuation_color[1] = g;
    m->attenuation_color[2] = b;
}

void build_mirror_sphere(model *scene)
{
    model_add_perspective(scene, "front", 30, (glint_vec3){0, 0, 5}, (glint_vec3){0, 0, 0});
    shape_sphere(model_add_geometry(scene, "sphere"), 1, 32);
    material silver = material_metal("silver", 0.972, 0.96, 0.915);
    model_add_object(scene, "mirror sphere", model_add_material(scene, &silver),
                     (glint_vec3){0, 0, 0});
}

void build_glass_sphere(model *scene)
{
    model_add_perspective(scene, "front", 30, (glint_vec3){0, 0, 5}, (glint_vec3){0, 0, 0});
    shape_sphere(model_add_geometry(scene, "sphere"), 1, 10);
    material glass = material_glass("clear glass", 1.5);
    model_add_object(scene, "glass sphere", model_add_material(scene, &glass),
                     (glint_vec3){0, 0, 0});
}

void build_glass_slab(model *scene)
{
    model_add_perspective(scene, "oblique", 32, (glint_vec3){1.6, 1.9, 3.6}, (glint_vec3){0, 0, 0});
    shape_box(model_add_geometry(scene, "slab"), (glint_vec3){0, 0, 0}, (glint_vec3){1, 0.1, 1});
    material glass = material_glass("clear glass", 1.5);
    model_add_object(scene, "glass slab", model_add_material(scene, &glass), (glint_vec3){0, 0, 0});
}

void build_prism(model *scene)
{
    model_add_perspective(scene, "front", 32, (glint_vec3){1.3, 0.9, 3.6}, (glint_vec3){0, 0, 0});
    // Edges of 1 m around the middle of the triangle: in-circle 1/√12, circumcircle 1/√3.
    const double foot = -1 / sqrt(12.0);
    const double outline[3][2] = {{-0.5, foot}, {0.5, foot}, {0, 1 / sqrt(3.0)}};
    shape_prism(model_add_geometry(scene, "equilateral prism"), outline, 3, 0.9);
    material glass = material_glass("clear glass", 1.5);
    node *prism =
        model_add_object(scene, "prism", model_add_material(scene, &glass), (glint_vec3){0, 0, 0});
    rotation_about((glint_vec3){0, 1, 0}, 55, prism->rotation);
}

// Air within water within glass. Each sphere is a solid, entered from the solid around it, so the
// surface of the water is also the inner surface of the glass.
void build_nested_glass(model *scene)
{
    model_add_perspective(scene, "front", 30, (glint_vec3){0, 0.8, 5}, (glint_vec3){0, 0, 0});
    shape_sphere(model_add_geometry(scene, "sphere"), 1, 5);
    material glass = material_glass("glass", 1.5);
    model_add_object(scene, "glass shell", model_add_material(scene, &glass),
                     (glint_vec3){0, 0, 0});

    material water = material_glass("water", 1.33);
    set_attenuation(&water, 1.2, 0.35, 0.75, 0.85);
    model_add_object(scene, "water", model_add_material(scene, &water), (glint_vec3){0, 0, 0})
        ->scale = 0.9;

    material air = material_glass("air", 1);
    model_add_object(scene, "air bubble", model_add_material(scene, &air),
                     (glint_vec3){0.3, 0.35, 0.2})
        ->scale = 0.25;
}

// Thin walls do not refract: objects behind the panes do not shift.
void build_thin_wall(model *scene)
{
    model_add_perspective(scene, "oblique", 32, (glint_vec3){1.3, 0.7, 4.6}, (glint_vec3){0, 0, 0});
    shape_sphere(model_add_geometry(scene, "sphere"), 1, 6);
    material film = material_thin("soap film", 1.33);
    model_add_object(scene, "bubble", model_add_material(scene, &film), (glint_vec3){0.85, 0, 0.4})
        ->scale = 0.55;
    material paint = material_paint("matte orange", 0.7, 0.25, 0.04, 1);
    model_add_object(scene, "matte ball", model_add_material(scene, &paint),
                     (glint_vec3){-0.3, -0.05, -0.9})
        ->scale = 0.5;

    shape_sheet(model_add_geometry(scene, "pane"), 0.75, 0.75);
    material clear = material_thin("window glass", 1.5);
    node *pane = model_add_object(scene, "clear pane", model_add_material(scene, &clear),
                                  (glint_vec3){-0.9, 0, 0.1});
    rotation_about((glint_vec3){1, 0, 0}, 50, pane->rotation); // leans back, towards the light
    material amber = material_thin("amber window", 1.5);
    amber.base_color[1] = 0.55;
    amber.base_color[2] = 0.12;
    pane = model_add_object(scene, "amber pane", model_add_material(scene, &amber),
                            (glint_vec3){0.1, 0.1, -0.2});
    double upright[4];
    double turn[4];
    rotation_about((glint_vec3){1, 0, 0}, 90, upright);
    rotation_about((glint_vec3){0, 1, 0}, 35, turn);
    rotation_compose(turn, upright, pane->rotation);
}

// A block of coloured glass on chequered tiles. The tiles are boxes with a joint between them, so
// that no two faces coincide.
void build_absorption_box(model *scene)
{
    model_add_perspective(scene, "oblique", 32, (glint_vec3){1.7, 2.4, 4.3},
                          (glint_vec3){0, 0.2, 0});
    const int across = 6;
    const double pitch = 0.5;
    for (int color = 0; color < 2; color++) {
        mesh *tiles = model_add_geometry(scene, color ? "dark tiles" : "light tiles");
        for (int i = 0; i < across * across; i++) {
            int column = i % across;
            int row = i / across;
            if ((column + row) % 2 == color) {
                glint_vec3 centre = {(column - 0.5 * (across - 1)) * pitch, -0.05,
                                     (row - 0.5 * (across - 1)) * pitch};
                shape_box(tiles, centre,
                          (glint_vec3){0.5 * pitch - 0.01, 0.05, 0.5 * pitch - 0.01});
            }
        }
        material paint = color ? material_paint("dark tile", 0.06, 0.06, 0.07, 1)
                               : material_paint("light tile", 0.8, 0.78, 0.74, 1);
        model_add_object(scene, color ? "dark tiles" : "light tiles",
                         model_add_material(scene, &paint), (glint_vec3){0, 0, 0});
    }
    shape_box(model_add_geometry(scene, "block"), (glint_vec3){0, 0, 0},
              (glint_vec3){0.8, 0.3, 0.5});
    material ruby = material_glass("ruby glass", 1.52);
    set_attenuation(&ruby, 0.5, 0.75, 0.08, 0.12);
    node *block = model_add_object(scene, "glass block", model_add_material(scene, &ruby),
                                   (glint_vec3){0, 0.301, 0});
    rotation_about((glint_vec3){0, 1, 0}, 20, block->rotation);
}

// The inside of the bowl. The wine shares it with the glass, vertex by vertex.
static const double bowl[2] = {0, 0.75};
#define BOWL_RADIUS 0.27
#define BOWL_STEP 5   // degrees
#define BOWL_RIM 55   // degrees above the middle
#define WINE_LEVEL 10 // degrees above the middle

static void add_goblet(model *scene)
{
    profile p = {0};
    profile_line(&p, 0, 0, 0.22, 0);
    profile_arc(&p, (const double[2]){0.22, 0.01}, 0.01, (const double[2]){-90, 80}, 6);
    profile_curve(&p, (const double[3][2]){{0.03, 0.04}, {0.03, 0.12}, {0.03, 0.3}}, 12);
    profile_curve(&p, (const double[3][2]){{0.03, 0.42}, {0.06, 0.46}, {0.1, 0.476}}, 8);
    profile_arc(&p, bowl, BOWL_RADIUS + 0.02, (const double[2]){-70, BOWL_RIM}, 25);
    const double angle = BOWL_RIM * GLINT_PI / 180;
    const double middle = BOWL_RADIUS + 0.01;
    profile_arc(&p, (const double[2]){middle * cos(angle), bowl[1] + middle * sin(angle)}, 0.01,
                (const double[2]){BOWL_RIM, BOWL_RIM + 180}, 8);
    profile_arc(&p, bowl, BOWL_RADIUS, (const double[2]){BOWL_RIM, -90},
                (BOWL_RIM + 90) / BOWL_STEP);
    shape_revolve(model_add_geometry(scene, "goblet"), &p, 64);
    material glass = material_glass("glass", 1.5);
    model_add_object(scene, "goblet", model_add_material(scene, &glass), (glint_vec3){0, 0, 0});
}

// A goblet on a table, with wine in it and ice in the wine. The glass stands on the table, the wine
// touches the glass all around, and the ice is partly above the wine.
void build_wine(model *scene)
{
    model_add_perspective(scene, "front", 26, (glint_vec3){0.4, 1.25, 2.6},
                          (glint_vec3){0, 0.5, 0});
    add_goblet(scene);

    profile p = {0};
    profile_arc(&p, bowl, BOWL_RADIUS, (const double[2]){-90, WINE_LEVEL},
                (WINE_LEVEL + 90) / BOWL_STEP);
    const double angle = WINE_LEVEL * GLINT_PI / 180;
    const double level = bowl[1] + BOWL_RADIUS * sin(angle);
    profile_line(&p, BOWL_RADIUS * cos(angle), level, 0, level);
    shape_revolve(model_add_geometry(scene, "wine"), &p, 64);
    material red = material_glass("wine", 1.34);
    set_attenuation(&red, 0.12, 0.62, 0.06, 0.09);
    model_add_object(scene, "wine", model_add_material(scene, &red), (glint_vec3){0, 0, 0});

    shape_chamfered_box(model_add_geometry(scene, "ice"), (glint_vec3){0.075, 0.07, 0.08}, 0.012);
    material ice = material_glass("ice", 1.31);
    const int number = model_add_material(scene, &ice);
    node *cube = model_add_object(scene, "ice", number, (glint_vec3){0.09, level - 0.01, 0.04});
    rotation_about((glint_vec3){0.6, 0, 0.8}, 25, cube->rotation);
    cube = model_add_object(scene, "ice below", number, (glint_vec3){-0.09, level - 0.05, -0.05});
    rotation_about((glint_vec3){0.36, 0.8, -0.48}, 55, cube->rotation);

    shape_box(model_add_geometry(scene, "table"), (glint_vec3){0, -0.05, 0},
              (glint_vec3){1.2, 0.05, 1.2});
    material oak = material_paint("table", 0.42, 0.27, 0.14, 0.6);
    model_add_object(scene, "table", model_add_material(scene, &oak), (glint_vec3){0, 0, 0});
}
