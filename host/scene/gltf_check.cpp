// Validation of the raw JSON: the top level, buffers, views and accessors. See gltf_check.hpp.
#include "scene/gltf_check.hpp"

#include "scene/gltf_animation.hpp"

#include "scene/gltf_material.hpp"
#include "scene/gltf_uri.hpp"

#include <algorithm>
#include <array>
#include <climits>
#include <cstring>

namespace glint
{

namespace
{

constexpr std::uint64_t largest_total = std::uint64_t{8} << 30; // bytes of all buffers
// An accessor without data is all zeros, whatever its count says.
constexpr std::uint64_t most_zeros = std::uint64_t{1} << 24;

const std::array<const char *, 8> supported_extensions = {
    "KHR_materials_transmission",      "KHR_materials_ior",       "KHR_materials_volume",
    "KHR_materials_emissive_strength", "KHR_materials_unlit",
    "KHR_texture_transform", // textures are not modelled, so neither is this wrong
    "KHR_mesh_quantization",           "EXT_mesh_gpu_instancing",
};

// "2.0" has a major number of 2. Anything else that begins otherwise is another format.
void check_version(const json &asset, const Place &place, const char *key)
{
    std::string version = optional_text(asset, place, key);
    if (!version.empty() && version.compare(0, 2, "2.") != 0) {
        refuse(place / key,
               in_quotes(version) + " is not supported (convert the file to glTF 2.0)");
    }
}

void check_asset(const json &root)
{
    const json *asset = member(root, "asset");
    if (asset == nullptr) {
        refuse(Place() / "asset", "missing (every glTF 2.0 file has one: is this another format?)");
    }
    Place place = Place() / "asset";
    const json &object = object_at(root, Place(), "asset");
    if (member(object, "version") == nullptr) {
        refuse(place / "version", "missing (it must say \"2.0\")");
    }
    check_version(object, place, "version");
    check_version(object, place, "minVersion");
}

void check_extensions(const json &root, Checked &checked)
{
    Place required = Place() / "extensionsRequired";
    const json &array = optional_array(root, Place(), "extensionsRequired");
    for (std::size_t i = 0; i < array.size(); i++) {
        std::string name = text_of(array[i], required[i]);
        bool known = std::any_of(supported_extensions.begin(), supported_extensions.end(),
                                 [&](const char *one) { return name == one; });
        if (!known) {
            refuse(required[i], in_quotes(name) +
                                    " is required by the file and not supported (export "
                                    "the file without it)");
        }
        checked.quantized = checked.quantized || name == "KHR_mesh_quantization";
    }
    const json &used = optional_array(root, Place(), "extensionsUsed");
    for (std::size_t i = 0; i < used.size(); i++) {
        std::string name = text_of(used[i], (Place() / "extensionsUsed")[i]);
        checked.quantized = checked.quantized || name == "KHR_mesh_quantization";
    }
}

void check_buffers(const Document &document)
{
    const json &buffers = objects_of(document.root, "buffers");
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < buffers.size(); i++) {
        Place place = (Place() / "buffers")[i];
        std::uint64_t length = whole_at(buffers[i], place, "byteLength", 1, largest_whole);
        total += std::min(length, largest_total + 1); // so the sum cannot overflow
        if (total > largest_total) {
            refuse(place / "byteLength", "the buffers have more than 8 GiB together (split the "
                                         "scene)");
        }
        const json *uri = member(buffers[i], "uri");
        if (uri != nullptr) {
            text_of(*uri, place / "uri");
        } else if (!document.has_bin) {
            refuse(place / "uri", "missing (only a .glb with a BIN chunk can leave it out)");
        } else if (i > 0) {
            refuse(place / "uri", "missing (only buffers[0] can be the BIN chunk)");
        }
    }
}

void check_views(const json &root)
{
    const json &buffers = objects_of(root, "buffers");
    const json &views = objects_of(root, "bufferViews");
    for (std::size_t i = 0; i < views.size(); i++) {
        Place place = (Place() / "bufferViews")[i];
        const json &view = views[i];
        const json *index = member(view, "buffer");
        if (index == nullptr) {
            refuse(place / "buffer", "missing (glTF 2.0 requires it)");
        }
        std::size_t buffer = index_of(*index, place / "buffer", buffers.size(), "buffer");
        std::uint64_t length = whole_at(view, place, "byteLength", 1, largest_whole);
        std::uint64_t offset = optional_whole(view, place, "byteOffset", 0, largest_whole);
        std::uint64_t there = buffers[buffer]["byteLength"].get<std::uint64_t>();
        if (offset > there || length > there - offset) { // each < 2^53: no overflow
            refuse(place / "byteLength",
                   counted(length, "byte") + " from byte " + std::to_string(offset) +
                       " run past the end of buffers[" + std::to_string(buffer) + "], which has " +
                       counted(there, "byte") + " (the file is damaged)");
        }
        const json *stride = member(view, "byteStride");
        if (stride != nullptr && whole_number(*stride, place / "byteStride", 4, 252) % 4 != 0) {
            refuse(place / "byteStride", "not a multiple of 4 (glTF 2.0 requires it)");
        }
    }
}

std::uint64_t component_count(const std::string &type)
{
    static const std::array<std::pair<const char *, std::uint64_t>, 7> types = {{{"SCALAR", 1},
                                                                                 {"VEC2", 2},
                                                                                 {"VEC3", 3},
                                                                                 {"VEC4", 4},
                                                                                 {"MAT2", 4},
                                                                                 {"MAT3", 9},
                                                                                 {"MAT4", 16}}};
    for (const auto &known : types) {
        if (type == known.first) {
            return known.second;
        }
    }
    return 0;
}

// Columns of small matrices begin at multiples of four bytes.
std::uint64_t element_size(const std::string &type, std::uint64_t component)
{
    std::uint64_t size = component_size(component);
    if (type == "MAT2" || type == "MAT3") {
        std::uint64_t rows = type == "MAT2" ? 2 : 3;
        return rows * ((rows * size + 3) / 4 * 4);
    }
    return component_count(type) * size;
}

std::uint64_t check_component_type(const json &object, const Place &place)
{
    std::uint64_t component = whole_at(object, place, "componentType", 0, INT_MAX);
    if (component_size(component) == 0) {
        refuse(place / "componentType",
               std::to_string(component) +
                   " is none (5120 to 5123, 5125 or 5126: byte, unsigned byte, short, unsigned "
                   "short, unsigned int, float)");
    }
    return component;
}

// `count` elements of `size` bytes, `stride` apart, from `offset` of the view on.
struct Range {
    std::uint64_t offset, count, size, stride;
};

void check_range(const json &views, std::size_t view, const Place &place, const Range &range)
{
    std::uint64_t there = views[view]["byteLength"].get<std::uint64_t>();
    // Numbers of the file are below 2^53 and strides below 256: neither side can overflow.
    bool fits = range.offset + (range.count - 1) * range.stride + range.size <= there;
    if (!fits) {
        refuse(place, counted(range.count, "element") + " of " + counted(range.size, "byte") +
                          ", " + std::to_string(range.stride) + " apart, from byte " +
                          std::to_string(range.offset) + " run past the end of bufferViews[" +
                          std::to_string(view) + "], which has " + counted(there, "byte") +
                          " (the file is damaged)");
    }
}

// The sparse part's view: its index, and the offset within it.
std::size_t check_sparse_view(const json &part, const Place &place, const json &views,
                              std::uint64_t &offset)
{
    const json *index = member(part, "bufferView");
    if (index == nullptr) {
        refuse(place / "bufferView", "missing (glTF 2.0 requires it)");
    }
    std::size_t view = index_of(*index, place / "bufferView", views.size(), "bufferView");
    if (member(views[view], "byteStride") != nullptr) {
        refuse(place / "bufferView", "bufferViews[" + std::to_string(view) +
                                         "] has a byteStride (sparse data is packed tightly)");
    }
    // tinygltf keeps this offset in an int.
    offset = optional_whole(part, place, "byteOffset", 0, INT_MAX);
    return view;
}

void check_sparse(const json &accessor, const Place &accessor_place, const json &views,
                  std::uint64_t size)
{
    const json *sparse = optional_object(accessor, accessor_place, "sparse");
    if (sparse == nullptr) {
        return;
    }
    Place place = accessor_place / "sparse";
    std::uint64_t all = accessor["count"].get<std::uint64_t>();
    std::uint64_t count = whole_at(*sparse, place, "count", 1, INT_MAX);
    if (count > all) {
        refuse(place / "count", std::to_string(count) + " is more than the accessor's " +
                                    std::to_string(all) + " (the file is damaged)");
    }
    std::uint64_t offset = 0;
    const json &indices = object_at(*sparse, place, "indices");
    std::size_t view = check_sparse_view(indices, place / "indices", views, offset);
    std::uint64_t component = check_component_type(indices, place / "indices");
    if (component != 5121 && component != 5123 && component != 5125) {
        refuse(place / "indices" / "componentType", "not an unsigned integer (5121, 5123 or 5125)");
    }
    std::uint64_t width = component_size(component);
    check_range(views, view, place / "indices", {offset, count, width, width});
    const json &values = object_at(*sparse, place, "values");
    view = check_sparse_view(values, place / "values", views, offset);
    check_range(views, view, place / "values", {offset, count, size, size});
}

void check_accessor(const json &accessor, const Place &place, const json &views)
{
    std::uint64_t component = check_component_type(accessor, place);
    const json *type_value = member(accessor, "type");
    if (type_value == nullptr) {
        refuse(place / "type", "missing (glTF 2.0 requires it)");
    }
    std::string type = text_of(*type_value, place / "type");
    if (component_count(type) == 0) {
        refuse(place / "type",
               in_quotes(type) + " is none (SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 or MAT4)");
    }
    std::uint64_t count = whole_at(accessor, place, "count", 1, largest_whole);
    std::uint64_t offset = optional_whole(accessor, place, "byteOffset", 0, largest_whole);
    optional_boolean(accessor, place, "normalized", false);
    std::uint64_t size = element_size(type, component);
    std::ptrdiff_t view = optional_index(accessor, place, "bufferView", views.size(), "bufferView");
    if (view >= 0) {
        const json *stride_value = member(views[static_cast<std::size_t>(view)], "byteStride");
        std::uint64_t stride = stride_value == nullptr ? size : stride_value->get<std::uint64_t>();
        if (stride < size) {
            refuse(place / "bufferView", "elements of " + counted(size, "byte") +
                                             " overlap: bufferViews[" + std::to_string(view) +
                                             "].byteStride is " + std::to_string(stride));
        }
        check_range(views, static_cast<std::size_t>(view), place / "count",
                    {offset, count, size, stride});
    } else if (count > most_zeros) {
        refuse(place / "count", std::to_string(count) +
                                    " zeros: an accessor without a bufferView holds nothing else "
                                    "(give it a bufferView)");
    }
    check_sparse(accessor, place, views, size);
}

void check_images(const Document &document)
{
    const json &root = document.root;
    const json &images = objects_of(root, "images");
    std::size_t views = objects_of(root, "bufferViews").size();
    for (std::size_t i = 0; i < images.size(); i++) {
        Place place = (Place() / "images")[i];
        const json *uri = member(images[i], "uri");
        std::ptrdiff_t view = optional_index(images[i], place, "bufferView", views, "bufferView");
        if (uri != nullptr) {
            check_uri(document, text_of(*uri, place / "uri"), place / "uri");
        } else if (view < 0 && optional_object(images[i], place, "extensions") == nullptr) {
            refuse(place, "neither a uri nor a bufferView (an image needs one)");
        }
    }
    const json &textures = objects_of(root, "textures");
    std::size_t samplers = objects_of(root, "samplers").size();
    for (std::size_t i = 0; i < textures.size(); i++) {
        Place place = (Place() / "textures")[i];
        optional_index(textures[i], place, "source", images.size(), "image");
        optional_index(textures[i], place, "sampler", samplers, "sampler");
    }
}

} // namespace

std::uint64_t component_size(std::uint64_t component_type)
{
    switch (component_type) {
    case 5120:
    case 5121:
        return 1;
    case 5122:
    case 5123:
        return 2;
    case 5125:
    case 5126:
        return 4;
    default:
        return 0;
    }
}

void check_storage(const Document &document)
{
    check_buffers(document);
    check_views(document.root);
    const json &views = objects_of(document.root, "bufferViews");
    const json &accessors = objects_of(document.root, "accessors");
    for (std::size_t i = 0; i < accessors.size(); i++) {
        check_accessor(accessors[i], (Place() / "accessors")[i], views);
    }
}

void check_document(const Document &document, Checked &checked)
{
    check_asset(document.root);
    // Before anything else, so that everybody can rely on it.
    for (const char *key :
         {"accessors", "animations", "buffers", "bufferViews", "cameras", "images", "materials",
          "meshes", "nodes", "samplers", "scenes", "skins", "textures"}) {
        check_objects(document.root, key);
    }
    check_extensions(document.root, checked);
    check_storage(document);
    check_images(document);
    check_materials(document.root);
    check_meshes(document.root, checked);
    check_graph(document.root, checked);
    check_animations(document.root);
}

} // namespace glint
