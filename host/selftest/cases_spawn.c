// Tests hard cases of rays that leave surfaces: self-hits, very small gaps and slabs, grazing rays,
// eyes inside glass and on a surface.
#include "base/memory.h"
#include "selftest/shapes.h"
#include "selftest/trial.h"
#include "selftest/vectors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void copy3(double to[3], const double from[3])
{
    memcpy(to, from, 3 * sizeof *to);
}

// The reflected or the transmitted branch of a bounce, as a ray.
static glint_probe_ray branch_of(const glint_probe_bounce *b, bool transmitted)
{
    glint_probe_ray ray = {.from = b->place,
                           .media = transmitted ? b->transmitted_media : b->reflected_media};
    copy3(ray.origin, transmitted ? b->transmitted_origin : b->reflected_origin);
    copy3(ray.origin_low, transmitted ? b->transmitted_low : b->reflected_low);
    copy3(ray.direction, transmitted ? b->transmitted : b->reflected);
    return ray;
}

// ---- Self-hits ---------------------------------------------------------------------------------

#define QUADS 500

// Makes parallelograms of two triangles each, which lie exactly in one plane, in any orientation.
// Their corners are multiples of 2⁻²³, which floats hold. They are a millionth to a tenth of the
// scene's size, of glass and of mirrors in turn. Every other pair lies in the plane x = 0, y = 0 or
// z = 0. There places have no rounding error at right angles to the plane, so rays start in the
// plane itself. With parts, small parallelograms have their own origins.
static glint_status random_quads(trial *t, bool with_parts, glint_scene *scene)
{
    shape s = shape_begin();
    for (int i = 0; i < QUADS; i++) {
        const double step = ldexp(1, -(int)trial_random(t, 6, 24));
        double corner[4][3];
        for (int k = 0; k < 3; k++) {
            const bool flat = i / 2 % 2 == 1 && k == i / 4 % 3;
            const double centre = flat ? 0 : floor(trial_random(t, -128, 128)) / 256;
            const double a = flat ? 0 : floor(trial_random(t, -8, 8)) * step;
            const double b = flat ? 0 : floor(trial_random(t, -8, 8)) * step;
            corner[0][k] = centre;
            corner[1][k] = centre + a;
            corner[2][k] = centre + a + b;
            corner[3][k] = centre + b;
        }
        shape_add_quad(&s, (const double(*)[3])corner, i % 2 ? MATERIAL_GLASS : MATERIAL_TINTED);
    }
    return with_parts ? shape_end_with_parts(&s, 1, scene, NULL, t->error)
                      : shape_end(&s, scene, t->error);
}

static void aim_at_quads(trial *t, const glint_scene *scene, glint_probe_ray *rays, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const float *p = scene->positions + 9 * (i % scene->triangle_count);
        const glint_vec3 away = glint_random_direction(&t->random);
        const double b1 = trial_random(t, 0, 1), b2 = trial_random(t, 0, 1 - b1);
        // Start at about the triangle's size away, so that most rays reach it.
        double size = 1e-6;
        for (int k = 0; k < 3; k++) {
            size = fmax(size, fabs((double)p[3 + k] - (double)p[k]));
        }
        const double offsets[3] = {away.x, away.y, away.z};
        double target[3], from[3];
        for (int k = 0; k < 3; k++) {
            target[k] = (double)p[k] + b1 * ((double)p[3 + k] - (double)p[k]) +
                        b2 * ((double)p[6 + k] - (double)p[k]);
            from[k] = target[k] + size * offsets[k];
        }
        rays[i] = trial_aim(t, from, target);
    }
}

typedef struct departures {
    glint_measure *again, *lengths;
} departures;

