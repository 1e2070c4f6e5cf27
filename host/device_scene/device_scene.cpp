#include "host/device_scene/device_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <tuple>

#include "host/base/error.h"
#include "host/base/parallel.h"
#include "host/device_scene/emitter_table.h"
#include "host/device_scene/surface_planes.h"
#include "host/scene/emitters.h"
#include "shaders/shared/bvh_layout.h"

namespace duolux {

namespace {

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::uint32_t octahedralEncode(glm::vec3 n) {
    n /= std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    glm::vec2 e(n.x, n.y);
    if (n.z < 0.0f) {
        e = {(1.0f - std::abs(n.y)) * (n.x >= 0.0f ? 1.0f : -1.0f),
             (1.0f - std::abs(n.x)) * (n.y >= 0.0f ? 1.0f : -1.0f)};
    }
    const auto snorm = [](float x) {
        return static_cast<std::uint32_t>(std::lround(glm::clamp(x, -1.0f, 1.0f) * 32767.0f)) & 0xffffu;
    };
    return snorm(e.x) | snorm(e.y) << 16;
}

/// See decodeColour in shaders/lib/vertex_colour.glsl.
std::uint32_t encodeColour(const glm::vec3& colour) {
    const glm::vec3 root = glm::sqrt(glm::clamp(colour, 0.0f, 1.0f)) * 1023.0f;
    const auto rounded = [](float x) { return static_cast<std::uint32_t>(std::lround(x)); };
    return rounded(root.x) | rounded(root.y) << 10 | rounded(root.z) << 20;
}

bool isSmooth(const Geometry& geometry, std::uint32_t triangle) {
    return !geometry.normals.empty() && geometry.normalIndices[triangle].x != Geometry::kNoNormal;
}

std::uint32_t materialFlags(const Geometry& geometry, std::uint32_t triangle) {
    return geometry.materials[triangle] | (isSmooth(geometry, triangle) ? shared::kTriangleSmooth : 0u);
}

shared::DevicePair devicePair(const Geometry& geometry, const TriangleRanks& ranks, const TrianglePair& pair,
                              const PairCorners& corners) {
    const auto position = [&](std::size_t corner) { return geometry.positions[corners.positions[corner]]; };
    const std::uint32_t second = pair.isSingle() ? pair.first : pair.second;
    const std::uint32_t secondRank = pair.isSingle() ? TrianglePair::kNone : ranks.rankOf(pair.second);
    return {position(0), ranks.rankOf(pair.first),
            position(1), materialFlags(geometry, second),
            position(2), materialFlags(geometry, pair.first),
            position(3), secondRank};
}

/// `turn`: the index of the corner that comes first.
shared::DeviceNormals deviceNormals(const Geometry& geometry, std::uint32_t triangle, std::uint32_t turn) {
    if (triangle == TrianglePair::kNone || !isSmooth(geometry, triangle)) return {};
    const glm::uvec3 index = geometry.normalIndices[triangle];
    const auto normal = [&](std::uint32_t corner) {
        return octahedralEncode(geometry.normals[index[static_cast<int>((turn + corner) % 3)]]);
    };
    return {{normal(0), normal(1), normal(2)}, 0};
}

/// As deviceNormals.
shared::DeviceColours deviceColours(const Geometry& geometry, std::uint32_t triangle, std::uint32_t turn) {
    if (triangle == TrianglePair::kNone) return {};
    const glm::uvec3 index = geometry.triangles[triangle];
    const auto colour = [&](std::uint32_t corner) {
        return encodeColour(geometry.colours[index[static_cast<int>((turn + corner) % 3)]]);
    };
    return {{colour(0), colour(1), colour(2)}, 0};
}

/// The tree over all triangles, followed by the tree over copies of the emitters.
struct Trees {
    std::vector<shared::WideNode> nodes;
    std::vector<TrianglePair> pairs;  // in the order of the leaves
    std::uint32_t emitterRoot = 0;

