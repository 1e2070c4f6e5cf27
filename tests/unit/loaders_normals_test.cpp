#include <cmath>
#include <string>
#include <vector>

#include "tests/unit/scene_files.h"

namespace duolux::test {
namespace {

using Normals = std::vector<glm::vec3>;

class NormalsTest : public SceneFiles {
  protected:
    /// The normals at the corners of a triangle; empty: flat.
    static Normals normalsOf(const Geometry& geometry, std::size_t triangle) {
        if (geometry.normalIndices.empty()) return {};
        const glm::uvec3& indices = geometry.normalIndices[triangle];
        if (indices.x == Geometry::kNoNormal) return {};
        return {geometry.normals[indices.x], geometry.normals[indices.y], geometry.normals[indices.z]};
    }
};

TEST_F(NormalsTest, AreNormalised) {
    const Geometry geometry =
        loadObj("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 5\nvn 3 0 4\nvn 0 1e-30 0\nf 1//1 2//2 3//3\n").geometry;
    EXPECT_EQ(normalsOf(geometry, 0), (Normals{{0, 0, 1}, {0.6f, 0, 0.8f}, {0, 1, 0}}));
}

TEST_F(NormalsTest, ZeroOrMissingOnesMakeATriangleFlat) {
    const Geometry geometry = loadObj(
                                  "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 0 0 0\n"
                                  "f 1 2 3\nf 1//1 2//1 3//2\nf 1//1 2//1 3//1\nf 1//1 2//1 3\n")
                                  .geometry;
    EXPECT_TRUE(normalsOf(geometry, 0).empty());
    EXPECT_TRUE(normalsOf(geometry, 1).empty());
    EXPECT_EQ(normalsOf(geometry, 2).size(), 3u);
    EXPECT_TRUE(normalsOf(geometry, 3).empty());
}

TEST_F(NormalsTest, FollowTheCornersOfAPolygon) {
    const Geometry geometry =
        loadObj(
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 1 0 0\nvn 0 1 0\nvn 0 0 1\nvn -1 0 0\n"
            "f 1//1 2//2 3//3 4//4\n")
            .geometry;
    for (std::size_t i = 0; i < 2; ++i) {
        for (int corner = 0; corner < 3; ++corner) {
            EXPECT_EQ(geometry.normalIndices[i][corner], geometry.triangles[i][corner]);
        }
    }
}

/// Two squares that meet at a right angle in the edge from (0,0,0) to (0,1,0): one faces +z, the other -x.
constexpr std::string_view kFold =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 -1\nv 0 1 -1\n"
    "{}f 1 2 3 4\n{}f 1 4 6 5\n";

std::string fold(std::string_view first, std::string_view second) {
    std::string text(kFold);
    text.replace(text.find("{}"), 2, first);
    text.replace(text.find("{}"), 2, second);
    return text;
}

TEST_F(NormalsTest, SmoothingGroupAveragesOverTheEdge) {
    const Geometry geometry = loadObj(fold("s 1\n", "")).geometry;
    const float half = std::sqrt(0.5f);
    ASSERT_EQ(geometry.triangles.size(), 4u + 2u);
    for (std::size_t i = 0; i < 4; ++i) {
        const Normals normals = normalsOf(geometry, i);
        ASSERT_EQ(normals.size(), 3u) << i;
        for (int corner = 0; corner < 3; ++corner) {
            const glm::vec3 position = geometry.positions[geometry.triangles[i][corner]];
            // Each face contributes its whole right angle, whichever diagonal cuts it.
            const glm::vec3 own = i < 2 ? glm::vec3(0, 0, 1) : glm::vec3(-1, 0, 0);
            const bool onEdge = position.x == 0.0f && position.z == 0.0f;
            EXPECT_THAT(normals[static_cast<std::size_t>(corner)],
                        IsNear(onEdge ? glm::vec3(-half, 0, half) : own, 1e-6f));
        }
    }
    EXPECT_TRUE(normalsOf(geometry, 4).empty()) << "the lamp is flat";
}

TEST_F(NormalsTest, DifferentGroupsDoNotMix) {
    const Geometry geometry = loadObj(fold("s 1\n", "s 2\n")).geometry;
    for (std::size_t i = 0; i < 4; ++i) {
        for (const glm::vec3& normal : normalsOf(geometry, i)) {
            EXPECT_THAT(normal, IsNear(i < 2 ? glm::vec3(0, 0, 1) : glm::vec3(-1, 0, 0), 1e-6f));
        }
    }
}

TEST_F(NormalsTest, SmoothingOffIsFlat) {
    EXPECT_TRUE(loadObj(fold("", "")).geometry.normals.empty());
    for (const char* off : {"s off\n", "s 0\n"}) {
        const Geometry geometry = loadObj(fold("s 1\n", off)).geometry;
        EXPECT_EQ(normalsOf(geometry, 0).size(), 3u);
        EXPECT_TRUE(normalsOf(geometry, 2).empty());
    }
}

TEST_F(NormalsTest, GivenNormalsWinOverSmoothing) {
    const Geometry geometry =
        loadObj("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 1 0 0\ns 1\nf 1//1 2//1 3//1\nf 1 2 3\n").geometry;
    EXPECT_EQ(normalsOf(geometry, 0), Normals(3, glm::vec3(1, 0, 0)));
    EXPECT_EQ(normalsOf(geometry, 1), Normals(3, glm::vec3(0, 0, 1)));
}

TEST_F(NormalsTest, NormalsThatCancelLeaveTheTriangleFlat) {
    const Geometry geometry = loadObj("v 0 0 0\nv 1 0 0\nv 0 1 0\ns 1\nf 1 2 3\nf 3 2 1\n").geometry;
    EXPECT_TRUE(normalsOf(geometry, 0).empty());
    EXPECT_TRUE(normalsOf(geometry, 1).empty());
}

TEST_F(NormalsTest, MalformedSmoothingGroupIsAStrictError) {
    EXPECT_EQ(errorOfObj("s on\n" + std::string(kTriangleObj), Reading::kStrict),
              "mesh.obj: line 1: smoothing group \"on\"; expected a number or \"off\"");
}

}  // namespace
}  // namespace duolux::test
