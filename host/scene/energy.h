#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host/scene/scene.h"

namespace duolux {

/// Properties of one interaction with a material, F = rho O + T with the albedo rho, per channel.
struct MaterialEnergy {
    /// Spectral radius of rho O + T: the asymptotic factor per interaction if light only meets this material.
    glm::vec3 factor;
    /// Whether light may scatter (by O) any number of times. If not, every series is finite, whatever the
    /// factor: straight crossings alone lead out of the scene.
    bool recurs = false;

    /// Whether the infinite series of bounces may diverge.
    bool mayGrow() const;

    /// Whether the terms of the series may grow.
    bool grows() const;
};

/// The fraction of uniform light that f_opaque scatters to either side, per channel, without images and
/// without what glass absorbs inside. Exact for surfaces that scatter all or nothing; of others approximate,
/// by the means over the hemisphere of smooth layers' reflectances.
glm::vec3 meanAlbedo(const Material& material);

/// `albedo`: meanAlbedo(material), which colours of vertices and images can only make smaller.
MaterialEnergy materialEnergy(const Reflectance& reflectance, const glm::vec3& albedo);

/// Totals over the emitters of a scene.
struct EmitterSummary {
    std::size_t points = 0;
    std::size_t triangles = 0;
    double area = 0.0;  ///< of the triangles, in scene units squared
    /// W in scene units: pi A E, or 2 pi A E for both sides; 4 pi I of points.
    glm::dvec3 invisiblePower{0.0};
    glm::dvec3 visiblePower{0.0};
};
EmitterSummary summariseEmitters(const Scene& scene);

/// Whether some surface scatters, with a non-zero albedo and matrix O. Otherwise a lamp would light nothing.
bool anySurfaceScatters(const Scene& scene);

/// Whether some surface may make the terms of the series of bounces grow.
bool seriesMayGrow(const Scene& scene);

/// The mean colour of the vertices of a triangle; 1 if they have none.
glm::vec3 vertexColourOf(const Geometry& geometry, std::size_t triangle);

/// The area-weighted mean albedo of all triangles.
glm::dvec3 meanAlbedo(const Scene& scene);

}  // namespace duolux
