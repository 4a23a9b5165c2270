// What surfaces are made of, and the one answer to what they do with light.
#ifndef GLINT_SCENE_MATERIAL_H
#define GLINT_SCENE_MATERIAL_H

#include "scene/texture.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// What the alpha of a surface's base colour means: how much of it is there.
typedef enum glint_alpha_mode {
    GLINT_ALPHA_OPAQUE, // nothing: all of it
    GLINT_ALPHA_MASK,   // all of it from alpha_cutoff on, else nothing
    GLINT_ALPHA_BLEND,  // that share of it; the other light goes straight on
} glint_alpha_mode;

// glTF 2.0's factors, and the extensions that are modelled. Colours are linear Rec.709 in [0, 1].
typedef struct glint_material {
    char *name; // may be NULL; owned
    int index;  // in the file; of glTF's default material, how many the file has
    float base_color[3];
    float metallic;             // [0, 1]
    float roughness;            // [0, 1]
    float emission[3];          // emissiveFactor × emissiveStrength, radiance ≥ 0
    float transmission;         // KHR_materials_transmission, [0, 1]
    float ior;                  // KHR_materials_ior, ≥ 1; default 1.5. 0 in the file ("infinite,
                                // F = 1") is refused
    float thickness;            // KHR_materials_volume: > 0 makes the mesh the boundary of a solid
    float attenuation_distance; // metres; INFINITY where the file gives none
    float attenuation_color[3]; // what is left of white after attenuation_distance
    float dispersion;           // KHR_materials_dispersion, 20/Abbe number, ≥ 0; of solids
    float specular;             // KHR_materials_specular, [0, 1]: of what paint and glass reflect
    float specular_color[3];    // likewise, ≥ 0: of that at right angles
    float clearcoat;            // KHR_materials_clearcoat, [0, 1]: how much of a coat there is
    float clearcoat_roughness;  // its roughness, [0, 1]
    float iridescence;          // KHR_materials_iridescence, [0, 1]: how much of a film there is
    float iridescence_ior;      // of the film, ≥ 1
    float iridescence_thickness[2]; // nm, ≥ 0: where the texture is 0 and 1; without one the last
    float anisotropy;               // KHR_materials_anisotropy, [0, 1]: strength
    float anisotropy_rotation;      // radians, from the tangent towards the bitangent
    float sheen_color[3];           // KHR_materials_sheen, [0, 1]: black is none
    float sheen_roughness;          // [0, 1]
    // KHR_materials_diffuse_transmission, [0, 1]: how much of what paint sends on comes from
    // behind; its colour.
    float diffuse_transmission;
    float diffuse_transmission_color[3];
    bool unlit;     // KHR_materials_unlit
    float mirror;   // the lecture's blend, extras {"glint": {"mirror": m}}; else −1
    float priority; // of solids where they overlap, extras {"glint": {"priority": p}}; see solids.h
    glint_alpha_mode alpha_mode;
    float alpha;        // baseColorFactor's A, [0, 1]
    float alpha_cutoff; // of GLINT_ALPHA_MASK
    glint_texture_use textures[GLINT_TEXTURE_SLOTS];
    float normal_scale;           // of x and y of the normal texture's normals
    float clearcoat_normal_scale; // likewise, of the clear coat's
    float occlusion_strength;     // [0, 1]
    bool has_vertex_colors;       // some of its triangles have colours at their vertices
    uint64_t warnings; // that loading gave first: bit i is set if the i-th concerns this material
} glint_material;

// What glTF 2.0 and its extensions give a material that says nothing of them, for initialisers: of
// KHR_materials_specular; and of that and of glass.
#define GLINT_MATERIAL_SPECULAR .specular = 1, .specular_color = {1, 1, 1}
#define GLINT_MATERIAL_CLEAR                                                                       \
    GLINT_MATERIAL_SPECULAR, .ior = 1.5F, .attenuation_distance = INFINITY,                        \
                             .attenuation_color = {1, 1, 1}

// glTF's default material: rough, white metal.
extern const glint_material glint_material_default;

// The lobes that a material has: each is one way in which its surface sends light on. A lobe is
// there if its share of the light is above 0. ARCHITECTURE.md, "Light transport", has the rules and
// the shares. The plan, the upload, the proofs about paths and the reports all ask here.
typedef struct glint_lobes {
    bool unlit;    // the base colour, and the path ends: no other lobe is there
    bool emission; // adds radiance
    // The lecture's blend, in place of metal, glass and paint.
    bool blend;
    bool blend_mirror; // its mirror has a share
    // Metal, glass and paint share the light; metallic comes first, then transmission.
    bool metal;       // reflects
    bool tint;        // and colours what it reflects, by itself or by a film
    bool glass;       // transmits and reflects: solid or thin
    bool solid;       // the mesh bounds a solid, which refracts
    bool absorption;  // and absorbs
    bool dispersion;  // and refracts by the wavelength
    bool thin;        // a wall without thickness: light passes straight
    bool paint;       // is lit by the environment's irradiance
    bool translucent; // also from behind
    bool gloss;       // and reflects, as it is smooth
    bool specular;    // what paint and glass reflect is weighed or coloured
    bool iridescent;  // a film colours what is reflected
    bool rough;       // metal, and the coat of paint, reflect lobes
    bool brushed;     // which are rougher along a direction than across it
    bool rough_path;  // for which paths go on
    bool sheen;       // fibres stand on metal and paint, where nothing is transmitted
    bool facets;      // glass is rough, and so is what beside it reflects
    // Above these, but for unlit surfaces and the blend:
    bool clearcoat;            // a clear coat reflects
    bool rough_clearcoat;      // a lobe
    bool rough_clearcoat_path; // for which paths go on
    // Beside all of these: some of the surface may not be there.
    bool masked; // by alpha_cutoff
    bool covers; // by its alpha; never of a solid, which is all there
} glint_lobes;

glint_lobes glint_material_lobes(const glint_material *material);

// The normal texture, or else the clear coat's; its image is 0 where there is neither.
const glint_texture_use *glint_material_normal_texture(const glint_material *material);

// Whether surfaces need tangents; and the texture whose coordinates they follow: the normal
// texture, else the clear coat's, else that of the anisotropy. Its image may be 0: the first
// coordinates.
bool glint_material_needs_tangents(const glint_material *material);
const glint_texture_use *glint_material_tangent_texture(const glint_material *material);

bool glint_material_is_textured(const glint_material *material);

#ifdef __cplusplus
}
#endif

#endif
