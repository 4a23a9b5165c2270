// Tests charts and resampling. Every pair of layouts must face the same way, look-ups and means
// must be as exact as their pixels allow, and turns, mirrors and rims must be right.
//
// The oracle is colour that encodes direction, drawn by the layouts' own definitions: the tables of
// OpenGL and OpenEXR, and the reflection in a ball, computed ray by ray.
#include "environment/chart.h"
#include "environment/layouts.h"
#include "environment/sampler.h"
#include "support/direction_maps.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { EDGE = 48 }; // edge of a face; other maps have at least as many pixels for a quarter turn

// ---- The oracle ---------------------------------------------------------------------------------

typedef struct variant {
    const char *name;
    glint_layout layout;
    bool on_edges;
    double distance; // distance of a ball's viewer
} variant;

static const variant variants[] = {
    {"cube", GLINT_LAYOUT_CUBE, false, INFINITY},
    {"cube on edges", GLINT_LAYOUT_CUBE, true, INFINITY},
    {"faces", GLINT_LAYOUT_FACES, false, INFINITY},
    {"hcross", GLINT_LAYOUT_HCROSS, false, INFINITY},
    {"vcross", GLINT_LAYOUT_VCROSS, false, INFINITY},
    {"vstrip", GLINT_LAYOUT_VSTRIP, false, INFINITY},
    {"hstrip", GLINT_LAYOUT_HSTRIP, false, INFINITY},
    {"latlong", GLINT_LAYOUT_LATLONG, false, INFINITY},
    {"latlong on edges", GLINT_LAYOUT_LATLONG, true, INFINITY},
    {"ball", GLINT_LAYOUT_BALL, false, INFINITY},
    {"ball from 3 radii", GLINT_LAYOUT_BALL, false, 3},
    {"angular", GLINT_LAYOUT_ANGULAR, false, INFINITY},
};
enum { VARIANTS = sizeof variants / sizeof *variants };

// The places of the six named faces, a letter for each: + and − of x, y, z are "XxYyZz".
static const char *picture_of(glint_layout layout)
{
    switch (layout) {
    case GLINT_LAYOUT_HCROSS:
        return " Y  /xZXz/ y  ";
    case GLINT_LAYOUT_VCROSS: // the last face is upside down
        return " Y /xZX/ y / z ";
    case GLINT_LAYOUT_HSTRIP:
        return "XxYyZz";
    default:
        return "X/x/Y/y/Z/z";
    }
}

static bool named_direction(const variant *v, const glint_chart_place *place, glint_vec3 *d)
{
    static const char letters[] = "XxYyZz";
    const char *row = picture_of(v->layout);
    for (int skip = place->j / EDGE; skip > 0; skip--) {
        row = strchr(row, '/') + 1;
    }
    const char *at = strchr(letters, row[place->i / EDGE]);
    if (at == NULL) {
        return false;
    }
    double s = (place->i % EDGE + 0.5 + place->dx) / EDGE;
    double t = (place->j % EDGE + 0.5 + place->dy) / EDGE;
    if (v->layout == GLINT_LAYOUT_VCROSS && *at == 'z') {
        s = 1 - s;
        t = 1 - t;
    }
    const glint_vec3 r = opengl_direction((int)(at - letters), s, t);
    *d = (glint_vec3){r.x, r.y, -r.z};
    return true;
}

// Computes r = 2(n·v)n − v where the ray through (x, y) of the disc first meets the ball.
static bool ball_direction(double distance, double x, double y, glint_vec3 *d)
{
    if (x * x + y * y > 1) {
        return false;
    }
    glint_vec3 n, to_viewer = {0, 0, 1};
    if (isinf(distance)) {
        n = (glint_vec3){x, y, sqrt(1 - x * x - y * y)};
    } else {
        // Long double, because k is the small difference of two distances. `tangent` is of the rim.
        const long double far = distance, tangent = 1 / sqrtl(far * far - 1);
        const long double right = x * tangent, up = y * tangent;
        const long double length = sqrtl(1 + right * right + up * up);
        const long double sine = far * sqrtl(right * right + up * up) / length;
        const long double k = far / length - sqrtl(fmaxl(1 - sine * sine, 0));
        n = (glint_vec3){(double)(k * right / length), (double)(k * up / length),
                         (double)(far - k / length)};
        to_viewer =
            (glint_vec3){(double)(-right / length), (double)(-up / length), (double)(1 / length)};
    }
    const double cosine = glint_vec3_dot(n, to_viewer);
    *d = glint_vec3_subtract(glint_vec3_scale(n, 2 * cosine), to_viewer);
    return true;
}

