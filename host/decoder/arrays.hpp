// Writes accessors as arrays of the document.
#ifndef GLINT_DECODER_ARRAYS_HPP
#define GLINT_DECODER_ARRAYS_HPP

#include "decoder/model.hpp"

namespace glint
{

// Returns the bytes of a view whose buffer is loaded.
const unsigned char *view_data(const Model &model, std::size_t index);

// Writes each accessor that something needs, once.
class Arrays
{
  public:
    Arrays(const Model &model, Writer &writer)
        : model_(model), writer_(writer), written_(model.accessors.size(), -1)
    {
    }

    // Returns the array of accessors[index]; −1 for −1. Refuses sparse indices that do not ascend
    // or are out of range.
    std::int32_t of(std::ptrdiff_t index);

    // Returns the array of an attribute; −1 if the primitive has none.
    std::int32_t of(const std::map<std::string, int> &attributes, const std::string &name)
    {
        const auto found = attributes.find(name);
        return found == attributes.end() ? -1 : of(static_cast<std::ptrdiff_t>(found->second));
    }

  private:
    const Model &model_;
    Writer &writer_;
    std::vector<std::int32_t> written_; // [accessor]
};

} // namespace glint

#endif
