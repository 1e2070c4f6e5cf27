#include "host/tools/compare/heat_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/base/srgb.h"

namespace duolux {

namespace {

// sRGB-encoded. Their lightness increases evenly, so that the order is also visible in greyscale.
constexpr std::array<glm::vec3, 6> kStops{{{0, 0, 0},
                                           {0.20f, 0.05f, 0.45f},
                                           {0.62f, 0.12f, 0.42f},
                                           {0.93f, 0.36f, 0.19f},
                                           {0.98f, 0.75f, 0.20f},
                                           {1, 1, 1}}};

glm::vec3 colourOf(float t) {
    if (!std::isfinite(t)) return {0.0f, 1.0f, 0.0f};
    const float scaled = std::clamp(t, 0.0f, 1.0f) * static_cast<float>(kStops.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(scaled), kStops.size() - 2);
    return glm::mix(kStops[i], kStops[i + 1], scaled - static_cast<float>(i));
}

}  // namespace

RadianceImage heatMap(const std::vector<float>& values, std::uint32_t width, std::uint32_t height,
                      float largest) {
    RadianceImage image{width, height, {}, {}};
    image.invisible.assign(values.size(), glm::vec3(0.0f));
    for (const float value : values) {
        glm::vec3 colour = colourOf(value / largest);
        for (int c = 0; c < 3; ++c)
            colour[c] = static_cast<float>(srgbDecode(static_cast<double>(colour[c])));
        image.visible.push_back(colour);
    }
    return image;
}

}  // namespace duolux
