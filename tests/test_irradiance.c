// Tests irradiance against closed forms and against sums over finely divided texels.
#include "environment/irradiance.h"

#include "environment/harmonics.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

// Error bound that irradiance.c documents for blocks on the horizon, in a uniform environment of
// radiance 1 with blocks at most 2/128 wide; and the rounding of the result to float.
#define BLOCK (2.0 / 128)
#define HORIZON 4e-6
#define ROUNDING 1.2e-7

static glint_vec3 unit(double x, double y, double z)
{
    double length = sqrt(x * x + y * y + z * z);
    return (glint_vec3){x / length, y / length, z / length};
}

static glint_vec3 texel_direction(int edge, int face, double i, double j)
{
    glint_vec3 d =
        glint_cube_direction(face, (2.0 * i + 1.0) / edge - 1.0, (2.0 * j + 1.0) / edge - 1.0);
    return unit(d.x, d.y, d.z);
}

typedef void (*radiance_function)(glint_vec3 d, double rgb[3]);

static glint_cube make_cube(int edge, radiance_function radiance)
{
    glint_cube cube;
    assert_int_equal(glint_cube_create(edge, &cube, NULL), GLINT_OK);
    for (int k = 0; k < 6 * edge * edge; k++) {
        int face = k / edge / edge, i = k % edge, j = k / edge % edge;
        double rgb[3];
        radiance(texel_direction(edge, face, i, j), rgb);
        for (int c = 0; c < 3; c++) {
            glint_cube_texel(&cube, face, i, j)[c] = (float)rgb[c];
        }
    }
    glint_cube_fill_border(&cube);
    return cube;
}

static glint_cube irradiance_of(const glint_cube *radiance, int edge)
{
    glint_cube map;
    assert_int_equal(glint_irradiance_map(radiance, edge, &map, NULL), GLINT_OK);
    assert_int_equal(map.edge, edge);
    return map;
}

static void uniform(glint_vec3 d, double rgb[3])
{
    (void)d;
    rgb[0] = 1.0;
    rgb[1] = 0.25;
    rgb[2] = 7.0;
}

// Tests a furnace: every texel and the border, for edges that are powers of two or not, below, at
// and above the number of blocks. Horizons cross blocks anywhere. irradiance.c assumes that n·ω
// spreads as far as over an even block. The errors of single blocks cancel except for a fiftieth.
static void uniform_radiance_gives_itself(void **state)
{
    (void)state;
    const int edges[] = {1, 2, 3, 7, 64, 100, 128, 129, 200, 257, 384};
    for (size_t k = 0; k < sizeof edges / sizeof edges[0]; k++) {
        glint_cube radiance = make_cube(edges[k], uniform);
        glint_cube map = irradiance_of(&radiance, 9);
        double sum = 0.0;
        for (size_t i = 0; i < glint_cube_size(&map); i += 4) {
            const double wanted[3] = {1.0, 0.25, 7.0};
            for (int c = 0; c < 3; c++) {
                double relative = (double)map.texels[i + (size_t)c] / wanted[c] - 1.0;
                assert_true(fabs(relative) <= HORIZON + ROUNDING);
                sum += relative;
            }
        }
        assert_true(fabs(sum / (3.0 / 4.0 * (double)glint_cube_size(&map))) <= HORIZON / 50);
        glint_cube_free(&map);
        glint_cube_free(&radiance);
    }
}

static void linear(glint_vec3 d, double rgb[3])
{
    rgb[0] = 1.0 + d.x;
    rgb[1] = 1.0 + d.y;
    rgb[2] = 1.0 + d.z;
}

