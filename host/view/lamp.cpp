#include "host/view/lamp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/gtc/constants.hpp>
#include <optional>

#include "host/scene/compose.h"
#include "host/view/look_through.h"
#include "host/view/view_axes.h"

namespace duolux {

namespace {

/// A place for the lamp, in the coordinates of the scene.
struct Place {
    glm::vec3 centre;
    Rectangle rectangle;
};

Place placeOf(const glm::vec3& centre, float side, const glm::vec3& lit, const glm::vec3& up) {
    const glm::vec3 towards = glm::normalize(lit - centre);
    // Perpendicular to the direction of the light, even if this is parallel to `up`.
    glm::vec3 across = glm::cross(up, towards);
    if (glm::length(across) < 1e-3f) across = glm::cross(glm::vec3(up.y, up.z, up.x), towards);
    const glm::vec3 edge1 = side * glm::normalize(across);
    const glm::vec3 edge2 = side * glm::normalize(glm::cross(towards, edge1));
    return {centre, {centre - 0.5f * (edge1 + edge2), edge1, edge2}};
}

/// Whether nothing is between the camera and the centre and corners of the rectangle.
bool isFree(const Surface& surface, const glm::vec3& camera, const Place& place) {
    const auto& [origin, edge1, edge2] = place.rectangle;
    const glm::vec3 from = surface.toLocal(glm::dvec3(camera));
    const std::array<glm::vec3, 5> points{place.centre, origin, origin + edge1, origin + edge2,
                                          origin + edge1 + edge2};
    return std::all_of(points.begin(), points.end(), [&](const glm::vec3& point) {
        return surface.sees(from, surface.toLocal(glm::dvec3(point)));
    });
}

/// A place above, beside and behind the camera, far enough behind that no corner is in view for any angle of
/// view. Of several places, the first that lights about as much of the visible surface as the best one. Empty
/// if walls block all of them.
std::optional<Place> openPlace(const Surface& surface, const Camera& camera, float aspect, float distance,
                               const glm::vec3& lit) {
    constexpr std::array<glm::vec2, 4> kAsides{{{0.3f, 0.8f}, {-0.3f, 0.8f}, {0.8f, 0.1f}, {0.3f, -0.8f}}};
    const ViewFrame frame(camera);
    std::array<Place, kAsides.size()> places{};
    std::array<float, kAsides.size()> cosines{};
    for (std::size_t i = 0; i < kAsides.size(); ++i) {
        const glm::vec3 offset = kAsides[i].x * frame.right + kAsides[i].y * frame.up - 0.25f * frame.forward;
        places[i] = placeOf(camera.position + distance * offset, 0.4f * distance, lit, frame.up);
    }
    lookThrough(camera, aspect, surface, [&](const SurfacePoint& point, std::uint32_t) {
        for (std::size_t i = 0; i < places.size(); ++i) {
            const glm::vec3 lamp = surface.toLocal(glm::dvec3(places[i].centre));
            const float cosine = glm::dot(point.normal, glm::normalize(lamp - point.position));
            if (cosine > 0.0f && surface.sees(point.position + kOffset * point.normal, lamp, point.triangle))
                cosines[i] += cosine;
        }
    });
    const float most = *std::max_element(cosines.begin(), cosines.end());
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (cosines[i] >= 0.6f * most && isFree(surface, camera.position, places[i])) return places[i];
    }
    return std::nullopt;
}

/// Whether all corners are beyond one of the planes that bound the view.
bool isOutOfView(const Place& place, const Camera& camera, float aspect) {
    constexpr float kViewMargin = 1.1f;
    const ViewFrame frame(camera);
    const ImagePlane plane = imagePlane(camera, static_cast<double>(aspect));
    const float halfWidth = kViewMargin * glm::length(plane.right);
    const float halfHeight = kViewMargin * glm::length(plane.up);
    const auto& [origin, edge1, edge2] = place.rectangle;
    bool behind = true, above = true, below = true, left = true, right = true;
    for (const glm::vec3& corner : {origin, origin + edge1, origin + edge2, origin + edge1 + edge2}) {
        const glm::vec3 offset = corner - camera.position;
        const float depth = glm::dot(offset, frame.forward);
        const float x = glm::dot(offset, frame.right), y = glm::dot(offset, frame.up);
        behind = behind && depth < 0.0f;
        const float widening = hasParallelRays(camera.type) ? 1.0f : depth;
        above = above && y > halfHeight * widening;
        below = below && -y > halfHeight * widening;
        right = right && x > halfWidth * widening;
        left = left && -x > halfWidth * widening;
    }
    return behind || above || below || left || right;
}

/// The place with the most clearance around the camera that is out of view: walls close to a lamp would be
/// too bright.
Place enclosedPlace(const Surface& surface, const Camera& camera, float aspect, float distance,
                    const glm::vec3& lit) {
    constexpr int kCandidateRays = 96, kClearanceRays = 32;
    const ViewFrame frame(camera);
    const glm::vec3 eye = surface.toLocal(glm::dvec3(camera.position));
    const glm::vec3 aim = surface.toLocal(glm::dvec3(lit));
    const auto clearance = [&](const glm::vec3& point) {
        float least = 1.0f;
        for (int k = 0; k < kClearanceRays; ++k) {
            if (const auto hit = surface.firstHit(point, onSphere(k, kClearanceRays)))
                least = std::min(least, hit->distance);
        }
        return least;
    };
    // The fallback is a tiny lamp just behind the camera.
    Place best = placeOf(camera.position - 1e-3f * distance * frame.forward, 1e-3f * distance, lit, frame.up);
    float most = 0.0f;
    for (int i = 0; i < kCandidateRays; ++i) {
        const glm::vec3 direction = onSphere(i, kCandidateRays);
        const auto hit = surface.firstHit(eye, direction);
        const float way = hit ? hit->distance : 1.0f;
        for (const float part : {0.3f, 0.5f, 0.7f}) {
            const glm::vec3 point = eye + part * way * direction;
            // Places above the camera are preferred.
            const float room = clearance(point) * (glm::dot(direction, frame.up) > 0.0f ? 1.0f : 0.5f);
            if (room <= most || glm::distance(point, aim) < 1e-4f || !surface.sees(point, aim)) continue;
            const auto side =
                static_cast<float>(static_cast<double>(0.8f * std::min(room, 0.5f)) / surface.scale());
            const Place place = placeOf(glm::vec3(surface.toScene(point)), side, lit, frame.up);
            if (!isOutOfView(place, camera, aspect)) continue;
            best = place;
            most = room;
        }
    }
    return best;
}

/// Scales the emission of the lamp (the last triangles of the scene) so that the mean radiance of white
/// surfaces in view is `wanted`.
void calibrate(LoadedScene& scene, std::size_t firstTriangle, float wanted) {
    if (scene.geometry.triangles.size() == firstTriangle) return;
    const std::uint32_t material = scene.geometry.materials.back();
    const Surface surface(scene, firstTriangle);
    const Illumination illumination(surface, material);
    double sum = 0.0, count = 0.0;
    lookThrough(scene.camera, scene.settings.aspect(), surface,
                [&](const SurfacePoint& point, std::uint32_t seed) {
                    if (!scatters(surface.materialOf(point.triangle), point.front)) return;
                    constexpr float kMost = 4.0f;  // limits the unbounded values close to the lamp
                    sum += static_cast<double>(std::min(illumination.onWhite(point, seed, 2), kMost));
                    count += 1.0;
                });
    if (!(sum > 0.0)) return;
    scene.materials[material].emission.invisible *=
        static_cast<float>(static_cast<double>(wanted) * count / sum);
}

}  // namespace

