// Applies tone curves. See tone.h.
#include "image/tone.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

const char *const glint_tone_names[] = {"none", "pbr-neutral", "agx", NULL};

// NaN becomes 0. Infinity becomes the largest float, since the curves would make it NaN.
static float as_light(float value)
{
    return value > 0.0f ? fminf(value, FLT_MAX) : 0.0f;
}

// The equations follow the specification. Its names: f is `offset`, p `peak`, p_n `new_peak`, g
// `kept`.
static void map_pbr_neutral(float rgb[3])
{
    const double f90 = 0.04, start = 0.8 - f90, desaturation = 0.15;
    const double least = (double)fminf(rgb[0], fminf(rgb[1], rgb[2]));
    const double most = (double)fmaxf(rgb[0], fmaxf(rgb[1], rgb[2]));
    const double offset = least <= 2 * f90 ? least - least * least / (4 * f90) : f90;
    const double peak = most - offset;
    double scale = 1, white = 0;
    if (peak > start) { // compress the highlight, and move it towards white
        const double new_peak = 1 - (1 - start) * (1 - start) / (peak + 1 - 2 * start);
        const double kept = 1 / (desaturation * (peak - new_peak) + 1);
        scale = new_peak / peak * kept;
        white = new_peak * (1 - kept);
    }
    for (int c = 0; c < 3; c++) {
        rgb[c] = (float)(((double)rgb[c] - offset) * scale + white);
    }
}

// ---- AgX ---------------------------------------------------------------------------------------

// The constants of AgX in Rec. 2020, as in three.js (tonemapping_pars_fragment.glsl.js) and
// Filament (ToneMapper.cpp). Both have the matrices from Blender's AgX by Eary Chow. Rows.
static const double rec709_to_rec2020[3][3] = {
    {0.6274, 0.3293, 0.0433}, {0.0691, 0.9195, 0.0113}, {0.0164, 0.0880, 0.8956}};
static const double rec2020_to_rec709[3][3] = {
    {1.6605, -0.5876, -0.0728}, {-0.1246, 1.1329, -0.0083}, {-0.0182, -0.1006, 1.1187}};
static const double inset[3][3] = {{0.856627153315983, 0.0951212405381588, 0.0482516061458583},
                                   {0.137318972929847, 0.761241990602591, 0.101439036467562},
                                   {0.11189821299995, 0.0767994186031903, 0.811302368396859}};
static const double outset[3][3] = {
    {1.1271005818144368, -0.11060664309660323, -0.016493938717834573},
    {-0.1413297634984383, 1.157823702216272, -0.016493938717834257},
    {-0.14132976349843826, -0.11060664309660294, 1.2519364065950405}};

static void multiply(const double matrix[3][3], double v[3])
{
    const double x = v[0], y = v[1], z = v[2];
    for (int i = 0; i < 3; i++) {
        v[i] = matrix[i][0] * x + matrix[i][1] * y + matrix[i][2] * z;
    }
}

// Computes the exponent within the curve's range, then the contrast curve: Benjamin Wrensch's
// polynomial ("Minimal AgX Implementation", 2023), a fit to Troy Sobotka's curve.
static double agx_curve(double light)
{
    const double low = -12.47393, high = 4.026069; // log2 of the light that becomes black and white
    const double exponent = (double)log2f((float)fmax(light, 1e-10));
    const double x = fmin(fmax((exponent - low) / (high - low), 0), 1);
    return -0.00232 +
           x * (0.1191 + x * (0.4298 + x * (-6.868 + x * (31.96 + x * (-40.14 + x * 15.5)))));
}

static void map_agx(float rgb[3])
{
    double color[3] = {(double)rgb[0], (double)rgb[1], (double)rgb[2]};
    multiply(rec709_to_rec2020, color);
    multiply(inset, color);
    for (int c = 0; c < 3; c++) {
        color[c] = agx_curve(color[c]);
    }
    multiply(outset, color);
    for (int c = 0; c < 3; c++) {
        color[c] = (double)powf((float)fmax(color[c], 0), 2.2f);
    }
    multiply(rec2020_to_rec709, color);
    for (int c = 0; c < 3; c++) {
        rgb[c] = (float)fmin(fmax(color[c], 0), 1);
    }
}

void glint_tone_map(glint_tone tone, float rgb[3])
{
    if (tone == GLINT_TONE_NONE) {
        return;
    }
    for (int c = 0; c < 3; c++) {
        rgb[c] = as_light(rgb[c]);
    }
    if (tone == GLINT_TONE_PBR_NEUTRAL) {
        map_pbr_neutral(rgb);
    } else {
        map_agx(rgb);
    }
}
