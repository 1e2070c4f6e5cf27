#include "host/bvh/binary_bvh.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <condition_variable>
#include <cstddef>
#include <cstring>
#include <exception>
#include <mutex>

#include "host/base/parallel.h"

namespace duolux {

namespace {

constexpr std::size_t kMostBins = 256;
constexpr std::size_t kMostSwept = 16;              // primitives; bins are faster for more
constexpr std::uint32_t kParallelThreshold = 8192;  // smaller subtrees are built by one thread

// The build spends most of its time on minima and maxima, which processors compute for four floats as fast as
// for one: x, y, z, and an unused zero.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

struct Box4 {
    Float4 lower{1e30f, 1e30f, 1e30f, 1e30f}, upper{-1e30f, -1e30f, -1e30f, -1e30f};

    void grow(const Box4& other) {
        lower = other.lower < lower ? other.lower : lower;
        upper = other.upper > upper ? other.upper : upper;
    }
    float halfArea() const {
        const Float4 d = upper - lower;
        return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
    }
    Aabb aabb() const { return {{lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]}}; }
};

Box4 boxOf(const PrimitiveRef& ref) {
    static_assert(sizeof(PrimitiveRef) == sizeof(Box4) && offsetof(PrimitiveRef, upper) == sizeof(Float4));
    // Integers: the bits of a primitive's number, read as a float, would be a denormal, which is slow.
    Int4 lower;
    Float4 upper;
    std::memcpy(&lower, &ref, sizeof lower);
    std::memcpy(&upper, reinterpret_cast<const char*>(&ref) + sizeof lower, sizeof upper);
    lower &= Int4{-1, -1, -1, 0};
    Box4 box;
    std::memcpy(&box.lower, &lower, sizeof lower);
    box.upper = upper;
    return box;
}

Float4 twiceCentre(const Box4& box) {
    return box.lower + box.upper;
}

struct Extent {
    Box4 bounds;   // of the primitives
    Box4 centres;  // of twice their centres
};

struct Task {
    std::uint32_t node, begin, end;
    Extent extent;
};

Extent extentOf(std::span<const PrimitiveRef> refs) {
    Extent extent;
    for (const PrimitiveRef& ref : refs) {
        const Box4 box = boxOf(ref);
        extent.bounds.grow(box);
        const Float4 centre = twiceCentre(box);
        extent.centres.grow({centre, centre});
    }
    return extent;
}

/// Partitions at the best of all splits between two different centres (MacDonald, Booth, "Heuristics for Ray
/// Tracing Using Space Subdivision", 1990); for few primitives. Returns the size of the left part, 0 if all
/// centres are identical.
std::uint32_t splitBySweep(std::span<PrimitiveRef> refs) {
    const std::size_t count = refs.size();
    std::array<Box4, kMostSwept> boxes;
    for (std::size_t i = 0; i < count; ++i)
        boxes[i] = boxOf(refs[i]);
    float bestCost = std::numeric_limits<float>::max();
    std::size_t leftCount = 0;
    std::array<std::size_t, kMostSwept> bestOrder;
    for (int axis = 0; axis < 3; ++axis) {
        std::array<float, kMostSwept> centre;
        std::array<std::size_t, kMostSwept> order;
        for (std::size_t i = 0; i < count; ++i) {  // insertion sort
            const float c = twiceCentre(boxes[i])[axis];
            std::size_t at = i;
            for (; at > 0 && centre[at - 1] > c; --at) {
                centre[at] = centre[at - 1];
                order[at] = order[at - 1];
            }
            centre[at] = c;
            order[at] = i;
        }
        std::array<float, kMostSwept> rightCost;
        Box4 right;
        for (std::size_t i = count; --i > 0;) {
            right.grow(boxes[order[i]]);
            rightCost[i] = right.halfArea() * static_cast<float>(count - i);
        }
        Box4 left;
        const float costBefore = bestCost;
        for (std::size_t i = 1; i < count; ++i) {
            left.grow(boxes[order[i - 1]]);
            const float cost = left.halfArea() * static_cast<float>(i) + rightCost[i];
            if (!(cost < bestCost) || centre[i - 1] == centre[i]) continue;
            bestCost = cost;
            leftCount = i;
        }
        if (bestCost < costBefore) bestOrder = order;
    }
    if (leftCount == 0) return 0;
    std::array<PrimitiveRef, kMostSwept> sorted;
    for (std::size_t i = 0; i < count; ++i)
        sorted[i] = refs[bestOrder[i]];
    std::copy_n(sorted.begin(), count, refs.begin());
    return static_cast<std::uint32_t>(leftCount);
}

struct Split {
    std::uint32_t leftCount = 0;
    Extent left, right;
};

/// Separates large primitives from small ones. No plane separates the walls of a room from its contents, but
/// their size does. The left part is empty unless the split costs less than `cost` (half area times
/// primitives).
Split splitBySize(std::span<PrimitiveRef> refs, const Box4& bounds, float cost) {
    constexpr float kLarge = 0.125f;  // of the area of all primitives' box
    const auto isSmall = [&](const Box4& box) { return box.halfArea() < kLarge * bounds.halfArea(); };
    Split split;
    for (const PrimitiveRef& ref : refs) {
        const Box4 box = boxOf(ref);
        const bool small = isSmall(box);
        Extent& extent = small ? split.left : split.right;
        extent.bounds.grow(box);
        const Float4 centre = twiceCentre(box);
        extent.centres.grow({centre, centre});
        split.leftCount += small ? 1 : 0;
    }
    const auto rightCount = static_cast<std::uint32_t>(refs.size()) - split.leftCount;
    if (split.leftCount == 0 || rightCount == 0 ||
        split.left.bounds.halfArea() * static_cast<float>(split.leftCount) +
                split.right.bounds.halfArea() * static_cast<float>(rightCount) >=
            cost)
        return {};
    std::partition(refs.begin(), refs.end(), [&](const PrimitiveRef& ref) { return isSmall(boxOf(ref)); });
    return split;
}

/// Partitions by binned SAH. The left part is empty if the centres cannot be separated.
Split splitByBins(std::span<PrimitiveRef> refs, const Extent& extent) {
    const Box4& centres = extent.centres;
    // Few enough that evaluating the bins takes only a small fraction of the time for filling them.
    const std::size_t binCount = std::min(32 + refs.size() / 16, kMostBins);
    const Float4 size = centres.upper - centres.lower;
    Float4 scale{};
    for (int axis = 0; axis < 3; ++axis) {
        scale[axis] = size[axis] > 0.0f ? static_cast<float>(binCount) * 0.9999f / size[axis] : 0.0f;
        if (!(scale[axis] < 1e30f)) scale[axis] = 0.0f;  // an extent so small that its inverse overflows
    }
    const auto binsOf = [&](const Float4& centre) {
        return __builtin_convertvector((centre - centres.lower) * scale, Int4);
    };

    struct Bin {
        Box4 bounds;
        std::uint32_t count;
    };
    Bin bins[3][kMostBins];
    for (auto& ofAxis : bins)
        std::fill_n(ofAxis, binCount, Bin{{}, 0});
    for (const PrimitiveRef& ref : refs) {
        const Box4 box = boxOf(ref);
        const Int4 index = binsOf(twiceCentre(box));
        for (int axis = 0; axis < 3; ++axis) {
            Bin& bin = bins[axis][index[axis]];
            bin.bounds.grow(box);
            ++bin.count;
        }
    }

    float bestCost = std::numeric_limits<float>::max();
    int bestAxis = -1;
    std::size_t bestBin = 0;
    Split split;
    for (int axis = 0; axis < 3; ++axis) {
        if (scale[axis] == 0.0f) continue;
        float rightCost[kMostBins];
        Box4 right;
        std::uint32_t rightCount = 0;
        for (std::size_t i = binCount - 1; i > 0; --i) {
            right.grow(bins[axis][i].bounds);
            rightCount += bins[axis][i].count;
            rightCost[i] = rightCount > 0 ? right.halfArea() * static_cast<float>(rightCount) : 0.0f;
        }
        Box4 left;
        std::uint32_t leftCount = 0;
        for (std::size_t i = 0; i < binCount - 1; ++i) {
            left.grow(bins[axis][i].bounds);
            leftCount += bins[axis][i].count;
            if (leftCount == 0 || leftCount == refs.size()) continue;
            const float cost = left.halfArea() * static_cast<float>(leftCount) + rightCost[i + 1];
            if (cost < bestCost) {
                bestCost = cost;
                bestAxis = axis;
                bestBin = i;
                split.leftCount = leftCount;
                split.left.bounds = left;
            }
        }
    }
    constexpr float kPoor = 0.65f;  // of the cost without a split
    if (bestCost > kPoor * extent.bounds.halfArea() * static_cast<float>(refs.size())) {
        if (const Split bySize = splitBySize(refs, extent.bounds, bestCost); bySize.leftCount > 0)
            return bySize;
    }
    if (bestAxis < 0) return split;
    for (std::size_t i = bestBin + 1; i < binCount; ++i)
        split.right.bounds.grow(bins[bestAxis][i].bounds);
    const auto goesLeft = [&](const PrimitiveRef& ref) {
        const Float4 centre = twiceCentre(boxOf(ref));
        const bool left = binsOf(centre)[bestAxis] <= static_cast<int>(bestBin);
        (left ? split.left : split.right).centres.grow({centre, centre});
        return left;
    };
    std::partition(refs.begin(), refs.end(), goesLeft);
    return split;
}

Split splitByMedian(std::span<PrimitiveRef> refs, const Box4& centres) {
    const Float4 size = centres.upper - centres.lower;
    const int axis = size[0] >= size[1] && size[0] >= size[2] ? 0 : (size[1] >= size[2] ? 1 : 2);
    const std::uint32_t half = static_cast<std::uint32_t>(refs.size() / 2);
    std::nth_element(refs.begin(), refs.begin() + half, refs.end(),
                     [&](const PrimitiveRef& a, const PrimitiveRef& b) {
                         const float ca = a.lower[axis] + a.upper[axis];
                         const float cb = b.lower[axis] + b.upper[axis];
                         return ca != cb ? ca < cb : a.primitive < b.primitive;
                     });
    return {half, extentOf(refs.first(half)), extentOf(refs.subspan(half))};
}

class Builder {
  public:
    Builder(std::span<PrimitiveRef> refs, SplitMethod method) : refs_(refs), method_(method) {
        bvh_.nodes.resize(2 * refs.size() - 1);
    }

