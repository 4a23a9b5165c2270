// Tests an environment on the walls of a room (--proxy). Mirrors anywhere in the room must show the
// part of the wall that they see, which is known in closed form. The environment shows the room
// from one place. Where the proxy is not the room's shape, mirrors in other places differ a lot.
#include "support/bridge.h"
#include "support/render.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { EDGE = 512 };

// Walls with waves of three metres: a smooth function of the place in space.
static double wall(const double p[3], int channel)
{
    return 0.5 + 0.4 * sin(2.1 * p[channel] + channel) * cos(1.3 * p[(channel + 1) % 3]);
}

// The point where the ray o + t d, t > from, leaves the room. False if it never meets the room.
static bool leave(const glint_proxy *room, const double o[3], const double d[3], double from,
                  double p[3])
{
    const double middle[3] = {room->middle.x, room->middle.y, room->middle.z};
    const double half[3] = {room->half_extent.x, room->half_extent.y, room->half_extent.z};
    double t = INFINITY;
    if (room->kind == GLINT_PROXY_SPHERE) {
        double a = 0, b = 0, c = -half[0] * half[0];
        for (int k = 0; k < 3; k++) {
            a += d[k] * d[k];
            b += d[k] * (o[k] - middle[k]);
            c += (o[k] - middle[k]) * (o[k] - middle[k]);
        }
        t = b * b < a * c ? -INFINITY : (sqrt(b * b - a * c) - b) / a;
    } else {
        double enters = -INFINITY;
        for (int k = 0; k < 3; k++) {
            if (d[k] == 0) {
                t = fabs(o[k] - middle[k]) > half[k] ? -INFINITY : t;
                continue;
            }
            const double one = (middle[k] - half[k] - o[k]) / d[k];
            const double other = (middle[k] + half[k] - o[k]) / d[k];
            t = fmin(t, fmax(one, other));
            enters = fmax(enters, fmin(one, other));
        }
        t = enters < t ? t : -INFINITY;
    }
    for (int k = 0; k < 3; k++) {
        p[k] = o[k] + t * d[k];
    }
    return t > from;
}

// The distance of a place on the walls to the nearest corner of the room, where look-ups have a
// kink.
static double distance_to_edge(const glint_proxy *room, const double p[3])
{
    const double middle[3] = {room->middle.x, room->middle.y, room->middle.z};
    const double half[3] = {room->half_extent.x, room->half_extent.y, room->half_extent.z};
    double least = INFINITY, next = INFINITY;
    for (int k = 0; k < 3; k++) {
        const double away = fabs(half[k] - fabs(p[k] - middle[k]));
        next = fmin(next, fmax(least, away));
        least = fmin(least, away);
    }
    return room->kind == GLINT_PROXY_SPHERE ? INFINITY : next;
}

// Draws the view from the room's centre into a map. The device will rotate the map by `turned`
// radians.
static void look_around(const glint_proxy *room, double turned, glint_environment *environment)
{
    *environment = (glint_environment){.proxy = *room};
    glint_cube *cube = &environment->radiance;
    assert_int_equal(glint_cube_create(EDGE, cube, NULL), GLINT_OK);
    const double center[3] = {room->center.x, room->center.y, room->center.z};
    for (int face = 0; face < 6; face++) {
        for (int j = 0; j < EDGE; j++) {
            for (int i = 0; i < EDGE; i++) {
                const glint_vec3 d =
                    glint_cube_direction(face, (2.0 * i + 1) / EDGE - 1, (2.0 * j + 1) / EDGE - 1);
                const double direction[3] = {d.x * cos(turned) + d.z * sin(turned), d.y,
                                             d.z * cos(turned) - d.x * sin(turned)};
                double p[3];
                assert_true(leave(room, center, direction, 0, p));
                for (int k = 0; k < 3; k++) {
                    glint_cube_texel(cube, face, i, j)[k] = (float)wall(p, k);
                }
            }
        }
    }
    glint_cube_fill_border(cube);
}

// ---- Expected views ----------------------------------------------------------------------------

