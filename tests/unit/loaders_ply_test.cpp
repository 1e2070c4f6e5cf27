// Valid PLY files.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "host/base/error.h"
#include "tests/unit/ply_files.h"

namespace duolux::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST_F(PlyTest, IsASceneOfItsOwn) {
    const LoadedScene scene = load(write("mesh.ply", ascii(3, kThree, 1, "3 0 1 2\n")).filename().string());
    EXPECT_EQ(scene.content.triangles, 1u);
    ASSERT_FALSE(scene.materials.empty());
    EXPECT_EQ(scene.materials[0].name, "default");
    EXPECT_EQ(scene.materials[0].baseColor, glm::vec3(0.8f));
    EXPECT_EQ(scene.meshBytes, ascii(3, kThree, 1, "3 0 1 2\n").size());
}

TEST_F(PlyTest, IsAMeshOfAJsonScene) {
    write("mesh.ply", ascii(3, kThree, 1, "3 0 1 2\n"));
    const LoadedScene scene = loadJson(R"({"duolux": 1, "objects": [{"mesh": "mesh.ply"}, {"mesh": "mesh.ply",
        "transform": [2,0,0,0, 0,2,0,0, 0,0,2,1, 0,0,0,1]}],
        "materials": {"default": {"diffuse": [0.1, 0.2, 0.3]}}})");
    EXPECT_EQ(scene.content.triangles, 2u);
    EXPECT_EQ(scene.materials[0].baseColor, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_FLOAT_EQ(glm::length(areaVector(scene.geometry, 0)), 0.5f);
    EXPECT_FLOAT_EQ(glm::length(areaVector(scene.geometry, 1)), 2.0f);
}

TEST_F(PlyTest, PolygonsAreTriangulated) {
    // An L with six corners and area 3, and a square.
    const Geometry geometry =
        mesh(ascii(6, "0 0 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n", 2, "6 0 1 2 3 4 5\n4 0 1 3 5\n"))
            .geometry;
    ASSERT_EQ(geometry.triangles.size(), 6u);
    glm::vec3 area(0.0f);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_GT(areaVector(geometry, i).z, 0.0f);
        area += areaVector(geometry, i);
    }
    EXPECT_EQ(area, glm::vec3(0, 0, 3));
    EXPECT_THAT(geometry.materials, testing::Each(0u));
    EXPECT_TRUE(geometry.normals.empty() && geometry.normalIndices.empty());
}

TEST_F(PlyTest, TypesAndByteOrdersMeanTheSame) {
    const std::string elements =
        "comment by hand\nobj_info none\nelement vertex 4\nproperty float64 x\nproperty short flags\n"
        "property float32 y\nproperty int8 z\nproperty list uint16 int16 rest\n"
        "element face 2\nproperty uchar before\nproperty list {} {} vertex_index\nproperty double behind\n";
    struct Types {
        const char *count, *index;
        int countSize, indexSize;
    };
    for (const Types& types :
         {Types{"uchar", "int", 1, 4}, Types{"char", "uint8", 1, 1}, Types{"uint32", "ushort", 4, 2},
          Types{"int16", "int8", 2, 1}, Types{"int", "uint", 4, 4}}) {
        const std::string head = fmt::format(fmt::runtime(elements), types.count, types.index);
        const Mesh text = mesh(header("ascii", head) +
                               "0.1 -7 0.25 -3 2 5 6\n1e6 7 -1.5e-3 127 0\n-2 0 1 0 1 -1\n3 0 3 -128 0\n"
                               "1 3 0 1 2 0.5\n255 4 3 2 1 0 -0.5\n");
        ASSERT_EQ(text.geometry.triangles.size(), 3u);
        EXPECT_EQ(text.geometry.triangles[0], glm::uvec3(0, 1, 2));
        for (const bool bigEndian : {false, true}) {
            Bytes body(bigEndian);
            const auto vertex = [&](double x, int flags, float y, int z, std::vector<int> rest) {
                body.wide(x).integer(static_cast<std::uint64_t>(flags), 2).real(y);
                body.integer(static_cast<std::uint64_t>(z), 1).integer(rest.size(), 2);
                for (const int value : rest)
                    body.integer(static_cast<std::uint64_t>(value), 2);
            };
            vertex(0.1, -7, 0.25f, -3, {5, 6});
            vertex(1e6, 7, -1.5e-3f, 127, {});
            vertex(-2.0, 0, 1.0f, 0, {-1});
            vertex(3.0, 0, 3.0f, -128, {});
            const auto face = [&](int before, std::vector<unsigned> corners, double behind) {
                body.integer(static_cast<std::uint64_t>(before), 1).integer(corners.size(), types.countSize);
                for (const unsigned corner : corners)
                    body.integer(corner, types.indexSize);
                body.wide(behind);
            };
            face(1, {0, 1, 2}, 0.5);
            face(255, {3, 2, 1, 0}, -0.5);
            const Mesh binary = mesh(header(formatName(bigEndian), head) + body.text());
            EXPECT_EQ(binary.geometry.positions, text.geometry.positions) << types.index << bigEndian;
            EXPECT_EQ(binary.geometry.triangles, text.geometry.triangles) << types.index << bigEndian;
            EXPECT_EQ(binary.warnings, text.warnings);
        }
    }
}

