// Tests the error estimate for flipped edges in glass. A sparse grid estimates the error of a frame
// where single precision shows the other side of an edge. The test compares it with the difference
// of frames in double precision, with cameras rotated by the error of single precision.
#include "bound/error_grid.h"
#include "support/render.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#define VIEWS 6
#define DIRECTIONS 4
#define OFF (2 * 0x1p-23) // two units in the last place of single precision, as an angle
#define FAR 16
#define MENDED 0.25

static glint_vec3 turned(glint_vec3 axis, glint_vec3 towards, double angle)
{
    return glint_vec3_add(glint_vec3_scale(axis, cos(angle)),
                          glint_vec3_scale(towards, sin(angle)));
}

// Rotates the camera to the right and up by these small angles.
static glint_camera look_beside(const glint_camera *camera, double right, double up)
{
    glint_camera c = *camera;
    c.back = turned(camera->back, camera->right, -right);
    c.right = turned(camera->right, camera->back, right);
    const glint_vec3 back = c.back;
    c.back = turned(back, c.up, -up);
    c.up = turned(c.up, back, up);
    return c;
}

static double square_difference(const glint_image *a, size_t of_a, const glint_image *b,
                                size_t of_b)
{
    double sum = 0;
    for (size_t c = 0; c < 3; c++) {
        const double d = (double)a->pixels[4 * of_a + c] - (double)b->pixels[4 * of_b + c];
        sum += d * d / 3;
    }
    return sum;
}

// Tells if a pixel differs from one of its four neighbours by more than this.
static bool is_beside_jump(const glint_image *image, size_t pixel, double square)
{
    const size_t width = (size_t)image->width, x = pixel % width, y = pixel / width;
    return (x > 0 && square_difference(image, pixel, image, pixel - 1) > square) ||
           (x + 1 < width && square_difference(image, pixel, image, pixel + 1) > square) ||
           (y > 0 && square_difference(image, pixel, image, pixel - width) > square) ||
           (y + 1 < (size_t)image->height &&
            square_difference(image, pixel, image, pixel + width) > square);
}

// Relative RMSE of `a`. `mended` takes the pixels of b beside jumps of more than `mend` times the
// mean.
typedef struct difference {
    double all, mended;
} difference;

static difference find_difference(const glint_image *a, const glint_image *b, double mend)
{
    const size_t count = (size_t)a->width * (size_t)a->height;
    double mean = 0, sum = 0, mended = 0;
    for (size_t i = 0; i < 4 * count; i++) {
        mean += i % 4 < 3 ? (double)b->pixels[i] / (double)(3 * count) : 0;
    }
    for (size_t i = 0; i < count; i++) {
        const double square = square_difference(a, i, b, i);
        sum += square;
        mended += is_beside_jump(a, i, mend * mend * mean * mean) ? 0 : square;
    }
    return (difference){sqrt(sum / (double)count) / mean, sqrt(mended / (double)count) / mean};
}

typedef struct tally {
    int frames, beyond;         // rotated by OFF
    int far_frames, far_beyond; // rotated by FAR times OFF
    int mended, mended_beyond;  // rotated by OFF, mended
} tally;

// Estimates the error, with enough mending to leave at most MENDED times the error.
static glint_edge_errors find_edges(test_stage *s, const glint_camera *camera)
{
    glint_error_grid grid = {.renderer = s->renderer, .camera = camera};
    glint_edge_errors found = {0}, mended;
    grid.step = glint_error_grid_step(s->settings.width, s->settings.height);
    assert_true(grid.step > 1);
    assert_int_equal(glint_error_grid_set_reference(&grid, &s->settings, NULL), GLINT_OK);
    glint_error_edges edges = {&grid.reference, &s->settings, 1e9};
    assert_int_equal(glint_error_grid_find_edges(&grid, &edges, &found, NULL), GLINT_OK);
    assert_int_equal(grid.pictures, 3);
    edges.allowed = MENDED * found.at_most;
    assert_int_equal(glint_error_grid_find_edges(&grid, &edges, &mended, NULL), GLINT_OK);
    assert_true(mended.at_most == found.at_most);
    assert_true(mended.mend == 0 || mended.mended <= edges.allowed);
    glint_error_grid_free(&grid);
    assert_int_equal(glint_renderer_set_settings(s->renderer, &s->settings, NULL), GLINT_OK);
    return mended;
}