float brightnessFor(const Camera& camera, float aspect, const Surface& surface,
                    const Illumination& illumination, const ViewSamples& samples) {
    double sum = 0.0, count = 0.0;
    lookThrough(camera, aspect, surface, [&](const SurfacePoint& point, std::uint32_t seed) {
        const bool reflects = scatters(surface.materialOf(point.triangle), point.front);
        const float white = reflects ? illumination.onWhite(point, seed, 2) : 0.0f;
        sum += static_cast<double>(std::min(1.0f, white + illumination.emitted(point)));
        count += 1.0;
    });
    const float seen = count > 0.0 ? static_cast<float>(sum / count) : 0.0f;
    return std::max(seen, samples.brightness());
}

void addLamp(LoadedScene& scene, const Surface& surface) {
    const glm::vec3 lower(surface.bulk().lower), upper(surface.bulk().upper);
    const Camera& camera = scene.camera;
    const glm::vec3 forward = ViewFrame(camera).forward;

    // The lamp lights the middle of the scene, or the target if the camera is inside the scene.
    const bool inside =
        glm::all(glm::greaterThan(camera.position, lower)) && glm::all(glm::lessThan(camera.position, upper));
    const float ahead = glm::dot(0.5f * (lower + upper) - camera.position, forward);
    const float distance = inside || ahead <= 0.0f ? glm::distance(camera.target, camera.position) : ahead;
    const glm::vec3 lit = camera.position + distance * forward;

    std::optional<Place> place = openPlace(surface, camera, scene.settings.aspect(), distance, lit);
    const bool enclosed = !place;
    if (enclosed) place = enclosedPlace(surface, camera, scene.settings.aspect(), distance, lit);

    // A small Lambertian source on the axis gives the irradiance E_inv A / r^2; white reflects irradiance /
    // pi.
    constexpr float kWhite = 0.8f;
    const float squaredDistance = glm::dot(lit - place->centre, lit - place->centre);
    const float area = glm::length(glm::cross(place->rectangle.edge1, place->rectangle.edge2));
    Material material;
    material.name = "default light";
    material.baseColor = glm::vec3(0.0f);
    material.emission.invisible = glm::vec3(kWhite * glm::pi<float>() * squaredDistance / area);
    const std::size_t first = scene.geometry.triangles.size();
    appendRectangle(scene, place->rectangle, material);
    if (enclosed) calibrate(scene, first, 0.5f * kWhite);
}

}  // namespace duolux
