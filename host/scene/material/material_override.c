// Parses, resolves and applies overrides of materials. See material_override.h.
#include "scene/material/material_override.h"

#include <ctype.h>
#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ---- The tables --------------------------------------------------------------------------------

#define OPAQUE GLINT_MATERIAL_CLEAR, .mirror = (-1)
#define SOLID(n)                                                                                   \
    .base_color = {1, 1, 1}, .transmission = 1, .thickness = 1, .ior = (n),                        \
    .attenuation_distance = INFINITY, .attenuation_color = {1, 1, 1}, GLINT_MATERIAL_SPECULAR,     \
    .mirror = (-1)

// Indices of refraction at 589 nm: diamond; water at 20 °C.
static const struct preset {
    const char *name;
    bool keeps_color; // keeps the file's base colour
    glint_material material;
} presets[] = {
    {"mirror", false, {OPAQUE, .base_color = {1, 1, 1}, .metallic = 1}},
    {"metal", true, {OPAQUE, .metallic = 1}},
    {"glass", false, {SOLID(1.5F)}},
    {"thin-glass", false, {OPAQUE, .base_color = {1, 1, 1}, .transmission = 1}},
    {"diamond", false, {SOLID(2.417F)}},
    {"water", false, {SOLID(1.333F)}},
    {"paint", true, {OPAQUE, .roughness = 1}},
    {"glossy-paint", true, {OPAQUE}},
    {"unlit", true, {OPAQUE, .unlit = true}},
};

static const struct value {
    const char *name;
    size_t offset; // offset in glint_material
    int count;     // count of numbers
    float low, high;
    const char *range; // the expected range, for messages
    const char *whose; // the materials that have the value, for messages
} values[GLINT_MATERIAL_VALUE_COUNT] = {
#define OF(member) offsetof(glint_material, member)
#define SHARE "from 0 to 1"
    {"color", OF(base_color), 3, 0, 1, "R,G,B from 0 to 1, linear", "every material has it"},
    {"metallic", OF(metallic), 1, 0, 1, "a number " SHARE, "metal, glass and paint have it"},
    {"roughness", OF(roughness), 1, 0, 1, "a number " SHARE, "metal, glass and paint have it"},
    {"emission", OF(emission), 3, 0, FLT_MAX, "R,G,B of 0 or more", "unlit materials have none"},
    {"transmission", OF(transmission), 1, 0, 1, "a number " SHARE, "glass and paint have it"},
    {"ior", OF(ior), 1, 1, FLT_MAX, "an index of refraction of 1 or more",
     "glass and glossy paint have it"},
    {"thickness", OF(thickness), 1, 0, FLT_MAX, "0, for a thin wall, or more", "glass has it"},
    {"attenuation-color", OF(attenuation_color), 3, 0, 1, "R,G,B from 0 to 1, linear",
     "solid glass has it, with an attenuation-distance"},
    {"attenuation-distance", OF(attenuation_distance), 1, FLT_MIN, FLT_MAX, "metres, more than 0",
     "solid glass has it, with an attenuation-color other than white"},
    {"dispersion", OF(dispersion), 1, 0, FLT_MAX, "20 over Abbe's number, 0 or more",
     "solid glass has it"},
#undef OF
};

enum { PRESET_COUNT = sizeof presets / sizeof *presets };

// True if another value would change the look of the material.
static bool depends_on(const glint_material *material, const struct value *value)
{
    const glint_lobes lobes = glint_material_lobes(material);
    const bool shares = lobes.metal || lobes.glass || lobes.paint;
    switch (value->offset) {
    case offsetof(glint_material, metallic):
    case offsetof(glint_material, roughness):
        return shares;
    case offsetof(glint_material, emission):
        return !lobes.unlit;
    case offsetof(glint_material, transmission):
        return lobes.glass || lobes.paint;
    case offsetof(glint_material, ior):
        return lobes.glass || lobes.gloss;
    case offsetof(glint_material, thickness):
        return lobes.glass;
    case offsetof(glint_material, attenuation_color):
    case offsetof(glint_material, attenuation_distance):
        return lobes.absorption;
    case offsetof(glint_material, dispersion):
        return lobes.solid;
    default:
        return true;
    }
}

