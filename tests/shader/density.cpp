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
    std::string stem(name);
    std::replace(stem.begin(), stem.end(), '/', '-');
    const std::filesystem::path path = folder / fmt::format("{}-{}.pfm", stem, what);
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
                   const Density& density, double alpha, int bins, const std::source_location& where) {
    const auto n = static_cast<double>(samples.size());
    const auto cells = static_cast<std::size_t>(bins) * static_cast<std::size_t>(bins);
    const glm::dvec2 size = (domain.upper - domain.lower) / static_cast<double>(bins);
    const auto fail = [&](const std::string& why) {
        ADD_FAILURE_AT(where.file_name(), static_cast<int>(where.line())) << name << ": " << why;
    };
    std::vector<double> expected(cells), observed(cells), z(cells);
    double total = 0.0;
    for (std::size_t c = 0; c < cells; ++c) {
        const auto column = static_cast<double>(c % static_cast<std::size_t>(bins));
        const auto row = static_cast<double>(c / static_cast<std::size_t>(bins));
        const glm::dvec2 lower = domain.lower + size * glm::dvec2(column, row);
        const double part = integrate(density, {lower, lower + size}, 2);
        total += part;
        expected[c] = n * part;
    }
    if (!(std::abs(total - 1.0) <= 1e-4))
        fail(fmt::format("the density's integral over the domain is {}", total));
    for (const glm::dvec2& sample : samples) {
        // Rounding may put an angle slightly outside the circle.
        const glm::dvec2 at = (sample - domain.lower) / size;
        const double margin = 1e-6 * bins;
        if (!(at.x >= -margin && at.y >= -margin && at.x <= bins + margin && at.y <= bins + margin)) {
            fail(fmt::format("sample {}, ({}, {}), is outside the domain, ({}, {}) to ({}, {})",
                             &sample - samples.data(), sample.x, sample.y, domain.lower.x, domain.lower.y,
                             domain.upper.x, domain.upper.y));
            return;
        }
        const auto bin = [&](double x) { return std::clamp(static_cast<int>(std::floor(x)), 0, bins - 1); };
        observed[static_cast<std::size_t>(bin(at.y) * bins + bin(at.x))] += 1.0;
    }
    const ChiSquare test = chiSquare(observed, expected);
    if (!(test.degrees > 0.0))
        fail(fmt::format("{} samples are too few for {} x {} bins", samples.size(), bins, bins));
    if (test.p >= alpha) return;
    for (std::size_t c = 0; c < cells; ++c)
        z[c] = expected[c] > 0.0 ? (observed[c] - expected[c]) / std::sqrt(expected[c]) : 0.0;
    fail(fmt::format("chi-square {:.6g} of {} degrees, p {:.3g} below {:.3g}; see {}, {}, {}", test.statistic,
                     test.degrees, test.p, alpha, writeArtefact(name, "observed", bins, observed),
                     writeArtefact(name, "expected", bins, expected), writeArtefact(name, "z", bins, z)));
}

}  // namespace duolux::test
