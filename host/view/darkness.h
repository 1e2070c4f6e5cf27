#pragma once

#include <cstdint>
#include <string>

#include "host/scene/scene.h"

namespace duolux {

/// Why an image is dark.
enum class Darkness : std::uint8_t {
    kNothingEmits,
    kLooksPast,       ///< the camera sees nothing of the scene, or almost nothing
    kOnlyEmitters,    ///< it sees only emitters, which emit no visible light
    kNoBounces,       ///< no light scatters, and what the camera sees emits no visible light
    kNothingVisible,  ///< no reflectance matrix turns the emitted component into visible light
    kBlackSurfaces,   ///< the surfaces that it sees reflect nothing
    kBehind,          ///< it is behind or inside surfaces whose other sides are lit
    kFacingAway,      ///< the front sides of the emitters face away
    kEnclosed,        ///< other surfaces block the light of the emitters
    kMirrors,         ///< the surfaces that it sees only reflect or refract, without a diffuse part
    kUnknown          ///< none of these: light arrives
};

struct DarkReason {
    Darkness darkness;
    std::string material;  ///< the material that it sees most or, with kFacingAway, of the emitters
    float filled;          ///< fraction of the image in which there are surfaces
    Camera better;         ///< the camera that would be chosen automatically
};

/// The likely cause, found by rays from the camera and paths from the surfaces that it sees to the emitters.
DarkReason whyDark(const Scene& scene, const RenderSettings& settings);

}  // namespace duolux
