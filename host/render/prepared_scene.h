// Prepares a scene without the device: its plan and its tree. Used in this folder only.
#ifndef GLINT_RENDER_PREPARED_SCENE_H
#define GLINT_RENDER_PREPARED_SCENE_H

#include "accel/bvh.h"
#include "base/status.h"
#include "render/plan.h"
#include "scene/shape/sight.h"

// Zero is valid.
typedef struct glint_prepared_scene {
    glint_plan plan; // for the settings of the renderer's creation
    // The proof about the scene, if these settings or variations of them may use it.
    glint_sight sight;
    glint_solids solids; // owned; needed until the upload of the scene
    // The tree of a scene that moves, without the arrays that the device has; else empty.
    glint_bvh tree;
    glint_bvh_report bvh;          // outlives the tree
    double built_cost, built_area; // costs of the tree when it was last built, see build_or_refit
    double analysis_ms, bvh_ms;
} glint_prepared_scene;

// Makes the plan. Finds topology and sight itself and ignores those of the inputs. Errors: as
// glint_plan_make; the plan is then unchanged.
glint_status glint_prepared_scene_plan(glint_prepared_scene *prepared,
                                       const glint_plan_inputs *inputs, glint_error *error);

// Refits the existing tree, or builds a new one. Errors: as glint_bvh_build.
glint_status glint_prepared_scene_tree(glint_prepared_scene *prepared, const glint_scene *scene,
                                       glint_error *error);

#endif
