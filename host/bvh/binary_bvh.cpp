#include "host/bvh/binary_bvh.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "host/base/parallel.h"

namespace duolux {

namespace {

constexpr std::size_t kMostBins = 256;
constexpr std::uint32_t kMostSwept = 16;
constexpr std::uint32_t kParallelThreshold = 8192;  // smaller subtrees are built by one thread

struct Task {
    std::uint32_t node, begin, end;
};

glm::vec3 twiceCentre(const PrimitiveRef& ref) {
    return ref.lower + ref.upper;
}

Aabb boxOf(const PrimitiveRef& ref) {
    return {ref.lower, ref.upper};
}

struct Extent {
    Aabb bounds;   // of the primitives
    Aabb centres;  // of twice their centres
};

Extent extentOf(std::span<const PrimitiveRef> refs) {
    Extent extent;
    for (const PrimitiveRef& ref : refs) {
        extent.bounds.grow(boxOf(ref));
        const glm::vec3 centre = twiceCentre(ref);
        extent.centres.grow({centre, centre});
    }
    return extent;
}

/// Partitions at the best of all splits between two different centres (MacDonald, Booth, "Heuristics for Ray
/// Tracing Using Space Subdivision", 1990); for few primitives. Returns the size of the left part, 0 if the
/// centres are all the same.
std::uint32_t splitByFullSweep(std::span<PrimitiveRef> refs) {
    struct Place {
        float centre;
        std::uint32_t ref;
    };
    const auto count = static_cast<std::uint32_t>(refs.size());
    float bestCost = std::numeric_limits<float>::max();
    int bestAxis = -1;
    float bestCentre = 0.0f;  // the last one of the left part
    for (int axis = 0; axis < 3; ++axis) {
        Place places[kMostSwept];
        for (std::uint32_t i = 0; i < count; ++i)
            places[i] = {refs[i].lower[axis] + refs[i].upper[axis], i};
        std::sort(places, places + count, [](const Place& a, const Place& b) { return a.centre < b.centre; });
        float rightCost[kMostSwept];
        Aabb right;
        for (std::uint32_t i = count; --i > 0;) {
            right.grow(boxOf(refs[places[i].ref]));
            rightCost[i] = right.halfArea() * static_cast<float>(count - i);
        }
        Aabb left;
        for (std::uint32_t i = 1; i < count; ++i) {
            left.grow(boxOf(refs[places[i - 1].ref]));
            if (places[i - 1].centre == places[i].centre) continue;
            const float cost = left.halfArea() * static_cast<float>(i) + rightCost[i];
            if (cost < bestCost) {
                bestCost = cost;
                bestAxis = axis;
                bestCentre = places[i - 1].centre;
            }
        }
    }
    if (bestAxis < 0) return 0;
    const auto middle = std::partition(refs.begin(), refs.end(), [&](const PrimitiveRef& ref) {
        return ref.lower[bestAxis] + ref.upper[bestAxis] <= bestCentre;
    });
    return static_cast<std::uint32_t>(middle - refs.begin());
}

/// Partitions by SAH, in bins where there are many primitives; returns the size of the left part, 0 if the
/// centres cannot be told apart.
std::uint32_t splitBySah(std::span<PrimitiveRef> refs, const Aabb& centres) {
    if (refs.size() <= kMostSwept) return splitByFullSweep(refs);
    struct Bin {
        Aabb bounds;
        std::uint32_t count;
    };
    // So many that looking through them takes a small part of the time that filling them takes.
    const std::size_t binCount = std::min(32 + refs.size() / 16, kMostBins);
    const glm::vec3 size = centres.upper - centres.lower;
    glm::vec3 scale;
    for (int axis = 0; axis < 3; ++axis) {
        scale[axis] = size[axis] > 0.0f ? static_cast<float>(binCount) * 0.9999f / size[axis] : 0.0f;
        if (!(scale[axis] < 1e30f)) scale[axis] = 0.0f;  // an extent so small that its inverse overflows
    }
    auto binOf = [&](const PrimitiveRef& ref, int axis) {
        const float x = (ref.lower[axis] + ref.upper[axis] - centres.lower[axis]) * scale[axis];
        return std::min(static_cast<std::size_t>(x), binCount - 1);
    };

    Bin bins[3][kMostBins];
    for (auto& ofAxis : bins)
        std::fill_n(ofAxis, binCount, Bin{{}, 0});
    for (const PrimitiveRef& ref : refs) {
        const Aabb box = boxOf(ref);
        for (int axis = 0; axis < 3; ++axis) {
            Bin& bin = bins[axis][binOf(ref, axis)];
            bin.bounds.grow(box);
            ++bin.count;
        }
    }

    float bestCost = std::numeric_limits<float>::max();
    int bestAxis = -1;
    std::size_t bestBin = 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (scale[axis] == 0.0f) continue;
        float rightCost[kMostBins];
        Aabb right;
        std::uint32_t rightCount = 0;
        for (std::size_t i = binCount - 1; i > 0; --i) {
            right.grow(bins[axis][i].bounds);
            rightCount += bins[axis][i].count;
            rightCost[i] = rightCount > 0 ? right.halfArea() * static_cast<float>(rightCount) : 0.0f;
        }
        Aabb left;
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
            }
        }
    }
    if (bestAxis < 0) return 0;
    const auto middle = std::partition(
        refs.begin(), refs.end(), [&](const PrimitiveRef& ref) { return binOf(ref, bestAxis) <= bestBin; });
    return static_cast<std::uint32_t>(middle - refs.begin());
}

