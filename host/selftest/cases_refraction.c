// Tests hard cases of refraction at one interface: the critical angle, indices next to each other
// and far apart, both ends of Fresnel's term.
#include "selftest/shapes.h"
#include "selftest/trial.h"

#include <math.h>
#include <string.h>

static const double indices[] = {1.1, 1.33, 1.5, 2.42, 10};
#define INDEX_COUNT (sizeof indices / sizeof *indices)

// 1 − η²(1 − c²) of the numbers that the device gets.
static double transmitted_squared(double cosine, double eta)
{
    const long double c = cosine, e = eta;
    return (double)(1 - e * e * (1 - c) * (1 + c));
}

// The unpolarised reflectance by Fresnel's equations; 1 beyond the critical angle.
static double reflectance(double cosine, double eta)
{
    const double squared = transmitted_squared(cosine, eta);
    if (!(squared >= 0)) {
        return 1;
    }
    const long double c = cosine, ct = sqrtl((long double)squared), e = eta;
    const long double s = (e * c - ct) / (e * c + ct), p = (c - e * ct) / (c + e * ct);
    return (double)((s * s + p * p) / 2);
}

static glint_status call_functions(trial *t, glint_probe_part part, double (*in)[4],
                                   double (*out)[4], size_t count)
{
    for (size_t i = 0; i < 4 * count; i++) {
        in[i / 4][i % 4] = trial_rounded(t, in[i / 4][i % 4]);
    }
    glint_probe *probe;
    glint_status status;
    TRY_OR(cleanup, status, trial_functions(t, &probe));
    TRY_OR(cleanup, status, trial_call(t, probe, part, &(trial_numbers){in, out, count}));
cleanup:
    glint_probe_free(probe);
    return status;
}

// ---- The critical angle ------------------------------------------------------------------------

static glint_status critical_formulas(trial *t, double exempt)
{
    enum { PER_INDEX = 1024, COUNT = INDEX_COUNT * PER_INDEX };
    static double in[COUNT][4], out[COUNT][4];
    glint_measure *wrong = trial_events(t, "cosines on the wrong side beyond the exempt band", 0);
    // cos² θt is about 2η times the distance. It is known to about 4u·η², its root to that over
    // twice the root.
    glint_measure *errors = trial_error(t, "error of the reflectance", "u/√distance", 16);
    glint_measure *beyond = trial_error(t, "and beyond ten times the band, η up to 2.42", "", 2e-3);
    // Choose angles on both sides of the critical angle.
    for (int i = 0; i < COUNT; i++) {
        const int which = i / PER_INDEX;
        const double eta = trial_rounded(t, indices[which]), critical = asin(1 / eta);
        const double distance = exempt * pow(10, trial_random(t, 0, 5.5)) * (i % 2 ? 1 : -1);
        in[i][0] = cos(fmin(fmax(critical + distance, 0), GLINT_PI / 2));
        in[i][1] = eta;
    }
    // Compare cos² θt and the reflectance.
    TRY(call_functions(t, GLINT_PROBE_FRESNEL, in, out, COUNT));
    for (int i = 0; i < COUNT; i++) {
        const double cosine = in[i][0], eta = in[i][1];
        const double distance = fabs(acos(cosine) - asin(1 / eta));
        const double squared = transmitted_squared(cosine, eta);
        if (distance <= exempt) {
            continue;
        }
        measure_event(wrong, isnan(out[i][0]) || (out[i][0] >= 0) != (squared >= 0),
                      "cos θ %.9g, η %.9g: cos² θt expected %.3g, got %.3g", cosine, eta, squared,
                      out[i][0]);
        // As in scatter(): if the square is below 0, all light is reflected.
        const double got = out[i][0] < 0 ? 1 : out[i][1];
        measure_value(errors, got, reflectance(cosine, eta), t->u * eta * eta / sqrt(distance),
                      "cos θ %.9g, η %.9g", cosine, eta);
        if (distance > 10 * exempt && eta < 3) {
            measure_value(beyond, got, reflectance(cosine, eta), 1, "cos θ %.9g, η %.9g", cosine,
                          eta);
        }
    }
    return GLINT_OK;
}

