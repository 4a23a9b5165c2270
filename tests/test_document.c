// Tests documents that glint-decoder could not have written: glint refuses them, or shows what they
// say, but reads nothing outside of them.
#include "scene/document.h"
#include "scene/gltf/load.h"
#include "scene/gltf/open.h"
#include "scene/gltf/reader.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

// Scenes with skins, targets, animations, lights, images and cameras.
#define SCENE(name) GLINT_SOURCE_DIR "/scenes/" name ".gltf"
static const char *const scenes[] = {SCENE("worm"), SCENE("lights"), SCENE("textures"),
                                     SCENE("clockwork")};
enum { SCENES = sizeof scenes / sizeof scenes[0] };

// A document that a test may damage.
typedef struct test_document {
    const char *path; // of its scene
    unsigned char *block;
    size_t bytes;
} test_document;

static test_document read_scene(const char *path)
{
    test_document draft = {.path = path};
    glint_error error = {0};
    struct stat facts;
    int file;
    assert_int_equal(glint_reader_run(path, &file, &error), GLINT_OK);
    assert_int_equal(fstat(file, &facts), 0);
    draft.bytes = (size_t)facts.st_size;
    draft.block = malloc(draft.bytes);
    assert_non_null(draft.block);
    assert_int_equal(pread(file, draft.block, draft.bytes, 0), (ssize_t)draft.bytes);
    close(file);
    return draft;
}

static glint_document_header *header_of(const test_document *draft)
{
    return (glint_document_header *)(void *)draft->block;
}

static unsigned char *table_of(const test_document *draft, glint_document_table table)
{
    const glint_document_place *place = &header_of(draft)->tables[table];
    assert_true(place->count > 0);
    return draft->block + place->offset;
}

// Loads the draft. *triangles is set on success; the message is kept.
static glint_status load(const test_document *draft, size_t *triangles, glint_error *error)
{
    const int file = memfd_create("document", MFD_CLOEXEC);
    assert_int_equal(write(file, draft->block, draft->bytes), (ssize_t)draft->bytes);
    glint_scene_source *source;
    glint_scene scene = {0};
    *error = (glint_error){0};
    glint_status status = glint_scene_open_document(draft->path, file, NULL, &source, error);
    close(file);
    if (status == GLINT_OK) {
        status = glint_scene_at(source, 0.5, &scene, NULL, error);
        glint_scene_close(source);
    }
    *triangles = scene.triangle_count;
    glint_scene_free(&scene);
    return status;
}

static void expect_refusal(const test_document *draft, const char *message)
{
    size_t triangles;
    glint_error error;
    const glint_status status = load(draft, &triangles, &error);
    if (status != GLINT_BAD_INPUT || strstr(error.message, message) == NULL) {
        fail_msg("%s: status %d, \"%s\" instead of \"%s\"", draft->path, status, error.message,
                 message);
    }
}

static void good_documents_are_shown(void **state)
{
    (void)state;
    for (size_t i = 0; i < SCENES; i++) {
        const test_document draft = read_scene(scenes[i]);
        size_t triangles;
        glint_error error;
        assert_int_equal(load(&draft, &triangles, &error), GLINT_OK);
        assert_true(triangles > 0);
        free(draft.block);
    }
}

// A reference: 32 bits that say which row, run or text is meant.
typedef struct reference {
    glint_document_table table;
    size_t scene, offset;
} reference;

#define WORM 0
#define LIGHTS 1
#define TEXTURES 2
#define REFERENCE(scene, table, type, member)                                                      \
    {                                                                                              \
        GLINT_TABLE_##table, scene, offsetof(type, member)                                         \
    }

