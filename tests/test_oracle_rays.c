// Tests the oracle's rays against geometry: hits, the tree, sides and normals, cameras, alpha, and
// the rules for matte, mixed and emitting surfaces. test_oracle.c tests optics.
#include "oracle/check.h"

#include <stdlib.h>
#include <string.h>

// Adds a square of half-width 9 in the plane y = 0, facing up.
static void add_floor(mesh *m, int material)
{
    mesh_add_quad(m, (const double[4][3]){{-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}},
                  material);
}

static oracle_ray towards(const double origin[3], const double target[3])
{
    oracle_ray ray;
    memcpy(ray.origin, origin, sizeof ray.origin);
    vector_store(unit(minus(vector_of(target), vector_of(origin))), ray.direction);
    return ray;
}

static void tree_finds_what_brute_force_finds(void **state)
{
    (void)state;
    uint64_t seed = 5;
    mesh m = {0};
    mesh_add_ball(&m, &(mesh_ball){.radius = 1.0, .rows = 12});
    for (int k = 0; k < 600; k++) {
        // Sizes span three decades. Some triangles are flat along an axis.
        double corners[3][3], size = pow(10.0, -3.0 * random_unit(&seed));
        for (int axis = 0; axis < 3; axis++) {
            double centre = 4.0 * random_unit(&seed) - 2.0;
            double spread = k % 3 == axis && k % 2 ? 0.0 : size;
            for (int i = 0; i < 3; i++)
                corners[i][axis] = centre + spread * (random_unit(&seed) - 0.5);
        }
        mesh_add_triangle(&m, (const double(*)[3])corners, 0);
    }
    oracle_material white = oracle_material_default;
    oracle_scene brute = scene_of(&m, &white), quick = brute;
    oracle_tree *tree = oracle_tree_create(m.triangles, m.count);
    quick.tree = tree;
    int hits = 0;
    for (int k = 0; k < 20000; k++) {
        oracle_ray ray;
        for (int axis = 0; axis < 3; axis++)
            ray.origin[axis] = 6.0 * random_unit(&seed) - 3.0;
        random_direction(&seed, ray.direction);
        if (k % 4 == 0) // along an axis, in the plane of flat boxes
            for (int axis = 0; axis < 3; axis++)
                ray.direction[axis] = axis == k / 4 % 3 ? 1.0 : 0.0;
        int left = k % 5 ? -1 : k % m.count;
        oracle_hit a = oracle_closest_hit(&brute, &ray, left);
        oracle_hit b = oracle_closest_hit(&quick, &ray, left);
        assert_int_equal(a.triangle, b.triangle);
        hits += a.triangle >= 0;
        if (a.triangle >= 0)
            assert_memory_equal(&a, &b, sizeof a);
    }
    print_message("tree: %d of 20000 rays met something\n", hits);
    assert_true(hits > 1000);
    oracle_tree_free(tree);
    mesh_free(&m);
}

static void closed_mesh_leaks_nowhere(void **state)
{
    (void)state;
    const double offsets[3] = {0.0, 1e3, 1e6};
    oracle_material white = oracle_material_default;
    for (int k = 0; k < 3; k++) {
        mesh m = {0};
        double o = offsets[k];
        mesh_add_ball(&m, &(mesh_ball){{o, -o, o}, 1.0, 12, false, 0});
        oracle_scene scene = scene_of(&m, &white);
        const double inside[3] = {o + 0.1, -o + 0.2, o - 0.3};
        for (int t = 0; t < m.count; t++) {
            for (int i = 0; i < 3; i++) {
                vector from = vector_of(m.triangles[t].position[i]);
                vector to = vector_of(m.triangles[t].position[(i + 1) % 3]);
                for (int step = 0; step <= 8; step++) {
                    double s = 0.125 * step;
                    vector target = plus(scaled(from, 1.0 - s), scaled(to, s));
                    oracle_ray ray = towards(inside, target.at);
                    assert_true(oracle_closest_hit(&scene, &ray, -1).triangle >= 0);
                }
            }
        }
        mesh_free(&m);
    }
}

