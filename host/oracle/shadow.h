// Between the oracle's own files: the way of a punctual light to a surface.
#ifndef GLINT_ORACLE_SHADOW_H
#define GLINT_ORACLE_SHADOW_H

#include "oracle/walk.h"

// The way so far: what is left of the light, and the solids that it is inside.
typedef struct oracle_shadow {
    const walk *walk;
    path way;
} oracle_shadow;

// Takes the way (`state`: an oracle_shadow) straight on past what it meets, along `direction`.
// Returns what is left of the light, R, G and B.
vector oracle_pass_straight(void *state, const oracle_hit *hit, vector direction);

// Rule 13: how much of a clear coat there is, in [0, 1]. From within a solid none is seen.
double oracle_clearcoat_of(const walk *w, const surface *s);

#endif
