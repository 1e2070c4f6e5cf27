#include "host/loaders/gltf_primitive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>

#include "host/loaders/gltf_accessor.h"
#include "host/loaders/gltf_draco.h"
#include "host/loaders/gltf_topology.h"

namespace duolux {

namespace {

bool isFiniteVector(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The number, or `other` if it is not finite.
float finiteOr(float number, float other) {
    return std::isfinite(number) ? number : other;
}

/// Reads one primitive.
class PrimitiveReader {
  public:
    PrimitiveReader(const JsonNode& node, const GltfDocument& document, GltfBuffers& buffers,
                    GltfNotes& notes)
        : node_(node),
          attributes_(node.require("attributes", "expected an object")),
          document_(document),
          buffers_(buffers),
          notes_(notes) {}

    /// Empty if there are no triangles.
    std::optional<GltfPrimitive> run() {
        const auto modeNode = node_.find("mode");
        const std::uint32_t mode = modeNode ? modeNode->integer(0, 6) : 4;
        if (mode < static_cast<std::uint32_t>(GltfMode::kTriangles)) {
            notes_.ignore(node_, "points and lines are not supported", "left out");
            return std::nullopt;
        }
        if (const auto material = node_.find("material"))
            primitive_.material = document_.index(*material, "materials");
        if (const auto draco = extensionOf(node_, "KHR_draco_mesh_compression")) decompress(*draco);
        const auto positions = attribute("POSITION", "VEC3");
        if (!positions) {
            notes_.tolerate(node_, "a primitive without POSITION", "expected positions", "left out");
            return std::nullopt;
        }
        vertexCount_ = positions->count();
        readTriangles(static_cast<GltfMode>(mode));
        if (primitive_.triangles.empty()) return std::nullopt;
        vertices_ = compactVertices(primitive_.triangles, *vertexCount_);
        readPositions(*positions);
        readNormals();
        readUvs();
        readColours();
        readInfluences("JOINTS_0", "WEIGHTS_0", primitive_.influences);
        readInfluences("JOINTS_1", "WEIGHTS_1", primitive_.moreInfluences);
        readTargets();
        return std::move(primitive_);
    }

  private:
    void decompress(const JsonNode& draco) {
        const JsonNode view = draco.require("bufferView", "expected the index of a buffer view");
        compressed_ = decodeDraco(draco, buffers_.view(view).bytes);
    }

    /// The values of an attribute; empty if the primitive does not have it.
    std::optional<GltfAccessor> attribute(const char* name, std::string_view types) {
        const auto index = attributes_.find(name);
        if (!index) return std::nullopt;
        if (compressed_) {
            const auto found = compressed_->attributes.find(name);
            if (found != compressed_->attributes.end()) return decompressed(*index, found->second, types);
        }
        return checked(*index, GltfAccessor(document_, buffers_, *index, types));
    }

    GltfAccessor decompressed(const JsonNode& index, DracoMesh::Attribute& attribute,
                              std::string_view types) {
        const auto type = fmt::format("VEC{}", attribute.components);
        if (types.find(type) == std::string_view::npos) {
            index.fail(fmt::format("the compressed data has {} numbers per vertex", attribute.components),
                       fmt::format("expected {}", types));
        }
        const std::uint32_t components = attribute.components;
        return checked(index, {index, std::move(attribute.values), components});
    }

    GltfAccessor checked(const JsonNode& index, GltfAccessor accessor) const {
        if (vertexCount_ && accessor.count() != *vertexCount_) {
            index.fail(fmt::format("has {} elements", accessor.count()),
                       fmt::format("expected {}, as many as POSITION", *vertexCount_));
        }
        return accessor;
    }

    void readTriangles(GltfMode mode) {
        std::vector<std::uint32_t> indices;
        if (compressed_) {
            indices = std::move(compressed_->indices);
            mode = GltfMode::kTriangles;
        } else if (const auto node = node_.find("indices")) {
            indices = readIndices(*node);
        } else {
            if (*vertexCount_ > std::numeric_limits<std::int32_t>::max())
                node_.fail("has too many vertices", "expected fewer than 2^31");
            indices.resize(*vertexCount_);
            std::iota(indices.begin(), indices.end(), 0u);
        }
        const auto largest = std::max_element(indices.begin(), indices.end());
        if (largest != indices.end() && *largest >= *vertexCount_) failIndex(indices);
        const std::size_t needed = mode == GltfMode::kTriangles ? indices.size() % 3 : 0;
        if (needed != 0 || indices.size() < 3) {
            notes_.tolerate(node_, "a number of indices that forms no whole triangles",
                            "expected three for each triangle", "the last ones are left out");
        }
        primitive_.triangles = trianglesOf(mode, indices);
    }

    std::vector<std::uint32_t> readIndices(const JsonNode& node) {
        const GltfAccessor accessor(document_, buffers_, node, "SCALAR");
        std::vector<std::uint32_t> indices(accessor.count());
        for (std::size_t i = 0; i < indices.size(); ++i)
            indices[i] = accessor.whole(i, 0);
        return indices;
    }

    [[noreturn]] void failIndex(const std::vector<std::uint32_t>& indices) const {
        const auto bad = std::find_if(indices.begin(), indices.end(),
                                      [&](std::uint32_t index) { return index >= *vertexCount_; });
        const std::string remedy = *vertexCount_ == 0 ? std::string("there are no vertices")
                                                      : fmt::format("expected 0 to {}", *vertexCount_ - 1);
        node_.find("indices").value_or(node_).fail(
            fmt::format("index {} of {} is {}", bad - indices.begin(), indices.size(), *bad), remedy);
    }

    void readPositions(const GltfAccessor& positions) {
        for (const std::uint32_t vertex : vertices_) {
            primitive_.positions.push_back(positions.vec3(vertex));
            if (!isFiniteVector(primitive_.positions.back())) {
                positions.node().fail(fmt::format("element {} is not finite", vertex),
                                      "expected finite positions");
            }
        }
    }

    void readNormals() {
        if (const auto normals = attribute("NORMAL", "VEC3")) {
            for (const std::uint32_t vertex : vertices_) {
                const glm::vec3 normal = normals->vec3(vertex);
                const float length = glm::length(normal);
                const bool isGood = length > 0.0f && std::isfinite(length);
                if (!isGood) {
                    notes_.tolerate(normals->node(), "a normal that is 0 or not finite",
                                    "expected a direction", "its triangles are flat");
                }
                primitive_.normals.push_back(isGood ? normal / length : glm::vec3(0.0f));
            }
        }
        if (const auto tangents = attribute("TANGENT", "VEC4")) {
            for (const std::uint32_t vertex : vertices_) {
                const glm::vec4 tangent = tangents->vec4(vertex);
                const float length = glm::length(glm::vec3(tangent));
                const bool isGood = length > 0.0f && std::isfinite(length);
                const float sign = tangent.w < 0.0f ? -1.0f : 1.0f;
                primitive_.tangents.push_back(isGood ? glm::vec4(glm::vec3(tangent) / length, sign)
                                                     : glm::vec4(0.0f));
            }
        }
    }

    void readUvs() {
        const auto read = [&](const char* name, std::vector<glm::vec2>& uvs) {
            const auto accessor = attribute(name, "VEC2");
            if (!accessor) return;
            for (const std::uint32_t vertex : vertices_) {
                const glm::vec2 uv = accessor->vec2(vertex);
                if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) {
                    notes_.tolerate(accessor->node(), "a texture coordinate that is not finite",
                                    "expected finite numbers", "read as 0");
                }
                uvs.emplace_back(finiteOr(uv.x, 0.0f), finiteOr(uv.y, 0.0f));
            }
        };
        read("TEXCOORD_0", primitive_.uvs);
        read("TEXCOORD_1", primitive_.secondUvs);
    }

    void readColours() {
        auto colours = attribute("COLOR_0", "VEC3 or VEC4");
        if (!colours) return;
        if (!colours->isFloat()) colours->setNormalised();
        const bool hasAlpha = colours->components() == 4;
        const auto fraction = [](float number) { return std::clamp(finiteOr(number, 1.0f), 0.0f, 1.0f); };
        for (const std::uint32_t vertex : vertices_) {
            const glm::vec3 colour = colours->vec3(vertex);
            primitive_.colours.emplace_back(fraction(colour.x), fraction(colour.y), fraction(colour.z));
            if (hasAlpha) primitive_.alphas.push_back(fraction(colours->number(vertex, 3)));
        }
    }

    void readInfluences(const char* jointsName, const char* weightsName,
                        std::vector<GltfPrimitive::Influence>& influences) {
        const auto joints = attribute(jointsName, "VEC4");
        auto weights = attribute(weightsName, "VEC4");
        if (!joints || !weights) return;
        if (!weights->isFloat()) weights->setNormalised();
        for (const std::uint32_t vertex : vertices_) {
            GltfPrimitive::Influence influence{};
            for (std::uint32_t i = 0; i < 4; ++i) {
                influence.joints[static_cast<int>(i)] = joints->whole(vertex, i);
                influence.weights[static_cast<int>(i)] =
                    std::max(finiteOr(weights->number(vertex, i), 0.0f), 0.0f);
            }
            influences.push_back(influence);
        }
    }

    void readTargets() {
        const auto targets = node_.find("targets");
        if (!targets) return;
        for (const JsonNode& node : targets->elements("expected an array of morph targets")) {
            GltfPrimitive::Target& target = primitive_.targets.emplace_back();
            readDifferences(node, "POSITION", target.positions);
            readDifferences(node, "NORMAL", target.normals);
            readDifferences(node, "TANGENT", target.tangents);
        }
    }

    void readDifferences(const JsonNode& target, const char* name, std::vector<glm::vec3>& differences) {
        const auto index = target.find(name);
        if (!index) return;
        const GltfAccessor accessor = checked(*index, GltfAccessor(document_, buffers_, *index, "VEC3"));
        for (const std::uint32_t vertex : vertices_) {
            const glm::vec3 difference = accessor.vec3(vertex);
            if (!isFiniteVector(difference))
                accessor.node().fail(fmt::format("element {} is not finite", vertex),
                                     "expected finite numbers");
            differences.push_back(difference);
        }
    }

    const JsonNode node_, attributes_;
    const GltfDocument& document_;
    GltfBuffers& buffers_;
    GltfNotes& notes_;
    std::optional<DracoMesh> compressed_;
    std::optional<std::size_t> vertexCount_;
    std::vector<std::uint32_t> vertices_;  ///< those that triangles use
    GltfPrimitive primitive_;
};

}  // namespace

std::vector<GltfPrimitive> readGltfMesh(const JsonNode& mesh, const GltfDocument& document,
                                        GltfBuffers& buffers, GltfNotes& notes) {
    std::vector<GltfPrimitive> primitives;
    const char* const remedy = "expected an array of primitives";
    for (const JsonNode& node : mesh.require("primitives", remedy).elements(remedy)) {
        if (auto primitive = PrimitiveReader(node, document, buffers, notes).run())
            primitives.push_back(*std::move(primitive));
    }
    return primitives;
}

}  // namespace duolux