static void spawned_rays_never_hit_where_they_start(void **state)
{
    (void)state;
    uint64_t seed = 9;
    oracle_material white = oracle_material_default;
    for (int k = 0; k < 300; k++) {
        mesh m = {0};
        double scale = pow(2.0, floor(80.0 * random_unit(&seed)) - 40.0);
        double offset = scale * pow(10.0, 4.0 * random_unit(&seed));
        mesh_add_ball(&m, &(mesh_ball){{offset, 0.0, -offset}, scale, 6, false, 0});
        oracle_scene scene = scene_of(&m, &white);
        for (int n = 0; n < 50; n++) {
            oracle_ray ray = {{offset + 3.0 * scale, 0.4 * scale, -offset}, {0.0, 0.0, 0.0}};
            double target[3] = {offset, scale * random_unit(&seed),
                                scale * (random_unit(&seed) - 0.5) - offset};
            ray = towards(ray.origin, target);
            oracle_hit first = oracle_closest_hit(&scene, &ray, -1);
            if (first.triangle < 0)
                continue;
            const oracle_triangle *t = &m.triangles[first.triangle];
            vector point = {{0.0, 0.0, 0.0}};
            for (int i = 0; i < 3; i++)
                point = plus(point, scaled(vector_of(t->position[i]), first.barycentric[i]));
            vector normal =
                unit(cross(minus(vector_of(t->position[1]), vector_of(t->position[0])),
                           minus(vector_of(t->position[2]), vector_of(t->position[0]))));
            oracle_ray away;
            vector_store(point, away.origin);
            random_direction(&seed, away.direction);
            bool out = dot(vector_of(away.direction), normal) > 0.0;
            // The ball is convex: outward rays miss it, inward rays hit its far side.
            oracle_hit next = oracle_closest_hit(&scene, &away, first.triangle);
            assert_true((next.triangle < 0) == out);
        }
        mesh_free(&m);
    }
}

static void degenerate_triangles_are_no_surfaces(void **state)
{
    (void)state;
    mesh m = {0};
    mesh_add_triangle(&m, (const double[3][3]){{0, 1, 0}, {0, 1, 0}, {0, 1, 0}}, 0);
    mesh_add_triangle(&m, (const double[3][3]){{-1, 1, 0}, {1, 1, 0}, {2, 1, 0}}, 0);
    mesh_add_triangle(&m, (const double[3][3]){{NAN, 1, 0}, {1, 1, 0}, {0, 1, 1}}, 0);
    add_floor(&m, 0);
    oracle_material white = oracle_material_default;
    oracle_scene scene = scene_of(&m, &white);
    oracle_ray ray = {{0.0, 2.0, 0.0}, {0.0, -1.0, 0.0}};
    oracle_hit hit = oracle_closest_hit(&scene, &ray, -1);
    assert_true(hit.triangle >= 3);
    assert_close(hit.distance, 2.0, 0.0);
    scene.triangle_count = 0;
    assert_int_equal(oracle_closest_hit(&scene, &ray, -1).triangle, -1);
    mesh_free(&m);
}

static void coincident_faces_show_the_lowest_index(void **state)
{
    (void)state;
    mesh m = {0};
    uint64_t seed = 2;
    add_floor(&m, 0);
    // The same square, cut along the other diagonal, so that distances round differently.
    mesh_add_quad(&m, (const double[4][3]){{9, 0, 9}, {9, 0, -9}, {-9, 0, -9}, {-9, 0, 9}}, 0);
    oracle_material white = oracle_material_default;
    oracle_scene scene = scene_of(&m, &white);
    for (int k = 0; k < 2000; k++) {
        double origin[3] = {random_unit(&seed), 0.1 + random_unit(&seed), random_unit(&seed)};
        double target[3] = {6.0 * random_unit(&seed), 0.0, 6.0 * random_unit(&seed)};
        oracle_ray ray = towards(origin, target);
        assert_true(oracle_closest_hit(&scene, &ray, -1).triangle < 2);
    }
    mesh_free(&m);
}

// One triangle in the floor's plane, with the same normal at all corners.
static vector seen_direction(const double normal[3], const oracle_ray *ray, double *weight)
{
    mesh m = {0};
    mesh_add_triangle(&m, (const double[3][3]){{-9, 0, 9}, {9, 0, 9}, {0, 0, -9}}, 0);
    for (int i = 0; i < 3; i++)
        memcpy(m.triangles[0].normal[i], normal, sizeof m.triangles[0].normal[i]);
    record seen = {.count = 0};
    oracle_material mirror = oracle_material_default;
    mirror.metallic = 1.0;
    mirror.base[1] = 0.0;
    oracle_scene scene = scene_of(&m, &mirror);
    scene.context = &seen;
    oracle_view view = {.depth = 2};
    double rgb[3];
    assert_true(oracle_radiance(&scene, &view, ray, rgb, NULL));
    assert_close(rgb[0], 1.0, 1e-15);
    assert_int_equal(seen.count, 1);
    mesh_free(&m);
    *weight = rgb[1];
    return vector_of(seen.direction[0]);
}

