// Tests that triangles may share vertices: a file with indices gives the same corners, bit by bit,
// as the same file with a vertex for each corner.
#include "base/random.h"
#include "scene/scene.h"
#include "scene/subset.h"
#include "support/by_corner.h"
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

enum { SIDE = 12, SHEET = SIDE * SIDE, BEADS = 7, VERTICES = SHEET + BEADS + 40 };
enum { SQUARES = (SIDE - 1) * (SIDE - 1), TRIANGLES = 2 * SQUARES + 8 };

typedef struct file_vertex {
    float position[3], normal[3], uv[2];
} file_vertex;

// A sheet, and two tetrahedra that have one vertex in common. The last vertices have no triangle.
typedef struct mesh {
    file_vertex vertices[VERTICES];
    uint32_t indices[3 * TRIANGLES];
} mesh;

static mesh make_mesh(glint_random *random)
{
    static const uint32_t tetrahedra[2][12] = {{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3},
                                               {3, 5, 4, 3, 4, 6, 3, 6, 5, 4, 5, 6}};
    static const float beads[BEADS][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1},
                                          {1, 0, 1}, {0, 1, 1}, {0, 0, 2}};
    mesh m = {0};
    for (int i = 0; i < VERTICES; i++) {
        file_vertex *v = &m.vertices[i];
        const int column = i % SIDE - SIDE / 2, row = i / SIDE % SIDE - SIDE / 2;
        const float x = (float)column, z = (float)row;
        const float up = (float)glint_random_number(random);
        memcpy(v->position, (float[]){x, 0.3F * up, z}, sizeof v->position);
        memcpy(v->normal, (float[]){0.3F * up, 0.9F, -0.2F * up}, sizeof v->normal);
        // The texture is mirrored at x = 0. A strip of it has no area.
        memcpy(v->uv, (float[]){fabsf(x) / SIDE, z > 3 ? 0.5F : z / SIDE}, sizeof v->uv);
    }
    for (int i = 0; i < BEADS; i++) {
        for (int k = 0; k < 3; k++) {
            m.vertices[SHEET + i].position[k] = 3 + 1e-4F * beads[i][k];
        }
    }
    uint32_t *to = m.indices;
    for (uint32_t i = 0; i < SQUARES; i++) {
        const uint32_t a = i / (SIDE - 1) * SIDE + i % (SIDE - 1);
        const uint32_t corners[6] = {a, a + SIDE, a + 1, a + 1, a + SIDE, a + SIDE + 1};
        memcpy(to, corners, sizeof corners);
        to += 6;
    }
    for (int i = 0; i < 24; i++) {
        *to++ = SHEET + tetrahedra[i / 12][i % 12];
    }
    return m;
}

// The storage of a mesh: accessors 0 to 2 are positions, normals and texture coordinates, 3 is the
// indices, which follow the vertices. With no index the accessor stands for nothing.
static void put_storage(size_t vertices, size_t indices, char *to, size_t size)
{
    const size_t bytes = vertices * sizeof(file_vertex);
    int length = snprintf(to, size, "\"bufferViews\":[");
    for (size_t offset = 0; offset < 36; offset += 12) {
        length += snprintf(to + length, size - (size_t)length,
                           "{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu,"
                           "\"byteStride\":32},",
                           offset, bytes - offset);
    }
    length += snprintf(to + length, size - (size_t)length,
                       "{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}],\"accessors\":[",
                       indices > 0 ? bytes : 0, indices > 0 ? 4 * indices : 4);
    for (int view = 0; view < 3; view++) {
        length += snprintf(to + length, size - (size_t)length,
                           "{\"bufferView\":%d,\"componentType\":5126,\"count\":%zu,"
                           "\"type\":\"VEC%d\"},",
                           view, vertices, view == 2 ? 2 : 3);
    }
    snprintf(to + length, size - (size_t)length,
             "{\"bufferView\":3,\"componentType\":5125,\"count\":%zu,\"type\":\"SCALAR\"}],",
             indices > 0 ? indices : 1);
}

static const char image[] =
    "\"images\":[{\"uri\":\"data:image/"
    "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADE"
    "lEQVR4nGNoaGgAAAMEAYFL09IQAAAAAElFTkSuQmCC\"}],\"textures\":[{\"source\":0}],"
    "\"materials\":[{\"normalTexture\":{\"index\":0}}]";

