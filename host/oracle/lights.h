// Computes the light of punctual lights on a surface. Internal to the oracle.
#ifndef GLINT_ORACLE_LIGHTS_H
#define GLINT_ORACLE_LIGHTS_H

#include "oracle/hit.h"

// A point on a surface that receives light.
typedef struct receiver {
    const oracle_scene *scene;
    // n_g on the viewer's side; n.
    vector point, geometric, lit;
    int triangle;     // triangle on which the point lies
    double travelled; // length of the path up to the point
    bool edges;       // measure report->edge
    oracle_report *report;
} receiver;

// Returns the light left behind the surface at `hit`, which lies along `direction` from the
// receiver. `way` is the caller's state, one for each light.
typedef vector (*passing)(void *way, const oracle_hit *hit, vector direction);

// The irradiance over π of light number `index`. Calls `pass` for each surface on the way, from the
// receiver to the light.
vector oracle_light_at(const receiver *r, int index, passing pass, void *way);

// The unit vector from the receiver to the light.
vector oracle_direction_to_light(const receiver *r, int index);

#endif