static void normals_decide_directions_but_never_sides(void **state)
{
    (void)state;
    double weight; // Schlick's (1 − n·v)⁵
    oracle_ray ray = {{0.0, 1.0, 0.0}, {0.6, -0.8, 0.0}};
    const vector flat = {{0.6, 0.8, 0.0}};
    // No normal, NaN, infinite, tiny and huge normals; and a normal on the wrong side.
    const double normals[6][3] = {{0, 0, 0},      {NAN, 1, 0},   {INFINITY, 1, 0},
                                  {0, 1e-200, 0}, {0, 1e200, 0}, {0, -1, 0}};
    for (int k = 0; k < 6; k++) {
        vector r = seen_direction(normals[k], &ray, &weight);
        assert_close(weight, pow(0.2, 5.0), 1e-15);
        assert_close(length(minus(r, flat)), 0.0, 1e-15);
    }
    // From below the mirror works the same.
    oracle_ray below = {{0.0, -1.0, 0.0}, {0.6, 0.8, 0.0}};
    vector r = seen_direction(normals[0], &below, &weight);
    assert_close(length(minus(r, (vector){{0.6, -0.8, 0.0}})), 0.0, 1e-15);

    // n tilts by 45° towards the ray's travel. It sends r = 2n(n·v) − v to (0.8, −0.6), below the
    // surface, so r is folded back across it.
    double s = sqrt(0.5);
    vector folded = seen_direction((double[]){s, s, 0.0}, &ray, &weight);
    assert_close(folded.at[0], 0.8, 1e-15);
    assert_close(folded.at[1], 0.6, 1e-15);
    // n·v < 0 although n is on n_g's side: n ← −n, which gives the same r.
    oracle_ray grazing = {{-8.0, 1.0, 0.0}, {0.992, -0.126, 0.0}};
    vector_store(unit(vector_of(grazing.direction)), grazing.direction);
    vector flipped = seen_direction((double[]){s, s, 0.0}, &grazing, &weight);
    assert_close(flipped.at[0], -grazing.direction[1], 1e-15);
    assert_close(flipped.at[1], grazing.direction[0], 1e-15);
    double cosine = s * (grazing.direction[0] + grazing.direction[1]);
    assert_close(weight, pow(1.0 - cosine, 5.0), 1e-15);
}

static void primary_rays_go_through_pixel_centres(void **state)
{
    (void)state;
    oracle_view view = {.eye = {1, 2, 3},
                        .right = {0, 0, -1},
                        .up = {0, 1, 0},
                        .back = {1, 0, 0},
                        .yfov = RADIANS(60.0),
                        .width = 200,
                        .height = 100};
    oracle_ray centre = oracle_primary_ray(&view, (double[]){100.0, 50.0});
    assert_close(centre.direction[0], -1.0, 1e-15);
    assert_close(centre.origin[1], 2.0, 0.0);
    // The top right corner: tan 30° up, twice as far to the right (which is −Z here).
    oracle_ray corner = oracle_primary_ray(&view, (double[]){200.0, 0.0});
    double t = tan(RADIANS(30.0)), norm = 1.0 / sqrt(1.0 + 5.0 * t * t);
    const double expected[3] = {-norm, t * norm, -2.0 * t * norm};
    for (int axis = 0; axis < 3; axis++)
        assert_close(corner.direction[axis], expected[axis], 1e-15);
    view.yfov = 0.0;
    view.ymag = 1.5;
    oracle_ray parallel = oracle_primary_ray(&view, (double[]){200.0, 0.0});
    assert_close(parallel.origin[0], 1.0, 0.0);
    assert_close(parallel.origin[1], 3.5, 1e-15);
    assert_close(parallel.origin[2], 0.0, 1e-15);
    assert_close(parallel.direction[0], -1.0, 0.0);
}

static void environment_turns_counter_clockwise_seen_from_above(void **state)
{
    (void)state;
    oracle_scene scene = {.radiance = light_direction, .environment_rotation = 90.0};
    oracle_view view = {.depth = 1};
    // Rotation moves +Z to +X, and +X to −Z.
    oracle_ray ray = {{0, 0, 0}, {1, 0, 0}};
    double rgb[3];
    assert_false(oracle_radiance(&scene, &view, &ray, rgb, NULL));
    assert_close(rgb[0], 0.5, 1e-15);
    assert_close(rgb[2], 1.0, 1e-15);
    ray = (oracle_ray){{0, 0, 0}, {0, 0, -1}};
    oracle_radiance(&scene, &view, &ray, rgb, NULL);
    assert_close(rgb[0], 1.0, 1e-15);
    assert_close(rgb[2], 0.5, 1e-15);
}

