#include <gtest/gtest.h>

#include <memory>

#include "host/device_scene/smoothness.h"
#include "host/device_scene/transport.h"

namespace duolux {
namespace {

Scene sceneWith(const Reflectance& reflectance) {
    Scene scene;
    scene.geometry.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    scene.geometry.triangles = {{0, 1, 2}, {2, 1, 0}};
    scene.geometry.materials = {0, 1};
    scene.materials.resize(2);
    scene.materials[0].emission.invisible = glm::vec3(4.0f);
    scene.reflectance = reflectance;
    return scene;
}

TransportTraits traitsOf(std::string_view preset) {
    return analyseTransport(sceneWith(*presetReflectance(preset)));
}

TEST(Transport, Presets) {
    EXPECT_EQ(traitsOf("global").transparency, shared::kTransparencyZero);
    EXPECT_EQ(traitsOf("one-bounce").transparency, shared::kTransparencyZero);
    EXPECT_EQ(traitsOf("local").transparency, shared::kTransparencyIdentity);
    EXPECT_EQ(traitsOf("shadowless").transparency, shared::kTransparencyIdentity);
    EXPECT_EQ(traitsOf("local").mostScatterings, 1u);
    EXPECT_EQ(traitsOf("one-bounce").mostScatterings, 1u);
    EXPECT_EQ(traitsOf("global").mostScatterings, TransportTraits::kUnlimited);
    EXPECT_EQ(traitsOf("shadowless").mostScatterings, TransportTraits::kUnlimited);
    EXPECT_FALSE(traitsOf("local").invisibleScatters);
    EXPECT_TRUE(traitsOf("local").invisibleCrosses);
    for (const Preset& preset : presets()) {
        EXPECT_TRUE(traitsOf(preset.name).oneReflectance);
        EXPECT_FALSE(traitsOf(preset.name).secondColumn);
        EXPECT_TRUE(traitsOf(preset.name).visibleScatters);
        EXPECT_FALSE(traitsOf(preset.name).visibleCrosses);
    }
}

TEST(Transport, PartialTransmissionIsGeneral) {
    EXPECT_EQ(analyseTransport(sceneWith(blendReflectance(0.5f, 1.0f))).transparency,
              shared::kTransparencyGeneral);
}

TEST(Transport, LightOnItsWayToTheCameraHasBothComponents) {
    for (const Preset& preset : presets())
        EXPECT_EQ(traitsOf(preset.name).cameraTransparency, traitsOf(preset.name).transparency);
    // Invisible light that a crossing makes visible is lost on surfaces, but reaches the camera.
    Reflectance glowing = *presetReflectance("local");
    glowing.transparent.m10 = {0.0f, 0.0f, 0.5f};
    EXPECT_EQ(analyseTransport(sceneWith(glowing)).transparency, shared::kTransparencyIdentity);
    EXPECT_EQ(analyseTransport(sceneWith(glowing)).cameraTransparency, shared::kTransparencyGeneral);
}

// The matrix passes the invisible component unchanged only if it does so in every channel.
TEST(Transport, IdentityIsThatOfAllChannels) {
    for (int channel = 0; channel < 3; ++channel) {
        for (const float other : {0.5f, 2.0f}) {
            Scene scene = sceneWith(*presetReflectance("local"));
            scene.materials[1].reflectance = scene.reflectance;
            scene.materials[1].reflectance->transparent.m00[channel] = other;
            EXPECT_EQ(analyseTransport(scene).transparency, shared::kTransparencyGeneral) << channel;
            scene.reflectance.transparent.m00[channel] = other;
            EXPECT_EQ(analyseTransport(scene).cameraTransparency, shared::kTransparencyGeneral) << channel;
        }
    }
}

TEST(Transport, OneOpaqueMaterialMakesShadows) {
    Scene scene = sceneWith(*presetReflectance("shadowless"));
    scene.materials[1].reflectance = presetReflectance("global");
    const TransportTraits traits = analyseTransport(scene);
    EXPECT_EQ(traits.transparency, shared::kTransparencyGeneral);
    EXPECT_FALSE(traits.oneReflectance);
}

TEST(Transport, UnusedMaterialsDoNotCount) {
    Scene scene = sceneWith(*presetReflectance("global"));
    scene.materials.push_back({});
    scene.materials.back().reflectance = presetReflectance("local");
    EXPECT_EQ(analyseTransport(scene).transparency, shared::kTransparencyZero);
    EXPECT_TRUE(analyseTransport(scene).oneReflectance);
}

TEST(Transport, SecondColumn) {
    Reflectance reflectance = *presetReflectance("global");
    reflectance.opaque.m01 = {0.0f, 0.1f, 0.0f};
    EXPECT_TRUE(analyseTransport(sceneWith(reflectance)).secondColumn);
    // Then the identity on the invisible component alone is not enough.
    reflectance.transparent.m00 = glm::vec3(1.0f);
    EXPECT_EQ(analyseTransport(sceneWith(reflectance)).transparency, shared::kTransparencyGeneral);
}

// What a surface that is there in part lets the camera see is in the second column, but only before the path
// scatters.
TEST(Transport, PartialSurfacesKeepTheIdentity) {
    for (const Preset& preset : presets()) {
        Scene scene = sceneWith(*presetReflectance(preset.name));
        const std::uint32_t opaque = analyseTransport(scene).transparency;
        scene.materials[1].alpha = {AlphaMode::kBlend, 0.5f, 0.5f};
        const TransportTraits traits = analyseTransport(scene);
        EXPECT_TRUE(traits.coverage);
        const bool identity = opaque == shared::kTransparencyIdentity;
        EXPECT_EQ(traits.secondColumn, identity);
        EXPECT_EQ(traits.transparency,
                  identity ? shared::kTransparencyIdentity : shared::kTransparencyCoverage);
        EXPECT_EQ(traits.cameraTransparency,
                  identity ? shared::kTransparencyGeneral : shared::kTransparencyCoverage);
        EXPECT_TRUE(traits.invisibleCrosses);
        EXPECT_TRUE(traits.visibleCrosses);
    }
    // Where another surface has a T, a number is not enough.
    Scene scene = sceneWith(*presetReflectance("global"));
    scene.materials[1].alpha = {AlphaMode::kBlend, 0.5f, 0.5f};
    scene.materials[0].reflectance = presetReflectance("shadowless");
    EXPECT_EQ(analyseTransport(scene).transparency, shared::kTransparencyGeneral);
    EXPECT_TRUE(analyseTransport(scene).secondColumn);
    // O may have a second column all the same.
    Reflectance reflectance = *presetReflectance("global");
    reflectance.opaque.m01 = glm::vec3(0.1f);
    scene = sceneWith(reflectance);
    scene.materials[1].alpha = {AlphaMode::kBlend, 0.5f, 0.5f};
    EXPECT_EQ(analyseTransport(scene).transparency, shared::kTransparencyCoverage);
    EXPECT_TRUE(analyseTransport(scene).secondColumn);
    // Invisible importance that a crossing makes visible is stopped by the next surface.
    Reflectance crossing = *presetReflectance("local");
    crossing.transparent.m01 = glm::vec3(0.1f);
    EXPECT_EQ(analyseTransport(sceneWith(crossing)).transparency, shared::kTransparencyGeneral);
}

/// Importance that alternates between the components: with 01 and 10 the series is infinite, with 10 alone it
/// ends after one event.
TEST(Transport, ScatteringsFollowTheComponents) {
    Reflectance reflectance;
    reflectance.opaque.m10 = glm::vec3(1.0f);
    EXPECT_EQ(analyseTransport(sceneWith(reflectance)).mostScatterings, 1u);
    reflectance.opaque.m01 = glm::vec3(1.0f);
    EXPECT_EQ(analyseTransport(sceneWith(reflectance)).mostScatterings, TransportTraits::kUnlimited);
    // A crossing that turns invisible importance into visible importance also closes the cycle.
    reflectance.opaque.m01 = glm::vec3(0.0f);
    reflectance.transparent.m01 = glm::vec3(0.5f);
    EXPECT_EQ(analyseTransport(sceneWith(reflectance)).mostScatterings, TransportTraits::kUnlimited);
    EXPECT_EQ(analyseTransport(sceneWith({})).mostScatterings, 0u);
}

TEST(Transport, BrightestEmissionIsOfWhatIsThere) {
    Scene scene = sceneWith({});
    scene.materials[1].emission.visible = {1.0f, 9.0f, 0.0f};
    scene.materials.push_back({});
    scene.materials.back().emission.invisible = glm::vec3(1e9f);  // no triangle has it
    EXPECT_EQ(brightestEmission(scene.geometry, listEmitters(scene)), 9.0);
    scene.materials[0].emission = scene.materials[1].emission = {};
    EXPECT_EQ(brightestEmission(scene.geometry, listEmitters(scene)), 0.0);
}

/// A metal with an image of 2 x 1 pixels of these values in green, which scales the input.
Smoothness smoothnessWith(float roughness, float anisotropy, MaterialInput input, std::uint8_t first,
                          std::uint8_t second) {
    Scene scene = sceneWith(*presetReflectance("global"));
    auto image = std::make_shared<Image>();
    image->width = 2;
    image->height = 1;
    image->bytes = {0, first, first, 0, 0, second, second, 0};
    scene.images = {image};
    Material& metal = scene.materials[0];
    metal.metallic = 1.0f;
    metal.roughness = roughness;
    metal.anisotropy = anisotropy;
    metal.textures = {{input, {}, 1}};
    return smoothnessOf(scene, metal);
}

TEST(Smoothness, OfMaterialsWithoutImages) {
    const Scene scene = sceneWith(*presetReflectance("global"));
    Material material;
    material.roughness = 0.01f;
    EXPECT_EQ(smoothnessOf(scene, material), Smoothness::kNowhere) << "diffuse";
    material.specular = 0.5f;
    EXPECT_EQ(smoothnessOf(scene, material), Smoothness::kEverywhere);
    material.anisotropy = 0.5f;
    EXPECT_EQ(smoothnessOf(scene, material), Smoothness::kNowhere) << "stretched to alpha 0.25";
    material.clearcoat = 0.1f;
    EXPECT_EQ(smoothnessOf(scene, material), Smoothness::kEverywhere);
    material.clearcoatRoughness = 0.2f;
    EXPECT_EQ(smoothnessOf(scene, material), Smoothness::kNowhere);
}

// Roughness is smooth below the root of kSmoothAlpha, 0.0316, or 8.06 / 255.
TEST(Smoothness, IsThatOfTheSmallestPixel) {
    const auto rough = [](float roughness, std::uint8_t first, std::uint8_t second) {
        return smoothnessWith(roughness, 0.0f, MaterialInput::kRoughness, first, second);
    };
    EXPECT_EQ(rough(1.0f, 9, 255), Smoothness::kNowhere);
    EXPECT_EQ(rough(1.0f, 255, 8), Smoothness::kWhereImagesSaySo);
    EXPECT_EQ(rough(0.5f, 15, 255), Smoothness::kWhereImagesSaySo);
    EXPECT_EQ(rough(0.01f, 255, 255), Smoothness::kEverywhere);
    const auto stretched = [](std::uint8_t first, std::uint8_t second) {
        return smoothnessWith(0.01f, 1.0f, MaterialInput::kAnisotropy, first, second);
    };
    EXPECT_EQ(stretched(255, 200), Smoothness::kNowhere);
    EXPECT_EQ(stretched(255, 0), Smoothness::kWhereImagesSaySo);
}

}  // namespace
}  // namespace duolux
