#pragma once

#include <array>
#include <span>
#include <vector>

#include "host/device_scene/device_scene.h"
#include "host/film/film.h"
#include "host/render/kernel_setup.h"
#include "host/render/render.h"
#include "host/render/teams.h"
#include "host/scene/scene.h"
#include "host/vk/commands.h"
#include "host/vk/device.h"
#include "host/vk/kernel.h"
#include "shaders/shared/light_tracer_layout.h"

namespace duolux {

/// Light paths [first, first + count).
struct PathRange {
    std::uint64_t first = 0;
    std::uint32_t count = 0;
};

/// The specialisation constants of the kernel. `bands`: buffers of the film; `bandPixels`: pixels of each of
/// them but the last.
std::vector<Specialization> lightTracerSpecialization(const RenderInputs& inputs, std::size_t bands,
                                                      std::uint32_t bandPixels);

/// The kernel of the light tracer, specialised for a scene, with a film on the device.
class LightTracerKernel {
  public:
    /// `maxPaths`: largest number of paths in one dispatch. The device scene must outlive this object. Throws
    /// DeviceError if the device cannot hold a film of the scene's size.
    LightTracerKernel(const RenderInputs& inputs, std::uint32_t maxPaths, const TestLimits& limits);

    std::uint32_t maxPaths() const { return maxPaths_; }
    std::uint64_t deviceBytes() const;

    /// Number of paths that a lane traces in one dispatch; see PathTracerKernel::laneSamples.
    std::uint32_t lanePaths() const { return lanePaths_; }
    void limitLanePaths(std::uint32_t paths) { lanePaths_ = std::min(lanePaths_, paths); }

    /// Submits a dispatch of at most maxPaths() paths. Two may be in flight, in the slots 0 and 1. Each adds
    /// to the film on the device, whose unit is `quantum`. Throws MachineError if the device fails, as do all
    /// functions below.
    void submit(unsigned slot, const PathRange& range, float quantum);

    struct Results {
        PathRange range;
        std::uint32_t lanePaths;  ///< the largest number of paths that a lane had to trace
        bool complete;            ///< the driver did not end the loops of any team early
        std::span<const shared::LaneResult> lanes;
        double deviceSeconds;
    };
    /// Waits for the dispatch in a slot. The results are valid until the next submit to the same slot.
    Results wait(unsigned slot);

    /// Adds the sums on the device to a film of the scene's size and quantum. No dispatch may be in flight.
    /// `partly` is true while only some of the pixels have been added.
    void takeFilm(Film& film, bool& partly);

    /// Sets all sums on the device to zero.
    void clearFilm();

  private:
    struct Submitted {
        PathRange range;
        std::uint32_t teamPaths = 0, lanes = 0;
    };

    const Device* device_;
    std::uint32_t lanePaths_, maxPaths_, pixels_, bandPixels_, readPixels_;
    Teams teams_;
    std::uint32_t maxLanes_;
    Buffer params_, results_, filmRead_;
    std::vector<Buffer> film_;
    Kernel kernel_;
    std::array<CommandSlot, 2> commands_;
    std::array<Submitted, 2> submitted_{};
};

}  // namespace duolux
