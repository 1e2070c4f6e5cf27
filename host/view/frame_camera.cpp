#include "host/view/frame_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "host/base/parallel.h"
#include "host/scene/image_plane.h"
#include "host/view/hollows.h"
#include "host/view/inside_views.h"
#include "host/view/view_axes.h"

namespace duolux {

namespace {

constexpr float kDefaultVfov = 40.0f;
constexpr double kMargin = 1.05;

/// Points that are all in view only if everything framed is: all corners, or the outermost ones in many
/// directions.
std::vector<glm::dvec3> cornersOf(const Surface& surface) {
    std::vector<glm::dvec3> corners;
    for (const Surface::Triangle& t : surface.triangles()) {
        if (!t.framed) continue;
        for (const glm::vec3& corner : {t.corner, t.corner + t.edge1, t.corner + t.edge2})
            corners.emplace_back(corner);
    }
    return corners;
}

std::vector<glm::dvec3> outermost(const std::vector<glm::dvec3>& points) {
    constexpr int kDirections = 64;
    std::vector<glm::dvec3> outer(kDirections);
    parallelFor(kDirections, 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const glm::dvec3 direction(onSphere(static_cast<int>(i), kDirections));
            outer[i] = *std::max_element(points.begin(), points.end(),
                                         [&](const glm::dvec3& a, const glm::dvec3& b) {
                                             return glm::dot(a, direction) < glm::dot(b, direction);
                                         });
        }
    });
    return outer;
}

/// An orthographic camera shows the same area as the perspective camera at its target, unless its height is
/// given.
Camera asChosen(Camera camera, const CameraChoice& choice) {
    camera.type = choice.type.value_or(CameraType::kPerspective);
    switch (camera.type) {
        case CameraType::kPerspective:
            break;
        case CameraType::kOrthographic: {
            const float distance = glm::distance(camera.position, camera.target);
            camera.height =
                choice.height.value_or(2.0f * distance * std::tan(0.5f * glm::radians(camera.vfov)));
            break;
        }
    }
    return camera;
}

class Framer {
  public:
    Framer(const CameraChoice& choice, const Surface& surface, const ViewSamples& samples, float aspect)
        : choice_(choice),
          surface_(surface),
          samples_(samples),
          aspect_(aspect),
          axes_(choice.up.value_or(choice.upwards)),
          corners_(cornersOf(surface)),
          outermost_(outermost(corners_)) {
        glm::dvec3 lower(1e300), upper(-1e300);
        for (const glm::dvec3& corner : corners_) {
            lower = glm::min(lower, corner);
            upper = glm::max(upper, corner);
        }
        radius_ = 0.5 * glm::distance(lower, upper);
        if (choice.target) target_ = surface.toLocal(*choice.target);
    }

    Camera frame() const {
        if (choice_.position) return fromPosition();
        const View outside = bestOutside();
        if (!parallel()) {
            const EnclosedEmitters lamps(surface_);
            const std::optional<InsideView> inside = bestInsideView({.surface = surface_,
                                                                     .samples = samples_,
                                                                     .emitters = lamps,
                                                                     .axes = axes_,
                                                                     .aspect = aspect_,
                                                                     .vfov = choice_.vfov,
                                                                     .target = target_,
                                                                     .unseen = outside.unseen});
            // The view from outside is worth little of a room, whose walls are all that it shows, and less
            // if all emitters are inside, because it is then dark.
            constexpr float kDarkWorth = 0.05f, kBlockWorth = 0.2f;
            const float part = lamps.all() ? kDarkWorth : (outside.block ? kBlockWorth : 1.0f);
            const float worth = part * outside.worth;
            // Inside a room, all surfaces face others, which must not count in its favour.
            if (inside && ViewSamples::kFacesNothing * inside->worth > worth)
                return camera(inside->eye, inside->target, inside->vfov);
        }
        Frustum exact = outside.frustum;
        placeEye(exact, corners_);
        const glm::vec3 target = targetOf(exact);
        return parallel() ? parallelCamera(exact.eye, target, 2.0f * exact.halfHeight)
                          : camera(exact.eye, target, vfov());
    }

