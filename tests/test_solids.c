// Tests which solids touch and overlap, and which of two overlapping solids gives way.
#include "scene/shape/solids.h"

#include "support/bodies.h"
#include "support/gltf_text.h"
#include "support/scratch.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef struct found {
    glint_scene scene;
    glint_topology topology;
    glint_solids solids;
} found;

static void analyse(found *f)
{
    assert_int_equal(glint_topology_find(&f->scene, &f->topology, NULL), GLINT_OK);
    assert_int_equal(glint_solids_find(&f->scene, &f->topology, &f->solids, NULL), GLINT_OK);
    if (f->solids.of_triangle == NULL || f->solids.material_of == NULL ||
        (f->solids.contacts == NULL && f->solids.contact_count > 0)) {
        abort();
    }
}

static found find(const bodies *all, double turn)
{
    found f = {.scene = bodies_scene(all, turn, false)};
    analyse(&f);
    return f;
}

static void let_go(found *f)
{
    glint_solids_free(&f->solids);
    glint_topology_free(&f->topology);
    glint_scene_free(&f->scene);
}

static const struct {
    bodies bodies;
    size_t contacts;
    bool overlap, touch_others;
} pairs[] = {
    {{.what = "apart",
      .of = {{{-0.6, 0, 0}, {0, 0.4, 0.4}, GLASS}, {{0.01, 0, 0}, {0.6, 0.4, 0.4}, WATER}}},
     0,
     false,
     false},
    {{.what = "a hair apart",
      .of = {{{-0.6, 0, 0}, {0, 0.4, 0.4}, GLASS}, {{1e-5, 0, 0}, {0.6, 0.4, 0.4}, WATER}}},
     0,
     false,
     false},
    {{.what = "side by side",
      .of = {{{-0.6, 0, 0}, {0, 0.4, 0.4}, GLASS}, {{0, 0, 0}, {0.6, 0.4, 0.4}, WATER}}},
     1,
     false,
     false},
    {{.what = "side by side, of one mesh",
      .of = {{{-0.6, 0, 0}, {0, 0.4, 0.4}, GLASS, 2, 1},
             {{0, 0, 0}, {0.6, 0.4, 0.4}, GLASS, 2, 1}}},
     1,
     false,
     false},
    {{.what = "a part of a face in common",
      .of = {{{-0.6, 0, 0}, {0.1, 0.4, 0.4}, GLASS}, {{0.1, 0.3, 0.3}, {0.6, 0.6, 0.6}, WATER, 3}}},
     1,
     false,
     false},
    {{.what = "an edge in common",
      .of = {{{-0.6, 0, 0}, {0, 0.4, 0.4}, GLASS}, {{0, 0.4, 0}, {0.6, 0.6, 0.4}, WATER}}},
     0,
     false,
     false},
    {{.what = "one in the other",
      .of = {{{-0.6, -0.6, -0.6}, {0.6, 0.6, 0.6}, GLASS, 3},
             {{-0.3, -0.3, -0.3}, {0.3, 0.3, 0.3}, WATER}}},
     0,
     false,
     false},
    {{.what = "one in the other, with a face in common",
      .of = {{{-0.6, -0.6, -0.6}, {0.6, 0.6, 0.6}, GLASS, 3},
             {{-0.3, -0.6, -0.3}, {0.3, 0.3, 0.3}, WATER}}},
     1,
     false,
     false},
    {{.what = "through each other",
      .of = {{{-0.6, -0.3, -0.3}, {0.6, 0.3, 0.3}, GLASS, 3},
             {{-0.3, -0.6, -0.2}, {0.3, 0.6, 0.2}, WATER, 2}}},
     1,
     true,
     false},
    {{.what = "through each other, along edges",
      .of = {{{-0.6, -0.5, -0.6}, {0.6, 0.1, 0.6}, GLASS, 3},
             {{-0.3, -0.2, -0.3}, {0.2, 0.4, 0.25}, WATER, 2}}},
     1,
     true,
     false},
    {{.what = "on each other, with edges on faces",
      .of = {{{-0.6, -0.5, -0.6}, {0.6, 0.1, 0.6}, GLASS, 3},
             {{-0.3, 0.1, -0.3}, {0.2, 0.4, 0.25}, WATER, 2}}},
     1,
     false,
     false},
    {{.what = "one in the other, with edges in its planes",
      .of = {{{-0.6, -0.6, -0.6}, {0.6, 0.6, 0.6}, GLASS, 2},
             {{-0.3, -0.3, -0.3}, {0.3, 0.3, 0.3}, WATER, 2}}},
     0,
     false,
     false},
    {{.what = "three in a row",
      .of = {{{-0.6, 0, 0}, {-0.2, 0.4, 0.4}, GLASS},
             {{-0.2, 0, 0}, {0.2, 0.4, 0.4}, WATER},
             {{0.2, 0, 0}, {0.5, 0.4, 0.4}, ICE}}},
     2,
     false,
     false},
    {{.what = "on metal",
      .of = {{{-0.6, 0, 0}, {0.6, 0.4, 0.4}, GLASS}, {{-0.6, -0.2, 0}, {0.6, 0, 0.4}, METAL}}},
     0,
     false,
     true},
    {{.what = "metal on paint",
      .of = {{{-0.6, 0, 0}, {0.6, 0.4, 0.4}, METAL},
             {{-0.6, -0.2, 0}, {0.6, 0, 0.4}, PAINT},
             {{-0.6, 0.5, 0}, {0.6, 0.6, 0.4}, GLASS}}},
     0,
     false,
     false},
};

