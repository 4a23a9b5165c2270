// Computes the share of a white environment that the lobes of rough surfaces reflect. See
// kernels/layout.h, Lobes.
#ifndef GLINT_ENVIRONMENT_LOBE_ALBEDO_H
#define GLINT_ENVIRONMENT_LOBE_ALBEDO_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// Fills the table of lobes, GLINT_ALBEDO_VALUES floats.
void glint_lobe_albedo_fill(float *table);

// Fills the table of sheen, of the same size; with 0 if not `wanted`.
void glint_sheen_albedo_fill(bool wanted, float *table);

#ifdef __cplusplus
}
#endif

#endif
