#include <numbers>

#include "tests/support/exact/receiver.h"

// Point emitters: each adds L = albedo / pi O I cos / d^2 on a diffuse receiver. Detects a wrong distance or
// cosine, multiple importance sampling of emitters that only one strategy finds, a choice among several
// emitters without division by its probability, and points that are hit or seen.

namespace duolux::test {

namespace {

struct Point {
    Vec3 position;
    glm::vec3 invisible, visible;
};

const Point kLeft{{-1.0, 2.0, 0.5}, {3.0f, 2.0f, 5.0f}, {0.5f, 0.0f, 0.25f}};
const Point kRight{{2.0, 0.5, -0.25}, {20.0f, 40.0f, 1.0f}, {0.0f, 8.0f, 2.0f}};
const Point kBelow{{0.0, -1.0, 0.0}, {100.0f, 100.0f, 100.0f}, {1.0f, 1.0f, 1.0f}};

// Low, but above the receiver.
const glm::vec3 kBesideLights{0.9f, 0.3f, 0.25f};

ChannelLight irradiance(const Point& point, const Vec3& normal) {
    const double squared = glm::dot(point.position, point.position);
    const double cosine = std::max(glm::dot(normal, point.position), 0.0) / std::sqrt(squared);
    return (cosine / squared) * reference::channelsOf(point.invisible, point.visible);
}

ExactCase lit(std::string name, const Reflectance& reflectance, const std::vector<Point>& points,
              glm::vec3 normal = {0, 1, 0}) {
    ReceiverScene::Receiver receiver;
    receiver.normal = normal;
    receiver.reflectance = reflectance;
    ReceiverScene scene(receiver, kBesideLights);
    ChannelLight sum = reference::channelsOf(glm::vec3(0.0f), glm::vec3(0.0f));
    for (const Point& point : points) {
        scene.builder().scene.pointEmitters.push_back(
            {glm::vec3(point.position), point.invisible, point.visible});
        sum = sum + irradiance(point, glm::normalize(Vec3(normal)));
    }
    // With stratified choices among so few points, several pixels have equal errors, which do not vary with
    // the seed.
    scene.builder().scene.settings.sampler = Sampler::kIndependent;
    return scene.finish(std::move(name), 3, scene.reflected(sum));
}

}  // namespace

std::vector<ExactCase> pointCases() {
    std::vector<ExactCase> cases;
    const Reflectance full{{{0.5f, 0.2f, 0.7f}, {0.4f, 0.6f, 0.1f}, {0.3f, 0.9f, 0.5f}, {0.2f, 0.3f, 0.4f}},
                           {}};
    cases.push_back(lit("PointLocal", preset("local"), {kLeft}));
    cases.push_back(lit("PointGlobal", preset("global"), {kLeft}));
    cases.push_back(lit("PointFull", full, {kLeft}));
    cases.push_back(lit("PointTilted", preset("global"), {kLeft}, {0.5f, 1.0f, 0.3f}));
    cases.push_back(lit("PointsTwo", preset("one-bounce"), {kLeft, kRight}));
    cases.push_back(lit("PointsTwoLocal", preset("local"), {kLeft, kRight, kBelow}));
    cases.push_back(lit("PointBelow", preset("shadowless"), {kBelow}));

    // Beside an emitting rectangle; and behind a pane, which halves the invisible component.
    ReceiverScene::Receiver receiver;
    receiver.reflectance = preset("global");
    const Emission glow{{1.0f, 2.0f, 3.0f}, {0.0f, 0.0f, 0.0f}, Sides::kFront};
    const std::vector<Vec3> square = downwardRectangle(-1, 1, -3, -2, 2);
    ReceiverScene both(receiver, kBesideLights);
    both.emitter(square, glow, preset("global"));
    both.builder().scene.pointEmitters.push_back({glm::vec3(kLeft.position), kLeft.invisible, kLeft.visible});
    const Vec3 up(0, 1, 0);
    cases.push_back(both.finish(
        "PointAndRectangle", 1,
        both.reflected(irradiance(kLeft, up) + lambertPolygon(Vec3(0.0), up, square) * lightOf(glow))));
    ReceiverScene shaded(receiver, kBesideLights);
    SceneBuilder& builder = shaded.builder();
    const std::uint32_t pane = builder.add(filter("pane", matrix(0.5f, 0, 0, 0.25f)));
    builder.quad({-3, 1.5f, -3}, {-3, 1.5f, 3}, {3, 1.5f, 3}, {3, 1.5f, -3}, pane);
    builder.scene.pointEmitters.push_back({glm::vec3(kLeft.position), kLeft.invisible, kLeft.visible});
    cases.push_back(shaded.finish(
        "PointBehindPane", 1,
        shaded.reflected(reference::channelsOf(matrix(0.5f, 0, 0, 0.25f)) * irradiance(kLeft, up))));
    return cases;
}

}  // namespace duolux::test