typedef struct sight {
    double rgb[3];
    double to_edge; // distance to a corner of the room
    bool meets_room;
    bool is_folded; // a direction was folded at its surface
} sight;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// The plane's normal and the interpolated vertex normal at a hit, of any length. Without vertex
// normals both are the plane's.
static void normals_at(const oracle_triangle *t, const oracle_hit *hit, double plane[3],
                       double n[3])
{
    const double(*p)[3] = t->position;
    for (int k = 0; k < 3; k++) {
        const int l = (k + 1) % 3, m = (k + 2) % 3;
        plane[k] =
            (p[1][l] - p[0][l]) * (p[2][m] - p[0][m]) - (p[1][m] - p[0][m]) * (p[2][l] - p[0][l]);
        n[k] = 0;
        for (int v = 0; v < 3; v++) {
            n[k] += hit->barycentric[v] * t->normal[v][k];
        }
    }
    if (dot(n, n) == 0) {
        memcpy(n, plane, 3 * sizeof *n);
    }
}

// Follows a ray to the walls, over white mirrors, or through glass if `ior` is not 0, with at most
// `depth` surfaces. `scene` is in metres.
static sight follow(const oracle_scene *scene, const glint_proxy *room, oracle_ray ray, double ior,
                    int depth)
{
    sight s = {.to_edge = INFINITY};
    int left = -1;
    for (int met = 0; met < depth; met++) {
        const oracle_hit hit = oracle_closest_hit(scene, &ray, left);
        if (hit.triangle < 0) {
            break;
        }
        const oracle_triangle *t = &scene->triangles[hit.triangle];
        double n[3], plane[3], back[3];
        normals_at(t, &hit, plane, n);
        for (int k = 0; k < 3; k++) {
            ray.origin[k] += hit.distance * ray.direction[k];
            back[k] = -ray.direction[k];
        }
        const double length = (dot(n, back) < 0 ? -1 : 1) * sqrt(dot(n, n));
        for (int k = 0; k < 3; k++) {
            n[k] /= length;
        }
        const double side = dot(back, plane);
        if (ior == 0) {
            oracle_reflect(n, back, ray.direction);
            s.is_folded = s.is_folded || side * dot(ray.direction, plane) <= 0;
        } else {
            s.is_folded = !oracle_refract(n, back, side > 0 ? 1 / ior : ior, ray.direction) ||
                          s.is_folded || side * dot(ray.direction, plane) >= 0;
        }
        left = hit.triangle;
    }
    const double center[3] = {room->center.x, room->center.y, room->center.z};
    double p[3];
    s.meets_room = leave(room, ray.origin, ray.direction, 0, p);
    if (!s.meets_room) { // as seen from the environment's own place
        leave(room, center, ray.direction, 0, p);
    }
    s.to_edge = distance_to_edge(room, p);
    for (int k = 0; k < 3; k++) {
        s.rgb[k] = wall(p, k);
    }
    return s;
}

// Bilinear look-ups err by h²/8 of second derivatives in each of two directions, h = 2/EDGE. The
// waves have at most 0.4 · 2.1², times the square of the distance to the wall. The wall is less
// than 5 m away, at up to 60 degrees: 2 · 2e-6 · 1.8 · (10)². Where walls meet, a texel changes the
// slope: h · 0.9 · 10.
#define SMOOTH_ERROR 8e-4
#define BENT_ERROR 3.6e-2
#define NEAR_EDGE 0.06 // metres; a texel is at most 0.04 there

typedef struct room_case {
    const char *name, *scene;
    glint_proxy room;
    glint_vec3 eye; // the camera looks at the origin
    bool in_parallel;
    int depth;
    double ior;     // of glass without reflection; 0: mirrors
    double degrees; // rotation of the environment
    double in_room; // least share of pixels that show the room
} room_case;

#define BOX(x, y, z)                                                                               \
    {                                                                                              \
        GLINT_PROXY_BOX, {x, y, z}, {-0.25, 0.25, 0.2},                                            \
        {                                                                                          \
            2.25, 1.95, 3.2                                                                        \
        }                                                                                          \
    }
#define BALL(x, y, z)                                                                              \
    {                                                                                              \
        GLINT_PROXY_SPHERE, {x, y, z}, {0.2, 0.1, -0.3},                                           \
        {                                                                                          \
            3.5, 3.5, 3.5                                                                          \
        }                                                                                          \
    }

