// Stores a frame's pixels as sums of terms, and lights them again. A term is a direction along
// which paths leave, with a weight. So another environment can light the frame without tracing.
#ifndef GLINT_RENDER_TERMS_H
#define GLINT_RENDER_TERMS_H

#include "base/status.h"
#include "environment/environment.h"
#include "image/image.h"
#include "image/image_io.h"
#include "render/layers.h"

#include <stddef.h>

// Adds the terms as channels to a frame's layers, from the data that the kernels stored (see
// kernels/layout.h). The channels of the EXR are:
//  - terms.constant_r, _g, _b: light that does not depend on the environment;
//  - terms.dropped: the weight of terms that did not fit;
//  - for each of `capacity` places: terms.NN.x, .y, .z (a unit vector in the world's axes), .kind,
//    and .wr, .wg, .wb (the weight).
// Kind 0 is the environment's radiance along the vector. Kind 1 is its irradiance over π on a
// surface with this normal. The places hold the heaviest terms of a pixel, unordered. Unused places
// come last and hold 0. Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_terms_add_channels(const float *stored, size_t pixel_count, int capacity,
                                      glint_layers *layers, glint_error *error);

// The terms of a file. Zero is valid: none.
typedef struct glint_terms {
    glint_channels channels;
    int capacity;                     // places per pixel
    int places[GLINT_LAYER_CHANNELS]; // indices of the channels, in the order above
    int alpha;                        // index of channel A; −1: none
    bool has_irradiance;              // some term is of kind 1
    double dropped;                   // the share of all weight that did not fit
} glint_terms;

// Reads the terms of a file. Errors: GLINT_BAD_INPUT, also for a file without terms.
glint_status glint_terms_read(const char *path, glint_terms *terms, glint_error *error);
void glint_terms_free(glint_terms *terms);

// Computes the picture under an environment that is rotated about +Y by `degrees`. The result is
// premultiplied RGBA with the stored alpha. *image may be unset. Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_terms_relight(const glint_terms *terms, const glint_environment *environment,
                                 double degrees, glint_image *image, glint_error *error);

#endif
