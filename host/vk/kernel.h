#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

#include "host/vk/buffer.h"
#include "host/vk/device.h"

namespace duolux {

/// A buffer or an acceleration structure that a kernel binds, all in set 0. Consecutive entries of a list
/// with the same number are the elements of an array.
struct Binding {
    std::uint32_t binding;
    const Buffer* buffer;
    vk::AccelerationStructureKHR structure{};  ///< if `buffer` is null
};

/// A specialisation constant: bool, or uint32.
struct Specialization {
    std::uint32_t id;
    std::uint32_t value;
};

/// A compute pipeline with its descriptor set. The bound resources must outlive it.
class Kernel {
  public:
    /// `name` is for error messages. Throws MachineError if the driver fails to compile it.
    Kernel(const Device& device, std::string_view name, std::span<const std::uint32_t> spirv,
           std::span<const Binding> bindings, std::span<const Specialization> specialization,
           std::uint32_t pushConstantBytes);

    /// Records a dispatch of `groups` work groups along x.
    template <typename Push>
    void dispatch(const vk::raii::CommandBuffer& commands, const Push& push, std::uint32_t groups) const {
        record(commands, std::as_bytes(std::span(&push, 1)), groups);
    }

  private:
    void record(const vk::raii::CommandBuffer& commands, std::span<const std::byte> push,
                std::uint32_t groups) const;

    vk::raii::DescriptorSetLayout setLayout_{nullptr};
    vk::raii::PipelineLayout layout_{nullptr};
    vk::raii::DescriptorPool pool_{nullptr};
    vk::raii::DescriptorSet set_{nullptr};
    vk::raii::Pipeline pipeline_{nullptr};
};

}  // namespace duolux
