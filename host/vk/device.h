#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "host/vk/device_info.h"

namespace duolux {

enum class Validation : std::uint8_t {
    kOff,
    kOn  ///< core and synchronization validation; throws MachineError if the layer is not installed
};

/// A logical device with one compute queue.
class Device {
  public:
    explicit Device(std::string_view selector = "", Validation validation = Validation::kOff);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceInfo& info() const { return info_; }

    /// Warnings and errors from the validation layer since creation (empty unless Validation::kOn).
    std::vector<std::string> validationMessages() const;

    struct Handles;  ///< defined in host/vk/handles.h, which alone includes Vulkan's headers
    const Handles& handles() const { return *handles_; }

  private:
    DeviceInfo info_;
    std::unique_ptr<Handles> handles_;
};

}  // namespace duolux
