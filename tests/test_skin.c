// Tests skins and morph targets against a model of their formulas in double precision
// (support/figure.h), and against closed forms.
#include "scene/scene.h"

#include "support/by_corner.h"
#include "support/figure.h"
#include "support/gltf_text.h"
#include "support/scratch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static glint_scene_source *open_text(const char *folder, const char *text)
{
    const char *path = write_bytes(folder, "figure.gltf", text, strlen(text));
    glint_scene_source *source;
    glint_error error = {0};
    if (glint_scene_open(path, NULL, &source, &error) != GLINT_OK) {
        fail_msg("%s", error.message);
    }
    return source;
}

static glint_scene_source *open_figure(const char *folder, const figure *f)
{
    char *text = figure_text(f);
    glint_scene_source *source = open_text(folder, text);
    free(text);
    return source;
}

// Expects one warning that contains `warning`; NULL: none.
static glint_scene warned_scene_at(glint_scene_source *source, double time, const char *warning)
{
    glint_scene scene;
    glint_error error = {0};
    glint_warnings warnings = {0};
    if (glint_scene_at(source, time, &scene, &warnings, &error) != GLINT_OK) {
        fail_msg("%s", error.message);
    }
    assert_true(warnings.count <= 1);
    const char *said = warnings.count > 0 ? warnings.texts[0] : "";
    if (warning == NULL ? warnings.count > 0 : strstr(said, warning) == NULL) {
        fail_msg("said: %s", said);
    }
    glint_warnings_free(&warnings);
    scene_by_corner(&scene);
    return scene;
}

static glint_scene scene_at(glint_scene_source *source, double time)
{
    return warned_scene_at(source, time, NULL);
}

static double world(const glint_scene *scene, size_t number)
{
    const double origin[3] = {scene->origin.x, scene->origin.y, scene->origin.z};
    return origin[number % 3] + scene->unit * (double)scene->positions[number];
}

// Positions are stored as floats of at most one unit, normals as floats of at most 1. The tolerance
// is half of the last digit, plus the rounding of both computations in double precision.
static void assert_stands_as_modelled(const figure *f, const glint_scene *scene, double time)
{
    const double rounding = 0x1p-25 * (1 + 1e-5);
    assert_int_equal(scene->triangle_count, FIGURE_TRIANGLES);
    for (int t = 0; t < FIGURE_TRIANGLES; t++) {
        const figure_triangle expected = figure_triangle_at(f, time, t);
        for (int k = 0; k < 9; k++) {
            const size_t number = 9 * (size_t)t + (size_t)k;
            const double position = world(scene, number) - (&expected.positions[0][0])[k];
            const double normal = (double)scene->normals[number] - (&expected.normals[0][0])[k];
            if (!(fabs(position) <= scene->unit * rounding) || !(fabs(normal) <= rounding)) {
                fail_msg("seed %d, %g s, triangle %d, number %d: position off by %g, normal by %g",
                         (int)f->kind.seed, time, t, k, position, normal);
            }
        }
    }
}

static const double times[] = {-1, 0, 0.1, 0.25, 0.5, 0.7, 1, 1.9, 2, 77};

static void assert_kind(const char *folder, figure_kind kind, bool moves)
{
    for (kind.seed = 1; kind.seed <= 5; kind.seed++) {
        const figure f = figure_make(&kind);
        glint_scene_source *source = open_figure(folder, &f);
        assert_int_equal(glint_scene_motion(source)->moves_triangles, moves);
        for (size_t i = 0; i < sizeof times / sizeof *times; i++) {
            glint_scene scene = scene_at(source, times[i]);
            assert_int_equal(scene.moves, moves);
            assert_stands_as_modelled(&f, &scene, times[i]);
            glint_scene_free(&scene);
        }
        glint_scene_close(source);
    }
}

static void a_node_places_what_has_no_skin(void **state)
{
    assert_kind(*state, (figure_kind){0}, false);
    assert_kind(*state, (figure_kind){.targets = 3}, false); // all weights are 0
}

static void targets_add_up(void **state)
{
    assert_kind(*state, (figure_kind){.targets = 3, .weights_of = "mesh"}, false);
    assert_kind(*state, (figure_kind){.targets = 3, .weights_of = "node"}, false);
    assert_kind(*state, (figure_kind){.targets = 1, .weights_of = "node"}, false);
}

static void weights_follow_their_keys(void **state)
{
    static const char *const ways[] = {"STEP", "LINEAR", "CUBICSPLINE"};
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        figure_kind kind = {.targets = 3, .interpolation = ways[i]};
        assert_kind(*state, kind, true);
        kind.targets = 1;
        kind.weights_of = "node"; // which the keys override
        assert_kind(*state, kind, true);
    }
}

