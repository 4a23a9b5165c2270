// Tests that it does not matter how a file cuts its solids into primitives: to their topology,
// their media, and the picture.
#include "support/bodies.h"
#include "support/bridge.h"
#include "support/cut.h"
#include "support/render.h"

#include "scene/shape/solids.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#define CUTS 8

// Ways to cut: in few pieces or in many, in runs or scattered, with one material or with copies.
static cut cut_of(int way)
{
    return (cut){.pieces = way & 4 ? 12 : 3, .scattered = way & 1, .recolored = way & 2};
}

// Bodies that overlap, nest, touch, and look alike.
static const bodies kinds[] = {
    {.what = "ice half in glass",
     .of = {{{-0.6, -0.5, -0.6}, {0.6, 0.1, 0.6}, GLASS, 2, 0, false},
            {{-0.3, -0.2, -0.3}, {0.2, 0.4, 0.25}, ICE, 3, 0, false}}},
    {.what = "glass beside water, both with ice in them",
     .of = {{{-0.6, -0.4, -0.4}, {0, 0.4, 0.4}, GLASS, 3, 0, false},
            {{0, -0.4, -0.4}, {0.4, 0.4, 0.4}, WATER, 3, 0, false},
            {{-0.2, -0.2, -0.2}, {0.3, 0.6, 0.2}, ICE, 2, 0, false}}},
    {.what = "a hollow glass with water that shares its faces, and ice in both",
     .of = {{{-0.6, -0.6, -0.6}, {0.6, 0.6, 0.6}, GLASS, 2, 1, false},
            {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, GLASS, 2, 1, true},
            {{-0.5, -0.5, -0.5}, {0.5, 0.1, 0.5}, WATER, 3, 0, false},
            {{-0.55, -0.2, -0.2}, {0.1, 0.3, 0.2}, ICE, 2, 0, false}}},
    {.what = "ice that the file ranks, and metal",
     .of = {{{-0.6, -0.5, -0.6}, {0.6, 0.1, 0.6}, WATER, 2, 0, false},
            {{-0.3, -0.2, -0.3}, {0.2, 0, 0.25}, ICE, 2, 0, false},
            {{-0.6, -0.7, -0.6}, {0.6, -0.5, 0.6}, METAL, 2, 0, false}},
     .priorities = {[ICE] = -2, [WATER] = -1}},
    // Solids of one material that meet are one block. Copies of the material would be two.
    {.what = "boxes of one glass that overlap",
     .of = {{{-0.6, -0.4, -0.4}, {0.2, 0.4, 0.4}, GLASS, 2, 0, false},
            {{-0.1, -0.3, -0.2}, {0.6, 0.5, 0.3}, GLASS, 3, 0, false}}},
    {.what = "boxes of one glass, and ice, that share whole faces",
     .of = {{{-0.6, -0.4, -0.4}, {0, 0.4, 0.4}, GLASS, 3, 0, false},
            {{0, -0.4, -0.4}, {0.4, 0.4, 0.4}, GLASS, 3, 0, false},
            {{0.4, -0.4, -0.4}, {0.6, 0.4, 0.4}, ICE, 3, 0, false}}},
    {.what = "boxes with an edge in common, and ice in one",
     .of = {{{-0.6, -0.6, -0.4}, {0, 0, 0.4}, GLASS, 2, 0, false},
            {{0, 0, -0.4}, {0.5, 0.5, 0.4}, GLASS, 2, 0, false},
            {{-0.35, -0.2, -0.3}, {-0.1, 0.2, 0.3}, ICE, 3, 0, false}}},
    // Which triangle belongs to which of two equal bodies does not matter, and cannot be told.
    {.what = "the same place twice, and ice in it",
     .of = {{{-0.6, -0.4, -0.4}, {0.6, 0.4, 0.4}, GLASS, 2, 0, false},
            {{-0.6, -0.4, -0.4}, {0.6, 0.4, 0.4}, GLASS, 2, 0, false},
            {{-0.3, -0.2, -0.3}, {0.2, 0.6, 0.25}, ICE, 3, 0, false}}},
};
#define KINDS ((int)(sizeof kinds / sizeof *kinds))
#define RECOLORED 4 // the first ones may be cut into copies of their materials
#define EQUAL (KINDS - 1)

