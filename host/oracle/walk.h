// Between the oracle's own files: the walk along the tree of paths, and what surfaces do on it.
#ifndef GLINT_ORACLE_WALK_H
#define GLINT_ORACLE_WALK_H

#include "oracle/media.h"
#include "oracle/surface.h"

typedef struct path {
    vector origin, direction; // of the ray to be traced
    vector weight;            // what radiance along it counts for in the sample
    media inside;
    int beyond; // where solids may overlap: the solid beyond the surface that was met, or −1
    cone cone;  // where the ray starts
    int left;   // triangle that it leaves, or −1
    int met;    // surfaces met so far, but for those that were not there
    double travelled; // length of the path so far
    bool dispersed;   // it is of the walk's wavelength alone
    bool holds;       // brings `held` where it ends, in place of the environment's light
    vector held;
} path;

typedef struct walk walk;

struct walk {
    const oracle_scene *scene;
    const oracle_view *view;
    oracle_report *report;
    vector radiance;  // sum so far
    double uncovered; // weight of what met no surface at all, where the view is transparent
    int depth;        // N
    int direction;    // rule 12: which facets of rough glass the path meets
    bool faceted;     // it met some
    int wavelength;   // rule 14: which one the path is of once a solid has dispersed it
    bool disperses;   // one has
    void (*follow)(walk *, const path *); // rule 7: goes on to the next surface
};

// What a path takes along its direction where it ends.
void oracle_escape(walk *w, const path *p, vector direction, vector weight);

// Rule 5: absorbs along the segment that ends at this surface, of this length.
void oracle_absorb(const oracle_scene *scene, path *p, const surface *s, double distance);

// Rule 14: a path that meets a solid which disperses light is of one wavelength from there on.
void oracle_disperse(walk *w, path *p, const surface *s);

// What a surface does with the light of a path that has met it.
void oracle_meet(walk *w, const path *p, const surface *s);

// Rule 12: how many facets of rough glass there are.
int oracle_facets_of(const oracle_view *view);

#endif
