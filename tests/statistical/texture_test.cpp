#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "host/render/renderer.h"
#include "tests/statistical/films.h"
#include "tests/statistical/renders.h"
#include "tests/support/device.h"
#include "tests/support/scene_builder.h"
#include "tests/support/tunings.h"

// Textured squares seen from above, a texel for each pixel, so that every sample of a pixel sees the same
// texel; normal maps and textured lamps against scenes without textures.

namespace duolux::test {
namespace {

constexpr std::uint32_t kSize = 16;  // pixels, texels and scene units

/// RGBA at (x, y) from the top left.
template <typename Colour>
std::shared_ptr<const Image> imageOf(std::uint32_t width, std::uint32_t height, const Colour& colour) {
    Image image;
    image.width = width;
    image.height = height;
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const glm::vec4 c = colour(x, y);
            image.floats.insert(image.floats.end(), {c.x, c.y, c.z, c.w});
        }
    }
    return std::make_shared<const Image>(std::move(image));
}

glm::vec4 chequer(std::uint32_t x, std::uint32_t y) {
    return {(x + y) % 2 == 0 ? 0.9f : 0.125f, static_cast<float>(x) / 16.0f,
            static_cast<float>(y) / 32.0f + 0.25f, 1.0f};
}

std::shared_ptr<const Image> uniformColour(const glm::vec4& colour) {
    return imageOf(1, 1, [&](std::uint32_t, std::uint32_t) { return colour; });
}

MaterialTexture textureFor(MaterialInput input, Filter filter = Filter::kNearest, std::uint32_t channel = 0) {
    MaterialTexture entry{input, {}, channel};
    entry.texture.filter = filter;
    return entry;
}

/// The square from (0, 0, 0) to (kSize, kSize, 0), facing up, with texture coordinates from the top left;
/// `mirrored`: from the top right.
SceneBuilder square(const Material& material, bool mirrored = false) {
    SceneBuilder builder;
    constexpr float s = kSize;
    builder.quad({0, 0, 0}, {s, 0, 0}, {s, s, 0}, {0, s, 0}, builder.add(material));
    Geometry& geometry = builder.scene.geometry;
    for (const glm::vec3& p : geometry.positions)
        geometry.uvs.emplace_back(mirrored ? 1.0f - p.x / s : p.x / s, 1.0f - p.y / s);
    geometry.uvIndices = geometry.triangles;
    LoadedScene& scene = builder.scene;
    scene.reflectance = preset("global");
    scene.camera.type = CameraType::kOrthographic;
    scene.camera.height = s;
    scene.camera.position = {s / 2, s / 2, 10};
    scene.camera.target = {s / 2, s / 2, 0};
    scene.settings.width = scene.settings.height = kSize;
    scene.settings.spp = 4;
    scene.settings.bounces = 1;
    return builder;
}

/// Adds a quad without texture coordinates.
void addLamp(SceneBuilder& builder, float emission, float left = -8, float right = 24) {
    Material lamp;
    lamp.baseColor = glm::vec3(0.0f);
    lamp.emission.invisible = glm::vec3(emission);
    builder.quad({left, -8, 30}, {left, 24, 30}, {right, 24, 30}, {right, -8, 30}, builder.add(lamp));
    builder.scene.geometry.uvIndices.resize(builder.scene.geometry.triangles.size(),
                                            glm::uvec3(Geometry::kNoUv));
}

RadianceImage renderOnce(const LoadedScene& scene, const TuningChoice& tuning = {}) {
    RenderControl control;
    control.tuning = tuning;
    return render(device(), scene, control).film.resolve();
}

TEST(Textures, EmissionIsScaledTexelByTexel) {
    Material material;
    material.baseColor = glm::vec3(0.0f);
    material.emission.invisible = {1, 2, 3};
    material.emission.visible = {4, 5, 6};
    material.textures = {textureFor(MaterialInput::kEmission)};
    LoadedScene scene = square(material).scene;
    scene.images = {imageOf(kSize, kSize, chequer)};
    for (const TuningChoice& tuning : allTunings(device().info())) {
        const RadianceImage image = renderOnce(scene, tuning);
        for (std::uint32_t y = 0; y < kSize; ++y) {
            for (std::uint32_t x = 0; x < kSize; ++x) {
                const glm::vec3 texel(chequer(x, y));
                const std::size_t pixel = std::size_t{y} * kSize + x;
                ASSERT_LT(glm::length(image.invisible[pixel] - texel * glm::vec3(1, 2, 3)), 1e-4f)
                    << x << " " << y;
                ASSERT_LT(glm::length(image.visible[pixel] - texel * glm::vec3(4, 5, 6)), 1e-4f)
                    << x << " " << y;
            }
        }
    }
}

