#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>

#include "tests/shader/density.h"
#include "tests/shader/inputs.h"
#include "tests/shader/oracles.h"

// Mappings from the unit square: densities, and both oracles.

namespace duolux::test {
namespace {

const ShaderLibrary& warp() {
    static const ShaderLibrary library("shaders/lib/warp.glsl");
    return library;
}

TEST(WarpOracles, CosineHemisphere) {
    const std::vector<glm::vec2> us = unitSquare(64);
    EXPECT_ORACLES(warp(), cosineHemisphere, (Budget{2, 5e-7}), us);
}

}  // namespace
}  // namespace duolux::test