// ---- Topology -----------------------------------------------------------------------------------

typedef struct found {
    glint_topology topology;
    glint_solids solids;
} found;

static found find(const glint_scene *scene)
{
    found f;
    assert_int_equal(glint_topology_find(scene, &f.topology, NULL), GLINT_OK);
    assert_int_equal(glint_solids_find(scene, &f.topology, &f.solids, NULL), GLINT_OK);
    return f;
}

static void let_go(found *f)
{
    glint_solids_free(&f->solids);
    glint_topology_free(&f->topology);
}

static bool is_solid(const glint_scene *scene, size_t triangle)
{
    return glint_material_lobes(&scene->materials[scene->material_of[triangle]]).solid;
}

static void assert_alike(const glint_component *a, const glint_component *b)
{
    assert_int_equal(a->triangle_count, b->triangle_count);
    assert_int_equal(a->boundary_edges, b->boundary_edges);
    assert_int_equal(a->closed, b->closed);
    assert_int_equal(a->simple, b->simple);
    assert_int_equal(a->convex, b->convex);
    assert_true(fabs(a->volume - b->volume) <= 1e-12 * fabs(a->volume));
    for (int k = 0; k < 3; k++) {
        assert_true(a->low[k] == b->low[k] && a->high[k] == b->high[k]);
    }
}

// Asserts that solids of different media yield to each other as before. Copies of a material may
// have media of their own.
static void assert_same_order(const found *whole, const found *parts, const size_t *origin,
                              size_t triangles)
{
    const size_t media = whole->solids.medium_count + 1;
    uint32_t *least = calloc(media, sizeof *least);
    uint32_t *most = calloc(media, sizeof *most);
    assert_non_null(least);
    assert_non_null(most);
    for (size_t t = 0; t < triangles; t++) {
        const uint32_t own = parts->solids.of_triangle[t].medium & ~GLINT_SOLID_TOUCHES;
        const uint32_t of = whole->solids.of_triangle[origin[t]].medium & ~GLINT_SOLID_TOUCHES;
        assert_true((own == 0) == (of == 0));
        least[of] = least[of] == 0 || own < least[of] ? own : least[of];
        most[of] = own > most[of] ? own : most[of];
    }
    for (size_t i = 2; i < media; i++) {
        assert_true(most[i - 1] < least[i]);
    }
    free(least);
    free(most);
}

// Compares the components and media of a scene's solids with those of its pieces. `are_equal`: some
// solids are in the same place, and look alike.
static void assert_same_solids(const glint_scene *scene, const glint_scene *pieces,
                               const size_t *origin, bool are_equal)
{
    found whole = find(scene);
    found parts = find(pieces);
    uint32_t *counterpart = calloc(parts.topology.component_count + 1, sizeof *counterpart);
    assert_non_null(counterpart); // 1 + the whole scene's component
    for (size_t t = 0; t < pieces->triangle_count; t++) {
        const uint32_t own = parts.topology.component_of[t];
        const uint32_t other = whole.topology.component_of[origin[t]];
        if (!is_solid(pieces, t)) {
            continue;
        }
        if (counterpart[own] == 0) {
            counterpart[own] = other + 1;
            assert_alike(&parts.topology.components[own], &whole.topology.components[other]);
        }
        assert_true(are_equal || counterpart[own] == other + 1);
    }
    assert_same_order(&whole, &parts, origin, pieces->triangle_count);
    assert_int_equal(parts.solids.component_count, whole.solids.component_count);
    assert_int_equal(parts.solids.contact_count, whole.solids.contact_count);
    assert_int_equal(parts.solids.faults.open.count, whole.solids.faults.open.count);
    assert_int_equal(parts.solids.faults.inside_out.count, whole.solids.faults.inside_out.count);
    assert_int_equal(parts.solids.faults.mixed.count, 0);
    free(counterpart);
    let_go(&whole);
    let_go(&parts);
}

