// Decodes meshes packed by Draco. See decode.hpp and image/mesh_decoding.h.
//
// In fuzzing, files of some hundred bytes made Draco run for minutes and take gigabytes. So it runs
// here, within limits, and never in glint's process.
#include "codec/decode.hpp"
#include "codec/mapping.hpp"
#include "image/mesh_decoding.h"

#include <draco/compression/decode.h>

#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>

namespace glint
{

namespace
{

[[noreturn]] void refuse(const std::string &cause)
{
    throw std::runtime_error(cause);
}

template <typename T>
void convert(const draco::PointAttribute &from, const glint_mesh_job &job,
             const glint_mesh_attribute &wanted, unsigned char *to)
{
    auto *values = reinterpret_cast<T *>(to);
    const auto components = static_cast<std::size_t>(wanted.components);
    for (std::uint32_t i = 0; i < job.vertex_count; i++) {
        const draco::AttributeValueIndex index = from.mapped_index(draco::PointIndex(i));
        if (index.value() >= from.size() ||
            !from.ConvertValue<T>(index, static_cast<std::int8_t>(wanted.components),
                                  values + i * components)) {
            refuse("Draco's attribute " + std::to_string(wanted.id) +
                   " holds what its accessor cannot");
        }
    }
}

void take_attribute(const draco::Mesh &mesh, const glint_mesh_job &job,
                    const glint_mesh_attribute &wanted, unsigned char *to)
{
    const draco::PointAttribute *found = mesh.GetAttributeByUniqueId(wanted.id);
    if (found == nullptr) {
        refuse("Draco's data has no attribute " + std::to_string(wanted.id));
    }
    if (found->num_components() != wanted.components) {
        refuse("Draco's attribute " + std::to_string(wanted.id) + " has " +
               std::to_string(found->num_components()) + " components, its accessor " +
               std::to_string(wanted.components));
    }
    switch (wanted.component_type) {
    case 5120:
        return convert<std::int8_t>(*found, job, wanted, to);
    case 5121:
        return convert<std::uint8_t>(*found, job, wanted, to);
    case 5122:
        return convert<std::int16_t>(*found, job, wanted, to);
    case 5123:
        return convert<std::uint16_t>(*found, job, wanted, to);
    case 5125:
        return convert<std::uint32_t>(*found, job, wanted, to);
    default:
        return convert<float>(*found, job, wanted, to);
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

} // namespace

glint_status decode_mesh(const glint_codec_request &request, int file, glint_error *error)
{
    const Mapping mapping(file);
    glint_mesh_job job;
    std::memcpy(&job, mapping.at(0), sizeof job);
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char *>(mapping.at(job.packed_offset)), job.packed_bytes);
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: Draco cannot decode it: %s (the file is damaged: export it again)",
                          request.path, decoded.status().error_msg());
    }
    try {
        const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
        job.vertex_count = mesh->num_points();
        job.index_count = std::uint64_t(mesh->num_faces()) * 3;
        std::memcpy(mapping.at(0), &job, sizeof job);
        const glint_mesh_places places = glint_mesh_layout(&job);
        if (places.bytes <= job.result_room) {
            unsigned char *results = mapping.at(job.result_offset);
            take_indices(*mesh, results + places.indices);
            for (std::int32_t i = 0; i < job.attribute_count; i++) {
                take_attribute(*mesh, job, job.attributes[i], results + places.attributes[i]);
            }
        }
    } catch (const std::runtime_error &fault) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: %s (export the file again)", request.path,
                          fault.what());
    }
    return GLINT_OK;
}

} // namespace glint
