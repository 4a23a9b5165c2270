// Converts scenes that glint has loaded to the oracle's form. It copies data and calls no code of
// the renderer under test. (An irradiance map may be handed over; tests/test_irradiance.c checks
// it.)
#ifndef GLINT_TESTS_SUPPORT_BRIDGE_H
#define GLINT_TESTS_SUPPORT_BRIDGE_H

#include "environment/environment.h"
#include "oracle/oracle.h"
#include "render/plan.h"
#include "scene/scene.h"

typedef struct bridge bridge;

// Makes the scene in world space with its environment. The test's own code looks up radiance in the
// cube's texels, bilinearly. Irradiance is the plain sum over all texels, so keep the cube small.
// Borrows scene and environment. Fails the running test if memory is short.
bridge *bridge_create(const glint_scene *scene, const glint_environment *environment);
void bridge_free(bridge *b);

const oracle_scene *bridge_scene(const bridge *b);

// Reads the textures from the scene's file again (file_textures.h), instead of the device's levels.
void bridge_read_textures(bridge *b, const glint_scene *scene);

// Looks up irradiance in a map, bilinearly as the kernels do, instead of summing. Borrows the map.
void bridge_use_irradiance_map(bridge *b, const glint_cube *map);

// How near the look-ups since the last call came to a tie between two faces of the cube, where
// rounding selects the face. The value is the least difference between the two largest components;
// INFINITY without look-ups.
double bridge_take_tie(const bridge *b);

// Converts the camera and the settings. Depth auto becomes glint's maximum.
oracle_view bridge_view(const glint_camera *camera, const glint_settings *settings);

// Makes an environment whose colour encodes direction: 0.5 + 0.5 d, with a cube of `edge` texels.
void bridge_direction_environment(int edge, glint_environment *environment);

#endif