    BinaryBvh build() {
        tasks_.push_back({0, 0, static_cast<std::uint32_t>(refs_.size()), extentOf(refs_)});
        const bool parallel = refs_.size() > kParallelThreshold;
        runOnThreads(parallel ? workerCount() : 1, [this] { work(); });
        if (failure_) std::rethrow_exception(failure_);
        return std::move(bvh_);
    }

  private:
    /// Runs tasks until no task is queued or in progress.
    void work() {
        std::unique_lock lock(mutex_);
        for (;;) {
            wake_.wait(lock, [this] { return !tasks_.empty() || busy_ == 0; });
            if (tasks_.empty()) return;
            const Task task = tasks_.back();
            tasks_.pop_back();
            ++busy_;
            lock.unlock();
            std::exception_ptr failure;
            try {
                subtree(task);
            } catch (...) {
                failure = std::current_exception();
            }
            lock.lock();
            if (failure) {
                failure_ = failure;
                tasks_.clear();
            }
            --busy_;
            if (busy_ == 0 && tasks_.empty()) wake_.notify_all();
        }
    }

    void subtree(const Task& root) {
        std::vector<Task> stack{root};
        while (!stack.empty()) {
            const Task task = stack.back();
            stack.pop_back();
            const std::span<PrimitiveRef> refs = refs_.subspan(task.begin, task.end - task.begin);
            if (method_ == SplitMethod::kBinnedSah && refs.size() <= kMostSwept) {
                sweep(task.node, refs, task.extent.bounds);
                continue;
            }
            BinaryBvh::Node& node = bvh_.nodes[task.node];
            node = {task.extent.bounds.aabb(), static_cast<std::uint32_t>(refs.size()), refs[0].primitive};
            if (refs.size() == 1) continue;
            Split split;
            if (method_ == SplitMethod::kBinnedSah) split = splitByBins(refs, task.extent);
            if (split.leftCount == 0) split = splitByMedian(refs, task.extent.centres);
            const std::uint32_t middle = task.begin + split.leftCount;
            node.right = task.node + 2 * split.leftCount;
            const Task left{task.node + 1, task.begin, middle, split.left};
            const Task right{node.right, middle, task.end, split.right};
            for (const Task* child : {&right, &left}) {
                if (child->end - child->begin > kParallelThreshold) {
                    std::lock_guard lock(mutex_);
                    tasks_.push_back(*child);
                    wake_.notify_one();
                } else {
                    stack.push_back(*child);
                }
            }
        }
    }

    void sweep(std::uint32_t index, std::span<PrimitiveRef> refs, const Box4& bounds) {
        const auto count = static_cast<std::uint32_t>(refs.size());
        BinaryBvh::Node& node = bvh_.nodes[index];
        node = {bounds.aabb(), count, refs[0].primitive};
        if (count == 1) return;
        std::uint32_t leftCount = count > 2 ? splitBySweep(refs) : 1;
        if (leftCount == 0) leftCount = count / 2;
        const std::span<PrimitiveRef> left = refs.first(leftCount), right = refs.subspan(leftCount);
        node.right = index + 2 * leftCount;
        sweep(index + 1, left, extentOf(left).bounds);
        sweep(node.right, right, extentOf(right).bounds);
    }

    std::span<PrimitiveRef> refs_;
    SplitMethod method_;
    BinaryBvh bvh_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::vector<Task> tasks_;
    int busy_ = 0;
    std::exception_ptr failure_;
};

}  // namespace

BinaryBvh buildBinaryBvh(std::span<PrimitiveRef> refs, SplitMethod method) {
    assert(!refs.empty() && refs.size() < (1u << 31));
    return Builder(refs, method).build();
}

}  // namespace duolux