  private:
    struct View {
        Frustum frustum;
        float worth = -1.0f;
        float unseen = 0.0f;  // fraction of the samples that no candidate saw
        bool block = false;   // whether these are many, and all others lie on the bounds
    };

    float vfov() const { return choice_.vfov.value_or(kDefaultVfov); }
    bool parallel() const { return hasParallelRays(choice_.type.value_or(CameraType::kPerspective)); }

    Frustum frustumOf(const glm::vec3& forward, float angle) const {
        const auto [right, up] = axes_.across(forward);
        const float tangent = std::tan(0.5f * glm::radians(angle));
        return {glm::vec3(0.0f), forward, right, up, tangent * aspect_, tangent, parallel()};
    }

    void placeEye(Frustum& frustum, const std::vector<glm::dvec3>& points) const {
        if (frustum.parallel) {
            placePlane(frustum, points);
        } else {
            placePoint(frustum, points);
        }
    }

    /// Places the plane where parallel rays begin in front of all points, and makes the image as large as it
    /// must be to show them, including a margin, unless its height is given. The points are centred, or the
    /// target is, if there is one.
    void placePlane(Frustum& frustum, const std::vector<glm::dvec3>& points) const {
        const glm::dvec3 middle = target_ ? glm::dvec3(*target_) : glm::dvec3(0.0);
        glm::dvec3 lower(1e300), upper(-1e300);  // x, y and depth
        for (const glm::dvec3& point : points) {
            const glm::dvec3 offset = point - middle;
            const glm::dvec3 place(glm::dot(offset, glm::dvec3(frustum.right)),
                                   glm::dot(offset, glm::dvec3(frustum.up)),
                                   glm::dot(offset, glm::dvec3(frustum.forward)));
            lower = glm::min(lower, place);
            upper = glm::max(upper, place);
        }
        glm::dvec2 across = 0.5 * glm::dvec2(lower + upper), half = 0.5 * glm::dvec2(upper - lower);
        if (target_) {
            across = glm::dvec2(0.0);
            half = glm::max(glm::abs(glm::dvec2(lower)), glm::abs(glm::dvec2(upper)));
        }
        const double needed = kMargin * std::max(half.y, half.x / static_cast<double>(aspect_));
        const double given = static_cast<double>(choice_.height.value_or(0.0f)) * surface_.scale() / 2.0;
        frustum.halfHeight = static_cast<float>(choice_.height ? given : needed);
        frustum.halfWidth = frustum.halfHeight * aspect_;
        // As far away as a perspective camera that shows the same: the default lamp stands beside the camera.
        const double tangent = std::tan(0.5 * glm::radians(static_cast<double>(kDefaultVfov)));
        const double depth =
            lower.z - std::max(static_cast<double>(frustum.halfHeight) / tangent, 0.02 * radius_);
        frustum.eye = glm::vec3(middle + across.x * glm::dvec3(frustum.right) +
                                across.y * glm::dvec3(frustum.up) + depth * glm::dvec3(frustum.forward));
    }

