// The plan: what is compiled for a scene on a device, and why.
#ifndef GLINT_RENDER_PLAN_H
#define GLINT_RENDER_PLAN_H

#include "accel/bvh.h"
#include "base/status.h"
#include "device/capabilities.h"
#include "environment/environment.h"
#include "environment/half_texels.h"
#include "kernels/features.h"
#include "render/settings.h"
#include "scene/scene.h"
#include "scene/shape/sight.h"
#include "scene/shape/solids.h"
#include "scene/shape/topology.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// The decision about a feature.
typedef struct glint_feature_choice {
    bool compiled;
    char reason[120]; // "3 of 8 materials are metal", "no material has a volume"
} glint_feature_choice;

#define GLINT_PLAN_BOXES 16

typedef struct glint_plan {
    glint_feature_choice features[GLINT_FEATURE_COUNT];
    glint_precision precision;
    int kernel_width; // lanes: the number of rays in a packet
    char width_reason[120];
    // A work-item renders 4 × 4 packets and traces their primary rays together.
    bool tiles;
    char tiles_reason[120];
    char secondary[120]; // description of how rays between surfaces are traced
    // The environment has half texels, else float. The irradiance map is always float.
    bool half_texels;
    char texels_reason[160];
    double texels_rmse; // relative RMSE that half texels add to the environment; 0 with float
    int bvh_width;      // children of a node
    glint_shading shading;
    int depth; // largest number of surfaces of a path
    bool depth_is_auto;
    glint_sight sight;   // the proof about the scene, if the settings allow its use
    bool depth_is_exact; // `depth` is the depth that sight proved: a larger one changes nothing
    int stack_capacity;  // waiting branches per pixel; 0 without SPLIT
    char stack_reason[120];
    glint_solids_remarks remarks; // what to warn about
    // Bounding boxes of solids, in stored coordinates. The last box holds all remaining solids.
    int box_count;
    float boxes[GLINT_PLAN_BOXES][2][3];
    // Number of different media (index of refraction and absorption), without empty space.
    int media_count;
    int media_bits;     // bits per entry of the stack of media
    int media_capacity; // entries of the stack of media
    // Entries of the stack of the traversal; set after the tree is built.
    int traversal_stack;
    size_t environment_bytes; // device memory for the environment
    size_t light_count;       // lights that shine, if a material shows them
    bool has_facets;          // the settings show rough glass, except with terms
    bool is_brushed;          // the settings show brushed lobes, except with terms
    bool has_sheen;           // the settings show sheen above metal or paint, except with terms
    bool is_translucent;      // paint is lit from behind, except with terms
    bool disperses;           // the scene has solids that disperse light
    int cells_last;           // finest level of cells that rough surfaces need; −1: none
    uint32_t build_tag;       // from the settings
} glint_plan;

// The name of a feature, and its meaning, from kernels/features.h.
const char *glint_feature_name(glint_feature feature);
const char *glint_feature_meaning(glint_feature feature);

// The inputs of the decision. Pointers are borrowed. The topology is read only if a material bounds
// a solid; otherwise it may be empty.
typedef struct glint_plan_inputs {
    const glint_scene *scene;
    const glint_topology *topology;
    const glint_solids *solids; // solids of the scene; NULL: no solid touches another
    const glint_sight *sight;   // NULL: nothing is proved about paths
    const glint_cube *environment;
    const glint_capabilities *device;
    const glint_settings *settings;
    // Rounding error of the environment as halfs; NULL: it is measured.
    const glint_half_rounding *half;
} glint_plan_inputs;

// True if a plan of these settings, or of a variation of them, may use proofs about the scene.
static inline bool glint_plan_may_heed_sight(const glint_settings *settings)
{
    return settings->depth == 0 && settings->output == GLINT_OUTPUT_COLOR &&
           settings->shading == GLINT_SHADING_PIXEL;
}

// True if the plan shades vertices.
static inline bool glint_plan_shades_vertices(const glint_plan *plan)
{
    return plan->shading != GLINT_SHADING_PIXEL;
}

// True if kernels of the plan, or of a variation of it, read coarser levels of the environment.
static inline bool glint_plan_reads_levels(const glint_plan *plan)
{
    return plan->features[GLINT_FEATURE_MIP_LEVELS].compiled || plan->has_facets;
}

// Bytes of a number in the plan's precision.
static inline size_t glint_plan_scalar_bytes(const glint_plan *plan)
{
    return plan->precision == GLINT_PRECISION_DOUBLE ? sizeof(double) : sizeof(float);
}

// The number of compiled features.
int glint_plan_feature_count(const glint_plan *plan);

#define GLINT_BUILD_OPTIONS_BYTES 4096

// Writes the build options of the plan's special kernels, which contain what the plan compiles
// ("-DGLINT_WIDTH=16 …"). general.h has the options of general kernels.
void glint_plan_build_options(const glint_plan *plan, char text[GLINT_BUILD_OPTIONS_BYTES]);

// What kernels are compiled with, apart from the parts of a plan that never differ between special
// and general kernels: width, precision, tiles.
typedef struct glint_variant {
    bool is_general;
    bool features[GLINT_FEATURE_COUNT];
    bool half_texels;
    int stack_capacity, traversal_stack;
} glint_variant;

// Writes the build options of a variant.
void glint_plan_write_options(const glint_plan *plan, const glint_variant *variant,
                              char text[GLINT_BUILD_OPTIONS_BYTES]);

// Describes the plan in one line: "shading pixel, depth auto (at most 64), precision float, half
// texels, width 16, 12 of 18 features".
void glint_plan_describe(const glint_plan *plan, char *text, size_t capacity);

#endif
