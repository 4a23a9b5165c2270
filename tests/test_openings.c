// Tests which solids are said to be inside out, open, or of several media.
#include "scene/shape/solids.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef enum stuff { GLASS, CRYSTAL, COPY, WATER, THIN, PAINT, LEAF, STUFFS } stuff;

// A growing scene of bare triangles.
typedef struct stage {
    glint_scene scene;
    glint_material materials[STUFFS];
    float positions[9 * 512];
    uint32_t material_of[512];
    glint_instance instances[64];
} stage;

static void begin(stage *s)
{
    *s = (stage){0};
    for (int i = 0; i < STUFFS; i++) {
        s->materials[i] =
            (glint_material){GLINT_MATERIAL_CLEAR, .mirror = -1, .transmission = 1,
                             .thickness = 1,       .alpha = 1,   .base_color = {1, 1, 1}};
    }
    s->materials[CRYSTAL].ior = 1.6F;
    s->materials[WATER].ior = 1.33F;
    s->materials[COPY].roughness = 0.5F;
    s->materials[THIN].thickness = 0;
    s->materials[PAINT].transmission = 0;
    s->materials[LEAF].transmission = 0;
    s->materials[LEAF].alpha_mode = GLINT_ALPHA_BLEND;
    s->materials[LEAF].alpha = 0.5F;
    s->scene = (glint_scene){.material_count = STUFFS,
                             .materials = s->materials,
                             .positions = s->positions,
                             .material_of = s->material_of,
                             .instances = s->instances,
                             .unit = 1};
}

static void begin_instance(stage *s, stuff of)
{
    s->instances[s->scene.instance_count++] =
        (glint_instance){.first_triangle = s->scene.triangle_count, .material = (uint32_t)of};
}

static void add_triangle(stage *s, const double corners[3][3])
{
    const size_t n = s->scene.triangle_count++;
    assert_true(n < 512);
    for (int i = 0; i < 9; i++) {
        s->positions[9 * n + (size_t)i] = (float)corners[i / 3][i % 3];
    }
    glint_instance *instance = &s->instances[s->scene.instance_count - 1];
    s->material_of[n] = instance->material;
    instance->triangle_count++;
}

// The corner of a box whose index has bits for x, y and z.
static void corner_of(const double low[3], const double high[3], int index, double at[3])
{
    for (int k = 0; k < 3; k++) {
        at[k] = (index >> k & 1) ? high[k] : low[k];
    }
}

enum { LEFT = 1, RIGHT = 2, BOTTOM = 4, TOP = 8, BACK = 16, FRONT = 32, ALL = 63 };

