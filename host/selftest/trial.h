// Supports a case of the self-test that runs at one width and precision.
#ifndef GLINT_SELFTEST_TRIAL_H
#define GLINT_SELFTEST_TRIAL_H

#include "base/random.h"
#include "image/image.h"
#include "render/frame.h"
#include "render/layers.h"
#include "render/probe.h"
#include "selftest/selftest.h"
#include "selftest/shapes.h"

typedef struct trial {
    const glint_selftest_options *options;
    double u;            // the largest relative rounding error: 2⁻²⁴ or 2⁻⁵³
    glint_random random; // starts with a seed of the case
    glint_selftest_result *result;
    glint_error *error;
} trial;

typedef glint_status trial_body(trial *t);

typedef struct trial_case {
    const char *name, *summary;
    trial_body *run;
} trial_case;

// The cases of each file. A NULL name ends a list.
extern const trial_case hit_cases[], scale_cases[], spawn_cases[], normal_cases[],
    refraction_cases[], solid_cases[], environment_cases[], path_cases[], surface_cases[],
    rough_cases[], rim_cases[], media_cases[], light_cases[], image_cases[], place_cases[],
    material_cases[], output_cases[], chance_cases[];

// ---- Measures ----------------------------------------------------------------------------------
// Each function adds a measure to the trial's result. Texts are static.

// Measures the largest error, in `unit`.
glint_measure *trial_error(trial *t, const char *what, const char *unit, double bound);
// Counts events.
glint_measure *trial_events(trial *t, const char *what, double bound);
// Measures the share of events among everything judged.
glint_measure *trial_share(trial *t, const char *what, double bound);

// Records an error; NaN is the largest error. The text names the value, if it is the worst so far.
void measure_error(glint_measure *m, double error, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// Records |got − expected|/scale. The text gets both values and their distance in ulp.
void measure_value(glint_measure *m, double got, double expected, double scale, const char *format,
                   ...) __attribute__((format(printf, 5, 6)));

// Records the error of a vector: the length of the difference.
void measure_vector(glint_measure *m, const double got[3], const double expected[3], double scale,
                    const char *format, ...) __attribute__((format(printf, 5, 6)));

// Judges one thing: did the unwanted event happen? The first event is described.
void measure_event(glint_measure *m, bool happened, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// Units in the last place between two values, in the trial's precision.
double trial_ulps(const trial *t, double got, double expected);

// ---- Numbers -----------------------------------------------------------------------------------

double trial_random(trial *t, double low, double high);
// The value that the device gets: rounded to float in single precision.
double trial_rounded(const trial *t, double value);

// A ray from one place to another, in stored coordinates, each rounded.
glint_probe_ray trial_aim(const trial *t, const double from[3], const double to[3]);
// A ray in a random direction.
glint_probe_ray trial_random_ray(trial *t, const double from[3]);

// ---- The renderer ------------------------------------------------------------------------------

// Makes probes of a scene under E(d) = ½ + ½d, with depth auto. All features are compiled in, so
// most cases share their kernels. (Fresnel's term is compiled in only if the scene needs it. So a
// scene of white mirrors alone would need another compilation.)
glint_status trial_probe(const trial *t, const glint_scene *scene, glint_probe **probe);
// Makes probes under another environment, with an empty scene.
glint_status trial_probe_environment(const trial *t, const glint_environment *environment,
                                     glint_probe **probe);
// Ends the shape and makes probes of its scene. The caller frees both, even after a failure.
glint_status trial_build(const trial *t, shape *s, glint_scene *scene, glint_probe **probe);
// Makes probes with an empty scene, to call functions of numbers alone.
glint_status trial_functions(const trial *t, glint_probe **probe);

// Elements of four numbers. `in` and `out` may be the same.
typedef struct trial_numbers {
    double (*in)[4], (*out)[4];
    size_t count;
} trial_numbers;

// Calls a probe's part on elements of four numbers.
glint_status trial_call(trial *t, glint_probe *probe, glint_probe_part part,
                        const trial_numbers *numbers);
glint_status trial_trace(trial *t, glint_probe *probe, const glint_probe_ray *rays,
                         glint_probe_hit *hits, size_t count);
glint_status trial_bounce(trial *t, glint_probe *probe, const glint_probe_ray *rays,
                          glint_probe_bounce *bounces, size_t count);

// Makes an environment: E(d) = ½ + ½d, which bilinear look-ups give within 2/edge²; or a uniform
// one.
glint_status trial_linear_environment(int edge, glint_environment *environment, glint_error *error);
glint_status trial_uniform_environment(float radiance, glint_environment *environment,
                                       glint_error *error);

// A frame as the device computed it.
typedef struct trial_picture {
    int width, height;
    double *values; // [height][width][4], owned
    glint_frame_report report;
    glint_plan plan;
    glint_layers layers; // layers and terms that the settings ask for
} trial_picture;

// Settings of frames at the trial's width and precision: 64 × 48 pixels, min_weight 0.
glint_settings trial_settings(const trial *t);
// The same for lobes, which take the oracle long: 16 × 12 pixels, exact lobes, 1024 facets.
glint_settings trial_lobe_settings(const trial *t, int depth);
// The renderer's inputs on the trial's device. Borrows everything.
glint_renderer_inputs trial_inputs(const trial *t, const glint_scene *scene,
                                   const glint_environment *environment,
                                   const glint_settings *settings);

glint_status trial_frame(trial *t, const glint_renderer_inputs *inputs, const glint_camera *camera,
                         trial_picture *picture);
void trial_picture_free(trial_picture *picture);

#endif
