// Tests the triangles of loaded scenes: their number, places and normals.
#include "scene/scene.h"

#include "support/gltf_text.h"
#include "support/scratch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static glint_vec3 world(const glint_scene *scene, const float *p)
{
    glint_vec3 stored = {p[0], p[1], p[2]};
    return glint_vec3_add(scene->origin, glint_vec3_scale(stored, scene->unit));
}

static glint_vec3 corner(const glint_scene *scene, size_t triangle, size_t c)
{
    return world(scene, glint_scene_position(scene, triangle, c));
}

static void assert_near3(glint_vec3 v, double x, double y, double z)
{
    if (!(fabs(v.x - x) <= 1e-6 && fabs(v.y - y) <= 1e-6 && fabs(v.z - z) <= 1e-6)) {
        fail_msg("(%g, %g, %g) is not (%g, %g, %g)", v.x, v.y, v.z, x, y, z);
    }
}

// Positive: the mesh is closed and counter-clockwise from outside.
static double volume_of(const glint_scene *scene)
{
    double sum = 0;
    for (size_t t = 0; t < scene->triangle_count; t++) {
        glint_vec3 bc = glint_vec3_cross(corner(scene, t, 1), corner(scene, t, 2));
        sum += glint_vec3_dot(corner(scene, t, 0), bc) / 6;
    }
    return sum;
}

// Every vertex normal must point to the outer side of its triangle.
static void assert_normals_outside(const glint_scene *scene)
{
    assert_non_null(scene->normals);
    for (size_t t = 0; t < scene->triangle_count; t++) {
        glint_vec3 a = corner(scene, t, 0);
        glint_vec3 face = glint_vec3_cross(glint_vec3_subtract(corner(scene, t, 1), a),
                                           glint_vec3_subtract(corner(scene, t, 2), a));
        for (size_t c = 0; c < 3; c++) {
            const float *n = glint_scene_normal(scene, t, c);
            glint_vec3 normal = {n[0], n[1], n[2]};
            assert_true(fabs(glint_vec3_length(normal) - 1) < 1e-6);
            assert_true(glint_vec3_dot(normal, face) >= 0);
        }
    }
}

static void a_tetrahedron_loads_as_it_is(void **state)
{
    glint_scene scene =
        load_tetrahedron(*state, "\"nodes\":[{\"mesh\":0,\"name\":\"t\"}]," ONE_SCENE);
    assert_int_equal(scene.triangle_count, 4);
    assert_int_equal(scene.instance_count, 1);
    assert_string_equal(scene.instances[0].node, "t");
    assert_int_equal(scene.instances[0].triangle_count, 4);
    assert_int_equal(scene.material_count, 1);
    assert_null(scene.materials[0].name);
    assert_true(scene.materials[0].metallic == 1 && scene.materials[0].ior == 1.5f);
    assert_true(fabs(volume_of(&scene) - 1.0 / 6) < 1e-7);
    assert_normals_outside(&scene);
    assert_near3(scene.low, 0, 0, 0);
    assert_near3(scene.high, 1, 1, 1);
    glint_scene_free(&scene);
    glint_scene_free(&scene); // zero is valid
}

static void negative_scale_keeps_normals_outside(void **state)
{
    const char *scales[] = {"-1,1,1", "1,-2,1", "-1,-1,-3", "-0.5,-4,1", "1e-3,1,-1e3"};
    for (size_t i = 0; i < 5; i++) {
        char rest[256];
        snprintf(
            rest, sizeof rest,
            "\"nodes\":[{\"mesh\":0,\"scale\":[%s],\"rotation\":[0.5,0.5,0.5,0.5]}]," ONE_SCENE,
            scales[i]);
        glint_scene scene = load_tetrahedron(*state, rest);
        assert_int_equal(scene.triangle_count, 4);
        assert_true(volume_of(&scene) > 0);
        assert_normals_outside(&scene);
        glint_scene_free(&scene);
    }
}

