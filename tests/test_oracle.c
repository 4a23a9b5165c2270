// Tests the oracle's light transport against closed forms: textbook optics, and rules 3 to 8 one by
// one. test_oracle_rays.c tests rays, cameras and the tree.
#include "oracle/check.h"

// Radiance of a path with at most `depth` surfaces. No branch ends by its weight.
static vector radiance(const oracle_scene *scene, const oracle_ray *ray, int depth)
{
    oracle_view view = {.depth = depth};
    vector rgb = {{0.0, 0.0, 0.0}};
    oracle_radiance(scene, &view, ray, rgb.at, NULL);
    return rgb;
}

static void assert_grey(vector rgb, double expected, double tolerance)
{
    for (int i = 0; i < 3; i++)
        assert_close(rgb.at[i], expected, tolerance);
}

// A ray in the x, y plane at `degrees` from straight down, towards +X.
static oracle_ray falling(double degrees, double from_x, double from_y)
{
    double a = RADIANS(degrees);
    return (oracle_ray){{from_x, from_y, 0.1}, {sin(a), -cos(a), 0.0}};
}

static void fresnel_meets_its_closed_forms(void **state)
{
    (void)state;
    for (int k = 0; k < 9; k++) {
        double n = 1.1 * pow(1.3, k);
        assert_close(oracle_fresnel(1.0, 1.0, n), normal_fresnel(n), 1e-15);
        assert_close(oracle_fresnel(1.0, n, 1.0), normal_fresnel(n), 1e-15);
        assert_close(oracle_fresnel(0.0, 1.0, n), 1.0, 0.0);
        // At Brewster's angle tan θ = n the reflected light is polarised: r_p = 0, and
        // r_s = cos²θ − sin²θ.
        double cosine = 1.0 / sqrt(1.0 + n * n), rs = (1.0 - n * n) / (1.0 + n * n);
        assert_close(oracle_fresnel(cosine, 1.0, n), 0.5 * rs * rs, 1e-14);
        // Beyond the critical angle sin θ = 1/n all light is reflected; below it some is
        // transmitted.
        double critical = asin(1.0 / n);
        assert_close(oracle_fresnel(cos(critical + 1e-9), n, 1.0), 1.0, 0.0);
        assert_true(oracle_fresnel(cos(critical - 1e-6), n, 1.0) < 1.0);
        // Stokes: both sides of an interface have the same reflectance.
        double inside = sqrt(1.0 - (1.0 - 0.3 * 0.3) / (n * n));
        assert_close(oracle_fresnel(0.3, 1.0, n), oracle_fresnel(inside, n, 1.0), 1e-13);
    }
    assert_true(oracle_fresnel(0.0, 1.5, 1.5) == 0.0);
    assert_true(oracle_fresnel(0.7, 1.5, 1.5) == 0.0);
    assert_true(oracle_fresnel(1.0, 1.0, 1.0 + 1e-7) <= 1e-13);
}

static void refraction_keeps_snells_law_and_unit_length(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int k = 0; k < 10000; k++) {
        double n[3], v[3], t[3], r[3];
        random_direction(&seed, n);
        random_direction(&seed, v);
        if (dot(vector_of(n), vector_of(v)) < 0.0)
            vector_store(scaled(vector_of(v), -1.0), v);
        double eta = 0.1 * pow(100.0, random_unit(&seed));
        double sine = length(cross(vector_of(n), vector_of(v)));
        oracle_reflect(n, v, r);
        assert_close(length(vector_of(r)), 1.0, 1e-14);
        assert_close(dot(vector_of(r), vector_of(n)), dot(vector_of(v), vector_of(n)), 1e-14);
        bool passes = oracle_refract(n, v, eta, t);
        if (fabs(eta * sine - 1.0) > 1e-12)
            assert_true(passes == (eta * sine < 1.0));
        if (!passes)
            continue;
        // n × t = η n × d, the vector form of Snell's law.
        vector residual =
            plus(cross(vector_of(n), vector_of(t)), scaled(cross(vector_of(n), vector_of(v)), eta));
        assert_true(length(residual) <= 1e-14 * fmax(1.0, eta));
        assert_close(length(vector_of(t)), 1.0, 1e-12 * fmax(1.0, eta * eta));
        assert_true(dot(vector_of(t), vector_of(n)) <= 0.0);
    }
}

