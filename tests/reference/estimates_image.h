#pragma once

#include "host/film/image.h"
#include "tests/reference/tracer.h"

namespace duolux::reference {

/// The means as an image.
inline RadianceImage imageOf(const Estimates& estimates) {
    RadianceImage image{estimates.width, estimates.height, {}, {}};
    for (const Estimate& e : estimates.pixels) {
        image.invisible.emplace_back(e.mean[0][0], e.mean[0][1], e.mean[0][2]);
        image.visible.emplace_back(e.mean[1][0], e.mean[1][1], e.mean[1][2]);
    }
    return image;
}

}  // namespace duolux::reference
