// Tests small parts: which triangles get an origin of their own, and with what precision.
#include "scene/shape/digits.h"
#include "scene/shape/parts.h"
#include "scene/subset.h"
#include "support/gltf_text.h"
#include "support/scratch.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 64 };

typedef struct heap {
    double corners[MOST][3][3];
    size_t count;
} heap;

static void add(heap *h, const double a[3], const double b[3], const double c[3])
{
    memcpy(h->corners[h->count][0], a, 3 * sizeof *a);
    memcpy(h->corners[h->count][1], b, 3 * sizeof *b);
    memcpy(h->corners[h->count++][2], c, 3 * sizeof *c);
}

static void add_quad(heap *h, const double corners[4][3])
{
    add(h, corners[0], corners[1], corners[2]);
    add(h, corners[0], corners[2], corners[3]);
}

static void add_floor(heap *h)
{
    const double corners[4][3] = {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}};
    add_quad(h, corners);
}

// Four corners around a place.
static void add_tetrahedron(heap *h, const double place[3], double size)
{
    double p[4][3];
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 3; k++) {
            p[i][k] = place[k] + (i == k + 1 ? size : 0);
        }
    }
    add(h, p[0], p[2], p[1]);
    add(h, p[0], p[1], p[3]);
    add(h, p[0], p[3], p[2]);
    add(h, p[1], p[2], p[3]);
}

static glint_parts parts_of(const heap *h)
{
    glint_parts parts;
    const glint_exact_triangles exact = {&h->corners[0][0][0], 3 * h->count, NULL, h->count};
    assert_int_equal(glint_parts_find(&exact, &parts, NULL), GLINT_OK);
    return parts;
}

// The largest error of corners.
static double largest_error(const heap *h, const glint_parts *parts, size_t first, size_t end)
{
    double largest = 0;
    for (size_t i = 3 * first; i < 3 * end; i++) {
        const uint32_t part = parts->part_of[i / 3];
        const double *exact = h->corners[i / 3][i % 3];
        float told[3];
        glint_parts_tell(parts, part, exact, told);
        for (int k = 0; k < 3; k++) {
            const double anchor = (double)parts->anchors[part][k];
            largest = fmax(largest, fabs(anchor + (double)told[k] - exact[k]));
        }
    }
    return largest;
}

static void no_parts_without_need(void **state)
{
    (void)state;
    const double place[3] = {0.3, 0.1, 0.2};
    heap h = {.count = 0};
    add_floor(&h);
    add_tetrahedron(&h, place, 0.1);
    glint_parts parts = parts_of(&h);
    assert_int_equal(parts.count, 0);
    assert_null(parts.part_of);
    // Small parts also need small triangles.
    assert_false(glint_parts_may_be_there(0.01));
    assert_true(glint_parts_may_be_there(0.001));
    h.count = 0;
    parts = parts_of(&h);
    assert_int_equal(parts.count, 0);
}

static void small_parts_keep_their_digits(void **state)
{
    (void)state;
    for (int size = 10; size < 40; size++) {
        const double place[3] = {0.7 + 1e-10, 1e-9, -0.9 + 1e-11};
        heap h = {.count = 0};
        add_floor(&h);
        add_tetrahedron(&h, place, ldexp(1, -size));
        glint_parts parts = parts_of(&h);
        assert_int_equal(parts.count, 2);
        assert_int_equal(parts.part_of[0], 0);
        assert_int_equal(parts.part_of[1], 0);
        for (int k = 0; k < 3; k++) {
            assert_true(parts.anchors[0][k] == 0);
        }
        for (size_t i = 2; i < h.count; i++) {
            assert_int_equal(parts.part_of[i], 1);
        }
        // The anchor is at most four sizes away, so the error is half a rounding of this distance.
        // The anchor itself is a float, so for parts of 2⁻²⁴ and less it is up to a float step
        // away.
        const double reach = fmax(4 * ldexp(1, -size), 0x1p-24);
        assert_true(largest_error(&h, &parts, 2, h.count) <= reach * 0x1p-24);
        glint_parts_free(&parts);
    }
}

static bool share_anchor(const heap *h, size_t a, size_t b)
{
    glint_parts parts = parts_of(h);
    assert_true(parts.count > 0);
    const bool share = parts.part_of[a] == parts.part_of[b];
    glint_parts_free(&parts);
    return share;
}

