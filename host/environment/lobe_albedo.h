// How much of a white environment the lobes of rough surfaces reflect: see kernels/layout.h,
// Lobes.
#ifndef GLINT_ENVIRONMENT_LOBE_ALBEDO_H
#define GLINT_ENVIRONMENT_LOBE_ALBEDO_H

#ifdef __cplusplus
extern "C" {
#endif

// Fills the table of GLINT_ALBEDO_VALUES floats.
void glint_lobe_albedo_fill(float *table);

#ifdef __cplusplus
}
#endif

#endif
