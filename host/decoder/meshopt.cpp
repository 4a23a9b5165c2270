// Unpacks views packed by meshoptimizer. See meshopt.hpp.
//
// The library knows the ends of input and output, and fuzzing
// with guard pages found no access beyond them. The decoder allocates nothing that the packed bytes
// cannot hold: the format needs a bit for eight bytes of a vertex, or a byte for an index or a
// triangle.
#include "decoder/meshopt.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <meshoptimizer.h>
#include <tuple>

namespace glint
{

namespace
{

constexpr std::array<const char *, 2> extension_names = {"EXT_meshopt_compression",
                                                         "KHR_meshopt_compression"};
// The most bytes per packed byte: 2 bits can say that 16 bytes repeat the bytes before.
constexpr std::uint64_t most_bytes_each = 64;

struct Extension {
    const json *object; // NULL: none
    Place place;
};

Extension find_extension(const json &holder, const Place &place)
{
    for (const char *name : extension_names) {
        const json *found = extension_of(holder, place, name);
        if (found != nullptr) {
            return {found, place / "extensions" / name};
        }
    }
    return {nullptr, place};
}

// Returns the place in `names` of the word under `key`; if it is missing, of `fallback`.
template <typename Code, std::size_t N>
Code word_at(const Extension &extension, const char *key, const char *fallback,
             const std::array<const char *, N> &names)
{
    const json *value = member(*extension.object, key);
    if (value == nullptr && fallback == nullptr) {
        refuse(extension.place / key, "missing (the extension requires it)");
    }
    const std::string word = value != nullptr ? text_of(*value, extension.place / key) : fallback;
    std::string known;
    for (std::size_t i = 0; i < N; i++) {
        if (word == names[i]) {
            return static_cast<Code>(i);
        }
        known += (i == 0 ? "" : ", ") + std::string(names[i]);
    }
    refuse(extension.place / key, in_quotes(word) + " is not read (" + known + " are)");
}

void check_stride(const PackedView &packed, const Place &place)
{
    const std::uint64_t stride = packed.stride;
    const bool is_vertex = packed.mode == PackedMode::attributes;
    if (is_vertex ? stride % 4 != 0 : stride != 2 && stride != 4) {
        refuse(place / "byteStride",
               std::to_string(stride) +
                   (is_vertex ? " is not a multiple of 4" : " is no size of an index (2 or 4)"));
    }
    const PackedFilter filter = packed.filter;
    if (filter != PackedFilter::none && !is_vertex) {
        refuse(place / "filter", "indices have no filter (leave it out)");
    }
    const bool fits = filter == PackedFilter::octahedral   ? stride == 4 || stride == 8
                      : filter == PackedFilter::quaternion ? stride == 8
                                                           : true;
    if (!fits) {
        refuse(place / "byteStride", std::to_string(stride) +
                                         " does not go with the filter (OCTAHEDRAL has 4 or 8, "
                                         "QUATERNION 8)");
    }
}

// Checks the range of the packed bytes in their buffer.
void check_source(const json &root, const Extension &extension, PackedView &packed)
{
    const json &buffers = objects_of(root, "buffers");
    const json *index = member(*extension.object, "buffer");
    if (index == nullptr) {
        refuse(extension.place / "buffer", "missing (the extension requires it)");
    }
    packed.buffer = index_of(*index, extension.place / "buffer", buffers.size(), "buffer");
    packed.length = whole_at(*extension.object, extension.place, "byteLength", 1, largest_whole);
    packed.offset =
        optional_whole(*extension.object, extension.place, "byteOffset", 0, largest_whole);
    const auto there = buffers[packed.buffer]["byteLength"].get<std::uint64_t>();
    if (packed.offset > there || packed.length > there - packed.offset) {
        refuse(extension.place / "byteLength",
               counted(packed.length, "byte") + " from byte " + std::to_string(packed.offset) +
                   " run past the end of buffers[" + std::to_string(packed.buffer) +
                   "], which has " + counted(there, "byte") + " (the file is damaged)");
    }
}

// Checks that the view's own size matches the unpacked data.
void check_target(const PackedView &packed, const tinygltf::BufferView &view,
                  const Extension &extension)
{
    if (view.byteStride != 0 && view.byteStride != packed.stride) {
        refuse(extension.place / "byteStride",
               std::to_string(packed.stride) + " is not the view's own byteStride, " +
                   std::to_string(view.byteStride) + " (the file is damaged)");
    }
    if (packed.count * packed.stride != view.byteLength) { // below 2^53 · 2^8: no overflow
        refuse(extension.place / "count",
               counted(packed.count, "element") + " of " + counted(packed.stride, "byte") +
                   " are not the view's byteLength, " + std::to_string(view.byteLength) +
                   " (the file is damaged)");
    }
}

Place place_of(const PackedView &packed)
{
    return (Place() / "bufferViews")[packed.view];
}

// ---- Unpacking ----------------------------------------------------------------------------------

// The least number of packed bytes for the elements.
std::uint64_t least_bytes(const PackedView &packed)
{
    switch (packed.mode) {
    case PackedMode::attributes: {
        // Elements come in blocks. A block holds, for each byte of an element, two bits per 16
        // elements, in whole bytes. A tail holds the first element, in at least 32 bytes.
        const std::uint64_t block = std::min<std::uint64_t>(8192 / packed.stride / 16 * 16, 256);
        const auto headers = [](std::uint64_t elements) { return (elements + 63) / 64; };
        return 1 +
               packed.stride *
                   (packed.count / block * headers(block) + headers(packed.count % block)) +
               std::max<std::uint64_t>(packed.stride, 32);
    }
    case PackedMode::triangles:
        return 1 + packed.count / 3 + 16; // a code per triangle, and a table
    default:
        return 1 + packed.count + 4; // at least a byte per index, and a tail
    }
}

// True for the versions of the formats that the library reads.
bool is_known_header(PackedMode mode, unsigned char header)
{
    switch (mode) {
    case PackedMode::attributes:
        return header == 0xA0;
    case PackedMode::triangles:
        return header == 0xE0 || header == 0xE1;
    default:
        return header == 0xD0 || header == 0xD1;
    }
}

void check_packed_bytes(const PackedView &packed, const unsigned char *bytes)
{
    if (!is_known_header(packed.mode, bytes[0])) {
        refuse(place_of(packed), "the packed bytes begin with " + std::to_string(bytes[0]) +
                                     ", which is no format that is read (export with "
                                     "EXT_meshopt_compression, or without)");
    }
    if (packed.length < least_bytes(packed)) {
        refuse(place_of(packed), counted(packed.count, "element") + " of " +
                                     counted(packed.stride, "byte") + " cannot stand in " +
                                     counted(packed.length, "packed byte") +
                                     " (the file is damaged)");
    }
}

void unpack(const PackedView &packed, const unsigned char *from, unsigned char *to)
{
    int fault = 0;
    switch (packed.mode) {
    case PackedMode::attributes:
        fault = meshopt_decodeVertexBuffer(to, packed.count, packed.stride, from, packed.length);
        break;
    case PackedMode::triangles:
        fault = meshopt_decodeIndexBuffer(to, packed.count, packed.stride, from, packed.length);
        break;
    case PackedMode::indices:
        fault = meshopt_decodeIndexSequence(to, packed.count, packed.stride, from, packed.length);
        break;
    }
    if (fault != 0) {
        refuse(place_of(packed), "the packed bytes cannot be unpacked (the file is damaged: export "
                                 "it again)");
    }
    switch (packed.filter) {
    case PackedFilter::none:
        break;
    case PackedFilter::octahedral:
        meshopt_decodeFilterOct(to, packed.count, packed.stride);
        break;
    case PackedFilter::quaternion:
        meshopt_decodeFilterQuat(to, packed.count, packed.stride);
        break;
    case PackedFilter::exponential:
        meshopt_decodeFilterExp(to, packed.count, packed.stride);
        break;
    }
}

// Checks the total size. Views may share packed bytes, but a small file must not fill the memory.
void check_total(const Model &model, std::uint64_t unpacked, std::uint64_t left)
{
    const std::uint64_t there = buffer_bytes(model);
    if (unpacked / most_bytes_each > there) {
        refuse(Place() / "bufferViews", counted(unpacked, "unpacked byte") + " cannot stand in " +
                                            counted(there, "byte") +
                                            " (packed views overlap: the "
                                            "file is damaged)");
    }
    if (unpacked > left) {
        throw shortage("its packed views take " + counted(unpacked, "byte") + ", and " +
                       counted(left, "byte") + " of memory are free (split the scene)");
    }
}

} // namespace

bool is_fallback(const json &buffer, const Place &place)
{
    const Extension extension = find_extension(buffer, place);
    return extension.object != nullptr &&
           optional_boolean(*extension.object, extension.place, "fallback", false);
}

void check_packed_view(const json &root, std::size_t index, Model &model)
{
    const Place place = (Place() / "bufferViews")[index];
    const Extension extension = find_extension(objects_of(root, "bufferViews")[index], place);
    if (extension.object == nullptr) {
        return;
    }
    PackedView packed;
    packed.view = index;
    check_source(root, extension, packed);
    packed.stride = whole_at(*extension.object, extension.place, "byteStride", 2, 256);
    packed.count = whole_at(*extension.object, extension.place, "count", 1, largest_whole);
    packed.mode =
        word_at<PackedMode, 3>(extension, "mode", nullptr, {"ATTRIBUTES", "TRIANGLES", "INDICES"});
    packed.filter = word_at<PackedFilter, 4>(extension, "filter", "NONE",
                                             {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"});
    check_stride(packed, extension.place);
    if (packed.mode == PackedMode::triangles && packed.count % 3 != 0) {
        refuse(extension.place / "count",
               std::to_string(packed.count) + " indices are no whole triangles");
    }
    check_target(packed, model.bufferViews[index], extension);
    model.packed.push_back(packed);
}

void unpack_views(const Limits &limits, Writer &writer, Model &model)
{
    // Unpack equal packed views only once.
    using Key = std::tuple<std::size_t, std::uint64_t, std::uint64_t, std::uint64_t, std::uint64_t,
                           PackedMode, PackedFilter>;
    std::map<Key, std::vector<std::size_t>> views;
    std::uint64_t unpacked = 0;
    for (std::size_t i = 0; i < model.packed.size(); i++) {
        const PackedView &one = model.packed[i];
        check_packed_bytes(one, model.buffer(one.buffer) + one.offset);
        std::vector<std::size_t> &same = views[{one.buffer, one.offset, one.length, one.stride,
                                                one.count, one.mode, one.filter}];
        // No overflow: the first is limited, the second within most_bytes_each of a length; neither
        // exceeds 2^61.
        unpacked = std::min(unpacked, largest_whole) + (same.empty() ? one.count * one.stride : 0);
        same.push_back(i);
    }
    check_total(model, unpacked, limits.free_bytes());
    for (const auto &entry : views) {
        const PackedView &one = model.packed[entry.second[0]];
        const Stored bytes = writer.allocate(one.count * one.stride);
        unpack(one, model.buffer(one.buffer) + one.offset, bytes.data);
        model.bytes.push_back(bytes);
        for (const std::size_t i : entry.second) {
            tinygltf::BufferView &view = model.bufferViews[model.packed[i].view];
            view.buffer = static_cast<int>(model.bytes.size() - 1);
            view.byteOffset = 0;
        }
    }
}

} // namespace glint