static void targets_may_be_sparse_or_quantised(void **state)
{
    for (figure_deltas deltas = FIGURE_BYTES; deltas <= FIGURE_SPARSE; deltas++) {
        assert_kind(*state, (figure_kind){.targets = 3, .weights_of = "node", .deltas = deltas},
                    false);
        assert_kind(*state,
                    (figure_kind){.targets = 2, .interpolation = "CUBICSPLINE", .deltas = deltas},
                    true);
    }
}

static void vertices_follow_their_joints(void **state)
{
    for (int influences = 4; influences <= 8; influences += 4) {
        figure_kind kind = {.influences = influences};
        assert_kind(*state, kind, false);
        kind.turns = true;
        assert_kind(*state, kind, true);
        kind.no_inverse_bind = true;
        assert_kind(*state, kind, true);
        kind.hides_mesh_node = true;
        kind.short_joints = true;
        assert_kind(*state, kind, true);
    }
}

// The sums differ from 1 by up to 8 halves of 1/255. This is rounding, so there is no warning.
static void weights_may_be_integers(void **state)
{
    static const int types[] = {5121, 5123};
    for (size_t i = 0; i < 2; i++) {
        figure_kind kind = {.influences = 4, .weight_type = types[i], .turns = true};
        assert_kind(*state, kind, true);
        kind.influences = 8;
        kind.short_joints = true;
        assert_kind(*state, kind, true);
    }
}

static void morphs_come_before_skins(void **state)
{
    assert_kind(*state,
                (figure_kind){.influences = 8,
                              .turns = true,
                              .targets = 3,
                              .interpolation = "CUBICSPLINE",
                              .deltas = FIGURE_SPARSE},
                true);
    assert_kind(*state, (figure_kind){.influences = 4, .targets = 2, .weights_of = "mesh"}, false);
}

static void mirrored_joints_turn_the_winding(void **state)
{
    assert_kind(*state, (figure_kind){.influences = 4, .mirrors = true, .turns = true}, true);
    assert_kind(*state, (figure_kind){.influences = 8, .mirrors = true, .no_inverse_bind = true},
                false);
}

// A scale of 0 along one axis: normals are perpendicular to the remaining plane.
static void flattened_skins_keep_their_normals(void **state)
{
    assert_kind(*state, (figure_kind){.influences = 4, .flattens = true, .turns = true}, true);
}

// ---- Nodes -------------------------------------------------------------------------------------

static void joints_need_not_be_in_the_scene(void **state)
{
    assert_kind(*state, (figure_kind){.influences = 4, .turns = true, .joints_outside = true},
                true);
}

// The instance alone places each copy of a skinned mesh; a morphed mesh also uses its node. The
// second copy is the first, shifted.
static void instances_share_what_deforms_them(void **state)
{
    figure_kind kind = {.influences = 8, .turns = true, .instanced = true, .seed = 7};
    for (int skinned = 1; skinned >= 0; skinned--) {
        kind.targets = 3;
        kind.interpolation = "LINEAR";
        kind.influences = skinned ? 8 : 0;
        figure f = figure_make(&kind);
        for (int k = 0; k < 3; k++) { // the node neither turns nor scales
            f.mesh_node.rotation[k] = 0;
            f.mesh_node.scale[k] = 1;
        }
        f.mesh_node.rotation[3] = 1;
        glint_scene_source *source = open_figure(*state, &f);
        glint_scene scene = scene_at(source, 0.3);
        assert_int_equal(scene.triangle_count, 2 * FIGURE_TRIANGLES);
        for (size_t number = 0; number < 9 * FIGURE_TRIANGLES; number++) {
            const double shift =
                world(&scene, number + 9 * (size_t)FIGURE_TRIANGLES) - world(&scene, number);
            assert_true(fabs(shift - (double)figure_instance[number % 3]) <= scene.unit * 0x1p-24);
            const figure_triangle expected = figure_triangle_at(&f, 0.3, (int)(number / 9));
            assert_true(fabs(world(&scene, number) - (&expected.positions[0][0])[number % 9]) <=
                        scene.unit * 0x1p-24);
        }
        glint_scene_free(&scene);
        glint_scene_close(source);
    }
}

