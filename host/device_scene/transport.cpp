#include "host/device_scene/transport.h"

#include <algorithm>
#include <cmath>

namespace duolux {

namespace {

bool any(const glm::vec3& v) {
    return v.x > 0.0f || v.y > 0.0f || v.z > 0.0f;
}

const ReflectanceMatrix kIdentity{glm::vec3(1.0f), glm::vec3(0.0f), glm::vec3(0.0f), glm::vec3(1.0f)};

/// The entries that are non-zero in any of the matrices: bit j of row i.
struct Pattern {
    unsigned row[2] = {0, 0};

    void add(const ReflectanceMatrix& m) {
        row[0] |= (any(m.m00) ? 1u : 0u) | (any(m.m01) ? 2u : 0u);
        row[1] |= (any(m.m10) ? 1u : 0u) | (any(m.m11) ? 2u : 0u);
    }
    /// The components that can carry importance after this matrix if the components `set` carry it before.
    unsigned after(unsigned set) const {
        return ((set & 1) != 0 ? row[0] : 0u) | ((set & 2) != 0 ? row[1] : 0u);
    }
};

}  // namespace

bool isPartial(const Scene& scene, const Material& material) {
    return material.alpha.mode != AlphaMode::kOpaque &&
           (material.alpha.value < 1.0f || hasTexture(material, MaterialInput::kAlpha) ||
            !scene.geometry.alphas.empty());
}

std::uint32_t lobesOf(const Material& material) {
    // An image can only make a number smaller.
    const bool allMetal = material.metallic >= 1.0f && !hasTexture(material, MaterialInput::kMetallic);
    const bool allGlass =
        material.transmission >= 1.0f && !hasTexture(material, MaterialInput::kTransmission);
    std::uint32_t lobes = 0;
    if (material.metallic > 0.0f) lobes |= shared::kLobeMetal;
    if (!allMetal) {
        if (material.transmission > 0.0f) lobes |= shared::kLobeGlass;
        if (!allGlass) lobes |= shared::kLobeDiffuse;
        if (!allGlass && material.specular > 0.0f) lobes |= shared::kLobeDielectric;
    }
    if (material.clearcoat > 0.0f) lobes |= shared::kLobeClearcoat;
    if (material.sheenColor != glm::vec3(0.0f)) lobes |= shared::kLobeSheen;
    if ((lobes & shared::kLobeGlass) != 0 && !material.thin && material.attenuationColor != glm::vec3(1.0f) &&
        std::isfinite(material.attenuationDistance))
        lobes |= shared::kLobeAttenuation;
    if (material.anisotropy > 0.0f && (lobes & ~shared::kLobeDiffuse) != 0) lobes |= shared::kLobeAnisotropic;
    return lobes;
}

TransportTraits analyseTransport(const Scene& scene) {
    const std::vector<bool> used = usedMaterials(scene);
    TransportTraits traits;
    Pattern opaque;
    Pattern transparent;
    bool identity = true;  // on the first column
    const Reflectance* first = nullptr;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        if (!used[i]) continue;
        const Reflectance& reflectance = scene.reflectanceOf(scene.materials[i]);
        if (first == nullptr) first = &reflectance;
        traits.oneReflectance = traits.oneReflectance && reflectance == *first;
        traits.lobes |= lobesOf(scene.materials[i]);
        opaque.add(reflectance.opaque);
        transparent.add(reflectance.transparent);
        traits.coverage = traits.coverage || isPartial(scene, scene.materials[i]);
        identity = identity && reflectance.transparent.m00 == glm::vec3(1.0f);
    }
    const bool onlyCoverage = traits.coverage && transparent.row[0] == 0 && transparent.row[1] == 0;
    if (traits.coverage && !onlyCoverage) transparent.add(kIdentity);
    traits.secondColumn =
        ((opaque.row[0] | opaque.row[1] | transparent.row[0] | transparent.row[1]) & 2) != 0;
    // Importance that has scattered is in the first column and stays there. The second one has importance
    // only between the camera and the first scattering, where T may have an entry 11, as partial surfaces do.
    const bool staysInFirstColumn = ((opaque.row[0] | opaque.row[1] | transparent.row[0]) & 2) == 0;
    if (onlyCoverage) transparent.add(kIdentity);
    traits.invisibleScatters = opaque.row[0] != 0;
    traits.visibleScatters = opaque.row[1] != 0;
    traits.invisibleCrosses = transparent.row[0] != 0;
    traits.visibleCrosses = transparent.row[1] != 0;
    if (onlyCoverage) {
        traits.transparency = shared::kTransparencyCoverage;
    } else if (!traits.invisibleCrosses && !traits.visibleCrosses) {
        traits.transparency = shared::kTransparencyZero;
    } else if (identity && staysInFirstColumn) {
        traits.transparency = shared::kTransparencyIdentity;
    } else {
        traits.transparency = shared::kTransparencyGeneral;
    }
    const bool blocksVisible = !traits.visibleCrosses;
    traits.cameraTransparency = traits.transparency == shared::kTransparencyIdentity && !blocksVisible
                                    ? shared::kTransparencyGeneral
                                    : traits.transparency;

    // Follows the components that can carry importance until none can. From both on, the set only shrinks.
    unsigned set = 3;
    for (;;) {
        const unsigned crossed = set | transparent.after(set);
        const unsigned scattered = opaque.after(crossed | transparent.after(crossed));
        if (scattered == 0) break;
        if (scattered == set) {
            traits.mostScatterings = TransportTraits::kUnlimited;
            break;
        }
        ++traits.mostScatterings;
        set = scattered;
    }
    return traits;
}

double brightestEmission(const Geometry& geometry, std::span<const SceneEmitter> emitters) {
    const Bounds bounds = boundsOf(geometry);
    const glm::dvec3 extent = glm::dvec3(bounds.upper) - glm::dvec3(bounds.lower);
    double brightest = 0.0;
    for (const SceneEmitter& emitter : emitters) {
        const glm::dvec3 e = glm::max(emitter.emission.invisible, emitter.emission.visible);
        const double largest = std::max({e.x, e.y, e.z});
        switch (emitter.kind) {
            case EmitterKind::kTriangle:
                brightest = std::max(brightest, largest);
                break;
            case EmitterKind::kPoint:
                brightest = std::max(brightest, largest / glm::dot(extent, extent));
                break;
        }
    }
    return brightest;
}

}  // namespace duolux
