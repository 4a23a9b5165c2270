// Decodes primitives packed by Draco. See draco.hpp.
//
// Draco's data decides how many vertices and corners a mesh has. But glint limits the results
// before it decodes, by the packed bytes and the accessors. No count in Draco's data lifts this
// limit.
#include "decoder/draco.hpp"

#include "base/free_memory.h"
#include "base/whole_io.h"
#include "decoder/arrays.hpp"
#include "image/decoder.h"
#include "image/mesh_decoding.h"

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
// Meshes take 10 to 50 bytes per byte of Draco's data. Only flat grids exceed 256. The least limit
// is for all meshes of a file together.
constexpr std::uint64_t result_bytes_least = 256 * mib;
constexpr std::uint64_t result_bytes_each = 256;
// Room for the results of one view. Where the accessors ask for more than the packed bytes would
// get, their counts may be too small by half.
constexpr std::uint64_t room_least = mib;
constexpr std::uint64_t room_each_claimed = 2;
// During decoding Draco holds tables of corners and two copies of each attribute. The least results
// of an index are its own 4 bytes.
constexpr std::uint64_t memory_bytes = 128 * mib;
constexpr std::uint64_t memory_each_index = 96;
constexpr std::uint64_t memory_each_result = 6 + memory_each_index / sizeof(std::uint32_t);
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
    glint_mesh_places places = {};  // of the decoded results
    double claimed_bytes = 0;       // of the results, as the accessors say
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

void add_attributes(Model &model, const DracoPrimitive &one, Packed &packed)
{
    const tinygltf::Primitive &primitive = primitive_of(model, one);
    for (const auto &[name, id] : one.attributes) {
        const auto index = static_cast<std::size_t>(primitive.attributes.at(name));
        const tinygltf::Accessor &accessor = model.accessors[index];
        if (find_attribute(packed.job, id, accessor) >= 0) {
            continue;
        }
        if (packed.job.attribute_count == GLINT_MESH_ATTRIBUTES_MAX) {
            refuse(place_of(one), "more than " + std::to_string(GLINT_MESH_ATTRIBUTES_MAX) +
                                      " attributes of one view (leave some out)");
        }
        glint_mesh_attribute &added = packed.job.attributes[packed.job.attribute_count++];
        added = {id, accessor.componentType,
                 tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type))};
        packed.claimed_bytes += double(accessor.count) * double(glint_mesh_vertex_bytes(&added));
    }
}

// The corners that a primitive's accessor says; 0 if the primitive has none.
std::uint64_t corners_of(const Model &model, const tinygltf::Primitive &primitive)
{
    return primitive.indices < 0
               ? 0
               : model.accessors[static_cast<std::size_t>(primitive.indices)].count;
}

void add_user(Model &model, std::size_t user, Packed &packed)
{
    const DracoPrimitive &one = model.draco[user];
    packed.view = one.view;
    packed.claimed_bytes +=
        double(corners_of(model, primitive_of(model, one))) * sizeof(std::uint32_t);
    add_attributes(model, one, packed);
    packed.users.push_back(user);
}

// What further results of a file may take.
class Budget
{
  public:
    explicit Budget(const Model &model)
    {
        const std::uint64_t there = buffer_bytes(model); // counts overlapping views once
        left_ =
            std::max(result_bytes_least, std::min(there, largest_whole >> 9) * result_bytes_each);
    }
    // Returns the room for a view's results, before any is decoded.
    std::uint64_t room_for(const Packed &packed, std::uint64_t packed_bytes) const
    {
        const double by_accessors = packed.claimed_bytes * double(room_each_claimed);
        const double by_bytes = double(packed_bytes) * double(result_bytes_each);
        const double wanted = std::max({double(room_least), by_accessors, by_bytes});
        return wanted < double(left_) ? static_cast<std::uint64_t>(wanted) : left_;
    }
    void take(std::uint64_t bytes)
    {
        left_ -= std::min(bytes, left_);
    }

  private:
    std::uint64_t left_;
};

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

