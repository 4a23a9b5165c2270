// Tests hard cases of the environment: ties between the cube's faces, its edges and corners,
// centres and borders of texels, the poles and the seam of a lat-long map, values that are no
// radiance.
#include "selftest/trial.h"

#include <math.h>
#include <string.h>

#define EDGE 16 // texels of the linear environment

// Looks up the environment along directions on the device.
static glint_status look_up(trial *t, const glint_environment *environment, double (*in)[4],
                            double (*out)[4], size_t count)
{
    for (size_t i = 0; i < 4 * count; i++) {
        in[i / 4][i % 4] = trial_rounded(t, in[i / 4][i % 4]);
    }
    glint_probe *probe;
    glint_status status;
    TRY_OR(cleanup, status, trial_probe_environment(t, environment, &probe));
    TRY_OR(cleanup, status,
           trial_call(t, probe, GLINT_PROBE_ENVIRONMENT, &(trial_numbers){in, out, count}));
cleanup:
    glint_probe_free(probe);
    return status;
}

// ½ + ½d, for d of any length.
static void linear_color(const double d[3], double rgb[3])
{
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int k = 0; k < 3; k++) {
        rgb[k] = 0.5 + 0.5 * d[k] / length;
    }
}

static double largest_difference(const double a[3], const double b[3])
{
    double largest = 0;
    for (int k = 0; k < 3; k++) {
        // NaN is the largest.
        const double difference = fabs(a[k] - b[k]);
        largest = difference <= largest ? largest : difference;
    }
    return largest;
}

