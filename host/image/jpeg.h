#pragma once

#include <string>
#include <string_view>

#include "host/scene/texture.h"

namespace duolux {

/// Decodes a JPEG: grey, YCbCr, RGB, or CMYK and YCCK as Adobe's programs write them. Throws InputError
/// naming `file`, also if the file ends early.
Image decodeJpeg(std::string_view bytes, const std::string& file);

}  // namespace duolux
