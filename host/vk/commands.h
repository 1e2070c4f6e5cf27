#pragma once

#include <functional>
#include <string_view>
#include <vulkan/vulkan_raii.hpp>

#include "host/vk/device.h"

namespace duolux {

/// A reusable command buffer that is recorded, submitted and waited for. Timestamps measure its execution.
class CommandSlot {
  public:
    explicit CommandSlot(const Device& device);
    /// Waits for commands in flight, because they use resources that are about to be destroyed.
    ~CommandSlot();
    CommandSlot(const CommandSlot&) = delete;
    CommandSlot& operator=(const CommandSlot&) = delete;

    /// Records and submits. The slot must not be in flight. `stage` is for error messages.
    void submit(std::string_view stage, const std::function<void(const vk::raii::CommandBuffer&)>& record);

    /// Waits until the device has finished. Returns the device's time in seconds (0 without timestamps).
    /// `stage` is for error messages.
    double wait(std::string_view stage);

  private:
    const Device* device_;
    vk::raii::CommandPool pool_;
    vk::raii::CommandBuffer commands_;
    vk::raii::Fence fence_;
    vk::raii::QueryPool timestamps_;
    bool inFlight_ = false;
};

/// Records and submits commands once, and waits for them.
void runOnce(const Device& device, std::string_view stage,
             const std::function<void(const vk::raii::CommandBuffer&)>& record);

}  // namespace duolux
