// Prepares primitives for drawing. See primitive.hpp.
#include "scene/gltf/primitive.hpp"

#include <algorithm>
#include <optional>
#include <utility>

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
        : model_(model), readers_(model.accessors.size()), largest_(model.accessors.size())
    {
    }

    const Reader &reader(std::size_t i)
    {
        if (!readers_[i]) {
            readers_[i].emplace(model_, i);
        }
        return *readers_[i];
    }

    std::uint32_t largest_index(std::size_t i)
    {
        if (!largest_[i]) {
            const Reader &indices = reader(i);
            std::uint32_t largest = 0;
            for (std::size_t k = 0; k < indices.count(); k++) {
                largest = std::max(largest, indices.index(k));
            }
            largest_[i] = largest;
        }
        return *largest_[i];
    }

  private:
    const Model &model_;
    std::vector<std::optional<Reader>> readers_;
    std::vector<std::optional<std::uint32_t>> largest_;
};

[[noreturn]] void refuse_index(const Primitive &primitive, std::size_t accessor,
                               std::uint32_t largest)
{
    std::size_t k = 0;
    while (primitive.indices.index(k) != largest) {
        k++;
    }
    std::string what =
        "accessors[" + std::to_string(accessor) + "], element " + std::to_string(k) + ": ";
    if (largest >= primitive.positions.count()) {
        refuse(primitive.place() / "indices",
               what + "there is no vertex " + std::to_string(largest) + " (POSITION has " +
                   counted(primitive.positions.count(), "element") + ")");
    }
    refuse(primitive.place() / "indices",
           what + std::to_string(largest) +
               " restarts a primitive, which glTF 2.0 does not allow (split the primitive)");
}

void open_indices(const tinygltf::Primitive &source, Accessors &accessors, Primitive &primitive)
{
    if (source.indices < 0) {
        return;
    }
    auto accessor = static_cast<std::size_t>(source.indices);
    primitive.indexed = true;
    primitive.indices = accessors.reader(accessor);
    std::uint32_t largest = accessors.largest_index(accessor);
    if (largest >= primitive.positions.count() || largest == primitive.indices.largest_index()) {
        refuse_index(primitive, accessor, largest);
    }
}

void open_targets(const tinygltf::Primitive &source, Accessors &accessors, Primitive &primitive,
                  Tally &tally)
{
    for (const auto &target : source.targets) {
        MorphTarget &opened = primitive.targets.emplace_back();
        for (const auto &moved : target) {
            const bool is_read =
                std::any_of(morph_rows.begin(), morph_rows.end(),
                            [&](const MorphRow &row) { return moved.first == row.name; });
            if (!is_read && moved.first != "TANGENT") { // tangents are computed anew
                tally.add("a morph target moves " + moved.first + ", which is left out",
                          primitive.place().text());
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
                          primitive.place().text());
                continue;
            }
            opened.of[row] = accessors.reader(static_cast<std::size_t>(found->second));
        }
    }
}

void open_influences(const tinygltf::Primitive &source, Accessors &accessors, Primitive &primitive)
{
    for (std::size_t set = 0;; set++) {
        const auto joints = source.attributes.find("JOINTS_" + std::to_string(set));
        const auto weights = source.attributes.find("WEIGHTS_" + std::to_string(set));
        if (joints == source.attributes.end() || weights == source.attributes.end()) {
            return;
        }
        primitive.influences.push_back(
            {accessors.reader(static_cast<std::size_t>(joints->second)),
             accessors.reader(static_cast<std::size_t>(weights->second))});
    }
}

// Opens the attributes for textures and colours.
void open_attributes(const tinygltf::Primitive &source, const Model &model, Accessors &accessors,
                     Primitive &primitive)
{
    auto open = [&](const char *name, Reader &reader) {
        const auto found = source.attributes.find(name);
        const bool is_there = found != source.attributes.end();
        if (is_there) {
            reader = accessors.reader(static_cast<std::size_t>(found->second));
        }
        return is_there;
    };
    primitive.has_tangents = open("TANGENT", primitive.tangents);
    primitive.has_texcoords = {open("TEXCOORD_0", primitive.texcoords[0]),
                               open("TEXCOORD_1", primitive.texcoords[1])};
    if (open("COLOR_0", primitive.colors)) {
        const auto accessor = static_cast<std::size_t>(source.attributes.at("COLOR_0"));
        primitive.color_components = model.accessors[accessor].type == TINYGLTF_TYPE_VEC4 ? 4 : 3;
    }
}

void count_triangles(Primitive &primitive, Tally &tally)
{
    std::size_t corners =
        primitive.indexed ? primitive.indices.count() : primitive.positions.count();
    std::size_t left_over = 0;
    if (primitive.mode == 4) {
        primitive.triangles = corners / 3;
        left_over = corners % 3;
    } else {
        primitive.triangles = corners < 3 ? 0 : corners - 2;
        left_over = corners < 3 ? corners : 0;
    }
    if (left_over > 0) {
        tally.add("the last vertices make no whole triangle and are left out",
                  primitive.place().text());
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
            Primitive primitive;
            primitive.mesh = m;
            primitive.number = p;
            primitive.mode = source.mode;
            primitive.material = source.material;
            auto position = source.attributes.find("POSITION");
            if (primitive.mode >= 4 && position != source.attributes.end()) {
                primitive.positions = accessors.reader(static_cast<std::size_t>(position->second));
                auto normal = source.attributes.find("NORMAL");
                if (normal != source.attributes.end()) {
                    primitive.has_normals = true;
                    primitive.normals = accessors.reader(static_cast<std::size_t>(normal->second));
                }
                open_attributes(source, model, accessors, primitive);
                open_indices(source, accessors, primitive);
                open_targets(source, accessors, primitive, tally);
                open_influences(source, accessors, primitive);
                count_triangles(primitive, tally);
            }
            result.all.push_back(std::move(primitive));
        }
    }
    result.first.push_back(result.all.size());
    return result;
}

} // namespace glint
