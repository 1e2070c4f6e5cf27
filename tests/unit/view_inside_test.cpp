#include <gtest/gtest.h>

#include "tests/unit/view_framed.h"

namespace duolux::test {
namespace {

bool isInside(const glm::vec3& point, const glm::vec3& half) {
    return glm::all(glm::lessThan(glm::abs(point), half));
}

/// A room of 4 x 2 x 4 with two boxes on its floor.
SceneBuilder furnishedRoom(Facing facing) {
    SceneBuilder builder;
    const std::uint32_t material = builder.add(Material{});
    builder.box({-2, -1, -2}, {2, 1, 2}, facing, material);
    builder.box({-1.5f, -1, -1.5f}, {-0.7f, -0.1f, -0.7f}, Facing::kOutward, material);
    builder.box({0.6f, -1, -0.2f}, {1.5f, -0.5f, 0.9f}, Facing::kOutward, material);
    return builder;
}

void addLamp(SceneBuilder& builder, bool down, float y = 0.6f) {
    Material lamp;
    lamp.name = "lamp";
    lamp.emission.invisible = lamp.emission.visible = glm::vec3(8.0f);
    const std::uint32_t material = builder.add(lamp);
    const glm::vec3 a(-0.5f, y, -0.5f), b(0.5f, y, -0.5f), c(0.5f, y, 0.5f), d(-0.5f, y, 0.5f);
    if (down) {
        builder.quad(a, b, c, d, material);
    } else {
        builder.quad(d, c, b, a, material);
    }
}

TEST(ViewInside, ALitRoomIsSeenFromWithinWhateverItsWinding) {
    for (const Facing facing : {Facing::kInward, Facing::kOutward}) {
        for (const bool down : {true, false}) {
            SceneBuilder builder = furnishedRoom(facing);
            addLamp(builder, down);
            const Camera camera = framed(builder.scene);
            EXPECT_TRUE(isInside(camera.position, {2, 1, 2}));
            EXPECT_GT(glm::length(glm::vec2(camera.position.x, camera.position.z)), 1.2f) << "near a wall";
            EXPECT_GT(glm::dot(camera.target - camera.position, -camera.position), 0.0f)
                << "looks at the middle";
            EXPECT_GT(camera.vfov, 55.0f);
        }
    }
}

TEST(ViewInside, ARoomWithoutLampsIsToldByItsFronts) {
    EXPECT_TRUE(isInside(framed(furnishedRoom(Facing::kInward).scene).position, {2, 1, 2}));
    EXPECT_FALSE(isInside(framed(furnishedRoom(Facing::kOutward).scene).position, {2, 1, 2}));
}

/// A closed room with walls of concrete, in which a lamp faces down, or up to the ceiling.
TEST(ViewInside, ARoomWithThickWallsIsSeenFromWithin) {
    for (const bool furnished : {true, false}) {
        for (const char* lamp : {"none", "down", "up", "outside"}) {
            SceneBuilder builder = furnishedRoom(Facing::kInward);
            const std::uint32_t material = builder.add(Material{});
            if (!furnished) {
                builder = SceneBuilder();
                builder.box({-2, -1, -2}, {2, 1, 2}, Facing::kInward, builder.add(Material{}));
            }
            builder.box({-2.3f, -1.3f, -2.3f}, {2.3f, 1.3f, 2.3f}, Facing::kOutward,
                        furnished ? material : 0);
            const std::string where = lamp;
            if (where == "down" || where == "up") addLamp(builder, where == "down", 0.95f);
            if (where == "outside") addLamp(builder, true, 9.0f);
            EXPECT_EQ(isInside(framed(builder.scene).position, {2, 1, 2}), where != "outside") << where;
        }
    }
}

TEST(ViewInside, ALampThatFacesTheCeilingIsAReasonToGoInside) {
    SceneBuilder builder = furnishedRoom(Facing::kInward);
    builder.sphere({0, 0, 0}, 4.0f, 1, Facing::kOutward, 0);
    EXPECT_FALSE(isInside(framed(builder.scene).position, {2, 1, 2})) << "a sphere is no block";
    addLamp(builder, false, 0.98f);
    EXPECT_TRUE(isInside(framed(builder.scene).position, {2, 1, 2}));
}

TEST(ViewInside, WallsMayBeThickerThanTheRoomIsHigh) {
    SceneBuilder builder;
    const std::uint32_t material = builder.add(Material{});
    builder.box({-4, -3, -4}, {4, 3, 4}, Facing::kOutward, material);
    builder.box({-2, -1, -2}, {2, 1, 2}, Facing::kOutward, material);
    addLamp(builder, false, 0.98f);
    EXPECT_TRUE(isInside(framed(builder.scene).position, {2, 1, 2}));
}

TEST(ViewInside, SolidsAreSeenFromOutside) {
    EXPECT_FALSE(isInside(framed(boxScene({-1, -1, -1}, {1, 1, 1})).position, glm::vec3(1)));
    // A lamp outside a closed body does not light its inside.
    LoadedScene scene = boxScene({-1, -1, -1}, {1, 1, 1});
    SceneBuilder builder;
    builder.scene = scene;
    Material lamp;
    lamp.emission.invisible = glm::vec3(20.0f);
    builder.quad({-1, 3, -1}, {1, 3, -1}, {1, 3, 1}, {-1, 3, 1}, builder.add(lamp));
    EXPECT_FALSE(isInside(framed(builder.scene).position, glm::vec3(1)));
}

TEST(ViewInside, PartsOfACameraThatAreSaidAreKept) {
    SceneBuilder builder = furnishedRoom(Facing::kInward);
    addLamp(builder, true);
    CameraChoice choice;
    choice.vfov = 30.0f;
    EXPECT_EQ(framed(builder.scene, choice).vfov, 30.0f);
    choice = {};
    choice.target = {0.5, 0, 0.5};
    const Camera at = framed(builder.scene, choice);
    EXPECT_EQ(at.target, glm::vec3(0.5f, 0.0f, 0.5f));
    EXPECT_TRUE(isInside(at.position, {2, 1, 2}));
    choice = {};
    choice.position = {1.8, 0.2, 1.8};
    const Camera from = framed(builder.scene, choice);
    EXPECT_GT(from.vfov, 55.0f);
    const glm::vec3 view = glm::normalize(from.target - from.position);
    EXPECT_LT(view.x + view.z, -0.5f) << "away from the corner";
}

}  // namespace
}  // namespace duolux::test
