// STL files. The bytes of binary ones are written one by one with shifts, not with the loader's functions.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "host/loaders/stl.h"
#include "tests/unit/scene_files.h"

namespace duolux::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Facet {
    std::array<glm::vec3, 3> corners;
    std::uint16_t attribute = 0;
    glm::vec3 normal{0.0f};
};

std::string binary(const std::vector<Facet>& facets, std::string header = "", int stated = -1) {
    const auto append = [](std::string& to, std::uint32_t value, int size) {
        for (int i = 0; i < size; ++i)
            to.push_back(static_cast<char>(value >> (8 * i) & 0xff));
    };
    std::string bytes = std::move(header);
    bytes.resize(80, '\0');
    append(bytes, stated < 0 ? static_cast<std::uint32_t>(facets.size()) : static_cast<std::uint32_t>(stated),
           4);
    for (const auto& [corners, attribute, normal] : facets) {
        for (const glm::vec3& vector : {normal, corners[0], corners[1], corners[2]}) {
            for (int i = 0; i < 3; ++i)
                append(bytes, std::bit_cast<std::uint32_t>(vector[i]), 4);
        }
        append(bytes, attribute, 2);
    }
    return bytes;
}

std::string text(const std::vector<Facet>& facets) {
    std::string lines = "solid part\n";
    for (const auto& [corners, attribute, normal] : facets) {
        lines += fmt::format("  facet normal {} {} {}\n    outer loop\n", normal.x, normal.y, normal.z);
        for (const glm::vec3& corner : corners)
            lines += fmt::format("      vertex {} {} {}\n", corner.x, corner.y, corner.z);
        lines += "    endloop\n  endfacet\n";
    }
    return lines + "endsolid part\n";
}

/// A roof of two squares along the y axis, whose normals differ by `degrees`; four facets.
std::vector<Facet> roof(float degrees) {
    const float half = glm::radians(degrees) / 2.0f, x = std::cos(half), z = -std::sin(half);
    const glm::vec3 ridge0(0, 0, 0), ridge1(0, 1, 0), left0(-x, 0, z), left1(-x, 1, z), right0(x, 0, z),
        right1(x, 1, z);
    return {{{left0, ridge0, ridge1}},
            {{left0, ridge1, left1}},
            {{ridge0, right0, right1}},
            {{ridge0, right1, ridge1}}};
}

const Facet kFlat{{glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)}};
const Facet kOther{{glm::vec3(1, 0, 0), glm::vec3(1, 1, 0), glm::vec3(0, 1, 0)}};

class StlTest : public SceneFiles {
  protected:
    Mesh mesh(const std::string& bytes, Reading reading = Reading::kLenient) const {
        MaterialFiles files(reading);
        Mesh mesh = loadStl(write("mesh.stl", bytes), files);
        for (std::string& warning : mesh.warnings)
            warning.erase(0, folder_.string().size() + 1);
        return mesh;
    }
    std::string errorOfStl(const std::string& bytes, Reading reading = Reading::kLenient) const {
        write("mesh.stl", bytes);
        return errorOf("mesh.stl", reading);
    }
    /// The shading normal of a triangle at the vertex that is at `place`.
    static glm::vec3 normalAt(const Geometry& geometry, std::size_t triangle, const glm::vec3& place) {
        for (int k = 0; k < 3; ++k) {
            if (geometry.positions[geometry.triangles[triangle][k]] == place)
                return geometry.normals.at(geometry.normalIndices[triangle][k]);
        }
        throw std::out_of_range("no such corner");
    }
};