// Adds a large slab between y = −thickness and y = 0, of material 0.
static void add_slab(mesh *m, double thickness)
{
    mesh_add_box(m, (double[]){-50.0, -thickness, -50.0}, (double[]){50.0, 0.0, 50.0}, 0);
}

static void slab_shifts_a_ray_and_keeps_its_direction(void **state)
{
    (void)state;
    mesh m = {0};
    oracle_material materials[2] = {glass_of(1.5, 1.0), oracle_material_default};
    materials[1].unlit = true;
    materials[1].base[0] = 5.0;
    double thickness = 0.7;
    add_slab(&m, thickness);
    // A dark screen under the slab covers x ≥ 2. The visible place of its edge gives the shift.
    const double screen[4][3] = {
        {2.0, -3.0, 9.0}, {90.0, -3.0, 9.0}, {90.0, -3.0, -9.0}, {2.0, -3.0, -9.0}};
    mesh_add_quad(&m, screen, 1);
    for (int k = 0; k < 5; k++) {
        double degrees = 10.0 + 15.0 * k;
        double edge[2]; // start x from which the ray sees the screen's edge: with the slab, without
        for (int without = 0; without < 2; without++) {
            oracle_scene scene = scene_of(&m, materials);
            scene.triangles += without ? 12 : 0;
            scene.triangle_count -= without ? 12 : 0;
            double low = -40.0, high = 20.0;
            for (int step = 0; step < 60; step++) {
                double middle = 0.5 * (low + high);
                oracle_ray ray = falling(degrees, middle, 1.0);
                bool seen = radiance(&scene, &ray, 4).at[0] > 2.0;
                low = seen ? low : middle;
                high = seen ? middle : high;
            }
            edge[without] = high;
        }
        double a = RADIANS(degrees), n = 1.5;
        double shift = thickness * sin(a) * (1.0 - cos(a) / sqrt(n * n - sin(a) * sin(a)));
        assert_close((edge[0] - edge[1]) * cos(a), shift, 1e-12);

        record seen = {.count = 0};
        oracle_scene scene = scene_of(&m, materials);
        scene.triangle_count = 12;
        scene.context = &seen;
        oracle_ray ray = falling(degrees, -3.0, 1.0);
        radiance(&scene, &ray, 2);
        assert_close(angle_between(seen.direction[seen.count - 1], ray.direction), 0.0, 1e-14);
    }
    mesh_free(&m);
}

static void prism_has_its_minimum_deviation(void **state)
{
    (void)state;
    mesh m = {0};
    oracle_material glass = glass_of(1.5, 1.0);
    double h = 0.5 * sqrt(3.0);
    const double corners[3][2] = {{-1.0, -h}, {1.0, -h}, {0.0, h}};
    mesh_add_prism(&m, corners, 5.0, 0);
    double expected = 2.0 * asin(1.5 * 0.5) - RADIANS(60.0), least = INFINITY;
    for (int k = 0; k <= 10000; k++) {
        double degrees = -5.0 + 0.005 * k;
        record seen = {.count = 0};
        oracle_scene scene = scene_of(&m, &glass);
        scene.context = &seen;
        const double a = RADIANS(degrees), target[2] = {-0.5, 0.0};
        oracle_ray ray = {{target[0] - 3.0 * cos(a), target[1] - 3.0 * sin(a), 0.1},
                          {cos(a), sin(a), 0.0}};
        radiance(&scene, &ray, 2);
        // Light through two faces leaves below the entry direction, towards the base.
        const double *out = seen.direction[seen.count - 1];
        if (out[0] > 0.0 && out[1] < ray.direction[1])
            least = fmin(least, angle_between(out, ray.direction));
    }
    print_message("prism: least deviation %.6f degrees\n", least * 180.0 / CHECK_PI);
    assert_close(least * 180.0 / CHECK_PI, 37.181, 1e-3);
    assert_close(least, expected, 1e-7);
    mesh_free(&m);
}

