#include "host/tools/bench/trace_kernel.h"

#include <fmt/format.h>

#include <cassert>
#include <cstring>

#include "host/base/clock.h"
#include "host/base/error.h"
#include "shaders/embedded.h"
#include "shaders/shared/bvh_layout.h"

namespace duolux {

namespace {

Buffer makeResults(const Device& device, std::size_t rays, bool count) {
    const std::size_t size = count ? sizeof(shared::TraceCounts) : rays * sizeof(shared::TraceHit);
    return Buffer::readback(device, size, "hits");
}

std::vector<Binding> traceBindings(std::vector<Binding> bindings, const Buffer& rays, const Buffer& results) {
    bindings.push_back({shared::kBindingRays, &rays});
    bindings.push_back({shared::kBindingHits, &results});
    return bindings;
}

}  // namespace

std::vector<Specialization> traceSpecialization(const Tuning& tuning, std::uint32_t mode, bool count) {
    return {{shared::kSpecWorkgroupSize, tuning.workgroupSize},
            {shared::kSpecLeaveTraversal, tuning.leaveTraversal},
            {shared::kSpecLeaveNodes, tuning.leaveNodes},
            {shared::kSpecVoteByShuffle, tuning.voteByShuffle},
            {shared::kSpecPlanes, false},
            {shared::kSpecTraceMode, mode},
            {shared::kSpecCount, count}};
}

TraceKernel::TraceKernel(const Device& device, const DeviceScene& scene, std::uint32_t mode,
                         std::span<const shared::TraceRay> rays, bool count)
    : device_(&device),
      rayCount_(static_cast<std::uint32_t>(rays.size())),
      lanes_(scene.tuning.lanes),
      blockRays_(lanes_ * scene.tuning.laneRays),
      workgroupSize_(scene.tuning.workgroupSize),
      count_(count),
      rays_(Buffer::upload(device, BufferUse::kTexels, rays, "rays")),
      results_(makeResults(device, rays.size(), count)),
      kernel_(device, "trace",
              variantFor(scene.tuning.layout, spirv::kTraceKernelTexel, spirv::kTraceKernelStorage,
                         spirv::kTraceKernelRayQuery),
              traceBindings(scene.treeBindings(), rays_, results_),
              traceSpecialization(scene.tuning, mode, count), sizeof(shared::TraceDispatch)),
      commands_(device) {
    assert(!count || scene.tuning.layout != Layout::kRayQuery);
}

BenchTimes TraceKernel::run(std::uint32_t passes) {
    runOnce(*device_, "clearing hits",
            [&](const Commands& commands) { commands.fill(results_, count_ ? 0u : 0xffffffffu); });
    const std::uint32_t blocks = (rayCount_ + blockRays_ - 1) / blockRays_;
    const std::uint32_t groups = (blocks * lanes_ + workgroupSize_ - 1) / workgroupSize_;
    const shared::TraceDispatch push{rayCount_, blockRays_};
    const Clock::time_point start = Clock::now();
    commands_.submit("tracing rays", [&](const Commands& commands) {
        for (std::uint32_t pass = 0; pass < passes; ++pass) {
            if (pass > 0) commands.barrier(Work::kKernels, Work::kKernels);
            kernel_.dispatch(commands, push, groups);
        }
    });
    const double device = commands_.wait("tracing rays");
    const double wall = secondsSince(start);
    results_.invalidate();
    return {wall, device};
}

std::vector<shared::TraceHit> TraceKernel::hits() const {
    std::vector<shared::TraceHit> out(rayCount_);
    std::memcpy(out.data(), results_.mapped(), out.size() * sizeof(shared::TraceHit));
    for (const shared::TraceHit& hit : out) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, &hit.t, sizeof bits);
        if (bits != 0xffffffffu) continue;
        throw DeviceError(fmt::format("tracing rays: {} ({}) has ended the kernel's loops early",
                                      device_->info().name, device_->info().driver));
    }
    return out;
}

shared::TraceCounts TraceKernel::counts() const {
    shared::TraceCounts out{};
    std::memcpy(&out, results_.mapped(), sizeof out);
    return out;
}

}  // namespace duolux
