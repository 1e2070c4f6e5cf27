#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "host/scene/reflectance.h"
#include "tests/reference/matrix2.h"
#include "tests/shader/mirror_types.h"
#include "tests/support/closed_form.h"

// The presets' matrices (eqs. 12-23), closed forms of a uniform enclosure, and both oracles.
// reflectance_matrix_test.glsl tests the algebra itself.

namespace duolux::test {
namespace {

using mirror::single::Radiance2;
using Matrix = mirror::single::ReflectanceMatrix;

const ShaderLibrary& algebra() {
    static const ShaderLibrary library("shaders/lib/reflectance_matrix.glsl");
    return library;
}

Matrix deviceMatrix(const ReflectanceMatrix& m) {
    return {m.m00, m.m01, m.m10, m.m11};
}

/// The effect of a preset on the radiance (i, v), where f is reflected and g is transmitted.
using Scatter = glm::vec2 (*)(float i, float f, float g);

/// L_out = F L with F = O f + T g. All values are powers of two, or 3, so every number is exact.
void expectScatter(const char* preset, Scatter expected) {
    SCOPED_TRACE(preset);
    const std::optional<Reflectance> reflectance = presetReflectance(preset);
    ASSERT_TRUE(reflectance);
    std::vector<Radiance2> lights;
    std::vector<float> opaque, transparent;
    for (const float i : {0.0f, 1.0f, 3.0f}) {
        for (const float v : {0.0f, 2.0f}) {  // always absorbed (eq. 13)
            for (const float f : {0.0f, 0.25f, 0.5f}) {
                for (const float g : {0.0f, 1.0f}) {
                    lights.push_back({{i, 2.0f * i, 4.0f * i}, {v, 0.0f, 8.0f * v}});
                    opaque.push_back(f);
                    transparent.push_back(g);
                }
            }
        }
    }
    const std::vector<Radiance2> out = algebra().evaluate<Radiance2>(
        "Radiance2 reflected = matrixApply(scaled(x0, vec3(x2)), x4);"
        "Radiance2 passed = matrixApply(scaled(x1, vec3(x3)), x4);"
        "result = Radiance2(reflected.invisible + passed.invisible, reflected.visible + passed.visible);",
        deviceMatrix(reflectance->opaque), deviceMatrix(reflectance->transparent), opaque, transparent,
        lights);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        for (int c = 0; c < 3; ++c) {  // eq. 17: each channel separately
            const glm::vec2 light = expected(lights[i].invisible[c], opaque[i], transparent[i]);
            EXPECT_EQ(out[i].invisible[c], light.x) << i << ", channel " << c;
            EXPECT_EQ(out[i].visible[c], light.y) << i << ", channel " << c;
        }
    }
}

TEST(Presets, DoToLightWhatThePaperSays) {
    // Eqs. 12, 14, 15; 18, 19; 20, 21; 22, 23.
    expectScatter("local", [](float i, float f, float g) { return glm::vec2(g * i, f * i); });
    expectScatter("global", [](float i, float f, float) { return glm::vec2(f * i, f * i); });
    expectScatter("shadowless", [](float i, float f, float g) { return glm::vec2((f + g) * i, f * i); });
    expectScatter("one-bounce", [](float i, float f, float) { return glm::vec2(0.0f, f * i); });
}

// Between the corners of the reflectance square F is bilinear: t and o scale transmitted and scattered light.
TEST(Blend, ScalesWhatPassesAndWhatIsInterreflected) {
    for (const float t : {0.0f, 0.25f, 1.0f}) {
        for (const float o : {0.0f, 0.5f, 1.0f}) {
            const Reflectance blend = blendReflectance(t, o);
            const Radiance2 light{{1.0f, 2.0f, 4.0f}, {8.0f, 16.0f, 32.0f}};
            const auto reflected =
                algebra().call<Radiance2>("matrixApply", deviceMatrix(blend.opaque), light);
            const auto passed =
                algebra().call<Radiance2>("matrixApply", deviceMatrix(blend.transparent), light);
            EXPECT_EQ(reflected[0].invisible, o * light.invisible);
            EXPECT_EQ(reflected[0].visible, light.invisible);
            EXPECT_EQ(passed[0].invisible, t * light.invisible);
            EXPECT_EQ(passed[0].visible, glm::vec3(0.0f));
        }
    }
}

/// Walls of a closed enclosure: matrix O, albedo, emission.
struct Walls {
    std::vector<Matrix> opaque;
    std::vector<glm::vec3> albedo;
    std::vector<Radiance2> emission;

