#include "host/image/convert.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "host/scene/roughness.h"

namespace duolux {

namespace {

std::size_t pixelsOf(const Image& image) {
    return std::size_t{image.width} * image.height;
}

glm::vec4 pixelOf(const Image& image, std::size_t index) {
    glm::vec4 pixel;
    for (int i = 0; i < 4; ++i) {
        const std::size_t at = 4 * index + static_cast<std::size_t>(i);
        pixel[i] = image.floats.empty() ? static_cast<float>(image.bytes[at]) / 255.0f : image.floats[at];
    }
    return pixel;
}

/// Images of bytes are limited to 0 to 1.
void setPixel(Image& image, std::size_t index, const glm::vec4& pixel) {
    for (int i = 0; i < 4; ++i) {
        const std::size_t at = 4 * index + static_cast<std::size_t>(i);
        if (image.floats.empty()) {
            image.bytes[at] =
                static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(pixel[i], 0.0f, 1.0f)));
        } else {
            image.floats[at] = pixel[i];
        }
    }
}

/// `change`: glm::vec4 -> glm::vec4.
template <typename Change>
void changePixels(Image& image, const Change& change) {
    for (std::size_t i = 0; i < pixelsOf(image); ++i)
        setPixel(image, i, change(pixelOf(image, i)));
}

float quantityOf(const glm::vec4& pixel, std::uint32_t channel) {
    // ITU-R BT.709. Of grey pixels, exactly their value.
    constexpr glm::vec3 kWeights(0.2126f, 0.7152f, 0.0722f);
    if (channel < 4) return pixel[static_cast<int>(channel)];
    if (pixel.x == pixel.y && pixel.y == pixel.z) return pixel.x;
    return glm::dot(glm::vec3(pixel), kWeights);
}

/// The difference quotient along a row or column of `count` values; `at(i)`: its values.
template <typename At>
float derivative(std::int64_t i, std::int64_t count, bool repeats, const At& at) {
    if (count == 1) return 0.0f;
    const auto width = static_cast<float>(count);
    if (repeats) return (at((i + 1) % count) - at((i + count - 1) % count)) * 0.5f * width;
    const std::int64_t before = std::max<std::int64_t>(i - 1, 0), after = std::min(i + 1, count - 1);
    return (at(after) - at(before)) / static_cast<float>(after - before) * width;
}

void makeNormals(Image& image, const ImageConversion& conversion) {
    const std::size_t pixels = pixelsOf(image);
    const std::int64_t width = image.width, height = image.height;
    std::vector<float> heights(pixels);
    for (std::size_t i = 0; i < pixels; ++i)
        heights[i] = quantityOf(pixelOf(image, i), conversion.channel);
    const auto heightAt = [&](std::int64_t x, std::int64_t y) {
        return heights[static_cast<std::size_t>(y * width + x)];
    };
    image.bytes = {};
    image.floats.assign(4 * pixels, 1.0f);
    for (std::int64_t y = 0; y < height; ++y) {
        for (std::int64_t x = 0; x < width; ++x) {
            const float du = derivative(x, width, conversion.repeats, [&](auto i) { return heightAt(i, y); });
            const float dv =
                derivative(y, height, conversion.repeats, [&](auto i) { return heightAt(x, i); });
            const glm::vec3 normal = glm::normalize(glm::vec3(-kBumpHeight * du, kBumpHeight * dv, 1.0f));
            setPixel(image, static_cast<std::size_t>(y * width + x), glm::vec4(normal * 0.5f + 0.5f, 1.0f));
        }
    }
}

}  // namespace

bool hasNormals(const Image& image) {
    constexpr double kMostAway = 0.02;  // fraction of the pixels
    constexpr float kTolerance = 0.15f, kLeastBlue = 0.1f;
    const std::size_t pixels = pixelsOf(image);
    std::size_t away = 0;
    double blue = 0.0;
    for (std::size_t i = 0; i < pixels; ++i) {
        const glm::vec3 pixel(pixelOf(image, i));
        const glm::vec3 normal = 2.0f * pixel - 1.0f;
        blue += static_cast<double>(pixel.z - 0.5f * (pixel.x + pixel.y));
        if (std::abs(glm::length(normal) - 1.0f) > kTolerance || normal.z < 0.0f) ++away;
    }
    return blue > static_cast<double>(kLeastBlue) * static_cast<double>(pixels) &&
           static_cast<double>(away) <= kMostAway * static_cast<double>(pixels);
}

void convert(Image& image, const ImageConversion& conversion) {
    using Kind = ImageConversion::Kind;
    if (conversion.kind == Kind::kHeights && hasNormals(image)) return;
    if (conversion.base != 0.0f || conversion.gain != 1.0f) {
        changePixels(image, [&](const glm::vec4& pixel) {
            return glm::vec4(conversion.base + conversion.gain * glm::vec3(pixel), pixel.w);
        });
    }
    if (conversion.kind == Kind::kHeights) makeNormals(image, conversion);
    if (conversion.kind == Kind::kExponents) {
        changePixels(image, [&](const glm::vec4& pixel) {
            const float exponent = std::max(conversion.factor * quantityOf(pixel, conversion.channel), 0.0f);
            const double roughness =
                exponent >= conversion.mirrorFrom ? 0.0 : roughnessOfExponent(static_cast<double>(exponent));
            return glm::vec4(glm::vec3(static_cast<float>(roughness)), 1.0f);
        });
    }
    if (conversion.kind == Kind::kGlossiness) {
        changePixels(image, [&](const glm::vec4& pixel) {
            const float glossiness = conversion.factor * quantityOf(pixel, conversion.channel);
            return glm::vec4(glm::vec3(std::clamp(1.0f - glossiness, 0.0f, 1.0f)), 1.0f);
        });
    }
}

}  // namespace duolux