static void alpha_is_the_covered_share_of_samples(void **state)
{
    (void)state;
    mesh m = {0};
    oracle_material light = oracle_material_default;
    light.unlit = true;
    light.base[1] = 0.5;
    mesh_add_quad(&m, (const double[4][3]){{0, -9, 0}, {9, -9, 0}, {9, 9, 0}, {0, 9, 0}}, 0);
    oracle_scene scene = scene_of(&m, &light);
    oracle_view view = {.eye = {0.1, 0, 5},
                        .right = {1, 0, 0},
                        .up = {0, 1, 0},
                        .back = {0, 0, 1},
                        .ymag = 1.0,
                        .width = 1,
                        .height = 1,
                        .samples = 4,
                        .transparent = true};
    // Samples stand at −0.65, −0.15, 0.35 and 0.85; the quad covers x ≥ 0.
    double rgba[4];
    oracle_pixel(&scene, &view, (int[]){0, 0}, rgba, NULL);
    assert_close(rgba[3], 0.5, 1e-15);
    assert_close(rgba[1], 0.25, 1e-15);
    view.transparent = false;
    oracle_pixel(&scene, &view, (int[]){0, 0}, rgba, NULL);
    assert_close(rgba[3], 1.0, 1e-15);
    assert_close(rgba[1], 0.75, 1e-15);
    mesh_free(&m);
}

// The colour of a floor of this material at 45° and depth 1 under E = ½ + ½d.
static vector floor_colour(const oracle_material *material)
{
    mesh m = {0};
    add_floor(&m, 0);
    oracle_scene scene = scene_of(&m, material);
    scene.radiance = light_direction;
    scene.irradiance = light_direction_mean;
    oracle_view view = {.depth = 1};
    double s = sqrt(0.5);
    oracle_ray ray = {{0.0, 1.0, 0.1}, {s, -s, 0.0}};
    vector rgb = {{0.0, 0.0, 0.0}};
    oracle_radiance(&scene, &view, &ray, rgb.at, NULL);
    mesh_free(&m);
    return rgb;
}

static void surfaces_mix_metal_then_glass_then_paint(void **state)
{
    (void)state;
    const double s = sqrt(0.5), reflected = 0.5 + 0.5 * s, through = 0.5 - 0.5 * s;
    const double matte = 0.5 + 1.0 / 3.0, base = 0.6; // all in the green channel
    const double f = oracle_fresnel(s, 1.0, 1.5);
    oracle_material m = oracle_material_default;
    m.base[1] = base;
    assert_close(floor_colour(&m).at[1], (1.0 - f) * base * matte + f * reflected, 1e-15);
    m.roughness = 0.01; // rough paint is matte
    assert_close(floor_colour(&m).at[1], base * matte, 1e-15);
    m.roughness = 0.0;
    double metal = base + (1.0 - base) * pow(1.0 - s, 5.0);
    m.metallic = 1.0;
    m.transmission = 1.0; // a metal transmits nothing
    assert_close(floor_colour(&m).at[1], metal * reflected, 1e-15);
    m.metallic = 0.25;
    m.transmission = 0.4;
    double expected = 0.25 * metal * reflected +
                      0.75 * 0.4 * (f * reflected + (1.0 - f) * base * through) +
                      0.75 * 0.6 * (f * reflected + (1.0 - f) * base * matte);
    assert_close(floor_colour(&m).at[1], expected, 1e-15);
    m.emission[1] = 3.0;
    assert_close(floor_colour(&m).at[1], expected + 3.0, 1e-15);
    m.mirror = 0.3; // the lecture's blend ignores Fresnel, tint, metal and glass
    assert_close(floor_colour(&m).at[1], 3.0 + 0.7 * base * matte + 0.3 * reflected, 1e-15);
    m.unlit = true; // no emission either
    assert_close(floor_colour(&m).at[1], base, 0.0);
}

