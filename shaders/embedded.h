#pragma once

#include <cstdint>
#include <span>

/// The kernels of shaders/kernels as SPIR-V words, for each layout of a scene in device memory.
namespace duolux::spirv {

using Words = std::span<const std::uint32_t>;

extern const Words kPathTracerTexel, kPathTracerStorage, kPathTracerRayQuery;
extern const Words kLightTracerTexel, kLightTracerStorage, kLightTracerRayQuery;
/// These need DeviceInfo::int64Atomics.
extern const Words kLightTracerInt64Texel, kLightTracerInt64Storage, kLightTracerInt64RayQuery;
/// For plain scenes (DeviceScene::isPlain), in which they compute the same.
extern const Words kPathTracerPlainTexel, kPathTracerPlainStorage, kPathTracerPlainRayQuery;
extern const Words kLightTracerPlainTexel, kLightTracerPlainStorage, kLightTracerPlainRayQuery;
extern const Words kLightTracerInt64PlainTexel, kLightTracerInt64PlainStorage, kLightTracerInt64PlainRayQuery;
extern const Words kTraceKernelTexel, kTraceKernelStorage, kTraceKernelRayQuery;

}  // namespace duolux::spirv
