#pragma once

#include <cstdint>
#include <span>

namespace duolux {

/// The tables of shaders/shared/albedo_layout.h, which make_albedo_tables computes in the build:
/// kAlbedoTexels texels of four words.
std::span<const std::uint32_t> albedoTables();

}  // namespace duolux