// glTF hides a skinned mesh if all joints have scale 0, but not if only its node has.
static void joints_of_no_size_hide_the_mesh(void **state)
{
    const figure_kind kind = {.influences = 4, .seed = 1};
    figure f = figure_make(&kind);
    memset(f.rig.scale, 0, sizeof f.rig.scale);
    glint_scene_source *source = open_figure(*state, &f);
    glint_scene scene;
    glint_warnings warnings = {0};
    assert_int_equal(glint_scene_at(source, 0, &scene, &warnings, NULL), GLINT_OK);
    assert_int_equal(warnings.count, 0); // who hides a mesh so means it
    assert_int_equal(scene.triangle_count, 0);
    assert_int_equal(scene.degenerate_triangles, 0);
    glint_warnings_free(&warnings);
    glint_scene_free(&scene);
    glint_scene_close(source);
}

// ---- Mistakes ----------------------------------------------------------------------------------

// The loader normalises sums that are not 1, like the model.
static void weights_are_normalised_with_a_warning(void **state)
{
    const figure_kind kind = {.influences = 8, .turns = true, .seed = 2};
    figure f = figure_make(&kind);
    for (int i = 0; i < FIGURE_INFLUENCES; i++) {
        f.weights[3][i] *= 2;
        f.weights[9][i] *= 0.25;
    }
    glint_scene_source *source = open_figure(*state, &f);
    glint_scene scene = warned_scene_at(
        source, 0.4, "meshes[0].primitives[0]: joint weights do not sum to 1 and are normalised");
    assert_stands_as_modelled(&f, &scene, 0.4);
    glint_scene_free(&scene);
    glint_scene_close(source);
}

static void vertices_without_a_weight_follow_the_first_joint_that_they_name(void **state)
{
    const figure_kind kind = {.influences = 4, .turns = true, .seed = 4};
    figure f = figure_make(&kind);
    memset(f.weights[5], 0, sizeof f.weights[5]);
    glint_scene_source *source = open_figure(*state, &f);
    glint_scene scene = warned_scene_at(source, 1, "follow the first joint that they name");
    f.weights[5][0] = 1;
    assert_stands_as_modelled(&f, &scene, 1);
    glint_scene_free(&scene);
    glint_scene_close(source);
}

static void spoil(figure *f, int which)
{
    switch (which) {
    case 0:
        f->weights[5][2] = -0.25;
        break;
    case 1:
        f->weights[6][7] = NAN;
        break;
    case 2:
        f->weights[0][4] = INFINITY;
        break;
    case 3:
        f->joints[7][5] = FIGURE_JOINTS;
        f->weights[7][5] = 0.5;
        break;
    case 4:
        memset(f->weights[8], 0, sizeof f->weights[8]);
        f->joints[8][0] = 200;
        break;
    case 5:
        f->inverse_bind[2][5] = NAN;
        break;
    case 6:
        f->inverse_bind[3][7] = 0.5f;
        break;
    default:
        f->deltas[1][0][4][2] = NAN;
        break;
    }
}

static void what_means_nothing_is_refused(void **state)
{
    static const char *const said[] = {
        "meshes[0].primitives[0].attributes.WEIGHTS_0: vertex 5 has a weight of -0.25",
        "meshes[0].primitives[0].attributes.WEIGHTS_1: vertex 6 has a weight of nan",
        "meshes[0].primitives[0].attributes.WEIGHTS_1: vertex 0 has a weight of inf",
        "attributes.JOINTS_1: vertex 7 follows joint 4 (the skin has 4 joints)",
        "attributes.JOINTS_0: vertex 8 follows joint 200 (the skin has 4 joints)",
        "skins[0].inverseBindMatrices: matrix 2 is not finite",
        "skins[0].inverseBindMatrices: the last row of matrix 3 is not 0 0 0 1",
        "vertex 4 is (nan, nan, nan) once its targets and joints have moved it",
    };
    for (int which = 0; which < (int)(sizeof said / sizeof *said); which++) {
        for (int turns = 0; turns < 2; turns++) { // the bounds of a clip find the error first
            const figure_kind kind = {.influences = 8,
                                      .targets = 3,
                                      .interpolation = "LINEAR",
                                      .turns = turns != 0,
                                      .seed = 5};
            figure f = figure_make(&kind);
            spoil(&f, which);
            char *text = figure_text(&f);
            glint_scene scene;
            glint_error error = {0};
            assert_int_equal(load_text(*state, text, &scene, NULL, &error), GLINT_BAD_INPUT);
            if (strstr(error.message, said[which]) == NULL) {
                fail_msg("%s: not %s", error.message, said[which]);
            }
            glint_error_free(&error);
            free(text);
        }
    }
}