static glint_status judge_departures(trial *t, glint_probe *probe,
                                     const glint_probe_bounce *bounces, size_t count,
                                     const departures *judged)
{
    glint_probe_ray *rays = glint_allocate(2 * count, sizeof *rays);
    glint_probe_hit *hits = glint_allocate(2 * count, sizeof *hits);
    glint_status status = GLINT_OK;
    if (rays == NULL || hits == NULL) {
        status = glint_fail_memory(t->error, "a self-test");
        goto cleanup;
    }
    // Trace both branches of every bounce.
    for (size_t i = 0; i < 2 * count; i++) {
        const glint_probe_bounce *b = &bounces[i / 2];
        rays[i] = branch_of(b, i % 2 == 1 && !(b->transmitted_weight <= 0));
    }
    TRY_OR(cleanup, status, trial_trace(t, probe, rays, hits, 2 * count));
    // A branch must not hit the plane that it leaves.
    for (size_t i = 0; i < 2 * count; i++) {
        const glint_probe_bounce *b = &bounces[i / 2];
        const bool leaves = i % 2 == 0 || !(b->transmitted_weight <= 0);
        if (b->hit.triangle >= 0 && leaves) {
            const double length = sqrt(dot(rays[i].direction, rays[i].direction));
            measure_error(judged->lengths, fabs(length - 1) / t->u,
                          "ray %zu leaves along %.9g, %.9g, %.9g", i / 2, rays[i].direction[0],
                          rays[i].direction[1], rays[i].direction[2]);
            measure_event(judged->again, floor(hits[i].triangle / 2) == floor(b->hit.triangle / 2),
                          "ray %zu leaves triangle %g and hits triangle %g, which lies in its "
                          "plane, after %.3g",
                          i / 2, b->hit.triangle, hits[i].triangle, hits[i].distance);
        }
    }
cleanup:
    free(rays);
    free(hits);
    return status;
}

static glint_status leave_quads(trial *t, bool with_parts, const departures *judged)
{
    enum { BATCH = 16384 };
    glint_scene scene;
    glint_probe *probe = NULL;
    glint_probe_ray *rays = glint_allocate(BATCH, sizeof *rays);
    glint_probe_bounce *bounces = glint_allocate(BATCH, sizeof *bounces);
    glint_status status;
    TRY_OR(cleanup, status, random_quads(t, with_parts, &scene));
    if (rays == NULL || bounces == NULL) {
        status = glint_fail_memory(t->error, "a self-test");
        goto cleanup;
    }
    TRY_OR(cleanup, status, trial_probe(t, &scene, &probe));
    for (uint64_t done = 0; done < t->options->rays; done += 2 * BATCH) {
        aim_at_quads(t, &scene, rays, BATCH);
        TRY_OR(cleanup, status, trial_bounce(t, probe, rays, bounces, BATCH));
        TRY_OR(cleanup, status, judge_departures(t, probe, bounces, BATCH, judged));
    }
cleanup:
    glint_probe_free(probe);
    free(rays);
    free(bounces);
    glint_scene_free(&scene);
    return status;
}

static glint_status no_second_hit(trial *t)
{
    // |t|² is η² sin² θi + cos² θt. Each term errs by some 4u·η² here.
    const departures judged = {trial_events(t, "rays that hit the plane they leave", 0),
                               trial_error(t, "length of their directions beside 1", "u", 16)};
    for (int with_parts = 0; with_parts < 2; with_parts++) {
        TRY(leave_quads(t, with_parts != 0, &judged));
    }
    return GLINT_OK;
}

// ---- Gaps --------------------------------------------------------------------------------------

// The gap between two mirrors that face each other along an axis.
typedef struct gap {
    int axis;
    double size;   // size of the mirrors
    double height; // height of the lower mirror
    double width;
} gap;