static const room_case cases[] = {
    {"a box", "mirror_sphere", BOX(0.3, 0.4, -0.2), {0.7, 0.5, 2.9}, false, 1, 0, 0, 1},
    {"a box, from outside", "mirror_sphere", BOX(0.3, 0.4, -0.2), {1, 2, 7}, false, 1, 0, 0, 0.4},
    {"a box, in parallel", "mirror_sphere", BOX(-1, 1, 2), {2, 1, 6}, true, 1, 0, 0, 0.9},
    {"a sphere", "mirror_sphere", BALL(0.5, -0.4, 0.6), {0.7, 0.5, 2.9}, false, 1, 0, 0, 1},
    {"a sphere, from outside",
     "mirror_sphere",
     BALL(0.5, -0.4, 0.6),
     {1, 2, 9},
     false,
     1,
     0,
     0,
     0.25},
    {"mirrors in a box", "facing_mirrors", BOX(0.3, 0.4, -0.2), {0.3, 0.5, 2.5}, false, 8, 0, 0, 1},
    {"mirrors in a sphere",
     "facing_mirrors",
     BALL(0.5, -0.4, 0.6),
     {0.3, 0.5, 2.5},
     false,
     8,
     0,
     0,
     1},
    {"a box that is turned",
     "mirror_sphere",
     BOX(0.3, 0.4, -0.2),
     {0.7, 0.5, 2.9},
     false,
     1,
     0,
     50,
     1},
    {"glass in a box", "mirror_sphere", BOX(0.3, 0.4, -0.2), {0.7, 0.5, 2.9}, false, 2, 1.5, 0, 1},
    {"glass in a sphere that is turned",
     "mirror_sphere",
     BALL(0.5, -0.4, 0.6),
     {0.7, 0.5, 2.9},
     false,
     2,
     1.3,
     -75,
     1},
};
enum { CASES = sizeof cases / sizeof *cases };

static void look_from(const room_case *c, glint_scene *scene)
{
    glint_camera *camera = &scene->cameras[0];
    camera->eye = c->eye;
    camera->back = glint_vec3_normalize(c->eye);
    camera->right = glint_vec3_normalize(glint_vec3_cross((glint_vec3){0, 1, 0}, camera->back));
    camera->up = glint_vec3_cross(camera->back, camera->right);
    camera->yfov = 1;
    camera->orthographic = c->in_parallel;
    camera->ymag = 1.5;
    for (size_t i = 0; i < scene->material_count; i++) {
        scene->materials[i].metallic = c->ior == 0;
        scene->materials[i].transmission = 1;
        scene->materials[i].thickness = 1;
        scene->materials[i].ior = c->ior == 0 ? 1.5F : (float)c->ior;
        scene->materials[i].mirror = -1;
        for (int k = 0; k < 3; k++) {
            scene->materials[i].base_color[k] = 1;
        }
    }
}

static glint_settings frame_of(const room_case *c)
{
    glint_settings settings = test_small_frame(c->depth);
    settings.texels = GLINT_TEXELS_FLOAT;
    settings.proxy = true;
    settings.min_weight = 0;
    settings.fresnel = GLINT_FRESNEL_NONE;
    settings.env_rotate = c->degrees;
    return settings;
}

typedef struct outcome {
    double largest, largest_bent; // differences
    int in_room, at_edges;
} outcome;

static outcome compare(const room_case *c, const glint_settings *settings)
{
    glint_scene scene = {0};
    glint_environment environment;
    test_scene_load(c->scene, &scene);
    look_from(c, &scene);
    look_around(&c->room, c->degrees * GLINT_PI / 180, &environment);
    test_frame frame;
    test_render(&scene, &environment, NULL, settings, &frame);
    bridge *b = bridge_create(&scene, &environment);
    oracle_view view = bridge_view(&scene.cameras[0], settings);
    outcome o = {0};
    for (int i = 0; i < settings->width * settings->height; i++) {
        const int pixel[2] = {i % settings->width, i / settings->width};
        const double at[2] = {pixel[0] + 0.5, pixel[1] + 0.5};
        oracle_report report;
        double rgba[4];
        oracle_pixel(bridge_scene(b), &view, pixel, rgba, &report);
        // Skip pixels near edges, and folded directions.
        if (report.edge < 1e-5) {
            o.at_edges++;
            continue;
        }
        const sight s =
            follow(bridge_scene(b), &c->room, oracle_primary_ray(&view, at), c->ior, c->depth);
        if (s.is_folded) {
            o.at_edges++;
            continue;
        }
        // Compare with the wall that the path sees.
        double *largest = s.to_edge < NEAR_EDGE ? &o.largest_bent : &o.largest;
        o.in_room += s.meets_room;
        for (int k = 0; k < 3; k++) {
            const double difference = fabs((double)frame.image.pixels[4 * i + k] - s.rgb[k]);
            *largest = fmax(*largest, isnan(difference) ? INFINITY : difference);
        }
    }
    bridge_free(b);
    test_frame_free(&frame);
    glint_environment_free(&environment);
    glint_scene_free(&scene);
    return o;
}

