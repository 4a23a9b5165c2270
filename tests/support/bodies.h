// Scenes of a few boxes that touch and overlap.
#ifndef GLINT_TESTS_SUPPORT_BODIES_H
#define GLINT_TESTS_SUPPORT_BODIES_H

#include "scene/scene.h"

#include <stdbool.h>

// What bodies are made of: three solids, matte paint and metal.
typedef enum stuff { GLASS, WATER, ICE, PAINT, METAL, STUFFS } stuff;

// A box.
typedef struct body {
    double low[3], high[3];
    stuff stuff;
    int parts;   // that its faces' edges are divided into; 0: 1
    int mesh;    // neighbours of one number are one instance; 0: each is one
    bool inward; // a hollow
} body;

#define BODIES 4
typedef struct bodies {
    const char *what;
    body of[BODIES]; // ended by one without extent
    float priorities[STUFFS];
    float dispersion; // of water
    bool lamp;        // a point light above
} bodies;

// All turned about +Y and then about +X, by radians; in their order, or backwards.
glint_scene bodies_scene(const bodies *all, double turn, bool backwards);

// Gives the scene a camera at a point of the bodies, which is turned as they are. It looks about
// along −X, and sees 75 degrees or, orthographic, 0.9 m.
void bodies_look(glint_scene *scene, const double at[3], double turn, bool orthographic);

#endif
