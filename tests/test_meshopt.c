// Tests views packed by meshoptimizer: unpacking keeps the data, and errors name the damaged part.
#include "scene/scene.h"

#include "support/by_corner.h"
#include "support/gltf_text.h"
#include "support/scratch.h"

#include <meshoptimizer.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// A wavy sheet of SIDE × SIDE vertices.
enum { SIDE = 20, VERTICES = SIDE * SIDE, INDICES = (SIDE - 1) * (SIDE - 1) * 6 };

typedef struct sheet {
    float positions[VERTICES][3];
    float normals[VERTICES][3];
    unsigned indices[INDICES];
} sheet;

static sheet make_sheet(void)
{
    sheet made = {0};
    for (int i = 0; i < VERTICES; i++) {
        const int row = i / SIDE;
        const float x = (float)(i % SIDE), y = (float)row;
        const float slope = 0.3f * cosf(0.7f * x), z = 0.3f / 0.7f * sinf(0.7f * x);
        const float length = sqrtf(1 + slope * slope);
        memcpy(made.positions[i], (float[]){x / 3, y / 7, z}, sizeof made.positions[i]);
        memcpy(made.normals[i], (float[]){-slope / length, 0, 1 / length}, sizeof made.normals[i]);
    }
    unsigned *to = made.indices;
    for (unsigned y = 0; y + 1 < SIDE; y++) {
        for (unsigned x = 0; x + 1 < SIDE; x++) {
            const unsigned a = y * SIDE + x, b = a + 1, c = a + SIDE, d = c + 1;
            memcpy(to, (unsigned[]){a, b, c, b, d, c}, 6 * sizeof *to);
            to += 6;
        }
    }
    return made;
}

// ---- Files --------------------------------------------------------------------------------------

// A buffer of packed bytes, and the views that unpack it.
typedef struct pack {
    unsigned char bytes[1 << 16];
    size_t length;   // a multiple of 4
    size_t unpacked; // bytes of the placeholder buffer
    char views[4096];
    const char *extension;
} pack;

typedef struct view {
    const char *mode, *filter; // filter NULL: no filter is named
    size_t count, stride;
    bool has_stride; // the view declares a stride: vertices
} view;

static void add_view(pack *to, const view *added, size_t length)
{
    char own[64] = "", filter[64] = "";
    if (added->has_stride) {
        snprintf(own, sizeof own, ",\"byteStride\":%zu", added->stride);
    }
    if (added->filter != NULL) {
        snprintf(filter, sizeof filter, ",\"filter\":\"%s\"", added->filter);
    }
    const size_t used = strlen(to->views), size = added->count * added->stride;
    assert_true(length > 0 && to->length + length <= sizeof to->bytes);
    snprintf(to->views + used, sizeof to->views - used,
             "%s{\"buffer\":1,\"byteOffset\":%zu,\"byteLength\":%zu%s,\"extensions\":{\"%s\":{"
             "\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu,\"byteStride\":%zu,\"count\":%zu,"
             "\"mode\":\"%s\"%s}}}",
             used > 0 ? "," : "", to->unpacked, size, own, to->extension, to->length, length,
             added->stride, added->count, added->mode, filter);
    to->length += (length + 3) / 4 * 4;
    to->unpacked += (size + 3) / 4 * 4;
}

static void pack_vertices(pack *to, const void *data, size_t count, size_t stride,
                          const char *filter)
{
    const view added = {"ATTRIBUTES", filter, count, stride, true};
    add_view(to, &added,
             meshopt_encodeVertexBuffer(to->bytes + to->length, sizeof to->bytes - to->length, data,
                                        count, stride));
}

static void pack_indices(pack *to, const sheet *made, bool are_triangles, size_t size)
{
    const view added = {are_triangles ? "TRIANGLES" : "INDICES", NULL, INDICES, size, false};
    unsigned char *at = to->bytes + to->length;
    const size_t room = sizeof to->bytes - to->length;
    add_view(to, &added,
             are_triangles ? meshopt_encodeIndexBuffer(at, room, made->indices, INDICES)
                           : meshopt_encodeIndexSequence(at, room, made->indices, INDICES));
}

