// Geometry and hierarchies of glTF files.
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/unit/gltf_files.h"

namespace duolux::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using V = glm::vec3;

TEST_F(GltfTest, IsASceneOfItsOwnAndAMeshOfAJsonScene) {
    GltfFile file = triangleFile();
    file.json["meshes"][0]["primitives"][0]["material"] = file.add(
        "materials", {{"name", "red"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 0, 0, 1}}}}});
    write("mesh.gltf", file.text());
    write("mesh.glb", file.glb());
    const LoadedScene own = load("mesh.gltf");
    EXPECT_EQ(own.content.triangles, 1u);
    EXPECT_EQ(own.materials[0].name, "red");
    EXPECT_EQ(own.meshBytes, file.text().size());
    const LoadedScene scene = loadJson(R"({"duolux": 1, "objects": [{"mesh": "mesh.gltf"},
        {"mesh": "mesh.glb", "transform": [2,0,0,0, 0,2,0,0, 0,0,2,1, 0,0,0,1]}],
        "materials": {"red": {"metallic": 0}}})");
    EXPECT_EQ(scene.content.triangles, 2u);
    EXPECT_EQ(scene.materials[0].baseColor, V(1, 0, 0));
    EXPECT_EQ(scene.materials[0].metallic, 0.0f);
    EXPECT_FLOAT_EQ(glm::length(areaVector(scene.geometry, 0)), 0.5f);
    EXPECT_FLOAT_EQ(glm::length(areaVector(scene.geometry, 1)), 2.0f);
}

TEST_F(GltfTest, BuffersAreFilesDataOrChunks) {
    const GltfFile file = triangleFile();
    const auto expectTriangle = [&](const std::string& name, std::size_t files, std::size_t bytes) {
        MaterialFiles reading(Reading::kLenient);
        const Mesh read = loadGltf(folder_ / name, reading);
        EXPECT_THAT(cornersOf(read.geometry, 0), ElementsAre(V(0, 0, 0), V(1, 0, 0), V(0, 1, 0))) << name;
        EXPECT_EQ(read.files.size(), files) << name;
        EXPECT_EQ(read.bytes, bytes) << name;
        EXPECT_THAT(read.warnings, IsEmpty());
    };
    write("mesh.gltf", file.text());
    expectTriangle("mesh.gltf", 1, file.text().size());
    write("mesh.glb", file.glb());
    expectTriangle("mesh.glb", 1, file.glb().size());
    write("misnamed.gltf", file.glb());
    expectTriangle("misnamed.gltf", 1, file.glb().size());
    std::filesystem::create_directory(folder_ / "data");
    const std::string name = "a b \xC3\xA9 %41.bin";
    write("data/" + name, file.binary + "more");  // other programs pad it
    for (const std::string& uri :
         {std::string("data/a%20b%20%C3%A9%20%2541.bin"), "data/" + name, "data/../data/" + name,
          "data\\" + name, (folder_ / "data" / name).string(),
          "file://" + (folder_ / "data").string() + "/a%20b%20%C3%A9%20%2541.bin"}) {
        GltfFile other = file;
        other.json["buffers"] = {{{"byteLength", file.binary.size()}, {"uri", uri}}};
        write("mesh.gltf", other.json.dump());
        expectTriangle("mesh.gltf", 2, other.json.dump().size() + file.binary.size() + 4);
    }
    for (const std::string start : {"data:;base64,", "DATA:application/gltf-buffer;x=y;BASE64,"}) {
        std::string data = base64Of(file.binary);
        GltfFile other = file;
        other.json["buffers"] = {{{"byteLength", file.binary.size()}, {"uri", start + data}}};
        write("mesh.gltf", other.json.dump());
        expectTriangle("mesh.gltf", 1, other.json.dump().size());
    }
}

