#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "host/base/named.h"
#include "host/vk/device_info.h"

namespace duolux {

/// How kernels read the triangles of a scene and find those along a ray.
enum class Layout : std::uint8_t {
    kTexel,    ///< a tree of host/bvh in texel buffers
    kStorage,  ///< a tree of host/bvh in storage buffers
    kRayQuery  ///< an acceleration structure of the driver
};

/// What the lanes of a subgroup do when their rays are done before those of the other lanes.
enum class KernelKind : std::uint8_t {
    kRefilling,  ///< they get new rays as soon as enough lanes are done
    kPlain       ///< they wait until all lanes are done
};

const char* nameOf(Layout layout);    ///< "texel", "storage", "ray-query"
const char* nameOf(KernelKind kind);  ///< "refilling", "plain"
template <>
inline constexpr std::array kValuesOf<Layout>{Layout::kTexel, Layout::kStorage, Layout::kRayQuery};
template <>
inline constexpr std::array kValuesOf<KernelKind>{KernelKind::kRefilling, KernelKind::kPlain};

/// Explicit choices that replace the defaults for the kind of device.
struct TuningChoice {
    std::optional<Layout> layout;
    std::optional<KernelKind> kernel;
};

/// How kernels run on a device. No value changes the image: it stays bitwise identical.
struct Tuning {
    Layout layout = Layout::kTexel;
    KernelKind kernel = KernelKind::kRefilling;
    std::uint32_t lanes = 1;          ///< of a subgroup
    std::uint32_t workgroupSize = 1;  ///< a multiple of `lanes`
    /// Lanes leave the traversal when fewer have rays in flight, and the node loop when fewer need nodes.
    std::uint32_t leaveTraversal = 0, leaveNodes = 0;
    /// In place of leaveTraversal where what follows the traversal costs more: lobes that are not diffuse, or
    /// rays that visit all surfaces.
    std::uint32_t leaveTraversalCostly = 0;
    bool voteByShuffle = false;     ///< the 8 lanes of a subgroup vote by shuffles instead of ballots
    std::uint32_t fewestTeams = 1;  ///< subgroups that keep the device busy
    /// Paths that a lane traces in one dispatch, one after the other; laneCrossingPaths applies where paths
    /// visit all surfaces along their rays.
    std::uint32_t lanePaths = 1, laneCrossingPaths = 1;
    std::uint32_t laneRays = 1;  ///< rays per lane in the kernel that traces given rays
};

/// Throws UsageError if the device does not support a choice.
Tuning chooseTuning(const DeviceInfo& device, const TuningChoice& choice);

/// Returns `chosen`, or another layout if only that one can bind a buffer of `bytes`, the larger buffer of a
/// tree. Throws DeviceError if the caller requested a layout that cannot hold the scene.
Layout layoutThatFits(const DeviceInfo& device, Layout chosen, const TuningChoice& choice,
                      std::uint64_t bytes);

/// The variant of a kernel for this layout.
inline std::span<const std::uint32_t> variantFor(Layout layout, std::span<const std::uint32_t> texel,
                                                 std::span<const std::uint32_t> storage,
                                                 std::span<const std::uint32_t> rayQuery) {
    return layout == Layout::kTexel ? texel : layout == Layout::kStorage ? storage : rayQuery;
}

}  // namespace duolux