TEST_F(StlTest, TextAndBinaryMeanTheSame) {
    const Mesh fromText = mesh(text({kFlat, kOther})), fromBinary = mesh(binary({kFlat, kOther}));
    EXPECT_EQ(fromText.geometry.positions, fromBinary.geometry.positions);
    EXPECT_EQ(fromText.geometry.triangles, fromBinary.geometry.triangles);
    ASSERT_EQ(fromText.geometry.triangles.size(), 2u);
    EXPECT_EQ(fromText.geometry.positions.size(), 4u) << "equal positions are one vertex";
    EXPECT_EQ(fromText.geometry.positions[fromText.geometry.triangles[1].y], glm::vec3(1, 1, 0));
    EXPECT_EQ(areaVector(fromText.geometry, 0), glm::vec3(0, 0, 0.5f));
    EXPECT_THAT(fromText.warnings, IsEmpty());
    EXPECT_THAT(fromBinary.warnings, IsEmpty());
    ASSERT_EQ(fromText.materials.size(), 1u);
    EXPECT_EQ(fromText.materials[0].name, "default");
    EXPECT_EQ(fromText.materials[0].baseColor, glm::vec3(0.8f));
    EXPECT_EQ(fromBinary.bytes, 84u + 2u * 50u);
}

TEST_F(StlTest, ZerosOfEitherSignAreEqual) {
    Facet other = kOther;
    other.corners[0] = glm::vec3(1.0f, -0.0f, -0.0f);
    EXPECT_EQ(mesh(binary({kFlat, other})).geometry.positions.size(), 4u);
}

TEST_F(StlTest, TheSizeTellsBinaryFromText) {
    const Mesh read = mesh(binary({kFlat}, "solid facet normal 0 0 1 outer loop vertex"));
    EXPECT_EQ(read.geometry.triangles.size(), 1u);
    EXPECT_THAT(read.warnings, IsEmpty());
    EXPECT_THAT(mesh(binary({kFlat, kOther}, "solid x", 1)).warnings,
                ElementsAre(HasSubstr(
                    "mesh.stl: the header says 1 facet, the file has room for 2: the rest is ignored")));
    EXPECT_EQ(mesh(binary({kFlat, kOther}, "", 0)).geometry.triangles.size(), 2u) << "written as a stream";
    EXPECT_EQ(
        errorOfStl(binary({kFlat, kOther}, "", 3)),
        "mesh.stl: the header says 3 facets, the file has room for 2; expected 84 bytes and 50 for each "
        "facet");
    EXPECT_THAT(errorOfStl(binary({kFlat, kOther}, "", 1), Reading::kStrict), HasSubstr("says 1 facet,"));
    EXPECT_EQ(errorOfStl("nothing"),
              "mesh.stl: is 7 bytes; expected a text that begins with \"solid\", or at "
              "least 84 bytes");
    EXPECT_EQ(errorOfStl(""),
              "mesh.stl: is 0 bytes; expected a text that begins with \"solid\", or at least 84 "
              "bytes");
    EXPECT_THAT(errorOfStl("ply\nformat ascii 1.0\n"), HasSubstr("mesh.stl: is PLY; expected an STL file"));
}

TEST_F(StlTest, TextsOfOtherPrograms) {
    const std::string upper =
        "\n  SOLID\tname with facet\r\nFACET NORMAL 0 0 1\r\nOUTER LOOP\r\nVERTEX 0 0 0\r\nVERTEX +1e0 0 "
        "0\r\n"
        "VERTEX 0 1. 0\r\nENDLOOP\r\nENDFACET\r\nENDSOLID\r\nsolid\nendsolid\n";
    EXPECT_EQ(mesh(upper).geometry.triangles.size(), 1u);
    EXPECT_THAT(mesh(upper).warnings, IsEmpty());
    const std::string line =
        "solid\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop "
        "endfacet endsolid";
    EXPECT_EQ(mesh(line).geometry.triangles.size(), 1u);
    const std::string odd =
        "solid\nfacet normal 0 x 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
        "facet\nvertex 0 0 0\nvertex 1 0 0\nendfacet\ncolor 1 0 0\n";
    EXPECT_THAT(
        mesh(odd).warnings,
        ElementsAre("mesh.stl: line 9: a facet that does not have three vertices: left out",
                    "mesh.stl: line 2: a normal that is not three numbers: ignored",
                    "mesh.stl: line 13: not a word of the format: the rest of the line is ignored",
                    "mesh.stl: line 13: the file ends without \"endsolid\": read as if it were complete"));
    EXPECT_EQ(errorOfStl(odd, Reading::kStrict),
              "mesh.stl: line 2: the normal is not three numbers; expected \"normal x y z\"");
}

