#pragma once

#include <cstdint>
#include <vector>

#include "host/scene/scene.h"

namespace duolux::reference {

/// How light is found from a scattering vertex.
enum class LightSearch : std::uint8_t {
    kArea,      ///< a point on the emitters, uniform by area: for small lights, away from surfaces
    kDirection  ///< whatever a cosine-distributed direction meets: for large lights
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

/// Gathers vector-valued light by brute force in double precision. The estimator is deliberately plain and
/// unlike the kernels': no roulette, no multiple importance sampling, Mersenne twisters. The same settings
/// give the same numbers on any number of threads.
Estimates trace(const Scene& scene, const Settings& settings);

}  // namespace duolux::reference