static void contacts_are_found(void **state)
{
    (void)state;
    for (size_t i = 0; i < 2 * sizeof pairs / sizeof *pairs; i++) {
        const size_t number = i / 2;
        found f = find(&pairs[number].bodies, i % 2 ? 0.7 : 0);
        print_message("%s\n", pairs[number].bodies.what);
        assert_int_equal(f.solids.contact_count, pairs[number].contacts);
        assert_int_equal(f.solids.touch_others, pairs[number].touch_others);
        size_t marked = 0;
        for (size_t k = 0; k < f.scene.triangle_count; k++) {
            marked += (f.solids.of_triangle[k].medium & GLINT_SOLID_TOUCHES) != 0;
        }
        const bool touches = pairs[number].touch_others || pairs[number].contacts > 0;
        assert_int_equal(marked > 0, touches && !pairs[number].overlap);
        assert_true(marked < f.scene.triangle_count);
        for (size_t k = 0; k < f.solids.contact_count; k++) {
            assert_int_equal(f.solids.contacts[k].overlap, pairs[number].overlap);
        }
        let_go(&f);
    }
}

// Checks the order of media, from the solid that gives way first.
static void assert_order(const bodies *all, const stuff *order, size_t count)
{
    found f = find(all, 0.3);
    print_message("%s\n", all->what);
    assert_int_equal(f.solids.medium_count, count);
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(f.solids.material_of[i], order[i]);
    }
    let_go(&f);
}

static void the_lesser_solid_is_there_unless_the_file_says_else(void **state)
{
    (void)state;
    bodies all = {.what = "ice in water in glass",
                  .of = {{{-0.6, -0.6, -0.6}, {0.6, 0.6, 0.6}, GLASS},
                         {{-0.4, -0.4, -0.4}, {0.4, 0.4, 0.4}, WATER},
                         {{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}, ICE}}};
    assert_order(&all, (const stuff[]){GLASS, WATER, ICE}, 3);
    all.what = "water first, then ice, by the file";
    all.priorities[WATER] = 2;
    all.priorities[ICE] = 1;
    assert_order(&all, (const stuff[]){GLASS, ICE, WATER}, 3);
    const bodies hollow = {.what = "a hollow glass is less than its water",
                           .of = {{{-0.6, -0.6, -0.6}, {0.6, 0.6, 0.6}, GLASS, 1, 1},
                                  {{-0.55, -0.55, -0.55}, {0.55, 0.55, 0.55}, GLASS, 1, 1, true},
                                  {{-0.55, -0.55, -0.55}, {0.55, 0.3, 0.55}, WATER}}};
    assert_order(&hollow, (const stuff[]){WATER, GLASS}, 2);
    const bodies again = {.what = "glass around water around glass",
                          .of = {{{-0.6, -0.6, -0.6}, {0.6, 0.6, 0.6}, GLASS},
                                 {{-0.4, -0.4, -0.4}, {0.4, 0.4, 0.4}, WATER},
                                 {{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}, GLASS}}};
    assert_order(&again, (const stuff[]){GLASS, WATER, GLASS}, 3);
}

// The surface of a hollow has the same medium as the solid around it.
static void a_hollow_belongs_to_its_solid(void **state)
{
    (void)state;
    const bodies hollow = {.what = "hollow",
                           .of = {{{-0.6, -0.6, -0.6}, {0.6, 0.6, 0.6}, GLASS, 1, 1},
                                  {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, GLASS, 1, 1, true},
                                  {{-0.3, -0.3, -0.3}, {0.3, 0.3, 0.3}, WATER},
                                  {{0.65, 0, 0}, {0.7, 0.1, 0.1}, GLASS}}};
    found f = find(&hollow, 0);
    assert_int_equal(f.solids.component_count, 4);
    assert_int_equal(f.solids.of_triangle[0].medium, f.solids.of_triangle[12].medium);
    assert_int_not_equal(f.solids.of_triangle[0].component, f.solids.of_triangle[12].component);
    assert_true(fabs(f.topology.components[1].volume + 1) < 1e-6);
    let_go(&f);
}

