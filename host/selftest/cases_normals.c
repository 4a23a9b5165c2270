// Tests hard cases of shading normals: they lean under the surface or beyond its plane, have no
// direction or an odd length. Also tests unit vectors after a thousand bounces.
#include "selftest/judged.h"
#include "selftest/shapes.h"
#include "selftest/trial.h"
#include "selftest/vectors.h"

#include <math.h>
#include <string.h>

// Adds a square in the plane z = 0. All its vertices have this normal.
static void add_square(shape *s, const double normal[3])
{
    static const double corners[2][3][3] = {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}},
                                            {{-1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}};
    double normals[3][3];
    for (int k = 0; k < 3; k++) {
        memcpy(normals[k], normal, sizeof normals[k]);
    }
    for (int i = 0; i < 2; i++) {
        shape_add(s, corners[i], (const double(*)[3])normals, MATERIAL_TINTED);
    }
}

// Bounces rays off such a square.
static glint_status bounce_off(trial *t, const double normal[3], const glint_probe_ray *rays,
                               glint_probe_bounce *bounces, size_t count)
{
    glint_scene scene;
    glint_probe *probe;
    shape s = shape_begin();
    add_square(&s, normal);
    glint_status status;
    TRY_OR(cleanup, status, trial_build(t, &s, &scene, &probe));
    TRY_OR(cleanup, status, trial_bounce(t, probe, rays, bounces, count));
cleanup:
    glint_probe_free(probe);
    glint_scene_free(&scene);
    return status;
}

// A ray to the middle of the square, from the side of +Z, at `angle` from the axis.
static glint_probe_ray from_above(const trial *t, double angle, double azimuth)
{
    glint_probe_ray ray = {.from = -1};
    const double direction[3] = {sin(angle) * cos(azimuth), sin(angle) * sin(azimuth), -cos(angle)};
    for (int k = 0; k < 3; k++) {
        ray.direction[k] = trial_rounded(t, direction[k]);
        ray.origin[k] = trial_rounded(t, -0.5 * direction[k]);
    }
    return ray;
}

// ---- Normals that lean -------------------------------------------------------------------------

#define STEPS 2048

// Moves the ray from one horizon to the other. Reflections must stay above the surface and must not
// jump. Reflection and folding are isometries in the viewer's direction: directions that differ by
// δ give directions that differ by δ, except for rounding.
static glint_status leaning_normals(trial *t)
{
    static glint_probe_ray rays[STEPS];
    static glint_probe_bounce bounces[STEPS];
    glint_measure *under = trial_error(t, "how far reflections go under the surface", "u", 2);
    glint_measure *jumps = trial_error(t, "jump between neighbouring rays", "u", 16);
    for (int lean = 0; lean < 8; lean++) {
        const double tilt = (lean < 7 ? 12.5 * lean : 89.9) * GLINT_PI / 180;
        const double azimuth = trial_random(t, 0, 2 * GLINT_PI);
        const double normal[3] = {sin(tilt), 0, cos(tilt)};
        for (int i = 0; i < STEPS; i++) {
            rays[i] = from_above(t, (2.0 * (i + 0.5) / STEPS - 1) * 89.9 * GLINT_PI / 180, azimuth);
        }
        TRY(bounce_off(t, normal, rays, bounces, STEPS));
        // Judge each reflection, and its step from the previous one.
        for (int i = 0; i < STEPS; i++) {
            const glint_probe_bounce *b = &bounces[i];
            const double along = dot(b->reflected, b->geometric_normal);
            measure_error(under, above_zero(-along) / t->u,
                          "normal leans by %.4g°, ray %d: r·n = %.3g", tilt * 180 / GLINT_PI, i,
                          along);
            double step = 0, turn = 0;
            for (int k = 0; i > 0 && k < 3; k++) {
                step += pow(rays[i].direction[k] - rays[i - 1].direction[k], 2);
                turn += pow(b->reflected[k] - bounces[i - 1].reflected[k], 2);
            }
            measure_error(jumps, above_zero(sqrt(turn) - sqrt(step)) / t->u,
                          "normal leans by %.4g°, between rays %d and %d: %.3g, where they differ "
                          "by %.3g",
                          tilt * 180 / GLINT_PI, i - 1, i, sqrt(turn), sqrt(step));
        }
    }
    return GLINT_OK;
}

// ---- Normals that lean beyond the plane ---------------------------------------------------------

