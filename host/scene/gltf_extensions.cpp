// Lists the extensions, and how glint treats each. See gltf_extensions.hpp.
#include "scene/gltf_extensions.hpp"

#include <algorithm>
#include <array>

namespace glint
{

namespace
{

struct Extension {
    const char *name;
    Holder holder;
    bool can_be_required;
    const char *said; // the warning for a used object; NULL: none, since nothing is missing
    glint_treatment treatment;
};

constexpr std::array<Extension, 23> extensions = {{
    {"KHR_materials_transmission", Holder::material, true, nullptr, GLINT_RENDERED},
    {"KHR_materials_ior", Holder::material, true, nullptr, GLINT_RENDERED},
    {"KHR_materials_volume", Holder::material, true, nullptr, GLINT_RENDERED},
    {"KHR_materials_dispersion", Holder::material, true, nullptr, GLINT_RENDERED},
    {"KHR_materials_emissive_strength", Holder::material, true, nullptr, GLINT_RENDERED},
    {"KHR_materials_specular", Holder::material, true, nullptr, GLINT_RENDERED},
    {"KHR_materials_clearcoat", Holder::material, true, nullptr, GLINT_RENDERED},
    {"KHR_materials_anisotropy", Holder::material, true, nullptr, GLINT_RENDERED},
    {"KHR_materials_sheen", Holder::material, true, nullptr, GLINT_RENDERED},
    {"KHR_materials_diffuse_transmission", Holder::material, true, nullptr, GLINT_RENDERED},
    {"KHR_materials_iridescence", Holder::material, true, nullptr, GLINT_RENDERED},
    {"KHR_materials_unlit", Holder::material, true, nullptr, GLINT_RENDERED},
    {"KHR_materials_pbrSpecularGlossiness", Holder::material, true,
     "specular and glossiness are converted to metallic and roughness, without their texture",
     GLINT_APPROXIMATED},
    {"KHR_texture_transform", Holder::texture, true, nullptr, GLINT_RENDERED},
    {"EXT_texture_webp", Holder::texture, true, nullptr, GLINT_RENDERED},
    {"MSFT_texture_dds", Holder::texture, true, nullptr, GLINT_RENDERED},
    {"KHR_mesh_quantization", Holder::document, true, nullptr, GLINT_RENDERED},
    {"EXT_meshopt_compression", Holder::document, true, nullptr, GLINT_RENDERED},
    {"KHR_meshopt_compression", Holder::document, true, nullptr, GLINT_RENDERED},
    {"EXT_mesh_gpu_instancing", Holder::node, true, nullptr, GLINT_RENDERED},
    {"KHR_lights_punctual", Holder::node, true,
     "lights have no size: mirrors and glass do not show their light", GLINT_APPROXIMATED},
    {"KHR_materials_variants", Holder::primitive, true, nullptr, GLINT_RENDERED},
    {"KHR_draco_mesh_compression", Holder::primitive, true, nullptr, GLINT_RENDERED},
}};

const char *shown_without(Holder holder)
{
    switch (holder) {
    case Holder::material:
        return "the material is rendered without it";
    case Holder::node:
        return "the node is shown without it";
    default:
        return "the mesh is shown without it";
    }
}

} // namespace

bool can_be_required(const std::string &name)
{
    return std::any_of(extensions.begin(), extensions.end(), [&](const Extension &one) {
        return name == one.name && one.can_be_required;
    });
}

glint_treatment treatment_of(const std::string &name)
{
    const auto *known = std::find_if(extensions.begin(), extensions.end(),
                                     [&](const Extension &one) { return name == one.name; });
    return known == extensions.end() ? GLINT_IGNORED : known->treatment;
}

void survey_extensions(const json &object, Holder holder, const std::string &where, Tally &tally)
{
    const json *found = member(object, "extensions");
    if (found == nullptr) {
        return;
    }
    for (auto it = found->begin(); it != found->end(); ++it) {
        const auto *known =
            std::find_if(extensions.begin(), extensions.end(), [&](const Extension &one) {
                return it.key() == one.name && holder == one.holder;
            });
        if (known == extensions.end()) {
            tally.add(it.key() + " is not modelled, " + shown_without(holder), where);
        } else if (known->said != nullptr) {
            tally.add(known->said, where);
        }
    }
}

} // namespace glint
