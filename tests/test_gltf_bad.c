// Tests bad input: glint must answer every bad file with one line that names the object and the
// cause. Nothing may crash, hang or ask for too much memory.
#include "scene/scene.h"

#include "support/gltf_text.h"
#include "support/scratch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>
#include <dirent.h>

// A bad file and the expected message. `rest` holds the members of the top level beside the
// tetrahedron's data.
typedef struct bad_case {
    const char *rest, *said;
} bad_case;

#define NODE ",\"nodes\":[{\"mesh\":0}]," ONE_SCENE
#define GOOD TETRAHEDRON NODE
#define VIEW "\"bufferViews\":[{\"buffer\":0,\"byteLength\":120}],"
#define ACCESSOR(text) VIEW "\"accessors\":[{" text "}]"
#define VEC3 "\"type\":\"VEC3\",\"componentType\":5126"
#define TETRAHEDRON_VIEWS                                                                          \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},{\"buffer\":0,\"byteOffset\":48,"           \
    "\"byteLength\":48}],"
#define NODES(text) TETRAHEDRON "," ONE_SCENE ",\"nodes\":[" text "]"
#define PRIMITIVE(text) TETRAHEDRON_STORAGE ",\"meshes\":[{\"primitives\":[{" text "}]}]" NODE
#define SPARSE(text) ACCESSOR("\"count\":9,\"bufferView\":0," VEC3 ",\"sparse\":{" text "}")
#define CAMERA(text) GOOD ",\"cameras\":[{" text "}]"

#define SKIN(count, joints)                                                                        \
    VIEW "\"accessors\":[{\"bufferView\":0,\"type\":\"MAT4\",\"componentType\":5126," count        \
         "}],\"nodes\":[{}],\"skins\":[{\"joints\":[" joints "],\"inverseBindMatrices\":0}]"
#define MORPH(mesh, node)                                                                          \
    TETRAHEDRON_STORAGE ",\"meshes\":[{" mesh ",\"primitives\":[{" TETRAHEDRON_PRIMITIVE           \
                        ",\"targets\":[{\"POSITION\":0},{}]}]}],\"nodes\":[{\"mesh\":0" node "}]"

