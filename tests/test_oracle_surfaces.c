// Tests the oracle's textures, vertex colours and alpha against closed forms.
#include "oracle/check.h"

#include <stdlib.h>
#include <string.h>

// ---- Images -------------------------------------------------------------------------------------

static void levels_are_area_means(void **state)
{
    (void)state;
    // A row of 5 texels is halved to 2: each covers 2.5 texels.
    static const double values[5] = {0.0, 1.0, 0.5, 0.25, 0.75};
    static const double alpha[5] = {1.0, 0.0, 0.5, 1.0, 0.0};
    for (int coverage = 0; coverage < 2; coverage++) {
        oracle_image image;
        assert_true(oracle_image_create(5, 1, &image));
        assert_int_equal(image.levels, 3);
        for (int i = 0; i < 5; i++) {
            image.texels[0][i][0] = values[i];
            image.texels[0][i][3] = alpha[i];
        }
        oracle_image_average(&image, coverage);
        assert_close(image.texels[1][0][3], 1.25 / 2.5, 1e-15);
        assert_close(image.texels[1][1][3], 1.25 / 2.5, 1e-15);
        assert_close(image.texels[1][0][0], coverage ? 0.125 / 1.25 : 1.25 / 2.5, 1e-15);
        assert_close(image.texels[1][1][0], coverage ? 0.375 / 1.25 : 1.25 / 2.5, 1e-15);
        assert_close(image.texels[2][0][0], coverage ? 0.2 : 0.5, 1e-15);
        oracle_image_free(&image);
    }
}

typedef struct look_up_case {
    oracle_wrap wrap;
    bool nearest;
    double u, expected;
} look_up_case;

// Magnified look-ups in a row 0, 1, 2, 3.
static void rows_are_wrapped_and_filtered(void **state)
{
    (void)state;
    static const look_up_case cases[] = {
        {ORACLE_REPEAT, false, 0.5, 1.5},      {ORACLE_REPEAT, false, 0.0, 1.5},
        {ORACLE_REPEAT, false, -0.3125, 2.25}, {ORACLE_REPEAT, false, 7.4375, 1.25},
        {ORACLE_CLAMP, false, 0.0, 0.0},       {ORACLE_CLAMP, false, 0.1875, 0.25},
        {ORACLE_CLAMP, false, 1.2, 3.0},       {ORACLE_CLAMP, false, -9.0, 0.0},
        {ORACLE_MIRROR, false, 1.0, 3.0},      {ORACLE_MIRROR, false, 1.1875, 2.75},
        {ORACLE_MIRROR, false, -0.25, 0.5},    {ORACLE_MIRROR, false, 2.25, 0.5},
        {ORACLE_REPEAT, true, 0.26, 1.0},      {ORACLE_REPEAT, true, -0.01, 3.0},
        {ORACLE_MIRROR, true, 1.26, 2.0},      {ORACLE_CLAMP, true, 1.5, 3.0},
    };
    oracle_image image;
    assert_true(oracle_image_create(4, 1, &image));
    for (int i = 0; i < 4; i++)
        image.texels[0][i][0] = i;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const look_up_case *c = &cases[i];
        oracle_texture t = {.image = &image,
                            .wrap = {c->wrap, ORACLE_REPEAT},
                            .magnified_nearest = c->nearest,
                            .minified_nearest = c->nearest,
                            .transform = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}};
        oracle_spot spot = {.at = {c->u, 0.5}, .moved = {{0.0625, 0.0}, {0.0, 0.0}}, .width = 1.0};
        oracle_glance glance = oracle_look_up(&t, &spot);
        assert_close(glance.rgba[0], c->expected, 1e-14);
        if (c->nearest)
            assert_close(glance.jump, fabs(4.0 * c->u - round(4.0 * c->u)) / 0.25, 1e-12);
        else
            assert_true(glance.jump == INFINITY);
    }
    oracle_image_free(&image);
}

// ---- Which level --------------------------------------------------------------------------------

enum { EDGE = 1024 };

// Makes an image of 1024² whose levels hold their own numbers.
static oracle_image numbered_levels(void)
{
    oracle_image image;
    assert_true(oracle_image_create(EDGE, EDGE, &image));
    for (int level = 0; level < image.levels; level++)
        for (int i = 0; i < (EDGE >> level) * (EDGE >> level); i++)
            image.texels[level][i][0] = level;
    return image;
}