// ---- Parsing -----------------------------------------------------------------------------------

static glint_status fail_unknown_word(const char *option, const char *text, const char *word,
                                      glint_error *error)
{
    const char *words[PRESET_COUNT + GLINT_MATERIAL_VALUE_COUNT + 1] = {NULL};
    for (int i = 0; i < PRESET_COUNT; i++) {
        words[i] = presets[i].name;
    }
    for (int i = 0; i < GLINT_MATERIAL_VALUE_COUNT; i++) {
        words[PRESET_COUNT + i] = values[i].name;
    }
    const char *nearest = glint_nearest_word(word, words);
    return nearest != NULL
               ? glint_fail(error, GLINT_USAGE, "--%s %s: there is no '%s' (did you mean %s?)",
                            option, text, word, nearest)
               : glint_fail(error, GLINT_USAGE,
                            "--%s %s: there is no '%s' (there are " GLINT_MATERIAL_PRESETS
                            "; and values: " GLINT_MATERIAL_VALUES ")",
                            option, text, word);
}

static glint_status take_preset(const char *option, const char *word, bool is_first,
                                glint_material_override *made, glint_error *error)
{
    for (int i = 0; i < PRESET_COUNT; i++) {
        if (strcmp(word, presets[i].name) != 0) {
            continue;
        }
        if (!is_first) {
            return glint_fail(error, GLINT_USAGE,
                              made->preset > 0 ? "--%s %s: '%s' is a second preset (give one)"
                                               : "--%s %s: '%s' replaces the values before it (put "
                                                 "it first)",
                              option, made->text, word);
        }
        made->preset = 1 + i;
        return GLINT_OK;
    }
    for (int i = 0; i < GLINT_MATERIAL_VALUE_COUNT; i++) {
        if (strcmp(word, values[i].name) == 0) {
            return glint_fail(error, GLINT_USAGE, "--%s %s: %s is expected as in %s=…", option,
                              made->text, values[i].range, word);
        }
    }
    return fail_unknown_word(option, made->text, word, error);
}

static bool read_numbers(const char *text, const struct value *value, float *result)
{
    double numbers[3];
    bool is_good = glint_parse_reals(text, numbers, value->count);
    for (int i = 0; is_good && i < value->count; i++) {
        is_good = numbers[i] <= (double)value->high; // a larger number would become infinite
        result[i] = is_good ? (float)numbers[i] : 0;
        is_good = is_good && result[i] >= value->low;
    }
    return is_good;
}

static glint_status take_value(const char *option, const char *name, const char *text,
                               glint_material_override *made, glint_error *error)
{
    for (int i = 0; i < GLINT_MATERIAL_VALUE_COUNT; i++) {
        if (strcmp(name, values[i].name) != 0) {
            continue;
        }
        if ((made->given & 1u << i) != 0) {
            return glint_fail(error, GLINT_USAGE, "--%s %s: %s is given twice (give one)", option,
                              made->text, name);
        }
        made->given |= 1u << i;
        return read_numbers(text, &values[i], made->values[i])
                   ? GLINT_OK
                   : glint_fail(error, GLINT_USAGE, "--%s %s: %s: %s is expected", option,
                                made->text, name, values[i].range);
    }
    return fail_unknown_word(option, made->text, name, error);
}

// Returns the end of the word or value at the beginning of `text`. Commas between a value's numbers
// belong to it.
static const char *end_of_item(const char *text)
{
    const char *end = text + strcspn(text, ",");
    while (*end == ',' && strchr(text, '=') != NULL && strchr(text, '=') < end &&
           (end[1] == '\0' || strchr("0123456789+-.", end[1]) != NULL)) {
        end += 1 + strcspn(end + 1, ",");
    }
    return end;
}

