// Tests cube and lat-long maps in memory: direction, seams, poles, and resampling. The oracle is
// colour that encodes direction (support/direction_maps.h).
#include "environment/environment.h"
#include "environment/latlong.h"
#include "support/direction_maps.h"

#include <math.h>
#include <sched.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

// ---- The cube -----------------------------------------------------------------------------------

static glint_cube direction_cube(int edge)
{
    glint_cube cube;
    assert_int_equal(glint_cube_create(edge, &cube, NULL), GLINT_OK);
    for (int face = 0; face < 6; face++) {
        for (int j = 0; j < edge; j++) {
            for (int i = 0; i < edge; i++) {
                double rgb[3];
                color_of(openexr_cube_direction(face, (i + 0.5) / edge, (j + 0.5) / edge), rgb);
                for (int c = 0; c < 3; c++) {
                    glint_cube_texel(&cube, face, i, j)[c] = (float)rgb[c];
                }
            }
        }
    }
    glint_cube_fill_border(&cube);
    return cube;
}

static void cube_faces_are_openexrs(void **state)
{
    (void)state;
    for (int face = 0; face < 6; face++) {
        for (int k = 0; k < 25; k++) {
            int column = k % 5, row = k / 5;
            double s = column / 2.0 - 1.0, t = row / 2.0 - 1.0;
            glint_vec3 d = glint_cube_direction(face, s, t);
            glint_vec3 wanted = openexr_cube_direction(face, (s + 1.0) / 2.0, (t + 1.0) / 2.0);
            assert_true(d.x == wanted.x && d.y == wanted.y && d.z == wanted.z);
        }
    }
}

static void look_up_at_texel_centres_is_exact(void **state)
{
    (void)state;
    glint_cube cube = direction_cube(8);
    for (int k = 0; k < 6 * 64; k++) {
        int face = k / 64, i = k % 8, j = k / 8 % 8;
        double s = (2 * i + 1) / 8.0 - 1.0, t = (2 * j + 1) / 8.0 - 1.0, rgb[3];
        glint_cube_sample(&cube, glint_cube_direction(face, 3.0 * s, 3.0 * t), rgb);
        glint_vec3 d = glint_cube_direction(face, s, t);
        glint_cube_sample(&cube, (glint_vec3){7.0 * d.x, 7.0 * d.y, 7.0 * d.z}, rgb);
        for (int c = 0; c < 3; c++) {
            // The place is right to some units in the last place of a double.
            assert_true(fabs(rgb[c] - (double)glint_cube_texel(&cube, face, i, j)[c]) < 1e-13);
        }
    }
    glint_cube_free(&cube);
}

static void fill_with_noise(glint_cube *cube)
{
    for (int t = 0; t < 6 * cube->edge * cube->edge; t++) {
        for (int c = 0; c < 3; c++) {
            glint_cube_texel(cube, t / cube->edge / cube->edge, t % cube->edge,
                             t / cube->edge % cube->edge)[c] = (float)(next_random() + 1.0);
        }
    }
    glint_cube_fill_border(cube);
}

// On an edge, both faces must interpolate to the same value, whatever the texels: half of a face's
// outermost texel and half of its border, from either side. At a corner it is the mean of the three
// texels there.
static void both_faces_of_an_edge_go_through_the_same_values(void **state)
{
    (void)state;
    for (int edge = 1; edge <= 9; edge++) {
        glint_cube cube;
        assert_int_equal(glint_cube_create(edge, &cube, NULL), GLINT_OK);
        fill_with_noise(&cube);
        for (int code = 0; code < 8; code++) { // the corners (±1, ±1, ±1)
            const glint_vec3 d = {code & 1 ? 1 : -1, code & 2 ? 1 : -1, code & 4 ? 1 : -1};
            double mean[3] = {0}, found[3];
            for (int axis = 0; axis < 3; axis++) {
                double inside[3] = {d.x, d.y, d.z};
                for (int k = 0; k < 3; k++) {
                    inside[k] *= k == axis ? 1 : 1 - 1.0 / edge;
                }
                double texel[3];
                glint_cube_sample(&cube, (glint_vec3){inside[0], inside[1], inside[2]}, texel);
                for (int c = 0; c < 3; c++) {
                    mean[c] += texel[c] / 3;
                }
            }
            glint_cube_sample(&cube, d, found);
            for (int c = 0; c < 3; c++) {
                assert_true(fabs(found[c] - mean[c]) <= 1e-6); // borders are rounded to float
            }
        }
        glint_cube_free(&cube);
    }
}

