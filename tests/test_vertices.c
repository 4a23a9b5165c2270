// Tests shading at vertices against the oracle. The oracle shades a vertex by a ray from the eye
// through it, onto a small plane of its own. The test interpolates the results between the corners
// of the triangle that a pixel sees.
#include "environment/irradiance.h"
#include "render/plan_make.h"
#include "scene/shape/icosphere.h"
#include "support/bridge.h"
#include "support/by_corner.h"
#include "support/render.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// ---- Colours of vertices -----------------------------------------------------------------------

// A look-up of the oracle: the radiance along a direction, or the irradiance about it.
typedef struct look_up {
    double direction[3], weight[3];
    bool is_irradiance, is_ahead; // ahead: on the side of the surface away from the viewer
} look_up;

enum { LOOK_UPS = 4 };

typedef struct vertex_light {
    bool is_away;      // the viewer sees its back
    double color[3];   // colour with the environment
    double emitted[3]; // colour without the environment
    look_up look_ups[LOOK_UPS];
    int count;
} vertex_light;

// Replaces the environment. It records the look-ups, answers 1 to one of them and 0 to the others.
// The oracle's result is then the weight of this look-up.
typedef struct listener {
    vertex_light *light;
    int asked, answered; // −1: none
} listener;

static void answer(listener *l, const double direction[3], bool is_irradiance, double rgb[3])
{
    assert_true(l->asked < LOOK_UPS);
    look_up *found = &l->light->look_ups[l->asked];
    memcpy(found->direction, direction, sizeof found->direction);
    found->is_irradiance = is_irradiance;
    rgb[0] = rgb[1] = rgb[2] = l->asked == l->answered ? 1 : 0;
    l->asked++;
}

static void listen_radiance(const void *context, const double direction[3], double rgb[3])
{
    answer(*(listener *const *)context, direction, false, rgb);
}