static void normals_turn_by_the_inverse_transpose(void **state)
{
    // The normal (1, 1, 0) of a plane under a scale of (4, 1, 1) becomes (1/4, 1, 0), normalised.
    const struct {
        float positions[3][3], normals[3][3];
    } data = {{{1, 0, 0}, {0, 1, 0}, {0, 1, -1}}, {{1, 1, 0}, {1, 1, 0}, {1, 1, 0}}};
    glint_scene scene = load_by_corner(
        *state, &data, sizeof data,
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":72}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},{\"bufferView\":0,"
        "\"byteOffset\":36,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1}}]}],"
        "\"nodes\":[{\"mesh\":0,\"scale\":[4,1,1]}]," ONE_SCENE);
    const float *n = scene.normals;
    glint_vec3 normal = {n[0], n[1], n[2]};
    double length = sqrt(1 + 0.0625);
    assert_near3(normal, 0.25 / length, 1 / length, 0);
    glint_scene_free(&scene);
}

static void matrices_and_trs_of_a_hierarchy_agree(void **state)
{
    // The parent has a quarter turn about +Y, scale 2 and a translation. Its child moves by (1, 0,
    // 0).
    const char *trs = "\"nodes\":[{\"translation\":[5,6,7],\"rotation\":[0,0.70710678118654752,0,"
                      "0.70710678118654752],\"scale\":[2,2,2],\"children\":[1]},"
                      "{\"mesh\":0,\"translation\":[1,0,0]}]," ONE_SCENE;
    const char *matrix = "\"nodes\":[{\"matrix\":[0,0,-2,0, 0,2,0,0, 2,0,0,0, 5,6,7,1],"
                         "\"children\":[1]},{\"mesh\":0,\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,"
                         "1,0,0,1]}]," ONE_SCENE;
    glint_scene a = load_tetrahedron(*state, trs);
    glint_scene b = load_tetrahedron(*state, matrix);
    assert_int_equal(a.triangle_count, 4);
    for (size_t t = 0; t < 4; t++) {
        for (size_t c = 0; c < 3; c++) {
            glint_vec3 p = corner(&b, t, c);
            assert_near3(corner(&a, t, c), p.x, p.y, p.z);
        }
    }
    // The origin of the mesh: (1, 0, 0) turned to (0, 0, −1), doubled, moved.
    assert_near3(corner(&a, 0, 0), 5, 6, 5);
    glint_scene_free(&a);
    glint_scene_free(&b);
}

// Loads points in a mode, with indices of a type, or 0: without.
static glint_scene load_mode(const char *folder, int mode, int index_type, const uint32_t *indices,
                             size_t count)
{
    struct {
        float positions[6][3];
        unsigned char indices[32];
    } data = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.5f}, {0, 2, 0}, {1, 2, 1}}, {0}};
    for (size_t i = 0; i < count; i++) {
        uint16_t half = (uint16_t)indices[i];
        if (index_type == 5121) {
            data.indices[i] = (unsigned char)indices[i];
        } else if (index_type == 5123) {
            memcpy(data.indices + 2 * i, &half, 2);
        } else {
            memcpy(data.indices + 4 * i, &indices[i], 4);
        }
    }
    size_t positions = index_type == 0 ? count : 6;
    char rest[1024];
    snprintf(rest, sizeof rest,
             "\"bufferViews\":[{\"buffer\":0,\"byteLength\":72},"
             "{\"buffer\":0,\"byteOffset\":72,\"byteLength\":32}],\"accessors\":["
             "{\"bufferView\":0,\"componentType\":5126,\"count\":%zu,\"type\":\"VEC3\"},"
             "{\"bufferView\":1,\"componentType\":%d,\"count\":%zu,\"type\":\"SCALAR\"}],"
             "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"mode\":%d%s}]}],"
             "\"nodes\":[{\"mesh\":0}]," ONE_SCENE,
             positions, index_type == 0 ? 5121 : index_type, count, mode,
             index_type == 0 ? "" : ",\"indices\":1");
    return load_by_corner(folder, &data, sizeof data, rest);
}

