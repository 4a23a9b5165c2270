// Overrides a scene's materials from the command line: --material NAME=glass,ior=2.42.
//
// NAME is a material's name in the file, or else its index there, or * for all materials. Values
// follow the first "=", with commas between them. At most one preset may stand before the values;
// it replaces the whole material. Values alone change the file's material. Several overrides apply
// in the order of the command line.
#ifndef GLINT_SCENE_MATERIAL_MATERIAL_OVERRIDE_H
#define GLINT_SCENE_MATERIAL_MATERIAL_OVERRIDE_H

#include "base/option.h"
#include "base/status.h"
#include "scene/material/material.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// For help texts: all presets and all values.
#define GLINT_MATERIAL_PRESETS                                                                     \
    "mirror, metal, glass, thin-glass, diamond, water, paint, glossy-paint, unlit"
#define GLINT_MATERIAL_VALUES                                                                      \
    "color, metallic, roughness, emission, transmission, ior, thickness, attenuation-color, "      \
    "attenuation-distance, dispersion"

enum { GLINT_MATERIAL_VALUE_COUNT = 10, GLINT_MATERIAL_OVERRIDES_MAX = 64 };

typedef struct glint_material_override {
    const char *text;   // the command line's text; borrowed
    size_t name_length; // length of NAME in the text
    int preset;         // 1 + the preset's place in the table of presets; 0: none
    unsigned given;     // the given values, a set of places in the table of values
    float values[GLINT_MATERIAL_VALUE_COUNT][3];
    int index; // index of the material if NAME is an index, else −1
} glint_material_override;

// Zero is valid: no overrides.
typedef struct glint_material_overrides {
    glint_material_override list[GLINT_MATERIAL_OVERRIDES_MAX];
    size_t count;
} glint_material_overrides;

// Appends an override to a glint_material_overrides.
glint_option_parser glint_material_override_parse;

// Finds the materials of a file that each override's NAME means. Errors: GLINT_BAD_INPUT, without
// the file's name, if NAME means no material, or if a value changes nothing in any of its
// materials.
glint_status glint_material_overrides_resolve(glint_material_overrides *overrides,
                                              const glint_material *materials, size_t count,
                                              glint_error *error);

// Applies the resolved overrides to one material. Returns true if a preset replaced the whole
// material.
bool glint_material_overrides_apply(const glint_material_overrides *overrides,
                                    glint_material *material);

// Warns of overrides that change none of these materials. `path` names the file.
void glint_material_overrides_warn(const glint_material_overrides *overrides,
                                   const glint_material *materials, size_t count, const char *path,
                                   glint_warnings *warnings);

#ifdef __cplusplus
}
#endif

#endif
