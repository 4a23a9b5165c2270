// Gives scenes of the self-test textures and attributes by formula.
#ifndef GLINT_SELFTEST_DRESSING_H
#define GLINT_SELFTEST_DRESSING_H

#include "base/status.h"
#include "scene/scene.h"

// The number of images, and the one whose levels keep the coverage of its alpha.
enum { DRESSING_IMAGES = 4, DRESSING_COVERAGE = 1 };

// Gives the images to a scene without textures.
glint_status dressing_add_images(glint_scene *scene, glint_error *error);

// A use of an image. `variant` selects the sampler: 3 × 3 wrap modes, 2 × 2 × 3 filters, with or
// without a transform, and the texture coordinates.
glint_texture_use dressing_use(int image, int variant);

// Gives all corners two texture coordinates, a colour and a tangent, from their positions. The
// alpha of the material `even` is 1; −1: of none.
glint_status dressing_add_attributes(glint_scene *scene, int even, glint_error *error);

#endif