static bool oracle_direction(const variant *v, const glint_chart *chart,
                             const glint_chart_place *place, glint_vec3 *d)
{
    const double width = chart->width, height = chart->height;
    const double x = place->i + 0.5 + place->dx, y = place->j + 0.5 + place->dy;
    if (v->layout == GLINT_LAYOUT_CUBE) {
        const double inside = place->j % EDGE + 0.5 + place->dy, last = EDGE - 1;
        *d = v->on_edges
                 ? openexr_cube_direction(place->j / EDGE, (x - 0.5) / last, (inside - 0.5) / last)
                 : openexr_cube_direction(place->j / EDGE, x / EDGE, inside / EDGE);
        return true;
    }
    if (v->layout == GLINT_LAYOUT_LATLONG) {
        *d = v->on_edges ? latlong_direction((x - 0.5) / (width - 1), (y - 0.5) / (height - 1))
                         : latlong_direction(x / width, y / height);
        return true;
    }
    if (v->layout != GLINT_LAYOUT_BALL && v->layout != GLINT_LAYOUT_ANGULAR) {
        return named_direction(v, place, d);
    }
    const double right = 2 * x / width - 1, up = 1 - 2 * y / height;
    if (v->layout == GLINT_LAYOUT_BALL) {
        return ball_direction(v->distance, right, up, d);
    }
    const double p = sqrt(right * right + up * up), share = p > 0 ? sin(GLINT_PI * p) / p : 0;
    *d = (glint_vec3){right * share, up * share, cos(GLINT_PI * p)};
    return p <= 1;
}

// ---- Pictures -----------------------------------------------------------------------------------

static glint_chart chart_of(const variant *v)
{
    const bool has_faces = glint_layout_cells(v->layout, NULL, NULL) != NULL;
    const int size = has_faces ? EDGE : v->layout == GLINT_LAYOUT_LATLONG ? 2 * EDGE : 4 * EDGE;
    glint_chart chart;
    assert_int_equal(glint_chart_make(v->layout, size, v->on_edges, &chart, NULL), GLINT_OK);
    chart.distance = v->distance;
    return chart;
}

static glint_image draw(const variant *v, const glint_chart *chart)
{
    glint_image image;
    assert_int_equal(glint_image_create(chart->width, chart->height, 3, &image, NULL), GLINT_OK);
    for (int k = 0; k < chart->width * chart->height; k++) {
        glint_vec3 d;
        double rgb[3] = {0, 0, 0};
        if (oracle_direction(v, chart,
                             &(glint_chart_place){k % chart->width, k / chart->width, 0, 0}, &d)) {
            color_of(d, rgb);
        }
        for (int c = 0; c < 3; c++) {
            image.pixels[3 * k + c] = (float)rgb[c];
        }
    }
    return image;
}

// The place of a direction in a disc, in radii from the centre.
static double radii(const glint_chart *chart, glint_vec3 d)
{
    double place[2];
    glint_disc_place(chart, d, place);
    return hypot(place[0] - chart->center[0], place[1] - chart->center[1]) / chart->radius;
}

// Bounds the difference between a look-up in a drawn picture and the colour of the direction.
// Bilinear interpolation errs by an eighth of the second derivative along each axis. For a ball,
// (2x q, 2y q, 1 − 2p²) with q = √(1 − p²), the second derivative is at most 6p/q + 2p³/q³, and 4
// in the middle. A near viewer's ball has half as much again. For an angular map, x sin(πp)/p and
// cos(πp), it is slightly above π². Where surrounding pixels lie outside the disc, only the range
// of colours bounds the difference.
static double source_bound(const variant *v, const glint_chart *chart, glint_vec3 d)
{
    const double r = chart->radius;
    if (v->layout == GLINT_LAYOUT_LATLONG) {
        return latlong_bound(chart->height, v->on_edges);
    }
    if (v->layout != GLINT_LAYOUT_BALL && v->layout != GLINT_LAYOUT_ANGULAR) {
        return v->on_edges ? 0.65 / ((EDGE - 1.0) * (EDGE - 1.0)) : seam_bound(EDGE);
    }
    const double p = radii(chart, d) + 1.5 / r; // radius of the farthest of the four pixels
    if (p >= 1) {
        return 1;
    }
    if (v->layout == GLINT_LAYOUT_ANGULAR) {
        return 1.1 * 0.5 * 2 * GLINT_PI * GLINT_PI / (8 * r * r);
    }
    const double q = sqrt(1 - p * p);
    const double second = fmax(4, 6 * p / q + 2 * p * p * p / (q * q * q));
    return 1.5 * 0.5 * 2 * second / (8 * r * r);
}

