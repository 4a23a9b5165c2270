// Tests the loader's arrays, joints and tally against closed forms.
#include "scene/gltf/joints.h"
#include "scene/gltf/morph.h"
#include "scene/gltf/tally.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

// Returns a packed array of `components` numbers an element.
static glint_array packed(glint_component_type type, bool normalized, const void *bytes,
                          size_t count, size_t element_size)
{
    return (glint_array){.type = type,
                         .normalized = normalized,
                         .count = count,
                         .element_size = element_size,
                         .bytes = bytes,
                         .stride = element_size};
}

static double number(const glint_array *array, size_t i)
{
    double value;
    glint_array_numbers(array, i, 1, &value);
    return value;
}

// glTF's table of normalised integers: the most negative one counts as −1.
static void integers_become_shares(void **state)
{
    (void)state;
    static const int8_t bytes[] = {-128, -127, 0, 127};
    static const uint8_t unsigned_bytes[] = {0, 51, 255};
    static const int16_t shorts[] = {-32768, -32767, 16384};
    static const uint16_t unsigned_shorts[] = {0, 13107, 65535};
    const glint_array signed8 = packed(GLINT_COMPONENT_INT8, true, bytes, 4, 1);
    const glint_array unsigned8 = packed(GLINT_COMPONENT_UINT8, true, unsigned_bytes, 3, 1);
    const glint_array signed16 = packed(GLINT_COMPONENT_INT16, true, shorts, 3, 2);
    const glint_array unsigned16 = packed(GLINT_COMPONENT_UINT16, true, unsigned_shorts, 3, 2);
    assert_true(number(&signed8, 0) == -1 && number(&signed8, 1) == -1);
    assert_true(number(&signed8, 2) == 0 && number(&signed8, 3) == 1);
    assert_true(number(&unsigned8, 1) == 0.2 && number(&unsigned8, 2) == 1);
    assert_true(number(&signed16, 0) == -1 && number(&signed16, 1) == -1);
    assert_true(number(&signed16, 2) == 16384.0 / 32767);
    assert_true(number(&unsigned16, 1) == 0.2 && number(&unsigned16, 2) == 1);
    const glint_array plain = packed(GLINT_COMPONENT_INT8, false, bytes, 4, 1);
    assert_true(number(&plain, 0) == -128);
}

// Elements that are apart, and not at multiples of their size.
static void strides_are_followed(void **state)
{
    (void)state;
    const float values[] = {1.5F, -2, 3, 4};
    unsigned char bytes[1 + 2 * 12];
    memcpy(bytes + 1, values, 8);
    memcpy(bytes + 13, values + 2, 8);
    glint_array array = packed(GLINT_COMPONENT_FLOAT, false, bytes + 1, 2, 8);
    array.stride = 12;
    double pair[2];
    glint_array_numbers(&array, 1, 2, pair);
    assert_true(pair[0] == 3 && pair[1] == 4);
    glint_array_numbers(&array, 0, 2, pair);
    assert_true(pair[0] == 1.5 && pair[1] == -2);
}

static void sparse_elements_stand_in(void **state)
{
    (void)state;
    static const uint16_t at[] = {1, 4};
    static const float instead[] = {7, 9};
    glint_array zeros = {.type = GLINT_COMPONENT_FLOAT, .count = 6, .element_size = 4};
    zeros.sparse = (glint_sparse){2, GLINT_COMPONENT_UINT16, (const unsigned char *)at,
                                  (const unsigned char *)instead};
    static const double expected[] = {0, 7, 0, 0, 9, 0};
    for (size_t i = 0; i < 6; i++) {
        assert_true(number(&zeros, i) == expected[i]);
    }
    static const uint8_t indices[] = {3, 255};
    const glint_array of_bytes = packed(GLINT_COMPONENT_UINT8, false, indices, 2, 1);
    assert_int_equal(glint_array_index(&of_bytes, 1), 255);
    assert_int_equal(glint_component_largest(GLINT_COMPONENT_UINT8), 255);
    assert_int_equal(glint_component_largest(GLINT_COMPONENT_UINT32), UINT32_MAX);
}