// A file of a few lines may ask for hours of adding zeros.
static void more_work_than_minutes_is_refused(void **state)
{
    enum { TARGETS = 1100 };
    static const char head[] =
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"accessors\":[{\"componentType\":5126,\"count\":16777215,\"type\":\"VEC3\"}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"targets\":[";
    const size_t most = sizeof head + TARGETS * sizeof "{\"POSITION\":0},1," + 64;
    char *text = malloc(most);
    assert_non_null(text);
    size_t length = (size_t)snprintf(text, most, "%s", head);
    for (int i = 0; i < TARGETS; i++) {
        length +=
            (size_t)snprintf(text + length, most - length, "%s{\"POSITION\":0}", i > 0 ? "," : "");
    }
    length += (size_t)snprintf(text + length, most - length, "]}],\"weights\":[");
    for (int i = 0; i < TARGETS; i++) {
        length += (size_t)snprintf(text + length, most - length, i > 0 ? ",1" : "1");
    }
    length += (size_t)snprintf(text + length, most - length, "]}]}");
    assert_true(length < most);
    glint_scene scene;
    glint_error error = {0};
    assert_int_equal(load_text(*state, text, &scene, NULL, &error), GLINT_BAD_INPUT);
    if (strstr(error.message, "its skins and morph targets move 1.84") == NULL) {
        fail_msg("%s", error.message);
    }
    glint_error_free(&error);
    free(text);
}

// A joint with weight 0 may have any index.
static void joints_without_weight_may_be_any(void **state)
{
    const figure_kind kind = {.influences = 4, .turns = true, .seed = 6};
    figure f = figure_make(&kind);
    f.weights[5][1] = f.weights[5][2] = 0;
    f.joints[5][1] = f.joints[5][2] = 255;
    glint_scene_source *source = open_figure(*state, &f);
    glint_scene scene = warned_scene_at(source, 1, "");
    f.joints[5][1] = f.joints[5][2] = 0;
    assert_stands_as_modelled(&f, &scene, 1);
    glint_scene_free(&scene);
    glint_scene_close(source);
}

// ---- Bounds ------------------------------------------------------------------------------------

// The bounds of the default camera hold the figure at all sampled times, and no more.
static void bounds_are_those_of_the_whole_clip(void **state)
{
    const figure_kind kind = {
        .influences = 8, .turns = true, .targets = 3, .interpolation = "LINEAR", .seed = 3};
    const figure f = figure_make(&kind);
    glint_scene_source *source = open_figure(*state, &f);
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int look = 0; look <= 64 + FIGURE_KEYS; look++) {
        const double time = look <= 64 ? look / 32.0 : (double)f.times[look - 65];
        for (int t = 0; t < FIGURE_TRIANGLES; t++) {
            const figure_triangle triangle = figure_triangle_at(&f, time, t);
            for (int k = 0; k < 9; k++) {
                low[k % 3] = fmin(low[k % 3], (&triangle.positions[0][0])[k]);
                high[k % 3] = fmax(high[k % 3], (&triangle.positions[0][0])[k]);
            }
        }
    }
    for (int i = 0; i < 3; i++) {
        glint_scene scene = scene_at(source, i * 0.6);
        glint_vec3 shown_low, shown_high;
        glint_scene_shown_bounds(&scene, &shown_low, &shown_high);
        const double shown[6] = {shown_low.x,  shown_low.y,  shown_low.z,
                                 shown_high.x, shown_high.y, shown_high.z};
        for (int k = 0; k < 3; k++) {
            assert_true(fabs(shown[k] - low[k]) < 1e-12 * 10);
            assert_true(fabs(shown[3 + k] - high[k]) < 1e-12 * 10);
        }
        glint_scene_free(&scene);
    }
    glint_scene_close(source);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_node_places_what_has_no_skin),
        cmocka_unit_test(targets_add_up),
        cmocka_unit_test(weights_follow_their_keys),
        cmocka_unit_test(targets_may_be_sparse_or_quantised),
        cmocka_unit_test(vertices_follow_their_joints),
        cmocka_unit_test(weights_may_be_integers),
        cmocka_unit_test(morphs_come_before_skins),
        cmocka_unit_test(mirrored_joints_turn_the_winding),
        cmocka_unit_test(flattened_skins_keep_their_normals),
        cmocka_unit_test(joints_need_not_be_in_the_scene),
        cmocka_unit_test(instances_share_what_deforms_them),
        cmocka_unit_test(joints_of_no_size_hide_the_mesh),
        cmocka_unit_test(weights_are_normalised_with_a_warning),
        cmocka_unit_test(vertices_without_a_weight_follow_the_first_joint_that_they_name),
        cmocka_unit_test(what_means_nothing_is_refused),
        cmocka_unit_test(more_work_than_minutes_is_refused),
        cmocka_unit_test(joints_without_weight_may_be_any),
        cmocka_unit_test(bounds_are_those_of_the_whole_clip),
    };
    return cmocka_run_group_tests(tests, scratch_setup, scratch_teardown);
}