// Interpolates linearly between levels of powers of two.
static double level_of(double texels)
{
    double level = floor(log2(texels));
    return level + texels / exp2(level) - 1.0;
}

// A scene whose material 0 is unlit and shows an image, with u = x and v = y of the corners.
typedef struct shown {
    mesh m;
    oracle_image image;
    oracle_corner (*corners)[3];
    oracle_material materials[2];
    oracle_scene scene;
} shown;

static void show(shown *s)
{
    s->image = numbered_levels();
    s->corners = calloc((size_t)s->m.count, sizeof *s->corners);
    assert_non_null(s->corners);
    for (int i = 0; i < s->m.count; i++) {
        for (int k = 0; k < 3; k++) {
            const double *p = s->m.triangles[i].position[k];
            s->corners[i][k] = (oracle_corner){.texcoord = {{p[0], p[1]}, {p[0], p[1]}},
                                               .color = {1.0, 1.0, 1.0, 1.0}};
        }
    }
    s->materials[0] = oracle_material_default;
    s->materials[0].unlit = true;
    s->materials[0].texture[ORACLE_BASE] = (oracle_texture){
        .image = &s->image, .set = 1, .transform = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}};
    s->scene = scene_of(&s->m, s->materials);
    s->scene.corners = (const oracle_corner(*)[3])s->corners;
}

static void stop_showing(shown *s)
{
    oracle_image_free(&s->image);
    free(s->corners);
    mesh_free(&s->m);
}

// A camera at the origin that looks along −z. Pixels are 1/100 wide at distance 1.
static const oracle_view ahead = {.right = {1.0, 0.0, 0.0},
                                  .up = {0.0, 1.0, 0.0},
                                  .back = {0.0, 0.0, 1.0},
                                  .yfov = 0.92729521800161223, // 2 atan ½
                                  .width = 100,
                                  .height = 100,
                                  .depth = 8};

static double seen(const shown *s, const oracle_view *view, double x, double y)
{
    const double at[2] = {x, y};
    double rgba[4];
    oracle_sample(&s->scene, view, at, rgba, NULL);
    return rgba[0];
}

// A plane through (0, 0, −2), straight on and at a slant. The plane turns about y, so u changes
// more slowly along it.
static void slanted_planes_take_the_level_of_the_longer_axis(void **state)
{
    (void)state;
    for (int degrees = 0; degrees < 80; degrees += 11) {
        shown s = {0};
        double c = cos(RADIANS(degrees)), d = sin(RADIANS(degrees));
        const double corners[4][3] = {{-9 * c, -9, -2 - 9 * d},
                                      {9 * c, -9, -2 + 9 * d},
                                      {9 * c, 9, -2 + 9 * d},
                                      {-9 * c, 9, -2 - 9 * d}};
        mesh_add_quad(&s.m, corners, 0);
        show(&s);
        for (int i = 0; i < 4; i++) {
            double slope = (i - 1.5) / 10.0; // slope of the ray in x
            // x = slope·t, z = −t; on the plane z = −2 + x tan.
            double t = 2.0 / (1.0 + slope * tan(RADIANS(degrees)));
            double cosine = fabs(-slope * d - c) / sqrt(1.0 + slope * slope);
            double width = t / 100.0; // the width of a pixel grows along the axis of view
            // Along the plane's slope u is c of the distance; across it v is the whole distance.
            double texels = EDGE * width * fmax(c / cosine, 1.0);
            assert_close(seen(&s, &ahead, 50.0 + 100.0 * slope, 50.0), level_of(texels), 1e-9);
            oracle_view finer = ahead;
            finer.samples = 2;
            assert_close(seen(&s, &finer, 50.0 + 100.0 * slope, 50.0), level_of(texels / 2.0),
                         1e-9);
        }
        stop_showing(&s);
    }
}