static const bad_case cases[] = {
    // Buffers and views.
    {"\"bufferViews\":[{\"buffer\":0}]", "bufferViews[0].byteLength: missing"},
    {"\"bufferViews\":[{\"byteLength\":1}]", "bufferViews[0].buffer: missing"},
    {"\"bufferViews\":[{\"buffer\":1,\"byteLength\":1}]",
     "bufferViews[0].buffer: 1: there is no such buffer (the file has 1 buffer"},
    {"\"bufferViews\":[{\"buffer\":0.5,\"byteLength\":1}]", "bufferViews[0].buffer: 0.5: there is"},
    {"\"bufferViews\":[{\"buffer\":0,\"byteLength\":9007199254740991,\"byteOffset\":1}]",
     "bufferViews[0].byteLength: 9007199254740991 bytes from byte 1 run past"},
    {"\"bufferViews\":[{\"buffer\":0,\"byteLength\":18446744073709551615}]",
     "bufferViews[0].byteLength: 18446744073709551615 is out of range"},
    {"\"bufferViews\":[{\"buffer\":0,\"byteLength\":2,\"byteOffset\":119}]",
     "2 bytes from byte 119 run past the end of buffers[0], which has 120 bytes"},
    {"\"bufferViews\":[1]", "bufferViews[0]: 1 stands where an object must stand"},
    {"\"bufferViews\":{}", "bufferViews: an object stands where an array must stand"},
    // Accessors.
    {ACCESSOR("\"count\":1," VEC3 ",\"bufferView\":-1"),
     "accessors[0].bufferView: -1: there is no"},
    {ACCESSOR(VEC3), "accessors[0].count: missing"},
    {ACCESSOR("\"count\":true," VEC3), "accessors[0].count: true is out of range"},
    {ACCESSOR("\"count\":1,\"componentType\":5126"), "accessors[0].type: missing"},
    {ACCESSOR("\"count\":1,\"type\":3,\"componentType\":5126"),
     "accessors[0].type: 3 stands where"},
    {ACCESSOR("\"count\":1,\"type\":\"VEC3\",\"componentType\":5124"),
     "accessors[0].componentType: 5124 is none"},
    {ACCESSOR("\"count\":11," VEC3 ",\"bufferView\":0"),
     "accessors[0].count: 11 elements of 12 by"},
    {ACCESSOR("\"count\":10," VEC3 ",\"bufferView\":0,\"byteOffset\":1"),
     "accessors[0].count: 10 el"},
    {ACCESSOR("\"count\":9007199254740991," VEC3 ",\"bufferView\":0"), "9007199254740991 elements"},
    {ACCESSOR("\"count\":1," VEC3 ",\"bufferView\":0,\"byteOffset\":9007199254740991"),
     "from byte 9007199254740991 run past"},
    {ACCESSOR("\"count\":2000000000," VEC3), "accessors[0].count: 2000000000 zeros"},
    {ACCESSOR("\"count\":1," VEC3 ",\"normalized\":1"), "accessors[0].normalized: 1 stands where"},
    {"\"bufferViews\":[{\"buffer\":0,\"byteLength\":120,\"byteStride\":8}],\"accessors\":[{"
     "\"bufferView\":0,\"count\":2," VEC3 "}]",
     "accessors[0].bufferView: elements of 12 bytes overlap: bufferViews[0].byteStride is 8"},
    {ACCESSOR("\"count\":2,\"bufferView\":0,\"type\":\"MAT3\",\"componentType\":5120,"
              "\"byteOffset\":97"),
     "2 elements of 12 bytes"},
    // Sparse accessors.
    {SPARSE("\"count\":10"), "accessors[0].sparse.count: 10 is more than the accessor's 9"},
    {SPARSE("\"count\":0"), "accessors[0].sparse.count: 0 is out of range"},
    {SPARSE("\"count\":1"), "accessors[0].sparse.indices: missing"},
    {SPARSE("\"count\":1,\"indices\":{\"bufferView\":0,\"componentType\":5126}"),
     "accessors[0].sparse.indices.componentType: not an unsigned integer"},
    {SPARSE("\"count\":9,\"indices\":{\"bufferView\":0,\"componentType\":5125,\"byteOffset\":85}"),
     "accessors[0].sparse.indices: 9 elements of 4 bytes"},
    {SPARSE("\"count\":1,\"indices\":{\"bufferView\":0,\"componentType\":5121}"),
     "accessors[0].sparse.values: missing"},
    {SPARSE("\"count\":9,\"indices\":{\"bufferView\":0,\"componentType\":5121},\"values\":{"
            "\"bufferView\":0,\"byteOffset\":13}"),
     "accessors[0].sparse.values: 9 elements of 12 bytes"},
    // Meshes.
    {TETRAHEDRON_STORAGE ",\"meshes\":[{}]", "meshes[0].primitives: missing"},
    {TETRAHEDRON_STORAGE ",\"meshes\":[{\"primitives\":[7]}]",
     "meshes[0].primitives[0]: not an obj"},
    {PRIMITIVE("\"indices\":2"), "meshes[0].primitives[0].attributes: missing"},
    {PRIMITIVE("\"attributes\":{\"POSITION\":3}"), "attributes.POSITION: 3: there is no such acce"},
    {PRIMITIVE("\"attributes\":{\"POSITION\":2}"),
     "attributes.POSITION: the accessor holds SCALAR"},
    {PRIMITIVE("\"attributes\":{\"POSITION\":0,\"NORMAL\":2}"),
     "attributes.NORMAL: the accessor holds SCALAR"},
    {TETRAHEDRON_VIEWS "\"accessors\":[{\"bufferView\":0,\"count\":4," VEC3
                       "},{\"bufferView\":1,\"count\":3," VEC3 "}]"
                       ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,"
                       "\"NORMAL\":1}}]}]" NODE,
     "meshes[0].primitives[0].attributes.NORMAL: accessors[1] has 3 elements, POSITION has 4"},
    {PRIMITIVE("\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":-1}"),
     "attributes.TEXCOORD_0: -1: the"},
    {PRIMITIVE("\"attributes\":{\"POSITION\":0},\"indices\":0"),
     "meshes[0].primitives[0].indices: accessors[0] does not hold indices"},
    {PRIMITIVE("\"attributes\":{\"POSITION\":0},\"indices\":\"2\""),
     "meshes[0].primitives[0].indices: the text \"2\": there is no such accessor"},
    {PRIMITIVE("\"attributes\":{\"POSITION\":0},\"material\":0"),
     "primitives[0].material: 0: there is no such material (the file has none"},
    {PRIMITIVE("\"attributes\":{\"POSITION\":0},\"mode\":-1"),
     "primitives[0].mode: -1 is out of ra"},
    {PRIMITIVE("\"attributes\":{\"POSITION\":0},\"targets\":[{\"POSITION\":9}]"),
     "primitives[0].targets[0].POSITION: 9: there is no such accessor"},
    {PRIMITIVE("\"attributes\":{\"NORMAL\":1}"), "attributes.POSITION: missing"},
    // Nodes.
    {NODES("{\"mesh\":1}"), "nodes[0].mesh: 1: there is no such mesh (the file has 1 mesh"},
    {NODES("{\"camera\":0}"), "nodes[0].camera: 0: there is no such camera (the file has none"},
    {NODES("{\"skin\":0}"), "nodes[0].skin: 0: there is no such skin"},
    {NODES("{\"children\":[1]}"), "nodes[0].children[0]: 1: there is no such node"},
    {NODES("{\"children\":[0]}"), "nodes[0].children[0]: node loop"},
    {NODES("{\"children\":[1]},{\"children\":[0]}"), "node loop"},
    {NODES("{\"children\":[1]},{\"children\":[2]},{\"children\":[1]}"),
     "nodes[2].children[0]: node loop"},
    {NODES("{},{\"children\":[2]},{\"children\":[3]},{\"children\":[1]}"), "node loop"},
    {NODES("{\"children\":[2]},{\"children\":[2]},{}"),
     "nodes[1].children[0]: nodes[2] is a child of nodes[0] already"},
    {NODES("{\"children\":[1,1]},{}"), "nodes[0].children[1]: nodes[1] stands there twice"},
    {NODES("{\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0]}"), "nodes[0].matrix: 15 elements"},
    {NODES("{\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,1,0,0,0,1]}"), "nodes[0].matrix: its last row"},
    {NODES("{\"matrix\":[1,0,0,0,0,\"1\",0,0,0,0,1,0,0,0,0,1]}"), "nodes[0].matrix[5]: the text"},
    {NODES("{\"scale\":[1,1]}"), "nodes[0].scale: 2 elements"},
    {NODES("{\"translation\":[1,null,1]}"), "nodes[0].translation[1]: null stands where"},
    {NODES("{\"rotation\":[0,0,0,0]}"), "nodes[0].rotation: not a rotation"},
    {NODES("{\"mesh\":0,\"translation\":[1e30,0,0]}"), "nodes[0]: its mesh reaches farther than"},
    {NODES(
         "{\"mesh\":0,\"scale\":[1e300,1,1],\"children\":[1]},{\"mesh\":0,\"scale\":[1e300,1,1]}"),
     "its mesh reaches farther than"},
    {NODES("{\"extensions\":{\"EXT_mesh_gpu_instancing\":{}}}"),
     "EXT_mesh_gpu_instancing.attributes: missing"},
    {NODES("{\"mesh\":0,\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{"
           "\"TRANSLATION\":0,\"_ID\":2}}}}"),
     "attributes._ID: as many elements"},
    {NODES("{\"mesh\":0,\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{"
           "\"ROTATION\":0}}}}"),
     "attributes.ROTATION: the accessor holds VEC3"},
    // Scenes.
    {TETRAHEDRON ",\"nodes\":[{}],\"scenes\":[{\"nodes\":[1]}]",
     "scenes[0].nodes[0]: 1: there is no"},
    {GOOD ",\"scene\":1", "scene: 1: there is no such scene (the file has 1 scene"},
    // Cameras.
    {CAMERA("\"type\":\"fisheye\""), "cameras[0].type: \"fisheye\" is none"},
    {CAMERA("\"type\":\"perspective\""), "cameras[0].perspective: missing"},
    {CAMERA("\"type\":\"perspective\",\"perspective\":{}"), "cameras[0].perspective.yfov: missing"},
    {CAMERA("\"type\":\"perspective\",\"perspective\":{\"yfov\":3.2}"), "yfov: 3.2 is no vertical"},
    {CAMERA("\"type\":\"orthographic\",\"orthographic\":{\"ymag\":0}"),
     "ymag: 0: the camera sees n"},
    // Extensions, skins.
    {GOOD ",\"extensionsRequired\":[\"VENDOR_of_the_future\"]",
     "\"VENDOR_of_the_future\" is required by the file and not supported"},
    {GOOD ",\"extensionsRequired\":\"KHR_materials_ior\"", "extensionsRequired: the text"},
    {GOOD ",\"skins\":[{\"joints\":[]}]", "skins[0].joints: empty"},
    {GOOD ",\"skins\":[{\"joints\":[0,7]}]", "skins[0].joints[1]: 7: there is no such node"},
    {GOOD ",\"skins\":[{\"joints\":[0],\"inverseBindMatrices\":0}]",
     "skins[0].inverseBindMatrices: the accessor holds VEC3"},
    {SKIN("\"count\":1", "0,0"), "inverseBindMatrices: accessors[0] has 1 element for 2 joints"},
    {PRIMITIVE("\"attributes\":{\"POSITION\":0,\"JOINTS_0\":0}"),
     "primitives[0].attributes.WEIGHTS_0: missing beside JOINTS_0"},
    {PRIMITIVE("\"attributes\":{\"POSITION\":0,\"WEIGHTS_0\":0}"),
     "primitives[0].attributes.JOINTS_0: missing beside WEIGHTS_0"},
    {PRIMITIVE("\"attributes\":{\"POSITION\":0,\"JOINTS_0\":1,\"WEIGHTS_0\":0}"),
     "attributes.JOINTS_0: the accessor does not hold joints"},
    // Morph targets.
    {PRIMITIVE("\"attributes\":{\"POSITION\":0},\"targets\":[{\"POSITION\":2}]"),
     "primitives[0].targets[0].POSITION: the accessor holds SCALAR"},
    {PRIMITIVE("\"attributes\":{\"POSITION\":0},\"targets\":[3]"),
     "primitives[0].targets[0]: 3 stands where an object must stand"},
    {MORPH("\"weights\":[1,null]", ""), "meshes[0].weights[1]: null stands where"},
    {MORPH("\"weights\":{}", ""), "meshes[0].weights: an object stands where"},
    {GOOD ",\"skins\":[{}]", "skins[0].joints: missing"},
};

