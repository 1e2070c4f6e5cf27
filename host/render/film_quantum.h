#pragma once

#include <cstdint>
#include <functional>

namespace duolux {

/// What a few samples of a picture show, taken with some quantum of the film.
struct FirstLook {
    double invisible = 0.0, visible = 0.0;  ///< sums over samples of the mean of the channels, in quanta
    std::uint64_t samples = 0;              ///< of the mean of the picture
    bool clamped = false;                   ///< some sample was brighter than the film could hold
};

/// A power of two: a 2^-30th of the picture's mean radiance (of the darker component, unless that is many
/// times darker), so that a pixel holds radiance up to 2^28 times that mean (shared::kFilmLargest). What the
/// picture shows counts, and not what its emitters emit, which may be out of sight; but the quantum may be up
/// to a 2^-20th of the mean if the film then holds the brightest emission, `brightest`, which a first look
/// may miss. Where the look shows nothing that counts in place of the mean. `look` is called with different
/// quanta until one suits.
float findQuantum(double brightest, const std::function<FirstLook(float quantum)>& look);

}  // namespace duolux
