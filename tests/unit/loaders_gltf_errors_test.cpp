// glTF files with errors.
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/unit/gltf_files.h"

namespace duolux::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// A triangle with indices, normals and a material.
GltfFile goodFile() {
    GltfFile file = triangleFile();
    json& primitive = file.json["meshes"][0]["primitives"][0];
    primitive["indices"] = file.indices({0, 1, 2});
    primitive["attributes"]["NORMAL"] = file.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
    primitive["material"] = file.add("materials", {{"name", "m"}});
    return file;
}

TEST_F(GltfTest, ErrorsNameThePlace) {
    EXPECT_EQ(mesh(goodFile()).geometry.triangles.size(), 1u);
    const auto expectError = [&](const char* pointer, json value, const std::string& error) {
        GltfFile file = goodFile();
        file.json[json::json_pointer(pointer)] = std::move(value);
        EXPECT_EQ(errorOfGltf(file), "mesh.gltf: " + error);
    };
    const auto expectMissing = [&](const char* parent, const char* key, const std::string& error) {
        GltfFile file = goodFile();
        file.json[json::json_pointer(parent)].erase(key);
        EXPECT_EQ(errorOfGltf(file), "mesh.gltf: " + error);
    };
    expectMissing("", "asset", "\"asset\" is missing; expected {\"version\": \"2.0\"}");
    expectError("/asset/version", "1.0", "asset.version: is \"1.0\"; expected \"2.0\"");
    expectError("/asset/minVersion", "2.1", "asset.minVersion: is \"2.1\"; expected \"2.0\"");
    expectError(
        "/extensionsRequired", {"KHR_mesh_quantization", "ACME_x"},
        "extensionsRequired[1]: the extension \"ACME_x\" is not supported; expected a file that does not "
        "require it");
    expectError("/nodes", 3, "nodes: is 3; expected an array");
    expectError("/nodes/0/mesh", 1, "nodes[0].mesh: is 1; expected 0");
    expectError("/nodes/0/mesh", "m", "nodes[0].mesh: is \"m\"; expected 0");
    expectError("/nodes/0/skin", 0,
                "nodes[0].skin: refers to skins, of which there are none; expected no reference");
    expectError("/nodes/0/matrix", {1, 2},
                "nodes[0].matrix: is an array of 2; expected 16 numbers, a matrix column by "
                "column");
    expectError("/nodes/0/matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                "nodes[0].matrix: the last row is not 0, 0, 0, 1; expected an affine transform");
    expectError("/nodes/0/translation", {1e30, 0, 0},
                "nodes[0].translation[0]: is 1e+30; expected three numbers");
    expectError("/scene", 0, "scene: refers to scenes, of which there are none; expected no reference");
    expectError("/scenes", {{{"nodes", {4}}}}, "scenes[0].nodes[0]: is 4; expected 0");
    expectError("/meshes/0", json::object(),
                "meshes[0]: \"primitives\" is missing; expected an array of primitives");
    expectError("/meshes/0/primitives/0/mode", 7,
                "meshes[0].primitives[0].mode: is 7; expected a whole number from 0 to 6");
    expectError("/meshes/0/primitives/0/material", 1, "meshes[0].primitives[0].material: is 1; expected 0");
    expectError("/meshes/0/primitives/0/indices", 9,
                "meshes[0].primitives[0].indices: is 9; expected a whole number from 0 to 2");
    expectError("/accessors/0/count", 4,
                "accessors[0]: 4 elements from byte 0 on do not fit into a buffer view of 36 bytes; expected "
                "at least "
                "48 bytes");
    expectError("/accessors/0/byteOffset", 1,
                "accessors[0]: 3 elements from byte 1 on do not fit into a buffer view of 36 bytes; expected "
                "at least "
                "37 bytes");
    expectError("/accessors/0/byteOffset", -4, "accessors[0].byteOffset: is -4; expected a number of bytes");
    expectError("/accessors/0/byteOffset", 1e300,
                "accessors[0].byteOffset: is 1e+300; expected a number of bytes");
    expectError("/accessors/0/count", 4294967295u,
                "accessors[0].count: is 4294967295; expected a whole number from 0 to 2147483647");
    expectError(
        "/accessors/0/componentType", 5124,
        "accessors[0].componentType: is 5124; expected 5120, 5121, 5122, 5123, 5125 or 5126 (signed and "
        "unsigned 8 and 16 bits, unsigned 32 bits, float)");
    expectError("/accessors/0/type", "VEC2", "accessors[0].type: is \"VEC2\"; expected VEC3");
    expectError("/accessors/0/type", "VEC", "accessors[0].type: is \"VEC\"; expected VEC3");
    expectError("/accessors/2/count", 2,
                "meshes[0].primitives[0].attributes.NORMAL: has 2 elements; expected 3, as many as POSITION");
    expectError("/bufferViews/0/byteLength", 1000,
                "bufferViews[0]: takes 1000 bytes from byte 0 of a buffer of 80 bytes; expected a part of "
                "the buffer");
    expectError("/bufferViews/0/byteOffset", 9007199254740991,
                "bufferViews[0]: takes 36 bytes from byte 9007199254740991 of a buffer of 80 bytes; expected "
                "a part of "
                "the buffer");
    expectError(
        "/bufferViews/0/byteStride", 8,
        "accessors[0].bufferView: the buffer view has a stride of 8 bytes; expected at least 12, the size of "
        "an element");
    expectError("/bufferViews/0/buffer", 1, "bufferViews[0].buffer: is 1; expected 0");
    expectMissing("/bufferViews/0", "buffer",
                  "bufferViews[0]: \"buffer\" is missing; expected the index of a buffer");
    expectError("/materials/0/emissiveFactor", {1, -1, 0},
                "materials[0].emissiveFactor[1]: is -1; expected three numbers from 0");
    expectError("/materials/0/alphaMode", "MASKED",
                "materials[0].alphaMode: is \"MASKED\"; did you mean \"MASK\"?");
    expectError("/materials/0/normalTexture", {{"index", 0}},
                "materials[0].normalTexture.index: refers to textures, of which there are none; expected no "
                "reference");
}

TEST_F(GltfTest, IndicesAndPositionsAreChecked) {
    GltfFile file = triangleFile();
    file.json["meshes"][0]["primitives"][0]["indices"] = file.indices({0, 1, 2, 2, 3, 1});
    EXPECT_EQ(errorOfGltf(file),
              "mesh.gltf: meshes[0].primitives[0].indices: index 4 of 6 is 3; expected 0 to 2");
    GltfFile nan;
    nan.primitive({{"POSITION", nan.vec3({0, 0, 0, 1, NAN, 0, 0, 1, 0})}});
    EXPECT_EQ(errorOfGltf(nan),
              "mesh.gltf: accessors[0]: element 1 is not finite; expected finite positions");
    GltfFile sparse = triangleFile();
    sparse.json["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", sparse.view(bytesOf({3}, 1))}, {"componentType", 5121}}},
        {"values", {{"bufferView", sparse.view(bytesOf({0, 0, 0}))}}}};
    EXPECT_EQ(errorOfGltf(sparse),
              "mesh.gltf: accessors[0].sparse.indices: element 0 is 3; expected indices below 3");
    sparse.json["accessors"][0]["sparse"]["values"]["byteOffset"] = 4;
    EXPECT_THAT(errorOfGltf(sparse),
                HasSubstr("accessors[0].sparse.values: 1 elements from byte 4 on do not fit"));
    GltfFile huge = triangleFile();
    huge.json["accessors"][0] = {{"componentType", 5126}, {"type", "VEC3"}, {"count", 2000000000}};
    EXPECT_EQ(errorOfGltf(huge),
              "mesh.gltf: accessors[0].count: is 2000000000; expected a whole number from 0 to "
              "16777216");
    GltfFile far = triangleFile();
    far.json["nodes"][0]["scale"] = {1e10, 1, 1};
    EXPECT_EQ(errorOfGltf(far),
              "mesh.gltf: nodes[0]: a vertex is too far away; expected coordinates of at most 1e+09 "
              "in magnitude");
    far.add("nodes", {{"children", {0}}, {"scale", {1e10, 1, 1}}});
    EXPECT_EQ(errorOfGltf(far),
              "mesh.gltf: nodes[0]: a vertex is too far away; expected coordinates of at most 1e+18 "
              "in magnitude");
}

