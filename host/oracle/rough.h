// Between the oracle's own files: rule 11, what rough surfaces see of the environment.
#ifndef GLINT_ORACLE_ROUGH_H
#define GLINT_ORACLE_ROUGH_H

#include "oracle/surface.h"

// Light by direction, in world space.
typedef vector (*seen_light)(const void *context, vector direction);

// ∫ D V (1 − m) E n·l dl and ∫ D V m E n·l dl over the directions l in front, m = (1 − v·h)⁵; and
// both where E is 1.
typedef struct lobe_integrals {
    vector base, edge;
    double white_base, white_edge;
} lobe_integrals;

// ∫ D V (1 − m) n·l and ∫ D V m n·l towards one direction, without the integral; white_… of it.
lobe_integrals oracle_lobe_towards(const surface *s, double roughness, vector direction);

// By strata × strata directions about the mirror direction of v, of which half are in each half
// plane.
lobe_integrals oracle_lobe(const surface *s, int strata, seen_light light, const void *context);

// Rule 15: the same of what a film reflects, of which `table` has the reflectance at v·h from 0 to
// 1 in equal steps: `base` is ∫ D V F E n·l dl, and `edge` that where E is 1.
enum { ORACLE_FILM_STEPS = 200 };
lobe_integrals oracle_film_lobe(const surface *s, int strata, const vector *table, seen_light light,
                                const void *context);

// Rule 17: ∫ D V E n·l dl of sheen, over strata × 2 strata directions, as `base`; of a white
// environment as `white_base`. And D V n·l towards one direction.
lobe_integrals oracle_sheen(const surface *s, int strata, seen_light light, const void *context);
double oracle_sheen_towards(const surface *s, vector direction);

// The surface as one of the facets that the viewer sees: number `number` of `count`, at a path's
// `met`th surface.
surface oracle_facet(const surface *s, int number, int count, int met);

// What Smith's height-correlated G leaves, of what its part for the viewer does, of light that a
// facet sends on at this cosine to the surface's normal; 0 where it leaves on the other side.
double oracle_opening(const surface *s, double cosine);

#endif