// Adds some faces of a box; `turned`: inside out.
static void add_faces(stage *s, const double low[3], const double high[3], int faces, bool turned)
{
    static const int quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                    {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (int f = 0; f < 6; f++) {
        for (int half = 0; (faces >> f & 1) && half < 2; half++) {
            double corners[3][3];
            corner_of(low, high, quads[f][0], corners[0]);
            corner_of(low, high, quads[f][half + 1], corners[turned ? 2 : 1]);
            corner_of(low, high, quads[f][half + 2], corners[turned ? 1 : 2]);
            add_triangle(s, corners);
        }
    }
}

static void add_box(stage *s, stuff of, double size, int faces, bool turned)
{
    const double low[3] = {-size, -size, -size};
    const double high[3] = {size, size, size};
    begin_instance(s, of);
    add_faces(s, low, high, faces, turned);
}

// A level rectangle of half the width, at a height.
static void add_sheet(stage *s, stuff of, double half, double height, bool turned)
{
    const double low[3] = {-half, height - 1, -half};
    const double high[3] = {half, height, half};
    begin_instance(s, of);
    add_faces(s, low, high, TOP, turned);
}

// ---- Scenes -------------------------------------------------------------------------------------

static void a_box(stage *s)
{
    add_box(s, GLASS, 0.5, ALL, false);
}

static void a_box_inside_out(stage *s)
{
    add_box(s, GLASS, 0.5, ALL, true);
}

static void a_hollow(stage *s)
{
    add_box(s, GLASS, 0.5, ALL, false);
    add_box(s, GLASS, 0.4, ALL, true);
}

static void a_hollow_of_a_copy(stage *s)
{
    add_box(s, GLASS, 0.5, ALL, false);
    add_box(s, COPY, 0.4, ALL, true);
}

static void water_inside_out_in_glass(stage *s)
{
    add_box(s, GLASS, 0.5, ALL, false);
    add_box(s, WATER, 0.4, ALL, true);
}

static void a_painted_box_inside_out(stage *s)
{
    add_box(s, PAINT, 0.5, ALL, true);
}

static void a_box_without_a_triangle(stage *s)
{
    add_box(s, GLASS, 0.5, ALL, false);
    s->scene.triangle_count--;
    s->instances[0].triangle_count--;
}

static void three_boxes_without_a_side(stage *s)
{
    for (int i = 0; i < 3; i++) {
        const double low[3] = {0.3 * i - 0.5, 0, 0};
        const double high[3] = {0.3 * i - 0.3, 0.2, 0.2};
        begin_instance(s, GLASS);
        add_faces(s, low, high, ALL - LEFT, false);
    }
}

static void a_box_without_a_lid(stage *s)
{
    add_box(s, GLASS, 0.5, ALL - TOP, false);
}

static void a_box_in_pieces(stage *s)
{
    for (int face = 1; face < ALL; face *= 2) {
        add_box(s, face == TOP ? COPY : GLASS, 0.5, face, false);
    }
}

static void a_box_of_two_glasses(stage *s)
{
    add_box(s, GLASS, 0.5, ALL - TOP, false);
    add_box(s, CRYSTAL, 0.5, TOP, false);
}

static void a_box_with_a_painted_lid(stage *s)
{
    add_box(s, GLASS, 0.5, ALL - TOP, false);
    add_box(s, PAINT, 0.5, TOP, false);
}

static void a_box_with_a_lid_of_leaves(stage *s)
{
    add_box(s, GLASS, 0.5, ALL - TOP, false);
    add_box(s, LEAF, 0.5, TOP, false);
}

static void a_box_with_a_thin_lid(stage *s)
{
    add_box(s, GLASS, 0.5, ALL - TOP, false);
    add_box(s, THIN, 0.5, TOP, false);
}

static void a_box_with_a_small_lid(stage *s)
{
    add_box(s, GLASS, 0.5, ALL - TOP, false);
    add_sheet(s, PAINT, 0.4, 0.5, false);
}

// A closed frame that shares its edges with the pane.
static void a_pane_in_a_frame(stage *s)
{
    const double low[3] = {-0.5, -0.5, -0.1};
    const double high[3] = {0.5, 0.5, 0.1};
    begin_instance(s, GLASS);
    add_faces(s, low, high, FRONT, false);
    begin_instance(s, PAINT);
    add_faces(s, (const double[3]){-0.6, -0.5, -0.1}, (const double[3]){-0.5, 0.5, 0.1}, ALL,
              false);
    add_faces(s, (const double[3]){0.5, -0.5, -0.1}, (const double[3]){0.6, 0.5, 0.1}, ALL, false);
    add_faces(s, (const double[3]){-0.5, 0.5, -0.1}, (const double[3]){0.5, 0.6, 0.1}, ALL, false);
    add_faces(s, (const double[3]){-0.5, -0.6, -0.1}, (const double[3]){0.5, -0.5, 0.1}, ALL,
              false);
}

static void an_upright_pane(stage *s)
{
    add_box(s, GLASS, 0.5, FRONT, false);
}

static void a_thin_pane(stage *s)
{
    add_box(s, THIN, 0.5, FRONT, false);
}

// Two coinciding faces, back to back: they hold nothing, and are closed.
static void a_pane_of_two_faces(stage *s)
{
    add_box(s, GLASS, 0.5, FRONT, false);
    add_box(s, GLASS, 0.5, FRONT, true);
}

static void water_alone(stage *s)
{
    add_sheet(s, WATER, 0.5, 0.1, false);
}

static void water_and_a_stone(stage *s)
{
    add_sheet(s, WATER, 0.5, 0.1, false);
    add_box(s, PAINT, 0.3, ALL, false);
}

static void water_that_faces_down(stage *s)
{
    add_sheet(s, WATER, 0.5, 0.1, true);
}

static void water_on_a_slope(stage *s)
{
    const double corners[2][3][3] = {{{-0.5, 0, 0.5}, {0.5, 0.2, 0.5}, {0.5, 0.2, -0.5}},
                                     {{-0.5, 0, 0.5}, {0.5, 0.2, -0.5}, {-0.5, 0, -0.5}}};
    begin_instance(s, WATER);
    add_triangle(s, corners[0]);
    add_triangle(s, corners[1]);
}

static void a_level_pane_above_a_floor(stage *s)
{
    add_sheet(s, GLASS, 0.5, 0.1, false);
    add_sheet(s, PAINT, 0.9, -0.5, false);
}

static void add_tub(stage *s, double inner)
{
    add_sheet(s, PAINT, 0.9, -0.5, false);
    begin_instance(s, PAINT);
    add_faces(s, (const double[3]){-inner, -0.4, -inner}, (const double[3]){inner, 0.3, inner},
              ALL - TOP, true);
}

static void water_that_fills_a_tub(stage *s)
{
    add_tub(s, 0.5);
    add_sheet(s, WATER, 0.5, 0.1, false);
}

static void water_smaller_than_its_tub(stage *s)
{
    add_tub(s, 0.6);
    add_sheet(s, WATER, 0.5, 0.1, false);
}

static void water_larger_than_its_tub(stage *s)
{
    add_tub(s, 0.4);
    add_sheet(s, WATER, 0.5, 0.1, false);
}

// The ground around the tub covers the water's edges.
static void water_under_the_ground(stage *s)
{
    add_tub(s, 0.4);
    begin_instance(s, PAINT);
    for (int side = 0; side < 4; side++) {
        const int axis = side / 2 * 2;
        double low[3] = {-0.8, 0, -0.8};
        double high[3] = {0.8, 0.3, 0.8};
        (side % 2 ? low : high)[axis] = side % 2 ? 0.4 : -0.4;
        add_faces(s, low, high, TOP, false);
    }
    add_sheet(s, WATER, 0.5, 0.1, false);
}

static void water_in_a_tub_of_glass(stage *s)
{
    add_sheet(s, PAINT, 0.9, -0.7, false);
    begin_instance(s, GLASS);
    add_faces(s, (const double[3]){-0.6, -0.6, -0.6}, (const double[3]){0.6, 0.3, 0.6}, ALL, false);
    add_faces(s, (const double[3]){-0.5, -0.5, -0.5}, (const double[3]){0.5, 0.2, 0.5}, ALL, true);
    add_sheet(s, WATER, 0.5, 0.1, false);
}

static const struct {
    const char *what;
    void (*build)(stage *s);
    size_t inside_out, open, mixed;
} cases[] = {
    {"a box", a_box, 0, 0, 0},
    {"a box inside out", a_box_inside_out, 1, 0, 0},
    {"a hollow", a_hollow, 0, 0, 0},
    {"a hollow of a copy of the material", a_hollow_of_a_copy, 0, 0, 0},
    {"water inside out in glass", water_inside_out_in_glass, 1, 0, 0},
    {"a painted box inside out", a_painted_box_inside_out, 0, 0, 0},
    {"a box without a triangle", a_box_without_a_triangle, 0, 1, 0},
    {"three boxes without a side", three_boxes_without_a_side, 0, 3, 0},
    {"a box without a lid", a_box_without_a_lid, 0, 1, 0},
    {"a box in pieces", a_box_in_pieces, 0, 0, 0},
    {"a box of two glasses", a_box_of_two_glasses, 0, 0, 1},
    {"a box with a painted lid", a_box_with_a_painted_lid, 0, 0, 0},
    {"a box with a lid of leaves", a_box_with_a_lid_of_leaves, 0, 1, 0},
    {"a box with a thin lid", a_box_with_a_thin_lid, 0, 1, 0},
    {"a box with a small lid", a_box_with_a_small_lid, 0, 1, 0},
    {"a pane in a frame", a_pane_in_a_frame, 0, 1, 0},
    {"an upright pane", an_upright_pane, 0, 1, 0},
    {"a thin pane", a_thin_pane, 0, 0, 0},
    {"a pane of two faces", a_pane_of_two_faces, 0, 0, 0},
    {"water alone", water_alone, 0, 0, 0},
    {"water and a stone", water_and_a_stone, 0, 0, 0},
    {"water that faces down", water_that_faces_down, 0, 1, 0},
    {"water on a slope", water_on_a_slope, 0, 1, 0},
    {"a level pane above a floor", a_level_pane_above_a_floor, 0, 1, 0},
    {"water that fills a tub", water_that_fills_a_tub, 0, 0, 0},
    {"water smaller than its tub", water_smaller_than_its_tub, 0, 1, 0},
    {"water larger than its tub", water_larger_than_its_tub, 0, 1, 0},
    {"water under the ground", water_under_the_ground, 0, 0, 0},
    {"water in a tub of glass", water_in_a_tub_of_glass, 0, 1, 0},
};

static void faults_are_said_and_nothing_else(void **state)
{
    (void)state;
    stage *s = malloc(sizeof *s);
    assert_non_null(s);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        begin(s);
        cases[i].build(s);
        glint_topology topology;
        glint_solids solids;
        glint_solids_remarks remarks;
        print_message("%s\n", cases[i].what);
        assert_int_equal(glint_topology_find(&s->scene, &topology, NULL), GLINT_OK);
        assert_int_equal(glint_solids_find(&s->scene, &topology, &solids, NULL), GLINT_OK);
        glint_solids_remark(&s->scene, &topology, &solids, &remarks);
        assert_int_equal(solids.faults.inside_out.count, cases[i].inside_out);
        assert_int_equal(solids.faults.open.count, cases[i].open);
        assert_int_equal(solids.faults.mixed.count, cases[i].mixed);
        assert_int_equal(remarks.inside_out[0] != '\0', cases[i].inside_out > 0);
        assert_int_equal(remarks.open[0] != '\0', cases[i].open > 0);
        assert_int_equal(remarks.mixed[0] != '\0', cases[i].mixed > 0);
        glint_solids_free(&solids);
        glint_topology_free(&topology);
    }
    free(s);
}

static void the_first_is_named_and_the_others_counted(void **state)
{
    (void)state;
    stage *s = malloc(sizeof *s);
    assert_non_null(s);
    char glass[] = "glass";
    begin(s);
    add_box(s, PAINT, 0.9, ALL, false);
    three_boxes_without_a_side(s);
    s->materials[GLASS].name = glass;
    s->instances[1].node = "vase";
    s->instances[1].node_index = 4;
    glint_topology topology;
    glint_solids solids;
    glint_solids_remarks remarks;
    assert_int_equal(glint_topology_find(&s->scene, &topology, NULL), GLINT_OK);
    assert_int_equal(glint_solids_find(&s->scene, &topology, &solids, NULL), GLINT_OK);
    glint_solids_remark(&s->scene, &topology, &solids, &remarks);
    assert_string_equal(remarks.open, "\"vase\" (node 4, glass) and 2 more solids are");
    assert_string_equal(remarks.inside_out, "");
    glint_solids_free(&solids);
    glint_topology_free(&topology);
    free(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(faults_are_said_and_nothing_else),
        cmocka_unit_test(the_first_is_named_and_the_others_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
