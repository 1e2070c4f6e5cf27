#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "host/vk/buffer.h"
#include "host/vk/device.h"

namespace duolux {

/// The driver's own tree over triangles, for ray queries in kernels. Requires DeviceInfo::rayQueries.
class AccelerationStructure {
  public:
    /// A range of consecutive vertices, and the number of triangles in it (at least one). Each part becomes
    /// an instance, in order, with its own mask.
    struct Part {
        std::uint32_t firstVertex, vertices, triangles;
        std::uint8_t mask;
    };

    /// `vertices`: 16 bytes each, which begin with the position as three floats, in a buffer with
    /// TreeUse::kInput. `indices`: three per triangle, relative to the part's first vertex; every part uses
    /// them from the start. Throws DeviceError if the driver fails or the device's limits do not
    /// suffice, MemoryError if memory does not.
    AccelerationStructure(const Device& device, const Buffer& vertices,
                          std::span<const std::uint32_t> indices, std::span<const Part> parts);
    ~AccelerationStructure();
    AccelerationStructure(AccelerationStructure&& other) noexcept;
    AccelerationStructure& operator=(AccelerationStructure&& other) noexcept;

    std::uint64_t allocated() const;  ///< bytes of device memory, excluding the vertices

    struct Handles;  ///< as Device::Handles
    const Handles& handles() const { return *handles_; }

  private:
    std::unique_ptr<Handles> handles_;
};

}  // namespace duolux
