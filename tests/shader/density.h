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

/// Fails the test unless `samples`, points of `domain`, come from `density`: Pearson's chi-square test over
/// bins x bins cells at the level `alpha`, with cells of low expectation merged. Also checks that the density
/// integrates to 1 over the domain, to 1e-4. On failure, writes observed and expected counts and the
/// standardised difference of each bin as images (PFM, rows along y from the lower end) to the build
/// directory: artefacts/NAME-observed.pfm, -expected, -z.
void expectDensity(std::string_view name, std::span<const glm::dvec2> samples, const Rectangle& domain,
                   const Density& density, double alpha, int bins = 32,
                   const std::source_location& where = std::source_location::current());

}  // namespace duolux::test