// ∫ (1 + d·a) max(0, n·d) dω = π + (2π/3) a·n: the first band of Ramamoorthi and Hanrahan 2001. The
// middle of a texel differs from its mean by up to (2/N)²/24 · abs(Laplacian) ≤ 1.4 · 4/(24 N²).
static void linear_radiance_gives_two_thirds(void **state)
{
    (void)state;
    glint_cube radiance = make_cube(96, linear);
    glint_cube map = irradiance_of(&radiance, 16);
    for (int k = 0; k < 6 * 18 * 18; k++) {
        int face = k / 18 / 18, i = k % 18 - 1, j = k / 18 % 18 - 1;
        glint_vec3 n = texel_direction(16, face, i, j);
        const double wanted[3] = {1.0 + 2.0 / 3.0 * n.x, 1.0 + 2.0 / 3.0 * n.y,
                                  1.0 + 2.0 / 3.0 * n.z};
        for (int c = 0; c < 3; c++) {
            double error = (double)glint_cube_texel(&map, face, i, j)[c] - wanted[c];
            assert_true(fabs(error) <= 2 * HORIZON + 0.24 / (96.0 * 96.0) + 2 * ROUNDING);
        }
    }
    glint_cube_free(&map);
    glint_cube_free(&radiance);
}

static const glint_vec3 lobe_axis = {0.48, 0.64, 0.6};

static void clamped_cosine(glint_vec3 d, double rgb[3])
{
    double cosine = d.x * lobe_axis.x + d.y * lobe_axis.y + d.z * lobe_axis.z;
    rgb[0] = rgb[1] = rgb[2] = cosine > 0.0 ? cosine : 0.0;
}

// ∫ max(0, d·a) max(0, d·n) dω = (2/3)(sin θ + (π − θ) cos θ), θ the angle between a and n (the
// autocorrelation of the clamped cosine).
static void clamped_cosine_gives_its_autocorrelation(void **state)
{
    (void)state;
    glint_cube radiance = make_cube(256, clamped_cosine);
    glint_cube map = irradiance_of(&radiance, 16);
    for (int k = 0; k < 6 * 256; k++) {
        glint_vec3 n = texel_direction(16, k / 256, k % 16, k / 16 % 16);
        double cosine = n.x * lobe_axis.x + n.y * lobe_axis.y + n.z * lobe_axis.z;
        double angle = acos(fmax(-1.0, fmin(1.0, cosine)));
        double wanted = 2.0 / 3.0 * (sin(angle) + (GLINT_PI - angle) * cosine) / GLINT_PI;
        double found = (double)glint_cube_texel(&map, k / 256, k % 16, k / 16 % 16)[0];
        // The kink along the great circle adds the square of a texel's width, times the slope
        // there.
        assert_true(fabs(found - wanted) <= HORIZON + 1.0 / (256.0 * 256.0) + ROUNDING);
    }
    glint_cube_free(&map);
    glint_cube_free(&radiance);
}

// The solid angle of [s0, s1] × [t0, t1] in the plane at distance 1.
static double solid_angle(double s0, double s1, double t0, double t1)
{
    const double s[2] = {s0, s1}, t[2] = {t0, t1};
    double sum = 0.0;
    for (int k = 0; k < 4; k++) {
        double a = s[k % 2], b = t[k / 2];
        sum += ((k % 2) == (k / 2) ? 1.0 : -1.0) * atan2(a * b, sqrt(1.0 + a * a + b * b));
    }
    return sum;
}

