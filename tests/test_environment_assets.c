// Tests environments that other programs made, if ../shared is there: pairs of layouts of one
// scene, values that are no radiance, photographed faces.
#include "environment/environment.h"
#include "support/direction_maps.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#define ASSETS GLINT_SOURCE_DIR "/../shared/assets/env/"

static bool is_there(const char *path)
{
    if (access(path, R_OK) != 0) {
        print_message("skipped: %s is not there\n", path);
        return false;
    }
    return true;
}

typedef struct difference {
    double relative; // RMS difference, relative to the mean
    double mirrored; // as a control: the same, with one map mirrored left to right
    double greatest;
} difference;

// Compares two environments over random directions. Values above 1 count as 1, otherwise the place
// of a sun within its texel would dominate.
static difference compare(const char *one, const char *other)
{
    glint_environment a = load_environment(one, GLINT_LAYOUT_UNKNOWN, NULL);
    glint_environment b = load_environment(other, GLINT_LAYOUT_UNKNOWN, NULL);
    difference found = {0};
    double sum = 0.0;
    for (int k = 0; k < 200000; k++) {
        glint_vec3 d = random_direction();
        double at_a[3], at_b[3], mirrored[3];
        glint_cube_sample(&a.radiance, d, at_a);
        glint_cube_sample(&b.radiance, d, at_b);
        glint_cube_sample(&b.radiance, (glint_vec3){-d.x, d.y, d.z}, mirrored);
        for (int c = 0; c < 3; c++) {
            double value = fmin(at_a[c], 1.0), off = value - fmin(at_b[c], 1.0);
            double control = value - fmin(mirrored[c], 1.0);
            sum += value;
            found.relative += off * off;
            found.mirrored += control * control;
            found.greatest = fmax(found.greatest, fabs(off));
        }
    }
    found.relative = sqrt(found.relative / 600000) / (sum / 600000);
    found.mirrored = sqrt(found.mirrored / 600000) / (sum / 600000);
    glint_environment_free(&a);
    glint_environment_free(&b);
    print_message("relative RMSE %.4f (mirrored %.4f), greatest difference %.3f\n", found.relative,
                  found.mirrored, found.greatest);
    return found;
}

// The same labels as a cube and as a lat-long map. The drawing of thin lines differs a little; a
// map in the wrong direction differs several times as much.
static void openexrs_labelled_pair_is_the_same(void **state)
{
    (void)state;
    const char *cube = ASSETS "openexr-images/OrientationCube.exr";
    const char *latlong = ASSETS "openexr-images/OrientationLatLong.exr";
    if (!is_there(cube) || !is_there(latlong)) {
        skip();
    }
    difference found = compare(cube, latlong);
    assert_true(found.relative < 0.05 && found.relative < 0.4 * found.mirrored);
}

static void openexrs_photographed_pair_is_alike(void **state)
{
    (void)state;
    const char *cube = ASSETS "openexr-images/KernerEnvCube.exr";
    const char *latlong = ASSETS "openexr-images/KernerEnvLatLong.exr";
    if (!is_there(cube) || !is_there(latlong)) {
        skip();
    }
    difference found = compare(cube, latlong);
    assert_true(found.relative < 0.1 && found.relative < 0.2 * found.mirrored);
}

static void openexrs_nan_and_infinity_are_counted(void **state)
{
    (void)state;
    const char *path = ASSETS "openexr-images/BrightRingsNanInf.exr";
    if (!is_there(path)) {
        skip();
    }
    glint_environment none;
    glint_error error = {0};
    const glint_layout_request any = {.layout = GLINT_LAYOUT_UNKNOWN};
    assert_int_equal(glint_environment_load(path, &any, &none, NULL, &error), GLINT_BAD_INPUT);
    assert_non_null(strstr(error.message, "mirror ball"));
    glint_error_free(&error);
    glint_warnings warnings = {0};
    glint_environment environment = load_environment(path, GLINT_LAYOUT_LATLONG, &warnings);
    print_message("mended texels: %zu\n", environment.mended_texels);
    assert_true(environment.mended_texels > 0);
    assert_int_equal(warnings.count, 2); // the other warning is about the shape
    glint_warnings_free(&warnings);
    glint_environment_free(&environment);
}

// The faces of a photograph fit together: steps across the cube's edges are no larger than steps
// within faces. A rotated or swapped face breaks this.
static void photographed_faces_fit_together(void **state)
{
    (void)state;
    const char *path = ASSETS "playcanvas/xmas_faces";
    if (!is_there(path)) {
        skip();
    }
    glint_environment environment = load_environment(path, GLINT_LAYOUT_UNKNOWN, NULL);
    const glint_cube *cube = &environment.radiance;
    int edge = cube->edge;
    double across = 0.0, within = 0.0;
    for (int k = 0; k < 6 * edge; k++) {
        int face = k / edge, along = k % edge;
        const int places[4][6] = {{0, along, -1, along, 1, along},
                                  {edge - 1, along, edge, along, edge - 2, along},
                                  {along, 0, along, -1, along, 1},
                                  {along, edge - 1, along, edge, along, edge - 2}};
        for (int side = 0; side < 4; side++) {
            const int *p = places[side];
            double last = (double)glint_cube_texel(cube, face, p[0], p[1])[1];
            across += fabs(last - (double)glint_cube_texel(cube, face, p[2], p[3])[1]);
            within += fabs(last - (double)glint_cube_texel(cube, face, p[4], p[5])[1]);
        }
    }
    print_message("steps across edges %.4f, within faces %.4f\n", across / (24 * edge),
                  within / (24 * edge));
    assert_true(across < 1.5 * within);
    glint_environment_free(&environment);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(openexrs_labelled_pair_is_the_same),
        cmocka_unit_test(openexrs_photographed_pair_is_alike),
        cmocka_unit_test(openexrs_nan_and_infinity_are_counted),
        cmocka_unit_test(photographed_faces_fit_together),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
