// Tests hard cases of solids against closed forms: slabs, prisms, balls, a ball in a ball, and the
// corner of three mirrors.
#include "selftest/shapes.h"
#include "selftest/trial.h"
#include "selftest/vectors.h"

#include <math.h>
#include <string.h>

static double angle_between(const double a[3], const double b[3])
{
    double product[3];
    cross(a, b, product);
    return atan2(sqrt(dot(product, product)), dot(a, b));
}

// The distance of a point from the line through the origin along d, a unit vector.
static double distance_from_line(const double point[3], const double d[3])
{
    double product[3];
    cross(point, d, product);
    return sqrt(dot(product, product));
}

// Makes two random unit vectors at right angles to each other.
static void random_frame(trial *t, double along[3], double across[3])
{
    const glint_vec3 a = glint_random_direction(&t->random), b = glint_random_direction(&t->random);
    const double first[3] = {a.x, a.y, a.z}, second[3] = {b.x, b.y, b.z};
    for (int k = 0; k < 3; k++) {
        along[k] = first[k];
        across[k] = second[k] - dot(first, second) * first[k];
    }
    make_unit(across);
}

// Rays on their way through a scene, and the bounces at the last surface.
typedef struct flock {
    glint_probe *probe;
    glint_probe_ray *rays;
    glint_probe_bounce *bounces;
    size_t count;
} flock;

// Sends `count` rays through `surfaces` surfaces, one after the other. They are transmitted, except
// at the surfaces whose bit is set in `reflected`. At the end *rays are the rays that leave the
// last surface.
static glint_status follow(trial *t, const flock *f, int surfaces, unsigned reflected)
{
    glint_probe_ray *rays = f->rays;
    for (int n = 0; n < surfaces; n++) {
        const bool back = (reflected >> n & 1) != 0;
        TRY(trial_bounce(t, f->probe, rays, f->bounces, f->count));
        for (size_t i = 0; i < f->count; i++) {
            const glint_probe_bounce *b = &f->bounces[i];
            const bool met = b->hit.triangle >= 0;
            for (int k = 0; k < 3; k++) {
                rays[i].origin[k] = back ? b->reflected_origin[k] : b->transmitted_origin[k];
                rays[i].origin_low[k] = back ? b->reflected_low[k] : b->transmitted_low[k];
                // A ray that met nothing gets the direction NaN, which fails every measure.
                rays[i].direction[k] = !met ? NAN : back ? b->reflected[k] : b->transmitted[k];
            }
            rays[i].from = b->place;
            rays[i].media = back ? b->reflected_media : b->transmitted_media;
        }
    }
    return GLINT_OK;
}

// ---- Slabs and prisms --------------------------------------------------------------------------