// Mean error of the exit direction of balls about the origin, after a straight path through all
// interfaces. The reference is a closed form of the impact parameter.
static double ball_error(const mesh *m, const oracle_material *materials, int surfaces,
                         double (*deviation)(double impact))
{
    oracle_tree *tree = oracle_tree_create(m->triangles, m->count);
    assert_non_null(tree);
    double sum = 0.0;
    int count = 0;
    for (int k = 0; k < 50; k++) {
        double b = 0.05 + 0.0171 * k;
        record seen = {.count = 0};
        oracle_scene scene = scene_of(m, materials);
        scene.tree = tree;
        scene.context = &seen;
        oracle_ray ray = {{-4.0, b, 0.003}, {1.0, 0.0, 0.0}};
        radiance(&scene, &ray, surfaces);
        double bend = deviation(hypot(b, 0.003));
        sum += fabs(angle_between(seen.direction[seen.count - 1], ray.direction) - fabs(bend));
        count++;
    }
    oracle_tree_free(tree);
    return sum / count;
}

static double solid_ball_deviation(double b)
{
    return 2.0 * (asin(b) - asin(b / 1.5));
}

static void glass_ball_bends_by_its_closed_form(void **state)
{
    (void)state;
    double previous = INFINITY;
    for (int rows = 40; rows <= 160; rows *= 2) {
        mesh m = {0};
        oracle_material glass = glass_of(1.5, 1.0);
        mesh_add_ball(&m, &(mesh_ball){.radius = 1.0, .rows = rows, .smooth = true});
        double error = ball_error(&m, &glass, 2, solid_ball_deviation);
        print_message("ball, %d rows: mean error of direction %.3g\n", rows, error);
        // Smooth normals are exact. The sagitta of the facets leaves h².
        assert_true(error < 2.0 / (rows * rows) && error < previous / 2.5);
        previous = error;
        mesh_free(&m);
    }
}

// Radii 1 and ½, indices 1.5 and 1.2 (HARD_CASES 23). Beyond b = 0.75 the ray misses the inner
// ball.
static double nested_deviation(double b)
{
    double outer = asin(b) - asin(b / 1.5);
    bool inner = b / 1.5 < 0.5 && b / 1.2 < 0.5;
    return 2.0 * (outer + (inner ? asin(b / 1.5 / 0.5) - asin(b / 1.2 / 0.5) : 0.0));
}

static void concentric_balls_bend_by_the_media_inside_them(void **state)
{
    (void)state;
    oracle_material materials[2] = {glass_of(1.5, 1.0), glass_of(1.2, 1.0)};
    mesh m = {0};
    mesh_add_ball(&m, &(mesh_ball){.radius = 1.0, .rows = 160, .smooth = true, .material = 0});
    mesh_add_ball(&m, &(mesh_ball){.radius = 0.5, .rows = 160, .smooth = true, .material = 1});
    oracle_tree *tree = oracle_tree_create(m.triangles, m.count);
    for (int k = 0; k < 15; k++) {
        double b = 0.02 + 0.0371 * k;
        record seen = {.count = 0};
        oracle_scene scene = scene_of(&m, materials);
        scene.tree = tree;
        scene.context = &seen;
        oracle_ray ray = {{-4.0, b, 0.0}, {1.0, 0.0, 0.0}};
        radiance(&scene, &ray, 4);
        double expected = nested_deviation(b);
        double out[3] = {cos(expected), -sin(expected), 0.0};
        assert_close(angle_between(seen.direction[seen.count - 1], out), 0.0, 2e-3);
    }
    oracle_tree_free(tree);
    mesh_free(&m);
}

