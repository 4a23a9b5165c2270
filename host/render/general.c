// Chooses general kernels. See general.h.
#include "render/general.h"

#include "render/plan_device.h"

const char *glint_kernel_kind_name(glint_kernel_kind kind)
{
    static const char *const names[] = {[GLINT_KERNEL_SPECIAL] = "special",
#define NAME(name, text) [GLINT_KERNEL_##name] = "general (" text ")",
                                        GLINT_GENERAL_KERNELS(NAME)
#undef NAME
    };
    return names[kind];
}

// The smallest general kernel that has the feature; GLINT_KERNEL_SPECIAL: none has.
static glint_kernel_kind least_kernel_with(glint_feature feature)
{
    enum { MIRRORS = GLINT_KERNEL_MIRRORS, PATHS = GLINT_KERNEL_PATHS };
    enum { EVERYTHING = GLINT_KERNEL_EVERYTHING, NONE = GLINT_KERNEL_SPECIAL };
    static const int least[] = {
#define LEAST(name, meaning, needs, excludes, unneeded, general) general,
        GLINT_FEATURES(LEAST)
#undef LEAST
    };
    return (glint_kernel_kind)least[feature];
}

// Without tiles a general kernel also renders lists of pixels, which exclude tiles.
static glint_variant general_variant(const glint_plan *plan, glint_kernel_kind kind)
{
    glint_variant variant = {.is_general = true,
                             .stack_capacity = kind == GLINT_KERNEL_MIRRORS ? 0 : GLINT_STACK_LEAST,
                             .traversal_stack = GLINT_TRAVERSAL_STACK_LEAST};
    for (int i = 0; i < GLINT_FEATURE_COUNT; i++) {
        const glint_kernel_kind least = least_kernel_with((glint_feature)i);
        variant.features[i] = least != GLINT_KERNEL_SPECIAL && least <= kind;
    }
    variant.features[GLINT_FEATURE_PIXEL_LIST] &= !plan->tiles;
    return variant;
}

static bool takes_one_lookup(const glint_plan *plan)
{
#define IS_COMPILED(name) plan->features[GLINT_FEATURE_##name].compiled
    return GLINT_TAKES_ONE_LOOKUP(IS_COMPILED);
#undef IS_COMPILED
}

// True if the plan's sizes fit the general kernel's.
static bool has_room(const glint_plan *plan, glint_kernel_kind kind)
{
    const glint_variant variant = general_variant(plan, kind);
    return plan->stack_capacity <= variant.stack_capacity &&
           plan->traversal_stack <= variant.traversal_stack;
}

glint_kernel_kind glint_general_kernel_of(const glint_plan *plan)
{
    const bool is_fast = takes_one_lookup(plan);
    glint_kernel_kind kind = is_fast ? GLINT_KERNEL_MIRRORS : GLINT_KERNEL_PATHS;
    for (int i = 0; i < GLINT_FEATURE_COUNT; i++) {
        const glint_kernel_kind least = least_kernel_with((glint_feature)i);
        if (!plan->features[i].compiled || (least != GLINT_KERNEL_SPECIAL && least <= kind)) {
            continue;
        }
        if (is_fast || least == GLINT_KERNEL_SPECIAL) {
            return GLINT_KERNEL_SPECIAL;
        }
        kind = least;
    }
    return has_room(plan, kind) ? kind : GLINT_KERNEL_SPECIAL;
}

bool glint_kernel_has(const glint_plan *plan, glint_kernel_kind kind, glint_feature feature)
{
    return kind == GLINT_KERNEL_SPECIAL ? plan->features[feature].compiled
                                        : general_variant(plan, kind).features[feature];
}

void glint_kernel_options(const glint_plan *plan, glint_kernel_kind kind,
                          char text[GLINT_BUILD_OPTIONS_BYTES])
{
    if (kind == GLINT_KERNEL_SPECIAL) {
        glint_plan_build_options(plan, text);
        return;
    }
    const glint_variant variant = general_variant(plan, kind);
    glint_plan_write_options(plan, &variant, text);
}