static void every_mistake_is_named(void **state)
{
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_rest_refused(*state, cases[i].rest, cases[i].said);
    }
}

static void data_that_lies_is_named(void **state)
{
    const char *folder = *state;
    tetrahedron data = the_tetrahedron;
    data.indices[7] = 4;
    char *text = gltf_text(&data, sizeof data, GOOD);
    assert_refused(write_bytes(folder, "bad.gltf", text, strlen(text)),
                   "meshes[0].primitives[0].indices: accessors[2], element 7: there is no vertex 4 "
                   "(POSITION has 4 elements)");
    free(text);
    data = the_tetrahedron;
    data.positions[2][1] = NAN;
    text = gltf_text(&data, sizeof data, GOOD);
    assert_refused(write_bytes(folder, "bad.gltf", text, strlen(text)),
                   "meshes[0].primitives[0].attributes.POSITION: vertex 2 is (0, nan, 0)");
    free(text);
    // The sparse indices are 0, 2, 1 and 0, 0, 0, but must ascend.
    const char *sparse =
        VIEW "\"accessors\":[{\"count\":%d," VEC3 ",\"sparse\":{\"count\":3,"
             "\"indices\":{\"bufferView\":0,\"byteOffset\":%d,\"componentType\":5123},"
             "\"values\":{\"bufferView\":0}}}],\"meshes\":[{\"primitives\":[{"
             "\"attributes\":{\"POSITION\":0}}]}]" NODE;
    char rest[1024];
    snprintf(rest, sizeof rest, sparse, 4, 96);
    text = gltf_text(&the_tetrahedron, sizeof the_tetrahedron, rest);
    assert_refused(write_bytes(folder, "bad.gltf", text, strlen(text)),
                   "accessors[0].sparse.indices[2]: 1 follows 2");
    free(text);
    snprintf(rest, sizeof rest, sparse, 3, 104);
    text = gltf_text(&the_tetrahedron, sizeof the_tetrahedron, rest);
    assert_refused(write_bytes(folder, "bad.gltf", text, strlen(text)),
                   "accessors[0].sparse.indices[1]: 3 is out of range");
    free(text);
}

