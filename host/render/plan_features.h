// Decides the features of a plan, each with its reason.
#ifndef GLINT_RENDER_PLAN_FEATURES_H
#define GLINT_RENDER_PLAN_FEATURES_H

#include "render/plan.h"

// Decides the features that depend on the scene and on settings that no variation changes.
glint_status glint_plan_decide_features(const glint_plan_inputs *in, glint_plan *plan,
                                        glint_error *error);

// Decides the features that depend on the plan's depth and on proofs about the scene.
void glint_plan_decide_paths(glint_plan *plan);

// Decides the features for extra outputs and effects: roughness, dispersion, terms, layers.
void glint_plan_decide_extras(const glint_settings *settings, glint_plan *plan);

// Compiles also features that have no effect if nothing needs them (kernels/features.h).
void glint_plan_compile_idle_features(glint_plan *plan);

#endif