// A convex mirror of radius r spreads a pixel like its virtual image: by s + 2w/r.
static void mirror_balls_spread_what_a_pixel_sees(void **state)
{
    (void)state;
    shown s = {0};
    mesh_add_quad(&s.m, (const double[4][3]){{9, -9, 5}, {-9, -9, 5}, {-9, 9, 5}, {9, 9, 5}}, 0);
    mesh_add_ball(&s.m, &(mesh_ball){{0.0, 0.0, -4.0}, 0.5, 400, true, 1});
    show(&s);
    s.materials[1] = oracle_material_default;
    s.materials[1].metallic = 1.0;
    double width = 3.5 / 100.0, spread = 0.01 + 2.0 * width / 0.5;
    // Scale down, so that the pixel does not cover more than all texels.
    s.materials[0].texture[ORACLE_BASE].transform[0][0] = 0.25;
    s.materials[0].texture[ORACLE_BASE].transform[1][1] = 0.25;
    double texels = 0.25 * EDGE * (width + spread * 8.5);
    assert_close(seen(&s, &ahead, 50.01, 50.01), level_of(texels), 1e-3);
    stop_showing(&s);
}

// Behind a slab of glass, objects appear nearer by (1 − 1/n) of its thickness.
static void slabs_bring_what_a_pixel_sees_nearer(void **state)
{
    (void)state;
    shown s = {0};
    mesh_add_quad(&s.m, (const double[4][3]){{-9, -9, -5}, {9, -9, -5}, {9, 9, -5}, {-9, 9, -5}},
                  0);
    mesh_add_box(&s.m, (double[]){-9, -9, -3}, (double[]){9, 9, -1.5}, 1);
    show(&s);
    s.materials[1] = glass_of(1.5, 1.0);
    // Reflected light takes E = 1, and so does the light after a second inner reflection.
    double f = normal_fresnel(1.5), once = (1.0 - f) * (1.0 - f);
    oracle_view view = ahead;
    view.depth = 3;
    s.scene.radiance = light_white;
    double level = level_of(EDGE * (5.0 - 1.5 / 3.0) / 100.0);
    double inside = (1.0 - f) * f;
    assert_close(seen(&s, &view, 50.0, 50.0), f + once * level + inside, 1e-9);
    stop_showing(&s);
}

// ---- Bent normals -------------------------------------------------------------------------------

static void bent_normals_turn_reflections(void **state)
{
    (void)state;
    static const double texel[3] = {0.7, 0.35, 0.9};
    for (int turn = -1; turn < 2; turn++) {
        mesh m = {0};
        const double corners[3][3] = {{-9, 0, 9}, {9, 0, 9}, {0, 0, -9}};
        mesh_add_triangle(&m, corners, 0);
        oracle_image image;
        assert_true(oracle_image_create(1, 1, &image));
        memcpy(image.texels[0][0], texel, sizeof texel);
        oracle_material mirror = oracle_material_default;
        mirror.metallic = 1.0;
        mirror.normal_scale = 0.5;
        mirror.texture[ORACLE_NORMAL].image = &image;
        oracle_corner corner[1][3];
        for (int k = 0; k < 3; k++)
            corner[0][k] = (oracle_corner){.color = {1, 1, 1, 1}, .tangent = {1, 0, 0, turn}};
        record r = {.count = 0};
        oracle_scene scene = scene_of(&m, &mirror);
        scene.corners = (const oracle_corner(*)[3])corner;
        scene.context = &r;
        oracle_view view = {.depth = 1};
        oracle_ray ray = {{0.0, 1.0, 0.0}, {0.0, -1.0, 0.0}};
        double rgb[3];
        oracle_radiance(&scene, &view, &ray, rgb, NULL);
        // Normal +y, tangent +x, bitangent turn × (+y × +x) = −z. Without a side the normal is not
        // bent.
        vector n = {{0.5 * 0.4, 0.8, 0.5 * -0.3 * -turn}};
        n = turn == 0 ? (vector){{0.0, 1.0, 0.0}} : unit(n);
        vector up = {{0.0, 1.0, 0.0}}, out = minus(scaled(n, 2.0 * dot(n, up)), up);
        assert_true(nearest_recorded(&r, out.at) < 1e-12);
        oracle_image_free(&image);
        mesh_free(&m);
    }
}

