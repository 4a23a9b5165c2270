// Radiance along directions, from a picture in any layout; and pictures in any layout from that.
#ifndef GLINT_ENVIRONMENT_SAMPLER_H
#define GLINT_ENVIRONMENT_SAMPLER_H

#include "base/status.h"
#include "environment/chart.h"
#include "environment/cube.h"
#include "image/image.h"

#ifdef __cplusplus
extern "C" {
#endif

// A picture that directions are looked up in. Zero is valid, and freed already.
typedef struct glint_sampler {
    glint_chart chart;
    const glint_image *image; // borrowed; NULL where `cube` holds all
    glint_cube cube;          // of faces whose centres lie inside: with the borders between them
    bool owns_cube;
} glint_sampler;

// `image` has the chart's size, and must outlive the sampler. Errors: GLINT_OUT_OF_MEMORY,
// GLINT_BAD_INPUT (faces that are too large for a cube).
glint_status glint_sampler_of_image(const glint_image *image, const glint_chart *chart,
                                    glint_sampler *sampler, glint_error *error);

// The cube, which must outlive the sampler, seen as OpenEXR's layout with centres inside.
glint_sampler glint_sampler_of_cube(const glint_cube *cube);

void glint_sampler_free(glint_sampler *sampler);

// The bilinear look-up along a direction of any length but zero. Continuous over the edges of
// faces, the ±180° of a lat-long map and its poles; of a disc only pixels count whose centres lie
// inside it.
void glint_sampler_look_up(const glint_sampler *sampler, glint_vec3 direction, double rgb[3]);

// Turns a direction that is asked for into the one that is looked up: rows of an orthogonal matrix,
// which may be a reflection.
typedef struct glint_turn {
    glint_vec3 rows[3];
} glint_turn;

extern const glint_turn glint_turn_none;

// The environment turned about +Y by degrees (positive: counter-clockwise seen from above), after
// having been mirrored along the axes that are named in `flip` ("xz"; NULL: none).
glint_turn glint_turn_of(double degrees, const char *flip);

// Draws a picture of three channels in another layout: each pixel is the look-up along its
// direction or, where it covers more than one pixel of what is sampled, the mean of a grid of
// look-ups over it. What the layout leaves open (beside a cross, outside a disc) is 0. The same for
// any number of threads. Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_resample(const glint_sampler *from, const glint_turn *turn,
                            const glint_chart *to, glint_image *image, glint_error *error);

#ifdef __cplusplus
}
#endif

#endif
