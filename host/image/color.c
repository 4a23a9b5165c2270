// Computes the sRGB transfer function (IEC 61966-2-1:1999). See color.h.
#include "image/color.h"

#include <math.h>
#include <pthread.h>
#include <stdint.h>
#include <string.h>

// The point where the linear part meets the power.
#define CODE_KNEE 0.04045
#define LINEAR_KNEE 0.0031308

static double decode(double code)
{
    return code <= CODE_KNEE ? code / 12.92 : pow((code + 0.055) / 1.055, 2.4);
}

float glint_srgb_to_linear(float code)
{
    return (float)decode((double)code);
}

float glint_linear_to_srgb(float linear)
{
    // NaN fails the first comparison.
    if (!(linear > 0.0f)) {
        return 0.0f;
    }
    if (linear >= 1.0f) {
        return 1.0f;
    }
    double l = (double)linear;
    return (float)(l <= LINEAR_KNEE ? 12.92 * l : 1.055 * pow(l, 1.0 / 2.4) - 0.055);
}

// Codes, indexed by the upper bits of the float: sign, exponent and 8 bits of the mantissa. Such a
// range is 2⁻⁸ of the value, at most half a code wide, so it holds at most one threshold between
// two codes. The entry is the code at the range's lower end. One comparison finishes the look-up.
#define KEPT_BITS 8
#define DROPPED_BITS (23 - KEPT_BITS)
#define FIRST_EXPONENT (127 - 13) // 2⁻¹³ is below the first threshold, 1.5e-4
#define TABLE_SIZE (13 << KEPT_BITS)
static unsigned char code_at[TABLE_SIZE];
static float threshold[257]; // threshold[c]: the smallest float with code c
static pthread_once_t table_once = PTHREAD_ONCE_INIT;

static void fill_table(void)
{
    threshold[256] = INFINITY;
    for (int code = 1; code < 256; code++) {
        double exact = decode((code - 0.5) / 255.0);
        float nearest = (float)exact;
        threshold[code] = (double)nearest < exact ? nextafterf(nearest, 1.0f) : nearest;
    }
    int code = 0;
    for (uint32_t i = 0; i < TABLE_SIZE; i++) {
        uint32_t bits = (i + ((uint32_t)FIRST_EXPONENT << KEPT_BITS)) << DROPPED_BITS;
        float low;
        memcpy(&low, &bits, sizeof low);
        while (low >= threshold[code + 1]) {
            code++;
        }
        code_at[i] = (unsigned char)code;
    }
}

unsigned char glint_linear_to_srgb8(float linear)
{
    pthread_once(&table_once, fill_table);
    if (!(linear >= 1.0f / 8192.0f)) { // below the first threshold; NaN too
        return 0;
    }
    if (linear >= 1.0f) {
        return 255;
    }
    uint32_t bits;
    memcpy(&bits, &linear, sizeof bits);
    unsigned code = code_at[(bits >> DROPPED_BITS) - ((uint32_t)FIRST_EXPONENT << KEPT_BITS)];
    return (unsigned char)(linear >= threshold[code + 1] ? code + 1 : code);
}
