// Tests the arithmetic of speed against error: the rungs of a ladder, dominated rungs, errors of
// directions, and the layout of texts and points on a page.
#include "render/ladder.h"
#include "report/speed_error/data_uri.h"
#include "report/speed_error/page_plot.h"
#include "report/speed_error/speed_error.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// ---- The ladder --------------------------------------------------------------------------------

static glint_ladder ladder_of(const glint_feature *features, size_t count, bool half_texels)
{
    glint_plan plan = {.half_texels = half_texels, .depth = GLINT_DEPTH_MAX};
    for (size_t i = 0; i < count; i++) {
        plan.features[features[i]].compiled = true;
    }
    glint_ladder ladder;
    glint_ladder_make(&plan, &glint_settings_default, &ladder);
    return ladder;
}

static bool has_rung(const glint_ladder *ladder, const char *part)
{
    for (size_t i = 0; i < ladder->count; i++) {
        if (strstr(ladder->rungs[i].options, part) != NULL) {
            return true;
        }
    }
    return false;
}

static void check_ladder(const glint_ladder *ladder)
{
    const glint_capabilities device = {.is_cpu = true, .has_double = true};
    const glint_scene nothing = {0};
    assert_in_range(ladder->count, 1, GLINT_RUNGS_MAX);
    for (size_t i = 0; i < ladder->count; i++) {
        const glint_rung *rung = &ladder->rungs[i];
        const glint_plan_inputs inputs = {
            .scene = &nothing, .device = &device, .settings = &rung->settings};
        assert_int_equal(glint_settings_check(inputs.settings, inputs.device, inputs.scene, NULL),
                         GLINT_OK);
        assert_true(rung->name[0] != '\0' && strncmp(rung->options, "--", 2) == 0);
        assert_true(strlen(rung->name) + 1 < sizeof rung->name);
        for (size_t k = 0; k < i; k++) {
            assert_string_not_equal(rung->name, ladder->rungs[k].name);
            assert_string_not_equal(rung->options, ladder->rungs[k].options);
        }
    }
    assert_int_equal(ladder->reference.settings.precision, GLINT_PRECISION_DOUBLE);
    assert_int_equal(ladder->reference.settings.shading, GLINT_SHADING_PIXEL);
}

static void what_a_scene_has_not_has_no_rung(void **state)
{
    (void)state;
    const glint_ladder nothing = ladder_of(NULL, 0, true);
    check_ladder(&nothing);
    assert_false(has_rung(&nothing, "--shading") || has_rung(&nothing, "--depth"));

    const glint_feature of_paint[] = {GLINT_FEATURE_GEOMETRY, GLINT_FEATURE_PAINT};
    const glint_ladder paint = ladder_of(of_paint, 2, false);
    check_ladder(&paint);
    assert_true(has_rung(&paint, "--irradiance sh") && has_rung(&paint, "--depth 1"));
    assert_false(has_rung(&paint, "--depth 2") || has_rung(&paint, "--texels"));

    const glint_feature of_mirrors[] = {GLINT_FEATURE_GEOMETRY, GLINT_FEATURE_MIRROR};
    const glint_ladder mirrors = ladder_of(of_mirrors, 2, true);
    check_ladder(&mirrors);
    assert_true(has_rung(&mirrors, "--depth 2") && has_rung(&mirrors, "--depth auto"));
    assert_true(has_rung(&mirrors, "--texels float"));
    assert_false(has_rung(&mirrors, "--irradiance") || has_rung(&mirrors, "--fresnel"));

    glint_plan proved = {.depth = 1, .depth_is_exact = true};
    proved.features[GLINT_FEATURE_GEOMETRY].compiled = true;
    proved.features[GLINT_FEATURE_MIRROR].compiled = true;
    glint_ladder convex;
    glint_ladder_make(&proved, &glint_settings_default, &convex);
    check_ladder(&convex);
    assert_true(has_rung(&convex, "--depth 1"));
    assert_false(has_rung(&convex, "--depth 2") || has_rung(&convex, "--depth auto"));

    const glint_feature of_glass[] = {GLINT_FEATURE_GEOMETRY, GLINT_FEATURE_GLASS,
                                      GLINT_FEATURE_SPLIT, GLINT_FEATURE_ROUGH};
    const glint_ladder glass = ladder_of(of_glass, 4, true);
    check_ladder(&glass);
    assert_true(has_rung(&glass, "--fresnel none") && has_rung(&glass, "--min-weight 0.0625"));
    assert_true(has_rung(&glass, "--roughness smooth") && has_rung(&glass, "--roughness exact"));
    assert_non_null(strstr(glass.reference.options, " --roughness exact"));
    assert_false(has_rung(&mirrors, "--roughness") || strstr(mirrors.reference.options, "rough"));
    assert_int_equal(glass.count, GLINT_RUNGS_MAX);
}