static void restart_values_are_refused(void **state)
{
    static struct {
        float positions[300][3];
        unsigned char indices[4];
    } data = {.indices = {0, 1, 255, 2}};
    char *text = gltf_text(
        &data, sizeof data,
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":3604}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"count\":300,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"byteOffset\":3600,\"componentType\":5121,\"count\":4,\"type\":"
        "\"SCALAR\"}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,"
        "\"mode\":5}]}]" NODE);
    assert_refused(write_bytes(*state, "bad.gltf", text, strlen(text)),
                   "accessors[1], element 2: 255 restarts a primitive");
    free(text);
}

static void what_is_no_regular_file_below_the_folder_is_refused(void **state)
{
    const char *folder = *state;
    assert_int_equal(mkdir(folder_path(folder, "sub"), 0700), 0);
    assert_int_equal(mkfifo(folder_path(folder, "fifo"), 0600), 0);
    assert_int_equal(symlink("/dev/zero", folder_path(folder, "link")), 0);
    write_bytes(folder, "short.bin", "abc", 3);
    static const bad_case uris[] = {
        {"missing.bin", "\"missing.bin\": cannot be opened: No such file"},
        {"sub", "\"sub\": it is a folder"},
        {"fifo", "\"fifo\": it is no regular file"},
        {"link", "\"link\": lies outside the scene's folder"},
        {"%2e%2e/%2E%2E/etc/hostname", "etc/hostname\": "},
        {"..\\\\..", "\"..\\..\": lies outside"},
        {"../..", "\"../..\": lies outside"},
        {"file:///etc/hostname", "file: is not read"},
        {"https://a.b/c.bin", "https: is not read"},
        {"short.bin%00.png", "names no file"},
        {"", "\"\": names no file"},
        {"short.bin", "\"short.bin\" has 3 bytes, byteLength says 120"},
        {"data:base64", "a data URI without a comma"},
        {"data:;base64,AA*A", "character 15, \"*\", is no base64 digit"},
        {"data:;base64,AAAA", "the data URI holds 3 bytes, byteLength says 120"},
    };
    for (size_t i = 0; i < sizeof uris / sizeof uris[0]; i++) {
        char text[2048];
        int length = snprintf(text, sizeof text,
                              "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":120,"
                              "\"uri\":\"%s\"}]," GOOD "}",
                              uris[i].rest);
        assert_refused(write_bytes(folder, "bad.gltf", text, (size_t)length), uris[i].said);
    }
    assert_refused(folder, "cannot be opened: it is a folder");
    assert_refused("/dev/zero", "cannot be opened: it is no regular file");
    assert_refused(folder_path(folder, "none.gltf"), "cannot be opened: No such file");
}