// A ball whose normals lean sideways: not at the bottom, and by 170° at the top.
static glint_status leaning_ball(shape_material material, glint_scene *scene, glint_error *error)
{
    static const double centre[3] = {0, 0, 0};
    shape s = shape_begin();
    shape_add_ball(&s, &(shape_ball){centre, 0.75, 2, material, true, NULL});
    TRY(shape_end(&s, scene, error));
    for (size_t v = 0; v < 3 * scene->triangle_count; v++) {
        const float *p = scene->positions + 3 * v;
        const double x = (double)p[0] / 0.75, y = (double)p[1] / 0.75, z = (double)p[2] / 0.75;
        const double lean = (y + 1) / 2 * 170 * GLINT_PI / 180;
        const double side[3] = {-z, 0, x}; // at right angles to the vertex's direction
        const double ring = fmax(hypot(x, z), 1e-9);
        const double outward[3] = {x, y, z};
        for (int k = 0; k < 3; k++) {
            scene->normals[3 * v + (size_t)k] =
                (float)(cos(lean) * outward[k] + sin(lean) * side[k] / ring);
        }
    }
    return GLINT_OK;
}

// Judges the ball's matte light. The winding alone decides which side of a normal is lit. So across
// a triangle the light changes as the normals do, without patches.
static glint_status judge_matte_ball(trial *t, const double eye[3], glint_measure *errors)
{
    static const double target[3] = {0, 0, 0};
    glint_scene scene = {0};
    judged frame = {0};
    glint_settings settings = trial_settings(t);
    settings.depth = 1;
    settings.all_features = true;
    const glint_camera camera = shape_camera(eye, target, 0.8, 0);
    glint_status status;
    TRY_OR(cleanup, status, leaning_ball(MATERIAL_PAINT, &scene, t->error));
    TRY_OR(cleanup, status, judged_frame(t, &scene, &camera, &settings, &frame));
    frame.view.edges = true;
    judged_compare(&frame, errors);
cleanup:
    judged_end(&frame);
    glint_scene_free(&scene);
    return status;
}

// A ball that sends light in many directions. Its normals point away from the viewer in places, and
// its light must not jump at their edges.
typedef struct spreading_ball {
    const char *what;
    shape_material material;
    float roughness, sheen, clearcoat, clearcoat_roughness;
    int strata; // the oracle's directions along each axis
    double bound;
} spreading_ball;

static glint_status judge_spreading_ball(trial *t, const spreading_ball *ball)
{
    static const double eye[3] = {0.3, 0.2, 2.2}, target[3] = {0, 0, 0};
    glint_scene scene = {0};
    judged frame = {0};
    const glint_settings settings = trial_lobe_settings(t, 1);
    const glint_camera camera = shape_camera(eye, target, 0.8, 0);
    glint_status status;
    TRY_OR(cleanup, status, leaning_ball(ball->material, &scene, t->error));
    glint_material *m = &scene.materials[ball->material];
    m->roughness = ball->roughness;
    m->sheen_color[1] = ball->sheen;
    m->sheen_roughness = 0.5F;
    m->clearcoat = ball->clearcoat;
    m->clearcoat_roughness = ball->clearcoat_roughness;
    TRY_OR(cleanup, status, judged_frame(t, &scene, &camera, &settings, &frame));
    frame.view.roughness = ball->strata;
    measure_error(trial_error(t, ball->what, "of the mean", ball->bound), judged_rmse(&frame),
                  "relative RMSE");
cleanup:
    judged_end(&frame);
    glint_scene_free(&scene);
    return status;
}

// The irradiance map errs as the environment does; see cases_materials.c. The other bounds are
// those of cases_rough.c.
static glint_status normals_past_the_plane(trial *t)
{
    static const double outside[3] = {0.3, 0.2, 2.2}, inside[3] = {0.1, -0.3, 0.2};
    static const spreading_ball balls[] = {
        {"rough metal", MATERIAL_TINTED, 0.6F, 0, 0, 0, 64, 0.003},
        {"rough glass", MATERIAL_GLASS, 0.4F, 0, 0, 0, 24, 0.0015},
        {"sheen on smooth metal", MATERIAL_TINTED, 0, 1, 0, 0, 64, 0.001},
        {"and below a smooth coat", MATERIAL_TINTED, 0, 1, 1, 0, 64, 0.001},
        {"a rough coat on smooth metal", MATERIAL_TINTED, 0, 0, 1, 0.5F, 64, 0.003},
    };
    TRY(judge_matte_ball(t, outside, trial_error(t, "matte light, from outside", "", 4e-4)));
    TRY(judge_matte_ball(t, inside, trial_error(t, "and from inside", "", 4e-4)));
    for (size_t i = 0; i < sizeof balls / sizeof *balls; i++) {
        TRY(judge_spreading_ball(t, &balls[i]));
    }
    return GLINT_OK;
}

