// Tests proofs about the surfaces that paths can meet, against frames with traced paths: no path
// may go deeper than proved, and the pixels must be the same.
#include "selftest/shapes.h"
#include "support/render.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static const double middle[3] = {0, 0, 0};

static double bumpy(const double d[3])
{
    return 1 + 0.1 * sin(9 * d[0]) * sin(7 * d[1] + 1);
}

// A ball with a dent in a few triangles only.
static double dented(const double d[3])
{
    return d[1] > 0.995 ? 0.99 : 1;
}

// A quad from z = −0.4 to 0.4, and from x0 at height y to x1 at height y + tilt.
typedef struct quad {
    double y, x0, x1, tilt;
} quad;

static void add_quad(shape *s, quad q, shape_material material)
{
    const double top = q.y + q.tilt;
    const double corners[4][3] = {
        {q.x0, q.y, 0.4}, {q.x1, top, 0.4}, {q.x1, top, -0.4}, {q.x0, q.y, -0.4}};
    shape_add_quad(s, corners, material);
}

static void one_ball(shape *s)
{
    shape_add_ball(s, &(shape_ball){middle, 0.5, 3, MATERIAL_MIRROR, true, NULL});
}

static void one_flat_ball(shape *s)
{
    shape_add_ball(s, &(shape_ball){middle, 0.5, 1, MATERIAL_MIRROR, false, NULL});
}

static void one_box(shape *s)
{
    const double low[3] = {-0.5, -0.3, -0.4}, high[3] = {0.4, 0.45, 0.3};
    shape_add_box(s, &(shape_box){low, high, 3, MATERIAL_MIRROR, false});
}

static void a_room(shape *s)
{
    const double low[3] = {-0.5, -0.3, -0.4}, high[3] = {0.4, 0.45, 0.3};
    shape_add_box(s, &(shape_box){low, high, 1, MATERIAL_MIRROR, true});
}

static void a_bumpy_ball(shape *s)
{
    shape_add_ball(s, &(shape_ball){middle, 0.5, 4, MATERIAL_MIRROR, true, bumpy});
}

static void a_dented_ball(shape *s)
{
    shape_add_ball(s, &(shape_ball){middle, 0.5, 5, MATERIAL_MIRROR, true, dented});
}

static void two_balls(shape *s)
{
    const double left[3] = {-0.4, 0, 0}, right[3] = {0.4, 0, 0};
    shape_add_ball(s, &(shape_ball){left, 0.3, 3, MATERIAL_MIRROR, true, NULL});
    shape_add_ball(s, &(shape_ball){right, 0.3, 3, MATERIAL_MIRROR, true, NULL});
}

static void on_paint(shape *s) // MATERIAL_TINTED is paint here
{
    shape_add_ball(s, &(shape_ball){middle, 0.4, 3, MATERIAL_MIRROR, true, NULL});
    add_quad(s, (quad){-0.45, -0.6, 0.6, 0}, MATERIAL_TINTED);
}

static void beside_a_mirror(shape *s)
{
    shape_add_ball(s, &(shape_ball){middle, 0.4, 3, MATERIAL_MIRROR, true, NULL});
    add_quad(s, (quad){-0.45, -0.6, 0.6, 0}, MATERIAL_MIRROR);
}

static void paint_alone(shape *s)
{
    shape_add_ball(s, &(shape_ball){middle, 0.4, 3, MATERIAL_TINTED, true, bumpy});
}

static void flat_mirrors(shape *s)
{
    add_quad(s, (quad){0.1, -0.6, -0.1, 0}, MATERIAL_MIRROR);
    add_quad(s, (quad){0.1, 0.1, 0.6, 0}, MATERIAL_MIRROR);
}

static void a_tilted_mirror(shape *s)
{
    add_quad(s, (quad){0.1, -0.6, 0.6, 0.3}, MATERIAL_MIRROR);
}

static void mirrors_at_an_angle(shape *s)
{
    add_quad(s, (quad){-0.1, -0.6, 0, -0.2}, MATERIAL_MIRROR);
    add_quad(s, (quad){-0.3, 0, 0.6, 0.2}, MATERIAL_MIRROR);
}

static void a_mirror_over_paint(shape *s)
{
    add_quad(s, (quad){0.1, -0.6, 0.6, 0.2}, MATERIAL_MIRROR);
    shape_add_ball(s, &(shape_ball){middle, 0.3, 3, MATERIAL_TINTED, true, bumpy});
}

static void a_pane(shape *s) // MATERIAL_CORE is a thin wall here
{
    add_quad(s, (quad){0.1, -0.6, 0.6, 0.3}, MATERIAL_CORE);
}

