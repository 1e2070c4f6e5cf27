#pragma once

#include <cstdint>

#include "host/scene/scene.h"

namespace duolux {

/// Where a material is smooth: it reflects (or refracts) each direction into one other. The light tracer
/// cannot connect such surfaces to the camera.
enum class Smoothness : std::uint8_t {
    kNowhere,
    kWhereImagesSaySo,  ///< perhaps: some pixel of an image makes it smooth
    kEverywhere
};

/// Materials of the scene, because the pixels of their images count.
Smoothness smoothnessOf(const Scene& scene, const Material& material);

}  // namespace duolux