static void a_room_is_seen_from_everywhere_in_it(void **state)
{
    (void)state;
    for (int i = 0; i < CASES; i++) {
        const room_case *c = &cases[i];
        glint_settings settings = frame_of(c);
        const outcome o = compare(c, &settings);
        settings.proxy = false;
        const outcome far = compare(c, &settings);
        print_message("%-32s off by %.2g, where walls meet %.2g; %d in the room, %d at edges; "
                      "infinitely far away by %.2g\n",
                      c->name, o.largest, o.largest_bent, o.in_room, o.at_edges, far.largest);
        assert_true(o.largest < SMOOTH_ERROR && o.largest_bent < BENT_ERROR);
        assert_true(o.in_room + o.at_edges >= c->in_room * settings.width * settings.height);
        assert_true(o.at_edges < settings.width * settings.height / 20);
        assert_true(far.largest > 0.2);
    }
}

static void it_is_the_same_at_every_width_and_precision(void **state)
{
    (void)state;
    for (int i = 5; i < CASES; i++) {
        glint_scene scene = {0};
        glint_environment environment;
        test_scene_load(cases[i].scene, &scene);
        look_from(&cases[i], &scene);
        look_around(&cases[i].room, cases[i].degrees * GLINT_PI / 180, &environment);
        glint_settings settings = frame_of(&cases[i]);
        settings.samples_per_axis = 2;
        settings.kernel_width = 1;
        test_frame one, more;
        test_render(&scene, &environment, NULL, &settings, &one);
        for (int width = 8; width <= 16; width += 8) {
            settings.kernel_width = width;
            test_render(&scene, &environment, NULL, &settings, &more);
            assert_int_equal(test_count_different(&one.image, &more.image), 0);
            test_frame_free(&more);
        }
        test_frame_free(&one);
        glint_environment_free(&environment);
        glint_scene_free(&scene);
    }
    glint_settings settings = frame_of(&cases[0]);
    settings.precision = GLINT_PRECISION_DOUBLE;
    assert_true(compare(&cases[0], &settings).largest < SMOOTH_ERROR);
}

static void without_a_proxy_none_can_be_heeded(void **state)
{
    (void)state;
    glint_scene scene = {0};
    glint_environment environment;
    test_scene_load("mirror_sphere", &scene);
    bridge_direction_environment(16, &environment);
    const glint_settings settings = frame_of(&cases[0]);
    const glint_renderer_inputs inputs = {.device = test_device(),
                                          .scene = &scene,
                                          .environment = &environment,
                                          .settings = &settings};
    glint_renderer *renderer;
    glint_error error = {0};
    assert_int_equal(glint_renderer_create(&inputs, &renderer, &error), GLINT_USAGE);
    assert_non_null(strstr(error.message, "no proxy"));
    glint_environment_free(&environment);
    glint_scene_free(&scene);
}

static void what_is_no_point_has_none(void **state)
{
    (void)state;
    const glint_scene nothing = {0};
    for (int i = 0; i < 3; i++) {
        glint_settings settings = frame_of(&cases[0]);
        settings.filter = i == 0 ? GLINT_FILTER_MIP : GLINT_FILTER_BILINEAR;
        settings.terms = i == 1 ? 4 : 0;
        settings.shading = i == 2 ? GLINT_SHADING_VERTEX_COLOR : GLINT_SHADING_PIXEL;
        const glint_plan_inputs inputs = {.scene = &nothing,
                                          .device = glint_device_capabilities(test_device()),
                                          .settings = &settings};
        glint_error error = {0};
        assert_int_equal(glint_settings_check(inputs.settings, inputs.device, inputs.scene, &error),
                         GLINT_USAGE);
        assert_non_null(strstr(error.message, "--proxy"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_room_is_seen_from_everywhere_in_it),
        cmocka_unit_test(it_is_the_same_at_every_width_and_precision),
        cmocka_unit_test(without_a_proxy_none_can_be_heeded),
        cmocka_unit_test(what_is_no_point_has_none),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
