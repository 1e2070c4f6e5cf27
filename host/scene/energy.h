#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host/scene/scene.h"

namespace duolux {

/// What one interaction with a material does to light, F = rho O + T with the albedo rho, by channel.
struct MaterialEnergy {
    /// Spectral radius of rho O + T: the factor by which light that keeps meeting this material grows or
    /// fades.
    glm::vec3 factor;
    /// Light may scatter (by O) any number of times. Without that every series ends, whatever the factor:
    /// straight crossings alone lead out of the scene.
    bool recurs = false;

    /// The infinite series of bounces may have no sum.
    bool mayGrow() const;

    /// The terms of the series may become larger and larger.
    bool grows() const;
};

MaterialEnergy materialEnergy(const Reflectance& reflectance, const glm::vec3& albedo);

/// The emitting triangles of a scene, all together.
struct EmitterSummary {
    std::size_t triangles = 0;
    double area = 0.0;               ///< in scene units squared
    glm::dvec3 invisiblePower{0.0};  ///< W in scene units: pi A E, twice that for both sides
    glm::dvec3 visiblePower{0.0};
};
EmitterSummary summariseEmitters(const Scene& scene);

/// Some surface scatters: its albedo and its matrix O are not all 0. Without one a lamp would light nothing.
bool anySurfaceScatters(const Scene& scene);

/// Some surface may make the terms of the series of bounces larger and larger.
bool seriesMayGrow(const Scene& scene);

/// Mean albedo over the area of all triangles.
glm::dvec3 meanAlbedo(const Scene& scene);

}  // namespace duolux
