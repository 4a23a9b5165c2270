// Skins and morph targets against a model of their formulas in double precision (support/figure.h),
// and closed forms.
#include "scene/scene.h"

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

static glint_scene scene_at(glint_scene_source *source, double time)
{
    glint_scene scene;
    glint_error error = {0};
    glint_warnings warnings = {0};
    if (glint_scene_at(source, time, &scene, &warnings, &error) != GLINT_OK) {
        fail_msg("%s", error.message);
    }
    if (warnings.count > 0) {
        fail_msg("%s", warnings.texts[0]);
    }
    glint_warnings_free(&warnings);
    return scene;
}

static double world(const glint_scene *scene, size_t number)
{
    const double *origin = &scene->origin.x;
    return origin[number % 3] + scene->unit * (double)scene->positions[number];
}

// Positions are stored in floats of at most one unit, normals in floats of at most 1: half of their
// last digit, and what both ways of computing round in double precision.
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

// Their sums are not 1 by up to 8 halves of 1/255: within what rounds, so nobody is warned.
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

// A scale of 0 along one axis: normals stand on the plane that is left.
static void flattened_skins_keep_their_normals(void **state)
{
    assert_kind(*state, (figure_kind){.influences = 4, .flattens = true, .turns = true}, true);
}

// ---- Bounds ------------------------------------------------------------------------------------

// The default camera's bounds: the figure at all times that are looked at, and no more.
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
        for (int k = 0; k < 3; k++) {
            assert_true(fabs((&shown_low.x)[k] - low[k]) < 1e-12 * 10);
            assert_true(fabs((&shown_high.x)[k] - high[k]) < 1e-12 * 10);
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
        cmocka_unit_test(bounds_are_those_of_the_whole_clip),
    };
    return cmocka_run_group_tests(tests, scratch_setup, scratch_teardown);
}
