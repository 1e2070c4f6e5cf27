#include "host/loaders/gltf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/base/error.h"
#include "host/loaders/gltf_accessor.h"
#include "host/loaders/gltf_buffers.h"
#include "host/loaders/gltf_document.h"
#include "host/loaders/gltf_geometry.h"
#include "host/loaders/gltf_hierarchy.h"
#include "host/loaders/gltf_material.h"
#include "host/loaders/gltf_notes.h"
#include "host/loaders/gltf_primitive.h"
#include "host/loaders/gltf_textures.h"
#include "host/loaders/gltf_views.h"
#include "host/scene/origin.h"

namespace duolux {

namespace {

namespace fs = std::filesystem;

/// Loads one file.
class GltfLoader {
  public:
    GltfLoader(const fs::path& path, Reading reading)
        : notes_(reading),
          document_(path, notes_),
          buffers_(document_),
          textures_(document_, buffers_, notes_) {
        mesh_.source = path;
        mesh_.files.push_back(path);
    }

    Mesh run() {
        hierarchy_ = readGltfHierarchy(document_, notes_);
        const std::vector<JsonNode>& nodes = document_.list("nodes");
        for (const std::uint32_t node : hierarchy_.scene) {
            if (const auto mesh = nodes[node].find("mesh")) ++uses_[document_.index(*mesh, "meshes")];
        }
        std::vector<std::uint32_t> cameras;
        for (const std::uint32_t node : hierarchy_.scene) {
            addMesh(nodes[node], hierarchy_.worlds[node]);
            if (nodes[node].find("camera")) cameras.push_back(node);
            if (auto light = readGltfLight(nodes[node], hierarchy_.worlds[node], document_, notes_))
                mesh_.pointEmitters.push_back(*light);
        }
        geometry_.moveTo(mesh_);
        if (mesh_.geometry.triangles.empty()) failWithoutTriangles();
        checkLights();
        chooseCamera(cameras);
        finishFiles();
        nameUnusedMaterials();
        notes_.warn(mesh_.warnings);
        return std::move(mesh_);
    }

  private:
    using Primitives = std::vector<GltfPrimitive>;

    void addMesh(const JsonNode& node, const glm::dmat4& world) {
        const auto index = node.find("mesh");
        if (!index) return;
        const std::uint32_t mesh = document_.index(*index, "meshes");
        const JsonNode& described = document_.list("meshes")[mesh];
        auto [entry, isNew] = meshes_.try_emplace(mesh);
        if (isNew) entry->second = readGltfMesh(described, document_, buffers_, notes_);
        const std::vector<double> weights = readWeights(node, described);
        GltfPlacement placement{node, world, {}, weights};
        if (const auto skin = node.find("skin")) placement.joints = jointsOf(document_.index(*skin, "skins"));
        for (const GltfPrimitive& primitive : entry->second) {
            const std::uint32_t material = materialOf(primitive);
            for (const glm::dmat4& instance : instancesOf(node)) {
                placement.world = world * instance;
                geometry_.add(primitive, material, placement);
            }
        }
        if (--uses_[mesh] == 0) meshes_.erase(entry);
    }

    /// The weights of the morph targets.
    static std::vector<double> readWeights(const JsonNode& node, const JsonNode& mesh) {
        auto given = node.find("weights");
        if (!given) given = mesh.find("weights");
        std::vector<double> weights;
        if (!given) return weights;
        constexpr double kLargest = 1e6;
        for (const JsonNode& weight : given->elements("expected an array of numbers"))
            weights.push_back(weight.number(-kLargest, kLargest, "expected a weight"));
        return weights;
    }

    /// The transforms that EXT_mesh_gpu_instancing lists; that of the node alone if it does not.
    std::vector<glm::dmat4> instancesOf(const JsonNode& node) {
        const auto extension = extensionOf(node, "EXT_mesh_gpu_instancing");
        if (!extension) return {glm::dmat4(1.0)};
        const JsonNode attributes = extension->require("attributes", "expected an object");
        std::optional<std::size_t> count;
        const auto read = [&](const char* key, const char* type) -> std::optional<GltfAccessor> {
            const auto index = attributes.find(key);
            if (!index) return std::nullopt;
            GltfAccessor accessor(document_, buffers_, *index, type);
            if (count && accessor.count() != *count) {
                index->fail(fmt::format("has {} elements", accessor.count()),
                            fmt::format("expected {}, as many as the others", *count));
            }
            count = accessor.count();
            return accessor;
        };
        const auto translations = read("TRANSLATION", "VEC3");
        const auto rotations = read("ROTATION", "VEC4");
        const auto scales = read("SCALE", "VEC3");
        std::vector<glm::dmat4> instances;
        for (std::size_t i = 0; i < count.value_or(0); ++i) {
            instances.push_back(
                transformOf(translations ? glm::dvec3(translations->vec3(i)) : glm::dvec3(0.0),
                            rotations ? glm::dvec4(rotations->vec4(i)) : glm::dvec4(0.0, 0.0, 0.0, 1.0),
                            scales ? glm::dvec3(scales->vec3(i)) : glm::dvec3(1.0)));
        }
        return instances;
    }

