// What the command line makes of a scene's materials: --material NAME=glass,ior=2.42.
//
// NAME is a material's name in the file, or else its index there, or * for all of them. Behind the
// first "=" stand values, with commas between, and before them at most one preset, which replaces
// the material whole. Values alone change the file's material. Several overrides are applied in the
// order of the command line.
#ifndef GLINT_SCENE_MATERIAL_OVERRIDE_H
#define GLINT_SCENE_MATERIAL_OVERRIDE_H

#include "base/option.h"
#include "base/status.h"
#include "scene/material.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// For help texts: every preset and every value there is.
#define GLINT_MATERIAL_PRESETS                                                                     \
    "mirror, metal, glass, thin-glass, diamond, water, paint, glossy-paint, unlit"
#define GLINT_MATERIAL_VALUES                                                                      \
    "color, metallic, roughness, emission, transmission, ior, thickness, attenuation-color, "      \
    "attenuation-distance, dispersion"

enum { GLINT_MATERIAL_VALUE_COUNT = 10, GLINT_MATERIAL_OVERRIDES_MAX = 64 };

typedef struct glint_material_override {
    const char *text;   // as it was given; borrowed
    size_t name_length; // the part of it that is NAME
    int preset;         // 1 + its place in the table of presets; 0: none
    unsigned given;     // the set of values, by their places in the table of values
    float values[GLINT_MATERIAL_VALUE_COUNT][3];
    int index; // of the material, where NAME is that and no name; −1 else
} glint_material_override;

// Zero is valid: none.
typedef struct glint_material_overrides {
    glint_material_override list[GLINT_MATERIAL_OVERRIDES_MAX];
    size_t count;
} glint_material_overrides;

// Appends an override to a glint_material_overrides.
glint_option_parser glint_material_override_parse;

// Finds what each override's NAME means among a file's materials. Errors: GLINT_BAD_INPUT, without
// the file's name, where it means nothing, or where a value changes nothing in any material that
// the override names.
glint_status glint_material_overrides_resolve(glint_material_overrides *overrides,
                                              const glint_material *materials, size_t count,
                                              glint_error *error);

// Applies what was resolved to one material. True if a preset has replaced it whole.
bool glint_material_overrides_apply(const glint_material_overrides *overrides,
                                    glint_material *material);

// Warns of overrides that none of these materials heeds. `path` names the file.
void glint_material_overrides_warn(const glint_material_overrides *overrides,
                                   const glint_material *materials, size_t count, const char *path,
                                   glint_warnings *warnings);

#ifdef __cplusplus
}
#endif

#endif
