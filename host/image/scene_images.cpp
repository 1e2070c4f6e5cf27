#include "host/image/scene_images.h"

#include <fmt/format.h>

#include <cstdint>
#include <exception>
#include <optional>
#include <utility>
#include <vector>

#include "host/base/error.h"
#include "host/base/parallel.h"
#include "host/image/decode.h"

namespace duolux {

namespace {

/// An image, or why there is none.
struct Attempt {
    DecodedImage decoded;
    std::optional<InputError> failure;
};

std::vector<Attempt> decodeAll(const std::vector<ImageSource>& sources) {
    std::vector<Attempt> attempts(sources.size());
    parallelFor(sources.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            try {
                attempts[i].decoded = decodeImage(sources[i]);
            } catch (const InputError& error) {
                attempts[i].failure = error;
            }
        }
    });
    return attempts;
}

}  // namespace

void decodeImages(LoadedScene& scene, Reading reading) {
    std::vector<Attempt> attempts = decodeAll(scene.imageSources);
    std::vector<std::optional<std::uint32_t>> places(attempts.size());  // after those that failed are gone
    std::vector<bool> linear;
    std::vector<ImageSource> sources;
    for (std::size_t i = 0; i < attempts.size(); ++i) {
        auto& [decoded, failure] = attempts[i];
        ImageSource& source = scene.imageSources[i];
        if (failure) {
            if (reading == Reading::kStrict) throw InputError(*failure);
            scene.warnings.emplace_back(fmt::format("{}: materials are without this image", failure->what()));
            continue;
        }
        if (decoded.nonFinite > 0) {
            scene.warnings.emplace_back(
                fmt::format("{}: {} values are not finite: they are 0", source.name, decoded.nonFinite));
        }
        places[i] = static_cast<std::uint32_t>(scene.images.size());
        scene.images.push_back(std::move(decoded.image));
        linear.push_back(decoded.linear);
        if (!source.path.empty()) scene.files.push_back(source.path);
        sources.push_back(std::move(source));
    }
    scene.imageSources = std::move(sources);
    for (Material& material : scene.materials) {
        std::erase_if(material.textures,
                      [&](const MaterialTexture& entry) { return !places[entry.texture.image]; });
        for (MaterialTexture& entry : material.textures) {
            entry.texture.image = *places[entry.texture.image];
            if (linear[entry.texture.image]) entry.texture.colourSpace = ColourSpace::kLinear;
        }
    }
}

}  // namespace duolux