static const reference references[] = {
    REFERENCE(LIGHTS, notes, glint_document_note, text),
    REFERENCE(WORM, nodes, glint_document_node, name),
    REFERENCE(WORM, nodes, glint_document_node, parent),
    REFERENCE(WORM, nodes, glint_document_node, children.count),
    REFERENCE(WORM, nodes, glint_document_node, mesh),
    REFERENCE(WORM, nodes, glint_document_node, camera),
    REFERENCE(WORM, nodes, glint_document_node, skin),
    REFERENCE(WORM, nodes, glint_document_node, light),
    REFERENCE(WORM, nodes, glint_document_node, weights.count),
    REFERENCE(WORM, nodes, glint_document_node, instances[0]),
    REFERENCE(WORM, nodes, glint_document_node, instances[2]),
    REFERENCE(WORM, nodes, glint_document_node, notes.count),
    REFERENCE(WORM, meshes, glint_document_mesh, primitives.count),
    REFERENCE(WORM, meshes, glint_document_mesh, weights.count),
    REFERENCE(WORM, primitives, glint_document_primitive, mode),
    REFERENCE(WORM, primitives, glint_document_primitive, material),
    REFERENCE(WORM, primitives, glint_document_primitive, positions),
    REFERENCE(WORM, primitives, glint_document_primitive, normals),
    REFERENCE(WORM, primitives, glint_document_primitive, indices),
    REFERENCE(WORM, primitives, glint_document_primitive, tangents),
    REFERENCE(WORM, primitives, glint_document_primitive, colors),
    REFERENCE(WORM, primitives, glint_document_primitive, texcoords[1]),
    REFERENCE(WORM, primitives, glint_document_primitive, targets.count),
    REFERENCE(WORM, primitives, glint_document_primitive, influences.count),
    REFERENCE(WORM, primitives, glint_document_primitive, mappings.count),
    REFERENCE(WORM, primitives, glint_document_primitive, mapping_fault),
    REFERENCE(WORM, targets, glint_document_target, positions),
    REFERENCE(WORM, targets, glint_document_target, normals),
    REFERENCE(WORM, influences, glint_document_influence, joints),
    REFERENCE(WORM, influences, glint_document_influence, weights),
    REFERENCE(WORM, skins, glint_document_skin, joints.count),
    REFERENCE(WORM, skins, glint_document_skin, inverse_bind),
    REFERENCE(WORM, animations, glint_document_animation, channels.count),
    REFERENCE(WORM, channels, glint_document_channel, node),
    REFERENCE(WORM, channels, glint_document_channel, property),
    REFERENCE(WORM, channels, glint_document_channel, interpolation),
    REFERENCE(WORM, channels, glint_document_channel, input),
    REFERENCE(WORM, channels, glint_document_channel, output),
    REFERENCE(WORM, cameras, glint_document_camera, name),
    REFERENCE(WORM, scenes, glint_document_scene, roots.count),
    REFERENCE(LIGHTS, lights, glint_document_light, kind),
    REFERENCE(LIGHTS, lights, glint_document_light, name),
    REFERENCE(LIGHTS, usages, glint_document_usage, treatment),
    REFERENCE(TEXTURES, materials, glint_document_material, name),
    REFERENCE(TEXTURES, materials, glint_document_material, missing.count),
    REFERENCE(TEXTURES, materials, glint_document_material, texture_keys[3]),
    REFERENCE(TEXTURES, materials, glint_document_material, material.alpha_mode),
    REFERENCE(TEXTURES, materials, glint_document_material, material.unlit),
    REFERENCE(TEXTURES, materials, glint_document_material, material.textures[4].image),
    REFERENCE(TEXTURES, materials, glint_document_material, material.textures[4].wrap_t),
    REFERENCE(TEXTURES, materials, glint_document_material, material.textures[4].texcoord),
    REFERENCE(TEXTURES, images, glint_document_image, shown),
    REFERENCE(TEXTURES, images, glint_document_image, uri),
};

static void each_reference_is_checked(void **state)
{
    (void)state;
    static const uint32_t wrong[] = {0x7fffff02, 0xfffffffe};
    test_document drafts[SCENES];
    for (size_t i = 0; i < SCENES; i++) {
        drafts[i] = read_scene(scenes[i]);
    }
    for (size_t i = 0; i < sizeof references / sizeof references[0]; i++) {
        const reference *one = &references[i];
        const test_document *draft = &drafts[one->scene];
        unsigned char *at = table_of(draft, one->table) + one->offset, kept[4];
        for (size_t w = 0; w < 2; w++) {
            memcpy(kept, at, sizeof kept);
            memcpy(at, &wrong[w], sizeof kept);
            expect_refusal(draft, "glint-decoder gave a damaged document");
            memcpy(at, kept, sizeof kept);
        }
    }
    for (size_t i = 0; i < SCENES; i++) {
        free(drafts[i].block);
    }
}

static void cut_documents_are_refused(void **state)
{
    (void)state;
    test_document draft = read_scene(scenes[WORM]);
    const size_t whole = draft.bytes;
    for (size_t bytes = 0; bytes < whole; bytes += whole / 64) {
        draft.bytes = bytes;
        expect_refusal(&draft, "glint-decoder gave a damaged document");
    }
    draft.bytes = whole;
    glint_document_header *header = header_of(&draft);
    for (size_t t = 0; t < GLINT_TABLES; t++) {
        const glint_document_place kept = header->tables[t];
        header->tables[t].count = UINT64_MAX / 4;
        expect_refusal(&draft, "tables");
        header->tables[t] = (glint_document_place){whole + 8, 0};
        expect_refusal(&draft, "tables");
        header->tables[t] = (glint_document_place){4, 0};
        expect_refusal(&draft, "tables");
        header->tables[t] = kept;
    }
    draft.block[header->tables[GLINT_TABLE_texts].offset + header->tables[GLINT_TABLE_texts].count -
                1] = 'x';
    expect_refusal(&draft, "texts");
    free(draft.block);
}

