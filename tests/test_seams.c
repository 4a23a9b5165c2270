// Tests seams of device look-ups. Fine lines cross every edge and corner of the cube, and the poles
// and ±180° of the lat-long map. Steps and errors must not be larger there than within faces.
#include "render/probe.h"

#include "base/random.h"
#include "support/bridge.h"
#include "support/render.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

enum { EDGE = 128, LINES = 24, ALONG = 400, PAIRS = 12 * ALONG };
#define TEXEL (2.0 / EDGE) // size on a face, which extends from −1 to 1
#define STEP (TEXEL / 8)   // distance between the two look-ups of a pair

// Lines are great circles in all directions, three texels wide. Each crosses edges of every face.
static glint_vec3 normals[LINES];

static void choose_lines(void)
{
    for (int i = 0; i < LINES; i++) {
        const double z = (2 * i + 1.0) / LINES - 1, turn = 2.39996322972865332 * i; // golden angle
        const double r = sqrt(1 - z * z);
        normals[i] = (glint_vec3){r * cos(turn), r * sin(turn), z};
    }
}

static double radiance(glint_vec3 d)
{
    const double width = 1.5 * TEXEL;
    double sum = 0;
    d = glint_vec3_scale(d, 1 / glint_vec3_length(d));
    for (int i = 0; i < LINES; i++) {
        const double off = glint_vec3_dot(d, normals[i]) / width;
        sum += exp(-off * off);
    }
    return sum;
}

static void make_cube(glint_environment *environment)
{
    *environment = (glint_environment){0};
    assert_int_equal(glint_cube_create(EDGE, &environment->radiance, NULL), GLINT_OK);
    for (int k = 0; k < 6 * EDGE * EDGE; k++) {
        const int face = k / (EDGE * EDGE), i = k % EDGE, j = k / EDGE % EDGE;
        const double e = radiance(
            glint_cube_direction(face, (2.0 * i + 1) / EDGE - 1, (2.0 * j + 1) / EDGE - 1));
        const double rgb[3] = {e, e, e};
        glint_cube_store(&environment->radiance, face, i, j, rgb);
    }
    glint_cube_fill_border(&environment->radiance);
}

// A map of 4·EDGE columns: +Y up, +Z in the middle, +X a quarter from the left.
static void make_latlong(glint_environment *environment)
{
    glint_image image;
    assert_int_equal(glint_image_create(4 * EDGE, 2 * EDGE, 3, &image, NULL), GLINT_OK);
    for (int j = 0; j < 2 * EDGE; j++) {
        for (int i = 0; i < 4 * EDGE; i++) {
            const double latitude = GLINT_PI * (0.5 - (j + 0.5) / (2 * EDGE));
            const double longitude = 2 * GLINT_PI * (0.5 - (i + 0.5) / (4 * EDGE));
            const double e = radiance((glint_vec3){cos(latitude) * sin(longitude), sin(latitude),
                                                   cos(latitude) * cos(longitude)});
            for (int c = 0; c < 3; c++) {
                glint_image_pixel(&image, i, j)[c] = (float)e;
            }
        }
    }
    assert_int_equal(glint_environment_from_image("lines", &image, NULL, environment, NULL),
                     GLINT_OK);
}

// Results of pairs of look-ups: the largest step within a pair, scaled to the angle of a texel in
// the middle of a face; and the largest error.
typedef struct measured {
    double step, error;
} measured;

static measured look_up(glint_probe *probe, const glint_vec3 *directions, size_t count)
{
    double *in = calloc(count, 4 * sizeof *in), *out = calloc(count, 4 * sizeof *out);
    measured m = {0};
    glint_error error = {0};
    glint_frame_record view;
    assert_non_null(in);
    assert_non_null(out);
    for (size_t i = 0; i < count; i++) {
        const glint_vec3 d = glint_vec3_scale(directions[i], 1 / glint_vec3_length(directions[i]));
        in[4 * i] = d.x;
        in[4 * i + 1] = d.y;
        in[4 * i + 2] = d.z;
    }
    glint_probe_view(probe, NULL, NULL, &view);
    assert_int_equal(
        glint_probe_call(probe, &(glint_probe_work){GLINT_PROBE_ENVIRONMENT, &view, in, out, count},
                         &error),
        GLINT_OK);
    for (size_t i = 0; i < count; i++) {
        m.error = fmax(m.error, fabs(out[4 * i] - radiance(directions[i])));
        if (i % 2 == 1) {
            const glint_vec3 a = {in[4 * i], in[4 * i + 1], in[4 * i + 2]};
            const glint_vec3 b = {in[4 * i - 4], in[4 * i - 3], in[4 * i - 2]};
            // The angle between the directions.
            const double apart = glint_vec3_length(glint_vec3_subtract(a, b));
            m.step = fmax(m.step, fabs(out[4 * i] - out[4 * i - 4]) / apart * TEXEL);
        }
    }
    free(in);
    free(out);
    return m;
}

