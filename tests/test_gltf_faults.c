// Tests small faults: glint draws the rest of the file, and one line names what it leaves out or
// takes otherwise. The rule is in docs/formats.md.
#include "scene/scene.h"

#include "support/by_corner.h"
#include "support/gltf_text.h"
#include "support/scratch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

// A file with a fault. `rest` holds the members of the top level beside the tetrahedron's data.
typedef struct fault_case {
    const char *rest;
    const char *said; // part of the one warning; NULL: there is none
} fault_case;

#define NODE ",\"nodes\":[{\"mesh\":0}]," ONE_SCENE

// Loads the file. It must show the tetrahedron, and say one line, or none.
static glint_scene load_faulty(const char *folder, const fault_case *one)
{
    char *text = gltf_text(&the_tetrahedron, sizeof the_tetrahedron, one->rest);
    glint_scene scene;
    glint_warnings warnings = {0};
    glint_error error = {0};
    if (load_text(folder, text, &scene, &warnings, &error) != GLINT_OK) {
        fail_msg("%s: refused: %s", one->rest, error.message);
    }
    const char *first = warnings.count > 0 ? warnings.texts[0] : "nothing";
    if (warnings.count != (one->said != NULL) ||
        (one->said != NULL && strstr(first, one->said) == NULL)) {
        fail_msg("%s: said %zu lines, \"%s\", expected \"%s\"", one->rest, warnings.count, first,
                 one->said != NULL ? one->said : "nothing");
    }
    assert_int_equal(scene.triangle_count, 4);
    glint_warnings_free(&warnings);
    free(text);
    return scene;
}

static void load_all(const char *folder, const fault_case *cases, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        glint_scene scene = load_faulty(folder, &cases[i]);
        glint_scene_free(&scene);
    }
}

#define LOAD_ALL(folder, cases) load_all(folder, cases, sizeof(cases) / sizeof *(cases))

// ---- Attributes ---------------------------------------------------------------------------------

// Accessors 3 to 6: four elements of VEC3, SCALAR, VEC4 and VEC2; 7: three of VEC2; 8: VEC2 of
// bytes that are not normalised; 9: VEC3 of normalised shorts.
#define DECORATED(attributes)                                                                      \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},"                                           \
    "{\"buffer\":0,\"byteOffset\":48,\"byteLength\":48},"                                          \
    "{\"buffer\":0,\"byteOffset\":96,\"byteLength\":24},{\"buffer\":0,\"byteLength\":120}],"       \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"      \
    "{\"bufferView\":1,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"                     \
    "{\"bufferView\":2,\"componentType\":5123,\"count\":12,\"type\":\"SCALAR\"},"                  \
    "{\"bufferView\":3,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"                     \
    "{\"bufferView\":3,\"componentType\":5126,\"count\":4,\"type\":\"SCALAR\"},"                   \
    "{\"bufferView\":3,\"componentType\":5126,\"count\":4,\"type\":\"VEC4\"},"                     \
    "{\"bufferView\":3,\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"},"                     \
    "{\"bufferView\":3,\"componentType\":5126,\"count\":3,\"type\":\"VEC2\"},"                     \
    "{\"bufferView\":3,\"componentType\":5121,\"count\":4,\"type\":\"VEC2\"},"                     \
    "{\"bufferView\":3,\"componentType\":5123,\"normalized\":true,\"count\":4,\"type\":\"VEC3\"}]" \
    ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1," attributes       \
    "},\"indices\":2}]}]" NODE

static void decorations_that_cannot_be_read_are_left_out(void **state)
{
    static const fault_case cases[] = {
        {DECORATED("\"TEXCOORD_0\":6"), NULL},
        {DECORATED("\"TEXCOORD_0\":3"),
         "meshes[0].primitives[0]: TEXCOORD_0 has more than two components: the first two count"},
        {DECORATED("\"TEXCOORD_1\":5"), "TEXCOORD_1 has more than two components"},
        {DECORATED("\"TEXCOORD_1\":9"), "TEXCOORD_1 has more than two components"},
        {DECORATED("\"TEXCOORD_0\":4"), "TEXCOORD_0 is not VEC2 of floats or normalized integers "
                                        "and is left out: the coordinates count as 0"},
        {DECORATED("\"TEXCOORD_0\":8"), "TEXCOORD_0 is not VEC2 of floats or normalized"},
        {DECORATED("\"TEXCOORD_0\":7"), "TEXCOORD_0 has another number of elements than POSITION "
                                        "and is left out: the coordinates count as 0"},
        {DECORATED("\"TANGENT\":5"), NULL},
        {DECORATED("\"TANGENT\":3"), "TANGENT is not VEC4 of floats or normalized integers and is "
                                     "left out: tangents are computed"},
        {DECORATED("\"COLOR_0\":5"), NULL},
        {DECORATED("\"COLOR_0\":9"), NULL},
        {DECORATED("\"COLOR_0\":6"), "COLOR_0 is not VEC3 or VEC4 of floats or normalized integers "
                                     "and is left out: the vertices are white"},
        // Nothing reads them.
        {DECORATED("\"TEXCOORD_2\":4"), NULL},
        {DECORATED("\"_TEMPERATURE\":7"), NULL},
    };
    LOAD_ALL(*state, cases);
}