// The winding alone says which side of a normal is lit: E(n) in front, E(−n) behind, with n as the
// file has it, by however much it leans.
static void the_winding_decides_which_side_is_lit(void **state)
{
    (void)state;
    for (int degrees = 0; degrees <= 180; degrees += 20) {
        mesh m = {0};
        const double corners[3][3] = {{-9, 0, 9}, {9, 0, 9}, {0, 0, -9}};
        mesh_add_triangle(&m, corners, 0);
        vector n = {{sin(RADIANS(degrees)), cos(RADIANS(degrees)), 0.0}};
        for (int k = 0; k < 3; k++)
            vector_store(n, m.triangles[0].normal[k]);
        oracle_material matte = blend_of(0.0);
        matte.base[0] = matte.base[1] = matte.base[2] = 1.0;
        oracle_scene scene = scene_of(&m, &matte);
        scene.irradiance = light_direction_mean;
        oracle_view view = {.depth = 1};
        for (int side = -1; side <= 1; side += 2) {
            oracle_ray ray = {{0.0, side, 0.0}, {0.0, -side, 0.0}};
            double rgb[3];
            oracle_radiance(&scene, &view, &ray, rgb, NULL);
            for (int i = 0; i < 3; i++)
                assert_close(rgb[i], 0.5 + side * n.at[i] / 3.0, 1e-15);
        }
        mesh_free(&m);
    }
}

// ---- High indices -------------------------------------------------------------------------------

// What smooth black paint reflects of E = 1 is F. Between Fresnel's and Schlick's term an index's
// share is linear in its inverse, so the middle of 1/6 and 1/(2 + √3) has half of each.
static void paint_of_high_index_has_schlicks_edge(void **state)
{
    (void)state;
    double a = 1.0 / (2.0 + sqrt(3.0)), middle = 0.5 * (a + 1.0 / 6.0);
    const double iors[] = {1.5, 1.0 / a - 1e-9, 1.0 / middle, 6.0, 50.0, 1e20};
    const double shares[] = {0.0, 0.0, 0.5, 1.0, 1.0, 1.0};
    mesh m = {0};
    mesh_add_quad(&m, (const double[4][3]){{-50, 0, 50}, {50, 0, 50}, {50, 0, -50}, {-50, 0, -50}},
                  0);
    for (int i = 0; i < 6; i++) {
        for (int colored = 0; colored < 2; colored++) {
            oracle_material paint = oracle_material_default;
            paint.base[0] = paint.base[1] = paint.base[2] = 0.0;
            paint.ior = iors[i];
            paint.specular = colored ? 0.75 : 1.0;
            paint.specular_color[0] = colored ? 0.25 : 1.0;
            oracle_scene scene = scene_of(&m, &paint);
            oracle_view view = {.depth = 1};
            for (int degrees = 0; degrees < 90; degrees += 5) {
                double c = cos(RADIANS(degrees)), rgb[3];
                oracle_ray ray = {{0.0, 1.0, 0.0}, {sin(RADIANS(degrees)), -c, 0.0}};
                oracle_radiance(&scene, &view, &ray, rgb, NULL);
                double f0 = normal_fresnel(iors[i]), fifth = pow(1.0 - c, 5.0);
                double f = oracle_fresnel(c, 1.0, iors[i]);
                double w = f0 < 1.0 ? (f - f0) / (1.0 - f0) : 0.0;
                w += shares[i] * (fifth - w);
                double from = colored ? 0.25 * f0 : f0;
                double seen =
                    w < 0.0 ? from * (1.0 + w * (1.0 - f0) / f0) : from + (1.0 - from) * w;
                assert_close(rgb[0], colored ? 0.75 * seen : seen, 1e-9);
            }
        }
    }
    mesh_free(&m);
}

// ---- Coverage -----------------------------------------------------------------------------------

typedef struct cover_case {
    oracle_alpha mode;
    double factor, vertices, cutoff, expected;
} cover_case;

