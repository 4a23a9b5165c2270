// Writes accessors as arrays. See arrays.hpp.
#include "decoder/arrays.hpp"

#include "decoder/json.hpp"

#include <cstring>

namespace glint
{

namespace
{

// Returns the offset of a view's byte in the document.
std::uint64_t place_in_view(const Model &model, int view_index, std::uint64_t byte)
{
    const tinygltf::BufferView &view = model.bufferViews[static_cast<std::size_t>(view_index)];
    return model.bytes[static_cast<std::size_t>(view.buffer)].offset + view.byteOffset + byte;
}

std::uint32_t sparse_index(const unsigned char *indices, std::size_t width, std::size_t k)
{
    std::uint32_t index = 0;
    std::memcpy(&index, indices + k * width, width); // little-endian, as glTF is
    return index;
}

void write_sparse(const Model &model, std::size_t index, glint_document_array &array)
{
    const auto &sparse = model.accessors[index].sparse;
    if (!sparse.isSparse) {
        return;
    }
    array.sparse_count = static_cast<std::uint32_t>(sparse.count);
    array.sparse_type = sparse.indices.componentType;
    array.sparse_indices = place_in_view(model, sparse.indices.bufferView,
                                         static_cast<std::uint64_t>(sparse.indices.byteOffset));
    array.sparse_elements = place_in_view(model, sparse.values.bufferView,
                                          static_cast<std::uint64_t>(sparse.values.byteOffset));
    const unsigned char *indices =
        view_data(model, static_cast<std::size_t>(sparse.indices.bufferView)) +
        sparse.indices.byteOffset;
    const std::size_t width = glint_component_bytes(array.sparse_type);
    const Place place = (Place() / "accessors")[index] / "sparse" / "indices";
    for (std::size_t k = 0; k < array.sparse_count; k++) {
        const std::uint32_t value = sparse_index(indices, width, k);
        if (value >= array.count) {
            refuse(place[k], std::to_string(value) + " is out of range (the accessor has " +
                                 counted(array.count, "element") + ")");
        }
        const std::uint32_t before = k > 0 ? sparse_index(indices, width, k - 1) : 0;
        if (k > 0 && value <= before) {
            refuse(place[k], std::to_string(value) + " follows " + std::to_string(before) +
                                 " (sparse indices must ascend)");
        }
    }
}

} // namespace

const unsigned char *view_data(const Model &model, std::size_t index)
{
    const tinygltf::BufferView &view = model.bufferViews[index];
    return model.buffer(static_cast<std::size_t>(view.buffer)) + view.byteOffset;
}

std::int32_t Arrays::of(std::ptrdiff_t index)
{
    if (index < 0) {
        return -1;
    }
    const auto number = static_cast<std::size_t>(index);
    if (written_[number] >= 0) {
        return written_[number];
    }
    const tinygltf::Accessor &accessor = model_.accessors[number];
    glint_document_array array = {};
    array.accessor = static_cast<std::int32_t>(index);
    array.count = accessor.count;
    array.type = accessor.componentType;
    array.components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    array.is_normalized = accessor.normalized ? 1 : 0;
    array.stride = glint_component_bytes(array.type) * static_cast<std::uint32_t>(array.components);
    if (accessor.bufferView >= 0) {
        const std::size_t stride =
            model_.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
        array.stride = stride == 0 ? array.stride : static_cast<std::uint32_t>(stride);
        array.offset = place_in_view(model_, accessor.bufferView, accessor.byteOffset);
    }
    write_sparse(model_, number, array);
    written_[number] = writer_.add(writer_.arrays, array);
    return written_[number];
}

} // namespace glint
