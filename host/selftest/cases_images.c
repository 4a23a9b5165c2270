// Tests hard cases of cameras and sizes: parallel rays, angles of 0.01° and 179°, pictures of one
// pixel and of one row, numbers beyond 2^31.
#include "selftest/shapes.h"
#include "selftest/trial.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

static const double eye[3] = {0.25, 0.125, 0.75}, target[3] = {-0.1, 0.05, -0.5};

// ---- Ray set-up --------------------------------------------------------------------------------

static double component(glint_vec3 v, int k)
{
    return k == 0 ? v.x : k == 1 ? v.y : v.z;
}

// The unit direction through a pixel's middle, computed in long double.
static void direction_of(const glint_camera *camera, const int size[2], double column, double row,
                         double d[3])
{
    const long double half = camera->orthographic ? 0 : tanl((long double)camera->yfov / 2);
    const long double x = half * (2 * (column + 0.5L) - size[0]) / size[1];
    const long double y = half * (size[1] - 2 * (row + 0.5L)) / size[1];
    long double v[3], squares = 0;
    for (int k = 0; k < 3; k++) {
        v[k] = x * component(camera->right, k) + y * component(camera->up, k) -
               component(camera->back, k);
        squares += v[k] * v[k];
    }
    for (int k = 0; k < 3; k++) {
        d[k] = (double)(v[k] / sqrtl(squares));
    }
}

// Makes a probe and the frame record of a camera's frame.
static glint_status view_probe(trial *t, const glint_camera *camera, const int size[2],
                               glint_probe **probe, glint_frame_record *frame)
{
    TRY(trial_functions(t, probe));
    glint_settings settings = trial_settings(t);
    settings.width = size[0];
    settings.height = size[1];
    glint_probe_view(*probe, camera, &settings, frame);
    return GLINT_OK;
}

// The error of a direction: forward + X right + Y up is rounded term by term, then normalised. A
// start is such a sum too. In double precision the three vectors are sums of two floats, good to
// 2^-49: 16u.
static double sum_bound(const trial *t)
{
    return t->options->precision == GLINT_PRECISION_DOUBLE ? 16 : 4;
}

// The distance of a primary ray's start from its exact half-line, in long double, over the farthest
// coordinate. The start may be anywhere on the line: kernels start where the scene begins.
static double start_error(const glint_camera *camera, const int size[2], const double pixel[2],
                          const double start[3])
{
    double d[3];
    direction_of(camera, size, pixel[0], pixel[1], d);
    const long double half = camera->orthographic ? (long double)camera->ymag : 0;
    const long double x = half * (2 * (pixel[0] + 0.5L) - size[0]) / size[1];
    const long double y = half * (size[1] - 2 * (pixel[1] + 0.5L)) / size[1];
    long double away[3], along = 0, squares = 0;
    double farthest = 1;
    for (int k = 0; k < 3; k++) {
        away[k] = start[k] - component(camera->eye, k) - x * component(camera->right, k) -
                  y * component(camera->up, k);
        along += away[k] * d[k];
        farthest = fmax(farthest, fabs(start[k]));
    }
    along = along > 0 ? along : 0;
    for (int k = 0; k < 3; k++) {
        squares += (away[k] - along * d[k]) * (away[k] - along * d[k]);
    }
    return (double)sqrtl(squares) / farthest;
}

typedef struct ray_measures {
    glint_measure *directions, *starts;
} ray_measures;

static ray_measures measures_of_rays(trial *t)
{
    return (ray_measures){
        trial_error(t, "directions of primary rays", "u", sum_bound(t)),
        trial_error(t, "from their starts to their lines", "u", sum_bound(t)),
    };
}

