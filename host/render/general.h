// Chooses general kernels. A general kernel contains many features and serves every scene that
// needs no others (kernels/features.h, column `general`). Its frames have the bits of the special
// kernel's. So a few kernels, compiled once, serve most scenes.
#ifndef GLINT_RENDER_GENERAL_H
#define GLINT_RENDER_GENERAL_H

#include "device/device.h"
#include "render/plan.h"

// The kinds of kernels: special ones, and the general ones of kernels/features.h by size.
typedef enum glint_kernel_kind {
    GLINT_KERNEL_SPECIAL,
#define GLINT_KERNEL_NAME(name, text) GLINT_KERNEL_##name,
    GLINT_GENERAL_KERNELS(GLINT_KERNEL_NAME)
#undef GLINT_KERNEL_NAME
        GLINT_KERNEL_KINDS
} glint_kernel_kind;

// "special", "general (paths)".
const char *glint_kernel_kind_name(glint_kernel_kind kind);

// The smallest general kernel that serves the plan; GLINT_KERNEL_SPECIAL: none does. The plan alone
// decides, so the bits of a frame do not depend on what has been compiled: the fast path of mirrors
// rounds differently, and has a general kernel of its own.
glint_kernel_kind glint_general_kernel_of(const glint_plan *plan);

// True if the plan's kernel of a kind contains the feature.
bool glint_kernel_has(const glint_plan *plan, glint_kernel_kind kind, glint_feature feature);

// Writes the build options of the plan's kernel of a kind. General kernels depend on few properties
// of a plan: precision, width, tiles.
void glint_kernel_options(const glint_plan *plan, glint_kernel_kind kind,
                          char text[GLINT_BUILD_OPTIONS_BYTES]);

// What compiling a kernel came to.
typedef struct glint_compile_report {
    bool was_cached;  // the driver's cache held it before
    bool is_needless; // nothing was compiled: a kernel for lists, where no kernel has tiles
    double ms;
} glint_compile_report;

// Which general kernel to compile.
typedef struct glint_general_request {
    glint_kernel_kind kind;
    glint_precision precision;
    bool for_lists; // without tiles: it renders lists of pixels, as --max-error and --mend need
} glint_general_request;

// Compiles a general kernel for the device, with the packets that it renders with, so that the
// driver's cache holds it. Errors: as glint_program_build; GLINT_DEVICE_LACKS if the device lacks
// the precision; GLINT_OUTPUT_FAILED if the driver's cache cannot hold it (device/compiled.h).
glint_status glint_general_compile(glint_device *device, const glint_general_request *request,
                                   glint_compile_report *report, glint_error *error);

// Compiles special kernels with these build options (glint_plan_build_options) in the same way.
// Errors: GLINT_USAGE for options without a packet's width; as glint_general_compile.
glint_status glint_special_compile(glint_device *device, const char *options,
                                   glint_compile_report *report, glint_error *error);

#endif
