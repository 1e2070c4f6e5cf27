#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "host/tools/compare/flip.h"

// FLIP against values that follow from published CIELAB coordinates, invariants, and a direct evaluation of
// the paper's two-dimensional filters at single pixels.

namespace duolux {
namespace {

using Image = std::vector<glm::vec3>;

Image noise(std::uint32_t width, std::uint32_t height, unsigned seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<float> value(0.0f, 1.0f);
    Image image(std::size_t{width} * height);
    for (glm::vec3& pixel : image)
        pixel = {value(engine), value(engine), value(engine)};
    return image;
}

Image plain(glm::vec3 colour) {
    return Image(8 * 8, colour);
}

TEST(Flip, EqualImagesDoNotDiffer) {
    const Image image = noise(20, 10, 1);
    for (const float value : flip(image, image, 20, 10))
        EXPECT_EQ(value, 0.0f);
}

TEST(Flip, GreenAndBlueAreFarthestApart) {
    for (const float value : flip(plain({0, 1, 0}), plain({0, 0, 1}), 8, 8))
        EXPECT_NEAR(value, 1.0f, 1e-6f);
}

TEST(Flip, PlainColoursByHand) {
    // CIELAB (D65) of sRGB's primaries as published: green 87.7347 -86.1827 83.1793, blue 32.2970 79.1875
    // -107.8602, red 53.2408 80.0925 67.2032; white 100 0 0. With the Hunt effect a and b are multiplied by L
    // / 100.
    const auto hunt = [](double l, double a, double b) { return glm::dvec3(l, a * l / 100, b * l / 100); };
    const auto distance = [](glm::dvec3 a, glm::dvec3 b) {
        return std::pow(std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z), 0.7);
    };
    const glm::dvec3 red = hunt(53.2408, 80.0925, 67.2032);
    const glm::dvec3 white(100, 0, 0);
    const glm::dvec3 black(0, 0, 0);
    const double largest = distance(hunt(87.7347, -86.1827, 83.1793), hunt(32.2970, 79.1875, -107.8602));
    const auto expected = [&](glm::dvec3 a, glm::dvec3 b) {
        const double ratio = distance(a, b) / largest;
        return ratio < 0.4 ? ratio * 0.95 / 0.4 : 0.95 + (ratio - 0.4) / 0.6 * 0.05;
    };
    EXPECT_NEAR(flip(plain(glm::vec3(1)), plain(glm::vec3(0)), 8, 8)[27], expected(white, black), 1e-5);
    EXPECT_NEAR(flip(plain({1, 0, 0}), plain(glm::vec3(0)), 8, 8)[27], expected(red, black), 1e-4);
    EXPECT_NEAR(flip(plain({1, 0, 0}), plain(glm::vec3(1)), 8, 8)[27], expected(red, white), 1e-4);
    // Greys: L = 116 Y^(1/3) - 16; here below the knee.
    const double linear = std::pow((0.5 + 0.055) / 1.055, 2.4);
    const double l = 116 * std::cbrt(linear) - 16;
    const double near = 116 * std::cbrt(std::pow((0.45 + 0.055) / 1.055, 2.4)) - 16;
    EXPECT_NEAR(flip(plain(glm::vec3(0.5f)), plain(glm::vec3(0.45f)), 8, 8)[27],
                expected({l, 0, 0}, {near, 0, 0}), 1e-5);
}

TEST(Flip, DoesNotDependOnTheOrderOfTheImages) {
    const Image a = noise(17, 12, 2);
    const Image b = noise(17, 12, 3);
    EXPECT_EQ(flip(a, b, 17, 12), flip(b, a, 17, 12));
}

TEST(Flip, MovesWithTheContentAndTurnsWithTheImage) {
    constexpr std::uint32_t kSize = 80;
    const auto withDot = [](std::uint32_t x, std::uint32_t y) {
        Image image(kSize * kSize, glm::vec3(0.3f));
        image[y * kSize + x] = {0.9f, 0.2f, 0.1f};
        return image;
    };
    const Image empty(kSize * kSize, glm::vec3(0.3f));
    const std::vector<float> at = flip(withDot(38, 40), empty, kSize, kSize);
    const std::vector<float> moved = flip(withDot(43, 37), empty, kSize, kSize);
    const std::vector<float> turned = flip(withDot(40, 38), empty, kSize, kSize);
    for (int y = -10; y <= 10; ++y) {
        for (int x = -10; x <= 10; ++x) {
            const auto index = [&](int px, int py) {
                return static_cast<std::size_t>(py * static_cast<int>(kSize) + px);
            };
            EXPECT_NEAR(at[index(38 + x, 40 + y)], moved[index(43 + x, 37 + y)], 1e-6);
            EXPECT_NEAR(at[index(38 + x, 40 + y)], turned[index(40 + y, 38 + x)], 1e-6);
        }
    }
}

/// The paper's formulas, evaluated one by one for a single pixel with full two-dimensional filters.
class DirectFlip {
  public:
    DirectFlip(const Image& a, const Image& b, int width, int height)
        : a_(a), b_(b), width_(width), height_(height) {}

    double at(int x, int y) const {
        const double largest = std::pow(hyab(lab({0, 1, 0}), lab({0, 0, 1})), 0.7);
        const double d = std::pow(hyab(lab(seen(a_, x, y)), lab(seen(b_, x, y))), 0.7) / largest;
        const double colour = d < 0.4 ? d * 0.95 / 0.4 : 0.95 + (d - 0.4) / 0.6 * 0.05;
        const double edges = std::abs(feature(a_, x, y, false) - feature(b_, x, y, false));
        const double points = std::abs(feature(a_, x, y, true) - feature(b_, x, y, true));
        return std::pow(colour, 1.0 - std::sqrt(std::max(edges, points) / std::sqrt(2.0)));
    }