TEST_F(StlTest, ErrorsNameThePlace) {
    EXPECT_EQ(errorOfStl("solid\nfacet\nvertex 0 0\n"),
              "mesh.stl: line 3: 2 numbers; expected \"vertex x y z\"");
    EXPECT_EQ(errorOfStl("solid\nfacet\nvertex 0 nan 0\n"),
              "mesh.stl: line 3: a coordinate is not finite; expected \"vertex x y z\"");
    EXPECT_EQ(errorOfStl("solid\nvertex 0 0 0\n"),
              "mesh.stl: line 2: a vertex outside of a facet; expected \"facet\" first");
    EXPECT_EQ(errorOfStl("solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\n"),
              "mesh.stl: line 4: the file ends within a facet; expected \"endfacet\"");
    EXPECT_EQ(errorOfStl("solid x\nendsolid x\n"),
              "mesh.stl: has no facets; expected at least one of three vertices");
    Facet bad = kFlat;
    bad.corners[1].y = std::numeric_limits<float>::infinity();
    EXPECT_EQ(errorOfStl(binary({kFlat, bad})),
              "mesh.stl: facet 2 of 2: a coordinate is not finite; expected finite coordinates");
    bad.corners[1].y = 1e30f;
    EXPECT_THAT(errorOfStl(binary({kFlat, bad})),
                HasSubstr("mesh.stl: facet 2 of 2: a coordinate is too large; expected at most 1e+09"));
}

TEST_F(StlTest, NormalsAreSmoothAcrossFlatEdgesOnly) {
    const Geometry smooth = mesh(binary(roof(28.0f))).geometry;
    const glm::vec3 ridge(0, 0, 0);
    for (std::size_t triangle : {0u, 2u, 3u})
        EXPECT_THAT(normalAt(smooth, triangle, ridge), IsNear(glm::vec3(0, 0, 1), 0.03f)) << triangle;
    EXPECT_EQ(normalAt(smooth, 0, ridge), normalAt(smooth, 3, ridge)) << "both sides share a normal";

    // 32 degrees: the normal of each side, also at the ridge.
    const Geometry sharp = mesh(binary(roof(32.0f))).geometry;
    const float half = glm::radians(16.0f);
    EXPECT_THAT(normalAt(sharp, 0, ridge), IsNear(glm::vec3(-std::sin(half), 0, std::cos(half)), 1e-6f));
    EXPECT_THAT(normalAt(sharp, 3, ridge), IsNear(glm::vec3(std::sin(half), 0, std::cos(half)), 1e-6f));
    EXPECT_TRUE(mesh(binary({kFlat})).geometry.normalIndices.empty()) << "a triangle alone is flat";
}

TEST_F(StlTest, NormalsAreWeightedByAngles) {
    // Around the tip of a shallow pyramid over a square, one side of which is cut in two: as without the cut.
    const glm::vec3 tip(0, 0, 0.2f), a(-1, -1, 0), b(1, -1, 0), c(1, 1, 0), d(-1, 1, 0), cut(0, -1, 0);
    const Geometry geometry =
        mesh(binary({{{a, cut, tip}}, {{cut, b, tip}}, {{b, c, tip}}, {{c, d, tip}}, {{d, a, tip}}}))
            .geometry;
    for (std::size_t i = 0; i < 5; ++i)
        EXPECT_THAT(normalAt(geometry, i, tip), IsNear(glm::vec3(0, 0, 1), 1e-6f));
}

TEST_F(StlTest, FacetNormalsAreOnlyCompared) {
    Facet contrary = kFlat;
    contrary.normal = glm::vec3(0, 0, -1);
    Facet agreeing = kFlat;
    agreeing.normal = glm::vec3(0, 0, 1);
    const Mesh read = mesh(binary({contrary, contrary, agreeing, kOther}));
    EXPECT_EQ(areaVector(read.geometry, 0).z, 0.5f) << "the order of the corners counts";
    EXPECT_THAT(read.warnings, ElementsAre("mesh.stl: the normals of 2 of 4 facets contradict the order of "
                                           "their vertices: the order is used"));
    EXPECT_THAT(mesh(binary({contrary, agreeing})).warnings, IsEmpty()) << "half of them is not most";
}