/// What an image scales stays in its range: a floating-point image with values of up to 3 and from -1 gives
/// the picture of the same image within 0 and 1.
TEST(Textures, ValuesOfMaterialsAreAtMostOneAndNotNegative) {
    for (const MaterialInput input :
         {MaterialInput::kBaseColor, MaterialInput::kTransmission, MaterialInput::kMetallic}) {
        Material material;
        material.baseColor = glm::vec3(0.8f);
        material.roughness = 0.5f;
        material.metallic = input == MaterialInput::kMetallic ? 1.0f : 0.0f;
        material.transmission = input == MaterialInput::kTransmission ? 1.0f : 0.0f;
        material.specular = 1.0f;
        material.textures = {textureFor(input)};
        SceneBuilder builder = square(material);
        addLamp(builder, 1.0f);
        const auto picture = [&](float low, float high) {
            builder.scene.images = {imageOf(kSize, kSize, [&](std::uint32_t x, std::uint32_t y) {
                return glm::vec4(glm::clamp(static_cast<float>((x + y) % 5) - 1.0f, low, high));
            })};
            return renderOnce(builder.scene);
        };
        const RadianceImage any = picture(-1.0f, 3.0f), within = picture(0.0f, 1.0f);
        EXPECT_EQ(any.visible, within.visible);
        EXPECT_EQ(any.invisible, within.invisible);
    }
}

/// Between the centres of the outer pixels, the filtered ramp is linear.
TEST(Textures, FilteredRampsAreLinear) {
    Material material;
    material.baseColor = glm::vec3(0.0f);
    material.emission.visible = glm::vec3(1.0f);
    material.textures = {textureFor(MaterialInput::kEmission, Filter::kLinear)};
    material.textures[0].texture.wrapU = Wrap::kClamp;
    LoadedScene scene = square(material).scene;
    scene.images = {
        imageOf(4, 1, [](std::uint32_t x, std::uint32_t) { return glm::vec4(static_cast<float>(x)); })};
    scene.settings.spp = 256;
    const RadianceImage image = renderOnce(scene);
    for (std::uint32_t x = 2; x + 2 < kSize; ++x) {
        const float u = (static_cast<float>(x) + 0.5f) / kSize;
        EXPECT_NEAR(image.visible[x].x, 4.0f * u - 0.5f, 1e-3f) << x;
    }
}

void expectScaled(const LoadedScene& textured, const LoadedScene& white, const TuningChoice& tuning) {
    const RadianceImage actual = renderOnce(textured, tuning), full = renderOnce(white, tuning);
    for (std::uint32_t y = 0; y < kSize; ++y) {
        for (std::uint32_t x = 0; x < kSize; ++x) {
            const std::size_t pixel = std::size_t{y} * kSize + x;
            const glm::vec3 expected = glm::vec3(chequer(x, y)) * full.visible[pixel];
            ASSERT_GT(full.visible[pixel].x, 0.0f);
            ASSERT_LT(glm::length(actual.visible[pixel] - expected), 2e-3f * glm::length(full.visible[pixel]))
                << x << " " << y;
        }
    }
}

TEST(Textures, BaseColoursAreScaledTexelByTexel) {
    Material white;
    white.baseColor = glm::vec3(1.0f);
    Material textured = white;
    textured.textures = {textureFor(MaterialInput::kBaseColor)};
    SceneBuilder builders[] = {square(textured), square(white)};
    for (SceneBuilder& builder : builders) {
        addLamp(builder, 5.0f);
        builder.scene.images = {imageOf(kSize, kSize, chequer)};
    }
    for (const TuningChoice& tuning : allTunings(device().info()))
        expectScaled(builders[0].scene, builders[1].scene, tuning);
    for (SceneBuilder& builder : builders) {
        builder.scene.settings.integrator = Integrator::kLightTracer;
        builder.scene.settings.spp = 512;
    }
    expectScaled(builders[0].scene, builders[1].scene, {});
}

double meanOf(const RadianceImage& image) {
    double sum = 0.0;
    for (const glm::vec3& v : image.visible)
        sum += static_cast<double>(v.x);
    return sum / static_cast<double>(image.visible.size());
}

