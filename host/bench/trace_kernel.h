#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/bench/benchmark.h"
#include "host/gpu/device_scene.h"
#include "host/vk/buffer.h"
#include "host/vk/commands.h"
#include "host/vk/device.h"
#include "host/vk/kernel.h"
#include "shaders/shared/trace_layout.h"

namespace duolux {

/// Traces the same rays again and again: the traversal by itself.
class TraceKernel {
  public:
    /// `count`: counts what the traversal does instead of giving hits; not with Layout::kRayQuery, because
    /// drivers do not tell.
    TraceKernel(const Device& device, const DeviceScene& scene, std::uint32_t mode,
                std::span<const shared::TraceRay> rays, bool count = false);

    /// All rays, `passes` times in one submission.
    BenchTimes run(std::uint32_t passes = 1);

    /// One a ray, of the last run. Throws MachineError if the driver has cut loops short.
    std::vector<shared::TraceHit> hits() const;
    /// Of a kernel that counts: of the last run.
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
