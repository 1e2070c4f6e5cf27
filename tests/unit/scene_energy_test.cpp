#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>
#include <vector>

#include "host/scene/emitters.h"
#include "host/scene/energy.h"

namespace duolux {
namespace {

MaterialEnergy energyOf(const char* preset, float albedo) {
    return materialEnergy(*presetReflectance(preset), glm::vec3(albedo));
}

TEST(Energy, FactorsOfThePresets) {
    EXPECT_FLOAT_EQ(energyOf("global", 0.75f).factor.x, 0.75f);
    EXPECT_FLOAT_EQ(energyOf("local", 0.75f).factor.x, 1.0f);
    EXPECT_FLOAT_EQ(energyOf("shadowless", 0.75f).factor.x, 1.75f);
    EXPECT_FLOAT_EQ(energyOf("one-bounce", 0.75f).factor.x, 0.0f);
}

TEST(Energy, OnlyScatteringThatRecursMayGrow) {
    EXPECT_FALSE(energyOf("global", 0.999f).mayGrow());
    EXPECT_TRUE(energyOf("global", 1.0f).mayGrow());
    EXPECT_TRUE(energyOf("shadowless", 0.01f).mayGrow());
    EXPECT_FALSE(energyOf("shadowless", 0.0f).mayGrow()) << "black surfaces only let pass";
    EXPECT_FALSE(energyOf("local", 1.0f).mayGrow())
        << "invisible light scatters into visible light, and ends";
    EXPECT_FALSE(energyOf("one-bounce", 1.0f).mayGrow());
}

TEST(Energy, OffDiagonalEntriesMakeACycle) {
    // [[0, 4], [1, 0]] has the eigenvalues +-2: scattering events alternate between the components.
    Reflectance reflectance;
    reflectance.opaque.m01 = glm::vec3(4.0f);
    reflectance.opaque.m10 = glm::vec3(1.0f);
    const MaterialEnergy energy = materialEnergy(reflectance, glm::vec3(1.0f, 0.5f, 0.25f));
    EXPECT_FLOAT_EQ(energy.factor.x, 2.0f);
    EXPECT_FLOAT_EQ(energy.factor.y, 1.0f);
    EXPECT_FLOAT_EQ(energy.factor.z, 0.5f);
    EXPECT_TRUE(energy.mayGrow());
    reflectance.opaque.m01 = glm::vec3(0.0f);
    EXPECT_FALSE(materialEnergy(reflectance, glm::vec3(1.0f)).recurs);
    reflectance.transparent.m01 = glm::vec3(1.0f);
    EXPECT_TRUE(materialEnergy(reflectance, glm::vec3(1.0f)).recurs) << "back by a crossing";
}

TEST(Energy, EigenvaluesOfAFullMatrix) {
    // [[1, 2], [3, 2]]: (3 + 5) / 2 = 4.
    Reflectance reflectance;
    reflectance.opaque = {glm::vec3(1), glm::vec3(2), glm::vec3(3), glm::vec3(0)};
    reflectance.transparent.m11 = glm::vec3(2);
    EXPECT_FLOAT_EQ(materialEnergy(reflectance, glm::vec3(1.0f)).factor.x, 4.0f);
}

/// A rectangle of area 6 that emits, and a triangle of area 2 that does not.
LoadedScene twoAreas() {
    LoadedScene scene;
    scene.geometry.positions = {{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}, {0, 0, 2}};
    scene.geometry.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 1, 4}};
    scene.geometry.materials = {0, 0, 1};
    scene.materials.resize(2);
    scene.materials[0].emission = {glm::vec3(1, 2, 3), glm::vec3(0, 0, 5), Sides::kFront};
    scene.materials[0].baseColor = glm::vec3(0.0f);
    scene.materials[1].baseColor = glm::vec3(0.4f, 0.8f, 1.0f);
    return scene;
}

TEST(Energy, PowerOfEmitters) {
    LoadedScene scene = twoAreas();
    EmitterSummary emitters = summariseEmitters(scene);
    EXPECT_EQ(emitters.triangles, 2u);
    EXPECT_NEAR(emitters.area, 6.0, 1e-9);
    EXPECT_NEAR(emitters.invisiblePower.y, 12.0 * glm::pi<double>(), 1e-9);
    EXPECT_NEAR(emitters.visiblePower.z, 30.0 * glm::pi<double>(), 1e-9);
    scene.materials[0].emission.sides = Sides::kBoth;
    EXPECT_NEAR(summariseEmitters(scene).invisiblePower.y, 24.0 * glm::pi<double>(), 1e-9);
}