TEST_F(PlyTest, NormalsAreThoseOfTheVertices) {
    const std::string elements = "element vertex 4\n" + kCoordinates +
                                 "property float nx\nproperty float ny\nproperty float nz\n"
                                 "element face 2\nproperty list uchar int vertex_indices\n";
    const std::string body = "0 0 0 0 0 5\n1 0 0 3 0 4\n0 1 0 0 -1 0\n1 1 0 0 0 0\n3 0 1 2\n3 1 3 2\n";
    const Mesh read = mesh(header("ascii", elements) + body);
    const Geometry& geometry = read.geometry;
    ASSERT_EQ(geometry.normalIndices.size(), 2u);
    const glm::uvec3 indices = geometry.normalIndices[0];
    EXPECT_THAT(geometry.normals[indices.x], IsNear(glm::vec3(0, 0, 1), 1e-6f));
    EXPECT_THAT(geometry.normals[indices.y], IsNear(glm::vec3(0.6f, 0, 0.8f), 1e-6f));
    EXPECT_THAT(geometry.normals[indices.z], IsNear(glm::vec3(0, -1, 0), 1e-6f));
    EXPECT_EQ(geometry.normalIndices[1].x, Geometry::kNoNormal) << "one of its corners has no direction";
    EXPECT_THAT(warningsOf(header("ascii", elements) + body),
                ElementsAre(HasSubstr("(vertex 4 of 4): a normal that is 0 or not finite: the faces")));
}

/// A triangle whose vertices have further properties of one type.
std::string withProperties(const std::string& type, const std::vector<std::string>& names,
                           const std::array<std::string, 3>& values) {
    std::string elements = "element vertex 3\n" + kCoordinates;
    for (const std::string& name : names)
        elements += "property " + type + " " + name + "\n";
    return header("ascii", elements + "element face 1\nproperty list uchar int vertex_indices\n") + "0 0 0 " +
           values[0] + "\n1 0 0 " + values[1] + "\n0 1 0 " + values[2] + "\n3 0 1 2\n";
}

