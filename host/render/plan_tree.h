// Builds and refits the trees of plans.
#ifndef GLINT_RENDER_PLAN_TREE_H
#define GLINT_RENDER_PLAN_TREE_H

#include "render/plan.h"

// Builds the tree of the scene's triangles for the plan's kernels. Errors: as glint_bvh_build.
glint_status glint_plan_build_tree(const glint_plan *plan, const glint_scene *scene, glint_bvh *bvh,
                                   glint_error *error);

// Refits a tree of the same scene at another time. Returns false if this is impossible, see
// glint_bvh_refit.
bool glint_plan_refit_tree(const glint_plan *plan, const glint_scene *scene, glint_bvh *bvh);

#endif
