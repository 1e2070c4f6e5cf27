#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/device_scene/device_scene.h"
#include "host/tools/bench/benchmark.h"
#include "host/vk/buffer.h"
#include "host/vk/commands.h"
#include "host/vk/device.h"
#include "host/vk/kernel.h"
#include "shaders/shared/trace_layout.h"

namespace duolux {

/// The specialisation constants of the kernel; `mode`: one of shared::kTrace...
std::vector<Specialization> traceSpecialization(const Tuning& tuning, std::uint32_t mode, bool count);

/// Traces the same rays repeatedly, to measure the traversal alone.
class TraceKernel {
  public:
    /// `count`: counts visits and tests instead of returning hits. Not with Layout::kRayQuery, because
    /// drivers do not provide counts.
    TraceKernel(const Device& device, const DeviceScene& scene, std::uint32_t mode,
                std::span<const shared::TraceRay> rays, bool count = false);

    /// Traces all rays `passes` times in one submission.
    BenchTimes run(std::uint32_t passes = 1);

    /// The hits of the last run, one for each ray. Throws DeviceError if the driver has ended loops early.
    std::vector<shared::TraceHit> hits() const;
    /// The counts of the last run, for a kernel that counts.
    shared::TraceCounts counts() const;

  private:
    const Device* device_;
    std::uint32_t rayCount_, lanes_, blockRays_, workgroupSize_;
    bool count_;
    Buffer rays_, results_;
    Kernel kernel_;
    CommandSlot commands_;
};

}  // namespace duolux
