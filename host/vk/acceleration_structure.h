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
    /// How the buffer of the triangles must have been made.
    static constexpr vk::BufferUsageFlags kTriangleUse =
        vk::BufferUsageFlagBits::eShaderDeviceAddress |
        vk::BufferUsageFlagBits::eAccelerationStructureBuildInputReadOnlyKHR;

    /// Consecutive triangles of the buffer, at least one. Each part becomes an instance, in order, with a
    /// mask of its own.
    struct Part {
        std::uint32_t firstTriangle, triangles;
        std::uint8_t mask;
    };

    /// `triangles`: three vertices each, of 16 bytes, which begin with the position as three floats. Throws
    /// MachineError if the driver fails, or memory or limits do not suffice.
    AccelerationStructure(const Device& device, const Buffer& triangles, std::span<const Part> parts);

    vk::AccelerationStructureKHR handle() const { return *top_.structure; }
    std::uint64_t allocated() const;  ///< bytes of device memory, without the triangles

  private:
    /// The tree of a part, or the one over all of these.
    struct Level {
        Buffer memory;
        vk::raii::AccelerationStructureKHR structure;
    };
    static Level build(const Device& device, vk::AccelerationStructureTypeKHR type,
                       const vk::AccelerationStructureGeometryKHR& geometry, std::uint32_t primitives);
    static std::vector<Level> buildParts(const Device& device, const Buffer& triangles,
                                         std::span<const Part> parts);
    static Level buildTop(const Device& device, const std::vector<Level>& levels,
                          std::span<const Part> parts);

    std::vector<Level> parts_;
    Level top_;
};

}  // namespace duolux
