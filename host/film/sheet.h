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

/// A contact sheet on a white background: rows of `columns` images with a centred caption below each. The
/// images have equal sizes and are not scaled. The sheet is stored in `visible`.
RadianceImage makeSheet(std::span<const SheetCell> cells, std::uint32_t columns);

}  // namespace duolux
