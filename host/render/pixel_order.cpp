#include "host/render/pixel_order.h"

#include <numeric>

namespace duolux {

namespace {

constexpr std::uint32_t kTile = 16;

std::uint32_t everySecondBit(std::uint32_t x) {
    std::uint32_t out = 0;
    for (int bit = 0; bit < 4; ++bit)
        out |= (x >> (2 * bit) & 1u) << bit;
    return out;
}

}  // namespace

std::vector<std::uint32_t> pixelOrder(std::uint32_t width, std::uint32_t height) {
    const std::uint32_t tilesX = (width + kTile - 1) / kTile;
    const std::uint32_t tilesY = (height + kTile - 1) / kTile;
    const std::uint64_t tiles = std::uint64_t{tilesX} * tilesY;
    // A step of about the golden section visits every tile once if the step and the number of tiles are
    // coprime.
    std::uint64_t step = static_cast<std::uint64_t>(static_cast<double>(tiles) * 0.6180339887) | 1u;
    while (std::gcd(step, tiles) != 1)
        step += 2;

    std::vector<std::uint32_t> order;
    order.reserve(std::size_t{width} * height);
    for (std::uint64_t i = 0; i < tiles; ++i) {
        const std::uint64_t tile = i * step % tiles;
        const std::uint32_t x0 = static_cast<std::uint32_t>(tile % tilesX) * kTile;
        const std::uint32_t y0 = static_cast<std::uint32_t>(tile / tilesX) * kTile;
        for (std::uint32_t m = 0; m < kTile * kTile; ++m) {
            const std::uint32_t x = x0 + everySecondBit(m);
            const std::uint32_t y = y0 + everySecondBit(m >> 1);
            if (x < width && y < height) order.push_back(y * width + x);
        }
    }
    return order;
}

}  // namespace duolux
