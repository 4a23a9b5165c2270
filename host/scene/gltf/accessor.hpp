// Reads elements of checked accessors.
#ifndef GLINT_SCENE_GLTF_ACCESSOR_HPP
#define GLINT_SCENE_GLTF_ACCESSOR_HPP

#include "scene/gltf/json.hpp"
#include "scene/gltf/model.hpp"

#include <cstring>

namespace glint
{

// Returns the bytes of a view whose buffer is loaded.
const unsigned char *view_data(const Model &model, std::size_t index);

// Reads an accessor's elements in place, in any order. It copies nothing, so the file's size limits
// the memory, not its counts. Zero is valid and reads zeros. The model must outlive the reader.
class Reader
{
  public:
    Reader() = default;
    // Refuses sparse indices that do not ascend or are out of range.
    Reader(const Model &model, std::size_t accessor);

    std::size_t count() const
    {
        return count_;
    }

    // Returns an element of unsigned integers.
    std::uint32_t index(std::size_t i) const
    {
        const unsigned char *bytes = element(i);
        switch (component_) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return bytes[0];
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load<std::uint16_t>(bytes, 0);
        default:
            return load<std::uint32_t>(bytes, 0);
        }
    }

    // The largest value of the indices' component type.
    std::uint32_t largest_index() const
    {
        return component_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE    ? 0xFF
               : component_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? 0xFFFF
                                                                      : 0xFFFFFFFF;
    }

    // Reads `n` components as numbers; normalised integers become [−1, 1] or [0, 1].
    void numbers(std::size_t i, std::size_t n, double *result) const
    {
        const unsigned char *bytes = element(i);
        for (std::size_t c = 0; c < n; c++) {
            result[c] = component_ == TINYGLTF_COMPONENT_TYPE_FLOAT
                            ? static_cast<double>(load<float>(bytes, c))
                            : integer(bytes, c);
        }
    }

  private:
    template <typename T>
    static T load(const unsigned char *bytes, std::size_t i)
    {
        T value;
        std::memcpy(&value, bytes + i * sizeof value, sizeof value);
        return value;
    }

    const unsigned char *element(std::size_t i) const
    {
        return sparse_count_ == 0 ? base_ + i * stride_ : sparse_element(i);
    }

    const unsigned char *sparse_element(std::size_t i) const;
    std::size_t sparse_index(std::size_t k) const;
    double integer(const unsigned char *bytes, std::size_t i) const;

    // Large enough for one element of any type. With a stride of 0 it stands for all elements.
    static const unsigned char zeros_[64];

    const unsigned char *base_ = zeros_;
    std::size_t stride_ = 0;
    std::size_t count_ = 0;
    std::size_t element_size_ = 0;
    int component_ = TINYGLTF_COMPONENT_TYPE_FLOAT;
    bool normalized_ = false;
    std::size_t sparse_count_ = 0;
    int sparse_component_ = 0;
    const unsigned char *sparse_indices_ = nullptr;
    const unsigned char *sparse_values_ = nullptr;
};

} // namespace glint

#endif
