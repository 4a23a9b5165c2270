// The plan: what is compiled for one scene on one device, and why. Pure: it calls no OpenCL.
#ifndef GLINT_RENDER_PLAN_H
#define GLINT_RENDER_PLAN_H

#include "accel/bvh.h"
#include "base/status.h"
#include "device/capabilities.h"
#include "environment/environment.h"
#include "environment/half_texels.h"
#include "kernels/features.h"
#include "render/layers.h"
#include "scene/scene.h"
#include "scene/sight.h"
#include "scene/topology.h"

#include <stdbool.h>
#include <stddef.h>
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
    GLINT_TEXELS_AUTO, // half where that costs next to nothing, see plan.c
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

typedef enum glint_feature {
#define GLINT_FEATURE_NAME(name, meaning) GLINT_FEATURE_##name,
    GLINT_FEATURES(GLINT_FEATURE_NAME)
#undef GLINT_FEATURE_NAME
        GLINT_FEATURE_COUNT
} glint_feature;

#define GLINT_LIST_COLUMNS 16
#define GLINT_SAMPLES_PER_AXIS_MAX 64
#define GLINT_DEPTH_MAX 64 // what --depth auto stops at; larger depths may be asked for by number
#define GLINT_DEFAULT_MIN_WEIGHT (1.0 / 1024)

