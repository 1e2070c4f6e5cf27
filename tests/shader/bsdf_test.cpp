#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shaders/shared/material_layout.h"
#include "tests/shader/density.h"
#include "tests/shader/inputs.h"
#include "tests/shader/mirror_types.h"
#include "tests/shader/oracles.h"

// BSDFs: integrals of the device's functions over directions, the density of samples, and both oracles.

namespace duolux::test {
namespace {

using mirror::single::Bsdf;
using mirror::single::BsdfFrame;
using mirror::single::BsdfSample;

constexpr std::uint32_t kRadiance = 0, kImportance = 1;

const ShaderLibrary& bsdf() {
    static const ShaderLibrary library("shaders/lib/bsdf.glsl");
    return library;
}

/// The library compiled for scenes that only have diffuse surfaces.
ShaderLibrary diffuseOnly() {
    return ShaderLibrary("shaders/lib/bsdf.glsl").constant(shared::kSpecLobes, shared::kLobeDiffuse);
}

/// The normal is z, so directions are in the local frame.
const BsdfFrame kFlat{{0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 1.0f}};

const std::vector<glm::vec3> kOutgoing{{0.0f, 0.0f, 1.0f},
                                       {0.6f, 0.0f, 0.8f},
                                       {0.0f, -0.8f, 0.6f},
                                       {0.48f, 0.64f, 0.6f},
                                       {0.98f, 0.0f, 0.198997f}};

Bsdf white(float metallic, float roughness) {
    return {glm::vec3(1.0f), metallic, roughness};
}

/// Midpoints of 512 x 512 cells of (z, phi) over the sphere; each cell has the solid angle 4 pi / 512^2.
std::vector<glm::vec3> sphere() {
    std::vector<glm::vec3> directions;
    for (const glm::dvec2 u : unitSquare(512)) {
        const double z = 2.0 * u.x - 1.0;
        const double r = std::sqrt(1.0 - z * z);
        directions.emplace_back(r * std::cos(2.0 * std::numbers::pi * u.y),
                                r * std::sin(2.0 * std::numbers::pi * u.y), z);
    }
    return directions;
}

/// Integrals over the sphere: f |cos| in xyz, the density in w.
glm::dvec4 integrals(const ShaderLibrary& library, const Bsdf& b, const glm::vec3& wo) {
    static const std::vector<glm::vec3> directions = sphere();
    glm::dvec4 sum(0.0);
    for (const glm::vec4& v :
         library.evaluate<glm::vec4>("result = vec4(bsdfEvaluate(x0, x1, x2, x3, 0u) * bsdfCosine(x1, x3, "
                                     "0u), bsdfPdf(x0, x1, x2, x3, 0u));",
                                     b, kFlat, wo, directions))
        sum += glm::dvec4(v);
    return sum * (4.0 * std::numbers::pi / static_cast<double>(directions.size()));
}

/// The white furnace: a surface that absorbs nothing reflects everything, for every roughness and direction.
/// The fits for a metal's multiple scattering are accurate to 1 %.
TEST(Bsdf, WhiteFurnaceReturnsEverything) {
    for (const glm::vec3& wo : kOutgoing) {
        EXPECT_NEAR(integrals(diffuseOnly(), white(0.0f, 0.5f), wo).x, 1.0, 1e-5);
        EXPECT_NEAR(integrals(bsdf(), white(0.0f, 0.5f), wo).x, 1.0, 1e-5);
        for (const float roughness : {0.3f, 0.5f, 0.7f, 0.85f, 1.0f}) {
            EXPECT_NEAR(integrals(bsdf(), white(1.0f, roughness), wo).x, 1.0, 0.01)
                << roughness << " " << wo.z;
            EXPECT_NEAR(integrals(bsdf(), white(0.5f, roughness), wo).x, 1.0, 0.01)
                << roughness << " " << wo.z;
        }
    }
}

/// The loss of single scattering, and its mean over the hemisphere, against integrals of the lobe.
TEST(Bsdf, LossOfSingleScatteringIsItsIntegral) {
    static const std::vector<glm::vec3> directions = sphere();
    for (const float roughness : {0.45f, 0.6f, 0.75f, 0.9f, 1.0f}) {
        for (const glm::vec3& wo : kOutgoing) {
            double albedo = 0.0;
            for (const float v :
                 bsdf().evaluate<float>("result = x2.z > 0.0 ? ggxEvaluate(x0, x1, x2) * x2.z : 0.0;",
                                        roughness * roughness, wo, directions))
                albedo += static_cast<double>(v);
            albedo *= 4.0 * std::numbers::pi / static_cast<double>(directions.size());
            EXPECT_NEAR(bsdf().call<float>("ggxLoss", roughness, wo.z).front(), 1.0 - albedo, 0.007)
                << roughness << " " << wo.z;
        }
        std::vector<float> cosines;
        for (int i = 0; i < 1000; ++i)
            cosines.push_back((static_cast<float>(i) + 0.5f) / 1000.0f);
        double mean = 0.0;
        const std::vector<float> losses = bsdf().call<float>("ggxLoss", roughness, cosines);
        for (std::size_t i = 0; i < losses.size(); ++i)
            mean += 2e-3 * static_cast<double>(losses[i]) * static_cast<double>(cosines[i]);
        const double fitted = static_cast<double>(bsdf().call<float>("ggxMeanLoss", roughness).front());
        EXPECT_NEAR(fitted / mean, 1.0, 0.02) << roughness;
    }
}

/// Coloured metals: no channel returns more than it receives, and a darker base colour returns less.
TEST(Bsdf, MetalsAbsorb) {
    for (const float roughness : {0.3f, 0.6f, 1.0f}) {
        const glm::dvec4 back =
            integrals(bsdf(), {glm::vec3(0.95f, 0.6f, 0.1f), 1.0f, roughness}, glm::vec3(0.6f, 0.0f, 0.8f));
        EXPECT_LT(back.x, 1.0);
        EXPECT_LT(back.y, back.x);
        EXPECT_LT(back.z, back.y);
        EXPECT_GT(back.z, 0.03);
    }
}

struct Case {
    const char* name;
    Bsdf bsdf;
    std::uint32_t mode;
};
const std::vector<Case> kCases{{"diffuse", {glm::vec3(0.5f), 0.0f, 0.5f}, kRadiance},
                               {"metal-rough", {glm::vec3(0.9f), 1.0f, 0.8f}, kRadiance},
                               {"metal-glossy", {glm::vec3(0.9f), 1.0f, 0.45f}, kRadiance},
                               {"mixture", {glm::vec3(0.7f), 0.5f, 0.6f}, kRadiance},
                               {"metal-importance", {glm::vec3(0.9f), 1.0f, 0.6f}, kImportance}};

/// Tests samples over (z, phi) of the upper hemisphere, where area is solid angle, against the density in
/// double precision. Samples of a rough metal may be below the horizon, where nothing is reflected; the
/// others follow the normalised density. With and without a separate shading normal; ten tests at level 1e-5.
TEST(Bsdf, SamplesHaveTheirDensity) {
    const std::vector<glm::vec2> us = randomSquare(1 << 17);
    std::vector<float> choices;
    for (const glm::vec2& u : randomSquare(us.size(), 9))
        choices.push_back(u.x);
    const glm::vec3 wo = glm::normalize(glm::vec3(0.5f, -0.3f, 0.6f));
    for (const Case& c : kCases) {
        for (const bool smooth : {false, true}) {
            BsdfFrame frame = kFlat;
            if (smooth) frame.shading = glm::normalize(glm::vec3(0.2f, 0.25f, 1.0f));
            const mirror::twice::BsdfFrame exact{glm::dvec3(frame.shading), glm::dvec3(frame.geometric)};
            const auto density = [&](double z, double phi) {
                const double r = std::sqrt(std::max(1.0 - z * z, 0.0));
                return mirror::twice::bsdfPdf(widen(c.bsdf), exact, glm::dvec3(wo),
                                              {r * std::cos(phi), r * std::sin(phi), z}, c.mode);
            };
            const Rectangle domain{{0.0, -std::numbers::pi}, {1.0, std::numbers::pi}};
            const double above = integrate(density, domain, 32);
            std::vector<glm::dvec2> points;
            for (const BsdfSample& s :
                 bsdf().call<BsdfSample>("bsdfSample", c.bsdf, frame, wo, choices, us, c.mode)) {
                if (s.pdf > 0.0f) points.emplace_back(s.wi.z, std::atan2(s.wi.y, s.wi.x));
            }
            const auto n = static_cast<double>(us.size());
            EXPECT_NEAR(static_cast<double>(points.size()) / n, above, 5.0 * std::sqrt(0.25 / n)) << c.name;
            expectDensity(
                std::string("bsdf-") + c.name + (smooth ? "-smooth" : ""), points, domain,
                [&](double z, double phi) { return density(z, phi) / above; }, 1e-5, 24);
        }
    }
}

/// The mean of f |cos| / pdf over samples is the integral of f |cos|.
TEST(Bsdf, WeightsOfSamplesMakeTheIntegral) {
    const std::vector<glm::vec2> us = unitSquare(256);
    std::vector<float> choices;
    for (const glm::vec2& u : randomSquare(us.size(), 9))
        choices.push_back(u.x);
    for (const Case& c : kCases) {
        const glm::vec3 wo(0.6f, 0.0f, 0.8f);
        double mean = 0.0;
        for (const BsdfSample& s :
             bsdf().call<BsdfSample>("bsdfSample", c.bsdf, kFlat, wo, choices, us, c.mode))
            mean += s.pdf > 0.0f ? static_cast<double>(s.weight.x) : 0.0;
        mean /= static_cast<double>(us.size());
        EXPECT_NEAR(mean, integrals(bsdf(), c.bsdf, wo).x, 0.005) << c.name;
    }
}

/// A scene without metals uses only the diffuse lobe, with the same results.
TEST(Bsdf, DiffuseAloneIsTheSame) {
    const std::vector<glm::vec2> us = randomSquare(1 << 12);
    const Bsdf b{glm::vec3(0.2f, 0.5f, 0.9f), 0.0f, 0.5f};
    const auto all = bsdf().call<BsdfSample>("bsdfSample", b, kFlat, kOutgoing[1], 0.5f, us, kRadiance);
    const auto alone =
        diffuseOnly().call<BsdfSample>("bsdfSample", b, kFlat, kOutgoing[1], 0.5f, us, kRadiance);
    for (std::size_t i = 0; i < us.size(); ++i) {
        ASSERT_EQ(all[i].wi, alone[i].wi);
        ASSERT_EQ(alone[i].weight, b.baseColor);
        ASSERT_NEAR(all[i].weight.z, alone[i].weight.z, 2e-6f);
        ASSERT_NEAR(all[i].pdf, alone[i].pdf, 1e-6f);
    }
}

TEST(BsdfOracles, AllFunctions) {
    const std::size_t n = 4096;
    const std::vector<glm::vec2> us = randomSquare(n, 7);
    const std::vector<glm::vec2> more = randomSquare(n, 8);
    std::vector<Bsdf> bsdfs;
    std::vector<BsdfFrame> frames;
    std::vector<glm::vec3> wo, wi;
    std::vector<float> choices, alphas, roughnesses, cosines;
    const std::vector<glm::vec3> a = randomDirections(n, 1), b = randomDirections(n, 2),
                                 c = randomDirections(n, 3), d = randomDirections(n, 4);
    for (std::size_t i = 0; i < n; ++i) {
        bsdfs.push_back({glm::abs(a[i]), i % 3 == 0 ? 0.0f : more[i].x, 0.2f + 0.8f * more[i].y});
        frames.push_back({glm::normalize(b[i] + 0.3f * a[i]), b[i]});
        // Keeps away from the horizons, where single and double precision may see different sides.
        wo.push_back(glm::normalize(c[i] * (glm::dot(c[i], b[i]) < 0.0f ? -1.0f : 1.0f) + 0.6f * b[i]));
        wi.push_back(glm::normalize(d[i] * (glm::dot(d[i], b[i]) < 0.0f ? -1.0f : 1.0f) + 0.6f * b[i]));
        choices.push_back(us[i].y);
        roughnesses.push_back(0.2f + 0.8f * more[i].y);
        alphas.push_back(roughnesses.back() * roughnesses.back());
        cosines.push_back(us[i].x);
    }
    const std::vector<std::uint32_t> modes(n, kRadiance);
    EXPECT_ORACLES(bsdf(), bsdfEvaluate, (Budget{600, 5e-5}), bsdfs, frames, wo, wi, modes);
    EXPECT_ORACLES(bsdf(), bsdfPdf, (Budget{600, 5e-5}), bsdfs, frames, wo, wi, modes);
    EXPECT_ORACLES(bsdf(), bsdfAlbedo, (Budget{20, 1e-6}), bsdfs, frames, wo);
    EXPECT_ORACLES(bsdf(), ggxLoss, (Budget{20, 2e-5}), roughnesses, cosines);
    EXPECT_ORACLES(bsdf(), smithTerm, (Budget{4, 1e-7}), alphas, cosines);
    EXPECT_ORACLES(bsdf(), aboveHorizon, (Budget{4, 1e-6}), wo);
    EXPECT_ORACLES(diffuseOnly(), diffuseSample, (Budget{4, 1e-6}), bsdfs, wo, us);
    EXPECT_ORACLES(bsdf(), diffusePdf, (Budget{3, 1e-7}), wo, wi);
}

}  // namespace
}  // namespace duolux::test
