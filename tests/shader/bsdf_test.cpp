#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "shaders/shared/material_layout.h"
#include "tests/shader/bsdf_surfaces.h"
#include "tests/shader/density.h"
#include "tests/shader/inputs.h"
#include "tests/shader/mirror_types.h"
#include "tests/shader/oracles.h"

// BSDFs: integrals of the device's functions over directions, the density of samples, and both oracles.

namespace duolux::test {
namespace {

/// Along, across and between tangents, steep and grazing.
const std::vector<glm::vec3> kAzimuths{
    {0.0f, 0.0f, 1.0f},       {0.6f, 0.0f, 0.8f},       {0.0f, 0.8f, 0.6f},         {0.48f, 0.64f, 0.6f},
    {0.98f, 0.0f, 0.198997f}, {0.0f, 0.98f, 0.198997f}, {0.784f, 0.588f, 0.198997f}};

/// Surfaces of which a direction and a description make the message of a failure.
struct Furnace {
    std::vector<Bsdf> bsdfs;
    std::vector<std::string> names;

    void add(const std::string& name, const Bsdf& b) {
        bsdfs.push_back(b);
        names.push_back(name);
    }

    /// Expects that each surface scatters everything that arrives from every direction.
    void expectWhite(std::uint32_t mode, double tolerance) const {
        expectReturned(mode, 1.0 - tolerance, 1.0 + tolerance, {kOutgoing[0], kOutgoing[3], kOutgoing[4]});
    }

