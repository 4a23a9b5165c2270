// Adapts a plan's kernels to the device: packets, tiles, stacks and texels.
#ifndef GLINT_RENDER_PLAN_DEVICE_H
#define GLINT_RENDER_PLAN_DEVICE_H

#include "render/plan.h"

// The default number of lanes of a packet on the device: 1, 8 or 16.
int glint_plan_native_width(const glint_capabilities *device, glint_precision precision);

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

// Chooses the texels again for another environment. Does not read scene and topology. Changes only
// the parts of the plan that concern texels. Errors: as glint_plan_make.
glint_status glint_plan_choose_texels(const glint_plan_inputs *in, glint_plan *plan,
                                      glint_error *error);

#endif
