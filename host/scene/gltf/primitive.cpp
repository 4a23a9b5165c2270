// Prepares primitives for drawing. See primitive.hpp.
#include "scene/gltf/primitive.hpp"

#include "scene/gltf/accessor.hpp"
#include "scene/gltf/check_morph.hpp"

#include <algorithm>
#include <optional>

namespace glint
{

namespace
{

// A cache of opened accessors. Many primitives can share an accessor; each is opened and searched
// once. Otherwise a small file could take a long time.
class Accessors
{
  public:
    explicit Accessors(const Model &model)
        : model_(model), arrays_(model.accessors.size()), largest_(model.accessors.size())
    {
    }

    const glint_array &array(std::size_t i)
    {
        if (!arrays_[i]) {
            arrays_[i] = open_array(model_, i);
        }
        return *arrays_[i];
    }

    std::uint32_t largest_index(std::size_t i)
    {
        if (!largest_[i]) {
            const glint_array &indices = array(i);
            std::uint32_t largest = 0;
            for (std::size_t k = 0; k < indices.count; k++) {
                largest = std::max(largest, glint_array_index(&indices, k));
            }
            largest_[i] = largest;
        }
        return *largest_[i];
    }

  private:
    const Model &model_;
    std::vector<std::optional<glint_array>> arrays_;
    std::vector<std::optional<std::uint32_t>> largest_;
};

[[noreturn]] void refuse_index(const glint_primitive &primitive, std::size_t accessor,
                               std::uint32_t largest)
{
    std::size_t k = 0;
    while (glint_array_index(&primitive.indices, k) != largest) {
        k++;
    }
    std::string what =
        "accessors[" + std::to_string(accessor) + "], element " + std::to_string(k) + ": ";
    if (largest >= primitive.positions.count) {
        refuse(place_of(primitive) / "indices",
               what + "there is no vertex " + std::to_string(largest) + " (POSITION has " +
                   counted(primitive.positions.count, "element") + ")");
    }
    refuse(place_of(primitive) / "indices",
           what + std::to_string(largest) +
               " restarts a primitive, which glTF 2.0 does not allow (split the primitive)");
}

void open_indices(const tinygltf::Primitive &source, Accessors &accessors,
                  glint_primitive &primitive)
{
    if (source.indices < 0) {
        return;
    }
    auto accessor = static_cast<std::size_t>(source.indices);
    primitive.indices = accessors.array(accessor);
    std::uint32_t largest = accessors.largest_index(accessor);
    if (largest >= primitive.positions.count ||
        largest == glint_component_largest(primitive.indices.type)) {
        refuse_index(primitive, accessor, largest);
    }
}

std::vector<glint_morph_target> open_targets(const tinygltf::Primitive &source,
                                             Accessors &accessors, const glint_primitive &primitive,
                                             Tally &tally)
{
    std::vector<glint_morph_target> targets;
    for (const auto &target : source.targets) {
        glint_morph_target &opened = targets.emplace_back();
        for (const auto &moved : target) {
            const bool is_read =
                std::any_of(morph_rows.begin(), morph_rows.end(),
                            [&](const MorphRow &row) { return moved.first == row.name; });
            if (!is_read && moved.first != "TANGENT") { // tangents are computed anew
                tally.add("a morph target moves " + moved.first + ", which is left out",
                          place_of(primitive).text());
            }
        }
        for (std::size_t row = 0; row < morph_rows.size(); row++) {
            const char *name = morph_rows[row].name;
            const auto found = target.find(name);
            if (found == target.end()) {
                continue;
            }
            if (source.attributes.count(name) == 0) {
                tally.add(std::string("a morph target moves ") + name +
                              ", which the primitive has not, and is left out",
                          place_of(primitive).text());
                continue;
            }
            opened.of[row] = accessors.array(static_cast<std::size_t>(found->second));
        }
    }
    return targets;
}

std::vector<glint_influences> open_influences(const tinygltf::Primitive &source,
                                              Accessors &accessors)
{
    std::vector<glint_influences> influences;
    for (std::size_t set = 0;; set++) {
        const auto joints = source.attributes.find("JOINTS_" + std::to_string(set));
        const auto weights = source.attributes.find("WEIGHTS_" + std::to_string(set));
        if (joints == source.attributes.end() || weights == source.attributes.end()) {
            return influences;
        }
        influences.push_back({accessors.array(static_cast<std::size_t>(joints->second)),
                              accessors.array(static_cast<std::size_t>(weights->second))});
    }
}

// Opens the attributes for textures and colours.
void open_attributes(const tinygltf::Primitive &source, const Model &model, Accessors &accessors,
                     glint_primitive &primitive)
{
    auto open = [&](const char *name, glint_array &array) {
        const auto found = source.attributes.find(name);
        const bool is_there = found != source.attributes.end();
        if (is_there) {
            array = accessors.array(static_cast<std::size_t>(found->second));
        }
        return is_there;
    };
    open("NORMAL", primitive.normals);
    open("TANGENT", primitive.tangents);
    open("TEXCOORD_0", primitive.texcoords[0]);
    open("TEXCOORD_1", primitive.texcoords[1]);
    if (open("COLOR_0", primitive.colors)) {
        const auto accessor = static_cast<std::size_t>(source.attributes.at("COLOR_0"));
        primitive.color_components = model.accessors[accessor].type == TINYGLTF_TYPE_VEC4 ? 4 : 3;
    }
}

void count_triangles(glint_primitive &primitive, Tally &tally)
{
    std::size_t corners =
        primitive.indices.count > 0 ? primitive.indices.count : primitive.positions.count;
    std::size_t left_over = 0;
    if (primitive.mode == GLINT_MODE_TRIANGLES) {
        primitive.triangles = corners / 3;
        left_over = corners % 3;
    } else {
        primitive.triangles = corners < 3 ? 0 : corners - 2;
        left_over = corners < 3 ? corners : 0;
    }
    if (left_over > 0) {
        tally.add("the last vertices make no whole triangle and are left out",
                  place_of(primitive).text());
    }
}

} // namespace

Primitives prepare_primitives(const Model &model, Tally &tally)
{
    Primitives result;
    Accessors accessors(model);
    for (std::size_t m = 0; m < model.meshes.size(); m++) {
        result.first.push_back(result.all.size());
        for (std::size_t p = 0; p < model.meshes[m].primitives.size(); p++) {
            const tinygltf::Primitive &source = model.meshes[m].primitives[p];
            glint_primitive &primitive = result.all.emplace_back();
            std::vector<glint_morph_target> &targets = result.targets.emplace_back();
            std::vector<glint_influences> &influences = result.influences.emplace_back();
            primitive.mesh = m;
            primitive.number = p;
            primitive.mode = source.mode;
            primitive.material = source.material;
            auto position = source.attributes.find("POSITION");
            if (primitive.mode >= GLINT_MODE_TRIANGLES && position != source.attributes.end()) {
                primitive.positions = accessors.array(static_cast<std::size_t>(position->second));
                open_attributes(source, model, accessors, primitive);
                open_indices(source, accessors, primitive);
                targets = open_targets(source, accessors, primitive, tally);
                influences = open_influences(source, accessors);
                primitive.targets = targets.data();
                primitive.target_count = targets.size();
                primitive.influences = {influences.data(), influences.size()};
                count_triangles(primitive, tally);
            }
        }
    }
    result.first.push_back(result.all.size());
    return result;
}

} // namespace glint