static glint_status facing_mirrors(trial *t, const gap *between, glint_scene *scene)
{
    const int axis = between->axis;
    const double size = between->size;
    static const int around[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    shape s = shape_begin();
    for (int upper = 0; upper < 2; upper++) {
        double corner[4][3];
        for (int k = 0; k < 4; k++) {
            const int *at = around[upper ? 3 - k : k];
            corner[k][axis] = between->height + upper * between->width;
            corner[k][(axis + 1) % 3] = at[0] * size;
            corner[k][(axis + 2) % 3] = at[1] * size;
        }
        shape_add_quad(&s, (const double(*)[3])corner, MATERIAL_TINTED);
    }
    return shape_end(&s, scene, t->error);
}

#define GAP_RAYS 256

// Tests whether all rays that start in the gap meet the lower mirror and then the upper mirror.
static glint_status gap_is_seen(trial *t, const gap *between, bool *seen)
{
    const int axis = between->axis;
    const double size = between->size, height = between->height;
    static glint_probe_ray rays[GAP_RAYS];
    static glint_probe_bounce bounces[GAP_RAYS];
    static glint_probe_hit hits[GAP_RAYS];
    glint_scene scene;
    glint_probe *probe = NULL;
    glint_status status;
    TRY_OR(cleanup, status, facing_mirrors(t, between, &scene));
    // Start in the middle of the gap, towards the lower mirror.
    for (int i = 0; i < GAP_RAYS; i++) {
        double from[3], to[3];
        for (int k = 0; k < 3; k++) {
            from[k] = trial_random(t, -size, size) / 2;
            to[k] = from[k] + trial_random(t, -size, size) / 4;
        }
        from[axis] = height + between->width / 2;
        to[axis] = height - size / 8;
        rays[i] = trial_aim(t, from, to);
    }
    // Reflect, and trace the reflected rays.
    TRY_OR(cleanup, status, trial_probe(t, &scene, &probe));
    TRY_OR(cleanup, status, trial_bounce(t, probe, rays, bounces, GAP_RAYS));
    for (int i = 0; i < GAP_RAYS; i++) {
        rays[i] = branch_of(&bounces[i], false);
    }
    TRY_OR(cleanup, status, trial_trace(t, probe, rays, hits, GAP_RAYS));
    // See what they met.
    *seen = true;
    for (int i = 0; i < GAP_RAYS; i++) {
        *seen =
            *seen && floor(bounces[i].hit.triangle / 2) == 0 && floor(hits[i].triangle / 2) == 1;
    }
cleanup:
    glint_probe_free(probe);
    glint_scene_free(&scene);
    return status;
}

// A ray starts off its surface by 8 rounding errors of its coordinates (place_on_triangle). Its
// place is known to about 3. So with 16 between the mirrors, no start may lie beyond the other
// mirror.
static glint_status smallest_gap(trial *t)
{
    static const double sizes[] = {1, 0x1p-10, 0x1p-20};
    glint_measure *smallest = trial_error(t, "smallest gap that is seen", "2⁻²⁴ × height", 16);
    for (int i = 0; i < 9; i++) {
        const double size = sizes[i / 3], height = 0.75 * size;
        bool seen = true;
        int k = 12;
        for (; seen && k >= 0; k--) {
            const gap between = {i % 3, size, height, ldexp(height, k - 24)};
            TRY(gap_is_seen(t, &between, &seen));
        }
        // The last gap tried is the first that is not seen, if any.
        const int last = seen ? 0 : k + 2;
        measure_error(smallest, ldexp(1, last), "along axis %d, mirrors of %g: 2^%d", i % 3, size,
                      last);
    }
    return GLINT_OK;
}

// ---- Grazing rays ------------------------------------------------------------------------------

// Makes a square about the origin, at right angles to `normal` except for the rounding of its
// corners. Sets `normal` to the stored normal of its first triangle.
static glint_status tilted_square(trial *t, double normal[3], glint_scene *scene)
{
    const double other[3] = {normal[1], normal[2], -normal[0]};
    double a[3], b[3], quad[4][3];
    cross(normal, other, a);
    make_unit(a);
    cross(normal, a, b);
    for (int k = 0; k < 3; k++) {
        quad[0][k] = 0.6 * (-a[k] - b[k]);
        quad[1][k] = 0.6 * (a[k] - b[k]);
        quad[2][k] = 0.6 * (a[k] + b[k]);
        quad[3][k] = 0.6 * (b[k] - a[k]);
    }
    shape s = shape_begin();
    shape_add_quad(&s, (const double(*)[3])quad, MATERIAL_TINTED);
    TRY(shape_end(&s, scene, t->error));
    for (int k = 0; k < 3; k++) {
        a[k] = (double)scene->positions[3 + k] - (double)scene->positions[k];
        b[k] = (double)scene->positions[6 + k] - (double)scene->positions[k];
    }
    cross(a, b, normal);
    make_unit(normal);
    return GLINT_OK;
}

#define GRAZING_RAYS 3072 // six angles, in turn

// Aims at the middle of the square's first triangle, from 10⁻ᵏ degrees above it.
static void aim_grazing(trial *t, const glint_scene *scene, const double normal[3],
                        glint_probe_ray *rays)
{
    const float *p = scene->positions;
    for (int i = 0; i < GRAZING_RAYS; i++) {
        const int power = -1 - i % 6;
        const double elevation = pow(10, power) * GLINT_PI / 180;
        const glint_vec3 any = glint_random_direction(&t->random);
        double along[3] = {any.x, any.y, any.z}, from[3], to[3];
        const double off = dot(along, normal);
        for (int k = 0; k < 3; k++) {
            along[k] -= off * normal[k];
        }
        make_unit(along);
        for (int k = 0; k < 3; k++) {
            to[k] = ((double)p[k] + (double)p[3 + k] + (double)p[6 + k]) / 3;
            from[k] = to[k] - 0.4 * (cos(elevation) * along[k] - sin(elevation) * normal[k]);
        }
        rays[i] = trial_aim(t, from, to);
    }
}

// The distance along a ray to the plane of the scene's first triangle, and the cosine between ray
// and normal. Computed from the stored corners, in long double.
static double distance_to_plane(const glint_scene *scene, const glint_probe_ray *ray,
                                double *cosine)
{
    const float *p = scene->positions;
    long double a[3], b[3], away = 0, along = 0, squares = 0;
    for (int k = 0; k < 3; k++) {
        a[k] = (long double)p[3 + k] - p[k];
        b[k] = (long double)p[6 + k] - p[k];
    }
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const long double n = a[i] * b[j] - a[j] * b[i];
        away += n * (p[k] - (long double)ray->origin[k]);
        along += n * (long double)ray->direction[k];
        squares += n * n;
    }
    *cosine = (double)(-along / sqrtl(squares));
    return (double)(away / along);
}

