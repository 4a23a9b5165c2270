// Makes scenes of a few boxes that touch and overlap.
#ifndef GLINT_TESTS_SUPPORT_BODIES_H
#define GLINT_TESTS_SUPPORT_BODIES_H

#include "scene/scene.h"

#include <stdbool.h>

// Materials of bodies: three solids, matte paint and metal.
typedef enum stuff { GLASS, WATER, ICE, PAINT, METAL, STUFFS } stuff;

// A box-shaped body.
typedef struct body {
    double low[3], high[3];
    stuff stuff;
    int parts;   // pieces along each edge of a face; 0: 1
    int mesh;    // neighbours with the same number form one instance; 0: an instance of its own
    bool inward; // a hollow: its faces point inwards
} body;

#define BODIES 4
typedef struct bodies {
    const char *what;
    body of[BODIES]; // a body without extent ends the list
    float priorities[STUFFS];
    float dispersion; // dispersion of water
    bool lamp;        // a point light above
} bodies;

// Makes the scene, in the given order or backwards. All bodies turn about +Y and then about +X, by
// `turn` radians.
glint_scene bodies_scene(const bodies *all, double turn, bool backwards);

// Gives the scene a camera at a point of the bodies, which turns with them. It looks about along
// −X. Its field of view is 75 degrees or, orthographic, 0.9 m.
void bodies_look(glint_scene *scene, const double at[3], double turn, bool orthographic);

#endif
