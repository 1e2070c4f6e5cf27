#pragma once

#include <array>
#include <span>

#include "host/gpu/device_scene.h"
#include "host/scene/scene.h"
#include "host/vk/commands.h"
#include "host/vk/device.h"
#include "host/vk/kernel.h"
#include "shaders/shared/path_layout.h"

namespace duolux {

/// A range of work: samples [firstSample, firstSample + samples) of the slots [firstSlot, firstSlot + slots).
struct WorkRange {
    std::uint32_t firstSlot = 0, slots = 0;
    std::uint32_t firstSample = 0, samples = 0;

    std::uint64_t size() const { return std::uint64_t{slots} * samples; }
};

/// The path-tracing kernel, specialised for a scene. Slots are pixels in the order of `pixels`.
class PathKernel {
  public:
    /// Largest number of samples of a slot in one dispatch: their sum fits the device's 64 bits (film.glsl
    /// clamps a sample at 2^56 quanta).
    static constexpr std::uint32_t kMaxSamples = 64;

    /// `maxSlots`: of one dispatch. `scene` and `deviceScene` must belong together; deviceScene must outlive
    /// this.
    PathKernel(const Device& device, const DeviceScene& deviceScene, const Scene& scene,
               std::span<const std::uint32_t> pixels, std::uint32_t maxSlots);

    std::uint32_t maxSlots() const { return maxSlots_; }
    std::uint32_t workgroupSize() const { return workgroupSize_; }
    std::uint64_t deviceBytes() const;

    /// Two dispatches may be in flight: `lane` 0 and 1.
    void submit(unsigned lane, const WorkRange& range);

    struct Results {
        WorkRange range;
        std::span<const shared::SlotResult> slots;
        double deviceSeconds;
    };
    /// Waits for the dispatch of a lane. What is returned is valid until the next submit to that lane.
    Results wait(unsigned lane);

  private:
    std::uint32_t workgroupSize_, maxSlots_;
    Buffer params_, pixels_, results_;
    Kernel kernel_;
    std::array<CommandSlot, 2> commands_;
    std::array<WorkRange, 2> ranges_{};
};

}  // namespace duolux
