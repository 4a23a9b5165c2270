// What may be asked for. See settings.h, and plan.h for the checks.
#include "render/settings.h"

#include "render/plan.h"

#include <math.h>
#include <stdio.h>

#define HITS_TRIANGLES_MAX (1u << 24) // numbers that a float holds exactly

const glint_settings glint_settings_default = {
    .width = 1280,
    .height = 720,
    .samples_per_axis = 1,
    .min_weight = GLINT_DEFAULT_MIN_WEIGHT,
};

void glint_settings_pixels(const glint_settings *settings, int size[2])
{
    const int step = settings->grid_step > 0 ? settings->grid_step : 1;
    if (settings->list != NULL) {
        size[0] = GLINT_LIST_COLUMNS;
        size[1] = settings->list_rows;
        return;
    }
    size[0] = (settings->width - step / 2 + step - 1) / step;
    size[1] = (settings->height - step / 2 + step - 1) / step;
}

bool glint_settings_are_variation(const glint_settings *settings, const glint_settings *first)
{
    const glint_settings *a = settings, *b = first;
    return a->shading == GLINT_SHADING_PIXEL && b->shading == GLINT_SHADING_PIXEL &&
           (a->depth > 0 || b->depth == 0) && a->width == b->width && a->height == b->height &&
           a->samples_per_axis == b->samples_per_axis && a->transparent == b->transparent &&
           a->env_rotate == b->env_rotate && a->fresnel == b->fresnel &&
           a->output == GLINT_OUTPUT_COLOR && b->output == GLINT_OUTPUT_COLOR &&
           a->filter == b->filter && a->irradiance == b->irradiance && a->proxy == b->proxy &&
           a->kernel_width == b->kernel_width && a->tile_packets == b->tile_packets &&
           a->all_features == b->all_features && a->build_tag == b->build_tag;
}

const char *glint_shading_name(glint_shading shading)
{
    static const char *const names[] = {"pixel", "vertex-direction", "vertex-color"};
    return names[shading];
}

static glint_status check_numbers(const glint_settings *s, glint_error *error)
{
    if (s->width < 1 || s->height < 1) {
        return glint_fail(error, GLINT_USAGE, "--size: %dx%d has no pixels", s->width, s->height);
    }
    if (s->grid_step < 0 || s->grid_step > s->width || s->grid_step > s->height) {
        return glint_fail(error, GLINT_USAGE, "a grid's step is no larger than the image");
    }
    if (s->list != NULL &&
        (s->list_rows < 1 || s->grid_step > 0 || s->shading != GLINT_SHADING_PIXEL)) {
        return glint_fail(error, GLINT_USAGE, "a list has pixels, of no grid and no vertices");
    }
    if (s->samples_per_axis < 1 || s->samples_per_axis > GLINT_SAMPLES_PER_AXIS_MAX) {
        return glint_fail(error, GLINT_USAGE, "--samples: a square number from 1 to %d",
                          GLINT_SAMPLES_PER_AXIS_MAX * GLINT_SAMPLES_PER_AXIS_MAX);
    }
    if (s->depth < 0) {
        return glint_fail(error, GLINT_USAGE, "--depth: 1 or more, or auto");
    }
    if (s->aovs > GLINT_AOV_ALL) {
        return glint_fail(error, GLINT_USAGE, "--aov: only layers that there are");
    }
    if (s->terms < 0 || s->terms > GLINT_TERMS_MAX) {
        return glint_fail(error, GLINT_USAGE, "--directions: 1 to %d", GLINT_TERMS_MAX);
    }
    if (!(s->min_weight >= 0 && s->min_weight <= 1)) {
        return glint_fail(error, GLINT_USAGE, "--min-weight: 0 to 1");
    }
    if (!(s->mend >= 0 && isfinite(s->mend))) {
        return glint_fail(error, GLINT_USAGE, "--mend: 0 or more");
    }
    if (!isfinite(s->env_rotate)) {
        return glint_fail(error, GLINT_USAGE, "--env-rotate: a finite number of degrees");
    }
    if (s->kernel_width != 0 && s->kernel_width != 1 && s->kernel_width != 8 &&
        s->kernel_width != 16) {
        return glint_fail(error, GLINT_USAGE, "--kernel-width: 1, 8 or 16");
    }
    if (s->tile_packets != 0 && s->tile_packets != 1 && s->tile_packets != 16) {
        return glint_fail(error, GLINT_USAGE, "--kernel-tile: 1 or 16");
    }
    return GLINT_OK;
}