// ---- Glass whose normals lean ------------------------------------------------------------------

// A ball of glass whose normals all lean by `lean`, in a direction that turns with the height.
static glint_status leaning_glass(double lean, glint_scene *scene, glint_error *error)
{
    static const double centre[3] = {0, 0, 0};
    shape s = shape_begin();
    shape_add_ball(&s, &(shape_ball){centre, 0.75, 3, MATERIAL_GLASS, true, NULL});
    TRY(shape_end(&s, scene, error));
    for (size_t v = 0; v < 3 * scene->triangle_count; v++) {
        const float *p = scene->positions + 3 * v;
        const double x = (double)p[0] / 0.75, y = (double)p[1] / 0.75, z = (double)p[2] / 0.75;
        const double ring = fmax(hypot(x, z), 1e-9), turn = 6 * y;
        const double outward[3] = {x, y, z}, across[3] = {-z / ring, 0, x / ring};
        const double up[3] = {-x * y / ring, ring, -z * y / ring};
        for (int k = 0; k < 3; k++) {
            const double aside = cos(turn) * across[k] + sin(turn) * up[k];
            scene->normals[3 * v + (size_t)k] = (float)(cos(lean) * outward[k] + sin(lean) * aside);
        }
    }
    return GLINT_OK;
}

// A ray starts 8u of its triangle's coordinates off a surface. Other roundings on the way add about
// as much. The errors of several surfaces can add up.
#define START_ROUNDINGS 16
#define ADDED_UP 8

static glint_status judge_leaning_glass(trial *t, double lean, glint_measure *unexplained,
                                        glint_measure *moved)
{
    static const double eye[3] = {0.3, 0.2, 2.2}, target[3] = {0, 0, 0};
    glint_scene scene = {0};
    judged frame = {0};
    glint_settings settings = trial_settings(t);
    settings.width = 32;
    settings.height = 24;
    settings.depth = 8;
    const glint_camera camera = shape_camera(eye, target, 0.8, 0);
    glint_status status;
    TRY_OR(cleanup, status, leaning_glass(lean, &scene, t->error));
    TRY_OR(cleanup, status, judged_frame(t, &scene, &camera, &settings, &frame));
    for (int p = 0; p < settings.width * settings.height; p++) {
        double expected[4], off = 0;
        bool is_off = false; // NaN is
        oracle_report report;
        judged_pixel(&frame, p, expected, &report);
        if (report.surfaces == 0) {
            continue;
        }
        const double spread = judged_spread(&frame, p, START_ROUNDINGS * t->u, expected);
        for (int k = 0; k < 4; k++) {
            const double error = fabs(frame.picture.values[4 * p + k] - expected[k]);
            is_off |= !(error <= 4e-4 + ADDED_UP * spread);
            off = fmax(off, error);
        }
        measure_event(moved, spread > 1e-3, "pixel (%d, %d)", p % settings.width,
                      p / settings.width);
        measure_event(unexplained, is_off,
                      "normals lean by %g, pixel (%d, %d): off by %.3g, rounding moves it by %.3g",
                      lean, p % settings.width, p / settings.width, off, spread);
    }
cleanup:
    judged_end(&frame);
    glint_scene_free(&scene);
    return status;
}

// Where normals lean far, each surface multiplies an error by several, and in single precision no
// digits may be left after eight surfaces. So no bound on colours holds. But no pixel may be off by
// more than rounding the places on surfaces moves it. In rare pixels an edge is between the places.
static glint_status tilted_glass(trial *t)
{
    glint_measure *unexplained =
        trial_share(t, "pixels off by more than rounding moves them", 0.01);
    TRY(judge_leaning_glass(t, 0, unexplained,
                            trial_share(t, "pixels that it moves by 10⁻³: normals upright", 0)));
    TRY(judge_leaning_glass(t, 0.5, unexplained, trial_share(t, "leaning by 0.5 rad", 0.5)));
    return judge_leaning_glass(t, 1.5, unexplained, trial_share(t, "leaning by 1.5 rad", 0.75));
}