// Three coordinates are read in steps of three: the result is that of the first two.
static void the_first_two_of_three_coordinates_count(void **state)
{
    char rest[4096] = DECORATED("\"TEXCOORD_0\":3") ",\"images\":[{\"uri\":\"data:image/png;base64,"
                                                    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAA"
                                                    "AADElEQVR4nGNoaGgAAAMEAYFL09IQAAAAAElFTkSuQm"
                                                    "CC"
                                                    "\"}],\"textures\":[{\"source\":0}],"
                                                    "\"materials\":[{\"pbrMetallicRoughness\":{"
                                                    "\"baseColorTexture\":{\"index\":0}}}]";
    char *indices = strstr(rest, "\"indices\":2}");
    memmove(indices + 13, indices, strlen(indices) + 1);
    memcpy(indices, "\"material\":0,", 13);
    const fault_case one = {rest, "TEXCOORD_0 has more than two components"};
    glint_scene scene = load_faulty(*state, &one);
    assert_true(scene.attribute_set.texcoords);
    const size_t stride = glint_attributes_stride(&scene.attribute_set);
    scene_by_corner(&scene);
    for (size_t corner = 0; corner < 12; corner++) {
        const float *from = the_tetrahedron.positions[the_tetrahedron.indices[corner]];
        assert_memory_equal(scene.attributes + stride * corner, from, 2 * sizeof(float));
    }
    glint_scene_free(&scene);
}

// ---- Scenes -------------------------------------------------------------------------------------

// Node 0 moves by (8, 0, 0), its child 1 by (0, 4, 0), and the mesh of 2 below it by (0, 0, 2).
#define CHAIN(scene)                                                                               \
    TETRAHEDRON ",\"nodes\":[{\"children\":[1],\"translation\":[8,0,0]},{\"children\":[2],"        \
                "\"translation\":[0,4,0]},{\"mesh\":0,\"translation\":[0,0,2]}],\"scenes\":[{"     \
                "\"nodes\":[" scene "]}]"
#define BELOW "the scene lists the node, and shows it below its parent, too (it is drawn once"
#define ORPHAN "the scene lists the node, but not its parent (it is drawn where it stands without"

static void a_scene_draws_each_node_once(void **state)
{
    static const struct {
        fault_case fault;
        double x, y, z;
    } scenes[] = {
        {{CHAIN("0"), NULL}, 8, 4, 2},
        {{CHAIN("0,0"), "nodes[0]: the scene lists the node twice (it is drawn once)"}, 8, 4, 2},
        {{CHAIN("0,1"), "nodes[1]: " BELOW}, 8, 4, 2},
        {{CHAIN("2,0"), "nodes[2]: " BELOW}, 8, 4, 2},
        {{CHAIN("2,1,0"), "nodes[2] and 1 more: " BELOW}, 8, 4, 2},
        {{CHAIN("1"), "nodes[1]: " ORPHAN}, 0, 4, 2},
        {{CHAIN("2"), "nodes[2]: " ORPHAN}, 0, 0, 2},
    };
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        glint_scene scene = load_faulty(*state, &scenes[i].fault);
        assert_int_equal(scene.instance_count, 1);
        assert_true(scene.low.x == scenes[i].x && scene.low.y == scenes[i].y &&
                    scene.low.z == scenes[i].z);
        glint_scene_free(&scene);
    }
}

