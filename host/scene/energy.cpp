#include "host/scene/energy.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "host/scene/emitters.h"

namespace duolux {

namespace {

/// The larger eigenvalue of a non-negative 2x2 matrix; real, because the product of the off-diagonal entries
/// is not negative.
float spectralRadius(float m00, float m01, float m10, float m11) {
    const float difference = m00 - m11;
    return 0.5f * (m00 + m11 + std::sqrt(difference * difference + 4.0f * m01 * m10));
}

/// The mean over the hemisphere of Schlick's Fresnel reflectance.
glm::vec3 meanReflectance(const glm::vec3& f0, float f90) {
    return f0 + (f90 - f0) / 21.0f;
}

/// What is under a layer that reflects some light and lets the rest pass. Exactly white if that is.
glm::vec3 under(const glm::vec3& reflected, const glm::vec3& albedo) {
    return albedo + (1.0f - albedo) * reflected;
}

/// The mean over the hemisphere of the albedo of sheen of colour 1, at most 1 in every direction: a fit to
/// sheenAlbedo of host/albedo within 0.002.
float meanSheen(float roughness) {
    const float r = std::max(roughness, 0.2f);
    return 0.0451f + (r - 0.2f) * (0.2147f + (r - 0.2f) * (0.525f - 0.4933f * (r - 0.2f)));
}

}  // namespace

glm::vec3 meanAlbedo(const Material& material) {
    const glm::vec3& base = material.baseColor;
    const float root = (material.ior - 1.0f) / (material.ior + 1.0f);
    const glm::vec3 f0 = glm::min(material.specularColor * (root * root), 1.0f) * material.specular;
    const glm::vec3 diffuse = under(meanReflectance(f0, material.specular), base);
    const glm::vec3 glass = under(meanReflectance(glm::vec3(root * root), 1.0f), base);
    const glm::vec3 dielectric = diffuse + (glass - diffuse) * material.transmission;
    const glm::vec3 metal = meanReflectance(base, 1.0f);
    glm::vec3 albedo = dielectric + (metal - dielectric) * material.metallic;
    if (material.clearcoat > 0.0f)
        albedo = under(material.clearcoat * meanReflectance(glm::vec3(0.04f), 1.0f), albedo);
    const glm::vec3 sheen = material.sheenColor * meanSheen(material.sheenRoughness);
    return albedo + (sheen - albedo * std::max({sheen.x, sheen.y, sheen.z}));
}

bool MaterialEnergy::mayGrow() const {
    return recurs && glm::any(glm::greaterThanEqual(factor, glm::vec3(1.0f)));
}

bool MaterialEnergy::grows() const {
    return recurs && glm::any(glm::greaterThan(factor, glm::vec3(1.0f)));
}

MaterialEnergy materialEnergy(const Reflectance& reflectance, const glm::vec3& albedo) {
    MaterialEnergy energy;
    const ReflectanceMatrix& o = reflectance.opaque;
    const ReflectanceMatrix& t = reflectance.transparent;
    for (int i = 0; i < 3; ++i) {
        const float o00 = albedo[i] * o.m00[i], o01 = albedo[i] * o.m01[i];
        const float o10 = albedo[i] * o.m10[i], o11 = albedo[i] * o.m11[i];
        const float m01 = o01 + t.m01[i], m10 = o10 + t.m10[i];
        energy.factor[i] = spectralRadius(o00 + t.m00[i], m01, m10, o11 + t.m11[i]);
        // Scattering can recur if it lies on a cycle of the two components.
        energy.recurs = energy.recurs || o00 > 0.0f || o11 > 0.0f || o01 * m10 > 0.0f || o10 * m01 > 0.0f;
    }
    return energy;
}

EmitterSummary summariseEmitters(const Scene& scene) {
    EmitterSummary summary;
    for (const SceneEmitter& emitter : listEmitters(scene)) {
        const Emission& emission = emitter.emission;
        double factor = 0.0;  // of the power over the emission
        switch (emitter.kind) {
            case EmitterKind::kTriangle:
                ++summary.triangles;
                summary.area += emitter.area;
                factor = (emission.sides == Sides::kBoth ? 2.0 : 1.0) * glm::pi<double>() * emitter.area;
                break;
            case EmitterKind::kPoint:
                ++summary.points;
                factor = 4.0 * glm::pi<double>();
                break;
        }
        summary.invisiblePower += factor * glm::dvec3(emission.invisible);
        summary.visiblePower += factor * glm::dvec3(emission.visible);
    }
    return summary;
}

bool anySurfaceScatters(const Scene& scene) {
    return std::ranges::any_of(scene.geometry.materials, [&](std::uint32_t index) {
        const Material& material = scene.materials[index];
        const ReflectanceMatrix& o = scene.reflectanceOf(material).opaque;
        const glm::vec3 scattered = meanAlbedo(material) * (o.m00 + o.m01 + o.m10 + o.m11);
        return glm::any(glm::greaterThan(scattered, glm::vec3(0.0f)));
    });
}

bool seriesMayGrow(const Scene& scene) {
    const std::vector<bool> used = usedMaterials(scene);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        if (used[i] && materialEnergy(scene.reflectanceOf(material), meanAlbedo(material)).grows())
            return true;
    }
    return false;
}

glm::vec3 vertexColourOf(const Geometry& geometry, std::size_t triangle) {
    if (geometry.colours.empty()) return glm::vec3(1.0f);
    const glm::uvec3& corners = geometry.triangles[triangle];
    return (geometry.colours[corners.x] + geometry.colours[corners.y] + geometry.colours[corners.z]) / 3.0f;
}

glm::dvec3 meanAlbedo(const Scene& scene) {
    glm::dvec3 sum(0.0);
    double totalArea = 0.0;
    const Geometry& geometry = scene.geometry;
    for (std::size_t i = 0; i < geometry.triangles.size(); ++i) {
        const double area = areaOf(geometry, i);
        const Material& material = scene.materials[geometry.materials[i]];
        sum += area * glm::dvec3(meanAlbedo(material) * vertexColourOf(geometry, i));
        totalArea += area;
    }
    return sum / totalArea;
}

}  // namespace duolux