// The numerator of the distance errs by a few u of the coordinates. The division by cos θ
// multiplies it.
static glint_status graze_plane(trial *t, int plane, glint_measure *errors, glint_measure *others)
{
    static glint_probe_ray rays[GRAZING_RAYS];
    static glint_probe_hit hits[GRAZING_RAYS];
    const glint_vec3 up = glint_random_direction(&t->random);
    double normal[3] = {plane == 0 ? 0 : up.x, plane == 0 ? 1 : up.y, plane == 0 ? 0 : up.z};
    glint_scene scene;
    glint_probe *probe = NULL;
    glint_status status;
    TRY_OR(cleanup, status, tilted_square(t, normal, &scene));
    aim_grazing(t, &scene, normal, rays);
    TRY_OR(cleanup, status, trial_probe(t, &scene, &probe));
    TRY_OR(cleanup, status, trial_trace(t, probe, rays, hits, GRAZING_RAYS));
    for (int i = 0; i < GRAZING_RAYS; i++) {
        double cosine;
        const double wanted = distance_to_plane(&scene, &rays[i], &cosine);
        // Judge only rays that, rounded, still meet the triangle well inside. In float, below 10⁻⁴
        // degrees, the bound is half of the distance; there anything may be true.
        const bool known = 8 * t->u / fabs(cosine) < 0.5;
        if (!(cosine > 0 && wanted > 0.3 && wanted < 0.5 && known)) {
            continue;
        }
        measure_value(errors, hits[i].distance, wanted, t->u * wanted / cosine,
                      "plane %d, 10^%d° above it, ray %d", plane, -1 - i % 6, i);
        measure_event(others, hits[i].triangle != 0,
                      "plane %d, 10^%d° above it, ray %d: triangle %g", plane, -1 - i % 6, i,
                      hits[i].triangle);
    }
cleanup:
    glint_probe_free(probe);
    glint_scene_free(&scene);
    return status;
}

