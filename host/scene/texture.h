#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "host/base/named.h"
#include "host/scene/image_conversion.h"

namespace duolux {

/// The pixels of an image file, RGBA, rows from the top. A grey image has equal channels; alpha is 1 where
/// the file has none.
struct Image {
    std::string name;  ///< for messages: the file, or its place in a model file
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> bytes;  ///< 4 * width * height, of an image with at most 8 bits per channel
    std::vector<float> floats;  ///< the same of any other image: finite, linear or as encoded in the file
};

/// An encoded image that a file refers to.
struct ImageSource {
    std::string name;                          ///< as Image::name
    std::filesystem::path path;                ///< of the file; empty if `bytes` holds its content
    std::shared_ptr<const std::string> bytes;  ///< the content of an embedded file
    ImageConversion conversion{};

    /// Equal for sources of the same image: the same file or part of a file, converted alike.
    std::tuple<std::filesystem::path, const std::string*, ImageConversion> identity() const {
        return {path, bytes.get(), conversion};
    }
    bool operator==(const ImageSource& other) const { return identity() == other.identity(); }
};

/// How the values of an image encode colours. Alpha is always linear.
enum class ColourSpace : std::uint8_t { kLinear, kSrgb };
/// How an image continues outside the unit square.
enum class Wrap : std::uint8_t { kRepeat, kClamp, kMirror };
enum class Filter : std::uint8_t { kLinear, kNearest };

const char* nameOf(Wrap wrap);
const char* nameOf(Filter filter);
template <>
inline constexpr std::array kValuesOf<Wrap>{Wrap::kRepeat, Wrap::kClamp, Wrap::kMirror};
template <>
inline constexpr std::array kValuesOf<Filter>{Filter::kLinear, Filter::kNearest};

/// Texture coordinates (u, v) -> offset + R(rotation) (scale * (u, v)), in this order, as in glTF's
/// KHR_texture_transform. v points down the image; (0, 0) is its top left corner.
struct UvTransform {
    glm::vec2 scale{1.0f};
    glm::vec2 offset{0.0f};
    float rotation = 0.0f;  ///< degrees; (u, v) = (1, 0) turns towards -v

    bool operator==(const UvTransform&) const = default;
};

/// An image on a surface.
struct Texture {
    std::uint32_t image = 0;  ///< index into Scene::images (or Mesh::images)
    ColourSpace colourSpace = ColourSpace::kLinear;
    Wrap wrapU = Wrap::kRepeat, wrapV = Wrap::kRepeat;
    Filter filter = Filter::kLinear;
    std::uint32_t uvSet = 0;  ///< 0 or 1
    UvTransform transform;

    bool operator==(const Texture&) const = default;
};

}  // namespace duolux
