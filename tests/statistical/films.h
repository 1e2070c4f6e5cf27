#pragma once

#include <algorithm>

#include "host/film/film.h"
#include "host/scene/scene.h"

namespace duolux::test {

inline bool sameBits(const Film& a, const Film& b) {
    const auto equal = [](const Film::PixelSum& p, const Film::PixelSum& q) {
        return std::ranges::equal(p.invisible, q.invisible) && std::ranges::equal(p.visible, q.visible);
    };
    return a.quantum() == b.quantum() && std::ranges::equal(a.samples(), b.samples()) &&
           a.lightPaths() == b.lightPaths() && std::ranges::equal(a.sums(), b.sums(), equal) &&
           std::ranges::equal(a.lightPathSums(), b.lightPathSums(), equal) && a.carries() == b.carries() &&
           a.layers() == b.layers() && std::ranges::equal(a.layerSums(), b.layerSums());
}

inline LoadedScene byLight(LoadedScene scene) {
    scene.settings.integrator = Integrator::kLightTracer;
    return scene;
}

}  // namespace duolux::test
