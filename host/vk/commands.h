#pragma once

#include <functional>
#include <string_view>
#include <vulkan/vulkan_raii.hpp>

#include "host/vk/device.h"

namespace duolux {

/// A command buffer that is recorded, submitted and waited for, again and again; with timestamps around what
/// it runs.
class CommandSlot {
  public:
    explicit CommandSlot(const Device& device);
    /// Waits for what is still in flight: it uses resources that are about to go, too.
    ~CommandSlot();
    CommandSlot(const CommandSlot&) = delete;
    CommandSlot& operator=(const CommandSlot&) = delete;

    /// Records and submits. The slot must not be in flight. `stage` is for errors.
    void submit(std::string_view stage, const std::function<void(const vk::raii::CommandBuffer&)>& record);

    /// Waits until the device is done, and returns its seconds (0 without timestamps). `stage` is for errors.
    double wait(std::string_view stage);

  private:
    const Device* device_;
    vk::raii::CommandPool pool_;
    vk::raii::CommandBuffer commands_;
    vk::raii::Fence fence_;
    vk::raii::QueryPool timestamps_;
    bool inFlight_ = false;
};

/// Records, submits and waits once.
void runOnce(const Device& device, std::string_view stage,
             const std::function<void(const vk::raii::CommandBuffer&)>& record);

}  // namespace duolux