static void edges_and_critical_angles_are_told(void **state)
{
    (void)state;
    mesh m = {0};
    oracle_material glass = glass_of(1.5, 1.0);
    mesh_add_box(&m, (double[]){-1, -1, -1}, (double[]){1, 1, 1}, 0);
    oracle_scene scene = scene_of(&m, &glass);
    oracle_view view = {.depth = 1, .edges = true};
    oracle_report report;
    double rgb[3];
    // Ten metres away: 10⁻³ inside and 10⁻³ outside the silhouette, well inside, far outside.
    const double from[4] = {0.999, 1.001, 0.5, 2.0};
    const double expected[4] = {1e-4, 1e-4, ORACLE_EDGE_REACH, ORACLE_EDGE_REACH};
    for (int k = 0; k < 4; k++) {
        oracle_ray ray = {{from[k], 0.3, 11.0}, {0.0, 0.0, -1.0}};
        bool met = oracle_radiance(&scene, &view, &ray, rgb, &report);
        assert_true(met == (from[k] < 1.0));
        // Outside, the ray also passes the far edges of the box (12 m): the least ratio counts.
        assert_close(report.edge, expected[k], 2e-5);
    }
    double critical = asin(1.0 / 1.5);
    oracle_ray inside = {{0.0, 0.0, 0.0}, {0.0, -cos(critical + 1e-7), sin(critical + 1e-7)}};
    oracle_radiance(&scene, &view, &inside, rgb, &report);
    assert_int_equal(report.total_reflections, 1);
    assert_true(report.critical < 1e-6);
    mesh_free(&m);
}

static void an_exploding_tree_is_bounded_and_told(void **state)
{
    (void)state;
    mesh m = {0};
    oracle_material glass = oracle_material_default;
    glass.transmission = 1.0;
    glass.ior = 2.4;
    for (int k = 0; k < 30; k++) {
        mesh_add_quad(&m, (const double[4][3]){{-9, -k, 9}, {9, -k, 9}, {9, -k, -9}, {-9, -k, -9}},
                      0);
    }
    oracle_scene scene = scene_of(&m, &glass);
    oracle_view view = {.depth = 64, .min_weight = 0.0};
    oracle_report report;
    oracle_ray ray = {{0.0, 1.0, 0.1}, {0.0, -1.0, 0.0}};
    double rgb[3];
    oracle_radiance(&scene, &view, &ray, rgb, &report);
    assert_true(report.exhausted);
    assert_true(report.rays <= ORACLE_RAY_LIMIT);
    assert_close(rgb[0], 1.0, 1e-9); // truncated light is never black
    mesh_free(&m);
}

// A ray comes down at 45 degrees on a mirror at y = 1 and goes up to a screen at x = 2, at y = 3.
// With a start of ¼ it leaves from y = 1.25.
static void rays_start_beside_surfaces_if_asked(void **state)
{
    (void)state;
    for (int beside = 0; beside < 2; beside++) {
        double low = beside ? 3.2 : 2.9, high = beside ? 3.3 : 3.1;
        mesh m = {0};
        mesh_add_quad(&m, (const double[4][3]){{-1, 1, 1}, {1, 1, 1}, {1, 1, -1}, {-1, 1, -1}}, 0);
        mesh_add_quad(
            &m, (const double[4][3]){{2, low, -1}, {2, low, 1}, {2, high, 1}, {2, high, -1}}, 1);
        oracle_material materials[2] = {oracle_material_default, oracle_material_default};
        materials[0].metallic = 1.0;
        materials[1].unlit = true;
        materials[1].base[0] = 5.0;
        oracle_scene scene = scene_of(&m, materials);
        for (int start = 0; start < 2; start++) {
            oracle_view view = {.depth = 2, .start = 0.25 * start};
            oracle_ray ray = {{-1.0, 2.0, 0.1}, {1.0, -1.0, 0.0}};
            double rgb[3];
            oracle_radiance(&scene, &view, &ray, rgb, NULL);
            assert_close(rgb[0], start == beside ? 5.0 : 1.0, 1e-14);
        }
        mesh_free(&m);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tree_finds_what_brute_force_finds),
        cmocka_unit_test(closed_mesh_leaks_nowhere),
        cmocka_unit_test(spawned_rays_never_hit_where_they_start),
        cmocka_unit_test(degenerate_triangles_are_no_surfaces),
        cmocka_unit_test(coincident_faces_show_the_lowest_index),
        cmocka_unit_test(normals_decide_directions_but_never_sides),
        cmocka_unit_test(primary_rays_go_through_pixel_centres),
        cmocka_unit_test(environment_turns_counter_clockwise_seen_from_above),
        cmocka_unit_test(alpha_is_the_covered_share_of_samples),
        cmocka_unit_test(surfaces_mix_metal_then_glass_then_paint),
        cmocka_unit_test(edges_and_critical_angles_are_told),
        cmocka_unit_test(an_exploding_tree_is_bounded_and_told),
        cmocka_unit_test(rays_start_beside_surfaces_if_asked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