// One number, in the first bytes of buffers[0].
#define FLOAT                                                                                      \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":4}],\"accessors\":[{\"bufferView\":0,"          \
    "\"componentType\":5126,\"count\":1,\"type\":\"SCALAR\"}]"

static void texts_that_are_not_json_or_not_gltf_are_named(void **state)
{
    static const bad_case texts[] = {
        {"{\"asset\":{\"version\":\"2.0\"},}", "byte 27: not JSON"},
        {"{\"asset\":{\"version\":\"2.0\"}", "byte 26: not JSON"},
        {"solid cube", "byte 0: not JSON"},
        {"[]", "the top level is no JSON object"},
        {"{\"asset\":1}", "asset: 1 stands where an object must stand"},
        {"{\"asset\":{}}", "asset.version: missing"},
        {"{\"asset\":{\"version\":\"1.0\"}}", "asset.version: \"1.0\" is not supported"},
        {"{\"asset\":{\"version\":\"2.1\",\"minVersion\":\"3.0\"}}",
         "asset.minVersion: \"3.0\" is"},
        {"{\"asset\":{\"version\":\"2.0\"},\"scene\":1e999}", "not JSON that can be used"},
        {"{\"asset\":{\"version\":3}}", "asset.version: \"3\" is not supported"},
        {"{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":4}]," FLOAT "}",
         "buffers[0].uri: missing (only a .glb"},
        {"{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":9e15,\"uri\":\"x\"}]," FLOAT
         "}",
         "buffers[0].byteLength: the buffers have more than 8 GiB"},
    };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        assert_refused(write_bytes(*state, "bad.gltf", texts[i].rest, strlen(texts[i].rest)),
                       texts[i].said);
    }
}

