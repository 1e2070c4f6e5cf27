#include <numbers>
#include <optional>

#include "tests/reference/pinhole.h"
#include "tests/support/exact/receiver.h"

// The paper's `local` (eq. 14): direct light without occlusion. On a diffuse receiver it is L = albedo / pi O
// E times Lambert's formula for the polygon clipped to the horizon. Detects wrong solid-angle or area pdfs, a
// cosine at the wrong end, emitters or receivers that act on the wrong side, and a wrong choice among several
// emitters.

namespace duolux::test {

namespace {

const Emission kGlow{{3.0f, 2.0f, 5.0f}, {0.5f, 0.0f, 0.25f}, Sides::kFront};

ReceiverScene::Receiver receiver(glm::vec3 normal) {
    ReceiverScene::Receiver r;
    r.normal = normal;
    r.reflectance = preset("local");
    return r;
}

// Low enough to pass below every rectangle here.
const glm::vec3 kEye{0.99f, 0.1f, 0.05f};

struct Setup {
    ReceiverScene::Receiver receiver;
    std::vector<Vec3> polygon;
    glm::vec3 eye = kEye;
    /// Projected solid angle of the emission that reaches the lit side; by default, for the front.
    std::optional<double> factor = std::nullopt;
};

ExactCase lambert(std::string name, const Setup& setup) {
    ReceiverScene scene(setup.receiver, setup.eye);
    scene.emitter(setup.polygon, kGlow, preset("local"));
    const Vec3 normal = glm::normalize(Vec3(setup.receiver.normal));
    const double factor = setup.factor ? *setup.factor : lambertPolygon(Vec3(0.0), normal, setup.polygon);
    // `local` has no second bounce, however many are allowed.
    return scene.finish(std::move(name), 4, scene.reflected(factor * lightOf(kGlow)));
}

ExactCase twoEmitters() {
    ReceiverScene scene(receiver({0, 1, 0}), kEye);
    const std::vector<Vec3> large = downwardRectangle(-3, -1, -2, 2, 2);
    const std::vector<Vec3> small{{0.2, 1, 0.1}, {0.4, 1, 0.1}, {0.3, 1.1, 0.4}};
    const Emission dim{{0.5f, 1.0f, 0.25f}, {0.0f, 0.5f, 1.0f}, Sides::kFront};
    const Emission bright{{40.0f, 90.0f, 10.0f}, {0.0f, 0.0f, 30.0f}, Sides::kBoth};
    scene.emitter(large, dim, preset("local"));
    scene.emitter(small, bright, preset("local"));
    const Vec3 up(0, 1, 0);
    const ChannelLight irradiance = lambertPolygon(Vec3(0.0), up, large) * lightOf(dim) +
                                    lambertPolygon(Vec3(0.0), up, small) * lightOf(bright);
    return scene.finish("LambertTwoEmitters", 1, scene.reflected(irradiance));
}

struct Floor {
    std::string name;
    Reflectance reflectance;
    /// Panes between the floor and both lamp and camera, from the top; they absorb the light that they do not
    /// transmit.
    std::vector<ReflectanceMatrix> panes;
    float distance = 0.25f;  ///< between panes
};

/// A whole image of a floor, to detect a mirrored, rotated or shifted camera. With panes, the camera sees T_1
/// T_2 ... albedo / pi O ... T_2 T_1 E times Lambert's formula.
ExactCase floorImage(const Floor& setup) {
    constexpr std::uint32_t kSize = 24;
    SceneBuilder builder;
    Material floor, lamp;
    floor.name = "floor";
    floor.baseColor = {0.9f, 0.6f, 0.3f};
    lamp.name = "lamp";
    lamp.emission = {{4.0f, 3.0f, 4.0f}, {0.0f, 1.0f, 0.0f}, Sides::kFront};
    const std::uint32_t floorIndex = builder.add(floor), lampIndex = builder.add(lamp);
    builder.quad({-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}, floorIndex);
    const std::vector<Vec3> polygon = downwardRectangle(-2.5, -1.5, 0.5, 2.5, 1.2);
    builder.quad(polygon[0], polygon[1], polygon[2], polygon[3], lampIndex);
    ChannelMatrix down = reference::identityPerChannel(), up = reference::identityPerChannel();
    float height = 0.9f;
    for (const ReflectanceMatrix& pane : setup.panes) {
        const std::uint32_t index = builder.add(filter("pane", pane));
        builder.quad({-9, height, 9}, {9, height, 9}, {9, height, -9}, {-9, height, -9}, index);
        up = up * reference::channelsOf(pane);
        down = reference::channelsOf(pane) * down;
        height -= setup.distance;
    }
    LoadedScene& scene = builder.scene;
    scene.reflectance = setup.reflectance;
    scene.camera = {{1.5f, 1.1f, 3.0f}, {-1.0f, 0.0f, 0.5f}, {0, 1, 0}, 24.0f};
    scene.settings.width = scene.settings.height = kSize;
    scene.settings.bounces = 1;
    const ChannelMatrix scatter = scaled(floor.baseColor, reference::channelsOf(setup.reflectance.opaque));
    const ChannelLight seen = (1.0 / std::numbers::pi) * (up * scatter * down * lightOf(lamp.emission));

    // Midpoint rule over each pixel's footprint.
    constexpr int kSteps = 24;
    const reference::Pinhole pinhole(scene.camera, kSize, kSize);
    reference::Estimates expected{kSize, kSize, 0, {}};
    for (std::uint32_t y = 0; y < kSize; ++y) {
        for (std::uint32_t x = 0; x < kSize; ++x) {
            double mean = 0.0;
            for (int i = 0; i < kSteps * kSteps; ++i) {
                const reference::Ray ray =
                    pinhole.ray(x + (i % kSteps + 0.5) / kSteps, y + (i / kSteps + 0.5) / kSteps);
                const Vec3 point = ray.origin - (ray.origin.y / ray.direction.y) * ray.direction;
                mean += lambertPolygon(point, Vec3(0, 1, 0), polygon) / (kSteps * kSteps);
            }
            expected.pixels.push_back(exactly(mean * seen));
        }
    }
    return {setup.name, scene, expected, reference::LightSearch::kArea, 3e-4};
}

}  // namespace

std::vector<ExactCase> lambertCases() {
    std::vector<ExactCase> cases;
    const auto add = [&](const char* name, const Setup& setup) { cases.push_back(lambert(name, setup)); };
    const ReceiverScene::Receiver flat = receiver({0, 1, 0});
    const std::vector<Vec3> square = downwardRectangle(-1, 1, -1, 1, 2);
    const double squareFactor = lambertPolygon(Vec3(0.0), Vec3(0, 1, 0), square);
    add("LambertNear", {flat, downwardRectangle(-1, 1, -0.5, 0.5, 0.5)});
    add("LambertMiddle", {flat, square});
    add("LambertFar", {flat, downwardRectangle(-1, 1, -0.5, 0.5, 10)});
    add("LambertAside", {flat, downwardRectangle(-4, -2, 1, 2, 1.5)});
    add("LambertTilted", {receiver({0.5f, 1.0f, 0.3f}), square});
    // Partly below the horizon: by the tilt, and for a vertical receiver whose horizon cuts the rectangle.
    add("LambertHorizon", {receiver({2.0f, 1.0f, 0.5f}), downwardRectangle(-3, 1, -1, 2, 1.5)});
    add("LambertVertical", {receiver({1, 0, 0}), downwardRectangle(-1, 1, -1, 1, 1)});
    add("LambertBelow", {receiver({1, 0, 0}), downwardRectangle(-3, -1, -1, 1, 1)});
    // f_opaque acts if light and camera are on the same side; a one-sided one, only on the front.
    ReceiverScene::Receiver turned = receiver({0, -1, 0});
    add("LambertBackOfReceiver", {turned, square, kEye, squareFactor});
    turned.sides = Sides::kFront;
    add("LambertFrontOnlyReceiver", {turned, square, kEye, 0.0});
    add("LambertFarSide", {flat, square, {0.99f, -0.1f, 0.05f}, 0.0});
    // The back of a one-sided emitter is dark.
    add("LambertEmitterTurnedAway", {flat, {square[0], square[3], square[2], square[1]}, kEye, 0.0});
    cases.push_back(twoEmitters());
    cases.push_back(floorImage({"LambertFloorImage", preset("local"), {}}));
    const ReflectanceMatrix amber{
        {0.9f, 0.1f, 0.5f}, {0.2f, 0.6f, 0.3f}, {0.1f, 0.8f, 0.4f}, {0.3f, 0.2f, 0.7f}};
    const ReflectanceMatrix teal{
        {0.2f, 0.7f, 0.1f}, {0.8f, 0.1f, 0.5f}, {0.5f, 0.3f, 0.9f}, {0.6f, 0.4f, 0.2f}};
    const Reflectance full{{{0.5f, 0.2f, 0.7f}, {0.4f, 0.6f, 0.1f}, {0.3f, 0.9f, 0.5f}, {0.2f, 0.3f, 0.4f}},
                           {}};
    cases.push_back(floorImage({"LambertFloorAmberTeal", full, {amber, teal}}));
    cases.push_back(floorImage({"LambertFloorTealAmber", full, {teal, amber}}));
    // The ray crosses both panes, one after the other.
    const ReflectanceMatrix half = matrix(0.5f, 0, 0, 0.75f), third = matrix(0.3f, 0, 0, 0.6f);
    cases.push_back(floorImage({"LambertFloorCoincidentPanes", full, {half, third}, 0.0f}));
    cases.push_back(floorImage({"LambertFloorOpaqueToVisible", preset("global"), {matrix(1, 0, 0, 0)}}));
    return cases;
}

}  // namespace duolux::test
