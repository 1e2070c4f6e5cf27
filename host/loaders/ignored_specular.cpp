#include "host/loaders/ignored_specular.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "host/base/printable.h"
#include "host/loaders/tally.h"

namespace duolux {

namespace {

bool ignoresSpecular(const Material& material) {
    const bool scaled = material.specular != 1.0f || material.specularColor != glm::vec3(1.0f) ||
                        hasTexture(material, MaterialInput::kSpecular) ||
                        hasTexture(material, MaterialInput::kSpecularColor);
    return scaled && material.transmission > 0.0f && material.metallic < 1.0f;
}

}  // namespace

void warnOfIgnoredSpecular(LoadedScene& scene) {
    const auto first = std::ranges::find_if(scene.materials, ignoresSpecular);
    if (first == scene.materials.end()) return;
    const auto count = static_cast<std::size_t>(std::count_if(first, scene.materials.end(), ignoresSpecular));
    scene.warnings.push_back(fmt::format(
        "{}: material {}{}: specular and specular_color have no effect where light is transmitted: the "
        "surface reflects there by its index of refraction alone",
        scene.source.string(), inQuotes(first->name), andMore(count)));
}

}  // namespace duolux
