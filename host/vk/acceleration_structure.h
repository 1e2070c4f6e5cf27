#pragma once

#include <cstdint>
#include <span>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

#include "host/vk/buffer.h"
#include "host/vk/device.h"

namespace duolux {

/// The driver's own tree over triangles, for ray queries in kernels. Only on a device with
/// DeviceInfo::rayQueries.
class AccelerationStructure {
  public:
    /// How the buffer of the vertices must have been made.
    static constexpr vk::BufferUsageFlags kInputUse =
        vk::BufferUsageFlagBits::eShaderDeviceAddress |
        vk::BufferUsageFlagBits::eAccelerationStructureBuildInputReadOnlyKHR;

    /// Consecutive vertices of the buffer, and triangles among them (at least one). Each part becomes an
    /// instance, in order, with a mask of its own.
    struct Part {
        std::uint32_t firstVertex, vertices, triangles;
        std::uint8_t mask;
    };

    /// `vertices`: of 16 bytes, which begin with the position as three floats. `indices`: of each triangle's
    /// corners, from the part's first vertex on; all parts use them from the start. Throws MachineError if
    /// the driver fails, or memory or limits do not suffice.
    AccelerationStructure(const Device& device, const Buffer& vertices,
                          std::span<const std::uint32_t> indices, std::span<const Part> parts);

    vk::AccelerationStructureKHR handle() const { return *top_.structure; }
    std::uint64_t allocated() const;  ///< bytes of device memory, without the vertices

  private:
    /// The tree of a part, or the one over all of these.
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