// Writes the job and the packed bytes, and gives the results their room.
void lay_out(const Model &model, Packed &packed, std::uint64_t room, const MemoryFile &file)
{
    glint_mesh_job &job = packed.job;
    job.packed_offset = sizeof job;
    job.packed_bytes = model.bufferViews[packed.view].byteLength;
    job.result_offset = (job.packed_offset + job.packed_bytes + 7) / 8 * 8;
    job.result_room = room;
    file.write(0, &job, sizeof job);
    file.write(job.packed_offset, view_data(model, packed.view), job.packed_bytes);
    if (ftruncate(file.descriptor(), static_cast<off_t>(job.result_offset + room)) != 0) {
        throw shortage(std::string("a memory file cannot be made large enough: ") +
                       std::strerror(errno));
    }
}

glint_decode_limits limits_of(const Packed &packed, std::uint64_t room)
{
    glint_decode_limits limits = {};
    limits.picture_bytes = packed.job.result_offset + room;
    limits.memory_bytes = memory_bytes + std::min(limits.picture_bytes + memory_each_result * room,
                                                  glint_free_memory());
    limits.cpu_seconds =
        static_cast<std::uint32_t>(std::min<std::uint64_t>(cpu_seconds_of(room), 86400));
    limits.seconds = static_cast<std::uint32_t>(std::min<std::uint64_t>(seconds_of(room), 2000000));
    return limits;
}

// Takes the counts that the decoder found, and checks them: it may misbehave in any way. `room` is
// what the results may take if memory suffices.
void take_counts(Packed &packed, const glint_stored &stored, std::uint64_t room, const Place &place)
{
    glint_mesh_job &job = packed.job;
    glint_mesh_job found = {};
    glint_error error = {};
    if (glint_stored_read(&stored, 0, &found, sizeof found, &error) != GLINT_OK) {
        pass_on(error);
    }
    job.vertex_count = found.vertex_count;
    job.index_count = found.index_count;
    packed.places = glint_mesh_layout(&job);
    if (job.vertex_count == 0 || job.index_count < 3) {
        refuse(place, "Draco's data holds no triangle (export the file again)");
    }
    const std::string holds = "Draco's data holds " + std::to_string(job.vertex_count) +
                              " vertices and " + std::to_string(job.index_count) + " indices, and ";
    if (packed.places.bytes > room) {
        refuse(place, holds + counted(job.packed_bytes, "packed byte") + " may take " +
                          counted(room, "byte") +
                          " (the file is damaged; or export it without Draco)");
    }
    if (packed.places.bytes > job.result_room) {
        throw shortage(place.text() + ": " + holds + counted(job.result_room, "byte") +
                       " of memory are free for them (split the scene)");
    }
}

// Decodes a view and returns the results. Sets the job's counts and the places of the results.
Stored decode(const Model &model, Packed &packed, std::uint64_t room, Writer &writer)
{
    const Place place = (Place() / "bufferViews")[packed.view];
    const std::uint64_t left = glint_free_memory() / 2; // the memory file and the buffer
    const MemoryFile file;
    lay_out(model, packed, std::min(room, left), file);
    const std::string name = place.text();
    const glint_decode_limits limits = limits_of(packed, room);
    glint_error error = {};
    if (glint_decoder_run_mesh(name.c_str(), &limits, file.descriptor(), &error) != GLINT_OK) {
        pass_on(error);
    }
    const glint_stored stored = {name.c_str(), {}, 0, 0, file.descriptor()};
    take_counts(packed, stored, room, place);
    const Stored results = writer.allocate(packed.places.bytes);
    if (glint_stored_read(&stored, packed.job.result_offset, results.data, results.size, &error) !=
        GLINT_OK) {
        pass_on(error);
    }
    return results;
}

// Adds an accessor like `like`, of `count` elements from `offset` on in the last buffer.
int add_accessor(Model &model, const tinygltf::Accessor &like, std::uint64_t count,
                 std::uint64_t offset)
{
    tinygltf::BufferView &view = model.bufferViews.emplace_back();
    view.buffer = static_cast<int>(model.bytes.size() - 1);
    view.byteOffset = offset;
    view.byteLength = model.bytes.back().size - offset;
    tinygltf::Accessor &made = model.accessors.emplace_back();
    made.bufferView = static_cast<int>(model.bufferViews.size() - 1);
    made.componentType = like.componentType;
    made.type = like.type;
    made.count = count;
    made.normalized = like.normalized;
    return static_cast<int>(model.accessors.size() - 1);
}