static glint_status slab(trial *t)
{
    enum { COUNT = 2048 };
    static const double low[3] = {-1, -1, 0}, high[3] = {1, 1, 0.25};
    static glint_probe_ray rays[COUNT], begun[COUNT];
    static glint_probe_bounce bounces[COUNT];
    // The exit's cosine is the root of 1 − n²(1 − c²). An error of c becomes n²c/cos θ times as
    // large.
    glint_measure *directions = trial_error(t, "exit beside entry direction", "n²u/cos θ", 4);
    glint_measure *shifts = trial_error(t, "sideways shift", "u/cos θ", 8);
    glint_scene scene;
    glint_probe *probe;
    shape s = shape_begin();
    shape_add_box(&s, &(shape_box){low, high, 1, MATERIAL_GLASS, false});
    glint_status status;
    TRY_OR(cleanup, status, trial_build(t, &s, &scene, &probe));
    // Aim rays at all angles.
    for (int i = 0; i < COUNT; i++) {
        const double angle = trial_random(t, 0, 1.4), azimuth = trial_random(t, 0, 2 * GLINT_PI);
        const double d[3] = {sin(angle) * cos(azimuth), sin(angle) * sin(azimuth), -cos(angle)};
        rays[i] = (glint_probe_ray){.from = -1};
        for (int k = 0; k < 3; k++) {
            rays[i].direction[k] = trial_rounded(t, d[k]);
            rays[i].origin[k] = trial_rounded(t, (k == 2 ? 0.25 : 0) - 0.125 * d[k]);
        }
    }
    // Send them through both faces.
    memcpy(begun, rays, sizeof rays);
    TRY_OR(cleanup, status, follow(t, &(flock){probe, rays, bounces, COUNT}, 2, 0));
    // Compare directions and shifts.
    for (int i = 0; i < COUNT; i++) {
        const double *d = begun[i].direction, n = SHAPE_GLASS_IOR;
        const double sine = hypot(d[0], d[1]), cosine = -d[2];
        const double degrees = atan2(sine, cosine) * 180 / GLINT_PI;
        measure_vector(directions, rays[i].direction, d, n * n * t->u / cosine,
                       "%.4g° off the normal", degrees);
        double away[3];
        for (int k = 0; k < 3; k++) {
            away[k] = rays[i].origin[k] - begun[i].origin[k];
        }
        const double expected = 0.25 * sine * (1 - cosine / sqrt(n * n - sine * sine));
        measure_value(shifts, distance_from_line(away, d), expected, t->u / cosine,
                      "%.4g° off the normal", degrees);
    }
cleanup:
    glint_probe_free(probe);
    glint_scene_free(&scene);
    return status;
}

// Makes a prism of 60° whose edge, along z, is on top.
static glint_status prism_scene(trial *t, glint_scene *scene)
{
    const double h = 0.75, w = h * tan(GLINT_PI / 6);
    const double front[3][3] = {{-w, 0, 0.75}, {w, 0, 0.75}, {0, h, 0.75}};
    double back[3][3];
    for (int k = 0; k < 3; k++) {
        memcpy(back[k], front[2 - k], sizeof back[k]);
        back[k][2] = -0.75;
    }
    shape s = shape_begin();
    shape_add(&s, front, NULL, MATERIAL_GLASS);
    shape_add(&s, (const double(*)[3])back, NULL, MATERIAL_GLASS);
    for (int k = 0; k < 3; k++) {
        const double *a = front[k], *b = front[(k + 1) % 3];
        const double side[4][3] = {
            {a[0], a[1], -0.75}, {b[0], b[1], -0.75}, {b[0], b[1], 0.75}, {a[0], a[1], 0.75}};
        shape_add_quad(&s, side, MATERIAL_GLASS);
    }
    return shape_end(&s, scene, t->error);
}

static glint_status prism(trial *t)
{
    enum { COUNT = 4001 };
    static glint_probe_ray rays[COUNT], begun[COUNT];
    static glint_probe_bounce bounces[COUNT];
    const double degrees = GLINT_PI / 180, n = SHAPE_GLASS_IOR;
    const double least = 2 * asin(n * sin(30 * degrees)) - 60 * degrees;
    glint_measure *minimum = trial_error(t, "least deviation beside 37.181°", "°", 1e-4);
    glint_measure *deviations = trial_error(t, "deviations at all angles", "°", 1e-4);
    glint_scene scene;
    glint_probe *probe = NULL;
    glint_status status;
    // Make the prism.
    TRY_OR(cleanup, status, prism_scene(t, &scene));
    for (int i = 0; i < COUNT; i++) {
        // Aim at the left face, whose normal is 150° from +x, from below its normal.
        const double incidence = (30.0 + 50.0 * i / (COUNT - 1)) * degrees;
        const double heading = -30 * degrees + incidence;
        const double d[3] = {cos(heading), sin(heading), 0};
        const double at[3] = {-0.375 * tan(30 * degrees), 0.375, 0.0625};
        rays[i] = (glint_probe_ray){.from = -1};
        for (int k = 0; k < 3; k++) {
            rays[i].direction[k] = trial_rounded(t, d[k]);
            rays[i].origin[k] = trial_rounded(t, at[k] - 0.25 * d[k]);
        }
    }
    // Send the rays through both faces.
    memcpy(begun, rays, sizeof rays);
    TRY_OR(cleanup, status, trial_probe(t, &scene, &probe));
    TRY_OR(cleanup, status, follow(t, &(flock){probe, rays, bounces, COUNT}, 2, 0));
    // Compare with the closed form; find the least deviation.
    double smallest = INFINITY;
    for (int i = 0; i < COUNT; i++) {
        const double got = angle_between(begun[i].direction, rays[i].direction);
        const double incidence = atan2(begun[i].direction[1], begun[i].direction[0]) + 30 * degrees;
        const double inside = 60 * degrees - asin(sin(incidence) / n);
        const double expected = incidence + asin(n * sin(inside)) - 60 * degrees;
        smallest = fmin(smallest, got);
        measure_value(deviations, got / degrees, expected / degrees, 1, "incidence %.6g°",
                      incidence / degrees);
    }
    measure_value(minimum, smallest / degrees, least / degrees, 1, "in degrees");
cleanup:
    glint_probe_free(probe);
    glint_scene_free(&scene);
    return status;
}

