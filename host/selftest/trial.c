// Supports the cases of the self-test. See trial.h.
#include "selftest/trial.h"

#include "base/memory.h"
#include "selftest/vectors.h"

#include <assert.h>
#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ---- Measures ----------------------------------------------------------------------------------

static glint_measure *add_measure(trial *t, const char *what, const char *unit, double bound)
{
    assert(t->result->measure_count < GLINT_SELFTEST_MEASURES);
    glint_measure *m = &t->result->measures[t->result->measure_count++];
    *m = (glint_measure){.what = what,
                         .unit = unit,
                         .bound = bound,
                         .in_double = t->options->precision == GLINT_PRECISION_DOUBLE};
    return m;
}

glint_measure *trial_error(trial *t, const char *what, const char *unit, double bound)
{
    return add_measure(t, what, unit, bound);
}

glint_measure *trial_events(trial *t, const char *what, double bound)
{
    return add_measure(t, what, "", bound);
}

glint_measure *trial_share(trial *t, const char *what, double bound)
{
    glint_measure *m = add_measure(t, what, "", bound);
    m->is_share = true;
    return m;
}

static double ulps(bool is_double, double got, double expected)
{
    int exponent;
    frexp(fmax(fabs(expected), DBL_MIN), &exponent);
    const int least = is_double ? -1074 : -149;
    const int unit = exponent - (is_double ? 53 : 24);
    return (got - expected) / ldexp(1, unit > least ? unit : least);
}

double trial_ulps(const trial *t, double got, double expected)
{
    return ulps(t->options->precision == GLINT_PRECISION_DOUBLE, got, expected);
}

// True if `error` is the worst so far.
static bool takes_lead(glint_measure *m, double error)
{
    m->judged++;
    // NaN takes the lead, and only once.
    if (isnan(m->measured) || error <= m->measured) {
        return false;
    }
    m->measured = error;
    return true;
}

void measure_error(glint_measure *m, double error, const char *format, ...)
{
    if (takes_lead(m, error)) {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(m->worst, sizeof m->worst, format, arguments);
        va_end(arguments);
    }
}

