#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <numbers>
#include <span>
#include <vector>

#include "host/albedo/albedo_tables.h"
#include "shaders/shared/albedo_layout.h"
#include "shaders/shared/material_layout.h"
#include "tests/shader/inputs.h"
#include "tests/shader/mirror_types.h"
#include "tests/shader/oracles.h"

// Surfaces for tests of BSDFs, and integrals of the device's functions over directions.

namespace duolux::test {

using mirror::single::Bsdf;
using mirror::single::BsdfFrame;
using mirror::single::BsdfSample;

inline constexpr std::uint32_t kRadiance = 0, kImportance = 1;
inline constexpr std::uint32_t kThin = 1, kOutside = 2;  // kBsdf... of bsdf_types.glsl

inline ShaderLibrary bsdfLibrary(std::uint32_t lobes) {
    static const std::vector<glm::uvec4> tables = [] {
        std::vector<glm::uvec4> texels(shared::kAlbedoTexels);
        std::memcpy(texels.data(), albedoTables().data(), albedoTables().size_bytes());
        mirror::texels().albedo = texels;
        return texels;
    }();
    ShaderLibrary library("shaders/lib/bsdf.glsl");
    library.texels("fetchAlbedoTexel", std::span(tables)).constant(shared::kSpecLobes, lobes);
    return library;
}

inline const ShaderLibrary& bsdf() {
    static const ShaderLibrary library = bsdfLibrary(shared::kAllLobes);
    return library;
}

/// The library compiled for scenes that only have diffuse surfaces.
inline const ShaderLibrary& diffuseOnly() {
    static const ShaderLibrary library = bsdfLibrary(shared::kLobeDiffuse);
    return library;
}

/// The normal is z, so directions are in the local frame.
inline const BsdfFrame kFlat{{0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 1.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};

inline BsdfFrame frameWith(const glm::vec3& shading, const glm::vec3& geometric) {
    const glm::vec3 across =
        std::abs(shading.x) < 0.9f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
    return {shading, geometric, glm::normalize(glm::cross(shading, across)), shading};
}

inline const std::vector<glm::vec3> kOutgoing{{0.0f, 0.0f, 1.0f},
                                              {0.6f, 0.0f, 0.8f},
                                              {0.0f, -0.8f, 0.6f},
                                              {0.48f, 0.64f, 0.6f},
                                              {0.98f, 0.0f, 0.198997f}};

/// White and diffuse, seen from outside.
inline Bsdf whiteDiffuse() {
    Bsdf b{};
    b.baseColor = glm::vec3(1.0f);
    b.roughness = 0.5f;
    b.eta = 1.5f;
    b.flags = kOutside;
    return b;
}

inline Bsdf rough(Bsdf b, float roughness) {
    b.roughness = roughness;
    b.alpha = glm::vec2(roughness * roughness);
    return b;
}

inline Bsdf metal(float metallic, float roughness, const glm::vec3& color = glm::vec3(1.0f)) {
    Bsdf b = rough(whiteDiffuse(), roughness);
    b.metallic = metallic;
    b.baseColor = color;
    return b;
}

/// Diffuse under the reflection of a dielectric.
inline Bsdf dielectric(float ior, float roughness, const glm::vec3& color = glm::vec3(1.0f)) {
    Bsdf b = rough(whiteDiffuse(), roughness);
    const float root = (ior - 1.0f) / (ior + 1.0f);
    b.f0 = glm::vec3(root * root);
    b.specular = 1.0f;
    b.eta = ior;
    b.baseColor = color;
    return b;
}

/// `eta` < 1: seen from inside.
inline Bsdf glass(float eta, float roughness, bool thin = false) {
    Bsdf b = dielectric(std::max(eta, 1.0f / eta), roughness);
    b.transmission = 1.0f;
    b.eta = eta;
    b.flags = (thin ? kThin : 0u) | (eta > 1.0f ? kOutside : 0u);
    return b;
}

inline Bsdf clearcoat(Bsdf b, float amount, float roughness) {
    b.clearcoat = amount;
    b.clearcoatRoughness = roughness;
    return b;
}

inline Bsdf sheen(Bsdf b, float amount, float roughness) {
    b.sheenColor = glm::vec3(amount);
    b.sheenRoughness = roughness;
    return b;
}

/// As KHR_materials_anisotropy stretches alpha along the tangent.
inline Bsdf anisotropic(Bsdf b, float strength) {
    b.alpha.x = glm::mix(b.alpha.y, 1.0f, strength * strength);
    return b;
}

/// Midpoints of 512 x 512 cells of (z, phi) over the sphere; each cell has the solid angle 4 pi / 512^2.
inline std::vector<glm::vec3> sphere() {
    std::vector<glm::vec3> directions;
    for (const glm::dvec2 u : unitSquare(512)) {
        const double z = 2.0 * u.x - 1.0;
        const double r = std::sqrt(1.0 - z * z);
        directions.emplace_back(r * std::cos(2.0 * std::numbers::pi * u.y),
                                r * std::sin(2.0 * std::numbers::pi * u.y), z);
    }
    return directions;
}

/// Integrals over the sphere: f |cos| in xyz, the density in w.
inline glm::dvec4 integrals(const ShaderLibrary& library, const Bsdf& b, const glm::vec3& wo,
                            std::uint32_t mode = kRadiance, const BsdfFrame& frame = kFlat) {
    static const std::vector<glm::vec3> directions = sphere();
    glm::dvec4 sum(0.0);
    for (const glm::vec4& v :
         library.evaluate<glm::vec4>("result = vec4(bsdfEvaluate(x0, x1, x2, x3, x4) * bsdfCosine(x1, x3, "
                                     "x4), bsdfPdf(x0, x1, x2, x3, x4));",
                                     b, frame, wo, directions, mode))
        sum += glm::dvec4(v);
    return sum * (4.0 * std::numbers::pi / static_cast<double>(directions.size()));
}

}  // namespace duolux::test