// Tests rays near the critical angle. Nearer than the rounding of the cosine, the side is
// undefined. This band is 10⁻⁶ in float: near such angles, an ulp of the cosine is a turn of u/sin
// θ.
static glint_status critical_angle(trial *t)
{
    enum { COUNT = 8192 };
    static const double low[3] = {-0.75, -0.75, -0.75}, high[3] = {0.75, 0.75, 0.75};
    static glint_probe_ray rays[COUNT];
    static glint_probe_bounce bounces[COUNT];
    const double exempt = 1e-6 * t->u / 0x1p-24;
    TRY(critical_formulas(t, exempt));
    glint_status status;
    glint_measure *wrong = trial_events(t, "rays on the wrong side beyond the exempt band", 0);
    glint_scene scene = {0};
    glint_probe *probe = NULL;
    shape s = shape_begin();
    shape_add_box(&s, &(shape_box){low, high, 1, MATERIAL_GLASS, false});
    TRY_OR(cleanup, status, trial_build(t, &s, &scene, &probe));
    // Rays go from the middle of a glass box to its upper face.
    const double critical = asin(1 / SHAPE_GLASS_IOR);
    for (int i = 0; i < COUNT; i++) {
        const double distance = pow(10, trial_random(t, -16, -1.2)) * (i % 2 ? 1 : -1);
        const double angle = critical + distance, turn = trial_random(t, 0, 2 * GLINT_PI);
        const double d[3] = {sin(angle) * cos(turn), sin(angle) * sin(turn), cos(angle)};
        rays[i] = (glint_probe_ray){.from = -1};
        for (int k = 0; k < 3; k++) {
            rays[i].direction[k] = trial_rounded(t, d[k]);
        }
    }
    TRY_OR(cleanup, status, trial_bounce(t, probe, rays, bounces, COUNT));
    // Every ray outside the exempt band must be on the right side.
    for (int i = 0; i < COUNT; i++) {
        const double *d = rays[i].direction, angle = atan2(hypot(d[0], d[1]), d[2]);
        if (fabs(angle - critical) > exempt) {
            measure_event(wrong, bounces[i].total_reflection != (angle > critical),
                          "%.3g rad %s the critical angle: total reflection %g",
                          fabs(angle - critical), angle > critical ? "beyond" : "before",
                          bounces[i].total_reflection);
        }
    }
cleanup:
    glint_probe_free(probe);
    glint_scene_free(&scene);
    return status;
}

// ---- Indices next to each other ----------------------------------------------------------------

static glint_status equal_indices(trial *t)
{
    enum { COUNT = 3 * 512 };
    static double in[COUNT][4], out[COUNT][4];
    glint_measure *reflected = trial_error(t, "reflectance at right angles", "", 1e-13);
    glint_measure *slanting = trial_error(t, "reflectance where η is 1", "", 1e-13);
    glint_measure *bends = trial_error(t, "bend", "rad", 1e-6);
    for (int i = 0; i < COUNT; i++) {
        in[i][0] = i % 512 == 0 ? 1 : trial_random(t, 0.1, 1);
        const int step = i / 512 - 1;
        in[i][1] = 1 + step * 1e-7;
    }
    TRY(call_functions(t, GLINT_PROBE_FRESNEL, in, out, COUNT));
    for (int i = 0; i < COUNT; i++) {
        if (in[i][0] == 1) {
            measure_error(reflected, fabs(out[i][1]), "η %.9g: %.3g", in[i][1], out[i][1]);
        }
        if (in[i][1] == 1) {
            measure_error(slanting, fabs(out[i][1]), "cos θ %.9g: %.3g", in[i][0], out[i][1]);
        }
    }
    TRY(call_functions(t, GLINT_PROBE_DIRECTIONS, in, out, COUNT));
    for (int i = 0; i < COUNT; i++) {
        const double sine = sqrt((1 - in[i][0]) * (1 + in[i][0]));
        const double bend = hypot(out[i][0] + sine, out[i][1] + in[i][0]);
        // Snell's law bends by Δη tan θ.
        measure_error(bends, bend / fmax(1, sine / in[i][0]), "cos θ %.9g, η %.9g: %.3g", in[i][0],
                      in[i][1], bend);
    }
    return GLINT_OK;
}