// The scene lists node 1 without its parent 0. Both are joints. The vertices follow the first one,
// which stands where the scene shows it.
static void a_joint_stands_where_the_scene_shows_it(void **state)
{
    char *text = gltf_text(
        &the_tetrahedron, sizeof the_tetrahedron,
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},"
        "{\"buffer\":0,\"byteOffset\":96,\"byteLength\":24}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
        "{\"bufferView\":1,\"componentType\":5123,\"count\":12,\"type\":\"SCALAR\"},"
        "{\"componentType\":5121,\"count\":4,\"type\":\"VEC4\"},"
        "{\"componentType\":5126,\"count\":4,\"type\":\"VEC4\"}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"JOINTS_0\":2,"
        "\"WEIGHTS_0\":3},\"indices\":1}]}],\"skins\":[{\"joints\":[1,0]}],\"nodes\":[{"
        "\"children\":[1],\"translation\":[8,0,0]},{\"translation\":[0,4,0]},{\"mesh\":0,"
        "\"skin\":0}],\"scenes\":[{\"nodes\":[1,2]}]");
    glint_scene scene;
    glint_warnings warnings = {0};
    assert_int_equal(load_text(*state, text, &scene, &warnings, NULL), GLINT_OK);
    assert_true(any_warning_has(&warnings, "nodes[1]: " ORPHAN));
    assert_true(scene.triangle_count == 4 && scene.low.x == 0 && scene.low.y == 4);
    glint_warnings_free(&warnings);
    glint_scene_free(&scene);
    free(text);
}

// A chain of nodes, all listed, takes linear time.
static void listing_all_nodes_takes_no_time(void **state)
{
    enum { depth = 50000 };
    const size_t capacity = 64 * depth;
    char *rest = malloc(capacity);
    assert_non_null(rest);
    size_t used = (size_t)snprintf(rest, capacity, TETRAHEDRON ",\"nodes\":[");
    for (int i = 0; i + 1 < depth; i++) {
        used += (size_t)snprintf(rest + used, capacity - used, "{\"children\":[%d]},", i + 1);
    }
    used +=
        (size_t)snprintf(rest + used, capacity - used, "{\"mesh\":0}],\"scenes\":[{\"nodes\":[");
    for (int i = depth - 1; i >= 0; i--) {
        used += (size_t)snprintf(rest + used, capacity - used, i > 0 ? "%d," : "%d]}]", i);
    }
    const fault_case one = {rest, "nodes[49999] and 49998 more: " BELOW};
    const clock_t begin = clock();
    glint_scene scene = load_faulty(*state, &one);
    assert_true((double)(clock() - begin) / CLOCKS_PER_SEC < 5);
    glint_scene_free(&scene);
    free(rest);
}

// ---- Nodes and members --------------------------------------------------------------------------

#define NODES(nodes) TETRAHEDRON ",\"nodes\":[" nodes "]," ONE_SCENE
#define STRIDE(positions, indices)                                                                 \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48" positions                                   \
    "},{\"buffer\":0,\"byteOffset\":96,\"byteLength\":24" indices                                  \
    "}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"   \
    "{\"bufferView\":1,\"componentType\":5123,\"count\":12,\"type\":\"SCALAR\"}],\"meshes\":[{"    \
    "\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}]" NODE
#define MORPH(mesh, node)                                                                          \
    TETRAHEDRON_STORAGE ",\"meshes\":[{\"primitives\":[{" TETRAHEDRON_PRIMITIVE                    \
                        ",\"targets\":[{\"POSITION\":0},{}]}]" mesh                                \
                        "}],\"nodes\":[{\"mesh\":0" node "}]," ONE_SCENE

