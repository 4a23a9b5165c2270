// Tests primitives packed by Draco. Packing and unpacking keeps the data, errors name the damaged
// part, and no Draco fault reaches glint's process.
#include "scene/scene.h"

#include "support/by_corner.h"
#include "support/draco_mesh.h"
#include "support/gltf_text.h"
#include "support/scratch.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// A wavy sheet.
enum { SIDE = 12, VERTICES = SIDE * SIDE, TRIANGLES = (SIDE - 1) * (SIDE - 1) * 2 };

typedef struct sheet {
    float positions[VERTICES][3];
    float normals[VERTICES][3];
    uint32_t indices[TRIANGLES][3];
    uint8_t colors[VERTICES][4];
} sheet;

static sheet make_sheet(void)
{
    sheet made = {0};
    for (int i = 0; i < VERTICES; i++) {
        const int row = i / SIDE;
        const float x = (float)(i % SIDE), y = (float)row;
        const float slope = 0.3f * cosf(0.7f * x), length = sqrtf(1 + slope * slope);
        memcpy(made.positions[i], (float[]){x / 3, y / 7, 0.3f / 0.7f * sinf(0.7f * x)}, 12);
        memcpy(made.normals[i], (float[]){-slope / length, 0, 1 / length}, 12);
        memcpy(made.colors[i], (uint8_t[]){(uint8_t)i, (uint8_t)(3 * i), 7, 255}, 4);
    }
    uint32_t(*to)[3] = made.indices;
    for (uint32_t y = 0; y + 1 < SIDE; y++) {
        for (uint32_t x = 0; x + 1 < SIDE; x++) {
            const uint32_t a = y * SIDE + x, b = a + 1, c = a + SIDE, d = c + 1;
            memcpy(*to++, (uint32_t[]){a, b, c}, 12);
            memcpy(*to++, (uint32_t[]){b, d, c}, 12);
        }
    }
    return made;
}

static unsigned char *pack(const sheet *made, bool edgebreaker, int bits, size_t *size)
{
    const draco_mesh mesh = {
        VERTICES,        TRIANGLES,        made->positions[0],         made->normals[0],
        made->colors[0], made->indices[0], .edgebreaker = edgebreaker, .bits = bits};
    unsigned char *bytes = draco_pack(&mesh, size);
    assert_non_null(bytes);
    return bytes;
}

#define ACCESSORS                                                                                  \
    "\"accessors\":[{\"componentType\":5126,\"count\":144,\"type\":\"VEC3\"},"                     \
    "{\"componentType\":5126,\"count\":144,\"type\":\"VEC3\"},"                                    \
    "{\"componentType\":5123,\"count\":726,\"type\":\"SCALAR\"},"                                  \
    "{\"componentType\":5121,\"normalized\":true,\"count\":144,\"type\":\"VEC4\"}]"
#define PRIMITIVE                                                                                  \
    "{\"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"COLOR_0\":3},\"indices\":2,\"mode\":4,"        \
    "\"extensions\":{\"KHR_draco_mesh_compression\":{\"bufferView\":0,\"attributes\":{"            \
    "\"POSITION\":0,\"NORMAL\":1,\"COLOR_0\":2}}}}"
#define REQUIRED "\"extensionsRequired\":[\"KHR_draco_mesh_compression\"],"
#define NODES ",\"nodes\":[{\"mesh\":0}]," ONE_SCENE

// The members of the file, except its buffer.
static char *rest_of(size_t size, const char *primitives)
{
    char *rest = malloc(8192);
    assert_non_null(rest);
    snprintf(rest, 8192,
             REQUIRED "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%zu}]," ACCESSORS
                      ",\"meshes\":[{\"primitives\":[%s]}]" NODES,
             size, primitives);
    return rest;
}

static glint_scene load_packed(const char *folder, const sheet *made, bool edgebreaker, int bits)
{
    size_t size;
    unsigned char *bytes = pack(made, edgebreaker, bits, &size);
    char *rest = rest_of(size, PRIMITIVE);
    glint_scene scene = load_by_corner(folder, bytes, size, rest);
    free(rest);
    free(bytes);
    return scene;
}