    /// Expects that each surface scatters between these fractions of what arrives from each direction: the
    /// mean of f |cos| / pdf over samples.
    void expectReturned(std::uint32_t mode, double least, double most,
                        const std::vector<glm::vec3>& directions) const {
        constexpr std::size_t kSamples = 65536;
        // Evenly distributed in the unit cube: multiples of powers of a root of x^4 = x + 1 (Roberts, "The
        // Unreasonable Effectiveness of Quasirandom Sequences", 2018).
        constexpr double kRoot = 1.2207440846057596;
        const auto sequence = [](std::size_t i, int power) {
            return static_cast<float>(std::fmod(0.5 + static_cast<double>(i) / std::pow(kRoot, power), 1.0));
        };
        std::vector<Bsdf> b;
        std::vector<glm::vec2> us;
        std::vector<float> choices;
        for (const Bsdf& one : bsdfs) {
            for (std::size_t i = 0; i < kSamples; ++i) {
                b.push_back(one);
                us.emplace_back(sequence(i, 1), sequence(i, 2));
                choices.push_back(sequence(i, 3));
            }
        }
        for (const glm::vec3& wo : directions) {
            const auto samples = bsdf().call<BsdfSample>("bsdfSample", b, kFlat, wo, choices, us, mode);
            for (std::size_t k = 0; k < bsdfs.size(); ++k) {
                double sum = 0.0;
                for (std::size_t i = 0; i < kSamples; ++i) {
                    const BsdfSample& s = samples[k * kSamples + i];
                    sum += s.pdf > 0.0f ? static_cast<double>(s.weight.x) : 0.0;
                }
                const std::string message = fmt::format("{}, direction {} {} {}", names[k], wo.x, wo.y, wo.z);
                EXPECT_GE(sum / kSamples, least) << message;
                EXPECT_LE(sum / kSamples, most) << message;
            }
        }
    }
};

/// Stretched microfacets, from nearly flat to rough ones, at azimuths along, across and between: in tables of
/// coarser steps than those of other surfaces.
TEST(Bsdf, StretchedFacetsReturnEverything) {
    Furnace metals, glasses;
    for (const float roughness : {0.1f, 0.23f, 0.4f, 0.65f, 0.9f}) {
        for (const float strength : {0.3f, 0.5f, 0.8f, 1.0f}) {
            const std::string with = fmt::format(" of roughness {}, anisotropy {}", roughness, strength);
            metals.add("metal" + with, anisotropic(metal(1.0f, roughness), strength));
            metals.add("dielectric" + with, anisotropic(dielectric(1.5f, roughness), strength));
            metals.add("thin glass" + with, anisotropic(glass(1.5f, roughness, true), strength));
            for (const float eta : {1.5f, 1.0f / 1.5f})
                glasses.add(fmt::format("glass {}", eta) + with,
                            anisotropic(glass(eta, roughness), strength));
        }
    }
    metals.expectReturned(kRadiance, 0.99, 1.005, kAzimuths);
    // Glass has no tables of its own for anisotropy: it loses light, but makes none.
    glasses.expectReturned(kImportance, 0.5, 1.005, kAzimuths);
}

const std::vector<float> kRoughnesses{0.0f, 0.1f, 0.25f, 0.4f, 0.7f, 1.0f};

/// The white furnace: a surface that absorbs nothing scatters everything, for every roughness and direction.
TEST(Bsdf, WhiteFurnaceReturnsEverything) {
    for (const glm::vec3& wo : kOutgoing)
        EXPECT_NEAR(integrals(diffuseOnly(), whiteDiffuse(), wo).x, 1.0, 1e-5);
    Furnace furnace;
    furnace.add("diffuse", whiteDiffuse());
    for (const float roughness : kRoughnesses) {
        const std::string with = fmt::format(" of roughness {}", roughness);
        for (const float metallic : {0.3f, 1.0f})
            furnace.add(fmt::format("metal {}", metallic) + with, metal(metallic, roughness));
        for (const float ior : {1.0f, 1.2f, 1.5f, 2.5f})
            furnace.add(fmt::format("dielectric {}", ior) + with, dielectric(ior, roughness));
        furnace.add("thin glass" + with, glass(1.5f, roughness, true));
        furnace.add("clearcoat" + with, clearcoat(whiteDiffuse(), 1.0f, roughness));
        furnace.add("on metal, clearcoat" + with, clearcoat(metal(1.0f, 0.3f), 0.7f, roughness));
        furnace.add("sheen" + with, sheen(whiteDiffuse(), 1.0f, roughness));
        furnace.add("on dielectric, sheen" + with, sheen(dielectric(1.5f, 0.4f), 0.6f, roughness));
    }
    furnace.expectWhite(kRadiance, 0.005);
}

/// Glass scatters all flux, from outside and from inside: in importance mode, because radiance changes with
/// the index of refraction.
TEST(Bsdf, GlassKeepsAllFlux) {
    Furnace furnace;
    for (const float roughness : kRoughnesses) {
        for (const float ior : {1.1f, 1.33f, 1.5f, 2.4f}) {
            for (const float eta : {ior, 1.0f / ior})
                furnace.add(fmt::format("eta {}, roughness {}", eta, roughness), glass(eta, roughness));
        }
    }
    furnace.expectWhite(kImportance, 0.008);
}

/// Coloured metals: no channel returns more than it receives, and a darker base colour returns less.
TEST(Bsdf, MetalsAbsorb) {
    for (const float roughness : {0.3f, 0.6f, 1.0f}) {
        const glm::dvec4 back =
            integrals(bsdf(), metal(1.0f, roughness, {0.95f, 0.6f, 0.1f}), glm::vec3(0.6f, 0.0f, 0.8f));
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
const std::vector<Case> kCases{
    {"diffuse", whiteDiffuse(), kRadiance},
    {"metal-rough", metal(1.0f, 0.8f, glm::vec3(0.9f)), kRadiance},
    {"metal-glossy", metal(1.0f, 0.45f, glm::vec3(0.9f)), kRadiance},
    {"mixture", metal(0.5f, 0.6f, glm::vec3(0.7f)), kRadiance},
    {"metal-importance", metal(1.0f, 0.6f, glm::vec3(0.9f)), kImportance},
    {"dielectric", dielectric(1.5f, 0.5f, glm::vec3(0.2f)), kRadiance},
    {"metal-anisotropic", anisotropic(metal(1.0f, 0.5f), 0.8f), kRadiance},
    {"glass", glass(1.5f, 0.35f), kRadiance},
    {"glass-inside", glass(1.0f / 1.5f, 0.85f), kImportance},
    {"glass-thin", glass(1.5f, 0.5f, true), kRadiance},
    {"clearcoat", clearcoat(metal(1.0f, 0.8f, glm::vec3(0.5f)), 1.0f, 0.5f), kRadiance},
    {"sheen", sheen(dielectric(1.5f, 0.6f, glm::vec3(0.3f)), 0.8f, 0.5f), kRadiance}};

/// Tests samples over (z, phi) of the upper hemisphere, where area is solid angle, against the density in
/// double precision. Samples of a rough metal may be below the horizon, where nothing is reflected; the
/// others follow the normalised density. With and without a separate shading normal; ten tests at level 1e-5.
TEST(Bsdf, SamplesHaveTheirDensity) {
    const std::vector<glm::vec2> us = randomSquare(1 << 17);
    std::vector<float> choices;
    for (const glm::vec2& u : randomSquare(us.size(), 9))
        choices.push_back(u.x);
    const glm::vec3 wo = glm::normalize(glm::vec3(0.5f, -0.3f, 0.6f));
    bsdf();  // also gives the mirror its tables
    for (const Case& c : kCases) {
        for (const bool smooth : {false, true}) {
            BsdfFrame frame = kFlat;
            if (smooth) frame = frameWith(glm::normalize(glm::vec3(0.2f, 0.25f, 1.0f)), frame.geometric);
            const mirror::twice::BsdfFrame exact{glm::dvec3(frame.shading), glm::dvec3(frame.geometric),
                                                 glm::dvec3(frame.tangent), glm::dvec3(frame.coat)};
            const auto density = [&](double z, double phi) {
                const double r = std::sqrt(std::max(1.0 - z * z, 0.0));
                return mirror::twice::bsdfPdf(widen(c.bsdf), exact, glm::dvec3(wo),
                                              {r * std::cos(phi), r * std::sin(phi), z}, c.mode);
            };
            const Rectangle domain{{c.bsdf.transmission > 0.0f ? -1.0 : 0.0, -std::numbers::pi},
                                   {1.0, std::numbers::pi}};
            const double above = integrate(density, domain, 2 * 24);  // at the same points as expectDensity
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
        EXPECT_NEAR(mean, integrals(bsdf(), c.bsdf, wo, c.mode).x, 0.005) << c.name;
    }
}

/// A scene without metals uses only the diffuse lobe, with the same results.
TEST(Bsdf, DiffuseAloneIsTheSame) {
    const std::vector<glm::vec2> us = randomSquare(1 << 12);
    Bsdf b = whiteDiffuse();
    b.baseColor = glm::vec3(0.2f, 0.5f, 0.9f);
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
    std::vector<float> choices, roughnesses, cosines;
    std::vector<glm::vec2> alphas;
    const std::vector<glm::vec3> a = randomDirections(n, 1), b = randomDirections(n, 2),
                                 c = randomDirections(n, 3), d = randomDirections(n, 4);
    for (std::size_t i = 0; i < n; ++i) {
        Bsdf random = dielectric(1.0f + more[i].x, 0.2f + 0.8f * more[i].y, glm::abs(a[i]));
        random.metallic = i % 3 == 0 ? 0.0f : more[i].x;
        random.transmission = i % 2 == 0 ? 0.0f : more[i].y;
        if (i % 5 < 2) random = clearcoat(random, more[i].y, 0.2f + 0.8f * us[i].x);
        if (i % 5 > 2) random = sheen(random, more[i].x, 0.2f + 0.8f * us[i].x);
        bsdfs.push_back(random);
        frames.push_back(frameWith(glm::normalize(b[i] + 0.3f * a[i]), b[i]));
        // Keeps away from the horizons, where single and double precision may see different sides.
        wo.push_back(glm::normalize(c[i] * (glm::dot(c[i], b[i]) < 0.0f ? -1.0f : 1.0f) + 0.6f * b[i]));
        wi.push_back(glm::normalize(d[i] * (glm::dot(d[i], b[i]) < 0.0f ? -1.0f : 1.0f) + 0.6f * b[i]));
        choices.push_back(us[i].y);
        roughnesses.push_back(0.2f + 0.8f * more[i].y);
        alphas.push_back(glm::vec2(roughnesses.back() * roughnesses.back(), roughnesses.back()));
        cosines.push_back(us[i].x);
    }
    const std::vector<std::uint32_t> modes(n, kRadiance);
    EXPECT_ORACLES(bsdf(), bsdfEvaluate, (Budget{600, 5e-5}), bsdfs, frames, wo, wi, modes);
    EXPECT_ORACLES(bsdf(), bsdfPdf, (Budget{600, 5e-5}), bsdfs, frames, wo, wi, modes);
    EXPECT_ORACLES(bsdf(), bsdfAlbedo, (Budget{20, 1e-6}), bsdfs, frames, wo);
    EXPECT_ORACLES(bsdf(), reflectionAlbedo, (Budget{20, 2e-5}), cosines, roughnesses);
    EXPECT_ORACLES(bsdf(), smithTerm, (Budget{4, 1e-7}), alphas, wo);
    EXPECT_ORACLES(bsdf(), aboveHorizon, (Budget{4, 1e-6}), wo);
    EXPECT_ORACLES(diffuseOnly(), diffuseSample, (Budget{4, 1e-6}), bsdfs, wo, us);
    EXPECT_ORACLES(bsdf(), diffusePdf, (Budget{3, 1e-7}), wo, wi);
}

}  // namespace
}  // namespace duolux::test
