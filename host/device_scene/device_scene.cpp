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
#include "host/device_scene/textures.h"
#include "host/device_scene/triangle_records.h"
#include "host/device_scene/vertex_records.h"
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

bool coloursScaleEmission(const Scene& scene) {
    const std::vector<bool> used = usedMaterials(scene);
    for (std::size_t i = 0; i < used.size() && !scene.geometry.colours.empty(); ++i) {
        if (used[i] && scene.materials[i].unlit) return true;
    }
    return false;
}

/// What the host prepares of materials and emitters.
struct MaterialsAndEmitters {
    std::vector<SceneEmitter> emitters;
    std::vector<std::uint32_t> triangles;  ///< that emit, ascending
    EmitterTable table;
    std::vector<shared::DeviceMaterial> materials;
    std::vector<shared::DeviceTexture> textures;
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

    /// The lookups of the materials in these images.
    void setTextures(const Scene& scene, const AtlasPlan& plan) {
        TextureTable lookups = makeTextureTable(scene, plan);
        textures = std::move(lookups.records);
        for (std::size_t i = 0; i < materials.size(); ++i) {
            materials[i].firstTexture = lookups.ranges[i].first;
            materials[i].textureCount = lookups.ranges[i].count;
        }
        transport.textureGroups = lookups.groups;
        if (coloursScaleEmission(scene)) transport.textureGroups |= 1u << shared::kGroupEmissionColour;
        // The closed form requires that neither emission nor normals vary over a surface.
        if (transport.emissionIsScaled() || transport.hasTextures(shared::kGroupNormal))
            transport.closedFormApplies = false;
    }

    /// The separate tree over emitters serves only rays that no surface blocks.
    bool needsTree() const {
        return transport.traits.transparency == shared::kTransparencyIdentity && !triangles.empty();
    }
};

