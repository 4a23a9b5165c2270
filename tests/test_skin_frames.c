// Tests frames of a skinned, morphing box against frames of plain files with the box baked by the
// test's own arithmetic. All numbers are short sums of powers of two, so nothing rounds. Scene,
// tree (refitted from frame to frame) and pixels must agree bit for bit.
#include "render/renderer.h"
#include "scene/scene.h"
#include "support/by_corner.h"
#include "support/gltf_text.h"
#include "support/render.h"
#include "support/scratch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { LEVELS = 9, VERTICES = 4 * LEVELS, TRIANGLES = 8 * (LEVELS - 1) + 4, FRAMES = 5 };

// A square column along +Y, with its vertices level by level.
typedef struct column {
    float positions[VERTICES][3];
    float bump[VERTICES][3]; // deltas of the morph target
    uint8_t joints[VERTICES][4];
    float weights[VERTICES][4];
    uint16_t indices[TRIANGLES][3];
    float times[2], morph_keys[2], shift_keys[2][3], size_keys[2][3];
    float inverse_bind[2][16]; // column by column
} column;

static void add_triangle(column *c, int *count, int a, int b, int d)
{
    const uint16_t corners[3] = {(uint16_t)a, (uint16_t)b, (uint16_t)d};
    memcpy(c->indices[(*count)++], corners, sizeof corners);
}

static column make_column(void)
{
    static const float corners[4][2] = {{-0.5f, 0.5f}, {0.5f, 0.5f}, {0.5f, -0.5f}, {-0.5f, -0.5f}};
    column c = {.times = {0, 4},
                .morph_keys = {0, 1},
                .shift_keys = {{0, 1, 0}, {1, 0.5f, -0.5f}},
                .size_keys = {{1, 1, 1}, {2, 1, 0.5f}},
                .inverse_bind = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                                 {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1}}};
    int count = 0;
    for (int v = 0; v < VERTICES; v++) {
        const int level = v / 4, k = v % 4;
        c.positions[v][0] = corners[k][0];
        c.positions[v][1] = 0.25f * (float)level;
        c.positions[v][2] = corners[k][1];
        c.bump[v][0] = level == 3 ? corners[k][0] : 0;
        c.joints[v][1] = 1;
        c.weights[v][1] = (float)level / (LEVELS - 1);
        c.weights[v][0] = 1 - c.weights[v][1];
        if (level > 0) {
            const int left = v, right = 4 * level + (k + 1) % 4;
            add_triangle(&c, &count, left - 4, right - 4, right);
            add_triangle(&c, &count, left - 4, right, left);
        }
    }
    const int top = VERTICES - 4;
    add_triangle(&c, &count, 0, 2, 1);
    add_triangle(&c, &count, 0, 3, 2);
    add_triangle(&c, &count, top, top + 1, top + 2);
    add_triangle(&c, &count, top, top + 2, top + 3);
    assert_int_equal(count, TRIANGLES);
    return c;
}

// Bakes the column at a time. Joint 0 stays at the origin. Joint 1 rests at (0, 1, 0); it moves and
// grows.
static void bake(const column *c, double time, float baked[VERTICES][3])
{
    const double share = time / 4;
    for (int v = 0; v < VERTICES; v++) {
        for (int k = 0; k < 3; k++) {
            const double shape = (double)c->positions[v][k] + share * (double)c->bump[v][k];
            const double home = k == 1 ? 1 : 0;
            const double from = (double)c->shift_keys[0][k], to = (double)c->shift_keys[1][k];
            const double small = (double)c->size_keys[0][k], large = (double)c->size_keys[1][k];
            const double moved =
                (small + share * (large - small)) * (shape - home) + from + share * (to - from);
            const double weight = (double)c->weights[v][1];
            const double result = (1 - weight) * shape + weight * moved;
            baked[v][k] = (float)result;
            assert_true((double)baked[v][k] == result); // exact
        }
    }
}

#define VIEW(size) "{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":" #size "}"
#define ACCESSOR(view, type, count, shape)                                                         \
    "{\"bufferView\":" #view ",\"componentType\":" #type ",\"count\":" #count ",\"type\":\"" shape \
    "\"}"
#define AROUND                                                                                     \
    "\"materials\":[{\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1},"   \
    "\"KHR_materials_volume\":{\"thicknessFactor\":1}},\"pbrMetallicRoughness\":{"                 \
    "\"metallicFactor\":0,\"roughnessFactor\":0}}],"                                               \
    "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.8,\"znear\":1}}],"         \
    "\"scenes\":[{\"nodes\":[0,1]}],"
#define CAMERA "{\"camera\":0,\"translation\":[0.25,1,5]}"

