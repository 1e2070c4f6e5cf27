#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "host/film/image.h"
#include "host/render/render.h"
#include "host/scene/scene.h"
#include "tests/support/agreement.h"

namespace duolux::test {

/// Renders of one scene that differ only in their seeds.
struct Renders {
    std::vector<RadianceImage> images;
    bool directLightInClosedForm = false;
};

/// Renders on the tests' device with seeds firstSeed, firstSeed + 1, ...; fails the running test if a sample
/// was not finite or a sum overflowed.
Renders renderSeeds(LoadedScene scene, std::uint32_t spp, std::uint32_t seeds, std::uint32_t firstSeed = 1,
                    const RenderControl& control = {});

/// The same with the other method for direct light, sampled or closed form; empty if there is no closed form.
std::optional<Renders> renderOtherEstimator(const LoadedScene& scene, std::uint32_t spp, std::uint32_t seeds,
                                            const Renders& renders);

/// The same with the light tracer.
Renders renderByLight(LoadedScene scene, std::uint32_t spp, std::uint32_t seeds);

/// Of cases that take long, every third runs each time, the others only nightly.
template <typename Case>
std::vector<Case> oftenCases(const std::vector<Case>& cases) {
    std::vector<Case> chosen;
    for (std::size_t i = 0; i < cases.size(); i += 3)
        chosen.push_back(cases[i]);
    return chosen;
}
template <typename Case>
std::vector<Case> nightlyCases(const std::vector<Case>& cases) {
    std::vector<Case> chosen;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        if (i % 3 != 0) chosen.push_back(cases[i]);
    }
    return chosen;
}

/// Means over the renders, with their variances.
reference::Estimates estimatesOf(const Renders& renders);

/// Fails the running test if the renders disagree with the expectation, and then writes images of both and of
/// the Welch statistic to artefacts/<name> in the build directory.
void expectAgreement(const std::string& name, const Renders& renders, const reference::Estimates& expected,
                     Criterion criterion = {});

}  // namespace duolux::test