TEST_F(PlyTest, ColoursAreEncodedBySrgb) {
    // Values of the sRGB transfer function from tables.
    const glm::vec3 first(1.0f, 0.0f, 0.2140411f), second(0.0003035f, 0.0508761f, 0.6038274f);
    const std::array<std::string, 3> bytes{"255 0 127.5", "1 63.75 204", "0 0 0"};
    const std::array<std::string, 3> reals{"1 0 0.5", "0.00392157 0.25 0.8", "0 0 0"};
    const std::array<std::string, 3> words{"65535 0 32767.5", "257 16383.75 52428", "0 0 0"};
    for (const auto& [type, values] :
         {std::pair("uchar", bytes), std::pair("float", reals), std::pair("uint16", words)}) {
        const Mesh read = mesh(withProperties(type, {"red", "green", "blue"}, values));
        ASSERT_EQ(read.geometry.colours.size(), 3u) << type;
        EXPECT_THAT(read.geometry.colours[0], IsNear(first, 1e-6f)) << type;
        EXPECT_THAT(read.geometry.colours[1], IsNear(second, 1e-6f)) << type;
        EXPECT_EQ(read.geometry.colours[2], glm::vec3(0.0f));
        EXPECT_EQ(read.materials[0].baseColor, glm::vec3(1.0f));
        EXPECT_THAT(read.warnings, IsEmpty());
    }
    const std::array<std::string, 3> one{"0 0 255", "0 0 0", "0 0 0"};
    EXPECT_EQ(mesh(withProperties("uchar", {"diffuse_red", "diffuse_green", "diffuse_blue"}, one))
                  .geometry.colours[0],
              glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh(withProperties("uchar", {"b", "g", "r"}, one)).geometry.colours[0], glm::vec3(1, 0, 0));
}

TEST_F(PlyTest, ColoursThatAreNoneAreWarnings) {
    const auto warnings = [&](const std::vector<std::string>& names,
                              const std::array<std::string, 3>& values) {
        return warningsOf(withProperties("float", names, values));
    };
    EXPECT_THAT(
        warnings({"red", "green", "blue"}, {"1.5 0 0", "0 nan 0", "1 -1 0"}),
        ElementsAre(
            "mesh.ply: line 13 (vertex 1 of 3): a colour that is not between 0 and 1 (and 2 more): clamped"));
    EXPECT_THAT(warnings({"red", "green"}, {"0 0", "0 0", "0 0"}),
                ElementsAre("mesh.ply: not supported and ignored: red of vertex, green of vertex"));
    const Geometry clamped =
        mesh(withProperties("float", {"red", "green", "blue"}, {"1.5 0 0", "0 nan 0", "1 -1 0"})).geometry;
    EXPECT_THAT(clamped.colours, ElementsAre(glm::vec3(1, 0, 0), glm::vec3(0), glm::vec3(1, 0, 0)));
}

TEST_F(PlyTest, AlphaMattersIfSomeVertexIsNotOpaque) {
    const std::vector<std::string> names{"red", "green", "blue", "alpha"};
    const Mesh blended = mesh(withProperties("uchar", names, {"0 0 0 255", "0 0 0 51", "0 0 0 0"}));
    EXPECT_THAT(blended.geometry.alphas, ElementsAre(1.0f, 0.2f, 0.0f));
    EXPECT_EQ(blended.materials[0].alpha, (Alpha{AlphaMode::kBlend, 1.0f, 0.5f}));
    EXPECT_THAT(blended.warnings, IsEmpty());
    const Mesh real = mesh(withProperties("float", names, {"0 0 0 1", "0 0 0 0.25", "0 0 0 7"}));
    EXPECT_THAT(real.geometry.alphas, ElementsAre(1.0f, 0.25f, 1.0f)) << "clamped";
    EXPECT_THAT(real.warnings,
                ElementsAre(HasSubstr("(vertex 3 of 3): a colour that is not between 0 and 1")));
    const Mesh opaque = mesh(withProperties("uchar", names, {"0 0 0 255", "9 9 9 255", "0 0 0 255"}));
    EXPECT_THAT(opaque.geometry.alphas, IsEmpty());
    EXPECT_EQ(opaque.materials[0].alpha, Alpha());
    const Mesh empty = mesh(withProperties("uchar", names, {"0 0 0 0", "9 9 9 0", "0 0 0 0"}));
    EXPECT_EQ(empty.materials[0].alpha, Alpha());
    EXPECT_THAT(empty.warnings, ElementsAre(HasSubstr("all vertices have alpha 0: alpha is ignored")));
}