    std::uint64_t largestBuffer() const {
        return std::max(nodes.size() * sizeof(shared::WideNode), pairs.size() * sizeof(shared::DevicePair));
    }
};

/// The input of the driver's trees: all triangles, followed by copies of the emitters.
Trees listTriangles(const Geometry& geometry, std::span<const std::uint32_t> emitters) {
    Trees trees;
    trees.pairs = pairTriangles(geometry, allTriangles(geometry));
    if (emitters.empty()) return trees;
    trees.emitterRoot = 2 * static_cast<std::uint32_t>(trees.pairs.size());
    const std::vector<TrianglePair> second = pairTriangles(geometry, emitters);
    trees.pairs.insert(trees.pairs.end(), second.begin(), second.end());
    return trees;
}

AccelerationStructure buildStructure(const Device& device, const Buffer& buffer, const Trees& trees) {
    const auto count = static_cast<std::uint32_t>(trees.pairs.size());
    const std::uint32_t emitters = trees.emitterRoot > 0 ? count - trees.emitterRoot / 2 : 0;
    const auto part = [](std::uint32_t firstPair, std::uint32_t pairs, std::uint32_t mask) {
        return AccelerationStructure::Part{shared::kPairTexels * firstPair, shared::kPairTexels * pairs,
                                           2 * pairs, static_cast<std::uint8_t>(mask)};
    };
    std::vector<AccelerationStructure::Part> parts{part(0, count - emitters, shared::kMaskAll)};
    if (emitters > 0) parts.push_back(part(count - emitters, emitters, shared::kMaskEmitters));
    // The emitters alone may have more pairs than the rest of the scene.
    const std::uint32_t most = std::max(count - emitters, emitters);
    std::vector<std::uint32_t> indices;
    indices.reserve(std::size_t{6} * most);
    for (std::uint32_t pair = 0; pair < most; ++pair) {
        for (const std::uint32_t corner : {0u, 1u, 2u, 3u, 2u, 1u})
            indices.push_back(shared::kPairTexels * pair + corner);
    }
    return {device, buffer, indices, parts};
}

/// The tree over all triangles, and one over the emitters behind it.
Trees joinTrees(const Geometry& geometry, const WideBvh& all, std::span<const std::uint32_t> emitters) {
    Trees trees{all.nodes, all.pairs, 0};
    if (emitters.empty()) return trees;
    const WideBvh second = buildWideBvh(geometry, emitters);
    trees.emitterRoot = static_cast<std::uint32_t>(trees.nodes.size());
    const auto firstPair = static_cast<std::uint32_t>(trees.pairs.size());
    for (shared::WideNode node : second.nodes) {
        node.childBase += trees.emitterRoot;
        node.pairBase += firstPair;
        trees.nodes.push_back(node);
    }
    trees.pairs.insert(trees.pairs.end(), second.pairs.begin(), second.pairs.end());
    return trees;
}

/// The separate tree over emitters serves only rays that no surface blocks.
bool needsEmitterTree(const TransportTraits& traits, std::span<const std::uint32_t> emitters) {
    return traits.transparency == shared::kTransparencyIdentity && !emitters.empty();
}

EmitterTable emitterTableOf(const Scene& scene, std::span<const SceneEmitter> emitters,
                            const TransportTraits& traits, Integrator integrator) {
    return buildEmitterTable(scene, emitters, traits.secondColumn || integrator == Integrator::kLightTracer);
}

bool hasClosedForm(const TransportTraits& traits, bool smoothNormals, std::size_t emitters) {
    return traits.transparency == shared::kTransparencyIdentity && traits.lobes == shared::kLobeDiffuse &&
           !smoothNormals && emitters > 0 && emitters <= kMostClosedFormEmitters;
}

/// For each triangle of the scene, its index in device memory (or that of a copy).
std::vector<std::uint32_t> deviceTriangles(const Trees& trees, std::size_t count) {
    std::vector<std::uint32_t> places(count);
    for (std::uint32_t i = 0; i < trees.pairs.size(); ++i) {
        places[trees.pairs[i].first] = 2 * i;
        if (!trees.pairs[i].isSingle()) places[trees.pairs[i].second] = 2 * i + 1;
    }
    return places;
}

void storeMatrix(const ReflectanceMatrix& m, glm::vec4 (&out)[4]) {
    out[0] = glm::vec4(m.m00, 0.0f);
    out[1] = glm::vec4(m.m01, 0.0f);
    out[2] = glm::vec4(m.m10, 0.0f);
    out[3] = glm::vec4(m.m11, 0.0f);
}

Bounds widenedBounds(const Geometry& geometry, std::span<const std::uint32_t> triangles) {
    Bounds bounds{glm::vec3(0.0f), glm::vec3(0.0f)};
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            const glm::vec3 p = geometry.positions[geometry.triangles[triangles[i]][k]];
            const bool first = i == 0 && k == 0;
            bounds.lower = first ? p : glm::min(bounds.lower, p);
            bounds.upper = first ? p : glm::max(bounds.upper, p);
        }
    }
    constexpr float kMargin = 1e-3f;  // relative to the diagonal of the bounds and to the coordinates
    const glm::vec3 largest = glm::max(glm::abs(bounds.lower), glm::abs(bounds.upper));
    const glm::vec3 margin = kMargin * (glm::vec3(glm::length(bounds.upper - bounds.lower)) + largest);
    return {bounds.lower - margin, bounds.upper + margin};
}