TEST_F(GltfTest, StripsAndFansAreTriangles) {
    // A square around (0, 0), by its corners in the order of a strip and of a fan.
    const std::vector<float> strip{-1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0},
        fan{-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    for (const auto& [mode, corners] : {std::pair(5, strip), std::pair(6, fan)}) {
        for (const bool indexed : {false, true}) {
            GltfFile file;
            json& primitive = file.primitive({{"POSITION", file.vec3(corners)}});
            primitive["mode"] = mode;
            if (indexed) primitive["indices"] = file.indices({0, 1, 2, 3});
            const Geometry geometry = mesh(file).geometry;
            ASSERT_EQ(geometry.triangles.size(), 2u);
            EXPECT_EQ(areaVector(geometry, 0), V(0, 0, 2)) << mode;
            EXPECT_EQ(areaVector(geometry, 1), V(0, 0, 2)) << mode;
        }
    }
    GltfFile file;
    json& primitive = file.primitive({{"POSITION", file.vec3(strip)}});
    primitive["mode"] = 5;
    primitive["indices"] = file.indices({0, 1, 2, 3, 3, 3, 0, 1});
    const Mesh read = mesh(file);
    EXPECT_EQ(read.geometry.triangles.size(), 3u) << "triangles that only connect others are left out";
    EXPECT_THAT(read.warnings, IsEmpty());
}

TEST_F(GltfTest, PointsAndLinesAreOneWarning) {
    GltfFile file = triangleFile();
    for (const int mode : {0, 1, 2, 3})
        file.primitive({{"POSITION", file.vec3(kCorners)}})["mode"] = mode;
    const Mesh read = mesh(file);
    EXPECT_EQ(read.geometry.triangles.size(), 1u);
    EXPECT_THAT(warningsOf(read), ElementsAre("mesh.gltf: meshes[1].primitives[0]: points and lines are not "
                                              "supported (and 3 more): left out"));
}

TEST_F(GltfTest, IntegersOfAllTypesArePositions) {
    struct Case {
        int type, size;
        bool normalised;
        std::vector<std::int64_t> values;  ///< of (0, 0, 0), (largest, 0, 0), (0, largest, lowest)
        float largest, lowest;
    };
    for (const Case& c :
         {Case{GltfFile::kByte, 1, false, {0, 0, 0, 127, 0, 0, 0, 127, -128}, 127, -128},
          Case{GltfFile::kByte, 1, true, {0, 0, 0, 127, 0, 0, 0, 127, -128}, 1, -1},
          Case{GltfFile::kUnsignedByte, 1, true, {0, 0, 0, 255, 0, 0, 0, 255, 0}, 1, 0},
          Case{GltfFile::kUnsignedByte, 1, false, {0, 0, 0, 255, 0, 0, 0, 255, 0}, 255, 0},
          Case{GltfFile::kShort, 2, true, {0, 0, 0, 32767, 0, 0, 0, 32767, -32768}, 1, -1},
          Case{GltfFile::kShort, 2, false, {0, 0, 0, 32767, 0, 0, 0, 32767, -32768}, 32767, -32768},
          Case{GltfFile::kUnsignedShort, 2, true, {0, 0, 0, 65535, 0, 0, 0, 65535, 0}, 1, 0}}) {
        GltfFile file;
        file.json["extensionsRequired"] = file.json["extensionsUsed"] = {"KHR_mesh_quantization"};
        const std::size_t positions = file.accessor(bytesOf(c.values, c.size), c.type, "VEC3", 3);
        if (c.normalised) file.json["accessors"][positions]["normalized"] = true;
        file.primitive({{"POSITION", positions}});
        EXPECT_THAT(cornersOf(mesh(file).geometry, 0),
                    ElementsAre(V(0, 0, 0), V(c.largest, 0, 0), V(0, c.largest, c.lowest)))
            << c.type << c.normalised;
    }
    for (const auto& [type, size] :
         {std::pair(GltfFile::kUnsignedByte, 1), std::pair(GltfFile::kUnsignedInt, 4)}) {
        GltfFile file;
        json& primitive = file.primitive({{"POSITION", file.vec3(kCorners)}});
        primitive["indices"] = file.accessor(bytesOf({0, 2, 1}, size), type, "SCALAR", 3);
        EXPECT_THAT(cornersOf(mesh(file).geometry, 0), ElementsAre(V(0, 0, 0), V(0, 1, 0), V(1, 0, 0)));
    }
}

TEST_F(GltfTest, AttributesMayBeInterleaved) {
    GltfFile file;
    // Position and normal of each vertex; unrelated bytes before and after.
    const std::size_t view =
        file.view("1234" + bytesOf({0, 0, 0, 0, 0, 1, 2, 0, 0, 0, 1, 0, 0, 2, 0, 1, 0, 0}) + "more");
    file.json["bufferViews"][view]["byteStride"] = 24;
    json attributes;
    for (const auto& [name, offset] : {std::pair("POSITION", 4), std::pair("NORMAL", 16)}) {
        attributes[name] = file.add("accessors", {{"bufferView", view},
                                                  {"byteOffset", offset},
                                                  {"type", "VEC3"},
                                                  {"componentType", GltfFile::kFloat},
                                                  {"count", 3}});
    }
    file.primitive(attributes);
    const Geometry geometry = mesh(file).geometry;
    EXPECT_THAT(cornersOf(geometry, 0), ElementsAre(V(0, 0, 0), V(2, 0, 0), V(0, 2, 0)));
    EXPECT_THAT(geometry.normals, ElementsAre(V(0, 0, 1), V(0, 1, 0), V(1, 0, 0)));
    EXPECT_THAT(geometry.normalIndices, ElementsAre(glm::uvec3(0, 1, 2)));
}

TEST_F(GltfTest, SparseElementsReplaceOthers) {
    for (const bool hasView : {true, false}) {
        GltfFile file;
        json accessor{{"componentType", GltfFile::kFloat}, {"type", "VEC3"}, {"count", 3}};
        if (hasView) accessor["bufferView"] = file.view(bytesOf(kCorners));
        // In descending order, which other programs accept.
        accessor["sparse"] = {
            {"count", 2},
            {"indices", {{"bufferView", file.view(bytesOf({2, 1}, 1))}, {"componentType", 5121}}},
            {"values", {{"bufferView", file.view(bytesOf({0, 7, 0, 5, 0, 0}))}}}};
        file.primitive({{"POSITION", file.add("accessors", accessor)}});
        EXPECT_THAT(cornersOf(mesh(file).geometry, 0), ElementsAre(V(0, 0, 0), V(5, 0, 0), V(0, 7, 0)))
            << hasView;
    }
}

TEST_F(GltfTest, AttributesOfSomePrimitivesOnly) {
    GltfFile file = triangleFile();
    file.primitive({{"POSITION", file.vec3(kCorners)},
                    {"NORMAL", file.vec3({0, 0, 2, 0, 3, 4, 0, 0, 1})},
                    {"TEXCOORD_0", file.vec2({0, 0, 1, 0, 0, 1})},
                    {"TANGENT", file.floats({1, 0, 0, 1, 0, 2, 0, -1, 1, 0, 0, 1}, "VEC4", 4)},
                    {"COLOR_0", file.floats({0.5, 0.25, 1, 0.75, 2, -1, 0, 1, 0, 0, 0, 0}, "VEC4", 4)}});
    file.primitive({{"POSITION", file.vec3(kCorners)},
                    {"TEXCOORD_1", file.vec2({3, 4, 5, 6, 7, 8})},
                    {"COLOR_0", file.accessor(bytesOf({255, 0, 51, 0, 0, 0, 0, 0, 0}, 1), 5121, "VEC3", 3)}});
    file.primitive({{"POSITION", file.vec3(kCorners)}});
    const Geometry geometry = mesh(file).geometry;
    constexpr std::uint32_t kNone = 0xffffffffu;
    ASSERT_EQ(geometry.positions.size(), 12u);
    EXPECT_THAT(geometry.normalIndices,
                ElementsAre(glm::uvec3(kNone), glm::uvec3(0, 1, 2), glm::uvec3(kNone), glm::uvec3(kNone)));
    EXPECT_THAT(geometry.normals[1], IsNear(V(0, 0.6f, 0.8f), 1e-6f));
    EXPECT_THAT(geometry.uvIndices,
                ElementsAre(glm::uvec3(kNone), glm::uvec3(0, 1, 2), glm::uvec3(3, 4, 5), glm::uvec3(kNone)));
    EXPECT_THAT(geometry.uvs, ElementsAre(glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1), glm::vec2(0),
                                          glm::vec2(0), glm::vec2(0)));
    EXPECT_THAT(geometry.secondUvs, ElementsAre(glm::vec2(0), glm::vec2(0), glm::vec2(0), glm::vec2(3, 4),
                                                glm::vec2(5, 6), glm::vec2(7, 8)));
    EXPECT_THAT(geometry.tangents,
                ElementsAre(glm::vec4(1, 0, 0, 1), glm::vec4(0, 1, 0, -1), glm::vec4(1, 0, 0, 1),
                            glm::vec4(0), glm::vec4(0), glm::vec4(0)));
    ASSERT_EQ(geometry.colours.size(), 12u);
    EXPECT_EQ(geometry.colours[0], V(1));
    EXPECT_EQ(geometry.colours[3], V(0.5, 0.25, 1));
    EXPECT_EQ(geometry.colours[4], V(1, 0, 0)) << "clamped";
    EXPECT_THAT(geometry.colours[6], IsNear(V(1, 0, 0.2f), 1e-6f)) << "integers are fractions, linear";
    EXPECT_EQ(geometry.colours[11], V(1));
    EXPECT_THAT(geometry.alphas, ElementsAre(1, 1, 1, 0.75f, 1, 0, 1, 1, 1, 1, 1, 1));
}

