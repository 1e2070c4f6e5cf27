#pragma once

#include <cstdint>
#include <string>

#include "host/scene/scene.h"

namespace duolux {

/// Why a picture is dark.
enum class Darkness : std::uint8_t {
    kNothingEmits,
    kLooksPast,       ///< the camera looks past the scene, or nearly so
    kOnlyEmitters,    ///< it sees emitters alone, which emit no visible light
    kNoBounces,       ///< no light scatters, and what the camera sees emits no visible light
    kNothingVisible,  ///< no reflectance turns what is emitted into visible light
    kBlackSurfaces,   ///< what it sees reflects nothing
    kBehind,          ///< it stands behind or inside of surfaces: their other sides are lit
    kFacingAway,      ///< the emitters' front sides face away
    kEnclosed,        ///< other surfaces are between the emitters and what it sees
    kUnknown          ///< light does arrive
};

struct DarkReason {
    Darkness darkness;
    std::string material;  ///< of the surfaces that it sees most, or, facing away, of the emitters
    float filled;          ///< the part of the picture in which there is something
    Camera better;         ///< that would be chosen automatically
};

/// The likely cause, by rays from the camera and paths from what it sees to the emitters.
DarkReason whyDark(const Scene& scene);

}  // namespace duolux
