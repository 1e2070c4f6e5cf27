// Coordinates far from the origin, as georeferenced models have them.
#include <fmt/format.h>

#include "host/scene/hash.h"
#include "host/scene/origin.h"
#include "tests/unit/scene_files.h"

namespace duolux::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class OriginTest : public SceneFiles {
  protected:
    /// A triangle of 1.2 and 0.9 units whose first corner is at the given place.
    static std::string triangleAt(const glm::dvec3& at) {
        return fmt::format(
            "v {0:.3f} {1:.3f} {2:.3f}\nv {3:.3f} {1:.3f} {2:.3f}\nv {0:.3f} {4:.3f} {2:.3f}\nf 1 2 3\n",
            at.x, at.y, at.z, at.x + 1.2, at.y + 0.9);
    }

    /// A corner of a triangle in the coordinates of the file.
    static glm::dvec3 corner(const LoadedScene& scene, std::size_t triangle, int i) {
        return scene.origin + glm::dvec3(scene.geometry.positions[scene.geometry.triangles[triangle][i]]);
    }

    static const glm::dvec3 kUtm;
};
const glm::dvec3 OriginTest::kUtm{512345.67, 4612345.671, 120.5};

TEST_F(OriginTest, IsZeroUnlessTheScenesIsFarForItsExtent) {
    const auto origin = [](const glm::dvec3& lower, const glm::dvec3& upper) {
        return originFor({lower, upper});
    };
    EXPECT_EQ(originFor({}), glm::dvec3(0.0));
    EXPECT_EQ(origin({-1, -1, -1}, {1, 1, 1}), glm::dvec3(0.0));
    EXPECT_EQ(origin({7, 0, 0}, {8, 1, 1}), glm::dvec3(0.0));
    EXPECT_EQ(origin({99, 0, 0}, {100, 1, 1}), glm::dvec3(100, 1, 1));
    EXPECT_EQ(origin({1000.2, 0, 0}, {1001.2, 1, 0.3}), glm::dvec3(1001, 1, 0));
    EXPECT_EQ(origin({1e6 + 3, 2, 2}, {1e6 + 345, 2, 2}), glm::dvec3(1e6 + 200, 0, 0)) << "in round numbers";
    EXPECT_EQ(origin({5, 5, 5}, {5, 5, 5}), glm::dvec3(0.0));
}

TEST_F(OriginTest, PositionsKeepWhatDoublesTell) {
    const LoadedScene scene = loadObj(triangleAt(kUtm));
    EXPECT_EQ(scene.origin, glm::dvec3(512346, 4612346, 121)) << "the middle in whole numbers";
    EXPECT_NEAR(glm::distance(corner(scene, 0, 0), kUtm), 0.0, 1e-6);
    EXPECT_NEAR(corner(scene, 0, 1).x - corner(scene, 0, 0).x, 1.2, 1e-6);
    EXPECT_LT(glm::length(scene.camera.target), 2.0f);
    EXPECT_THAT(scene.warnings[0].text,
                HasSubstr("coordinates are far from the origin for their extent: they are used "
                          "less 512346, 4612346, 121"));
    EXPECT_NE(hashScene(scene), hashScene(loadObj(triangleAt(kUtm + 10.0))));
    EXPECT_EQ(loadObj(triangleAt({0, 0, 0})).origin, glm::dvec3(0.0));
}

TEST_F(OriginTest, VerticesThatNoFaceUsesDoNotCount) {
    EXPECT_EQ(loadObj(triangleAt(kUtm) + "v 0 0 0\n").origin, glm::dvec3(512346, 4612346, 121));
    EXPECT_EQ(loadObj(triangleAt({0, 0, 0}) + "v 1e7 1e7 1e7\n").origin, glm::dvec3(0.0));
}

TEST_F(OriginTest, CoordinatesBeyondTheLimitAreMovedWithin) {
    const LoadedScene scene = loadObj("v 3e9 0 0\nv 3000000010 0 0\nv 3e9 10 0\nf 1 2 3\n");
    EXPECT_EQ(corner(scene, 0, 1), glm::dvec3(3000000010.0, 0, 0));
}