static void assert_cuts_change_no_solid(const char *what, const glint_scene *scene, bool recolors,
                                        bool are_equal)
{
    print_message("%s\n", what);
    for (int way = 0; way < 3 * CUTS; way++) {
        cut how = cut_of(way);
        how.recolored = how.recolored && recolors;
        size_t *origin;
        glint_scene pieces = cut_scene(scene, &how, (uint64_t)way, &origin);
        assert_same_solids(scene, &pieces, origin, are_equal);
        glint_scene_free(&pieces);
        free(origin);
    }
}

static const char *const scenes[] = {"wine", "nested_glass", "absorption_box", "gallery", "water"};
#define SCENES ((int)(sizeof scenes / sizeof *scenes))

static void solids_are_the_same_in_pieces(void **state)
{
    (void)state;
    for (int i = 0; i < 2 * KINDS; i++) {
        glint_scene scene = bodies_scene(&kinds[i / 2], i % 2 ? 0.7 : 0, false);
        assert_cuts_change_no_solid(kinds[i / 2].what, &scene, i / 2 < RECOLORED, i / 2 == EQUAL);
        glint_scene_free(&scene);
    }
    for (int i = 0; i < SCENES; i++) {
        glint_scene scene;
        test_scene_load(scenes[i], &scene);
        assert_cuts_change_no_solid(scenes[i], &scene, true, false);
        glint_scene_free(&scene);
    }
}

// ---- Pictures -----------------------------------------------------------------------------------

// The largest difference between two pictures of one scene whose triangles stand in another order.
// A ray that meets a common edge of two triangles at one distance meets the lower number. Then
// other corners are interpolated: a few roundings, which every surface of curved glass multiplies.
#define OF_ORDER 1e-5

static void assert_cuts_change_no_picture(const char *what, const glint_scene *scene, bool recolors,
                                          const glint_settings *settings)
{
    glint_environment environment;
    bridge_direction_environment(32, &environment);
    test_frame whole;
    test_render(scene, &environment, NULL, settings, &whole);
    for (int way = 0; way < CUTS; way++) {
        cut how = cut_of(way);
        how.recolored = how.recolored && recolors;
        glint_scene pieces = cut_scene(scene, &how, (uint64_t)way, NULL);
        test_frame frame;
        test_render(&pieces, &environment, NULL, settings, &frame);
        const size_t different = test_count_different(&frame.image, &whole.image);
        double most = 0;
        for (int i = 0; i < 4 * settings->width * settings->height; i++) {
            most = fmax(most, fabs(frame.exact[i] - whole.exact[i]));
        }
        print_message("%s, %d pieces%s%s: %zu pixels differ, by %.3g\n", what, how.pieces,
                      how.scattered ? ", scattered" : "", how.recolored ? ", recolored" : "",
                      different, most);
        assert_true(most <= OF_ORDER);
        assert_true(how.scattered || different == 0);
        test_frame_free(&frame);
        glint_scene_free(&pieces);
    }
    test_frame_free(&whole);
    glint_environment_free(&environment);
}

static glint_settings picture(int depth, glint_precision precision)
{
    glint_settings settings = test_small_frame(depth);
    settings.precision = precision;
    return settings;
}

static void pictures_are_the_same_in_pieces(void **state)
{
    (void)state;
    const glint_settings single = picture(12, GLINT_PRECISION_FLOAT);
    const glint_settings exact = picture(12, GLINT_PRECISION_DOUBLE);
    for (int i = 0; i < KINDS; i++) {
        glint_scene scene = bodies_scene(&kinds[i], 0.7, false);
        assert_cuts_change_no_picture(kinds[i].what, &scene, i < RECOLORED, &single);
        assert_cuts_change_no_picture(kinds[i].what, &scene, i < RECOLORED, &exact);
        glint_scene_free(&scene);
    }
    for (int i = 0; i < SCENES; i++) {
        glint_scene scene;
        test_scene_load(scenes[i], &scene);
        assert_cuts_change_no_picture(scenes[i], &scene, true, &single);
        glint_scene_free(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solids_are_the_same_in_pieces),
        cmocka_unit_test(pictures_are_the_same_in_pieces),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
