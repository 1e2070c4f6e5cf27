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

// Hashes of films that ensure that refactoring leaves images bitwise identical, for every preset, integrator,
// layout and kernel. They are valid for lavapipe 22.3 (LLVM 15) on x86-64 processors with FMA, and therefore
// not part of every run.

namespace duolux::test {

namespace {

struct Expected {
    const char* scene;
    const char* preset;
    std::uint64_t path, light;
};

constexpr Expected kExpected[] = {
    {"cornell", "local", 0x491654071959e41a, 0x139920d76d074adc},
    {"cornell", "global", 0x3de835ae30340c59, 0x313a6a18a8f0ed63},
    {"cornell", "shadowless", 0x12c73ac1c0faa1b7, 0x7e58356caf430fd3},
    {"cornell", "one-bounce", 0x5459c41beaeeae53, 0xa59b13c9062862e1},
    {"spot", "local", 0x9a9443cbc9accd12, 0xd2109fab75b4f73a},
    {"spot", "global", 0x858169b5cb755526, 0x3f0b873036fc81fe},
    {"spot", "shadowless", 0xe4429d42a9a46722, 0x3c4408ef42ee645f},
    {"spot", "one-bounce", 0xb1904a30e6276902, 0xb2ca4cbb38ed595f},
    {"uplight", "local", 0x98fd6b0ec0b028b5, 0x451f18fefc103ee9},
    {"uplight", "global", 0xad692ff7de5bca8c, 0x34f10c9bba64499a},
    {"uplight", "shadowless", 0x295f1fe4fc0b3efc, 0xa8d0f025e3e19a9e},
    {"uplight", "one-bounce", 0x30a055a029cdab66, 0x23914182f5dbdb0d},
    {"two-spheres", "local", 0x7ecc2e6c155643dc, 0xfac12c892dd69e88},
    {"two-spheres", "global", 0xf1b2604555b53265, 0x338a2abdcdd981a4},
    {"two-spheres", "shadowless", 0x2109b5bbe6b52105, 0x1aa98016caba9837},
    {"two-spheres", "one-bounce", 0xda066579f245f7c0, 0x824fd5fa09e24e4f},
};

void PrintTo(const Expected& expected, std::ostream* out) {
    *out << expected.scene << ' ' << expected.preset;
}

std::uint64_t hashOf(const Film& film) {
    std::uint64_t hash = XXH3_64bits(film.samples().data(), film.samples().size_bytes());
    for (const std::span<const Film::PixelSum> sums : {film.sums(), film.lightPathSums()})
        hash = XXH3_64bits_withSeed(sums.data(), sums.size_bytes(), hash);
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
    for (const TuningChoice& tuning : allTunings(device().info())) {
        if (tuning.layout == Layout::kRayQuery) continue;  // the driver rounds in its own way
        RenderControl control;
        control.tuning = tuning;
        EXPECT_EQ(hashOf(render(device(), scene, control).film), GetParam().path) << nameOf(tuning);
        EXPECT_EQ(hashOf(render(device(), byLight(scene), control).film), GetParam().light) << nameOf(tuning);
    }
}

INSTANTIATE_TEST_SUITE_P(All, FilmBits, testing::ValuesIn(kExpected));

}  // namespace

}  // namespace duolux::test
