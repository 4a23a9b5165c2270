// Makes plans. Pure: calls no OpenCL.
#ifndef GLINT_RENDER_PLAN_MAKE_H
#define GLINT_RENDER_PLAN_MAKE_H

#include "render/plan.h"

// Makes a plan. Errors: as glint_settings_check, and GLINT_USAGE for half texels if half cannot
// hold the environment.
glint_status glint_plan_make(const glint_plan_inputs *inputs, glint_plan *plan, glint_error *error);

// Changes a plan for other settings of the same scene, environment and device. They must be a
// variation of the settings that made the plan. Does not read scene and topology. Errors: as
// glint_plan_make; *plan is then invalid.
glint_status glint_plan_vary(const glint_plan_inputs *in, glint_plan *plan, glint_error *error);

// Switches the use of a plan's proof on or off; initially it is on. It must be off if the proof
// holds only for eyes outside (sight.from_outside) and this eye is inside. Changes the depth, and
// whether paths continue. Nothing else in a plan depends on these if no path splits. If paths may
// split, no proof holds only for eyes outside.
void glint_plan_heed_sight(glint_plan *plan, bool heed);

#endif
