// Punctual lights, as in KHR_lights_punctual. They have no size, so mirrors do not show them.
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
    char *name; // name of the node, else of the light, else NULL; owned by the scene
    glint_punctual_kind kind;
    int node_index;       // index of the node in the file
    glint_vec3 position;  // metres, world space
    glint_vec3 direction; // unit vector in which it shines: the node's −Z
    // Linear R, G, B times the intensity: candela; for a directional light, lux. A candela gives an
    // irradiance of 1 at a metre, in the environment's unit of radiance times π.
    double color[3];
    double range;                    // metres; INFINITY: unlimited
    double inner_angle, outer_angle; // for a spot: radians from its direction
} glint_punctual_light;

// More lights would take minutes per frame.
#define GLINT_PUNCTUAL_LIGHTS_MAX 1024

const char *glint_punctual_kind_name(glint_punctual_kind kind); // such as "point", as in the file

#ifdef __cplusplus
}
#endif

#endif