/// The records of emitters that coincide with other surfaces, or whose emission varies, hold the index of
/// their triangle in device memory. Where emission varies, they have its corners in the same order.
void noteTriangles(MaterialsAndEmitters& prepared, const Geometry& geometry, const SurfacePlanes& surfaces,
                   const SceneTrees& trees) {
    const bool textured = prepared.transport.emissionVaries();
    if (!surfaces.used() && !textured) return;
    const std::vector<std::uint32_t> places = deviceTriangles(trees, geometry.triangles.size());
    for (std::size_t i = 0; i < prepared.triangles.size(); ++i) {
        const std::uint32_t triangle = prepared.triangles[i], place = places[triangle];
        shared::DeviceEmitter& record = prepared.table.records[i];
        record.triangle = place;
        if (surfaces.used() && surfaces.coincident(triangle)) record.flags |= shared::kEmitterCoincident;
        if (!textured) continue;
        const std::uint32_t turn = cornersOf(geometry, trees.pairs[place / 2]).value().turns[place % 2];
        const auto corner = [&](std::uint32_t k) {
            return geometry.positions[geometry.triangles[triangle][static_cast<int>((turn + k) % 3)]];
        };
        record.v0 = corner(0);
        record.v1 = corner(1);
        record.v2 = corner(2);
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
    std::span<const shared::DeviceTexture> textures;
    std::span<const shared::DeviceCorners> corners;
    std::span<const shared::DeviceVertex> vertices;
    std::span<const glm::vec4> secondUvs;
    AtlasPlan atlas;

    std::uint64_t bytes() const {
        const auto& [n, t, m, c, p, f, e, x, k, v, s, a] = *this;
        const auto sum = [](const auto&... spans) { return (std::uint64_t{spans.size_bytes()} + ...); };
        return sum(n, t, m, c, p, f, e, x, k, v, s) + a.texels * sizeof(glm::uvec4);
    }
};

Buffer uploadAtlas(const Device& device, const AtlasPlan& plan) {
    const auto write = [&](std::span<std::byte> out) {
        writeAtlas(plan, {reinterpret_cast<glm::uvec4*>(out.data()), plan.texels});
    };
    return Buffer::upload(device, BufferUse::kTexels, plan.texels * sizeof(glm::uvec4), "images", write);
}

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
        .textures = Buffer::upload(device, Use::kTexels, records.textures, "textures"),
        .atlas = uploadAtlas(device, records.atlas),
        .corners = Buffer::upload(device, Use::kTexels, records.corners, "corners of triangles"),
        .vertices = Buffer::upload(device, Use::kTexels, records.vertices, "vertices"),
        .secondUvs = Buffer::upload(device, Use::kTexels, records.secondUvs, "texture coordinates"),
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
    VertexNeeds needs = vertexNeeds(scene);
    const TriangleRecords triangles = makeTriangleRecords(
        geometry, trees.pairs, TriangleRanks(prepared.triangles), surfaces, needs.records);
    const VertexRecords vertices = makeVertexRecords(geometry, trees.pairs, needs);
    SceneRecords records{.nodes = trees.nodes,
                         .triangles = triangles.pairs,
                         .normals = triangles.normals,
                         .colours = triangles.colours,
                         .planes = triangles.planes,
                         .materials = prepared.materials,
                         .emitters = prepared.table.records,
                         .textures = {},
                         .corners = vertices.corners,
                         .vertices = vertices.vertices,
                         .secondUvs = vertices.secondUvs,
                         .atlas = {}};
    const std::uint64_t mostAtlasTexels = largestAtlas(device.info(), records.bytes());
    records.atlas = planAtlas(scene, mostAtlasTexels);
    prepared.setTextures(scene, records.atlas);
    noteTriangles(prepared, geometry, surfaces, trees);
    records.textures = prepared.textures;
    tuning.layout = layoutThatFits(device.info(), tuning.layout, choice,
                                   std::max(records.nodes.size_bytes(), records.triangles.size_bytes()));
    requireDeviceMemory(device.info(), records.bytes(), scene);
    DeviceScene out{
        .transport = prepared.transport,
        .choice = choice,
        .tuning = tuning,
        .hasSmoothNormals = !geometry.normals.empty(),
        .hasVertexColours = !triangles.colours.empty(),
        .hasPlanes = surfaces.used(),
        .vertexNeeds = std::move(needs),
        .atlas = records.atlas,
        .mostAtlasTexels = mostAtlasTexels,
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

bool DeviceScene::isPlain() const {
    return transport.traits.lobes == shared::kLobeDiffuse && transport.textureGroups == 0 &&
           !transport.traits.coverage;
}

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
    const AtlasPlan plan = planAtlas(scene, deviceScene.mostAtlasTexels);
    prepared.setTextures(scene, plan);
    const bool sameTextures = plan == deviceScene.atlas && vertexNeeds(scene) == deviceScene.vertexNeeds &&
                              !prepared.transport.emissionVaries() && !deviceScene.transport.emissionVaries();
    if (!sameTriangles || !sameTextures) {
        DeviceScene updated =
            assemble(device, scene, std::move(prepared), deviceScene.choice, deviceScene.tree);
        updated.tree = std::move(deviceScene.tree);
        deviceScene = std::move(updated);
        return;
    }
    Buffer textures =
        Buffer::upload<shared::DeviceTexture>(device, BufferUse::kTexels, prepared.textures, "textures");
    Buffer materials =
        Buffer::upload<shared::DeviceMaterial>(device, BufferUse::kTexels, prepared.materials, "materials");
    deviceScene.buffers.emitters =
        Buffer::upload<shared::DeviceEmitter>(device, BufferUse::kTexels, prepared.table.records, "emitters");
    deviceScene.buffers.materials = std::move(materials);
    deviceScene.buffers.textures = std::move(textures);
    deviceScene.transport = prepared.transport;
    deviceScene.buildSeconds = 0.0;
    deviceScene.uploadSeconds = secondsSince(start);
}

}  // namespace duolux