static void corner_cube_sends_light_back(void **state)
{
    (void)state;
    mesh m = {0};
    oracle_material materials[2] = {blend_of(0.8), oracle_material_default};
    materials[1].metallic = 1.0;
    materials[1].base[0] = materials[1].base[1] = materials[1].base[2] = 0.6;
    mesh_add_quad(&m, (const double[4][3]){{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}}, 0);
    mesh_add_quad(&m, (const double[4][3]){{0, 0, 0}, {0, 9, 0}, {0, 9, 9}, {0, 0, 9}}, 0);
    mesh_add_quad(&m, (const double[4][3]){{0, 0, 0}, {0, 0, 9}, {9, 0, 9}, {9, 0, 0}}, 0);
    uint64_t seed = 7;
    for (int k = 0; k < 300; k++) {
        double metal = k % 2;
        vector d = {
            {-0.4 - random_unit(&seed), -0.4 - random_unit(&seed), -0.4 - random_unit(&seed)}};
        d = unit(d);
        vector target = {{1.0 + random_unit(&seed), 1.0 + random_unit(&seed), 0.0}};
        oracle_ray ray;
        vector_store(d, ray.direction);
        vector_store(minus(target, scaled(d, 2.0)), ray.origin);
        record seen = {.count = 0};
        oracle_scene scene = scene_of(&m, metal > 0.0 ? materials + 1 : materials);
        scene.context = &seen;
        double expected = 0.8 * 0.8 * 0.8;
        for (int axis = 0; axis < 3 && metal > 0.0; axis++)
            expected = (axis ? expected : 1.0) * (0.6 + 0.4 * pow(1.0 - fabs(d.at[axis]), 5.0));
        vector rgb = radiance(&scene, &ray, 4);
        assert_grey(rgb, expected, 1e-14);
        assert_int_equal(seen.count, 1);
        assert_close(length(plus(vector_of(seen.direction[0]), d)), 0.0, 1e-14);
    }
    mesh_free(&m);
}

static void facing_mirrors_give_tint_to_the_n(void **state)
{
    (void)state;
    mesh m = {0};
    oracle_material tinted = oracle_material_default;
    tinted.metallic = 1.0;
    tinted.base[0] = 0.9;
    tinted.base[1] = 0.7;
    tinted.base[2] = 0.5;
    mesh_add_quad(&m, (const double[4][3]){{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}}, 0);
    mesh_add_quad(&m, (const double[4][3]){{-5, 5, 2}, {5, 5, 2}, {5, -5, 2}, {-5, -5, 2}}, 0);
    oracle_scene scene = scene_of(&m, &tinted);
    oracle_ray ray = {{0.3, 0.2, 1.0}, {0.0, 0.0, -1.0}};
    for (int depth = 1; depth <= ORACLE_DEPTH_LIMIT; depth *= 2) {
        oracle_view view = {.depth = depth};
        oracle_report report;
        vector rgb = {{0.0, 0.0, 0.0}};
        oracle_radiance(&scene, &view, &ray, rgb.at, &report);
        for (int i = 0; i < 3; i++)
            assert_close(rgb.at[i], pow(tinted.base[i], depth), 1e-14);
        // The path has exactly the requested depth, and the report includes the truncation.
        assert_int_equal(report.surfaces, depth);
        assert_int_equal(report.deepest, depth);
        assert_int_equal(report.rays, depth);
        assert_close(report.truncated_by_depth, pow(0.9, depth), 1e-14);
        assert_close(report.truncated_by_weight, 0.0, 0.0);
    }
    mesh_free(&m);
}

static void branches_under_the_least_weight_take_the_environment(void **state)
{
    (void)state;
    mesh m = {0};
    oracle_material materials[1] = {blend_of(0.5)};
    mesh_add_quad(&m, (const double[4][3]){{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}}, 0);
    mesh_add_quad(&m, (const double[4][3]){{-5, 5, 2}, {5, 5, 2}, {5, -5, 2}, {-5, -5, 2}}, 0);
    oracle_scene scene = scene_of(&m, materials);
    oracle_ray ray = {{0.3, 0.2, 1.0}, {0.0, 0.0, -1.0}};
    // The comparison is "less than": at exactly ½⁴ the branch continues, slightly above it ends.
    const double least[2] = {0.0625, 0.0626};
    for (int k = 0; k < 2; k++) {
        oracle_view view = {.depth = 64, .min_weight = least[k]};
        oracle_report report;
        vector rgb = {{0.0, 0.0, 0.0}};
        oracle_radiance(&scene, &view, &ray, rgb.at, &report);
        int surfaces = k == 0 ? 5 : 4;
        assert_int_equal(report.surfaces, surfaces);
        assert_close(report.truncated_by_weight, pow(0.5, surfaces), 0.0);
        assert_close(report.truncated_by_depth, 0.0, 0.0);
        assert_grey(rgb, pow(0.5, surfaces), 1e-15);
    }
    mesh_free(&m);
}

