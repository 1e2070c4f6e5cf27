// PLY files with errors.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "host/base/error.h"
#include "tests/unit/ply_files.h"

namespace duolux::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST_F(PlyTest, HarmlessErrorsAreOneWarningEach) {
    const auto triangles = [&](const std::string& text) { return mesh(text).geometry.triangles.size(); };
    const std::string shortFaces = ascii(3, kThree, 3, "2 0 1\n3 0 1 2\n0\n");
    EXPECT_EQ(triangles(shortFaces), 1u);
    EXPECT_THAT(
        warningsOf(shortFaces),
        ElementsAre(
            "mesh.ply: line 13 (face 1 of 3): a face of fewer than 3 corners (and 1 more): left out"));
    const std::string badFaces = ascii(3, kThree, 3, "3 0 1 2\n3 0 1 3\n3 -1 0 1\n");
    EXPECT_EQ(triangles(badFaces), 1u);
    EXPECT_THAT(warningsOf(badFaces),
                ElementsAre("mesh.ply: line 14 (face 2 of 3): a face with a vertex that is not "
                            "in the file (and 1 more): left out"));
    EXPECT_THAT(
        warningsOf(ascii(4, kThree + "nan 0 0\n", 1, "3 0 1 2\n")),
        ElementsAre("mesh.ply: vertex 4 of 4: a vertex that is not finite or too large: no face uses it"));
    EXPECT_THAT(
        warningsOf(ascii(4, kThree + "1e30 0 0\n", 1, "3 0 1 2\n")),
        ElementsAre("mesh.ply: vertex 4 of 4: a vertex that is not finite or too large: no face uses it"));
    EXPECT_THAT(warningsOf(ascii(3, "0 0 0 9\n1 0 0\n0 1 0 9 9\n", 1, "3 0 1 2\n")),
                ElementsAre("mesh.ply: 2 lines have more numbers than the header says: ignored"));
    std::string texture = ascii(3, kThree, 1, "3 0 1 2\n");
    texture.insert(texture.find("element"), "comment TextureFile wood.png\nobj_comment no\n");
    EXPECT_THAT(warningsOf(texture),
                ElementsAre("mesh.ply: there is no texture \"wood.png\": the material is without it",
                            "mesh.ply: \"obj_comment\" in the header is unknown: ignored"));
    EXPECT_THAT(warningsOf(ascii(3, kThree, 1, "3 0 1 2\n")), IsEmpty());

    EXPECT_EQ(errorOfPly(badFaces, Reading::kStrict),
              "mesh.ply: line 14 (face 2 of 3): vertex index 3 is out of range; expected 0 to 2");
    EXPECT_EQ(errorOfPly(shortFaces, Reading::kStrict),
              "mesh.ply: line 13 (face 1 of 3): 2 corners; expected at least 3");
}

TEST_F(PlyTest, ErrorsNameThePlace) {
    const auto expectError = [&](const std::string& text, const std::string& error) {
        EXPECT_EQ(errorOfPly(text), "mesh.ply: " + error);
    };
    const std::string good = ascii(3, kThree, 1, "3 0 1 2\n");
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        return text.replace(text.find(from), from.size(), to);
    };
    expectError("", "line 1: does not begin with \"ply\"; expected a PLY file");
    expectError("plywood\n", "line 1: does not begin with \"ply\"; expected a PLY file");
    expectError("v 0 0 0\n", "line 1: does not begin with \"ply\"; expected a PLY file");
    expectError(std::string("PK\x03\x04..."), "is a zip archive; expected a PLY file");
    expectError("ply\nformat ascii 1.0\n", "line 2: the header ends here; expected \"end_header\"");
    expectError(with("format ascii 1.0\n", ""),
                "line 8: the header has no format; expected \"format ascii 1.0\" or a binary one");
    expectError(with("ascii", "text"),
                "line 2: unknown format \"text\"; expected ascii, binary_little_endian or binary_big_endian");
    expectError(with("vertex 3", "vertex -3"),
                "line 3: \"-3\" is not a count; expected \"element NAME COUNT\"");
    expectError(with("vertex 3", "vertex 99999999999999999999"),
                "line 3: \"99999999999999999999\" is not a count; expected \"element NAME COUNT\"");
    expectError(
        with("float y", "real y"),
        "line 5: unknown type \"real\"; expected char, uchar, short, ushort, int, uint, float or double");
    expectError(with("float y", "float"),
                "line 5: a property without a name; expected \"property TYPE NAME\"");
    expectError(with("list uchar", "list float"),
                "line 8: the length of a list is not an integer; expected an integer type");
    expectError(with("element face 1", "element vertex 1"),
                "line 7: element \"vertex\" is defined again; expected names that differ");
    expectError(with("element vertex 3\n", ""),
                "line 3: a property before any element; expected \"element NAME COUNT\"");
    expectError(with("float y", "float w"),
                "element vertex: has no coordinates; expected the properties x, y and z, which are no lists");
    expectError(with("float y", "list uchar float y"),
                "element vertex: has no coordinates; expected the properties x, y and z, which are no lists");
    expectError(
        with("list uchar int", "int"),
        "element face: has no corners; expected a property such as \"list uchar int vertex_indices\"");
    expectError(
        with("element face", "element strip"),
        "has no element \"face\"; expected a mesh; point clouds and triangle strips are not supported");
    expectError(with("vertex 3", "vertex 4294967295"),
                "element vertex: is too large; expected fewer than 2^31 vertices and faces");
    expectError(with("vertex 3", "vertex 2000000000"),
                "element vertex: the file holds at most 4; expected 2000000000, as the header says");
    expectError(with("vertex 3", "vertex 4"),
                "line 14 (face 1 of 1): the file ends here; expected 1, as the header says");
    expectError(with("face 1", "face 3"),
                "line 14 (face 2 of 3): the file ends here; expected 3, as the header says");
    expectError(with("3 0 1 2", "3 0 1"),
                "line 13 (face 1 of 1): the line has too few numbers; expected a line for each item");
    expectError(with("3 0 1 2", "4294967295 0 1 2"),
                "line 13 (face 1 of 1): a list of 4294967295 numbers goes beyond the end of the file; "
                "expected at most 4");
    expectError(with("3 0 1 2", "-3 0 1 2"),
                "line 13 (face 1 of 1): -3 is not the length of a list; expected a whole number");
    expectError(with("3 0 1 2", "nan 0 1 2"),
                "line 13 (face 1 of 1): nan is not the length of a list; expected a whole number");
    expectError(with("3 0 1 2", "3 0 1 3"),
                "line 13 (face 1 of 1): vertex index 3 is out of range; expected 0 to 2");
    expectError(with("3 0 1 2", "3 0 1 0.5"),
                "line 13 (face 1 of 1): vertex index 0.5 is out of range; expected 0 to 2");
    expectError(with("3 0 1 2", "2 0 1"), "has no faces; expected at least one of 3 corners or more");
    expectError(with("1 0 0", "1 0,5 0"),
                "line 11 (vertex 2 of 3): \"0,5\" is not a number; expected a number");
    expectError(
        with("1 0 0", "1 inf 0"),
        "vertex 2 of 3: a coordinate is not finite or too large; expected at most 1e+09 in magnitude");
    expectError(ascii(3, "0 0 0\n1 0 0\n2 0 0\n", 1, "3 0 1 2\n"),
                "every triangle has zero area; expected triangles with area");
}

