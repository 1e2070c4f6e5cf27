// Shapes and places that glTF files compute: skins, morph targets, instances; compressed data.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
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

TEST_F(GltfTest, MorphTargetsAddDifferences) {
    GltfFile file;
    json& primitive =
        file.primitive({{"POSITION", file.vec3(kCorners)},
                        {"NORMAL", file.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1})},
                        {"TANGENT", file.floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, -1}, "VEC4", 4)}});
    primitive["targets"] = {{{"POSITION", file.vec3({0, 0, 2, 0, 0, 0, 0, 0, 0})},
                             {"NORMAL", file.vec3({0, 0, 0, 4, 0, 0, 0, 0, 0})},
                             {"TANGENT", file.vec3({0, 0, 0, 0, 0, 0, -1, 4, 0})}},
                            {{"POSITION", file.vec3({0, 0, 0, 0, 8, 0, 0, 0, 0})}}};
    const auto expectCorners = [&](const V& first, const V& second) {
        EXPECT_THAT(cornersOf(mesh(file).geometry, 0), ElementsAre(first, second, V(0, 1, 0)));
    };
    expectCorners(V(0, 0, 0), V(1, 0, 0));
    file.json["meshes"][0]["weights"] = {0.5, 0};
    expectCorners(V(0, 0, 1), V(1, 0, 0));
    file.json["nodes"][0]["weights"] = {0.25, -1};
    expectCorners(V(0, 0, 0.5), V(1, -8, 0));
    file.json["nodes"][0]["weights"] = {1, 0};
    const Geometry geometry = mesh(file).geometry;
    EXPECT_EQ(geometry.normals[0], V(0, 0, 1));
    EXPECT_THAT(geometry.normals[1], IsNear(V(4, 0, 1) / std::sqrt(17.0f), 1e-6f));
    EXPECT_EQ(geometry.tangents[2], glm::vec4(0, 1, 0, -1)) << "the sign stays";
}

