// The parts of a plan, which glint_plan_make puts together. For plan*.c alone.
#ifndef GLINT_RENDER_PLAN_PARTS_H
#define GLINT_RENDER_PLAN_PARTS_H

#include "render/plan.h"

// ---- plan_features.c: features, each with its reason -------------------------------------------

// Those that rest on the scene and on settings that no variation changes.
glint_status glint_plan_decide_features(const glint_plan_inputs *in, glint_plan *plan,
                                        glint_error *error);

// Those that rest on the plan's depth, and on what is proved of the scene.
void glint_plan_decide_paths(glint_plan *plan);

// Those for what is told of a frame beside its colours.
void glint_plan_decide_extras(const glint_settings *settings, glint_plan *plan);

// Compiles the features that are idle where nothing needs them (kernels/features.h).
void glint_plan_compile_idle_features(glint_plan *plan);

// ---- plan_device.c: how the kernels suit the device --------------------------------------------

// The packets' width, tiles, and the stack of branches that wait.
void glint_plan_choose_packets(const glint_plan_inputs *in, glint_plan *plan);
void glint_plan_describe_secondary_rays(glint_plan *plan);
// INSIDE, by what is known of the eye.
void glint_plan_decide_inside(bool may_be_inside, glint_plan *plan);

void glint_plan_choose_media(const glint_plan_inputs *in, glint_plan *plan);

#endif
