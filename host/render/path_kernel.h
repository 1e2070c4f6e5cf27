#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "host/film/film.h"
#include "host/gpu/device_scene.h"
#include "host/render/film_quantum.h"
#include "host/render/schedule.h"
#include "host/render/teams.h"
#include "host/scene/scene.h"
#include "host/vk/commands.h"
#include "host/vk/device.h"
#include "host/vk/kernel.h"
#include "shaders/shared/path_layout.h"

namespace duolux {

/// The path-tracing kernel, specialised for a scene. Slots are pixels in the order of `pixels`.
class PathKernel {
  public:
    /// Largest number of samples of a slot in one dispatch. Their sum fits the device's 64 bits by far
    /// (film.glsl clamps a sample at 2^56 quanta).
    static constexpr std::uint32_t kMaxSamples = 16;
    /// Largest number of slots that a dispatch need have.
    static constexpr std::uint32_t kMaxSlots = 1u << 18;

    /// `maxSlots`: of one dispatch. `closedForm`: direct light is not sampled. `scene` and `deviceScene` must
    /// belong together; deviceScene and pixels must outlive this.
    PathKernel(const Device& device, const DeviceScene& deviceScene, const Scene& scene,
               std::span<const std::uint32_t> pixels, std::uint32_t maxSlots, bool closedForm);

    std::uint32_t maxSlots() const { return maxSlots_; }
    std::uint64_t deviceBytes() const;

    /// Samples that a lane takes in one dispatch, over all its slots. The more, the less the lanes of a team
    /// wait for the last one; but drivers may end long loops.
    std::uint32_t laneSamples() const { return laneSamples_; }
    void limitLaneSamples(std::uint32_t samples) { laneSamples_ = std::min(laneSamples_, samples); }

    /// The slots after those of `pixels` are some more, spread evenly over the image, for a first look at it.
    std::uint32_t firstLookSlot() const { return static_cast<std::uint32_t>(pixels_.size()); }
    std::uint32_t lookSlots() const { return lookSlots_; }

    /// Two dispatches may be in flight, in the places 0 and 1. A range has at most laneSamples() samples of a
    /// slot. `quantum`: of the film.
    void submit(unsigned place, const WorkRange& range, float quantum);

    struct Results {
        WorkRange range;
        std::uint32_t laneSamples;  ///< the most that a lane had to take
        bool complete;              ///< no team was cut short by the driver
        double deviceSeconds;
    };
    /// Waits for the dispatch in a place.
    Results wait(unsigned place);

    /// What the statistics take of a dispatch: sums over its samples. See shared::SlotResult.
    struct Totals {
        std::uint64_t nonFinite = 0, cameraRays = 0, bounceRays = 0, shadowRays = 0, emitterRays = 0;
        double lastBounce = 0.0, previousBounce = 0.0;
        bool clamped = false;
    };
    /// Adds the sums of the dispatch in a place, which was waited for, to a film of the scene's size and
    /// quantum.
    Totals addTo(Film& film, unsigned place);
    /// The same sums, over the slots.
    FirstLook look(unsigned place);

  private:
    struct Submitted {
        WorkRange range;
        std::uint32_t teamSlots = 0;
    };

    Totals read(unsigned place);

    std::uint32_t laneSamples_, maxSlots_, lookSlots_;
    std::span<const std::uint32_t> pixels_;
    std::vector<Film::PixelSum> sums_;  // of a dispatch
    Teams teams_;
    Buffer params_, pixelOrder_, results_;
    Kernel kernel_;
    std::array<CommandSlot, 2> commands_;
    std::array<Submitted, 2> submitted_{};
};

}  // namespace duolux