// The text of a file that names packed.bin. The caller frees it.
static char *text_of(const char *folder, const pack *from, const char *rest)
{
    write_bytes(folder, "packed.bin", from->bytes, from->length);
    char *text = malloc(16384);
    assert_non_null(text);
    snprintf(text, 16384,
             "{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"%s\","
             "\"KHR_mesh_quantization\"],\"buffers\":[{\"byteLength\":%zu,\"uri\":\"packed.bin\"},"
             "{\"byteLength\":%zu,\"extensions\":{\"%s\":{\"fallback\":true}}}],"
             "\"bufferViews\":[%s],%s}",
             from->extension, from->length, from->unpacked, from->extension, from->views, rest);
    return text;
}

#define ACCESSOR(view, component, count, type)                                                     \
    "{\"bufferView\":" #view ",\"componentType\":" #component ",\"count\":" #count                 \
    ",\"type\":\"" #type "\"}"
#define MESH                                                                                       \
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1},\"indices\":2}]}]"
#define SHEET(normals, component)                                                                  \
    "\"accessors\":[" ACCESSOR(0, 5126, 400, VEC3) "," normals "," ACCESSOR(                       \
        2, component, 2166, SCALAR) "]," MESH ",\"nodes\":[{\"mesh\":0}]," ONE_SCENE
#define FLOAT_NORMALS ACCESSOR(1, 5126, 400, VEC3)
#define BYTE_NORMALS                                                                               \
    "{\"bufferView\":1,\"componentType\":5120,\"normalized\":true,\"count\":400,\"type\":"         \
    "\"VEC3\"}"

static glint_scene load_good(const char *folder, const pack *from, const char *rest)
{
    char *text = text_of(folder, from, rest);
    glint_scene scene;
    glint_error error = {0};
    if (load_text(folder, text, &scene, NULL, &error) != GLINT_OK) {
        fail_msg("%s", error.message);
    }
    free(text);
    scene_by_corner(&scene);
    return scene;
}

// Loads the sheet without packing.
static glint_scene load_plain(const char *folder, const sheet *made)
{
    return load_by_corner(
        folder, made, sizeof *made,
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":4800},{\"buffer\":0,"
        "\"byteOffset\":4800,\"byteLength\":4800},{\"buffer\":0,\"byteOffset\":9600,"
        "\"byteLength\":8664}]," SHEET(FLOAT_NORMALS, 5125));
}

// ---- Lossless -----------------------------------------------------------------------------------

// The packer may rotate the corners of a triangle. The winding stays.
static bool is_same_triangle(const float *a, const float *b)
{
    for (int turn = 0; turn < 3; turn++) {
        bool is_same = true;
        for (int i = 0; i < 9; i++) {
            is_same = is_same && a[i] == b[(i + 3 * turn) % 9];
        }
        if (is_same) {
            return true;
        }
    }
    return false;
}

static void plain_packing_keeps_every_bit(void **state)
{
    const sheet made = make_sheet();
    glint_scene plain = load_plain(*state, &made);
    for (int kind = 0; kind < 8; kind++) {
        const bool are_triangles = (kind & 1) != 0, are_short = (kind & 2) != 0;
        pack packed = {.extension =
                           kind & 4 ? "KHR_meshopt_compression" : "EXT_meshopt_compression"};
        pack_vertices(&packed, made.positions, VERTICES, 12, NULL);
        pack_vertices(&packed, made.normals, VERTICES, 12, "NONE");
        pack_indices(&packed, &made, are_triangles, are_short ? 2 : 4);
        glint_scene scene = load_good(
            *state, &packed, are_short ? SHEET(FLOAT_NORMALS, 5123) : SHEET(FLOAT_NORMALS, 5125));
        assert_int_equal(scene.triangle_count, INDICES / 3);
        assert_int_equal(scene.triangle_count, plain.triangle_count);
        for (size_t t = 0; t < scene.triangle_count; t++) {
            assert_true(is_same_triangle(scene.positions + 9 * t, plain.positions + 9 * t));
            assert_true(is_same_triangle(scene.normals + 9 * t, plain.normals + 9 * t));
        }
        if (!are_triangles) {
            assert_memory_equal(scene.positions, plain.positions, INDICES * 12);
        }
        glint_scene_free(&scene);
    }
    glint_scene_free(&plain);
}

