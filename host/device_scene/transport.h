#pragma once

#include <cstdint>
#include <span>

#include "host/scene/emitters.h"
#include "host/scene/scene.h"
#include "shaders/shared/path_tracer_layout.h"

namespace duolux {

/// Properties of the matrices and the BSDFs of a scene's materials. Kernels are specialised for them, so that
/// a scene does not pay for features it does not use.
struct TransportTraits {
    std::uint32_t transparency = shared::kTransparencyZero;  ///< one of shared::kTransparency...
    /// The same for connections from light paths to the camera, where both components count:
    /// kTransparencyIdentity if surfaces transmit the invisible component unchanged and block the visible
    /// one.
    std::uint32_t cameraTransparency = shared::kTransparencyZero;
    bool secondColumn = false;  ///< some O or T has an entry 01 or 11
    bool invisibleScatters =
        false;  ///< some O has an entry in row 0: importance for invisible light scatters
    bool visibleScatters = false;
    bool invisibleCrosses = false;  ///< some T has an entry in row 0
    bool visibleCrosses = false;
    bool oneReflectance = true;  ///< all materials share one O and T
    bool coverage = false;       ///< surfaces may be there only in part (isPartial)
    std::uint32_t lobes = 0;     ///< sum of shared::kLobe...: what the BSDFs consist of
    /// The largest number of scattering events after which a path can still contribute to a pixel (1 for
    /// `local` and `one-bounce`), or kUnlimited.
    std::uint32_t mostScatterings = 0;
    static constexpr std::uint32_t kUnlimited = 0xffffffffu;
};

/// Materials that no triangle refers to do not count.
TransportTraits analyseTransport(const Scene& scene);

/// Whether a surface of the material may be there only in part: light passes unchanged through the rest.
bool isPartial(const Scene& scene, const Material& material);

/// Sum of shared::kLobe...
std::uint32_t lobesOf(const Material& material);

/// The largest emitted radiance over all emitters of a scene with this geometry, channels and components; of
/// point emitters the irradiance at a distance of the scene's extent. 0 if nothing emits.
double brightestEmission(const Geometry& geometry, std::span<const SceneEmitter> emitters);

}  // namespace duolux
