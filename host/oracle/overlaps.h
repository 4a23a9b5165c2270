// Between the oracle's own files: rule 5 where solids touch or overlap.
#ifndef GLINT_ORACLE_OVERLAPS_H
#define GLINT_ORACLE_OVERLAPS_H

#include "oracle/oracle.h"
#include "oracle/vector.h"

// The materials of the solids before and beyond a hit, −1 for none. *hit becomes that of the
// surface which is met: one that bounds no solid or, if there is none, that of the solid which is
// there on one side alone. False: there is none of either kind.
bool oracle_sides(const oracle_scene *scene, const oracle_ray *ray, oracle_hit *hit, int sides[2]);

// The first hit of a primary ray, from `hit` on, that is not in one place with the eye.
oracle_hit oracle_pass_eye(const oracle_scene *scene, const oracle_ray *ray, oracle_hit hit);

// Where a ray starts that leaves a surface: beside all that is in one place with it.
vector oracle_start_beside(const oracle_scene *scene, int triangle, vector point, vector direction);

#endif
