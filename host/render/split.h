// Splits a number for the device into an unevaluated sum of two floats.
#ifndef GLINT_RENDER_SPLIT_H
#define GLINT_RENDER_SPLIT_H

static inline void glint_split_number(double value, float *high, float *low)
{
    *high = (float)value;
    *low = (float)(value - (double)*high);
}

#endif