static double angle_between(glint_vec3 a, glint_vec3 b)
{
    return atan2(glint_vec3_length(glint_vec3_cross(a, b)), glint_vec3_dot(a, b));
}

// Averages many directions over a pixel's square in the picture.
static void mean_color(const variant *v, const glint_chart *chart, int i, int j, double mean[3])
{
    enum { SIDE = 8 };
    int count = 0;
    mean[0] = mean[1] = mean[2] = 0;
    for (int k = 0; k < SIDE * SIDE; k++) {
        glint_vec3 d;
        double rgb[3];
        const int column = k % SIDE, row = k / SIDE;
        const glint_chart_place place = {i, j, (column + 0.5) / SIDE - 0.5,
                                         (row + 0.5) / SIDE - 0.5};
        if (oracle_direction(v, chart, &place, &d)) {
            color_of(d, rgb);
            for (int c = 0; c < 3; c++) {
                mean[c] += rgb[c];
            }
            count++;
        }
    }
    for (int c = 0; c < 3; c++) {
        mean[c] /= count > 0 ? count : 1;
    }
}

// Bounds the difference between means over different grids of a pixel. Midpoint rules err by h²/24
// times the second derivative, which is ½ along an arc; h is one and a half pixels of the source.
// The factor 4 has two parts: two for the two axes, and two because arcs of a grid have different
// lengths near a rim. On the rim some points of a grid lie outside, so there is no bound.
static double grid_bound(const variant *v, const glint_chart *chart, int i, int j)
{
    const double h = 1.5 * GLINT_PI / 2 / EDGE;
    for (int corner = 0; corner < 4; corner++) {
        glint_vec3 d;
        const int right = corner % 2, down = corner / 2;
        if (!oracle_direction(v, chart, &(glint_chart_place){i, j, right - 0.5, down - 0.5}, &d) ||
            (v->layout == GLINT_LAYOUT_BALL && radii(chart, d) > 1 - 2 / chart->radius)) {
            return 1;
        }
    }
    return 4 * h * h / 24 * 0.5;
}

static void compare(const variant *from, const variant *to)
{
    const glint_chart source = chart_of(from), target = chart_of(to);
    glint_image drawn = draw(from, &source), found;
    glint_sampler sampler;
    assert_int_equal(glint_sampler_of_image(&drawn, &source, &sampler, NULL), GLINT_OK);
    assert_int_equal(glint_resample(&sampler, &glint_turn_none, &target, &found, NULL), GLINT_OK);
    int looked_at = 0, all = 0;
    for (int k = 0; k < target.width * target.height; k++) {
        const int i = k % target.width, j = k / target.width;
        glint_vec3 d;
        double wanted[3] = {0, 0, 0}, bound = 0;
        if (oracle_direction(to, &target, &(glint_chart_place){i, j, 0, 0}, &d)) {
            mean_color(to, &target, i, j, wanted);
            bound = 1e-6 + source_bound(from, &source, d) + grid_bound(to, &target, i, j);
            all++;
            looked_at += bound < 0.1;
        }
        for (int c = 0; c < 3; c++) {
            const double value = (double)found.pixels[3 * k + c];
            if (!(fabs(value - wanted[c]) <= bound && value >= -1e-6 && value <= 1 + 1e-6)) {
                fail_msg("%s to %s, pixel (%d, %d): %g, where %g within %g is right", from->name,
                         to->name, i, j, value, wanted[c], bound);
            }
        }
    }
    if (looked_at < 0.55 * all) { // a ball shows the rest at its rim, or hides it
        fail_msg("%s to %s: %d of %d pixels are looked at", from->name, to->name, looked_at, all);
    }
    glint_sampler_free(&sampler);
    glint_image_free(&drawn);
    glint_image_free(&found);
}

