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
    /// Largest number of samples of a slot in one dispatch. Their sum fits the device's 64 bits by far
    /// (film.glsl clamps a sample at 2^56 quanta).
    static constexpr std::uint32_t kMaxSamples = 16;

    /// `maxSlots`: of one dispatch. `scene` and `deviceScene` must belong together; deviceScene must outlive
    /// this.
    PathKernel(const Device& device, const DeviceScene& deviceScene, const Scene& scene,
               std::span<const std::uint32_t> pixels, std::uint32_t maxSlots);

    std::uint32_t maxSlots() const { return maxSlots_; }
    std::uint64_t deviceBytes() const;

    /// Samples that a team of lanes takes in one dispatch, over all its slots (but at least one slot's).
    std::uint32_t teamSamples() const { return teamSamples_; }
    void limitTeamSamples(std::uint32_t samples) { teamSamples_ = samples; }

    /// Two dispatches may be in flight: `lane` 0 and 1.
    void submit(unsigned lane, const WorkRange& range);

    struct Results {
        WorkRange range;
        std::uint32_t teamSamples;  ///< as it was at submit
        bool complete;              ///< no team was cut short by the driver
        std::span<const shared::SlotResult> slots;
        double deviceSeconds;
    };
    /// Waits for the dispatch of a lane. What is returned is valid until the next submit to that lane.
    Results wait(unsigned lane);

  private:
    struct Submitted {
        WorkRange range;
        std::uint32_t teamSamples = 0, teamSlots = 0;
    };

    std::uint32_t teamSize_, workgroupSize_, teamSamples_, maxSlots_;
    Buffer params_, pixels_, results_, teams_;
    Kernel kernel_;
    std::array<CommandSlot, 2> commands_;
    std::array<Submitted, 2> submitted_{};
};

}  // namespace duolux
