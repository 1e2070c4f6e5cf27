#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

#include "host/vk/instance.h"

namespace duolux {

enum class DeviceKind : std::uint8_t { kCpu, kGpu };
inline const char* nameOf(DeviceKind kind) {
    return kind == DeviceKind::kCpu ? "cpu" : "gpu";
}

/// Properties of a physical device, as `duolux devices` lists them.
struct DeviceInfo {
    std::uint32_t index = 0;  ///< in the loader's order
    std::string name;
    std::string driver;  ///< name and version, for example "llvmpipe Mesa 22.3.6 (LLVM 15.0.6)"
    DeviceKind kind = DeviceKind::kCpu;
    std::uint32_t apiVersion = 0;
    std::uint32_t subgroupSize = 0;
    std::uint64_t maxStorageBufferRange = 0;  ///< bytes
    std::uint64_t maxTexelBufferElements = 0;
    std::uint32_t maxWorkgroupSize = 0;  ///< invocations of a work group along x
    bool int64Atomics = false;           ///< 64-bit integers, and atomics on them in storage buffers
    bool rayQueries = false;             ///< acceleration structures and ray queries in kernels
    std::uint64_t memoryBytes = 0;       ///< of the largest device-local heap
    std::string unusable;                ///< the missing required feature; empty: the device is usable
};

/// All physical devices, usable or not. Throws NoDriverError if there is no Vulkan loader or driver.
std::vector<DeviceInfo> listDevices();

/// The device chosen by `selector`: "" (a usable GPU if there is one, otherwise the software driver), "cpu",
/// "gpu", an index, or part of a name (case-insensitive). Throws UsageError, which lists the devices, if none
/// matches.
const DeviceInfo& selectDevice(const std::vector<DeviceInfo>& devices, std::string_view selector);

/// The exception for a failed call to a device. `stage`: what failed, for example "tracing paths".
MachineError failureOn(const DeviceInfo& device, std::string_view stage, const vk::SystemError& error);

/// A logical device with one compute queue.
class Device {
  public:
    explicit Device(std::string_view selector = "", Validation validation = Validation::kOff);
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceInfo& info() const { return info_; }
    const vk::raii::Device& handle() const { return device_; }
    const vk::raii::PhysicalDevice& physical() const { return physical_; }
    const vk::raii::Queue& queue() const { return queue_; }
    std::uint32_t queueFamily() const { return queueFamily_; }
    double timestampPeriod() const { return timestampPeriod_; }  ///< nanoseconds per tick; 0: no timestamps

    /// Warnings and errors from the validation layer since creation (empty unless Validation::kOn).
    std::vector<std::string> validationMessages() const { return instance_.validationMessages(); }

  private:
    Instance instance_;
    DeviceInfo info_;
    vk::raii::PhysicalDevice physical_;
    vk::raii::Device device_;
    vk::raii::Queue queue_;
    std::uint32_t queueFamily_ = 0;
    double timestampPeriod_ = 0.0;
};

}  // namespace duolux
