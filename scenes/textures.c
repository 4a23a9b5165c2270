// Builds a scene with one object for each use of textures, vertex colours and alpha.
#include "scenes.h"
#include "shapes.h"

#include <stdlib.h>

// ---- Pictures ----------------------------------------------------------------------------------

static void set(double *value, double r, double g, double b)
{
    value[0] = r;
    value[1] = g;
    value[2] = b;
}

// Two by two fields.
static void draw_checker(double u, double v, double *value)
{
    const bool is_light = (u < 0.5) == (v < 0.5);
    set(value, is_light ? 0.82 : 0.22, is_light ? 0.8 : 0.25, is_light ? 0.76 : 0.3);
}

// Normals of a round dimple: height −0.3·(1 − r²/R²)², with R = 0.9 of half the picture.
static void draw_dimple(double u, double v, double *value)
{
    const double x = 2 * u - 1, down = 2 * v - 1;
    const double inside = 1 - (x * x + down * down) / 0.81;
    const double slope = inside > 0 ? 4 * 0.3 / 0.81 * inside : 0;
    // Green points up in the picture, while v runs down.
    const glint_vec3 n = glint_vec3_normalize((glint_vec3){-slope * x, slope * down, 1});
    set(value, 0.5 + 0.5 * n.x, 0.5 + 0.5 * n.y, 0.5 + 0.5 * n.z);
}

// Slanted stripes: metal in one half of each period. Blue is metallic, green roughness.
static void draw_stripes(double u, double v, double *value)
{
    set(value, 0, 1, fmod(u + v, 1) < 0.5);
}

// A window of a paper lamp between dark ribs.
static void draw_window(double u, double v, double *value)
{
    const bool is_lit = fabs(u - 0.5) < 0.4 && fabs(v - 0.5) < 0.4;
    set(value, is_lit ? 1 : 0.15, is_lit ? 0.72 : 0.06, is_lit ? 0.34 : 0.02);
}

// A leaf on its stem, with veins and an eaten hole. Its transparent texels are green as well, so
// that the edge does not turn dark.
static void draw_leaf(double u, double v, double *value)
{
    const double x = fabs(2 * u - 1), along = (1 - v - 0.16) / 0.8;
    const bool is_vein = x < 0.04 || fmod(6 * along - 2.4 * x, 1) < 0.16;
    const double blade = along > 0 && along < 1 ? 3.1 * along * (1 - along) * (1.45 - along) : 0;
    const double hole = hypot(u - 0.66, v - 0.5) - 0.07; // below 0 inside
    set(value, is_vein ? 0.62 : 0.22, is_vein ? 0.76 : 0.52, is_vein ? 0.34 : 0.14);
    value[3] = fmin(fmax(0.5 + 16 * fmin(fmax(blade, along < 0.5 ? 0.05 : 0) - x, 2 * hole), 0), 1);
}

// Leaded glass: coloured lozenges of alpha ½ in opaque lead.
static void draw_leaded(double u, double v, double *value)
{
    static const double colors[3][3] = {{0.85, 0.2, 0.15}, {0.15, 0.45, 0.85}, {0.95, 0.75, 0.2}};
    const double a = 3 * (u + v), b = 3 * (u - v) + 3;
    const bool is_lead =
        fmin(fmod(a, 1), fmod(b, 1)) < 0.12 || fmax(fabs(u - 0.5), fabs(v - 0.5)) > 0.47;
    const double *color = colors[((int)a + 2 * (int)b) % 3];
    set(value, is_lead ? 0.2 : color[0], is_lead ? 0.2 : color[1], is_lead ? 0.22 : color[2]);
    value[3] = is_lead ? 1 : 0.5;
}

// ---- Shapes ------------------------------------------------------------------------------------

// A sphere of radius 0.6 in meridians and parallels, with its texture once around it. The first
// meridian has its vertices twice, with u = 0 and u = 1.
static void add_globe(model *scene)
{
    enum { COLUMNS = 64, ROWS = 32 };
    mesh *m = model_add_geometry(scene, "globe");
    coat *c = &scene->geometries[scene->geometry_count - 1].coat;
    c->texcoords = calloc((size_t)(COLUMNS + 1) * (ROWS + 1), sizeof *c->texcoords);
    m->failed = c->texcoords == NULL;
    for (int i = 0; !m->failed && i < (COLUMNS + 1) * (ROWS + 1); i++) {
        const int column = i % (COLUMNS + 1), row = i / (COLUMNS + 1);
        const double u = (double)column / COLUMNS, v = (double)row / ROWS;
        const double east = 2 * GLINT_PI * u, ring = sin(GLINT_PI * v);
        const glint_vec3 out = {ring * sin(east), cos(GLINT_PI * v), ring * cos(east)};
        mesh_add_vertex(m, glint_vec3_scale(out, 0.6), out);
        c->texcoords[i][0] = u;
        c->texcoords[i][1] = v;
    }
    for (uint32_t i = 0; i < COLUMNS * ROWS; i++) {
        const uint32_t upper = i / COLUMNS * (COLUMNS + 1) + i % COLUMNS;
        const uint32_t lower = upper + COLUMNS + 1;
        mesh_add_quad(m, lower, lower + 1, upper + 1, upper);
    }
}