// Loads the mesh at three places: as it is, mirrored, and small.
static glint_scene load(const char *folder, const mesh *m, bool is_indexed, bool has_normals)
{
    static file_vertex by_corner[3 * TRIANGLES];
    for (int i = 0; i < 3 * TRIANGLES; i++) {
        by_corner[i] = m->vertices[m->indices[i]];
    }
    char storage[2048], rest[4096];
    put_storage(is_indexed ? VERTICES : 3 * TRIANGLES, is_indexed ? 3 * TRIANGLES : 0, storage,
                sizeof storage);
    snprintf(rest, sizeof rest,
             "%s\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0%s,\"TEXCOORD_0\":2},"
             "\"material\":0%s}]}],\"nodes\":[{\"mesh\":0},"
             "{\"mesh\":0,\"scale\":[-1,1,1],\"translation\":[0,2,0]},"
             "{\"mesh\":0,\"scale\":[1e-3,1e-3,1e-3],\"translation\":[7.1,0.3,-4.7]}],"
             "\"scenes\":[{\"nodes\":[0,1,2]}],%s",
             storage, has_normals ? ",\"NORMAL\":1" : "", is_indexed ? ",\"indices\":3" : "",
             image);
    return is_indexed ? load_rest(folder, m, sizeof *m, rest)
                      : load_rest(folder, by_corner, sizeof by_corner, rest);
}

static void assert_same_corners(const glint_scene *a, const glint_scene *b)
{
    const size_t corners = 3 * a->triangle_count;
    assert_int_equal(a->triangle_count, b->triangle_count);
    assert_memory_equal(a->positions, b->positions, corners * 3 * sizeof(float));
    assert_int_equal(a->normals != NULL, b->normals != NULL);
    if (a->normals != NULL) {
        assert_memory_equal(a->normals, b->normals, corners * 3 * sizeof(float));
    }
    assert_int_equal(a->attributes != NULL, b->attributes != NULL);
    if (a->attributes != NULL) {
        const size_t stride = glint_attributes_stride(&a->attribute_set);
        assert_memory_equal(a->attributes, b->attributes, corners * stride * sizeof(float));
    }
    assert_int_equal(a->parts.count, b->parts.count);
    if (a->parts.count > 0) {
        assert_memory_equal(a->parts.positions, b->parts.positions, corners * 3 * sizeof(float));
        assert_memory_equal(a->parts.part_of, b->parts.part_of, corners / 3 * sizeof(uint32_t));
    }
    assert_memory_equal(&a->low, &b->low, sizeof a->low);
    assert_memory_equal(&a->high, &b->high, sizeof a->high);
}

// Each vertex has a triangle, and its triangles are of one instance and one part.
static void assert_vertices_serve(const glint_scene *scene)
{
    const uint32_t none = UINT32_MAX;
    uint32_t *instance_of = malloc(scene->vertex_count * sizeof *instance_of);
    uint32_t *part_of = malloc(scene->vertex_count * sizeof *part_of);
    assert_non_null(scene->indices);
    assert_non_null(instance_of);
    assert_non_null(part_of);
    memset(instance_of, 0xFF, scene->vertex_count * sizeof *instance_of);
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const glint_instance *instance = &scene->instances[i];
        for (size_t k = 0; k < 3 * instance->triangle_count; k++) {
            const size_t triangle = instance->first_triangle + k / 3;
            const size_t vertex = glint_scene_vertex(scene, triangle, k % 3);
            const uint32_t part = scene->parts.count > 0 ? scene->parts.part_of[triangle] : 0;
            assert_true(vertex < scene->vertex_count);
            assert_true(instance_of[vertex] == none || instance_of[vertex] == i);
            assert_true(instance_of[vertex] == none || part_of[vertex] == part);
            instance_of[vertex] = i;
            part_of[vertex] = part;
        }
    }
    for (size_t v = 0; v < scene->vertex_count; v++) {
        assert_true(instance_of[v] != none);
    }
    free(instance_of);
    free(part_of);
}

static void indices_change_no_corner(void **state)
{
    glint_random random = {7};
    for (int i = 0; i < 8; i++) {
        const bool has_normals = i % 2 == 0;
        const char *const removed[] = {NULL, "0", "1", "0,2"};
        const char *nodes = removed[i / 2];
        const mesh m = make_mesh(&random);
        glint_scene shared = load(*state, &m, true, has_normals);
        glint_scene apart = load(*state, &m, false, has_normals);
        assert_true(shared.parts.count > 1 && shared.attribute_set.tangents);
        assert_null(apart.indices);
        if (nodes != NULL) {
            assert_int_equal(glint_scene_remove_nodes(&shared, nodes, NULL), GLINT_OK);
            assert_int_equal(glint_scene_remove_nodes(&apart, nodes, NULL), GLINT_OK);
        }
        assert_vertices_serve(&shared);
        scene_by_corner(&shared);
        assert_same_corners(&shared, &apart);
        glint_scene_free(&shared);
        glint_scene_free(&apart);
    }
}

// A sheet with normals has few more vertices than the file: those where the texture is mirrored or
// has no area.
static void vertices_are_stored_once(void **state)
{
    glint_random random = {8};
    const mesh m = make_mesh(&random);
    glint_scene scene = load(*state, &m, true, true);
    assert_true(scene.vertex_count >= 3 * (SHEET + BEADS));
    assert_true(scene.vertex_count <= 3 * (SHEET + 3 * SIDE + 3 * BEADS));
    glint_scene_free(&scene);
}

