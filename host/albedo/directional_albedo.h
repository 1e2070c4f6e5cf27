#pragma once

namespace duolux {

/// Fractions of the light from a direction that surfaces scatter, by numerical integration in double
/// precision. `cosine`: between the direction and the normal, (0, 1]; `roughness`: 0..1, the square root of
/// GGX's alpha.

/// GGX reflection by single scattering (shaders/lib/bsdf/microfacet.glsl) with Schlick's Fresnel reflectance
/// f0 + (f90 - f0) (1 - cos)^5: f0 * atNormal + f90 * atGrazing.
struct ReflectionAlbedo {
    double atNormal, atGrazing;
};
ReflectionAlbedo reflectionAlbedo(double cosine, double roughness);

/// The same of microfacets that are stretched along the tangent: the alphas are (mix(roughness^2, 1,
/// anisotropy^2), roughness^2). `azimuth`: |cos| of the direction's azimuth to the tangent; `anisotropy`:
/// 0..1.
ReflectionAlbedo stretchedAlbedo(double cosine, double azimuth, double roughness, double anisotropy);

/// GGX reflection and refraction of a dielectric by single scattering. `eta`: index of refraction of the
/// other side relative to that of the direction, > 0.
double glassAlbedo(double cosine, double roughness, double eta);

/// Sheen (shaders/lib/bsdf/sheen.glsl) of colour 1.
double sheenAlbedo(double cosine, double roughness);

}  // namespace duolux