// A sheet that shows its texture once, upright if seen from +z.
static void add_sheet(model *scene, const char *name, double half_x, double half_z)
{
    mesh *m = model_add_geometry(scene, name);
    coat *c = &scene->geometries[scene->geometry_count - 1].coat;
    shape_sheet(m, half_x, half_z);
    c->texcoords = calloc(4, sizeof *c->texcoords);
    m->failed = m->failed || c->texcoords == NULL;
    for (int i = 0; !m->failed && i < 4; i++) {
        c->texcoords[i][0] = i == 1 || i == 2;
        c->texcoords[i][1] = i < 2;
    }
}

// ---- The scene ---------------------------------------------------------------------------------

static texture add_map(model *scene, picture p, double across, double down)
{
    return (texture){model_add_picture(scene, &p), {across, down}};
}

static void add_globes(model *scene)
{
    add_globe(scene);
    material dimpled = material_metal("dimpled chrome", 0.92, 0.92, 0.93);
    dimpled.normal_map = add_map(scene, (picture){"dimple", 32, 3, false, draw_dimple}, 16, 8);
    model_add_object(scene, "dimpled globe", model_add_material(scene, &dimpled),
                     (glint_vec3){-1.3, 0.601, -0.1});

    material striped = material_metal("copper and paint", 0.95, 0.5, 0.34);
    striped.metallic_roughness_map =
        add_map(scene, (picture){"stripes", 32, 3, false, draw_stripes}, 6, 3);
    model_add_object(scene, "striped globe", model_add_material(scene, &striped),
                     (glint_vec3){0.05, 0.601, -0.6});

    material lamp = material_paint("lamp", 0.1, 0.08, 0.06, 1);
    set(lamp.emission, 1, 1, 1);
    lamp.emissive_strength = 2.5;
    lamp.emission_map = add_map(scene, (picture){"window", 16, 3, false, draw_window}, 8, 4);
    model_add_object(scene, "lamp", model_add_material(scene, &lamp), (glint_vec3){0.1, 0.271, 0.8})
        ->scale = 0.45;
}

static void stand_up(node *sheet, double turn)
{
    double upright[4], turned[4];
    rotation_about((glint_vec3){1, 0, 0}, 90, upright);
    rotation_about((glint_vec3){0, 1, 0}, turn, turned);
    rotation_compose(turned, upright, sheet->rotation);
}

static void add_sheets(model *scene)
{
    add_sheet(scene, "floor", 2.4, 2.4);
    material tiles = material_paint("tiles", 1, 1, 1, 0);
    tiles.base_color_map = add_map(scene, (picture){"checker", 2, 3, true, draw_checker}, 6, 6);
    model_add_object(scene, "floor", model_add_material(scene, &tiles), (glint_vec3){0, 0, 0});

    add_sheet(scene, "leaf", 0.3, 0.36);
    material leaf = material_paint("leaf", 1, 1, 1, 1);
    leaf.base_color_map = add_map(scene, (picture){"leaf", 64, 4, false, draw_leaf}, 0, 0);
    leaf.alpha_mode = "MASK";
    leaf.double_sided = true;
    const int green = model_add_material(scene, &leaf);
    for (int i = 0; i < 3; i++) {
        const glint_vec3 place = {-0.95 + 0.38 * i, 0.36, i == 1 ? 1.2 : 1};
        stand_up(model_add_object(scene, "leaf", green, place), 35 * (1 - i));
    }

    add_sheet(scene, "pane", 0.5, 0.5);
    material leaded = material_paint("leaded glass", 1, 1, 1, 0);
    leaded.base_color_map = add_map(scene, (picture){"leaded", 64, 4, false, draw_leaded}, 0, 0);
    leaded.alpha_mode = "BLEND";
    leaded.double_sided = true;
    stand_up(model_add_object(scene, "pane", model_add_material(scene, &leaded),
                              (glint_vec3){1.4, 0.502, 0.85}),
             -18);
}

// A box whose vertex colours are the places of its corners: black, red, green, blue, and their
// sums.
static void add_color_box(model *scene)
{
    mesh *m = model_add_geometry(scene, "color box");
    coat *c = &scene->geometries[scene->geometry_count - 1].coat;
    shape_box(m, (glint_vec3){0, 0, 0}, (glint_vec3){0.4, 0.4, 0.4});
    c->colors = calloc(m->vertex_count, sizeof *c->colors);
    m->failed = m->failed || c->colors == NULL;
    for (size_t i = 0; !m->failed && i < m->vertex_count; i++) {
        set(c->colors[i], m->positions[i].x > 0, m->positions[i].y > 0, m->positions[i].z > 0);
    }
    material plain = material_paint("colors of vertices", 1, 1, 1, 1);
    node *box = model_add_object(scene, "color box", model_add_material(scene, &plain),
                                 (glint_vec3){1.15, 0.401, -0.5});
    rotation_about((glint_vec3){0, 1, 0}, -35, box->rotation);
}

void build_textures(model *scene)
{
    model_add_perspective(scene, "main", 30, (glint_vec3){0.1, 1.6, 5}, (glint_vec3){0, 0.45, 0});
    add_sheets(scene);
    add_globes(scene);
    add_color_box(scene);
}