static void small_faults_of_members_are_mended(void **state)
{
    static const fault_case cases[] = {
        // null counts as missing, and an empty array as an empty object.
        {TETRAHEDRON NODE ",\"textures\":null,\"scene\":null,\"extensionsRequired\":null", NULL},
        {NODES("{\"mesh\":0,\"camera\":null,\"matrix\":null,\"extensions\":[],\"name\":null}"),
         NULL},
        {NODES("{\"mesh\":0,\"extensions\":{\"KHR_lights_punctual\":null}}"), NULL},
        {NODES("{\"mesh\":0,\"name\":5}"), NULL},
        {NODES("{\"mesh\":0,\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],\"scale\":[2,2,2],"
               "\"translation\":[1,1,1]}"),
         "nodes[0]: the node has a matrix, and translation, rotation or scale, too (the matrix"},
        // Strides that need not be there.
        {STRIDE(",\"byteStride\":0", ",\"byteStride\":0"), NULL},
        {STRIDE(",\"byteStride\":12", ",\"byteStride\":2"), NULL},
        {MORPH(",\"weights\":[0]", ""),
         "meshes[0].primitives[0]: there are not as many weights as"},
        {MORPH(",\"weights\":[0,0]", ",\"weights\":[0,0,0]"),
         "nodes[0]: there are not as many weights as morph targets (missing ones are 0)"},
        {MORPH(",\"weights\":[]", ""), NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        glint_scene scene = load_faulty(*state, &cases[i]);
        assert_true(scene.low.x == 0 && scene.high.x == 1);
        glint_scene_free(&scene);
    }
}

static void a_version_may_be_a_number(void **state)
{
    static const char *const versions[] = {"2", "2.0", "\"2\"", "\"2.0\"", "\"2.1\""};
    for (size_t i = 0; i < sizeof versions / sizeof *versions; i++) {
        char text[128];
        snprintf(text, sizeof text, "{\"asset\":{\"version\":%s}}", versions[i]);
        glint_scene scene;
        assert_int_equal(load_text(*state, text, &scene, NULL, NULL), GLINT_OK);
        glint_scene_free(&scene);
    }
}

// ---- Extensions ---------------------------------------------------------------------------------

#define ON_NODE(name) NODES("{\"mesh\":0,\"extensions\":{\"" name "\":{}}}")
#define ON_PRIMITIVE(name)                                                                         \
    TETRAHEDRON_STORAGE ",\"meshes\":[{\"primitives\":[{" TETRAHEDRON_PRIMITIVE                    \
                        ",\"extensions\":{\"" name "\":{}}}]}]" NODE
#define ON_SCENE(name)                                                                             \
    TETRAHEDRON ",\"nodes\":[{\"mesh\":0}],\"scenes\":[{\"nodes\":[0],\"extensions\":{\"" name     \
                "\":{}}}]"
#define REQUIRED(name) TETRAHEDRON NODE ",\"extensionsRequired\":[\"" name "\"]"

static void extensions_that_change_no_picture_are_silent(void **state)
{
    static const fault_case cases[] = {
        {ON_PRIMITIVE("FB_ngon_encoding"), NULL},
        {ON_PRIMITIVE("EXT_mesh_features"), NULL},
        {ON_PRIMITIVE("EXT_structural_metadata"), NULL},
        {ON_NODE("OMI_physics_body"), NULL},
        {ON_NODE("OMI_seat"), NULL},
        {ON_NODE("KHR_physics_rigid_bodies"), NULL},
        {ON_NODE("KHR_xmp_json_ld"), NULL},
        {ON_NODE("AGI_articulations"), NULL},
        {ON_NODE("AGI_stk_metadata"), NULL},
        {ON_NODE("MSFT_lod"), NULL},
        {ON_NODE("KHR_audio_emitter"), NULL},
        {ON_SCENE("KHR_xmp_json_ld"), NULL},
        {ON_SCENE("FB_geometry_metadata"), NULL},
        // These may change one.
        {ON_NODE("VENDOR_of_the_future"),
         "nodes[0]: VENDOR_of_the_future is not modelled, the node is shown without it"},
        {ON_NODE("KHR_xm"), "KHR_xm is not modelled"},
        {ON_PRIMITIVE("CESIUM_primitive_outline"), "the mesh is shown without it"},
        {ON_SCENE("EXT_lights_image_based"),
         "scenes[0]: EXT_lights_image_based is not modelled, the scene is shown without it"},
        {TETRAHEDRON ",\"nodes\":[{\"mesh\":0}],\"scenes\":[{\"nodes\":[0],\"extensions\":3}]",
         "scenes[0]: its extensions are no object (they are left out)"},
        {ON_SCENE("OMI_environment_sky"), "OMI_environment_sky is not modelled"},
        // A file may require what can be left out.
        {REQUIRED("KHR_texture_basisu"), NULL},
        {REQUIRED("FB_ngon_encoding"), NULL},
        {REQUIRED("OMI_physics_body"), NULL},
        {REQUIRED("KHR_materials_volume_scatter"), NULL},
        {REQUIRED("KHR_animation_pointer"), NULL},
        {REQUIRED("EXT_lights_image_based"), NULL},
    };
    LOAD_ALL(*state, cases);
    assert_rest_refused(*state, REQUIRED("EXT_mesh_compression_of_the_future"),
                        "is required by the file and not supported");
    assert_rest_refused(*state, REQUIRED(""), "\"\" is required by the file and not supported");
}

// KHR_node_visibility hides a node with all below; a joint below still moves its mesh.
static void hidden_nodes_are_not_drawn(void **state)
{
#define HIDDEN "\"extensions\":{\"KHR_node_visibility\":{\"visible\":false}}"
    static const fault_case cases[] = {
        {NODES("{\"mesh\":0,\"children\":[1,2]},{\"mesh\":0," HIDDEN ",\"children\":[3]},"
               "{\"extensions\":{\"KHR_node_visibility\":{\"visible\":true}}},{\"mesh\":0}"),
         NULL},
        {NODES("{\"mesh\":0,\"children\":[1]},{\"mesh\":0," HIDDEN
               "}") ",\"extensionsRequired\":[\"KHR_node_visibility\"]",
         NULL},
    };
    LOAD_ALL(*state, cases);
    char *text =
        gltf_text(&the_tetrahedron, sizeof the_tetrahedron, NODES("{\"mesh\":0," HIDDEN "}"));
    glint_scene scene;
    glint_warnings warnings = {0};
    assert_int_equal(load_text(*state, text, &scene, &warnings, NULL), GLINT_OK);
    assert_true(scene.triangle_count == 0 && warnings.count == 0);
    glint_scene_free(&scene);
    free(text);
}

// Another scene of the file has a hidden node; this one is empty.
static void an_empty_scene_is_said(void **state)
{
    char *text = gltf_text(&the_tetrahedron, sizeof the_tetrahedron,
                           TETRAHEDRON ",\"nodes\":[{\"mesh\":0," HIDDEN
                                       "},{}],\"scenes\":[{\"nodes\":[1]},{\"nodes\":[0]}]");
    glint_scene scene;
    glint_warnings warnings = {0};
    assert_int_equal(load_text(*state, text, &scene, &warnings, NULL), GLINT_OK);
    assert_true(any_warning_has(&warnings, "the scene has no triangles"));
    glint_warnings_free(&warnings);
    glint_scene_free(&scene);
    free(text);
}

// ---- Alpha --------------------------------------------------------------------------------------

// Glass with a volume is all there. That matters only if some alpha says otherwise.
#define GLASS(mode, alpha, more)                                                                   \
    TETRAHEDRON_STORAGE                                                                            \
    ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1" more              \
    "},\"indices\":2,\"material\":0}]}]" NODE ",\"materials\":[{\"alphaMode\":\"" mode             \
    "\",\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0,\"baseColorFactor\":" \
    "["                                                                                            \
    "1,1,1," alpha "]},\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1}," \
    "\"KHR_materials_volume\":{\"thicknessFactor\":1}}}]"
