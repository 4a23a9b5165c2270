// Reads material variants, even if none is chosen. See variants.hpp.
#include "decoder/variants.hpp"

namespace glint
{

namespace
{

const char *const name_of_extension = "KHR_materials_variants";

void read_mapping(const json &root, const json &mapping, const Place &place, const Model &model,
                  VariantMaterials &found)
{
    expect_object(mapping, place);
    const std::size_t materials = objects_of(root, "materials").size();
    const json *material = member(mapping, "material");
    if (material == nullptr) {
        refuse(place / "material", "missing (KHR_materials_variants requires it)");
    }
    const std::size_t index = index_of(*material, place / "material", materials, "material");
    const json &variants = array_at(mapping, place, "variants");
    for (std::size_t i = 0; i < variants.size(); i++) {
        const Place at = (place / "variants")[i];
        const std::size_t variant = index_of(variants[i], at, model.variants.size(), "variant");
        if (!found.emplace(variant, static_cast<int>(index)).second) {
            refuse(at, "variant " + std::to_string(variant) +
                           " has a material already (a primitive may map it once)");
        }
    }
}

} // namespace

void read_variants(const json &root, Model &model)
{
    try {
        const json *extension = extension_of(root, Place(), name_of_extension);
        if (extension == nullptr) {
            return;
        }
        const Place place = Place() / "extensions" / name_of_extension;
        const json &variants = array_at(*extension, place, "variants");
        for (std::size_t i = 0; i < variants.size(); i++) {
            expect_object(variants[i], (place / "variants")[i]);
            model.variants.push_back(name_of(variants[i]));
        }
    } catch (const refusal &) {
        model.variants.clear(); // who asks for one learns that there is none
    }
}

MappedPrimitive read_variant_mappings(const json &root, const json &primitive, const Place &place,
                                      const Model &model)
{
    MappedPrimitive mapped;
    try {
        const json *extension = extension_of(primitive, place, name_of_extension);
        if (extension != nullptr) {
            const Place at = place / "extensions" / name_of_extension;
            const json &mappings = array_at(*extension, at, "mappings");
            for (std::size_t i = 0; i < mappings.size(); i++) {
                read_mapping(root, mappings[i], (at / "mappings")[i], model, mapped.materials);
            }
        }
    } catch (const refusal &fault) {
        mapped.fault = fault.cause() + "; further materials of variants are left out";
    }
    return mapped;
}

} // namespace glint
