// The numbers of a material: a row for each. The host expands this table to the struct, its
// defaults, the ranges that it checks, the reading from glTF, fingerprints and JSON.
#ifndef GLINT_SCENE_MATERIAL_MATERIAL_VALUES_H
#define GLINT_SCENE_MATERIAL_MATERIAL_VALUES_H

// VALUE(kind, name, least, most, start, extension, key, meaning)
//   kind       NUMBER; COLOR: three numbers, linear Rec. 709; PAIR: two numbers
//   least, most  the range in which the numbers count
//   start      the default, where a file does not give the value; a PAIR's two stand in parentheses
//   extension  the glTF extension that gives the value; CORE: none
//   key        in the extension, or in pbrMetallicRoughness; NULL: decoder/factors.cpp reads the
//   value
//              by code of its own
// Whoever expands the ranges includes <float.h> and <math.h>.
#define GLINT_MATERIAL_TABLE(VALUE)                                                                \
    VALUE(COLOR, base_color, 0, 1, 1, CORE, NULL, "R, G and B of baseColorFactor")                 \
    VALUE(NUMBER, metallic, 0, 1, 1, CORE, "metallicFactor", "share of metal")                     \
    VALUE(NUMBER, roughness, 0, 1, 1, CORE, "roughnessFactor", "of metal, paint and glass")        \
    VALUE(COLOR, emission, 0, FLT_MAX, 0, CORE, NULL,                                              \
          "emissiveFactor times emissiveStrength, radiance")                                       \
    VALUE(NUMBER, alpha, 0, 1, 1, CORE, NULL, "A of baseColorFactor")                              \
    VALUE(NUMBER, alpha_cutoff, 0, FLT_MAX, 0.5F, CORE, NULL, "with GLINT_ALPHA_MASK")             \
    VALUE(NUMBER, normal_scale, -FLT_MAX, FLT_MAX, 1, CORE, NULL,                                  \
          "scales x and y of the normal texture's normals")                                        \
    VALUE(NUMBER, occlusion_strength, 0, 1, 1, CORE, NULL, "of the occlusion texture")             \
    VALUE(NUMBER, transmission, 0, 1, 0, "KHR_materials_transmission", "transmissionFactor",       \
          "share of paint's light that passes")                                                    \
    VALUE(NUMBER, thickness, 0, FLT_MAX, 0, "KHR_materials_volume", "thicknessFactor",             \
          "above 0 the mesh bounds a solid")                                                       \
    VALUE(COLOR, attenuation_color, 0, 1, 1, "KHR_materials_volume", "attenuationColor",           \
          "of white light after attenuation_distance")                                             \
    VALUE(NUMBER, attenuation_distance, FLT_MIN, INFINITY, INFINITY, "KHR_materials_volume", NULL, \
          "metres; infinite: the solid does not absorb")                                           \
    VALUE(NUMBER, dispersion, 0, FLT_MAX, 0, "KHR_materials_dispersion", "dispersion",             \
          "of solids, 20 over Abbe's number")                                                      \
    VALUE(NUMBER, ior, 1, GLINT_IOR_INFINITE, 1.5F, "KHR_materials_ior", NULL,                     \
          "index of refraction")                                                                   \
    VALUE(NUMBER, specular, 0, 1, 1, "KHR_materials_specular", "specularFactor",                   \
          "scales the reflection of paint and glass")                                              \
    VALUE(COLOR, specular_color, 0, FLT_MAX, 1, "KHR_materials_specular", "specularColorFactor",   \
          "scales it at normal incidence")                                                         \
    VALUE(NUMBER, clearcoat, 0, 1, 0, "KHR_materials_clearcoat", "clearcoatFactor",                \
          "weight of the coat")                                                                    \
    VALUE(NUMBER, clearcoat_roughness, 0, 1, 0, "KHR_materials_clearcoat",                         \
          "clearcoatRoughnessFactor", "of the coat")                                               \
    VALUE(NUMBER, clearcoat_normal_scale, -FLT_MAX, FLT_MAX, 1, "KHR_materials_clearcoat", NULL,   \
          "scales x and y of the coat's normals")                                                  \
    VALUE(NUMBER, anisotropy, 0, 1, 0, "KHR_materials_anisotropy", "anisotropyStrength",           \
          "how much longer lobes are than wide")                                                   \
    VALUE(NUMBER, anisotropy_rotation, -FLT_MAX, FLT_MAX, 0, "KHR_materials_anisotropy",           \
          "anisotropyRotation", "radians, from the tangent towards the bitangent")                 \
    VALUE(COLOR, sheen_color, 0, 1, 0, "KHR_materials_sheen", "sheenColorFactor",                  \
          "of the fibres; black is no sheen")                                                      \
    VALUE(NUMBER, sheen_roughness, 0, 1, 0, "KHR_materials_sheen", "sheenRoughnessFactor",         \
          "of the fibres")                                                                         \
    VALUE(NUMBER, diffuse_transmission, 0, 1, 0, "KHR_materials_diffuse_transmission",             \
          "diffuseTransmissionFactor", "share of paint's diffuse light that comes from behind")    \
    VALUE(COLOR, diffuse_transmission_color, 0, 1, 1, "KHR_materials_diffuse_transmission",        \
          "diffuseTransmissionColorFactor", "of this light")                                       \
    VALUE(NUMBER, iridescence, 0, 1, 0, "KHR_materials_iridescence", "iridescenceFactor",          \
          "weight of the film")                                                                    \
    VALUE(NUMBER, iridescence_ior, 1, FLT_MAX, 1.3F, "KHR_materials_iridescence",                  \
          "iridescenceIor", "index of refraction of the film")                                     \
    VALUE(PAIR, iridescence_thickness, 0, FLT_MAX, (100, 400), "KHR_materials_iridescence", NULL,  \
          "of the film, nm, for texture values 0 and 1; without a texture the last counts")        \
    VALUE(NUMBER, mirror, -1, 1, -1, CORE, NULL,                                                   \
          "the lecture's blend, extras {\"glint\": {\"mirror\": m}}; else -1")                     \
    VALUE(NUMBER, priority, -1e6, 1e6, 0, CORE, NULL,                                              \
          "where solids overlap, extras {\"glint\": {\"priority\": p}}; see solids.h")

#endif