#define ALPHA "materials[0]: alphaMode counts for nothing in glass with a volume"

static void alpha_of_glass_is_told_of_where_it_would_count(void **state)
{
    static const fault_case cases[] = {
        {GLASS("OPAQUE", "0.5", ""), NULL}, {GLASS("BLEND", "1", ""), NULL},
        {GLASS("BLEND", "0.5", ""), ALPHA}, {GLASS("MASK", "0.5", ""), NULL},
        {GLASS("MASK", "0.25", ""), ALPHA}, {GLASS("BLEND", "1", ",\"COLOR_0\":1"), NULL},
    };
    LOAD_ALL(*state, cases);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(decorations_that_cannot_be_read_are_left_out),
        cmocka_unit_test(the_first_two_of_three_coordinates_count),
        cmocka_unit_test(a_scene_draws_each_node_once),
        cmocka_unit_test(a_joint_stands_where_the_scene_shows_it),
        cmocka_unit_test(listing_all_nodes_takes_no_time),
        cmocka_unit_test(small_faults_of_members_are_mended),
        cmocka_unit_test(a_version_may_be_a_number),
        cmocka_unit_test(extensions_that_change_no_picture_are_silent),
        cmocka_unit_test(hidden_nodes_are_not_drawn),
        cmocka_unit_test(an_empty_scene_is_said),
        cmocka_unit_test(alpha_of_glass_is_told_of_where_it_would_count),
    };
    return cmocka_run_group_tests(tests, scratch_setup, scratch_teardown);
}