static glint_scene load_plain(const char *folder, const sheet *made)
{
    return load_by_corner(
        folder, made, sizeof *made,
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":1728},{\"buffer\":0,"
        "\"byteOffset\":1728,\"byteLength\":1728},{\"buffer\":0,\"byteOffset\":3456,"
        "\"byteLength\":2904}],\"accessors\":[{\"bufferView\":0,\"componentType\":"
        "5126,\"count\":144,\"type\":\"VEC3\"},{\"bufferView\":1,\"componentType\":"
        "5126,\"count\":144,\"type\":\"VEC3\"},{\"bufferView\":2,\"componentType\":"
        "5125,\"count\":726,\"type\":\"SCALAR\"}],\"meshes\":[{\"primitives\":[{"
        "\"attributes\":{\"POSITION\":0,\"NORMAL\":1},\"indices\":2}]}]" NODES);
}

// ---- Unpacked data ------------------------------------------------------------------------------

static void sequential_packing_keeps_every_bit(void **state)
{
    const sheet made = make_sheet();
    glint_scene plain = load_plain(*state, &made), scene = load_packed(*state, &made, false, 0);
    assert_int_equal(scene.triangle_count, TRIANGLES);
    assert_memory_equal(scene.positions, plain.positions, TRIANGLES * 9 * sizeof(float));
    assert_memory_equal(scene.normals, plain.normals, TRIANGLES * 9 * sizeof(float));
    glint_scene_free(&scene);
    glint_scene_free(&plain);
}

// A triangle with its normals, rotated to begin with its least corner.
typedef struct flat {
    float values[18];
} flat;

static int compare(const void *a, const void *b)
{
    return memcmp(a, b, sizeof(flat));
}

static flat *sorted(const glint_scene *scene)
{
    flat *all = calloc(TRIANGLES, sizeof *all);
    assert_non_null(all);
    for (size_t t = 0; t < TRIANGLES; t++) {
        for (size_t turn = 0; turn < 3; turn++) {
            flat turned;
            for (size_t i = 0; i < 9; i++) {
                turned.values[i] = scene->positions[9 * t + (i + 3 * turn) % 9];
                turned.values[9 + i] = scene->normals[9 * t + (i + 3 * turn) % 9];
            }
            if (turn == 0 || compare(&turned, &all[t]) < 0) {
                all[t] = turned;
            }
        }
    }
    qsort(all, TRIANGLES, sizeof *all, compare);
    return all;
}

static void edgebreaker_keeps_every_triangle(void **state)
{
    const sheet made = make_sheet();
    glint_scene plain = load_plain(*state, &made), scene = load_packed(*state, &made, true, 0);
    assert_int_equal(scene.triangle_count, TRIANGLES);
    flat *expected = sorted(&plain), *found = sorted(&scene);
    assert_memory_equal(found, expected, TRIANGLES * sizeof(flat));
    free(expected);
    free(found);
    glint_scene_free(&scene);
    glint_scene_free(&plain);
}

static void quantised_positions_err_by_half_a_step(void **state)
{
    const sheet made = make_sheet();
    for (int bits = 6; bits <= 16; bits += 5) {
        glint_scene plain = load_plain(*state, &made),
                    scene = load_packed(*state, &made, false, bits);
        // The longest side of the box has 2^bits − 1 steps. Floats add their rounding.
        const double side = (SIDE - 1) / 3.0, step = side / (pow(2, bits) - 1);
        double largest = 0;
        for (size_t i = 0; i < (size_t)TRIANGLES * 9; i++) {
            const double origins[3] = {plain.origin.x - scene.origin.x,
                                       plain.origin.y - scene.origin.y,
                                       plain.origin.z - scene.origin.z};
            largest = fmax(largest, fabs(plain.positions[i] * plain.unit -
                                         scene.positions[i] * scene.unit + origins[i % 3]));
        }
        assert_true(largest > 0 && largest <= step / 2 + 4 * 6e-8 * side);
        glint_scene_free(&scene);
        glint_scene_free(&plain);
    }
}