// All lossless mixtures of mirror, glass and paint, side by side and nested.
static void white_furnace_stays_at_one(void **state)
{
    (void)state;
    mesh m = {0};
    oracle_material materials[6] = {glass_of(1.5, 1.0),      glass_of(2.4, 1.0),
                                    glass_of(1.33, 0.0),     oracle_material_default,
                                    oracle_material_default, oracle_material_default};
    materials[3].metallic = 1.0;
    materials[4].metallic = 0.3;
    materials[4].transmission = 0.6;
    materials[4].thickness = 1.0;
    materials[5].roughness = 0.5;
    mesh_add_ball(&m, &(mesh_ball){.radius = 1.0, .rows = 16, .smooth = true, .material = 0});
    mesh_add_ball(&m, &(mesh_ball){.radius = 0.4, .rows = 10, .material = 1});
    mesh_add_box(&m, (double[]){1.2, -1.0, -1.0}, (double[]){2.0, 1.0, 1.0}, 2);
    mesh_add_box(&m, (double[]){-2.5, -1.1, -1.0}, (double[]){-1.5, 1.0, 1.0}, 4);
    mesh_add_box(&m, (double[]){-3.0, -2.0, -3.0}, (double[]){0.0, -1.5, 3.0}, 3);
    mesh_add_box(&m, (double[]){0.0, -2.0, -3.0}, (double[]){3.0, -1.5, 3.0}, 5);
    oracle_tree *tree = oracle_tree_create(m.triangles, m.count);
    oracle_scene scene = scene_of(&m, materials);
    scene.tree = tree;
    oracle_view view = {.depth = 64, .min_weight = 1.0 / 256.0};
    uint64_t seed = 3;
    double cut = 0.0;
    for (int k = 0; k < 400; k++) {
        oracle_ray ray = {{6.0 * random_unit(&seed) - 3.0, 5.0, 4.0 * random_unit(&seed) - 2.0},
                          {0.3 * random_unit(&seed), -1.0, 0.3 * random_unit(&seed)}};
        oracle_report report;
        vector rgb = {{0.0, 0.0, 0.0}};
        oracle_radiance(&scene, &view, &ray, rgb.at, &report);
        assert_grey(rgb, 1.0, 1e-12);
        assert_false(report.exhausted);
        cut = fmax(cut, report.truncated_by_weight + report.truncated_by_depth);
    }
    print_message("furnace: at most %.3f of a path's weight truncated\n", cut);
    oracle_tree_free(tree);
    mesh_free(&m);
}

static void absorbing_slab_obeys_beer_and_lambert(void **state)
{
    (void)state;
    mesh m = {0};
    oracle_material glass = glass_of(1.5, 1.0);
    const double attenuation[3] = {0.8, 0.3, 0.0}, base[3] = {1.0, 0.9, 1.0};
    vector_store(vector_of(attenuation), glass.attenuation);
    vector_store(vector_of(base), glass.base);
    glass.attenuation_distance = 0.5;
    add_slab(&m, 0.7);
    for (int k = 0; k < 4; k++) {
        double degrees = 20.0 * k;
        oracle_scene scene = scene_of(&m, &glass);
        scene.radiance = light_below;
        oracle_ray ray = falling(degrees, 0.3, 2.0);
        double sine = sin(RADIANS(degrees)) / 1.5, path = 0.7 / sqrt(1.0 - sine * sine);
        double f = oracle_fresnel(cos(RADIANS(degrees)), 1.0, 1.5);
        for (int i = 0; i < 3; i++) {
            // The straight path, plus all even numbers of internal reflections. The base colour
            // tints both crossings.
            double a = attenuation[i] > 0.0 ? pow(attenuation[i], path / 0.5) : 0.0;
            double once = (1.0 - f) * (1.0 - f) * a * base[i] * base[i];
            double expected = once / (1.0 - f * f * a * a);
            assert_close(radiance(&scene, &ray, 60).at[i], expected, 1e-14);
        }
    }
    mesh_free(&m);
}