/// Two joints: one turned by 90 degrees about z at (10, 0, 0), one mirrored and scaled, at (0, 0, 20).
GltfFile skinnedFile() {
    GltfFile file;
    file.primitive(
        {{"POSITION", file.vec3(kCorners)},
         {"NORMAL", file.vec3({1, 0, 0, 1, 0, 0, 1, 0, 0})},
         {"JOINTS_0", file.accessor(bytesOf({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, 1), 5121, "VEC4", 3)},
         {"WEIGHTS_0", file.floats({1, 0, 0, 0, 1, 0, 0, 0, 0.25, 0.75, 0, 0}, "VEC4", 4)}});
    const double half = std::sqrt(0.5);
    file.add("nodes", {{"rotation", {0, 0, half, half}}, {"translation", {10, 0, 0}}});
    file.add("nodes", {{"scale", {-2, 2, 2}}, {"translation", {0, 0, 20}}});
    file.json["nodes"][0]["skin"] = file.add("skins", {{"joints", {1, 2}}});
    file.json["nodes"][0]["translation"] = {100, 100, 100};  // has no effect on what a skin moves
    return file;
}

TEST_F(GltfTest, SkinsFollowTheirJoints) {
    GltfFile file = skinnedFile();
    const Geometry geometry = mesh(file).geometry;
    // The first vertex follows joint 0, the second one joint 1, the third one the mean of (9, 0, 0) and
    // (0, 2, 20) with weights 1 and 3.
    std::vector<V> positions = geometry.positions;
    EXPECT_THAT(positions[0], IsNear(V(10, 0, 0), 1e-5f));
    EXPECT_THAT(positions[1], IsNear(V(-2, 0, 20), 1e-5f));
    EXPECT_THAT(positions[2], IsNear(V(2.25, 1.5, 15), 1e-5f));
    EXPECT_THAT(geometry.normals[0], IsNear(V(0, 1, 0), 1e-6f));
    EXPECT_THAT(geometry.normals[1], IsNear(V(-1, 0, 0), 1e-6f));

    // Inverse bind matrices shift before the joints turn.
    std::vector<float> binds(32, 0.0f);
    for (std::size_t i : {0u, 5u, 10u, 15u})
        binds[i] = binds[16 + i] = 1.0f;
    binds[12] = 3.0f;  // x of the first one
    file.json["skins"][0]["inverseBindMatrices"] = file.floats(binds, "MAT4", 16);
    EXPECT_THAT(mesh(file).geometry.positions[0], IsNear(V(10, 3, 0), 1e-5f));
}

TEST_F(GltfTest, WeightsOfSkinsAreNormalised) {
    GltfFile file = skinnedFile();
    json& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
    // Integers without the flag, and floats: 0.2 and 0.6. No weight at all: the node's own place.
    attributes["WEIGHTS_0"] =
        file.accessor(bytesOf({51, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 1), 5121, "VEC4", 3);
    attributes["JOINTS_1"] = file.accessor(bytesOf({1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0}, 2), 5123, "VEC4", 3);
    attributes["WEIGHTS_1"] = file.floats({0.6f, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 4);
    const std::vector<V> positions = mesh(file).geometry.positions;
    EXPECT_THAT(positions[0], IsNear(V(2.5, 0, 15), 1e-5f));
    EXPECT_THAT(positions[1], IsNear(V(101, 100, 100), 1e-5f));
    EXPECT_THAT(positions[2], IsNear(V(0, 2, 20), 1e-5f));
}

TEST_F(GltfTest, InstancesHaveTransformsOfTheirOwn) {
    GltfFile file = triangleFile();
    file.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    file.json["nodes"][0]["translation"] = {0, 0, 10};
    file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", file.vec3({1, 2, 3, 4, 5, 6})},
        {"SCALE", file.vec3({1, 1, 1, -2, 2, 2})},
        // Half a turn about z, as normalised integers.
        {"ROTATION", file.accessor(bytesOf({0, 0, 0, 127, 0, 0, 127, 0}, 1), GltfFile::kByte, "VEC4", 2)}};
    file.json["accessors"].back()["normalized"] = true;
    const Geometry geometry = mesh(file).geometry;
    ASSERT_EQ(geometry.triangles.size(), 2u);
    EXPECT_THAT(cornersOf(geometry, 0), ElementsAre(V(1, 2, 13), V(2, 2, 13), V(1, 3, 13)));
    EXPECT_EQ(areaVector(geometry, 1), V(0, 0, 2)) << "the mirrored one has its front on the same side";
    EXPECT_THAT(cornersOf(geometry, 1), testing::UnorderedElementsAre(V(4, 5, 16), V(6, 5, 16), V(4, 3, 16)));
}

/// A square of two triangles with texture coordinates 10 times its coordinates, compressed by Draco.
std::string dracoSquare() {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2);
    const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int uv = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
    const int colour = builder.AddAttribute(draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8, true);
    const std::array<std::array<float, 3>, 4> corners{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
    const std::array<std::array<std::size_t, 3>, 2> faces{{{0, 1, 2}, {0, 2, 3}}};
    const std::array<std::uint8_t, 4> pink{255, 0, 51, 255};
    for (std::size_t face = 0; face < 2; ++face) {
        std::array<std::array<float, 2>, 3> uvs;
        for (std::size_t i = 0; i < 3; ++i)
            uvs[i] = {10 * corners[faces[face][i]][0], 10 * corners[faces[face][i]][1]};
        const draco::FaceIndex index(static_cast<std::uint32_t>(face));
        builder.SetAttributeValuesForFace(position, index, corners[faces[face][0]].data(),
                                          corners[faces[face][1]].data(), corners[faces[face][2]].data());
        builder.SetAttributeValuesForFace(uv, index, uvs[0].data(), uvs[1].data(), uvs[2].data());
        builder.SetAttributeValuesForFace(colour, index, pink.data(), pink.data(), pink.data());
    }
    const std::unique_ptr<draco::Mesh> square = builder.Finalize();
    draco::EncoderBuffer buffer;
    draco::Encoder encoder;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*square, &buffer).ok());
    return {buffer.data(), buffer.size()};
}