// Two primitives share one view, in a GLB. One leaves attributes out and calls itself a strip.
static void primitives_can_share_a_view(void **state)
{
    const sheet made = make_sheet();
    size_t size, glb_size;
    unsigned char *bytes = pack(&made, true, 0, &size);
    char *rest = rest_of(size, PRIMITIVE ",{\"attributes\":{\"POSITION\":0},\"indices\":2,"
                                         "\"extensions\":{\"KHR_draco_mesh_compression\":{"
                                         "\"bufferView\":0,\"attributes\":{\"POSITION\":0}}}}");
    unsigned char *glb = glb_bytes(bytes, size, rest, &glb_size);
    glint_scene scene;
    glint_error error = {0};
    const char *path = write_bytes(*state, "test.glb", glb, glb_size);
    if (glint_scene_load(path, NULL, &scene, NULL, &error) != GLINT_OK) {
        fail_msg("%s", error.message);
    }
    scene_by_corner(&scene);
    assert_int_equal(scene.triangle_count, 2 * TRIANGLES);
    assert_memory_equal(scene.positions, scene.positions + 9 * TRIANGLES,
                        TRIANGLES * 9 * sizeof(float));
    glint_scene_free(&scene);
    free(glb);
    free(rest);
    free(bytes);
}

// Draco also stores the triangles of a strip as a list. 365 corners make at most 363 triangles.
static void strips_are_lists_once_decoded(void **state)
{
    const sheet made = make_sheet();
    glint_scene plain = load_packed(*state, &made, false, 0);
    size_t size;
    unsigned char *bytes = pack(&made, false, 0, &size);
    char *rest = rest_of(size, PRIMITIVE);
    memcpy(strstr(rest, "\"mode\":4"), "\"mode\":5", 8);
    memcpy(strstr(rest, "\"count\":726"), "\"count\":365", 11);
    glint_scene scene = load_by_corner(*state, bytes, size, rest);
    assert_int_equal(scene.triangle_count, TRIANGLES);
    assert_memory_equal(scene.positions, plain.positions, TRIANGLES * 9 * sizeof(float));
    glint_scene_free(&scene);
    glint_scene_free(&plain);
    free(rest);
    free(bytes);
}

// ---- Counts -------------------------------------------------------------------------------------

static void a_lie_is_refused(const char *folder, const unsigned char *bytes, size_t size,
                             const char *rest, const char *said)
{
    char *text = gltf_text(bytes, size, rest);
    glint_scene scene;
    glint_error error = {0};
    if (load_text(folder, text, &scene, NULL, &error) != GLINT_BAD_INPUT) {
        fail_msg("not refused; it should say: %s", said);
    }
    if (strstr(error.message, said) == NULL || strchr(error.message, '\n') != NULL) {
        fail_msg("%s: does not say: %s", error.message, said);
    }
    free(text);
}

// Replaces every `from` by `to`. The caller frees the result.
static char *replaced(const char *text, const char *from, const char *to)
{
    char *result;
    size_t size;
    FILE *stream = open_memstream(&result, &size);
    assert_non_null(stream);
    for (const char *at; (at = strstr(text, from)) != NULL; text = at + strlen(from)) {
        fprintf(stream, "%.*s%s", (int)(at - text), text, to);
    }
    fputs(text, stream);
    fclose(stream);
    return result;
}