static bool same_triangle(const float *a, const float *b)
{
    for (size_t turn = 0; turn < 3; turn++) {
        bool same = true;
        for (size_t i = 0; i < 9; i++) {
            same = same && a[i] == b[(i + 3 * turn) % 9];
        }
        if (same) {
            return true;
        }
    }
    return false;
}

// In order; each triangle may start at any corner.
static void assert_same_triangles(const glint_scene *a, const glint_scene *b)
{
    assert_int_equal(a->triangle_count, b->triangle_count);
    for (size_t t = 0; t < a->triangle_count; t++) {
        assert_true(same_triangle(a->positions + 9 * t, b->positions + 9 * t));
    }
}

static void strip_and_fan_give_the_same_triangles_as_a_list(void **state)
{
    const uint32_t strip[] = {0, 1, 2, 3, 4, 5};
    const uint32_t strip_as_list[] = {0, 1, 2, 1, 3, 2, 2, 3, 4, 3, 5, 4};
    const uint32_t fan_as_list[] = {1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5, 0};
    const int types[] = {0, 5121, 5123, 5125};
    glint_scene strip_list = load_mode(*state, 4, 5121, strip_as_list, 12);
    glint_scene fan_list = load_mode(*state, 4, 5121, fan_as_list, 12);
    for (size_t i = 0; i < 4; i++) {
        glint_scene scene = load_mode(*state, 5, types[i], strip, 6);
        assert_same_triangles(&scene, &strip_list);
        glint_scene_free(&scene);
        scene = load_mode(*state, 6, types[i], strip, 6);
        assert_same_triangles(&scene, &fan_list);
        glint_scene_free(&scene);
    }
    glint_scene_free(&strip_list);
    glint_scene_free(&fan_list);
}

static void an_incomplete_triangle_is_left_out(void **state)
{
    const uint32_t order[] = {0, 1, 2, 3, 4};
    glint_scene scene = load_mode(*state, 4, 5123, order, 5);
    assert_int_equal(scene.triangle_count, 1);
    glint_scene_free(&scene);
    scene = load_mode(*state, 5, 5123, order, 2);
    assert_int_equal(scene.triangle_count, 0);
    assert_true(scene.low.x > scene.high.x);
    glint_scene_free(&scene);
}

static void triangles_without_area_are_counted_and_left_out(void **state)
{
    const struct {
        float p[15][3];
    } data = {{{0, 0, 0},
               {1, 0, 0},
               {0, 1, 0}, // a triangle
               {0, 0, 0},
               {0, 0, 0},
               {9e8f, 0, 0}, // two corners in one place, far away
               {0, 0, 0},
               {0.5f, 0, 0},
               {1, 0, 0}, // on a line
               {0, 0, 0},
               {0.25f, 0.5f, 0.125f},
               {0.5f, 1, 0.25f}, // on a slanted line
               {0, 0, 0},
               {0.5f, 1e-7f, 0},
               {1, 0, 0}}}; // a sliver is a triangle
    glint_scene scene =
        load_by_corner(*state, &data, sizeof data,
                       "\"bufferViews\":[{\"buffer\":0,\"byteLength\":180}],\"accessors\":["
                       "{\"bufferView\":0,\"componentType\":5126,\"count\":15,\"type\":\"VEC3\"}],"
                       "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
                       "\"nodes\":[{\"mesh\":0}]," ONE_SCENE);
    assert_int_equal(scene.degenerate_triangles, 3);
    assert_int_equal(scene.triangle_count, 2);
    assert_true(scene.high.x == 1); // triangles without area do not count in the bounds
    assert_null(scene.normals);
    glint_scene_free(&scene);
}