TEST_F(GltfTest, NodesFormTrees) {
    GltfFile file = triangleFile();
    file.add("nodes", {{"children", {2}}});
    file.add("nodes", {{"children", {1}}});
    EXPECT_EQ(errorOfGltf(file), "mesh.gltf: nodes[1]: is its own ancestor; expected nodes that form trees");
    file.json["nodes"][2]["children"] = {0, 2};
    EXPECT_EQ(errorOfGltf(file),
              "mesh.gltf: nodes[2].children[1]: nodes[2] is also a child of nodes[1]; expected one parent "
              "for each node");
    file.json["nodes"][2]["children"] = {0};
    file.json["scenes"] = {{{"nodes", {2, 0}}}};
    const Mesh read = mesh(file);
    EXPECT_EQ(read.geometry.triangles.size(), 1u) << "each node once";
    EXPECT_THAT(warningsOf(read),
                ElementsAre("mesh.gltf: scenes[0].nodes[0]: a node of the scene that is a child of "
                            "another node (and 1 more): its parents move it, too"));
    EXPECT_THAT(errorOfGltf(file, Reading::kStrict), HasSubstr("scenes[0].nodes[0]: a node of the scene"));
}

TEST_F(GltfTest, SkinsAreChecked) {
    GltfFile file;
    file.primitive(
        {{"POSITION", file.vec3(kCorners)},
         {"JOINTS_0", file.accessor(bytesOf({0, 0, 0, 0, 1, 9, 0, 0, 0, 2, 0, 0}, 1), 5121, "VEC4", 3)},
         {"WEIGHTS_0", file.floats({1, 0, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 0, 0}, "VEC4", 4)}});
    file.json["nodes"][0]["skin"] = file.add("skins", {{"joints", {0, 0}}});
    EXPECT_EQ(errorOfGltf(file),
              "mesh.gltf: nodes[0]: a vertex follows joint 2; expected joints below 2, the number "
              "in the skin");
    file.json["skins"][0]["inverseBindMatrices"] = file.floats(std::vector<float>(16, 0.0f), "MAT4", 16);
    EXPECT_EQ(errorOfGltf(file),
              "mesh.gltf: skins[0].inverseBindMatrices: has 1 matrices; expected 2, one for each "
              "joint");
    file.json["skins"][0]["joints"] = {7};
    EXPECT_EQ(errorOfGltf(file), "mesh.gltf: skins[0].joints[0]: is 7; expected 0");
}