TEST_F(GltfTest, NodesTransformTheirChildren) {
    GltfFile file = triangleFile();
    file.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = file.vec3({0, 0, 1, 0, 0, 1, 0, 1, 0});
    // A quarter turn about z, then a shift, within a node that scales by (1, 2, 3).
    const double half = std::sqrt(0.5);
    file.json["nodes"][0]["rotation"] = {0, 0, half, half};
    file.json["nodes"][0]["translation"] = {10, 0, 0};
    file.add("nodes", {{"children", {0}}, {"matrix", {1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 3, 0, 0, 0, 5, 1}}});
    const Geometry geometry = mesh(file).geometry;
    const std::vector<V> corners = cornersOf(geometry, 0);
    EXPECT_THAT(corners[0], IsNear(V(10, 0, 5), 1e-5f));
    EXPECT_THAT(corners[1], IsNear(V(10, 2, 5), 1e-5f));
    EXPECT_THAT(corners[2], IsNear(V(9, 0, 5), 1e-5f));
    EXPECT_THAT(geometry.normals[geometry.normalIndices[0].x], IsNear(V(0, 0, 1), 1e-6f));
    EXPECT_THAT(geometry.normals[geometry.normalIndices[0].z], IsNear(V(-1, 0, 0), 1e-6f));
}