    void add(const Matrix& o, const glm::vec3& a) {
        const auto k = static_cast<float>(opaque.size() % 5);
        opaque.push_back(o);
        albedo.push_back(a);
        emission.push_back({{1.0f, 0.5f, 2.0f + k}, {0.25f * k, 0.125f, 0.5f}});
    }
};

/// Presets and blends, whose second columns are zero; or, if `full`, matrices that differ by channel.
Walls enclosures(bool full) {
    Walls walls;
    std::mt19937 engine(11);
    std::uniform_real_distribution<float> uniform;
    const auto vector = [&](float largest) {
        return largest * glm::vec3(uniform(engine), uniform(engine), uniform(engine));
    };
    if (!full) {
        for (const Preset& p : presets())
            walls.add(deviceMatrix(blendReflectance(p.t, p.o).opaque), {0.1f, 0.5f, 0.8f});
    }
    for (int i = 0; i < 500; ++i) {
        if (full) {  // the largest row sum, which bounds the spectral radius, is below 0.95 2 0.45
            walls.add({vector(0.45f), vector(0.45f), vector(0.45f), vector(0.45f)}, vector(0.95f));
        } else {
            walls.add(deviceMatrix(blendReflectance(uniform(engine), uniform(engine)).opaque), vector(0.8f));
        }
    }
    return walls;
}

/// Radiance with `bounces` scattering events at most, in double precision.
std::vector<ChannelLight> seriesOf(const Walls& walls, std::uint32_t bounces) {
    std::vector<ChannelLight> out;
    for (std::size_t i = 0; i < walls.opaque.size(); ++i) {
        const Matrix& o = walls.opaque[i];
        const auto scatter =
            reference::scaled(walls.albedo[i], reference::channelsOf({o.m00, o.m01, o.m10, o.m11}));
        const auto emission = reference::channelsOf(walls.emission[i].invisible, walls.emission[i].visible);
        out.push_back(enclosureRadiance(scatter, emission, bounces));
    }
    return out;
}

/// L = (I - rho O)^-1 E, by Cramer's rule.
std::vector<ChannelLight> limitOf(const Walls& walls) {
    std::vector<ChannelLight> out;
    for (std::size_t i = 0; i < walls.opaque.size(); ++i) {
        ChannelLight light;
        for (int c = 0; c < 3; ++c) {
            const auto entry = [&](const glm::vec3& e) {
                return static_cast<double>(walls.albedo[i][c]) * static_cast<double>(e[c]);
            };
            const Matrix& o = walls.opaque[i];
            const double a = 1.0 - entry(o.m00), b = -entry(o.m01), d = -entry(o.m10), e = 1.0 - entry(o.m11);
            const double x = static_cast<double>(walls.emission[i].invisible[c]);
            const double y = static_cast<double>(walls.emission[i].visible[c]);
            const double determinant = a * e - b * d;
            light[static_cast<std::size_t>(c)] = {(x * e - b * y) / determinant,
                                                  (a * y - d * x) / determinant};
        }
        out.push_back(light);
    }
    return out;
}

void expectRadiance(const std::vector<Radiance2>& actual, const std::vector<ChannelLight>& expected,
                    double relative) {
    ASSERT_EQ(actual.size(), expected.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < actual.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const glm::dvec2 seen(actual[i].invisible[c], actual[i].visible[c]);
            const glm::dvec2 exact = expected[i][static_cast<std::size_t>(c)];
            for (int k = 0; k < 2; ++k)
                worst = std::max(worst, std::abs(seen[k] - exact[k]) / std::max(exact[k], 1e-3));
        }
    }
    EXPECT_LE(worst, relative);
}

/// Light tracer: every event multiplies the radiance from the left, L <- E + rho O L.
constexpr const char* kShoot =
    "ReflectanceMatrix m = scaled(x0, x1); result = x2;"
    "for (uint i = 0u; i < x3; i++) {"
    "    Radiance2 s = matrixApply(m, result);"
    "    result = Radiance2(x2.invisible + s.invisible, x2.visible + s.visible);"
    "}";
