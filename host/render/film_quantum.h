#pragma once

#include <cstdint>
#include <functional>

namespace duolux {

/// Sums over a few samples of an image, taken with a trial quantum.
struct FirstLook {
    double invisible = 0.0, visible = 0.0;  ///< sums over samples of the mean of the channels, in quanta
    std::uint64_t samples = 0;              ///< number of samples of the image's mean
    bool clamped = false;                   ///< some sample exceeded the film's largest value
};

/// Chooses the quantum of a film in W sr^-1 m^-2 (scene units), a power of two: 2^-30 of the image's mean
/// radiance (of the darker component, unless it is many times darker), so that a pixel holds radiance up to
/// 2^28 times this mean (shared::kFilmLargest). The mean is that of the image and not of the emitters, which
/// may be out of view. The quantum may rise to 2^-20 of the mean if the film then holds `brightest`, the
/// brightest emission, which a first look may miss. If the first look is black, `brightest` replaces the
/// mean. `look` is called with different quanta until one is suitable.
float findQuantum(double brightest, const std::function<FirstLook(float quantum)>& look);

}  // namespace duolux
