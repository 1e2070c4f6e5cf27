#include "tests/shader/mirror/mirror.h"

#include <gtest/gtest.h>
TEST(Mirror, X) {
    const auto w = duolux::mirror::twice::cosineHemisphere({0.3, 0.7});
    EXPECT_NEAR(glm::length(w), 1.0, 1e-15);
}
