#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <span>
#include <vulkan/vulkan_raii.hpp>

#include "host/vk/kernel.h"

namespace duolux {

/// What a kernel needs of its code and the kinds of its bindings, but not of what is bound.
struct Pipeline {
    vk::raii::DescriptorSetLayout setLayout{nullptr};
    vk::raii::PipelineLayout layout{nullptr};
    vk::raii::Pipeline pipeline{nullptr};
};

vk::DescriptorType descriptorType(const Binding& binding);

/// The last pipelines of a device: views of one scene, and scenes that differ only in what is bound, share
/// one. Drivers compile for 0.1 to 1 s. May be used by several threads.
class Pipelines {
  public:
    /// As the constructor of Kernel. Throws vk::SystemError.
    std::shared_ptr<const Pipeline> get(const vk::raii::Device& device, std::span<const std::uint32_t> spirv,
                                        std::span<const Binding> bindings,
                                        std::span<const Specialization> specialization,
                                        std::uint32_t pushConstantBytes);

  private:
    struct Entry {
        std::uint64_t key;
        std::shared_ptr<const Pipeline> pipeline;
    };
    std::mutex mutex_;
    std::list<Entry> entries_;  ///< the last used first
};

}  // namespace duolux