static glint_status grazing_rays(trial *t)
{
    glint_measure *errors = trial_error(t, "error of the distance", "u·t/cos θ", 8);
    glint_measure *others = trial_events(t, "rays that do not meet the triangle", 0);
    for (int plane = 0; plane < 8; plane++) {
        TRY(graze_plane(t, plane, errors, others));
    }
    return GLINT_OK;
}

// ---- Thin slabs --------------------------------------------------------------------------------

static glint_status pass_slab(trial *t, double thickness, glint_measure *others)
{
    enum { COUNT = 1024 };
    static glint_probe_ray rays[COUNT];
    static glint_probe_bounce first[COUNT], second[COUNT];
    static glint_probe_hit hits[COUNT];
    const double low[3] = {-0.5, -0.5, 0.7}, high[3] = {0.5, 0.5, 0.7 + thickness};
    glint_scene scene;
    glint_probe *probe;
    shape s = shape_begin();
    shape_add_box(&s, &(shape_box){low, high, 1, MATERIAL_GLASS, false});
    glint_status status;
    TRY_OR(cleanup, status, trial_build(t, &s, &scene, &probe));
    // Aim at the upper face.
    for (int i = 0; i < COUNT; i++) {
        const double from[3] = {trial_random(t, -0.9, 0.9), trial_random(t, -0.9, 0.9), 0.9};
        const double to[3] = {trial_random(t, -0.4, 0.4), trial_random(t, -0.4, 0.4), 0.7};
        rays[i] = trial_aim(t, from, to);
    }
    // Refract at both faces, then trace.
    TRY_OR(cleanup, status, trial_bounce(t, probe, rays, first, COUNT));
    for (int i = 0; i < COUNT; i++) {
        rays[i] = branch_of(&first[i], true);
    }
    TRY_OR(cleanup, status, trial_bounce(t, probe, rays, second, COUNT));
    for (int i = 0; i < COUNT; i++) {
        rays[i] = branch_of(&second[i], true);
    }
    TRY_OR(cleanup, status, trial_trace(t, probe, rays, hits, COUNT));
    // Each ray must enter, leave and meet nothing more.
    for (int i = 0; i < COUNT; i++) {
        const bool right = first[i].outside == 1 && second[i].hit.triangle >= 0 &&
                           second[i].outside == 0 && hits[i].triangle < 0;
        measure_event(others, !right,
                      "%g thick, ray %d: triangle %g (from outside: %g), %g (%g), then %g",
                      thickness, i, first[i].hit.triangle, first[i].outside, second[i].hit.triangle,
                      second[i].outside, hits[i].triangle);
    }
cleanup:
    glint_probe_free(probe);
    glint_scene_free(&scene);
    return status;
}

static glint_status thin_slabs(trial *t)
{
    glint_measure *others = trial_events(t, "rays that do not cross two interfaces", 0);
    for (int k = -6; k <= -3; k++) {
        TRY(pass_slab(t, pow(10, k), others));
    }
    return GLINT_OK;
}

// ---- Eyes in odd places ------------------------------------------------------------------------

// From a smooth ball's centre every ray runs along its normal and is not bent.
static glint_status eye_inside_glass(trial *t)
{
    enum { COUNT = 4096 };
    static const double centre[3] = {0, 0, 0};
    static glint_probe_ray rays[COUNT];
    static glint_probe_bounce bounces[COUNT];
    glint_measure *media = trial_events(t, "rays that do not leave the glass for empty space", 0);
    glint_measure *bends = trial_error(t, "bend of the ray", "2⁻²⁴", 8); // normals are floats
    glint_measure *weights = trial_error(t, "weight beside 1 − F0", "2⁻²⁴", 8);
    glint_scene scene;
    glint_probe *probe;
    shape s = shape_begin();
    shape_add_ball(&s, &(shape_ball){centre, 0.75, 3, MATERIAL_GLASS, true, NULL});
    glint_status status;
    TRY_OR(cleanup, status, trial_build(t, &s, &scene, &probe));
    // Shoot rays from the centre.
    for (int i = 0; i < COUNT; i++) {
        rays[i] = trial_random_ray(t, centre);
    }
    TRY_OR(cleanup, status, trial_bounce(t, probe, rays, bounces, COUNT));
    // They leave the glass without a bend.
    for (int i = 0; i < COUNT; i++) {
        const glint_probe_bounce *b = &bounces[i];
        measure_event(media,
                      !(b->outside == 0 && b->transmitted_media == 0 && b->reflected_media != 0),
                      "ray %d: outside %g, media %g and %g", i, b->outside, b->reflected_media,
                      b->transmitted_media);
        measure_vector(bends, b->transmitted, rays[i].direction, 0x1p-24, "ray %d", i);
        measure_value(weights, b->transmitted_weight, 0.96, 0x1p-24, "ray %d", i);
    }
cleanup:
    glint_probe_free(probe);
    glint_scene_free(&scene);
    return status;
}