// The packed data decides how many vertices and corners there are. A warning says where accessors
// have others.
static void accessors_with_other_counts_change_nothing(void **state)
{
    static const struct {
        const char *from, *to;
        bool is_told;
    } counts[] = {
        {"\"count\":144", "\"count\":144", false},
        {"\"count\":144", "\"count\":143", true},
        {"\"count\":144", "\"count\":146", true},
        {"\"count\":144", "\"count\":1", true},
        {"\"count\":144", "\"count\":9007199254740991", true},
        {"\"count\":144,\"type\":\"VEC4\"", "\"count\":7,\"type\":\"VEC4\"", true},
        {"\"count\":726", "\"count\":723", true},
        {"\"count\":726", "\"count\":729", true},
        {"\"count\":726", "\"count\":1", true},
        {"\"count\":726", "\"count\":900000000000", true},
        {"\"indices\":2,", "", true},
    };
    const sheet made = make_sheet();
    glint_scene plain = load_packed(*state, &made, false, 0);
    size_t size;
    unsigned char *bytes = pack(&made, false, 0, &size);
    char *rest = rest_of(size, PRIMITIVE);
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        char *changed = replaced(rest, counts[i].from, counts[i].to);
        char *text = gltf_text(bytes, size, changed);
        glint_scene scene;
        glint_warnings warnings = {0};
        glint_error error = {0};
        if (load_text(*state, text, &scene, &warnings, &error) != GLINT_OK) {
            fail_msg("%s: %s", counts[i].to, error.message);
        }
        scene_by_corner(&scene);
        assert_int_equal(scene.triangle_count, TRIANGLES);
        assert_memory_equal(scene.positions, plain.positions, TRIANGLES * 9 * sizeof(float));
        assert_memory_equal(scene.normals, plain.normals, TRIANGLES * 9 * sizeof(float));
        assert_int_equal(warnings.count, counts[i].is_told);
        assert_int_equal(any_warning_has(&warnings, "meshes[0].primitives[0]: Draco's data has "),
                         counts[i].is_told);
        glint_warnings_free(&warnings);
        glint_scene_free(&scene);
        free(text);
        free(changed);
    }
    glint_scene_free(&plain);
    free(rest);
    free(bytes);
}

// Primitives of one view may have accessors with different counts. Each is told of once.
static void primitives_of_a_view_may_say_different_counts(void **state)
{
    const sheet made = make_sheet();
    size_t size;
    unsigned char *bytes = pack(&made, true, 0, &size);
    char *rest = rest_of(size, PRIMITIVE ",{\"attributes\":{\"POSITION\":4},\"indices\":5,"
                                         "\"extensions\":{\"KHR_draco_mesh_compression\":{"
                                         "\"bufferView\":0,\"attributes\":{\"POSITION\":0}}}}");
    char *more = replaced(rest, "\"type\":\"VEC4\"}",
                          "\"type\":\"VEC4\"},"
                          "{\"componentType\":5126,\"count\":150,\"type\":\"VEC3\"},"
                          "{\"componentType\":5125,\"count\":3,\"type\":\"SCALAR\"}");
    char *text = gltf_text(bytes, size, more);
    glint_scene scene;
    glint_warnings warnings = {0};
    assert_int_equal(load_text(*state, text, &scene, &warnings, NULL), GLINT_OK);
    scene_by_corner(&scene);
    assert_int_equal(scene.triangle_count, 2 * TRIANGLES);
    assert_memory_equal(scene.positions, scene.positions + 9 * TRIANGLES,
                        TRIANGLES * 9 * sizeof(float));
    assert_int_equal(warnings.count, 1);
    assert_true(any_warning_has(&warnings, "meshes[0].primitives[1]: Draco's data has"));
    glint_warnings_free(&warnings);
    glint_scene_free(&scene);
    free(text);
    free(more);
    free(rest);
    free(bytes);
}

// Data that is not packed must go with the packed vertices.
static void targets_must_fit_the_packed_vertices(void **state)
{
    const sheet made = make_sheet();
    size_t size;
    unsigned char *bytes = pack(&made, false, 0, &size);
    char *rest = rest_of(size, PRIMITIVE);
    char *more = replaced(rest, "\"type\":\"VEC4\"}",
                          "\"type\":\"VEC4\"},"
                          "{\"componentType\":5126,\"count\":143,\"type\":\"VEC3\"}");
    char *with_target = replaced(more, "\"mode\":4", "\"mode\":4,\"targets\":[{\"POSITION\":4}]");
    char *text = gltf_text(bytes, size, with_target);
    assert_refused(write_bytes(*state, "bad.gltf", text, strlen(text)),
                   "meshes[0].primitives[0].targets[0].POSITION: accessors[4] has 143 elements, "
                   "POSITION has 144");
    free(text);
    free(with_target);
    free(more);
    free(rest);
    free(bytes);
}

