// Packs meshes by Draco. See draco_mesh.h.
#include "support/draco_mesh.h"

#include <cstdlib>
#include <cstring>
#include <draco/compression/encode.h>

namespace
{

void add_attribute(draco::Mesh &made, draco::GeometryAttribute::Type type, draco::DataType data,
                   std::int8_t components, const void *values)
{
    const std::int64_t size = draco::DataTypeLength(data) * components;
    draco::GeometryAttribute shape;
    shape.Init(type, nullptr, components, data, data == draco::DT_UINT8, size, 0);
    const auto count = static_cast<std::uint32_t>(made.num_points());
    draco::PointAttribute &added =
        *made.attribute(made.AddAttribute(shape, /*identity_mapping=*/true, count));
    for (std::uint32_t i = 0; i < count; i++) {
        added.SetAttributeValue(draco::AttributeValueIndex(i),
                                static_cast<const char *>(values) + i * size);
    }
}

} // namespace

unsigned char *draco_pack(const draco_mesh *mesh, size_t *size)
{
    draco::Mesh made;
    made.set_num_points(static_cast<std::uint32_t>(mesh->vertices));
    for (std::size_t t = 0; t < mesh->triangles; t++) {
        const std::uint32_t *corner = mesh->indices + 3 * t;
        made.AddFace({{draco::PointIndex(corner[0]), draco::PointIndex(corner[1]),
                       draco::PointIndex(corner[2])}});
    }
    add_attribute(made, draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, 3, mesh->positions);
    add_attribute(made, draco::GeometryAttribute::NORMAL, draco::DT_FLOAT32, 3, mesh->normals);
    add_attribute(made, draco::GeometryAttribute::COLOR, draco::DT_UINT8, 4, mesh->colors);
    draco::Encoder encoder;
    encoder.SetEncodingMethod(mesh->edgebreaker ? draco::MESH_EDGEBREAKER_ENCODING
                                                : draco::MESH_SEQUENTIAL_ENCODING);
    if (mesh->bits > 0) {
        encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, mesh->bits);
        encoder.SetAttributeQuantization(draco::GeometryAttribute::NORMAL, mesh->bits);
    }
    draco::EncoderBuffer packed;
    if (!encoder.EncodeMeshToBuffer(made, &packed).ok()) {
        return nullptr;
    }
    *size = packed.size();
    auto *bytes = static_cast<unsigned char *>(std::malloc(packed.size()));
    if (bytes != nullptr) {
        std::memcpy(bytes, packed.data(), packed.size());
    }
    return bytes;
}