static void every_pair_of_layouts_faces_the_same_way(void **state)
{
    (void)state;
    for (int from = 0; from < VARIANTS; from++) {
        for (int to = 0; to < VARIANTS; to++) {
            compare(&variants[from], &variants[to]);
        }
    }
}

// ---- Exactness ----------------------------------------------------------------------------------

// Conversion to the same layout and size must not change a picture, whatever its content.
static void a_layout_to_itself_is_the_same_picture(void **state)
{
    (void)state;
    for (int k = 0; k < VARIANTS; k++) {
        const glint_chart chart = chart_of(&variants[k]);
        glint_image image = draw(&variants[k], &chart), found;
        for (int p = 0; p < 3 * chart.width * chart.height; p++) {
            image.pixels[p] *= (float)(1 + next_random());
        }
        glint_sampler sampler;
        assert_int_equal(glint_sampler_of_image(&image, &chart, &sampler, NULL), GLINT_OK);
        assert_int_equal(glint_resample(&sampler, &glint_turn_none, &chart, &found, NULL),
                         GLINT_OK);
        // At the edges of a lat-long map the first and last column are one place, and so is the row
        // of a pole.
        double worst = 0;
        for (int p = 0; p < chart.width * chart.height; p++) {
            const int i = p % chart.width, j = p / chart.width;
            const bool is_shared =
                variants[k].on_edges &&
                (i % EDGE == 0 || i % EDGE == EDGE - 1 || j % EDGE == 0 || j % EDGE == EDGE - 1 ||
                 i == chart.width - 1 || j == chart.height - 1);
            // Half of a pixel on the rim of a disc is outside. On a ball such a pixel is many
            // degrees wide.
            const double rim = variants[k].layout == GLINT_LAYOUT_BALL      ? 8
                               : variants[k].layout == GLINT_LAYOUT_ANGULAR ? 1
                                                                            : -1e9;
            const bool is_rim =
                hypot(i + 0.5 - chart.center[0], j + 0.5 - chart.center[1]) > chart.radius - rim;
            for (int c = 0; c < 3 && !is_shared && !is_rim; c++) {
                worst =
                    fmax(worst, fabs((double)(found.pixels[3 * p + c] - image.pixels[3 * p + c])));
            }
        }
        if (worst > 1e-5) {
            fail_msg("%s: %g", variants[k].name, worst);
        }
        glint_sampler_free(&sampler);
        glint_image_free(&image);
        glint_image_free(&found);
    }
}

// Tests means: a fine chequered pattern becomes grey where a pixel covers many squares, and a
// constant picture stays constant, up to the last bits.
static void shrinking_takes_means(void **state)
{
    (void)state;
    for (int k = 0; k < VARIANTS; k++) {
        const glint_chart source = chart_of(&variants[k]);
        glint_image image = draw(&variants[k], &source);
        for (int p = 0; p < source.width * source.height; p++) {
            const int is_white = (p % source.width + p / source.width) % 2;
            image.pixels[3 * p] = (float)is_white;
            image.pixels[3 * p + 1] = 0.7f;
            image.pixels[3 * p + 2] = 0;
        }
        glint_sampler sampler;
        assert_int_equal(glint_sampler_of_image(&image, &source, &sampler, NULL), GLINT_OK);
        glint_chart target;
        glint_image found;
        assert_int_equal(glint_chart_make(GLINT_LAYOUT_LATLONG, 4, false, &target, NULL), GLINT_OK);
        assert_int_equal(glint_resample(&sampler, &glint_turn_none, &target, &found, NULL),
                         GLINT_OK);
        for (int p = 0; p < 8 * 4; p++) {
            assert_float_equal(found.pixels[3 * p], 0.5f, 0.06f); // at least 24² squares a pixel
            assert_float_equal(found.pixels[3 * p + 1], 0.7f, 1e-6f);
            assert_true(found.pixels[3 * p + 2] == 0);
        }
        glint_sampler_free(&sampler);
        glint_image_free(&image);
        glint_image_free(&found);
    }
}

