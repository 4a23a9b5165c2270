// Checks settings and derives values from them. See settings.h.
#include "render/settings.h"

#include "render/settings_table.h"

#define HITS_TRIANGLES_MAX (1u << 24) // numbers that a float holds exactly

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
    for (size_t i = 0; i < glint_setting_count; i++) {
        const glint_setting *setting = &glint_setting_table[i];
        if ((setting->roles & GLINT_SETTING_VARIES) == 0 &&
            glint_setting_differs(setting, settings, first)) {
            return false;
        }
    }
    const bool is_smooth = settings->roughness == GLINT_ROUGHNESS_SMOOTH;
    return is_smooth == (first->roughness == GLINT_ROUGHNESS_SMOOTH) &&
           first->shading == GLINT_SHADING_PIXEL && first->output == GLINT_OUTPUT_COLOR &&
           (settings->depth > 0 || first->depth == 0);
}

bool glint_settings_heed_roughness(const glint_settings *settings)
{
    return settings->roughness != GLINT_ROUGHNESS_SMOOTH &&
           settings->output == GLINT_OUTPUT_COLOR && settings->shading == GLINT_SHADING_PIXEL &&
           !settings->proxy;
}

bool glint_settings_heed_dispersion(const glint_settings *settings)
{
    return settings->wavelengths > 1 && settings->output == GLINT_OUTPUT_COLOR &&
           settings->shading == GLINT_SHADING_PIXEL && settings->terms == 0;
}

int glint_settings_rounds(const glint_settings *settings)
{
    const int samples = settings->samples_per_axis * settings->samples_per_axis;
    return (settings->facets + samples - 1) / samples;
}

int glint_settings_directions(const glint_settings *settings)
{
    return glint_settings_rounds(settings) * settings->samples_per_axis *
           settings->samples_per_axis;
}

double glint_lobe_tolerance(glint_roughness roughness)
{
    return roughness == GLINT_ROUGHNESS_EXACT ? 0.001 : 0.4;
}

// ---- Checks ------------------------------------------------------------------------------------

static bool is_usual(const glint_setting *setting, const glint_settings *settings)
{
    return !glint_setting_differs(setting, settings, &glint_settings_default);
}

// A value is in range if the option accepts its printed form. So the command line and the library
// have the same rule.
static glint_status check_values(const glint_settings *settings, glint_error *error)
{
    for (size_t i = 0; i < glint_setting_count; i++) {
        const glint_setting *setting = &glint_setting_table[i];
        if (setting->group == GLINT_SETTINGS_INTERNAL || is_usual(setting, settings)) {
            continue;
        }
        char text[GLINT_SETTING_TEXT];
        glint_settings read = *settings;
        glint_setting_print(setting, settings, text);
        TRY(glint_option_parse(&setting->option, text,
                               (char *)&read + glint_setting_destination(setting), error));
    }
    return GLINT_OK;
}

static glint_status check_exclusions(const glint_settings *settings, glint_error *error)
{
    for (size_t i = 0; i < glint_exclusion_count; i++) {
        const glint_exclusion *exclusion = &glint_exclusion_table[i];
        const glint_setting *one = glint_setting_at(exclusion->one);
        const glint_setting *other = glint_setting_at(exclusion->other);
        if (is_usual(one, settings) || is_usual(other, settings)) {
            continue;
        }
        char names[2][GLINT_SETTING_TEXT];
        glint_setting_print_name(one, settings, names[0]);
        glint_setting_print_name(other, settings, names[1]);
        return glint_fail(error, GLINT_USAGE, "%s: %s %s (leave one of the two out)", names[0],
                          names[1], exclusion->why);
    }
    return GLINT_OK;
}

static glint_status check_part(const glint_settings *s, glint_error *error)
{
    if (s->grid_step < 0 || s->grid_step > s->width || s->grid_step > s->height) {
        return glint_fail(error, GLINT_USAGE, "a grid's step is no larger than the image");
    }
    if (s->list != NULL &&
        (s->list_rows < 1 || s->grid_step > 0 || s->shading != GLINT_SHADING_PIXEL)) {
        return glint_fail(error, GLINT_USAGE, "a list has pixels, of no grid and no vertices");
    }
    return GLINT_OK;
}

glint_status glint_settings_check(const glint_settings *s, const glint_capabilities *device,
                                  const glint_scene *scene, glint_error *error)
{
    TRY(check_values(s, error));
    TRY(check_part(s, error));
    if (s->shading != GLINT_SHADING_PIXEL && s->depth > 1) {
        return glint_fail(error, GLINT_USAGE,
                          "--shading %s: surfaces see the environment alone, which is depth 1 "
                          "(leave --depth %d out, or use --shading pixel)",
                          glint_shading_name(s->shading), s->depth);
    }
    TRY(check_exclusions(s, error));
    if (s->output == GLINT_OUTPUT_HITS && scene->triangle_count > HITS_TRIANGLES_MAX) {
        return glint_fail(error, GLINT_USAGE, "hits can be had of %u triangles at most",
                          HITS_TRIANGLES_MAX);
    }
    const bool is_double = s->precision == GLINT_PRECISION_DOUBLE;
    if ((is_double || s->mend > 0) && !device->has_double) {
        return glint_fail(error, GLINT_DEVICE_LACKS, "device '%s' has no double precision (%s)",
                          device->name, is_double ? "use --precision float" : "leave --mend out");
    }
    return GLINT_OK;
}
