#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/film/image.h"
#include "tests/reference/tracer.h"

namespace duolux::test {

struct Criterion {
    double alpha = 1e-4;     ///< probability that any test of the family fails if the means agree
    double relative = 1e-5;  ///< of the expected value: errors that are not statistical, such as rounding
    double absolute = 1e-9;  ///< radiance
    /// The renders are by the light tracer. A light path may reach many pixels, so pixels are not
    /// independent, and the variance of a block is that of its mean over the renders. If fewer than 10
    /// renders have any light in a block, its variance is at least the expected value times the image's ratio
    /// of variance to mean.
    bool lightPaths = false;
};

/// The verdict on a set of images.
struct Agreement {
    bool agrees = true;
    std::string report;  ///< the worst results of every scale, and the failures
    RadianceImage meanImage;
    RadianceImage z;  ///< signed Welch statistic per pixel where tested, both components
};

/// Judges independent renders (one per seed, at least 2) of a scene with a known expectation, exact or with
/// variances. Uses Welch's t per component and channel on blocks of 4 and 8 pixels a side and on the whole
/// image, and with 10 renders or more on every pixel: noise averages out as the blocks grow, a bias does not.
/// Each scale gets a quarter of alpha, divided by Sidak's rule among its tests. With 10 renders or more, also
/// tests the mean square of t over all pixels.
Agreement judge(std::span<const RadianceImage> renders, const reference::Estimates& expected,
                const Criterion& criterion = {});

}  // namespace duolux::test
