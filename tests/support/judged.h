// Compares frames of the device with the oracle, pixel by pixel.
#ifndef GLINT_TESTS_SUPPORT_JUDGED_H
#define GLINT_TESTS_SUPPORT_JUDGED_H

#include "environment/environment.h"
#include "render/plan.h"
#include "scene/scene.h"
#include "support/render.h"

typedef struct judged {
    const char *scene; // name of a file in scenes/, without .gltf
    const glint_environment *environment;
    glint_settings settings;
    glint_feature feature; // the plan must compile this feature
    int strata;            // the oracle's facets along each axis; 0: no rough glass
    // Roughness of all materials. If there are strata: roughness of the glass, 0 for all others.
    // Less than 0: unchanged.
    float roughness;
    float metallic; // metallic of all materials; less than 0: unchanged
    float alpha;    // alpha of thin walls, if less than 1
    // Changes a material further; or NULL.
    void (*change)(const void *kind, glint_material *material);
    const void *kind; // argument of `change`
} judged;

// Settings of a small frame with at most `depth` surfaces, the oracle's texels and exact lobes.
// Rough glass has 1024 facets.
glint_settings judged_frame(int width, int height, int depth);

// Returns the relative RMSE of the device against the oracle, over the pixels that show surfaces
// and are not near a decision.
double judge(const judged *j);

// Returns the relative RMSE of a frame against the oracle, over the pixels that show surfaces and
// are not near edges. The oracle heeds solids that touch and overlap. It takes the first camera.
double judged_overlaps(const glint_scene *scene, const glint_environment *environment,
                       const glint_settings *settings, const test_frame *frame);

#endif