// ---- Balls -------------------------------------------------------------------------------------

#define BALL_RAYS 4096
#define BALL_RADIUS 0.5
#define CORE_RADIUS 0.25
// h²/8 of an icosphere of level 5. Seen from the middle, its edges are under 63.4°/32. Facets stay
// this far below the ball, and smooth normals leave an error of this order.
#define SAGITTA 1.5e-4

// Aims rays past the balls' middle, at a distance of up to `most` radii of the outer ball.
static void aim_at_ball(trial *t, double most, glint_probe_ray *rays, double *impacts)
{
    for (int i = 0; i < BALL_RAYS; i++) {
        double along[3], across[3], away[3];
        random_frame(t, along, across);
        const double impact = BALL_RADIUS * trial_random(t, 0, most);
        rays[i] = (glint_probe_ray){.from = -1};
        for (int k = 0; k < 3; k++) {
            rays[i].direction[k] = trial_rounded(t, along[k]);
            rays[i].origin[k] = trial_rounded(t, impact * across[k] - 0.75 * along[k]);
        }
        const double back = dot(rays[i].origin, rays[i].direction);
        for (int k = 0; k < 3; k++) {
            away[k] = rays[i].origin[k] - back * rays[i].direction[k];
        }
        impacts[i] = sqrt(dot(away, away));
    }
}

typedef struct glass_ball {
    int internal; // number of reflections inside
    bool smooth, core;
} glass_ball;

// The mean error of the deviations, in radians. `internal` reflections happen inside. `core` adds
// the inner ball, whose index is lower.
static glint_status ball_error(trial *t, const glass_ball *of, int level, double *mean)
{
    const bool core = of->core;
    const int internal = of->internal;
    static const double centre[3] = {0, 0, 0};
    static glint_probe_ray rays[BALL_RAYS], begun[BALL_RAYS];
    static glint_probe_bounce bounces[BALL_RAYS];
    static double impacts[BALL_RAYS];
    // Make the balls.
    glint_scene scene;
    glint_probe *probe;
    shape s = shape_begin();
    shape_add_ball(&s, &(shape_ball){centre, BALL_RADIUS, level, MATERIAL_GLASS, of->smooth, NULL});
    if (core) {
        shape_add_ball(&s,
                       &(shape_ball){centre, CORE_RADIUS, level, MATERIAL_CORE, of->smooth, NULL});
    }
    glint_status status;
    TRY_OR(cleanup, status, trial_build(t, &s, &scene, &probe));
    // Send the rays through.
    aim_at_ball(t, core ? 0.55 : 0.85, rays, impacts);
    memcpy(begun, rays, sizeof rays);
    // Reflect at the surfaces after the first and before the last.
    const unsigned reflected = ((1u << internal) - 1) << 1;
    TRY_OR(
        cleanup, status,
        follow(t, &(flock){probe, rays, bounces, BALL_RAYS}, (core ? 4 : 2) + internal, reflected));
    // Compare with the closed form.
    double sum = 0;
    for (int i = 0; i < BALL_RAYS; i++) {
        const double b = impacts[i], n = SHAPE_GLASS_IOR, m = SHAPE_CORE_IOR;
        double turned = 2 * (asin(b / BALL_RADIUS) - asin(b / (n * BALL_RADIUS)));
        turned += internal * (GLINT_PI - 2 * asin(b / (n * BALL_RADIUS)));
        turned += core ? 2 * (asin(b / (n * CORE_RADIUS)) - asin(b / (m * CORE_RADIUS))) : 0;
        // Turn the sum into the angle between two directions.
        const double expected = acos(cos(turned));
        sum += fabs(angle_between(begun[i].direction, rays[i].direction) - expected);
    }
    *mean = sum / BALL_RAYS;
cleanup:
    glint_probe_free(probe);
    glint_scene_free(&scene);
    return status;
}