TEST_F(GltfTest, BuffersAreChecked) {
    const GltfFile good = triangleFile();
    const auto expectError = [&](json buffer, const std::string& error) {
        json complete = good.json;
        complete["buffers"] = {std::move(buffer)};
        EXPECT_EQ(errorOfGltf(complete.dump()), "mesh.gltf: buffers[0]" + error);
    };
    write("short.bin", "12345");
    expectError({{"byteLength", 36}, {"uri", "short.bin"}}, ": has 5 bytes; expected 36, its byteLength");
    expectError({{"byteLength", 36}, {"uri", "none.bin"}},
                ".uri: no file none.bin; expected the path of a file, relative to the glTF file");
    expectError({{"byteLength", 36}, {"uri", "."}},
                ".uri: no file .; expected the path of a file, relative to the glTF file");
    expectError({{"byteLength", 36}}, ": has no data; expected \"uri\", or a binary glTF file");
    for (const char* const uri : {"https://example.com/a.bin", "", "a%00b"}) {
        expectError({{"byteLength", 36}, {"uri", uri}},
                    ".uri: is \"" + std::string(uri) +
                        "\"; expected a data URI or the path of a file, relative to "
                        "the glTF file");
    }
    expectError({{"byteLength", 36}, {"uri", "data:;base64"}},
                ".uri: is a data URI without a comma; expected \"data:application/octet-stream;base64,\" and "
                "the data");
    for (const char* const data : {"data:;base64,AAA*", "data:;base64,AAAAA", "data:;base64,AA=A"}) {
        expectError({{"byteLength", 3}, {"uri", data}},
                    ".uri: is a data URI that is not base64; expected letters, digits, + and /");
    }
    expectError({{"byteLength", 3}, {"uri", "data:;base64,"}}, ": has 0 bytes; expected 3, its byteLength");
}

TEST_F(GltfTest, UnusedErrorsDoNotMatter) {
    GltfFile file = triangleFile();
    file.add("accessors", {{"bufferView", 99}});
    file.add("bufferViews", {{"buffer", 1}});
    file.add("meshes", 7);
    file.add("animations", "none");
    file.add("images", {{"uri", "none.png"}});
    EXPECT_EQ(mesh(file).geometry.triangles.size(), 1u);
}

