#pragma once

#include <cstdint>

#include "host/scene/scene.h"
#include "shaders/shared/path_layout.h"

namespace duolux {

/// What the matrices of a scene's materials can do at all; kernels are specialised on it, so that a scene
/// does not pay for what it does not use.
struct TransportTraits {
    std::uint32_t transmittance = shared::kTransmittanceZero;  ///< one of shared::kTransmittance...
    /// The same of what surfaces do to light on its way from a light path to the camera, both components of
    /// which count: kTransmittanceIdentity if they pass the invisible one unchanged and nothing of the other.
    std::uint32_t cameraTransmittance = shared::kTransmittanceZero;
    bool secondColumn = false;  ///< some O or T has an entry 01 or 11
    bool invisibleScatters =
        false;  ///< some O has an entry in row 0: importance for invisible light scatters on
    bool visibleScatters = false;
    bool invisibleCrosses = false;  ///< some T has an entry in row 0
    bool visibleCrosses = false;
    bool oneReflectance = true;  ///< all materials share one O and T
    /// Scattering events that can contribute to a pixel: the scene's `bounces`, or fewer where the matrices
    /// end every path earlier (1 for `local` and `one-bounce`).
    std::uint32_t effectiveBounces = 0;
    bool limitedByBounces = false;  ///< more than `bounces` could contribute
};

TransportTraits analyseTransport(const Scene& scene);

/// Only materials that triangles refer to count: true at their indices.
std::vector<bool> usedMaterials(const Scene& scene);

/// The largest radiance that anything emits, of any channel and component; 0 if nothing does.
double brightestEmission(const Scene& scene);

}  // namespace duolux
