// Decodes primitives packed by Draco. See gltf_draco.hpp.
//
// The accessors define the contents of a view. So glint lays out the results, and the decoder fills
// them in. No count in Draco's data makes glint allocate memory.
#include "scene/gltf_draco.hpp"

#include "base/free_memory.h"
#include "base/whole_io.h"
#include "image/decoder.h"
#include "image/mesh_decoding.h"
#include "scene/gltf_accessor.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <map>
#include <sys/mman.h>
#include <unistd.h>

namespace glint
{

namespace
{

constexpr const char *extension_name = "KHR_draco_mesh_compression";

// ---- Limits (SECURITY.md) -----------------------------------------------------------------------

constexpr std::uint64_t mib = std::uint64_t{1} << 20;
// Meshes take 10 to 50 bytes per byte of Draco's data. Only flat grids exceed 256.
constexpr std::uint64_t result_bytes_least = 256 * mib;
constexpr std::uint64_t result_bytes_each = 256;
// During decoding Draco holds tables of corners and two copies of each attribute.
constexpr std::uint64_t memory_bytes = 128 * mib;
constexpr std::uint64_t memory_each_index = 96;
constexpr std::uint64_t memory_each_result = 6;
// The slowest decoding yields 4 MiB of results per second.
constexpr std::uint64_t cpu_seconds_least = 5;
constexpr std::uint64_t results_a_second = 4 * mib;
constexpr std::uint64_t seconds_least = 60;
constexpr std::uint64_t seconds_each = 20; // per second of CPU time

std::uint64_t cpu_seconds_of(std::uint64_t result_bytes)
{
    return cpu_seconds_least + result_bytes / results_a_second;
}

std::uint64_t seconds_of(std::uint64_t result_bytes)
{
    return seconds_least + seconds_each * cpu_seconds_of(result_bytes);
}

// ---- Jobs ---------------------------------------------------------------------------------------

// A packed view, and the results that its primitives need.
struct Packed {
    std::size_t view = 0;
    glint_mesh_job job = {};
    std::uint64_t result_bytes = 0; // from result_offset to the end of the memory file
    std::uint64_t result_offset = 0;
    std::vector<std::size_t> users; // indices into model.draco
};

tinygltf::Primitive &primitive_of(Model &model, const DracoPrimitive &one)
{
    return model.meshes[one.mesh].primitives[one.number];
}

Place place_of(const DracoPrimitive &one)
{
    return ((Place() / "meshes")[one.mesh] / "primitives")[one.number] / "extensions" /
           extension_name;
}

std::uint64_t size_of(const tinygltf::Accessor &accessor)
{
    const int bytes =
        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType));
    const int count = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    return static_cast<std::uint64_t>(bytes) * static_cast<std::uint64_t>(count);
}

// Returns the job's attribute that fits, or −1.
int find_attribute(const glint_mesh_job &job, std::uint32_t id, const tinygltf::Accessor &accessor)
{
    const int components =
        tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    for (int i = 0; i < job.attribute_count; i++) {
        const glint_mesh_attribute &one = job.attributes[i];
        if (one.id == id && one.component_type == accessor.componentType &&
            one.components == components) {
            return i;
        }
    }
    return -1;
}

// Reserves bytes at the end of the results; refuses more than any memory holds.
std::uint64_t reserve(Packed &packed, std::uint64_t count, std::uint64_t size, const Place &place)
{
    const std::uint64_t offset = packed.result_bytes;
    if (count > largest_whole / size || offset > largest_whole - count * size) {
        refuse(place, counted(count, "element") + " cannot be packed (the file is damaged)");
    }
    packed.result_bytes += (count * size + 7) / 8 * 8;
    return offset;
}

