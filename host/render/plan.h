// The plan: what is compiled for one scene on one device, and why. Pure: it calls no OpenCL.
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
#include "scene/sight.h"
#include "scene/solids.h"
#include "scene/topology.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum glint_feature {
#define GLINT_FEATURE_NAME(name, ...) GLINT_FEATURE_##name,
    GLINT_FEATURES(GLINT_FEATURE_NAME)
#undef GLINT_FEATURE_NAME
        GLINT_FEATURE_COUNT
} glint_feature;

// How a feature was decided.
typedef struct glint_feature_choice {
    bool compiled;
    char reason[120]; // "3 of 8 materials are metal", "no material has a volume"
} glint_feature_choice;

#define GLINT_PLAN_BOXES 16

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
    char guesses[GLINT_CONTACT_TEXT]; // which solids touch or overlap without a word about which is
                                      // there
    int box_count; // where solids are, in stored coordinates; the last one holds all others
    float boxes[GLINT_PLAN_BOXES][2][3];
    int media_count;     // distinct media (index of refraction and absorption), without empty space
    int media_bits;      // bits of one entry of the stack of media
    int media_capacity;  // entries of that stack
    int traversal_stack; // entries of the traversal's stack; set once the tree is built
    size_t environment_bytes; // device memory for the environment
    bool has_facets;          // rough glass is to be seen, but for terms
    bool is_brushed;          // likewise, of lobes
    bool has_sheen;           // likewise, above metal or paint
    bool is_translucent;      // paint is lit from behind, likewise
    bool disperses;           // so are solids that disperse light
    int cells_last;           // the finest level of cells that rough surfaces need; −1: none do
    uint32_t build_tag;       // the settings'
} glint_plan;

// Names of a feature and what it adds, from kernels/features.h.
const char *glint_feature_name(glint_feature feature);
const char *glint_feature_meaning(glint_feature feature);

// Everything the decision rests on. Pointers are borrowed. The topology is read only where some
// material bounds a solid; it may be empty where none does.
typedef struct glint_plan_inputs {
    const glint_scene *scene;
    const glint_topology *topology;
    const glint_solids *solids; // found of it; NULL: no solid touches another
    const glint_sight *sight;   // NULL: nothing is known of what paths can meet
    const glint_cube *environment;
    const glint_capabilities *device;
    const glint_settings *settings;
    const glint_half_rounding *half; // what the environment loses as halfs; NULL: to be found
} glint_plan_inputs;

// Lanes of a packet on the device where nobody asks for others: 1, 8 or 16.
int glint_plan_native_width(const glint_capabilities *device, glint_precision precision);

// Errors: as glint_settings_check, and GLINT_USAGE for half texels of an environment that half
// cannot hold.
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

// Whether kernels of the plan, or of a variation of it, read coarser levels of the environment.
static inline bool glint_plan_reads_levels(const glint_plan *plan)
{
    return plan->features[GLINT_FEATURE_MIP_LEVELS].compiled || plan->has_facets;
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