// ---- Lengths -----------------------------------------------------------------------------------

// Tests the vector functions alone, over all exponents.
static glint_status measure_lengths(trial *t, glint_measure *lengths, glint_measure *hopeless)
{
    enum { COUNT = 4096 };
    static const double odd[][3] = {{0, 0, 0},     {-0.0, 0, -0.0},      {NAN, 1, 0},
                                    {0, NAN, 1},   {1, 0, INFINITY},     {-INFINITY, 0, 0},
                                    {NAN, 0, NAN}, {INFINITY, NAN, 1e30}};
    const int odd_count = sizeof odd / sizeof *odd;
    static double in[COUNT][4], out[COUNT][4];
    const bool is_double = t->options->precision == GLINT_PRECISION_DOUBLE;
    const double reach = is_double ? 300 : 37;
    // Make vectors of all lengths, and vectors without a direction.
    for (int i = 0; i < COUNT; i++) {
        const glint_vec3 d = glint_random_direction(&t->random);
        const double length = pow(10, trial_random(t, -reach, reach));
        const double v[3] = {d.x * length, d.y * length, d.z * length};
        memcpy(in[i], i < odd_count ? odd[i] : v, sizeof v);
    }
    glint_probe *probe;
    glint_status status;
    TRY_OR(cleanup, status, trial_functions(t, &probe));
    TRY_OR(cleanup, status,
           trial_call(t, probe, GLINT_PROBE_NORMALIZED, &(trial_numbers){in, out, COUNT}));
    for (int i = 0; i < COUNT; i++) {
        const double *v = out[i];
        if (i < odd_count) {
            measure_event(hopeless, v[3] != 0, "(%g, %g, %g) is said to have a direction", in[i][0],
                          in[i][1], in[i][2]);
            continue;
        }
        measure_event(hopeless, v[3] != 1, "(%g, %g, %g) is said to have no direction", in[i][0],
                      in[i][1], in[i][2]);
        double expected[3] = {in[i][0], in[i][1], in[i][2]};
        const double largest = fmax(fabs(expected[0]), fmax(fabs(expected[1]), fabs(expected[2])));
        for (int k = 0; k < 3; k++) {
            expected[k] /= largest; // prevents overflow of squares
        }
        make_unit(expected);
        measure_vector(lengths, v, expected, t->u, "along (%g, %g, %g)", in[i][0], in[i][1],
                       in[i][2]);
    }
cleanup:
    glint_probe_free(probe);
    return status;
}

static glint_status odd_normals(trial *t)
{
    enum { COUNT = 256 };
    static const double normals[][3] = {
        {0, 0, 0},   {0, 0, 1e20},     {0, 0, 1e-20}, {0.6e20, 0, 0.8e20}, {0.6e-20, 0, 0.8e-20},
        {NAN, 0, 1}, {0, 0, INFINITY}, {0, 0, -1},    {0, 0, 1 + 1e-6},    {1e-30, 0, 1e-38},
        {1, 0, 0}};
    static const double axis[3] = {0, 0, 1};
    static glint_probe_ray rays[COUNT];
    static glint_probe_bounce bounces[COUNT];
    glint_measure *lengths = trial_error(t, "unit vectors, and |r| beside 1", "u", 4);
    // Three products with weights that add up to 1 within 2u, a sum, then a normalisation.
    glint_measure *taken = trial_error(t, "the normal that is taken", "u", 8);
    glint_measure *hopeless = trial_events(t, "vectors misjudged", 0);
    TRY(measure_lengths(t, lengths, hopeless));
    for (size_t n = 0; n < sizeof normals / sizeof *normals; n++) {
        const double *normal = normals[n];
        for (int i = 0; i < COUNT; i++) {
            rays[i] = from_above(t, trial_random(t, 0, 1.5), trial_random(t, 0, 2 * GLINT_PI));
        }
        TRY(bounce_off(t, normal, rays, bounces, COUNT));
        // The expected normal is along the stored vertices' normal, towards the viewer; or the
        // square's own.
        double wanted[3] = {(double)(float)normal[0], (double)(float)normal[1],
                            (double)(float)normal[2]};
        const bool usable = isfinite(dot(wanted, wanted)) && dot(wanted, wanted) > 0;
        if (!usable) {
            memcpy(wanted, axis, sizeof wanted);
        }
        make_unit(wanted);
        // Compare the normal that the kernel used.
        for (int i = 0; i < COUNT; i++) {
            const glint_probe_bounce *b = &bounces[i];
            const double above = wanted[2] < 0 ? -1 : 1;
            const double facing = -above * dot(wanted, rays[i].direction) < 0 ? -above : above;
            const double towards[3] = {facing * wanted[0], facing * wanted[1], facing * wanted[2]};
            measure_vector(taken, b->normal, towards, t->u, "normal (%g, %g, %g), ray %d",
                           normal[0], normal[1], normal[2], i);
            measure_value(lengths, sqrt(dot(b->reflected, b->reflected)), 1, t->u,
                          "normal (%g, %g, %g), ray %d", normal[0], normal[1], normal[2], i);
        }
    }
    return GLINT_OK;
}