static void append(glint_measure *m, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void append(glint_measure *m, const char *format, ...)
{
    const size_t used = strlen(m->worst);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(m->worst + used, sizeof m->worst - used, format, arguments);
    va_end(arguments);
}

void measure_value(glint_measure *m, double got, double expected, double scale, const char *format,
                   ...)
{
    if (takes_lead(m, got == expected ? 0 : fabs(got - expected) / scale)) {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(m->worst, sizeof m->worst, format, arguments);
        va_end(arguments);
        append(m, ": expected %.9g, got %.9g (%+.3g ulp)", expected, got,
               ulps(m->in_double, got, expected));
    }
}

void measure_vector(glint_measure *m, const double got[3], const double expected[3], double scale,
                    const char *format, ...)
{
    double squares = 0;
    int largest = 0;
    for (int k = 0; k < 3; k++) {
        squares += (got[k] - expected[k]) * (got[k] - expected[k]);
        largest = fabs(got[k] - expected[k]) > fabs(got[largest] - expected[largest]) ? k : largest;
    }
    if (takes_lead(m, sqrt(squares) / scale)) {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(m->worst, sizeof m->worst, format, arguments);
        va_end(arguments);
        append(m, ": expected (%.9g, %.9g, %.9g), got (%.9g, %.9g, %.9g) (%c by %+.3g ulp)",
               expected[0], expected[1], expected[2], got[0], got[1], got[2], "xyz"[largest],
               ulps(m->in_double, got[largest], expected[largest]));
    }
}

void measure_event(glint_measure *m, bool happened, const char *format, ...)
{
    m->judged++;
    if (happened && m->measured++ == 0) {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(m->worst, sizeof m->worst, format, arguments);
        va_end(arguments);
    }
}

// ---- Numbers -----------------------------------------------------------------------------------

double trial_random(trial *t, double low, double high)
{
    return low + (high - low) * glint_random_number(&t->random);
}

double trial_rounded(const trial *t, double value)
{
    return t->options->precision == GLINT_PRECISION_DOUBLE ? value : (double)(float)value;
}

glint_probe_ray trial_aim(const trial *t, const double from[3], const double to[3])
{
    glint_probe_ray ray = {.from = -1};
    for (int k = 0; k < 3; k++) {
        ray.origin[k] = trial_rounded(t, from[k]);
        ray.direction[k] = to[k] - ray.origin[k];
    }
    make_unit(ray.direction);
    for (int k = 0; k < 3; k++) {
        ray.direction[k] = trial_rounded(t, ray.direction[k]);
    }
    return ray;
}

glint_probe_ray trial_random_ray(trial *t, const double from[3])
{
    const glint_vec3 d = glint_random_direction(&t->random);
    const double to[3] = {from[0] + d.x, from[1] + d.y, from[2] + d.z};
    return trial_aim(t, from, to);
}

// ---- Environments ------------------------------------------------------------------------------

glint_status trial_linear_environment(int edge, glint_environment *environment, glint_error *error)
{
    *environment = (glint_environment){0};
    glint_cube *cube = &environment->radiance;
    TRY(glint_cube_create(edge, cube, error));
    for (int texel = 0; texel < GLINT_CUBE_FACES * edge * edge; texel++) {
        const int face = texel / (edge * edge), j = texel / edge % edge, i = texel % edge;
        const glint_vec3 d = glint_vec3_normalize(
            glint_cube_direction(face, (2.0 * i + 1) / edge - 1, (2.0 * j + 1) / edge - 1));
        float *rgb = glint_cube_texel(cube, face, i, j);
        rgb[0] = (float)(0.5 + 0.5 * d.x);
        rgb[1] = (float)(0.5 + 0.5 * d.y);
        rgb[2] = (float)(0.5 + 0.5 * d.z);
    }
    glint_cube_fill_border(cube);
    return GLINT_OK;
}

glint_status trial_uniform_environment(float radiance, glint_environment *environment,
                                       glint_error *error)
{
    *environment = (glint_environment){0};
    glint_cube *cube = &environment->radiance;
    TRY(glint_cube_create(4, cube, error));
    for (size_t i = 0; i < glint_cube_size(cube); i++) {
        cube->texels[i] = radiance;
    }
    return GLINT_OK;
}

// ---- Probes ------------------------------------------------------------------------------------

static glint_status make_probe(const trial *t, const glint_scene *scene,
                               const glint_environment *environment, glint_probe **probe)
{
    glint_settings settings = trial_settings(t);
    settings.all_features = true;
    settings.texels = GLINT_TEXELS_FLOAT;
    const glint_renderer_inputs inputs = trial_inputs(t, scene, environment, &settings);
    return glint_probe_create(&inputs, probe, t->error);
}

glint_status trial_probe(const trial *t, const glint_scene *scene, glint_probe **probe)
{
    glint_environment environment;
    *probe = NULL;
    glint_status status;
    TRY_OR(cleanup, status, trial_linear_environment(16, &environment, t->error));
    TRY_OR(cleanup, status, make_probe(t, scene, &environment, probe));
cleanup:
    glint_environment_free(&environment);
    return status;
}

glint_status trial_build(const trial *t, shape *s, glint_scene *scene, glint_probe **probe)
{
    *probe = NULL;
    TRY(shape_end(s, scene, t->error));
    return trial_probe(t, scene, probe);
}

glint_status trial_probe_environment(const trial *t, const glint_environment *environment,
                                     glint_probe **probe)
{
    static const double corners[3][3] = {{0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}};
    glint_scene scene;
    *probe = NULL;
    shape s = shape_begin();
    shape_add(&s, corners, NULL, MATERIAL_TINTED);
    glint_status status;
    TRY_OR(cleanup, status, shape_end(&s, &scene, t->error));
    TRY_OR(cleanup, status, make_probe(t, &scene, environment, probe));
cleanup:
    glint_scene_free(&scene);
    return status;
}

glint_status trial_functions(const trial *t, glint_probe **probe)
{
    glint_environment environment;
    *probe = NULL;
    glint_status status;
    TRY_OR(cleanup, status, trial_linear_environment(16, &environment, t->error));
    TRY_OR(cleanup, status, trial_probe_environment(t, &environment, probe));
cleanup:
    glint_environment_free(&environment);
    return status;
}

glint_status trial_call(trial *t, glint_probe *probe, glint_probe_part part,
                        const trial_numbers *numbers)
{
    return glint_probe_call(
        probe, &(glint_probe_work){part, NULL, numbers->in[0], numbers->out[0], numbers->count},
        t->error);
}

glint_status trial_trace(trial *t, glint_probe *probe, const glint_probe_ray *rays,
                         glint_probe_hit *hits, size_t count)
{
    return glint_probe_call(
        probe, &(glint_probe_work){GLINT_PROBE_TRACE, NULL, rays->origin, &hits->distance, count},
        t->error);
}

glint_status trial_bounce(trial *t, glint_probe *probe, const glint_probe_ray *rays,
                          glint_probe_bounce *bounces, size_t count)
{
    return glint_probe_call(probe,
                            &(glint_probe_work){GLINT_PROBE_BOUNCE_RAYS, NULL, rays->origin,
                                                &bounces->hit.distance, count},
                            t->error);
}

// ---- Frames ------------------------------------------------------------------------------------

glint_settings trial_settings(const trial *t)
{
    glint_settings settings = glint_settings_default;
    settings.width = 64;
    settings.height = 48;
    settings.depth = GLINT_DEPTH_MAX; // like auto, except for scenes with a proved depth
    settings.min_weight = 0;
    settings.roughness = GLINT_ROUGHNESS_SMOOTH;
    settings.precision = t->options->precision;
    settings.kernel_width = t->options->width;
    settings.kernels = t->options->kernels;
    return settings;
}

glint_settings trial_lobe_settings(const trial *t, int depth)
{
    glint_settings settings = trial_settings(t);
    settings.width = 16;
    settings.height = 12;
    settings.depth = depth;
    settings.roughness = GLINT_ROUGHNESS_EXACT;
    settings.facets = 1024;
    return settings;
}

glint_renderer_inputs trial_inputs(const trial *t, const glint_scene *scene,
                                   const glint_environment *environment,
                                   const glint_settings *settings)
{
    return (glint_renderer_inputs){
        .device = t->options->device,
        .scene = scene,
        .environment = environment,
        .settings = settings,
        .kernel_dir = t->options->kernel_dir,
    };
}

static glint_status read_picture(glint_renderer *renderer, const glint_image *image,
                                 trial_picture *picture, glint_error *error)
{
    picture->width = image->width;
    picture->height = image->height;
    picture->plan = *glint_renderer_plan(renderer);
    if (picture->plan.precision == GLINT_PRECISION_DOUBLE) {
        return glint_renderer_exact_pixels(renderer, &picture->values, error);
    }
    const size_t count = (size_t)image->width * (size_t)image->height * 4;
    picture->values = glint_allocate_unset(count, sizeof *picture->values);
    if (picture->values == NULL) {
        return glint_fail_memory(error, "a picture");
    }
    for (size_t i = 0; i < count; i++) {
        picture->values[i] = (double)image->pixels[i];
    }
    return GLINT_OK;
}

// Notes which features the frame's plan has.
static void note_features(const glint_plan *plan, glint_selftest_result *result)
{
    uint64_t set = 0;
    _Static_assert(GLINT_FEATURE_COUNT <= 64, "a set has a bit for each feature");
    for (int i = 0; i < GLINT_FEATURE_COUNT; i++) {
        set |= (uint64_t)plan->features[i].compiled << i;
    }
    int k = 0;
    while (k < result->feature_set_count && result->feature_sets[k] != set) {
        k++;
    }
    if (k == result->feature_set_count && k < GLINT_SELFTEST_FEATURE_SETS) {
        result->feature_sets[result->feature_set_count++] = set;
    }
}

glint_status trial_frame(trial *t, const glint_renderer_inputs *inputs, const glint_camera *camera,
                         trial_picture *picture)
{
    *picture = (trial_picture){0};
    glint_renderer *renderer = NULL;
    glint_image image = {0};
    glint_status status;
    TRY_OR(cleanup, status, glint_renderer_create(inputs, &renderer, t->error));
    TRY_OR(cleanup, status,
           glint_renderer_frame(
               &(glint_frame_request){renderer, camera, NULL, &image, &picture->report}, t->error));
    TRY_OR(cleanup, status, read_picture(renderer, &image, picture, t->error));
    if (!inputs->settings->all_features) {
        note_features(&picture->plan, t->result);
    }
    if (inputs->settings->aovs != 0 || inputs->settings->terms > 0) {
        TRY_OR(cleanup, status, glint_renderer_layers(renderer, &picture->layers, t->error));
    }
cleanup:
    glint_image_free(&image);
    glint_renderer_free(renderer);
    return status;
}

void trial_picture_free(trial_picture *picture)
{
    free(picture->values);
    glint_layers_free(&picture->layers);
    *picture = (trial_picture){0};
}