// ---- Indices far apart -------------------------------------------------------------------------

static glint_status extreme_indices(trial *t)
{
    enum { COUNT = 4096 };
    static double in[COUNT][4], out[COUNT][4];
    glint_measure *snell = trial_error(t, "η sin θi − sin θt", "u·max(1, η)", 4);
    glint_measure *lengths = trial_error(t, "|t| beside 1", "u·max(1, η²)/cos θt", 8);
    glint_measure *mirrored = trial_error(t, "the reflected direction", "u", 4);
    glint_measure *sides = trial_events(t, "rays on the wrong side of 5.739° from 10 to 1", 0);
    // Directions for η = 10 and η = 1/10.
    for (int i = 0; i < COUNT; i++) {
        in[i][1] = i % 2 ? 10 : 0.1;
        // From index 10 most rays are totally reflected. Take the others.
        in[i][0] = i % 2 ? cos(trial_random(t, 0, 0.0995)) : trial_random(t, 0, 1);
    }
    TRY(call_functions(t, GLINT_PROBE_DIRECTIONS, in, out, COUNT));
    for (int i = 0; i < COUNT; i++) {
        const double cosine = in[i][0], eta = in[i][1], scale = fmax(1, eta);
        const double sine = sqrt((1 - cosine) * (1 + cosine));
        measure_value(snell, -out[i][0], eta * sine, t->u * scale, "cos θ %.9g, η %g", cosine, eta);
        measure_value(mirrored, hypot(out[i][2] + sine, out[i][3] - cosine), 0, t->u, "cos θ %.9g",
                      cosine);
        const double root = sqrt(fmax(0, transmitted_squared(cosine, eta)));
        measure_value(lengths, hypot(out[i][0], out[i][1]), 1, t->u * fmax(1, eta * eta) / root,
                      "cos θ %.9g, η %g", cosine, eta);
    }
    // The side of the critical angle from index 10.
    for (int i = 0; i < COUNT; i++) {
        const double away = trial_random(t, 1e-4, 5);
        in[i][1] = 10;
        in[i][0] = cos((5.739170 + (i % 2 ? away : -away)) * GLINT_PI / 180);
    }
    TRY(call_functions(t, GLINT_PROBE_FRESNEL, in, out, COUNT));
    for (int i = 0; i < COUNT; i++) {
        measure_event(sides, isnan(out[i][0]) || (out[i][0] >= 0) != (i % 2 == 0),
                      "cos θ %.9g: cos² θt %.3g", in[i][0], out[i][0]);
    }
    return GLINT_OK;
}

// ---- Fresnel's term ----------------------------------------------------------------------------

