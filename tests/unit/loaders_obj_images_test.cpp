// Texture coordinates of OBJ files, and the images that MTL files name.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "host/loaders/material_files.h"
#include "host/loaders/mtl_map.h"
#include "host/loaders/obj.h"
#include "tests/unit/scene_files.h"

namespace duolux::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ObjImagesTest : public SceneFiles {
  protected:
    static constexpr const char* kVertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

    Mesh mesh(const std::string& text) const {
        MaterialFiles files(Reading::kLenient);
        return duolux::loadObj(write("mesh.obj", text), files);
    }
    Mesh meshWith(const std::string& mtl) const {
        write("m.mtl", mtl);
        return mesh(std::string("mtllib m.mtl\nusemtl a\nvt 0 0\n") + kVertices + "f 1/1 2/1 3/1\n");
    }
    static glm::vec2 uvAt(const Geometry& geometry, std::size_t triangle, const glm::vec3& place) {
        for (int k = 0; k < 3; ++k) {
            if (geometry.positions[geometry.triangles[triangle][k]] == place)
                return geometry.uvs.at(geometry.uvIndices[triangle][k]);
        }
        throw std::out_of_range("no such corner");
    }
};

TEST_F(ObjImagesTest, CoordinatesPointDownTheImage) {
    const Geometry geometry =
        mesh(std::string(kVertices) + "vt 0 0\nvt 0.5 0.25\nvt 2 -1 7\nvt 0.125\nf 1/1 2/2 3/3 4/4\n")
            .geometry;
    ASSERT_EQ(geometry.uvIndices.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(uvAt(geometry, i, {0, 0, 0}), glm::vec2(0, 1));
    }
    EXPECT_EQ(uvAt(geometry, 0, {1, 0, 0}), glm::vec2(0.5f, 0.75f));
    EXPECT_EQ(uvAt(geometry, 1, {0, 1, 0}), glm::vec2(0.125f, 1.0f)) << "v is 0 by default";
    EXPECT_EQ(uvAt(geometry, 0, {1, 1, 0}), glm::vec2(2, 2));
}

TEST_F(ObjImagesTest, TrianglesWithoutValidCoordinatesHaveNone) {
    const Geometry geometry =
        mesh(std::string(kVertices) +
             "vt nan 0\nvt 0.5 0.5\nvt 1e9 0\nf 1 2 3\nf 1/2 2/2 3/2\nf 1/1 2/2 3/2\nf 1/2 2/2 "
             "3\nf 1/2 2/3 3/2\nf 1/-2 2/-2/ 4/2\nf 1/7 2/2 3/2\n")
            .geometry;
    ASSERT_EQ(geometry.uvIndices.size(), 7u);
    for (std::size_t i = 0; i < 7; ++i) {
        const bool hasUvs = geometry.uvIndices[i].x != Geometry::kNoUv;
        EXPECT_EQ(hasUvs, i == 1 || i == 5) << i;
        if (!hasUvs) continue;
        EXPECT_EQ(geometry.uvs[geometry.uvIndices[i].y], glm::vec2(0.5f));
    }
    for (const glm::vec2& uv : geometry.uvs)
        EXPECT_TRUE(std::isfinite(uv.x) && std::isfinite(uv.y));
    EXPECT_TRUE(mesh(std::string(kVertices) + "vt 0 0\nf 1 2 3\n").geometry.uvs.empty());
}

TEST_F(ObjImagesTest, CoordinatesOfALongFile) {
    // Several parts are read at once; relative indices count from the start of the file.
    std::string text;
    constexpr int kFaces = 120'000;
    for (int i = 0; i < kFaces; ++i)
        text += fmt::format("v {0} 0 0\nv {0} 1 0\nv {0} 0 1\nvt {1} 0\nvt 0 0\nf -3/-2 -2/-1 -1/{2}\n", i,
                            i % 1000, 2 * i + 2);
    const Geometry geometry = mesh(text).geometry;
    ASSERT_EQ(geometry.uvIndices.size(), static_cast<std::size_t>(kFaces));
    for (std::size_t i = 0; i < kFaces; i += 997) {
        EXPECT_EQ(geometry.uvs[geometry.uvIndices[i].x].x, static_cast<float>(i % 1000));
        EXPECT_EQ(geometry.uvIndices[i], glm::uvec3(2 * i, 2 * i + 1, 2 * i + 1));
    }
}