// A rung only changes its own settings.
static void the_rest_is_as_it_was(void **state)
{
    (void)state;
    glint_plan plan = {.half_texels = true};
    plan.features[GLINT_FEATURE_GEOMETRY].compiled = true;
    plan.features[GLINT_FEATURE_SPLIT].compiled = true;
    glint_settings settings = glint_settings_default;
    settings.width = 31;
    settings.samples_per_axis = 3;
    settings.env_rotate = 12;
    settings.transparent = true;
    glint_ladder ladder;
    glint_ladder_make(&plan, &settings, &ladder);
    for (size_t i = 0; i <= ladder.count; i++) {
        const glint_settings *of =
            i < ladder.count ? &ladder.rungs[i].settings : &ladder.reference.settings;
        assert_true(of->width == 31 && of->samples_per_axis == 3 && of->env_rotate == 12 &&
                    of->transparent);
    }
}

// ---- Dominated rungs ---------------------------------------------------------------------------

static void the_beaten_know_by_whom(void **state)
{
    (void)state;
    static const struct {
        double ms, error;
        int by;
    } cases[] = {
        {1, 0.5, -1},  {2, 0.5, 0},             // the same error, but slower
        {3, 0.1, -1},  {3, 0.2, 2},             // the same speed, but a larger error
        {4, NAN, 0},   {5, 0.05, 6},            // the fastest rung dominates NaN
        {5, 0.01, -1}, {6, 0, -1},   {7, 0, 7}, // two without an error: the faster remains
    };
    enum { COUNT = sizeof cases / sizeof *cases };
    glint_rung_result rungs[COUNT] = {0};
    for (int i = 0; i < COUNT; i++) {
        rungs[i].kernel.median = cases[i].ms;
        rungs[i].error.relative_rmse = cases[i].error;
    }
    glint_speed_error_compare(rungs, COUNT);
    for (int i = 0; i < COUNT; i++) {
        assert_int_equal(rungs[i].dominated_by, cases[i].by);
    }
    glint_rung_result same[2] = {0}; // neither dominates
    glint_speed_error_compare(same, 2);
    assert_true(same[0].dominated_by < 0 && same[1].dominated_by < 0);
}

// ---- Directions --------------------------------------------------------------------------------

enum { PIXELS = 200 };

typedef struct directions {
    float values[7][PIXELS];
    glint_layers layers;
} directions;

static void make_directions(directions *d)
{
    static const char *const names[7] = {"terms.00.x",    "terms.00.y",  "terms.00.z",
                                         "terms.00.kind", "terms.00.wr", "terms.00.wg",
                                         "terms.00.wb"};
    memset(d, 0, sizeof *d);
    for (int k = 0; k < 7; k++) {
        d->layers.channels[k] = (glint_channel){names[k], d->values[k]};
    }
    d->layers.count = 7;
    for (int i = 0; i < PIXELS; i++) {
        d->values[2][i] = 1;
        d->values[5][i] = 0.25f;
    }
}

static void turn(directions *d, int pixel, double degrees)
{
    d->values[0][pixel] = (float)sin(degrees * 3.14159265358979 / 180);
    d->values[2][pixel] = (float)cos(degrees * 3.14159265358979 / 180);
}

static void angles_are_told_in_degrees(void **state)
{
    (void)state;
    static directions both[2];
    directions *one = &both[0], *other = &both[1];
    make_directions(one);
    make_directions(other);
    glint_direction_error found;
    assert_int_equal(glint_direction_error_find(&one->layers, &other->layers, PIXELS, &found, NULL),
                     GLINT_OK);
    assert_true(found.compared == PIXELS && found.mean == 0 && found.largest == 0);

    turn(one, 7, 90);
    turn(one, 8, 1e-4);       // too small for the cosine
    other->values[3][9] = 1;  // an irradiance
    other->values[5][10] = 0; // no light
    assert_int_equal(glint_direction_error_find(&one->layers, &other->layers, PIXELS, &found, NULL),
                     GLINT_OK);
    assert_int_equal(found.compared, PIXELS - 2);
    assert_int_equal(found.lost, 2);
    assert_float_equal(found.largest, 90, 1e-5);
    assert_float_equal(found.mean, (90 + 1e-4) / (PIXELS - 2), 1e-7);

    one->layers.count = 3;
    assert_int_equal(glint_direction_error_find(&one->layers, &other->layers, PIXELS, &found, NULL),
                     GLINT_USAGE);
}

