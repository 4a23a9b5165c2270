// Frames beside the oracle: how far the device's are off, pixel by pixel.
#ifndef GLINT_TESTS_SUPPORT_JUDGED_H
#define GLINT_TESTS_SUPPORT_JUDGED_H

#include "environment/environment.h"
#include "render/plan.h"
#include "scene/scene.h"

typedef struct judged {
    const char *scene; // of scenes/, without .gltf
    const glint_environment *environment;
    glint_settings settings;
    glint_feature feature; // which the plan must compile
    int strata;            // of the oracle's facets along each axis; 0: there is no rough glass
    float roughness;       // of all materials, or of the glass alone where there are strata, which
                           // leaves the others smooth; less than 0: as they are
    float metallic;        // of all materials; less than 0: as it is
    float alpha;           // of thin walls, less than 1: how much of them is there
    void (*change)(const void *kind, glint_material *material); // what else is to be; or NULL
    const void *kind;                                           // handed to it
} judged;

// A frame of few pixels, with texels as the oracle reads them and exact lobes, of so many surfaces
// at most. Rough glass has as many facets as so few pixels are worth.
glint_settings judged_frame(int width, int height, int depth);

// What the oracle and the device disagree by: relative RMSE over the pixels that show surfaces and
// that no decision is near.
double judge(const judged *j);

#endif