    /// The matrices by which the joints of a skin move vertices.
    const std::vector<glm::dmat4>& jointsOf(std::uint32_t skin) {
        const auto [entry, isNew] = skins_.try_emplace(skin);
        if (!isNew) return entry->second;
        const JsonNode& node = document_.list("skins")[skin];
        const char* const remedy = "expected an array of indices of nodes";
        const std::vector<JsonNode> joints = node.require("joints", remedy).elements(remedy);
        const auto bindIndex = node.find("inverseBindMatrices");
        std::optional<GltfAccessor> binds;
        if (bindIndex) binds.emplace(document_, buffers_, *bindIndex, "MAT4");
        if (binds && binds->count() < joints.size()) {
            bindIndex->fail(fmt::format("has {} matrices", binds->count()),
                            fmt::format("expected {}, one for each joint", joints.size()));
        }
        for (std::size_t i = 0; i < joints.size(); ++i) {
            const glm::dmat4& world = hierarchy_.worlds[document_.index(joints[i], "nodes")];
            entry->second.push_back(binds ? world * binds->mat4(i) : world);
        }
        return entry->second;
    }

    std::uint32_t materialOf(const GltfPrimitive& primitive) {
        const std::optional<std::uint32_t> index = primitive.material;
        const auto next = static_cast<std::uint32_t>(mesh_.materials.size());
        const auto [entry, isNew] = materials_.try_emplace(index, next);
        if (!index) {
            if (isNew) mesh_.materials.push_back(defaultGltfMaterial());
            return entry->second;
        }
        const JsonNode& node = document_.list("materials")[*index];
        if (isNew) mesh_.materials.push_back(readGltfMaterial(node, *index, textures_, notes_));
        return entry->second;
    }

    void nameUnusedMaterials() {
        const std::vector<JsonNode>& nodes = document_.list("materials");
        for (std::uint32_t i = 0; i < nodes.size(); ++i) {
            if (!materials_.contains(i)) mesh_.unusedMaterials.push_back(gltfMaterialName(nodes[i], i));
        }
    }

    [[noreturn]] void failWithoutTriangles() const {
        throw InputError(document_.path().string(), "", "has no triangles",
                         "expected a scene with nodes that have meshes of triangles");
    }

    void checkLights() const {
        for (const PlacedPointEmitter& emitter : mesh_.pointEmitters) {
            const glm::dvec3 position = emitter.position - mesh_.origin;
            if (glm::all(glm::lessThanEqual(glm::abs(position), glm::dvec3(kLargestCoordinate)))) continue;
            throw InputError(document_.path().string(), "", "a light is too far from the rest of the scene",
                             fmt::format("expected a distance of at most {:g}", kLargestCoordinate));
        }
    }

    void chooseCamera(const std::vector<std::uint32_t>& cameras) {
        if (cameras.empty()) return;
        const JsonNode& node = document_.list("nodes")[cameras.front()];
        const glm::dmat4& world = hierarchy_.worlds[cameras.front()];
        // The target should be as far as what it shows, so that rounding does not turn the view.
        WideBounds bounds;
        for (const glm::vec3& position : mesh_.geometry.positions)
            bounds.add(mesh_.origin + glm::dvec3(position));
        const double distance = glm::distance(glm::dvec3(world[3]), 0.5 * (bounds.lower + bounds.upper));
        const JsonNode& camera = document_.element(*node.find("camera"), "cameras");
        const bool isUsable = distance > 0.0 && distance <= kFarthestPlace;
        mesh_.camera = readGltfCamera(camera, world, isUsable ? distance : 1.0, notes_);
        if (cameras.size() > 1) {
            mesh_.warnings.push_back(fmt::format("{}: has {} cameras: the first, {}, is used",
                                                 document_.path().string(), cameras.size(), camera.path()));
        }
    }

    void finishFiles() {
        mesh_.bytes = document_.size() + buffers_.fileBytes();
        mesh_.images = std::move(textures_.images());
        mesh_.files.insert(mesh_.files.end(), buffers_.files().begin(), buffers_.files().end());
        mesh_.files.insert(mesh_.files.end(), textures_.files().begin(), textures_.files().end());
    }

    GltfNotes notes_;
    const GltfDocument document_;
    GltfBuffers buffers_;
    GltfTextures textures_;
    GltfHierarchy hierarchy_;
    GltfGeometry geometry_;
    std::map<std::uint32_t, std::size_t> uses_;  ///< of each mesh, by nodes that are left to add
    std::map<std::uint32_t, Primitives> meshes_;
    std::map<std::uint32_t, std::vector<glm::dmat4>> skins_;
    std::map<std::optional<std::uint32_t>, std::uint32_t> materials_;  ///< in mesh_.materials
    Mesh mesh_;
};

}  // namespace

Mesh loadGltf(const fs::path& path, MaterialFiles& files) {
    return GltfLoader(path, files.reading()).run();
}

}  // namespace duolux
