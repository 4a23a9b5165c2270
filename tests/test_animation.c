// Tests animated scenes against files with the nodes in their places at that time. Also tests
// animations that glint cannot read.
#include "scene/gltf/curve.h"
#include "scene/scene.h"
#include "support/by_corner.h"
#include "support/gltf_text.h"
#include "support/scratch.h"

#include <float.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// ---- Scenes ------------------------------------------------------------------------------------

// The tetrahedron, followed by the keys of a clip of two seconds.
typedef struct moving_data {
    tetrahedron shape;
    float times[3];
    float places[3][3], sizes[3][3];
    float turns[3][4];
    int16_t short_turns[3][4];
} moving_data;

static moving_data make_data(void)
{
    const float half = 0.70710678f;
    return (moving_data){
        .shape = the_tetrahedron,
        .times = {0, 1, 2},
        .places = {{0, 0, 0}, {4, 0, 0}, {4, 2, 0}},
        .sizes = {{1, 1, 1}, {2, 2, 2}, {0, 0, 0}},
        .turns = {{0, 0, 0, 1}, {0, half, 0, half}, {0, 1, 0, 0}},
        .short_turns = {{0, 0, 0, 32767}, {0, 23170, 0, 23170}, {0, 32767, 0, 0}},
    };
}

#define ACCESSORS                                                                                  \
    ",{\"bufferView\":3,\"componentType\":5126,\"count\":3,\"type\":\"SCALAR\"},"                  \
    "{\"bufferView\":4,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"                     \
    "{\"bufferView\":5,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"                     \
    "{\"bufferView\":6,\"componentType\":5126,\"count\":3,\"type\":\"VEC4\"},"                     \
    "{\"bufferView\":7,\"componentType\":5122,\"normalized\":true,\"count\":3,\"type\":\"VEC4\"}]"
