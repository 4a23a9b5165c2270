// Opens checked accessors as arrays. See accessor.hpp.
#include "scene/gltf/accessor.hpp"

#include "scene/gltf/json.hpp"

namespace glint
{

namespace
{

glint_sparse open_sparse(const Model &model, std::size_t index)
{
    const tinygltf::Accessor &accessor = model.accessors[index];
    const auto &source = accessor.sparse;
    glint_sparse sparse = {};
    if (!source.isSparse) {
        return sparse;
    }
    sparse.count = static_cast<std::size_t>(source.count);
    sparse.index_type = static_cast<glint_component>(source.indices.componentType);
    sparse.indices = view_data(model, static_cast<std::size_t>(source.indices.bufferView)) +
                     source.indices.byteOffset;
    sparse.elements = view_data(model, static_cast<std::size_t>(source.values.bufferView)) +
                      source.values.byteOffset;
    const Place place = (Place() / "accessors")[index] / "sparse" / "indices";
    for (std::size_t k = 0; k < sparse.count; k++) {
        const std::size_t value = glint_sparse_index(&sparse, k);
        if (value >= accessor.count) {
            refuse(place[k], std::to_string(value) + " is out of range (the accessor has " +
                                 counted(accessor.count, "element") + ")");
        }
        const std::size_t before = k > 0 ? glint_sparse_index(&sparse, k - 1) : 0;
        if (k > 0 && value <= before) {
            refuse(place[k], std::to_string(value) + " follows " + std::to_string(before) +
                                 " (sparse indices must ascend)");
        }
    }
    return sparse;
}

} // namespace

const unsigned char *view_data(const Model &model, std::size_t index)
{
    const tinygltf::BufferView &view = model.bufferViews[index];
    return model.buffers[static_cast<std::size_t>(view.buffer)].data.data() + view.byteOffset;
}

glint_array open_array(const Model &model, std::size_t index)
{
    const tinygltf::Accessor &accessor = model.accessors[index];
    const auto size_of_component =
        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType));
    const auto components =
        tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    glint_array array = {};
    array.type = static_cast<glint_component>(accessor.componentType);
    array.normalized = accessor.normalized;
    array.count = accessor.count;
    array.element_size =
        static_cast<std::size_t>(size_of_component) * static_cast<std::size_t>(components);
    if (accessor.bufferView >= 0) {
        const auto view = static_cast<std::size_t>(accessor.bufferView);
        const std::size_t stride = model.bufferViews[view].byteStride;
        array.stride = stride == 0 ? array.element_size : stride;
        array.bytes = view_data(model, view) + accessor.byteOffset;
    }
    array.sparse = open_sparse(model, index);
    return array;
}

} // namespace glint