/// Path tracer: W <- W rho O by `multiply`, starting from the identity, and adds W E.
std::string gatherBy(const std::string& multiply) {
    return "ReflectanceMatrix m = scaled(x0, x1); ReflectanceMatrix w = matrixIdentity(); result = x2;"
           "for (uint i = 0u; i < x3; i++) {"
           "    w = " +
           multiply +
           "(w, m);"
           "    Radiance2 s = matrixApply(w, x2);"
           "    result = Radiance2(result.invisible + s.invisible, result.visible + s.visible);"
           "}";
}

/// Rounding of a sum of up to 300 terms, each at most 0.855 times the one before.
constexpr double kSeriesError = 1e-6;

class Enclosure : public testing::TestWithParam<bool> {
  protected:
    void expectClosedForms(const std::string& statements) {
        const Walls walls = enclosures(GetParam());
        const auto run = [&](std::uint32_t bounces) {
            return algebra().evaluate<Radiance2>(statements, walls.opaque, walls.albedo, walls.emission,
                                                 bounces);
        };
        expectRadiance(run(300), limitOf(walls), kSeriesError);
        for (const std::uint32_t bounces : {0u, 1u, 2u, 5u})
            expectRadiance(run(bounces), seriesOf(walls, bounces), kSeriesError);
    }
};

TEST_P(Enclosure, ShootingSumsTheSeries) {
    expectClosedForms(kShoot);
}

TEST_P(Enclosure, GatheringSumsTheSeries) {
    expectClosedForms(gatherBy("matrixMultiply"));
    if (!GetParam()) expectClosedForms(gatherBy("matrixMultiplyFirstColumn"));
}

INSTANTIATE_TEST_SUITE_P(Walls, Enclosure, testing::Values(false, true),
                         [](const auto& walls) { return walls.param ? "FullMatrices" : "Blends"; });

struct Inputs {
    std::vector<Matrix> a, b;
    std::vector<Radiance2> light;
    std::vector<glm::vec3> scale;
    std::vector<glm::vec2> rows;
};

/// Entries of ordinary size, then of all sizes whose products neither overflow nor underflow, then 0 and 1.
Inputs algebraInputs() {
    Inputs in;
    std::mt19937 engine(5);
    std::uniform_real_distribution<float> uniform;
    for (int i = 0; i < 4096; ++i) {
        const auto entry = [&] {
            if (i < 2048) return uniform(engine);
            if (i < 3072) return std::exp2(60.0f * (2.0f * uniform(engine) - 1.0f));
            return uniform(engine) < 0.5f ? 0.0f : 1.0f;
        };
        const auto vector = [&] { return glm::vec3(entry(), entry(), entry()); };
        in.a.push_back({vector(), vector(), vector(), vector()});
        in.b.push_back({vector(), vector(), vector(), vector()});
        in.light.push_back({vector(), vector()});
        in.scale.push_back(vector());
        const float w = uniform(engine);
        in.rows.emplace_back(w, 1.0f - w);
    }
    return in;
}

TEST(ReflectanceMatrixOracles, Algebra) {
    // Sums of two products of numbers that are not negative: 1.5 ulp, less where they are contracted.
    const Budget budget{3, 0};
    const Inputs in = algebraInputs();
    EXPECT_ORACLES(algebra(), matrixMultiply, budget, in.a, in.b);
    EXPECT_ORACLES(algebra(), matrixMultiplyFirstColumn, budget, in.a, in.b);
    EXPECT_ORACLES(algebra(), matrixApply, budget, in.a, in.light);
    EXPECT_ORACLES(algebra(), scaled, budget, in.a, in.scale);
    EXPECT_ORACLES(algebra(), scaled, budget, in.light, in.scale);
    EXPECT_ORACLES(algebra(), maxComponent, (Budget{0, 0}), in.scale);
    EXPECT_ORACLES(algebra(), matrixWeight, (Budget{3, 0}), in.a, in.rows);
    const auto identity = algebra().call<Matrix>("matrixIdentity");
    EXPECT_EQ(numbers(identity[0]), numbers(mirror::single::matrixIdentity()));
}

}  // namespace
}  // namespace duolux::test
