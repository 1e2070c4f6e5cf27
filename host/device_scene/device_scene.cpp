#include "host/device_scene/device_scene.h"

#include <fmt/format.h>

#include <chrono>
#include <span>
#include <utility>

#include "host/albedo/albedo_tables.h"
#include "host/base/clock.h"
#include "host/base/error.h"
#include "host/device_scene/emitter_table.h"
#include "host/device_scene/material_records.h"
#include "host/device_scene/scene_trees.h"
#include "host/device_scene/surface_planes.h"
#include "host/device_scene/triangle_records.h"
#include "host/scene/emitters.h"

namespace duolux {

namespace {

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

/// What the host prepares of materials and emitters.
struct MaterialsAndEmitters {
    std::vector<SceneEmitter> emitters;
    std::vector<std::uint32_t> triangles;  ///< that emit, ascending
    EmitterTable table;
    std::vector<shared::DeviceMaterial> materials;
    LightTransport transport;

    MaterialsAndEmitters(const Scene& scene, Integrator integrator)
        : emitters(listEmitters(scene)),
          triangles(duolux::emittingTriangles(emitters)),
          materials(makeMaterialRecords(scene)) {
        TransportTraits& traits = transport.traits;
        traits = analyseTransport(scene);
        table =
            buildEmitterTable(scene, emitters, traits.secondColumn || integrator == Integrator::kLightTracer);
        transport.emitterKinds = duolux::emitterKinds(emitters);
        transport.emitterChoices = table.choices;
        transport.brightestEmission = duolux::brightestEmission(scene.geometry, emitters);
        transport.closedFormApplies =
            traits.transparency == shared::kTransparencyIdentity && traits.lobes == shared::kLobeDiffuse &&
            scene.geometry.normals.empty() && table.choices > 0 && table.choices <= kMostClosedFormEmitters &&
            (transport.emitterKinds & ~shared::kEmitterKindsWithClosedForm) == 0;
    }

    /// The separate tree over emitters serves only rays that no surface blocks.
    bool needsTree() const {
        return transport.traits.transparency == shared::kTransparencyIdentity && !triangles.empty();
    }
};

/// Emitters that coincide with other surfaces need to know their triangle in device memory.
void noteCoincident(MaterialsAndEmitters& prepared, const SurfacePlanes& surfaces, const SceneTrees& trees,
                    std::size_t triangleCount) {
    const std::vector<std::uint32_t> places = deviceTriangles(trees, triangleCount);
    for (std::size_t i = 0; i < prepared.triangles.size(); ++i) {
        shared::DeviceEmitter& record = prepared.table.records[i];
        record.triangle = places[prepared.triangles[i]];
        if (surfaces.coincident(prepared.triangles[i])) record.flags |= shared::kEmitterCoincident;
    }
}

/// The contents of SceneBuffers.
struct SceneRecords {
    std::span<const shared::WideNode> nodes;
    std::span<const shared::DevicePair> triangles;
    std::span<const shared::DeviceNormals> normals;
    std::span<const shared::DeviceColours> colours;
    std::span<const glm::vec4> planes;
    std::span<const shared::DeviceMaterial> materials;
    std::span<const shared::DeviceEmitter> emitters;

