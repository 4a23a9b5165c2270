// Collects pointers to the subject of a report; any of them may be NULL.
#ifndef GLINT_REPORT_FRAME_SUBJECT_H
#define GLINT_REPORT_FRAME_SUBJECT_H

#include "accel/bvh.h"
#include "base/status.h"
#include "device/capabilities.h"
#include "environment/environment.h"
#include "render/plan.h"
#include "scene/material/material_override.h"
#include "scene/scene.h"
#include "scene/shape/topology.h"

// The subject of a report. All borrowed. Zero is valid; reports leave out what is NULL.
typedef struct glint_subject {
    const glint_scene *scene;
    const glint_topology *topology;
    const glint_solids *solids;
    // of the materials in `scene`, which already contain them
    const glint_material_overrides *overrides;
    const glint_motion *motion; // NULL or all zero: nothing moves
    const glint_environment *environment;
    const glint_camera *camera;
    const glint_settings *settings;
    double max_error; // relative RMSE of --max-error, which replaces some settings; 0: not given
    const glint_capabilities *device;
    const glint_plan *plan;
    const char *kernels; // kind of kernels of the latest frame: glint_kernel_kind_name; NULL: none
    const char *plan_failure; // why there is no plan
    const glint_bvh_report *bvh;
    const glint_warnings *warnings;
} glint_subject;

// Names a material by the rules of light transport: "metal", "solid glass", "thin glass", "matte
// paint", "glossy paint", "blend", "unlit", or "mixture" for several kinds. Static text.
const char *glint_material_kind(const glint_material *material);

#endif
