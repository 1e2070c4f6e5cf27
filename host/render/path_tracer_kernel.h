#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "host/device_scene/device_scene.h"
#include "host/film/film.h"
#include "host/render/film_quantum.h"
#include "host/render/kernel_setup.h"
#include "host/render/schedule.h"
#include "host/render/teams.h"
#include "host/scene/scene.h"
#include "host/vk/commands.h"
#include "host/vk/device.h"
#include "host/vk/kernel.h"
#include "shaders/shared/path_tracer_layout.h"

namespace duolux {

/// The specialisation constants of the kernel; `closedForm`: see below.
std::vector<Specialization> pathTracerSpecialization(const RenderInputs& inputs, bool closedForm);

/// The kernel of the path tracer, specialised for a scene. Pixels are numbered in the order of `pixels`.
class PathTracerKernel {
  public:
    /// Largest number of samples of a pixel in one dispatch. Their sum fits into the device's 64 bits
    /// (film.glsl clamps a sample to shared::kFilmLargest).
    static constexpr std::uint32_t kMaxSamples = 16;
    /// Largest useful number of pixels in one dispatch.
    static constexpr std::uint32_t kMaxPixels = 1u << 18;

    /// `maxPixels`: largest number of pixels in one dispatch. `closedForm`: direct light is computed in
    /// closed form instead of being sampled. The device scene and `pixels` must outlive this object. Throws
    /// MachineError if memory does not suffice or the driver fails to compile the kernel.
    PathTracerKernel(const RenderInputs& inputs, std::span<const std::uint32_t> pixels,
                     std::uint32_t maxPixels, bool closedForm);

    std::uint32_t maxPixels() const { return maxPixels_; }
    std::uint64_t deviceBytes() const;

    /// Number of samples that a lane traces in one dispatch, over all its pixels. With more samples, the
    /// lanes of a team wait less for the last one, but some drivers end long loops early.
    std::uint32_t laneSamples() const { return laneSamples_; }
    void limitLaneSamples(std::uint32_t samples) { laneSamples_ = std::min(laneSamples_, samples); }

    /// The number of the first of the pixels that follow those of `pixels`. They are spread evenly over the
    /// image, for the first look.
    std::uint32_t firstLookPixel() const { return static_cast<std::uint32_t>(pixels_.size()); }
    std::uint32_t lookPixels() const { return lookPixels_; }

    /// Submits a dispatch. Two may be in flight, in the slots 0 and 1. A range has at most maxPixels()
    /// pixels and laneSamples() samples of a pixel. `quantum`: of the film. Throws MachineError if the device
    /// fails.
    void submit(unsigned slot, const WorkRange& range, float quantum);

    struct Results {
        WorkRange range;
        std::uint32_t laneSamples;  ///< the largest number of samples that a lane had to trace
        bool complete;              ///< the driver did not end the loops of any team early
        double deviceSeconds;
    };
    /// Waits for the dispatch in a slot. Throws MachineError if the device fails.
    Results wait(unsigned slot);

    /// The statistics of a dispatch: sums over its samples. See shared::PixelResult.
    struct Totals {
        std::uint64_t nonFinite = 0, cameraRays = 0, bounceRays = 0, shadowRays = 0, emitterRays = 0;
        double lastBounce = 0.0, previousBounce = 0.0;
        bool clamped = false;
    };
    /// Adds the sums of the finished dispatch in a slot to a film of the scene's size and quantum.
    Totals addTo(Film& film, unsigned slot);
    /// The same sums, totalled over the pixels.
    FirstLook look(unsigned slot);

  private:
    struct Submitted {
        WorkRange range;
        std::uint32_t teamPixels = 0;
    };

    Totals read(unsigned slot);

    std::uint32_t laneSamples_, maxPixels_, lookPixels_;
    std::span<const std::uint32_t> pixels_;
    // Of a dispatch.
    std::vector<Film::PixelSum> sums_;
    std::vector<std::int64_t> layerSums_;
    std::uint32_t layerChannels_;
    Teams teams_;
    Buffer params_, pixelOrder_, results_, layerResults_;
    Kernel kernel_;
    std::array<CommandSlot, 2> commands_;
    std::array<Submitted, 2> submitted_{};
};

}  // namespace duolux
