// Scenes whose triangles share no vertices, for tests that read the arrays of corners.
#ifndef GLINT_TESTS_SUPPORT_BY_CORNER_H
#define GLINT_TESTS_SUPPORT_BY_CORNER_H

#include "scene/scene.h"

// Gives each corner a vertex of its own, and removes the indices. Corner c of triangle t is then
// vertex 3 t + c. Fails the test if memory is short.
void scene_by_corner(glint_scene *scene);

#endif