// ---- Drift -------------------------------------------------------------------------------------

// Makes a mirrored cube whose normals are all a little too long.
static glint_status mirrored_room(trial *t, double length, glint_scene *scene)
{
    static const double low[3] = {-0.75, -0.75, -0.75}, high[3] = {0.75, 0.75, 0.75};
    shape s = shape_begin();
    shape_add_box(&s, &(shape_box){low, high, 1, MATERIAL_TINTED, true});
    TRY(shape_end(&s, scene, t->error));
    for (size_t i = 0; i < scene->triangle_count; i++) {
        const float *p = scene->positions + 9 * i;
        for (size_t k = 0; k < 3; k++) {
            // Find the axis along which all three corners agree. The normal points inwards along
            // it.
            const bool flat = p[k] == p[3 + k] && p[k] == p[6 + k];
            for (size_t v = 0; flat && v < 3; v++) {
                scene->normals[9 * i + 3 * v + k] = (float)(p[k] > 0 ? -length : length);
            }
        }
    }
    return GLINT_OK;
}

static glint_status drift(trial *t)
{
    enum { COUNT = 256, BOUNCES = 1000 };
    static const double middle[3] = {0, 0, 0};
    static glint_probe_ray rays[COUNT];
    static glint_probe_bounce bounces[COUNT];
    glint_measure *lost = trial_events(t, "rays that leave the closed room", 0);
    glint_measure *lengths = trial_error(t, "|r| − 1 after 1000 bounces", "u", 1e-6 / 0x1p-24);
    glint_scene scene;
    glint_probe *probe = NULL;
    glint_status status;
    // Start in the middle.
    TRY_OR(cleanup, status, mirrored_room(t, 1 + 1e-6, &scene));
    for (int i = 0; i < COUNT; i++) {
        rays[i] = trial_random_ray(t, middle);
    }
    // Bounce a thousand times.
    TRY_OR(cleanup, status, trial_probe(t, &scene, &probe));
    for (int n = 0; n < BOUNCES; n++) {
        TRY_OR(cleanup, status, trial_bounce(t, probe, rays, bounces, COUNT));
        for (int i = 0; i < COUNT; i++) {
            measure_event(lost, !(bounces[i].hit.triangle >= 0), "ray %d at bounce %d", i, n);
            memcpy(rays[i].origin, bounces[i].reflected_origin, sizeof rays[i].origin);
            memcpy(rays[i].origin_low, bounces[i].reflected_low, sizeof rays[i].origin_low);
            memcpy(rays[i].direction, bounces[i].reflected, sizeof rays[i].direction);
            rays[i].from = bounces[i].place;
        }
    }
    for (int i = 0; i < COUNT; i++) {
        measure_value(lengths, sqrt(dot(rays[i].direction, rays[i].direction)), 1, t->u, "ray %d",
                      i);
    }
cleanup:
    glint_probe_free(probe);
    glint_scene_free(&scene);
    return status;
}

const trial_case normal_cases[] = {
    {"leaning_normals",
     "normals up to 89.9° off the surface's: reflections above it, without jumps", leaning_normals},
    {"normals_past_the_plane",
     "normals up to 170° off the surface's: light as the winding says, without patches",
     normals_past_the_plane},
    {"tilted_glass",
     "glass whose normals lean by up to 1.5 rad: eight surfaces, errors no larger than rounding's",
     tilted_glass},
    {"odd_normals", "normals 0, NaN, infinite, 10^±20 long: unit reflections, or the surface's own",
     odd_normals},
    {"drift", "1000 bounces off normals 10^−6 too long: directions keep their length", drift},
    {0},
};
