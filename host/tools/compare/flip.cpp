#include "host/tools/compare/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "host/base/parallel.h"
#include "host/base/srgb.h"

namespace duolux {

namespace {

using Plane = std::vector<glm::dvec3>;

/// Weights at -radius ... radius.
using Kernel = std::vector<double>;

// Section 4.1: sums of two Gaussians per channel (achromatic, red-green, blue-yellow) that model the contrast
// sensitivity of the eye; a in units of the filter, b in degrees squared.
struct ContrastFilter {
    double a1, b1, a2, b2;
};
constexpr std::array<ContrastFilter, 3> kContrastFilters{
    {{1.0, 0.0047, 0.0, 1e-5}, {1.0, 0.0053, 0.0, 1e-5}, {34.1, 0.04, 13.5, 0.025}}};
constexpr double kWidestB = 0.04;

constexpr double kColourExponent = 0.7;   // q_c
constexpr double kColourKnee = 0.4;       // p_c
constexpr double kColourAtKnee = 0.95;    // p_t
constexpr double kFeatureWidth = 0.082;   // w, degrees
constexpr double kFeatureExponent = 0.5;  // q_f

constexpr glm::dmat3 kRgbToXyz{// columns are the primaries of sRGB, scaled so that they sum to kWhite
                               {10135552.0 / 24577794.0, 2613072.0 / 12288897.0, 1425312.0 / 73733382.0},
                               {8788810.0 / 24577794.0, 8788810.0 / 12288897.0, 8788810.0 / 73733382.0},
                               {4435075.0 / 24577794.0, 887015.0 / 12288897.0, 70074185.0 / 73733382.0}};
const glm::dvec3 kWhite = kRgbToXyz * glm::dvec3(1.0);
const glm::dmat3 kXyzToRgb = glm::inverse(kRgbToXyz);

glm::dvec3 rgbToYcxcz(glm::dvec3 rgb) {
    const glm::dvec3 c = kRgbToXyz * rgb / kWhite;
    return {116.0 * c.y - 16.0, 500.0 * (c.x - c.y), 200.0 * (c.y - c.z)};
}

glm::dvec3 ycxczToRgb(glm::dvec3 ycxcz) {
    const double y = (ycxcz.x + 16.0) / 116.0;
    return kXyzToRgb * (glm::dvec3(y + ycxcz.y / 500.0, y, y - ycxcz.z / 200.0) * kWhite);
}

/// CIELAB with the Hunt effect: colour differences are smaller in dark areas.
glm::dvec3 rgbToHuntLab(glm::dvec3 rgb) {
    const glm::dvec3 xyz = kRgbToXyz * rgb / kWhite;
    const auto f = [](double t) {
        constexpr double kDelta = 6.0 / 29.0;
        return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
    };
    const double l = 116.0 * f(xyz.y) - 16.0;
    return {l, 0.01 * l * 500.0 * (f(xyz.x) - f(xyz.y)), 0.01 * l * 200.0 * (f(xyz.y) - f(xyz.z))};
}

double hyab(glm::dvec3 a, glm::dvec3 b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

/// Filters rows or columns; the outermost pixels are repeated beyond the border.
template <typename T>
std::vector<T> convolve(const std::vector<T>& in, std::uint32_t width, std::uint32_t height,
                        const Kernel& kernel, bool rows) {
    const int radius = static_cast<int>(kernel.size() / 2);
    const int last = static_cast<int>(rows ? width : height) - 1;
    const std::size_t stride = rows ? 1 : width;
    std::vector<T> out(in.size());
    parallelFor(height, 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) {
            for (std::size_t x = 0; x < width; ++x) {
                const std::size_t first = rows ? y * width : x;
                const int at = static_cast<int>(rows ? x : y);
                T sum(0.0);
                for (int k = -radius; k <= radius; ++k) {
                    sum += kernel[static_cast<std::size_t>(k + radius)] *
                           in[first + static_cast<std::size_t>(std::clamp(at + k, 0, last)) * stride];
                }
                out[y * width + x] = sum;
            }
        }
    });
    return out;
}

Kernel gaussian(int radius, double exponent) {  // exp(-exponent k^2)
    Kernel kernel;
    for (int k = -radius; k <= radius; ++k)
        kernel.push_back(std::exp(-exponent * k * k));
    return kernel;
}

double sum(const Kernel& kernel) {
    double total = 0.0;
    for (const double weight : kernel)
        total += weight;
    return total;
}

std::vector<double> channel(const Plane& plane, int c) {
    std::vector<double> values(plane.size());
    std::transform(plane.begin(), plane.end(), values.begin(), [c](const glm::dvec3& p) { return p[c]; });
    return values;
}

/// Filters an image in YCxCz by the contrast sensitivity of the eye; returns linear RGB clamped to [0, 1].
Plane filterAsSeen(const Plane& ycxcz, std::uint32_t width, std::uint32_t height, double pixelsPerDegree) {
    constexpr double kPi = std::numbers::pi;
    const int radius =
        static_cast<int>(std::ceil(3.0 * std::sqrt(kWidestB / (2.0 * kPi * kPi)) * pixelsPerDegree));
    Plane out(ycxcz.size());
    for (int c = 0; c < 3; ++c) {
        const ContrastFilter& f = kContrastFilters[static_cast<std::size_t>(c)];
        const std::vector<double> in = channel(ycxcz, c);
        std::vector<double> filtered(in.size(), 0.0);
        double total = 0.0;
        for (const auto& [a, b] : {std::pair(f.a1, f.b1), std::pair(f.a2, f.b2)}) {
            if (a == 0.0) continue;
            const double scale = a * std::sqrt(kPi / b);
            const Kernel kernel = gaussian(radius, kPi * kPi / (b * pixelsPerDegree * pixelsPerDegree));
            const std::vector<double> part =
                convolve(convolve(in, width, height, kernel, true), width, height, kernel, false);
            for (std::size_t i = 0; i < in.size(); ++i)
                filtered[i] += scale * part[i];
            total += scale * sum(kernel) * sum(kernel);
        }
        for (std::size_t i = 0; i < in.size(); ++i)
            out[i][c] = filtered[i] / total;
    }
    for (glm::dvec3& p : out)
        p = glm::clamp(ycxczToRgb(p), 0.0, 1.0);
    return out;
}

/// Strength of edges and points (of first and second derivatives) of a lightness from 0 to 1.
struct Features {
    std::vector<double> edges, points;
};

/// Scales the positive weights to a sum of 1, and the negative ones to -1.
void normaliseSides(Kernel& kernel) {
    double positive = 0.0;
    double negative = 0.0;
    for (const double weight : kernel)
        (weight > 0.0 ? positive : negative) += std::abs(weight);
    for (double& weight : kernel)
        weight /= weight > 0.0 ? positive : negative;
}

Features detectFeatures(const std::vector<double>& lightness, std::uint32_t width, std::uint32_t height,
                        double pixelsPerDegree) {
    const double deviation = 0.5 * kFeatureWidth * pixelsPerDegree;
    const int radius = static_cast<int>(std::ceil(3.0 * deviation));
    Kernel smooth = gaussian(radius, 0.5 / (deviation * deviation));
    Kernel first = smooth;
    Kernel second = smooth;
    for (int k = -radius; k <= radius; ++k) {
        const auto i = static_cast<std::size_t>(k + radius);
        first[i] *= -k;
        second[i] *= k * k / (deviation * deviation) - 1.0;
    }
    normaliseSides(first);
    normaliseSides(second);
    const double total = sum(smooth);
    for (double& weight : smooth)
        weight /= total;
    const auto strength = [&](const Kernel& derivative) {
        const std::vector<double> x =
            convolve(convolve(lightness, width, height, derivative, true), width, height, smooth, false);
        std::vector<double> y =
            convolve(convolve(lightness, width, height, derivative, false), width, height, smooth, true);
        for (std::size_t i = 0; i < y.size(); ++i)
            y[i] = std::hypot(x[i], y[i]);
        return y;
    };
    return {strength(first), strength(second)};
}

struct Perceived {
    Plane colours;  ///< linear RGB
    Features features;
};

Perceived perceive(const std::vector<glm::vec3>& srgb, std::uint32_t width, std::uint32_t height,
                   double pixelsPerDegree) {
    Plane ycxcz(srgb.size());
    std::vector<double> lightness(srgb.size());
    for (std::size_t i = 0; i < srgb.size(); ++i) {
        glm::dvec3 linear;
        for (int c = 0; c < 3; ++c)
            linear[c] = srgbDecode(std::clamp(static_cast<double>(srgb[i][c]), 0.0, 1.0));
        ycxcz[i] = rgbToYcxcz(linear);
        lightness[i] = (ycxcz[i].x + 16.0) / 116.0;
    }
    return {filterAsSeen(ycxcz, width, height, pixelsPerDegree),
            detectFeatures(lightness, width, height, pixelsPerDegree)};
}

}  // namespace