static void the_tree_is_a_tree(void **state)
{
    (void)state;
    test_document draft = read_scene(scenes[WORM]);
    glint_document_node *nodes = (void *)table_of(&draft, GLINT_TABLE_nodes);
    int32_t *lists = (void *)table_of(&draft, GLINT_TABLE_node_lists);
    size_t parent = 0;
    while (nodes[parent].children.count == 0) {
        parent++;
    }
    const int32_t child = lists[nodes[parent].children.first];
    // Each is the other's child.
    const glint_document_node kept = nodes[child];
    const int32_t above = nodes[parent].parent;
    nodes[child].parent = -1;
    expect_refusal(&draft, "nodes.children");
    nodes[child] = kept;
    nodes[parent].parent = child;
    expect_refusal(&draft, "nodes");
    nodes[parent].parent = above;
    lists[nodes[parent].children.first] = (int32_t)parent;
    expect_refusal(&draft, "nodes.children");
    free(draft.block);
}

static void arrays_lie_in_the_block(void **state)
{
    (void)state;
    test_document draft = read_scene(scenes[WORM]);
    glint_document_array *arrays = (void *)table_of(&draft, GLINT_TABLE_arrays);
    const glint_document_array kept = arrays[0];
    arrays[0].offset = draft.bytes - 4;
    expect_refusal(&draft, "arrays");
    arrays[0] = kept;
    arrays[0].stride = 1;
    expect_refusal(&draft, "arrays");
    arrays[0] = kept;
    arrays[0].stride = UINT32_MAX;
    expect_refusal(&draft, "arrays");
    arrays[0] = kept;
    arrays[0].type = 5124;
    expect_refusal(&draft, "arrays");
    arrays[0] = kept;
    arrays[0].offset = 0;
    arrays[0].count = GLINT_ZEROS_MAX + 1;
    expect_refusal(&draft, "arrays");
    arrays[0] = kept;
    arrays[0].count--;
    expect_refusal(&draft, ""); // counts differ, or an index has no vertex
    arrays[0] = kept;
    // Sparse indices that do not ascend, or are too large.
    uint32_t indices[2] = {1, 1};
    arrays[0].sparse_count = 2;
    arrays[0].sparse_type = GLINT_COMPONENT_UINT32;
    arrays[0].sparse_indices = sizeof(glint_document_header); // unused bytes
    arrays[0].sparse_elements = kept.offset;
    memcpy(draft.block + arrays[0].sparse_indices, indices, sizeof indices);
    expect_refusal(&draft, "arrays");
    indices[1] = (uint32_t)kept.count;
    memcpy(draft.block + arrays[0].sparse_indices, indices, sizeof indices);
    expect_refusal(&draft, "arrays");
    arrays[0] = kept;
    size_t triangles;
    glint_error error;
    assert_int_equal(load(&draft, &triangles, &error), GLINT_OK);
    free(draft.block);
}

// What the fields agree on among each other is any of many things: try some thousand.
static void any_damage_is_survived(void **state)
{
    (void)state;
    static const uint32_t words[] = {0, 1, 2, 3, 7, 0xffffffff, 0x7fffffff, 0x80000000, 0x7fc00000};
    uint64_t random = 1;
    size_t refused = 0, shown = 0;
    for (size_t i = 0; i < SCENES; i++) {
        const test_document draft = read_scene(scenes[i]);
        for (int attempt = 0; attempt < 150; attempt++) {
            size_t triangles;
            glint_error error;
            random = random * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
            const glint_document_table table =
                GLINT_TABLE_arrays + (random >> 33) % (GLINT_TABLES - GLINT_TABLE_arrays);
            const glint_document_place *place = &header_of(&draft)->tables[table];
            const size_t bytes = place->count * 64;
            if (bytes == 0 || place->offset + bytes > draft.bytes) {
                continue;
            }
            unsigned char *at = draft.block + place->offset + (random >> 20) % bytes / 4 * 4,
                          kept[4];
            memcpy(kept, at, sizeof kept);
            memcpy(at, &words[(random >> 50) % 9], sizeof kept);
            const glint_status status = load(&draft, &triangles, &error);
            assert_true(status == GLINT_OK || error.message[0] != '\0');
            refused += status == GLINT_OK ? 0 : 1;
            shown += status == GLINT_OK ? 1 : 0;
            memcpy(at, kept, sizeof kept);
        }
        free(draft.block);
    }
    assert_true(refused > 20 && shown > 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(good_documents_are_shown),  cmocka_unit_test(each_reference_is_checked),
        cmocka_unit_test(cut_documents_are_refused), cmocka_unit_test(the_tree_is_a_tree),
        cmocka_unit_test(arrays_lie_in_the_block),   cmocka_unit_test(any_damage_is_survived),
    };
    return cmocka_run_group_tests_name("document", tests, NULL, NULL);
}
