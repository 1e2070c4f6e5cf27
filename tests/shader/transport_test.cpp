#include "host/device_scene/transport.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "shaders/shared/path_tracer_layout.h"
#include "tests/reference/matrix2.h"
#include "tests/shader/mirror_types.h"
#include "tests/support/scene_builder.h"

// Specialisation constants remove only code that no surface of the scene needs. Also tests the materials'
// records, because they are fetched in the same way.

namespace duolux::test {
namespace {

using mirror::single::Material;
using Matrix = mirror::single::ReflectanceMatrix;

constexpr std::size_t kMaterials = 5;

/// Numbers that all differ.
std::vector<shared::DeviceMaterial> materials() {
    std::mt19937 engine(3);
    std::uniform_real_distribution<float> uniform(0.1f, 1.0f);
    const auto vector = [&] { return glm::vec3(uniform(engine), uniform(engine), uniform(engine)); };
    std::vector<shared::DeviceMaterial> out(kMaterials);
    for (std::size_t i = 0; i < kMaterials; ++i) {
        shared::DeviceMaterial& m = out[i];
        m.baseColor = vector();
        m.flags = static_cast<std::uint32_t>(i + 1);
        m.metallic = uniform(engine);
        m.roughness = uniform(engine);
        for (int entry = 0; entry < 4; ++entry) {
            m.opaque[entry] = glm::vec4(vector(), -1.0f);
            m.transparent[entry] = glm::vec4(vector(), -1.0f);
        }
    }
    return out;
}

ShaderLibrary transport() {
    static const std::vector<shared::DeviceMaterial> records = materials();
    ShaderLibrary library("shaders/lib/transport.glsl");
    library.texels("fetchMaterialTexel", std::span(records));
    library.define(
        "ReflectanceMatrix sceneOpaque() { return ReflectanceMatrix(vec3(1.5), vec3(2.5), vec3(3.5), "
        "vec3(4.5)); }\n"
        "ReflectanceMatrix sceneTransparent() { return ReflectanceMatrix(vec3(5.5), vec3(6.5), vec3(7.5), "
        "vec3(8.5)); }");
    return library;
}

std::vector<std::uint32_t> materialIndices() {
    return {0, 1, 2, 3, 4};
}

Matrix matrixOf(const glm::vec4 (&entries)[4]) {
    return {entries[0], entries[1], entries[2], entries[3]};
}

TEST(Transport, ConstantsAreTheHosts) {
    ShaderLibrary library = transport();
    for (const std::uint32_t kind : {shared::kTransparencyZero, shared::kTransparencyIdentity,
                                     shared::kTransparencyGeneral, shared::kTransparencyCoverage}) {
        library.constant(shared::kSpecTransparency, kind);
        EXPECT_EQ(library.evaluate<std::uint32_t>("result = kTransparency;").at(0), kind);
    }
}

TEST(Transport, EveryMaterialHasItsOwnMatrices) {
    const ShaderLibrary library = transport();
    const auto opaque = library.call<Matrix>("opaqueOf", materialIndices());
    const auto transparent = library.call<Matrix>("transparentOf", materialIndices());
    for (std::size_t i = 0; i < kMaterials; ++i) {
        EXPECT_EQ(numbers(opaque[i]), numbers(matrixOf(materials()[i].opaque)));
        EXPECT_EQ(numbers(transparent[i]), numbers(matrixOf(materials()[i].transparent)));
    }
}

TEST(Transport, OneReflectanceIsThatOfTheScene) {
    const ShaderLibrary library = transport().constant(shared::kSpecOneReflectance, 1);
    const auto opaque = library.call<Matrix>("opaqueOf", materialIndices());
    const auto transparent = library.call<Matrix>("transparentOf", materialIndices());
    const auto all = [](float a, float b, float c, float d) {
        return numbers(Matrix{glm::vec3(a), glm::vec3(b), glm::vec3(c), glm::vec3(d)});
    };
    for (std::size_t i = 0; i < kMaterials; ++i) {
        EXPECT_EQ(numbers(opaque[i]), all(1.5f, 2.5f, 3.5f, 4.5f));
        EXPECT_EQ(numbers(transparent[i]), all(5.5f, 6.5f, 7.5f, 8.5f));
    }
}

reference::ChannelMatrix channels(const Matrix& m) {
    return reference::channelsOf({m.m00, m.m01, m.m10, m.m11});
}

double entry(const reference::Matrix2& m, int e) {
    return e == 0 ? m.m00 : e == 1 ? m.m01 : e == 2 ? m.m10 : m.m11;
}

std::vector<Matrix> randomMatrices(std::uint32_t seed) {
    std::mt19937 engine(seed);
    std::uniform_int_distribution<int> integer(0, 15);
    const auto vector = [&] {
        return glm::vec3(glm::ivec3(integer(engine), integer(engine), integer(engine)));
    };
    std::vector<Matrix> out;
    for (int i = 0; i < 1024; ++i)
        out.push_back({vector(), vector(), vector(), vector()});
    return out;
}

/// Integers, so that products are exact.
void expectProducts(const ShaderLibrary& library, const std::vector<Matrix>& a,
                    const std::vector<Matrix>& b) {
    const auto products = library.call<Matrix>("multiply", a, b);
    for (std::size_t i = 0; i < a.size(); ++i) {
        const auto expected = channels(a[i]) * channels(b[i]);
        const auto seen = channels(products[i]);
        for (std::size_t c = 0; c < 3; ++c) {
            for (int e = 0; e < 4; ++e)
                ASSERT_EQ(entry(seen[c], e), entry(expected[c], e)) << i << ", channel " << c << ", " << e;
        }
    }
}

TEST(Transport, MultiplicationLeavesOutOnlyASecondColumnThatIsZero) {
    const std::vector<Matrix> a = randomMatrices(1);
    std::vector<Matrix> b = randomMatrices(2);
    expectProducts(transport().constant(shared::kSpecSecondColumn, 1), a, b);
    for (Matrix& m : b)
        m.m01 = m.m11 = glm::vec3(0.0f);
    expectProducts(transport().constant(shared::kSpecSecondColumn, 0), a, b);
    expectProducts(transport().constant(shared::kSpecSecondColumn, 1), a, b);
}

/// Importance with every pattern of non-zero entries, in a single channel: each channel alone must count.
std::vector<Matrix> importances() {
    std::vector<Matrix> out;
    for (int pattern = 0; pattern < 16; ++pattern) {
        for (int c = 0; c < 3; ++c) {
            Matrix w{};
            for (int e = 0; e < 4; ++e) {
                const float value = (pattern >> e & 1) != 0 ? std::ldexp(1.0f, -20 * e) : 0.0f;
                (e == 0 ? w.m00 : e == 1 ? w.m01 : e == 2 ? w.m10 : w.m11)[c] = value;
            }
            out.push_back(w);
        }
    }
    return out;
}

/// Whether importance can remain after a matrix whose rows (invisible, visible) may be non-zero.
bool anythingLeft(const Matrix& w, bool invisibleRow, bool visibleRow) {
    const double i = invisibleRow ? 1.0 : 0.0, v = visibleRow ? 1.0 : 0.0;
    const auto left = channels(w) * reference::ChannelMatrix{{{i, i, v, v}, {i, i, v, v}, {i, i, v, v}}};
    return !reference::isZero(left);
}

constexpr const char* kWhatCan = "result = uvec2(canScatter(x0), canCross(x0));";

// By definition: no, if and only if W F = 0 for every F with the rows that the constants allow.
TEST(Transport, CanScatterAndCrossExactlyWhereSomethingMayBeLeft) {
    const std::vector<Matrix> ws = importances();
    for (std::uint32_t bits = 0; bits < 16; ++bits) {
        const auto bit = [&](std::uint32_t i) { return bits >> i & 1u; };
        ShaderLibrary library = transport();
        library.constant(shared::kSpecInvisibleScatters, bit(0));
        library.constant(shared::kSpecVisibleScatters, bit(1));
        library.constant(shared::kSpecInvisibleCrosses, bit(2));
        library.constant(shared::kSpecVisibleCrosses, bit(3));
        const auto can = library.evaluate<glm::uvec2>(kWhatCan, ws);
        for (std::size_t i = 0; i < ws.size(); ++i) {
            EXPECT_EQ(can[i].x != 0, anythingLeft(ws[i], bit(0) != 0, bit(1) != 0)) << bits << ", " << i;
            EXPECT_EQ(can[i].y != 0, anythingLeft(ws[i], bit(2) != 0, bit(3) != 0)) << bits << ", " << i;
        }
    }
}

/// A scene with these matrices on its one material.
Scene sceneOf(const ReflectanceMatrix& opaque, const ReflectanceMatrix& transparent) {
    SceneBuilder builder;
    builder.triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, builder.add({}));
    builder.scene.reflectance = {opaque, transparent};
    return builder.scene;
}

// The constants that the host derives from a scene's matrices lose no importance, for O and T with any
// pattern of zeros and with each entry in one channel only.
TEST(Transport, ConstantsOfAnySceneLoseNoImportance) {
    const std::vector<Matrix> ws = importances();
    for (int pattern = 0; pattern < 16; ++pattern) {
        ReflectanceMatrix block;
        for (int e = 0; e < 4; ++e) {
            glm::vec3& value = e == 0 ? block.m00 : e == 1 ? block.m01 : e == 2 ? block.m10 : block.m11;
            value[(pattern + e) % 3] = (pattern >> e & 1) != 0 ? 1e-3f : 0.0f;
        }
        for (const bool isOpaque : {true, false}) {
            const ReflectanceMatrix opaque = isOpaque ? block : ReflectanceMatrix{};
            const ReflectanceMatrix transparent = isOpaque ? ReflectanceMatrix{} : block;
            const TransportTraits traits = analyseTransport(sceneOf(opaque, transparent));
            ShaderLibrary library = transport();
            library.constant(shared::kSpecSecondColumn, traits.secondColumn);
            library.constant(shared::kSpecInvisibleScatters, traits.invisibleScatters);
            library.constant(shared::kSpecVisibleScatters, traits.visibleScatters);
            library.constant(shared::kSpecInvisibleCrosses, traits.invisibleCrosses);
            library.constant(shared::kSpecVisibleCrosses, traits.visibleCrosses);
            const auto can = library.evaluate<glm::uvec2>(kWhatCan, ws);
            for (std::size_t i = 0; i < ws.size(); ++i) {
                const bool left = !reference::isZero(channels(ws[i]) * reference::channelsOf(block));
                EXPECT_TRUE(!left || (isOpaque ? can[i].x : can[i].y) != 0) << pattern << ", " << i;
                EXPECT_EQ(isOpaque ? can[i].y : can[i].x, 0u) << pattern << ", " << i;
            }
        }
    }
}

/// Sets the mirror's constants for its lifetime.
class MirrorConstants {
  public:
    MirrorConstants(bool secondColumn, bool scatters, bool crosses, bool oneReflectance) {
        set(secondColumn, scatters, crosses, oneReflectance);
    }
    ~MirrorConstants() { set(true, true, true, false); }
    MirrorConstants(const MirrorConstants&) = delete;
    MirrorConstants& operator=(const MirrorConstants&) = delete;