TEST_F(OriginTest, OneOriginForAllObjectsLightsAndTheCamera) {
    write("far.obj", triangleAt(kUtm));
    write("near.obj", triangleAt({0, 0, 0}));
    const LoadedScene scene = loadJson(R"({"duolux": 1,
        "camera": {"position": [512346.27, 4612346.25, 124.5], "target": [512346.27, 4612346.25, 120.5]},
        "objects": [{"mesh": "far.obj"},
                    {"mesh": "near.obj", "transform": [1,0,0,512345.17, 0,1,0,4612345.125, 0,0,1,119, 0,0,0,1]},
                    {"mesh": "far.obj", "transform": [1,0,0,0, 0,1,0,0, 0,0,1,0.5, 0,0,0,1]}],
        "lights": [{"type": "rectangle", "origin": [512345.5, 4612345.5, 125.25], "edge1": [0,1,0], "edge2": [1,0,0],
                    "emission": {"invisible": 1}}]})");
    ASSERT_EQ(scene.geometry.triangles.size(), 5u);
    EXPECT_GT(scene.origin.y, 4e6);
    const auto expectCorner = [&](std::size_t triangle, const glm::dvec3& place) {
        EXPECT_NEAR(glm::distance(corner(scene, triangle, 0), place), 0.0, 2e-6) << triangle;
    };
    expectCorner(0, kUtm);
    expectCorner(1, {512345.17, 4612345.125, 119});
    expectCorner(2, kUtm + glm::dvec3(0, 0, 0.5));
    expectCorner(3, {512345.5, 4612345.5, 125.25});
    EXPECT_NEAR(glm::distance(scene.origin + glm::dvec3(scene.camera.position),
                              glm::dvec3(512346.27, 4612346.25, 124.5)),
                0.0, 2e-6);
}

TEST_F(OriginTest, ATransformMayBringAFarMeshHome) {
    write("far.obj", triangleAt(kUtm));
    const LoadedScene scene = loadJson(R"({"duolux": 1, "objects": [{"mesh": "far.obj",
        "transform": [1,0,0,-512345.67, 0,1,0,-4612345.671, 0,0,1,-120.5, 0,0,0,1]}]})");
    EXPECT_EQ(scene.origin, glm::dvec3(0.0));
    EXPECT_NEAR(glm::length(corner(scene, 0, 0)), 0.0, 1e-6);
    EXPECT_THAT(textsOf(scene.warnings), Not(Contains(HasSubstr("far from the origin"))));
}

TEST_F(OriginTest, PlacesBeyondTheLimitOfFloatsAreMovedWithin) {
    write("far.obj", triangleAt({1e12, 1e12, 120}));
    const LoadedScene home = loadJson(R"({"duolux": 1, "objects": [{"mesh": "far.obj",
        "transform": [1,0,0,-1e12, 0,1,0,-1e12, 0,0,1,-120, 0,0,0,1]}]})");
    EXPECT_NEAR(glm::length(corner(home, 0, 0)), 0.0, 1e-6);
    const std::string away = R"({"duolux": 1, "objects": [{"mesh": "far.obj"}],
        "camera": {"position": [1000000002000, 1000000000000, 120], "target": [1e12, 1e12, 120]}, )";
    const LoadedScene there = loadJson(away + R"("film": {"width": 9}})");
    EXPECT_NEAR(glm::distance(there.camera.position, there.camera.target), 2000.0f, 1e-3f);
    EXPECT_EQ(
        errorOfJson(R"({"duolux": 1, "objects": [{"mesh": "far.obj"}], "camera": {"position": [0, 0, 0]}})"),
        "scene.json: camera.position: is too far from the scene; expected a distance of at most 1e+09");
    EXPECT_THAT(
        errorOfJson(R"({"duolux": 1, "objects": [{"mesh": "far.obj",
                    "transform": [1,0,0,1e20, 0,1,0,0, 0,0,1,0, 0,0,0,1]}]})"),
        HasSubstr("objects[0].transform[3]: is 1e+20; expected a number of at most 1e+18 in magnitude"));
    EXPECT_THAT(errorOfJson(away + R"("lights": [{"type": "rectangle", "origin": [1e12, 2e12, 0],
                    "edge1": [1, 0, 0], "edge2": [0, 1, 0], "emission": {"visible": 1}}]})"),
                HasSubstr("lights[0]: is too far from the rest of the scene"));
}