// Makes pairs across the cube's edges. Two coordinates have equal size; the third runs along the
// edge, up to and over the corners.
static size_t across_edges(glint_vec3 *directions)
{
    size_t count = 0;
    for (int edge = 0; edge < 12; edge++) {
        const int axis = edge / 4, a = (axis + 1) % 3, b = (axis + 2) % 3;
        for (int k = 0; k < ALONG; k++) {
            for (int side = -1; side <= 1; side += 2) {
                double d[3];
                d[axis] = 2.0 * k / (ALONG - 1) - 1;
                d[a] = (edge & 1 ? 1 : -1) * (1 + side * STEP / 2);
                d[b] = edge & 2 ? 1 : -1;
                directions[count++] = (glint_vec3){d[0], d[1], d[2]};
            }
        }
    }
    return count;
}

// Makes pairs around each corner. Some cross one edge, some two.
static size_t round_corners(glint_vec3 *directions)
{
    size_t count = 0;
    for (int corner = 0; corner < 8; corner++) {
        const glint_vec3 c = {corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1};
        const glint_vec3 right = glint_vec3_scale((glint_vec3){c.x, -c.y, 0}, sqrt(0.5));
        const glint_vec3 up = glint_vec3_scale((glint_vec3){c.x, c.y, -2 * c.z}, sqrt(1.0 / 6));
        for (int k = 0; k < 400; k++) {
            const double radius = TEXEL * (k % 20) / 10, turn = GLINT_PI * k / 200;
            for (int side = -1; side <= 1; side += 2) {
                const double x = radius * cos(turn) - side * STEP / 2 * sin(turn);
                const double y = radius * sin(turn) + side * STEP / 2 * cos(turn);
                directions[count++] = glint_vec3_add(
                    c, glint_vec3_add(glint_vec3_scale(right, x), glint_vec3_scale(up, y)));
            }
        }
    }
    return count;
}

// Makes pairs across the half plane x = 0, z < 0, the lat-long's ±180°, up to the poles.
static size_t across_the_back(glint_vec3 *directions)
{
    size_t count = 0;
    for (int k = 0; k < PAIRS; k++) {
        const double latitude = GLINT_PI * ((k + 0.5) / PAIRS - 0.5);
        for (int side = -1; side <= 1; side += 2) {
            directions[count++] = (glint_vec3){side * STEP / 2, sin(latitude), -cos(latitude)};
        }
    }
    return count;
}

// Makes pairs within faces, at least four texels from the edges.
static size_t within_faces(glint_vec3 *directions)
{
    glint_random random = {20};
    size_t count = 0;
    for (int k = 0; k < 20 * PAIRS; k++) {
        const double reach = 1 - 4 * TEXEL;
        const double s = reach * (2 * glint_random_number(&random) - 1);
        const double t = reach * (2 * glint_random_number(&random) - 1);
        const double turn = 2 * GLINT_PI * glint_random_number(&random);
        for (int side = -1; side <= 1; side += 2) {
            directions[count++] = glint_cube_direction(k % 6, s + side * STEP / 2 * cos(turn),
                                                       t + side * STEP / 2 * sin(turn));
        }
    }
    return count;
}

static void check(glint_environment *environment, const char *name)
{
    glint_scene scene;
    glint_error error = {0};
    glint_probe *probe;
    glint_settings settings = test_small_frame(1);
    settings.texels = GLINT_TEXELS_FLOAT;
    test_scene_load("mirror_sphere", &scene);
    const glint_renderer_inputs inputs = {.device = test_device(),
                                          .scene = &scene,
                                          .environment = environment,
                                          .settings = &settings,
                                          .without_frames = true};
    assert_int_equal(glint_probe_create(&inputs, &probe, &error), GLINT_OK);
    glint_vec3 *directions = calloc(40 * PAIRS, sizeof *directions);
    assert_non_null(directions);
    // Measure within faces, then at each kind of seam.
    const measured within = look_up(probe, directions, within_faces(directions));
    const struct {
        const char *where;
        size_t (*make)(glint_vec3 *directions);
    } seams[] = {{"edges", across_edges}, {"corners", round_corners}, {"back", across_the_back}};
    print_message("%s: within faces steps to %.4f, errors to %.4f\n", name, within.step,
                  within.error);
    for (int i = 0; i < 3; i++) {
        const measured at = look_up(probe, directions, seams[i].make(directions));
        print_message("%s: %s: %.4f, %.4f\n", name, seams[i].where, at.step, at.error);
        assert_true(at.step <= within.step);
        assert_true(at.error <= within.error);
    }
    free(directions);
    glint_probe_free(probe);
    glint_environment_free(environment);
    glint_scene_free(&scene);
}

static void a_cube_has_no_seams(void **state)
{
    (void)state;
    glint_environment environment;
    choose_lines();
    make_cube(&environment);
    check(&environment, "cube");
}

static void a_lat_long_map_has_none(void **state)
{
    (void)state;
    glint_environment environment;
    choose_lines();
    make_latlong(&environment);
    check(&environment, "lat-long");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cube_has_no_seams),
        cmocka_unit_test(a_lat_long_map_has_none),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