/// Images of one colour, and materials with these numbers.
TEST(Textures, ScaleMetalAndRoughness) {
    Material plain;
    plain.metallic = 0.5f;
    plain.roughness = 0.25f;
    Material textured = plain;
    textured.metallic = textured.roughness = 1.0f;
    textured.textures = {textureFor(MaterialInput::kMetallic, Filter::kLinear, 2),
                         textureFor(MaterialInput::kRoughness, Filter::kLinear, 1)};
    SceneBuilder builders[] = {square(textured), square(plain)};
    for (SceneBuilder& builder : builders) {
        addLamp(builder, 5.0f);
        builder.scene.images = {uniformColour({0.0f, 0.25f, 0.5f, 1.0f})};
        builder.scene.settings.spp = 64;
    }
    const double expected = meanOf(renderOnce(builders[1].scene));
    EXPECT_NEAR(meanOf(renderOnce(builders[0].scene)), expected, 1e-3 * expected);
}

/// Light from a direction (a distant point) on a diffuse square: brightness relative to 1.
float brightnessOf(const glm::vec3& texel, float scale, const glm::vec3& light, bool mirrored,
                   Integrator integrator, bool mapped = true) {
    Material material;
    material.baseColor = glm::vec3(1.0f);
    material.normalScale = scale;
    if (mapped) material.textures = {textureFor(MaterialInput::kNormal)};
    LoadedScene scene = square(material, mirrored).scene;
    scene.images = {uniformColour({texel, 1.0f})};
    constexpr float kDistance = 1e5f;
    PointEmitter point;
    point.position = glm::vec3(8, 8, 0) + kDistance * light;
    point.invisible = glm::vec3(kDistance * kDistance * std::numbers::pi_v<float>);
    scene.pointEmitters = {point};
    scene.settings.integrator = integrator;
    scene.settings.spp = 1;
    return static_cast<float>(meanOf(renderOnce(scene)));
}

TEST(NormalMaps, FlatOnesChangeNothing) {
    const glm::vec3 light = glm::normalize(glm::vec3(1, 2, 2));
    const float plain = brightnessOf({}, 1, light, false, Integrator::kPathTracer, false);
    EXPECT_NEAR(plain, 2.0f / 3.0f, 1e-3f);
    EXPECT_NEAR(brightnessOf({0.5f, 0.5f, 1.0f}, 1, light, false, Integrator::kPathTracer), plain, 1e-5f);
}

/// The brightness is the cosine to the normal, which is in the frame of the texture: x along growing u, y up
/// the image.
TEST(NormalMaps, TurnTheNormal) {
    const glm::vec3 light = glm::normalize(glm::vec3(1, 2, 2));
    for (const bool mirrored : {false, true}) {
        const float east = mirrored ? -1.0f : 1.0f;
        const auto expect = [&](const glm::vec3& texel, float scale, const glm::vec3& normal) {
            EXPECT_NEAR(brightnessOf(texel, scale, light, mirrored, Integrator::kPathTracer),
                        glm::dot(glm::normalize(normal), light), 1e-3f)
                << mirrored << " " << texel.x << " " << texel.y;
        };
        expect({0.8f, 0.5f, 0.9f}, 1, {0.6f * east, 0, 0.8f});
        expect({0.2f, 0.5f, 0.9f}, 1, {-0.6f * east, 0, 0.8f});
        expect({0.5f, 0.8f, 0.9f}, 1, {0, 0.6f, 0.8f});
        expect({0.5f, 0.8f, 0.9f}, 0.5f, {0, 0.3f, 0.8f});
    }
}

/// The light of a lamp that a black square with a clearcoat reflects; its normals point along `tilt`, if that
/// is not 0.
double coatBrightness(Material material, const glm::vec3& tilt, const std::vector<glm::vec3>& texels,
                      Integrator integrator) {
    material.baseColor = glm::vec3(0.0f);
    material.clearcoat = 1.0f;
    material.clearcoatRoughness = 0.5f;
    SceneBuilder builder = square(material);
    addLamp(builder, 5.0f);
    LoadedScene& scene = builder.scene;
    if (tilt != glm::vec3(0.0f)) {
        scene.geometry.normals = {glm::normalize(tilt)};
        scene.geometry.normalIndices.assign(scene.geometry.triangles.size(), glm::uvec3(Geometry::kNoNormal));
        scene.geometry.normalIndices[0] = scene.geometry.normalIndices[1] = glm::uvec3(0);
    }
    for (const glm::vec3& texel : texels)
        scene.images.push_back(uniformColour({texel, 1.0f}));
    scene.settings.integrator = integrator;
    scene.settings.spp = integrator == Integrator::kPathTracer ? 256 : 2048;
    return meanOf(renderOnce(scene));
}