// Two views of the same packed bytes, and a placeholder without the flag for one.
static void packed_bytes_can_be_shared(void **state)
{
    const sheet made = make_sheet();
    pack packed = {.extension = "EXT_meshopt_compression"};
    pack_vertices(&packed, made.positions, VERTICES, 12, NULL);
    char *first = strdup(packed.views);
    assert_non_null(first);
    const size_t used = strlen(packed.views);
    snprintf(packed.views + used, sizeof packed.views - used, ",%s", first);
    free(first);
    pack_indices(&packed, &made, true, 4);
    char *text = text_of(*state, &packed, SHEET(FLOAT_NORMALS, 5125));
    char *mark = strstr(text, ",\"extensions\":{\"EXT_meshopt_compression\":{\"fallback\":true}}");
    assert_non_null(mark);
    memset(mark, ' ', strcspn(mark, "]") - 1);
    glint_scene scene;
    glint_error error = {0};
    if (load_text(*state, text, &scene, NULL, &error) != GLINT_OK) {
        fail_msg("%s", error.message);
    }
    assert_int_equal(scene.triangle_count, INDICES / 3);
    glint_scene_free(&scene);
    free(text);
}

// ---- Filters ------------------------------------------------------------------------------------

static double distance(const float *a, const float *b)
{
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return sqrt(x * x + y * y + z * z);
}

// Distance of vertex i between two scenes.
static double apart(const glint_scene *a, const glint_scene *b, size_t i)
{
    const float *p = a->positions + 3 * i, *q = b->positions + 3 * i;
    const double x = (p[0] * a->unit + a->origin.x) - (q[0] * b->unit + b->origin.x);
    const double y = (p[1] * a->unit + a->origin.y) - (q[1] * b->unit + b->origin.y);
    const double z = (p[2] * a->unit + a->origin.z) - (q[2] * b->unit + b->origin.z);
    return sqrt(x * x + y * y + z * z);
}

static void filters_err_by_their_quantum(void **state)
{
    enum { BITS = 15 };
    const sheet made = make_sheet();
    glint_scene plain = load_plain(*state, &made);
    float filtered[VERTICES][3], directions[VERTICES][4] = {{0}};
    signed char octahedral[VERTICES][4];
    double largest = 0;
    for (int i = 0; i < VERTICES; i++) {
        memcpy(directions[i], made.normals[i], sizeof made.normals[i]);
        for (int c = 0; c < 3; c++) {
            largest = fmax(largest, fabs((double)made.positions[i][c]));
        }
    }
    meshopt_encodeFilterExp(filtered, VERTICES, 12, BITS, &made.positions[0][0]);
    meshopt_encodeFilterOct(octahedral, VERTICES, 4, 8, &directions[0][0]);
    pack packed = {.extension = "EXT_meshopt_compression"};
    pack_vertices(&packed, filtered, VERTICES, 12, "EXPONENTIAL");
    pack_vertices(&packed, octahedral, VERTICES, 4, "OCTAHEDRAL");
    pack_indices(&packed, &made, false, 4);
    glint_scene scene = load_good(*state, &packed, SHEET(BYTE_NORMALS, 5125));
    // The largest component of a vertex has BITS − 1 digits, at least one of them significant. So
    // the quantum is at most 2^(2 − BITS) of the component. Each of three components errs by half
    // of this.
    const double bound = sqrt(3) * largest * pow(2, 1 - BITS);
    // Half a step of 1/127 moves a point of the octahedron by √6/254. The least distance of the
    // octahedron to its centre is 1/√3. Bytes round each component of the direction by 1/254.
    const double turned = (sqrt(18) + sqrt(3)) / 254;
    double largest_error = 0;
    for (size_t i = 0; i < 3 * plain.triangle_count; i++) {
        largest_error = fmax(largest_error, apart(&plain, &scene, i));
        assert_true(distance(plain.normals + 3 * i, scene.normals + 3 * i) <= turned);
    }
    assert_true(largest_error > 0 && largest_error <= bound);
    glint_scene_free(&scene);
    glint_scene_free(&plain);
}