static void render(test_stage *s, const glint_camera *camera, glint_image *image)
{
    assert_int_equal(
        glint_renderer_frame(&(glint_frame_request){s->renderer, camera, NULL, image, NULL}, NULL),
        GLINT_OK);
}

static difference differ(test_stage *s, const glint_camera *camera, const glint_image *image,
                         const double by[2], double mend)
{
    const glint_camera other = look_beside(camera, by[0], by[1]);
    glint_image beside = {0};
    render(s, &other, &beside);
    const difference result = find_difference(&beside, image, mend);
    glint_image_free(&beside);
    return result;
}

static void count_view(test_stage *s, const glint_camera *camera, tally *t)
{
    const glint_edge_errors found = find_edges(s, camera);
    glint_image image = {0};
    render(s, camera, &image);
    for (int i = 0; i < DIRECTIONS; i++) {
        const double angle = 2 * GLINT_PI * (i + 0.3) / DIRECTIONS;
        const double by[2] = {OFF * cos(angle), OFF * sin(angle)};
        const difference near = differ(s, camera, &image, by, found.mend);
        t->frames++;
        t->beyond += near.all > found.at_most;
        t->mended += found.mend > 0;
        t->mended_beyond += found.mend > 0 && near.mended > found.mended;
        if (i % 2 == 1) {
            const double by_more[2] = {FAR * by[0], FAR * by[1]};
            const difference far = differ(s, camera, &image, by_more, found.mend);
            t->far_frames++;
            t->far_beyond += far.all > found.at_most;
        }
    }
    glint_image_free(&image);
}

static void count_scene(const char *scene, int samples_per_axis, tally *t)
{
    glint_settings settings = glint_settings_default;
    settings.width = 480;
    settings.height = 270;
    settings.min_weight = 0.03;
    settings.precision = GLINT_PRECISION_DOUBLE;
    settings.samples_per_axis = samples_per_axis;
    test_stage s;
    test_stage_open(scene, &settings, &s);
    const glint_vec3 middle = glint_vec3_scale(glint_vec3_add(s.scene.low, s.scene.high), 0.5);
    for (int view = 0; view < VIEWS; view++) {
        const glint_camera camera = glint_camera_orbit(&s.camera, middle, view, VIEWS);
        count_view(&s, &camera, t);
    }
    test_stage_close(&s);
}

// The bounds have a confidence of about 95%. They must not be met by being far too large.
static void check_tally(const tally *t)
{
    if (t->beyond > 0.05 * t->frames || t->far_beyond < 0.2 * t->far_frames) {
        fail_msg("%d of %d frames err by more than was found, and %d of %d that are off by more",
                 t->beyond, t->frames, t->far_beyond, t->far_frames);
    }
    if (t->mended_beyond > 0.05 * t->mended || t->mended < t->frames / 2) {
        fail_msg("%d of %d mended frames err by more than was found", t->mended_beyond, t->mended);
    }
}

static void frames_err_by_no_more(void **state)
{
    (void)state;
    static const char *const scenes[] = {"prism", "absorption_box", "glass_slab", "thin_wall",
                                         "water"};
    tally t = {0};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        count_scene(scenes[i], 1, &t);
        count_scene(scenes[i], 2, &t);
    }
    check_tally(&t);
}

// With parallel rays, single precision errs by a share of the picture's extent.
static void parallel_rays_have_edges_too(void **state)
{
    (void)state;
    glint_settings settings = glint_settings_default;
    settings.width = 480;
    settings.height = 270;
    settings.precision = GLINT_PRECISION_DOUBLE;
    test_stage s;
    test_stage_open("prism", &settings, &s);
    const double near = find_edges(&s, &s.camera).at_most;
    // The same view, near the middle, from so far away that the rays are parallel.
    glint_camera camera = s.camera;
    const glint_vec3 middle = glint_vec3_scale(glint_vec3_add(s.scene.low, s.scene.high), 0.5);
    camera.orthographic = true;
    camera.ymag = tan(camera.yfov / 2) * glint_vec3_length(glint_vec3_subtract(middle, camera.eye));
    const double far = find_edges(&s, &camera).at_most;
    assert_true(far > 0 && far < 10 * near && near < 10 * far);
    test_stage_close(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_err_by_no_more),
        cmocka_unit_test(parallel_rays_have_edges_too),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
