#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "tests/shader/density.h"
#include "tests/shader/inputs.h"
#include "tests/shader/mirror_types.h"
#include "tests/shader/oracles.h"

// BSDFs: integrals of the device's own functions over directions, the density of samples, and both oracles.

namespace duolux::test {
namespace {

using mirror::single::Bsdf;
using mirror::single::BsdfSample;

constexpr double kPi = glm::pi<double>();

const ShaderLibrary& bsdf() {
    static const ShaderLibrary library("shaders/lib/bsdf.glsl");
    return library;
}

const std::vector<Bsdf> kBsdfs{{glm::vec3(1.0f)}, {glm::vec3(0.0f)}, {glm::vec3(0.2f, 0.5f, 0.9f)}};
const std::vector<glm::vec3> kOutgoing{{0.0f, 0.0f, 1.0f},
                                       {0.6f, 0.0f, 0.8f},
                                       {0.0f, -0.8f, 0.6f},
                                       {0.48f, 0.64f, 0.6f},
                                       {0.99995f, 0.0f, 0.01f}};

/// Midpoints of 128 x 128 cells of (z, phi), all of the sphere; the solid angle of a cell is 4 pi / 128^2.
/// For what is linear in z between -1, 0 and 1 the sum over them is the integral.
std::vector<glm::vec3> sphere() {
    std::vector<glm::vec3> directions;
    for (const glm::dvec2 u : unitSquare(128)) {
        const double z = 2.0 * u.x - 1.0;
        const double r = std::sqrt(1.0 - z * z);
        directions.emplace_back(r * std::cos(2.0 * kPi * u.y), r * std::sin(2.0 * kPi * u.y), z);
    }
    return directions;
}

/// The density of samples integrates to 1 over the sphere; f |cos| over the hemisphere is the albedo: by no
/// more than 1, and by 1 where nothing is absorbed (the white furnace).
TEST(Bsdf, IntegratesToItsAlbedo) {
    const std::vector<glm::vec3> directions = sphere();
    const double solidAngle = 4.0 * kPi / static_cast<double>(directions.size());
    for (const Bsdf& b : kBsdfs) {
        for (const glm::vec3& wo : kOutgoing) {
            double pdf = 0.0;
            glm::dvec3 reflected(0.0);
            for (const glm::vec4 v : bsdf().evaluate<glm::vec4>(
                     "result = vec4(bsdfEvaluate(x0, x1, x2) * max(x2.z, 0.0), bsdfPdf(x0, x1, x2));", b, wo,
                     directions)) {
                reflected += glm::dvec3(v) * solidAngle;
                pdf += static_cast<double>(v.w) * solidAngle;
            }
            EXPECT_NEAR(pdf, 1.0, 1e-6);
            const glm::dvec3 albedo(bsdf().call<glm::vec3>("bsdfAlbedo", b, wo).front());
            for (glm::length_t c = 0; c < 3; ++c) {
                EXPECT_NEAR(reflected[c], albedo[c], 1e-6);
                EXPECT_LE(reflected[c], 1.0 + 1e-6);
                EXPECT_EQ(albedo[c], static_cast<double>(b.diffuse[c]));
            }
        }
    }
}

/// The mean of f |cos| / pdf over samples is the albedo; for this BSDF every one of them is.
TEST(Bsdf, SampledWeightsAreTheAlbedo) {
    const std::vector<glm::vec2> us = randomSquare(1 << 12);
    for (const Bsdf& b : kBsdfs) {
        for (const glm::vec3& wo : kOutgoing) {
            for (const BsdfSample& s : bsdf().call<BsdfSample>("bsdfSample", b, wo, us))
                ASSERT_EQ(s.weight, b.diffuse);
        }
    }
}

/// Samples over (z, phi) of the whole sphere, in which solid angle is an area, against max(z, 0) / pi: what
/// bsdfPdf is for each of the directions. Two tests at 5e-5.
TEST(Bsdf, SamplesHaveTheirDensity) {
    const auto density = [](double z, double) { return std::max(z, 0.0) / kPi; };
    const std::vector<glm::vec2> us = randomSquare(1 << 16);
    for (const std::size_t outgoing : {1u, 3u}) {
        std::vector<glm::dvec2> points;
        for (const BsdfSample& s :
             bsdf().call<BsdfSample>("bsdfSample", kBsdfs[2], kOutgoing[outgoing], us)) {
            points.emplace_back(s.wi.z, std::atan2(s.wi.y, s.wi.x));
            ASSERT_NEAR(static_cast<double>(s.pdf), density(points.back().x, 0.0), 1e-7);
        }
        expectDensity("bsdf-diffuse", points, {{-1.0, -kPi}, {1.0, kPi}}, density, 5e-5);
    }
}

TEST(Bsdf, PdfMatchesItsFormula) {
    const std::vector<glm::vec3> directions = randomDirections(1 << 14);
    const std::vector<float> pdfs = bsdf().call<float>("bsdfPdf", kBsdfs[2], kOutgoing[1], directions);
    for (std::size_t i = 0; i < directions.size(); ++i)
        ASSERT_NEAR(static_cast<double>(pdfs[i]), std::max(static_cast<double>(directions[i].z), 0.0) / kPi,
                    5e-8);
}

TEST(BsdfOracles, AllFunctions) {
    const std::vector<glm::vec2> us = unitSquare(64);
    const std::vector<glm::vec3> wo = randomDirections(us.size(), 1);
    const std::vector<glm::vec3> wi = randomDirections(us.size(), 2);
    std::vector<Bsdf> bsdfs;
    for (const glm::vec3& d : randomDirections(us.size(), 3))
        bsdfs.push_back({glm::abs(d)});
    EXPECT_ORACLES(bsdf(), bsdfEvaluate, (Budget{3, 0}), bsdfs, wo, wi);
    EXPECT_ORACLES(bsdf(), bsdfPdf, (Budget{3, 0}), bsdfs, wo, wi);
    EXPECT_ORACLES(bsdf(), bsdfAlbedo, (Budget{0, 0}), bsdfs, wo);
    EXPECT_ORACLES(bsdf(), bsdfSample, (Budget{3, 1e-6}), bsdfs, wo, us);
}

}  // namespace
}  // namespace duolux::test
