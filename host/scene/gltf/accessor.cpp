// Reads elements of checked accessors. See accessor.hpp.
#include "scene/gltf/accessor.hpp"

#include <algorithm>

namespace glint
{

const unsigned char Reader::zeros_[64] = {};

const unsigned char *view_data(const Model &model, std::size_t index)
{
    const tinygltf::BufferView &view = model.bufferViews[index];
    return model.buffers[static_cast<std::size_t>(view.buffer)].data.data() + view.byteOffset;
}

Reader::Reader(const Model &model, std::size_t accessor_index)
{
    const tinygltf::Accessor &accessor = model.accessors[accessor_index];
    component_ = accessor.componentType;
    normalized_ = accessor.normalized;
    count_ = accessor.count;
    element_size_ = static_cast<std::size_t>(
                        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component_))) *
                    static_cast<std::size_t>(tinygltf::GetNumComponentsInType(
                        static_cast<std::uint32_t>(accessor.type)));
    if (accessor.bufferView >= 0) {
        auto view = static_cast<std::size_t>(accessor.bufferView);
        std::size_t stride = model.bufferViews[view].byteStride;
        stride_ = stride == 0 ? element_size_ : stride;
        base_ = view_data(model, view) + accessor.byteOffset;
    }
    if (!accessor.sparse.isSparse) {
        return;
    }
    // Open the sparse part, and check its indices.
    const auto &sparse = accessor.sparse;
    sparse_component_ = sparse.indices.componentType;
    sparse_indices_ = view_data(model, static_cast<std::size_t>(sparse.indices.bufferView)) +
                      sparse.indices.byteOffset;
    sparse_values_ = view_data(model, static_cast<std::size_t>(sparse.values.bufferView)) +
                     sparse.values.byteOffset;
    sparse_count_ = static_cast<std::size_t>(sparse.count);
    Place place = (Place() / "accessors")[accessor_index] / "sparse" / "indices";
    for (std::size_t k = 0; k < sparse_count_; k++) {
        std::size_t value = sparse_index(k);
        if (value >= count_) {
            refuse(place[k], std::to_string(value) + " is out of range (the accessor has " +
                                 counted(count_, "element") + ")");
        }
        if (k > 0 && value <= sparse_index(k - 1)) {
            refuse(place[k], std::to_string(value) + " follows " +
                                 std::to_string(sparse_index(k - 1)) +
                                 " (sparse indices must ascend)");
        }
    }
}

std::size_t Reader::sparse_index(std::size_t k) const
{
    switch (sparse_component_) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return sparse_indices_[k];
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return load<std::uint16_t>(sparse_indices_, k);
    default:
        return load<std::uint32_t>(sparse_indices_, k);
    }
}

const unsigned char *Reader::sparse_element(std::size_t i) const
{
    std::size_t low = 0;
    std::size_t high = sparse_count_;
    while (low < high) {
        std::size_t middle = low + (high - low) / 2;
        if (sparse_index(middle) < i) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    bool replaced = low < sparse_count_ && sparse_index(low) == i;
    return replaced ? sparse_values_ + low * element_size_ : base_ + i * stride_;
}

double Reader::integer(const unsigned char *bytes, std::size_t i) const
{
    switch (component_) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
        double value = load<std::int8_t>(bytes, i);
        return normalized_ ? std::max(value / 127, -1.0) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return normalized_ ? bytes[i] / 255.0 : bytes[i];
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
        double value = load<std::int16_t>(bytes, i);
        return normalized_ ? std::max(value / 32767, -1.0) : value;
    }
    default: {
        double value = load<std::uint16_t>(bytes, i);
        return normalized_ ? value / 65535 : value;
    }
    }
}

} // namespace glint