TEST_F(GltfTest, HarmlessErrorsOfMeshesAreWarnings) {
    GltfFile file = goodFile();
    json& primitive = file.json["meshes"][0]["primitives"][0];
    primitive["indices"] = file.indices({0, 1, 2, 0, 1});
    primitive["attributes"]["NORMAL"] = file.vec3({0, 0, 1, 0, 0, 0, NAN, 0, 1});
    primitive["attributes"]["TEXCOORD_0"] = file.vec2({0, INFINITY, 1, 0, 0, 1});
    file.primitive(json::object());
    for (const std::vector<float>& normals : {std::vector<float>{0, 0, 0, 0, 0, 1, 0, 0, 1},
                                              {0, 0, 1, 0, 0, 0, 0, 0, 1},
                                              {0, 0, 1, 0, 0, 1, 0, 0, 0}}) {
        GltfFile flat;
        flat.primitive({{"POSITION", flat.vec3(kCorners)}, {"NORMAL", flat.vec3(normals)}});
        EXPECT_EQ(mesh(flat).geometry.normalIndices[0].x, Geometry::kNoNormal);
    }
    const Mesh read = mesh(file);
    EXPECT_EQ(read.geometry.triangles.size(), 1u);
    EXPECT_EQ(read.geometry.normalIndices[0].x, Geometry::kNoNormal);
    EXPECT_EQ(read.geometry.uvs[0], glm::vec2(0, 0));
    EXPECT_THAT(
        warningsOf(read),
        ElementsAre(
            "mesh.gltf: meshes[0].primitives[0]: a number of indices that forms no whole triangles: the "
            "last ones are left out",
            "mesh.gltf: accessors[4]: a normal that is 0 or not finite (and 1 more): its triangles are "
            "flat",
            "mesh.gltf: accessors[5]: a texture coordinate that is not finite: read as 0",
            "mesh.gltf: meshes[1].primitives[0]: a primitive without POSITION: left out"));
}

TEST_F(GltfTest, BinaryFilesAreChecked) {
    const std::string good = triangleFile().glb();
    const auto errorOfGlb = [&](const std::string& bytes) {
        write("mesh.glb", bytes);
        return errorOf("mesh.glb");
    };
    const auto with = [&](std::size_t offset, std::int64_t word) {
        std::string bytes = good;
        return bytes.replace(offset, 4, bytesOf({word}, 4));
    };
    write("mesh.glb", good + "and more");
    EXPECT_EQ(load("mesh.glb").content.triangles, 1u);
    EXPECT_EQ(errorOfGlb(good.substr(0, 10)),
              "mesh.glb: byte 10: the file ends here; expected the header of a binary glTF file");
    EXPECT_EQ(errorOfGlb(good.substr(0, 60)),
              "mesh.glb: byte 60: the file ends here; expected " + std::to_string(good.size()) + " bytes");
    EXPECT_EQ(errorOfGlb(with(4, 1)), "mesh.glb: byte 4: is version 1 of binary glTF; expected version 2");
    EXPECT_EQ(errorOfGlb(with(12, 1 << 30)),
              "mesh.glb: byte 12: the length of a chunk is 1073741824; expected at most " +
                  std::to_string(good.size() - 20));
    EXPECT_EQ(errorOfGlb(with(16, 0)),
              "mesh.glb: byte 12: the first chunk is not JSON; expected the JSON chunk");
    EXPECT_EQ(errorOfGlb(with(good.find("BIN"), 0)),
              "mesh.glb: buffers[0]: has no data; expected \"uri\", or a binary glTF file");
}

TEST_F(GltfTest, OtherContentIsAnError) {
    EXPECT_THAT(errorOfGltf(std::string()), HasSubstr("line 1, column 1: syntax error: the file is empty"));
    EXPECT_THAT(errorOfGltf(std::string("{\n  \"asset\": }")), HasSubstr("line 2, column 12: syntax error"));
    EXPECT_EQ(errorOfGltf(std::string("ply\n")), "mesh.gltf: is PLY; expected glTF JSON or binary glTF");
    EXPECT_EQ(errorOfGltf(std::string("version https://git-lfs.github.com/spec/v1\n")),
              "mesh.gltf: is a Git LFS pointer; expected the file itself, which \"git lfs pull\" fetches");
    EXPECT_EQ(errorOfGltf(R"({"asset": {"version": "2.0"}, "asset": {}})"),
              "mesh.gltf: asset: the key appears twice; expected it once");
    EXPECT_EQ(errorOfGltf(R"({"asset": {"version": "2.0"}})"),
              "mesh.gltf: has no triangles; expected a scene with nodes that have meshes of triangles");
    std::string deep = R"({"asset": {"version": "2.0", "extras": )";
    constexpr std::size_t kDepth = 200000;
    EXPECT_THAT(errorOfGltf(deep + std::string(kDepth, '[') + std::string(kDepth, ']') + "}}"),
                HasSubstr("has no triangles"));
}

}  // namespace
}  // namespace duolux::test