  private:
    static void set(bool secondColumn, bool scatters, bool crosses, bool oneReflectance) {
        using namespace mirror;
        single::kSecondColumn = twice::kSecondColumn = secondColumn;
        single::kInvisibleScatters = twice::kInvisibleScatters = scatters;
        single::kInvisibleCrosses = twice::kInvisibleCrosses = crosses;
        single::kOneReflectance = twice::kOneReflectance = oneReflectance;
        single::opaqueForAll = {glm::vec3(1.5f), glm::vec3(2.5f), glm::vec3(3.5f), glm::vec3(4.5f)};
        single::transparentForAll = {glm::vec3(5.5f), glm::vec3(6.5f), glm::vec3(7.5f), glm::vec3(8.5f)};
        twice::opaqueForAll = widen(single::opaqueForAll);
        twice::transparentForAll = widen(single::transparentForAll);
    }
};

void setMirrorMaterials() {
    const std::vector<shared::DeviceMaterial> records = materials();
    mirror::texels().materials.resize(records.size() * shared::kMaterialTexels);
    std::memcpy(mirror::texels().materials.data(), records.data(), std::as_bytes(std::span(records)).size());
}

TEST(Transport, PathsSurviveByTheRootOfTheirWeight) {
    const std::vector<float> weights{0.0f, 1e-12f, 0.04f, 0.25f, 0.81f, 0.95f, 0.99999f, 1.0f, 1.5f, 100.0f};
    const auto survival = transport().call<float>("survivalProbability", weights);
    const std::vector<float> expected{0.0f, 1e-6f, 0.2f, 0.5f, 0.9f, 0.95f, 0.95f, 1.0f, 1.0f, 1.0f};
    for (std::size_t i = 0; i < weights.size(); ++i)
        EXPECT_NEAR(survival[i], expected[i], 1e-6f * expected[i]) << weights[i];
}

TEST(TransportOracles, RouletteIsTheSame) {
    std::vector<float> weights;
    for (int i = 0; i <= 1000; ++i)
        weights.push_back(1e-3f * static_cast<float>(i * i) / 500.0f);
    const ShaderLibrary library = transport();
    EXPECT_ORACLES(library, survivalProbability, (Budget{3, 1e-7}), weights);
}

TEST(TransportOracles, MaterialsAreFetchedTheSame) {
    setMirrorMaterials();
    const ShaderLibrary library = transport();
    const Budget exact{0, 0};
    EXPECT_ORACLES(library, fetchMaterial, exact, materialIndices());
    EXPECT_ORACLES(library, fetchOpaque, exact, materialIndices());
    EXPECT_ORACLES(library, fetchTransparent, exact, materialIndices());
    EXPECT_ORACLES(library, fetchMatrix, exact, materialIndices());
    std::vector<Material> all;
    std::vector<std::uint32_t> front;
    for (const std::uint32_t i : materialIndices()) {
        for (const std::uint32_t side : {0u, 1u}) {
            all.push_back(mirror::single::fetchMaterial(i));
            front.push_back(side);
        }
    }
    const auto scatters =
        library.evaluate<std::uint32_t>("result = uint(materialScatters(x0, x1 != 0u));", all, front);
    EXPECT_WITHIN_ORACLES(
        "materialScatters", scatters, exact,
        [](const auto& m, std::uint32_t f) { return mirror::single::materialScatters(m, f != 0) ? 1u : 0u; },
        [](const auto& m, std::uint32_t f) { return mirror::twice::materialScatters(m, f != 0) ? 1u : 0u; },
        all, front);
}

TEST(TransportOracles, ConstantsLeaveOutTheSame) {
    setMirrorMaterials();
    const std::vector<Matrix> a = randomMatrices(3), b = randomMatrices(4), ws = importances();
    for (const std::uint32_t bits : {0u, 1u, 2u, 4u, 8u, 15u}) {
        const auto bit = [&](std::uint32_t i) { return (bits >> i & 1u) != 0; };
        const MirrorConstants constants(bit(0), bit(1), bit(2), bit(3));
        ShaderLibrary library = transport();
        library.constant(shared::kSpecSecondColumn, bit(0));
        library.constant(shared::kSpecInvisibleScatters, bit(1));
        library.constant(shared::kSpecInvisibleCrosses, bit(2));
        library.constant(shared::kSpecOneReflectance, bit(3));
        const Budget exact{0, 0};
        EXPECT_ORACLES(library, multiply, exact, a, b);
        EXPECT_ORACLES(library, opaqueOf, exact, materialIndices());
        EXPECT_ORACLES(library, transparentOf, exact, materialIndices());
        EXPECT_WITHIN_ORACLES(
            "canScatter, canCross", library.evaluate<glm::uvec2>(kWhatCan, ws), exact,
            [](const auto& w) {
                return glm::uvec2(mirror::single::canScatter(w), mirror::single::canCross(w));
            },
            [](const auto& w) {
                return glm::uvec2(mirror::twice::canScatter(w), mirror::twice::canCross(w));
            },
            ws);
    }
}

}  // namespace
}  // namespace duolux::test
