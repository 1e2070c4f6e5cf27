#pragma once

#include <cstdint>
#include <span>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

#include "host/vk/buffer.h"
#include "host/vk/device.h"

namespace duolux {

/// The driver's own tree over triangles, for ray queries in kernels. Requires DeviceInfo::rayQueries.
class AccelerationStructure {
  public:
    /// The usage flags with which the vertex buffer must have been created.
    static constexpr vk::BufferUsageFlags kInputUse =
        vk::BufferUsageFlagBits::eShaderDeviceAddress |
        vk::BufferUsageFlagBits::eAccelerationStructureBuildInputReadOnlyKHR;

    /// A range of consecutive vertices, and the number of triangles in it (at least one). Each part becomes
    /// an instance, in order, with its own mask.
    struct Part {
        std::uint32_t firstVertex, vertices, triangles;
        std::uint8_t mask;
    };

    /// `vertices`: 16 bytes each, which begin with the position as three floats. `indices`: three per
    /// triangle, relative to the part's first vertex; every part uses them from the start. Throws
    /// MachineError if the driver fails, or if memory or the device's limits do not suffice.
    AccelerationStructure(const Device& device, const Buffer& vertices,
                          std::span<const std::uint32_t> indices, std::span<const Part> parts);

    vk::AccelerationStructureKHR handle() const { return *top_.structure; }
    std::uint64_t allocated() const;  ///< bytes of device memory, excluding the vertices

  private:
    /// The tree of a part (bottom level), or the tree over all parts (top level).
    struct Level {
        Buffer memory;
        vk::raii::AccelerationStructureKHR structure;
    };
    static Level build(const Device& device, vk::AccelerationStructureTypeKHR type,
                       const vk::AccelerationStructureGeometryKHR& geometry, std::uint32_t primitives);
    static std::vector<Level> buildParts(const Device& device, const Buffer& vertices,
                                         std::span<const std::uint32_t> indices, std::span<const Part> parts);
    static Level buildTop(const Device& device, const std::vector<Level>& levels,
                          std::span<const Part> parts);

    std::vector<Level> parts_;
    Level top_;
};

}  // namespace duolux
