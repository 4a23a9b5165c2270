// Layers (arbitrary output variables) of a frame: what became of each pixel's paths, and what its
// primary ray met.
//
// Layers that measure paths are means over a pixel's samples, but for the surfaces, which are their
// maximum. Layers that tell of a surface or name something are of one sample: of k × k, that in
// column and row k/2, rounded down, which is the nearest to the pixel's centre (for even k one of
// four).
#ifndef GLINT_RENDER_LAYERS_H
#define GLINT_RENDER_LAYERS_H

#include "base/status.h"
#include "image/image_io.h"

#include <stddef.h>
#include <stdint.h>

typedef enum glint_aov {
    GLINT_AOV_SURFACES,  // that the pixel's longest path met; 0: the background alone
    GLINT_AOV_TIR,       // how many times its paths were reflected totally
    GLINT_AOV_TRUNCATED, // weight (largest of R, G, B) that took the environment without being
                         // traced, by depth, least weight and stack together
    GLINT_AOV_TRIANGLE, // number in the scene of the triangle that the primary ray meets, −1: none
    GLINT_AOV_MATERIAL, // that triangle's, by its index in the file, −1: none
    GLINT_AOV_OBJECT,   // the node that it hangs on, by its index in the file, −1: none
    GLINT_AOV_FACE, // face of the environment's cube (0 to 5: +X −X +Y −Y +Z −Z) in which the
                    // heaviest look-up falls, of equals the first on the path; −1: no look-up
                    // with a weight above 0
    GLINT_AOV_Z,    // metres from the eye to the first surface along the axis of view; ∞: none
    GLINT_AOV_NORMAL, // its shading normal: world space, unit, towards the viewer; 0: none
    GLINT_AOV_ALBEDO, // its base colour, linear R, G, B; 0: none
    GLINT_AOV_DEPTH,  // the surfaces by their old name
    GLINT_AOV_COUNT
} glint_aov;

// A set of layers is the sum of their bits. All of them are all but the old name.
#define GLINT_AOV_BIT(aov) (1u << (aov))
#define GLINT_AOV_ALL (GLINT_AOV_BIT(GLINT_AOV_DEPTH) - 1)
#define GLINT_AOV_VALID (GLINT_AOV_BIT(GLINT_AOV_COUNT) - 1)

// Those that need paths to be followed to their ends, also where they are proved to end earlier.
#define GLINT_AOV_OF_PATHS                                                                         \
    (GLINT_AOV_BIT(GLINT_AOV_SURFACES) | GLINT_AOV_BIT(GLINT_AOV_TIR) |                            \
     GLINT_AOV_BIT(GLINT_AOV_TRUNCATED) | GLINT_AOV_BIT(GLINT_AOV_DEPTH))

// Those with channels R, G, B or Y, of which OpenEXR's DWA compression loses digits.
#define GLINT_AOV_LOSSY (GLINT_AOV_BIT(GLINT_AOV_NORMAL) | GLINT_AOV_BIT(GLINT_AOV_ALBEDO))

// Up to this number of triangles a float tells their numbers exactly; above, it is rounded to a
// multiple of 2, from 2²⁵ of 4, and from 2²⁶ of 8.
#define GLINT_AOV_TRIANGLES_EXACT (1u << 24)

// The layer's name: "surfaces".
const char *glint_aov_name(glint_aov aov);

// A set by its layers' names, in letters of any case, with commas between them, or "all"; `option`
// is named in messages. Errors: GLINT_USAGE.
glint_status glint_aovs_parse(const char *option, const char *text, uint32_t *aovs,
                              glint_error *error);
void glint_aovs_print(uint32_t aovs, char *text, size_t capacity); // of none ""

// How many channels a set of layers has.
size_t glint_layers_channels(uint32_t aovs);

#define GLINT_TERMS_MAX 32    // that are kept of a pixel, see terms.h
#define GLINT_AOV_CHANNELS 15 // of all layers together
#define GLINT_LAYER_CHANNELS 244
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
struct glint_owners;        // render/owners.h
struct glint_settings;      // render/settings.h

// What layers are made of.
typedef struct glint_layers_inputs {
    const struct glint_layers_record *records; // what the kernels noted of each pixel
    size_t pixel_count;
    const struct glint_owners *owners; // of the scene's triangles
    const struct glint_settings *settings;
} glint_layers_inputs;

// Makes the layers that the settings ask for. The caller frees them. Errors: GLINT_OUT_OF_MEMORY;
// *layers is then empty.
glint_status glint_layers_make(const glint_layers_inputs *inputs, glint_layers *layers,
                               glint_error *error);

#endif