/// A normal map of the clearcoat is as good as normals of vertices; one of what lies below does not bend it.
TEST(NormalMaps, OfClearcoats) {
    const glm::vec3 texel(0.65f, 0.35f, 0.5f + 0.5f * std::sqrt(0.82f));  // of the normal (0.3, -0.3, 0.906)
    const glm::vec3 normal(0.3f, -0.3f, std::sqrt(0.82f));
    Material plain, coat, below;
    coat.textures = {textureFor(MaterialInput::kClearcoatNormal)};
    below.textures = {textureFor(MaterialInput::kNormal)};
    Material halved = coat;
    halved.clearcoatNormalScale = 0.5f;
    for (const Integrator integrator : {Integrator::kPathTracer, Integrator::kLightTracer}) {
        const double flat = coatBrightness(plain, {}, {}, integrator);
        const double tilted = coatBrightness(plain, normal, {}, integrator);
        ASSERT_GT(std::abs(tilted - flat), 0.1 * flat) << "so that the tests mean something";
        const double tolerance = 0.02 * flat;
        EXPECT_NEAR(coatBrightness(coat, {}, {texel}, integrator), tilted, tolerance) << nameOf(integrator);
        EXPECT_NEAR(coatBrightness(below, {}, {texel}, integrator), flat, tolerance) << nameOf(integrator);
        EXPECT_NEAR(coatBrightness(halved, {}, {texel}, integrator),
                    coatBrightness(plain, normal * glm::vec3(0.5f, 0.5f, 1.0f), {}, integrator), tolerance)
            << nameOf(integrator);
    }
}

/// The same lamp as a texture that is black on one half, and as a quad of half the size.
TEST(Textures, LampsShineWhereTheirTexturesDo) {
    Material grey;
    const auto sceneWith = [&](bool textured) {
        SceneBuilder builder = square(grey);
        addLamp(builder, 5.0f, textured ? -8.0f : 8.0f, 24.0f);
        Geometry& geometry = builder.scene.geometry;
        if (!textured) return builder.scene;
        const std::size_t first = geometry.positions.size() - 6;
        for (std::size_t i = first; i < geometry.positions.size(); ++i)
            geometry.uvs.emplace_back((geometry.positions[i].x + 8.0f) / 32.0f, 0.5f);
        geometry.uvIndices[2] = geometry.triangles[2];
        geometry.uvIndices[3] = geometry.triangles[3];
        builder.scene.materials[1].textures = {textureFor(MaterialInput::kEmission)};
        builder.scene.images = {
            imageOf(2, 1, [](std::uint32_t x, std::uint32_t) { return glm::vec4(x == 0 ? 0.0f : 1.0f); })};
        return builder.scene;
    };
    const reference::Estimates expected = estimatesOf(renderSeeds(sceneWith(false), 256, 4, 100));
    expectAgreement("TexturedLamp", renderSeeds(sceneWith(true), 256, 4), expected);
    expectAgreement("TexturedLampByLight", renderByLight(sceneWith(true), 1024, 4), expected);
}

/// Materials may gain textures after a scene was uploaded without any, and lose them.
TEST(Textures, MaterialsMayChange) {
    Material plain;
    Material textured;
    textured.textures = {textureFor(MaterialInput::kBaseColor)};
    SceneBuilder builder = square(plain);
    addLamp(builder, 5.0f);
    LoadedScene scene = builder.scene;
    scene.images = {imageOf(kSize, kSize, chequer), uniformColour(glm::vec4(0.5f))};
    Renderer renderer(device(), scene);
    const auto expectSameBits = [&](const Material& material) {
        scene.materials[0] = material;
        renderer.setMaterials(scene.materials);
        EXPECT_TRUE(
            sameBits(renderer.render(scene.settings).film, render(device(), scene, scene.settings).film));
    };
    expectSameBits(textured);
    textured.textures[0].texture.transform.scale = glm::vec2(3.0f);
    expectSameBits(textured);
    textured.textures[0].texture.image = 1;
    expectSameBits(textured);
    textured.textures[0].input = MaterialInput::kNormal;
    expectSameBits(textured);
    expectSameBits(plain);
}

}  // namespace
}  // namespace duolux::test