// One bright pixel of a map that shrinks a lot: the total light must stay the same.
static void a_sun_keeps_its_light(void **state)
{
    (void)state;
    glint_chart source, target;
    glint_image image, found;
    glint_sampler sampler;
    assert_int_equal(glint_chart_make(GLINT_LAYOUT_LATLONG, 1024, false, &source, NULL), GLINT_OK);
    assert_int_equal(glint_chart_make(GLINT_LAYOUT_LATLONG, 4, false, &target, NULL), GLINT_OK);
    assert_int_equal(glint_image_create(source.width, source.height, 3, &image, NULL), GLINT_OK);
    glint_image_pixel(&image, 1000, 600)[1] = 65536; // 256² pixels become one
    assert_int_equal(glint_sampler_of_image(&image, &source, &sampler, NULL), GLINT_OK);
    assert_int_equal(glint_resample(&sampler, &glint_turn_none, &target, &found, NULL), GLINT_OK);
    for (int p = 0; p < 8 * 4; p++) {
        const float wanted = p == 2 * 8 + 3 ? 1.0f : 0.0f;
        assert_float_equal(found.pixels[3 * p + 1], wanted, 0.01f);
    }
    glint_sampler_free(&sampler);
    glint_image_free(&image);
    glint_image_free(&found);
}

// ---- Discs --------------------------------------------------------------------------------------

// The lecture's map, (s, t) = (x, y)/√(x² + y² + (z + 1)²), in long double. The form in glint keeps
// its digits near −Z, where the root cancels.
static void the_ball_is_the_lectures_disk(void **state)
{
    (void)state;
    glint_chart chart;
    assert_int_equal(glint_chart_make(GLINT_LAYOUT_BALL, 2, false, &chart, NULL), GLINT_OK);
    for (int k = 0; k < 20000; k++) {
        const long double small = powl(10, -12 * (long double)fabs(next_random()));
        const long double turn = 4 * (long double)next_random();
        const long double z = k % 2 ? -sqrtl(1 - small * small) : 1 - 2 * small;
        const long double aside = k % 2 ? small : sqrtl(4 * small * (1 - small));
        const glint_vec3 d = {(double)(aside * cosl(turn)), (double)(aside * sinl(turn)),
                              (double)z};
        // z + 1 without cancellation.
        const long double x = d.x, y = d.y,
                          above = d.z < 0 ? (x * x + y * y) / (1 - (long double)d.z)
                                          : 1 + (long double)d.z;
        const long double root = sqrtl(x * x + y * y + above * above);
        double place[2];
        glint_disc_place(&chart, d, place);
        assert_true(fabs(place[0] - (double)(1 + x / root)) <= 1e-14);
        assert_true(fabs(place[1] - (double)(1 - y / root)) <= 1e-14);
    }
    const glint_vec3 behind = {0, 0, -1}, minus_zero = {-0.0, 0.0, -1};
    double place[2];
    glint_disc_place(&chart, behind, place);
    assert_true(fabs(hypot(place[0] - 1, place[1] - 1) - 1) < 1e-15); // some point of the rim
    glint_disc_place(&chart, minus_zero, place);
    assert_true(isfinite(place[0] + place[1]));
}

// Maps a direction to its place and back, for viewers from a hundredth of a radius on.
static void discs_are_inverted(void **state)
{
    (void)state;
    static const double distances[] = {1.01, 1.5, 3, 50, 1e6, INFINITY};
    for (size_t k = 0; k < 7; k++) {
        const variant v = {"", k < 6 ? GLINT_LAYOUT_BALL : GLINT_LAYOUT_ANGULAR, false,
                           k < 6 ? distances[k] : INFINITY};
        const glint_chart chart = chart_of(&v);
        const double hidden = isinf(v.distance) ? 0 : asin(1 / v.distance);
        for (int n = 0; n < 5000; n++) {
            const glint_vec3 d = random_direction();
            if (angle_between(d, (glint_vec3){0, 0, -1}) < hidden + 1e-3) {
                continue;
            }
            double place[2];
            glint_disc_place(&chart, d, place);
            const int i = (int)floor(place[0]), j = (int)floor(place[1]);
            const glint_chart_place within = {i, j, place[0] - i - 0.5, place[1] - j - 0.5};
            glint_vec3 there, oracle;
            assert_true(glint_chart_direction(&chart, &within, &there));
            assert_true(oracle_direction(&v, &chart, &within, &oracle));
            // At the rim the angle goes with the square root of the distance to the rim.
            const double rim = sqrt(fmax(1 - radii(&chart, d), 1e-16));
            assert_true(angle_between(d, there) <= 1e-13 / rim + 1e-12);
            assert_true(angle_between(d, oracle) <= 1e-13 / rim + 1e-12);
        }
    }
}

