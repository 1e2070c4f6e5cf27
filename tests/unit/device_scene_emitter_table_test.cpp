#include <gtest/gtest.h>

#include <numeric>

#include "host/device_scene/emitter_table.h"
#include "host/scene/emitters.h"

namespace duolux {
namespace {

/// The probabilities that an alias table realises.
std::vector<double> probabilities(const std::vector<AliasEntry>& table) {
    std::vector<double> p(table.size());
    for (std::size_t i = 0; i < table.size(); ++i) {
        p[i] += static_cast<double>(table[i].threshold) / static_cast<double>(table.size());
        p[table[i].alias] +=
            (1.0 - static_cast<double>(table[i].threshold)) / static_cast<double>(table.size());
    }
    return p;
}

TEST(AliasTable, RealisesItsWeights) {
    const std::vector<std::vector<double>> cases{
        {1}, {1, 1}, {1, 0}, {0, 0, 5, 0}, {1, 2, 3, 4, 5, 6, 7}, {1e-9, 1, 1e9}, {3, 3, 3, 3, 3, 3, 3, 3.1}};
    for (const std::vector<double>& weights : cases) {
        const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
        const std::vector<double> p = probabilities(buildAliasTable(weights));
        for (std::size_t i = 0; i < weights.size(); ++i)
            EXPECT_NEAR(p[i], weights[i] / total, 1e-7);
    }
}

LoadedScene twoEmitters() {
    LoadedScene scene;
    scene.geometry.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {0, 2, 0}};
    scene.geometry.triangles = {{0, 1, 2}, {0, 3, 4}, {0, 1, 4}};
    scene.geometry.materials = {0, 1, 2};
    scene.materials.resize(3);
    scene.materials[0].emission = {glm::vec3(3.0f), glm::vec3(0.0f), Sides::kFront};
    scene.materials[1].emission = {glm::vec3(1.0f), glm::vec3(5.0f), Sides::kBoth};
    return scene;
}

EmitterTable tableOf(const LoadedScene& scene, bool bothComponents) {
    return buildEmitterTable(scene, listEmitters(scene), bothComponents);
}

TEST(EmitterTable, DensityIsPowerOverTotalPower) {
    const EmitterTable table = tableOf(twoEmitters(), false);
    ASSERT_EQ(table.records.size(), 2u);
    EXPECT_EQ(table.choices, 2u);
    // Areas 0.5 and 2; brightness 9 and 3, the latter on both sides: powers 4.5 and 12.
    EXPECT_FLOAT_EQ(table.records[0].density, 9.0f / 16.5f);
    EXPECT_FLOAT_EQ(table.records[1].density, 6.0f / 16.5f);
    // The density integrates to 1 over the emitters.
    EXPECT_FLOAT_EQ(0.5f * table.records[0].density + 2.0f * table.records[1].density, 1.0f);
}

TEST(EmitterTable, VisibleEmissionCountsWhereItCanReachSurfaces) {
    const EmitterTable table = tableOf(twoEmitters(), true);
    // Brightness 9 and 18 on both sides: powers 4.5 and 72.
    EXPECT_FLOAT_EQ(table.records[1].density, 36.0f / 76.5f);
}

// Emitters of visible light alone are recorded, because the camera sees them, but not sampled.
TEST(EmitterTable, VisibleEmissionAloneGivesNothingToChooseFrom) {
    LoadedScene scene = twoEmitters();
    for (Material& material : scene.materials)
        material.emission.invisible = glm::vec3(0.0f);
    const EmitterTable invisible = tableOf(scene, false);
    EXPECT_EQ(invisible.choices, 0u);
    ASSERT_EQ(invisible.records.size(), 1u);
    EXPECT_EQ(invisible.records[0].visible, glm::vec3(5.0f));
    EXPECT_EQ(invisible.records[0].density, 0.0f);
    EXPECT_EQ(tableOf(scene, true).choices, 1u);
}

// A point of intensity I has the power 4 pi I, a triangle of one side pi L A.
TEST(EmitterTable, PointsFollowAndAreChosenByPower) {
    LoadedScene scene = twoEmitters();
    scene.pointEmitters = {{glm::vec3(1, 2, 3), glm::vec3(0.5f), glm::vec3(0.25f)}};
    const EmitterTable table = tableOf(scene, false);
    ASSERT_EQ(table.records.size(), 3u);
    EXPECT_EQ(table.choices, 3u);
    EXPECT_EQ(table.records[2].v0, glm::vec3(1, 2, 3));
    EXPECT_EQ(table.records[2].flags, shared::kEmitterKindPoint);
    EXPECT_EQ(table.records[2].visible, glm::vec3(0.25f));
    // Powers over pi: 4.5 and 12 as above, and 4 times 1.5.
    EXPECT_FLOAT_EQ(table.records[2].density, 6.0f / 22.5f);
    EXPECT_FLOAT_EQ(table.records[0].density, 9.0f / 22.5f);
    // Points alone.
    for (Material& material : scene.materials)
        material.emission = {};
    EXPECT_FLOAT_EQ(tableOf(scene, true).records.at(0).density, 1.0f);
}

// Emitters first, in their order, then the remaining triangles in theirs.
TEST(TriangleRanks, EmittersComeFirst) {
    const std::vector<std::uint32_t> emitters{2, 3, 7};
    const TriangleRanks ranks(emitters);
    const std::vector<std::uint32_t> expected{3, 4, 0, 1, 5, 6, 7, 2, 8};
    for (std::uint32_t i = 0; i < expected.size(); ++i)
        EXPECT_EQ(ranks.rankOf(i), expected[i]) << i;
    EXPECT_EQ(TriangleRanks({}).rankOf(5), 5u);
}

}  // namespace
}  // namespace duolux