// Borders may be negative beside bright texels, but look-ups must not be.
static void no_look_up_leaves_the_range_of_the_texels(void **state)
{
    (void)state;
    glint_cube cube;
    assert_int_equal(glint_cube_create(8, &cube, NULL), GLINT_OK);
    for (int t = 0; t < 6 * 64; t++) {
        for (int c = 0; c < 3; c++) {
            glint_cube_texel(&cube, t / 64, t % 8, t / 8 % 8)[c] = next_random() > 0.8 ? 1000 : 0;
        }
    }
    glint_cube_fill_border(&cube);
    for (int k = 0; k < 100000; k++) {
        double rgb[3], edge = k % 3 == 0 ? 1.0 : next_random();
        glint_cube_sample(&cube, (glint_vec3){edge, next_random(), k % 2 ? 1.0 : -1.0}, rgb);
        for (int c = 0; c < 3; c++) {
            assert_true(rgb[c] >= -1e-3 && rgb[c] <= 1000 + 1e-3); // 1000 times a few roundings
        }
    }
    glint_cube_free(&cube);
}

// Noise is the hardest test of a seam. A step of 10⁻⁹ across an edge or a corner may change the
// value by 10⁻⁹ times the steepest slope (N/2 a texel of contrast 2), plus float rounding at
// corners.
static void look_up_is_continuous_across_edges_and_corners(void **state)
{
    (void)state;
    for (int edge = 1; edge <= 16; edge *= 2) {
        glint_cube cube;
        assert_int_equal(glint_cube_create(edge, &cube, NULL), GLINT_OK);
        fill_with_noise(&cube);
        for (int k = 0; k < 3000; k++) {
            double along = k % 10 == 0 ? 1.0 : next_random();
            double e = 1e-9, sign = k % 2 ? 1.0 : -1.0, other = k / 2 % 2 ? 1.0 : -1.0;
            glint_vec3 a = {sign * (1.0 + e), other, along}, b = {sign * (1.0 - e), other, along};
            if (k % 3 == 1) {
                a = (glint_vec3){along, sign * (1.0 + e), other};
                b = (glint_vec3){along, sign * (1.0 - e), other};
            } else if (k % 3 == 2) {
                a = (glint_vec3){other, along, sign * (1.0 + e)};
                b = (glint_vec3){other, along, sign * (1.0 - e)};
            }
            double at_a[3], at_b[3];
            glint_cube_sample(&cube, a, at_a);
            glint_cube_sample(&cube, b, at_b);
            for (int c = 0; c < 3; c++) {
                assert_true(fabs(at_a[c] - at_b[c]) <= 1e-6);
            }
        }
        glint_cube_free(&cube);
    }
}

static void colour_linear_in_direction_is_kept(void **state)
{
    (void)state;
    for (int edge = 4; edge <= 256; edge *= 2) {
        glint_cube cube = direction_cube(edge);
        double worst = worst_error(&cube);
        assert_true(worst <= seam_bound(edge) + 1e-7);
        // Off the edges only interpolation matters.
        double inner = 0.0;
        for (int k = 0; k < 20000; k++) {
            double s = next_random() * (1.0 - 1.0 / edge), t = next_random() * (1.0 - 1.0 / edge);
            inner = fmax(inner, error_along(&cube, glint_cube_direction(k % 6, s, t)));
        }
        assert_true(inner <= 0.65 / ((double)edge * edge) + 1e-7);
        glint_cube_free(&cube);
    }
}