std::vector<float> flip(const std::vector<glm::vec3>& test, const std::vector<glm::vec3>& reference,
                        std::uint32_t width, std::uint32_t height, double pixelsPerDegree) {
    const Perceived a = perceive(test, width, height, pixelsPerDegree);
    const Perceived b = perceive(reference, width, height, pixelsPerDegree);
    // The two colours of sRGB that are farthest apart.
    const double largest = std::pow(hyab(rgbToHuntLab({0, 1, 0}), rgbToHuntLab({0, 0, 1})), kColourExponent);
    const double knee = kColourKnee * largest;
    std::vector<float> result(test.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double difference =
            std::pow(hyab(rgbToHuntLab(a.colours[i]), rgbToHuntLab(b.colours[i])), kColourExponent);
        const double colour = difference < knee ? kColourAtKnee / knee * difference
                                                : kColourAtKnee + (difference - knee) / (largest - knee) *
                                                                      (1.0 - kColourAtKnee);
        const double feature = std::max(std::abs(a.features.edges[i] - b.features.edges[i]),
                                        std::abs(a.features.points[i] - b.features.points[i])) /
                               std::numbers::sqrt2;
        result[i] = static_cast<float>(std::pow(colour, 1.0 - std::pow(feature, kFeatureExponent)));
    }
    return result;
}

}  // namespace duolux