TEST_F(StlTest, ColoursOfFacets) {
    const auto facet = [](std::uint16_t attribute) { return Facet{kFlat.corners, attribute}; };
    const auto colours = [](const Mesh& mesh) {
        std::vector<glm::vec3> perFacet;
        for (const std::uint32_t material : mesh.geometry.materials)
            perFacet.push_back(mesh.materials[material].baseColor);
        return perFacet;
    };
    const glm::vec3 grey(0.8f), red(1, 0, 0), blue(0, 0, 1);
    // 16 of 31 is 132 of 255, whose linear value by the sRGB table is 0.2307.
    const Mesh viscam = mesh(binary({facet(0x8000 | 31 << 10), facet(0), facet(0x8000 | 31),
                                     facet(0x8000 | 31), facet(0x8000 | 16 << 5)}));
    ASSERT_EQ(viscam.geometry.materials.size(), 5u);
    EXPECT_EQ(colours(viscam)[0], red);
    EXPECT_EQ(colours(viscam)[1], grey);
    EXPECT_EQ(colours(viscam)[2], blue);
    EXPECT_THAT(colours(viscam)[4], IsNear(glm::vec3(0, 0.2307f, 0), 1e-4f));
    EXPECT_EQ(viscam.materials.size(), 4u);
    EXPECT_EQ(viscam.materials[0].name, "#ff0000");
    EXPECT_THAT(viscam.warnings, IsEmpty());

    const std::string header("COLOR=\x00\xff\x00\xff,MATERIAL=", 20);
    const Mesh magics = mesh(binary({facet(31), facet(0x8000), facet(31 << 10)}, header));
    EXPECT_THAT(colours(magics), ElementsAre(red, glm::vec3(0, 1, 0), blue));
    EXPECT_THAT(magics.warnings, ElementsAre(HasSubstr("MATERIAL= in the header is not supported")));

    EXPECT_THAT(colours(mesh(binary({facet(0xffff)}, header))), ElementsAre(glm::vec3(0, 1, 0)));

    const Mesh junk = mesh(binary({facet(5), facet(0)}));
    EXPECT_THAT(colours(junk), ElementsAre(grey, grey));
    EXPECT_THAT(junk.warnings, ElementsAre(HasSubstr("1 of 2 facets have attributes that are no colours")));
    EXPECT_THAT(colours(mesh(binary({facet(0xffff), facet(0xffff)}))), ElementsAre(grey, grey));
}

TEST_F(StlTest, IsViewedWithZUp) {
    write("mesh.stl", binary(roof(60.0f)));
    EXPECT_EQ(load("mesh.stl").camera.up, glm::vec3(0, 0, 1));
    EXPECT_GT(load("mesh.stl").camera.position.z, 0.0f) << "from above";
    write("mesh.obj", kTriangleObj);
    EXPECT_EQ(load("mesh.obj").camera.up, glm::vec3(0, 1, 0));
    EXPECT_EQ(loadJson(R"({"duolux": 1, "objects": [{"mesh": "mesh.stl"}]})").camera.up, glm::vec3(0, 1, 0));
}

TEST_F(StlTest, FarCoordinatesKeepTheirPrecision) {
    const Mesh read = mesh(
        "solid\nfacet\nvertex 5000000.25 100 7\nvertex 5000001.5 100 7\nvertex 5000000.25 "
        "101.125 7\nendfacet\nendsolid\n");
    EXPECT_NE(read.origin, glm::dvec3(0.0));
    EXPECT_FLOAT_EQ(areaVector(read.geometry, 0).z, 0.5f * 1.25f * 1.125f);
}

}  // namespace
}  // namespace duolux::test
