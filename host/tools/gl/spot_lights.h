#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string_view>
#include <vector>

#include "host/scene/scene.h"

namespace duolux {

/// A spot light of Warn's model with exponent 1 (paper, eq. for I(x)): in direction w it has the intensity
/// intensity * max(dot(direction, w), 0).
struct SpotLight {
    glm::vec3 position;
    glm::vec3 direction;  ///< unit
    glm::vec3 intensity;  ///< along the direction, W sr^-1 in scene units, of invisible light
};

/// How each luminaire is divided.
struct Tiling {
    std::uint32_t rows = 3, columns = 3;
    bool cornersAndCentre =
        false;  ///< of the 3 x 3 tiles only these five, each standing for a fifth of the whole

    /// "5" or "NxM". Throws UsageError.
    static Tiling parse(std::string_view text);
};

/// Spot lights in place of the luminaires, one at the centre of each tile.
///
/// A luminaire of radiance L and area A is a sum of tiles of area A/n. Seen from x, at distance r along the
/// unit vector w from its centre, a tile small against r gives x the irradiance L (A/n) dot(direction, w)
/// cos_x / r^2: that of a spot light of intensity I = L A/n along its direction, falling off by Warn's
/// exponent e = 1 and by 1/r^2. A diffuse surface of albedo rho turns it into the radiance rho/pi times that.
/// OpenGL computes (material)(light) spot att (N.l) with att = 1/(a2 r^2); with material = rho this is the
/// same if light = I a2 / pi, whatever a2 is. In the limit of many tiles the sum is the integral over the
/// luminaire, for which Lambert's polygon formula is exact.
///
/// Luminaires must be parallelograms: pairs of adjacent triangles with one material. One that emits on both
/// sides becomes two lights a tile. Throws InputError naming the material otherwise, or if nothing emits
/// invisible light.
std::vector<SpotLight> spotLights(const Scene& scene, const Tiling& tiling);

/// The coarseness of the scene's triangles for lighting at their corners: the largest ratio of an edge to the
/// distance of a light that illuminates its triangle.
float coarseness(const Scene& scene, const std::vector<SpotLight>& lights);

}  // namespace duolux