// ---- The plot ----------------------------------------------------------------------------------

static char *plot_of(const glint_plot_point *points, size_t count)
{
    static char *text; // static: for a variable on the stack, GCC 12 warns of a dangling pointer
    static size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    glint_page_plot(points, count, out);
    fclose(out);
    return text;
}

static size_t count_of(const char *text, const char *part)
{
    size_t count = 0;
    for (const char *at = strstr(text, part); at != NULL; at = strstr(at + 1, part)) {
        count++;
    }
    return count;
}

static void what_can_be_shown_is(void **state)
{
    (void)state;
    const glint_plot_point points[] = {
        {3, 0.2, 2.5, 3.5, true, "a < b & \"c\"", "#a"},
        {40, 0, 40, 40, true, "exact", "#b"},
        {5, NAN, 5, 5, false, "wrong", "#c"},
        {0, 0.1, 0, 0, false, "not measured", "#d"},
        {20, INFINITY, 20, 20, false, "black", "#e"},
    };
    char *text = plot_of(points, 5);
    assert_int_equal(count_of(text, "<circle"), 2);
    assert_int_equal(count_of(text, "class=\"spread\""), 1);
    assert_non_null(strstr(text, "a &lt; b &amp; &quot;c&quot;"));
    assert_non_null(strstr(text, ">none<"));
    assert_true(strstr(text, "nan") == NULL && strstr(text, "inf") == NULL);
    free(text);
    text = plot_of(points, 0); // an empty plot is valid
    assert_true(strstr(text, "nan") == NULL && strstr(text, "inf") == NULL);
    assert_int_equal(count_of(text, "<circle"), 0);
    free(text);
}

// All points must be within the axes, for narrow and wide ranges.
static void points_stay_within_the_axes(void **state)
{
    (void)state;
    for (int i = 0; i < 9; i++) {
        const double spread = pow(7, i);
        for (int j = 0; j < 6; j++) {
            const double ms = 0.013 * pow(31, j);
            const glint_plot_point points[] = {{ms, 0.1, ms, ms, true, "", "#a"},
                                               {ms * spread, 0.1 / spread, 0, 0, true, "", "#b"}};
            char *text = plot_of(points, 2);
            const char *at = text;
            for (int k = 0; k < 2; k++) {
                double x, y;
                at = strstr(at, "<circle");
                assert_non_null(at);
                assert_int_equal(sscanf(at, "<circle cx=\"%lf\" cy=\"%lf\"", &x, &y), 2);
                assert_true(x >= 69.9 && x <= 740.1 && y >= 19.9 && y <= 360.1);
                at++;
            }
            free(text);
        }
    }
}

// The base64 text of a PNG file's first eight bytes.
static void pictures_of_the_page_need_no_file(void **state)
{
    (void)state;
    glint_image image;
    char *uri;
    assert_int_equal(glint_image_create(3, 2, 3, &image, NULL), GLINT_OK);
    assert_int_equal(setenv("TMPDIR", "/nowhere", 1), 0);
    assert_int_equal(glint_data_uri_make(&image, GLINT_DATA_PNG, &uri, NULL), GLINT_OK);
    assert_memory_equal(uri, "data:image/png;base64,iVBORw0KGgo", 33);
    free(uri);
    assert_int_equal(glint_data_uri_make(&image, GLINT_DATA_JPEG, &uri, NULL), GLINT_OK);
    assert_memory_equal(uri, "data:image/jpeg;base64,/9j/", 27);
    free(uri);
    assert_int_equal(unsetenv("TMPDIR"), 0);
    glint_image_free(&image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_a_scene_has_not_has_no_rung),
        cmocka_unit_test(the_rest_is_as_it_was),
        cmocka_unit_test(the_beaten_know_by_whom),
        cmocka_unit_test(angles_are_told_in_degrees),
        cmocka_unit_test(what_can_be_shown_is),
        cmocka_unit_test(points_stay_within_the_axes),
        cmocka_unit_test(pictures_of_the_page_need_no_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