std::vector<shared::DeviceMaterial> deviceMaterials(const Scene& scene) {
    std::vector<shared::DeviceMaterial> out;
    for (const Material& material : scene.materials) {
        // All fields by name: a further one does not compile until it is handled here.
        const auto& [name, baseColor, metallic, roughness, sides, emission, ownReflectance] = material;
        static_cast<void>(std::tie(name, emission, ownReflectance));  // elsewhere, or resolved below
        shared::DeviceMaterial d{};
        d.baseColor = baseColor;
        d.metallic = metallic;
        d.roughness = roughness;
        d.flags = sides == Sides::kBoth ? shared::kMaterialTwoSided : 0u;
        const Reflectance& reflectance = scene.reflectanceOf(material);
        storeMatrix(reflectance.opaque, d.opaque);
        storeMatrix(reflectance.transparent, d.transparent);
        out.push_back(d);
    }
    return out;
}

}  // namespace

std::vector<Binding> DeviceScene::treeBindings() const {
    const Binding nodesBinding = structure ? Binding{shared::kBindingNodes, nullptr, &*structure}
                                           : Binding{shared::kBindingNodes, &nodes};
    return {nodesBinding, {shared::kBindingTriangles, &triangles}};
}

std::uint64_t DeviceScene::deviceBytes() const {
    return nodes.allocated() + triangles.allocated() + normals.allocated() + colours.allocated() +
           materials.allocated() + emitterRecords.allocated() + planes.allocated() +
           (structure ? structure->allocated() : 0);
}

void requireDeviceMemory(const DeviceInfo& device, std::uint64_t bytes, const Scene& scene) {
    if (device.kind != DeviceKind::kGpu || bytes <= device.memoryBytes) return;
    throw MemoryError(
        fmt::format("{}: {} triangles take {} MiB of device memory, but {} ({}) has {}; expected fewer "
                    "triangles, or a device with more memory, as the cpu",
                    scene.source.string(), scene.geometry.triangles.size(), (bytes >> 20) + 1, device.name,
                    device.driver, device.memoryBytes >> 20));
}

namespace {

/// All but the tree over all triangles, which took `buildSeconds` to build.
DeviceScene assemble(const Device& device, const Scene& scene, Integrator integrator,
                     const TuningChoice& choice, WideBvh tree, double buildSeconds) {
    const Geometry& geometry = scene.geometry;
    const TransportTraits traits = analyseTransport(scene);
    Tuning tuning = chooseTuning(device.info(), choice);
    const bool rayQueries = tuning.layout == Layout::kRayQuery;

    auto start = std::chrono::steady_clock::now();
    const std::vector<SceneEmitter> allEmitters = listEmitters(scene);
    std::vector<std::uint32_t> emitters = emittingTriangles(allEmitters);
    const bool emitterTree = needsEmitterTree(traits, emitters);
    const std::span<const std::uint32_t> inTree =
        emitterTree ? std::span<const std::uint32_t>(emitters) : std::span<const std::uint32_t>();
    const Trees trees = rayQueries ? listTriangles(geometry, inTree) : joinTrees(geometry, tree, inTree);
    tuning.layout = layoutThatFits(device.info(), tuning.layout, choice, trees.largestBuffer());
    buildSeconds += secondsSince(start);

    start = std::chrono::steady_clock::now();
    const SurfacePlanes surfaces(geometry);
    const TriangleRanks ranks(emitters);
    std::vector<glm::vec4> planes(surfaces.used() ? 2 * trees.pairs.size() : 0);
    std::vector<shared::DevicePair> pairs(trees.pairs.size());
    std::vector<shared::DeviceNormals> normals(geometry.normals.empty() ? 0 : 2 * pairs.size());
    std::vector<shared::DeviceColours> colours(geometry.colours.empty() ? 0 : 2 * pairs.size());
    parallelFor(pairs.size(), 1 << 15, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const TrianglePair& pair = trees.pairs[i];
            const PairCorners corners = cornersOf(geometry, pair).value();
            pairs[i] = devicePair(geometry, ranks, pair, corners);
            for (std::size_t k = 0; k < (surfaces.used() ? (pair.isSingle() ? 1 : 2) : 0); ++k) {
                planes[2 * i + k] = surfaces.planeOf(k == 0 ? pair.first : pair.second);
            }
            if (!colours.empty()) {
                colours[2 * i] = deviceColours(geometry, pair.first, corners.turns[0]);
                colours[2 * i + 1] = deviceColours(geometry, pair.second, corners.turns[1]);
            }
            if (normals.empty()) continue;
            normals[2 * i] = deviceNormals(geometry, pair.first, corners.turns[0]);
            normals[2 * i + 1] = deviceNormals(geometry, pair.second, corners.turns[1]);
        }
    });
    EmitterTable table = emitterTableOf(scene, allEmitters, traits, integrator);
    if (surfaces.used()) {
        const std::vector<std::uint32_t> places = deviceTriangles(trees, geometry.triangles.size());
        for (std::size_t i = 0; i < emitters.size(); ++i) {
            table.records[i].triangle = places[emitters[i]];
            if (surfaces.coincident(emitters[i])) table.records[i].flags |= shared::kEmitterCoincident;
        }
    }
    requireDeviceMemory(
        device.info(),
        trees.nodes.size() * sizeof(shared::WideNode) + pairs.size() * sizeof(shared::DevicePair) +
            normals.size() * sizeof(shared::DeviceNormals) + colours.size() * sizeof(shared::DeviceColours) +
            scene.materials.size() * sizeof(shared::DeviceMaterial) +
            table.records.size() * sizeof(shared::DeviceEmitter) + planes.size() * sizeof(glm::vec4),
        scene);
    using Use = BufferUse;
    const Use treeUse = tuning.layout == Layout::kStorage ? Use::kStorage : Use::kTexels;
    DeviceScene out{
        .traits = traits,
        .choice = choice,
        .tuning = tuning,
        .hasSmoothNormals = !normals.empty(),
        .hasVertexColours = !colours.empty(),
        .hasPlanes = surfaces.used(),
        .closedFormApplies = hasClosedForm(traits, !normals.empty(), table.choices),
        .emitterKinds = emitterKinds(allEmitters),
        .emitterChoices = table.choices,
        .emitterRoot = trees.emitterRoot,
        .emitterBounds = widenedBounds(geometry, emitters),
        .brightestEmission = brightestEmission(scene),
        .buildSeconds = buildSeconds,
        .nodes = Buffer::upload<shared::WideNode>(device, treeUse, trees.nodes, "BVH nodes"),
        .triangles = Buffer::upload<shared::DevicePair>(device, treeUse, pairs, "triangles",
                                                        rayQueries ? TreeUse::kInput : TreeUse::kNone),
        .normals = Buffer::upload<shared::DeviceNormals>(device, Use::kTexels, normals, "normals"),
        .colours = Buffer::upload<shared::DeviceColours>(device, Use::kTexels, colours, "colours"),
        .materials =
            Buffer::upload<shared::DeviceMaterial>(device, Use::kTexels, deviceMaterials(scene), "materials"),
        .emitterRecords =
            Buffer::upload<shared::DeviceEmitter>(device, Use::kTexels, table.records, "emitters"),
        .planes = Buffer::upload<glm::vec4>(device, Use::kTexels, planes, "planes"),
        .tree = std::move(tree),
        .emitters = std::move(emitters),
    };
    out.uploadSeconds = secondsSince(start);
    if (rayQueries) {
        start = std::chrono::steady_clock::now();
        out.structure.emplace(buildStructure(device, out.triangles, trees));
        out.buildSeconds += secondsSince(start);
    }
    return out;
}

}  // namespace

