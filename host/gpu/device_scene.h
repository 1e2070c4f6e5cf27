#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "host/gpu/transport.h"
#include "host/gpu/tuning.h"
#include "host/scene/scene.h"
#include "host/vk/acceleration_structure.h"
#include "host/vk/buffer.h"
#include "host/vk/device.h"
#include "host/vk/kernel.h"

namespace duolux {

/// More emitting triangles than this are sampled.
inline constexpr std::size_t kMostClosedFormLights = 16;

/// A scene in device memory, in the records of shaders/shared.
struct DeviceScene {
    TransportTraits traits;
    Tuning tuning;
    bool hasEmitters = false;  ///< some triangle emits; then there is a tree over the emitting ones
    bool hasSmoothNormals = false;
    bool hasPlanes = false;  ///< distances are found by planes, see SurfacePlanes
    /// Direct light has a closed form: nothing can be between a surface and an emitter, normals are flat, and
    /// the emitters are so few that a formula for each costs no more than sampling one.
    bool closedFormApplies = false;
    std::uint32_t lightCount = 0;    ///< triangles that next-event estimation samples
    std::uint32_t emitterRoot = 0;   ///< as in shared::PathParams
    Bounds emitterBounds{};          ///< of what emits, widened by more than rounding can move a hit
    double brightestEmission = 0.0;  ///< radiance
    double buildSeconds = 0.0, uploadSeconds = 0.0;

    Buffer nodes;  ///< empty with Layout::kRayQuery
    Buffer triangles, normals, materials, lights, planes;
    std::optional<AccelerationStructure> structure{};  ///< with Layout::kRayQuery

    /// What the traversal needs.
    std::vector<Binding> treeBindings() const;
    std::uint64_t deviceBytes() const;
};

/// Throws MachineError, with numbers, if so many bytes of a scene do not fit into the memory of a GPU. (A
/// software driver's is the host's, whatever it says.)
void requireDeviceMemory(const DeviceInfo& device, std::uint64_t bytes, const Scene& scene);

/// Builds the trees and uploads everything. Throws MachineError if it does not fit the device, and UsageError
/// if that cannot do what is asked for.
DeviceScene uploadScene(const Device& device, const Scene& scene, const TuningChoice& choice = {});

}  // namespace duolux