    /// Places the eye as near as possible with all points within the frustum, including a margin. The points
    /// are centred, or the target is, if there is one.
    void placePoint(Frustum& frustum, const std::vector<glm::dvec3>& points) const {
        const glm::dvec3 forward(frustum.forward), right(frustum.right), up(frustum.up);
        const double tangentX = static_cast<double>(frustum.halfWidth) / kMargin;
        const double tangentY = static_cast<double>(frustum.halfHeight) / kMargin;
        // A point is in view if its offset satisfies |x| <= tangentX z and |y| <= tangentY z. The largest
        // values of x - tangentX z and so on determine the four planes of the frustum.
        glm::dvec4 touch(-1e300);
        double nearest = 1e300;
        const glm::dvec3 middle = target_ ? glm::dvec3(*target_) : glm::dvec3(0.0);
        for (const glm::dvec3& point : points) {
            const glm::dvec3 offset = point - middle;
            const double x = glm::dot(offset, right), y = glm::dot(offset, up), z = glm::dot(offset, forward);
            touch = glm::max(
                touch, glm::dvec4(x - tangentX * z, -x - tangentX * z, y - tangentY * z, -y - tangentY * z));
            nearest = std::min(nearest, z);
        }
        constexpr double kLeastDepth = 0.02;  // relative to the radius of what is framed
        glm::dvec2 across(0.0);
        double depth = nearest - kLeastDepth * radius_;
        if (target_) {
            depth = std::min(
                {depth, -std::max(touch.x, touch.y) / tangentX, -std::max(touch.z, touch.w) / tangentY});
        } else {
            across = 0.5 * glm::dvec2(touch.x - touch.y, touch.z - touch.w);
            depth = std::min(
                {depth, -0.5 * (touch.x + touch.y) / tangentX, -0.5 * (touch.z + touch.w) / tangentY});
        }
        frustum.eye = glm::vec3(middle + across.x * right + across.y * up + depth * forward);
    }

    glm::vec3 targetOf(const Frustum& frustum) const {
        if (target_) return *target_;
        float least = 1e30f, most = -1e30f;
        for (const glm::dvec3& point : outermost_) {
            const float depth = glm::dot(glm::vec3(point) - frustum.eye, frustum.forward);
            least = std::min(least, depth);
            most = std::max(most, depth);
        }
        return frustum.eye + 0.5f * (least + most) * frustum.forward;
    }