TEST_F(ObjImagesTest, ImagesAreFoundAsTheMtlFilesAre) {
    std::filesystem::create_directory(folder_ / "tex");
    write("tex/wood.png", "-");
    write("Stone Wall.JPG", "-");
    for (const char* const name :
         {"tex/wood.png", "tex\\wood.png", "tex/WOOD.png", "tex/wood", "\"tex/wood.png\"",
          "tex/wood.png # oak", "-s 2 2 1 tex/wood.png", "./tex/wood.png"}) {
        const Mesh read = meshWith(std::string("newmtl a\nmap_Kd ") + name + "\n");
        ASSERT_EQ(read.images.size(), 1u) << name;
        EXPECT_TRUE(std::filesystem::equivalent(read.images[0].path, folder_ / "tex/wood.png")) << name;
        EXPECT_THAT(read.files, Contains(read.images[0].path)) << "so that no output overwrites it";
        EXPECT_THAT(read.warnings, IsEmpty()) << name;
    }
    for (const char* const name :
         {"Stone Wall.JPG", "stone wall.jpg", "C:\\My Textures\\stone wall.jpg", "stone wall"})
        EXPECT_EQ(meshWith(std::string("newmtl a\nmap_Kd ") + name + "\n").images.size(), 1u) << name;
}

TEST_F(ObjImagesTest, OnlyTheImagesOfUsedMaterialsAreInTheMesh) {
    for (const char* const name : {"1.png", "2.png", "3.png"})
        write(name, "-");
    write("m.mtl", "newmtl x\nmap_Kd 1.png\nnewmtl a\nmap_Kd 2.png\nmap_Ke 3.png\nnewmtl b\nmap_Kd 3.png\n");
    const Mesh read = mesh(std::string("mtllib m.mtl\nvt 0 0\n") + kVertices +
                           "usemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1/1 3/1 4/1\n");
    ASSERT_EQ(read.images.size(), 2u);
    const auto pathOf = [&](std::size_t material, std::size_t texture) {
        return read.images[read.materials[material].textures[texture].texture.image].path.filename();
    };
    EXPECT_EQ(pathOf(0, 0), "2.png");
    EXPECT_EQ(pathOf(0, 1), "3.png");
    EXPECT_EQ(pathOf(1, 0), "3.png");
}

TEST_F(ObjImagesTest, MissingCoordinatesAreAWarning) {
    write("a.png", "-");
    write("m.mtl", "newmtl a\nmap_Kd a.png\n");
    write("mesh.obj", std::string("mtllib m.mtl\nusemtl a\n") + kVertices + "f 1 2 3\n");
    EXPECT_THAT(textsOf(load("mesh.obj").warnings),
                Contains(HasSubstr(
                    "mesh.obj: material \"a\": 1 of its triangles has no coordinates for its images")));
}

TEST_F(ObjImagesTest, OptionsOfImages) {
    const MtlMap map =
        readMtlMap("-blendu on -s 2 3 -o 0.25 0.5 0 -clamp on -imfchan m -bm 0.75 my wood.png");
    EXPECT_EQ(map.file, "my wood.png");
    EXPECT_EQ(map.wrap, Wrap::kClamp);
    EXPECT_EQ(map.filter, Filter::kLinear);
    EXPECT_EQ(map.channel, 3u);
    EXPECT_EQ(map.scale, 0.75);
    EXPECT_THAT(map.unused, IsEmpty());
    // With v up the image, (u, v) -> (2 u + 0.25, 3 v + 0.5); here v is down.
    const glm::vec2 uv(0.5f, 0.125f), transformed = map.transform.scale * uv + map.transform.offset;
    EXPECT_FLOAT_EQ(transformed.x, 2.0f * 0.5f + 0.25f);
    EXPECT_FLOAT_EQ(1.0f - transformed.y, 3.0f * (1.0f - 0.125f) + 0.5f);

    EXPECT_EQ(readMtlMap("wood.png").transform, UvTransform());
    EXPECT_EQ(readMtlMap("-s 2 wood.png").transform.scale, glm::vec2(2, 1));
    EXPECT_EQ(readMtlMap("-blendv off wood.png").filter, Filter::kNearest);
    EXPECT_EQ(readMtlMap("-clamp off wood.png").wrap, Wrap::kRepeat);
    EXPECT_EQ(readMtlMap("-wood.png").file, "-wood.png");
    EXPECT_EQ(readMtlMap("").file, "");
    EXPECT_EQ(readMtlMap("-mm 0.25 2 wood.png").base, 0.25);
    EXPECT_EQ(readMtlMap("-mm 0.25 2 wood.png").gain, 2.0);
    EXPECT_EQ(readMtlMap("-mm 0.25 wood.png").gain, 1.0);
    EXPECT_THAT(readMtlMap("-mm 0.5 2 wood.png").unused, IsEmpty());
    EXPECT_THAT(readMtlMap("-mm 0 1 -boost 0 -cc off -t 0 0 0 a.png").unused, IsEmpty()) << "without effect";
    const MtlMap odd = readMtlMap("-mm 1e9 2 -new 3 -s x -o 1e9 -imfchan z a.png");
    EXPECT_THAT(odd.unused, ElementsAre("-mm", "-new", "-s"));
    EXPECT_EQ(odd.file, "x -o 1e9 -imfchan z a.png");
    EXPECT_THAT(readMtlMap("-o 1e9 -imfchan z a.png").unused, ElementsAre("-o", "-imfchan"));
}

}  // namespace
}  // namespace duolux::test
