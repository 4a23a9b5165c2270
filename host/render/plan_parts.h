// Makes the parts of a plan; glint_plan_make puts them together. For this folder only.
#ifndef GLINT_RENDER_PLAN_PARTS_H
#define GLINT_RENDER_PLAN_PARTS_H

#include "render/plan.h"

// ---- plan_features.c: features, each with its reason -------------------------------------------

// Decides the features that depend on the scene and on settings that no variation changes.
glint_status glint_plan_decide_features(const glint_plan_inputs *in, glint_plan *plan,
                                        glint_error *error);

// Decides the features that depend on the plan's depth and on proofs about the scene.
void glint_plan_decide_paths(glint_plan *plan);

// Decides the features for extra outputs and effects: roughness, dispersion, terms, layers.
void glint_plan_decide_extras(const glint_settings *settings, glint_plan *plan);

// Compiles also features that have no effect if nothing needs them (kernels/features.h).
void glint_plan_compile_idle_features(glint_plan *plan);

// ---- plan.c: build options ----------------------------------------------------------------------

// What kernels are compiled with, apart from the parts of a plan that never differ between special
// and general kernels: width, precision, tiles.
typedef struct glint_variant {
    bool is_general;
    bool features[GLINT_FEATURE_COUNT];
    bool half_texels;
    int stack_capacity, traversal_stack;
} glint_variant;

// Writes the build options of a variant.
void glint_plan_write_options(const glint_plan *plan, const glint_variant *variant,
                              char text[GLINT_BUILD_OPTIONS_BYTES]);

// ---- plan_device.c: adapts the kernels to the device -------------------------------------------

// The capacity of the stack of waiting branches that suffices for all usual settings, and the stack
// of nodes that suffices for all but the largest trees.
#define GLINT_STACK_LEAST 18
#define GLINT_TRAVERSAL_STACK_LEAST 128

// Chooses the width of packets, the tiles, and the stack of waiting branches.
void glint_plan_choose_packets(const glint_plan_inputs *in, glint_plan *plan);
void glint_plan_describe_secondary_rays(glint_plan *plan);
// Decides INSIDE: whether rays may begin inside solids.
void glint_plan_decide_inside(bool may_be_inside, glint_plan *plan);

void glint_plan_choose_media(const glint_plan_inputs *in, glint_plan *plan);

#endif