static void a_bubble(shape *s)
{
    shape_add_ball(s, &(shape_ball){middle, 0.5, 3, MATERIAL_CORE, true, NULL});
}

static void a_glass_ball(shape *s)
{
    shape_add_ball(s, &(shape_ball){middle, 0.5, 3, MATERIAL_GLASS, true, NULL});
}

static void a_pane_before_a_mirror(shape *s) // nearly coplanar
{
    add_quad(s, (quad){0.3, -0.6, 0.6, 0}, MATERIAL_MIRROR);
    add_quad(s, (quad){0.3 + 1e-6, -0.6, 0.6, 0}, MATERIAL_CORE);
}

static void a_pane_beside_a_mirror(shape *s)
{
    add_quad(s, (quad){0.3, -0.6, 0, 0}, MATERIAL_MIRROR);
    add_quad(s, (quad){0.3, 0, 0.6, 0}, MATERIAL_CORE);
}

typedef struct sight_case {
    const char *name;
    void (*build)(shape *s);
    int depth; // depth to be proved; 0: no proof may exist
    bool from_outside;
    // Least number of surfaces of the longest path (of at most 16), if nothing is proved.
    int met;
} sight_case;

static const sight_case cases[] = {
    {"a ball", one_ball, 1, true, 0},
    {"a ball of few flat triangles", one_flat_ball, 1, true, 0},
    {"a box", one_box, 1, true, 0},
    {"a room, whose walls wind inwards", a_room, 0, false, 1},
    {"a bumpy ball", a_bumpy_ball, 0, false, 2},
    {"a ball with a dent", a_dented_ball, 0, false, 1},
    {"two balls", two_balls, 0, false, 3},
    {"a ball on paint", on_paint, 2, true, 0},
    {"a ball on a mirror", beside_a_mirror, 0, false, 3},
    {"paint", paint_alone, 1, false, 0},
    {"mirrors in one plane", flat_mirrors, 1, false, 0},
    {"a tilted mirror", a_tilted_mirror, 1, false, 0},
    {"mirrors at an angle", mirrors_at_an_angle, 0, false, 2},
    {"a mirror over paint", a_mirror_over_paint, 2, false, 0},
    {"a pane", a_pane, 1, false, 0},
    {"a pane before a mirror", a_pane_before_a_mirror, 0, false, 2},
    {"a pane beside a mirror", a_pane_beside_a_mirror, 1, false, 0},
    {"a bubble", a_bubble, 0, false, 2},
    {"a glass ball", a_glass_ball, 0, false, 2},
};
enum { CASES = sizeof cases / sizeof *cases };

static void build(const sight_case *c, glint_scene *scene)
{
    shape s = shape_begin();
    c->build(&s);
    assert_int_equal(shape_end(&s, scene, NULL), GLINT_OK);
    glint_material *paint = &scene->materials[MATERIAL_TINTED];
    paint->metallic = 0;
    paint->roughness = 1;
    scene->materials[MATERIAL_CORE].thickness = 0;
}

static glint_camera camera_at(double x, double y, double z)
{
    const double eye[3] = {x, y, z};
    return shape_camera(eye, middle, 0.9, 0);
}

static void render(const glint_scene *scene, const glint_camera *camera, int depth,
                   test_frame *frame)
{
    glint_scene seen = *scene;
    glint_camera own = *camera;
    seen.cameras = &own;
    seen.camera_count = 1;
    glint_settings settings = test_small_frame(depth);
    settings.texels = GLINT_TEXELS_FLOAT;
    test_render(&seen, test_studio(), NULL, &settings, frame);
}

// Only a single convex glass object is proved to have no hits after exits.
static void glass_on_paint(shape *s)
{
    a_glass_ball(s);
    add_quad(s, (quad){-0.7, -2, 2, 0}, MATERIAL_TINTED);
}

static void two_glass_balls(shape *s)
{
    shape_add_ball(s, &(shape_ball){(double[3]){-0.6, 0, 0}, 0.5, 3, MATERIAL_GLASS, true, NULL});
    shape_add_ball(s, &(shape_ball){(double[3]){0.6, 0, 0}, 0.5, 3, MATERIAL_GLASS, true, NULL});
}

static const struct {
    const char *name;
    void (*build)(shape *s);
    bool escape;
} glasses[] = {
    {"a glass ball", a_glass_ball, true},    {"two of them", two_glass_balls, false},
    {"one on paint", glass_on_paint, false}, {"a mirror ball", one_ball, false},
    {"a bubble", a_bubble, false},
};

