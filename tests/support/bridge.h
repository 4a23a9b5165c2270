// What glint loads, as the oracle takes it: data is copied, and no code of the renderer that is
// judged is called. (An irradiance map may be handed over; tests/test_irradiance.c judges it.)
#ifndef GLINT_TESTS_SUPPORT_BRIDGE_H
#define GLINT_TESTS_SUPPORT_BRIDGE_H

#include "environment/environment.h"
#include "oracle/oracle.h"
#include "render/plan.h"
#include "scene/scene.h"

typedef struct bridge bridge;

// The scene in world space with its environment: looked up in the cube's own texels, bilinear, by
// code of the test's own; irradiance as the plain sum over all texels, so keep the cube small.
// Borrows scene and environment. Fails the running test if memory is short.
bridge *bridge_create(const glint_scene *scene, const glint_environment *environment);
void bridge_free(bridge *b);

const oracle_scene *bridge_scene(const bridge *b);

// Reads the textures from the scene's file anew (file_textures.h), and does not take the levels
// that the device gets.
void bridge_read_textures(bridge *b, const glint_scene *scene);

// Takes irradiance from a map, bilinear, as the kernels do, and not as the plain sum. Borrows it.
void bridge_use_irradiance_map(bridge *b, const glint_cube *map);

// How near the look-ups since the last call came to a tie between two faces of the cube, where
// rounding decides in which of them a direction is looked up: the least difference between the two
// largest components; INFINITY without look-ups.
double bridge_take_tie(const bridge *b);

// The camera and the settings; depth auto becomes the most that glint follows.
oracle_view bridge_view(const glint_camera *camera, const glint_settings *settings);

// An environment whose colour tells the direction: 0.5 + 0.5 d, with a cube of `edge` texels.
void bridge_direction_environment(int edge, glint_environment *environment);

#endif