// Instances rotated by packed quaternions must match instances rotated by plain quaternions.
static void quaternions_are_unpacked(void **state)
{
    const float turns[4][4] = {{0.5f, 0.5f, 0.5f, 0.5f},
                               {0, 0.6f, 0, 0.8f},
                               {-0.36f, 0.48f, 0.64f, 0.48f},
                               {0.8f, 0, -0.6f, 0}};
    short filtered[4][4];
    meshopt_encodeFilterQuat(filtered, 4, 8, 16, &turns[0][0]);
    pack packed = {.extension = "EXT_meshopt_compression"};
    pack_vertices(&packed, the_tetrahedron.positions, 4, 12, NULL);
    pack_vertices(&packed, filtered, 4, 8, "QUATERNION");
    glint_scene scene = load_good(
        *state, &packed,
        "\"accessors\":[" ACCESSOR(
            0, 5126, 3,
            VEC3) ",{\"bufferView\":1,\"componentType\":5122,"
                  "\"normalized\":true,\"count\":4,\"type\":\"VEC4\"}],\"meshes\":[{\"primitives\":"
                  "[{"
                  "\"attributes\":{\"POSITION\":0}}]}],\"nodes\":[{\"mesh\":0,\"extensions\":{"
                  "\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"ROTATION\":1}}}}]," ONE_SCENE);
    assert_int_equal(scene.triangle_count, 4);
    for (size_t i = 0; i < 4; i++) {
        const double x = turns[i][0], y = turns[i][1], z = turns[i][2], w = turns[i][3];
        // The new place of the vertex (1, 0, 0).
        const double expected[3] = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w),
                                    2 * (x * z - y * w)};
        const float *p = scene.positions + 9 * i + 3;
        const double at[3] = {p[0] * scene.unit + scene.origin.x,
                              p[1] * scene.unit + scene.origin.y,
                              p[2] * scene.unit + scene.origin.z};
        for (int c = 0; c < 3; c++) {
            // A component has 15 bits, packed and unpacked: a rotation errs by 2·10⁻⁴.
            assert_true(fabs(at[c] - expected[c]) <= 2e-4);
        }
    }
    glint_scene_free(&scene);
}

// ---- Damage -------------------------------------------------------------------------------------

static void a_lie_is_refused(const char *folder, const char *text, const char *said)
{
    glint_scene scene;
    glint_error error = {0};
    if (load_text(folder, text, &scene, NULL, &error) != GLINT_BAD_INPUT) {
        fail_msg("not refused; it should say: %s", said);
    }
    if (strstr(error.message, said) == NULL) {
        fail_msg("%s: does not say: %s", error.message, said);
    }
}

