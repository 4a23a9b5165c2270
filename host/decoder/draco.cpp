// Decodes primitives packed by Draco. See draco.hpp.
//
// Draco's data decides how many vertices and corners a mesh has. But the decoder limits the results
// before it decodes, by the packed bytes and the accessors. No count in Draco's data lifts this
// limit. In fuzzing, files of some hundred bytes made Draco run for minutes and take gigabytes. So
// memory and time are limited, too, for each mesh.
#include "decoder/draco.hpp"

#include "decoder/arrays.hpp"

#include <algorithm>
#include <cstring>
#include <draco/compression/decode.h>
#include <map>
#include <memory>
#include <tuple>

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
constexpr std::size_t most_attributes = 32; // of a view
// During decoding Draco holds tables of corners and two copies of each attribute. The least results
// of an index are its own 4 bytes.
constexpr std::uint64_t memory_bytes = 128 * mib;
constexpr std::uint64_t memory_each_index = 96;
constexpr std::uint64_t memory_each_result = 6 + memory_each_index / sizeof(std::uint32_t);
// The slowest decoding yields 4 MiB of results per second.
constexpr std::uint64_t cpu_seconds_least = 5;
constexpr std::uint64_t results_a_second = 4 * mib;

std::uint64_t cpu_seconds_of(std::uint64_t result_bytes)
{
    return cpu_seconds_least + result_bytes / results_a_second;
}

// ---- Views --------------------------------------------------------------------------------------

// An attribute that primitives want from a packed view: Draco's id for it, and their accessors'
// kind.
struct Wanted {
    std::uint32_t id = 0;
    int component_type = 0, components = 0;
    Stored values = {}; // [vertex][components], once decoded

    std::uint64_t vertex_bytes() const
    {
        return glint_component_bytes(component_type) * static_cast<std::uint64_t>(components);
    }
};

