// Makes the layers (arbitrary output variables) of a frame. They describe each pixel's paths, and
// the surface that its primary ray meets.
//
// Layers that measure paths are means over a pixel's samples; only the number of surfaces is a
// maximum. Layers that describe a surface or name something take one sample. Of k × k samples it is
// the one in column and row k/2, rounded down. It is the nearest to the pixel's centre (for even k
// one of four).
#ifndef GLINT_RENDER_LAYERS_H
#define GLINT_RENDER_LAYERS_H

#include "base/status.h"
#include "image/image_io.h"

#include <stddef.h>
#include <stdint.h>

typedef enum glint_aov {
    GLINT_AOV_SURFACES, // surfaces that the pixel's longest path met; 0: only the background
    GLINT_AOV_TIR,      // number of total internal reflections of the pixel's paths
    // Truncated weight (largest of R, G, B), which took the environment without tracing: by depth,
    // least weight and stack together.
    GLINT_AOV_TRUNCATED,
    GLINT_AOV_TRIANGLE, // number in the scene of the triangle that the primary ray meets; −1: none
    GLINT_AOV_MATERIAL, // index in the file of the triangle's material; −1: none
    GLINT_AOV_OBJECT,   // index in the file of the triangle's node; −1: none
    // Face of the environment's cube (0 to 5: +X −X +Y −Y +Z −Z) of the look-up with the largest
    // weight. Among equal weights, the first on the path counts. −1: no look-up with a weight above
    // 0.
    GLINT_AOV_FACE,
    GLINT_AOV_Z,      // metres from the eye to the first surface, along the view axis; ∞: none
    GLINT_AOV_NORMAL, // shading normal of the first surface: world space, unit, towards the viewer;
                      // 0: none
    GLINT_AOV_ALBEDO, // base colour of the first surface, linear R, G, B; 0: none
    GLINT_AOV_DEPTH,  // GLINT_AOV_SURFACES under its old name
    GLINT_AOV_COUNT
} glint_aov;

// A set of layers is the sum of their bits. GLINT_AOV_ALL is all of them without the old name.
#define GLINT_AOV_BIT(aov) (1u << (aov))
#define GLINT_AOV_ALL (GLINT_AOV_BIT(GLINT_AOV_DEPTH) - 1)
#define GLINT_AOV_VALID (GLINT_AOV_BIT(GLINT_AOV_COUNT) - 1)

// The layers for which paths must be followed to their ends, even if a proof allows them to end
// earlier.
#define GLINT_AOV_OF_PATHS                                                                         \
    (GLINT_AOV_BIT(GLINT_AOV_SURFACES) | GLINT_AOV_BIT(GLINT_AOV_TIR) |                            \
     GLINT_AOV_BIT(GLINT_AOV_TRUNCATED) | GLINT_AOV_BIT(GLINT_AOV_DEPTH))

// The layers with channels R, G, B or Y, in which OpenEXR's DWA compression loses digits.
#define GLINT_AOV_LOSSY (GLINT_AOV_BIT(GLINT_AOV_NORMAL) | GLINT_AOV_BIT(GLINT_AOV_ALBEDO))

// Up to this number of triangles, a float holds their numbers exactly. Above it, they are rounded
// to a multiple of 2, from 2²⁵ on of 4, and from 2²⁶ on of 8.
#define GLINT_AOV_TRIANGLES_EXACT (1u << 24)

// The layer's name: "surfaces".
const char *glint_aov_name(glint_aov aov);

// Parses a set of layers: names in upper or lower case, separated by commas, or "all". Messages
// name `option`. Errors: GLINT_USAGE.
glint_status glint_aovs_parse(const char *option, const char *text, uint32_t *aovs,
                              glint_error *error);
void glint_aovs_print(uint32_t aovs, char *text, size_t capacity); // no layers: ""

// The number of channels of a set of layers.
size_t glint_layers_channels(uint32_t aovs);

#define GLINT_TERMS_MAX 32    // terms kept per pixel, see terms.h
#define GLINT_AOV_CHANNELS 15 // of all layers together
#define GLINT_LAYER_CHANNELS 244
#define GLINT_LAYER_NAME 24 // bytes of the name of a term's channel

// Layers, in the order of glint_aov, and terms, as channels of an EXR. Zero is valid and empty.
typedef struct glint_layers {
    glint_channel channels[GLINT_LAYER_CHANNELS];
    size_t count;
    float *values, *term_values;     // owned; the channels point into them
    char (*names)[GLINT_LAYER_NAME]; // owned; the channels point to them
} glint_layers;

void glint_layers_free(glint_layers *layers);

struct glint_layers_record; // kernels/layout.h
struct glint_owners;        // render/owners.h
struct glint_settings;      // render/settings.h

// The inputs for making layers.
typedef struct glint_layers_inputs {
    const struct glint_layers_record *records; // records of the kernels, one per pixel
    size_t pixel_count;
    const struct glint_owners *owners; // of the scene's triangles
    const struct glint_settings *settings;
} glint_layers_inputs;

// Makes the layers that the settings ask for. The caller frees them. Errors: GLINT_OUT_OF_MEMORY;
// *layers is then empty.
glint_status glint_layers_make(const glint_layers_inputs *inputs, glint_layers *layers,
                               glint_error *error);

#endif
