// Reads the buffers that the scene needs. See buffers.hpp.
#include "decoder/buffers.hpp"

#include "decoder/meshopt.hpp"
#include "decoder/texture.hpp"

#include <algorithm>
#include <map>

namespace glint
{

namespace
{

constexpr std::uint64_t largest_total = std::uint64_t{8} << 30; // most bytes of all buffers

enum class Need : char { nothing, images, shapes };

// Finds what needs each buffer.
class Needs
{
  public:
    Needs(const json &root, const Model &model) : of_(objects_of(root, "buffers").size())
    {
        // The buffer of a view's bytes: for a packed view, of the packed bytes.
        std::vector<std::size_t> buffer_of;
        for (const tinygltf::BufferView &view : model.bufferViews) {
            buffer_of.push_back(static_cast<std::size_t>(view.buffer));
        }
        for (const PackedView &packed : model.packed) {
            buffer_of[packed.view] = packed.buffer;
        }
        auto add = [&](std::ptrdiff_t view, Need need) {
            if (view >= 0 && view < static_cast<std::ptrdiff_t>(buffer_of.size())) {
                Need &of_buffer = of_[buffer_of[static_cast<std::size_t>(view)]];
                of_buffer = std::max(of_buffer, need);
            }
        };
        for (const tinygltf::Accessor &accessor : model.accessors) {
            add(accessor.bufferView, Need::shapes);
            if (accessor.sparse.isSparse) {
                add(accessor.sparse.indices.bufferView, Need::shapes);
                add(accessor.sparse.values.bufferView, Need::shapes);
            }
        }
        for (const DracoPrimitive &primitive : model.draco) {
            add(static_cast<std::ptrdiff_t>(primitive.view), Need::shapes);
        }
        // All packed views are unpacked.
        for (const PackedView &packed : model.packed) {
            of_[packed.buffer] = Need::shapes;
        }
        for (std::size_t i = 0; i < objects_of(root, "images").size(); i++) {
            try {
                add(view_of_image(root, i), Need::images);
            } catch (const refusal &) {
                continue; // who reads the image says so
            }
        }
    }

    Need of(std::size_t buffer) const
    {
        return of_[buffer];
    }

  private:
    std::vector<Need> of_;
};

// Refuses a buffer without bytes.
void expect_bytes(const SceneFile &input, std::size_t index)
{
    const json &buffer = objects_of(input.root, "buffers")[index];
    const Place place = (Place() / "buffers")[index];
    if (is_fallback(buffer, place)) {
        refuse(place, "a fallback, but not only packed views refer to it (the file is damaged)");
    }
    if (member(buffer, "uri") == nullptr && !(index == 0 && input.has_bin)) {
        refuse(place / "uri", input.has_bin
                                  ? "missing (only buffers[0] can be the BIN chunk)"
                                  : "missing (only a .glb with a BIN chunk can leave it out)");
    }
}

std::uint64_t length_of(const json &buffer)
{
    return buffer["byteLength"].get<std::uint64_t>();
}

// The buffer that stands in for others, by its file and what needs it: the longest of the file.
using StandIns = std::map<std::pair<std::string, Need>, std::size_t>;

// Returns the key of a buffer; without a text if the buffer stands for itself.
StandIns::key_type key_of(const json &buffer, Need need)
{
    const json *uri = member(buffer, "uri");
    const bool is_file = uri != nullptr && !is_data_uri(uri->get_ref<const std::string &>());
    return {is_file ? uri->get<std::string>() : "", need};
}

// Finds the stand-ins, and checks how much there is to read.
StandIns find_stand_ins(const json &buffers, const Needs &needs)
{
    StandIns longest;
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < buffers.size(); i++) {
        if (needs.of(i) == Need::nothing) {
            continue;
        }
        total += std::min(length_of(buffers[i]), largest_total + 1); // cannot overflow
        if (total > largest_total) {
            refuse((Place() / "buffers")[i] / "byteLength",
                   "the buffers have more than 8 GiB together (split the scene)");
        }
        const StandIns::key_type key = key_of(buffers[i], needs.of(i));
        std::size_t &best = longest.try_emplace(key, i).first->second;
        best = length_of(buffers[i]) > length_of(buffers[best]) ? i : best;
    }
    return longest;
}

} // namespace

void read_buffers(SceneFile &input, Writer &writer, Model &model)
{
    const json &buffers = objects_of(input.root, "buffers");
    const Needs needs(input.root, model);
    const StandIns longest = find_stand_ins(buffers, needs);
    std::vector<int> stand_in(buffers.size());
    for (std::size_t i = 0; i < buffers.size(); i++) {
        const StandIns::key_type key = key_of(buffers[i], needs.of(i));
        const auto found = key.first.empty() ? longest.end() : longest.find(key);
        stand_in[i] = static_cast<int>(found != longest.end() ? found->second : i);
    }
    model.bytes.resize(buffers.size());
    model.buffer_faults.resize(buffers.size());
    for (std::size_t i = 0; i < buffers.size(); i++) {
        if (needs.of(i) == Need::nothing || stand_in[i] != static_cast<int>(i)) {
            continue;
        }
        try {
            expect_bytes(input, i);
            model.bytes[i] = read_buffer(input, i, writer);
        } catch (const refusal &fault) {
            if (needs.of(i) == Need::shapes) {
                throw;
            }
            model.buffer_faults[i] = fault.what();
        }
    }
    for (tinygltf::BufferView &view : model.bufferViews) {
        view.buffer = stand_in[static_cast<std::size_t>(view.buffer)];
    }
    for (PackedView &packed : model.packed) {
        packed.buffer = static_cast<std::size_t>(stand_in[packed.buffer]);
    }
}

} // namespace glint