DeviceScene uploadScene(const Device& device, const Scene& scene, Integrator integrator,
                        const TuningChoice& choice) {
    const auto start = std::chrono::steady_clock::now();
    WideBvh tree;
    if (chooseTuning(device.info(), choice).layout != Layout::kRayQuery)
        tree = buildWideBvh(scene.geometry, allTriangles(scene.geometry));
    return assemble(device, scene, integrator, choice, std::move(tree), secondsSince(start));
}

void updateScene(DeviceScene& deviceScene, const Device& device, const Scene& scene, Integrator integrator) {
    const TransportTraits traits = analyseTransport(scene);
    const std::vector<SceneEmitter> allEmitters = listEmitters(scene);
    const std::vector<std::uint32_t> emitters = emittingTriangles(allEmitters);
    // Emitters are in a tree of their own, and first among surfaces that coincide.
    const bool sameTriangles = (deviceScene.emitterRoot != 0) == needsEmitterTree(traits, emitters) &&
                               emitters == deviceScene.emitters && !deviceScene.hasPlanes;
    if (!sameTriangles) {
        deviceScene =
            assemble(device, scene, integrator, deviceScene.choice, std::move(deviceScene.tree), 0.0);
        return;
    }
    const auto start = std::chrono::steady_clock::now();
    const EmitterTable table = emitterTableOf(scene, allEmitters, traits, integrator);
    deviceScene.traits = traits;
    deviceScene.closedFormApplies = hasClosedForm(traits, deviceScene.hasSmoothNormals, table.choices);
    deviceScene.emitterKinds = emitterKinds(allEmitters);
    deviceScene.emitterChoices = table.choices;
    deviceScene.brightestEmission = brightestEmission(scene);
    deviceScene.materials = Buffer::upload<shared::DeviceMaterial>(device, BufferUse::kTexels,
                                                                   deviceMaterials(scene), "materials");
    deviceScene.emitterRecords =
        Buffer::upload<shared::DeviceEmitter>(device, BufferUse::kTexels, table.records, "emitters");
    deviceScene.buildSeconds = 0.0;
    deviceScene.uploadSeconds = secondsSince(start);
}

}  // namespace duolux
