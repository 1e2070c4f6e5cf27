#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "shaders/shared/texture_layout.h"
#include "tests/shader/bsdf_surfaces.h"

// Clearcoats that have normals of their own.

namespace duolux::test {
namespace {

/// The library for scenes with clearcoats that have normals of their own.
const ShaderLibrary& bentCoats() {
    static const ShaderLibrary library =
        bsdfLibrary(shared::kAllLobes).constant(shared::kSpecTextureGroups, 1u << shared::kGroupCoatNormal);
    return library;
}

/// Flat, but for the normal of the clearcoat.
BsdfFrame coatedFrame(const glm::vec3& coat) {
    BsdfFrame frame = kFlat;
    frame.coat = glm::normalize(coat);
    return frame;
}

/// A clearcoat reflects around its own normal, whatever that of the surface below: as much as one whose
/// surface has that normal.
TEST(ClearcoatNormal, ClearcoatsReflectAroundTheirNormal) {
    Bsdf black = clearcoat(whiteDiffuse(), 0.8f, 0.45f);
    black.baseColor = glm::vec3(0.0f);
    const glm::vec3 normal = glm::normalize(glm::vec3(0.2f, -0.15f, 1.0f));
    for (const glm::vec3& wo : {kOutgoing[0], kOutgoing[1]}) {
        const double tilted = integrals(bentCoats(), black, wo, kRadiance, coatedFrame(normal)).x;
        const double turned = integrals(bsdf(), black, wo, kRadiance, frameWith(normal, normal)).x;
        const double flat = integrals(bsdf(), black, wo).x;
        EXPECT_NEAR(tilted, turned, 0.01 * turned) << wo.x << ": but for tails beyond either horizon";
        if (wo.x > 0.0f) {
            EXPECT_GT(std::abs(tilted - flat), 0.02 * flat);
        }
    }
    // A mirror reflects in that direction.
    black.clearcoatRoughness = 0.0f;
    const glm::vec3 wo = kOutgoing[1], expected = 2.0f * glm::dot(normal, wo) * normal - wo;
    for (const std::uint32_t mode : {kRadiance, kImportance}) {
        for (const BsdfSample& s : bentCoats().call<BsdfSample>("bsdfSample", black, coatedFrame(normal), wo,
                                                                0.999f, std::vector<glm::vec2>(4), mode)) {
            EXPECT_LT(glm::length(s.wi - expected), 1e-5f);
            EXPECT_GT(s.pdf, 1e29f);
        }
    }
}

TEST(ClearcoatNormal, ClearcoatsWithoutANormalOfTheirOwnAreTheSame) {
    const std::vector<glm::vec2> us = randomSquare(1 << 12);
    const Bsdf b = clearcoat(dielectric(1.5f, 0.5f, glm::vec3(0.4f)), 0.7f, 0.3f);
    const BsdfFrame frame = frameWith(glm::normalize(glm::vec3(0.2f, 0.25f, 1.0f)), kFlat.geometric);
    const auto bent =
        bentCoats().call<BsdfSample>("bsdfSample", b, frame, kOutgoing[1], 0.95f, us, kRadiance);
    const auto plain = bsdf().call<BsdfSample>("bsdfSample", b, frame, kOutgoing[1], 0.95f, us, kRadiance);
    const glm::vec3 white(1.0f);
    double bentSum = 0.0, plainSum = 0.0;
    for (std::size_t i = 0; i < us.size(); ++i) {
        bentSum += bent[i].pdf > 0.0f ? static_cast<double>(glm::dot(bent[i].weight, white)) : 0.0;
        plainSum += plain[i].pdf > 0.0f ? static_cast<double>(glm::dot(plain[i].weight, white)) : 0.0;
    }
    EXPECT_NEAR(bentSum, plainSum, 0.01 * plainSum);
    const std::vector<glm::vec3> wi = randomDirections(4096, 3);
    for (const std::uint32_t mode : {kRadiance, kImportance}) {
        for (const char* const function :
             {"bsdfEvaluate(x0, x1, x2, x3, x4).x", "bsdfPdf(x0, x1, x2, x3, x4)"}) {
            const std::string code = std::string("result = ") + function + ";";
            const auto a = bentCoats().evaluate<float>(code, b, frame, kOutgoing[1], wi, mode);
            const auto c = bsdf().evaluate<float>(code, b, frame, kOutgoing[1], wi, mode);
            for (std::size_t i = 0; i < wi.size(); ++i)
                ASSERT_NEAR(a[i], c[i], 2e-3f * c[i] + 1e-5f) << function << " " << i;
        }
    }
}

/// With a bent normal of the clearcoat: samples have their density and weights, nothing is gained, and both
/// modes evaluate the same BSDF.
TEST(ClearcoatNormal, BentClearcoatsAreSampledAsTheyReflect) {
    const std::vector<glm::vec2> us = unitSquare(256);
    std::vector<float> choices;
    for (const glm::vec2& u : randomSquare(us.size(), 9))
        choices.push_back(u.x);
    const BsdfFrame frame = coatedFrame({0.35f, 0.3f, 1.0f});
    const glm::vec3 wo(0.6f, 0.0f, 0.8f);
    for (const Bsdf& b : {clearcoat(whiteDiffuse(), 1.0f, 0.5f), clearcoat(metal(1.0f, 0.6f), 0.7f, 0.35f),
                          clearcoat(glass(1.5f, 0.5f), 0.8f, 0.4f),
                          sheen(clearcoat(dielectric(1.5f, 0.6f), 1.0f, 0.6f), 0.5f, 0.5f)}) {
        for (const std::uint32_t mode : {kRadiance, kImportance}) {
            const glm::dvec4 exact = integrals(bentCoats(), b, wo, mode, frame);
            double mean = 0.0, kept = 0.0;
            for (const BsdfSample& s :
                 bentCoats().call<BsdfSample>("bsdfSample", b, frame, wo, choices, us, mode)) {
                if (!(s.pdf > 0.0f)) continue;
                mean += static_cast<double>(s.weight.x);
                kept += 1.0;
            }
            mean /= static_cast<double>(us.size());
            kept /= static_cast<double>(us.size());
            EXPECT_NEAR(mean, exact.x, 0.005) << mode;
            EXPECT_NEAR(kept, exact.w, 0.005) << mode;
            if (mode == kRadiance) {
                EXPECT_LT(exact.x, 1.005);
            }
        }
    }
    const Bsdf b = clearcoat(dielectric(1.5f, 0.6f, glm::vec3(0.3f)), 1.0f, 0.4f);
    std::vector<glm::vec3> wi;
    for (const glm::vec3& w : randomDirections(4096, 3))
        wi.push_back(glm::normalize(glm::vec3(w.x, w.y, std::abs(w.z) + 0.05f)));
    const auto forward =
        bentCoats().evaluate<glm::vec3>("result = bsdfEvaluate(x0, x1, x2, x3, 0u);", b, frame, wo, wi);
    const auto backward =
        bentCoats().evaluate<glm::vec3>("result = bsdfEvaluate(x0, x1, x3, x2, 1u);", b, frame, wo, wi);
    for (std::size_t i = 0; i < wi.size(); ++i)
        ASSERT_NEAR(forward[i].x, backward[i].x, 1e-4f * forward[i].x + 1e-6f) << i;
}

/// Sheen on a smooth bent varnish takes the same from light in both modes: the flux that a mirror sends from
/// a direction to another is, but for the cosines, that of the way back.
TEST(ClearcoatNormal, SheenLiesOnASmoothBentClearcoat) {
    const BsdfFrame frame = coatedFrame({0.45f, 0.1f, 1.0f});
    const glm::vec3 wo = glm::normalize(glm::vec3(-0.3f, 0.1f, 0.95f));
    const Bsdf bare = clearcoat(whiteDiffuse(), 1.0f, 0.0f);
    const Bsdf b = sheen(bare, 0.9f, 1.0f);
    // The weight of the mirror times the probability of its choice, and the direction.
    const auto reflected = [&](const Bsdf& surface, const glm::vec3& from, std::uint32_t mode) {
        const std::vector<glm::vec2> us(1 << 16);
        std::vector<float> choices;
        for (std::size_t i = 0; i < us.size(); ++i)
            choices.push_back((static_cast<float>(i) + 0.5f) / static_cast<float>(us.size()));
        BsdfSample kept{};
        double sum = 0.0;
        for (const BsdfSample& s :
             bentCoats().call<BsdfSample>("bsdfSample", surface, frame, from, choices, us, mode)) {
            if (s.pdf < 1e29f) continue;
            kept = s;
            sum += static_cast<double>(s.weight.x);
        }
        return std::pair(sum / static_cast<double>(us.size()), kept.wi);
    };
    const auto [forward, wi] = reflected(b, wo, kRadiance);
    const auto [backward, back] = reflected(b, wi, kImportance);
    ASSERT_LT(glm::length(back - wo), 1e-4f);
    const auto [bareForward, bareWi] = reflected(bare, wo, kRadiance);
    const auto [bareBackward, bareBack] = reflected(bare, wi, kImportance);
    EXPECT_NEAR(forward / bareForward, backward / bareBackward, 0.02);
    EXPECT_LT(forward / bareForward, 0.9);
}

}  // namespace
}  // namespace duolux::test