// If the proof says that rays leaving glass meet nothing, tracing them must change nothing, bit for
// bit. A fixed depth forces the tracing. Tests eyes outside and inside.
static void exits_escape_as_is_proved(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof glasses / sizeof *glasses; i++) {
        const sight_case c = {.build = glasses[i].build};
        glint_scene scene;
        glint_topology topology;
        build(&c, &scene);
        assert_int_equal(glint_topology_find(&scene, &topology, NULL), GLINT_OK);
        const glint_sight sight = glint_sight_find(&scene, &topology, false);
        assert_int_equal(sight.exits_escape, glasses[i].escape);
        scene.moves = true;
        assert_false(glint_sight_find(&scene, &topology, false).exits_escape);
        scene.moves = false;
        const glint_camera cameras[] = {camera_at(0.4, 0.3, 3), camera_at(0.1, 0, 0.2)};
        for (int k = 0; k < 2; k++) {
            test_frame proved, traced;
            render(&scene, &cameras[k], 0, &proved);
            render(&scene, &cameras[k], GLINT_DEPTH_MAX, &traced);
            assert_int_equal(proved.plan.features[GLINT_FEATURE_CONVEX_SOLID].compiled,
                             glasses[i].escape);
            assert_false(traced.plan.features[GLINT_FEATURE_CONVEX_SOLID].compiled);
            if (glasses[i].escape) {
                assert_int_equal(test_count_different(&proved.image, &traced.image), 0);
                assert_memory_equal(&proved.report.rays, &traced.report.rays,
                                    sizeof traced.report.rays);
                assert_true(proved.report.truncation.by_min_weight <=
                            traced.report.truncation.by_min_weight);
            }
            test_frame_free(&proved);
            test_frame_free(&traced);
        }
        glint_topology_free(&topology);
        glint_scene_free(&scene);
    }
}

static void is_proved_as_it_must_be(void **state)
{
    (void)state;
    for (int i = 0; i < CASES; i++) {
        glint_scene scene;
        build(&cases[i], &scene);
        glint_topology topology;
        assert_int_equal(glint_topology_find(&scene, &topology, NULL), GLINT_OK);
        const glint_sight sight = glint_sight_find(&scene, &topology, false);
        print_message("%-33s %d: %s\n", cases[i].name, sight.depth, sight.reason);
        assert_int_equal(sight.depth, cases[i].depth);
        assert_int_equal(sight.from_outside, cases[i].from_outside);
        assert_true(sight.reason[0] != '\0');
        // Convexity is only examined on request, so the proof must request it.
        assert_true(!sight.from_outside || glint_sight_wants_topology(&scene, false));
        const glint_sight without = glint_sight_find(&scene, &(glint_topology){0}, false);
        assert_int_equal(without.depth, sight.from_outside ? 0 : sight.depth);
        scene.moves = true;
        assert_false(glint_sight_wants_topology(&scene, false));
        assert_false(glint_sight_find(&scene, &topology, false).from_outside);
        glint_topology_free(&topology);
        glint_scene_free(&scene);
    }
}

// Which materials end a path: proofs for a convex ball and for a bumpy ball of each material.
static void materials_end_paths_or_not(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        glint_material material;
        int convex, bumpy;
    } kinds[] = {
        {"metal", {.metallic = 1, .mirror = -1}, 1, 0},
        {"rough metal, which is rendered smooth",
         {.metallic = 1, .roughness = 1, .mirror = -1},
         1,
         0},
        {"partly metal", {.metallic = 0.25F, .roughness = 1, .mirror = -1}, 1, 0},
        {"matte paint", {.roughness = 1, .mirror = -1}, 1, 1},
        {"matte paint that emits", {.roughness = 1, .emission = {1, 1, 1}, .mirror = -1}, 1, 1},
        {"smooth paint", {.mirror = -1}, 1, 0},
        {"unlit metal", {.metallic = 1, .unlit = true, .mirror = -1}, 1, 1},
        {"unlit glass", {.transmission = 1, .thickness = 1, .unlit = true, .mirror = -1}, 1, 1},
        {"the blend, matte alone", {.metallic = 1, .mirror = 0}, 1, 1},
        {"the blend, a little of a mirror", {.roughness = 1, .mirror = 0.01F}, 1, 0},
        {"the blend, of glass", {.transmission = 1, .thickness = 1, .mirror = 0.5F}, 1, 0},
        {"glass", {.transmission = 1, .thickness = 1, .mirror = -1}, 0, 0},
        {"a little of glass",
         {.transmission = 0.01F, .thickness = 1, .roughness = 1, .mirror = -1},
         0,
         0},
        {"a thin wall", {.transmission = 1, .mirror = -1}, 0, 0},
        {"metal that would be glass",
         {.metallic = 1, .transmission = 1, .thickness = 1, .mirror = -1},
         1,
         0},
    };
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        for (int is_bumpy = 0; is_bumpy < 2; is_bumpy++) {
            glint_scene scene;
            glint_topology topology;
            build(&cases[is_bumpy ? 4 : 0], &scene);
            scene.materials[MATERIAL_MIRROR] = kinds[i].material;
            assert_int_equal(glint_topology_find(&scene, &topology, NULL), GLINT_OK);
            const int depth = glint_sight_find(&scene, &topology, false).depth;
            if (depth != (is_bumpy ? kinds[i].bumpy : kinds[i].convex)) {
                fail_msg("%s: depth %d", kinds[i].name, depth);
            }
            glint_topology_free(&topology);
            scene.materials[MATERIAL_MIRROR] = (glint_material){0};
            glint_scene_free(&scene);
        }
    }
}

