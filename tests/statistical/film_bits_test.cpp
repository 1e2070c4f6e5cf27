#include <gtest/gtest.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <filesystem>
#include <span>
#include <string>

#include "host/base/temporary_folder.h"
#include "host/generators/two_spheres.h"
#include "host/view/load.h"
#include "tests/statistical/films.h"
#include "tests/statistical/renders.h"
#include "tests/support/device.h"
#include "tests/support/tunings.h"

// Hashes of films that ensure that refactoring leaves images bitwise identical. They are valid for lavapipe
// 22.3 (LLVM 15) on x86-64 processors with FMA, and therefore not part of every run. layouts_test.cpp
// compares layouts and kernels with each other.

namespace duolux::test {

namespace {

struct Expected {
    const char* scene;
    const char* preset;
    std::uint64_t path, light;
};

constexpr Expected kExpected[] = {
    {"cornell", "local", 0x0eb83f64e9b4fe98, 0xa91b609c53284df9},
    {"cornell", "global", 0xf00281b2d1e955ce, 0x07a8f2914ed395a9},
    {"cornell", "shadowless", 0x9025f802a1a2bb78, 0x8b8e5380fa97c3dc},
    {"cornell", "one-bounce", 0x5459c41beaeeae53, 0x9d200afc922acf00},
    {"spot", "local", 0x9a9443cbc9accd12, 0xa682733ef4d36fee},
    {"spot", "global", 0x700b41bfdd59c4ff, 0x0b859ae1a594bb3d},
    {"spot", "shadowless", 0x75676fd0c50df808, 0xb792280ed476e65c},
    {"spot", "one-bounce", 0xb1904a30e6276902, 0x4c96137eadc138b6},
    {"uplight", "local", 0x5e4d9e26cfc36629, 0x573ad7224c3d5cae},
    {"uplight", "global", 0xca833c46d8ccfa52, 0x7b8567a69606fa68},
    {"uplight", "shadowless", 0xbba938013849fb17, 0x821a87e51f1f1f41},
    {"uplight", "one-bounce", 0x30a055a029cdab66, 0x3218e47495a581cd},
    {"two-spheres", "local", 0x0a94d2bba1704f33, 0x0fc080def2179c1b},
    {"two-spheres", "global", 0x32e34d68daa1b7ff, 0x1eb618ddd447debb},
    {"two-spheres", "shadowless", 0xa4954b41562b270d, 0x2fca06e8ff782546},
    {"two-spheres", "one-bounce", 0xda066579f245f7c0, 0xc00f81ea971e37f3},
};

void PrintTo(const Expected& expected, std::ostream* out) {
    *out << expected.scene << ' ' << expected.preset;
}

std::uint64_t hashOf(const Film& film) {
    std::uint64_t hash = XXH3_64bits(film.samples().data(), film.samples().size_bytes());
    for (const std::span<const Film::PixelSum> sums : {film.sums(), film.lightSums()})
        hash = XXH3_64bits_withSeed(sums.data(), sums.size_bytes(), hash);
    const float quantum = film.quantum();
    return XXH3_64bits_withSeed(&quantum, sizeof quantum, hash);
}

LoadedScene loadNamed(const std::string& name) {
    const SceneChoices choices{.size = glm::uvec2(40, 30)};
    if (name == "two-spheres") {
        const TemporaryFolder folder;
        writeTwoSpheres(folder.path(), 3000);
        return loadScene(folder.path() / "two_spheres.json", choices);
    }
    return loadScene(std::filesystem::path(DUOLUX_ASSETS) / name / (name + ".json"), choices);
}

class FilmBits : public testing::TestWithParam<Expected> {};

TEST_P(FilmBits, AreTheSameAsBefore) {
    LoadedScene scene = loadNamed(GetParam().scene);
    scene.reflectance = *presetReflectance(GetParam().preset);
    scene.settings.spp = 4;
    scene.settings.bounces = 6;
    scene.settings.integrator = Integrator::kPath;
    EXPECT_EQ(hashOf(render(device(), scene).film), GetParam().path);
    EXPECT_EQ(hashOf(render(device(), byLight(scene)).film), GetParam().light);
}

INSTANTIATE_TEST_SUITE_P(All, FilmBits, testing::ValuesIn(kExpected));

}  // namespace

}  // namespace duolux::test
