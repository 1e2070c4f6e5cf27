#pragma once

#include <cstdint>

namespace duolux {

/// The samples [begin, end) of every pixel, out of 0 .. 2^24 - 1. With the light tracer, both numbers are
/// multiplied by the number of pixels to give the range of light paths.
struct SampleRange {
    std::uint32_t begin = 0, end = 0;

    /// Number of samples per pixel; begin <= end.
    std::uint32_t size() const { return end - begin; }
};

}  // namespace duolux