// From four places, traced paths must not meet more surfaces than proved.
static void no_path_goes_deeper(void **state)
{
    (void)state;
    const glint_camera cameras[] = {camera_at(1.1, 0.9, 1.3), camera_at(-0.2, 1.6, 0.3),
                                    camera_at(0.1, -0.2, 1.9), camera_at(-1.5, 0.05, 0.1)};
    for (int i = 0; i < CASES; i++) {
        const sight_case *c = &cases[i];
        glint_scene scene;
        build(c, &scene);
        uint32_t deepest = 0;
        for (int k = 0; k < 4; k++) {
            test_frame traced, automatic;
            render(&scene, &cameras[k], 16, &traced);
            render(&scene, &cameras[k], 0, &automatic);
            deepest = traced.report.deepest > deepest ? traced.report.deepest : deepest;
            assert_int_equal(automatic.plan.depth_is_exact, c->depth > 0);
            assert_true(c->depth == 0 || traced.report.deepest <= (uint32_t)c->depth);
            assert_true(c->depth == 0 || automatic.report.truncation.by_depth == 0);
            for (size_t p = 0; c->depth > 0 && p < 61 * 43 * 4; p++) {
                // The short way of mirrors rounds differently (test_mirrors.c): at most 1e-4 of 20.
                const double off =
                    (double)traced.image.pixels[p] - (double)automatic.image.pixels[p];
                assert_true(fabs(off) < 2e-3);
            }
            test_frame_free(&traced);
            test_frame_free(&automatic);
        }
        if (c->depth == 0 && deepest < (uint32_t)c->met) {
            fail_msg("%s: no path met more than %u", c->name, deepest);
        }
        glint_scene_free(&scene);
    }
}

// Inside a closed mirror paths never end. The plan for eyes outside must give way, and come back.
static void an_eye_inside_is_noticed(void **state)
{
    (void)state;
    glint_scene scene;
    build(&cases[2], &scene);
    const glint_settings settings = test_small_frame(0);
    const glint_renderer_inputs inputs = {.device = test_device(),
                                          .scene = &scene,
                                          .environment = test_studio(),
                                          .settings = &settings};
    glint_renderer *renderer;
    assert_int_equal(glint_renderer_create(&inputs, &renderer, NULL), GLINT_OK);
    // Cameras outside and inside, and orthographic cameras whose plane cuts the box or does not.
    const glint_camera outside = camera_at(1.1, 0.9, 1.3), inside = camera_at(0.1, 0.1, 0.1);
    const double eye[3] = {0.1, 0.1, 0.1};
    const glint_camera cutting = shape_camera(eye, middle, 0, 0.5);
    const double far_eye[3] = {3, 2, 1};
    const glint_camera parallel = shape_camera(far_eye, middle, 0, 0.5);
    const struct {
        const glint_camera *camera;
        bool goes_on;
    } frames[] = {{&outside, false},
                  {&inside, true},
                  {&outside, false},
                  {&cutting, true},
                  {&parallel, false}};
    glint_image first = {0}, image = {0};
    for (int i = 0; i < 5; i++) {
        glint_frame_report report;
        assert_int_equal(
            glint_renderer_frame(&(glint_frame_request){renderer, frames[i].camera, NULL,
                                                        i == 0 ? &first : &image, &report},
                                 NULL),
            GLINT_OK);
        assert_int_equal(glint_renderer_plan(renderer)->depth_is_exact, !frames[i].goes_on);
        assert_true((report.deepest > 1) == frames[i].goes_on);
        if (i == 2) {
            assert_int_equal(test_count_different(&first, &image), 0);
        }
    }
    glint_image_free(&first);
    glint_image_free(&image);
    glint_renderer_free(renderer);
    glint_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(is_proved_as_it_must_be),    cmocka_unit_test(exits_escape_as_is_proved),
        cmocka_unit_test(materials_end_paths_or_not), cmocka_unit_test(no_path_goes_deeper),
        cmocka_unit_test(an_eye_inside_is_noticed),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