static void what_lies_in_glass_is_seen_through_the_glass(void **state)
{
    (void)state;
    mesh m = {0};
    oracle_material materials[2] = {glass_of(1.5, 1.0), oracle_material_default};
    materials[0].attenuation[0] = materials[0].attenuation[1] = materials[0].attenuation[2] = 0.5;
    materials[0].attenuation_distance = 1.0;
    materials[1].unlit = true;
    add_slab(&m, 4.0);
    mesh_add_box(&m, (double[]){-1.0, -3.0, -1.0}, (double[]){1.0, -2.0, 1.0}, 1);
    oracle_scene scene = scene_of(&m, materials);
    scene.radiance = light_below;
    // Two metres of glass halve twice, whatever the end of the segment.
    oracle_ray ray = falling(0.0, 0.3, 2.0);
    assert_grey(radiance(&scene, &ray, 8), 0.96 * 0.25, 1e-14);
    // A ray that starts inside counts as outside until its first surface.
    oracle_ray inside = falling(0.0, 0.3, -1.0);
    assert_grey(radiance(&scene, &inside, 8), 1.0, 0.0);
    mesh_free(&m);
}

static void nested_solids_absorb_one_at_a_time(void **state)
{
    (void)state;
    mesh m = {0};
    oracle_material materials[2] = {glass_of(1.5, 1.0), glass_of(1.5, 1.0)};
    materials[0].attenuation[0] = 0.5;
    materials[1].attenuation[0] = 0.125;
    materials[0].attenuation_distance = materials[1].attenuation_distance = 1.0;
    add_slab(&m, 4.0);
    mesh_add_box(&m, (double[]){-9.0, -2.0, -9.0}, (double[]){9.0, -1.0, 9.0}, 1);
    oracle_scene scene = scene_of(&m, materials);
    scene.radiance = light_below;
    // Equal indices: the inner solid reflects nothing. The path has three metres of the outer solid
    // and one of the inner. Each face of the outer solid reflects 1/25.
    oracle_ray ray = falling(0.0, 0.3, 2.0);
    double straight = 0.125 * 0.125, f = 0.04;
    double expected = (1.0 - f) * (1.0 - f) * straight / (1.0 - f * f * straight * straight);
    assert_close(radiance(&scene, &ray, 60).at[0], expected, 1e-14);
    mesh_free(&m);
}

static void thin_wall_does_not_bend_and_is_alike_from_both_sides(void **state)
{
    (void)state;
    mesh m = {0};
    oracle_material wall = glass_of(1.5, 0.0);
    wall.base[0] = wall.base[1] = wall.base[2] = 0.7;
    wall.attenuation[0] = 0.1; // a thin wall has no inside, so this has no effect
    mesh_add_quad(&m, (const double[4][3]){{-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}}, 0);
    for (int side = 0; side < 2; side++) {
        for (int k = 0; k < 9; k++) {
            double degrees = 10.0 * k;
            record seen = {.count = 0};
            oracle_scene scene = scene_of(&m, &wall);
            scene.context = &seen;
            oracle_ray ray = falling(degrees, -0.3, 1.0);
            ray.origin[1] *= side ? -1.0 : 1.0;
            ray.direction[1] *= side ? -1.0 : 1.0;
            double f = oracle_fresnel(cos(RADIANS(degrees)), 1.0, 1.5);
            assert_grey(radiance(&scene, &ray, 3), f + (1.0 - f) * 0.7, 1e-14);
            assert_int_equal(seen.count, 2);
            assert_close(angle_between(seen.direction[1], ray.direction), 0.0, 1e-15);
        }
    }
    mesh_free(&m);
}

static void camera_at_the_centre_of_a_glass_ball_sees_no_bend(void **state)
{
    (void)state;
    mesh m = {0};
    oracle_material glass = glass_of(1.5, 1.0);
    glass.attenuation[0] = 0.25;
    mesh_add_ball(&m, &(mesh_ball){.radius = 1.0, .rows = 24, .smooth = true});
    uint64_t seed = 11;
    for (int k = 0; k < 500; k++) {
        record seen = {.count = 0};
        oracle_scene scene = scene_of(&m, &glass);
        scene.context = &seen;
        oracle_ray ray = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
        random_direction(&seed, ray.direction);
        glass.attenuation_distance = 1.0;
        oracle_hit hit = oracle_closest_hit(&scene, &ray, -1);
        vector rgb = radiance(&scene, &ray, 1);
        assert_int_equal(seen.count, 2);
        assert_close(angle_between(seen.direction[1], ray.direction), 0.0, 1e-14);
        // Reflected and transmitted light both crossed one segment of glass.
        assert_close(rgb.at[0], pow(0.25, hit.distance), 1e-14);
        assert_close(rgb.at[1], 1.0, 1e-15);
    }
    mesh_free(&m);
}