GltfFile dracoFile() {
    GltfFile file;
    const std::size_t view = file.view(dracoSquare());
    file.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    const auto accessor = [&](const char* type, int count, int componentType) {
        return file.add("accessors", {{"componentType", componentType}, {"type", type}, {"count", count}});
    };
    json& primitive = file.primitive({{"POSITION", accessor("VEC3", 4, 5126)},
                                      {"TEXCOORD_0", accessor("VEC2", 4, 5126)},
                                      {"COLOR_0", accessor("VEC4", 4, 5121)}});
    primitive["indices"] = accessor("SCALAR", 6, 5125);
    primitive["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", view}, {"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}, {"COLOR_0", 2}}}};
    return file;
}

TEST_F(GltfTest, DracoIsDecompressed) {
    const Mesh read = mesh(dracoFile());
    const Geometry& geometry = read.geometry;
    ASSERT_EQ(geometry.triangles.size(), 2u);
    EXPECT_THAT(areaVector(geometry, 0) + areaVector(geometry, 1), IsNear(V(0, 0, 1), 1e-4f));
    ASSERT_EQ(geometry.uvs.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_THAT(V(geometry.uvs[i], 0), IsNear(10.0f * geometry.positions[i], 1e-3f));
    EXPECT_THAT(geometry.colours[0], IsNear(V(1, 0, 0.2f), 1e-2f));
    EXPECT_THAT(read.warnings, IsEmpty());
}

TEST_F(GltfTest, DamagedDracoIsAnError) {
    GltfFile file = dracoFile();
    const std::string place = "mesh.gltf: meshes[0].primitives[0].extensions.KHR_draco_mesh_compression";
    json& extension = file.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
    extension["attributes"]["TEXCOORD_0"] = 7;
    EXPECT_EQ(errorOfGltf(file),
              place + ".attributes.TEXCOORD_0: is 7; expected the id of an attribute in the compressed data");
    extension["attributes"]["TEXCOORD_0"] = 0;
    EXPECT_EQ(errorOfGltf(file),
              "mesh.gltf: meshes[0].primitives[0].attributes.TEXCOORD_0: the compressed data has 3 "
              "numbers per vertex; expected VEC2");
    file.json["bufferViews"][0]["byteLength"] = 20;
    EXPECT_THAT(errorOfGltf(file),
                testing::AllOf(HasSubstr(place + ": the compressed data cannot be decoded"),
                               HasSubstr("expected a mesh compressed by Draco")));
}

/// A view of `count` elements that is compressed.
std::size_t compressedView(GltfFile& file, const std::vector<unsigned char>& bytes, std::size_t stride,
                           std::size_t count, const char* mode, const char* filter = "NONE") {
    const std::size_t view = file.view({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    json& node = file.json["bufferViews"][view];
    json extension = node;
    extension.update({{"byteStride", stride}, {"count", count}, {"mode", mode}, {"filter", filter}});
    // What is outside the extension describes a fallback, whose buffer need not have data.
    node = {{"buffer", 1}, {"byteLength", stride * count}, {"byteStride", stride}};
    node["extensions"]["EXT_meshopt_compression"] = extension;
    return view;
}

std::vector<unsigned char> compressedVertices(const void* vertices, std::size_t count, std::size_t size) {
    std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(count, size));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), vertices, count, size));
    return bytes;
}