// ∫ ω dω over the quadrilateral of a texel. It is half the sum over the sides of the side's arc
// times the unit normal of the arc's plane (Lambert, Photometria, 1760).
static glint_vec3 first_moment(int edge, int face, int i, int j)
{
    static const int at[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
    glint_vec3 sum = {0, 0, 0};
    for (int k = 0; k < 4; k++) {
        const glint_vec3 a = texel_direction(edge, face, i + at[k][0] - 0.5, j + at[k][1] - 0.5);
        const glint_vec3 b =
            texel_direction(edge, face, i + at[k + 1][0] - 0.5, j + at[k + 1][1] - 0.5);
        const glint_vec3 normal = glint_vec3_cross(a, b);
        const double sine = glint_vec3_length(normal), angle = asin(sine);
        sum = glint_vec3_add(sum, glint_vec3_scale(normal, 0.5 * angle / sine));
    }
    const bool inwards = glint_vec3_dot(sum, texel_direction(edge, face, i, j)) > 0;
    return glint_vec3_scale(sum, inwards ? 1 : -1);
}

// One bright texel, like the sun, gives n · its first moment. On the horizon the error is at most
// an eighth of a block's width, relative to the texel's largest contribution. Texels are smaller
// than blocks, equal, and larger.
static void one_bright_texel_gives_its_first_moment(void **state)
{
    (void)state;
    static const struct {
        int edge, face, i, j;
    } suns[] = {{512, 4, 77, 410}, {300, 1, 299, 2}, {128, 2, 60, 127}, {60, 5, 29, 3}};
    for (size_t k = 0; k < sizeof suns / sizeof *suns; k++) {
        const int edge = suns[k].edge;
        glint_cube radiance;
        assert_int_equal(glint_cube_create(edge, &radiance, NULL), GLINT_OK);
        glint_cube_texel(&radiance, suns[k].face, suns[k].i, suns[k].j)[0] = 1e6f;
        glint_cube map = irradiance_of(&radiance, 32);
        const glint_vec3 moment = first_moment(edge, suns[k].face, suns[k].i, suns[k].j);
        const double flux = 1e6 / GLINT_PI * glint_vec3_length(moment), h = 2.0 / edge;
        for (int p = 0; p < 6 * 34 * 34; p++) {
            const int face = p / 34 / 34, i = p % 34 - 1, j = p / 34 % 34 - 1;
            const glint_vec3 n = texel_direction(32, face, i, j);
            const float *found = glint_cube_texel(&map, face, i, j);
            const double wanted = 1e6 / GLINT_PI * fmax(0.0, glint_vec3_dot(n, moment));
            const bool on_horizon =
                fabs(glint_vec3_dot(n, moment)) < (2.0 * BLOCK + h) * glint_vec3_length(moment);
            // Off the horizon: cells are right to 7e-9; opposite normals cancel.
            const double bound = on_horizon ? flux * fmax(BLOCK, h) / 8
                                            : 7e-9 * wanted + ROUNDING * wanted / 2 + 1e-13 * flux;
            assert_true(fabs((double)found[0] - wanted) <= bound);
            assert_true(found[0] >= 0.0f && found[1] == 0.0f);
        }
        glint_cube_free(&map);
        glint_cube_free(&radiance);
    }
}

static void noise(glint_vec3 d, double rgb[3])
{
    static uint32_t seed = 1;
    (void)d;
    for (int c = 0; c < 3; c++) {
        seed = seed * 1664525u + 1013904223u;
        // Mostly dim, rarely bright.
        rgb[c] = seed >> 28 == 0 ? 10.0 : (double)(seed >> 8) / 16777216.0;
    }
}

// Sums over all texels, each divided into k × k parts with their exact solid angles.
static void brute_force(const glint_cube *radiance, glint_vec3 n, int k, double rgb[3])
{
    int edge = radiance->edge, fine = edge * k;
    rgb[0] = rgb[1] = rgb[2] = 0.0;
    for (int p = 0; p < 6 * fine * fine; p++) {
        int face = p / fine / fine, i = p % fine, j = p / fine % fine;
        glint_vec3 d = texel_direction(fine, face, i, j);
        double cosine = n.x * d.x + n.y * d.y + n.z * d.z;
        if (cosine <= 0.0) {
            continue;
        }
        double s = 2.0 * i / fine - 1.0, t = 2.0 * j / fine - 1.0;
        double weight = cosine * solid_angle(s, s + 2.0 / fine, t, t + 2.0 / fine) / GLINT_PI;
        const float *texel = glint_cube_texel(radiance, face, i / k, j / k);
        for (int c = 0; c < 3; c++) {
            rgb[c] += weight * (double)texel[c];
        }
    }
}

static void noise_agrees_with_brute_force(void **state)
{
    (void)state;
    const int edges[] = {5, 32, 150};
    for (int k = 0; k < 3; k++) {
        glint_cube radiance = make_cube(edges[k], noise);
        glint_cube map = irradiance_of(&radiance, 3);
        for (int p = 0; p < 54; p += 5) {
            glint_vec3 n = texel_direction(3, p / 9, p % 3, p / 3 % 3);
            double wanted[3];
            int parts = 600 / edges[k];
            brute_force(&radiance, n, parts, wanted);
            for (int c = 0; c < 3; c++) {
                double found = (double)glint_cube_texel(&map, p / 9, p % 3, p / 3 % 3)[c];
                // Blocks on the horizon hold values between 0 and 10. Each errs at random by up to
                // 10 h³/16, and 500 of them by √500 times this. The brute-force sum errs by
                // (2/600)²/8 of the radiance along the horizon.
                double random = 10.0 * BLOCK * BLOCK * BLOCK / 16 * sqrt(500.0) / GLINT_PI;
                assert_true(fabs(found - wanted[c]) <= random + 1e-5);
            }
        }
        glint_cube_free(&map);
        glint_cube_free(&radiance);
    }
}

// A bilinear look-up in the map must be continuous across edges, because both borders hold true
// values.
static void look_up_is_smooth_across_the_cubes_edges(void **state)
{
    (void)state;
    glint_cube radiance = make_cube(128, clamped_cosine);
    glint_cube map = irradiance_of(&radiance, 64);
    double worst = 0.0;
    for (int k = 0; k < 30000; k++) {
        double t = 2.0 * (k % 1000) / 999.0 - 1.0, e = 1e-9;
        double one = k / 1000 % 2 ? 1.0 : -1.0, two = k / 2000 % 2 ? 1.0 : -1.0;
        int axis = k / 4000 % 3;
        const double a[3] = {one * (1.0 + e), two, t}, b[3] = {one * (1.0 - e), two, t};
        double left[3], right[3];
        glint_cube_sample(&map, (glint_vec3){a[axis], a[(axis + 1) % 3], a[(axis + 2) % 3]}, left);
        glint_cube_sample(&map, (glint_vec3){b[axis], b[(axis + 1) % 3], b[(axis + 2) % 3]}, right);
        worst = fmax(worst, fabs(left[0] - right[0]));
    }
    // Two interpolations, each within 1.3 (2/64)²/8 · 2 of a function with slope and curvature < 1.
    assert_true(worst <= 4.0 * 1.3 * (2.0 / 64) * (2.0 / 64) / 8);
    glint_cube_free(&map);
    glint_cube_free(&radiance);
}

// ---- Harmonics ----------------------------------------------------------------------------------

// E(n)/π by the polynomial of layout.h.
static double by_harmonics(const float coefficients[GLINT_HARMONICS][4], glint_vec3 n, int channel)
{
    const double terms[GLINT_HARMONICS] = {1,
                                           n.x,
                                           n.y,
                                           n.z,
                                           n.x * n.y,
                                           n.y * n.z,
                                           n.z * n.x,
                                           n.x * n.x - n.y * n.y,
                                           3 * n.z * n.z - 1};
    double sum = 0;
    for (int k = 0; k < GLINT_HARMONICS; k++) {
        sum += (double)coefficients[k][channel] * terms[k];
    }
    return sum;
}

// Three radiances of bands 0 to 2, one with all bands. E/π has the bands times 1, 2/3 and 1/4.
static void three_bands(glint_vec3 d, double rgb[3])
{
    rgb[0] = 3 + 0.5 * d.x - 0.25 * d.y + d.z;
    rgb[1] = 2 + d.x * d.y - 0.5 * d.y * d.z + 0.3 * d.z * d.x;
    rgb[2] = 4 + 0.5 * (d.x * d.x - d.y * d.y) + 0.4 * (3 * d.z * d.z - 1) + 0.1 * d.x;
}

static void three_bands_received(glint_vec3 n, double rgb[3])
{
    rgb[0] = 3 + 2.0 / 3 * (0.5 * n.x - 0.25 * n.y + n.z);
    rgb[1] = 2 + 0.25 * (n.x * n.y - 0.5 * n.y * n.z + 0.3 * n.z * n.x);
    rgb[2] = 4 + 0.25 * (0.5 * (n.x * n.x - n.y * n.y) + 0.4 * (3 * n.z * n.z - 1)) +
             2.0 / 3 * 0.1 * n.x;
}

// Irradiance ignores band 3: a radiance of this band beside another changes nothing.
static void band_three(glint_vec3 d, double rgb[3])
{
    rgb[0] = 2 + d.x * d.y * d.z;
    rgb[1] = 2 + d.x * (5 * d.z * d.z - 1);
    rgb[2] = 2 + d.y * (3 * d.x * d.x - d.y * d.y);
}

// The texels hold the radiance at their centres, and the integral takes each as constant. This errs
// by h²/24 of the second derivatives, which are under 8 here, with h = 2/edge.
static void harmonics_of_low_bands_are_exact(void **state)
{
    (void)state;
    float coefficients[GLINT_HARMONICS][4];
    for (int i = 0; i < 4; i++) {
        const int edge = i < 2 ? 96 : 256; // four points a texel, and one point
        const double bound = 4.0 / edge / edge / 24 * 8 * (edge == 96 ? 1 : 2) + 8 * ROUNDING;
        glint_cube cube = make_cube(edge, i % 2 == 0 ? three_bands : band_three);
        assert_int_equal(glint_irradiance_harmonics(&cube, coefficients, NULL), GLINT_OK);
        for (int k = 0; k < 500; k++) {
            const glint_vec3 n =
                unit(cos(k * 2.4) * sqrt(1 - (k / 250.0 - 1) * (k / 250.0 - 1)),
                     sin(k * 2.4) * sqrt(1 - (k / 250.0 - 1) * (k / 250.0 - 1)), k / 250.0 - 1);
            double wanted[3] = {2, 2, 2};
            if (i % 2 == 0) {
                three_bands_received(n, wanted);
            }
            for (int c = 0; c < 3; c++) {
                assert_true(fabs(by_harmonics(coefficients, n, c) - wanted[c]) <= bound);
            }
        }
        glint_cube_free(&cube);
    }
}

// One bright texel is the worst case. Its irradiance is a clamped cosine, whose ∫cos² over the half
// sphere is 2π/3. The bands 0 to 2 hold π/4·(1 + 4/3 + 5/16) of it.
static void harmonics_of_a_point_leave_out_what_they_must(void **state)
{
    (void)state;
    enum { EDGE = 256, MAP = 48 };
    glint_cube cube;
    float coefficients[GLINT_HARMONICS][4];
    assert_int_equal(glint_cube_create(EDGE, &cube, NULL), GLINT_OK);
    const double bright[3] = {1e6, 1e6, 1e6};
    glint_cube_store(&cube, 2, 100, 170, bright);
    glint_cube_fill_border(&cube);
    assert_int_equal(glint_irradiance_harmonics(&cube, coefficients, NULL), GLINT_OK);
    glint_cube map = irradiance_of(&cube, MAP);
    double off = 0, all = 0;
    for (int k = 0; k < 6 * MAP * MAP; k++) {
        const int face = k / MAP / MAP, i = k % MAP, j = k / MAP % MAP;
        const double s = (2.0 * i + 1) / MAP - 1, t = (2.0 * j + 1) / MAP - 1;
        const double weight = pow(1 + s * s + t * t, -1.5); // its solid angle
        const double exact = (double)glint_cube_texel(&map, face, i, j)[0];
        const double d = by_harmonics(coefficients, texel_direction(MAP, face, i, j), 0) - exact;
        off += weight * d * d;
        all += weight * exact * exact;
    }
    const double left_out = sqrt(off / all);
    print_message("of a point's irradiance %.4f is left out\n", left_out);
    assert_true(fabs(left_out - sqrt(1 - 3.0 / 8 * (1 + 4.0 / 3 + 5.0 / 16))) < 2e-3);
    glint_cube_free(&map);
    glint_cube_free(&cube);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(uniform_radiance_gives_itself),
        cmocka_unit_test(linear_radiance_gives_two_thirds),
        cmocka_unit_test(clamped_cosine_gives_its_autocorrelation),
        cmocka_unit_test(one_bright_texel_gives_its_first_moment),
        cmocka_unit_test(noise_agrees_with_brute_force),
        cmocka_unit_test(look_up_is_smooth_across_the_cubes_edges),
        cmocka_unit_test(harmonics_of_low_bands_are_exact),
        cmocka_unit_test(harmonics_of_a_point_leave_out_what_they_must),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
