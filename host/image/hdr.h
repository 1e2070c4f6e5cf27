#pragma once

#include <string>
#include <string_view>

#include "host/film/codec.h"

namespace duolux {

/// Decodes a Radiance picture (Ward, "Real Pixels", Graphics Gems II, 1991; Radiance's file formats): rows
/// from the top, of shared exponents, compressed or not. Throws InputError naming `file`.
RgbaImage decodeHdr(std::string_view bytes, const std::string& file);

}  // namespace duolux
