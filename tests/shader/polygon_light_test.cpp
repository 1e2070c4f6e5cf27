#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/closed_form.h"
#include "tests/support/run_kernel.h"

namespace duolux::spirv {
extern const std::span<const std::uint32_t> kPolygonLightTest;
}

namespace duolux::test {
namespace {

/// Corners seen from the receiver, and its normal.
struct PolygonInput {
    glm::vec3 a, b, c, normal;
};

std::vector<float> evaluate(const std::vector<PolygonInput>& inputs) {
    const Buffer input = Buffer::upload<PolygonInput>(device(), BufferUse::kStorage, inputs, "inputs");
    const auto count = static_cast<std::uint32_t>(inputs.size());
    return runKernel<float>(spirv::kPolygonLightTest, {{0, &input}}, 1, count, count);
}

/// The same in double precision, by clipping the polygon.
double exact(const PolygonInput& p) {
    const std::array<Vec3, 3> corners{Vec3(p.a), Vec3(p.b), Vec3(p.c)};
    return std::abs(lambertPolygon(Vec3(0.0), glm::normalize(Vec3(p.normal)), corners));
}

class PolygonLight : public testing::Test {
  protected:
    glm::vec3 direction() {
        glm::vec3 v;
        do {
            v = {uniform_(engine_), uniform_(engine_), uniform_(engine_)};
        } while (glm::length(v) < 0.1f || glm::length(v) > 1.0f);
        return glm::normalize(v);
    }

    /// The error of a sum of three arcs of at most pi, each with a few roundings.
    static constexpr double kTolerance = 2e-6;

    std::mt19937 engine_{7};
    std::uniform_real_distribution<float> uniform_{-1.0f, 1.0f};
};

TEST_F(PolygonLight, TrianglesOfAllSizesAndHeightsMatchDoublePrecision) {
    std::vector<PolygonInput> inputs;
    for (int i = 0; i < 20000; ++i) {
        const float size = std::exp(4.0f * uniform_(engine_));
        const glm::vec3 centre = direction();
        inputs.push_back({centre + size * direction(), centre + size * direction(),
                          centre + size * direction(), direction()});
    }
    const std::vector<float> results = evaluate(inputs);
    int above = 0;
    int cut = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const PolygonInput& p = inputs[i];
        int corners = 0;
        for (const glm::vec3& corner : {p.a, p.b, p.c})
            corners += glm::dot(corner, p.normal) > 0.0f ? 1 : 0;
        above += corners == 3 ? 1 : 0;
        cut += corners == 1 || corners == 2 ? 1 : 0;
        ASSERT_NEAR(results[i], exact(p), kTolerance) << i;
    }
    EXPECT_GT(above, 1000);
    EXPECT_GT(cut, 5000);
}

TEST_F(PolygonLight, ScaleDoesNotMatter) {
    std::vector<PolygonInput> inputs;
    for (const float scale : {1e-6f, 1e-3f, 1.0f, 1e3f, 1e6f}) {
        inputs.push_back({scale * glm::vec3(-1, 2, -1),
                          scale * glm::vec3(1, 2, -1),
                          scale * glm::vec3(0, 2, 1),
                          {0, 1, 0}});
        inputs.push_back({scale * glm::vec3(-1, -2, -1),
                          scale * glm::vec3(1, 2, -1),
                          scale * glm::vec3(0, 2, 1),
                          {0, 1, 0}});
    }
    const std::vector<float> results = evaluate(inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i)
        EXPECT_NEAR(results[i], exact(inputs[i % 2]), kTolerance) << i;
}

TEST_F(PolygonLight, LimitsByHand) {
    const glm::vec3 up(0, 1, 0);
    const std::vector<PolygonInput> inputs{
        {{-1, -1, 0}, {1, -1, 0}, {0, -1, 1}, up},                // below the horizon
        {{-1, 0, -1}, {1, 0, -1}, {0, 0, 1}, up},                 // in the horizon
        {{-1e6f, 1, -1e6f}, {1e6f, 1, -1e6f}, {0, 1, 1e6f}, up},  // the whole sky: pi
        {{0, 1e-3f, 0}, {1, 1e-3f, 0}, {1, 1e-3f, 0}, up},        // no area
        {{0, 0, 0}, {1, 1, 0}, {0, 1, 1}, up},                    // from one of its corners: must be finite
    };
    const std::vector<float> results = evaluate(inputs);
    EXPECT_EQ(results[0], 0.0f);
    EXPECT_NEAR(results[1], 0.0f, kTolerance);
    EXPECT_NEAR(results[2], std::numbers::pi, 1e-5);
    EXPECT_NEAR(results[3], 0.0f, kTolerance);
    EXPECT_TRUE(std::isfinite(results[4]));
}

}  // namespace
}  // namespace duolux::test
