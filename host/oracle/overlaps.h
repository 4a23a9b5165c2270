// Handles rule 5 where solids touch or overlap. Internal to the oracle.
#ifndef GLINT_ORACLE_OVERLAPS_H
#define GLINT_ORACLE_OVERLAPS_H

#include "oracle/oracle.h"
#include "oracle/vector.h"

// Finds the materials of the solids before and beyond a hit, −1 for none, and the surface that the
// ray meets. Changes *hit to a surface there that bounds no solid. If there is none, it becomes the
// surface of the solid that is on one side alone. Returns false if there is neither.
bool oracle_sides(const oracle_scene *scene, const oracle_ray *ray, oracle_hit *hit, int sides[2]);

// The first hit of a primary ray, from `hit` on, that is not in one place with the eye.
oracle_hit oracle_pass_eye(const oracle_scene *scene, const oracle_ray *ray, oracle_hit hit);

// The start of a ray that leaves a surface: beside everything in one place with the surface.
vector oracle_start_beside(const oracle_scene *scene, int triangle, vector point, vector direction);

#endif