TEST_F(PlyTest, TextureCoordinatesOfVerticesPointDownTheImage) {
    for (const auto& [u, v] :
         {std::pair("s", "t"), std::pair("u", "v"), std::pair("texture_u", "texture_v")}) {
        const Geometry geometry = mesh(withProperties("float", {v, u}, {"0 0.5", "0.25 2", "1 0"})).geometry;
        EXPECT_THAT(geometry.uvs,
                    ElementsAre(glm::vec2(0.5f, 1.0f), glm::vec2(2.0f, 0.75f), glm::vec2(0, 0)));
        EXPECT_THAT(geometry.uvIndices, ElementsAre(glm::uvec3(0, 1, 2)));
    }
    const Mesh bad = mesh(withProperties("float", {"s", "t"}, {"0 0", "nan 0", "1 0"}));
    EXPECT_THAT(bad.geometry.uvIndices, testing::Each(glm::uvec3(Geometry::kNoUv)));
    EXPECT_THAT(bad.warnings,
                ElementsAre(HasSubstr("(vertex 2 of 3): a texture coordinate that is not finite")));
}

TEST_F(PlyTest, TexturesAsMeshLabWritesThem) {
    write("Wood.png", "-");
    const std::string text =
        header("ascii", "comment VCGLIB generated\ncomment TextureFile wood.png\nelement vertex 4\n" +
                            kCoordinates +
                            "element face 3\nproperty list uchar float texcoord\nproperty int texnumber\n"
                            "property list uchar int vertex_indices\n") +
        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n8 0 0 1 0 1 1 0 1 0 4 0 1 2 3\n4 0 0 1 0 0 2 0 1\n6 0.5 0.5 1 1 0 0 0 3 "
        "0 1 2\n";
    const Mesh read = mesh(text);
    const Geometry& geometry = read.geometry;
    ASSERT_EQ(geometry.triangles.size(), 3u);
    for (std::size_t i = 0; i < 2; ++i) {
        for (int k = 0; k < 3; ++k) {
            const glm::vec3& place = geometry.positions[geometry.triangles[i][k]];
            EXPECT_EQ(geometry.uvs[geometry.uvIndices[i][k]], glm::vec2(place.x, 1.0f - place.y));
        }
    }
    EXPECT_EQ(geometry.uvs[geometry.uvIndices[2].x], glm::vec2(0.5f)) << "the face before it is left out";
    ASSERT_EQ(read.materials[0].textures.size(), 1u);
    EXPECT_EQ(read.materials[0].textures[0].input, MaterialInput::kBaseColor);
    EXPECT_EQ(read.materials[0].textures[0].texture.colourSpace, ColourSpace::kSrgb);
    EXPECT_EQ(read.materials[0].baseColor, glm::vec3(1.0f));
    ASSERT_EQ(read.images.size(), 1u);
    EXPECT_EQ(read.images[0].path, folder_ / "Wood.png");
    EXPECT_THAT(read.files, testing::Contains(folder_ / "Wood.png"));
    EXPECT_THAT(read.warnings, ElementsAre(HasSubstr("a face of fewer than 3 corners: left out")));

    std::string wrong = text;
    wrong.replace(wrong.find("6 0.5"), 5, "4 0.5");
    wrong.replace(wrong.find(" 1 1 0 0 0 3"), 12, " 1 1 0 3");
    const Mesh incomplete = mesh(wrong);
    EXPECT_EQ(incomplete.geometry.uvIndices[2].x, Geometry::kNoUv);
    EXPECT_THAT(incomplete.warnings,
                testing::Contains(HasSubstr("(face 3 of 3): a face whose texture coordinates are")));
}