static void ties_and_odd_directions_have_an_answer(void **state)
{
    (void)state;
    glint_cube cube = direction_cube(4);
    const double odd[] = {0.0, -0.0, 1.0, -1.0, INFINITY, -INFINITY, NAN, 1e-320, 1e300};
    for (int k = 0; k < 9 * 9 * 9; k++) {
        glint_vec3 d = {odd[k % 9], odd[k / 9 % 9], odd[k / 81]};
        double rgb[3];
        glint_cube_sample(&cube, d, rgb); // the sanitizers check for reads outside
    }
    glint_cube_free(&cube);
    assert_int_equal(glint_cube_create(0, &cube, NULL), GLINT_BAD_INPUT);
    assert_int_equal(glint_cube_create(-1, &cube, NULL), GLINT_BAD_INPUT);
    assert_int_equal(glint_cube_create(1 << 30, &cube, NULL), GLINT_BAD_INPUT);
    glint_cube_free(&cube);
}

// ---- Lat-long -----------------------------------------------------------------------------------

static void latlong_look_up_wraps_and_crosses_the_poles(void **state)
{
    (void)state;
    for (int k = 0; k < 8; k++) {
        int height = 4 << (k / 2);
        bool on_edges = k % 2;
        glint_image image = direction_latlong(height, on_edges);
        double worst = 0.0;
        for (int i = 0; i < 20000; i++) {
            glint_vec3 d = random_direction();
            if (i % 4 == 1) { // near a pole
                d = (glint_vec3){d.x * 0.1, d.y < 0.0 ? -1.0 : 1.0, d.z * 0.1};
            } else if (i % 4 == 2) { // near the seam
                d = (glint_vec3){d.x * 1e-3, d.y, -fabs(d.z)};
            } else if (i < 8) {
                d = (glint_vec3){i % 8 < 4 ? 0.0 : -0.0, i % 2 ? 1.0 : -1.0, 0.0};
            }
            double found[3], wanted[3];
            glint_latlong_sample(&image, on_edges, d, found);
            color_of(d, wanted);
            for (int c = 0; c < 3; c++) {
                worst = fmax(worst, fabs(found[c] - wanted[c]));
            }
        }
        assert_true(worst <= latlong_bound(height, on_edges));
        // Both sides of the seam must agree, and all longitudes at a pole.
        double left[3], right[3], pole[3], turned[3];
        glint_latlong_sample(&image, on_edges, (glint_vec3){1e-300, 0.3, -1.0}, left);
        glint_latlong_sample(&image, on_edges, (glint_vec3){-1e-300, 0.3, -1.0}, right);
        glint_latlong_sample(&image, on_edges, (glint_vec3){0.0, 1.0, 0.0}, pole);
        glint_latlong_sample(&image, on_edges, (glint_vec3){1e-17, 1.0, 1e-17}, turned);
        for (int c = 0; c < 3; c++) {
            assert_true(fabs(left[c] - right[c]) < 1e-6);
            assert_true(isfinite(pole[c]));
            assert_true(fabs(pole[c] - turned[c]) <= latlong_bound(height, on_edges));
        }
        glint_image_free(&image);
    }
}

static void latlong_becomes_a_cube_that_agrees_with_it(void **state)
{
    (void)state;
    for (int k = 0; k < 6; k++) {
        int height = k < 2 ? 8 : (k < 4 ? 64 : 300);
        bool on_edges = k % 2;
        glint_image image = direction_latlong(height, on_edges);
        glint_cube cube;
        int edge = glint_latlong_edge(height);
        assert_true(edge >= 256 && edge >= height);
        assert_int_equal(glint_cube_from_latlong(&image, on_edges, edge, &cube, NULL), GLINT_OK);
        // The mean over a texel differs from its middle by another interpolation error.
        double bound =
            latlong_bound(height, on_edges) + seam_bound(edge) + 0.65 / ((double)edge * edge);
        assert_true(worst_error(&cube) <= bound);
        glint_cube_free(&cube);
        glint_image_free(&image);
    }
}

