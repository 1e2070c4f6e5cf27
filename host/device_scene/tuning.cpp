#include "host/device_scene/tuning.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/base/error.h"
#include "host/base/parallel.h"

namespace duolux {

namespace {

constexpr std::uint64_t kTexelBytes = 16;

std::uint64_t largestBuffer(const DeviceInfo& device, Layout layout) {
    return layout == Layout::kStorage ? device.maxStorageBufferRange
                                      : device.maxTexelBufferElements * kTexelBytes;
}

Layout chooseLayout(const DeviceInfo& device, const TuningChoice& choice) {
    if (choice.layout == Layout::kRayQuery && !device.rayQueries) {
        throw UsageError(fmt::format("layout ray-query: {} ({}) has no ray queries; expected {} or {}",
                                     device.name, device.driver, nameOf(Layout::kTexel),
                                     nameOf(Layout::kStorage)));
    }
    // On lavapipe 1.6 to 2.3 times as fast as storage buffers (tests/bench/PERFORMANCE.md); on GPUs it is
    // these that are read 16 bytes at a time (Ylitie et al., "Efficient Incoherent Ray Traversal on GPUs
    // Through Compressed Wide BVHs", HPG 2017).
    return choice.layout.value_or(device.kind == DeviceKind::kCpu ? Layout::kTexel : Layout::kStorage);
}

KernelKind chooseKernel(Layout layout, const TuningChoice& choice) {
    if (layout != Layout::kRayQuery) {
        // On lavapipe 1.2 to 1.8 times as fast; on GPUs incoherent rays gain, too (Aila, Laine, Karras,
        // "Understanding the Efficiency of Ray Traversal on GPUs - Kepler and Fermi Addendum", 2012).
        return choice.kernel.value_or(KernelKind::kRefilling);
    }
    if (choice.kernel == KernelKind::kRefilling) {
        throw UsageError(
            "kernel refilling: lanes cannot leave a ray query before its end; expected kernel plain");
    }
    return KernelKind::kPlain;
}

}  // namespace

const char* nameOf(Layout layout) {
    switch (layout) {
        case Layout::kTexel:
            return "texel";
        case Layout::kStorage:
            return "storage";
        case Layout::kRayQuery:
            return "ray-query";
    }
    return "";
}

const char* nameOf(KernelKind kind) {
    switch (kind) {
        case KernelKind::kRefilling:
            return "refilling";
        case KernelKind::kPlain:
            return "plain";
    }
    return "";
}

Tuning chooseTuning(const DeviceInfo& device, const TuningChoice& choice) {
    const bool cpu = device.kind == DeviceKind::kCpu;
    Tuning tuning;
    tuning.layout = chooseLayout(device, choice);
    tuning.kernel = chooseKernel(tuning.layout, choice);
    tuning.lanes = std::max(device.subgroupSize, 1u);
    // On a CPU, few threads run at once, so a work group is about as large as a subgroup.
    tuning.workgroupSize =
        std::max(std::min(cpu ? 8u : 64u, device.maxWorkgroupSize) / tuning.lanes, 1u) * tuning.lanes;
    if (tuning.kernel == KernelKind::kRefilling) {
        // Measured with 8 lanes: 4 to 5 (traversal) and 2 to 4 (nodes) are equal within noise.
        tuning.leaveTraversal = tuning.lanes / 2;
        tuning.leaveNodes = tuning.lanes * 3 / 8;
        // 0 takes 0.5 to 0.9 of the time of 4 on lavapipe. Not measured on GPUs.
        tuning.leaveTraversalCostly = cpu ? 0u : tuning.leaveTraversal;
    }
    // Lavapipe compiles ballots to loops over lanes.
    tuning.voteByShuffle = cpu && tuning.lanes == 8;
    // Four teams for each thread of a CPU.
    tuning.fewestTeams = cpu ? 4u * workerCount() : 8192u;
    // On lavapipe, 64 or more paths are equal within noise, and 16 are 12 % slower. Lavapipe ends the loops
    // of a subgroup after 65535 iterations, which rays with many crossings reach early. On a GPU, many teams
    // matter more than many paths per lane.
    tuning.lanePaths = cpu ? 128u : 16u;
    tuning.laneCrossingPaths = cpu ? 32u : 16u;
    tuning.laneRays = cpu ? 128u : 4u;
    return tuning;
}

Layout layoutThatFits(const DeviceInfo& device, Layout chosen, const TuningChoice& choice,
                      std::uint64_t bytes) {
    if (chosen == Layout::kRayQuery || bytes <= largestBuffer(device, chosen)) return chosen;
    const Layout other = chosen == Layout::kStorage ? Layout::kTexel : Layout::kStorage;
    // If neither layout fits, the upload reports it.
    if (bytes > largestBuffer(device, other)) return chosen;
    if (!choice.layout) return other;
    throw DeviceError(fmt::format(
        "layout {}: a buffer of this scene takes {} bytes, but {} ({}) can bind at most {} bytes with this "
        "layout; layout {} can hold it",
        nameOf(chosen), bytes, device.name, device.driver, largestBuffer(device, chosen), nameOf(other)));
}

}  // namespace duolux
