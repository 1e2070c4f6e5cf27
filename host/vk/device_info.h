#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host/base/error.h"

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
    std::string vulkanVersion;  ///< for example "1.3.230"
    std::uint32_t subgroupSize = 0;
    std::uint64_t maxStorageBufferRange = 0;  ///< bytes
    std::uint64_t maxTexelBufferElements = 0;
    std::uint32_t maxStorageBuffers = 0;  ///< that a kernel binds
    std::uint32_t maxWorkgroupSize = 0;   ///< invocations of a work group along x
    bool int64Atomics = false;            ///< 64-bit integers, and atomics on them in storage buffers
    bool rayQueries = false;              ///< acceleration structures and ray queries in kernels
    std::uint64_t memoryBytes = 0;        ///< of the largest device-local heap
    std::string unusable;                 ///< the missing required feature; empty: the device is usable
};

/// No Vulkan driver could be loaded, or none has a device.
class NoDriverError : public DeviceError {
  public:
    using DeviceError::DeviceError;
};

/// All physical devices, usable or not. Throws NoDriverError if there is no Vulkan loader or driver.
std::vector<DeviceInfo> listDevices();

/// The device chosen by `selector`: "" (a usable GPU if there is one, otherwise the software driver), "cpu",
/// "gpu", an index, or part of a name (case-insensitive). Throws UsageError, which lists the devices, if none
/// matches.
const DeviceInfo& selectDevice(const std::vector<DeviceInfo>& devices, std::string_view selector);

}  // namespace duolux