// Writes a file that wants the normals and colours of a mesh in all component types, and as many
// elements as it says.
static char *greedy_rest(size_t size, const char *count)
{
    static const int types[] = {5120, 5121, 5122, 5123, 5125, 5126};
    char accessors[4096], attributes[1024], ids[1024], all[16384];
    char *a = accessors, *b = attributes, *c = ids;
    for (int i = 0; i < 12; i++) {
        a += sprintf(a, ",{\"componentType\":%d,\"count\":%s,\"type\":\"VEC%d\"}", types[i % 6],
                     count, i < 6 ? 3 : 4);
        b += sprintf(b, ",\"_%d\":%d", i, 4 + i);
        c += sprintf(c, ",\"_%d\":%d", i, i < 6 ? 1 : 2);
    }
    snprintf(all, sizeof all,
             REQUIRED "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%zu}]," ACCESSORS
                      ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0%s},"
                      "\"extensions\":{\"KHR_draco_mesh_compression\":{\"bufferView\":0,"
                      "\"attributes\":{\"POSITION\":0%s}}}}]}]" NODES,
             size, attributes, ids);
    char tail[8192];
    snprintf(tail, sizeof tail, "\"type\":\"VEC4\"}%s],\"meshes\"", accessors);
    return replaced(all, "\"type\":\"VEC4\"}],\"meshes\"", tail);
}

// A flat grid, whose vertices stand on quantised places, packs into half a byte a vertex. The
// accessors must ask for it: else a small file could fill the memory.
static void what_no_accessor_asked_for_has_a_limit(void **state)
{
    enum { side = 256, vertices = side * side, faces = (side - 1) * (side - 1) * 2 };
    float(*positions)[3] = calloc(vertices, sizeof *positions);
    float(*normals)[3] = calloc(vertices, sizeof *normals);
    uint8_t(*colors)[4] = calloc(vertices, sizeof *colors);
    uint32_t(*indices)[3] = calloc(faces, sizeof *indices);
    assert_true(positions && normals && colors && indices);
    for (uint32_t i = 0, f = 0; i < vertices; i++) {
        const uint32_t row = i / side, column = i % side;
        positions[i][0] = (float)column;
        positions[i][1] = (float)row;
        normals[i][2] = 1;
        if (column + 1 < side && row + 1 < side) {
            memcpy(indices[f++], (uint32_t[]){i, i + 1, i + side}, 12);
            memcpy(indices[f++], (uint32_t[]){i + 1, i + side + 1, i + side}, 12);
        }
    }
    const draco_mesh grid = {vertices,  faces,      positions[0],        normals[0],
                             colors[0], indices[0], .edgebreaker = true, .bits = 8};
    size_t size;
    unsigned char *bytes = draco_pack(&grid, &size);
    assert_non_null(bytes);
    // A vertex takes 12 bytes for its position, 42 for the normals of all types, 56 for the
    // colours.
    const size_t results = faces * sizeof *indices + vertices * (size_t)(12 + 42 + 56);
    assert_true(results > size * 256 && results > (1 << 20));
    char *rest = greedy_rest(size, "1");
    a_lie_is_refused(*state, bytes, size, rest, " packed bytes may take ");
    free(rest);
    rest = greedy_rest(size, "65536");
    glint_scene scene = load_by_corner(*state, bytes, size, rest);
    assert_int_equal(scene.triangle_count, faces);
    glint_scene_free(&scene);
    free(rest);
    free(bytes);
    free(positions);
    free(normals);
    free(colors);
    free(indices);
}

// ---- Refusals -----------------------------------------------------------------------------------