static glint_status fresnel_at_its_ends(trial *t)
{
    enum { COUNT = 8 * INDEX_COUNT };
    static double in[COUNT][4], out[COUNT][4];
    glint_measure *head_on = trial_error(t, "((n − 1)/(n + 1))² at 0°", "u", 16);
    glint_measure *grazing = trial_error(t, "1 at 90°", "u", 16);
    glint_measure *brewster = trial_error(t, "R_p = 0 at Brewster's angle", "u", 16);
    glint_measure *between = trial_error(t, "in between", "u", 16);
    // This takes 1/η by two more divisions. OpenCL lets each err by 5u; R changes by no more than η
    // does.
    glint_measure *surfaces =
        trial_error(t, "all of these from an index, as paint takes it", "u", 16);
    // Choose angles at both ends, at Brewster's angle and between.
    for (size_t i = 0; i < COUNT; i++) {
        const double n = indices[i / 8];
        const double angles[] = {0, GLINT_PI / 2, atan(n), 0.2, 0.6, 1, 1.3, 1.5};
        in[i][0] = i % 8 == 1 ? 0 : cos(angles[i % 8]);
        in[i][1] = 1 / n;
    }
    // Compare with the closed forms.
    TRY(call_functions(t, GLINT_PROBE_FRESNEL, in, out, COUNT));
    for (size_t i = 0; i < COUNT; i++) {
        const double n = indices[i / 8], got = out[i][1];
        if (i % 8 == 0) {
            measure_value(head_on, got, pow((n - 1) / (n + 1), 2), t->u, "n %g", n);
        } else if (i % 8 == 1) {
            measure_value(grazing, got, 1, t->u, "n %g", n);
        } else if (i % 8 == 2) {
            // r_s is sin(θi − θt). With θi + θt a right angle it is −cos 2θi. Half of its square
            // remains.
            measure_value(brewster, got, 0.5 * pow((n * n - 1) / (n * n + 1), 2), t->u, "n %g", n);
        } else {
            measure_value(between, got, reflectance(in[i][0], in[i][1]), t->u, "n %g, cos θ %.9g",
                          n, in[i][0]);
        }
        measure_value(surfaces, out[i][2], reflectance(in[i][0], in[i][1]), t->u,
                      "n %g, cos θ %.9g", n, in[i][0]);
    }
    return GLINT_OK;
}

static glint_status metal_at_its_ends(trial *t)
{
    enum { COUNT = 1024 };
    static double in[COUNT][4], out[COUNT][4];
    glint_measure *errors = trial_error(t, "F0 + (1 − F0)(1 − cos θ)⁵", "u", 8);
    for (int i = 0; i < COUNT; i++) {
        in[i][0] = i % 4 == 0 ? 0 : i % 4 == 1 ? 1 : trial_random(t, 0, 1);
        in[i][1] = i % 5 == 0 ? 0 : i % 5 == 1 ? 1 : trial_random(t, 0, 1);
    }
    TRY(call_functions(t, GLINT_PROBE_METAL, in, out, COUNT));
    for (int i = 0; i < COUNT; i++) {
        const double expected = in[i][1] + (1 - in[i][1]) * pow(1 - in[i][0], 5);
        measure_value(errors, out[i][0], expected, t->u, "F0 %.9g, cos θ %.9g", in[i][1], in[i][0]);
    }
    return GLINT_OK;
}

// ---- High indices ------------------------------------------------------------------------------

// A surface that reflects, and the largest of the colours of KHR_materials_specular.
typedef struct high_index {
    double ior, specular, color;
    bool is_paint; // else glass without thickness
} high_index;

// Rule 6 in long double. Glass has Fresnel's term at every index. Paint has it up to 2 + √3, and
// Schlick's from 6 on.
static double expected_of(const high_index *of, double cosine)
{
    const long double n = (long double)(float)of->ior, root = (n - 1) / (n + 1), f0 = root * root;
    const long double a = 2 - sqrtl(3), b = (a - 1 / n) / (a - 1 / 6.0L);
    const long double e = of->is_paint ? fminl(fmaxl(b, 0), 1) : 0;
    const long double schlick = f0 + (1 - f0) * powl(1 - (long double)cosine, 5);
    const long double f = (1 - e) * (long double)reflectance(cosine, (double)(1 / n)) + e * schlick;
    const long double from = fminl((long double)(float)of->color * f0, 1);
    const long double w = f0 < 1 ? (f - f0) / (1 - f0) : powl(1 - (long double)cosine, 5);
    return (double)((long double)(float)of->specular *
                    (w < 0 ? from * f / f0 : from + (1 - from) * w));
}