static glint_status take_items(const char *option, glint_material_override *made,
                               glint_error *error)
{
    const char *begin = made->text + made->name_length + 1;
    for (const char *at = begin; at != NULL;) {
        char item[128];
        const char *end = end_of_item(at);
        if (end - at >= (ptrdiff_t)sizeof item) {
            return glint_fail(error, GLINT_USAGE, "--%s %.60s: one of its values is too long",
                              option, made->text);
        }
        snprintf(item, sizeof item, "%.*s", (int)(end - at), at);
        char *equals = strchr(item, '=');
        if (equals == NULL) {
            TRY(take_preset(option, item, at == begin, made, error));
        } else {
            *equals = '\0';
            TRY(take_value(option, item, equals + 1, made, error));
        }
        at = *end == ',' ? end + 1 : NULL;
    }
    return GLINT_OK;
}

glint_status glint_material_override_parse(const glint_option *option, const char *text,
                                           void *destination, glint_error *error)
{
    glint_material_overrides *overrides = destination;
    const size_t name_length = strcspn(text, "=");
    if (name_length == 0 || text[name_length] == '\0' || text[name_length + 1] == '\0') {
        return glint_fail(error, GLINT_USAGE,
                          "--%s %s: a material and what it becomes are expected, as in "
                          "Gem=glass,ior=2.42",
                          option->name, text);
    }
    if (overrides->count == GLINT_MATERIAL_OVERRIDES_MAX) {
        return glint_fail(error, GLINT_USAGE, "--%s: it may be given %d times at most",
                          option->name, GLINT_MATERIAL_OVERRIDES_MAX);
    }
    glint_material_override *made = &overrides->list[overrides->count];
    *made = (glint_material_override){.text = text, .name_length = name_length, .index = -1};
    TRY(take_items(option->name, made, error));
    overrides->count++;
    return GLINT_OK;
}

// ---- What is named -----------------------------------------------------------------------------

static bool is_all(const glint_material_override *one)
{
    return one->name_length == 1 && one->text[0] == '*';
}

static bool has_name(const glint_material_override *one, const char *name)
{
    return name != NULL && strlen(name) == one->name_length &&
           strncmp(name, one->text, one->name_length) == 0;
}

static bool is_named(const glint_material_override *one, const glint_material *material)
{
    return is_all(one) ||
           (one->index >= 0 ? one->index == material->index : has_name(one, material->name));
}

static const char *nearest_name(const char *wanted, const glint_material *materials, size_t count)
{
    const char *nearest = NULL;
    size_t best = GLINT_WORD_IS_FAR;
    for (size_t i = 0; i < count; i++) {
        const size_t distance = materials[i].name != NULL
                                    ? glint_word_distance(wanted, materials[i].name)
                                    : GLINT_WORD_IS_FAR;
        if (distance < best) {
            best = distance;
            nearest = materials[i].name;
        }
    }
    return nearest;
}

static glint_status fail_unnamed(const glint_material_override *one,
                                 const glint_material *materials, size_t count, glint_error *error)
{
    char name[64], list[600] = "";
    snprintf(name, sizeof name, "%.*s", (int)one->name_length, one->text);
    const char *nearest = nearest_name(name, materials, count);
    for (size_t i = 0; i < count; i++) {
        glint_list_add(list, sizeof list, materials[i].index, materials[i].name);
    }
    return nearest != NULL
               ? glint_fail(error, GLINT_BAD_INPUT,
                            "there is no material \"%s\" (did you mean \"%s\"?)", name, nearest)
           : count > 0 ? glint_fail(error, GLINT_BAD_INPUT,
                                    "there is no material \"%s\" (there is %s)", name, list)
                       : glint_fail(error, GLINT_BAD_INPUT,
                                    "there is no material \"%s\" (the file has none)", name);
}

// Returns the index if NAME is an index, else −1. strtol would also accept a sign and spaces.
static int index_of(const glint_material_override *one)
{
    char *end;
    const long index = strtol(one->text, &end, 10);
    const bool is_index = isdigit((unsigned char)one->text[0]) &&
                          end == one->text + one->name_length && index < INT_MAX;
    return is_index ? (int)index : -1;
}

static glint_status find_named(glint_material_override *one, const glint_material *materials,
                               size_t count, glint_error *error)
{
    one->index = -1;
    for (int pass = 0; pass < 2; pass++) {
        for (size_t i = 0; i < count; i++) {
            if (is_named(one, &materials[i])) {
                return GLINT_OK;
            }
        }
        one->index = index_of(one);
    }
    return fail_unnamed(one, materials, count, error);
}

