// Diagnostic layers (arbitrary output variables) of a frame: what became of each pixel's paths.
//
// Layers that measure are means over a pixel's samples, but for the depth, which is their maximum.
// Layers that name something are of one sample: of k × k, that in column and row k/2, rounded down,
// which is the nearest to the pixel's centre (for even k one of four).
#ifndef GLINT_RENDER_LAYERS_H
#define GLINT_RENDER_LAYERS_H

#include "base/status.h"
#include "image/image_io.h"

#include <stddef.h>
#include <stdint.h>

typedef enum glint_aov {
    GLINT_AOV_DEPTH,     // surfaces that the pixel's longest path met; 0: the background alone
    GLINT_AOV_TIR,       // how many times its paths were reflected totally
    GLINT_AOV_TRUNCATED, // weight (largest of R, G, B) that took the environment without being
                         // traced, by depth, least weight and stack together
    GLINT_AOV_TRIANGLE, // number in the scene of the triangle that the primary ray meets, −1: none
    GLINT_AOV_MATERIAL, // that triangle's, an index into the scene's materials, −1: none
    GLINT_AOV_FACE, // face of the environment's cube (0 to 5: +X −X +Y −Y +Z −Z) in which the
                    // heaviest look-up falls, of equals the first on the path; −1: no look-up
                    // with a weight above 0
    GLINT_AOV_COUNT
} glint_aov;

// A set of layers is the sum of their bits.
#define GLINT_AOV_BIT(aov) (1u << (aov))
#define GLINT_AOV_ALL (GLINT_AOV_BIT(GLINT_AOV_COUNT) - 1)

// Up to this number of triangles a float tells their numbers exactly; above, it is rounded to a
// multiple of 2, from 2²⁵ of 4, and from 2²⁶ of 8.
#define GLINT_AOV_TRIANGLES_EXACT (1u << 24)

// The layer's name: "depth".
const char *glint_aov_name(glint_aov aov);

// A set by its layers' names with commas between them, or "all"; `option` is named in messages.
// Errors: GLINT_USAGE.
glint_status glint_aovs_parse(const char *option, const char *text, uint32_t *aovs,
                              glint_error *error);
void glint_aovs_print(uint32_t aovs, char *text, size_t capacity); // of none ""

#define GLINT_TERMS_MAX 32 // that are kept of a pixel, see terms.h
#define GLINT_LAYER_CHANNELS 240
#define GLINT_LAYER_NAME 24 // bytes of a term's channel's name

// Layers, in the order of glint_aov, and terms, as channels of an EXR. Zero is valid and empty.
typedef struct glint_layers {
    glint_channel channels[GLINT_LAYER_CHANNELS];
    size_t count;
    float *values, *term_values;     // owned; the channels point into them
    char (*names)[GLINT_LAYER_NAME]; // owned, likewise
} glint_layers;

void glint_layers_free(glint_layers *layers);

struct glint_layers_record; // kernels/layout.h
struct glint_settings;      // render/settings.h

// Makes the layers that the settings ask for from what the kernels noted of each of `pixel_count`
// pixels. The caller frees them. Errors: GLINT_OUT_OF_MEMORY; *layers is then empty.
glint_status glint_layers_make(const struct glint_layers_record *records, size_t pixel_count,
                               const struct glint_settings *settings, glint_layers *layers,
                               glint_error *error);

#endif
