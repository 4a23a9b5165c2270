// Describes what surfaces are made of, and decides which lobes they have.
#ifndef GLINT_SCENE_MATERIAL_MATERIAL_H
#define GLINT_SCENE_MATERIAL_MATERIAL_H

#include "scene/material/material_values.h"
#include "scene/texture/texture.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Stands for an infinite index of refraction: at right angles all but 4e-5 of the light is
// reflected. In floats the formulas still tell 1 from the reflectance, and squares do not overflow.
#define GLINT_IOR_INFINITE 1e5F

// What the alpha of the base colour means for the surface.
typedef enum glint_alpha_mode {
    GLINT_ALPHA_OPAQUE, // no meaning: the surface is fully there
    GLINT_ALPHA_MASK,   // the surface is there if alpha ≥ alpha_cutoff
    GLINT_ALPHA_BLEND,  // alpha is the surface's coverage; the rest of the light goes straight on
} glint_alpha_mode;

// The factors of glTF 2.0 and of the supported extensions: material_values.h says what they mean.
typedef struct glint_material {
    char *name; // may be NULL; owned
    int index;  // in the file; for glTF's default material, the number of materials in the file
#define GLINT_DECLARE_NUMBER(name) float name
#define GLINT_DECLARE_COLOR(name) float name[3]
#define GLINT_DECLARE_PAIR(name) float name[2]
#define GLINT_DECLARE(kind, name, ...) GLINT_DECLARE_##kind(name);
    GLINT_MATERIAL_TABLE(GLINT_DECLARE)
#undef GLINT_DECLARE
    bool unlit; // KHR_materials_unlit
    glint_alpha_mode alpha_mode;
    glint_texture_use textures[GLINT_TEXTURE_SLOTS];
    bool has_vertex_colors; // some triangles have colours at their vertices
    // Of the first warnings that loading gave: bit i is set if warning i concerns this material.
    uint64_t warnings;
} glint_material;

// A row of material_values.h.
typedef struct glint_material_value {
    const char *name;
    size_t offset; // in glint_material
    int count;     // of its numbers
    double least, most;
    const char *extension; // of glTF; NULL: none
    const char *key;       // in the extension, else in pbrMetallicRoughness; NULL: see factors.cpp
} glint_material_value;

extern const glint_material_value glint_material_values[];
extern const size_t glint_material_value_count;

// Initialisers for values that a file leaves out: of KHR_materials_specular; and of specular and
// glass.
#define GLINT_MATERIAL_SPECULAR .specular = 1, .specular_color = {1, 1, 1}
#define GLINT_MATERIAL_CLEAR                                                                       \
    GLINT_MATERIAL_SPECULAR, .ior = 1.5F, .attenuation_distance = INFINITY,                        \
                             .attenuation_color = {1, 1, 1}

// glTF's default material: rough, white metal.
extern const glint_material glint_material_default;

// The lobes that a material has: each is one way in which its surface sends light on. A lobe exists
// if its share of the light is above 0. docs/light_transport.md has the rules and the shares. The
// plan, the upload, the proofs about paths and the reports all ask here.
typedef struct glint_lobes {
    bool unlit;    // shows the base colour and ends the path: no other lobe exists
    bool emission; // adds radiance
    // The lecture's blend replaces metal, glass and paint.
    bool blend;
    bool blend_mirror; // the blend's mirror has a share
    // Metal, glass and paint share the light: metallic decides first, then transmission.
    bool metal;       // reflects
    bool tint;        // metal colours its reflection, by its colour or by a film
    bool glass;       // transmits and reflects; solid or thin
    bool solid;       // glass: the mesh bounds a solid, which refracts
    bool absorption;  // the solid absorbs
    bool dispersion;  // the solid refracts by wavelength
    bool thin;        // glass: a wall without thickness; light passes straight
    bool paint;       // diffuse: lit by the environment's irradiance
    bool translucent; // paint is also lit from behind
    bool gloss;       // paint also reflects, because it is smooth
    bool specular;    // KHR_materials_specular changes the reflection of paint and glass
    bool iridescent;  // a film colours the reflection
    bool rough;       // metal and paint's coat reflect rough lobes
    bool brushed;     // the rough lobes are anisotropic
    bool rough_path;  // paths follow the rough lobes
    bool sheen;       // fibres on metal and paint, if nothing is transmitted
    bool facets;      // glass is rough, and so are the reflections of metal and paint beside it
    // A clear coat lies above these lobes, but not on unlit surfaces or the blend.
    bool clearcoat;            // the coat exists
    bool rough_clearcoat;      // the coat reflects a rough lobe
    bool rough_clearcoat_path; // paths follow the coat's rough lobe
    // Coverage applies to all lobes: part of the surface may not be there.
    bool masked; // by alpha_cutoff
    bool covers; // by alpha; never for a solid, which always covers fully
} glint_lobes;

glint_lobes glint_material_lobes(const glint_material *material);

// True if light travels alike in solids of both materials, and neither has priority over the other.
bool glint_material_media_are_alike(const glint_material *a, const glint_material *b);

// Returns the normal texture, or else the clear coat's. Its image is 0 if there is neither.
const glint_texture_use *glint_material_normal_texture(const glint_material *material);

// True if surfaces need tangents. The second function returns the texture whose coordinates the
// tangents follow: the normal texture, else the clear coat's normal texture, else the anisotropy
// texture. Its image may be 0: then the first set of coordinates counts.
bool glint_material_needs_tangents(const glint_material *material);
const glint_texture_use *glint_material_tangent_texture(const glint_material *material);

bool glint_material_is_textured(const glint_material *material);

#ifdef __cplusplus
}
#endif

#endif
