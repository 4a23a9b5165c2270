// What may be asked for of a frame: the settings.
#ifndef GLINT_RENDER_SETTINGS_H
#define GLINT_RENDER_SETTINGS_H

#include "base/status.h"
#include "device/capabilities.h"
#include "render/layers.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stdint.h>

typedef enum glint_precision {
    GLINT_PRECISION_FLOAT,
    GLINT_PRECISION_DOUBLE,
} glint_precision;

// How reflectance depends on the angle.
typedef enum glint_fresnel {
    GLINT_FRESNEL_EXACT, // exactly for dielectrics, by Schlick's approximation for metal (glTF 2.0)
    GLINT_FRESNEL_NONE,  // not at all: metal reflects its base colour, glass only where it reflects
                         // all, paint nothing
} glint_fresnel;

// Where the environment is looked up: the lecture's two alternatives, and ours. At vertices what
// surfaces see is the environment alone, whatever is in between.
typedef enum glint_shading {
    GLINT_SHADING_PIXEL,            // at what each primary ray meets
    GLINT_SHADING_VERTEX_DIRECTION, // directions are found at vertices, interpolated, and looked up
    GLINT_SHADING_VERTEX_COLOR,     // colours are found at vertices and interpolated
} glint_shading;

// What a pixel holds.
typedef enum glint_output {
    GLINT_OUTPUT_COLOR, // radiance R, G, B, premultiplied; alpha
    GLINT_OUTPUT_HITS, // what its ray met: the distance from its start in stored units, barycentric
                       // weights of the second and third vertex, the triangle's number in the
                       // scene; without a hit 0, 0, 0, −1. One sample, primary rays alone.
} glint_output;

// What the environment's texels are on the device.
typedef enum glint_texels {
    GLINT_TEXELS_AUTO, // half where that costs next to nothing, see plan_device.c
    GLINT_TEXELS_HALF,
    GLINT_TEXELS_FLOAT,
} glint_texels;

// How the environment is taken along a direction.
typedef enum glint_filter {
    GLINT_FILTER_BILINEAR, // between the four nearest texels, however much a pixel sees of it
    GLINT_FILTER_MIP,      // from levels whose texels are as wide as what a pixel sees
} glint_filter;

// What lights matte paint.
typedef enum glint_irradiance {
    GLINT_IRRADIANCE_EXACT, // a map, see environment/irradiance.h
    GLINT_IRRADIANCE_SH,    // nine spherical harmonics, see environment/harmonics.h
} glint_irradiance;

// How often light is reflected between the microfacets of rough surfaces.
typedef enum glint_scattering {
    GLINT_SCATTERING_SINGLE,   // once; the rest is lost, as in glTF's rule
    GLINT_SCATTERING_MULTIPLE, // as often as it takes: a white surface reflects all
} glint_scattering;

// What becomes of rough surfaces that pixels shade, without terms and proxy; else they are smooth.
typedef enum glint_roughness {
    GLINT_ROUGHNESS_FAST,   // lobes, to about a hundredth
    GLINT_ROUGHNESS_EXACT,  // to a few thousandths
    GLINT_ROUGHNESS_SMOOTH, // metal and glass are as smooth, and paint reflects nothing
} glint_roughness;

// Whether the file's punctual lights shine.
typedef enum glint_lights {
    GLINT_LIGHTS_FILE, // on paint that pixels shade
    GLINT_LIGHTS_NONE,
} glint_lights;

#define GLINT_LIST_COLUMNS 16
#define GLINT_SAMPLES_PER_AXIS_MAX 64
#define GLINT_FACETS_MAX 65536
#define GLINT_DEPTH_MAX 64   // what --depth auto stops at; larger depths may be asked for by number
#define GLINT_SIDE_MAX 65536 // pixels: what the hard cases ask for, and formats hold

