// Runs the cases. See selftest.h.
#include "selftest/selftest.h"

#include "base/clock.h"
#include "render/plan_device.h"
#include "selftest/trial.h"

#include <stdio.h>
#include <string.h>

static const trial_case *const groups[] = {
    hit_cases,         scale_cases, spawn_cases,   normal_cases,   refraction_cases, solid_cases,
    environment_cases, path_cases,  surface_cases, rough_cases,    rim_cases,        media_cases,
    light_cases,       image_cases, place_cases,   material_cases, output_cases,     chance_cases};

// The cases of a quick run. Together they cover most of the kernels.
static const char *const quick[] = {
    "rays_at_shared_edges",
    "primary_rays_at_edges",
    "directions_with_zeros",
    "slivers",
    "edge_on_triangles",
    "far_from_origin",
    "grazing_rays",
    "leaning_normals",
    "odd_normals",
    "critical_angle",
    "fresnel_at_its_ends",
    "metal_at_its_ends",
    "ball_in_ball",
    "cube_ties",
    "cube_seams",
    "latlong_poles",
    "dressed_room",
    "lit_room",
    "rough_balls",
    "solids_together",
    "odd_sizes",
    "large_numbers",
    "beads_on_floors",
    "plain_materials",
    "coats_and_settings",
    "shaded_vertices",
    "near_environment",
    "layers",
    "terms",
    "listed_pixels",
    "spot_edges",
};

static const trial_case *case_at(size_t index)
{
    for (size_t g = 0; g < sizeof groups / sizeof *groups; g++) {
        for (const trial_case *c = groups[g]; c->name != NULL; c++) {
            if (index-- == 0) {
                return c;
            }
        }
    }
    return NULL;
}

const char *glint_selftest_name(size_t index)
{
    const trial_case *c = case_at(index);
    return c != NULL ? c->name : NULL;
}

const char *glint_selftest_summary(size_t index)
{
    const trial_case *c = case_at(index);
    return c != NULL ? c->summary : NULL;
}

bool glint_selftest_is_quick(size_t index)
{
    const char *name = glint_selftest_name(index);
    bool is_quick = false;
    for (size_t i = 0; name != NULL && i < sizeof quick / sizeof *quick; i++) {
        is_quick = is_quick || strcmp(quick[i], name) == 0;
    }
    return is_quick;
}

bool glint_measure_holds(const glint_measure *measure)
{
    return measure->judged > 0 && measure->measured <= measure->bound;
}

const glint_measure *glint_selftest_worst(const glint_selftest_result *result)
{
    const glint_measure *worst = NULL;
    double most = 0;
    for (int i = 0; i < result->measure_count; i++) {
        const glint_measure *m = &result->measures[i];
        // NaN, and anything over a bound of 0, is the worst.
        const double excess = m->measured / m->bound;
        if (!glint_measure_holds(m) && (worst == NULL || !(excess <= most))) {
            worst = m;
            most = excess;
        }
    }
    return worst;
}

const char *glint_verdict_name(glint_verdict verdict)
{
    static const char *const names[] = {"passed", "failed", "skipped", "broken"};
    return names[verdict];
}

// Makes a seed for each case, so that its numbers do not depend on the cases before.
static uint64_t seed_of(const char *name, uint32_t seed)
{
    uint64_t hash = 14695981039346656037u ^ (uint64_t)seed * 1099511628211u; // FNV-1a
    for (; *name != '\0'; name++) {
        hash = (hash ^ (uint64_t)(unsigned char)*name) * 1099511628211u;
    }
    return hash;
}

// Turns counts into shares if a measure is a share, and judges.
static glint_verdict conclude(glint_selftest_result *result)
{
    glint_verdict verdict = result->measure_count > 0 ? GLINT_PASSED : GLINT_FAILED;
    for (int i = 0; i < result->measure_count; i++) {
        glint_measure *m = &result->measures[i];
        if (m->is_share && m->judged > 0) {
            m->measured /= (double)m->judged;
        }
        verdict = glint_measure_holds(m) ? verdict : GLINT_FAILED;
    }
    return verdict;
}

glint_status glint_selftest_run(size_t index, const glint_selftest_options *options,
                                glint_selftest_result *result, glint_error *error)
{
    const trial_case *c = case_at(index);
    const bool is_double = options->precision == GLINT_PRECISION_DOUBLE;
    const glint_capabilities *device = glint_device_capabilities(options->device);
    const int native = glint_plan_native_width(device, options->precision);
    *result = (glint_selftest_result){.name = c->name,
                                      .width = options->width > 0 ? options->width : native,
                                      .precision = options->precision};
    if (is_double && !device->has_double) {
        result->verdict = GLINT_SKIPPED;
        snprintf(result->reason, sizeof result->reason, "the device has no double precision");
        return GLINT_OK;
    }
    glint_selftest_options complete = *options;
    complete.rays = options->rays > 0 ? options->rays : GLINT_SELFTEST_RAYS;
    trial t = {.options = &complete,
               .u = is_double ? 0x1p-53 : 0x1p-24,
               .random = {seed_of(c->name, options->seed)},
               .result = result,
               .error = error};
    double clock = glint_now_ms();
    glint_status status = c->run(&t);
    result->ms = glint_lap_ms(&clock);
    result->verdict = conclude(result);
    if (glint_status_is_of_machine(status)) {
        result->verdict = GLINT_BROKEN;
        snprintf(result->reason, sizeof result->reason, "%s", error->message);
        status = GLINT_OK;
    }
    return status;
}
