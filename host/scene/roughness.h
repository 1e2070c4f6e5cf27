#pragma once

#include <cmath>

namespace duolux {

/// The roughness whose GGX lobe has the width of Phong's with exponent n >= 0: alpha = sqrt(2 / (n + 2))
/// (Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", section 5.2), roughness =
/// sqrt(alpha).
inline double roughnessOfExponent(double exponent) {
    return std::pow(2.0 / (exponent + 2.0), 0.25);
}

}  // namespace duolux
