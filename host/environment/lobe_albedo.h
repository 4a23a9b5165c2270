// How much of a white environment the lobes of rough surfaces reflect: see kernels/layout.h,
// Lobes.
#ifndef GLINT_ENVIRONMENT_LOBE_ALBEDO_H
#define GLINT_ENVIRONMENT_LOBE_ALBEDO_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// Fills the table of GLINT_ALBEDO_VALUES floats.
void glint_lobe_albedo_fill(float *table);

// Fills that of sheen, as large; with 0 where it is not wanted.
void glint_sheen_albedo_fill(bool wanted, float *table);

#ifdef __cplusplus
}
#endif

#endif
