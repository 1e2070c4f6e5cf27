#include "host/view/inside_views.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "host/base/parallel.h"

namespace duolux {

namespace {

constexpr int kDirections = 64;      // rays that test whether a point is enclosed
constexpr float kEnclosed = 0.9f;    // fraction of the rays that must hit a surface
constexpr float kClearance = 0.12f;  // fraction of the distance to the wall behind the camera
constexpr std::size_t kHearts = 2, kProbes = 24;

/// A point in empty space, and statistics of the surfaces around it.
struct Heart {
    glm::vec3 position;
    float hits = 0.0f, fronts = 0.0f;  // fractions of all directions
    float room = 0.0f;                 // mean distance
};

Heart probe(const Surface& surface, const glm::vec3& position) {
    Heart heart{position};
    for (int i = 0; i < kDirections; ++i) {
        const auto hit = surface.firstHit(position, onSphere(i, kDirections));
        if (!hit) continue;
        heart.hits += 1.0f / kDirections;
        heart.fronts += hit->front ? 1.0f / kDirections : 0.0f;
        heart.room += std::min(hit->distance, 2.0f) / kDirections;
    }
    return heart;
}

/// The enclosed points with the most room. Candidates are the middle of the scene and points halfway between
/// opposite surfaces.
std::vector<Heart> findHearts(const Surface& surface, const ViewSamples& samples) {
    std::vector<glm::vec3> positions{glm::vec3(0.0f)};
    for (std::size_t k = 0; k < kProbes && samples.size() > 0; ++k) {
        const SurfacePoint& point = samples.front(k * samples.size() / kProbes);
        for (const glm::vec3& side : {point.normal, -point.normal}) {
            const auto hit = surface.firstHit(point.position + 1e-5f * side, side, point.triangle);
            if (hit && hit->distance > 0.02f)
                positions.push_back(point.position + 0.5f * hit->distance * side);
        }
    }
    std::vector<Heart> hearts(positions.size());
    parallelFor(positions.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            hearts[i] = probe(surface, positions[i]);
    });
    std::erase_if(hearts, [](const Heart& heart) { return heart.hits < kEnclosed; });
    std::stable_sort(hearts.begin(), hearts.end(),
                     [](const Heart& a, const Heart& b) { return a.room > b.room; });
    return hearts;
}

/// Whether the surroundings are a room, judged without emitters: a hollow whose front sides face inwards.
bool isRoom(const Heart& heart, const ViewSamples& samples, float unseen) {
    constexpr float kFronts = 0.7f, kRound = 0.85f, kContents = 0.04f;
    return heart.fronts > kFronts * heart.hits &&
           (unseen > kContents || samples.frontsSeenFrom(heart.position) > kRound);
}

}  // namespace

float insideVfov(float aspect) {
    return 2.0f * glm::degrees(std::atan(0.64f / std::sqrt(std::clamp(aspect, 0.25f, 4.0f))));
}

std::optional<InsideView> bestInsideView(const InsideSearch& search) {
    const auto& [surface, samples, emitters, axes, aspect, vfov, target, unseen] = search;
    std::vector<Heart> hearts;
    if (target) {
        hearts = {probe(surface, *target)};
        if (hearts[0].hits < kEnclosed) return std::nullopt;
    } else {
        hearts = findHearts(surface, samples);
    }
    if (emitters.all()) {
        std::erase_if(hearts, [&](const Heart& heart) { return !emitters.areSeenFrom(heart.position); });
    } else if (samples.brightness() < kDark) {
        std::erase_if(hearts, [&](const Heart& heart) { return !isRoom(heart, samples, unseen); });
    }
    if (hearts.size() > kHearts) hearts.resize(kHearts);
    std::vector<InsideView> views;
    const float angle = vfov.value_or(insideVfov(aspect));
    for (const Heart& heart : hearts) {
        for (int k = 0; k < 16; ++k) {
            for (const float elevation : {3.0f, 14.0f}) {
                const glm::vec3 back = axes.direction(30.0f + 22.5f * static_cast<float>(k), elevation);
                const auto hit = surface.firstHit(heart.position, back);
                if (!hit) continue;
                views.push_back({heart.position + (1.0f - kClearance) * hit->distance * back, heart.position,
                                 angle, -1.0f});
            }
        }
    }
    const float tangent = std::tan(0.5f * glm::radians(angle));
    parallelFor(views.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const glm::vec3 forward = glm::normalize(views[i].target - views[i].eye);
            const auto [right, up] = axes.across(forward);
            views[i].worth = samples.worthOf(
                Frustum{views[i].eye, forward, right, up, tangent * aspect, tangent}, nullptr);
        }
    });
    if (views.empty()) return std::nullopt;
    return *std::max_element(views.begin(), views.end(),
                             [](const InsideView& a, const InsideView& b) { return a.worth < b.worth; });
}

}  // namespace duolux