// Many files share one large array among small primitives. Each stores only the vertices that it
// uses, once, whether they stand together in the array or far apart.
static void small_primitives_of_large_arrays_share_vertices(void **state)
{
    enum { MANY = 30000 };
    typedef struct large {
        file_vertex vertices[MANY];
        uint32_t indices[12];
    } large;
    large *l = calloc(1, sizeof *l);
    assert_non_null(l);
    for (int i = 0; i < MANY; i++) {
        const float place[3] = {(float)(i & 1), (float)(i >> 1 & 1), (float)i / MANY};
        memcpy(l->vertices[i].position, place, sizeof place);
    }
    static const uint32_t together[6] = {20000, 20001, 20002, 20002, 20001, 20003};
    static const uint32_t apart[6] = {0, 1, 20002, 20002, 1, 29999};
    memcpy(l->indices, together, sizeof together);
    memcpy(l->indices + 6, apart, sizeof apart);
    char storage[2048], rest[4096];
    for (int i = 0; i < 2; i++) {
        put_storage(MANY, 12, storage, sizeof storage);
        char *end = strrchr(storage, '{'); // the indices' accessor
        snprintf(end, sizeof storage - (size_t)(end - storage),
                 "{\"bufferView\":3,\"byteOffset\":%d,\"componentType\":5125,\"count\":6,"
                 "\"type\":\"SCALAR\"}],",
                 24 * i);
        snprintf(rest, sizeof rest,
                 "%s\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},"
                 "\"indices\":3}]}],\"nodes\":[{\"mesh\":0}],\"scenes\":[{\"nodes\":[0]}]",
                 storage);
        glint_scene scene = load_rest(*state, l, sizeof *l, rest);
        assert_int_equal(scene.triangle_count, 2);
        assert_int_equal(glint_scene_vertex_count(&scene), i == 0 ? 4 : 6);
        for (size_t k = 0; k < 6; k++) {
            const float *at = l->vertices[l->indices[6 * (size_t)i + k]].position;
            const glint_vec3 p = glint_scene_corner(&scene, k / 3, k % 3);
            assert_true(fabs(p.z * scene.unit + scene.origin.z - (double)at[2]) < 1e-6);
        }
        glint_scene_free(&scene);
    }
    free(l);
}

// A fan of many triangles around a vertex without a normal: each lies in a plane of its own, and so
// do its tangents.
static void flat_triangles_around_a_vertex_have_tangents_of_their_own(void **state)
{
    enum { AROUND = 20000 };
    typedef struct fan {
        file_vertex vertices[AROUND + 1];
        uint32_t indices[3 * AROUND];
    } fan;
    fan *f = calloc(1, sizeof *f);
    assert_non_null(f);
    for (int i = 0; i < AROUND; i++) {
        const double angle = 2 * GLINT_PI * i / AROUND;
        file_vertex *v = &f->vertices[i + 1];
        v->position[0] = v->uv[0] = (float)cos(angle);
        v->position[2] = v->uv[1] = (float)sin(angle);
        v->position[1] = i % 2 == 0 ? 0.1F : 0;
        f->indices[3 * i + 1] = (uint32_t)(1 + (i + 1) % AROUND);
        f->indices[3 * i + 2] = (uint32_t)(1 + i);
    }
    char storage[2048], rest[4096];
    put_storage(AROUND + 1, 3 * (size_t)AROUND, storage, sizeof storage);
    snprintf(rest, sizeof rest,
             "%s\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":2},"
             "\"indices\":3,\"material\":0}]}],\"nodes\":[{\"mesh\":0}],"
             "\"scenes\":[{\"nodes\":[0]}],%s",
             storage, image);
    glint_scene scene = load_rest(*state, f, sizeof *f, rest);
    assert_int_equal(scene.triangle_count, AROUND);
    assert_vertices_serve(&scene);
    const size_t stride = glint_attributes_stride(&scene.attribute_set);
    for (size_t i = 0; i < 3 * (size_t)AROUND; i++) {
        const glint_vec3 a = glint_scene_corner(&scene, i / 3, 0);
        const glint_vec3 ab = glint_vec3_subtract(glint_scene_corner(&scene, i / 3, 1), a);
        const glint_vec3 ac = glint_vec3_subtract(glint_scene_corner(&scene, i / 3, 2), a);
        const float *tangent =
            scene.attributes + stride * glint_scene_vertex(&scene, i / 3, i % 3) + stride - 4;
        const glint_vec3 normal = glint_vec3_normalize(glint_vec3_cross(ab, ac));
        assert_true(fabsf(tangent[3]) == 1);
        assert_true(fabs(glint_vec3_dot(normal, glint_vec3_from_floats(tangent))) < 1e-6);
    }
    glint_scene_free(&scene);
    free(f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(indices_change_no_corner),
        cmocka_unit_test(vertices_are_stored_once),
        cmocka_unit_test(small_primitives_of_large_arrays_share_vertices),
        cmocka_unit_test(flat_triangles_around_a_vertex_have_tangents_of_their_own),
    };
    return cmocka_run_group_tests(tests, scratch_setup, scratch_teardown);
}