static void what_shares_an_edge_has_one_anchor(void **state)
{
    (void)state;
    const double s = 0x1p-12, far[3] = {-0.8, 0.5, 0.3};
    // A strip of small quads, longer than the limit of a small part.
    heap h = {.count = 0};
    for (int i = 0; i < 24; i++) {
        const double x = 16 * s * i;
        const double corners[4][3] = {{x, 0, 0}, {x + 16 * s, 0, 0}, {x + 16 * s, s, 0}, {x, s, 0}};
        add_quad(&h, corners);
    }
    add_tetrahedron(&h, far, s);
    assert_true(share_anchor(&h, 0, 47));
    assert_false(share_anchor(&h, 0, 48));
    // Small neighbours. Their common edge differs by less than the resolution of floats.
    const double a[4][3] = {{0.7, 0, 0}, {0.7 + s, 0, 0}, {0.7 + s, s, 0}, {0.7, s, 0}};
    const double b[4][3] = {{0.7 + s + 1e-12, 0, 0},
                            {0.7 + 400 * s, 0, 0},
                            {0.7 + 400 * s, s, 0},
                            {0.7 + s + 1e-12, s, 0}};
    h.count = 0;
    add_floor(&h);
    add_tetrahedron(&h, far, s);
    add_quad(&h, a);
    add_quad(&h, b);
    assert_true(share_anchor(&h, 6, 8));
}

static void what_shares_a_corner_alone_is_apart(void **state)
{
    (void)state;
    const double corner[3] = {1, 0, 1};
    heap h = {.count = 0};
    add_floor(&h);
    add_tetrahedron(&h, corner, 0x1p-12);
    assert_false(share_anchor(&h, 0, 3));
}

static void zeros_of_both_signs_are_one(void **state)
{
    (void)state;
    const double s = 0x1p-12;
    const double a[3] = {0.5, -0.0, 0}, b[3] = {0.5 + s, 0, -0.0}, c[3] = {0.5, s, 0};
    const double b_again[3] = {0.5 + s, -0.0, 0}, a_again[3] = {0.5, 0, -0.0},
                 d[3] = {0.5, -600 * s, 0};
    heap h = {.count = 0};
    add_floor(&h);
    add(&h, a, b, c);
    add(&h, b_again, a_again, d);
    add_tetrahedron(&h, c, s / 4); // so that parts exist
    assert_true(share_anchor(&h, 2, 3));
}

// ---- Files --------------------------------------------------------------------------------------

// The tetrahedron as a floor of a thousand metres, and as a bead of a millimetre on it.
static void assert_is_bead(const glint_scene *scene, size_t first)
{
    const glint_vec3 place = {700.1, 0.3, 11.7};
    for (size_t t = first; t < first + 4; t++) {
        for (size_t c = 0; c < 3; c++) {
            const glint_vec3 stored = glint_scene_corner(scene, t, c);
            const glint_vec3 at =
                glint_vec3_add(scene->origin, glint_vec3_scale(stored, scene->unit));
            const glint_vec3 off = glint_vec3_scale(glint_vec3_subtract(at, place), 1000);
            // Within a millionth of the bead's size from a corner of the tetrahedron.
            const double sum = off.x + off.y + off.z;
            assert_true(fabs(sum) < 1e-6 || fabs(sum - 1) < 1e-6);
        }
    }
}

static void a_file_keeps_what_is_small(void **state)
{
    glint_scene scene = load_rest(
        *state, &the_tetrahedron, sizeof the_tetrahedron,
        TETRAHEDRON ",\"nodes\":[{\"mesh\":0,\"scale\":[1000,1000,1000]},"
                    "{\"mesh\":0,\"scale\":[0.001,0.001,0.001],\"translation\":[700.1,0.3,11.7]}],"
                    "\"scenes\":[{\"nodes\":[0,1]}]");
    assert_int_equal(scene.triangle_count, 8);
    assert_int_equal(scene.parts.count, 2);
    assert_is_bead(&scene, 4);
    assert_int_equal(glint_scene_remove_nodes(&scene, "0", NULL), GLINT_OK);
    assert_int_equal(scene.triangle_count, 4);
    assert_true(scene.parts.part_of[0] == 1);
    assert_int_equal(scene.vertex_count, 4);
    assert_is_bead(&scene, 0);
    glint_scene_free(&scene);
}

// ---- Digits ------------------------------------------------------------------------------------

// A tetrahedron of the given size at a place on a floor of 10 km; and something high above, which
// raises the scene's origin.
static glint_scene bead_below(const char *folder, double size, const char *place, const char *above)
{
    char rest[2000];
    snprintf(rest, sizeof rest,
             TETRAHEDRON ",\"nodes\":[{\"mesh\":0,\"scale\":[10000,1e-9,10000],\"name\":\"floor\"},"
                         "{\"mesh\":0,\"scale\":[%g,%g,%g],\"translation\":[%s],\"name\":\"bead\"},"
                         "{\"mesh\":0,\"translation\":[%s]}],"
                         "\"scenes\":[{\"nodes\":[0,1,2]}]",
             size, size, size, place, above);
    return load_rest(folder, &the_tetrahedron, sizeof the_tetrahedron, rest);
}