// A packed view, and the results that its primitives need.
struct Packed {
    std::size_t view = 0;
    std::vector<Wanted> wanted;
    double claimed_bytes = 0;                        // of the results, as the accessors say
    std::vector<std::size_t> users;                  // indices into model.draco
    std::uint64_t vertex_count = 0, index_count = 0; // once decoded, as are the indices
    Stored indices = {};                             // 32 bits each
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

// Returns the attribute that fits; NULL: none.
const Wanted *find_wanted(const Packed &packed, std::uint32_t id,
                          const tinygltf::Accessor &accessor)
{
    const int components =
        tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    const auto found =
        std::find_if(packed.wanted.begin(), packed.wanted.end(), [&](const Wanted &one) {
            return one.id == id && one.component_type == accessor.componentType &&
                   one.components == components;
        });
    return found == packed.wanted.end() ? nullptr : &*found;
}

void add_attributes(Model &model, const DracoPrimitive &one, Packed &packed)
{
    const tinygltf::Primitive &primitive = primitive_of(model, one);
    for (const auto &[name, id] : one.attributes) {
        const auto index = static_cast<std::size_t>(primitive.attributes.at(name));
        const tinygltf::Accessor &accessor = model.accessors[index];
        if (find_wanted(packed, id, accessor) != nullptr) {
            continue;
        }
        if (packed.wanted.size() == most_attributes) {
            refuse(place_of(one), "more than " + std::to_string(most_attributes) +
                                      " attributes of one view (leave some out)");
        }
        Wanted &added = packed.wanted.emplace_back();
        added.id = id;
        added.component_type = accessor.componentType;
        added.components =
            tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
        packed.claimed_bytes += double(accessor.count) * double(added.vertex_bytes());
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

template <typename T>
void convert(const draco::PointAttribute &from, std::uint64_t vertices, const Place &place,
             const Wanted &wanted)
{
    auto *values = reinterpret_cast<T *>(wanted.values.data);
    const auto components = static_cast<std::size_t>(wanted.components);
    for (std::uint32_t i = 0; i < vertices; i++) {
        const draco::AttributeValueIndex index = from.mapped_index(draco::PointIndex(i));
        if (index.value() >= from.size() ||
            !from.ConvertValue<T>(index, static_cast<std::int8_t>(wanted.components),
                                  values + i * components)) {
            refuse(place, "Draco's attribute " + std::to_string(wanted.id) +
                              " holds what its accessor cannot (export the file again)");
        }
    }
}

void take_attribute(const draco::Mesh &mesh, const Place &place, const Wanted &wanted)
{
    const draco::PointAttribute *found = mesh.GetAttributeByUniqueId(wanted.id);
    const std::string name = "attribute " + std::to_string(wanted.id);
    if (found == nullptr) {
        refuse(place, "Draco's data has no " + name + " (export the file again)");
    }
    if (found->num_components() != wanted.components) {
        refuse(place, "Draco's " + name + " has " + std::to_string(found->num_components()) +
                          " components, its accessor " + std::to_string(wanted.components) +
                          " (export the file again)");
    }
    switch (wanted.component_type) {
    case GLINT_COMPONENT_INT8:
        return convert<std::int8_t>(*found, mesh.num_points(), place, wanted);
    case GLINT_COMPONENT_UINT8:
        return convert<std::uint8_t>(*found, mesh.num_points(), place, wanted);
    case GLINT_COMPONENT_INT16:
        return convert<std::int16_t>(*found, mesh.num_points(), place, wanted);
    case GLINT_COMPONENT_UINT16:
        return convert<std::uint16_t>(*found, mesh.num_points(), place, wanted);
    case GLINT_COMPONENT_UINT32:
        return convert<std::uint32_t>(*found, mesh.num_points(), place, wanted);
    default:
        return convert<float>(*found, mesh.num_points(), place, wanted);
    }
}

void take_indices(const draco::Mesh &mesh, unsigned char *to)
{
    for (std::uint32_t f = 0; f < mesh.num_faces(); f++) {
        const draco::Mesh::Face &face = mesh.face(draco::FaceIndex(f));
        for (std::size_t c = 0; c < 3; c++) {
            const std::uint32_t vertex = face[c].value();
            std::memcpy(to + (std::size_t(f) * 3 + c) * sizeof vertex, &vertex, sizeof vertex);
        }
    }
}

std::unique_ptr<draco::Mesh> decode_bytes(const unsigned char *bytes, std::uint64_t count,
                                          const Place &place)
{
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char *>(bytes), count);
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) {
        refuse(place, std::string("Draco cannot decode it: ") + decoded.status().error_msg() +
                          " (the file is damaged: export it again)");
    }
    return std::move(decoded).value();
}

// Checks what the results of a view take, and makes room for them. Returns their bytes.
std::uint64_t make_room(Packed &packed, std::uint64_t packed_bytes, std::uint64_t room,
                        Writer &writer)
{
    const Place place = (Place() / "bufferViews")[packed.view];
    if (packed.vertex_count == 0 || packed.index_count < 3) {
        refuse(place, "Draco's data holds no triangle (export the file again)");
    }
    // Draco counts points and faces in 32 bits: no overflow.
    std::uint64_t bytes = packed.index_count * sizeof(std::uint32_t);
    for (const Wanted &wanted : packed.wanted) {
        bytes += packed.vertex_count * wanted.vertex_bytes();
    }
    if (bytes > room) {
        refuse(place, "Draco's data holds " + std::to_string(packed.vertex_count) +
                          " vertices and " + std::to_string(packed.index_count) + " indices, and " +
                          counted(packed_bytes, "packed byte") + " may take " +
                          counted(room, "byte") +
                          " (the file is damaged; or export it without Draco)");
    }
    packed.indices = writer.allocate(packed.index_count * sizeof(std::uint32_t));
    for (Wanted &wanted : packed.wanted) {
        wanted.values = writer.allocate(packed.vertex_count * wanted.vertex_bytes());
    }
    return bytes;
}

// Decodes a view. Returns the bytes of its results.
std::uint64_t decode(const Model &model, Packed &packed, std::uint64_t room, Limits &limits,
                     Writer &writer)
{
    const Place place = (Place() / "bufferViews")[packed.view];
    const std::uint64_t packed_bytes = model.bufferViews[packed.view].byteLength;
    const std::uint64_t most = memory_bytes + packed_bytes + memory_each_result * room;
    limits.begin_part(place.text(), most, cpu_seconds_of(room));
    try {
        const std::unique_ptr<draco::Mesh> mesh =
            decode_bytes(view_data(model, packed.view), packed_bytes, place);
        packed.vertex_count = mesh->num_points();
        packed.index_count = std::uint64_t(mesh->num_faces()) * 3;
        const std::uint64_t bytes = make_room(packed, packed_bytes, room, writer);
        take_indices(*mesh, packed.indices.data);
        for (const Wanted &wanted : packed.wanted) {
            take_attribute(*mesh, place, wanted);
        }
        limits.end_part(bytes / results_a_second);
        return bytes;
    } catch (const std::bad_alloc &) {
        limits.end_part(0);
        if (most > limits.free_bytes()) {
            throw;
        }
        refuse(place, "takes more than " + std::to_string(most / mib) +
                          " MiB to decode (it is damaged; or export it without Draco)");
    }
}

// Adds an accessor like `like`, of `count` elements in these bytes.
int add_accessor(Model &model, const tinygltf::Accessor &like, std::uint64_t count,
                 const Stored &bytes)
{
    model.bytes.push_back(bytes);
    tinygltf::BufferView &view = model.bufferViews.emplace_back();
    view.buffer = static_cast<int>(model.bytes.size() - 1);
    view.byteLength = bytes.size;
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
    const std::uint64_t corners = corners_of(model, primitive), found = packed.index_count;
    const bool is_strip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
    return primitive.indices < 0 ||
           (is_strip ? corners < 3 || found / 3 > corners - 2 : found != corners) ||
           std::any_of(one.attributes.begin(), one.attributes.end(), [&](const auto &attribute) {
               const int accessor = primitive.attributes.at(attribute.first);
               return model.accessors[static_cast<std::size_t>(accessor)].count !=
                      packed.vertex_count;
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
        index = add_accessor(model, accessor, packed.vertex_count,
                             find_wanted(packed, id, accessor)->values);
    }
    tinygltf::Accessor indices;
    indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    indices.type = TINYGLTF_TYPE_SCALAR;
    primitive.indices = add_accessor(model, indices, packed.index_count, packed.indices);
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

void decode_draco(Limits &limits, Writer &writer, Model &model)
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
    for (Packed &packed : all) {
        const std::uint64_t room =
            budget.room_for(packed, model.bufferViews[packed.view].byteLength);
        budget.take(decode(model, packed, room, limits, writer));
        for (const std::size_t user : packed.users) {
            connect(model, model.draco[user], packed);
        }
    }
}

} // namespace glint