// Targets of weight 0, without deltas, and past the last weight count for nothing.
static void targets_add_up(void **state)
{
    (void)state;
    static const float first[] = {1, 2, 3}, second[] = {10, 20, 30};
    const glint_morph_target targets[] = {
        {{packed(GLINT_COMPONENT_FLOAT, false, first, 1, 12), {0}}},
        {{{0}, packed(GLINT_COMPONENT_FLOAT, false, first, 1, 12)}},
        {{packed(GLINT_COMPONENT_FLOAT, false, second, 1, 12), {0}}},
        {{packed(GLINT_COMPONENT_FLOAT, false, second, 1, 12), {0}}},
    };
    static const double weights[] = {0.5, 0, -1};
    glint_morph morph;
    assert_true(glint_morph_init(&morph, targets, 4, weights, 3));
    assert_int_equal(morph.counts[GLINT_MORPH_POSITION], 2);
    assert_int_equal(morph.counts[GLINT_MORPH_NORMAL], 0);
    double p[3] = {100, 100, 100};
    glint_morph_add(&morph, GLINT_MORPH_POSITION, 0, p);
    assert_true(p[0] == 90.5 && p[1] == 81 && p[2] == 71.5);
    glint_morph_free(&morph);
}

static glint_mat4 shifted(double x)
{
    glint_mat4 matrix = glint_mat4_identity;
    matrix.m[0][3] = x;
    return matrix;
}

static void weights_are_judged(void **state)
{
    (void)state;
    enum { VERTICES = 7 };
    static const uint8_t joints[VERTICES][4] = {{0, 1}, {0, 1}, {1}, {2}, {0, 2}, {0}, {1, 9}};
    static const float weights[VERTICES][4] = {{0.25F, 0.75F}, {1, 1}, {0},   {0},
                                               {0.5F, 0.5F},   {-1},   {1, 0}};
    static const glint_weighting expected[VERTICES] = {
        GLINT_WEIGHTS_GOOD, GLINT_WEIGHTS_NOT_ONE, GLINT_WEIGHTS_NONE, GLINT_JOINT_FAULTY,
        GLINT_JOINT_FAULTY, GLINT_WEIGHTS_FAULTY,  GLINT_WEIGHTS_GOOD};
    static const double moved[VERTICES] = {7.5, 5, 10, 0, 0, 0, 10};
    const glint_influences set = {packed(GLINT_COMPONENT_UINT8, false, joints, VERTICES, 4),
                                  packed(GLINT_COMPONENT_FLOAT, false, weights, VERTICES, 16)};
    const glint_influence_sets sets = {&set, 1};
    const glint_mat4 matrices[] = {shifted(0), shifted(10)};
    const glint_bones bones = {matrices, 2};
    for (size_t v = 0; v < VERTICES; v++) {
        glint_mat4 blend;
        const glint_weighting weighting = glint_joints_blend(&sets, v, &bones, &blend);
        assert_int_equal(weighting, expected[v]);
        if (!glint_weighting_is_fault(weighting)) {
            assert_true(blend.m[0][3] == moved[v] && blend.m[3][3] == 1);
        }
    }
    glint_error error = {0};
    assert_int_equal(glint_joints_refuse(&sets, 4, 2, "meshes[0].primitives[1]", &error),
                     GLINT_BAD_INPUT);
    assert_string_equal(error.message, "meshes[0].primitives[1].attributes.JOINTS_0: vertex 4 "
                                       "follows joint 2 (the skin has 2 joints)");
}

static void warnings_are_counted(void **state)
{
    (void)state;
    glint_tally tally = GLINT_TALLY_EMPTY;
    glint_tally_add(&tally, "is odd", "nodes[0]");
    glint_tally_mark(&tally);
    for (int frame = 0; frame < 2; frame++) { // the same again, once taken back
        tally.material = 40;
        glint_tally_add(&tally, "is odd", "nodes[1]");
        glint_tally_add_once(&tally, "is lost", "images[0]");
        glint_tally_add_once(&tally, "is lost", "images[0]");
        glint_tally_add_once(&tally, "is lost", "images[1]");
        tally.material = -1;
        glint_warnings warnings = {0};
        glint_tally_report(&tally, "a.gltf", &warnings);
        assert_int_equal(warnings.count, 2);
        assert_string_equal(warnings.texts[0], "a.gltf: nodes[0] and 1 more: is odd");
        assert_string_equal(warnings.texts[1], "a.gltf: images[0] and 1 more: is lost");
        assert_int_equal(glint_tally_lines_about(&tally, 40), 3);
        assert_int_equal(glint_tally_lines_about(&tally, 41), 0);
        glint_warnings_free(&warnings);
        glint_tally_rewind(&tally);
    }
    glint_warnings warnings = {0};
    glint_tally_report(&tally, "a.gltf", &warnings);
    assert_int_equal(warnings.count, 1);
    assert_string_equal(warnings.texts[0], "a.gltf: nodes[0]: is odd");
    glint_warnings_free(&warnings);
    glint_tally_free(&tally);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(integers_become_shares),   cmocka_unit_test(strides_are_followed),
        cmocka_unit_test(sparse_elements_stand_in), cmocka_unit_test(targets_add_up),
        cmocka_unit_test(weights_are_judged),       cmocka_unit_test(warnings_are_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