TEST_F(PlyTest, ColoursStayWithTheirVertices) {
    write("red.ply", withProperties("uchar", {"red", "green", "blue"}, {"255 0 0", "255 0 0", "255 0 0"}));
    write("grey.obj", kTriangleObj);
    const std::string red = R"({"mesh": "red.ply"})", grey = R"({"mesh": "grey.obj"})";
    for (const std::string& objects : {red + ", " + grey, grey + ", " + red + ", " + red}) {
        const LoadedScene scene = loadJson(R"({"duolux": 1, "objects": [)" + objects + "]}");
        const Geometry& geometry = scene.geometry;
        ASSERT_EQ(geometry.colours.size(), geometry.positions.size()) << "the added lamp has colours, too";
        for (std::size_t i = 0; i < geometry.triangles.size(); ++i) {
            const bool isRed =
                i < scene.content.triangles && scene.materials[geometry.materials[i]].baseColor.x == 1.0f;
            for (int k = 0; k < 3; ++k)
                EXPECT_EQ(geometry.colours[geometry.triangles[i][k]],
                          isRed ? glm::vec3(1, 0, 0) : glm::vec3(1));
        }
        LoadedScene without = scene;
        removeLamp(without);
        EXPECT_EQ(without.geometry.colours.size(), without.geometry.positions.size());
    }
}

TEST_F(PlyTest, OtherElementsAndTheirOrderDoNotMatter) {
    const Mesh read = mesh(header("ascii",
                                  "element camera 2\nproperty list uchar float view\nproperty int id\n"
                                  "element face 1\nproperty list int int corners\nelement empty 4294967295\n"
                                  "element vertex 3\n" +
                                      kCoordinates + "element edge 9\nproperty int vertex1\n") +
                           "\n2 0.5 -1 7\n0 8\n\n3 0 1 2\n" + kThree);
    EXPECT_THAT(read.geometry.triangles, ElementsAre(glm::uvec3(0, 1, 2)));
    ASSERT_EQ(read.warnings.size(), 1u);
    EXPECT_THAT(read.warnings[0],
                HasSubstr(": not supported and ignored: element camera, element empty, element edge"));
}

TEST_F(PlyTest, LinesMayEndAsOnAnySystem) {
    const auto withEnds = [](std::string text, const std::string& end) {
        for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + end.size()))
            text.replace(at, 1, end);
        return text;
    };
    const std::string text = ascii(3, kThree, 1, "3 0 1 2\n");
    for (const char* const end : {"\n", "\r\n", "\r"})
        EXPECT_EQ(mesh(withEnds(text, end)).geometry.triangles.size(), 1u);
    EXPECT_EQ(mesh(text.substr(0, text.size() - 1)).geometry.triangles.size(), 1u);

    // The first byte of the body is a line feed, which must not be taken for the end of the header.
    const std::string head =
        header("binary_little_endian",
               "element face 1\nproperty char mark\nproperty list uchar uchar vertex_indices\n"
               "element vertex 3\n" +
                   kCoordinates);
    Bytes body(false);
    body.integer('\n', 1).integer(3, 1).integer(0, 1).integer(1, 1).integer(2, 1);
    for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f})
        body.real(value);
    for (const char* const end : {"\n", "\r\n", "\r"})
        EXPECT_EQ(mesh(withEnds(head, end) + body.text()).geometry.positions[1], glm::vec3(1, 0, 0));
}

TEST_F(PlyTest, FarCoordinatesAreRelativeToAnOrigin) {
    const std::string text =
        header("ascii",
               "element vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
               "element face 1\nproperty list uchar int vertex_indices\n") +
        "512345.125 4612345.125 120\n512346.5 4612345.125 120\n512345.125 4612346 121\n"
        "3 0 1 2\n";
    const Mesh read = mesh(text);
    EXPECT_NE(read.origin, glm::dvec3(0.0));
    EXPECT_EQ(read.origin + glm::dvec3(read.geometry.positions[1]), glm::dvec3(512346.5, 4612345.125, 120));
}

}  // namespace
}  // namespace duolux::test
