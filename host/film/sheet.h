#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "host/film/image.h"

namespace duolux {

struct SheetCell {
    RadianceImage image;
    std::string caption;  ///< UTF-8; shortened if it does not fit below the image
};

/// A contact sheet on white: rows of `columns` images, a caption centred below each. The images keep every
/// pixel, and have all one size. The sheet is in `visible`.
RadianceImage makeSheet(std::span<const SheetCell> cells, std::uint32_t columns);

}  // namespace duolux
