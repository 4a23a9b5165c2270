// Follows a punctual light's straight way to a surface. Internal to the oracle.
#ifndef GLINT_ORACLE_SHADOW_H
#define GLINT_ORACLE_SHADOW_H

#include "oracle/walk.h"

// State of the way: the light that is left, and the solids that the way is inside.
typedef struct oracle_shadow {
    const walk *walk;
    path way;
} oracle_shadow;

// Continues the way straight past the surface at `hit`, along `direction`. `state` is an
// oracle_shadow. Returns the light that is left, R, G and B.
vector oracle_pass_straight(void *state, const oracle_hit *hit, vector direction);

// The factor of the clear coat (rule 13), in [0, 1]. Inside a solid it is 0.
double oracle_clearcoat_of(const walk *w, const surface *s);

#endif
