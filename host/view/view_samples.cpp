#include "host/view/view_samples.h"

#include <algorithm>
#include <cmath>

#include "host/base/parallel.h"
#include "host/base/random.h"
#include "host/view/hollows.h"

namespace duolux {

namespace {

constexpr std::size_t kSamples = 768;
constexpr int kPaths = 2;  // for each side of a sample

/// Spreads `count` points evenly over the area of the triangles that a camera should show.
std::vector<SurfacePoint> spread(const Surface& surface, std::size_t count) {
    double whole = 0.0;
    for (const Surface::Triangle& t : surface.triangles())
        whole += t.framed ? static_cast<double>(glm::length(t.areaVector())) : 0.0;
    std::vector<SurfacePoint> points;
    const double step = whole / static_cast<double>(count);
    double before = 0.0;
    for (std::uint32_t i = 0; i < surface.triangles().size() && whole > 0.0; ++i) {
        const Surface::Triangle& t = surface.triangles()[i];
        const glm::vec3 area = t.areaVector();
        const float size = glm::length(area);
        if (!t.framed || !(size > 0.0f)) continue;
        while (points.size() < count &&
               (static_cast<double>(points.size()) + 0.5) * step < before + static_cast<double>(size)) {
            // Roberts's sequence R2, "The unreasonable effectiveness of quasirandom sequences", 2018.
            const auto n = static_cast<double>(points.size() + 1);
            double x = n * 0.7548776662466927, y = n * 0.5698402909980532;
            x -= std::floor(x);
            y -= std::floor(y);
            if (x + y > 1.0) {
                x = 1.0 - x;
                y = 1.0 - y;
            }
            const glm::vec3 at = t.corner + static_cast<float>(x) * t.edge1 + static_cast<float>(y) * t.edge2;
            points.push_back({at, area / size, i, true});
        }
        before += static_cast<double>(size);
    }
    return points;
}

/// 0 at grazing views, 1 from 30 degrees on.
float notGrazing(float cosine) {
    return std::clamp((cosine - 0.03f) / 0.47f, 0.0f, 1.0f);
}

}  // namespace

bool Frustum::contains(const glm::vec3& point) const {
    const glm::vec3 offset = point - eye;
    const float depth = glm::dot(offset, forward);
    const float widening = parallel ? 1.0f : depth;
    return depth > 0.0f && std::abs(glm::dot(offset, right)) <= halfWidth * widening &&
           std::abs(glm::dot(offset, up)) <= halfHeight * widening;
}

glm::vec3 Frustum::eyeFor(const glm::vec3& point) const {
    return parallel ? point - glm::dot(point - eye, forward) * forward : eye;
}

ViewSamples::ViewSamples(const Surface& surface, const Illumination& illumination) : surface_(surface) {
    const std::vector<SurfacePoint> points = spread(surface, kSamples);
    samples_.resize(points.size());
    std::vector<std::array<float, 2>> whites(points.size());
    std::vector<char> insideOut(points.size());
    std::vector<std::array<float, 2>> faced(points.size());
    parallelFor(points.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            insideOut[i] = isInsideOut(surface, points[i], static_cast<std::uint32_t>(i + 1)) ? 1 : 0;
            for (std::size_t side = 0; side < 2; ++side) {
                SurfacePoint point = points[i];
                Random random(i + 1);
                if (side == 1) point = {point.position, -point.normal, point.triangle, false};
                faced[i][side] = facedPart(surface, point, random);
                const bool reflects = scatters(surface.materialOf(point.triangle), point.front);
                const auto seed = static_cast<std::uint32_t>(2 * i + side + 1);
                const float white = reflects ? illumination.onWhite(point, seed, kPaths) : 0.0f;
                whites[i][side] = std::min(1.0f, white + illumination.emitted(point));
            }
        }
    });
    for (const auto& [front, back] : whites)
        brightness_ += std::max(front, back) / static_cast<float>(std::max<std::size_t>(whites.size(), 1));
    for (std::size_t i = 0; i < points.size(); ++i) {
        samples_[i].front = points[i];
        for (std::size_t side = 0; side < 2; ++side) {
            SurfacePoint point = points[i];
            point.front = side == 0;
            samples_[i].worth[side] = glm::mix(kFacesNothing, 1.0f, faced[i][side]) *
                                      worthOf(point, insideOut[i] != 0, whites[i][side]);
        }
    }
}

float ViewSamples::worthOf(const SurfacePoint& point, bool insideOut, float white) const {
    const Material& material = surface_.materialOf(point.triangle);
    float worth = point.front != insideOut ? 1.0f : 0.4f;
    if (!point.front && material.sides == Sides::kFront) worth = 0.05f;
    if (brightness_ >= kDark) worth *= 0.1f + 0.9f * std::min(1.0f, white / kDark);
    return worth;
}

float ViewSamples::worthOf(const Frustum& frustum, std::vector<bool>* seen) const {
    float sum = 0.0f;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        const auto& [point, worth] = samples_[i];
        if (!frustum.contains(point.position)) continue;
        const glm::vec3 eye = frustum.eyeFor(point.position);
        const glm::vec3 offset = eye - point.position;
        const float cosine = glm::dot(point.normal, offset) / glm::length(offset);
        const float weight = notGrazing(std::abs(cosine));
        if (!(weight > 0.0f)) continue;
        const glm::vec3 side = cosine > 0.0f ? point.normal : -point.normal;
        if (!surface_.sees(point.position + kOffset * side, eye, point.triangle)) continue;
        sum += weight * worth[cosine > 0.0f ? 0 : 1];
        if (seen != nullptr) (*seen)[i] = true;
    }
    return sum / static_cast<float>(std::max<std::size_t>(samples_.size(), 1));
}

float ViewSamples::frontsSeenFrom(const glm::vec3& point) const {
    std::size_t count = 0;
    for (const Sample& sample : samples_) {
        const glm::vec3 from = sample.front.position + kOffset * sample.front.normal;
        if (glm::dot(sample.front.normal, point - from) <= 0.0f) continue;
        count += surface_.sees(from, point, sample.front.triangle) ? 1 : 0;
    }
    return static_cast<float>(count) / static_cast<float>(std::max<std::size_t>(samples_.size(), 1));
}

}  // namespace duolux
