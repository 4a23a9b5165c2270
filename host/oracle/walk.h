// Walks along the tree of paths and scatters light at surfaces. Internal to the oracle.
#ifndef GLINT_ORACLE_WALK_H
#define GLINT_ORACLE_WALK_H

#include "oracle/media.h"
#include "oracle/surface.h"

typedef struct path {
    vector origin, direction; // of the ray to trace
    vector weight;            // factor of the path's radiance in the sample
    media inside;
    // Where solids may overlap: the solid beyond the surface that was met, or −1.
    int beyond;
    cone cone;        // where the ray starts
    int left;         // triangle that the ray leaves, or −1
    int met;          // surfaces met so far, without those that were not there
    double travelled; // length of the path so far
    bool dispersed;   // holds only the walk's wavelength
    bool holds;       // takes the light `held` at its end, instead of the environment's
    vector held;
} path;

typedef struct walk walk;

struct walk {
    const oracle_scene *scene;
    const oracle_view *view;
    oracle_report *report;
    vector radiance;  // sum so far
    double uncovered; // transparent view: weight of paths that met no surface
    int depth;        // N
    int direction;    // rule 12: index of the facet that the path meets on rough glass
    bool faceted;     // the path met rough glass
    int wavelength;   // rule 14: wavelength of the path after a dispersive solid
    bool disperses;   // the path met a dispersive solid
    void (*follow)(walk *, const path *); // rule 7: continues to the next surface
};

// Ends a path at its ray: adds the light that it holds, or the environment's along the ray.
void oracle_escape(walk *w, const path *p);

// Rule 5: absorbs light along the segment, `distance` long, that ends at this surface.
void oracle_absorb(const oracle_scene *scene, path *p, const surface *s, double distance);

// Rule 14: restricts a path that meets a dispersive solid to one wavelength.
void oracle_disperse(walk *w, path *p, const surface *s);

// Scatters the light of a path that has met a surface.
void oracle_meet(walk *w, const path *p, const surface *s);

// Rule 12: the number of facets of rough glass.
int oracle_facets_of(const oracle_view *view);

#endif