static void broken_glb_chunks_are_named_by_their_byte(void **state)
{
    size_t size;
    unsigned char *glb = glb_bytes(&the_tetrahedron, sizeof the_tetrahedron, GOOD, &size);
    size_t bin = size - 128; // the header of the BIN chunk
    char bin_said[64];
    snprintf(bin_said, sizeof bin_said, "byte %zu: GLB: a chunk says", bin);
    const struct {
        size_t byte;
        unsigned char value;
        const char *said;
    } changes[] = {
        {4, 1, "byte 4: GLB version 1"},
        {8, (unsigned char)(size + 1), "byte 8: GLB: the header says"},
        {11, 0xFF, "byte 8: GLB: the header says"},
        {15, 0x7F, "byte 12: GLB: a chunk says that it has"},
        {16, 'j', "byte 16: GLB: the first chunk is not the JSON chunk"},
        {20, 'x', "byte 20: not JSON"},
        {bin + 3, 0x80, bin_said},
        {bin, 96, "byte "}, // the rest is no chunk then
        {bin + 4, 'X', "buffers[0].uri: missing (only a .glb with a BIN chunk"},
    };
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        unsigned char old = glb[changes[i].byte];
        glb[changes[i].byte] = changes[i].value;
        assert_refused(write_bytes(*state, "bad.glb", glb, size), changes[i].said);
        glb[changes[i].byte] = old;
    }
    assert_refused(write_bytes(*state, "bad.glb", glb, 10), "byte 10: GLB: the file ends within");
    free(glb);
}