// Places eyes on a face, on an edge and on a corner of a box, of glass or of mirrors. They look
// along the surface, away from it and into it. Each colour is a mean of the environment's colours,
// which lie in [0, 1]. Its weights add up to 1 within 4u a surface, and each path has six surfaces.
static glint_status look_from_surface(trial *t, const glint_environment *environment,
                                      const glint_camera *camera, shape_material material,
                                      glint_measure *bad)
{
    static const double low[3] = {-0.5, -0.5, -0.5}, high[3] = {0.5, 0.5, 0.5};
    glint_settings settings = trial_settings(t);
    settings.depth = 6;
    settings.min_weight = 1.0 / 64;
    glint_scene scene;
    trial_picture picture = {0};
    shape s = shape_begin();
    shape_add_box(&s, &(shape_box){low, high, 1, material, false});
    glint_status status;
    TRY_OR(cleanup, status, shape_end(&s, &scene, t->error));
    const glint_renderer_inputs inputs = trial_inputs(t, &scene, environment, &settings);
    TRY_OR(cleanup, status, trial_frame(t, &inputs, camera, &picture));
    for (int p = 0; p < 4 * picture.width * picture.height; p++) {
        const double value = picture.values[p];
        measure_event(bad, !(value >= 0 && value <= 1 + 24 * t->u),
                      "eye (%g, %g, %g) that looks along (%g, %g, %g): pixel %d has %g",
                      camera->eye.x, camera->eye.y, camera->eye.z, -camera->back.x, -camera->back.y,
                      -camera->back.z, p / 4, value);
    }
cleanup:
    trial_picture_free(&picture);
    glint_scene_free(&scene);
    return status;
}

static glint_status eye_on_surface(trial *t)
{
    static const double eyes[][3] = {{0.5, 0.125, 0.25}, {0.5, 0.5, 0.25}, {0.5, 0.5, 0.5}};
    static const double targets[][3] = {{0, 0, 0}, {1, 0.5, 0.5}, {0.5, 0.25, -0.5}};
    glint_measure *bad = trial_events(t, "pixels that are not finite or not in [0, 1]", 0);
    glint_environment environment;
    glint_status status;
    TRY_OR(cleanup, status, trial_linear_environment(16, &environment, t->error));
    for (int i = 0; i < 18; i++) {
        const glint_camera camera = shape_camera(eyes[i % 3], targets[i / 3 % 3], 1.2, 0);
        TRY_OR(cleanup, status,
               look_from_surface(t, &environment, &camera, i / 9 ? MATERIAL_GLASS : MATERIAL_MIRROR,
                                 bad));
    }
cleanup:
    glint_environment_free(&environment);
    return status;
}

const trial_case spawn_cases[] = {
    {"no_second_hit", "rays that leave triangles of any size: they do not hit its plane again",
     no_second_hit},
    {"smallest_gap", "mirrors 2^k of their height apart: how near each other they are seen",
     smallest_gap},
    {"grazing_rays",
     "rays 10^−1 to 10^−6 degrees (float: 10^−4) above a plane: the distance, in closed form",
     grazing_rays},
    {"thin_slabs", "glass of 10^−6 to 10^−3 at a distance of 0.7: exactly two interfaces",
     thin_slabs},
    {"eye_inside_glass", "an eye in the middle of a glass ball: nothing is bent", eye_inside_glass},
    {"eye_on_surface", "eyes on faces, edges and corners: finite colours", eye_on_surface},
    {0},
};