void add_attributes(Model &model, const DracoPrimitive &one, Packed &packed)
{
    const tinygltf::Primitive &primitive = primitive_of(model, one);
    for (const auto &[name, id] : one.attributes) {
        const auto index = static_cast<std::size_t>(primitive.attributes.at(name));
        const tinygltf::Accessor &accessor = model.accessors[index];
        if (accessor.count != packed.job.vertex_count) {
            refuse(place_of(one),
                   "an accessor of " + counted(accessor.count, "element") +
                       ", and another of bufferViews[" + std::to_string(packed.view) + "] has " +
                       std::to_string(packed.job.vertex_count) + " (the file is damaged)");
        }
        if (find_attribute(packed.job, id, accessor) >= 0) {
            continue;
        }
        if (packed.job.attribute_count == GLINT_MESH_ATTRIBUTES_MAX) {
            refuse(place_of(one), "more than " + std::to_string(GLINT_MESH_ATTRIBUTES_MAX) +
                                      " attributes of one view (leave some out)");
        }
        packed.job.attributes[packed.job.attribute_count++] = {
            id, accessor.componentType,
            tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)),
            reserve(packed, accessor.count, size_of(accessor), place_of(one))};
    }
}

void add_user(Model &model, std::size_t user, Packed &packed)
{
    const DracoPrimitive &one = model.draco[user];
    const tinygltf::Primitive &primitive = primitive_of(model, one);
    const auto vertices =
        model.accessors[static_cast<std::size_t>(primitive.attributes.at(one.attributes[0].first))]
            .count;
    const std::uint64_t corners =
        model.accessors[static_cast<std::size_t>(primitive.indices)].count;
    // A strip of n corners has at most n − 2 triangles, and Draco lists triangles.
    const bool is_strip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
    const std::uint64_t room = is_strip ? 3 * (std::max<std::uint64_t>(corners, 2) - 2) : corners;
    if (packed.users.empty()) {
        packed.view = one.view;
        packed.job.vertex_count = vertices;
        packed.job.index_room = room;
        packed.job.is_exact = !is_strip;
        packed.job.index_offset = reserve(packed, room, sizeof(std::uint32_t), place_of(one));
    } else if (room != packed.job.index_room || packed.job.is_exact == is_strip) {
        refuse(place_of(one), counted(corners, "corner") +
                                  ", and another primitive has another number of bufferViews[" +
                                  std::to_string(one.view) + "] (the file is damaged)");
    }
    add_attributes(model, one, packed);
    packed.users.push_back(user);
}

// Checks the total size before any memory is allocated.
void check_total(const Model &model, const std::vector<Packed> &all)
{
    const std::uint64_t there = buffer_bytes(model); // counts once the bytes of views that overlap
    std::uint64_t results = 0;
    for (const Packed &one : all) {
        results = std::min(results + one.result_bytes, largest_whole); // no overflow
    }
    const std::uint64_t most =
        std::max(result_bytes_least, std::min(there, largest_whole >> 9) * result_bytes_each);
    if (results > most) {
        refuse(Place() / "accessors", "Draco's data would take " + counted(results, "byte") +
                                          ", and " + counted(there, "packed byte") + " may take " +
                                          std::to_string(most) +
                                          " (the file is damaged; or export it without Draco)");
    }
    const std::uint64_t left = glint_free_memory();
    if (results * 2 > left) { // the memory file and the buffers
        throw shortage("its packed meshes take " + counted(results * 2, "byte") + ", and " +
                       counted(left, "byte") + " of memory are free (split the scene)");
    }
}

// ---- Decoding -----------------------------------------------------------------------------------

class MemoryFile
{
  public:
    MemoryFile() : file_(memfd_create("glint mesh", MFD_CLOEXEC))
    {
        if (file_ < 0) {
            throw shortage(std::string("no memory file to decode into: ") + std::strerror(errno) +
                           " (try again)");
        }
    }
    MemoryFile(const MemoryFile &) = delete;
    MemoryFile &operator=(const MemoryFile &) = delete;
    ~MemoryFile()
    {
        close(file_);
    }
    int descriptor() const
    {
        return file_;
    }
    void write(std::uint64_t offset, const void *bytes, std::size_t count) const
    {
        if (!glint_write_all_at(file_, offset, bytes, count)) {
            throw shortage(std::string("a memory file cannot be written: ") + std::strerror(errno));
        }
    }

  private:
    int file_;
};

[[noreturn]] void pass_on(const glint_error &error)
{
    if (error.code == GLINT_OUT_OF_MEMORY) {
        throw shortage(error.message);
    }
    throw refusal(error.message);
}