// Measures how the mean error falls if edges halve from level to level: as h^order.
static glint_status measure_order(trial *t, const glass_ball *of, double order,
                                  glint_measure *orders, double *last)
{
    double coarse = 0;
    for (int level = 3; level <= 5; level++) {
        TRY(ball_error(t, of, level, last));
        if (level > 3) {
            const double got = log2(coarse / *last);
            measure_error(orders, order - got,
                          "%s, %d reflections inside, level %d: %.3g rad, before %.3g: order %.3g",
                          of->smooth ? "smooth" : "flat", of->internal, level, *last, coarse, got);
        }
        coarse = *last;
    }
    return GLINT_OK;
}

static glint_status ball(trial *t)
{
    glint_measure *flat =
        trial_error(t, "flat: order 1 of the error less the order found", "", 0.2);
    glint_measure *smooth =
        trial_error(t, "smooth: order 2 of the error less the order found", "", 0.2);
    glint_measure *last = trial_error(t, "mean error of 20,480 smooth triangles", "rad", SAGITTA);
    for (int internal = 0; internal < 3; internal++) {
        double mean;
        TRY(measure_order(t, &(glass_ball){.internal = internal}, 1, flat, &mean));
        TRY(measure_order(t, &(glass_ball){.internal = internal, .smooth = true}, 2, smooth,
                          &mean));
        measure_error(last, mean / (1 + internal), "%d reflections inside: %.3g", internal, mean);
    }
    return GLINT_OK;
}

static glint_status ball_in_ball(trial *t)
{
    glint_measure *order = trial_error(t, "order 2 of the error less the order found", "", 0.2);
    glint_measure *last = trial_error(t, "mean error of 40,960 smooth triangles", "rad", SAGITTA);
    double mean = NAN;
    glint_status status =
        measure_order(t, &(glass_ball){.smooth = true, .core = true}, 2, order, &mean);
    measure_error(last, mean, "%.3g", mean);
    return status;
}

// ---- A corner of mirrors -----------------------------------------------------------------------

// Reflects d by the plane of a triangle as it is stored.
static void reflect_by_plane(const glint_scene *scene, double triangle, double d[3])
{
    const float *p = scene->positions + 9 * (size_t)triangle;
    double a[3], b[3], n[3];
    for (int k = 0; k < 3; k++) {
        a[k] = (double)p[3 + k] - (double)p[k];
        b[k] = (double)p[6 + k] - (double)p[k];
    }
    cross(a, b, n);
    make_unit(n);
    const double along = 2 * dot(d, n);
    for (int k = 0; k < 3; k++) {
        d[k] -= along * n[k];
    }
}

