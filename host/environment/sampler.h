// Looks up radiance along directions in a picture of any layout, and draws pictures in any layout.
#ifndef GLINT_ENVIRONMENT_SAMPLER_H
#define GLINT_ENVIRONMENT_SAMPLER_H

#include "base/status.h"
#include "environment/chart.h"
#include "environment/cube.h"
#include "image/image.h"

#ifdef __cplusplus
extern "C" {
#endif

// A picture for look-ups. Zero is valid: nothing to free.
typedef struct glint_sampler {
    glint_chart chart;
    const glint_image *image; // borrowed; NULL if `cube` holds everything
    glint_cube cube;          // faces with centres inside, with the borders between them
    bool owns_cube;
} glint_sampler;

// Makes a sampler. `image` has the chart's size and must outlive the sampler. Errors:
// GLINT_OUT_OF_MEMORY, GLINT_BAD_INPUT (the faces are too large for a cube).
glint_status glint_sampler_of_image(const glint_image *image, const glint_chart *chart,
                                    glint_sampler *sampler, glint_error *error);

// Makes a sampler of a cube, which must outlive it. Its chart is OpenEXR's layout with centres
// inside.
glint_sampler glint_sampler_of_cube(const glint_cube *cube);

void glint_sampler_free(glint_sampler *sampler);

// Looks up a direction of any length but zero, bilinearly. The result is continuous over the edges
// of faces and over the ±180° and the poles of a lat-long map. In a disc, only pixels with their
// centres inside it count.
void glint_sampler_look_up(const glint_sampler *sampler, glint_vec3 direction, double rgb[3]);

// Turns a requested direction into the direction to look up. The rows are of an orthogonal matrix,
// which may be a reflection.
typedef struct glint_turn {
    glint_vec3 rows[3];
} glint_turn;

extern const glint_turn glint_turn_none;

// Mirrors the environment along the axes named in `flip` ("xz"; NULL: none), then turns it about +Y
// by degrees (positive: counter-clockwise seen from above).
glint_turn glint_turn_of(double degrees, const char *flip);

// Draws a picture of three channels in another layout. Each pixel is a look-up along its direction.
// If it covers more than one pixel of the source, it is the mean of a grid of look-ups. Pixels that
// the layout does not use (beside a cross, outside a disc) are 0. The number of threads does not
// change the result. Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_resample(const glint_sampler *from, const glint_turn *turn,
                            const glint_chart *to, glint_image *image, glint_error *error);

#ifdef __cplusplus
}
#endif

#endif
