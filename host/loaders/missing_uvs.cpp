#include "host/loaders/missing_uvs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "host/base/printable.h"
#include "host/loaders/tally.h"

namespace duolux {

void warnOfMissingUvs(LoadedScene& scene) {
    const Geometry& geometry = scene.geometry;
    const auto usesSecondUvs = [](const MaterialTexture& entry) { return entry.texture.uvSet > 0; };
    std::vector<std::size_t> missing(scene.materials.size(), 0);
    for (std::size_t i = 0; i < geometry.triangles.size(); ++i) {
        const std::uint32_t index = geometry.materials[i];
        const std::vector<MaterialTexture>& textures = scene.materials[index].textures;
        if (textures.empty()) continue;
        const bool hasUvs = !geometry.uvs.empty() && geometry.uvIndices[i].x != Geometry::kNoUv;
        const bool suffices = hasUvs && (!geometry.secondUvs.empty() ||
                                         std::none_of(textures.begin(), textures.end(), usesSecondUvs));
        if (!suffices) ++missing[index];
    }
    const auto first =
        std::find_if(missing.begin(), missing.end(), [](std::size_t count) { return count > 0; });
    if (first == missing.end()) return;
    const auto materials = static_cast<std::size_t>(
        std::count_if(first, missing.end(), [](std::size_t count) { return count > 0; }));
    scene.warnings.push_back(fmt::format(
        "{}: material {}{}: {} of its triangles ha{} no coordinates for its images: (0, 0) is used",
        scene.source.string(),
        inQuotes(scene.materials[static_cast<std::size_t>(first - missing.begin())].name), andMore(materials),
        *first, *first == 1 ? "s" : "ve"));
}

}  // namespace duolux