    View bestOutside() const {
        const std::vector<OutsideDirection> directions = outsideDirections(axes_);
        std::vector<View> views(directions.size());
        std::vector<std::vector<bool>> seen(directions.size(), std::vector<bool>(samples_.size()));
        parallelFor(directions.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                Frustum frustum = frustumOf(-directions[i].towardsEye, vfov());
                placeEye(frustum, outermost_);
                // A surface does not hide a target that lies on it.
                const bool hidden =
                    target_ && !surface_.sees(frustum.eyeFor(*target_), *target_ - 1e-3f * frustum.forward);
                const float preference = directions[i].preference * (hidden ? 0.3f : 1.0f);
                views[i] = {frustum, preference * samples_.worthOf(frustum, &seen[i])};
            }
        });
        View best = *std::max_element(views.begin(), views.end(),
                                      [](const View& a, const View& b) { return a.worth < b.worth; });
        std::size_t unseen = 0;
        bool convex = true;
        for (std::size_t k = 0; k < samples_.size(); ++k) {
            if (std::none_of(seen.begin(), seen.end(), [&](const auto& s) { return s[k]; })) {
                ++unseen;
            } else {
                convex = convex && isOnBounds(samples_.front(k).position);
            }
        }
        best.unseen =
            static_cast<float>(unseen) / static_cast<float>(std::max<std::size_t>(samples_.size(), 1));
        best.block = convex && best.unseen > 0.3f;
        return best;
    }

    bool isOnBounds(const glm::vec3& point) const {
        const glm::vec3 below = point - surface_.toLocal(surface_.bulk().lower);
        const glm::vec3 above = surface_.toLocal(surface_.bulk().upper) - point;
        return glm::any(glm::lessThan(glm::min(below, above), glm::vec3(0.01f)));
    }

    /// For a choice with a position but no target.
    Camera fromPosition() const {
        const glm::vec3 eye = surface_.toLocal(*choice_.position);
        glm::vec3 lower(1e30f), upper(-1e30f);
        for (const glm::dvec3& point : outermost_) {
            lower = glm::min(lower, glm::vec3(point));
            upper = glm::max(upper, glm::vec3(point));
        }
        const glm::vec3 centre = 0.5f * (lower + upper);
        const bool inside = glm::all(glm::greaterThan(eye, lower)) && glm::all(glm::lessThan(eye, upper));
        if (!inside && glm::distance(eye, centre) > 1e-3f) {
            return parallel() ? parallelCamera(eye, centre, heightAround(eye, centre))
                              : camera(eye, centre, angleAround(eye, centre));
        }
        const float angle = choice_.vfov.value_or(insideVfov(aspect_));
        Frustum best{};
        float most = -1.0f;
        for (const glm::vec3& forward : lookAround(axes_)) {
            Frustum frustum = frustumOf(forward, angle);
            frustum.eye = eye;
            const float worth = samples_.worthOf(frustum);
            if (worth > most) best = frustum;
            most = std::max(worth, most);
        }
        const auto hit = surface_.firstHit(eye, best.forward);
        return camera(eye, eye + (hit ? std::max(hit->distance, 1e-3f) : 1.0f) * best.forward, angle);
    }

    /// The height of an image of parallel rays that covers everything.
    float heightAround(const glm::vec3& eye, const glm::vec3& target) const {
        const auto [right, up] = axes_.across(glm::normalize(target - eye));
        float half = 0.0f;
        for (const glm::dvec3& point : outermost_) {
            const glm::vec3 offset = glm::vec3(point) - eye;
            half =
                std::max({half, std::abs(glm::dot(offset, up)), std::abs(glm::dot(offset, right)) / aspect_});
        }
        return 2.0f * half * static_cast<float>(kMargin);
    }

    /// The vertical angle of view that covers everything, within limits.
    float angleAround(const glm::vec3& eye, const glm::vec3& target) const {
        if (choice_.vfov) return *choice_.vfov;
        const glm::vec3 forward = glm::normalize(target - eye);
        const auto [right, up] = axes_.across(forward);
        float tangent = 0.0f;
        for (const glm::dvec3& point : outermost_) {
            const glm::vec3 offset = glm::vec3(point) - eye;
            const float depth = std::max(glm::dot(offset, forward), 1e-4f);
            tangent = std::max({tangent, std::abs(glm::dot(offset, up)) / depth,
                                std::abs(glm::dot(offset, right)) / (depth * aspect_)});
        }
        const float angle = 2.0f * glm::degrees(std::atan(tangent * static_cast<float>(kMargin)));
        return std::clamp(angle, 1.0f, 100.0f);
    }

    Camera camera(const glm::vec3& eye, const glm::vec3& target, float angle) const {
        Camera camera;
        camera.position = choice_.position ? glm::vec3(*choice_.position) : glm::vec3(surface_.toScene(eye));
        camera.target = choice_.target ? glm::vec3(*choice_.target) : glm::vec3(surface_.toScene(target));
        camera.up = choice_.up ? glm::vec3(*choice_.up)
                               : axes_.upFor(glm::normalize(camera.target - camera.position));
        camera.vfov = angle;
        return asChosen(camera, choice_);
    }

    Camera parallelCamera(const glm::vec3& eye, const glm::vec3& target, float height) const {
        Camera result = camera(eye, target, vfov());
        if (!choice_.height)
            result.height = static_cast<float>(static_cast<double>(height) / surface_.scale());
        return result;
    }

    const CameraChoice& choice_;
    const Surface& surface_;
    const ViewSamples& samples_;
    float aspect_;
    ViewAxes axes_;
    std::optional<glm::vec3> target_;  // in local coordinates, if given
    std::vector<glm::dvec3> corners_, outermost_;
    double radius_ = 1.0;  // of the framed points
};

}  // namespace

Camera completeCamera(const CameraChoice& choice) {
    const ViewAxes axes(choice.up.value_or(choice.upwards));
    Camera camera;
    camera.position = glm::vec3(*choice.position);
    camera.target = glm::vec3(*choice.target);
    camera.up = choice.up ? glm::vec3(*choice.up)
                          : axes.upFor(glm::vec3(glm::normalize(*choice.target - *choice.position)));
    camera.vfov = choice.vfov.value_or(kDefaultVfov);
    return asChosen(camera, choice);
}

Camera frameCamera(const CameraChoice& choice, const Surface& surface, const ViewSamples& samples,
                   float aspect) {
    if (choice.complete()) return completeCamera(choice);
    return Framer(choice, surface, samples, aspect).frame();
}

}  // namespace duolux