/// A landscape of 60 km with vertices every 3 km, as a survey writes it.
std::string landscape() {
    std::string text;
    for (int row = 0; row < 21; ++row) {
        for (int column = 0; column < 21; ++column)
            text += fmt::format("v {:.2f} {:.2f} {:.2f}\n", 300000.13 + 3000 * column,
                                5400000.37 + 3000 * row, 100.25 + 7 * ((row * column) % 5));
    }
    for (int at = 1; at < 420; ++at)
        if (at % 21 != 0) text += fmt::format("f {} {} {} {}\n", at, at + 1, at + 22, at + 21);
    return text;
}

TEST_F(OriginTest, ALandscapeOfUtmCoordinatesKeepsItsCentimetres) {
    const LoadedScene scene = loadObj(landscape());
    EXPECT_NE(scene.origin, glm::dvec3(0.0));
    EXPECT_NEAR(glm::distance(corner(scene, 0, 0), glm::dvec3(300000.13, 5400000.37, 100.25)), 0.0, 3e-3);
    EXPECT_THAT(textsOf(scene.warnings), Not(Contains(HasSubstr("single precision"))));
}

TEST_F(OriginTest, AStrayTriangleDoesNotCostAllOthersTheirDigits) {
    std::string pyramid;
    for (const glm::dvec3& offset : {glm::dvec3(0, 0, 0), glm::dvec3(7.3, 0, 0), glm::dvec3(7.3, 7.3, 0),
                                     glm::dvec3(0, 7.3, 0), glm::dvec3(3.7, 3.7, 4.4)}) {
        const glm::dvec3 place = kUtm + offset;
        pyramid += fmt::format("v {:.3f} {:.3f} {:.3f}\n", place.x, place.y, place.z);
    }
    pyramid += "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
    const LoadedScene scene = loadObj(pyramid + "v 0 0 0\nv 1.3 0 0\nv 0 1.3 0\nf 6 7 8\n");
    EXPECT_NEAR(glm::distance(corner(scene, 0, 0), kUtm), 0.0, 1e-3);
    EXPECT_NEAR(glm::distance(corner(scene, 1, 1), kUtm + glm::dvec3(7.3, 7.3, 0)), 0.0, 1e-3);
    EXPECT_THAT(textsOf(scene.warnings),
                Contains(HasSubstr("mesh.obj: single precision moves 2 vertices by up to 0.2")));
}

TEST_F(OriginTest, FineDetailFarApartLosesWithAWarning) {
    const LoadedScene scene = loadObj(triangleAt(kUtm) + "v 0.1 0 0\nv 1.3 0 0\nv 0.1 0.9 0\nf 4 5 6\n");
    EXPECT_THAT(textsOf(scene.warnings),
                Contains(HasSubstr("moves 3 vertices by up to 0.17; typical edges are 1.5 long")));
}

TEST_F(OriginTest, ObjectsFarApartWarnOfTheOneThatLoses) {
    write("far.obj", triangleAt(kUtm));
    write("near.obj", triangleAt({0.1, 0.2, 0.3}));
    const LoadedScene scene = loadJson(
        R"({"duolux": 1, "objects": [{"mesh": "near.obj"}, {"mesh": "far.obj"}, {"mesh": "far.obj"}]})");
    EXPECT_NEAR(glm::distance(corner(scene, 1, 0), kUtm), 0.0, 1e-4) << "the place of most triangles";
    EXPECT_THAT(textsOf(scene.warnings),
                Contains(HasSubstr("scene.json: objects[0]: single precision moves vertices by up to 0.2")));
    const LoadedScene together = loadJson(R"({"duolux": 1, "objects": [{"mesh": "far.obj"}]})");
    EXPECT_THAT(textsOf(together.warnings), Not(Contains(HasSubstr("single precision"))));
}

}  // namespace
}  // namespace duolux::test
