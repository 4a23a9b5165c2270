// Computes rotations in glTF's form: unit quaternions (x, y, z, w).
#ifndef GLINT_SCENES_ROTATION_H
#define GLINT_SCENES_ROTATION_H

#include "base/vector.h"

// Rotates by `degrees` about a unit axis, counter-clockwise seen from the tip of the axis.
void rotation_about(glint_vec3 axis, double degrees, double rotation[4]);

// Applies `first`, then `second`.
void rotation_compose(const double second[4], const double first[4], double rotation[4]);

// Rotates a camera: −Z points from `eye` to `target`, +Y lies towards world +Y.
void rotation_look_at(glint_vec3 eye, glint_vec3 target, double rotation[4]);

glint_vec3 rotation_apply(const double rotation[4], glint_vec3 v);

#endif