// Deep graphs, wide graphs and graphs with 2^40 paths must take linear time.
static void hostile_graphs_take_no_time(void **state)
{
    enum { depth = 50000 };
    size_t capacity = 64 * depth;
    char *text = malloc(capacity);
    assert_non_null(text);
    for (int looped = 0; looped < 2; looped++) {
        size_t used = (size_t)snprintf(text, capacity, TETRAHEDRON "," ONE_SCENE ",\"nodes\":[");
        for (int i = 0; i < depth; i++) {
            int child = i + 1 < depth ? i + 1 : depth / 2;
            bool leaf = i + 1 == depth && !looped;
            used += (size_t)snprintf(text + used, capacity - used,
                                     leaf ? "{\"mesh\":0}" : "{\"children\":[%d]},", child);
        }
        snprintf(text + used - looped, capacity - used, "]");
        char *whole = gltf_text(&the_tetrahedron, sizeof the_tetrahedron, text);
        glint_scene scene;
        glint_error error = {0};
        clock_t begin = clock();
        glint_status status = load_text(*state, whole, &scene, NULL, &error);
        assert_true((double)(clock() - begin) / CLOCKS_PER_SEC < 5);
        assert_int_equal(status, looped ? GLINT_BAD_INPUT : GLINT_OK);
        assert_int_equal(strstr(error.message, "node loop") != NULL, looped);
        assert_int_equal(scene.triangle_count, looped ? 0 : 4);
        glint_scene_free(&scene);
        free(whole);
    }
    free(text);
}

// A few kilobytes with 2^40 triangles, by four levels of primitives, nodes and instances.
static void small_files_cannot_ask_for_the_world(void **state)
{
    char text[16384];
    size_t used = (size_t)snprintf(text, sizeof text,
                                   VIEW "\"accessors\":[{" VEC3 ",\"count\":16000000},{" VEC3
                                        ",\"count\":4000000}],\"meshes\":[{\"primitives\":[");
    for (int i = 0; i < 100; i++) {
        used += (size_t)snprintf(text + used, sizeof text - used,
                                 "%s{\"attributes\":{\"POSITION\":0}}", i ? "," : "");
    }
    snprintf(text + used, sizeof text - used, "]}]," ONE_SCENE ",\"nodes\":[{\"mesh\":0%s}]",
             ",\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"TRANSLATION\":1}}}");
    char *whole = gltf_text(&the_tetrahedron, sizeof the_tetrahedron, text);
    assert_refused(write_bytes(*state, "bad.gltf", whole, strlen(whole)), "(split the scene)");
    free(whole);
}

static void a_long_name_does_not_push_the_cause_out(void **state)
{
    char text[8192];
    char name[3000];
    memset(name, 'x', sizeof name - 1);
    name[sizeof name - 1] = '\0';
    snprintf(text, sizeof text, GOOD ",\"extensionsRequired\":[\"%s\"]", name);
    char *whole = gltf_text(&the_tetrahedron, sizeof the_tetrahedron, text);
    assert_refused(write_bytes(*state, "bad.gltf", whole, strlen(whole)),
                   "...\" is required by the file and not supported (export the file without it)");
    free(whole);
}

// A missing image must not hide the geometry.
static void a_missing_image_refuses_nothing(void **state)
{
    glint_scene scene =
        load_rest(*state, &the_tetrahedron, sizeof the_tetrahedron,
                  GOOD ",\"images\":[{\"uri\":\"missing.png\"},{\"uri\":\"no/such/folder.png\"}],"
                       "\"textures\":[{\"source\":0},{\"source\":1}],\"materials\":[{"
                       "\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}]");
    assert_int_equal(scene.triangle_count, 4);
    glint_scene_free(&scene);
}