// What the user asks for. glint_settings_default fills it.
typedef struct glint_settings {
    int width, height; // pixels, ≥ 1
    int grid_step;     // 0, or n ≥ 2: of an image of width × height pixels render every nth of
                       // every nth row alone, see glint_settings_pixels
    // Or of these alone: [list_rows][GLINT_LIST_COLUMNS] numbers of pixels, row by row of the
    // image, borrowed while they are the renderer's settings; NULL and 0: no list. Neighbours in it
    // are rendered together, in blocks of up to 4 × 4. No grid_step beside it, nor shading at
    // vertices.
    const int32_t *list;
    int list_rows;
    int samples_per_axis; // k of k² samples a pixel, ≥ 1
    int depth;            // surfaces a path meets, ≥ 1; 0: auto
    double min_weight;    // in [0, 1]; 0 follows every branch to the depth
    bool transparent;     // background transparent, else the environment
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
    glint_irradiance irradiance;
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

// Whether `settings` are those of `first`, which shade pixels, but for precision, mend, texels,
// depth, least weight, grid_step, list, layers, terms and truncation_squares, and so need no
// renderer of their own. Depth auto is no variation of a depth by number, with which nothing is
// proved of the scene.
bool glint_settings_are_variation(const glint_settings *settings, const glint_settings *first);

extern const glint_settings glint_settings_default; // 1280 × 720, 1 sample, auto, 1/1024, float

// How a feature was decided.
typedef struct glint_feature_choice {
    bool compiled;
    char reason[120]; // "3 of 8 materials are metal", "no material has a volume"
} glint_feature_choice;

typedef struct glint_plan {
    glint_feature_choice features[GLINT_FEATURE_COUNT];
    glint_precision precision;
    int kernel_width; // lanes: rays of a packet
    char width_reason[120];
    bool tiles; // a work-item renders 4 × 4 packets, whose primary rays are traced together
    char tiles_reason[120];
    char secondary[120]; // how rays from one surface to the next are traced
    bool half_texels;    // of the environment, else float; the irradiance map's are float always
    char texels_reason[160];
    double texels_rmse; // relative RMSE that half texels add to the environment; 0 with float
    int bvh_width;      // children of a node
    glint_shading shading;
    int depth; // surfaces at most
    bool depth_is_auto;
    glint_sight sight;   // what is proved of the scene, where the settings heed that
    bool depth_is_exact; // `depth` is what sight proved: nothing changes beyond
    int stack_capacity;  // waiting branches of a pixel; 0 without SPLIT
    char stack_reason[120];
    int media_count;     // distinct media (index of refraction and absorption), without empty space
    int media_bits;      // bits of one entry of the stack of media
    int media_capacity;  // entries of that stack
    int traversal_stack; // entries of the traversal's stack; set once the tree is built
    size_t environment_bytes; // device memory for the environment
    uint32_t build_tag;       // the settings'
} glint_plan;

// Names of a feature and what it adds, from kernels/features.h.
const char *glint_feature_name(glint_feature feature);
const char *glint_feature_meaning(glint_feature feature);

// "pixel", "vertex-direction", "vertex-color".
const char *glint_shading_name(glint_shading shading);

// Everything the decision rests on. Pointers are borrowed. The topology is read only where some
// material bounds a solid; it may be empty where none does.
typedef struct glint_plan_inputs {
    const glint_scene *scene;
    const glint_topology *topology;
    const glint_sight *sight; // NULL: nothing is known of what paths can meet
    const glint_cube *environment;
    const glint_capabilities *device;
    const glint_settings *settings;
    const glint_half_rounding *half; // what the environment loses as halfs; NULL: to be found
} glint_plan_inputs;

// Lanes of a packet on the device where nobody asks for others: 1, 8 or 16.
int glint_plan_native_width(const glint_capabilities *device, glint_precision precision);

// Whether the settings are in range, go together and suit the device: what glint_plan_make asks
// first. Of `inputs` scene, device and settings are read.
glint_status glint_plan_check_settings(const glint_plan_inputs *inputs, glint_error *error);

// Errors: GLINT_USAGE for settings out of range and for half texels of an environment that half
// cannot hold, GLINT_DEVICE_FAILED for what the device cannot do (double precision without
// cl_khr_fp64).
glint_status glint_plan_make(const glint_plan_inputs *inputs, glint_plan *plan, glint_error *error);

// The plan for other settings of the same scene, environment and device, which are a variation of
// those that `plan` was made of. Scene and topology are not read. Errors: as glint_plan_make; *plan
// is then not to be used.
glint_status glint_plan_vary(const glint_plan_inputs *in, glint_plan *plan, glint_error *error);

// Chooses the texels for another environment alone. Scene and topology are not read. Errors: as
// glint_plan_make; of the plan only what concerns the texels is changed.
glint_status glint_plan_choose_texels(const glint_plan_inputs *in, glint_plan *plan,
                                      glint_error *error);

// Builds the tree of the scene's triangles that the plan's kernels go through. Errors: as
// glint_bvh_build.
glint_status glint_plan_build_tree(const glint_plan *plan, const glint_scene *scene, glint_bvh *bvh,
                                   glint_error *error);

// Fits a tree of the same scene at another time. False where it does not serve, see
// glint_bvh_refit.
bool glint_plan_refit_tree(const glint_plan *plan, const glint_scene *scene, glint_bvh *bvh);

// Whether a plan of these settings, or of a variation of them, heeds what is proved of the scene.
static inline bool glint_plan_may_heed_sight(const glint_settings *settings)
{
    return settings->depth == 0 && settings->output == GLINT_OUTPUT_COLOR &&
           settings->shading == GLINT_SHADING_PIXEL;
}

// Whether a plan that was made with a sight heeds it, as it does at first: not where the proof is
// for eyes outside and this one is inside (sight.from_outside). Changes the depth and whether paths
// go on; nothing else of a plan rests on these where no path splits, and where one may nothing is
// proved for eyes outside alone.
void glint_plan_heed_sight(glint_plan *plan, bool heed);

// Whether light is found at vertices.
static inline bool glint_plan_shades_vertices(const glint_plan *plan)
{
    return plan->shading != GLINT_SHADING_PIXEL;
}

// Bytes of a number of the plan's precision.
static inline size_t glint_plan_scalar_bytes(const glint_plan *plan)
{
    return plan->precision == GLINT_PRECISION_DOUBLE ? sizeof(double) : sizeof(float);
}

// The number of features compiled.
int glint_plan_feature_count(const glint_plan *plan);

// Writes the kernel build options ("-DGLINT_WIDTH=16 …") of at most `capacity` bytes.
void glint_plan_build_options(const glint_plan *plan, char *text, size_t capacity);

// One line that names the plan: "shading pixel, depth auto (at most 64), precision float, half
// texels, width 16, 12 of 18 features".
void glint_plan_describe(const glint_plan *plan, char *text, size_t capacity);

#endif
