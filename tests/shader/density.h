#pragma once

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <source_location>
#include <span>
#include <string_view>
#include <vector>

namespace duolux::test {

/// A density over a rectangle of the plane, per unit of its area.
using Density = std::function<double(double x, double y)>;

struct Rectangle {
    glm::dvec2 lower, upper;
};

/// Integral over a rectangle by cells x cells Gauss-Legendre rules of 5 x 5 points.
double integrate(const Density& density, const Rectangle& domain, int cells);

/// Fails the test unless `samples`, points of `domain`, come from `density`: Pearson's chi-square over
/// bins x bins cells, those of low expectation merged, at the level `alpha`. That the density integrates to 1
/// over the domain is checked, too, to 1e-4. On failure observed and expected counts and the standardised
/// difference of each bin are left as pictures (PFM, rows along y from the lower end) in the build directory:
/// artefacts/NAME-observed.pfm, -expected, -z.
void expectDensity(std::string_view name, std::span<const glm::dvec2> samples, const Rectangle& domain,
                   const Density& density, double alpha, int bins = 32,
                   const std::source_location& where = std::source_location::current());

}  // namespace duolux::test
