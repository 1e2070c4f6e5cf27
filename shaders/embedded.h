#pragma once

#include <cstdint>
#include <span>

/// The kernels of shaders/kernels as SPIR-V words, for each layout of a scene in device memory.
namespace duolux::spirv {

using Words = std::span<const std::uint32_t>;

extern const Words kPathKernelTexel, kPathKernelStorage, kPathKernelRayQuery;
extern const Words kLightKernelTexel, kLightKernelStorage, kLightKernelRayQuery;
/// These need DeviceInfo::int64Atomics.
extern const Words kLightKernelInt64Texel, kLightKernelInt64Storage, kLightKernelInt64RayQuery;
extern const Words kTraceKernelTexel, kTraceKernelStorage, kTraceKernelRayQuery;

}  // namespace duolux::spirv