// Writes the job and the packed bytes, and reserves room for the results.
void lay_out(const Model &model, Packed &packed, const MemoryFile &file)
{
    glint_mesh_job &job = packed.job;
    job.packed_offset = sizeof job;
    job.packed_bytes = model.bufferViews[packed.view].byteLength;
    packed.result_offset = (job.packed_offset + job.packed_bytes + 7) / 8 * 8;
    glint_mesh_job placed = job;
    placed.index_offset += packed.result_offset;
    for (int i = 0; i < placed.attribute_count; i++) {
        placed.attributes[i].offset += packed.result_offset;
    }
    file.write(0, &placed, sizeof placed);
    file.write(job.packed_offset, view_data(model, packed.view), job.packed_bytes);
    const auto size = static_cast<off_t>(packed.result_offset + packed.result_bytes);
    if (ftruncate(file.descriptor(), size) != 0) {
        throw shortage(std::string("a memory file cannot be made large enough: ") +
                       std::strerror(errno));
    }
}

// Decodes a view and returns the results. Sets job.index_room to the number of indices.
std::vector<unsigned char> decode(const Model &model, Packed &packed)
{
    const MemoryFile file;
    lay_out(model, packed, file);
    const std::string name = (Place() / "bufferViews")[packed.view].text();
    const std::uint64_t size = packed.result_offset + packed.result_bytes;
    glint_decode_limits limits = {};
    limits.picture_bytes = size;
    limits.memory_bytes = std::min(memory_bytes + size + memory_each_index * packed.job.index_room +
                                       memory_each_result * packed.result_bytes,
                                   memory_bytes + glint_free_memory());
    limits.cpu_seconds = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(cpu_seconds_of(packed.result_bytes), 86400));
    limits.seconds = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(seconds_of(packed.result_bytes), 2000000));
    std::uint64_t index_bytes = 0;
    glint_error error = {};
    if (glint_decoder_run_mesh(name.c_str(), &limits, file.descriptor(), &index_bytes, &error) !=
        GLINT_OK) {
        pass_on(error);
    }
    // The decoder may misbehave in any way, so limit its count.
    packed.job.index_room = std::min(index_bytes / sizeof(std::uint32_t), packed.job.index_room);
    std::vector<unsigned char> results(packed.result_bytes);
    const glint_stored stored = {name.c_str(), {}, results.size(), 0, file.descriptor()};
    if (glint_stored_read(&stored, packed.result_offset, results.data(), results.size(), &error) !=
        GLINT_OK) {
        pass_on(error);
    }
    return results;
}

// Adds an accessor like `like`, for the bytes from `offset` on in the last buffer.
int add_accessor(Model &model, const tinygltf::Accessor &like, std::uint64_t offset)
{
    tinygltf::BufferView &view = model.bufferViews.emplace_back();
    view.buffer = static_cast<int>(model.buffers.size() - 1);
    view.byteOffset = offset;
    view.byteLength = like.count * size_of(like);
    tinygltf::Accessor &made = model.accessors.emplace_back();
    made.bufferView = static_cast<int>(model.bufferViews.size() - 1);
    made.componentType = like.componentType;
    made.type = like.type;
    made.count = like.count;
    made.normalized = like.normalized;
    return static_cast<int>(model.accessors.size() - 1);
}

void connect(Model &model, const DracoPrimitive &one, const Packed &packed)
{
    tinygltf::Primitive &primitive = primitive_of(model, one);
    for (const auto &[name, id] : one.attributes) {
        int &index = primitive.attributes.at(name);
        const tinygltf::Accessor accessor = model.accessors[static_cast<std::size_t>(index)];
        const int found = find_attribute(packed.job, id, accessor);
        index = add_accessor(model, accessor, packed.job.attributes[found].offset);
    }
    tinygltf::Accessor indices;
    indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    indices.type = TINYGLTF_TYPE_SCALAR;
    indices.count = packed.job.index_room;
    primitive.indices = add_accessor(model, indices, packed.job.index_offset);
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
}

// ---- Checks -------------------------------------------------------------------------------------