TEST_F(GltfTest, MirroredFrontsRemainFronts) {
    for (const V& scale : {V(-1, 1, 1), V(2, -3, 1), V(-1, -1, -4), V(-1, -1, 1), V(1, 1, -1)}) {
        GltfFile file = triangleFile();
        json& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
        attributes["NORMAL"] = file.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
        attributes["TEXCOORD_0"] = file.vec2({0, 0, 1, 0, 0, -1});
        attributes["TANGENT"] = file.floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4", 4);
        file.json["nodes"][0]["scale"] = {scale.x, scale.y, scale.z};
        const Geometry geometry = mesh(file).geometry;
        const V normal = V(0, 0, scale.z > 0 ? 1 : -1);
        EXPECT_EQ(glm::normalize(areaVector(geometry, 0)), normal) << scale.x;
        EXPECT_EQ(geometry.normals[0], normal);
        // The image of the bitangent (0, 1, 0).
        const glm::vec4 tangent = geometry.tangents[0];
        EXPECT_EQ(glm::cross(normal, V(tangent)) * tangent.w, V(0, scale.y > 0 ? 1 : -1, 0)) << scale.x;
        // Every corner keeps its texture coordinates.
        for (int corner = 0; corner < 3; ++corner) {
            const V position = geometry.positions[geometry.triangles[0][corner]] / scale;
            EXPECT_EQ(geometry.uvs[geometry.uvIndices[0][corner]], glm::vec2(position.x, -position.y));
        }
    }
}

