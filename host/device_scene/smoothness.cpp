#include "host/device_scene/smoothness.h"

#include <algorithm>

#include "host/base/srgb.h"
#include "host/device_scene/transport.h"
#include "host/scene/material_textures.h"
#include "shaders/shared/material_layout.h"

namespace duolux {

namespace {

/// The smallest value of a channel, as kernels read it: 0 to 1.
float smallestOf(const Image& image, ColourSpace space, std::uint32_t channel) {
    float smallest = 1.0f;
    std::uint8_t smallestByte = 255;
    for (std::size_t i = channel; i < image.bytes.size(); i += 4)
        smallestByte = std::min(smallestByte, image.bytes[i]);
    for (std::size_t i = channel; i < image.floats.size(); i += 4)
        smallest = std::min(smallest, image.floats[i]);
    smallest = std::clamp(smallest, 0.0f, static_cast<float>(smallestByte) / 255.0f);
    const bool encoded = space == ColourSpace::kSrgb && channel < 3;
    return encoded ? static_cast<float>(srgbDecode(static_cast<double>(smallest))) : smallest;
}

/// The smallest value of an input that an image may scale.
float smallestOf(const Scene& scene, const Material& material, MaterialInput input, float value) {
    const MaterialTexture* texture = findTexture(material, input);
    if (texture == nullptr) return value;
    // Blue holds the strength of the anisotropy.
    const std::uint32_t channel = input == MaterialInput::kAnisotropy ? 2u : texture->channel;
    return value * smallestOf(*scene.images[texture->texture.image], texture->texture.colourSpace, channel);
}

/// As in shaders/lib/bsdf/bsdf_types.glsl.
bool isSmooth(float roughness, float anisotropy) {
    const float across = roughness * roughness;
    const float along = across + (1.0f - across) * anisotropy * anisotropy;
    return across * along < shared::kSmoothAlpha * shared::kSmoothAlpha;
}

}  // namespace

Smoothness smoothnessOf(const Scene& scene, const Material& material) {
    const std::uint32_t lobes = lobesOf(material);
    const auto least = [&](MaterialInput input, float value) {
        return smallestOf(scene, material, input, value);
    };
    bool everywhere = false, somewhere = false;
    if ((lobes & (shared::kLobeMetal | shared::kLobeDielectric | shared::kLobeGlass)) != 0) {
        everywhere = isSmooth(material.roughness, material.anisotropy);
        somewhere = isSmooth(least(MaterialInput::kRoughness, material.roughness),
                             least(MaterialInput::kAnisotropy, material.anisotropy));
    }
    if ((lobes & shared::kLobeClearcoat) != 0) {
        everywhere = everywhere || isSmooth(material.clearcoatRoughness, 0.0f);
        somewhere = somewhere ||
                    isSmooth(least(MaterialInput::kClearcoatRoughness, material.clearcoatRoughness), 0.0f);
    }
    if (everywhere) return Smoothness::kEverywhere;
    return somewhere ? Smoothness::kWhereImagesSaySo : Smoothness::kNowhere;
}

}  // namespace duolux