GltfFile meshoptFile() {
    meshopt_encodeVertexVersion(0);  // those of the extension
    meshopt_encodeIndexVersion(1);
    GltfFile file;
    file.json["extensionsRequired"] = {"EXT_meshopt_compression"};
    const std::vector<float> corners{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const std::vector<unsigned> triangles{0, 1, 2, 0, 2, 3};
    std::vector<unsigned char> indices(meshopt_encodeIndexBufferBound(6, 4));
    indices.resize(meshopt_encodeIndexBuffer(indices.data(), indices.size(), triangles.data(), 6));
    // Octahedral normals of 8 bits: (0, 0, 1), (0, 0, 1), (1, 0, 0), (0, 1, 0).
    const std::vector<std::int8_t> normals{0, 0, 127, 0, 0, 0, 127, 0, 127, 0, 127, 0, 0, 127, 127, 0};
    const std::size_t positionView =
        compressedView(file, compressedVertices(corners.data(), 4, 12), 12, 4, "ATTRIBUTES");
    const std::size_t normalView =
        compressedView(file, compressedVertices(normals.data(), 4, 4), 4, 4, "ATTRIBUTES", "OCTAHEDRAL");
    const std::size_t indexView = compressedView(file, indices, 4, 6, "TRIANGLES");
    const auto accessor = [&](std::size_t view, int componentType, const char* type, int count) {
        return file.add("accessors", {{"bufferView", view},
                                      {"componentType", componentType},
                                      {"type", type},
                                      {"count", count},
                                      {"normalized", componentType == 5120}});
    };
    json& primitive = file.primitive({{"POSITION", accessor(positionView, 5126, "VEC3", 4)},
                                      {"NORMAL", accessor(normalView, 5120, "VEC3", 4)}});
    primitive["indices"] = accessor(indexView, 5125, "SCALAR", 6);
    return file;
}

TEST_F(GltfTest, MeshoptIsDecompressed) {
    const Geometry geometry = mesh(meshoptFile()).geometry;
    ASSERT_EQ(geometry.triangles.size(), 2u);
    EXPECT_EQ(areaVector(geometry, 0) + areaVector(geometry, 1), V(0, 0, 1));
    const auto normalAt = [&](const V& position) {
        const auto found = std::find(geometry.positions.begin(), geometry.positions.end(), position);
        return geometry.normals[static_cast<std::size_t>(found - geometry.positions.begin())];
    };
    EXPECT_THAT(normalAt(V(1, 0, 0)), IsNear(V(0, 0, 1), 1e-2f));
    EXPECT_THAT(normalAt(V(1, 1, 0)), IsNear(V(1, 0, 0), 1e-2f));
    EXPECT_THAT(normalAt(V(0, 1, 0)), IsNear(V(0, 1, 0), 1e-2f));
}

TEST_F(GltfTest, DamagedMeshoptIsAnError) {
    const GltfFile good = meshoptFile();
    const auto expectError = [&](const char* key, json value, const std::string& error,
                                 std::size_t view = 0) {
        GltfFile file = good;
        file.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"][key] = std::move(value);
        EXPECT_EQ(errorOfGltf(file), "mesh.gltf: bufferViews[" + std::to_string(view) +
                                         "].extensions.EXT_meshopt_compression" + error);
    };
    expectError("byteLength", 8, ": the compressed data is damaged; expected 4 elements");
    expectError("count", 2000000000, ": the compressed data is damaged; expected 2000000000 elements");
    expectError("byteStride", 10, ".byteStride: is 10; expected a multiple of 4");
    expectError("byteStride", 12, ".byteStride: is 12; expected 4 or 8", 1);
    expectError("byteStride", 3, ".byteStride: is 3; expected 2 or 4, the size of an index", 2);
    expectError("count", 5, ".count: is 5; expected a multiple of 3", 2);
    expectError("filter", "OCTAHEDRAL", R"(.filter: is "OCTAHEDRAL"; expected "NONE" in this mode)", 2);
    expectError("mode", "TRIANGLE", R"(.mode: is "TRIANGLE"; did you mean "TRIANGLES"?)");
    expectError("byteLength", 100000,
                ": takes 100000 bytes from byte 0 of a buffer of " + std::to_string(good.binary.size()) +
                    " bytes; expected a part of the buffer");
}

}  // namespace
}  // namespace duolux::test