// Replaces `from` by `to` in the good text.
static void every_lie_is_named(void **state)
{
    static const struct {
        const char *from, *to, *said;
    } lies[] = {
        {"\"bufferView\":0,\"attributes\"", "\"attributes\"", "bufferView: missing"},
        {"\"bufferView\":0,\"attributes\"", "\"bufferView\":1,\"attributes\"",
         "bufferView: 1: there is no such bufferView"},
        {"\"NORMAL\":1,\"COLOR_0\":2}", "\"NORMAL\":7,\"COLOR_0\":2}",
         "bufferViews[0]: Draco's data has no attribute 7"},
        {"\"NORMAL\":1,\"COLOR_0\":2}", "\"NORMAL\":2,\"COLOR_0\":2}",
         "Draco's attribute 2 has 4 components, its accessor 3"},
        {"\"NORMAL\":1,\"COLOR_0\":2}", "\"NORMAL\":-1,\"COLOR_0\":2}", "NORMAL: -1 is out of"},
        {"\"NORMAL\":1,\"COLOR_0\":2}", "\"TANGENT\":1}", "the primitive has no such attribute"},
        {"\"POSITION\":0,\"NORMAL\":1,\"COLOR_0\":2}", "}", "attributes: empty"},
        {"\"mode\":4", "\"mode\":6", "mode: 6 cannot be packed by Draco"},
        {"{\"bufferView\":0,\"attributes\"", "7,\"x\":{\"attributes\"", "7 stands where an object"},
    };
    const sheet made = make_sheet();
    size_t size;
    unsigned char *bytes = pack(&made, false, 0, &size);
    char *rest = rest_of(size, PRIMITIVE);
    for (size_t i = 0; i < sizeof lies / sizeof lies[0]; i++) {
        const char *at = strstr(rest, lies[i].from);
        assert_non_null(at);
        char changed[8192];
        snprintf(changed, sizeof changed, "%.*s%s%s", (int)(at - rest), rest, lies[i].to,
                 at + strlen(lies[i].from));
        a_lie_is_refused(*state, bytes, size, changed, lies[i].said);
    }
    bytes[0] = 'X';
    a_lie_is_refused(*state, bytes, size, rest, "bufferViews[0]: Draco cannot decode it: ");
    free(rest);
    free(bytes);
}

static void damaged_bytes_are_refused_or_read(void **state)
{
    const sheet made = make_sheet();
    for (int edgebreaker = 0; edgebreaker < 2; edgebreaker++) {
        size_t size, refused = 0;
        unsigned char *bytes = pack(&made, edgebreaker != 0, 11, &size);
        char *rest = rest_of(size, PRIMITIVE);
        for (size_t i = 0; i < size; i += 1 + size / 60) {
            bytes[i] ^= (unsigned char)(1 + i % 255);
            char *text = gltf_text(bytes, size, rest);
            glint_scene scene;
            const glint_status status = load_text(*state, text, &scene, NULL, NULL);
            assert_true(status == GLINT_OK || status == GLINT_BAD_INPUT);
            refused += status == GLINT_BAD_INPUT;
            glint_scene_free(&scene);
            free(text);
            bytes[i] ^= (unsigned char)(1 + i % 255);
        }
        assert_true(refused > 0);
        free(rest);
        free(bytes);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sequential_packing_keeps_every_bit),
        cmocka_unit_test(edgebreaker_keeps_every_triangle),
        cmocka_unit_test(quantised_positions_err_by_half_a_step),
        cmocka_unit_test(primitives_can_share_a_view),
        cmocka_unit_test(strips_are_lists_once_decoded),
        cmocka_unit_test(accessors_with_other_counts_change_nothing),
        cmocka_unit_test(primitives_of_a_view_may_say_different_counts),
        cmocka_unit_test(targets_must_fit_the_packed_vertices),
        cmocka_unit_test(what_no_accessor_asked_for_has_a_limit),
        cmocka_unit_test(every_lie_is_named),
        cmocka_unit_test(damaged_bytes_are_refused_or_read),
    };
    return cmocka_run_group_tests(tests, scratch_setup, scratch_teardown);
}