static glint_status check_hits(const glint_settings *s, size_t triangle_count, glint_error *error)
{
    if (s->samples_per_axis > 1 || triangle_count > HITS_TRIANGLES_MAX) {
        return glint_fail(error, GLINT_USAGE,
                          "hits can be had for one sample a pixel and %u triangles at most",
                          HITS_TRIANGLES_MAX);
    }
    if (s->aovs != 0 || s->terms > 0) {
        return glint_fail(error, GLINT_USAGE, "%s: hits have none (leave it out)",
                          s->aovs != 0 ? "--aov" : "--directions");
    }
    return GLINT_OK;
}

// At vertices there is no pixel, of which a part of the environment could be seen, and no path on
// which more could be met.
static glint_status check_vertex_shading(const glint_settings *s, glint_error *error)
{
    const char *name = glint_shading_name(s->shading);
    if (s->depth > 1) {
        return glint_fail(error, GLINT_USAGE,
                          "--shading %s: surfaces see the environment alone, which is depth 1 "
                          "(leave --depth %d out, or use --shading pixel)",
                          name, s->depth);
    }
    const char *other = s->filter == GLINT_FILTER_MIP ? "--filter mip"
                        : s->aovs != 0                ? "--aov"
                        : s->terms > 0                ? "--directions"
                                                      : NULL;
    return other == NULL
               ? GLINT_OK
               : glint_fail(error, GLINT_USAGE,
                            "%s: it tells of pixels, and --shading %s shades vertices (use "
                            "--shading pixel)",
                            other, name);
}

// Double precision is what single precision is mended with; elsewhere there are no pixels' colours.
static glint_status check_mend(const glint_plan_inputs *in, glint_error *error)
{
    const glint_settings *s = in->settings;
    if (!in->device->has_double) {
        return glint_fail(error, GLINT_DEVICE_FAILED,
                          "device '%s' has no double precision (leave --mend out)",
                          in->device->name);
    }
    const char *beside = s->precision == GLINT_PRECISION_DOUBLE ? "--precision double"
                         : s->shading != GLINT_SHADING_PIXEL    ? "shading at vertices"
                         : s->output != GLINT_OUTPUT_COLOR      ? "hits"
                                                                : NULL;
    return beside == NULL ? GLINT_OK
                          : glint_fail(error, GLINT_USAGE,
                                       "--mend: %s has nothing to mend (leave it out)", beside);
}

// A ray comes to a proxy at one point of it, and from a point.
static glint_status check_proxy(const glint_settings *s, glint_error *error)
{
    char shading[64];
    snprintf(shading, sizeof shading, "--shading %s", glint_shading_name(s->shading));
    const char *beside = s->filter == GLINT_FILTER_MIP       ? "--filter mip"
                         : s->terms > 0                      ? "--directions"
                         : s->shading != GLINT_SHADING_PIXEL ? shading
                                                             : NULL;
    return beside == NULL
               ? GLINT_OK
               : glint_fail(error, GLINT_USAGE,
                            "--proxy: where rays come to it is found for points of surfaces alone "
                            "(leave %s out)",
                            beside);
}

glint_status glint_plan_check_settings(const glint_plan_inputs *in, glint_error *error)
{
    const glint_settings *s = in->settings;
    glint_status status = check_numbers(s, error);
    if (status == GLINT_OK && s->output == GLINT_OUTPUT_HITS) {
        status = check_hits(s, in->scene->triangle_count, error);
    }
    if (status == GLINT_OK && s->terms > 0 && s->filter == GLINT_FILTER_MIP) {
        return glint_fail(error, GLINT_USAGE,
                          "--directions: what a pixel sees around a direction is not kept, which "
                          "--filter mip needs (use bilinear)");
    }
    if (status == GLINT_OK && s->shading != GLINT_SHADING_PIXEL) {
        status = check_vertex_shading(s, error);
    }
    if (status == GLINT_OK && s->proxy) {
        status = check_proxy(s, error);
    }
    if (status == GLINT_OK && s->mend > 0) {
        status = check_mend(in, error);
    }
    if (status == GLINT_OK && s->precision == GLINT_PRECISION_DOUBLE && !in->device->has_double) {
        return glint_fail(error, GLINT_DEVICE_FAILED,
                          "device '%s' has no double precision (use --precision float)",
                          in->device->name);
    }
    return status;
}
