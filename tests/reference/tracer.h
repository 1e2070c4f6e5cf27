#pragma once

#include <cstdint>
#include <vector>

#include "host/scene/scene.h"

namespace duolux::reference {

/// How direct light at a scattering vertex is sampled.
enum class LightSearch : std::uint8_t {
    kArea,      ///< points on the emitters, uniform in area: for small lights away from surfaces
    kDirection  ///< cosine-distributed directions: for large lights
};

struct Settings {
    std::uint32_t width = 32, height = 32;
    std::uint32_t samples = 64;  ///< per pixel, >= 2
    std::uint32_t bounces = 4;   ///< scattering events; crossings do not count
    std::uint64_t seed = 1;
    LightSearch search = LightSearch::kArea;
};

/// Both components of a pixel, [component][channel], component 0 invisible and 1 visible.
struct Estimate {
    double mean[2][3] = {};
    double variance[2][3] = {};  ///< of the mean; 0 for a closed form
};

struct Estimates {
    std::uint32_t width = 0, height = 0;
    std::uint32_t samples = 0;  ///< per pixel behind each variance
    std::vector<Estimate> pixels;
};

/// Brute-force path tracer for vector-valued light in double precision. The estimator is deliberately simple
/// and different from the kernels: no Russian roulette, no multiple importance sampling, Mersenne twisters.
/// Identical settings give identical numbers on any number of threads.
Estimates trace(const LoadedScene& scene, const Settings& settings);

}  // namespace duolux::reference