    std::uint64_t bytes() const {
        const auto& [n, t, m, c, p, f, e] = *this;
        const auto sum = [](const auto&... spans) { return (std::uint64_t{spans.size_bytes()} + ...); };
        return sum(n, t, m, c, p, f, e);
    }
};

SceneBuffers uploadRecords(const Device& device, Layout layout, const SceneRecords& records) {
    using Use = BufferUse;
    const Use treeUse = layout == Layout::kStorage ? Use::kStorage : Use::kTexels;
    const TreeUse pairUse = layout == Layout::kRayQuery ? TreeUse::kInput : TreeUse::kNone;
    return {
        .nodes = Buffer::upload(device, treeUse, records.nodes, "BVH nodes"),
        .triangles = Buffer::upload(device, treeUse, records.triangles, "triangles", pairUse),
        .normals = Buffer::upload(device, Use::kTexels, records.normals, "normals"),
        .colours = Buffer::upload(device, Use::kTexels, records.colours, "colours"),
        .planes = Buffer::upload(device, Use::kTexels, records.planes, "planes"),
        .materials = Buffer::upload(device, Use::kTexels, records.materials, "materials"),
        .emitters = Buffer::upload(device, Use::kTexels, records.emitters, "emitters"),
        .albedo = Buffer::upload(device, Use::kTexels, albedoTables(), "albedo tables"),
    };
}

/// All but the tree over all triangles: `tree`, unless the driver builds it.
DeviceScene assemble(const Device& device, const Scene& scene, MaterialsAndEmitters prepared,
                     const TuningChoice& choice, const WideBvh& tree) {
    const Geometry& geometry = scene.geometry;
    Tuning tuning = chooseTuning(device.info(), choice);
    const bool rayQueries = tuning.layout == Layout::kRayQuery;

    auto start = std::chrono::steady_clock::now();
    const std::span<const std::uint32_t> inTree = prepared.needsTree()
                                                      ? std::span<const std::uint32_t>(prepared.triangles)
                                                      : std::span<const std::uint32_t>();
    const SceneTrees trees = rayQueries ? listTriangles(geometry, inTree) : joinTrees(geometry, tree, inTree);
    double buildSeconds = secondsSince(start);

    start = std::chrono::steady_clock::now();
    const SurfacePlanes surfaces(geometry);
    const TriangleRecords triangles =
        makeTriangleRecords(geometry, trees.pairs, TriangleRanks(prepared.triangles), surfaces);
    if (surfaces.used()) noteCoincident(prepared, surfaces, trees, geometry.triangles.size());
    const SceneRecords records{trees.nodes,      triangles.pairs,    triangles.normals,     triangles.colours,
                               triangles.planes, prepared.materials, prepared.table.records};
    tuning.layout = layoutThatFits(device.info(), tuning.layout, choice,
                                   std::max(records.nodes.size_bytes(), records.triangles.size_bytes()));
    requireDeviceMemory(device.info(), records.bytes(), scene);
    DeviceScene out{
        .transport = prepared.transport,
        .choice = choice,
        .tuning = tuning,
        .hasSmoothNormals = !triangles.normals.empty(),
        .hasVertexColours = !triangles.colours.empty(),
        .hasPlanes = surfaces.used(),
        .emitterRoot = trees.emitterRoot,
        .emitterBounds = widenedBounds(geometry, prepared.triangles),
        .buffers = uploadRecords(device, tuning.layout, records),
        .tree = {},
        .emittingTriangles = std::move(prepared.triangles),
    };
    out.uploadSeconds = secondsSince(start);
    if (rayQueries) {
        start = std::chrono::steady_clock::now();
        out.structure.emplace(buildStructure(device, out.buffers.triangles, trees));
        buildSeconds += secondsSince(start);
    }
    out.buildSeconds = buildSeconds;
    return out;
}

}  // namespace

std::vector<Binding> DeviceScene::bindings() const {
    std::vector<Binding> all;
    forEachBuffer(buffers, [&](std::uint32_t binding, const Buffer& buffer) {
        const bool isStructure = structure && binding == shared::kBindingNodes;
        all.push_back(isStructure ? Binding{binding, nullptr, &*structure} : Binding{binding, &buffer});
    });
    return all;
}

std::vector<Binding> DeviceScene::treeBindings() const {
    std::vector<Binding> all = bindings();
    std::erase_if(all, [](const Binding& b) {
        return b.binding != shared::kBindingNodes && b.binding != shared::kBindingTriangles;
    });
    return all;
}

std::uint64_t DeviceScene::deviceBytes() const {
    std::uint64_t bytes = structure ? structure->allocated() : 0;
    forEachBuffer(buffers, [&](std::uint32_t, const Buffer& buffer) { bytes += buffer.allocated(); });
    return bytes;
}

void requireDeviceMemory(const DeviceInfo& device, std::uint64_t bytes, const Scene& scene) {
    if (device.kind != DeviceKind::kGpu || bytes <= device.memoryBytes) return;
    throw MemoryError(
        fmt::format("{}: {} triangles take {} MiB of device memory, but {} ({}) has {}; expected fewer "
                    "triangles, or a device with more memory, such as the CPU",
                    scene.source.string(), scene.geometry.triangles.size(), (bytes >> 20) + 1, device.name,
                    device.driver, device.memoryBytes >> 20));
}

DeviceScene uploadScene(const Device& device, const Scene& scene, Integrator integrator,
                        const TuningChoice& choice) {
    const auto start = std::chrono::steady_clock::now();
    WideBvh tree;
    if (chooseTuning(device.info(), choice).layout != Layout::kRayQuery)
        tree = buildWideBvh(scene.geometry, allTriangles(scene.geometry));
    const double seconds = secondsSince(start);
    DeviceScene out = assemble(device, scene, MaterialsAndEmitters(scene, integrator), choice, tree);
    out.buildSeconds += seconds;
    out.tree = std::move(tree);
    return out;
}

void updateScene(DeviceScene& deviceScene, const Device& device, const Scene& scene, Integrator integrator) {
    const auto start = std::chrono::steady_clock::now();
    MaterialsAndEmitters prepared(scene, integrator);
    // Emitters are in a tree of their own, and first among surfaces that coincide.
    const bool sameTriangles = (deviceScene.emitterRoot != 0) == prepared.needsTree() &&
                               prepared.triangles == deviceScene.emittingTriangles && !deviceScene.hasPlanes;
    if (!sameTriangles) {
        DeviceScene updated =
            assemble(device, scene, std::move(prepared), deviceScene.choice, deviceScene.tree);
        updated.tree = std::move(deviceScene.tree);
        deviceScene = std::move(updated);
        return;
    }
    Buffer materials =
        Buffer::upload<shared::DeviceMaterial>(device, BufferUse::kTexels, prepared.materials, "materials");
    deviceScene.buffers.emitters =
        Buffer::upload<shared::DeviceEmitter>(device, BufferUse::kTexels, prepared.table.records, "emitters");
    deviceScene.buffers.materials = std::move(materials);
    deviceScene.transport = prepared.transport;
    deviceScene.buildSeconds = 0.0;
    deviceScene.uploadSeconds = secondsSince(start);
}

}  // namespace duolux