static void stored_coordinates_lie_within_one(void **state)
{
    const char *places[] = {"0,0,0", "1e6,-3e6,17.3", "0.1,0.2,-0.3", "-1e15,0,0"};
    const char *scales[] = {"1", "1e-6", "3e5", "0.7"};
    for (size_t i = 0; i < 16; i++) {
        char rest[256];
        snprintf(rest, sizeof rest,
                 "\"nodes\":[{\"mesh\":0,\"translation\":[%s],\"scale\":[%s,%s,%s]}]," ONE_SCENE,
                 places[i / 4], scales[i % 4], scales[i % 4], scales[i % 4]);
        glint_scene scene = load_tetrahedron(*state, rest);
        int exponent;
        assert_true(frexp(scene.unit, &exponent) == 0.5); // a power of two
        float largest = 0;
        for (size_t k = 0; k < 3 * scene.vertex_count; k++) {
            largest = fmaxf(largest, fabsf(scene.positions[k]));
        }
        assert_true(largest <= 1);
        // At -1e15 doubles are 1/8 apart, so small triangles lose nearly all digits.
        assert_true(largest > 0.25f || i >= 12);
        glint_scene_free(&scene);
    }
}

static void far_from_the_origin_nothing_is_lost(void **state)
{
    glint_scene near = load_tetrahedron(*state, "\"nodes\":[{\"mesh\":0}]," ONE_SCENE);
    glint_scene far = load_tetrahedron(
        *state, "\"nodes\":[{\"mesh\":0,\"translation\":[1000000,-2000000,3000000]}]," ONE_SCENE);
    assert_int_equal(near.vertex_count, 4);
    assert_memory_equal(near.positions, far.positions, 12 * sizeof(float));
    assert_memory_equal(near.indices, far.indices, 12 * sizeof *near.indices);
    assert_true(far.origin.x == near.origin.x + 1e6);
    glint_scene_free(&near);
    glint_scene_free(&far);
}

static void a_power_of_two_scale_gives_the_same_bits(void **state)
{
    const char *format =
        "\"nodes\":[{\"scale\":[%s,%s,%s],\"children\":[1]},{\"mesh\":0,"
        "\"translation\":[0.3,0.7,-0.9],\"rotation\":[0.1,0.2,0.3,0.9273618]}]," ONE_SCENE;
    const char *scales[] = {"1", "0.00000095367431640625", "1048576"};
    glint_scene scenes[3];
    for (size_t i = 0; i < 3; i++) {
        char rest[512];
        snprintf(rest, sizeof rest, format, scales[i], scales[i], scales[i]);
        scenes[i] = load_tetrahedron(*state, rest);
        assert_memory_equal(scenes[0].positions, scenes[i].positions, 12 * sizeof(float));
        assert_memory_equal(scenes[0].normals, scenes[i].normals, 12 * sizeof(float));
    }
    for (size_t i = 0; i < 3; i++) {
        glint_scene_free(&scenes[i]);
    }
}

static void sparse_and_absent_data_are_zeros_elsewhere(void **state)
{
    // Accessor 0: three zeros, with elements 1 and 2 replaced. 3: strided, element 1 replaced.
    const struct {
        float values[2][3];
        uint16_t places[2];
        float strided[3][4];
        unsigned char place;
        unsigned char padding[3];
        float value[3];
    } data = {{{1, 0, 0}, {0, 1, 0}},
              {1, 2},
              {{5, 0, 0, 9}, {0, 0, 0, 9}, {5, 1, 0, 9}},
              1,
              {0},
              {6, 0, 0}};
    const char *rest =
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":24},"
        "{\"buffer\":0,\"byteOffset\":24,\"byteLength\":4},"
        "{\"buffer\":0,\"byteOffset\":28,\"byteLength\":48,\"byteStride\":16},"
        "{\"buffer\":0,\"byteOffset\":76,\"byteLength\":4},"
        "{\"buffer\":0,\"byteOffset\":80,\"byteLength\":12}],\"accessors\":["
        "{\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"sparse\":{\"count\":2,\"indices\":"
        "{"
        "\"bufferView\":1,\"componentType\":5123},\"values\":{\"bufferView\":0}}},"
        "{\"bufferView\":2,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"sparse\":{"
        "\"count\":1,\"indices\":{\"bufferView\":3,\"componentType\":5121},\"values\":{"
        "\"bufferView\":4}}},{\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
        "{\"componentType\":5121,\"count\":3,\"type\":\"SCALAR\"}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":2}},"
        "{\"attributes\":{\"POSITION\":1}},{\"attributes\":{\"POSITION\":2}},"
        "{\"attributes\":{\"POSITION\":0},\"indices\":3}]}],\"nodes\":[{\"mesh\":0}]," ONE_SCENE;
    glint_scene scene = load_by_corner(*state, &data, sizeof data, rest);
    // Positions or indices that are all zero give triangles without area.
    assert_int_equal(scene.triangle_count, 2);
    assert_int_equal(scene.degenerate_triangles, 2);
    assert_int_equal(scene.instance_count, 2);
    assert_near3(corner(&scene, 0, 0), 0, 0, 0);
    assert_near3(corner(&scene, 0, 1), 1, 0, 0);
    assert_near3(corner(&scene, 0, 2), 0, 1, 0);
    assert_near3(corner(&scene, 1, 0), 5, 0, 0);
    assert_near3(corner(&scene, 1, 1), 6, 0, 0);
    assert_near3(corner(&scene, 1, 2), 5, 1, 0);
    for (size_t k = 0; k < 18; k++) {
        assert_true(scene.normals[k] == 0); // zeros, and missing normals
    }
    glint_scene_free(&scene);
}