// ---- Turns --------------------------------------------------------------------------------------

static void turns_and_mirrors_are_what_they_say(void **state)
{
    (void)state;
    const variant *v = &variants[7];
    const glint_chart chart = chart_of(v);
    glint_image image = draw(v, &chart), found;
    glint_sampler sampler;
    assert_int_equal(glint_sampler_of_image(&image, &chart, &sampler, NULL), GLINT_OK);
    const struct {
        double degrees;
        const char *flip;
        glint_vec3 of_x, of_y, of_z; // the new places of +X, +Y and +Z
    } cases[] = {
        {0, "x", {-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        {0, "y", {1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
        {0, "z", {1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
        {0, "xz", {-1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
        {90, NULL, {0, 0, -1}, {0, 1, 0}, {1, 0, 0}}, // counter-clockwise, seen from above
        {-270, NULL, {0, 0, -1}, {0, 1, 0}, {1, 0, 0}},
        {90, "x", {0, 0, 1}, {0, 1, 0}, {1, 0, 0}}, // mirrored first
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const glint_turn turn = glint_turn_of(cases[k].degrees, cases[k].flip);
        assert_int_equal(glint_resample(&sampler, &turn, &chart, &found, NULL), GLINT_OK);
        glint_sampler turned;
        assert_int_equal(glint_sampler_of_image(&found, &chart, &turned, NULL), GLINT_OK);
        const glint_vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        const glint_vec3 now[3] = {cases[k].of_x, cases[k].of_y, cases[k].of_z};
        for (int axis = 0; axis < 3; axis++) {
            double seen[3], wanted[3];
            glint_sampler_look_up(&turned, now[axis], seen);
            color_of(axes[axis], wanted);
            for (int c = 0; c < 3; c++) {
                assert_true(fabs(seen[c] - wanted[c]) <= 2 * latlong_bound(chart.height, false));
            }
        }
        glint_sampler_free(&turned);
        glint_image_free(&found);
    }
    glint_sampler_free(&sampler);
    glint_image_free(&image);
}

// ---- Sizes --------------------------------------------------------------------------------------

static void sizes_are_as_fine_as_what_is_read(void **state)
{
    (void)state;
    for (int k = 0; k < VARIANTS; k++) {
        const glint_chart chart = chart_of(&variants[k]);
        if (!isinf(variants[k].distance)) {
            continue;
        }
        const double quarter = glint_chart_quarter_turn(&chart);
        const int size = glint_chart_size_for(chart.layout, quarter);
        glint_chart again;
        assert_int_equal(glint_chart_make(chart.layout, size, chart.on_edges, &again, NULL),
                         GLINT_OK);
        assert_int_equal(again.width, chart.width);
        assert_int_equal(again.height, chart.height);
    }
    glint_chart chart;
    assert_int_equal(glint_chart_make(GLINT_LAYOUT_LATLONG, 1, true, &chart, NULL), GLINT_USAGE);
    assert_int_equal(glint_chart_make(GLINT_LAYOUT_HCROSS, 65536, false, &chart, NULL),
                     GLINT_USAGE);
    assert_int_equal(glint_chart_make(GLINT_LAYOUT_BALL, 0, false, &chart, NULL), GLINT_USAGE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_pair_of_layouts_faces_the_same_way),
        cmocka_unit_test(a_layout_to_itself_is_the_same_picture),
        cmocka_unit_test(shrinking_takes_means),
        cmocka_unit_test(a_sun_keeps_its_light),
        cmocka_unit_test(the_ball_is_the_lectures_disk),
        cmocka_unit_test(discs_are_inverted),
        cmocka_unit_test(turns_and_mirrors_are_what_they_say),
        cmocka_unit_test(sizes_are_as_fine_as_what_is_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
