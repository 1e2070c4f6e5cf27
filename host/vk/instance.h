#pragma once

#include <memory>
#include <string>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

#include "host/vk/device.h"

namespace duolux {

/// The Vulkan loader with all drivers it can load.
class Instance {
  public:
    /// Throws NoDriverError.
    explicit Instance(Validation validation);
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    /// At least one. Throws NoDriverError.
    std::vector<vk::raii::PhysicalDevice> devices() const;

    /// Warnings and errors from the validation layer since creation (empty unless Validation::kOn).
    std::vector<std::string> validationMessages() const;

  private:
    struct Log;
    std::unique_ptr<Log> log_;
    vk::raii::Context context_;
    vk::raii::Instance instance_;
    vk::raii::DebugUtilsMessengerEXT messenger_;
};

}  // namespace duolux
