#include "host/view/darkness.h"

#include <algorithm>
#include <map>
#include <vector>

#include "host/scene/emitters.h"
#include "host/view/frame_camera.h"
#include "host/view/look_through.h"

namespace duolux {

namespace {

constexpr float kFewest = 0.02f;  // fraction of the image
constexpr int kPathsPerWhite = 4;

bool any(const glm::vec3& v) {
    return v.x > 0.0f || v.y > 0.0f || v.z > 0.0f;
}

/// Metal or glass all over, which shows only what it reflects or refracts.
bool hasNoDiffusePart(const Material& material) {
    const bool varies =
        hasTexture(material, MaterialInput::kMetallic) || hasTexture(material, MaterialInput::kTransmission);
    return !varies && (material.metallic == 1.0f || material.transmission == 1.0f) &&
           material.sheenColor == glm::vec3(0.0f);
}

/// Inspects the surfaces that the camera sees and the emitters of the scene.
class Inspection {
  public:
    Inspection(const Scene& scene, const RenderSettings& settings)
        : scene_(scene),
          settings_(settings),
          emitters_(listEmitters(scene)),
          surface_(scene, scene.geometry.triangles.size()) {
        lookThrough(scene.camera, settings_.aspect(), surface_,
                    [&](const SurfacePoint& point, std::uint32_t) { seen_.push_back(point); });
    }

    DarkReason reason() const {
        DarkReason reason{Darkness::kUnknown, mostSeen(), filled(), automaticCamera()};
        reason.darkness = darkness();
        if (reason.darkness == Darkness::kFacingAway) reason.material = emitter();
        return reason;
    }

  private:
    float filled() const { return static_cast<float>(seen_.size()) / (kLooksAcross * kLooksAcross); }

    const Material& materialOf(const SurfacePoint& point) const {
        return surface_.materialOf(point.triangle);
    }

    bool emits(const SurfacePoint& point) const { return materialOf(point).emission.any(); }

    std::string mostSeen() const {
        std::map<std::string, int> counts;
        for (const SurfacePoint& point : seen_)
            ++counts[materialOf(point).name];
        const auto most = std::max_element(counts.begin(), counts.end(),
                                           [](const auto& a, const auto& b) { return a.second < b.second; });
        return most == counts.end() ? std::string() : most->first;
    }

    /// The material of the first emitting triangle.
    std::string emitter() const {
        for (const SceneEmitter& emitter : emitters_) {
            switch (emitter.kind) {
                case EmitterKind::kTriangle:
                    return scene_.materials[scene_.geometry.materials[emitter.index]].name;
                case EmitterKind::kPoint:
                    break;
            }
        }
        return {};
    }

    Camera automaticCamera() const {
        CameraChoice choice;
        choice.up = glm::dvec3(scene_.camera.up);
        // Of what the files hold, without a lamp that was added.
        const std::size_t content = scene_.content.triangles;
        const Surface surface(scene_, content > 0 ? content : scene_.geometry.triangles.size());
        const Illumination illumination(surface);
        const ViewSamples samples(surface, illumination);
        return frameCamera(choice, surface, samples, settings_.aspect());
    }

    /// Whether any surface can turn the emitted component into visible light.
    bool anythingBecomesVisible() const {
        bool invisible = false, visible = false, fromInvisible = false, fromVisible = false;
        for (const std::uint32_t index : scene_.geometry.materials) {
            const ReflectanceMatrix& opaque = scene_.reflectanceOf(scene_.materials[index]).opaque;
            fromInvisible = fromInvisible || any(opaque.m10);
            fromVisible = fromVisible || any(opaque.m11);
        }
        for (const SceneEmitter& emitter : emitters_) {
            invisible = invisible || any(emitter.emission.invisible);
            visible = visible || any(emitter.emission.visible);
        }
        return (invisible && fromInvisible) || (visible && fromVisible);
    }

    template <typename Test>
    bool nearlyAll(const Test& test) const {
        const auto count = std::count_if(seen_.begin(), seen_.end(), test);
        return static_cast<float>(count) >= 0.95f * static_cast<float>(seen_.size());
    }

    /// Mean radiance that white surfaces would reflect at the points that the camera sees, or on the other
    /// side of the same surfaces.
    float onWhite(const Illumination& illumination, bool otherSide) const {
        float sum = 0.0f;
        for (std::size_t i = 0; i < seen_.size(); ++i) {
            SurfacePoint point = seen_[i];
            if (otherSide) point = {point.position, -point.normal, point.triangle, !point.front};
            sum += illumination.onWhite(point, static_cast<std::uint32_t>(i + 1), kPathsPerWhite);
        }
        return sum / static_cast<float>(seen_.size());
    }

    Darkness darkness() const {
        if (emitters_.empty()) return Darkness::kNothingEmits;
        if (filled() < kFewest) return Darkness::kLooksPast;
        if (nearlyAll([&](const SurfacePoint& point) { return emits(point); }))
            return Darkness::kOnlyEmitters;
        if (settings_.bounces == 0) return Darkness::kNoBounces;
        if (!anythingBecomesVisible()) return Darkness::kNothingVisible;
        const auto dead = [&](const SurfacePoint& point) {
            return !scatters(materialOf(point), point.front);
        };
        if (nearlyAll(dead)) {
            const auto black = [&](const SurfacePoint& point) { return !scatters(materialOf(point), true); };
            return nearlyAll(black) ? Darkness::kBlackSurfaces : Darkness::kBehind;
        }
        const Illumination illumination(surface_), bothSides(surface_, std::nullopt, true);
        const float here = onWhite(illumination, false);
        const float there = onWhite(illumination, true), turned = onWhite(bothSides, false);
        // The other side must be this many times brighter; smaller ratios may be light leaks and noise.
        constexpr float kMuchMore = 20.0f;
        if (turned > kMuchMore * here && turned >= there) return Darkness::kFacingAway;
        if (there > kMuchMore * here) return Darkness::kBehind;
        if (!(here > 0.0f)) return Darkness::kEnclosed;
        const auto mirror = [&](const SurfacePoint& point) { return hasNoDiffusePart(materialOf(point)); };
        return nearlyAll(mirror) ? Darkness::kMirrors : Darkness::kUnknown;
    }

    const Scene& scene_;
    const RenderSettings& settings_;
    std::vector<SceneEmitter> emitters_;
    Surface surface_;
    std::vector<SurfacePoint> seen_;
};

}  // namespace

DarkReason whyDark(const Scene& scene, const RenderSettings& settings) {
    return Inspection(scene, settings).reason();
}

}  // namespace duolux
