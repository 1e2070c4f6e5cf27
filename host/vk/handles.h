#pragma once

#include <memory>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

#include "host/vk/acceleration_structure.h"
#include "host/vk/buffer.h"
#include "host/vk/device.h"
#include "host/vk/instance.h"
#include "host/vk/pipeline.h"

// Vulkan's objects behind the classes of this folder. Its other headers do not include Vulkan's, which take
// seconds to compile.

namespace duolux {

struct Device::Handles {
    explicit Handles(Validation validation) : instance(validation) {}

    Instance instance;
    vk::raii::PhysicalDevice physical{nullptr};
    vk::raii::Device device{nullptr};
    vk::raii::Queue queue{nullptr};
    std::uint32_t queueFamily = 0;
    double timestampPeriod = 0.0;  ///< nanoseconds per tick; 0: no timestamps
    std::unique_ptr<Pipelines> pipelines = std::make_unique<Pipelines>();
};

struct Buffer::Handles {
    vk::raii::Buffer buffer{nullptr};
    vk::raii::DeviceMemory memory{nullptr};
    vk::raii::BufferView view{nullptr};  ///< kTexels: R32G32B32A32 uint
};

struct AccelerationStructure::Handles {
    /// The tree of a part (bottom level), or the tree over all parts (top level).
    struct Level {
        Buffer memory;
        vk::raii::AccelerationStructureKHR structure;
    };
    std::vector<Level> parts;
    Level top;
};

/// Throws MemoryError if the limit on the address space leaves too little for the device's driver. Lavapipe
/// compiles kernels in this process, some of them when they first run, and crashes if an allocation fails.
void requireDriverSpace(const DeviceInfo& device, std::string_view stage);

/// Reports a failed call to a device: throws MemoryError if memory ran out, otherwise DeviceError. `stage`:
/// what failed, for example "tracing paths".
[[noreturn]] void failOn(const DeviceInfo& device, std::string_view stage, const vk::SystemError& error);

}  // namespace duolux