// ---- Applying ----------------------------------------------------------------------------------

static void replace_material(glint_material *material, const struct preset *preset)
{
    glint_material made = preset->material;
    made.name = material->name;
    made.index = material->index;
    if (preset->keeps_color) {
        memcpy(made.base_color, material->base_color, sizeof made.base_color);
        made.has_vertex_colors = material->has_vertex_colors;
        made.textures[GLINT_TEXTURE_BASE_COLOR] = material->textures[GLINT_TEXTURE_BASE_COLOR];
    }
    *material = made;
}

static void set_value(glint_material *material, const struct value *value, const float *numbers)
{
    memcpy((char *)material + value->offset, numbers, (size_t)value->count * sizeof *numbers);
}

// Returns the set of values that the material depends on.
static unsigned values_of(const glint_material *material)
{
    unsigned set = 0;
    for (int i = 0; i < GLINT_MATERIAL_VALUE_COUNT; i++) {
        set |= depends_on(material, &values[i]) ? 1u << i : 0;
    }
    return set;
}

// Applies an override. Adds the values that the material depended on before to `heeded`.
static void apply(const glint_material_override *one, glint_material *material, unsigned *heeded)
{
    if (one->preset > 0) {
        replace_material(material, &presets[one->preset - 1]);
    }
    *heeded |= values_of(material);
    for (int i = 0; i < GLINT_MATERIAL_VALUE_COUNT; i++) {
        if ((one->given & 1u << i) != 0) {
            set_value(material, &values[i], one->values[i]);
        }
    }
}

bool glint_material_overrides_apply(const glint_material_overrides *overrides,
                                    glint_material *material)
{
    bool is_replaced = false;
    for (size_t i = 0; i < overrides->count; i++) {
        const glint_material_override *one = &overrides->list[i];
        unsigned heeded = 0;
        if (is_named(one, material)) {
            apply(one, material, &heeded);
            is_replaced = is_replaced || one->preset > 0;
        }
    }
    return is_replaced;
}

static glint_status check_heeded(const glint_material_override *one, unsigned heeded,
                                 glint_error *error)
{
    for (int i = 0; i < GLINT_MATERIAL_VALUE_COUNT; i++) {
        if ((one->given & ~heeded & 1u << i) != 0) {
            return glint_fail(error, GLINT_BAD_INPUT,
                              "--material %s: %s changes nothing there (%s)", one->text,
                              values[i].name, values[i].whose);
        }
    }
    return GLINT_OK;
}

glint_status glint_material_overrides_resolve(glint_material_overrides *overrides,
                                              const glint_material *materials, size_t count,
                                              glint_error *error)
{
    unsigned heeded[GLINT_MATERIAL_OVERRIDES_MAX] = {0};
    for (size_t k = 0; k < overrides->count; k++) {
        TRY(find_named(&overrides->list[k], materials, count, error));
    }
    for (size_t i = 0; i < count; i++) {
        glint_material material = materials[i];
        for (size_t k = 0; k < overrides->count; k++) {
            if (is_named(&overrides->list[k], &material)) {
                apply(&overrides->list[k], &material, &heeded[k]);
            }
        }
        for (size_t k = 0; k < overrides->count; k++) {
            heeded[k] |= is_named(&overrides->list[k], &material) ? values_of(&material) : 0;
        }
    }
    for (size_t k = 0; k < overrides->count; k++) {
        TRY(check_heeded(&overrides->list[k], heeded[k], error));
    }
    return GLINT_OK;
}

void glint_material_overrides_warn(const glint_material_overrides *overrides,
                                   const glint_material *materials, size_t count, const char *path,
                                   glint_warnings *warnings)
{
    for (size_t k = 0; k < overrides->count; k++) {
        const glint_material_override *one = &overrides->list[k];
        bool is_there = false;
        for (size_t i = 0; i < count && !is_there; i++) {
            is_there = is_named(one, &materials[i]);
        }
        if (!is_there) {
            glint_warn(warnings, "%s: --material %s: no triangle has this material", path,
                       one->text);
        }
    }
}