// Two planes, the first partly transparent. An unlit surface shows its share, also at depth 1, and
// the rest shows the surface behind. Without the second plane, alpha is lower by the rest.
static void what_is_there_in_part_lets_light_pass(void **state)
{
    (void)state;
    static const cover_case cases[] = {
        {ORACLE_OPAQUE, 0.25, 0.5, 0.5, 1.0}, {ORACLE_BLEND, 0.5, 0.5, 0.5, 0.25},
        {ORACLE_BLEND, 0.0, 1.0, 0.5, 0.0},   {ORACLE_MASK, 1.0, 0.5, 0.5, 1.0},
        {ORACLE_MASK, 0.9, 0.5, 0.5, 0.0},    {ORACLE_MASK, 1.0, 1.0, 1.5, 0.0},
        {ORACLE_MASK, 0.25, 1.0, 0.125, 1.0},
    };
    mesh m = {0};
    mesh_add_quad(&m, (const double[4][3]){{-9, -9, -2}, {9, -9, -2}, {9, 9, -2}, {-9, 9, -2}}, 0);
    mesh_add_quad(&m, (const double[4][3]){{-9, -9, -3}, {9, -9, -3}, {9, 9, -3}, {-9, 9, -3}}, 1);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const cover_case *c = &cases[i];
        oracle_material materials[2] = {oracle_material_default, oracle_material_default};
        materials[0].unlit = materials[1].unlit = true;
        materials[0].alpha_mode = c->mode;
        materials[0].alpha = c->factor;
        materials[0].alpha_cutoff = c->cutoff;
        materials[1].base[0] = 0.25;
        oracle_corner corners[4][3];
        for (int k = 0; k < 12; k++)
            corners[k / 3][k % 3] = (oracle_corner){.color = {0.5, 1, 1, c->vertices}};
        oracle_scene scene = scene_of(&m, materials);
        scene.corners = (const oracle_corner(*)[3])corners;
        oracle_view view = ahead;
        view.depth = 1;
        view.transparent = true;
        for (int behind = 0; behind < 2; behind++) {
            double rgba[4];
            oracle_report report;
            scene.triangle_count = behind ? 4 : 2;
            oracle_pixel(&scene, &view, (int[]){40, 50}, rgba, &report);
            double rest = 1.0 - c->expected;
            assert_close(rgba[0], 0.5 * c->expected + (behind ? 0.125 * rest : 0.0), 1e-15);
            assert_close(rgba[3], behind ? 1.0 : c->expected, 1e-15);
            assert_int_equal(report.deepest, c->expected > 0.0 || behind ? 1 : 0);
        }
    }
    mesh_free(&m);
}

// Alpha does not apply to solids. A partly transparent thin wall counts as a surface, so at depth 1
// the light through it takes the environment.
static void glass_counts_where_it_is_there(void **state)
{
    (void)state;
    mesh m = {0};
    mesh_add_box(&m, (double[]){-9, -9, -4}, (double[]){9, 9, -2}, 0);
    mesh_add_quad(&m, (const double[4][3]){{-9, -9, -5}, {9, -9, -5}, {9, 9, -5}, {-9, 9, -5}}, 1);
    for (int thickness = 0; thickness < 2; thickness++) {
        for (int alpha = 0; alpha < 2; alpha++) {
            oracle_material materials[2] = {glass_of(1.5, thickness), oracle_material_default};
            materials[0].alpha_mode = ORACLE_BLEND;
            materials[0].alpha = 0.5 * alpha;
            materials[1].unlit = true;
            materials[1].base[0] = 7.0;
            oracle_scene scene = scene_of(&m, materials);
            oracle_view view = ahead;
            view.depth = 1;
            double rgba[4];
            oracle_pixel(&scene, &view, (int[]){40, 50}, rgba, NULL);
            assert_close(rgba[0], thickness == 0 && alpha == 0 ? 7.0 : 1.0, 1e-14);
        }
    }
    mesh_free(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(levels_are_area_means),
        cmocka_unit_test(rows_are_wrapped_and_filtered),
        cmocka_unit_test(slanted_planes_take_the_level_of_the_longer_axis),
        cmocka_unit_test(mirror_balls_spread_what_a_pixel_sees),
        cmocka_unit_test(slabs_bring_what_a_pixel_sees_nearer),
        cmocka_unit_test(bent_normals_turn_reflections),
        cmocka_unit_test(the_winding_decides_which_side_is_lit),
        cmocka_unit_test(paint_of_high_index_has_schlicks_edge),
        cmocka_unit_test(what_is_there_in_part_lets_light_pass),
        cmocka_unit_test(glass_counts_where_it_is_there),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
