#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "host/scene/scene.h"
#include "tests/reference/tracer.h"

namespace duolux::test {

/// A scene whose image is known in closed form: both the reference and the kernels must render it.
struct ExactCase {
    std::string name;   ///< letters and digits
    LoadedScene scene;  ///< size and bounces set
    reference::Estimates expected;
    /// A light search with finite variance; only the reference needs it.
    reference::LightSearch search = reference::LightSearch::kDirection;
    double relative = 1e-5;  ///< error of the closed form and of single precision
    bool onePoint =
        false;  ///< no light path reaches the camera: every pixel sees the same point, or a mirror
};

/// For messages of the test framework.
inline void PrintTo(const ExactCase& exact, std::ostream* out) {
    *out << exact.name;
}

/// Closed sphere seen from inside, uniform emission: L = sum over k of (albedo O)^k E.
std::vector<ExactCase> enclosureCases();

/// The same with metallic walls, which the reference does not support.
std::vector<ExactCase> metalCases();

/// A diffuse receiver under point emitters, which the reference does not support.
std::vector<ExactCase> pointCases();

/// Concentric spheres that transmit light: products of T in the order of crossings from the camera.
std::vector<ExactCase> crossingCases();

/// Objects whose emission compensates for the light that they absorb: a uniform image for all shapes.
std::vector<ExactCase> furnaceCases();

/// A diffuse receiver below an unoccluded rectangle: Lambert's polygon formula.
std::vector<ExactCase> lambertCases();

/// The same with panes between receiver and rectangle: products of T in the order from the receiver.
std::vector<ExactCase> blockerCases();

/// One of these cases, with any number of panes.
ExactCase stackedPanesCase(int count);

/// All of the above.
std::vector<ExactCase> exactCases();

}  // namespace duolux::test