TEST(Energy, PowerOfPoints) {
    LoadedScene scene = twoAreas();
    scene.pointEmitters = {{{0, 0, 9}, {1, 2, 3}, {0, 0, 7}}, {{0, 0, 8}, {0, 1, 0}, {0, 0, 0}}};
    const EmitterSummary emitters = summariseEmitters(scene);
    EXPECT_EQ(emitters.points, 2u);
    EXPECT_EQ(emitters.triangles, 2u);
    EXPECT_NEAR(emitters.area, 6.0, 1e-9);
    EXPECT_NEAR(emitters.invisiblePower.y, (12.0 + 4.0 * 3.0) * glm::pi<double>(), 1e-9);
    EXPECT_NEAR(emitters.visiblePower.z, (30.0 + 4.0 * 7.0) * glm::pi<double>(), 1e-9);
}

TEST(Emitters, AreTrianglesThenPoints) {
    LoadedScene scene = twoAreas();
    scene.pointEmitters = {{{0, 0, 9}, {1, 2, 3}, {0, 0, 7}}};
    const std::vector<SceneEmitter> emitters = listEmitters(scene);
    ASSERT_EQ(emitters.size(), 3u);
    for (std::uint32_t i = 0; i < 2; ++i) {
        EXPECT_EQ(emitters[i].kind, EmitterKind::kTriangle);
        EXPECT_EQ(emitters[i].index, i);
        EXPECT_EQ(emitters[i].area, 3.0);
        EXPECT_EQ(emitters[i].emission, scene.materials[0].emission);
    }
    EXPECT_EQ(emitters[2].kind, EmitterKind::kPoint);
    EXPECT_EQ(emitters[2].index, 0u);
    EXPECT_EQ(emitters[2].emission.invisible, glm::vec3(1, 2, 3));
    EXPECT_EQ(emitters[2].emission.visible, glm::vec3(0, 0, 7));
    EXPECT_EQ(emittingTriangles(scene), (std::vector<std::uint32_t>{0, 1}));
    scene.materials[0].emission = {};
    EXPECT_TRUE(emittingTriangles(scene).empty());
    EXPECT_TRUE(anyEmitter(scene));
    scene.pointEmitters.clear();
    EXPECT_FALSE(anyEmitter(scene));
}

template <typename Change>
glm::vec3 albedoOf(float base, const Change& change) {
    Material material;
    material.baseColor = glm::vec3(base);
    change(material);
    return meanAlbedo(material);
}

TEST(Energy, WhatAbsorbsNothingIsExactlyWhite) {
    const auto expectWhite = [](const char* name, auto&& change) {
        EXPECT_EQ(albedoOf(1.0f, change), glm::vec3(1.0f)) << name;
    };
    for (const float part : {0.1f, 0.3f, 0.7f, 1.0f}) {
        expectWhite("metal", [&](Material& m) { m.metallic = part; });
        expectWhite("dielectric", [&](Material& m) { m.specular = part; });
        expectWhite("glass", [&](Material& m) { m.specular = 1.0f, m.transmission = part; });
        expectWhite("clearcoat", [&](Material& m) { m.clearcoat = part; });
        expectWhite("sheen", [&](Material& m) { m.sheenColor = glm::vec3(part), m.sheenRoughness = part; });
    }
}

TEST(Energy, LayersAndReflectionsOnBlackScatter) {
    // Means over the hemisphere of Schlick's reflectance: f0 + (1 - f0) / 21.
    const float varnish = 0.04f + 0.96f / 21.0f;
    EXPECT_FLOAT_EQ(albedoOf(0.0f, [](Material& m) { m.specular = 1.0f; }).y, varnish);
    EXPECT_FLOAT_EQ(albedoOf(0.0f, [](Material& m) { m.clearcoat = 0.5f; }).y, 0.5f * varnish);
    EXPECT_FLOAT_EQ(albedoOf(0.0f, [](Material& m) { m.transmission = 1.0f, m.ior = 3.0f; }).y,
                    0.25f + 0.75f / 21.0f);
    EXPECT_FLOAT_EQ(albedoOf(0.0f, [](Material& m) { m.metallic = 1.0f; }).y, 1.0f / 21.0f);
    // By quadrature of the sheen's albedo, at most 1 in any direction.
    for (const auto& [roughness, mean] : {std::pair(0.1f, 0.0451f), {0.5f, 0.1427f}, {1.0f, 0.2997f}}) {
        EXPECT_NEAR(
            albedoOf(0.0f, [&](Material& m) { m.sheenColor.y = 1.0f, m.sheenRoughness = roughness; }).y, mean,
            0.003f);
    }
    // Sheen of one channel takes from all.
    EXPECT_LT(albedoOf(1.0f, [](Material& m) { m.sheenColor.y = m.sheenRoughness = 1.0f; }).x, 0.75f);
    EXPECT_EQ(albedoOf(0.0f, [](Material&) {}), glm::vec3(0.0f));
}

TEST(Energy, MeanAlbedoIsByArea) {
    const glm::dvec3 albedo = meanAlbedo(twoAreas());
    EXPECT_NEAR(albedo.x, 0.4 * 2 / 8, 1e-6);
    EXPECT_NEAR(albedo.z, 1.0 * 2 / 8, 1e-6);
}

}  // namespace
}  // namespace duolux
