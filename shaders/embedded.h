#pragma once

#include <cstdint>
#include <span>

/// The kernels of shaders/kernels as SPIR-V words.
namespace duolux::spirv {

extern const std::span<const std::uint32_t> kPathKernel;
extern const std::span<const std::uint32_t> kLightKernel;
extern const std::span<const std::uint32_t> kLightKernelInt64;  ///< needs DeviceInfo::int64Atomics
extern const std::span<const std::uint32_t> kTraceKernel;

}  // namespace duolux::spirv
