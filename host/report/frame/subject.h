// What a report is about: pointers to what the lower floors made, any of which may be NULL.
#ifndef GLINT_REPORT_FRAME_SUBJECT_H
#define GLINT_REPORT_FRAME_SUBJECT_H

#include "accel/bvh.h"
#include "base/status.h"
#include "device/capabilities.h"
#include "environment/environment.h"
#include "render/plan.h"
#include "scene/material_override.h"
#include "scene/scene.h"
#include "scene/topology.h"

// All borrowed. Zero is valid; what is NULL is left out of the report.
typedef struct glint_subject {
    const glint_scene *scene;
    const glint_topology *topology;
    const glint_solids *solids;
    const glint_material_overrides *overrides; // of the scene's materials, which has them already
    const glint_motion *motion;                // NULL, or all zero: nothing moves
    const glint_environment *environment;
    const glint_camera *camera;
    const glint_settings *settings;
    double max_error; // relative RMSE that was asked for in place of some of them; 0: none was
    const glint_capabilities *device;
    const glint_plan *plan;
    const char *plan_failure; // why there is no plan
    const glint_bvh_report *bvh;
    const glint_warnings *warnings;
} glint_subject;

// What a material is by the rules of light transport: "metal", "solid glass", "thin glass", "matte
// paint", "glossy paint", "blend", "unlit", or "mixture" of several. Static text.
const char *glint_material_kind(const glint_material *material);

#endif
