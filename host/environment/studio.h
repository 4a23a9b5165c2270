// Makes the built-in studio.
#ifndef GLINT_ENVIRONMENT_STUDIO_H
#define GLINT_ENVIRONMENT_STUDIO_H

#include "base/status.h"
#include "environment/cube.h"

// Draws a soft box overhead, two strips at the sides, a floor and a horizon, so that mirrors and
// glass have something to show. Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_studio_cube(glint_cube *cube, glint_error *error);

#endif