static void latlong_edge_is_kept_between_its_limits(void **state)
{
    (void)state;
    assert_int_equal(glint_latlong_edge(1), 256);
    assert_int_equal(glint_latlong_edge(512), 512);
    assert_int_equal(glint_latlong_edge(1000), 1000);
    assert_int_equal(glint_latlong_edge(20000), 2048);
}

// A fine pattern in a small cube: each texel must be near the mean of its area, not a single
// sample.
static void texels_that_cover_many_pixels_are_means(void **state)
{
    (void)state;
    glint_image image;
    assert_int_equal(glint_image_create(1024, 512, 3, &image, NULL), GLINT_OK);
    for (int p = 0; p < 1024 * 512; p++) {
        float bright = (p % 1024 + p / 1024) % 2 == 0 ? 1.0f : 0.0f;
        for (int c = 0; c < 3; c++) {
            image.pixels[3 * p + c] = bright;
        }
    }
    glint_cube cube;
    assert_int_equal(glint_cube_from_latlong(&image, false, 32, &cube, NULL), GLINT_OK);
    for (int k = 0; k < 6 * 32 * 32; k++) {
        double value = (double)glint_cube_texel(&cube, k / 1024, k % 32, k / 32 % 32)[0];
        assert_true(fabs(value - 0.5) < 0.15);
    }
    glint_cube_free(&cube);
    glint_image_free(&image);
}

// ---- Resampling, by a plain formula -------------------------------------------------------------

// A pixel of the map; beyond a pole it is the mirrored row, half a turn away.
static double plain_pixel(const glint_image *image, double x, int row, int channel)
{
    const int w = image->width, h = image->height;
    if (row < 0 || row >= h) {
        row = row < 0 ? -1 - row : 2 * h - 1 - row;
        x += 0.5 * w;
    }
    double value[2], first = floor(x);
    for (int k = 0; k < 2; k++) {
        const int column = (((int)first + k) % w + w) % w;
        value[k] = (double)image->pixels[(row * w + column) * 3 + channel];
    }
    return value[0] * (1 - (x - first)) + value[1] * (x - first);
}

static double plain_look_up(const glint_image *image, bool on_edges, glint_vec3 d, int channel)
{
    const double pi = 3.14159265358979323846;
    const double u = 0.5 - atan2(d.x, d.z) / (2 * pi);
    const double v = 0.5 - atan2(d.y, hypot(d.x, d.z)) / pi;
    const double x = on_edges ? u * (image->width - 1) : u * image->width - 0.5;
    const double y = on_edges ? v * (image->height - 1) : v * image->height - 0.5;
    const double row = floor(y);
    return plain_pixel(image, x, (int)row, channel) * (1 - (y - row)) +
           plain_pixel(image, x, (int)row + 1, channel) * (y - row);
}

// The side of a texel's footprint in pixels, rounded, from 1 to 16.
static int plain_taps(const glint_image *image, int edge, glint_vec3 d)
{
    const double pi = 3.14159265358979323846, length = sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
    const double size = 2.0 / edge / length, from_axis = hypot(d.x, d.z) / length + size / 4;
    const double down = size * image->height / pi;
    const double across = size * image->width / (2 * pi * from_axis);
    return (int)fmin(fmax(ceil(fmax(down, across) - 0.5), 1), 16);
}

static double plain_texel(const glint_image *image, bool on_edges, int edge, const int at[3],
                          int channel)
{
    const int taps = plain_taps(
        image, edge, openexr_cube_direction(at[0], (at[1] + 0.5) / edge, (at[2] + 0.5) / edge));
    double sum = 0;
    for (int k = 0; k < taps * taps; k++) {
        const int i = k % taps, j = k / taps;
        const double column = (at[1] + (i + 0.5) / taps) / edge;
        const double row = (at[2] + (j + 0.5) / taps) / edge;
        sum += plain_look_up(image, on_edges, openexr_cube_direction(at[0], column, row), channel);
    }
    return sum / (taps * taps);
}