// What the user asks for. glint_settings_default fills it. Ranges, words and what depends on each
// stand in settings_table.c.
typedef struct glint_settings {
    int width, height; // pixels
    int grid_step;     // 0, or n ≥ 2: of an image of width × height pixels render every nth of
                       // every nth row alone, see glint_settings_pixels
    // Or of these alone: [list_rows][GLINT_LIST_COLUMNS] numbers of pixels, row by row of the
    // image, borrowed while they are the renderer's settings; NULL and 0: no list. Neighbours in it
    // are rendered together, in blocks of up to 4 × 4. No grid_step beside it, nor shading at
    // vertices.
    const uint32_t *list;
    int list_rows;
    int samples_per_axis; // k of k² samples a pixel
    int depth;            // surfaces a path meets; 0: auto
    double min_weight;    // 0 follows every branch to the depth
    bool transparent;     // background transparent, else the environment
    const char *plate;    // a picture that whoever writes the frame puts behind it; NULL: none.
                          // Borrowed, and not read here; the background is transparent then
    double backdrop[4];   // R, G, B (radiance, ≥ 0) and alpha, 1, of what is behind a transparent
                          // scene; zeros: nothing
    double env_rotate;    // degrees about +Y, counter-clockwise seen from above
    glint_precision precision;
    // Above 0, in single precision: pixels that differ from a neighbour by more than `mend` times
    // the frame's mean are rendered again in double precision, see mend.h. Only beside colours that
    // pixels shade; a grid or a list of pixels is not mended.
    double mend;
    glint_fresnel fresnel;
    glint_output output;
    glint_texels texels;
    glint_filter filter;
    int anisotropy; // taps of a texture along the ellipse that a pixel sees, at most: 1 or more
    glint_irradiance irradiance;
    glint_lights lights;
    glint_roughness roughness;
    glint_scattering scattering;
    int facets;            // directions of a pixel that meets rough glass, 1 or more
    int wavelengths;       // that light is divided into by solids that disperse it: 1 to
                           // GLINT_WAVELENGTHS_MAX; 1: it is not
    bool proxy;            // the environment has one (environment.h), which is heeded: with the
                           // bilinear filter, shading pixel and no terms
    glint_shading shading; // other than pixel: depth 0 or 1, the bilinear filter, no layers
    int terms;             // of each pixel's that are kept, to light it anew, see terms.h: up to
               // GLINT_TERMS_MAX, 0: none; only beside colours, with the bilinear filter
    uint32_t aovs; // the set of diagnostic layers wanted, see layers.h; only beside colours
    bool truncation_squares; // glint_truncation.rms is wanted
    int kernel_width;        // lanes: 1, 8 or 16; 0: the plan's choice
    int tile_packets;        // of a tile: 1 or 16; 0: the plan's choice
    bool all_features; // compile everything, needed or not (to test that it changes nothing but
                       // the rounding of mirrors at depth 1, which take a shorter way without)
    // 0, or a number that the kernels get and do not read: a build with a new one is in no driver's
    // cache yet (to time it).
    uint32_t build_tag;
} glint_settings;

// The pixels that are rendered: columns and rows of the frame, or of the list. Of a grid, its first
// pixel stands in the middle of the first n × n.
void glint_settings_pixels(const glint_settings *settings, int size[2]);

// Whether a renderer that was made with `first` takes these settings: both shade pixels, and they
// differ by what varies alone (settings_table.h) and by the list. Roughness does, but for SMOOTH.
// Depth auto is no variation of a depth by number, with which nothing is proved of the scene.
bool glint_settings_are_variation(const glint_settings *settings, const glint_settings *first);

extern const glint_settings glint_settings_default;

// Whether the settings are in range, go together and suit the device. The scene is read for hits
// alone. Errors: GLINT_USAGE; GLINT_DEVICE_FAILED for what the device cannot do (double precision
// without cl_khr_fp64).
glint_status glint_settings_check(const glint_settings *settings, const glint_capabilities *device,
                                  const glint_scene *scene, glint_error *error);

// Whether rough surfaces are to be seen, but for terms.
bool glint_settings_heed_roughness(const glint_settings *settings);

// Whether dispersion is to be seen.
bool glint_settings_heed_dispersion(const glint_settings *settings);

// Directions that a pixel takes where it meets rough glass: those of all its samples, which go over
// them in so many rounds.
int glint_settings_directions(const glint_settings *settings);
int glint_settings_rounds(const glint_settings *settings);

// How far off a cell of the environment may be (kernels/layout.h, Lobes), of its brightness.
double glint_lobe_tolerance(glint_roughness roughness);

// "pixel", "vertex-direction", "vertex-color".
const char *glint_shading_name(glint_shading shading);

#endif
