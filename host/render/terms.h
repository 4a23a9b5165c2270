// What a frame's pixels are the sum of: directions that their paths leave along, with weights; so
// that another environment lights them without tracing.
#ifndef GLINT_RENDER_TERMS_H
#define GLINT_RENDER_TERMS_H

#include "base/status.h"
#include "environment/environment.h"
#include "image/image.h"
#include "image/image_io.h"
#include "render/layers.h"

#include <stddef.h>

// As channels of an EXR: terms.constant_r, _g, _b (what does not depend on the environment),
// terms.dropped (the weight that found no room), and of each of `capacity` places, the heaviest
// terms of a pixel in no order, terms.NN.x, .y, .z (a unit vector in the world's axes), .kind (0:
// the environment's radiance along it; 1: its irradiance over π of a surface with that normal),
// .wr, .wg, .wb (the weight). Places that are not taken, behind the others, hold 0.
// Adds those channels to a frame's layers, from what the kernels stored (see kernels/layout.h).
// Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_terms_add_channels(const float *stored, size_t pixel_count, int capacity,
                                      glint_layers *layers, glint_error *error);

// A file's terms. Zero is valid: none.
typedef struct glint_terms {
    glint_channels channels;
    int capacity;                     // places of a pixel
    int places[GLINT_LAYER_CHANNELS]; // of the channels, in the order above
    int alpha;                        // the place of A; −1: none
    bool has_irradiance;              // some term is of that kind
    double dropped;                   // the share of all weight that found no room
} glint_terms;

// Errors: GLINT_BAD_INPUT, also for a file without terms.
glint_status glint_terms_read(const char *path, glint_terms *terms, glint_error *error);
void glint_terms_free(glint_terms *terms);

// The picture under an environment that is turned about +Y by `degrees`, with the alpha that was
// stored: premultiplied RGBA. *image need not be set. Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_terms_relight(const glint_terms *terms, const glint_environment *environment,
                                 double degrees, glint_image *image, glint_error *error);

#endif