static void unusable_normals_become_zero(void **state)
{
    tetrahedron data = the_tetrahedron;
    data.normals[0][0] = NAN;
    data.normals[1][1] = INFINITY;
    data.normals[2][1] = 0;
    data.normals[3][2] = 1e-30f; // short, but usable
    glint_scene scene = load_by_corner(*state, &data, sizeof data,
                                       TETRAHEDRON ",\"nodes\":[{\"mesh\":0}]," ONE_SCENE);
    for (size_t i = 0; i < 12; i++) {
        const float *n = scene.normals + 3 * i;
        glint_vec3 normal = {n[0], n[1], n[2]};
        bool usable = the_tetrahedron.indices[i] == 3;
        assert_true(glint_vec3_length(normal) == (usable ? 1 : 0));
    }
    glint_scene_free(&scene);
}

static void quantized_positions_and_normals_are_scaled(void **state)
{
    const struct {
        int16_t positions[3][4];
        int8_t normals[3][4];
    } data = {{{0, 0, 0, 0}, {32767, 0, 0, 0}, {0, -32768, 0, 0}},
              {{0, 0, -127, 0}, {0, 0, -127, 0}, {0, 0, -127, 0}}};
    const char *rest =
        "\"extensionsRequired\":[\"KHR_mesh_quantization\"],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":24,\"byteStride\":8},"
        "{\"buffer\":0,\"byteOffset\":24,\"byteLength\":12,\"byteStride\":4}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5122,\"normalized\":%s,\"count\":3,\"type\":\"VEC3\"},"
        "{\"bufferView\":1,\"componentType\":5120,\"normalized\":true,\"count\":3,"
        "\"type\":\"VEC3\"}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1}}]}],"
        "\"nodes\":[{\"mesh\":0}]," ONE_SCENE;
    for (int normalized = 0; normalized < 2; normalized++) {
        char text[2048];
        snprintf(text, sizeof text, rest, normalized ? "true" : "false");
        glint_scene scene = load_by_corner(*state, &data, sizeof data, text);
        assert_near3(scene.high, normalized ? 1 : 32767, 0, 0);
        assert_near3(scene.low, 0, normalized ? -1 : -32768, 0);
        assert_true(scene.normals[2] == -1);
        glint_scene_free(&scene);
    }
}