static char *animated_text(const column *c)
{
    char rest[4096];
    snprintf(
        rest, sizeof rest,
        AROUND
        "\"bufferViews\":[" VIEW(432) "," VIEW(432) "," VIEW(144) "," VIEW(576) "," VIEW(408) "," VIEW(8) "," VIEW(8) "," VIEW(24) "," VIEW(24) "," VIEW(
            128) "],"
                 "\"accessors\":[" ACCESSOR(0, 5126, 36, "VEC3") "," ACCESSOR(1, 5126, 36, "VEC3") "," ACCESSOR(2, 5121, 36, "VEC4") "," ACCESSOR(3, 5126, 36, "VEC4") "," ACCESSOR(
                     4, 5123, 204,
                     "SCALAR") "," ACCESSOR(5, 5126, 2,
                                            "SCALAR") "," ACCESSOR(6, 5126, 2,
                                                                   "SCALAR") "," ACCESSOR(7, 5126,
                                                                                          2,
                                                                                          "VEC3") "," ACCESSOR(8,
                                                                                                               5126,
                                                                                                               2,
                                                                                                               "VEC3") "," ACCESSOR(9,
                                                                                                                                    5126,
                                                                                                                                    2,
                                                                                                                                    "MAT4") "],"
                                                                                                                                            "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"JOINTS_0\":2,"
                                                                                                                                            "\"WEIGHTS_0\":3},\"indices\":4,\"material\":0,\"targets\":[{\"POSITION\":1}]}]}],"
                                                                                                                                            "\"nodes\":[{\"mesh\":0,\"skin\":0,\"translation\":[9,9,9]}," CAMERA
                                                                                                                                            ",{},{}],"
                                                                                                                                            "\"skins\":[{\"joints\":[2,3],\"inverseBindMatrices\":9}],\"animations\":[{\"samplers\":["
                                                                                                                                            "{\"input\":5,\"output\":6},{\"input\":5,\"output\":7},{\"input\":5,\"output\":8}],"
                                                                                                                                            "\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"weights\"}},"
                                                                                                                                            "{\"sampler\":1,\"target\":{\"node\":3,\"path\":\"translation\"}},"
                                                                                                                                            "{\"sampler\":2,\"target\":{\"node\":3,\"path\":\"scale\"}}]}]",
        offsetof(column, positions), offsetof(column, bump), offsetof(column, joints),
        offsetof(column, weights), offsetof(column, indices), offsetof(column, times),
        offsetof(column, morph_keys), offsetof(column, shift_keys), offsetof(column, size_keys),
        offsetof(column, inverse_bind));
    return gltf_text(c, sizeof *c, rest);
}

static glint_scene baked_scene(const char *folder, const column *c, double time)
{
    column plain = *c;
    bake(c, time, plain.positions);
    char rest[2048];
    snprintf(rest, sizeof rest,
             AROUND "\"bufferViews\":[" VIEW(432) "," VIEW(408) "],\"accessors\":[" ACCESSOR(
                 0, 5126, 36,
                 "VEC3") "," ACCESSOR(1, 5123, 204,
                                      "SCALAR") "],"
                                                "\"meshes\":[{\"primitives\":[{\"attributes\":{"
                                                "\"POSITION\":0},\"indices\":1,"
                                                "\"material\":0}]}],\"nodes\":[{\"mesh\":0}," CAMERA
                                                "]",
             offsetof(column, positions), offsetof(column, indices));
    return load_by_corner(folder, &plain, sizeof plain, rest);
}

static void assert_same_triangles(const glint_scene *a, const glint_scene *b)
{
    assert_int_equal(a->triangle_count, TRIANGLES);
    assert_int_equal(b->triangle_count, TRIANGLES);
    assert_memory_equal(&a->origin, &b->origin, sizeof a->origin);
    assert_true(a->unit == b->unit);
    assert_memory_equal(a->positions, b->positions, TRIANGLES * 9 * sizeof(float));
}

static glint_renderer *make_renderer(const glint_scene *scene)
{
    static glint_settings settings;
    settings = test_small_frame(4);
    const glint_renderer_inputs inputs = {.device = test_device(),
                                          .scene = scene,
                                          .environment = test_studio(),
                                          .settings = &settings};
    glint_renderer *renderer;
    glint_error error = {0};
    assert_int_equal(glint_renderer_create(&inputs, &renderer, &error), GLINT_OK);
    return renderer;
}

static glint_image render(glint_renderer *renderer, const glint_scene *scene)
{
    glint_image image = {0};
    glint_error error = {0};
    const glint_frame_request request = {renderer, &scene->cameras[0], NULL, &image, NULL};
    assert_int_equal(glint_renderer_frame(&request, &error), GLINT_OK);
    return image;
}

static void frames_of_a_skin_are_those_of_baked_triangles(void **state)
{
    const column c = make_column();
    char *text = animated_text(&c);
    glint_scene_source *source;
    glint_error error = {0};
    const char *path = write_bytes(*state, "column.gltf", text, strlen(text));
    free(text);
    if (glint_scene_open(path, NULL, &source, &error) != GLINT_OK) {
        fail_msg("%s", error.message);
    }
    glint_scene scene;
    assert_int_equal(glint_scene_at(source, 0, &scene, NULL, NULL), GLINT_OK);
    glint_renderer *moved = make_renderer(&scene);
    int refitted = 0;
    for (int frame = 0; frame < FRAMES; frame++) {
        glint_scene_free(&scene);
        assert_int_equal(glint_scene_at(source, frame, &scene, NULL, NULL), GLINT_OK);
        scene_by_corner(&scene);
        glint_scene baked = baked_scene(*state, &c, frame);
        assert_same_triangles(&scene, &baked);
        assert_int_equal(glint_renderer_set_scene(moved, &scene, &error), GLINT_OK);
        refitted += glint_renderer_bvh(moved)->is_refitted;
        glint_renderer *fresh = make_renderer(&baked);
        glint_image here = render(moved, &scene), there = render(fresh, &baked);
        assert_int_equal(test_count_different(&here, &there), 0);
        glint_renderer_free(fresh);
        glint_image_free(&here);
        glint_image_free(&there);
        glint_scene_free(&baked);
    }
    assert_true(refitted > 0);
    glint_renderer_free(moved);
    glint_scene_free(&scene);
    glint_scene_close(source);
}

static int tear_down(void **state)
{
    return scratch_teardown(state) | test_close_device(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_of_a_skin_are_those_of_baked_triangles),
    };
    return cmocka_run_group_tests(tests, scratch_setup, tear_down);
}
