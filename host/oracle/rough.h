// Integrates the environment over the lobes of rough surfaces (rule 11). Internal to the oracle.
#ifndef GLINT_ORACLE_ROUGH_H
#define GLINT_ORACLE_ROUGH_H

#include "oracle/surface.h"

// Light by direction, in world space.
typedef vector (*seen_light)(const void *context, vector direction);

// ∫ D V (1 − m) E n·l dl and ∫ D V m E n·l dl over the directions l in front, m = (1 − v·h)⁵.
// white_base and white_edge are the same integrals with E = 1.
typedef struct lobe_integrals {
    vector base, edge;
    double white_base, white_edge;
} lobe_integrals;

// Sets white_base and white_edge to D V (1 − m) n·l and D V m n·l towards one direction, not
// integrated.
lobe_integrals oracle_lobe_towards(const surface *s, double roughness, vector direction);

// Integrates over strata × strata directions about the mirror direction of v. Each half plane has
// half of the directions.
lobe_integrals oracle_lobe(const surface *s, int strata, seen_light light, const void *context);

// Integrates a film's lobe (rule 15). `table` has the film's reflectance F at v·h from 0 to 1, in
// equal steps. `base` is ∫ D V F E n·l dl; `edge` is the same integral with E = 1.
enum { ORACLE_FILM_STEPS = 200 };
lobe_integrals oracle_film_lobe(const surface *s, int strata, const vector *table, seen_light light,
                                const void *context);

// Integrates sheen (rule 17) over strata × 2 strata directions. `base` is ∫ D V E n·l dl;
// `white_base` is the same with E = 1. oracle_sheen_towards is D V n·l towards one direction.
lobe_integrals oracle_sheen(const surface *s, int strata, seen_light light, const void *context);
double oracle_sheen_towards(const surface *s, vector direction);

// The surface as one of the facets that the viewer sees: facet `number` of `count`, at a path's
// `met`th surface.
surface oracle_facet(const surface *s, int number, int count, int met);

// The share G(v, l)/G(v) of a facet's light that is not shadowed, with Smith's height-correlated G.
// `cosine` is between the direction l and the surface's normal. 0 if the light leaves on the wrong
// side.
double oracle_opening(const surface *s, double cosine);

#endif