static void instancing_draws_the_mesh_at_every_place(void **state)
{
    const struct {
        tetrahedron mesh;
        float translations[2][3];
        float scales[2][3];
    } data = {the_tetrahedron, {{10, 0, 0}, {0, 20, 0}}, {{1, 1, 1}, {-2, 2, 2}}};
    const char *rest =
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},{\"buffer\":0,\"byteOffset\":96,"
        "\"byteLength\":24},{\"buffer\":0,\"byteOffset\":120,\"byteLength\":48}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
        "{\"bufferView\":1,\"componentType\":5123,\"count\":12,\"type\":\"SCALAR\"},"
        "{\"bufferView\":2,\"componentType\":5126,\"count\":2,\"type\":\"VEC3\"},"
        "{\"bufferView\":2,\"byteOffset\":24,\"componentType\":5126,\"count\":2,\"type\":\"VEC3\"}]"
        ","
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"
        "\"nodes\":[{\"mesh\":0,\"translation\":[0,0,5],\"extensions\":{\"EXT_mesh_gpu_"
        "instancing\":"
        "{\"attributes\":{\"TRANSLATION\":2,\"SCALE\":3}}}}]," ONE_SCENE;
    glint_scene scene = load_by_corner(*state, &data, sizeof data, rest);
    assert_int_equal(scene.instance_count, 2);
    assert_int_equal(scene.triangle_count, 8);
    assert_near3(corner(&scene, 0, 0), 10, 0, 5);
    assert_near3(scene.low, -2, 0, 5);
    assert_near3(scene.high, 11, 22, 7);
    assert_true(fabs(volume_of(&scene) - 9.0 / 6) < 1e-4); // 1 + 2³, both outside out
    glint_scene_free(&scene);
}

static void a_scale_of_zero_hides_what_is_below(void **state)
{
    char *text =
        gltf_text(&the_tetrahedron, sizeof the_tetrahedron,
                  TETRAHEDRON ",\"nodes\":[{\"scale\":[0,0,0],\"children\":[1],\"mesh\":0},"
                              "{\"mesh\":0,\"translation\":[1,2,3]}]," ONE_SCENE);
    glint_scene scene;
    glint_warnings warnings = {0};
    assert_int_equal(load_text(*state, text, &scene, &warnings, NULL), GLINT_OK);
    assert_int_equal(scene.triangle_count, 0);
    assert_int_equal(scene.degenerate_triangles, 0);
    assert_int_equal(warnings.count, 0); // who hides all meshes so means it
    glint_scene_free(&scene);
    glint_warnings_free(&warnings);
    free(text);
}

// A matrix flattens and hides as a scale does.
static void a_mesh_scaled_flat_stays_visible(void **state)
{
    static const char *const places[] = {"\"scale\":[1,1,0]",
                                         "\"matrix\":[1,0,0,0,0,1,0,0,0,0,0,0,0,0,0,1]",
                                         "\"matrix\":[0,0,0,0,0,0,0,0,0,0,0,0,5,0,0,1]"};
    for (int i = 0; i < 3; i++) {
        char rest[256];
        snprintf(rest, sizeof rest, "\"nodes\":[{\"mesh\":0,%s}]," ONE_SCENE, places[i]);
        glint_scene scene = load_tetrahedron(*state, rest);
        assert_int_equal(scene.triangle_count, i < 2 ? 2 : 0);
        assert_int_equal(scene.degenerate_triangles, i < 2 ? 2 : 0);
        glint_scene_free(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tetrahedron_loads_as_it_is),
        cmocka_unit_test(negative_scale_keeps_normals_outside),
        cmocka_unit_test(normals_turn_by_the_inverse_transpose),
        cmocka_unit_test(matrices_and_trs_of_a_hierarchy_agree),
        cmocka_unit_test(strip_and_fan_give_the_same_triangles_as_a_list),
        cmocka_unit_test(an_incomplete_triangle_is_left_out),
        cmocka_unit_test(triangles_without_area_are_counted_and_left_out),
        cmocka_unit_test(stored_coordinates_lie_within_one),
        cmocka_unit_test(far_from_the_origin_nothing_is_lost),
        cmocka_unit_test(a_power_of_two_scale_gives_the_same_bits),
        cmocka_unit_test(sparse_and_absent_data_are_zeros_elsewhere),
        cmocka_unit_test(unusable_normals_become_zero),
        cmocka_unit_test(quantized_positions_and_normals_are_scaled),
        cmocka_unit_test(instancing_draws_the_mesh_at_every_place),
        cmocka_unit_test(a_scale_of_zero_hides_what_is_below),
        cmocka_unit_test(a_mesh_scaled_flat_stays_visible),
    };
    return cmocka_run_group_tests(tests, scratch_setup, scratch_teardown);
}
