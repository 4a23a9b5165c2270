// Lists the extensions, and how glint treats each. See extensions.hpp.
#include "decoder/extensions.hpp"

#include <algorithm>
#include <array>

namespace glint
{

namespace
{

struct Extension {
    const char *name;
    Holder holder;
    const char *said; // the warning for a used object; NULL: none, since nothing is missing
    glint_treatment treatment;
};

constexpr std::array<Extension, 24> extensions = {{
    {"KHR_materials_transmission", Holder::material, nullptr, GLINT_RENDERED},
    {"KHR_materials_ior", Holder::material, nullptr, GLINT_RENDERED},
    {"KHR_materials_volume", Holder::material, nullptr, GLINT_RENDERED},
    {"KHR_materials_dispersion", Holder::material, nullptr, GLINT_RENDERED},
    {"KHR_materials_emissive_strength", Holder::material, nullptr, GLINT_RENDERED},
    {"KHR_materials_specular", Holder::material, nullptr, GLINT_RENDERED},
    {"KHR_materials_clearcoat", Holder::material, nullptr, GLINT_RENDERED},
    {"KHR_materials_anisotropy", Holder::material, nullptr, GLINT_RENDERED},
    {"KHR_materials_sheen", Holder::material, nullptr, GLINT_RENDERED},
    {"KHR_materials_diffuse_transmission", Holder::material, nullptr, GLINT_RENDERED},
    {"KHR_materials_iridescence", Holder::material, nullptr, GLINT_RENDERED},
    {"KHR_materials_unlit", Holder::material, nullptr, GLINT_RENDERED},
    {"KHR_materials_pbrSpecularGlossiness", Holder::material,
     "specular and glossiness are converted to metallic and roughness, without their texture",
     GLINT_APPROXIMATED},
    {"KHR_texture_transform", Holder::texture, nullptr, GLINT_RENDERED},
    {"EXT_texture_webp", Holder::texture, nullptr, GLINT_RENDERED},
    {"MSFT_texture_dds", Holder::texture, nullptr, GLINT_RENDERED},
    {"KHR_mesh_quantization", Holder::document, nullptr, GLINT_RENDERED},
    {"EXT_meshopt_compression", Holder::document, nullptr, GLINT_RENDERED},
    {"KHR_meshopt_compression", Holder::document, nullptr, GLINT_RENDERED},
    {"EXT_mesh_gpu_instancing", Holder::node, nullptr, GLINT_RENDERED},
    {"KHR_node_visibility", Holder::node, nullptr, GLINT_RENDERED},
    {"KHR_lights_punctual", Holder::node,
     "lights have no size: mirrors and glass do not show their light", GLINT_APPROXIMATED},
    {"KHR_materials_variants", Holder::primitive, nullptr, GLINT_RENDERED},
    {"KHR_draco_mesh_compression", Holder::primitive, nullptr, GLINT_RENDERED},
}};

// Extensions that change no picture: metadata, behaviour, sound, physics, and levels of detail (the
// node itself is the finest). '*' stands for any end of the name.
constexpr std::array<const char *, 24> unseen = {{
    "ADOBE_meta",
    "AGI_articulations",
    "AGI_stk_metadata",
    "BLENDER_physics",
    "EXT_bim_metadata",
    "EXT_feature_metadata",
    "EXT_instance_features",
    "EXT_mesh_features",
    "EXT_mesh_manifold",
    "EXT_structural_metadata",
    "FB_geometry_metadata",
    "FB_ngon_encoding",
    "GODOT_single_root",
    "GRIFFEL_bim_data",
    "KHR_audio*",
    "KHR_collision_shapes",
    "KHR_implicit_shapes",
    "KHR_interactivity",
    "KHR_node_hoverability",
    "KHR_node_selectability",
    "KHR_physics_*",
    "KHR_xmp*",
    "MSFT_audio_emitter",
    "MSFT_lod",
}};

// Those of the Open Metaverse Interoperability Group are of the same kinds, but for its sky.
constexpr const char *unseen_of_omi = "OMI_*", *sky_of_omi = "OMI_environment_sky";

// Extensions that may change a picture, but neither shapes nor places: a file that requires them is
// shown without them.
constexpr std::array<const char *, 6> left_out = {{
    "*_materials_*",
    "*_texture_*",
    "*_lights_*",
    "KHR_animation_pointer",
    "KHR_techniques_webgl",
    sky_of_omi,
}};

// True if the name fits a pattern with '*' at its beginning, its end, or both.
bool fits(const std::string &name, const char *pattern)
{
    const bool any_head = pattern[0] == '*';
    std::string rest = pattern + (any_head ? 1 : 0);
    const bool any_tail = !rest.empty() && rest.back() == '*';
    if (any_tail) {
        rest.pop_back();
    }
    const std::size_t at = name.find(rest);
    return at != std::string::npos && (any_head || at == 0) &&
           (any_tail || at + rest.size() == name.size());
}

template <std::size_t N>
bool is_among(const std::string &name, const std::array<const char *, N> &patterns)
{
    return std::any_of(patterns.begin(), patterns.end(),
                       [&](const char *pattern) { return fits(name, pattern); });
}

bool is_unseen(const std::string &name)
{
    return is_among(name, unseen) || (fits(name, unseen_of_omi) && name != sky_of_omi);
}

const char *shown_without(Holder holder)
{
    switch (holder) {
    case Holder::material:
        return "the material is rendered without it";
    case Holder::node:
        return "the node is shown without it";
    case Holder::scene:
        return "the scene is shown without it";
    default:
        return "the mesh is shown without it";
    }
}

} // namespace

bool can_be_required(const std::string &name)
{
    return is_unseen(name) || is_among(name, left_out) ||
           std::any_of(extensions.begin(), extensions.end(),
                       [&](const Extension &one) { return name == one.name; });
}

glint_treatment treatment_of(const std::string &name)
{
    const auto *known = std::find_if(extensions.begin(), extensions.end(),
                                     [&](const Extension &one) { return name == one.name; });
    return known == extensions.end() ? GLINT_IGNORED : known->treatment;
}

std::vector<std::string> survey_extensions(const json &object, Holder holder)
{
    std::vector<std::string> warnings;
    const json *found = nullptr;
    try {
        found = optional_object(object, Place(), "extensions");
    } catch (const refusal &) {
        warnings.emplace_back("its extensions are no object (they are left out)");
    }
    if (found == nullptr) {
        return warnings;
    }
    for (auto it = found->begin(); it != found->end(); ++it) {
        const auto *known =
            std::find_if(extensions.begin(), extensions.end(), [&](const Extension &one) {
                return it.key() == one.name && holder == one.holder;
            });
        const bool is_known = known != extensions.end();
        if (it->is_null() || (is_known ? known->said == nullptr : is_unseen(it.key()))) {
            continue;
        }
        warnings.push_back(is_known ? known->said
                                    : it.key() + " is not modelled, " + shown_without(holder));
    }
    return warnings;
}

} // namespace glint
