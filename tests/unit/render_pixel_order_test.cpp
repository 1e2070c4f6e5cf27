#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "host/render/pixel_order.h"

namespace duolux {
namespace {

TEST(PixelOrder, HasEveryPixelOnce) {
    for (const auto& [width, height] :
         {std::pair{1u, 1u}, {16u, 16u}, {17u, 1u}, {640u, 480u}, {33u, 95u}, {1u, 300u}}) {
        std::vector<std::uint32_t> order = pixelOrder(width, height);
        std::sort(order.begin(), order.end());
        std::vector<std::uint32_t> all(width * height);
        std::iota(all.begin(), all.end(), 0u);
        EXPECT_EQ(order, all) << width << "x" << height;
    }
}

TEST(PixelOrder, EightInARowAreNeighbours) {
    const std::vector<std::uint32_t> order = pixelOrder(64, 64);
    for (std::size_t i = 0; i < order.size(); i += 8) {
        const auto [lowest, highest] = std::minmax_element(order.begin() + static_cast<long>(i),
                                                           order.begin() + static_cast<long>(i) + 8);
        EXPECT_LE(*highest / 64 - *lowest / 64, 3u);
    }
}

}  // namespace
}  // namespace duolux