TEST_F(GltfTest, TheDefaultSceneIsShown) {
    GltfFile file = triangleFile();
    file.primitive({{"POSITION", file.vec3({0, 0, 5, 1, 0, 5, 0, 1, 5})}});
    const auto heights = [&] {
        std::vector<float> z;
        const Geometry geometry = mesh(file).geometry;
        for (const glm::uvec3& triangle : geometry.triangles)
            z.push_back(geometry.positions[triangle.x].z);
        return z;
    };
    EXPECT_THAT(heights(), ElementsAre(0, 5)) << "without scenes: all nodes";
    file.json["scenes"] = {{{"nodes", {1}}}, {{"nodes", {0}}}};
    EXPECT_THAT(heights(), ElementsAre(5)) << "the first one";
    file.json["scene"] = 1;
    EXPECT_THAT(heights(), ElementsAre(0));
    file.json["nodes"][1]["mesh"] = 0;
    file.json["nodes"][1]["translation"] = {0, 0, 7};
    file.json["scenes"][1]["nodes"] = {0, 1};
    EXPECT_THAT(heights(), ElementsAre(0, 7)) << "two nodes with one mesh";
}

TEST_F(GltfTest, DeepAndWideHierarchiesTakeLinearTime) {
    GltfFile file = triangleFile();
    constexpr int kDepth = 20000;
    json& nodes = file.json["nodes"];
    nodes[0]["translation"] = {0, 0, 1};
    for (int i = 1; i < kDepth; ++i)
        nodes.push_back({{"children", {i - 1}}, {"translation", {0, 0, 1}}});
    const Mesh deep = mesh(file);
    EXPECT_EQ(deep.origin.z + static_cast<double>(deep.geometry.positions[0].z), kDepth);
    for (int i = 0; i < kDepth; ++i) {
        nodes[static_cast<std::size_t>(i)] = {{"mesh", 0}, {"translation", {i, 0, 0}}};
        file.add("materials", {{"name", std::to_string(i)}});
    }
    const Mesh wide = mesh(file);
    EXPECT_EQ(wide.geometry.triangles.size(), std::size_t{kDepth});
    EXPECT_EQ(wide.unusedMaterials.size(), std::size_t{kDepth});
}

TEST_F(GltfTest, FarAwayCoordinatesKeepTheirPrecision) {
    GltfFile file = triangleFile();
    file.json["nodes"][0]["translation"] = {4e6, 5e6, 100.125};
    const Mesh read = mesh(file);
    EXPECT_NE(read.origin, glm::dvec3(0.0));
    const std::vector<V> corners = cornersOf(read.geometry, 0);
    EXPECT_EQ(read.origin + glm::dvec3(corners[0]), glm::dvec3(4e6, 5e6, 100.125));
    EXPECT_EQ(corners[1] - corners[0], V(1, 0, 0));
    EXPECT_THAT(read.warnings, IsEmpty());
}

TEST_F(GltfTest, OnlyUsedVerticesAreKept) {
    GltfFile file;
    json& primitive =
        file.primitive({{"POSITION", file.vec3({NAN, 0, 0, 0, 0, 0, 1e30f, 0, 0, 1, 0, 0, 0, 1, 0})}});
    primitive["indices"] = file.indices({1, 3, 4});
    const Geometry geometry = mesh(file).geometry;
    EXPECT_THAT(geometry.positions, ElementsAre(V(0, 0, 0), V(1, 0, 0), V(0, 1, 0)));
}

}  // namespace
}  // namespace duolux::test