// Marks an accessor that Draco fills. Returns true if it has no data of its own.
bool mark(Model &model, int accessor, const Place &place)
{
    const auto index = static_cast<std::size_t>(accessor);
    const tinygltf::Accessor &marked = model.accessors[index];
    if (marked.sparse.isSparse && marked.bufferView < 0) {
        refuse(place, "accessors[" + std::to_string(accessor) +
                          "] is sparse (what Draco packs cannot be)");
    }
    model.filled_accessors.insert(index);
    return marked.bufferView < 0;
}

bool add_ids(const json &attributes, const Place &place, Model &model, DracoPrimitive &one)
{
    const tinygltf::Primitive &primitive = primitive_of(model, one);
    bool is_needed = false;
    for (auto it = attributes.begin(); it != attributes.end(); ++it) {
        const Place at = place / it.key().c_str();
        const auto found = primitive.attributes.find(it.key());
        if (found == primitive.attributes.end()) {
            refuse(at, "the primitive has no such attribute (the file is damaged)");
        }
        const int type = model.accessors[static_cast<std::size_t>(found->second)].type;
        if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)) > 4 ||
            type == TINYGLTF_TYPE_MAT2) {
            refuse(at, "its accessor holds matrices (Draco packs none)");
        }
        is_needed = mark(model, found->second, at) || is_needed;
        one.attributes.emplace_back(
            it.key(), static_cast<std::uint32_t>(whole_number(it.value(), at, 0, UINT32_MAX)));
    }
    if (one.attributes.empty()) {
        refuse(place, "empty (the packed mesh needs its attributes)");
    }
    return is_needed;
}

} // namespace

void check_draco(const json &source, const Place &place, Model &model)
{
    const json *found = extension_of(source, place, extension_name);
    if (found == nullptr) {
        return;
    }
    const Place at = place / "extensions" / extension_name;
    DracoPrimitive one;
    one.mesh = model.meshes.size() - 1;
    one.number = model.meshes.back().primitives.size() - 1;
    const tinygltf::Primitive &primitive = primitive_of(model, one);
    const json *view = member(*found, "bufferView");
    if (view == nullptr) {
        refuse(at / "bufferView", "missing (the extension requires it)");
    }
    one.view = index_of(*view, at / "bufferView", model.bufferViews.size(), "bufferView");
    bool is_needed = add_ids(object_at(*found, at, "attributes"), at / "attributes", model, one);
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES &&
        primitive.mode != TINYGLTF_MODE_TRIANGLE_STRIP) {
        refuse(place / "mode", std::to_string(primitive.mode) +
                                   " cannot be packed by Draco (4, triangles, or 5, a strip)");
    }
    if (primitive.indices < 0) {
        refuse(place / "indices", "missing (Draco packs triangles by their indices)");
    }
    is_needed = mark(model, primitive.indices, place / "indices") || is_needed;
    if (is_needed || model.requires_draco) {
        model.draco.push_back(one);
    }
}

void decode_draco(Model &model)
{
    // Views of the same bytes count as one view.
    std::map<std::tuple<int, std::size_t, std::size_t>, std::size_t> by_bytes;
    std::vector<Packed> all;
    for (std::size_t i = 0; i < model.draco.size(); i++) {
        const tinygltf::BufferView &view = model.bufferViews[model.draco[i].view];
        const auto entry =
            by_bytes.try_emplace({view.buffer, view.byteOffset, view.byteLength}, all.size());
        if (entry.second) {
            all.emplace_back();
        }
        add_user(model, i, all[entry.first->second]);
    }
    // Check the total before decoding.
    check_total(model, all);
    std::uint64_t results = 0;
    for (const Packed &one : all) {
        results += one.result_bytes;
    }
    const auto begin = std::chrono::steady_clock::now();
    for (Packed &packed : all) {
        std::vector<unsigned char> bytes = decode(model, packed);
        model.buffers.emplace_back().data.swap(bytes);
        for (const std::size_t user : packed.users) {
            connect(model, model.draco[user], packed);
        }
        // Many small views, each within its limits, could take forever together.
        if (std::chrono::steady_clock::now() - begin >
            std::chrono::seconds(std::min<std::uint64_t>(seconds_of(results), 2000000))) {
            refuse(Place() / "meshes", "take more than " + std::to_string(seconds_of(results)) +
                                           " s to decode (export the file without Draco)");
        }
    }
}

} // namespace glint