// Replaces `from` by `to` in the good text.
static const struct {
    const char *from, *to, *said;
} lies[] = {
    {"\"mode\":\"ATTRIBUTES\"", "\"mode\":\"attributes\"", "\"attributes\" is not read"},
    {"\"mode\":\"ATTRIBUTES\"", "\"other\":1", "mode: missing"},
    {"\"mode\":\"ATTRIBUTES\"", "\"mode\":\"TRIANGLES\"", "12 is no size of an index"},
    {"\"mode\":\"TRIANGLES\"", "\"mode\":\"ATTRIBUTES\"", "begin with 224, which is no format"},
    {"\"mode\":\"TRIANGLES\"", "\"mode\":\"TRIANGLES\",\"filter\":\"OCTAHEDRAL\"",
     "indices have no filter"},
    {"\"mode\":\"ATTRIBUTES\"", "\"mode\":\"ATTRIBUTES\",\"filter\":\"COLOR\"",
     "\"COLOR\" is not read (NONE, OCTAHEDRAL, QUATERNION, EXPONENTIAL are)"},
    {"\"mode\":\"ATTRIBUTES\"", "\"mode\":\"ATTRIBUTES\",\"filter\":\"OCTAHEDRAL\"",
     "12 does not go with the filter"},
    {"\"mode\":\"ATTRIBUTES\"", "\"mode\":\"ATTRIBUTES\",\"filter\":\"QUATERNION\"",
     "12 does not go with the filter"},
    {"\"byteStride\":12,\"count\":400", "\"byteStride\":16,\"count\":400",
     "16 is not the view's own byteStride, 12"},
    {"\"byteStride\":12,\"count\":400", "\"byteStride\":0,\"count\":400",
     "byteStride: 0 is out of range"},
    {"\"byteStride\":12,\"count\":400", "\"byteStride\":260,\"count\":400", "out of range"},
    {"\"count\":400,\"mode\"", "\"count\":399,\"mode\"",
     "count: 399 elements of 12 bytes are not the view's byteLength, 4800"},
    {"\"count\":400,\"mode\"", "\"count\":0,\"mode\"", "count: 0 is out of range"},
    {"\"count\":400,\"mode\"", "\"count\":9007199254740991,\"mode\"", "are not the view's"},
    {"\"count\":400,\"mode\"", "\"count\":1e300,\"mode\"", "count: "},
    {"\"count\":2166,\"mode\"", "\"count\":2165,\"mode\"", "2165 indices are no whole triang"},
    {"{\"buffer\":0,\"byteOffset\":0", "{\"buffer\":7,\"byteOffset\":0",
     "EXT_meshopt_compression.buffer: 7: there is no such buffer"},
    {"{\"buffer\":0,\"byteOffset\":0", "{\"byteOffset\":0", "buffer: missing"},
    {"{\"buffer\":0,\"byteOffset\":0", "{\"buffer\":0,\"byteOffset\":9007199254740991",
     "run past the end of buffers[0]"},
    {"{\"buffer\":0,\"byteOffset\":0", "{\"buffer\":1,\"byteOffset\":0",
     "buffers[1]: a fallback, but not only packed views refer to it"},
    {"{\"fallback\":true}", "{\"fallback\":1}", "fallback: 1 stands where"},
    {"{\"fallback\":true}", "7", "7 stands where an object must stand"},
    {"{\"fallback\":true}", "{}},\"extras\":{\"was\":{}", ""},
    {"\"byteLength\":18264,", "\"byteLength\":18263,", "run past the end of buffers[1]"},
};

static void every_lie_is_named(void **state)
{
    const sheet made = make_sheet();
    pack packed = {.extension = "EXT_meshopt_compression"};
    pack_vertices(&packed, made.positions, VERTICES, 12, NULL);
    pack_vertices(&packed, made.normals, VERTICES, 12, NULL);
    pack_indices(&packed, &made, true, 4);
    char *text = text_of(*state, &packed, SHEET(FLOAT_NORMALS, 5125));
    for (size_t i = 0; i < sizeof lies / sizeof lies[0]; i++) {
        const char *at = strstr(text, lies[i].from);
        assert_non_null(at);
        char changed[16384];
        snprintf(changed, sizeof changed, "%.*s%s%s", (int)(at - text), text, lies[i].to,
                 at + strlen(lies[i].from));
        if (lies[i].said[0] != '\0') {
            a_lie_is_refused(*state, changed, lies[i].said);
        } else {
            glint_scene scene;
            assert_int_equal(load_text(*state, changed, &scene, NULL, NULL), GLINT_OK);
            glint_scene_free(&scene);
        }
    }
    free(text);
}