  private:
    static double linear(float v) {
        return v <= 0.04045f ? static_cast<double>(v) / 12.92
                             : std::pow((static_cast<double>(v) + 0.055) / 1.055, 2.4);
    }
    // X/Xn, Y/Yn, Z/Zn with the rounded matrix of IEC 61966-2-1.
    static glm::dvec3 xyz(glm::dvec3 c) {
        return {(0.4124 * c.x + 0.3576 * c.y + 0.1805 * c.z) / 0.9505,
                0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z,
                (0.0193 * c.x + 0.1192 * c.y + 0.9505 * c.z) / 1.0890};
    }
    static glm::dvec3 rgb(glm::dvec3 n) {
        const double x = n.x * 0.9505;
        const double z = n.z * 1.0890;
        return {3.2406 * x - 1.5372 * n.y - 0.4986 * z, -0.9689 * x + 1.8758 * n.y + 0.0415 * z,
                0.0557 * x - 0.2040 * n.y + 1.0570 * z};
    }
    static glm::dvec3 lab(glm::dvec3 c) {
        const glm::dvec3 n = xyz(c);
        const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116; };
        const double l = 116 * f(n.y) - 16;
        return {l, l / 100 * 500 * (f(n.x) - f(n.y)), l / 100 * 200 * (f(n.y) - f(n.z))};
    }
    static double hyab(glm::dvec3 a, glm::dvec3 b) {
        return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
    }
    glm::dvec3 ycxcz(const Image& image, int x, int y) const {
        const glm::vec3 p = image[static_cast<std::size_t>(std::clamp(y, 0, height_ - 1) * width_ +
                                                           std::clamp(x, 0, width_ - 1))];
        const glm::dvec3 n = xyz({linear(p.x), linear(p.y), linear(p.z)});
        return {116 * n.y - 16, 500 * (n.x - n.y), 200 * (n.y - n.z)};
    }
    glm::dvec3 seen(const Image& image, int x, int y) const {
        const double pi = std::numbers::pi;
        const int radius =
            static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * kFlipPixelsPerDegree));
        glm::dvec3 sum(0.0);
        glm::dvec3 weights(0.0);
        for (int j = -radius; j <= radius; ++j) {
            for (int i = -radius; i <= radius; ++i) {
                const double z = (i * i + j * j) / (kFlipPixelsPerDegree * kFlipPixelsPerDegree);
                const auto g = [&](double a, double b) {
                    return a * std::sqrt(pi / b) * std::exp(-pi * pi * z / b);
                };
                const glm::dvec3 w(g(1, 0.0047), g(1, 0.0053), g(34.1, 0.04) + g(13.5, 0.025));
                sum += w * ycxcz(image, x + i, y + j);
                weights += w;
            }
        }
        const glm::dvec3 c = sum / weights;
        const double n = (c.x + 16) / 116;
        return glm::clamp(rgb({n + c.y / 500, n, n - c.z / 200}), 0.0, 1.0);
    }
    double feature(const Image& image, int x, int y, bool point) const {
        const double s = 0.5 * 0.082 * kFlipPixelsPerDegree;
        const int radius = static_cast<int>(std::ceil(3 * s));
        glm::dvec2 positive(0.0);
        glm::dvec2 negative(0.0);
        double positiveWeight = 0;
        double negativeWeight = 0;
        for (int j = -radius; j <= radius; ++j) {
            for (int i = -radius; i <= radius; ++i) {
                const double g = std::exp(-(i * i + j * j) / (2 * s * s));
                const double w = point ? (i * i / (s * s) - 1) * g : -i * g;
                const glm::dvec2 v((ycxcz(image, x + i, y + j).x + 16) / 116,
                                   (ycxcz(image, x + j, y + i).x + 16) / 116);
                (w > 0 ? positive : negative) += std::abs(w) * v;
                (w > 0 ? positiveWeight : negativeWeight) += std::abs(w);
            }
        }
        return glm::length(positive / positiveWeight - negative / negativeWeight);
    }

    const Image& a_;
    const Image& b_;
    int width_, height_;
};

TEST(Flip, AgreesWithADirectEvaluation) {
    constexpr int kWidth = 23;
    constexpr int kHeight = 15;
    Image a = noise(kWidth, kHeight, 4);
    Image b = noise(kWidth, kHeight, 5);
    for (std::size_t i = 0; i < a.size(); ++i) {  // with an edge and a plain part
        if (i % kWidth < 8) a[i] = {0.8f, 0.7f, 0.1f};
        if (i % kWidth < 4) b[i] = {0.2f, 0.3f, 0.9f};
    }
    const std::vector<float> map = flip(a, b, kWidth, kHeight);
    const DirectFlip direct(a, b, kWidth, kHeight);
    for (const auto& [x, y] : {std::pair(0, 0), {22, 14}, {4, 7}, {8, 3}, {12, 12}, {6, 0}, {1, 9}}) {
        // The direct evaluation uses matrices rounded to four digits.
        EXPECT_NEAR(map[static_cast<std::size_t>(y * kWidth + x)], direct.at(x, y), 2e-3) << x << " " << y;
    }
}

}  // namespace
}  // namespace duolux
