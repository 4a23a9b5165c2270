// Defines and checks the settings of a frame.
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
    GLINT_FRESNEL_EXACT, // exact for dielectrics, Schlick's approximation for metal (glTF 2.0)
    // No dependence: metal reflects its base colour, glass only by total internal reflection, paint
    // nothing.
    GLINT_FRESNEL_NONE,
} glint_fresnel;

// Where the environment is looked up: the lecture's two alternatives, and our own. With shading at
// vertices, surfaces see only the environment; nothing blocks it.
typedef enum glint_shading {
    GLINT_SHADING_PIXEL, // at the surface that each primary ray meets
    // Directions are computed at vertices, interpolated, and looked up per pixel.
    GLINT_SHADING_VERTEX_DIRECTION,
    GLINT_SHADING_VERTEX_COLOR, // colours are computed at vertices and interpolated
} glint_shading;

// The content of a pixel.
typedef enum glint_output {
    GLINT_OUTPUT_COLOR, // radiance R, G, B, premultiplied; alpha
    // The hit of its primary ray: the distance from the start in stored units, the barycentric
    // weights of the second and third vertex, and the triangle's number in the scene. 0, 0, 0, −1
    // without a hit. One sample.
    GLINT_OUTPUT_HITS,
} glint_output;

// The type of the environment's texels on the device.
typedef enum glint_texels {
    GLINT_TEXELS_AUTO, // half if it costs almost no accuracy, see plan_device.c
    GLINT_TEXELS_HALF,
    GLINT_TEXELS_FLOAT,
} glint_texels;

// How the environment is filtered along a direction.
typedef enum glint_filter {
    // Interpolates the four nearest texels, however large the pixel's footprint is.
    GLINT_FILTER_BILINEAR,
    // Reads the levels whose texels are as wide as the pixel's footprint.
    GLINT_FILTER_MIP,
} glint_filter;

// The source of light on matte paint.
typedef enum glint_irradiance {
    GLINT_IRRADIANCE_EXACT, // a map, see environment/irradiance.h
    GLINT_IRRADIANCE_SH,    // nine spherical harmonics, see environment/harmonics.h
} glint_irradiance;

// How often light is reflected between the microfacets of rough surfaces.
typedef enum glint_scattering {
    GLINT_SCATTERING_MULTIPLE, // until all light has left: a white surface reflects all light
    GLINT_SCATTERING_SINGLE,   // once; the rest is lost
} glint_scattering;

// How rough surfaces are shaded. Surfaces are smooth with terms, with a proxy, and if pixels are
// not shaded.
typedef enum glint_roughness {
    GLINT_ROUGHNESS_FAST,   // lobes, with errors of about 1/100
    GLINT_ROUGHNESS_EXACT,  // lobes, with errors of a few thousandths
    GLINT_ROUGHNESS_SMOOTH, // metal and glass are smooth, and paint reflects nothing
} glint_roughness;

// The choice between kernels of the same bits, see general.h.
typedef enum glint_kernel_choice {
    // Special kernels that are compiled already, else general kernels that are, else special ones.
    GLINT_KERNELS_AUTO,
    GLINT_KERNELS_SPECIAL, // contain only what the scene needs: the fastest frames
    GLINT_KERNELS_GENERAL, // serve most scenes; special ones only for what they do not serve
} glint_kernel_choice;

// Whether the punctual lights of the file shine.
typedef enum glint_lights {
    GLINT_LIGHTS_FILE, // on paint that pixels shade
    GLINT_LIGHTS_NONE,
} glint_lights;

#define GLINT_LIST_COLUMNS 16
#define GLINT_SAMPLES_PER_AXIS_MAX 64
#define GLINT_FACETS_MAX 65536
// The largest depth of --depth auto. A depth given as a number may be larger.
#define GLINT_DEPTH_MAX 64
#define GLINT_SIDE_MAX 65536 // pixels: enough for the hard cases, and supported by the formats