// True if the primitive's accessors say other counts than Draco's data. Draco lists triangles: a
// strip of n corners has up to n − 2.
bool differs(const Model &model, const DracoPrimitive &one, const Packed &packed)
{
    const tinygltf::Primitive &primitive = model.meshes[one.mesh].primitives[one.number];
    const std::uint64_t corners = corners_of(model, primitive), found = packed.job.index_count;
    const bool is_strip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
    return primitive.indices < 0 ||
           (is_strip ? corners < 3 || found / 3 > corners - 2 : found != corners) ||
           std::any_of(one.attributes.begin(), one.attributes.end(), [&](const auto &attribute) {
               const int accessor = primitive.attributes.at(attribute.first);
               return model.accessors[static_cast<std::size_t>(accessor)].count !=
                      packed.job.vertex_count;
           });
}

void connect(Model &model, const DracoPrimitive &one, const Packed &packed)
{
    if (differs(model, one, packed)) {
        model.note({one.mesh, one.number}, "Draco's data has other numbers of vertices or corners "
                                           "than the accessors say (Draco's data counts)");
    }
    tinygltf::Primitive &primitive = primitive_of(model, one);
    for (const auto &[name, id] : one.attributes) {
        int &index = primitive.attributes.at(name);
        const tinygltf::Accessor accessor = model.accessors[static_cast<std::size_t>(index)];
        const int found = find_attribute(packed.job, id, accessor);
        index =
            add_accessor(model, accessor, packed.job.vertex_count, packed.places.attributes[found]);
    }
    tinygltf::Accessor indices;
    indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    indices.type = TINYGLTF_TYPE_SCALAR;
    primitive.indices = add_accessor(model, indices, packed.job.index_count, packed.places.indices);
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
}

// ---- Checks -------------------------------------------------------------------------------------

// Marks an accessor that Draco fills. Returns true if it has no data of its own.
bool mark(Model &model, std::size_t accessor, const Place &place)
{
    const tinygltf::Accessor &marked = model.accessors[accessor];
    if (marked.sparse.isSparse && marked.bufferView < 0) {
        refuse(place, "accessors[" + std::to_string(accessor) +
                          "] is sparse (what Draco packs cannot be)");
    }
    model.filled_accessors.insert(accessor);
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
        const auto index = static_cast<std::size_t>(found->second);
        const int type = model.accessors[index].type;
        if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)) > 4 ||
            type == TINYGLTF_TYPE_MAT2) {
            refuse(at, "its accessor holds matrices (Draco packs none)");
        }
        is_needed = mark(model, index, at) || is_needed;
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
    // Draco stores triangles, whatever the accessor of indices says.
    if (primitive.indices >= 0) {
        const auto indices = static_cast<std::size_t>(primitive.indices);
        is_needed = mark(model, indices, place / "indices") || is_needed;
    }
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
        return; // points and lines are not drawn
    }
    if (primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN) {
        refuse(place / "mode", std::to_string(primitive.mode) +
                                   " cannot be packed by Draco (4, triangles, or 5, a strip)");
    }
    if (is_needed || primitive.indices < 0 || model.requires_draco) {
        model.draco.push_back(one);
    }
}

void decode_draco(Writer &writer, Model &model)
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
    Budget budget(model);
    std::uint64_t decoded = 0; // bytes
    const auto begin = std::chrono::steady_clock::now();
    for (Packed &packed : all) {
        const std::uint64_t room =
            budget.room_for(packed, model.bufferViews[packed.view].byteLength);
        const Stored bytes = decode(model, packed, room, writer);
        decoded += bytes.size;
        budget.take(bytes.size);
        model.bytes.push_back(bytes);
        for (const std::size_t user : packed.users) {
            connect(model, model.draco[user], packed);
        }
        // Many small views, each within its limits, could take forever together.
        const std::uint64_t most = seconds_of(decoded);
        if (std::chrono::steady_clock::now() - begin > std::chrono::seconds(most)) {
            refuse(Place() / "meshes", "take more than " + std::to_string(most) +
                                           " s to decode (export the file without Draco)");
        }
    }
}

} // namespace glint