#define STORAGE                                                                                    \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},"                                           \
    "{\"buffer\":0,\"byteOffset\":48,\"byteLength\":48},"                                          \
    "{\"buffer\":0,\"byteOffset\":96,\"byteLength\":24},"                                          \
    "{\"buffer\":0,\"byteOffset\":120,\"byteLength\":12},"                                         \
    "{\"buffer\":0,\"byteOffset\":132,\"byteLength\":36},"                                         \
    "{\"buffer\":0,\"byteOffset\":168,\"byteLength\":36},"                                         \
    "{\"buffer\":0,\"byteOffset\":204,\"byteLength\":48},"                                         \
    "{\"buffer\":0,\"byteOffset\":252,\"byteLength\":24}],"                                        \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"      \
    "{\"bufferView\":1,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"                     \
    "{\"bufferView\":2,\"componentType\":5123,\"count\":12,\"type\":\"SCALAR\"}" ACCESSORS         \
    ",\"meshes\":[{\"primitives\":[{" TETRAHEDRON_PRIMITIVE "}]}]"
// A parent that moves and turns, a child that grows, a static mesh, and a camera on the parent.
#define NODES                                                                                      \
    ",\"nodes\":[{\"children\":[1,3],\"name\":\"arm\"%s},{\"mesh\":0,\"translation\":[1,0,0]%s},"  \
    "{\"mesh\":0,\"translation\":[0,0,-3]},{\"camera\":0,\"translation\":[0,0,9]}],"               \
    "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":1,\"znear\":1}}],"           \
    "\"scenes\":[{\"nodes\":[0,2]}]"
#define CLIP                                                                                       \
    ",\"animations\":[{\"name\":\"wave\",\"samplers\":[{\"input\":3,\"output\":4},"                \
    "{\"input\":3,\"output\":5,\"interpolation\":\"LINEAR\"},{\"input\":3,\"output\":%d}],"        \
    "\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"translation\"}},"              \
    "{\"sampler\":2,\"target\":{\"node\":0,\"path\":\"rotation\"}},"                               \
    "{\"sampler\":1,\"target\":{\"node\":1,\"path\":\"scale\"}}]}]"

static char *moving_text(const char *format, int turns)
{
    const moving_data data = make_data();
    char rest[8192];
    int length = snprintf(rest, sizeof rest, STORAGE NODES, "", "");
    snprintf(rest + length, sizeof rest - (size_t)length, format, turns);
    return gltf_text(&data, sizeof data, rest);
}

static glint_scene_source *open_text(const char *folder, char *text, const char *clip,
                                     glint_status wanted, const char *message)
{
    const char *path = write_bytes(folder, "moving.gltf", text, strlen(text));
    free(text);
    const glint_scene_options options = {.animation = clip};
    glint_scene_source *source;
    glint_error error = {0};
    const glint_status status = glint_scene_open(path, &options, &source, &error);
    if (status != wanted || (message != NULL && strstr(error.message, message) == NULL)) {
        fail_msg("status %d: %s", status, error.message);
    }
    glint_error_free(&error);
    return source;
}

// The same scene at rest, with the nodes at the places `arm` and `child`.
static glint_scene baked(const char *folder, const char *arm, const char *child)
{
    const moving_data data = make_data();
    char rest[8192];
    snprintf(rest, sizeof rest, STORAGE NODES, arm, child);
    return load_by_corner(folder, &data, sizeof data, rest);
}

static void assert_same_scene(const glint_scene *a, const glint_scene *b)
{
    assert_int_equal(a->triangle_count, b->triangle_count);
    assert_memory_equal(&a->origin, &b->origin, sizeof a->origin);
    assert_true(a->unit == b->unit);
    assert_memory_equal(a->positions, b->positions, 9 * a->triangle_count * sizeof(float));
    assert_memory_equal(a->normals, b->normals, 9 * a->triangle_count * sizeof(float));
    assert_int_equal(a->camera_count, 1);
    assert_memory_equal(&a->cameras[0].eye, &b->cameras[0].eye, 4 * sizeof(glint_vec3));
}

static const struct {
    double time;
    const char *arm, *child;
} stands[] = {
    {-1, "", ""},
    {0, "", ""},
    {0.5, ",\"translation\":[2,0,0],\"rotation\":[0,0.38268343236508977,0,0.9238795325112867]",
     ",\"scale\":[1.5,1.5,1.5]"},
    {1, ",\"translation\":[4,0,0],\"rotation\":[0,0.7071067811865476,0,0.7071067811865476]",
     ",\"scale\":[2,2,2]"},
    {1.25, ",\"translation\":[4,0.5,0],\"rotation\":[0,0.8314696123025452,0,0.5555702330196022]",
     ",\"scale\":[1.5,1.5,1.5]"},
    {2, ",\"translation\":[4,2,0],\"rotation\":[0,1,0,0]", ",\"scale\":[0,0,0]"},
    {1e9, ",\"translation\":[4,2,0],\"rotation\":[0,1,0,0]", ",\"scale\":[0,0,0]"},
};

static void a_moving_scene_is_the_one_in_which_nodes_stand_so(void **state)
{
    glint_scene_source *source = open_text(*state, moving_text(CLIP, 6), NULL, GLINT_OK, NULL);
    const glint_motion *motion = glint_scene_motion(source);
    assert_true(motion->moves_triangles && motion->moves_cameras && motion->duration == 2);
    assert_string_equal(motion->clip, "wave");
    for (size_t i = 0; i < sizeof stands / sizeof *stands; i++) {
        glint_scene scene, expected = baked(*state, stands[i].arm, stands[i].child);
        assert_int_equal(glint_scene_at(source, stands[i].time, &scene, NULL, NULL), GLINT_OK);
        scene_by_corner(&scene);
        assert_true(scene.moves && !expected.moves);
        // Rotations from float keys differ from those in the text by rounding.
        assert_int_equal(scene.triangle_count, expected.triangle_count);
        assert_int_equal(scene.triangle_count, stands[i].time >= 2 ? 4 : 8);
        for (size_t k = 0; k < 9 * scene.triangle_count; k++) {
            const double there = (double)expected.positions[k] * expected.unit;
            const double here = (double)scene.positions[k] * scene.unit;
            const double shift[3] = {scene.origin.x - expected.origin.x,
                                     scene.origin.y - expected.origin.y,
                                     scene.origin.z - expected.origin.z};
            assert_true(fabs(here + shift[k % 3] - there) < 4e-6);
        }
        assert_true(glint_vec3_length(
                        glint_vec3_subtract(scene.cameras[0].eye, expected.cameras[0].eye)) < 4e-6);
        glint_scene_free(&scene);
        glint_scene_free(&expected);
    }
    glint_scene_close(source);
}

static void at_its_keys_the_scene_is_the_same_bit_for_bit(void **state)
{
    glint_scene_source *source = open_text(*state, moving_text(CLIP, 6), NULL, GLINT_OK, NULL);
    glint_scene scene, expected = baked(*state, "", "");
    for (int again = 0; again < 2; again++) { // other times between must leave no trace
        assert_int_equal(glint_scene_at(source, 0, &scene, NULL, NULL), GLINT_OK);
        scene_by_corner(&scene);
        assert_same_scene(&scene, &expected);
        glint_scene_free(&scene);
        assert_int_equal(glint_scene_at(source, 1.5, &scene, NULL, NULL), GLINT_OK);
        scene_by_corner(&scene);
        glint_scene_free(&scene);
    }
    glint_scene_free(&expected);
    expected =
        baked(*state, ",\"translation\":[4,2,0],\"rotation\":[0,1,0,0]", ",\"scale\":[0,0,0]");
    assert_int_equal(glint_scene_at(source, 2, &scene, NULL, NULL), GLINT_OK);
    scene_by_corner(&scene);
    assert_same_scene(&scene, &expected);
    // Only the cameras.
    assert_int_equal(glint_scene_cameras_at(source, 0, &scene, NULL), GLINT_OK);
    assert_true(scene.cameras[0].eye.z == 9 && scene.cameras[0].eye.x == 0);
    glint_scene_free(&scene);
    glint_scene_free(&expected);
    glint_scene_close(source);
}

static void short_integers_are_turns_too(void **state)
{
    glint_scene a, b;
    glint_scene_source *source = open_text(*state, moving_text(CLIP, 6), NULL, GLINT_OK, NULL);
    assert_int_equal(glint_scene_at(source, 0.7, &a, NULL, NULL), GLINT_OK);
    glint_scene_close(source);
    source = open_text(*state, moving_text(CLIP, 7), NULL, GLINT_OK, NULL);
    assert_int_equal(glint_scene_at(source, 0.7, &b, NULL, NULL), GLINT_OK);
    glint_scene_close(source);
    assert_int_equal(a.vertex_count, b.vertex_count);
    for (size_t k = 0; k < 3 * a.vertex_count; k++) {
        assert_true(fabsf(a.positions[k] - b.positions[k]) < 1e-4f); // shorts are rounded to 2⁻¹⁵
    }
    glint_scene_free(&a);
    glint_scene_free(&b);
}

static void clips_are_chosen_by_name_and_index(void **state)
{
    static const struct {
        const char *clip;
        bool moves;
        const char *refusal;
    } cases[] = {
        {NULL, true, NULL},
        {"wave", true, NULL},
        {"0", true, NULL},
        {"all", true, NULL},
        {"none", false, NULL},
        {"1", false, "there is no animation \"1\" (there is 0 \"wave\")"},
        {"Wave", false, "there is no animation"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        glint_scene_source *source =
            open_text(*state, moving_text(CLIP, 6), cases[i].clip,
                      cases[i].refusal != NULL ? GLINT_BAD_INPUT : GLINT_OK, cases[i].refusal);
        if (source != NULL) {
            assert_int_equal(glint_scene_motion(source)->moves_triangles, cases[i].moves);
        }
        glint_scene_close(source);
    }
}

// The default camera of a moving scene sees the whole motion, and stands still.
static void bounds_are_those_of_the_whole_clip(void **state)
{
    glint_scene_source *source = open_text(*state, moving_text(CLIP, 6), NULL, GLINT_OK, NULL);
    glint_scene scene;
    assert_int_equal(glint_scene_at(source, 0, &scene, NULL, NULL), GLINT_OK);
    glint_vec3 low, high;
    glint_scene_shown_bounds(&scene, &low, &high);
    for (int step = 0; step <= 60; step++) { // these times differ from the sampled times
        glint_scene then;
        assert_int_equal(glint_scene_at(source, step / 30.0, &then, NULL, NULL), GLINT_OK);
        glint_vec3 same_low, same_high;
        glint_scene_shown_bounds(&then, &same_low, &same_high);
        assert_memory_equal(&low, &same_low, sizeof low);
        assert_memory_equal(&high, &same_high, sizeof high);
        // Between two samples 1/32 s apart a point leaves the straight line by at most a/8/32². The
        // point is at most 3.5 m from the axis, turns by 1.6/s and grows by 2 m/s. So a is under
        // 3.5 · 1.6² + 2 · 2 · 1.6 = 15.4 m/s².
        const double near = 15.4 / 8 / 1024;
        assert_true(then.low.x >= low.x - near && then.high.x <= high.x + near);
        assert_true(then.low.y >= low.y - near && then.high.y <= high.y + near);
        assert_true(then.low.z >= low.z - near && then.high.z <= high.z + near);
        glint_scene_free(&then);
    }
    assert_true(high.x < 4 + 1 + 2 + 1e-6 && low.x > -4); // and little more
    glint_scene_free(&scene);
    glint_scene_close(source);
}

// The linker redirects the program's calls to this function (tests/CMakeLists.txt).
bool __real_glint_camera_from_matrix(const glint_mat4 *to_world, glint_camera *camera);
bool __wrap_glint_camera_from_matrix(const glint_mat4 *to_world, glint_camera *camera);
static int cameras_placed;

bool __wrap_glint_camera_from_matrix(const glint_mat4 *to_world, glint_camera *camera)
{
    cameras_placed++;
    return __real_glint_camera_from_matrix(to_world, camera);
}

// A walk of the scene places its camera. Opening a file must not take a walk for each key of a
// clip, because large scenes would then open slowly.
static void opening_does_not_walk_the_scene_at_each_key(void **state)
{
    cameras_placed = 0;
    glint_scene_source *source = open_text(*state, moving_text(CLIP, 6), NULL, GLINT_OK, NULL);
    assert_true(glint_scene_motion(source)->moves_triangles);
    assert_true(cameras_placed <= 1);
    glint_scene scene;
    assert_int_equal(glint_scene_at(source, 1, &scene, NULL, NULL), GLINT_OK);
    assert_true(cameras_placed >= 1 && cameras_placed <= 2);
    glint_scene_free(&scene);
    glint_scene_close(source);
}

// ---- Mistakes ----------------------------------------------------------------------------------

#define ONE_CHANNEL(samplers, channel)                                                             \
    ",\"animations\":[{\"samplers\":[" samplers "],\"channels\":[" channel "]}]%.0d"
#define MOVE "{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"translation\"}}"

// Opens a file whose animation is left out, in whole or in part, for the reason given. Nothing
// moves.
static void assert_left_out(const char *folder, char *text, const char *why)
{
    glint_scene_source *source = open_text(folder, text, NULL, GLINT_OK, NULL);
    assert_false(glint_scene_motion(source)->moves_triangles);
    assert_true(glint_scene_motion(source)->duration == 0);
    glint_scene scene;
    glint_warnings warnings = {0};
    assert_int_equal(glint_scene_at(source, 0, &scene, &warnings, NULL), GLINT_OK);
    if (warnings.count != 1 || !any_warning_has(&warnings, why) ||
        !any_warning_has(&warnings, " is left out")) {
        fail_msg("said \"%s\", expected \"%s\"", warnings.count > 0 ? warnings.texts[0] : "", why);
    }
    glint_warnings_free(&warnings);
    glint_scene_free(&scene);
    glint_scene_close(source);
}

static void channels_that_cannot_be_read_are_left_out(void **state)
{
    static const char *const cases[][2] = {
        {",\"animations\":[{}]%.0d", "animations[0].channels: missing"},
        {",\"animations\":[{\"samplers\":[],\"channels\":5}]%.0d", "animations[0].channels: 5"},
        {ONE_CHANNEL("{\"input\":3,\"output\":4}", "7"), "animations[0].channels[0]: 7 stands"},
        {ONE_CHANNEL("{\"input\":3}", MOVE), "samplers[0].output: missing"},
        {ONE_CHANNEL("{\"input\":99,\"output\":4}", MOVE), "samplers[0].input: 99: there is no"},
        {ONE_CHANNEL("{\"input\":4,\"output\":4}", MOVE),
         "samplers[0].input: the accessor holds VEC3"},
        {ONE_CHANNEL("{\"input\":3,\"output\":6}", MOVE),
         "samplers[0].output: the accessor holds VEC4"},
        {ONE_CHANNEL("{\"input\":3,\"output\":0}", MOVE), "4 values for 3 keys"},
        {ONE_CHANNEL("{\"input\":3,\"output\":4,\"interpolation\":\"CUBICSPLINE\"}", MOVE),
         "3 values for 3 keys, which have three each"},
        {ONE_CHANNEL("{\"input\":3,\"output\":4,\"interpolation\":\"BEZIER\"}", MOVE),
         "\"BEZIER\" is none"},
        {ONE_CHANNEL("{\"input\":3,\"output\":4}",
                     "{\"sampler\":1,\"target\":{\"node\":0,\"path\":\"scale\"}}"),
         "channels[0].sampler: 1: there is no"},
        {ONE_CHANNEL("{\"input\":3,\"output\":4}",
                     "{\"sampler\":0,\"target\":{\"node\":4,\"path\":\"scale\"}}"),
         "channels[0].target.node: 4: there is no"},
        {ONE_CHANNEL("{\"input\":3,\"output\":4}", "{\"sampler\":0,\"target\":{\"node\":0}}"),
         "channels[0]: only translation, rotation, scale and weights"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_left_out(*state, moving_text(cases[i][0], 0), cases[i][1]);
    }
}

// The text of the moving scene with other data and the one clip in `format`.
static char *text_of_data(const moving_data *data, const char *format)
{
    char rest[8192];
    int length = snprintf(rest, sizeof rest, STORAGE NODES, "", "");
    snprintf(rest + length, sizeof rest - (size_t)length, format, 0);
    return gltf_text(data, sizeof *data, rest);
}

static void keys_that_make_no_sense_are_left_out(void **state)
{
    static const struct {
        const char *format, *why;
    } cases[] = {
        {ONE_CHANNEL("{\"input\":3,\"output\":4}", MOVE), "must be finite and ascend; the channel"},
        {ONE_CHANNEL("{\"input\":3,\"output\":4}", MOVE), "must be finite and ascend; the channel"},
        {ONE_CHANNEL("{\"input\":3,\"output\":6}",
                     "{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"rotation\"}}"),
         "a value is no rotation"},
        {ONE_CHANNEL("{\"input\":3,\"output\":4}", MOVE), "a value is not finite"},
    };
    for (int which = 0; which < 4; which++) {
        moving_data data = make_data();
        data.times[1] = which == 0 ? -1 : 1;
        data.times[2] = which == 1 ? NAN : 2;
        if (which == 2) {
            memset(data.turns[1], 0, sizeof data.turns[1]);
        }
        data.places[2][0] = which == 3 ? INFINITY : 4;
        assert_left_out(*state, text_of_data(&data, cases[which].format), cases[which].why);
    }
}

// Where keys repeat a time, the value jumps from the first of them to the last. Keys before time 0
// are part of the curve. The node's tetrahedron ends 2 m to its right.
static void keys_may_repeat_a_time(void **state)
{
    moving_data data = make_data();
    const float places[3][3] = {{0, 0, 0}, {4, 0, 0}, {10, 0, 0}};
    memcpy(data.places, places, sizeof places);
    static const struct {
        float times[3];
        double at[4][2]; // time and x of the node
        bool repeats;
    } cases[] = {
        {{0, 1, 2}, {{0, 0}, {0.5, 2}, {1, 4}, {1.5, 7}}, false},
        {{-1, 1, 2}, {{0, 2}, {0.5, 3}, {1, 4}, {2, 10}}, false},
        {{0, 1, 1}, {{0, 0}, {0.5, 2}, {0.75, 3}, {1, 10}}, true},
        {{0, 0, 1}, {{0, 4}, {0.25, 5.5}, {0.5, 7}, {1, 10}}, true},
        {{0, 0, 0}, {{0, 10}, {0.5, 10}, {1, 10}, {2, 10}}, true},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        memcpy(data.times, cases[i].times, sizeof data.times);
        char *text = text_of_data(&data, ONE_CHANNEL("{\"input\":3,\"output\":4}", MOVE));
        glint_scene_source *source = open_text(*state, text, NULL, GLINT_OK, NULL);
        assert_true(glint_scene_motion(source)->duration == cases[i].times[2]);
        for (int k = 0; k < 4; k++) {
            glint_scene scene;
            glint_warnings warnings = {0};
            assert_int_equal(glint_scene_at(source, cases[i].at[k][0], &scene, &warnings, NULL),
                             GLINT_OK);
            // Positions are floats within 16 m.
            assert_true(fabs(scene.high.x - 2 - cases[i].at[k][1]) < 16 * FLT_EPSILON);
            assert_int_equal(any_warning_has(&warnings, "several keys have one time"),
                             cases[i].repeats);
            glint_warnings_free(&warnings);
            glint_scene_free(&scene);
        }
        glint_scene_close(source);
    }
}

static void what_is_not_animated_is_said(void **state)
{
    char *text =
        moving_text(",\"animations\":[{\"samplers\":[{\"input\":3,\"output\":4}],\"channels\":["
                    "{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"weights\"}},"
                    "{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"pointer\"}},"
                    "{\"sampler\":0,\"target\":{\"path\":\"translation\"}}]},"
                    "{\"samplers\":[],\"channels\":[],\"name\":\"b\"}]%.0d",
                    0);
    glint_scene_source *source = open_text(*state, text, NULL, GLINT_OK, NULL);
    assert_false(glint_scene_motion(source)->moves_triangles);
    glint_scene scene;
    glint_warnings warnings = {0};
    assert_int_equal(glint_scene_at(source, 0, &scene, &warnings, NULL), GLINT_OK);
    assert_true(any_warning_has(&warnings, "channels[0]: the node has no morph targets"));
    assert_true(any_warning_has(&warnings, "channels[1] and 1 more: only translation, rotation"));
    assert_true(any_warning_has(&warnings, "the first of 2 animations is shown"));
    glint_warnings_free(&warnings);
    glint_scene_free(&scene);
    glint_scene_close(source);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_moving_scene_is_the_one_in_which_nodes_stand_so),
        cmocka_unit_test(at_its_keys_the_scene_is_the_same_bit_for_bit),
        cmocka_unit_test(short_integers_are_turns_too),
        cmocka_unit_test(clips_are_chosen_by_name_and_index),
        cmocka_unit_test(bounds_are_those_of_the_whole_clip),
        cmocka_unit_test(opening_does_not_walk_the_scene_at_each_key),
        cmocka_unit_test(channels_that_cannot_be_read_are_left_out),
        cmocka_unit_test(keys_that_make_no_sense_are_left_out),
        cmocka_unit_test(keys_may_repeat_a_time),
        cmocka_unit_test(what_is_not_animated_is_said),
    };
    return cmocka_run_group_tests(tests, scratch_setup, scratch_teardown);
}
