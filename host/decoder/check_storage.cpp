// Validates buffers, views and accessors in the raw JSON. See check_storage.hpp.
#include "decoder/check_storage.hpp"

#include "decoder/meshopt.hpp"

#include <algorithm>
#include <array>
#include <climits>

namespace glint
{

namespace
{

void check_buffers(const json &root)
{
    const json &buffers = objects_of(root, "buffers");
    for (std::size_t i = 0; i < buffers.size(); i++) {
        Place place = (Place() / "buffers")[i];
        whole_at(buffers[i], place, "byteLength", 1, largest_whole);
        optional_text(buffers[i], place, "uri");
        is_fallback(buffers[i], place);
    }
}

tinygltf::BufferView check_view(const json &root, const json &view, const Place &place)
{
    const json &buffers = objects_of(root, "buffers");
    const std::size_t buffer = index_at(view, place, "buffer", buffers.size(), "buffer");
    std::uint64_t length = whole_at(view, place, "byteLength", 1, largest_whole);
    std::uint64_t offset = optional_whole(view, place, "byteOffset", 0, largest_whole);
    std::uint64_t there = buffers[buffer]["byteLength"].get<std::uint64_t>();
    if (offset > there || length > there - offset) { // each is below 2^53: no overflow
        refuse(place / "byteLength", counted(length, "byte") + " from byte " +
                                         std::to_string(offset) + " run past the end of buffers[" +
                                         std::to_string(buffer) + "], which has " +
                                         counted(there, "byte") + " (the file is damaged)");
    }
    // 0 means what a missing stride means, as in glTF 1.0: packed tightly.
    const json *stride_value = member(view, "byteStride");
    std::uint64_t stride =
        stride_value == nullptr ? 0 : whole_number(*stride_value, place / "byteStride", 0, 252);
    tinygltf::BufferView made;
    made.buffer = static_cast<int>(buffer);
    made.byteOffset = offset;
    made.byteLength = length;
    made.byteStride = stride;
    return made;
}

void check_views(const json &root, Model &model)
{
    const json &views = objects_of(root, "bufferViews");
    for (std::size_t i = 0; i < views.size(); i++) {
        model.bufferViews.push_back(check_view(root, views[i], (Place() / "bufferViews")[i]));
        check_packed_view(root, i, model);
    }
}

struct Type {
    const char *name;
    int code; // tinygltf's code
    std::uint64_t components;
};

constexpr std::array<Type, 7> types = {{{"SCALAR", TINYGLTF_TYPE_SCALAR, 1},
                                        {"VEC2", TINYGLTF_TYPE_VEC2, 2},
                                        {"VEC3", TINYGLTF_TYPE_VEC3, 3},
                                        {"VEC4", TINYGLTF_TYPE_VEC4, 4},
                                        {"MAT2", TINYGLTF_TYPE_MAT2, 4},
                                        {"MAT3", TINYGLTF_TYPE_MAT3, 9},
                                        {"MAT4", TINYGLTF_TYPE_MAT4, 16}}};

const char *type_name(int code)
{
    for (const Type &type : types) {
        if (type.code == code) {
            return type.name;
        }
    }
    return "nothing";
}

const Type &check_type(const json &accessor, const Place &place)
{
    const std::string name = text_at(accessor, place, "type");
    for (const Type &type : types) {
        if (name == type.name) {
            return type;
        }
    }
    refuse(place / "type",
           in_quotes(name) + " is none (SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 or MAT4)");
}

// Columns of small matrices begin at multiples of four bytes.
std::uint64_t element_size(const Type &type, std::uint64_t component)
{
    std::uint64_t size = glint_component_bytes(static_cast<std::int32_t>(component));
    if (type.code == TINYGLTF_TYPE_MAT2 || type.code == TINYGLTF_TYPE_MAT3) {
        std::uint64_t rows = type.code == TINYGLTF_TYPE_MAT2 ? 2 : 3;
        return rows * ((rows * size + 3) / 4 * 4);
    }
    return type.components * size;
}

std::uint64_t check_component_type(const json &object, const Place &place)
{
    std::uint64_t component = whole_at(object, place, "componentType", 0, INT_MAX);
    if (glint_component_bytes(static_cast<std::int32_t>(component)) == 0) {
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

void check_range(const Model &model, std::size_t view, const Place &place, const Range &range)
{
    std::uint64_t there = model.bufferViews[view].byteLength;
    // Numbers of the file are below 2^53 and strides below 256, so neither side overflows.
    bool fits = range.offset + (range.count - 1) * range.stride + range.size <= there;
    if (!fits) {
        refuse(place, counted(range.count, "element") + " of " + counted(range.size, "byte") +
                          ", " + std::to_string(range.stride) + " apart, from byte " +
                          std::to_string(range.offset) + " run past the end of bufferViews[" +
                          std::to_string(view) + "], which has " + counted(there, "byte") +
                          " (the file is damaged)");
    }
}

// Returns the view of a sparse part, and its offset in the view.
template <typename Part>
std::size_t check_sparse_view(const json &part, const Place &place, const Model &model,
                              Part &result)
{
    const std::size_t view =
        index_at(part, place, "bufferView", model.bufferViews.size(), "bufferView");
    if (model.bufferViews[view].byteStride != 0) {
        refuse(place / "bufferView", "bufferViews[" + std::to_string(view) +
                                         "] has a byteStride (sparse data is packed tightly)");
    }
    result.bufferView = static_cast<int>(view);
    // tinygltf keeps this offset in an int.
    result.byteOffset = static_cast<int>(optional_whole(part, place, "byteOffset", 0, INT_MAX));
    return view;
}

void check_sparse(const json &source, const Place &accessor_place, const Model &model,
                  std::uint64_t size, tinygltf::Accessor &accessor)
{
    const json *sparse = optional_object(source, accessor_place, "sparse");
    if (sparse == nullptr) {
        return;
    }
    Place place = accessor_place / "sparse";
    std::uint64_t count = whole_at(*sparse, place, "count", 1, INT_MAX);
    if (count > accessor.count) {
        refuse(place / "count", std::to_string(count) + " is more than the accessor's " +
                                    std::to_string(accessor.count) + " (the file is damaged)");
    }
    accessor.sparse.isSparse = true;
    accessor.sparse.count = static_cast<int>(count);
    auto &to_indices = accessor.sparse.indices;
    auto &to_values = accessor.sparse.values;
    const json &indices = object_at(*sparse, place, "indices");
    std::size_t view = check_sparse_view(indices, place / "indices", model, to_indices);
    std::uint64_t component = check_component_type(indices, place / "indices");
    if (component != 5121 && component != 5123 && component != 5125) {
        refuse(place / "indices" / "componentType", "not an unsigned integer (5121, 5123 or 5125)");
    }
    to_indices.componentType = static_cast<int>(component);
    std::uint64_t width = glint_component_bytes(static_cast<std::int32_t>(component));
    auto offset = static_cast<std::uint64_t>(to_indices.byteOffset);
    check_range(model, view, place / "indices", {offset, count, width, width});
    const json &values = object_at(*sparse, place, "values");
    view = check_sparse_view(values, place / "values", model, to_values);
    offset = static_cast<std::uint64_t>(to_values.byteOffset);
    check_range(model, view, place / "values", {offset, count, size, size});
}

void check_accessor(const json &source, const Place &place, Model &model)
{
    tinygltf::Accessor accessor;
    std::uint64_t component = check_component_type(source, place);
    accessor.componentType = static_cast<int>(component);
    const Type &type = check_type(source, place);
    accessor.type = type.code;
    accessor.count = whole_at(source, place, "count", 1, largest_whole);
    accessor.byteOffset = optional_whole(source, place, "byteOffset", 0, largest_whole);
    accessor.normalized = optional_boolean(source, place, "normalized", false);
    std::uint64_t size = element_size(type, component);
    std::ptrdiff_t view =
        optional_index(source, place, "bufferView", model.bufferViews.size(), "bufferView");
    accessor.bufferView = static_cast<int>(view);
    if (view >= 0) {
        auto at = static_cast<std::size_t>(view);
        std::uint64_t stride = model.bufferViews[at].byteStride;
        stride = stride == 0 ? size : stride;
        if (stride < size) {
            refuse(place / "bufferView", "elements of " + counted(size, "byte") +
                                             " overlap: bufferViews[" + std::to_string(view) +
                                             "].byteStride is " + std::to_string(stride));
        }
        check_range(model, at, place / "count",
                    {accessor.byteOffset, accessor.count, size, stride});
    }
    check_sparse(source, place, model, size, accessor);
    model.accessors.push_back(std::move(accessor));
}

} // namespace

bool has_format(const tinygltf::Accessor &accessor, const Format &format)
{
    const int component = accessor.componentType;
    const bool normalized = accessor.normalized;
    bool good = format.plain_float && component == 5126;
    good =
        good || (format.normalized_ints && normalized && (component == 5120 || component == 5122));
    good = good || (format.unsigned_ints && normalized && (component == 5121 || component == 5123));
    good = good || (format.quantized && component >= 5120 && component <= 5123);
    return good && accessor.type == format.type;
}

void check_format(const tinygltf::Accessor &accessor, const Place &place, const Format &format)
{
    if (!has_format(accessor, format)) {
        const int component = accessor.componentType;
        std::string wanted = std::string(type_name(format.type)) + " of floats (5126)";
        if (format.normalized_ints || format.quantized || format.unsigned_ints) {
            wanted += ", bytes or shorts";
        }
        refuse(place, "the accessor holds " + std::string(type_name(accessor.type)) +
                          " of component type " + std::to_string(component) +
                          (accessor.normalized ? ", normalized" : "") + " (it must be " + wanted +
                          ")");
    }
}

void check_zeros(const Model &model)
{
    for (std::size_t i = 0; i < model.accessors.size(); i++) {
        const tinygltf::Accessor &accessor = model.accessors[i];
        if (accessor.bufferView < 0 && accessor.count > GLINT_ZEROS_MAX &&
            model.filled_accessors.count(i) == 0) {
            refuse((Place() / "accessors")[i] / "count",
                   std::to_string(accessor.count) +
                       " zeros: an accessor without a bufferView holds nothing else (give it a "
                       "bufferView)");
        }
    }
}

void check_storage(const json &root, Model &model)
{
    check_buffers(root);
    check_views(root, model);
    const json &accessors = objects_of(root, "accessors");
    model.accessors.reserve(accessors.size()); // they are large
    for (std::size_t i = 0; i < accessors.size(); i++) {
        check_accessor(accessors[i], (Place() / "accessors")[i], model);
    }
}

} // namespace glint
