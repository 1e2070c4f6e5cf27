#include <gtest/gtest.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <filesystem>
#include <span>
#include <string>

#include "host/cli/temporary_folder.h"
#include "host/generators/two_spheres.h"
#include "host/view/load.h"
#include "tests/statistical/films.h"
#include "tests/statistical/renders.h"
#include "tests/support/device.h"
#include "tests/support/tunings.h"

// Hashes of films that ensure that refactoring leaves images bitwise identical, for every preset, integrator,
// layout and kernel. They are valid for lavapipe 22.3 (LLVM 15) on x86-64 processors with FMA, and therefore
// not part of every run.

namespace duolux::test {

namespace {

struct Expected {
    const char* scene;
    const char* preset;
    std::uint64_t path, light;
    FilmLayerSet layers = 0;  ///< only the path tracer has layers
};

constexpr Expected kExpected[] = {
    {"cornell", "local", 0x74ff0a80d7eda82d, 0x139920d76d074adc},
    {"cornell", "global", 0xb781af1890d0d231, 0x5481b022014d5586},
    {"cornell", "shadowless", 0x1a914428085618bb, 0x4e4d8962e9f83304},
    {"cornell", "one-bounce", 0xd75efd9b112d326b, 0xa59b13c9062862e1},
    {"spot", "local", 0x398bd6f4d57a8c1d, 0xd2109fab75b4f73a},
    {"spot", "global", 0x858169b5cb755526, 0xe86b99c7e63c7c39},
    {"spot", "shadowless", 0xadd8f5371ebab565, 0x801089a8eb8eda1b},
    {"spot", "one-bounce", 0xc3c08a030d0294a6, 0xb2ca4cbb38ed595f},
    {"uplight", "local", 0xe1f6ad4c7dae8d98, 0x451f18fefc103ee9},
    {"uplight", "global", 0xad692ff7de5bca8c, 0xdf149a3e3ecd44e7},
    {"uplight", "shadowless", 0x3acfdd074400612d, 0x769131d8adf5f16e},
    {"uplight", "one-bounce", 0x30a055a029cdab66, 0x23914182f5dbdb0d},
    {"two-spheres", "local", 0xf326de607007ed4d, 0xfac12c892dd69e88},
    {"two-spheres", "global", 0xaeeed8c35f8bc96d, 0x54a0becb1fc2b41b},
    {"two-spheres", "shadowless", 0x8777ff52e70b68c1, 0x9a11915bd10bfd23},
    {"two-spheres", "one-bounce", 0xda066579f245f7c0, 0x824fd5fa09e24e4f},
    {"spot", "global", 0x8159795386d15f55, 0, kLayerNormal},
};

void PrintTo(const Expected& expected, std::ostream* out) {
    *out << expected.scene << ' ' << expected.preset;
    for (const std::string& layer : namesOf(expected.layers))
        *out << ' ' << layer;
}

std::uint64_t hashOf(const Film& film) {
    std::uint64_t hash = XXH3_64bits(film.samples().data(), film.samples().size_bytes());
    for (const std::span<const Film::PixelSum> sums : {film.sums(), film.lightPathSums()})
        hash = XXH3_64bits_withSeed(sums.data(), sums.size_bytes(), hash);
    if (film.layers() != 0) {
        const FilmLayerSet layers = film.layers();
        hash = XXH3_64bits_withSeed(&layers, sizeof layers, hash);
        hash = XXH3_64bits_withSeed(film.layerSums().data(), film.layerSums().size_bytes(), hash);
    }
    for (const auto& [sum, count] : film.carries()) {
        hash = XXH3_64bits_withSeed(&sum, sizeof sum, hash);
        hash = XXH3_64bits_withSeed(&count, sizeof count, hash);
    }
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
    scene.settings.integrator = Integrator::kPathTracer;
    scene.settings.layers = GetParam().layers;
    for (const TuningChoice& tuning : allTunings(device().info())) {
        if (tuning.layout == Layout::kRayQuery) continue;  // the driver rounds in its own way
        RenderControl control;
        control.tuning = tuning;
        EXPECT_EQ(hashOf(render(device(), scene, control).film), GetParam().path) << nameOf(tuning);
        if (scene.settings.layers != 0) continue;
        EXPECT_EQ(hashOf(render(device(), byLight(scene), control).film), GetParam().light) << nameOf(tuning);
    }
}

INSTANTIATE_TEST_SUITE_P(All, FilmBits, testing::ValuesIn(kExpected));

}  // namespace

}  // namespace duolux::test