static void turned_inside_out_glass_is_met_from_within(void **state)
{
    (void)state;
    mesh m = {0};
    oracle_material glass = glass_of(1.5, 1.0);
    add_slab(&m, 1.0);
    oracle_ray ray = falling(50.0, 0.0, 1.0);
    for (int turned = 0; turned < 2; turned++) {
        record seen = {.count = 0};
        oracle_scene scene = scene_of(&m, &glass);
        scene.context = &seen;
        oracle_view view = {.depth = 1};
        oracle_report report;
        vector rgb = {{0.0, 0.0, 0.0}};
        oracle_radiance(&scene, &view, &ray, rgb.at, &report);
        // The critical angle 41.8° applies from inside only, and 50° is beyond it.
        assert_int_equal(report.total_reflections, turned);
        assert_int_equal(seen.count, turned ? 1 : 2);
        double in = asin(sin(RADIANS(50.0)) / 1.5), out[3] = {sin(in), -cos(in), 0.0};
        assert_true((nearest_recorded(&seen, out) < 1e-14) == (turned == 0));
        mesh_turn_inside_out(&m);
    }
    mesh_free(&m);
}

static void a_solid_that_was_not_entered_changes_nothing_when_left(void **state)
{
    (void)state;
    mesh m = {0};
    oracle_material materials[2] = {glass_of(1.5, 1.0), glass_of(2.0, 1.0)};
    // The ray enters glass 0 through a single face and leaves by the back face of glass 1.
    mesh_add_quad(&m, (const double[4][3]){{-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}}, 0);
    mesh_add_quad(&m, (const double[4][3]){{-9, -1, -9}, {9, -1, -9}, {9, -1, 9}, {-9, -1, 9}}, 1);
    record seen = {.count = 0};
    oracle_scene scene = scene_of(&m, materials);
    scene.context = &seen;
    oracle_ray ray = falling(30.0, -0.3, 1.0);
    radiance(&scene, &ray, 2);
    double in = asin(0.5 / 1.5), out[3] = {sin(in), -cos(in), 0.0};
    assert_int_equal(seen.count, 2); // F = 0 at the second surface: no reflected branch
    assert_close(angle_between(seen.direction[1], out), 0.0, 1e-14);
    mesh_free(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fresnel_meets_its_closed_forms),
        cmocka_unit_test(refraction_keeps_snells_law_and_unit_length),
        cmocka_unit_test(slab_shifts_a_ray_and_keeps_its_direction),
        cmocka_unit_test(prism_has_its_minimum_deviation),
        cmocka_unit_test(glass_ball_bends_by_its_closed_form),
        cmocka_unit_test(concentric_balls_bend_by_the_media_inside_them),
        cmocka_unit_test(corner_cube_sends_light_back),
        cmocka_unit_test(facing_mirrors_give_tint_to_the_n),
        cmocka_unit_test(branches_under_the_least_weight_take_the_environment),
        cmocka_unit_test(white_furnace_stays_at_one),
        cmocka_unit_test(absorbing_slab_obeys_beer_and_lambert),
        cmocka_unit_test(what_lies_in_glass_is_seen_through_the_glass),
        cmocka_unit_test(nested_solids_absorb_one_at_a_time),
        cmocka_unit_test(thin_wall_does_not_bend_and_is_alike_from_both_sides),
        cmocka_unit_test(camera_at_the_centre_of_a_glass_ball_sees_no_bend),
        cmocka_unit_test(turned_inside_out_glass_is_met_from_within),
        cmocka_unit_test(a_solid_that_was_not_entered_changes_nothing_when_left),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
