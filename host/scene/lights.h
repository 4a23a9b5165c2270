// Punctual lights, as KHR_lights_punctual has them: without a size, so that mirrors do not show
// them.
#ifndef GLINT_SCENE_LIGHTS_H
#define GLINT_SCENE_LIGHTS_H

#include "base/vector.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum glint_punctual_kind {
    GLINT_PUNCTUAL_POINT,
    GLINT_PUNCTUAL_SPOT,
    GLINT_PUNCTUAL_DIRECTIONAL,
} glint_punctual_kind;

typedef struct glint_punctual_light {
    char *name; // the node's, else the light's; NULL: none. Owned by the scene
    glint_punctual_kind kind;
    int node_index;       // of the file
    glint_vec3 position;  // metres, world space
    glint_vec3 direction; // unit, the way that it shines: the node's −Z
    double color[3]; // linear R, G, B times the intensity: candela, of a directional light lux.
                     // A candela gives an irradiance of 1 at a metre, in the environment's
                     // unit of radiance times π
    double range;    // metres; INFINITY: no end
    double inner_angle, outer_angle; // of a spot: radians from its direction
} glint_punctual_light;

// More would take minutes a frame.
#define GLINT_PUNCTUAL_LIGHTS_MAX 1024

const char *glint_punctual_kind_name(glint_punctual_kind kind); // "point", as in the file

#ifdef __cplusplus
}
#endif

#endif