static bool same_color(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

// ---- Ties --------------------------------------------------------------------------------------

#define TIES 288
#define ODD 8 // directions that are zero or not finite

// Makes a direction with two or three equal magnitudes, in all signs. The third is from 0 to as
// large.
static void tie(int number, double d[3])
{
    static const double thirds[] = {0, -0.0, 1e-30, 0.25, 0.75, 1};
    const int axis = number % 3, signs = number / 3 % 8, third = number / 24 % 6;
    const double size = number / 144 ? 3e-3 : 1;
    d[axis] = (signs & 1 ? -1 : 1) * thirds[third] * size;
    d[(axis + 1) % 3] = (signs & 2 ? -1 : 1) * size;
    d[(axis + 2) % 3] = (signs & 4 ? -1 : 1) * size;
}

// The face of a tie. The order x, y, z decides, as in ImfEnvmap.h.
static int face_of_tie(const double d[3])
{
    const double x = fabs(d[0]), y = fabs(d[1]), z = fabs(d[2]);
    const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    return 2 * axis + (d[axis] < 0);
}

static void measure_odd(glint_measure *wild, const double d[3], const double v[3])
{
    const bool is_color =
        v[0] >= 0 && v[0] <= 1 && v[1] >= 0 && v[1] <= 1 && v[2] >= 0 && v[2] <= 1;
    measure_event(wild, !is_color, "along (%g, %g, %g): (%g, %g, %g)", d[0], d[1], d[2], v[0], v[1],
                  v[2]);
}

// Measures the face of a tie, and its place there in texels.
static void measure_face(trial *t, glint_measure *others, const double d[3], const double f[4])
{
    // Allow for the rounding of the place.
    const double low = 0.5 - 2 * t->u * EDGE, high = EDGE + 0.5 + 2 * t->u * EDGE;
    const bool inside = f[1] >= low && f[1] <= high && f[2] >= low && f[2] <= high;
    measure_event(others, f[0] != face_of_tie(d) || !inside,
                  "(%g, %g, %g): face %d expected; face %g, column %g, row %g", d[0], d[1], d[2],
                  face_of_tie(d), f[0], f[1], f[2]);
}

// Measures steps over ties. Both faces have the same value there, except for the rounding of the
// border's texels to float. So a step over a tie is no larger than a step within a face: a few
// rounding errors of the place, times EDGE.
static glint_status measure_jumps(trial *t, glint_measure *jumps, glint_measure *wild)
{
    static const double odd[ODD][3] = {{NAN, 0, -1},
                                       {0, NAN, 1},
                                       {0, 0, 0},
                                       {INFINITY, 1, 0},
                                       {-INFINITY, 1, 1},
                                       {NAN, NAN, NAN},
                                       {1, INFINITY, -INFINITY},
                                       {-0.0, 0, NAN}};
    static double in[3 * TIES + ODD][4], out[3 * TIES + ODD][4];
    // Try each tie three times: as it is, and a little to either side.
    for (int i = 0; i < TIES; i++) {
        double d[3];
        tie(i, d);
        for (int n = 0; n < 3; n++) {
            memcpy(in[3 * i + n], d, sizeof d);
        }
        // A little to either side.
        in[3 * i + 1][(i + 1) % 3] *= 1 - 4 * t->u;
        in[3 * i + 2][(i + 2) % 3] *= 1 - 4 * t->u;
    }
    for (int i = 0; i < ODD; i++) {
        memcpy(in[3 * TIES + i], odd[i], sizeof odd[i]);
    }
    // Look up and compare.
    glint_environment environment;
    glint_status status;
    TRY_OR(cleanup, status, trial_linear_environment(EDGE, &environment, t->error));
    TRY_OR(cleanup, status, look_up(t, &environment, in, out, 3 * TIES + ODD));
    for (int i = 0; i < ODD; i++) {
        measure_odd(wild, odd[i], out[3 * TIES + i]);
    }
    for (int i = 0; i < 2 * TIES; i++) {
        const double *d = in[i / 2 * 3], *on = out[i / 2 * 3], *beside = out[i / 2 * 3 + 1 + i % 2];
        const double jump = largest_difference(on, beside);
        measure_error(jumps, jump / (0x1p-24 * EDGE), "(%g, %g, %g): a step of %.3g", d[0], d[1],
                      d[2], jump);
    }
cleanup:
    glint_environment_free(&environment);
    return status;
}

static glint_status cube_ties(trial *t)
{
    static double faces[TIES][4];
    glint_measure *others = trial_events(t, "ties that fall on another face, or beside it", 0);
    glint_measure *jumps = trial_error(t, "jump from one face to the other", "2⁻²⁴ × edge", 4);
    glint_measure *wild = trial_events(t, "colours along NaN, 0 and ∞ that no texel has", 0);
    TRY(measure_jumps(t, jumps, wild));
    for (int i = 0; i < TIES; i++) {
        tie(i, faces[i]);
    }
    glint_probe *probe = NULL;
    glint_status status;
    TRY_OR(cleanup, status, trial_functions(t, &probe));
    TRY_OR(cleanup, status,
           trial_call(t, probe, GLINT_PROBE_FACE, &(trial_numbers){faces, faces, TIES}));
    for (int i = 0; i < TIES; i++) {
        double d[3];
        tie(i, d);
        measure_face(t, others, d, faces[i]);
    }
cleanup:
    glint_probe_free(probe);
    return status;
}

// ---- Edges and corners -------------------------------------------------------------------------

#define SEAM_LOOKUPS 8192

static glint_status seams_of_edge(trial *t, int edge, glint_measure *errors)
{
    static double in[SEAM_LOOKUPS][4], out[SEAM_LOOKUPS][4];
    for (int i = 0; i < SEAM_LOOKUPS; i++) {
        // Within a texel of an edge. Every other direction is within a texel of a corner.
        double d[3];
        tie(i % 24, d);
        const int axis = i % 3;
        d[axis] = i % 2 ? trial_random(t, -1, 1) : copysign(1, d[axis]);
        for (int k = 0; k < 3; k++) {
            in[i][k] = d[k] * (1 - (k == axis && i % 2 ? 0 : trial_random(t, 0, 2.0 / edge)));
        }
    }
    glint_environment environment;
    glint_status status;
    TRY_OR(cleanup, status, trial_linear_environment(edge, &environment, t->error));
    TRY_OR(cleanup, status, look_up(t, &environment, in, out, SEAM_LOOKUPS));
    for (int i = 0; i < SEAM_LOOKUPS; i++) {
        double expected[3];
        linear_color(in[i], expected);
        const double error = largest_difference(out[i], expected);
        measure_error(errors, error * edge * edge / 2, "edge %d, (%.9g, %.9g, %.9g): off by %.3g",
                      edge, in[i][0], in[i][1], in[i][2], error);
    }
cleanup:
    glint_environment_free(&environment);
    return status;
}

static glint_status cube_seams(trial *t)
{
    static const int edges[] = {2, 3, 16, 61};
    glint_measure *errors = trial_error(t, "error at edges and corners", "2/edge²", 1);
    for (size_t n = 0; n < sizeof edges / sizeof *edges; n++) {
        TRY(seams_of_edge(t, edges[n], errors));
    }
    return GLINT_OK;
}

// ---- Centres and borders -----------------------------------------------------------------------

static glint_status texel_centres(trial *t)
{
    enum { COUNT = 6 * EDGE * EDGE };
    static double in[2 * COUNT][4], out[2 * COUNT][4];
    glint_measure *centres = trial_error(t, "value at a texel's centre", "u", 0);
    glint_measure *borders = trial_error(t, "value half-way beside the mean", "u", 2);
    glint_environment environment;
    glint_status status;
    TRY_OR(cleanup, status, trial_linear_environment(EDGE, &environment, t->error));
    // Aim at the centre of each texel, and half a texel to the right.
    for (int i = 0; i < COUNT; i++) {
        const int face = i / (EDGE * EDGE), row = i / EDGE % EDGE, column = i % EDGE;
        // All are multiples of 1/16, so they are exact.
        const double s = (2.0 * column + 1) / EDGE - 1, v = (2.0 * row + 1) / EDGE - 1;
        const glint_vec3 centre = glint_cube_direction(face, s, v);
        const glint_vec3 border = glint_cube_direction(face, s + 1.0 / EDGE, v);
        const double d[3] = {centre.x, centre.y, centre.z}, b[3] = {border.x, border.y, border.z};
        memcpy(in[i], d, sizeof d);
        memcpy(in[COUNT + i], b, sizeof b);
    }
    TRY_OR(cleanup, status, look_up(t, &environment, in, out, 2 * COUNT));
    // A centre gives the texel; half-way gives the mean of two texels.
    for (int i = 0; i < COUNT; i++) {
        const int face = i / (EDGE * EDGE), row = i / EDGE % EDGE, column = i % EDGE;
        const float *texel = glint_cube_texel(&environment.radiance, face, column, row);
        for (int k = 0; k < 3; k++) {
            measure_value(centres, out[i][k], (double)texel[k], t->u, "face %d, column %d, row %d",
                          face, column, row);
            // The last column's border lies on the cube's edge. Another face may answer there.
            if (column + 1 < EDGE) {
                measure_value(
                    borders, out[COUNT + i][k], ((double)texel[k] + (double)texel[4 + k]) / 2, t->u,
                    "face %d, between columns %d and %d, row %d", face, column, column + 1, row);
            }
        }
    }
cleanup:
    glint_environment_free(&environment);
    return status;
}

// ---- Lat-long maps -----------------------------------------------------------------------------

#define ROWS 128

// Makes a lat-long map of ½ + ½d; +Y up, +Z in the middle, +X a quarter in from the left.
static glint_status latlong_environment(trial *t, glint_environment *environment)
{
    glint_image image;
    glint_status status;
    TRY_OR(cleanup, status, glint_image_create(2 * ROWS, ROWS, 3, &image, t->error));
    for (int i = 0; i < 2 * ROWS * ROWS; i++) {
        const int column = i % (2 * ROWS), row = i / (2 * ROWS);
        const double longitude = GLINT_PI * (1 - (column + 0.5) / ROWS);
        const double latitude = GLINT_PI * (0.5 - (row + 0.5) / ROWS);
        const double d[3] = {cos(latitude) * sin(longitude), sin(latitude),
                             cos(latitude) * cos(longitude)};
        for (int k = 0; k < 3; k++) {
            image.pixels[3 * i + k] = (float)(0.5 + 0.5 * d[k]);
        }
    }
    TRY_OR(cleanup, status,
           glint_environment_from_image("a lat-long map", &image, NULL, environment, t->error));
cleanup:
    glint_image_free(&image);
    return status;
}

static glint_status latlong_poles(trial *t)
{
    enum { COUNT = 4096 };
    static double in[COUNT][4], out[COUNT][4];
    // Bilinear look-ups err by an eighth of the second derivative, ½, times the square of a step,
    // π/ROWS, each way. Next to a pole, where rows end, they err by twice as much.
    glint_measure *errors = trial_error(t, "error at the poles and the seam", "(π/rows)²/4", 1);
    for (int i = 0; i < COUNT; i++) {
        // Half of the directions are at a pole or near it, half near the seam at −Z, within a
        // column.
        const double small = pow(10, trial_random(t, -12, 0)), turn = trial_random(t, 0, 7);
        const double pole[3] = {i < 8 ? 0 : small * cos(turn), i % 2 ? -1 : 1,
                                i < 8 ? 0 : small * sin(turn)};
        const double seam[3] = {trial_random(t, -1, 1) * GLINT_PI / ROWS, trial_random(t, -2, 2),
                                -1};
        memcpy(in[i], i < COUNT / 2 ? pole : seam, sizeof pole);
    }
    glint_environment environment = {0};
    glint_status status;
    TRY_OR(cleanup, status, latlong_environment(t, &environment));
    TRY_OR(cleanup, status, look_up(t, &environment, in, out, COUNT));
    const double scale = pow(GLINT_PI / ROWS, 2) / 4;
    for (int i = 0; i < COUNT; i++) {
        double expected[3];
        linear_color(in[i], expected);
        const double error = largest_difference(out[i], expected);
        measure_error(errors, error / scale, "(%.9g, %.9g, %.9g): off by %.3g", in[i][0], in[i][1],
                      in[i][2], error);
    }
cleanup:
    glint_environment_free(&environment);
    return status;
}

// ---- Values that are no radiance ---------------------------------------------------------------

static const struct {
    int face, column, row;
    float value, mended;
} bad_texels[] = {{0, 5, 9, NAN, 0},
                  {2, 8, 4, INFINITY, 65504},
                  {3, 6, 6, -3, 0},
                  {5, 10, 11, -INFINITY, 0},
                  {4, 4, 12, 65504, 65504}};
#define BAD_TEXELS 5

// Makes a strip of six faces, with or without the bad texels.
static glint_status strip_environment(trial *t, bool spoilt, glint_environment *environment)
{
    glint_environment linear = {0};
    glint_image image = {0};
    glint_status status;
    TRY_OR(cleanup, status, trial_linear_environment(EDGE, &linear, t->error));
    TRY_OR(cleanup, status, glint_image_create(EDGE, 6 * EDGE, 3, &image, t->error));
    for (int i = 0; i < 6 * EDGE * EDGE; i++) {
        const float *texel =
            glint_cube_texel(&linear.radiance, i / (EDGE * EDGE), i % EDGE, i / EDGE % EDGE);
        memcpy(image.pixels + 3 * i, texel, 3 * sizeof *texel);
    }
    for (int b = 0; spoilt && b < BAD_TEXELS; b++) {
        const int row = bad_texels[b].face * EDGE + bad_texels[b].row;
        for (int k = 0; k < 3; k++) {
            glint_image_pixel(&image, bad_texels[b].column, row)[k] = bad_texels[b].value;
        }
    }
    const glint_layout_request strip = {.layout = GLINT_LAYOUT_CUBE};
    TRY_OR(cleanup, status,
           glint_environment_from_image("a strip", &image, &strip, environment, t->error));
cleanup:
    glint_image_free(&image);
    glint_environment_free(&linear);
    return status;
}

// True if a bad texel is in the footprint of the look-up along d.
static bool in_footprint(const double d[3])
{
    bool inside = false;
    for (int b = 0; b < BAD_TEXELS; b++) {
        const int face = bad_texels[b].face;
        const glint_vec3 axis = glint_cube_direction(face, 0, 0), v = {d[0], d[1], d[2]};
        const glint_vec3 s = glint_vec3_subtract(glint_cube_direction(face, 1, 0), axis);
        const glint_vec3 down = glint_vec3_subtract(glint_cube_direction(face, 0, 1), axis);
        const double along = glint_vec3_dot(v, axis);
        // In texels, from the texel's centre.
        const double column = (glint_vec3_dot(v, s) / along + 1) / 2 * EDGE - 0.5;
        const double row = (glint_vec3_dot(v, down) / along + 1) / 2 * EDGE - 0.5;
        inside = inside || (face_of_tie(d) == face && fabs(column - bad_texels[b].column) < 1 &&
                            fabs(row - bad_texels[b].row) < 1);
    }
    return inside;
}

static glint_status bad_radiance(trial *t)
{
    enum { COUNT = 16384 };
    static double in[COUNT][4], clean[COUNT][4], found[COUNT][4];
    glint_measure *count = trial_error(t, "texels said to be mended, beside 4", "", 0);
    glint_measure *values = trial_error(t, "mended texels' values", "", 0);
    glint_measure *changed = trial_events(t, "look-ups changed away from bad texels", 0);
    glint_measure *wild = trial_events(t, "look-ups that are not finite or below 0", 0);
    glint_environment whole = {0}, spoilt = {0};
    // Aim at the bad texels, and anywhere.
    for (int i = 0; i < COUNT; i++) {
        const glint_vec3 d = glint_random_direction(&t->random);
        const int b = i % BAD_TEXELS;
        const glint_vec3 centre =
            glint_cube_direction(bad_texels[b].face, (2.0 * bad_texels[b].column + 1) / EDGE - 1,
                                 (2.0 * bad_texels[b].row + 1) / EDGE - 1);
        const double random[3] = {d.x, d.y, d.z}, at[3] = {centre.x, centre.y, centre.z};
        memcpy(in[i], i < BAD_TEXELS ? at : random, sizeof at);
    }
    // Look up the whole map and the spoilt map.
    glint_status status;
    TRY_OR(cleanup, status, strip_environment(t, false, &whole));
    TRY_OR(cleanup, status, strip_environment(t, true, &spoilt));
    TRY_OR(cleanup, status, look_up(t, &whole, in, clean, COUNT));
    TRY_OR(cleanup, status, look_up(t, &spoilt, in, found, COUNT));
    // Only bad texels may differ.
    measure_value(count, (double)spoilt.mended_texels, 4, 1, "of 5 texels");
    for (int i = 0; i < COUNT; i++) {
        const double *v = found[i];
        if (i < BAD_TEXELS) {
            measure_value(values, v[0], (double)bad_texels[i].mended, 1, "%g on face %d",
                          (double)bad_texels[i].value, bad_texels[i].face);
        }
        measure_event(changed, !in_footprint(in[i]) && !same_color(v, clean[i]),
                      "(%.9g, %.9g, %.9g): %.9g, was %.9g", in[i][0], in[i][1], in[i][2], v[0],
                      clean[i][0]);
        measure_event(wild, !(v[0] >= 0 && v[1] >= 0 && v[2] >= 0 && isfinite(v[0] + v[1] + v[2])),
                      "(%.9g, %.9g, %.9g): (%g, %g, %g)", in[i][0], in[i][1], in[i][2], v[0], v[1],
                      v[2]);
    }
cleanup:
    glint_environment_free(&whole);
    glint_environment_free(&spoilt);
    return status;
}

// Looks up radiance up to 10⁻³⁷. The lowest tenth is denormal in float. Flushing may take a
// denormal number for each texel of a look-up: together at most 1.2·10⁻³⁸.
static glint_status denormal_radiance(trial *t)
{
    enum { COUNT = 4096 };
    static const double scale = 1e-37;
    static double in[COUNT][4], out[COUNT][4];
    glint_measure *errors = trial_error(t, "beside what IEEE arithmetic gives", "", 1.3e-38);
    glint_environment environment;
    glint_status status;
    TRY_OR(cleanup, status, trial_linear_environment(EDGE, &environment, t->error));
    for (size_t i = 0; i < glint_cube_size(&environment.radiance); i++) {
        environment.radiance.texels[i] *= (float)scale;
    }
    for (int i = 0; i < COUNT; i++) {
        const glint_vec3 d = glint_random_direction(&t->random);
        const double random[3] = {d.x, d.y, d.z};
        memcpy(in[i], random, sizeof random);
    }
    TRY_OR(cleanup, status, look_up(t, &environment, in, out, COUNT));
    for (int i = 0; i < COUNT; i++) {
        double rgb[3];
        linear_color(in[i], rgb);
        for (int k = 0; k < 3; k++) {
            measure_value(errors, out[i][k], scale * rgb[k], 1, "(%.9g, %.9g, %.9g)", in[i][0],
                          in[i][1], in[i][2]);
        }
    }
cleanup:
    glint_environment_free(&environment);
    return status;
}

const trial_case environment_cases[] = {
    {"cube_ties", "directions on the cube's edges and corners: one face by a rule, no jump",
     cube_ties},
    {"cube_seams", "within a texel of edges and corners, E linear in d: off by 2/edge² at most",
     cube_seams},
    {"texel_centres", "directions through texels' centres, and half-way: the texel, the mean",
     texel_centres},
    {"latlong_poles", "the poles and the seam of a lat-long map: finite and in place",
     latlong_poles},
    {"bad_radiance", "NaN, infinite, negative texels: mended and counted, neighbours unaffected",
     bad_radiance},
    {"denormal_radiance", "denormal texels: as IEEE arithmetic has them, or 0", denormal_radiance},
    {0},
};