// A bead of a millimetre on a floor of a kilometre, and a hollow in it.
static void a_hollow_of_a_small_part_is_found(void **state)
{
    struct {
        tetrahedron solid;
        uint16_t turned[12];
    } bytes = {.solid = the_tetrahedron};
    for (int i = 0; i < 12; i++) {
        bytes.turned[i] = the_tetrahedron.indices[11 - i];
    }
#define SHORTS "\"componentType\":5123,\"count\":12,\"type\":\"SCALAR\"}"
#define GLASS_OF(material, indices)                                                                \
    "{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":" indices                       \
    ",\"material\":" material "}]}"
#define GLASSY(name)                                                                               \
    "{\"name\":\"" name "\",\"pbrMetallicRoughness\":{\"metallicFactor\":0},\"extensions\":{"      \
    "\"KHR_materials_transmission\":{\"transmissionFactor\":1},"                                   \
    "\"KHR_materials_volume\":{\"thicknessFactor\":1}}}"
    static const char rest[] =
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},"
        "{\"buffer\":0,\"byteOffset\":96,\"byteLength\":24},"
        "{\"buffer\":0,\"byteOffset\":120,\"byteLength\":24}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
        "{\"bufferView\":1," SHORTS ",{\"bufferView\":2," SHORTS "],"
        "\"materials\":[" GLASSY("solid") "," GLASSY(
            "hollow") "],\"meshes\":["
                      "{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}"
                      "," GLASS_OF("0", "1") "," GLASS_OF(
                          "1", "2") "],\"nodes\":["
                                    "{\"mesh\":0,\"scale\":[1000,1e-9,1000]},"
                                    "{\"mesh\":1,\"scale\":[1e-3,1e-3,1e-3],\"translation\":[700.1,"
                                    "0.3,11.7]},"
                                    "{\"mesh\":2,\"scale\":[1e-4,1e-4,1e-4],\"translation\":[700."
                                    "1001,0.3001,11.7001]}],"
                                    "\"scenes\":[{\"nodes\":[0,1,2]}]";
    found f = {.scene = load_rest(*state, &bytes, sizeof bytes, rest)};
    analyse(&f);
    assert_int_equal(f.solids.component_count, 2);
    assert_int_equal(f.solids.faults.inside_out.count, 0);
    assert_int_equal(f.solids.of_triangle[4].medium, f.solids.of_triangle[8].medium);
    assert_true(f.topology.components[2].volume < 0);
    let_go(&f);
}

// A cube of glass with many bubbles.
static void many_hollows_are_found(void **state)
{
    (void)state;
    enum { ACROSS = 21, BUBBLES = ACROSS * ACROSS * ACROSS, OF_CUBE = 12 };
    const size_t count = (size_t)OF_CUBE * (BUBBLES + 1);
    const bodies cube = {.what = "a cube", .of = {{{-1, -1, -1}, {1, 1, 1}, GLASS, 1, 1}}};
    found f = {.scene = bodies_scene(&cube, 0, false)};
    assert_int_equal(f.scene.triangle_count, OF_CUBE);
    free(f.scene.normals);
    f.scene.normals = NULL;
    f.scene.positions = realloc(f.scene.positions, 9 * count * sizeof *f.scene.positions);
    f.scene.material_of = realloc(f.scene.material_of, count * sizeof *f.scene.material_of);
    assert_true(f.scene.positions != NULL && f.scene.material_of != NULL);
    for (size_t t = OF_CUBE; t < count; t++) {
        const size_t bubble = t / OF_CUBE - 1;
        const size_t place[3] = {bubble % ACROSS, bubble / ACROSS % ACROSS,
                                 bubble / ACROSS / ACROSS};
        for (size_t i = 0; i < 9; i++) { // corners in the other order
            const float corner = f.scene.positions[9 * (t % OF_CUBE) + (2 - i / 3) * 3 + i % 3];
            f.scene.positions[9 * t + i] =
                0.02F * corner + 1.8F * ((float)place[i % 3] / (ACROSS - 1) - 0.5F);
        }
        f.scene.material_of[t] = f.scene.material_of[0];
    }
    f.scene.triangle_count = f.scene.instances[0].triangle_count = count;
    analyse(&f);
    assert_int_equal(f.solids.component_count, BUBBLES + 1);
    assert_int_equal(f.solids.faults.inside_out.count, 0);
    let_go(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(contacts_are_found),
        cmocka_unit_test(the_lesser_solid_is_there_unless_the_file_says_else),
        cmocka_unit_test(a_hollow_belongs_to_its_solid),
        cmocka_unit_test(a_hollow_of_a_small_part_is_found),
        cmocka_unit_test(many_hollows_are_found),
    };
    return cmocka_run_group_tests(tests, scratch_setup, scratch_teardown);
}