// Measures rays at the corners, the edges' middles, the middle, and anywhere.
static glint_status measure_rays(trial *t, const glint_camera *camera, const int size[2],
                                 const ray_measures *judged, const char *what)
{
    enum { COUNT = 512 };
    static double in[COUNT][4], out[COUNT][4], from[COUNT][4];
    // Choose the pixels.
    glint_probe *probe;
    glint_frame_record frame;
    glint_status status;
    TRY_OR(cleanup, status, view_probe(t, camera, size, &probe, &frame));
    for (int i = 0; i < COUNT; i++) {
        const int columns[3] = {0, size[0] / 2, size[0] - 1},
                  rows[3] = {0, size[1] / 2, size[1] - 1};
        in[i][0] = i < 9 ? columns[i % 3] : floor(trial_random(t, 0, size[0]));
        const int which = i / 3 % 3;
        in[i][1] = i < 9 ? rows[which] : floor(trial_random(t, 0, size[1]));
    }
    // Get directions and starts.
    TRY_OR(cleanup, status,
           glint_probe_call(probe,
                            &(glint_probe_work){GLINT_PROBE_PRIMARY, &frame, in[0], out[0], COUNT},
                            t->error));
    TRY_OR(cleanup, status,
           glint_probe_call(
               probe,
               &(glint_probe_work){GLINT_PROBE_PRIMARY_ORIGIN, &frame, in[0], from[0], COUNT},
               t->error));
    // Compare them with long double.
    for (int i = 0; i < COUNT; i++) {
        double expected[3];
        direction_of(camera, size, in[i][0], in[i][1], expected);
        measure_vector(judged->directions, out[i], expected, t->u, "%s, pixel (%g, %g)", what,
                       in[i][0], in[i][1]);
        measure_error(judged->starts, start_error(camera, size, in[i], from[i]) / t->u,
                      "%s, pixel (%g, %g): (%.9g, %.9g, %.9g)", what, in[i][0], in[i][1],
                      from[i][0], from[i][1], from[i][2]);
    }
cleanup:
    glint_probe_free(probe);
    return status;
}

static glint_status extreme_cameras(trial *t)
{
    static const struct {
        const char *what;
        double degrees;
    } cameras[] = {
        {"parallel rays", 0}, {"0.01°", 0.01}, {"45°", 45}, {"179°", 179}, {"179.99°", 179.99}};
    static const int size[2] = {1920, 1080};
    const ray_measures judged = measures_of_rays(t);
    for (size_t i = 0; i < sizeof cameras / sizeof *cameras; i++) {
        const glint_camera camera =
            shape_camera(eye, target, cameras[i].degrees * GLINT_PI / 180, 0.5);
        TRY(measure_rays(t, &camera, size, &judged, cameras[i].what));
    }
    return GLINT_OK;
}

// ---- Odd sizes ---------------------------------------------------------------------------------

// Renders an empty scene, which shows only the environment.
static glint_status measure_sky(trial *t, const glint_camera *camera, const int size[2],
                                const glint_environment *environment, glint_measure *pixels)
{
    const glint_scene empty = {.unit = 1, .low = {1, 1, 1}, .high = {-1, -1, -1}};
    glint_settings settings = trial_settings(t);
    settings.width = size[0];
    settings.height = size[1];
    trial_picture picture;
    const glint_renderer_inputs inputs = trial_inputs(t, &empty, environment, &settings);
    TRY(trial_frame(t, &inputs, camera, &picture));
    for (int p = 0; p < picture.width * picture.height; p++) {
        double d[3];
        const int column = p % picture.width, row = p / picture.width;
        direction_of(camera, size, column, row, d);
        for (int k = 0; k < 3; k++) {
            measure_value(pixels, picture.values[4 * p + k], 0.5 + 0.5 * d[k],
                          2.0 / 256 + 16 * t->u, "%d×%d, pixel %d", size[0], size[1], p);
        }
    }
    trial_picture_free(&picture);
    return GLINT_OK;
}

static glint_status odd_sizes(trial *t)
{
    static const int sizes[][2] = {{1, 1},     {1, 7},   {7, 1},        {1, 4097},
                                   {65536, 1}, {17, 33}, {65536, 65536}};
    const ray_measures judged = measures_of_rays(t);
    glint_measure *pixels = trial_error(t, "colours of the empty scene", "2/edge² + u", 1);
    const glint_camera camera = shape_camera(eye, target, 0.7, 0);
    glint_environment environment = {0};
    glint_status status;
    TRY_OR(cleanup, status, trial_linear_environment(16, &environment, t->error));
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        char what[32];
        snprintf(what, sizeof what, "%d×%d", sizes[i][0], sizes[i][1]);
        TRY_OR(cleanup, status, measure_rays(t, &camera, sizes[i], &judged, what));
        if ((double)sizes[i][0] * sizes[i][1] < 1e6) {
            TRY_OR(cleanup, status, measure_sky(t, &camera, sizes[i], &environment, pixels));
        }
    }
cleanup:
    glint_environment_free(&environment);
    return status;
}