static glint_status measure_high_index(trial *t, const high_index *of, glint_measure *errors)
{
    enum { COUNT = 64 };
    static const double corners[4][3] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    static glint_probe_ray rays[COUNT];
    static glint_probe_bounce bounces[COUNT];
    glint_scene scene = {0};
    glint_probe *probe = NULL;
    glint_status status;
    const shape_material which = of->is_paint ? MATERIAL_PAINT : MATERIAL_GLASS;
    shape s = shape_begin();
    shape_add_quad(&s, corners, which);
    TRY_OR(cleanup, status, shape_end(&s, &scene, t->error));
    glint_material *m = &scene.materials[which];
    m->roughness = m->thickness = 0;
    m->ior = (float)of->ior;
    m->specular = (float)of->specular;
    m->specular_color[0] = (float)of->color;
    m->specular_color[1] = m->specular_color[2] = 0;
    TRY_OR(cleanup, status, trial_probe(t, &scene, &probe));
    for (int i = 0; i < COUNT; i++) {
        const double angle = i == 0 ? 0 : GLINT_PI / 2 * i / COUNT;
        const double d[3] = {sin(angle), 0, -cos(angle)};
        rays[i] = (glint_probe_ray){.from = -1};
        for (int k = 0; k < 3; k++) {
            rays[i].direction[k] = trial_rounded(t, d[k]);
            rays[i].origin[k] = trial_rounded(t, -0.5 * d[k]);
        }
    }
    TRY_OR(cleanup, status, trial_bounce(t, probe, rays, bounces, COUNT));
    for (int i = 0; i < COUNT; i++) {
        measure_value(errors, bounces[i].reflected_weight, expected_of(of, bounces[i].cosine), t->u,
                      "%s of ior %g, specular %g × %g, cos θ %.9g",
                      of->is_paint ? "paint" : "glass", of->ior, of->specular, of->color,
                      bounces[i].cosine);
    }
cleanup:
    glint_probe_free(probe);
    glint_scene_free(&scene);
    return status;
}

// Fresnel's term errs by 16u (see fresnel_at_its_ends). The colour divides this by 1 − F0, which is
// 0.49 or more up to index 6. Above it only Schlick's term is left.
static glint_status high_indices(trial *t)
{
    static const double iors[] = {1.5, 2.42, 3.7, 3.8, 4.5, 5.5, 6, 8, 1000, GLINT_IOR_INFINITE};
    glint_measure *paint = trial_error(t, "what paint reflects", "u", 48);
    glint_measure *glass = trial_error(t, "what glass reflects, index up to 5.5", "u", 48);
    for (size_t i = 0; i < sizeof iors / sizeof *iors; i++) {
        const high_index looks[] = {{iors[i], 1, 1, true},
                                    {iors[i], 1, 0.25, true},
                                    {iors[i], 0.5, 20, true},
                                    {iors[i], 1, 1, false},
                                    {iors[i], 0.5, 0.25, false}};
        for (size_t k = 0; k < sizeof looks / sizeof *looks; k++) {
            if (looks[k].is_paint || iors[i] < 6) {
                TRY(measure_high_index(t, &looks[k], looks[k].is_paint ? paint : glass));
            }
        }
    }
    return GLINT_OK;
}

const trial_case refraction_cases[] = {
    {"critical_angle", "rays to both sides of total reflection: the right side, the reflectance",
     critical_angle},
    {"equal_indices", "η of 1 and 1 ± 10^−7: next to nothing reflected or bent", equal_indices},
    {"extreme_indices", "η of 0.1 and 10: Snell's law, and total reflection from 5.739° on",
     extreme_indices},
    {"fresnel_at_its_ends", "Fresnel's term at 0°, at 90°, at Brewster's angle, in between",
     fresnel_at_its_ends},
    {"high_indices",
     "paint of index 1.5 to 3·10^38: Fresnel's term, then Schlick's, without a jump; glass",
     high_indices},
    {"metal_at_its_ends", "Schlick's term for metal, against the formula", metal_at_its_ends},
    {0},
};