// Loads a file. Any answer is right, except a crash, a hang or silence.
static void load_anything(const char *path)
{
    glint_scene scene;
    glint_warnings warnings = {0};
    glint_error error = {0};
    clock_t begin = clock();
    glint_status status = glint_scene_load(path, NULL, &scene, &warnings, &error);
    assert_true(status == GLINT_OK || status == GLINT_BAD_INPUT);
    assert_int_equal(status != GLINT_OK, error.message[0] != '\0');
    assert_true((double)(clock() - begin) / CLOCKS_PER_SEC < 5);
    glint_scene_free(&scene);
    glint_warnings_free(&warnings);
}

static uint32_t random_next(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

// Truncates the file at every place, then changes a few bytes at a time.
static void load_damaged(const char *folder, const void *bytes, size_t size)
{
    static const char likely[] = "0123456789-]}[{,\"";
    uint32_t seed = 20240607;
    for (size_t cut = 0; cut < size; cut += 13) {
        load_anything(write_bytes(folder, "bad.glb", bytes, cut));
    }
    unsigned char *copy = malloc(size + 1);
    assert_non_null(copy);
    for (int i = 0; i < 600 && size > 0; i++) {
        memcpy(copy, bytes, size);
        for (uint32_t n = random_next(&seed) % 3 + 1; n > 0; n--) {
            uint32_t value = random_next(&seed);
            char letter = likely[value % (sizeof likely - 1)];
            copy[random_next(&seed) % size] = (unsigned char)(i % 2 ? (int)(value >> 8) : letter);
        }
        load_anything(write_bytes(folder, "bad.glb", copy, size));
    }
    free(copy);
}

static void damaged_files_are_refused_or_loaded(void **state)
{
    size_t size;
    unsigned char *glb = glb_bytes(&the_tetrahedron, sizeof the_tetrahedron, GOOD, &size);
    load_damaged(*state, glb, size);
    free(glb);
    char *text =
        gltf_text(&the_tetrahedron, sizeof the_tetrahedron,
                  GOOD ",\"materials\":[{\"extensions\":{\"KHR_materials_ior\":{\"ior\":2}}}]"
                       ",\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":1}}]");
    load_damaged(*state, text, strlen(text));
    free(text);
}

static void the_folder_of_bad_files_gets_a_line_each(void **state)
{
    (void)state;
    // These files are odd but valid, or have a fault only in an image that nothing uses.
    static const char *good[] = {"00_valid.gltf", "glb_zero_bin.glb", "image_uri_directory.gltf",
                                 "node_chain_50k.gltf", "node_scale_zero.gltf"};
    const char *path = GLINT_SOURCE_DIR "/../shared/assets/bad";
    DIR *folder = opendir(path);
    if (folder == NULL) {
        print_message("%s is not there: skipped\n", path);
        skip();
        return;
    }
    for (struct dirent *entry = readdir(folder); entry; entry = readdir(folder)) {
        if (entry->d_name[0] == '.') {
            continue;
        }
        bool is_good = false;
        for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
            is_good = is_good || strcmp(entry->d_name, good[i]) == 0;
        }
        const char *file = folder_path(path, entry->d_name);
        if (is_good) {
            load_anything(file);
        } else {
            assert_refused(file, ": ");
        }
    }
    closedir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_mistake_is_named),
        cmocka_unit_test(data_that_lies_is_named),
        cmocka_unit_test(restart_values_are_refused),
        cmocka_unit_test(what_is_no_regular_file_below_the_folder_is_refused),
        cmocka_unit_test(texts_that_are_not_json_or_not_gltf_are_named),
        cmocka_unit_test(broken_glb_chunks_are_named_by_their_byte),
        cmocka_unit_test(hostile_graphs_take_no_time),
        cmocka_unit_test(small_files_cannot_ask_for_the_world),
        cmocka_unit_test(a_long_name_does_not_push_the_cause_out),
        cmocka_unit_test(a_missing_image_refuses_nothing),
        cmocka_unit_test(damaged_files_are_refused_or_loaded),
        cmocka_unit_test(the_folder_of_bad_files_gets_a_line_each),
    };
    return cmocka_run_group_tests(tests, scratch_setup, scratch_teardown);
}
