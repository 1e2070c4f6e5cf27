#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>

#include "tests/shader/density.h"
#include "tests/shader/oracles.h"

// Mappings from the unit square: densities, and both oracles.

namespace duolux::test {
namespace {

const ShaderLibrary& warp() {
    static const ShaderLibrary library("shaders/lib/warp.glsl");
    return library;
}

/// The centres of n x n cells: a stratified sample of the unit square.
std::vector<glm::vec2> unitSquare(int n) {
    std::vector<glm::vec2> us;
    for (int i = 0; i < n * n; ++i)
        us.push_back((glm::vec2(i % n, i / n) + 0.5f) / static_cast<float>(n));
    return us;
}

TEST(WarpOracles, CosineHemisphere) {
    const std::vector<glm::vec2> us = unitSquare(64);
    EXPECT_ORACLES(warp(), cosineHemisphere, (Budget{2, 5e-7}), us);
}

}  // namespace
}  // namespace duolux::test