// ---- Numbers beyond 2^31 -----------------------------------------------------------------------

#define TILES 64

// Checks the places of tiles in a square picture, from the first to the last. An int would overflow
// there.
static glint_status measure_places(trial *t, int edge, glint_measure *wrong)
{
    static double in[TILES][4], out[TILES][4];
    const int size[2] = {edge, edge};
    glint_probe *probe;
    glint_frame_record frame;
    TRY(view_probe(t, NULL, size, &probe, &frame));
    // Describe a frame of bands of tiles.
    const glint_plan *plan = glint_probe_plan(probe);
    const int lanes = plan->kernel_width, side = GLINT_TILE_SIDE(plan->tiles);
    const int width = GLINT_PACKET_COLUMNS(lanes) * side, height = GLINT_PACKET_ROWS(lanes) * side;
    frame.width = frame.height = edge;
    frame.band = 4;
    frame.first_band = 3;
    // Choose tiles over the whole picture.
    for (int p = 0; p < TILES; p++) {
        const int column = p % 8 * ((edge - 1) / width) / 7;
        const int row = p / 8 * ((edge - 1) / height) / 7 - frame.first_band * frame.band;
        const int above = row > 0 ? row : 0;
        const int in_band = above % frame.band, band = above / frame.band;
        in[p][0] = column * frame.band + in_band;
        in[p][1] = band;
    }
    glint_status status;
    TRY_OR(cleanup, status,
           glint_probe_call(
               probe, &(glint_probe_work){GLINT_PROBE_TILE_PLACE, &frame, in[0], out[0], TILES},
               t->error));
    // Compare their places with 64-bit arithmetic.
    for (int p = 0; p < TILES; p++) {
        const int64_t across = (int64_t)in[p][0], down = (int64_t)in[p][1];
        const int64_t column = across / frame.band * width;
        const int64_t row = ((down + frame.first_band) * frame.band + across % frame.band) * height;
        const int64_t place = 4 * (row * edge + column);
        const double got = out[p][2] * 0x1p24 + out[p][3];
        measure_event(wrong, out[p][0] != column || out[p][1] != row || got != (double)place,
                      "%d×%d pixels, tile at (%lld, %lld): (%g, %g), value %.17g instead of %lld",
                      edge, edge, (long long)column, (long long)row, out[p][0], out[p][1], got,
                      (long long)place);
    }
cleanup:
    glint_probe_free(probe);
    return status;
}

static glint_status large_numbers(trial *t)
{
    static const int edges[] = {23170, 23171, 46340, 46341, 65536};
    glint_measure *wrong = trial_events(t, "tiles that would be written elsewhere", 0);
    for (size_t i = 0; i < sizeof edges / sizeof *edges; i++) {
        TRY(measure_places(t, edges[i], wrong));
    }
    return GLINT_OK;
}

// A path through much glass takes some hundred thousand rounds in all.
static glint_status long_loops(trial *t)
{
    enum { COUNT = 64, ROUNDS = 1000000 };
    static double in[COUNT][4], out[COUNT][4];
    glint_measure *wrong = trial_events(t, "loops of a million rounds that end early", 0);
    uint32_t state = 1;
    for (int i = 0; i < ROUNDS; i++) {
        state = state * 1664525U + 1013904223U;
    }
    for (int i = 0; i < COUNT; i++) {
        in[i][0] = ROUNDS;
    }
    glint_probe *probe;
    glint_status status;
    TRY_OR(cleanup, status, trial_functions(t, &probe));
    TRY_OR(cleanup, status,
           trial_call(t, probe, GLINT_PROBE_LOOP, &(trial_numbers){in, out, COUNT}));
    for (int i = 0; i < COUNT; i++) {
        measure_event(wrong, out[i][0] != state >> 8, "state %.9g instead of %u", out[i][0],
                      state >> 8);
    }
cleanup:
    glint_probe_free(probe);
    return status;
}

const trial_case image_cases[] = {
    {"extreme_cameras", "parallel rays, 0.01°, 179° and more: the rays in closed form",
     extreme_cameras},
    {"odd_sizes", "pictures of 1×1, 1×N, 65536×1 pixels and more: rays and colours", odd_sizes},
    {"large_numbers", "places in pictures of more than 2^31 values", large_numbers},
    {"long_loops", "loops of a million rounds: the driver ends none of them early", long_loops},
    {0},
};