// The settings that the user asks for. glint_settings_default holds the defaults. settings_table.c
// holds the ranges, the words, and what depends on each setting.
typedef struct glint_settings {
    int width, height; // pixels
    // 0, or n ≥ 2: renders only every nth pixel of every nth row of an image of width × height
    // pixels, see glint_settings_pixels.
    int grid_step;
    // Or renders only these pixels: [list_rows][GLINT_LIST_COLUMNS] pixel numbers, row by row of
    // the image. Borrowed while they are the renderer's settings. NULL and 0: no list. Neighbours
    // in the list are rendered together, in blocks of up to 4 × 4. Excludes grid_step and shading
    // at vertices.
    const uint32_t *list;
    int list_rows;
    int samples_per_axis; // k: each pixel has k² samples
    int depth;            // number of surfaces that a path meets; 0: auto
    double min_weight;    // 0 follows every branch to the depth
    bool transparent;     // transparent background, else the environment
    // File of a picture that the writer of the frame puts behind it; NULL: none. Borrowed, and not
    // read here. The background is then transparent.
    const char *plate;
    // Colour behind a transparent scene: R, G, B (radiance, ≥ 0) and alpha, 1. Zeros: no colour.
    double backdrop[4];
    double env_rotate; // degrees about +Y, counter-clockwise seen from above
    glint_precision precision;
    // Limit for mending in single precision; 0: off. A pixel that differs from a neighbour by more
    // than `mend` times the frame's mean is rendered again in double precision, see mend.h. Works
    // only for colours with shading per pixel. A grid or a list of pixels is not mended.
    double mend;
    glint_fresnel fresnel;
    glint_output output;
    glint_texels texels;
    glint_filter filter;
    // Largest number of texture samples along the elliptical footprint of a pixel: 1 or more.
    int anisotropy;
    glint_irradiance irradiance;
    glint_lights lights;
    glint_roughness roughness;
    glint_scattering scattering;
    // Directions per pixel that meets rough glass: 1 or more.
    int facets;
    // Number of wavelengths for solids that disperse light: 1 (no dispersion) to
    // GLINT_WAVELENGTHS_MAX.
    int wavelengths;
    // Uses the environment's proxy (environment.h). Needs the bilinear filter, shading pixel and no
    // terms.
    bool proxy;
    // Shading at vertices needs depth 0 or 1, the bilinear filter, and no layers.
    glint_shading shading;
    // Terms kept per pixel to light the frame again, see terms.h: up to GLINT_TERMS_MAX; 0: none.
    // Only with colours and the bilinear filter.
    int terms;
    // The set of diagnostic layers, see layers.h. Only with colours.
    uint32_t aovs;
    bool truncation_squares;     // compute glint_truncation.rms
    int kernel_width;            // lanes: 1, 8 or 16; 0: the plan's choice
    int tile_packets;            // packets per tile: 1 or 16; 0: the plan's choice
    glint_kernel_choice kernels; // which of several kernels with the same bits runs
    // Compiles all features, needed or not, to test that they change nothing. Only the rounding of
    // mirrors at depth 1 changes, which have a shorter code path otherwise.
    bool all_features;
    // 0, or a number that is passed to the kernels but not read. A build with a new number is in no
    // driver's cache yet, so that its time can be measured.
    uint32_t build_tag;
} glint_settings;

// Computes the size of the rendered picture in pixels: columns and rows of the frame, the grid or
// the list. The first pixel of a grid is in the middle of the first n × n pixels.
void glint_settings_pixels(const glint_settings *settings, int size[2]);

// True if a renderer that was made with `first` accepts these settings. Both must shade pixels.
// They may differ in settings that vary (settings_table.h), in the list, and in the roughness,
// except SMOOTH. If `first` has a depth as a number, depth auto is no variation, because nothing is
// proved about the scene.
bool glint_settings_are_variation(const glint_settings *settings, const glint_settings *first);

extern const glint_settings glint_settings_default;

// Checks that the settings are in range, compatible with each other, and supported by the device.
// Reads the scene only for hits. Errors: GLINT_USAGE; GLINT_DEVICE_LACKS if the device lacks a
// feature (double precision without cl_khr_fp64).
glint_status glint_settings_check(const glint_settings *settings, const glint_capabilities *device,
                                  const glint_scene *scene, glint_error *error);

// True if rough surfaces are visible; ignores terms.
bool glint_settings_heed_roughness(const glint_settings *settings);

// True if dispersion is visible.
bool glint_settings_heed_dispersion(const glint_settings *settings);

// The number of directions of a pixel that meets rough glass: those of all its samples. Rounds:
// directions per sample.
int glint_settings_directions(const glint_settings *settings);
int glint_settings_rounds(const glint_settings *settings);

// The allowed error of a cell of the environment (kernels/layout.h, Lobes), relative to the
// environment's brightness.
double glint_lobe_tolerance(glint_roughness roughness);

// "pixel", "vertex-direction", "vertex-color".
const char *glint_shading_name(glint_shading shading);

#endif
