#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "host/bvh/wide_bvh.h"
#include "host/device_scene/textures.h"
#include "host/device_scene/transport.h"
#include "host/device_scene/tuning.h"
#include "host/device_scene/vertex_records.h"
#include "host/scene/scene.h"
#include "host/vk/acceleration_structure.h"
#include "host/vk/buffer.h"
#include "host/vk/device.h"
#include "host/vk/kernel.h"
#include "shaders/shared/kernel_interface.h"

namespace duolux {

/// Scenes with more emitters use next-event estimation instead of the closed form.
inline constexpr std::size_t kMostClosedFormEmitters = 16;

/// The buffers of a scene, in the records of shaders/shared.
struct SceneBuffers {
    Buffer nodes;  ///< empty with Layout::kRayQuery
    Buffer triangles, normals, colours, planes, materials, emitters;
    Buffer textures, atlas, corners, vertices, secondUvs;
    Buffer albedo;  ///< the tables of shaders/shared/albedo_layout.h
};

/// Calls visit(binding, buffer) for every buffer: a further one does not compile until it is handled here.
template <typename Visit>
void forEachBuffer(const SceneBuffers& buffers, Visit&& visit) {
    const auto& [nodes, triangles, normals, colours, planes, materials, emitters, textures, atlas, corners,
                 vertices, secondUvs, albedo] = buffers;
    visit(shared::kBindingNodes, nodes);
    visit(shared::kBindingTriangles, triangles);
    visit(shared::kBindingNormals, normals);
    visit(shared::kBindingColours, colours);
    visit(shared::kBindingPlanes, planes);
    visit(shared::kBindingMaterials, materials);
    visit(shared::kBindingEmitters, emitters);
    visit(shared::kBindingTextures, textures);
    visit(shared::kBindingAtlas, atlas);
    visit(shared::kBindingCorners, corners);
    visit(shared::kBindingVertices, vertices);
    visit(shared::kBindingSecondUvs, secondUvs);
    visit(shared::kBindingAlbedo, albedo);
}

/// What follows from materials, reflectances and emitters.
struct LightTransport {
    TransportTraits traits;
    /// Direct light has a closed form: nothing can block an emitter, surfaces are diffuse and flat, and there
    /// are so few emitters that evaluating the formula for each costs no more than sampling one.
    bool closedFormApplies = false;
    std::uint32_t emitterKinds = 0;    ///< sum of shared::kEmitterKind...
    std::uint32_t emitterChoices = 0;  ///< as in EmitterTable
    double brightestEmission = 0.0;    ///< as duolux::brightestEmission
    std::uint32_t textureGroups = 0;   ///< as TextureTable::groups, and shared::kGroupEmissionColour

    bool hasTextures(std::uint32_t group) const { return (textureGroups >> group & 1u) != 0; }
    /// Images or colours of vertices scale the emission of some material.
    bool emissionIsScaled() const {
        return hasTextures(shared::kGroupEmission) || hasTextures(shared::kGroupEmissionColour);
    }
    /// Emission may differ between the points of a triangle.
    bool emissionVaries() const { return emissionIsScaled() || traits.coverage; }
};

/// A scene in device memory.
struct DeviceScene {
    LightTransport transport;
    TuningChoice choice;  ///< the caller's, from which `tuning` follows
    Tuning tuning;
    bool hasSmoothNormals = false, hasVertexColours = false;
    bool hasPlanes = false;   ///< distances are computed from stored planes, see SurfacePlanes
    VertexNeeds vertexNeeds;  ///< for which the buffers were made
    AtlasPlan atlas;          ///< of the images in the buffers; its warning is for the user
    std::uint64_t mostAtlasTexels = 0;
    std::uint32_t emitterRoot = 0;  ///< as in shared::PathParams
    Bounds emitterBounds{};  ///< of the emitting triangles, enlarged by more than the rounding error of a hit
    double buildSeconds = 0.0, uploadSeconds = 0.0;

    SceneBuffers buffers;
    std::optional<AccelerationStructure> structure{};  ///< with Layout::kRayQuery

    WideBvh tree;  ///< over all triangles, on the host; empty with Layout::kRayQuery
    std::vector<std::uint32_t> emittingTriangles;  ///< ascending

    /// What kernels bind of the scene.
    std::vector<Binding> bindings() const;
    /// The part of it that traversal needs.
    std::vector<Binding> treeBindings() const;
    std::uint64_t deviceBytes() const;

    /// All surfaces are diffuse, without images, and there entirely: kernels need no code for anything else.
    bool isPlain() const;
};

/// Throws MemoryError, with the numbers, if a scene of this size does not fit into the memory of a GPU. Not
/// checked for software drivers, which use the host's memory whatever they report.
void requireDeviceMemory(const DeviceInfo& device, std::uint64_t bytes, const Scene& scene);

/// Builds the trees and uploads the scene for one of the integrators. Throws MemoryError or DeviceError if it
/// does not fit the device, and UsageError if the device does not support the requested tuning.
DeviceScene uploadScene(const Device& device, const Scene& scene,
                        Integrator integrator = Integrator::kPathTracer, const TuningChoice& choice = {});

/// Brings the device up to date with a scene of the same geometry, which may have other materials,
/// reflectances and point emitters, and with the integrator, which may be another one. Uploads only the
/// records of materials, textures and emitters if all of this holds:
///   - the same triangles emit, and emission does not vary over a triangle, before and after;
///   - the materials use the same images and the same parts of vertices;
///   - no surfaces coincide (DeviceScene::hasPlanes);
///   - light passes unchanged through all surfaces (kTransparencyIdentity, which requires a tree over the
///     emitters) both before and after, or neither.
/// Otherwise uploads everything again. The tree over all triangles is kept on the host, and only that over
/// the emitters is built; with Layout::kRayQuery the driver builds its whole structure again. Throws like
/// uploadScene; the device then keeps the previous scene.
void updateScene(DeviceScene& deviceScene, const Device& device, const Scene& scene, Integrator integrator);

}  // namespace duolux