/// A binary mesh of a square and its header, with all kinds of properties.
std::string square(bool bigEndian) {
    Bytes body(bigEndian);
    for (int i = 0; i < 4; ++i)
        body.real(static_cast<float>(i % 2)).real(static_cast<float>(i / 2)).wide(0.0).integer(200, 1);
    body.integer(4, 4);
    for (const unsigned corner : {0u, 1u, 3u, 2u})
        body.integer(corner, 2);
    return header(formatName(bigEndian),
                  "element vertex 4\nproperty float x\nproperty float y\nproperty double z\n"
                  "property uchar mark\nelement face 1\nproperty list uint ushort vertex_indices\n") +
           body.text();
}

TEST_F(PlyTest, BinaryErrorsNameTheItem) {
    std::string text = square(true);
    const std::size_t length = text.size() - 4 * 2 - 4;
    text.replace(length, 4, "\xff\xff\xff\xff");
    EXPECT_EQ(errorOfPly(text),
              "mesh.ply: face 1 of 1: a list of 4294967295 numbers goes beyond the end of the file; "
              "expected at most 4");
    text = square(false);
    EXPECT_EQ(errorOfPly(text.substr(0, text.size() - 1)),
              "mesh.ply: face 1 of 1: the file ends here; expected 1, as the header says");
    EXPECT_EQ(errorOfPly(text.substr(0, text.size() - 9)),
              "mesh.ply: element face: the file holds at most 0; expected 1, as the header says");
    EXPECT_EQ(errorOfPly(text.substr(0, text.size() - 13)),
              "mesh.ply: element vertex: the file holds at most 3; expected 4, as the header says");
}

TEST_F(PlyTest, EveryTruncatedFileIsAnError) {
    for (const bool bigEndian : {false, true}) {
        const std::string text = square(bigEndian);
        ASSERT_EQ(mesh(text).geometry.triangles.size(), 2u);
        for (std::size_t size = 0; size < text.size(); ++size)
            EXPECT_THROW(mesh(text.substr(0, size)), InputError) << size;
    }
}

TEST_F(PlyTest, DamagedFilesAreErrorsOrMeshes) {
    std::uint32_t random = 1;
    const auto next = [&] { return (random = random * 1664525u + 1013904223u) >> 8; };
    std::size_t loaded = 0, refused = 0;
    for (const std::string& good : {square(false), square(true), ascii(3, kThree, 1, "3 0 1 2\n")}) {
        for (int i = 0; i < 500; ++i) {
            std::string text = good;
            for (std::uint32_t n = 0; n <= next() % 3; ++n)
                text[next() % text.size()] = static_cast<char>(next());
            try {
                const Geometry geometry = mesh(text).geometry;
                for (const glm::uvec3& triangle : geometry.triangles)
                    ASSERT_LT(std::max({triangle.x, triangle.y, triangle.z}), geometry.positions.size());
                ++loaded;
            } catch (const InputError&) {
                ++refused;
            }
        }
    }
    EXPECT_GT(loaded, 100u);
    EXPECT_GT(refused, 100u);
}

}  // namespace
}  // namespace duolux::test