static void parts_beside_coarse_surfaces_are_said(void **state)
{
    // Places on the floor are 2^-21 of its height below the origin deep, half of the height of what
    // is above: 2.4 mm for 10 km.
    static const struct {
        double size;
        const char *place, *above;
        size_t count;
    } cases[] = {
        {1e-4, "2000,0,1000", "3000,1,3000", 0},
        {1e-4, "2000,0,1000", "3000,100,3000", 0},
        {1e-4, "2000,0,1000", "3000,1000,3000", 1},
        {1e-4, "2000,0,1000", "3000,10000,3000", 1},
        {2e-3, "2000,0,1000", "3000,10000,3000", 1},
        {3e-3, "2000,0,1000", "3000,10000,3000", 0},
        {1e-4, "2000,0.001,1000", "3000,10000,3000", 1}, // nearer than a place
        {1e-4, "2000,0.01,1000", "3000,10000,3000", 0},
        {1e-4, "-0.01,0,1000", "3000,10000,3000", 0}, // beside the floor
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        glint_scene scene = bead_below(*state, cases[i].size, cases[i].place, cases[i].above);
        const glint_coarse_places found = glint_coarse_places_find(&scene, NULL, 100);
        print_message("%g m at %s, below %s: %zu\n", cases[i].size, cases[i].place, cases[i].above,
                      found.count);
        assert_int_equal(found.count, cases[i].count);
        if (found.count > 0) {
            assert_string_equal(scene.instances[found.instance].node, "bead");
            assert_true(fabs(found.width - cases[i].size) < 0.01 * cases[i].size);
            assert_true(found.place > found.width);
        }
        glint_scene_free(&scene);
    }
}

// What is smaller than a pixel, or behind the camera, is not worth a warning.
static void parts_out_of_sight_are_not_said(void **state)
{
    glint_scene scene = bead_below(*state, 1e-4, "2000,0,1000", "3000,10000,3000");
    const glint_vec3 target = {2000, 0, 1000};
    const glint_vec3 up = {0, 1, 0};
    static const struct {
        double away;
        int height;
        bool turned;
        size_t count;
    } views[] = {{1e-3, 100, false, 1},
                 {0.1, 1000, false, 1},
                 {0.1, 100, false, 0},
                 {1000, 1000, false, 0},
                 {1e-3, 100, true, 0}};
    for (size_t i = 0; i < sizeof views / sizeof *views; i++) {
        glint_camera camera = {.yfov = 0.7};
        glint_warnings warnings = {0};
        const glint_vec3 eye = {target.x, target.y + 0.3 * views[i].away, target.z + views[i].away};
        const glint_vec3 ahead = glint_vec3_subtract(glint_vec3_scale(eye, 2), target);
        assert_true(glint_camera_look(eye, views[i].turned ? ahead : target, up, &camera));
        glint_coarse_places_warn(&scene, &camera, views[i].height, &warnings);
        assert_int_equal(warnings.count, views[i].count);
        assert_true(views[i].count == 0 ||
                    any_warning_has(&warnings, "\"bead\" (node 1) is 0.0001 m"));
        glint_warnings_free(&warnings);
    }
    glint_scene_free(&scene);
}

// A deformed primitive without a whole triangle has no place to look at.
static void what_has_no_triangle_is_passed(void **state)
{
    static const float places[8][3] = {{-100, 0, 0},  {100, 0, 0},   {0, 100, 0},     {1, 1, 1},
                                       {1.01F, 1, 1}, {1, 1.01F, 1}, {0.5F, 0.5F, 0}, {2, 0, 0}};
    glint_scene scene = load_rest(
        *state, places, sizeof places,
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":72},{\"buffer\":0,\"byteOffset\":72,"
        "\"byteLength\":24}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":6,"
        "\"type\":\"VEC3\"},{\"bufferView\":1,\"componentType\":5126,\"count\":2,\"type\":"
        "\"VEC3\"}],\"meshes\":[{\"weights\":[1],\"primitives\":[{\"attributes\":{\"POSITION\":0},"
        "\"targets\":[{\"POSITION\":0}]},{\"attributes\":{\"POSITION\":1},\"targets\":["
        "{\"POSITION\":1}]}]}],\"nodes\":[{\"mesh\":0}]," ONE_SCENE);
    assert_int_equal(scene.triangle_count, 2);
    assert_true(scene.parts.count > 0);
    glint_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_has_no_triangle_is_passed),
        cmocka_unit_test(no_parts_without_need),
        cmocka_unit_test(small_parts_keep_their_digits),
        cmocka_unit_test(what_shares_an_edge_has_one_anchor),
        cmocka_unit_test(what_shares_a_corner_alone_is_apart),
        cmocka_unit_test(zeros_of_both_signs_are_one),
        cmocka_unit_test(a_file_keeps_what_is_small),
        cmocka_unit_test(parts_beside_coarse_surfaces_are_said),
        cmocka_unit_test(parts_out_of_sight_are_not_said),
    };
    return cmocka_run_group_tests(tests, scratch_setup, scratch_teardown);
}
