#include "tests/shader/density.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "host/film/image.h"
#include "tests/support/statistics.h"

namespace duolux::test {

namespace {

std::string writeArtefact(std::string_view name, std::string_view what, int bins,
                          std::span<const double> values) {
    RadianceImage image{static_cast<std::uint32_t>(bins), static_cast<std::uint32_t>(bins), {}, {}};
    for (const double v : values)
        image.visible.emplace_back(static_cast<float>(v));
    image.invisible.resize(image.visible.size());
    const std::filesystem::path folder = DUOLUX_ARTEFACTS;
    std::filesystem::create_directories(folder);
    const std::filesystem::path path = folder / fmt::format("{}-{}.pfm", name, what);
    writeImage(path, image, {});
    return path.string();
}

}  // namespace

double integrate(const Density& density, const Rectangle& domain, int cells) {
    // Abramowitz & Stegun, table 25.4.
    constexpr std::array<double, 5> kNode{-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831,
                                          0.9061798459386640};
    constexpr std::array<double, 5> kWeight{0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                            0.4786286704993665, 0.2369268850561891};
    const glm::dvec2 half = 0.5 * (domain.upper - domain.lower) / static_cast<double>(cells);
    double sum = 0.0;
    for (int i = 0; i < cells; ++i) {
        for (int j = 0; j < cells; ++j) {
            const glm::dvec2 centre = domain.lower + half * glm::dvec2(2 * i + 1, 2 * j + 1);
            for (std::size_t a = 0; a < 5; ++a) {
                for (std::size_t b = 0; b < 5; ++b)
                    sum += kWeight[a] * kWeight[b] *
                           density(centre.x + half.x * kNode[a], centre.y + half.y * kNode[b]);
            }
        }
    }
    return sum * half.x * half.y;
}

void expectDensity(std::string_view name, std::span<const glm::dvec2> samples, const Rectangle& domain,
                   const Density& density, double alpha, int bins) {
    const auto n = static_cast<double>(samples.size());
    const auto cells = static_cast<std::size_t>(bins) * static_cast<std::size_t>(bins);
    const glm::dvec2 size = (domain.upper - domain.lower) / static_cast<double>(bins);
    std::vector<double> expected(cells), observed(cells), z(cells);
    for (std::size_t c = 0; c < cells; ++c) {
        const auto column = static_cast<double>(c % static_cast<std::size_t>(bins));
        const auto row = static_cast<double>(c / static_cast<std::size_t>(bins));
        const glm::dvec2 lower = domain.lower + size * glm::dvec2(column, row);
        expected[c] = n * integrate(density, {lower, lower + size}, 2);
    }
    double total = 0.0;
    for (const double e : expected)
        total += e / n;
    EXPECT_NEAR(total, 1.0, 1e-4) << name << ": the density's integral over its domain";
    for (const glm::dvec2& sample : samples) {
        const glm::dvec2 at = (sample - domain.lower) / size;
        const auto bin = [&](double x) { return std::clamp(static_cast<int>(std::floor(x)), 0, bins - 1); };
        ASSERT_TRUE(at.x >= 0.0 && at.y >= 0.0 && at.x <= bins && at.y <= bins)
            << name << ": (" << sample.x << ", " << sample.y << ") is outside the domain";
        observed[static_cast<std::size_t>(bin(at.y) * bins + bin(at.x))] += 1.0;
    }
    const ChiSquare test = chiSquare(observed, expected);
    EXPECT_GT(test.degrees, 0.0) << name << ": too few samples for " << bins << " x " << bins << " bins";
    if (test.p >= alpha) return;
    for (std::size_t c = 0; c < cells; ++c)
        z[c] = expected[c] > 0.0 ? (observed[c] - expected[c]) / std::sqrt(expected[c]) : 0.0;
    ADD_FAILURE() << name << ": chi-square " << test.statistic << " of " << test.degrees << " degrees, p "
                  << test.p << " below " << alpha << "; see "
                  << writeArtefact(name, "observed", bins, observed) << ", "
                  << writeArtefact(name, "expected", bins, expected) << ", "
                  << writeArtefact(name, "z", bins, z);
}

}  // namespace duolux::test
