#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "host/vk/device.h"

namespace duolux {

/// How kernels reach the triangles of a scene and find those along a ray.
enum class Layout : std::uint8_t {
    kTexel,    ///< a tree of host/bvh in texel buffers
    kStorage,  ///< the same in storage buffers
    kRayQuery  ///< an acceleration structure of the driver's
};

/// What the lanes of a subgroup do that are done with their rays before the others.
enum class KernelKind : std::uint8_t {
    kRefilling,  ///< when enough are done, these get new ones
    kPlain       ///< they wait until all are done
};

const char* nameOf(Layout layout);    ///< "texel", "storage", "ray-query"
const char* nameOf(KernelKind kind);  ///< "refilling", "plain"

/// What is asked for in place of the choice by the kind of device.
struct TuningChoice {
    std::optional<Layout> layout;
    std::optional<KernelKind> kernel;
};

/// How kernels run on a device. No number changes a bit of an image.
struct Tuning {
    Layout layout = Layout::kTexel;
    KernelKind kernel = KernelKind::kRefilling;
    std::uint32_t lanes = 1;          ///< of a subgroup
    std::uint32_t workgroupSize = 1;  ///< a multiple of that
    /// Lanes leave the traversal when fewer are under way, and the node loop when fewer want nodes.
    std::uint32_t leaveTraversal = 0, leaveNodes = 0;
    bool voteByShuffle = false;     ///< lanes are 8 and count such others by shuffles, not ballots
    std::uint32_t fewestTeams = 1;  ///< subgroups that keep the device busy
    /// Paths that a lane takes in one dispatch, one after the other, and where they meet all surfaces along
    /// their rays.
    std::uint32_t lanePaths = 1, laneCrossingPaths = 1;
    std::uint32_t laneRays = 1;  ///< rays of the kernel that traces given ones
};

/// Throws UsageError if the device cannot do what is asked for.
Tuning chooseTuning(const DeviceInfo& device, const TuningChoice& choice);

/// `chosen`, or another layout if the larger buffer of a tree, of so many bytes, fits that alone. Throws
/// MachineError if such a scene was asked for with a layout that cannot hold it.
Layout layoutThatFits(const DeviceInfo& device, Layout chosen, const TuningChoice& choice,
                      std::uint64_t bytes);

/// The one of a kernel's variants that has this layout.
inline std::span<const std::uint32_t> variantFor(Layout layout, std::span<const std::uint32_t> texel,
                                                 std::span<const std::uint32_t> storage,
                                                 std::span<const std::uint32_t> rayQuery) {
    return layout == Layout::kTexel ? texel : layout == Layout::kStorage ? storage : rayQuery;
}

}  // namespace duolux
