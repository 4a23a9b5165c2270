// All that a scene needs before the device comes in: plan and tree. For this floor only.
#ifndef GLINT_RENDER_PREPARED_SCENE_H
#define GLINT_RENDER_PREPARED_SCENE_H

#include "accel/bvh.h"
#include "base/status.h"
#include "render/plan.h"
#include "scene/sight.h"

// Zero is valid.
typedef struct glint_prepared_scene {
    glint_plan plan;      // of the settings that the renderer was made with
    glint_sight sight;    // what is proved of the scene, where these settings may heed it or
                          // variations of them
    glint_solids solids;  // owned; needed until the scene is uploaded
    glint_bvh tree;       // of a scene that moves, less the arrays that the device has; else empty
    glint_bvh_report bvh; // outlives the tree
    double built_cost, built_area; // the tree's when it was last built, see build_or_refit
    double analysis_ms, bvh_ms;
} glint_prepared_scene;

// The plan. Topology and sight are found here, those of the inputs are not read. Errors: as
// glint_plan_make; the plan is then what it was.
glint_status glint_prepared_scene_plan(glint_prepared_scene *prepared,
                                       const glint_plan_inputs *inputs, glint_error *error);

// The tree: the one that there is, fitted, or a new one. Errors: as glint_bvh_build.
glint_status glint_prepared_scene_tree(glint_prepared_scene *prepared, const glint_scene *scene,
                                       glint_error *error);

#endif