// A file that two buffers name is read once.
static void packed_views_may_name_any_buffer_of_a_file(void **state)
{
    const sheet made = make_sheet();
    pack packed = {.extension = "EXT_meshopt_compression"};
    pack_vertices(&packed, made.positions, VERTICES, 12, NULL);
    pack_vertices(&packed, made.normals, VERTICES, 12, NULL);
    pack_indices(&packed, &made, true, 4);
    char *text = text_of(*state, &packed, SHEET(FLOAT_NORMALS, 5125));
    char *first = strstr(text, "{\"buffer\":0,\"byteOffset\":0");
    char *end = strstr(text, "}],\"bufferViews\"");
    assert_non_null(first);
    assert_non_null(end);
    first[strlen("{\"buffer\":")] = '2';
    char changed[16384];
    snprintf(changed, sizeof changed, "%.*s},{\"byteLength\":%zu,\"uri\":\"packed.bin\"%s",
             (int)(end - text), text, packed.length, end);
    glint_scene scene;
    glint_error error = {0};
    if (load_text(*state, changed, &scene, NULL, &error) != GLINT_OK) {
        fail_msg("%s", error.message);
    }
    assert_int_equal(scene.triangle_count, INDICES / 3);
    glint_scene_free(&scene);
    free(text);
}

// glint must refuse more elements than the packed bytes can hold, before it allocates memory.
static void small_files_cannot_unpack_the_world(void **state)
{
    static const unsigned zeros[4096];
    static const view huge = {"ATTRIBUTES", NULL, (size_t)1 << 44, 4, true};
    const char *rest = "\"scenes\":[{}]";
    pack packed = {.extension = "EXT_meshopt_compression"};
    packed.bytes[0] = 0xA0;
    add_view(&packed, &huge, 100);
    char *text = text_of(*state, &packed, rest);
    a_lie_is_refused(*state, text,
                     "17592186044416 elements of 4 bytes cannot stand in 100 packed bytes");
    free(text);
    // Each of the views alone is possible, but not all of them from the same bytes.
    packed = (pack){.extension = "EXT_meshopt_compression"};
    const size_t length =
        meshopt_encodeVertexBuffer(packed.bytes, sizeof packed.bytes, zeros, sizeof zeros / 4, 4);
    for (size_t i = 0; i < 8; i++) {
        const view one = {"ATTRIBUTES", NULL, sizeof zeros / 4 - i, 4, true};
        packed.length = 0;
        add_view(&packed, &one, length);
    }
    text = text_of(*state, &packed, rest);
    a_lie_is_refused(*state, text, "packed views overlap");
    free(text);
}

static void damaged_bytes_are_refused_or_read(void **state)
{
    const sheet made = make_sheet();
    pack packed = {.extension = "EXT_meshopt_compression"};
    pack_vertices(&packed, made.positions, VERTICES, 12, NULL);
    pack_vertices(&packed, made.normals, VERTICES, 12, NULL);
    pack_indices(&packed, &made, true, 4);
    char *text = text_of(*state, &packed, SHEET(FLOAT_NORMALS, 5125));
    const char *path = write_bytes(*state, "test.gltf", text, strlen(text));
    char name[4096];
    snprintf(name, sizeof name, "%s", path);
    size_t refused = 0;
    for (size_t i = 0; i < packed.length; i += 5) {
        pack damaged = packed;
        damaged.bytes[i] ^= (unsigned char)(1 + i % 255);
        write_bytes(*state, "packed.bin", damaged.bytes, damaged.length);
        glint_scene scene;
        glint_error error = {0};
        const glint_status status = glint_scene_load(name, NULL, &scene, NULL, &error);
        assert_true(status == GLINT_OK || status == GLINT_BAD_INPUT);
        refused += status == GLINT_BAD_INPUT;
        glint_scene_free(&scene);
    }
    assert_true(refused > 0);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plain_packing_keeps_every_bit),
        cmocka_unit_test(packed_bytes_can_be_shared),
        cmocka_unit_test(filters_err_by_their_quantum),
        cmocka_unit_test(quaternions_are_unpacked),
        cmocka_unit_test(every_lie_is_named),
        cmocka_unit_test(packed_views_may_name_any_buffer_of_a_file),
        cmocka_unit_test(small_files_cannot_unpack_the_world),
        cmocka_unit_test(damaged_bytes_are_refused_or_read),
    };
    return cmocka_run_group_tests(tests, scratch_setup, scratch_teardown);
}
