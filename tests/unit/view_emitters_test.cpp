#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/view/emitter_sides.h"
#include "tests/unit/view_framed.h"

namespace duolux::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A lamp of 1 x 1 that faces down, or up.
void addLamp(SceneBuilder& builder, glm::vec3 middle, bool down, Sides sides = Sides::kFront) {
    Material lamp;
    lamp.name = "lamp";
    lamp.emission.invisible = lamp.emission.visible = glm::vec3(8.0f);
    lamp.emission.sides = sides;
    const std::uint32_t material = builder.add(lamp);
    const glm::vec3 x(0.5f, 0, 0), z(0, 0, down ? 0.5f : -0.5f);
    builder.quad(middle - x - z, middle + x - z, middle + x + z, middle - x + z, material);
}

SceneBuilder floor() {
    SceneBuilder builder;
    builder.quad({-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, builder.add(Material{}));
    return builder;
}

SceneBuilder room() {
    SceneBuilder builder;
    builder.box({-2, 0, -2}, {2, 2, 2}, Facing::kInward, builder.add(Material{}));
    return builder;
}

std::vector<std::string> warningsOf(const LoadedScene& scene, const Camera& camera) {
    return textsOf(
        emitterWarnings(Surface(scene, scene.geometry.triangles.size()), camera, scene.settings.aspect()));
}

std::vector<std::string> warningsOf(const LoadedScene& scene) {
    return warningsOf(scene, framed(scene));
}

TEST(ViewEmitters, ThoseThatFaceAwayAreNamed) {
    SceneBuilder outside = floor();
    addLamp(outside, {0, 1, 0}, false);
    EXPECT_THAT(warningsOf(outside.scene), ElementsAre(HasSubstr("(material \"lamp\") face away")));
    SceneBuilder inside = room();
    addLamp(inside, {0, 1.95f, 0}, false);
    EXPECT_THAT(warningsOf(inside.scene), ElementsAre(HasSubstr("face away")));
    SceneBuilder one = floor();
    addLamp(one, {0, 1, 0}, true);
    addLamp(one, {1.5f, 1, 0}, false);
    std::vector<std::uint32_t>& materials = one.scene.geometry.materials;
    materials[4] = materials[5] = materials[2];
    EXPECT_THAT(warningsOf(one.scene), ElementsAre(HasSubstr("partly face away")));
}

TEST(ViewEmitters, ThoseWhoseBackSidesAreInViewAreNamed) {
    SceneBuilder builder = room();
    addLamp(builder, {0, 1.2f, 0}, false);
    Camera camera;
    camera.position = {1.9f, 0.5f, 1.9f};
    camera.target = {0, 1, 0};
    EXPECT_THAT(warningsOf(builder.scene, camera),
                ElementsAre(HasSubstr("show the camera only their back sides")));
    camera.position = {1.9f, 1.8f, 1.9f};
    EXPECT_THAT(warningsOf(builder.scene, camera), IsEmpty());
    // One is seen from below, another from above.
    addLamp(builder, {0, 0.6f, 0}, false);
    std::vector<std::uint32_t>& materials = builder.scene.geometry.materials;
    materials[14] = materials[15] = materials[12];
    camera.position = {1.9f, 0.9f, 1.9f};
    EXPECT_THAT(warningsOf(builder.scene, camera), IsEmpty());
}

TEST(ViewEmitters, ThoseThatLightTheSceneBringNoWarning) {
    SceneBuilder seenFromAbove = floor();
    addLamp(seenFromAbove, {0, 1, 0}, true);
    EXPECT_THAT(warningsOf(seenFromAbove.scene), IsEmpty());
    SceneBuilder both = floor();
    addLamp(both, {0, 1, 0}, false, Sides::kBoth);
    EXPECT_THAT(warningsOf(both.scene), IsEmpty());
    SceneBuilder ceiling = room();
    addLamp(ceiling, {0, 1.999f, 0}, true);
    EXPECT_THAT(warningsOf(ceiling.scene), IsEmpty());
    // The inside of a bulb is its back side, which lights nothing.
    SceneBuilder bulb;
    Material glass;
    glass.emission.invisible = glm::vec3(1.0f);
    bulb.sphere({0, 1, 0}, 0.3f, 1, Facing::kOutward, bulb.add(glass));
    EXPECT_THAT(warningsOf(bulb.scene), IsEmpty());
}

}  // namespace
}  // namespace duolux::test