// Pixels are random over eight decades. Each addition and rounding of positive numbers is good to a
// part in 2⁵³, a place in the map to 10⁻¹² pixels. So the float of a texel is the nearest one, or
// its neighbour: 2⁻²³ = 1.2e-7.
static void texels_are_those_of_a_plain_formula(void **state)
{
    (void)state;
    static const struct {
        int width, height, edge;
        bool on_edges;
    } maps[] = {{128, 64, 64, false}, {128, 64, 64, true},   {131, 47, 33, false},
                {257, 129, 21, true}, {600, 300, 30, false}, {3, 2, 8, false},
                {1, 1, 5, false}};
    for (size_t m = 0; m < sizeof maps / sizeof maps[0]; m++) {
        glint_image image;
        glint_cube cube;
        const int edge = maps[m].edge;
        const bool on_edges = maps[m].on_edges;
        assert_int_equal(glint_image_create(maps[m].width, maps[m].height, 3, &image, NULL),
                         GLINT_OK);
        for (int k = 0; k < 3 * image.width * image.height; k++) {
            image.pixels[k] = (float)pow(10, 4 * next_random());
        }
        assert_int_equal(glint_cube_from_latlong(&image, on_edges, edge, &cube, NULL), GLINT_OK);
        double worst = 0;
        for (int k = 0; k < 6 * edge * edge; k++) {
            const int at[3] = {k / edge / edge, k % edge, k / edge % edge};
            const float *texel = glint_cube_texel(&cube, at[0], at[1], at[2]);
            for (int c = 0; c < 3; c++) {
                const double wanted = plain_texel(&image, on_edges, edge, at, c);
                worst = fmax(worst, fabs((double)texel[c] - wanted) / wanted);
            }
            assert_true(texel[3] == 1.0f);
        }
        print_message("%d x %d to %d: worst relative error %.2g\n", image.width, image.height, edge,
                      worst);
        assert_true(worst <= 0x1p-23);
        glint_cube_free(&cube);
        glint_image_free(&image);
    }
}

static void threads_do_not_change_the_bits(void **state)
{
    (void)state;
    glint_image image = direction_latlong(100, false);
    glint_cube many, one;
    cpu_set_t before, single;
    assert_int_equal(glint_cube_from_latlong(&image, false, 64, &many, NULL), GLINT_OK);
    assert_int_equal(sched_getaffinity(0, sizeof before, &before), 0);
    CPU_ZERO(&single);
    for (size_t cpu = 0; cpu < CPU_SETSIZE; cpu++) {
        if (CPU_ISSET(cpu, &before)) {
            CPU_SET(cpu, &single);
            break;
        }
    }
    assert_int_equal(sched_setaffinity(0, sizeof single, &single), 0);
    assert_int_equal(glint_cube_from_latlong(&image, false, 64, &one, NULL), GLINT_OK);
    sched_setaffinity(0, sizeof before, &before);
    assert_memory_equal(many.texels, one.texels, glint_cube_size(&one) * sizeof(float));
    glint_cube_free(&many);
    glint_cube_free(&one);
    glint_image_free(&image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cube_faces_are_openexrs),
        cmocka_unit_test(look_up_at_texel_centres_is_exact),
        cmocka_unit_test(both_faces_of_an_edge_go_through_the_same_values),
        cmocka_unit_test(no_look_up_leaves_the_range_of_the_texels),
        cmocka_unit_test(look_up_is_continuous_across_edges_and_corners),
        cmocka_unit_test(colour_linear_in_direction_is_kept),
        cmocka_unit_test(ties_and_odd_directions_have_an_answer),
        cmocka_unit_test(latlong_look_up_wraps_and_crosses_the_poles),
        cmocka_unit_test(latlong_becomes_a_cube_that_agrees_with_it),
        cmocka_unit_test(latlong_edge_is_kept_between_its_limits),
        cmocka_unit_test(texels_that_cover_many_pixels_are_means),
        cmocka_unit_test(texels_are_those_of_a_plain_formula),
        cmocka_unit_test(threads_do_not_change_the_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