std::uint32_t splitByMedian(std::span<PrimitiveRef> refs, const Aabb& centres) {
    const glm::vec3 size = centres.upper - centres.lower;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const std::uint32_t half = static_cast<std::uint32_t>(refs.size() / 2);
    std::nth_element(refs.begin(), refs.begin() + half, refs.end(),
                     [&](const PrimitiveRef& a, const PrimitiveRef& b) {
                         const float ca = a.lower[axis] + a.upper[axis];
                         const float cb = b.lower[axis] + b.upper[axis];
                         return ca != cb ? ca < cb : a.primitive < b.primitive;
                     });
    return half;
}

class Builder {
  public:
    Builder(std::span<PrimitiveRef> refs, SplitMethod method) : refs_(refs), method_(method) {
        bvh_.nodes.resize(2 * refs.size() - 1);
    }

    BinaryBvh build() {
        tasks_.push_back({0, 0, static_cast<std::uint32_t>(refs_.size())});
        std::vector<std::jthread> pool;
        const bool parallel = refs_.size() > kParallelThreshold;
        for (unsigned i = 1; parallel && i < workerCount(); ++i)
            pool.emplace_back([this] { work(); });
        work();
        pool.clear();  // joins
        if (failure_) std::rethrow_exception(failure_);
        return std::move(bvh_);
    }

  private:
    /// Takes tasks until none is left or in progress.
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

    void subtree(Task root) {
        std::vector<Task> stack{root};
        while (!stack.empty()) {
            const Task task = stack.back();
            stack.pop_back();
            const std::uint32_t count = task.end - task.begin;
            const std::span<PrimitiveRef> refs = refs_.subspan(task.begin, count);
            const Extent extent = extentOf(refs);
            BinaryBvh::Node& node = bvh_.nodes[task.node];
            node.bounds = extent.bounds;
            node.count = count;
            if (count == 1) {
                node.right = refs[0].primitive;
                continue;
            }
            std::uint32_t leftCount =
                method_ == SplitMethod::kBinnedSah ? splitBySah(refs, extent.centres) : 0;
            if (leftCount == 0) leftCount = splitByMedian(refs, extent.centres);
            node.right = task.node + 2 * leftCount;
            const Task left{task.node + 1, task.begin, task.begin + leftCount};
            const Task right{node.right, task.begin + leftCount, task.end};
            for (const Task& child : {right, left}) {
                if (child.end - child.begin > kParallelThreshold) {
                    std::lock_guard lock(mutex_);
                    tasks_.push_back(child);
                    wake_.notify_one();
                } else {
                    stack.push_back(child);
                }
            }
        }
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
