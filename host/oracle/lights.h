// Between the oracle's own files: what punctual lights send to a surface.
#ifndef GLINT_ORACLE_LIGHTS_H
#define GLINT_ORACLE_LIGHTS_H

#include "oracle/hit.h"

// A point on a surface that light comes to.
typedef struct receiver {
    const oracle_scene *scene;
    vector point, geometric, lit; // n_g on the viewer's side, and n
    int triangle;                 // that the point lies on
    double travelled;             // of the path up to there
    bool edges;                   // measure report->edge
    oracle_report *report;
} receiver;

// What is left of light behind a surface on its way, which it comes to along `direction` from the
// receiver. `way` is the state of the caller's, one for each light.
typedef vector (*passing)(void *way, const oracle_hit *hit, vector direction);

// The irradiance over π of the scene's light number `index`. What it met on its way is passed from
// the receiver to the light.
vector oracle_light_at(const receiver *r, int index, passing pass, void *way);

// The unit vector from the receiver to it.
vector oracle_direction_to_light(const receiver *r, int index);

#endif