static void listen_irradiance(const void *context, const double direction[3], double rgb[3])
{
    answer(*(listener *const *)context, direction, true, rgb);
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

// A large triangle around `place` with the normal n.
static oracle_triangle facing(const double place[3], const double n[3], double size, int material)
{
    oracle_triangle t = {.material = material};
    const double any[3] = {fabs(n[0]) < 0.5, fabs(n[0]) >= 0.5, 0};
    double u[3], v[3];
    cross(n, any, u);
    const double length = sqrt(dot(u, u));
    for (int k = 0; k < 3; k++) {
        u[k] /= length;
    }
    cross(n, u, v);
    for (int corner = 0; corner < 3; corner++) {
        const double angle = 2 * 3.14159265358979323846 * corner / 3;
        for (int k = 0; k < 3; k++) {
            t.position[corner][k] = place[k] + size * (cos(angle) * u[k] + sin(angle) * v[k]);
            t.normal[corner][k] = n[k];
        }
    }
    return t;
}

// The ray to a place, from the eye or, for parallel rays, from the image plane.
static oracle_ray ray_to(const oracle_view *view, const double place[3])
{
    oracle_ray ray;
    double back = 0;
    for (int k = 0; k < 3; k++) {
        back += (place[k] - view->eye[k]) * view->back[k];
    }
    for (int k = 0; k < 3; k++) {
        ray.origin[k] = view->yfov > 0 ? view->eye[k] : place[k] - back * view->back[k];
        ray.direction[k] = view->yfov > 0 ? place[k] - view->eye[k] : -view->back[k];
    }
    return ray;
}

static void plane_of(const oracle_triangle *t, double plane[3])
{
    double a[3], b[3];
    for (int k = 0; k < 3; k++) {
        a[k] = t->position[1][k] - t->position[0][k];
        b[k] = t->position[2][k] - t->position[0][k];
    }
    cross(a, b, plane);
}

// The normal at a corner of a triangle, on the side where the triangle is counter-clockwise. Uses
// vertex normals if all three exist.
static void corner_normal(const oracle_triangle *t, int corner, double n[3])
{
    double plane[3];
    plane_of(t, plane);
    bool given = true;
    for (int v = 0; v < 3; v++) {
        given = given && dot(t->normal[v], t->normal[v]) > 0;
    }
    const double *from = given ? t->normal[corner] : plane;
    const double sign = dot(from, plane) < 0 ? -1 : 1;
    const double length = sqrt(dot(from, from));
    for (int k = 0; k < 3; k++) {
        n[k] = sign * from[k] / length;
    }
}

static vertex_light light_at(const oracle_scene *all, const oracle_view *view,
                             const oracle_triangle *t, int corner)
{
    vertex_light light = {.count = 0};
    double n[3], plane[3];
    corner_normal(t, corner, n);
    plane_of(t, plane);
    const oracle_ray ray = ray_to(view, t->position[corner]);
    light.is_away = dot(n, ray.direction) * dot(plane, ray.direction) < 0;
    double far = 0;
    for (int k = 0; k < 3; k++) {
        far = fmax(far, fabs(ray.direction[k]));
    }
    // Make a scene of one triangle around the corner.
    const oracle_triangle one = facing(t->position[corner], n, fmax(1, far), t->material);
    oracle_scene scene = *all;
    scene.triangles = &one;
    scene.triangle_count = 1;
    scene.tree = NULL;
    oracle_view first_hit = *view;
    first_hit.depth = 1;
    first_hit.min_weight = 0;
    first_hit.edges = false;
    // Trace it with the environment, then with the listener.
    oracle_radiance(&scene, &first_hit, &ray, light.color, NULL);
    listener ear = {.light = &light, .answered = -1};
    struct listener *context = &ear;
    scene.context = &context;
    scene.environment_rotation = 0; // directions are recorded in the world's axes
    scene.radiance = listen_radiance;
    scene.irradiance = listen_irradiance;
    oracle_radiance(&scene, &first_hit, &ray, light.emitted, NULL);
    light.count = ear.asked;
    // Find the weight of each look-up.
    for (int i = 0; i < light.count; i++) {
        look_up *l = &light.look_ups[i];
        ear.asked = 0;
        ear.answered = i;
        oracle_radiance(&scene, &first_hit, &ray, l->weight, NULL);
        for (int k = 0; k < 3; k++) {
            l->weight[k] -= light.emitted[k];
        }
        const double side = dot(l->direction, n), viewer = -dot(ray.direction, n);
        l->is_ahead = !l->is_irradiance && (side > 0) != (viewer > 0);
    }
    return light;
}

// ---- Colours of pixels -------------------------------------------------------------------------

// Adds the light of one kind of look-up at all corners: radiance on the viewer's side of the
// surface (0), radiance on the other side (1), irradiance (2). Returns false if only some corners
// make this look-up: the interpolated direction is then undefined.
static bool add_look_up(const oracle_scene *scene, const vertex_light lights[3],
                        const double weights[3], int kind, double rgb[3])
{
    const bool is_ahead = kind == 1, is_irradiance = kind == 2;
    double direction[3] = {0}, weight[3] = {0}, light[3] = {0};
    int corners = 0;
    for (int v = 0; v < 3; v++) {
        for (int i = 0; i < lights[v].count; i++) {
            const look_up *l = &lights[v].look_ups[i];
            if (l->is_irradiance != is_irradiance || l->is_ahead != is_ahead) {
                continue;
            }
            corners++;
            for (int k = 0; k < 3; k++) {
                direction[k] += weights[v] * l->direction[k];
                weight[k] += weights[v] * l->weight[k];
            }
        }
    }
    if (corners == 3) {
        const double length = sqrt(dot(direction, direction));
        for (int k = 0; k < 3; k++) {
            direction[k] /= length;
        }
        // To rotate the environment about +Y, rotate the direction backwards.
        const double angle = scene->environment_rotation * 3.14159265358979323846 / 180;
        const double turned[3] = {cos(angle) * direction[0] - sin(angle) * direction[2],
                                  direction[1],
                                  sin(angle) * direction[0] + cos(angle) * direction[2]};
        (is_irradiance ? scene->irradiance : scene->radiance)(scene->context, turned, light);
        for (int k = 0; k < 3; k++) {
            rgb[k] += weight[k] * light[k];
        }
    }
    return corners == 3 || corners == 0;
}

typedef struct setting {
    glint_scene scene;
    glint_environment environment;
    glint_cube irradiance;
    bridge *bridge;
    oracle_scene oracle;
} setting;

typedef struct expected {
    double rgb[3];
    bool is_certain;
    double tie;
} expected;

static expected expect(const setting *s, const oracle_view *view, glint_shading shading,
                       const int pixel[2])
{
    expected e = {.is_certain = true};
    const bridge *b = s->bridge;
    const oracle_scene *scene = &s->oracle;
    const double position[2] = {pixel[0] + 0.5, pixel[1] + 0.5};
    const oracle_ray ray = oracle_primary_ray(view, position);
    const oracle_hit hit = oracle_closest_hit(scene, &ray, -1);
    bridge_take_tie(b);
    if (hit.triangle < 0) {
        oracle_radiance(scene, view, &ray, e.rgb, NULL);
        e.tie = bridge_take_tie(b);
        return e;
    }
    vertex_light lights[3];
    for (int v = 0; v < 3; v++) {
        lights[v] = light_at(scene, view, &scene->triangles[hit.triangle], v);
        e.is_certain = e.is_certain && !lights[v].is_away;
        const double *shown =
            shading == GLINT_SHADING_VERTEX_COLOR ? lights[v].color : lights[v].emitted;
        for (int k = 0; k < 3; k++) {
            e.rgb[k] += hit.barycentric[v] * shown[k];
        }
    }
    for (int kind = 0; shading == GLINT_SHADING_VERTEX_DIRECTION && kind < 3; kind++) {
        e.is_certain = add_look_up(scene, lights, hit.barycentric, kind, e.rgb) && e.is_certain;
    }
    e.tie = bridge_take_tie(b);
    return e;
}

// ---- Scenes ------------------------------------------------------------------------------------

static void keep(glint_scene *scene)
{
    (void)scene;
}

static void drop_normals(glint_scene *scene)
{
    free(scene->normals);
    scene->normals = NULL;
}

static void drop_some_and_turn_others(glint_scene *scene)
{
    for (size_t i = 0; i < 3 * scene->triangle_count; i++) {
        float *n = scene->normals + 3 * i;
        const float sign = i / 3 % 5 == 0 ? 0 : i / 3 % 2 == 0 ? 1 : -1;
        n[0] *= sign;
        n[1] *= sign;
        n[2] *= sign;
    }
}

static void see_in_parallel(glint_scene *scene)
{
    scene->cameras[0].orthographic = true;
    scene->cameras[0].ymag = 1.2;
}

// Moves the camera into the middle of the scene, where it sees every surface from inside.
static void see_from_inside(glint_scene *scene)
{
    glint_camera *camera = &scene->cameras[0];
    camera->eye = glint_vec3_add(scene->origin, (glint_vec3){0.05, 0.03, 0.02});
    camera->yfov = 1.2;
}

// The device stores a vertex's values as floats; places and normals are floats on both sides. The
// rest is in double precision. At grazing light Fresnel's term multiplies errors by 5.
#define DOUBLE_ERROR (16 * 0x1p-24)
// In single precision a place within a triangle errs by at most 1800 roundings (test_mirrors.c).
// This place weights the values of the corners, which differ by up to 1.
#define FLOAT_ERROR (2000 * 0x1p-24)

typedef struct vertex_case {
    const char *name, *scene;
    void (*change)(glint_scene *scene);
    double env_rotate;
    // Share of pixels where some corners, but not all, have total reflection or are just out of
    // sight.
    double uncertain;
    bool in_float; // also test float, which compiles another kernel
} vertex_case;

static const vertex_case cases[] = {
    {"silver", "mirror_sphere", keep, 0, 0, true},
    {"facets", "mirror_sphere", drop_normals, 0, 0, false},
    {"some normals, some inwards", "mirror_sphere", drop_some_and_turn_others, 30, 0, false},
    {"in parallel", "mirror_sphere", see_in_parallel, 0, 0, true},
    {"glass", "glass_sphere", keep, 0, 0.05, true},
    {"glass from inside", "glass_sphere", see_from_inside, 0, 0.05, false},
    {"absorbing, from inside", "absorption_box", see_from_inside, 0, 0.3, false},
    {"a thin wall", "thin_wall", keep, 0, 0.02, false},
    {"materials", "materials", keep, 120, 0.05, true},
    {"a blend", "lecture_example_2", keep, 0, 0.02, false},
};
enum { CASES = sizeof cases / sizeof *cases };

static glint_settings frame_of(glint_shading shading, const vertex_case *c)
{
    glint_settings settings = test_small_frame(0);
    settings.texels = GLINT_TEXELS_FLOAT; // the oracle's texels
    settings.env_rotate = c->env_rotate;
    settings.shading = shading;
    return settings;
}

static void begin(const vertex_case *c, setting *s)
{
    *s = (setting){0};
    test_scene_load(c->scene, &s->scene);
    scene_by_corner(&s->scene);
    c->change(&s->scene);
    bridge_direction_environment(64, &s->environment);
    assert_int_equal(
        glint_irradiance_map(&s->environment.radiance, GLINT_IRRADIANCE_EDGE, &s->irradiance, NULL),
        GLINT_OK);
    s->bridge = bridge_create(&s->scene, &s->environment);
    bridge_use_irradiance_map(s->bridge, &s->irradiance);
    s->oracle = *bridge_scene(s->bridge);
    s->oracle.environment_rotation = c->env_rotate;
}

static void end(setting *s)
{
    bridge_free(s->bridge);
    glint_cube_free(&s->irradiance);
    glint_environment_free(&s->environment);
    glint_scene_free(&s->scene);
}

// Leaves out and counts three kinds of pixels: at an edge, at a tie between two faces of the cube
// (whose interpolations differ), and with corners that do not make the same look-ups.
static void compare(const vertex_case *c, const glint_settings *settings, double tolerance)
{
    setting s;
    begin(c, &s);
    test_frame frame;
    test_render(&s.scene, &s.environment, NULL, settings, &frame);
    assert_int_equal(frame.plan.depth, 1);
    glint_camera camera;
    assert_int_equal(glint_scene_camera(&s.scene, NULL, &camera, NULL), GLINT_OK);
    oracle_view view = bridge_view(&camera, settings);
    view.depth = 1;
    const int pixels = settings->width * settings->height;
    double largest = 0;
    int left_out = 0, uncertain = 0;
    for (int i = 0; i < pixels; i++) {
        const int pixel[2] = {i % settings->width, i / settings->width};
        double rgba[4];
        oracle_report report;
        oracle_pixel(&s.oracle, &view, pixel, rgba, &report);
        const expected e = expect(&s, &view, settings->shading, pixel);
        // Leave out uncertain pixels.
        if (report.edge < 1e-6 || e.tie < 1e-6 || !e.is_certain) {
            left_out++;
            uncertain += !e.is_certain;
            continue;
        }
        for (int k = 0; k < 3; k++) {
            const double difference = fabs(frame.exact[4 * i + k] - e.rgb[k]);
            assert_true(difference <= tolerance); // NaN is not
            largest = fmax(largest, difference);
        }
    }
    print_message("%-28s %-16s %s: off by %.2g at most, %d of %d pixels left out, %d uncertain\n",
                  c->name, glint_shading_name(settings->shading),
                  settings->precision == GLINT_PRECISION_DOUBLE ? "double" : "float", largest,
                  left_out, pixels, uncertain);
    assert_true(uncertain <= c->uncertain * pixels);
    assert_true(left_out - uncertain < pixels / 30);
    test_frame_free(&frame);
    end(&s);
}

static void vertices_agree_with_the_oracle(void **state)
{
    (void)state;
    for (size_t i = 0; i < CASES; i++) {
        for (int by_color = 0; by_color < 2; by_color++) {
            glint_settings settings = frame_of(
                by_color ? GLINT_SHADING_VERTEX_COLOR : GLINT_SHADING_VERTEX_DIRECTION, &cases[i]);
            if (cases[i].in_float) {
                compare(&cases[i], &settings, FLOAT_ERROR);
            }
            settings.precision = GLINT_PRECISION_DOUBLE;
            compare(&cases[i], &settings, DOUBLE_ERROR);
        }
    }
}

static void vertices_are_the_same_at_every_width(void **state)
{
    (void)state;
    static const int forms[][2] = {{8, 16}, {16, 16}, {16, 1}};
    for (int by_color = 0; by_color < 2; by_color++) {
        const vertex_case *c = &cases[8]; // has every material
        setting s;
        begin(c, &s);
        glint_settings settings =
            frame_of(by_color ? GLINT_SHADING_VERTEX_COLOR : GLINT_SHADING_VERTEX_DIRECTION, c);
        settings.samples_per_axis = 2;
        settings.texels = GLINT_TEXELS_HALF;
        settings.transparent = true;
        settings.kernel_width = settings.tile_packets = 1;
        test_frame one, more;
        test_render(&s.scene, &s.environment, NULL, &settings, &one);
        for (size_t w = 0; w < sizeof forms / sizeof *forms; w++) {
            settings.kernel_width = forms[w][0];
            settings.tile_packets = forms[w][1];
            test_render(&s.scene, &s.environment, NULL, &settings, &more);
            assert_int_equal(test_count_different(&one.image, &more.image), 0);
            test_frame_free(&more);
        }
        test_frame_free(&one);
        end(&s);
    }
}

// Adds an icosphere in place of the silver sphere, which has radius 1 about the origin.
static void add_triangle(void *context, const glint_vec3 corners[3])
{
    glint_scene *scene = context;
    for (int v = 0; v < 3; v++) {
        const glint_vec3 at =
            glint_vec3_scale(glint_vec3_subtract(corners[v], scene->origin), 1 / scene->unit);
        const size_t place = 9 * scene->triangle_count + 3 * (size_t)v;
        const float position[3] = {(float)at.x, (float)at.y, (float)at.z};
        const float normal[3] = {(float)corners[v].x, (float)corners[v].y, (float)corners[v].z};
        memcpy(scene->positions + place, position, sizeof position);
        memcpy(scene->normals + place, normal, sizeof normal);
    }
    scene->material_of[scene->triangle_count++] = 0;
}

static void make_sphere(int level, glint_scene *scene)
{
    const size_t triangles = (size_t)20 << 2 * level;
    *scene = (glint_scene){0};
    test_scene_load("mirror_sphere", scene);
    scene_by_corner(scene);
    assert_int_equal(scene->instance_count, 1);
    free(scene->positions);
    free(scene->normals);
    free(scene->material_of);
    scene->positions = calloc(triangles, 9 * sizeof *scene->positions);
    scene->normals = calloc(triangles, 9 * sizeof *scene->normals);
    scene->material_of = calloc(triangles, sizeof *scene->material_of);
    assert_true(scene->positions && scene->normals && scene->material_of);
    scene->triangle_count = 0;
    glint_icosphere(level, add_triangle, scene);
    assert_int_equal(scene->triangle_count, triangles);
    scene->instances[0].triangle_count = triangles;
    glint_scene_find_bounds(scene);
}

static double mean_difference(const glint_image *a, const glint_image *b)
{
    const size_t values = (size_t)a->width * (size_t)a->height * 4;
    double sum = 0;
    for (size_t i = 0; i < values; i++) {
        sum += fabs((double)a->pixels[i] - (double)b->pixels[i]);
    }
    return sum / (double)values;
}

// The lecture's argument: with a finer mesh, both methods approach pixel shading, and colours start
// farther away.
static void finer_meshes_come_to_what_pixels_show(void **state)
{
    (void)state;
    double errors[3][2];
    for (int level = 0; level < 3; level++) {
        glint_scene sphere;
        make_sphere(level + 3, &sphere);
        glint_settings settings = test_small_frame(1);
        settings.width = settings.height = 120;
        test_frame pixel, other;
        test_render(&sphere, test_studio(), NULL, &settings, &pixel);
        for (int by_color = 0; by_color < 2; by_color++) {
            settings.shading =
                by_color ? GLINT_SHADING_VERTEX_COLOR : GLINT_SHADING_VERTEX_DIRECTION;
            test_render(&sphere, test_studio(), NULL, &settings, &other);
            errors[level][by_color] = mean_difference(&pixel.image, &other.image);
            test_frame_free(&other);
        }
        test_frame_free(&pixel);
        glint_scene_free(&sphere);
        print_message("%d triangles: off by %.3g by directions, by %.3g by colours\n",
                      20 << 2 * (level + 3), errors[level][0], errors[level][1]);
        // Interpolation errs by h² for smooth functions. At a light's edge, interpolated colours
        // err over the size h of the triangle there, interpolated directions only over h².
        assert_true(errors[level][1] > 10 * errors[level][0]);
        if (level > 0) {
            assert_true(errors[level][0] < errors[level - 1][0] / 3);
            assert_true(errors[level][1] < errors[level - 1][1] / 1.7);
        }
    }
}

static void refuse(const glint_scene *scene, const glint_environment *environment,
                   const glint_settings *settings, const char *text)
{
    const glint_plan_inputs inputs = {.scene = scene,
                                      .environment = &environment->radiance,
                                      .device = glint_device_capabilities(test_device()),
                                      .settings = settings};
    glint_error error = {0};
    glint_plan plan;
    assert_int_equal(glint_plan_make(&inputs, &plan, &error), GLINT_USAGE);
    assert_non_null(strstr(error.message, text));
}

static void what_vertices_cannot_know_is_refused(void **state)
{
    (void)state;
    setting s;
    begin(&cases[0], &s);
    const glint_settings plain = frame_of(GLINT_SHADING_VERTEX_COLOR, &cases[0]);
    glint_settings settings = plain;
    settings.depth = 2;
    refuse(&s.scene, &s.environment, &settings, "--shading vertex-color");
    settings = plain;
    settings.filter = GLINT_FILTER_MIP;
    refuse(&s.scene, &s.environment, &settings, "--filter mip");
    settings = plain;
    settings.aovs = 1;
    refuse(&s.scene, &s.environment, &settings, "--aov");
    settings = plain;
    settings.terms = 4;
    refuse(&s.scene, &s.environment, &settings, "--directions");
    end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(vertices_agree_with_the_oracle),
        cmocka_unit_test(vertices_are_the_same_at_every_width),
        cmocka_unit_test(finer_meshes_come_to_what_pixels_show),
        cmocka_unit_test(what_vertices_cannot_know_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
