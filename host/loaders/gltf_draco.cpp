#include "host/loaders/gltf_draco.h"

#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>
#include <fmt/format.h>

#include <limits>
#include <memory>
#include <utility>

#include "host/base/printable.h"

namespace duolux {

namespace {

DracoMesh::Attribute attributeOf(const draco::Mesh& mesh, const JsonNode& id) {
    const draco::PointAttribute* const attribute =
        mesh.GetAttributeByUniqueId(id.integer(0, std::numeric_limits<std::uint32_t>::max()));
    if (attribute == nullptr) id.failValue("expected the id of an attribute in the compressed data");
    constexpr std::uint32_t kMostComponents = 4;
    DracoMesh::Attribute decoded;
    decoded.components = attribute->num_components();
    if (decoded.components > kMostComponents) id.fail("has too many components", "expected at most 4");
    decoded.values.resize(std::size_t{mesh.num_points()} * decoded.components);
    for (std::uint32_t point = 0; point < mesh.num_points(); ++point) {
        const draco::AttributeValueIndex index = attribute->mapped_index(draco::PointIndex(point));
        float* const values = &decoded.values[std::size_t{point} * decoded.components];
        if (index.value() >= attribute->size() ||
            !attribute->ConvertValue<float>(index, static_cast<std::int8_t>(decoded.components), values))
            id.fail("the compressed data is damaged", "expected an attribute of numbers");
    }
    return decoded;
}

}  // namespace

DracoMesh decodeDraco(const JsonNode& extension, std::string_view bytes) {
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    draco::Decoder decoder;
    auto result = decoder.DecodeMeshFromBuffer(&buffer);
    if (!result.ok()) {
        extension.fail(fmt::format("the compressed data cannot be decoded: {}",
                                   shortened(result.status().error_msg_string(), 2 * kLongestName)),
                       "expected a mesh compressed by Draco");
    }
    const std::unique_ptr<draco::Mesh> mesh = std::move(result).value();
    DracoMesh decoded;
    decoded.indices.reserve(3 * std::size_t{mesh->num_faces()});
    for (std::uint32_t face = 0; face < mesh->num_faces(); ++face) {
        for (const draco::PointIndex& point : mesh->face(draco::FaceIndex(face)))
            decoded.indices.push_back(point.value());
    }
    for (const auto& [name, id] : extension.require("attributes", "expected an object").members())
        decoded.attributes.emplace(name, attributeOf(*mesh, id));
    return decoded;
}

}  // namespace duolux