// Makes three mirrors at right angles, turned at random. The corner is the origin.
static glint_status corner_scene(trial *t, double axes[3][3], glint_scene *scene)
{
    random_frame(t, axes[0], axes[1]);
    cross(axes[0], axes[1], axes[2]);
    shape s = shape_begin();
    for (int m = 0; m < 3; m++) {
        const double *a = axes[(m + 1) % 3], *b = axes[(m + 2) % 3];
        double quad[4][3];
        for (int k = 0; k < 3; k++) {
            quad[0][k] = 0;
            quad[1][k] = 0.5 * a[k];
            quad[2][k] = 0.5 * (a[k] + b[k]);
            quad[3][k] = 0.5 * b[k];
        }
        shape_add_quad(&s, (const double(*)[3])quad, MATERIAL_TINTED);
    }
    return shape_end(&s, scene, t->error);
}

// Aims a ray from a place in front of all three mirrors to a place near the corner beyond the
// first.
static glint_probe_ray aim_at_corner(trial *t, const double axes[3][3])
{
    const double from[3] = {0.06, 0.12, 0.2},
                 steps[3] = {-1, trial_random(t, -1.2, -0.8), trial_random(t, -1.2, -0.8)};
    double d[3] = {0, 0, 0};
    glint_probe_ray ray = {.from = -1};
    for (int k = 0; k < 3; k++) {
        double at = 0;
        for (int m = 0; m < 3; m++) {
            at += axes[m][k] * from[m];
            d[k] += axes[m][k] * steps[m];
        }
        ray.origin[k] = trial_rounded(t, at);
    }
    make_unit(d);
    for (int k = 0; k < 3; k++) {
        ray.direction[k] = trial_rounded(t, d[k]);
    }
    return ray;
}

static glint_status corner_of_mirrors(trial *t)
{
    enum { COUNT = 1024 };
    static glint_probe_ray rays[COUNT], begun[COUNT];
    static glint_probe_bounce bounces[COUNT];
    static double judged[COUNT][3]; // directions, reflected at the stored planes
    // Corners of mirrors are floats. This alone puts them out of square by about 2⁻²³.
    glint_measure *back = trial_error(t, "exit beside −entry", "2⁻²⁴", 16);
    glint_measure *planes = trial_error(t, "exit beside what the stored planes give", "u", 16);
    double axes[3][3];
    glint_scene scene;
    glint_probe *probe = NULL;
    glint_status status;
    // Make the mirrors and aim the rays.
    TRY_OR(cleanup, status, corner_scene(t, axes, &scene));
    for (int i = 0; i < COUNT; i++) {
        rays[i] = aim_at_corner(t, (const double(*)[3])axes);
        memcpy(judged[i], rays[i].direction, sizeof judged[i]);
    }
    memcpy(begun, rays, sizeof rays);
    TRY_OR(cleanup, status, trial_probe(t, &scene, &probe));
    // Bounce three times.
    for (int n = 0; n < 3; n++) {
        TRY_OR(cleanup, status, follow(t, &(flock){probe, rays, bounces, COUNT}, 1, 1));
        for (int i = 0; i < COUNT && bounces[i].hit.triangle >= 0; i++) {
            reflect_by_plane(&scene, bounces[i].hit.triangle, judged[i]);
        }
    }
    // The rays must go back.
    for (int i = 0; i < COUNT; i++) {
        double reversed[3];
        for (int k = 0; k < 3; k++) {
            reversed[k] = -begun[i].direction[k];
        }
        measure_vector(back, rays[i].direction, reversed, 0x1p-24, "ray %d", i);
        measure_vector(planes, rays[i].direction, judged[i], t->u, "ray %d", i);
    }
cleanup:
    glint_probe_free(probe);
    glint_scene_free(&scene);
    return status;
}

const trial_case solid_cases[] = {
    {"slab", "a glass slab at up to 80°: the exit parallel to the entry, the shift in closed form",
     slab},
    {"ball", "a glass ball: deviations in closed form, errors that fall as h flat and h² smooth",
     ball},
    {"prism", "a prism of 60°: the least deviation, 37.181°, and all others", prism},
    {"ball_in_ball", "a glass ball in another: deviations in closed form, errors that fall as h²",
     ball_in_ball},
    {"corner_of_mirrors", "three mirrors at right angles: rays return as they came",
     corner_of_mirrors},
    {0},
};
